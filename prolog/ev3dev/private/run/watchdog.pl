:- module(ev3dev_watchdog, []).
:- use_module('../basics/small_lists',
              [and_list/2, append_lists/3, one_of/2]).
:- use_module('../errors/frames', [program/1]).

:- initialization(
       create_prolog_flag(ev3dev_watchdog, 3.0, [keep(true), type(float)]),
       now).

/** <module> A program computes, and its motors run on

The foreign library looks at the processor time of each thread that has
started a motor. When a thread has computed for as many seconds as the flag
`ev3dev_watchdog` says, and has not used the robot, waited or read from a
terminal meanwhile, its motors stop. So a program that searches or loops does
not drive the robot off the table. `docs/safety.md` has the details.
*/

%!  computes(+Thread, +Seconds, +Ports) is det.
%
%   Thread has computed for so long, and its motors at Ports were stopped. The
%   foreign library calls it in a thread that must not wait.

:- public computes/3.

computes(Thread, Seconds, Ports) :-
    thread_create(ev3dev_watchdog:stopped(Thread, Seconds, Ports), _,
                  [detached(true)]).

:- public stopped/3.

stopped(Thread, Seconds, Near) :-
    findall(Port,
            ( far_stopped(Thread, Ports), one_of(Ports, Port) ),
            Far),
    append_lists(Near, Far, Ports),
    (   Ports == []
    ->  true
    ;   setup_call_cleanup(
            message_queue_create(Queue),
            say(Thread, Queue, Ports, Seconds),
            message_queue_destroy(Queue))
    ).

%   The thread says itself where it is, between two of its goals. One that
%   cannot, as it sorts a long list or loads a file, is not waited for.

say(Thread, Queue, Ports, Seconds) :-
    (   catch(thread_signal(Thread,
                            ev3dev_watchdog:said(Queue, Ports, Seconds)),
              error(_, _), fail),
        thread_get_message(Queue, said, [timeout(1)])
    ->  true
    ;   print_message(warning, ev3dev(computed(Ports, Seconds, none)))
    ).

:- public said/3.

said(Queue, Ports, Seconds) :-
    (   catch(thread_send_message(Queue, said), error(_, _), fail)
    ->  here(Place),
        print_message(warning, ev3dev(computed(Ports, Seconds, Place)))
    ;   true
    ).

%!  far_stopped(+Thread, -Ports) is nondet.
%
%   Motors of a far brick at Ports, which turned as Thread wanted, were
%   stopped. private/bricks/far.pl adds a clause.

:- multifile far_stopped/2.

%!  thought(+Seconds, +Degrees, +Limit, +Ports) is det.
%
%   On a virtual clock on which thinking takes time, this thread has thought
%   for so long. A motor has turned by Degrees meanwhile, or after Limit
%   seconds the motors at Ports were stopped.

:- public thought/4.

thought(Seconds, Degrees, Limit, Ports) :-
    here(Place),
    forall(( rolled(Degrees, Cm), heard_thought(Seconds, Cm, Place) ), true),
    (   Ports == []
    ->  true
    ;   print_message(warning, ev3dev(computed(Ports, Limit, Place)))
    ).

%!  rolled(+Degrees, -Cm) is semidet.
%
%   A wheel that turns by Degrees rolls that far. The module that knows the
%   robot adds a clause.

:- multifile rolled/2.

%!  heard_thought(+Seconds, +Cm, +Place) is det.
%
%   `swipl ev3dev try` adds a clause. Place is at(Predicate, File, Line), or
%   `none`.

:- multifile heard_thought/3.

here(Place) :-
    prolog_current_frame(Frame),
    (   place(Frame, 1000, Place0)
    ->  Place = Place0
    ;   Place = none
    ).

%   The innermost clause of the program.

place(Frame, Left, Place) :-
    (   prolog_frame_attribute(Frame, clause, Clause),
        clause_property(Clause, file(Path)),
        program(Path)
    ->  clause_property(Clause, predicate(_:Predicate)),
        clause_property(Clause, line_count(Line)),
        file_base_name(Path, File),
        Place = at(Predicate, File, Line)
    ;   Left > 0,
        prolog_frame_attribute(Frame, parent, Parent),
        Left1 is Left-1,
        place(Parent, Left1, Place)
    ).

:- multifile prolog:message//1.

prolog:message(ev3dev(computed(Ports, Seconds, Place))) -->
    { and_list(Ports, Names),
      ( Ports = [_] -> Verb = was ; Verb = were )
    },
    [ '~w ~w stopped. The program computed for ~g s'-[Names, Verb, Seconds] ],
    at(Place),
    [ ', and nobody steered the robot meanwhile.'-[], nl,
      'Stop the robot before a long search, or call wait/1 in between.'-[] ].

at(none) -->
    [].
at(at(Predicate, File, Line)) -->
    [ ' in ~w (~w:~d)'-[Predicate, File, Line] ].
