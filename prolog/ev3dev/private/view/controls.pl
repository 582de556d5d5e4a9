:- module(ev3dev_view_controls,
          [ hand_line/3,                % +Word, +Rest, -Answer
            name_of/2,                  % +Text, -Name
            hands_end/0
          ]).
:- use_module(library(lists), [append/3, member/2]).
:- use_module('../native/native',
              [ sim_add_/2, sim_forms_/1, sim_jam_/2, sim_key_/2,
                sim_place_/3,
                sim_plug_/2, sim_remove_/1, view_keep_/2,
                view_move_/4, view_pace_/1, view_pause_/1, view_pull_/1,
                view_put_back_/2, view_source_/1, view_stands_/0,
                view_step_/2
              ]).
:- use_module('../../sim_hand', [added_facts/1, set_added_facts/1]).
:- use_module('../../sim_time', [sim_restore/1, sim_snapshot/1]).
:- use_module(jog, [jog_line/3]).
:- use_module(program, [program_state/1]).

/** <module> Controls of a page

What a person may do on a page to the simulated world. Each line is a word and
plain numbers and names, which are checked here; the simulator checks whether
it is possible.
*/

:- dynamic snapshot/3.                  % Number, Name, Snapshot

%   The most snapshots.
most_snapshots(16).

%!  hand_line(+Word, +Rest, -Answer) is semidet.
%
%   Do what a line of the page says. Answer is done(More), refused(Why), or
%   `none`. Fails if that is not a line.

hand_line(Word, Rest, Answer) :-
    arguments(Rest, Arguments),
    form(Word, Arguments, Hand),
    (   catch(( reaches(Hand), hand(Hand, Answer0) ), Error, true)
    ->  (   var(Error)
        ->  Answer = Answer0
        ;   Error = error(_, _)
        ->  Answer = refused(Error)
        ;   throw(Error)
        )
    ;   why_not(Hand, Why),
        Answer = refused(Why)
    ).

%   All but driving is for the simulator.
reaches(jog(_, _)) :-
    !.
reaches(_) :-
    view_source_(sim).

arguments("", []) :-
    !.
arguments(Rest, Arguments) :-
    split_string(Rest, " ", "", Arguments).

%   The words that there are, with their arguments as texts.
form(pace, [Pace0], pace(Factor)) :-
    atom_string(Pace, Pace0),
    factor(Pace, Factor).
form(pause, [], pause).
form(resume, [], resume).
form(step, [], step(0.1)).
form(step, [S], step(Seconds)) :-
    number_of(S, Seconds),
    Seconds > 0,
    Seconds =< 10.
form(place, [X0, Y0, H0], place(X, Y, H)) :-
    numbers_of([X0, Y0, H0], [X, Y, H]).
form(press, [Key0], key(Key, true)) :-
    key(Key0, Key).
form(release, [Key0], key(Key, false)) :-
    key(Key0, Key).
form(unplug, [Port0], unplug(Port)) :-
    port(Port0, Port).
form(plug, [Port0], plug(Port)) :-
    port(Port0, Port).
form(plug, [Port0, Type0], plug(Port, Type)) :-
    port(Port0, Port),
    name_of(Type0, Type).
form(hold, [Port0], hold(Port, true)) :-
    port(Port0, Port).
form(free, [Port0], hold(Port, false)) :-
    port(Port0, Port).
form(add, [Kind0|Words], add(Fact)) :-
    atom_string(Kind, Kind0),
    (   append(Numbers0, ["mass", Kg0], Words)
    ->  number_of(Kg0, Kg),
        Options = [[mass(Kg)]]
    ;   Numbers0 = Words,
        Options = []
    ),
    numbers_of(Numbers0, Numbers),
    append(Numbers, Options, Arguments),
    item(Kind, Arguments),
    Fact =.. [Kind|Arguments].
form(move, [Id0, X0, Y0], move(Id, X, Y, same)) :-
    numbers_of([Id0, X0, Y0], [Id, X, Y]),
    integer(Id).
form(move, [Id0, X0, Y0, H0], move(Id, X, Y, H)) :-
    numbers_of([Id0, X0, Y0, H0], [Id, X, Y, H]),
    integer(Id).
form(remove, [Id0], remove(Id)) :-
    number_of(Id0, Id),
    integer(Id).
form(save, [Name0], save(Name)) :-
    name_of(Name0, Name).
form(restore, [Name0], restore(Name)) :-
    name_of(Name0, Name).
form(forget, [Name0], forget(Name)) :-
    name_of(Name0, Name).
form(jog, [L0, R0], jog(L, R)) :-
    numbers_of([L0, R0], [L, R]),
    abs(L) =< 100,
    abs(R) =< 100.

factor(x1, 1).
factor(x2, 2).
factor(x10, 10).
factor(max, 0).

%   These numbers, and a list of options after them, describe a thing of this
%   Kind.
item(Kind, Arguments) :-
    sim_forms_(Forms),
    member(thing(Form), Forms),
    Form =.. [Kind|Types],
    are_of(Arguments, Types),
    !.

are_of([], []).
are_of([Argument|Arguments], [_:Type|Types]) :-
    (   number(Argument)
    ->  memberchk(Type, [number, channel])
    ;   Type = traits
    ),
    are_of(Arguments, Types).

numbers_of([], []).
numbers_of([Text|Texts], [Number|Numbers]) :-
    number_of(Text, Number),
    numbers_of(Texts, Numbers).

%   Decimal: a sign, digits, a point and digits; at most ten million.
number_of(Text, Number) :-
    string_length(Text, Length),
    Length =< 20,
    string_codes(Text, Codes),
    (   Codes = [0'-|Digits]
    ->  true
    ;   Digits = Codes
    ),
    append(Whole, Rest, Digits),
    \+ ( Rest = [Next|_], digit(Next) ),
    !,
    Whole = [_|_],
    all_digits(Whole),
    (   Rest = []
    ->  true
    ;   Rest = [0'.|Part],
        Part = [_|_],
        all_digits(Part)
    ),
    number_codes(Number, Codes),
    abs(Number) =< 1.0e7.

all_digits(Codes) :-
    \+ ( member(Code, Codes),
         \+ digit(Code) ).

digit(Code) :-
    Code >= 0'0,
    Code =< 0'9.

%!  name_of(+Text, -Name) is semidet.
%
%   Letters, digits, `_` and `-`.

name_of(Text, Name) :-
    string_length(Text, Length),
    between(1, 32, Length),
    string_codes(Text, Codes),
    \+ ( member(Code, Codes),
         \+ letter(Code) ),
    atom_codes(Name, Codes).

letter(Code) :-
    (   digit(Code)
    ;   Code >= 0'a, Code =< 0'z
    ;   Code >= 0'A, Code =< 0'Z
    ;   memberchk(Code, `_-`)
    ),
    !.

port(Text, Port) :-
    atom_string(Port, Text),
    memberchk(Port, [outA, outB, outC, outD, in1, in2, in3, in4]).

key(Text, Key) :-
    atom_string(Key, Text),
    memberchk(Key, [up, down, left, right, enter, back, in1, in2, in3, in4]).

%   Hands of the simulator fail if none runs.
hand(pace(Factor), done([])) :-
    view_pace_(Factor).
hand(pause, done([])) :-
    view_pause_(true).
hand(resume, done([])) :-
    view_pause_(false).
hand(step(Seconds), done([])) :-
    program_state(State),
    (   State == idle
    ->  Idle = true
    ;   Idle = false
    ),
    view_pause_(true),
    view_step_(Seconds, Idle).
hand(place(X, Y, H), done([])) :-
    sim_place_(X, Y, H).
hand(key(Key, Presses), done([])) :-
    sim_key_(Key, Presses).
hand(unplug(Port), done([])) :-
    view_pull_(Port).
hand(plug(Port), done([])) :-
    view_put_back_(Port, Type),
    plugged(Port, Type).
hand(plug(Port, Type), done([])) :-
    plugged(Port, Type).
hand(hold(Port, Holds), done([])) :-
    sim_jam_(Port, Holds).
hand(add(Fact), done([id=Id])) :-
    sim_add_(Fact, Id),
    added_facts(Added),
    set_added_facts([Fact-Id|Added]).
hand(move(Id, X, Y, H), done([id=Id])) :-
    view_move_(Id, X, Y, H),
    moved(Id, X, Y, H).
hand(remove(Id), done([])) :-
    sim_remove_(Id),
    added_facts(Added0),
    findall(Fact-Other, ( member(Fact-Other, Added0), Other \== Id ), Added),
    set_added_facts(Added).
hand(save(Name), Answer) :-
    findall(Other, ( snapshot(_, Other, _), Other \== Name ), Others),
    length(Others, Count),
    most_snapshots(Most),
    (   Count < Most
    ->  sim_snapshot(Snapshot),
        with_mutex(ev3dev_view_snapshots, keep_snapshot(Name, Snapshot)),
        Answer = done([])
    ;   Answer = refused("There are enough snapshots: forget one first.")
    ).
hand(restore(Name), done([])) :-
    snapshot(_, Name, Snapshot),
    sim_restore(Snapshot).
hand(forget(Name), done([])) :-
    snapshot(_, Name, _),
    with_mutex(ev3dev_view_snapshots, forget_snapshot(Name)).
hand(jog(L, R), Answer) :-
    jog_line(L, R, Answer).

%   The kernel has it within 2 s, which pass only for a program if the clock
%   is virtual.
plugged(Port, Type) :-
    sim_plug_(Port, Type),
    (   program_state(idle),
        catch(view_stands_, _, fail)
    ->  view_step_(2, true)
    ;   true
    ).

why_not(_, Why) :-
    \+ view_source_(sim),
    !,
    Why = "No simulation runs.".
why_not(restore(Name), Why) :-
    \+ snapshot(_, Name, _),
    !,
    format(string(Why), "There is no snapshot ~w.", [Name]).
why_not(forget(Name), Why) :-
    !,
    format(string(Why), "There is no snapshot ~w.", [Name]).
why_not(unplug(Port), Why) :-
    !,
    format(string(Why), "Nothing is plugged into ~w.", [Port]).
why_not(plug(Port), Why) :-
    !,
    format(string(Why), "Nothing was pulled out of ~w.", [Port]).
why_not(key(Port, _), Why) :-
    memberchk(Port, [in1, in2, in3, in4]),
    !,
    format(string(Why), "There is no touch sensor at ~w.", [Port]).
why_not(move(Id, _, _, _), Why) :-
    !,
    format(string(Why), "Thing ~w is not there, or cannot move.", [Id]).
why_not(remove(Id), Why) :-
    !,
    format(string(Why), "Thing ~w is not there.", [Id]).
why_not(_, "No simulation runs.").

%   The fact of an item that was added by a fact is another one now.
moved(Id, X, Y, H) :-
    added_facts(Added0),
    findall(Fact-Other,
            ( member(Fact0-Other, Added0),
              (   Other == Id
              ->  moved_fact(Fact0, X, Y, H, Fact)
              ;   Fact = Fact0
              ) ),
            Added),
    set_added_facts(Added).

moved_fact(box(_, _, W, D, H0), X, Y, H1, box(X, Y, W, D, H)) :-
    !,
    (   number(H1)
    ->  H = H1
    ;   H = H0
    ).
moved_fact(box(_, _, W, D), X, Y, H, Fact) :-
    !,
    (   number(H)
    ->  Fact = box(X, Y, W, D, H)
    ;   Fact = box(X, Y, W, D)
    ).
moved_fact(Fact0, X, Y, _, Fact) :-
    Fact0 =.. [Name, _, _|Rest],
    Fact =.. [Name, X, Y|Rest].

keep_snapshot(Name, Snapshot) :-
    retractall(snapshot(_, Name, _)),
    flag(ev3dev_view_snapshot, Number, Number + 1),
    assertz(snapshot(Number, Name, Snapshot)),
    tell_snapshots.

forget_snapshot(Name) :-
    retractall(snapshot(_, Name, _)),
    tell_snapshots.

tell_snapshots :-
    findall(Text, ( snapshot(_, Name, _), atom_string(Name, Text) ), Texts),
    view_keep_(snapshots, Texts).

%!  hands_end is det.
%
%   Forget the snapshots.

hands_end :-
    retractall(snapshot(_, _, _)),
    tell_snapshots.
