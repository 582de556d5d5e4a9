% What a program of library(ev3dev/sim_fenced) begins with: its random numbers
% are those of a seed.

:- module(ev3dev_fenced_seed, []).

:- dynamic
    seed/1,
    known/1.                            % Task, of a thread

%   Each thread has its own, and each engine.

begin_numbers :-
    seed(Seed0),
    number_here(Number),
    atom_concat(ev3dev_numbers_, Number, Key),
    flag(Key, Before, Before+1),
    Seed is Seed0 + 1000000*Number + Before,
    set_random(seed(Seed)),
    (   random_property(state(State))
    ->  true
    ;   State = none
    ),
    nb_setval(ev3dev_random_seed, before(State)).   % as random_seed.pl has it

%   Threads get their numbers in the order of their creation, however late
%   they begin. An engine, which is 0, is created by a thread that is known;
%   it must not be asked: there thread_self/1 crashes 9.0.4.

number_here(Number) :-
    (   read_link('/proc/thread-self', Task, _),
        \+ known(Task)
    ->  assertz(known(Task)),
        thread_self(Me),
        thread_number(Me, Number)
    ;   Number = 0
    ).

thread_number(Me, Number) :-
    (   integer(Me)                     % 7.2.3
    ->  Number = Me
    ;   Property =.. [id, Number],      % newer, too
        catch(thread_property(Me, Property), error(_, _), fail)
    ->  true
    ;   term_hash(Me, Number)
    ).

:- (   getenv('EV3DEV_SEED', Text)
   ->  unsetenv('EV3DEV_SEED'),
       atom_number(Text, Seed),
       assertz(seed(Seed)),
       thread_initialization(begin_numbers)
   ;   true
   ).
