:- module(tally,
          [ tally/1                     % +Name
          ]).
:- use_module(library(lists)).
:- use_module(library(pairs)).
:- use_module(library(plunit)).

/** <module> How many tests a run leaves out, and why

A test or a unit that is not for every run says so by `condition(only(Runs,
Why))`. Whoever defines only/2 asks for the tally, which is printed at halt.
*/

%!  tally(:Name)
%
%   At halt, tell how many tests there are, and how many of them Name/2 left
%   out.

:- meta_predicate tally(:).

tally(Module:Name) :-
    at_halt(tally:print_tally(Module:Name)).

print_tally(Only) :-
    findall(Test, test_in(_, Test, _), Tests),
    findall(Why, ( test_in(_, _, Options), left_out(Only, Options, Why) ), Whys),
    Tests = [_|_],
    !,
    length(Tests, All),
    length(Whys, Left),
    Run is All - Left,
    getenv_or('EV3DEV_TEST_TREE', plain, Kind),
    format("tally ~w: ~d tests, ~d left out~n", [Kind, Run, Left]),
    msort(Whys, Sorted),
    findall(Why-1, member(Why, Sorted), Pairs),
    group_pairs_by_key(Pairs, Groups),
    forall(member(Why-Ones, Groups),
           ( length(Ones, Count), format("    ~d: ~w~n", [Count, Why]) )).

print_tally(_).

getenv_or(Name, Default, Value) :-
    (   getenv(Name, Value)
    ->  true
    ;   Value = Default
    ).

%   Options are those of the test and of its unit.
test_in(Unit, Test, [UnitOptions, Options]) :-
    plunit:current_unit(Unit, Module, _, UnitOptions),
    Module:'unit test'(Test, _, Options, _).

left_out(_:Name, [UnitOptions, Options], Why) :-
    (   member(Known, [UnitOptions, Options]),
        sub_term_of(Known, Condition),
        compound(Condition),
        Condition =.. [Name, Trees, Why],
        \+ tree:only(Trees, Why)
    ->  true
    ).

sub_term_of(Term, Term).
sub_term_of(Term, Sub) :-
    compound(Term),
    arg(_, Term, Argument),
    sub_term_of(Argument, Sub).
