:- module(ev3dev_turn_order,
          [ about/1                     % -Text
          ]).

/** <module> The order of threads on the virtual clock

On the virtual clock threads that come at the same moment have their turns in
the order of what they are about to do. The threads of concurrent/3 take their
goals in any order, so their names and ages say nothing.
*/

%!  about(-Text) is det.
%
%   The goals that this thread is in, from the native predicate that asks
%   outward; "" where Prolog cannot write them: a cyclic term, or in the
%   threads of 9.2.9 a large integer, as the state of a generator is.

about(Text) :-
    prolog_current_frame(Frame),
    goals(Frame, 20, Goals),
    (   acyclic_term(Goals),
        copy_term(Goals, Copy, _),
        numbervars(Copy, 0, _),
        catch(format(string(Text0), "~W",
                     [ Copy,
                       [quoted(true), numbervars(true), max_depth(50)] ]),
              error(resource_error(_), _), fail)
    ->  Text = Text0
    ;   Text = ""
    ).

goals(Frame, Left, Goals) :-
    (   Left > 0,
        prolog_frame_attribute(Frame, parent, Parent)
    ->  prolog_frame_attribute(Parent, goal, Goal),
        Goals = [Goal|Outer],
        Left1 is Left - 1,
        goals(Parent, Left1, Outer)
    ;   Goals = []
    ).
