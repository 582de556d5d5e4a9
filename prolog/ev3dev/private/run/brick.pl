:- module(ev3dev_brick,
          [ brick/1,                    % -Brick
            switch_brick/1,             % +Brick
            in_brick/2,                 % +Brick, :Goal
            in_new_brick/1,             % :Goal
            new_brick/1,                % -Brick
            end_brick/1,                % +Brick
            of_brick/1,                 % :Facts
            name_brick/3,               % +Name, +Brick, +Where
            unname_brick/1,             % +Name
            named_brick/3,              % ?Name, ?Brick, ?Where
            must_be_new_names/1,        % +Names
            is_simulated/0,
            is_apart/1                  % +Brick
          ]).
:- use_module('../native/native',
              [ brick_/1, brick_close_/1, brick_open_/1, brick_use_/1,
                sim_active_/0 ]).
:- use_module('../basics/small_lists', [one_of/2]).
:- use_module('../errors/errors', [throw_error/3]).

:- meta_predicate
    in_brick(+, 0),
    in_new_brick(0),
    of_brick(:).

/** <module> The brick in use

What is known of a robot belongs to its brick, which is the first argument of
such facts. A brick is a number: 0 is the one that is there from the start.

Each thread has one in use. The native code knows it; a new thread gets that
of the thread that made it, by a flag of Prolog, which threads inherit.
*/

:- dynamic
    named/3,                            % Name, Brick, Where
    apart/1,                            % Brick
    about/2.                            % Brick, :Fact
:- volatile
    named/3,
    apart/1.

%!  brick(-Brick) is det.
%
%   True if Brick is the one that predicates are about in this thread.

brick(Brick) :-
    brick_(Brick).

%!  switch_brick(+Brick) is det.
%
%   Predicates are about Brick from now on, in this thread and in threads that
%   it makes.
%
%   @error existence_error(brick, Name) if it was closed

switch_brick(Brick) :-
    brick_(Brick),
    !.
switch_brick(Brick) :-
    (   switch(ev3dev_brick:switched(Brick))
    ->  true
    ;   switched(Brick)
    ->  true
    ;   no_brick(Brick)
    ).

%   Its clock may be another one: library(ev3dev/sim) adds the clause.
:- multifile switch/1.

%   In 10.1 a flag that is made, and not set, is one of all threads.

switched(Brick) :-
    brick_use_(Brick),
    (   current_prolog_flag(ev3dev_brick, _)
    ->  true
    ;   create_prolog_flag(ev3dev_brick, 0, [])
    ),
    set_prolog_flag(ev3dev_brick, Brick).

no_brick(Brick) :-
    throw_error(existence_error(brick, Brick), _, 'that brick was closed').

%!  in_brick(+Brick, :Goal) is nondet.
%
%   Call Goal, in which predicates are about Brick. Where Goal has succeeded,
%   and where it is left, they are about the one before.

in_brick(Brick, Goal) :-
    brick_(Brick),
    !,
    call(Goal).
in_brick(Brick, Goal) :-
    brick_(Outer),
    Inside = inside(true),
    setup_call_cleanup(
        switch_brick(Brick),
        within(Brick, Outer, Inside, Goal),
        (   arg(1, Inside, true)
        ->  switch_brick(Outer)
        ;   true
        )).

within(Brick, Outer, Inside, Goal) :-
    call_cleanup(Goal, Is = over),
    (   Is == over
    ->  true
    ;   (   nb_setarg(1, Inside, false),
            switch_brick(Outer)
        ;   nb_setarg(1, Inside, true),
            switch_brick(Brick),
            fail
        )
    ).

%!  in_new_brick(:Goal) is semidet.
%
%   Call Goal once, in a brick of which nothing is known, and which ends with
%   it. The events of others do not happen meanwhile.

in_new_brick(Goal) :-
    setup_call_cleanup(
        new_brick(Brick),
        ( assertz(apart(Brick)), once(in_brick(Brick, Goal)) ),
        ( retractall(apart(Brick)), end_brick(Brick) )).

%!  is_apart(+Brick) is semidet.
%
%   True if Brick is one of in_new_brick/1.

is_apart(Brick) :-
    apart(Brick).

%!  new_brick(-Brick) is det.
%!  end_brick(+Brick) is det.
%
%   A brick of which nothing is known; end it, which stops its motors. What
%   was known of it is forgotten. A thread in which it is in use has no brick.

new_brick(Brick) :-
    brick_open_(Brick).

end_brick(Brick) :-
    forall(forget(Brick), true),
    ignore(brick_close_(Brick)).

%!  forget(+Brick) is multi.
%
%   Forget what is known of a Brick. A module adds a clause if it has more to
%   do than of_brick/1.

:- multifile forget/1.

forget(Brick) :-
    forall(about(Brick, Fact), retractall(Fact)).

%!  other_world(+Brick) is det.
%
%   A simulation of another world begins. A module adds a clause if it knows
%   something of the world.

:- multifile other_world/1.

%!  of_brick(:Facts) is det.
%
%   A directive: the predicates Facts, a list of Name/Arity, have the brick as
%   their first argument. Their facts are forgotten when the brick ends.

of_brick(Module:Facts) :-
    forall(( one_of(Facts, Name/Arity),
             functor(Fact, Name, Arity),
             arg(1, Fact, Brick),
             \+ about(_, Module:Fact) ),
           assertz(about(Brick, Module:Fact))).

%!  name_brick(+Name, +Brick, +Where) is det.
%!  unname_brick(+Name) is det.
%!  named_brick(?Name, ?Brick, ?Where) is nondet.
%
%   Give a brick a name, take it away, or ask: Brick is called Name, and is a
%   robot at that place, as in brick_open/2.

name_brick(Name, Brick, Where) :-
    assertz(named(Name, Brick, Where)).

unname_brick(Name) :-
    retractall(named(Name, _, _)).

named_brick(Name, Brick, Where) :-
    named(Name, Brick, Where).

%!  must_be_new_names(+Names) is det.
%
%   Names may be those of new bricks: none has one, and no two are the same.
%
%   @error permission_error(open, brick, Name)

must_be_new_names([]).
must_be_new_names([Name|Names]) :-
    (   ( Name == local ; named(Name, _, _) ; memberchk(Name, Names) )
    ->  throw_error(permission_error(open, brick, Name), _,
                    'there is a brick of that name; brick_close/1 closes \c
                     it, and sim_stop/0 all robots of sim_start/2')
    ;   must_be_new_names(Names)
    ).

%!  is_simulated is semidet.
%
%   A simulation runs in the brick in use. Fails where the pack was built
%   without the simulator.

is_simulated :-
    predicate_property(sim_active_, foreign),
    sim_active_.
