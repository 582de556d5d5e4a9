:- module(ev3dev_reasoning_events,
          [ events/1                    % -Events
          ]).
:- set_prolog_flag(generate_debug_info, false).
:- use_module(recorder, [event/5]).

/** <module> What was recorded, in a normal form

The events of the recorder, complete: a goal that an exception has left has
its own event. They are nested: each call or redo ends before that of its
parent does, unless the recording ends earlier.
*/

%!  events(-Events) is det.
%
%   Events is the list of terms e(Port, Node, Data, Moment), in order:
%
%     - call: Data is Parent-Goal
%     - unify: Data is the key of a clause
%     - exit, more: Data is the goal; after `more` it can be tried again
%     - redo, fail: Data is []
%     - exception: Data is ball(Ball), or `none` if that is not known
%     - caught: Data is the ball that Node has caught
%     - cut: Node drops the choice points since the event Data
%     - deep: what Node calls is not recorded
%
%   An attempt to find one more answer that found nothing at once is left out:
%   whether Prolog makes it depends on its indexes.

events(Events) :-
    findall(event(Number, Port, Of, Data, Moment),
            event(Number, Port, Of, Data, Moment),
            Recorded),
    completed(Recorded, [], [], Reversed),
    reversed(Reversed, [], Events).

%   completed(+Recorded, +Open, +Events0, -Events): Open are the nodes that
%   run, the innermost first. Events are in reverse order.

completed([], _, Events, Events).
completed([event(Number, Port, Of, Data, Moment)|Recorded], Open0, Events0,
          Events) :-
    (   Port == call
    ->  Node = Number,
        Inner = Of,
        Open = [Number|Open1],
        Data1 = Of-Data
    ;   Node = Of,
        Data1 = Data,
        (   Port == redo
        ->  Open = [Node|Open1],
            (   event(Node, call, Inner, _, _)
            ->  true
            ;   Open0 = [Inner|_]       % its call has been forgotten
            ->  true
            ;   Inner = 0
            )
        ;   Inner = Node,
            (   memberchk(Port, [exit, more, fail])
            ->  Open1 = [_|Open]
            ;   Open = Open1
            )
        )
    ),
    (   Port == caught
    ->  Left = ball(Data)
    ;   Left = none
    ),
    left(Open0, Inner, Left, Moment, Open1, Events0, Events1),
    (   Port == fail,
        Events1 = [e(redo, Node, _, _)|Events2]
    ->  true
    ;   Events2 = [e(Port, Node, Data1, Moment)|Events1]
    ),
    completed(Recorded, Open, Events2, Events).

%   Only an exception leaves a node that runs.

left(Open0, Inner, Left, Moment, Open, Events0, Events) :-
    (   Inner =\= 0,
        \+ memberchk(Inner, Open0)
    ->  Open = [Inner|Open0],
        Events = Events0
    ;   left_(Open0, Inner, Left, Moment, Open, Events0, Events)
    ).

left_([Node|Open0], Inner, Left, Moment, Open, Events0, Events) :-
    Node =\= Inner,
    !,
    left_(Open0, Inner, Left, Moment, Open,
          [e(exception, Node, Left, Moment)|Events0], Events).
left_(Open, _, _, _, Open, Events, Events).

reversed([], Events, Events).
reversed([Event|Events0], Events1, Events) :-
    reversed(Events0, [Event|Events1], Events).
