:- module(ev3dev_sim_fenced,
          [ sim_fenced/2,               % +File, -Ended
            sim_fenced/3,               % +File, -Ended, +Options
            can_enclose/0
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/load/compiled, [pack_folder/1]).
:- use_module(private/checks/arguments,
              [ limit_option/2, limit_option/3, must_be_options/3,
                option/3 ]).
:- use_module(private/simulation/random_seed, [branch_seed/1]).
:- use_module(private/simulation/thinking_rate, [thinking_rate/2]).
:- use_module(private/batch/workplace, [end_workplace/1, new_workplace/2]).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [in_own_name/1, throw_error/3]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(private/native/native,
              [ sim_fence_close_/0, sim_fence_open_/2,
                sim_fence_serve_/3, sim_fence_silent_/0 ]).
:- use_module(private/processes/usage,
              [ usage_age/2, usage_begins/1, usage_beyond/3, usage_crowded/3,
                usage_goes_on/5, usage_heard/2 ]).
:- use_module(sim_time, [sim_time/1]).
:- use_module(library(lists), [append/2, append/3, member/2]).
:- use_module(library(process),
              [ process_create/3, process_group_kill/2, process_kill/2,
                process_wait/3 ]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> A program that cannot see the world

The running simulation shows its robot to a program in another process: the
files of motors, sensors, buttons and screen, and nothing else. There are no
sim_pose/3, no world and no seed. The clock is virtual, and the program's
random numbers follow the seed of the simulation, so each run is the same,
also on a busy machine.

```
?- sim_start(maze, [clock(virtual), seed(7)]),
   sim_fenced('explorer.pl', Ended, [goal(start), seconds(60)]),
   sim_pose(X, Y, _), sim_collisions(Collisions).
Ended = over,
```
*/

%!  sim_fenced(+File, -Ended) is semidet.
%!  sim_fenced(+File, -Ended, +Options) is semidet.
%
%   Run the program File in a process of its own, with the robot of the
%   running simulation, whose clock must be virtual. The program needs no
%   change; its time begins at the simulation's. Ended is
%
%     - exit(Status)
%       It has ended by itself.
%     - killed(Signal)
%       It has crashed.
%     - over
%       Its simulated time was over.
%     - limit(sleep)
%     - limit(cpu)
%     - limit(output)
%     - limit(memory)
%     - limit(processes)
%       It slept or computed for too long, has printed too much, or its
%       processes had too much memory together, or more than 200 threads.
%     - refused(Why)
%       It has sent what no program sends by these libraries. Why is a string.
%     - lost
%       Nothing can be said of it: for ten minutes it neither slept nor could
%       compute, or it had half an hour and has come to no limit. The machine
%       was too busy.
%
%   Only in the first two cases did it end by itself; in the others it is
%   killed with all its processes, and its motors may still run. Options:
%
%     - goal(Goal)
%       What to call after File was loaded. Default is `main`.
%     - seconds(Seconds)
%       When its simulated time is over, counted from now. By default never.
%     - sleep(Seconds)
%       How long it may sleep without asking the robot anything, as in
%       sleep/1 or a read: all that it does so together, or `infinite`.
%       Default is 60. Time in which one of its threads could run, or waits
%       for an answer, does not count.
%     - cpu(Seconds)
%       How much time of a processor all its processes may use together, or
%       `infinite`. Default is 60. There is one second more for each second
%       of simulated time.
%     - salt(Text)
%       The seed of its random numbers is made of Text and the seed of the
%       simulation. A program that does not know Text cannot find that seed
%       from its numbers. Default is `''`.
%     - memory(Megabytes)
%       How much memory each of its processes may use, and all of them
%       together. By default as much as they like.
%     - enclosed(Boolean)
%       Whether the program is shut in by bwrap (bubblewrap): it has no
%       network, sees no other processes, no files but its own and those of
%       SWI-Prolog and the pack, and nothing of the environment. What it
%       writes is in memory, 64 MB at most. Default is `false`.
%     - thinking(Thinking)
%       What it costs the program to compute, as in sim_start/2.
%     - files(Files)
%       Other files that it loads, which are its own, too. Default is [].
%     - output(Text)
%       Text is a string of what it has printed, errors and warnings, too: at
%       most 1 MB.
%     - told(Lines)
%       Lines is a list of Time-Text, what began when, in words: rules that
%       became active, events, actions of Golog. The first 4000 are kept, and
%       the program could say anything.
%
%   While it runs, no other thread may let simulated time pass. Fails if no
%   simulation runs.
%
%   @error existence_error(source_sink, File)
%   @error permission_error(fence, clock, realtime) if it is not virtual
%   @error existence_error(program, bwrap) if it is to be enclosed and cannot
%   @error domain_error(sim_fenced_option, Option)

sim_fenced(File, Ended) :-
    sim_fenced(File, Ended, []).

sim_fenced(File, Ended, Options) :-
    must_be_options(sim_fenced_option,
                    [ goal, seconds, sleep, cpu, memory, enclosed, output,
                      told, salt, files, thinking ], Options),
    thinking_rate(Options, Thinking),
    option(goal(Goal), Options, main),
    must_be(callable, Goal),
    limit_option(seconds(Seconds), Options),
    limit_option(sleep(Sleep), Options, 60),
    limit_option(cpu(Cpu), Options, 60),
    option(memory(Megabytes), Options, unlimited),
    (   Megabytes == unlimited
    ->  true
    ;   must_be(positive_integer, Megabytes)
    ),
    option(enclosed(Enclosed), Options, false),
    must_be(boolean, Enclosed),
    (   Enclosed == true,
        \+ can_enclose
    ->  throw_error(existence_error(program, bwrap), _,
                    'bubblewrap is not installed, or may not be used')
    ;   true
    ),
    option(files(Files), Options, []),
    must_be(list, Files),
    option(salt(Salt), Options, ''),
    must_be(text, Salt),
    own_seed(Salt, Seed),
    option(output(Text), Options, _),
    option(told(Told), Options, none),
    in_own_name(absolute_file_name(File, Path,
                                   [file_type(prolog), access(read)])),
    setup_call_cleanup(
        fence_directory(Directory),
        in_directory(Directory, [Path|Files], Goal, Seed-Thinking,
                     limits(Seconds, Sleep, Cpu, Megabytes, Enclosed), Ended,
                     Text, Told),
        ( sim_fence_close_, end_workplace(Directory) )).

%   What the program may write is in a directory of its own.

fence_directory(Directory) :-
    new_workplace(ev3dev_fence, Directory),
    atom_concat(Directory, '/own', Own),
    make_directory(Own).

in_directory(Directory, Paths, Goal, Seed-Thinking,
             limits(Seconds, Sleep, Cpu, Memory, Shut), Ended, Text, Told) :-
    atom_concat(Directory, '/own/robot', Socket),
    atom_concat(Directory, '/own/told', Tells),
    atom_concat(Directory, '/output', Output),
    (   Told == none
    ->  ToldBy = ''
    ;   ToldBy = Tells
    ),
    Paths = [Path|_],
    (   runs_here(Path, run(Goal, Seed, Seconds), Output-ToldBy, Ended0)
    ->  true
    ;   in_process([Socket, ToldBy, Seed]-Thinking, Paths, Goal,
                   Directory-Output,
                   limits(Seconds, Sleep, Cpu, Memory, Shut), Ended0)
    ),
    printed(Output, Size, Text),
    (   Size >= 1 << 20
    ->  Ended = limit(output)
    ;   Ended = Ended0
    ),
    (   Told == none
    ->  true
    ;   what_was_told(Tells, Told)
    ).

%   Where there are no processes, somebody else runs the program:
%   runs_here(+Path, +Run, +Files, -Ended).

:- multifile runs_here/4.

in_process([Socket, ToldBy, Seed]-Thinking, Paths, Goal, Directory-Output,
           limits(Seconds, Sleep, Cpu, Memory, Shut), Ended) :-
    sim_time(Now),
    (   sim_fence_open_(Socket, Thinking)
    ->  true
    ;   throw_error(permission_error(fence, clock, realtime), _,
                    'the clock of the simulation must be virtual')
    ),
    (   Seconds == infinite
    ->  Until = inf
    ;   Until is Now + Seconds
    ),
    processor_time(Cpu, Now, Until, AtMost),
    usage_begins(Used),
    setup_call_cleanup(
        start(Directory, [Socket, ToldBy, Seed], Output, Paths, Goal,
              AtMost-Memory-Shut, Pid),
        served(Pid, Until, limits(Sleep, Cpu, Now, Memory), Used, Ended),
        ended(Pid, Directory, Shut)).

%   A program that never had its turn has no output.

printed(Output, Size, Text) :-
    (   exists_file(Output)
    ->  size_file(Output, Size),
        read_file_to_string(Output, Text, [encoding(utf8)])
    ;   Size = 0,
        Text = ""
    ).

%   The seed of the program's own numbers. It draws them in another process,
%   so these here go on.

own_seed(Salt, Seed) :-
    branch_seed(Drawn),
    (   Drawn == none
    ->  Seed = ''
    ;   variant_sha1(seed(Salt, Drawn), Hash),
        sub_atom(Hash, 0, 15, _, Digits),
        atom_concat('0x', Digits, Number),
        atom_number(Number, Seed)
    ).

%!  processor_time(+Cpu, +From, +Time, -Seconds) is det.
%
%   How much time of a processor may be used until the simulated Time.

processor_time(Cpu, From, Time, Seconds) :-
    (   ( Cpu == infinite ; Time == inf )
    ->  Seconds = infinite
    ;   Seconds is Cpu + Time - From
    ).

%   What is shut in dies with bwrap. Otherwise a process may have left the
%   group; it still has the environment that it began with. A process that has
%   just begun has no group yet, and process_wait/3 knows no time but 0.

ended(Pid, Directory, Shut) :-
    catch(process_group_kill(Pid, kill), _, true),
    catch(process_kill(Pid, kill), _, true),
    catch(process_wait(Pid, _, []), _, true),
    (   Shut == true
    ->  true
    ;   atom_concat('EV3DEV_FENCED=', Directory, Mark),
        expand_file_name('/proc/[0-9]*', Processes),
        forall(( member(Process, Processes),
                 atom_concat(Process, '/environ', File),
                 catch(read_file_to_string(File, Text, [encoding(octet)]), _,
                       fail),
                 once(sub_string(Text, _, _, _, Mark)),
                 file_base_name(Process, Name),
                 atom_number(Name, Other) ),
               catch(process_kill(Other, kill), _, true))
    ).

%   The program may have made anything of that file.

what_was_told(File, Lines) :-
    (   exists_file(File),
        \+ read_link(File, _, _),
        catch(read_file_to_string(File, Text, [encoding(utf8)]), _, fail)
    ->  split_string(Text, "\n", "", Rows),
        findall(Time-Row,
                ( member(Whole, Rows),
                  once(sub_string(Whole, Before, 1, _, "\t")),
                  sub_string(Whole, 0, Before, _, Number),
                  catch(number_string(Time, Number), _, fail),
                  sub_string(Whole, Before, _, 0, Row0),
                  split_string(Row0, "", "\t", [Row]) ),
                Lines)
    ;   Lines = []
    ).

%   The shell's limits: no file longer than 1 MB (2048 blocks of 512 bytes),
%   and no core dump. Prolog is the one that runs this. The limit of processor
%   time is for a process that lives on by itself; the kernel measures it
%   coarsely.
start(Directory, [Socket, Tells, Seed], Output, [Path|Files], Goal,
      Cpu-Memory-Shut, Pid) :-
    current_prolog_flag(executable, Prolog),
    pack_folder(Pack),
    atomic_list_concat(['library=', Pack, '/prolog'], Alias),
    atom_concat(Pack, '/prolog/ev3dev/private/batch/fenced_seed.pl', Begins),
    current_prolog_flag(version, Version),
    (   Version < 70500                 % where failing is no error
    ->  format(atom(GoalText), '(~q->true;halt(1))', [Goal])
    ;   format(atom(GoalText), '~q', [Goal])
    ),
    (   Cpu == infinite
    ->  Limit = unlimited
    ;   Limit is 10 + 2*ceiling(Cpu)
    ),
    (   Memory == unlimited
    ->  Kilobytes = unlimited
    ;   Kilobytes is 1024*Memory
    ),
    atom_concat(Directory, '/own', Own),
    (   Shut == true
    ->  enclosing(true, Extra),
        enclosure(Directory, [Path|Files], Extra, Walls),
        Begin = ['-i'],
        findall(Name=Value, ( kept_variable(Name), getenv(Name, Value) ),
                Kept),
        ( Tells == '' -> true ; close_new(Tells) )
    ;   Walls = [],
        Begin = [],
        Kept = ['EV3DEV_FENCED'=Directory]
    ),
    findall(Variable,
            ( member(Name=Value, [ 'EV3DEV_FENCE'=Socket, 'EV3DEV_TOLD'=Tells,
                                   'EV3DEV_SEED'=Seed | Kept ]),
              Value \== '',
              atomic_list_concat([Name, =, Value], Variable) ),
            Variables),
    append([ Begin, Variables, Walls,
             [ Prolog, '-q', '-f', file(Begins), '-p', Alias, '-g', GoalText,
               '-t', halt, '-s', file(Path) ] ], Command),
    process_create(
        path(sh),
        [ '-c', 'ulimit -c 0; ulimit -f 2048; ulimit -v "$2"; ulimit -t "$1"
                 output=$3; shift 3
                 exec env "$@" </dev/null >"$output" 2>&1',
          sh, Limit, Kilobytes, file(Output) | Command ],
        [ process(Pid), detached(true), cwd(Own) ]).

close_new(File) :-
    open(File, write, Stream),
    close(Stream).

%   What an enclosed program has of the environment, which may have secrets.

kept_variable('PATH').
kept_variable('LD_LIBRARY_PATH').
kept_variable('LANG').
kept_variable('LC_ALL').
kept_variable('LC_CTYPE').
kept_variable('TZ').

%!  can_enclose is semidet.
%
%   Whether sim_fenced/3 can shut a program in: bwrap is there, and Prolog
%   starts within.

can_enclose :-
    enclosing(true, _).

%   Extra are walls that not every bwrap and system has.

enclosing(Whether, Extra) :-
    (   known_enclosing(_, _)
    ->  true
    ;   member(Found, [['--unshare-user', '--disable-userns'], []]),
        starts_enclosed(Found)
    ->  assertz(known_enclosing(true, Found))
    ;   assertz(known_enclosing(false, []))
    ),
    known_enclosing(Whether, Extra).

:- dynamic known_enclosing/2.
:- volatile known_enclosing/2.

starts_enclosed(Extra) :-
    current_prolog_flag(executable, Prolog),
    pack_folder(Pack),
    setup_call_cleanup(
        fence_directory(Directory),
        ( forall(member(Name, [robot, told]),
                 ( atomic_list_concat([Directory, '/own/', Name], File),
                   close_new(File) )),
          enclosure(Directory, [Pack], Extra, [bwrap|Walls]),
          append(Walls, [Prolog, '-f', none, '-g', halt], Arguments),
          catch(process_create(path(bwrap), Arguments,
                               [stdout(null), stderr(null), process(Pid)]),
                error(_, _), fail),
          process_wait(Pid, exit(0), []) ),
        end_workplace(Directory)).

%   The arguments with which bwrap shuts in what follows. The system's
%   programs and libraries can be read, but nobody's home. What the program
%   writes is in memory, and bounded; outside it has the socket of its robot,
%   and the file for the log of its rules. bwrap leaves capabilities
%   to root, and without them root can still set what is in /proc/sys.

enclosure(Directory, Paths, Extra, Walls) :-
    atom_concat(Directory, '/own', Own),
    atom_concat(Own, '/robot', Socket),
    atom_concat(Own, '/told', Tells),
    pack_folder(Pack),
    current_prolog_flag(home, Home),
    current_prolog_flag(executable, Prolog0),
    absolute_file_name(Prolog0, Prolog),
    file_directory_name(Prolog, Programs),
    findall([Bind, Folder, Folder],
            (   member(Folder, ['/usr', '/bin', '/lib', '/lib64']),
                Bind = '--ro-bind-try'
            ;   member(Name, ['/prolog', '/lib', '/native', '/compiled']),
                atom_concat(Pack, Name, Folder),
                Bind = '--ro-bind-try'
            ;   member(Folder, [Home, Programs, Socket|Paths]),
                Bind = '--ro-bind'
            ;   Folder = Tells,
                Bind = '--bind-try'
            ),
            Binds),
    append([ [ [ bwrap, '--unshare-all', '--die-with-parent',
                 '--new-session', '--cap-drop', 'ALL' | Extra ],
               [ '--proc', '/proc', '--dev', '/dev',
                 '--size', 67108864, '--tmpfs', '/tmp',
                 '--size', 67108864, '--tmpfs', Own ] ],
             Binds,
             [ [ '--remount-ro', '/proc', '--remount-ro', '/dev',
                 '--remount-ro', '/',
                 '--chdir', Own, '--' ] ] ], Walls0),
    append(Walls0, Walls).

%   The program is looked at as often as it is silent, else five times a
%   second. The looks follow the clock, whatever the program does: one that
%   asks something between two naps is seen in them.

served(Pid, Until, Limits, Used0, Ended) :-
    slice(Slice),
    get_time(Now),
    Left is Slice - (Now - Slice*floor(Now/Slice)),
    sim_fence_serve_(Until, Left, State),
    (   over(State, Ended)
    ->  true
    ;   process_wait(Pid, Status, [timeout(0)]),
        Status \== timeout
    ->  read_to_the_end(Until),
        Ended = Status
    ;   looked(State, Pid, Slice, Used0, Used),
        (   beyond(Used, Limits, Ended0)
        ->  Ended = Ended0
        ;   ( State == ended -> sleep(0.005) ; true ),
            served(Pid, Until, Limits, Used, Ended)
        )
    ).

%   What the program had still written when it ended.

read_to_the_end(Until) :-
    slice(Slice),
    (   sim_fence_serve_(Until, Slice, waiting)
    ->  read_to_the_end(Until)
    ;   true
    ).

slice(0.02).

looked(waiting, Pid, Slice, Used0, Used) :-
    !,
    usage_age(Used0, Age),
    (   Age < 0.2
    ->  Used = Used0
    ;   usage_heard(Used0, Used1),
        usage_goes_on(Pid, Slice, fail, Used1, Used)
    ).
looked(_, Pid, Slice, Used0, Used) :-
    usage_goes_on(Pid, Slice, sim_fence_silent_, Used0, Used).

beyond(Used, limits(_, _, _, Memory), Limit) :-
    usage_crowded(Used, Memory, Limit),
    !.
beyond(Used, limits(Sleep, Cpu, From, _), Limit) :-
    sim_time(Now),
    processor_time(Cpu, From, Now, Seconds),
    usage_beyond(Used, limits(Sleep, Seconds), Limit).

over(over, over).
over(refused(Why0), refused(Why)) :-
    atom_string(Why0, Why).

