% The pack from a shell. Where SWI-Prolog has apps (9.1.18 and later) and the
% pack is installed:
%
%   swipl ev3dev view
%   swipl ev3dev run obstacle_avoidance --world room --for 60
%
% In older versions, and from a clone of the repository:
%
%   swipl app/ev3dev.pl view
%
% It ends with status 0; 1 if the answer is no or the program failed; 2 if
% the command line makes no sense.

% No exports: what a module of the pack exports is blamed for errors.
:- module(ev3dev_app, []).
:- prolog_load_context(directory, Here),
   file_directory_name(Here, Pack),
   atom_concat(Pack, '/prolog', Library),
   (   exists_directory(Library)
   ->  asserta(user:file_search_path(library, Library))
   ;   true
   ),
   assertz(user:file_search_path(ev3dev_pack, Pack)).
:- use_module(library(ev3dev)).
% The pack has said that its native library is missing.
:- (   module_property(ev3dev_no_library, file(_))
   ->  halt(1)
   ;   true
   ).
:- use_module(library(ev3dev/sim)).
:- use_module(library(ev3dev/private/app/command_line)).
:- use_module(library(ev3dev/private/explain/last_goal)).
:- use_module(library(apply), [maplist/3]).
:- use_module(library(lists), [member/2]).
:- use_module(library(readutil), [read_file_to_terms/3]).
:- use_module(library(time)).

:- initialization(main, main).

%   Not main/0 of library(main), which ends the toplevel at Ctrl-C, too.

main :-
    current_prolog_flag(argv, Arguments),
    catch(status(Arguments, Status), usage(Format, Values),
          ( complain(Arguments, Format, Values),
            Status = 2 )),
    (   Status == toplevel
    ->  toplevel
    ;   halt(Status)
    ).

%!  status(+Arguments, -Status) is det.
%
%   Status may also be `toplevel`. Throws usage(Format, Values) if Arguments
%   make no sense.

status(Arguments, Status) :-
    (   is_help(Arguments, Command)
    ->  help(Command),
        Status = 0
    ;   Arguments = ['--version'|_]
    ->  version,
        Status = 0
    ;   command_line(Arguments, Command, Files, Options),
        (   memberchk(Command, [view, sim])
        ->  End = toplevel
        ;   End = 0,
            on_signal(int, _, interrupt),
            hide_thread
        ),
        succeeds(call_command(Command, Files, Options))
    ->  Status = End
    ;   Status = 1
    ).

interrupt(_) :-
    (   current_prolog_flag(argv, [mark|_])
    ->  format(user_error, "~nInterrupted. The same command with --resume \c
                            goes on.~n", [])
    ;   true
    ),
    halt(1).

%   10.1 begins each message with `[Thread main]` otherwise.

hide_thread :-
    (   current_prolog_flag(message_context, _)
    ->  set_prolog_flag(message_context, [])
    ;   true
    ).

%   The toplevel of Prolog itself comes after main/0, but in 7.2.3.

toplevel :-
    (   current_prolog_flag(toplevel_goal, _)
    ->  set_prolog_flag(toplevel_goal, prolog)
    ;   prolog
    ).

%   An error is a failure, once it is printed.

succeeds(Goal) :-
    catch(Goal, error(Formal, Context),
          ( print_message(error, error(Formal, Context)), fail )),
    !.

version :-
    read_file_to_terms(ev3dev_pack('pack.pl'), Facts, []),
    memberchk(version(Version), Facts),
    current_prolog_flag(version, Prolog),
    Major is Prolog//10000,
    Minor is Prolog//100 mod 100,
    Patch is Prolog mod 100,
    format("ev3dev ~w, SWI-Prolog ~d.~d.~d~n",
           [Version, Major, Minor, Patch]).

% ---------------- COMMANDS

call_command(view, Files, Options) :-
    maplist(program_file, Files, Paths),
    start_view(Options),
    load_files(user:Paths, []),
    load_libraries.
call_command(sim, [World], Options) :-
    start_world(World, realtime, Options),
    start_view(Options),
    load_libraries.
call_command(run, [File], Options) :-
    program_file(File, Path),
    (   setting(view, Options, true)
    ->  Clock = realtime
    ;   Clock = virtual
    ),
    start_world_if_any(Clock, Options),
    start_view_if_any(Options),
    bound_stack,
    load_files(user:Path, []),
    goal_of(File, Options, Goal),
    recorded(Options, Goal, Called, Text),
    setup_call_cleanup(
        true,
        outcome(run_goal(Called, Options), Outcome),
        stop_all_motors),
    summary,
    call(Text),
    report(Outcome, Goal).
call_command(playground, Folders, Options) :-
    use_module(library(ev3dev/private/app/playground_server), []),
    playground_folder(Folders, Folder),
    setting(port, Options, Port, 8034),
    setting(address, Options, Address, localhost),
    ( setting('no-open', Options, true) -> Open = false ; Open = display ),
    Serve = ev3dev_playground_server:serve(Folder, Address, Port, Open),
    call(Serve).
call_command(devices, [], Options) :-
    start_world_if_any(virtual, Options),
    ev3_devices,
    once(( lego_sensor(_) ; tacho_motor(_) )).
call_command(check, [], Options) :-
    start_world_if_any(virtual, Options),
    absolute_file_name(ev3dev_pack(examples/brick_check), File,
                       [file_type(prolog), access(read)]),
    use_module(File, []),
    Report = brick_check:report,
    call_cleanup(Report, stop_all_motors).
call_command(work, [], Options) :-
    use_module(library(ev3dev/sim_batch), []),
    setting(redis, Options, Address, 'localhost:6379'),
    ( current_prolog_flag(cpu_count, Count) -> true ; Count = 1 ),
    setting(workers, Options, Workers, Count),
    Work = ev3dev_sim_batch:sim_batch_work(Address, Workers),
    call(Work).
call_command(try, [Exercise, Program], Options) :-
    exercise_file(Exercise, File),
    a_file(Program),
    findall(Option, marking_option(Options, Option), Chosen),
    (   setting(page, Options, Page)
    ->  true
    ;   file_name_extension(Base, _, Program),
        file_base_name(Base, Name0),
        ( sub_atom(Name0, 0, 60, _, Name) -> true ; Name = Name0 ),
        atom_concat(Name, '.html', Page)    % of at most 255 bytes
    ),
    use_module(library(ev3dev/exercise), []),
    Try = ev3dev_exercise:exercise_try(File, Program, [page(Page)|Chosen]),
    call(Try).
call_command(mark, [Exercise|Named], Options) :-
    exercise_file(Exercise, File),
    forall(( member(Path, Named), \+ exists_directory(Path) ), a_file(Path)),
    findall(Option, marking_option(Options, Option), Chosen),
    setting(out, Options, Folder, marks),
    use_module(library(ev3dev/exercise), []),
    Mark = ev3dev_exercise:exercise_mark(File, Named,
                                         [ out(Folder), progress(true)
                                         | Chosen ], Marks),
    call(Mark),
    (   Marks == []
    ->  atomic_list_concat(Named, ' ', Places),
        throw(usage("there are no programs (*.pl) in ~w", [Places]))
    ;   true
    ),
    forall(( member(mark(Name, Points, Of, _, _, Reason), Marks),
             normalize_space(atom(Line), Name) ),
           format("~w ~t~24|~w of ~w~t~36|~w~n", [Line, Points, Of, Reason])),
    format("The reports: ~w~n", [Folder]).
call_command(jog, [], Options) :-
    start_world_if_any(realtime, Options),
    start_view_if_any(Options),
    setting(wheel, Options, Wheel, 5.6),
    setting(axle, Options, Axle, 10.6),
    setting(left, Options, Left, outB),
    setting(right, Options, Right, outC),
    setting(speed, Options, Speed, 30),
    set_robot(Wheel, Axle, Left, Right),
    use_module(library(ev3dev/jog)),
    Jog = ev3dev_jog:jog([speed(Speed)]),
    call(Jog).

%   A folder with one, a file, or one of the course, by its name, its number
%   or a part that no other one has.

exercise_file(Exercise, File) :-
    (   (   \+ atom_number(Exercise, _),       % 3 is not 3.pl
            member(Where, [ Exercise, ev3dev_pack(course/Exercise) ])
        ;   part_of_course(Exercise, Name),
            Where = ev3dev_pack(course/Name)
        ;   Where = Exercise
        ),
        (   absolute_file_name(Where, Folder,
                               [file_type(directory), file_errors(fail)]),
            atom_concat(Folder, '/exercise.pl', File),
            exists_file(File)
        ;   absolute_file_name(Where, File,
                               [ file_type(prolog), access(read),
                                 file_errors(fail) ]),
            exists_file(File)
        )
    ->  true
    ;   no_such(exercise, Exercise)
    ).

part_of_course(Exercise, Name) :-
    absolute_file_name(ev3dev_pack(course), Course,
                       [file_type(directory), file_errors(fail)]),
    directory_files(Course, Names0),
    msort(Names0, Names),
    findall(Name0,
            ( member(Name0, Names),
              sub_atom(Name0, 2, 1, _, -),
              (   atom_number(Exercise, Number)
              ->  sub_atom(Name0, 0, 2, _, Digits),
                  atom_number(Digits, Number)
              ;   sub_atom(Name0, 3, _, 0, Words),
                  once(sub_atom(Words, _, _, _, Exercise))
              ) ),
            [Name|Others]),
    (   Others == []
    ->  true
    ;   atomic_list_concat([Name|Others], ', ', Listed),
        throw(usage("~w is a part of several exercises: ~w",
                    [Exercise, Listed]))
    ).

a_file(File) :-
    (   exists_file(File)
    ->  true
    ;   throw(usage("there is no file ~w", [File]))
    ).

marking_option(Options, jobs(Count)) :-
    setting(jobs, Options, Count).
marking_option(Options, seeds(Seeds)) :-
    setting(seeds, Options, Seeds).
marking_option(Options, formats([Format])) :-
    setting(format, Options, Format).
marking_option(Options, participants(List)) :-
    setting(participants, Options, List).
marking_option(Options, earlier(Folder)) :-
    setting(earlier, Options, Folder).
marking_option(Options, resume(true)) :-
    setting(resume, Options, true).
marking_option(Options, enclosed(false)) :-
    setting('no-fence', Options, true).
marking_option(Options, redis(Address)) :-
    setting(redis, Options, Address).

%   The folder of `make playground`, unless another one is named.

playground_folder(Folders, Folder) :-
    (   Folders = [Named|_]
    ->  true
    ;   Named = ev3dev_pack('dist/playground')
    ),
    absolute_file_name(Named, Folder),
    atom_concat(Folder, '/parts.bin', Parts),
    (   exists_file(Parts)
    ->  true
    ;   throw(usage("~w has no playground: make playground, in a clone of \c
                     the repository, builds one", [Folder]))
    ).

%   A file, or an example of the pack.

program_file(File, Path) :-
    (   member(Where, [File, ev3dev_pack(examples/File)]),
        absolute_file_name(Where, Path, [ file_type(prolog), access(read),
                                          file_errors(fail) ]),
        exists_file(Path)
    ->  true
    ;   no_such(program, File)
    ).

%   The goal is read after the program is loaded, whose operators it may use.

goal_of(_, Options, Goal) :-
    setting(goal, Options, Text),
    !,
    (   catch(term_to_atom(Goal, Text), error(syntax_error(_), _), fail),
        callable(Goal)
    ->  true
    ;   throw(usage("--goal needs a goal, not ~w", [Text]))
    ).
goal_of(_, _, Goal) :-
    member(Goal, [start, main]),
    current_predicate(user:Goal/0),
    !.
goal_of(File, _, _) :-
    throw(usage("~w has neither start/0 nor main/0: name a goal by --goal",
                [File])).

run_goal(Goal, Options) :-
    setting(for, Options, Seconds),
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

%   With --reasoning Text prints at the end what Prolog did.

recorded(Options, Goal, Called, Text) :-
    (   setting(reasoning, Options, true)
    ->  use_module(library(ev3dev/reasoning), []),
        Called = ev3dev_reasoning:reasoning(user:Goal),
        Text = ev3dev_reasoning:reasoning_text
    ;   Called = Goal,
        Text = true
    ).

%   An endless recursion ends after seconds; a brick has less room anyway.

bound_stack :-
    Most is 256*1024*1024,
    (   current_prolog_flag(stack_limit, Limit),
        Limit > Most
    ->  set_prolog_flag(stack_limit, Most)
    ;   true
    ).

summary :-
    (   sim_time(Time)
    ->  sim_pose(X, Y, Heading),
        sim_collisions(Collisions),
        length(Collisions, Count),
        times(Count, Times),
        format("~2f s simulated; the robot is at ~1f, ~1f cm, heading ~0f; \c
                it ran into ~w.~n",
               [Time, X, Y, Heading, Times])
    ;   true
    ).

times(0, nothing) :- !.
times(1, 'something once') :- !.
times(Count, Times) :-
    format(atom(Times), "something ~d times", [Count]).

start_world_if_any(Clock, Options) :-
    (   setting(world, Options, World)
    ->  start_world(World, Clock, Options)
    ;   true
    ).

start_world(World, Clock0, Options) :-
    setting(clock, Options, Clock1, Clock0),
    ( number(Clock1) -> Clock = scaled(Clock1) ; Clock = Clock1 ),
    setting(robot, Options, Robot, default),
    setting(noise, Options, Noise, false),
    setting(seed, Options, Seed, 1),
    catch(sim_start(World, [ clock(Clock), robot(Robot), noise(Noise),
                             seed(Seed) ]),
          error(existence_error(Kind, Name), Context),
          (   memberchk(Kind, [world, robot])
          ->  no_such(Kind, Name)
          ;   throw(error(existence_error(Kind, Name), Context))
          )).

start_view_if_any(Options) :-
    (   setting(view, Options, true)
    ->  start_view(Options)
    ;   true
    ).

start_view(Options) :-
    use_module(library(ev3dev/view)),
    findall(Option, view_option(Options, Option), Chosen),
    View = ev3dev_view:view(Chosen),
    call(View).

view_option(Options, port(Port)) :-
    setting(port, Options, Port).
view_option(Options, address(any)) :-
    setting(address, Options, any).
view_option(Options, open(false)) :-
    setting('no-open', Options, true).

%   For the toplevel, except names that a loaded program uses for its own.

load_libraries :-
    forall(member(Library-Module,
                  [ ev3dev-ev3dev, ev3dev/sim-ev3dev_sim,
                    ev3dev/drive-ev3dev_drive, ev3dev/view-ev3dev_view ]),
           ( use_module(library(Library), []),
             module_property(Module, exports(Exports)),
             findall(PI,
                     ( member(PI, Exports), current_predicate(user:PI) ),
                     Taken),
             use_module(user:library(Library), except(Taken)) )).
