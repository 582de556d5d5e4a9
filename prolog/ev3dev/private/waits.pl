:- module(ev3dev_waits,
          [ waited/1                    % +Reason
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(native, []).

/** <module> Waits, and what happens meanwhile

A native wait returns `pause` or `tick` after each slice of time, with a choice
point, and at its end its reason. So a caller writes

```
    wait_(Seconds, Reason),
    waited(Reason),
    !
```

Between two slices Prolog handles its signals. An exception that leaves the
wait ends it: a move stops its motors.
*/

%!  waited(+Reason) is semidet.
%
%   True if a wait is over. Fails back into it if not, once the events of this
%   thread that are due have been served.

waited(Reason) :-
    (   Reason == pause
    ->  fail
    ;   Reason == tick
    ->  serve,
        fail
    ;   true
    ).

:- multifile
    served/0.

%   Succeeds, or throws what ends the wait.
serve :-
    due_goals,
    forall(served, true).

due_goals :-
    (   current_predicate(ev3dev_sim_time:run_due_goals/0)
    ->  ev3dev_sim_time:run_due_goals
    ;   true
    ).
