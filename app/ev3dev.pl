% The pack from a shell. Where SWI-Prolog has apps (9.1.18 and later) and the
% pack is installed:
%
%   swipl ev3dev view
%   swipl ev3dev run examples/obstacle_avoidance.pl --world room --for 60
%
% In older versions, and from a clone of the repository:
%
%   swipl app/ev3dev.pl view
%
% It ends with status 0; 1 if the answer is no or the program failed; 2 if
% the command line makes no sense.

:- module(ev3dev_app, [main/1]).
:- prolog_load_context(directory, Here),
   file_directory_name(Here, Pack),
   atom_concat(Pack, '/prolog', Library),
   (   exists_directory(Library)
   ->  asserta(user:file_search_path(library, Library))
   ;   true
   ),
   assertz(user:file_search_path(ev3dev_pack, Pack)).
:- use_module(library(ev3dev)).
:- use_module(library(ev3dev/sim)).
:- use_module(library(lists)).
:- use_module(library(main), [main/0]).
:- use_module(library(readutil)).
:- use_module(library(time)).

:- initialization(main, main).

main(Arguments) :-
    run_command(Arguments, Status),
    halt(Status).

%!  run_command(+Arguments, -Status) is det.

run_command(Arguments, Status) :-
    catch(command_line(Arguments, Command, Files, Options),
          usage(Format, Values), true),
    (   nonvar(Format)
    ->  complain(Format, Values),
        Status = 2
    ;   Command == help
    ->  help,
        Status = 0
    ;   catch(call_command(Command, Files, Options), Error,
              (   print_message(error, Error), fail ))
    ->  Status = 0
    ;   Status = 1
    ).

complain(Format, Values) :-
    format(user_error, "ev3dev: ", []),
    format(user_error, Format, Values),
    format(user_error, "~nSee: swipl ev3dev --help~n", []).

help :-
    forall(help_line(Line), format("~s~n", [Line])).

help_line(`swipl ev3dev COMMAND [ARGUMENT] [OPTION ...]`).
help_line(``).
help_line(`  view [FILE]   show the robot in a browser, and the toplevel`).
help_line(`  sim WORLD     the same with a simulated robot in a world:`).
help_line(`                room, lights, line, grid, maze, or a file`).
help_line(`  run FILE      load a program, call start/0 or main/0 or --goal`).
help_line(`  devices       what is connected`).
help_line(`  check         try each motor and sensor; lift the robot first`).
help_line(`  jog           drive with the arrow keys of the terminal`).
help_line(``).
help_line(`  --world W     simulate: run, devices, check, jog`).
help_line(`  --robot R     the simulated robot: default, touch, or a file`).
help_line(`  --noise       errors as of real devices; --seed N, other ones`).
help_line(`  --clock C     virtual (for run), realtime, or a factor`).
help_line(`  --for S       run: end after S seconds of the robot's time`).
help_line(`  --goal G      run: the goal`).
help_line(`  --view        run, jog: with the view`).
help_line(`  --port P      of the view's address`).
help_line(`  --address any other machines can open the view, too`).
help_line(`  --no-open     open no browser`).
help_line(`  --speed P     jog: percent of full speed`).
help_line(`  --wheel D --axle L --left PORT --right PORT`).
help_line(`                jog: the robot; 5.6, 10.6, outB and outC`).
help_line(``).
help_line(`Status: 0; 1 if the answer is no, or the program failed;`).
help_line(`2 if the command line makes no sense.`).

                /*******************************
                *         COMMAND LINE         *
                *******************************/

%   What a command takes besides options: at least and at most how many files.
command(view, 0, 1).
command(sim, 1, 1).
command(run, 1, 1).
command(devices, 0, 0).
command(check, 0, 0).
command(jog, 0, 0).

option_type(world, text).
option_type(robot, text).
option_type(seed, integer).
option_type(noise, flag).
option_type(clock, text).
option_type(for, number).
option_type(goal, text).
option_type(view, flag).
option_type(port, integer).
option_type(address, text).
option_type('no-open', flag).
option_type(speed, number).
option_type(wheel, number).
option_type(axle, number).
option_type(left, text).
option_type(right, text).

for_command(view, [port, address, 'no-open']).
for_command(sim, [robot, seed, noise, clock, port, address, 'no-open']).
for_command(run, [world, robot, seed, noise, clock, for, goal, view, port,
                  address, 'no-open']).
for_command(devices, [world, robot]).
for_command(check, [world, robot]).
for_command(jog, [world, robot, seed, noise, clock, speed, wheel, axle, left,
                  right, view, port, address, 'no-open']).

command_line(Arguments, Command, Files, Options) :-
    (   ( Arguments == [] ; member(Help, [help, '--help', '-h']),
          memberchk(Help, Arguments) )
    ->  Command = help, Files = [], Options = []
    ;   Arguments = [Command|Rest],
        (   command(Command, Least, Most)
        ->  true
        ;   throw(usage("there is no command ~w", [Command]))
        ),
        split(Rest, Files, Options),
        length(Files, Count),
        (   Count < Least
        ->  throw(usage("~w needs a world or a file", [Command]))
        ;   Count > Most
        ->  nth0(Most, Files, Extra),
            throw(usage("~w does not take ~w", [Command, Extra]))
        ;   true
        ),
        for_command(Command, Known),
        (   member(Option, Options), functor(Option, Name, 1),
            \+ memberchk(Name, Known)
        ->  throw(usage("~w has no option --~w", [Command, Name]))
        ;   true
        )
    ).

split([], [], []).
split([Argument|Arguments], Files, Options) :-
    (   atom_concat(--, Option, Argument)
    ->  (   sub_atom(Option, Before, _, After, =)
        ->  sub_atom(Option, 0, Before, _, Name),
            sub_atom(Option, _, After, 0, Value),
            Rest0 = [Value|Arguments],
            Given = true
        ;   Name = Option,
            Rest0 = Arguments,
            Given = false
        ),
        option_value(Name, Given, Rest0, Rest, Term),
        Options = [Term|Options1],
        split(Rest, Files, Options1)
    ;   Files = [Argument|Files1],
        split(Arguments, Files1, Options)
    ).

option_value(Name, Given, Rest0, Rest, Term) :-
    (   option_type(Name, Type)
    ->  true
    ;   throw(usage("there is no option --~w", [Name]))
    ),
    (   Type == flag
    ->  (   Given == true
        ->  throw(usage("--~w takes no value", [Name]))
        ;   Rest = Rest0, Value = true
        )
    ;   Rest0 = [Text|Rest]
    ->  value(Type, Name, Text, Value)
    ;   throw(usage("--~w needs a value", [Name]))
    ),
    Term =.. [Name, Value].

value(text, _, Text, Text).
value(number, Name, Text, Number) :-
    (   atom_number(Text, Number), Number >= 0
    ->  true
    ;   throw(usage("--~w needs a number, not ~w", [Name, Text]))
    ).
value(integer, Name, Text, Number) :-
    (   atom_number(Text, Number), integer(Number), Number >= 0
    ->  true
    ;   throw(usage("--~w needs a whole number, not ~w", [Name, Text]))
    ).

setting(Name, Options, Value, Default) :-
    Option =.. [Name, Given],
    (   memberchk(Option, Options)
    ->  Value = Given
    ;   Value = Default
    ).

                /*******************************
                *           COMMANDS           *
                *******************************/

call_command(view, Files, Options) :-
    start_view(Options),
    load_programs(Files),
    session.
call_command(sim, [World], Options) :-
    start_world(World, realtime, Options),
    start_view(Options),
    session.
call_command(run, [File], Options) :-
    (   memberchk(view(true), Options)
    ->  Clock = realtime
    ;   Clock = virtual
    ),
    start_world_if_any(Clock, Options),
    (   memberchk(view(true), Options)
    ->  start_view(Options)
    ;   true
    ),
    load_program(File),
    goal_of(Options, Goal),
    setup_call_cleanup(
        true,
        ( run_goal(Goal, Options) -> Outcome = true ; Outcome = false ),
        stop_all_motors),
    summary,
    (   Outcome == true
    ->  true
    ;   format(user_error, "ev3dev: ~q failed~n", [Goal]),
        fail
    ).
call_command(devices, [], Options) :-
    start_world_if_any(virtual, Options),
    ev3_devices,
    once(( lego_sensor(_) ; tacho_motor(_) )).
call_command(check, [], Options) :-
    start_world_if_any(virtual, Options),
    absolute_file_name(ev3dev_pack(examples/brick_check), File,
                       [file_type(prolog), access(read)]),
    use_module(File),
    Report = brick_check:report,
    call_cleanup(Report, stop_all_motors).
call_command(jog, [], Options) :-
    start_world_if_any(realtime, Options),
    (   memberchk(view(true), Options)
    ->  start_view(Options)
    ;   true
    ),
    setting(wheel, Options, Wheel, 5.6),
    setting(axle, Options, Axle, 10.6),
    setting(left, Options, Left, outB),
    setting(right, Options, Right, outC),
    setting(speed, Options, Speed, 30),
    set_robot(Wheel, Axle, Left, Right),
    use_module(library(ev3dev/jog)),
    Jog = ev3dev_jog:jog([speed(Speed)]),
    call(Jog).

load_programs([]).
load_programs([File|Files]) :-
    load_program(File),
    load_programs(Files).

load_program(File) :-
    (   exists_source(File)
    ->  true
    ;   throw(error(existence_error(file, File), _))
    ),
    user:load_files(File, []).

exists_source(File) :-
    absolute_file_name(File, _, [ file_type(prolog), access(read),
                                  file_errors(fail) ]).

%   The goal is read after the program is loaded, whose operators it may use.

goal_of(Options, Goal) :-
    memberchk(goal(Text), Options),
    !,
    term_to_atom(Goal, Text).
goal_of(_, Goal) :-
    member(Goal, [start, main]),
    current_predicate(user:Goal/0),
    !.
goal_of(_, _) :-
    throw(error(existence_error(procedure, start/0), _)).

run_goal(Goal, Options) :-
    memberchk(for(Seconds), Options),
    !,
    ev3_sysfs(_),
    (   sim_time(_)
    ->  for_seconds(Seconds, user:Goal)
    ;   catch(call_with_time_limit(Seconds, user:Goal),
              time_limit_exceeded, true)
    ),
    !.
run_goal(Goal, _) :-
    call(user:Goal),
    !.

summary :-
    (   sim_time(Time)
    ->  sim_pose(X, Y, Heading),
        sim_collisions(Collisions),
        length(Collisions, Count),
        format("~2f s simulated; the robot is at ~1f, ~1f cm, heading ~0f; \c
                it ran into something ~d times.~n",
               [Time, X, Y, Heading, Count])
    ;   true
    ).

start_world_if_any(Clock, Options) :-
    (   memberchk(world(World), Options)
    ->  start_world(World, Clock, Options)
    ;   true
    ).

start_world(World, Clock0, Options) :-
    setting(clock, Options, Clock1, Clock0),
    clock(Clock1, Clock),
    setting(robot, Options, Robot, default),
    setting(noise, Options, Noise, false),
    setting(seed, Options, Seed, 1),
    sim_start(World, [clock(Clock), robot(Robot), noise(Noise), seed(Seed)]).

clock(Text, Clock) :-
    (   memberchk(Text, [virtual, realtime])
    ->  Clock = Text
    ;   atom_number(Text, Factor)
    ->  Clock = scaled(Factor)
    ;   throw(error(domain_error(clock, Text), _))
    ).

start_view(Options) :-
    use_module(library(ev3dev/view)),
    findall(Option, view_option(Options, Option), Chosen),
    View = ev3dev_view:view(Chosen),
    call(View).

view_option(Options, port(Port)) :-
    memberchk(port(Port), Options).
view_option(Options, address(any)) :-
    memberchk(address(any), Options).
view_option(Options, open(false)) :-
    memberchk('no-open'(true), Options).

%   The toplevel, in which Ctrl-C interrupts a goal and does not end all.

session :-
    catch(on_signal(int, _, debug), _, true),
    prolog.
