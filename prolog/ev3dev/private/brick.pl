:- module(ev3dev_brick,
          [ brick/1,                    % -Brick
            new_brick/1,                % -Brick
            end_brick/1                 % +Brick
          ]).

/** <module> The brick in use

What is known of a robot belongs to its brick, which is the first argument of
such facts. So what one brick knows is nothing to another one.
*/

:- dynamic in_use/1.                    % Brick, the newest first

in_use(local).

%!  brick(-Brick) is det.
%
%   True if Brick is the one that predicates are about: `local`, or the number
%   of one that a test has for itself.

brick(Brick) :-
    in_use(Brick),
    !.

%!  new_brick(-Brick) is det.
%!  end_brick(+Brick) is det.
%
%   Use a brick of which nothing is known; end it, and use the one before
%   again. What was known of it is forgotten.

new_brick(Brick) :-
    flag(ev3dev_brick, Brick, Brick + 1),
    asserta(in_use(Brick)).

end_brick(Brick) :-
    retractall(in_use(Brick)),
    forall(forget(Brick), true).

%!  forget(+Brick) is det.
%
%   Each module that knows something of a Brick adds a clause.

:- multifile forget/1.
