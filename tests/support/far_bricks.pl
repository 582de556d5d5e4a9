:- module(far_bricks,
          [ far_place/1,                % -Where
            with_far/2,                 % +Name, :Goal
            with_far/3,                 % +Name, +Where, :Goal
            far_program/2,              % +Rest, -Text
            can_log_in/0,
            with_login/1,               % :Goal
            far_end/1,                  % ?How
            stops_when/4                % +Through, +How, +Wait, -Late
          ]).
:- use_module(child).
:- use_module(trees).
:- use_module(library(ev3dev/bricks)).
:- use_module(library(filesex)).
:- use_module(library(lists)).
:- use_module(library(process)).
:- use_module(library(readutil)).

/** <module> Far bricks that are processes of this machine

Behind a pipe, or behind a server of OpenSSH.
*/

:- meta_predicate
    with_far(+, 0),
    with_far(+, +, 0),
    with_login(0).

:- dynamic
    library/1,
    script/1.

:- prolog_load_context(directory, Support),
   atom_concat(Home, '/tests/support', Support),
   atom_concat(Home, '/prolog', Library),
   assertz(library(Library)),
   atom_concat(Support, '/sshd.sh', Script),
   assertz(script(Script)).

%!  far_place(-Where)
%
%   Where one is behind a pipe.

far_place(command(Swipl, ['-q', '-f', none, '-g', Goal, '-t', halt])) :-
    swipl(Swipl),
    library(Library),
    format(atom(Goal), "asserta(user:file_search_path(library,~q)),\c
                        use_module(library(ev3dev/worker)),\c
                        set_prolog_flag(ev3dev_hints,off),work",
           [Library]).

%!  with_far(+Name, :Goal)
%!  with_far(+Name, +Where, :Goal)
%
%   Call Goal once while there is this far brick.

with_far(Name, Goal) :-
    far_place(Where),
    with_far(Name, Where, Goal).

with_far(Name, Where, Goal) :-
    setup_call_cleanup(
        brick_open(Name, Where),
        once(Goal),
        ( brick(Name) -> brick_close(Name) ; true )).

%!  far_program(+Rest, -Text)
%
%   The text of a program for which `anna` is a far brick with the files of the
%   tree in use, and which goes on with Rest.

far_program(Rest, Text) :-
    tree_root(Root),
    far_place(Where),
    format(string(Text),
           ":- use_module(library(ev3dev/bricks)).
            :- initialization(( brick_open(anna, ~q), far(anna, ev3_sysfs(~q)), ~s )).",
           [Where, Root, Rest]).

%!  can_log_in
%
%   True if this machine has OpenSSH, client and server.

can_log_in :-
    exists(path(ssh)),
    (   exists(path(sshd))
    ->  true
    ;   exists('/usr/sbin/sshd')
    ).

exists(Program) :-
    absolute_file_name(Program, _, [access(execute), file_errors(fail)]).

%!  with_login(:Goal)
%
%   Call Goal once while ssh can log in at the host `eva`.

with_login(Goal) :-
    script(Script),
    swipl(Swipl),
    library(Library),
    getenv('PATH', Path),
    tmp_file(login, Folder),
    make_directory_path(Folder),
    format(atom(Path1), "~w/bin:~w", [Folder, Path]),
    setup_call_cleanup(
        process_create(Script, [Folder, Swipl, Library],
                       [stdin(pipe(In)), stdout(pipe(Out)), process(Server)]),
        setup_call_cleanup(
            ( read(Out, Listens), integer(Listens), setenv('PATH', Path1) ),
            once(Goal),
            setenv('PATH', Path)),
        ( close(In), close(Out), process_wait(Server, _),
          delete_directory_and_contents(Folder) )).

%!  far_end(?How)
%
%   The worker is killed, or stopped by SIGSTOP; the connection is cut; it is silent; the program is
%   killed.

far_end(killed).
far_end(stopped).
far_end(cut).
far_end(silent).
far_end(program_killed).

%!  stops_when(+Through, +How, +Wait, -Late)
%
%   A motor of a far brick at outB runs, and after Wait seconds it ends as How
%   says. Late is how many seconds later the motor has been stopped. What it
%   goes Through is `pipe` or `ssh`.

stops_when(pipe, program_killed, Wait, Late) :-
    !,
    far_program("far(anna, ( motor_run(outB, 50), sleep(60) ))", Text),
    start_program(Text, [], Child),
    eventually(get_attribute(outB, command, 'run-forever')),
    sleep(Wait),
    late(kill_program(Child), Late).
stops_when(Through, How, Wait, Late) :-
    through(Through, Where, FindRelay, Relay),
    tree_root(Root),
    setup_call_cleanup(
        brick_open(anna, Where),
        ( far(anna, ( ev3_sysfs(Root), current_prolog_flag(pid, Worker) )),
          call(FindRelay),
          meanwhile(catch(far(anna, ( motor_run(outB, 50), sleep(60) )), _, true),
                    ( eventually(get_attribute(outB, command, 'run-forever')),
                      sleep(Wait),
                      late(hurt(How, Worker, Relay), Late) )) ),
        ( hurt(cut, _, Relay), brick_close(anna) )).

late(End, Late) :-
    get_time(Before),
    call(End),
    eventually(get_attribute(outB, command, stop)),
    get_time(After),
    Late is After-Before.

hurt(killed, Worker, _) :-
    process_kill(Worker, kill).
hurt(stopped, Worker, _) :-
    process_kill(Worker, stop).
hurt(cut, _, Relay) :-
    catch(process_kill(Relay, kill), error(_, _), true).
hurt(silent, _, Relay) :-
    process_kill(Relay, stop).

%   The process Relay is between the program and the worker. That of the pipe
%   does not end when it is stopped.

through(ssh, ssh(eva), ev3dev_far:process(_, Relay, _), Relay).
through(pipe, command(bash, ['-c', Command, File, Swipl|Arguments]),
        far_bricks:read_file_to_terms(File, [Relay], []), Relay) :-
    Command = 'exec "$@" < <(echo "$BASHPID." > $0; exec cat 2>/dev/null)',
    tmp_file(relay, File),
    far_place(command(Swipl, Arguments)).
