:- module(ev3dev_halt, []).
:- use_module(native, [stop_started_/0]).

:- initialization(
       create_prolog_flag(ev3dev_stop_at_halt, true,
                          [keep(true), type(boolean)]),
       now).

/** <module> Nothing moves when the program has ended

The kernel goes on running a motor whose program is over. So every motor, of
any class, that the program has started is stopped when Prolog halts, or is
ended by SIGINT, SIGTERM or SIGHUP, unless the flag `ev3dev_stop_at_halt` is
`false`. A servo floats then.
*/

:- initialization(at_halt(stop_at_halt), now).

stop_at_halt :-
    (   current_prolog_flag(ev3dev_stop_at_halt, true)
    ->  stop_started_
    ;   true
    ).

% SIGTERM, and SIGINT where nobody debugs, end Prolog at once and without its
% at_halt/1 goals. Handlers of the program's own are left alone.
halt_on(Signal) :-
    on_signal(Signal, Handler, Handler),
    (   ends_at_once(Signal, Handler)
    ->  on_signal(Signal, _, halt_by)
    ;   true
    ).

% Before version 9 SIGINT is for the debugger even where nobody is there to
% answer it. Version 7.2.3 shows the debugger's handler as a C function, is at
% its end of input then, and halts as it should: leave it.
ends_at_once(_, default).
ends_at_once(int, debug) :-
    \+ stream_property(user_input, tty(true)).
ends_at_once(term, '$foreign_function'(_)).

halt_by(Signal) :-
    status(Signal, Status),
    halt(Status).

status(int, 130).
status(term, 143).

:- initialization(( halt_on(term), halt_on(int) ), now).

% The thread that collects garbage takes such a signal now and then, and then
% nothing comes of it. A brick has one core, and no use for that thread.
without_gc_thread :-
    (   current_prolog_flag(gc_thread, true)
    ->  set_prolog_flag(gc_thread, false)
    ;   true
    ).

:- initialization(without_gc_thread, now).
