:- module(ev3dev_far,
          [ far_open/3,                 % +Name, +Where, -Far
            far_close/1,                % +Far
            is_lost/1,                  % +Far
            far_stop/1,                 % +Far
            far_call/2,                 % +Far, +Goal
            far_file/2                  % +Far, +File
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors',
              [error_within/3, in_own_name/1, throw_error/3]).
:- use_module(far_frames,
              [ beat/1, protocol/1, receive_frames/2, send_frame/4 ]).
:- use_module('../native/native', [far_guard_/1]).
:- use_module('../run/waits', [let_others_go_on/0]).
:- use_module('../run/watchdog', []).
:- use_module(library(process),
              [ process_create/3, process_group_kill/2, process_kill/2,
                process_wait/3 ]).
:- use_module(library(readutil), [read_file_to_string/3]).

/** <module> A brick on another machine

Its process here is ssh, or another command, which starts
library(ev3dev/worker) there. far_frames.pl has the protocol. Two threads here
belong to it: one that receives, and one that says that this program lives.
Authentication and encryption are those of ssh.
*/

:- dynamic
    far/3,                      % Far, Name, In
    process/3,                  % Far, Process, whether it has a group
    user/2,                     % Far, Thread
    thread/2,                   % Far, Thread
    waiting/3,                  % Far, Number of a call, Queue
    lost/1.                     % Far
:- volatile
    far/3,
    process/3,
    user/2,
    thread/2,
    waiting/3,
    lost/1.

%!  far_open(+Name, +Where, -Far) is det.
%
%   Start the process of a far brick, and wait until it speaks: at most a
%   minute, as an EV3 loads Prolog and the pack, and a person may have to type
%   a password.

far_open(Name, Where, Far) :-
    process_of(Where, Program, Arguments, Group),
    flag(ev3dev_far, Far, Far+1),
    in_own_name(process_create(Program, Arguments,
                               [ stdin(pipe(In)), stdout(pipe(Out)),
                                 process(Process), detached(Group) ])),
    set_stream(In, encoding(utf8)),
    set_stream(Out, encoding(utf8)),
    set_stream(Out, timeout(60)),
    assertz(far(Far, Name, In)),
    assertz(process(Far, Process, Group)),
    catch(greeted(Far, Name, In, Out), Error, true),
    (   var(Error)
    ->  true
    ;   far_close(Far),
        throw(Error)
    ).

%   On the brick a shell waits for the end of the connection, too: a worker
%   that hangs, as after SIGSTOP, does not see it. The shell kills it a second
%   later, which stops its motors. The worker reads what comes by fd 3.
%
%   A process of this machine has a group of its own, so that Ctrl-C does not
%   reach it. ssh must be able to ask for a password at the terminal; a signal
%   that is ignored when it starts stays so.

process_of(ssh(Destination), path(sh),
           [ '-c', 'trap "" INT; exec "$@"', sh, ssh, '-T', Destination,
             'exec sh -c ''exec 3<&0; \c
              swipl -q -g "use_module(library(ev3dev/worker)),work" \c
                  -t halt <&3 3<&- & w=$!; \c
              { while [ -d /proc/$PPID ] && [ -d /proc/$w ]; \c
                do sleep 1; done; \c
                [ -d /proc/$w ] && sleep 1 && kill -KILL $w; \c
              } </dev/null >/dev/null 2>&1 3<&- & \c
              wait $w'''
           ], false) :-
    must_be(text, Destination),
    (   sub_string(Destination, 0, 1, _, "-")
    ->  throw_error(domain_error(ssh_destination, Destination), _,
                    'a destination is Host or User@Host')
    ;   true
    ).
process_of(command(Program, Arguments), Where, Arguments, true) :-
    must_be(list, Arguments),
    (   atom(Program),
        \+ sub_atom(Program, _, _, _, /)
    ->  Where = path(Program)
    ;   Where = Program
    ).

greeted(Far, Name, In, Out) :-
    protocol(Version),
    answer(Far, 0, ev3dev_far:start_threads(Far, Name, In, Out), Theirs),
    (   Theirs == lost
    ->  throw_error(existence_error(connection, Name), _,
                    'its process has ended, or did not begin to speak')
    ;   Theirs == Version
    ->  send_frame(In, hello, 0, Version)
    ;   throw_error(permission_error(open, brick, Name), _,
                    'it has another version of this pack')
    ).

start_threads(Far, Name, In, Out) :-
    thread_create(receive(Far, Name, Out), Receiver, []),
    assertz(thread(Far, Receiver)),
    thread_create(beat(In), Beat, []),
    assertz(thread(Far, Beat)).

%!  far_close(+Far) is det.
%
%   Its motors stop, and its process ends.

far_close(Far) :-
    retract(far(Far, _, In)),
    catch(send_frame(In, end, 0, []), error(_, _), true),
    forall(thread(Far, Thread),
           catch(thread_send_message(Thread, over), error(_, _), true)),
    end_process(Far, 200),
    catch(close(In, [force(true)]), error(_, _), true),
    forall(retract(thread(Far, Thread)), thread_join(Thread, _)),
    retractall(lost(Far)),
    retractall(user(Far, _)).

%   It has some hundredths of a second to end by itself. What it has started
%   may live, and hold its output.

end_process(Far, Hundredths) :-
    (   retract(process(Far, Process, Group))
    ->  ended(Process, Hundredths, Status),
        (   Group == true
        ->  catch(process_group_kill(Process, kill), error(_, _), true)
        ;   Status == timeout
        ->  catch(process_kill(Process, kill), error(_, _), true)
        ;   true
        ),
        (   Status == timeout
        ->  ended(Process, 200, _)
        ;   true
        )
    ;   true
    ).

%   In 9.0.4 a timeout of process_wait/3 other than 0 may wait forever.

ended(Process, Hundredths, Status) :-
    catch(process_wait(Process, Status0, [timeout(0)]), error(_, _), true),
    (   Status0 == timeout,
        Hundredths > 0
    ->  sleep(0.01),
        Rest is Hundredths-1,
        ended(Process, Rest, Status)
    ;   Status = Status0
    ).

%   Else the program would wait for their threads.
:- initialization(at_halt(ev3dev_far:close_all), now).
:- public close_all/0.

close_all :-
    forall(far(Far, _, _), far_close(Far)).

% ---------------- RECEIVER

receive(Far, Name, Out) :-
    call_cleanup(receive_frames(Out, ev3dev_far:hear(Far, Name, Out)),
                 over(Far, Out)).

over(Far, Out) :-
    assertz(lost(Far)),
    forall(waiting(Far, _, Queue), give(Queue, lost)),
    % A writer must not wait for it forever.
    end_process(Far, 20),
    close(Out, [force(true)]).

hear(Far, _, Out, hello, _, Version) :-
    !,
    set_stream(Out, timeout(2)),
    given(Far, 0, Version).
hear(Far, _, _, answer, Number, Answer) :-
    !,
    given(Far, Number, Answer).
hear(_, Name, _, output, _, Text) :-
    !,
    string_codes(Text, Codes0),
    harmless(Codes0, Codes),
    format(user_output, '~w: ~s~n', [Name, Codes]),
    flush_output(user_output).
hear(_Far, _Name, _Out, _, _Number, _Version).

%   A terminal takes the others as orders.

harmless([], []).
harmless([Code0|Codes0], [Code|Codes]) :-
    (   ( Code0 >= 0' , \+ between(127, 159, Code0) ; Code0 =:= 0'\t )
    ->  Code = Code0
    ;   Code = 0'?
    ),
    harmless(Codes0, Codes).

%   What nobody waits for any more is dropped.

given(Far, Number, Answer) :-
    (   waiting(Far, Number, Queue)
    ->  give(Queue, Answer)
    ;   true
    ).

give(Queue, Answer) :-
    catch(thread_send_message(Queue, answer(Answer)), error(_, _), true).

% ---------------- CALLS

%!  is_lost(+Far) is semidet.
%
%   True if its process has ended, or was silent for two seconds.

is_lost(Far) :-
    lost(Far).

%!  far_stop(+Far) is det.
%
%   Stop all its motors, whatever it does.

far_stop(Far) :-
    far(Far, _, In),
    catch(send_frame(In, stop, 0, []), error(_, _), true).

%!  far_call(+Far, +Goal) is semidet.
%
%   Call Goal once there. Its solution, failure or error is that of this
%   predicate.

far_call(Far, Goal) :-
    term_variables(Goal, Variables),
    copy_term_nat(goal(Variables, Goal), Request),
    asked(Far, call, Request, Solution),
    Variables = Solution.

%!  far_file(+Far, +File) is det.
%
%   Load a copy of this program file there.

far_file(Far, File) :-
    in_own_name(absolute_file_name(File, Path,
                                   [file_type(prolog), access(read)])),
    read_file_to_string(Path, Text, [encoding(utf8)]),
    asked(Far, load, file(Path, Text), _).

asked(Far, Kind, Request, Solution) :-
    far(Far, Name, _),
    answer_to(Far, Kind, Request, Answer),
    far_guard_(Me),
    (   user(Far, Me)
    ->  true
    ;   assertz(user(Far, Me))
    ),
    (   Answer = yes(Solution0)
    ->  Solution = Solution0
    ;   Answer = error(Error0)
    ->  format(atom(Where), 'on the brick ~w', [Name]),
        (   ends_program(Error0)
        ->  throw_error(system_error(aborted), _, Where)
        ;   error_within(Error0, Where, Error)
        ->  throw(Error)
        ;   throw(Error0)
        )
    ;   Answer == lost
    ->  no_connection(Name)
    ;   Answer == unreadable
    ->  throw_error(type_error(sendable, answer), _,
                    'its answer has something in it that cannot be sent, \c
                     as a stream')
    ;   fail
    ).

%   It ended the goal there, and is no order for this program.

ends_program(Error) :-
    nonvar(Error),
    (   Error == '$aborted'
    ;   Error = unwind(_)
    ),
    !.

answer_to(Far, Kind, Request, Answer) :-
    flag(ev3dev_far_call, Number0, Number0+1),
    Number is Number0+1,
    answer(Far, Number, ev3dev_far:ask(Far, Kind, Number, Request), Answer).

:- multifile ev3dev_watchdog:far_stopped/2.

ev3dev_watchdog:far_stopped(Thread, Ports) :-
    user(Far, Thread),
    catch(answer_to(Far, idle, [], yes(Ports)), error(_, _), fail).

ask(Far, Kind, Number, Request) :-
    far(Far, Name, In),
    catch(send_frame(In, Kind, Number, Request),
          error(io_error(_, In), _),
          no_connection(Name)).

no_connection(Name) :-
    throw_error(existence_error(connection, Name), _,
                'the brick does not answer any more; brick_open/2 opens it \c
                 again').

%   Answer is what the brick says to the call of this Number, or `lost`. If
%   this is left before, the call there ends, and all motors there stop.

answer(Far, Number, Ask, Answer) :-
    setup_call_cleanup(
        message_queue_create(Queue),
        setup_call_catcher_cleanup(
            assertz(waiting(Far, Number, Queue)),
            ( call(Ask),
              (   lost(Far)
              ->  Answer = lost
              ;   until(Number, Until),
                  await(Queue, Until, Answer)
              ) ),
            How,
            ( retractall(waiting(Far, Number, Queue)),
              left(How, Far, Number) )),
        message_queue_destroy(Queue)).

left(exit, _, _) :-
    !.
left(_, Far, Number) :-
    far(Far, _, In),
    catch(send_frame(In, cancel, Number, []), error(_, _), true).

%   A greeting comes within a minute, whatever else the process says.

until(Number, Until) :-
    (   Number =:= 0
    ->  get_time(Now),
        Until is Now+60
    ;   Until = never
    ).

%   Meanwhile this thread serves its events, and other branches go on.

await(Queue, Until, Answer) :-
    (   thread_get_message(Queue, answer(Answer0), [timeout(0.02)])
    ->  Answer = Answer0
    ;   number(Until),
        get_time(Now),
        Now > Until
    ->  Answer = lost
    ;   let_others_go_on,
        await(Queue, Until, Answer)
    ).
