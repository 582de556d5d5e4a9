:- module(cases,
          [ case/2,                     % +Count, -Seed
            cases/2,                    % +Count, -Used
            some/1,                     % :Goal
            case/3,                     % +Few, +Many, -Seed
            schedules/2,                % -First, -Last
            all_cases/0
          ]).

/** <module> The number of random cases that a test tries

All of them, unless EV3DEV_TEST_PERCENT in the environment says how many
percent: an emulated EV3 takes twenty to two hundred times as long for each.
*/

:- (   getenv('EV3DEV_TEST_PERCENT', Text)
   ->  atom_number(Text, Percent)
   ;   Percent = 100
   ),
   asserta(percent(Percent)).

%!  case(+Count, -Seed) is nondet.
%
%   The seeds of Count cases, from 1 on, or of those of them that are tried.

case(Count, Seed) :-
    cases(Count, Used),
    between(1, Used, Seed).

%!  case(+Few, +Many, -Seed) is nondet.
%
%   The seeds of Few cases. EV3DEV_TEST_SCHEDULES in the environment, whatever it says,
%   asks for Many.

case(Few, Many, Seed) :-
    (   getenv('EV3DEV_TEST_SCHEDULES', _)
    ->  case(Many, Seed)
    ;   case(Few, Seed)
    ).

%!  cases(+Count, -Used) is det.
%
%   True if that many of Count cases are tried: at least two.

cases(Count, Used) :-
    percent(Percent),
    Used is max(2, Count * Percent // 100).

%!  some(:Goal) is nondet.
%
%   As Goal, without the solutions that are not tried. They are the same each time, and
%   spread evenly.

:- meta_predicate some(0).

some(Goal) :-
    percent(Percent),
    State = count(0),
    call(Goal),
    State = count(Count0),
    Count is Count0 + 1,
    nb_setarg(1, State, Count),
    Count0 * 2654435769 mod 4294967296 < Percent * 42949673.

%!  schedules(-First, -Last) is det.
%
%   The seeds of 300 random programs. EV3DEV_TEST_SCHEDULES in the environment
%   asks for more, or for other ones, as in `1-10000`.

schedules(First, Last) :-
    (   getenv('EV3DEV_TEST_SCHEDULES', Text),
        term_to_atom(First-Last, Text)
    ->  true
    ;   First = 1,
        cases(300, Last)
    ).

%!  all_cases is semidet.
%
%   True if all are. What is said of the lot of them holds for no less.

all_cases :-
    percent(Percent),
    Percent >= 100.
