:- module(ev3dev_thinking_rate,
          [ thinking_rate/2             % +Options, -Inferences
          ]).
:- use_module('../checks/arguments', [option/3]).
:- use_module('../checks/checks', [must_be/2]).
:- use_module('../errors/errors', [throw_error/3]).

/** <module> What it costs to compute

The brick's figure is from docs/performance.md.
*/

%!  thinking_rate(+Options, -Inferences) is det.
%
%   By thinking(T) in Options that many inferences take a second; 0 is free.
%
%   @error domain_error(thinking, T)

thinking_rate(Options, Inferences) :-
    option(thinking(Thinking), Options, free),
    must_be(nonvar, Thinking),
    (   rate(Thinking, Inferences)
    ->  true
    ;   throw_error(domain_error(thinking, Thinking), _,
                    'thinking is free, brick, or a whole number of \c
                     inferences per second')
    ).

rate(free, 0).
rate(brick, 100000).
rate(Inferences, Inferences) :-
    integer(Inferences),
    Inferences > 0.
