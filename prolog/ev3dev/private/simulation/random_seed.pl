:- module(ev3dev_random_seed,
          [ begin_chance_of/1,          % +Options
            begin_chance/1,             % +Seed
            end_chance/0,
            with_own_chance/1,          % :Goal
            branch_seed/1,              % -Seed
            seed_branch/1               % +Seed
          ]).

/** <module> The random numbers of a program that is simulated

Prolog has a generator for each thread, and for each engine; library(random)
draws from it, too, and need not be loaded here. So its former state is in a
global variable, of which each of them has its own.
*/

:- use_module('../checks/arguments', [option/2]).

:- meta_predicate with_own_chance(0).

%!  begin_chance_of(+Options) is det.
%
%   Draw the numbers that the Options of sim_start/2 ask for: by the virtual
%   clock those of 1, if there is no other seed.

begin_chance_of(Options) :-
    (   option(seed(Seed), Options)
    ->  begin_chance(Seed)
    ;   option(clock(virtual), Options)
    ->  begin_chance(1)
    ;   end_chance
    ).

%!  begin_chance(+Seed) is det.
%!  end_chance is det.
%
%   From now on this thread draws the numbers of Seed, an integer; it goes on
%   with those that it would have drawn without begin_chance/1.

begin_chance(Seed) :-
    (   seeded(_)
    ->  true
    ;   generator(State),
        nb_setval(ev3dev_random_seed, before(State))
    ),
    set_random(seed(Seed)).

%   Not every Prolog can say it.
generator(State) :-
    (   random_property(state(State0))
    ->  State = State0
    ;   State = none
    ).

end_chance :-
    (   seeded(State)
    ->  nb_setval(ev3dev_random_seed, []),
        draw_from(State)
    ;   true
    ).

draw_from(State) :-
    (   State == none
    ->  set_random(seed(random))
    ;   set_random(state(State))
    ).

%!  with_own_chance(:Goal) is semidet.
%
%   Call Goal once, in which a simulation draws its own numbers. After it this
%   thread goes on with those that it would have drawn without it.

with_own_chance(Goal) :-
    (   seeded(Before)
    ->  Outer = before(Before)
    ;   Outer = []
    ),
    generator(State),
    setup_call_cleanup(
        nb_setval(ev3dev_random_seed, []),
        once(Goal),
        chance_again(Outer, State)).

chance_again(Outer, State) :-
    (   seeded(_)
    ->  draw_from(State)
    ;   true
    ),
    nb_setval(ev3dev_random_seed, Outer).

seeded(State) :-
    nb_current(ev3dev_random_seed, before(State)).

%!  branch_seed(-Seed) is det.
%!  seed_branch(+Seed) is det.
%
%   A goal that runs beside others, in an engine, draws the numbers of Seed.
%   This thread draws Seed for it, if its own numbers have a seed; else Seed
%   is `none`.

branch_seed(Seed) :-
    (   seeded(_)
    ->  Seed is random(4294967296)
    ;   Seed = none
    ).

seed_branch(Seed) :-
    (   Seed == none
    ->  true
    ;   nb_setval(ev3dev_random_seed, before(none)),
        set_random(seed(Seed))
    ).
