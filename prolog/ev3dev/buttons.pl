:- module(ev3dev_buttons,
          [ button/1,                   % ?Key
            button_wait/2,              % ?Key, ?Event
            button_wait/3,              % ?Key, ?Event, +Options
            button_events/1             % -Events
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(private/checks/checks, [must_be/2]).
:- use_module(private/errors/errors, [domain_error/2]).
:- use_module(private/errors/public_clauses, [term_expansion/4]).
:- use_module(files, []).
:- use_module(private/checks/arguments,
              [must_be_options/3, timeout_option/2, word/2]).
:- use_module(private/basics/small_lists).
:- use_module(private/run/waits, [waited/1]).
:- use_module(private/native/native,
              [ button_event_/5, button_source_/1, button_wait_/4,
                buttons_/1 ]).

/** <module> The buttons of the brick

A Key is one of `up`, `down`, `left`, `right`, `enter` (in the middle) and
`back`. If a program was started from the brick's menu, `back` always ends it.

All predicates fail if the machine has no buttons.

```
?- button_wait(Key, pressed).
Key = left.
```
*/

%!  button(?Key) is nondet.
%
%   True if the button Key is pressed now. An unbound Key enumerates the
%   pressed buttons.
%
%   @error domain_error(button, Key)

button(Key) :-
    var(Key),
    !,
    buttons_(Keys),
    one_of(Keys, Key).
button(Key0) :-
    word(Key0, Key),
    (   memberchk(Key, [up, down, left, right, enter, back])
    ->  true
    ;   domain_error(button, Key)
    ),
    buttons_(Keys),
    memberchk(Key, Keys).

%!  button_wait(?Key, ?Event) is semidet.
%!  button_wait(?Key, ?Event, +Options) is semidet.
%
%   Wait until somebody presses or releases a button: Event is `pressed` or
%   `released`. An unbound Key stands for any button, an unbound Event for
%   either event. Events before the call do not count. button_events/1 misses
%   no event. Options:
%
%     - timeout(+Seconds)
%       Fail after that time. Default is `infinite`.
%
%   @error domain_error(button, Key)
%   @error domain_error(button_event, Event)
%   @error domain_error(button_option, Option) if Option is not an option of
%          this predicate
%   @error domain_error(timeout, Seconds)

button_wait(Key, Event) :-
    button_waited(Key, Event, infinite).

button_wait(Key, Event, Options) :-
    must_be_options(button_option, [timeout], Options),
    timeout_option(Options, Timeout),
    button_waited(Key, Event, Timeout).

button_waited(Key, Event, Timeout) :-
    button_wait_(Key, Event, Timeout, Reason),
    waited(Reason),
    !.

%!  button_events(-Events) is semidet.
%
%   True if Events is the endless list of button events from now on. Each
%   element is a pair Key-Event as in button_wait/2. Does not wait: reading an
%   element of the list waits until that event happens. The list misses no
%   event while it is reachable. Reading an element again, also after
%   backtracking, finds the same event.
%
%   ```
%   ?- button_events(Events), member(Key-released, Events).
%   Key = up ;
%   Key = down .
%   ```

button_events(Events) :-
    button_source_(Source),
    events(Source, 0, Events).

events(Source, Index, Events) :-
    freeze(Events, events_are(Events, Source, Index)).

%   freeze/2 calls this when Events is bound.

events_are([Key-Event|Rest], Source, Index) :-
    button_event_(Source, Index, Key0, Event0, Reason),
    waited(Reason),
    !,
    Key = Key0,
    Event = Event0,
    Next is Index + 1,
    events(Source, Next, Rest).
