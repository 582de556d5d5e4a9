:- module(ev3dev_halt, []).
:- use_module('../native/native',
              [ at_halt_/1, halt_canceled_/0, halts_by_/1, stop_started_/0,
                told_to_end_/0
              ]).

:- set_prolog_flag(generate_debug_info, false).

:- initialization(
       ( create_prolog_flag(ev3dev_stop_at_halt, true,
                            [keep(true), type(boolean)]),
         create_prolog_flag(ev3dev_stop_at_kill, true,
                            [keep(true), type(boolean)]) ),
       now).

/** <module> Stops the motors when the program ends

The kernel keeps a motor running after its program has ended. So when Prolog
halts, or SIGINT, SIGTERM or SIGHUP ends it, this module stops every motor, of
any class, that the program started, unless the flag `ev3dev_stop_at_halt` is
`false`. It lets servos float. From then on no motor starts: a thread that
tries to is aborted.

If Prolog does not end within two seconds of such a signal, the process is
ended without its at_halt/1 goals. Whatever the flag says, the motors stop at
any other signal that ends the process, and at one that suspends it, such as
Ctrl-Z. If the process is killed, another one stops its motors. That one
begins with the first motor that runs, unless the flag `ev3dev_stop_at_kill`
is then `false`. `docs/safety.md` has the details.
*/

stop_at_halt :-
    current_prolog_flag(ev3dev_stop_at_halt, Stops),
    at_halt_(Stops),
    (   Stops == true
    ->  stop_started_
    ;   true
    ).

:- multifile prolog:message//1.

:- dynamic halt_canceled/0.

%   Prolog has forgotten the goals that it has called.
prolog:message(cancel_halt(_)) -->
    { ( halt_canceled -> true ; assertz(halt_canceled) ),
      halt_canceled_,
      at_halt(stop_at_halt),
      fail
    }.

%   The foreign library calls this before the first motor runs. True if the
%   motors stop when the process is killed. What at_halt/1 has got last comes
%   first: the toplevel's goal waits while another thread reads what is typed.
%   Another thread may be about to halt already.
:- '$hide'(before_motors/0).

before_motors :-
    at_halt(stop_at_halt),
    (   current_prolog_flag(exit_status, _),
        \+ halt_canceled
    ->  stop_at_halt
    ;   true
    ),
    \+ current_prolog_flag(ev3dev_stop_at_kill, false).

% SIGTERM, and SIGINT without a debugger, end Prolog at once and without its
% at_halt/1 goals. This does not replace handlers of the program.
halt_on(Signal, Terminal) :-
    handler(Signal, Handler),
    (   ends_at_once(Signal, Handler, Terminal)
    ->  ours(Ours),
        on_signal(Signal, _:_, Ours)
    ;   true
    ).

% Of any module: with a plain variable, on_signal/3 fails before 8.1.20 if the
% handler belongs to another one.
handler(Signal, Handler) :-
    on_signal(Signal, Module:Name, Module:Name),
    (   var(Module)
    ->  Handler = Name
    ;   Handler = Module:Name
    ).

% Before version 9 SIGINT starts the debugger even if there is no terminal.
% Version 7.2.3 shows the debugger's handler as a C function. It reads the end
% of its input then and halts as it should, so this leaves that handler.
ends_at_once(_, default, _).
ends_at_once(int, debug, false).
ends_at_once(term, '$foreign_function'(_), _).

% In the tracer, too, where each call asks at the terminal
:- '$hide'(halt_by/1).

halt_by(Signal) :-
    halts_by_(Signal),
    status(Signal, Status),
    halt(Status).

% There a program's on_signal(term, _, Goal_1) would fail, too. So the handler
% is in the module of programs.
:- if((current_prolog_flag(version, Version), Version < 80120)).

:- multifile user:ev3dev_halt_by/1.

:- '$hide'(user:ev3dev_halt_by/1).

user:ev3dev_halt_by(Signal) :-
    ev3dev_halt:halt_by(Signal).

ours(user:ev3dev_halt_by).

:- else.

ours(ev3dev_halt:halt_by).

:- endif.

%   True if Signal ends this program, whose motors are stopped before.
%   Terminal is whether somebody can type there. The native library asks in a
%   thread of its own: Prolog handles no signal while it loads a file, as in
%   main/0 of `:- initialization(main).`, nor in shell/1. This takes no lock
%   that a thread may hold that reads from a stream.
told_to_end(Signal, Terminal) :-
    (   Signal == int
    ->  % The toplevel has set its own since.
        halt_on(int, Terminal)
    ;   true
    ),
    handler(Signal, Handler),
    ends(Signal, Handler, Terminal),
    (   current_prolog_flag(ev3dev_stop_at_halt, true)
    ->  told_to_end_,
        stop_started_
    ;   true
    ).

%   At a terminal SIGINT opens the debugger in all versions, see above.
ends(_, Handler, _) :-
    ours(Handler).
ends(Signal, '$foreign_function'(_), Terminal) :-
    \+ ( Signal == int,
         Terminal == true ).

status(int, 130).
status(term, 143).

halt_on_signals :-
    (   stream_property(user_input, tty(true))
    ->  Terminal = true
    ;   Terminal = false
    ),
    halt_on(term, Terminal),
    halt_on(int, Terminal).

:- initialization(halt_on_signals, now).

% The thread that collects garbage sometimes receives such a signal, and then
% the signal is lost. A brick has one core and does not need that thread.
without_gc_thread :-
    (   current_prolog_flag(gc_thread, true)
    ->  set_prolog_flag(gc_thread, false)
    ;   true
    ).

:- initialization(without_gc_thread, now).
