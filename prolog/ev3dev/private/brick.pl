:- module(ev3dev_brick,
          [ brick/1                     % -Brick
          ]).

/** <module> The brick in use

What is known of a robot belongs to its brick, which is the first argument of
such facts. So what one brick knows is nothing to another one.
*/

%!  brick(-Brick) is det.
%
%   True if Brick is the one that predicates are about. There is only `local`.

brick(local).
