:- use_module('../support/simulation').
:- use_module('../support/cases').
:- use_module(library(plunit)).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/golog_classic), [situation_history/2]).

:- op(960, xfy, #).
:- op(850, xfy, v).
:- op(870, xfy, =>).
:- op(800, xfy, &).

% Programs in the syntax of [Le97] and of Reiter's book, each in a module of
% its own, as a user loads them.

program(coffee, "
primitive_action(go(_)).  primitive_action(pour).  primitive_action(give(_)).
poss(go(L), S) :- at(M, S), L \\= M.
poss(pour, S) :- at(machine, S), -full(S).
poss(give(P), S) :- full(S), at(office(P), S), wants(P, S).
at(L, do(A, S)) :- A = go(L) ; \\+ A = go(_), at(L, S).
full(do(A, S)) :- A = pour ; full(S), \\+ A = give(_).
wants(P, do(A, S)) :- wants(P, S), \\+ A = give(P).
-(G) :- \\+ G.
at(machine, s0).  wants(sue, s0).  wants(bob, s0).
restoreSitArg(at(L), S, at(L, S)).
restoreSitArg(full, S, full(S)).
restoreSitArg(wants(P), S, wants(P, S)).
proc(to(L), ?(at(L)) # go(L)).
proc(serve(P), to(machine) : pour : to(office(P)) : give(P)).
proc(day, while(some(p, wants(p)), pi(p, ?(wants(p)) : serve(p)))).
").
program(blocks, "
primitive_action(move(_, _)).
poss(move(X, Y), S) :- clear(X, S), place(Y, S), X \\= Y, \\+ on(X, Y, S).
place(table, _).
place(Y, S) :- clear(Y, S).
clear(X, S) :- block(X), \\+ on(_, X, S).
on(X, Y, do(A, S)) :- A = move(X, Y) ; on(X, Y, S), \\+ A = move(X, _).
block(a).  block(b).  block(c).
on(a, b, s0).  on(b, table, s0).  on(c, table, s0).
restoreSitArg(on(X, Y), S, on(X, Y, S)).
restoreSitArg(clear(X), S, clear(X, S)).
proc(flatten, while(-all(x, block(x) => on(x, table)),
                    pi(x, ?(clear(x) & -on(x, table)) : move(x, table)))).
proc(steps(N), ?(on(b, a) & on(a, c)) #
               ?(N > 0) : pi(x, pi(y, move(x, y))) :
               pi(m, ?(m is N-1) : steps(m))).
").
program(lamp, "
primitive_action(on).  poss(on, S) :- \\+ holds(lit, S).
holds(lit, do(A, S)) :- A = on ; holds(lit, S).
proc(light, if(lit, ?(true), on)).
").
program(two_balls, "
primitive_action(bounce(_, _)).  primitive_action(collide(_)).
poss(bounce(B, T), S) :- soonest(bounce(B), T, S).
poss(collide(T), S) :- soonest(collide, T, S).
soonest(E, T, S) :- findall(T1-E1, at_time(E1, T1, S), L0), msort(L0, [T-E|_]).
at_time(bounce(B), T, S) :- vel(B, V, S), V =\\= 0, wall(W), start(T0, S),
                            pos(B, X, S), T is T0+(W-X)/V, T > T0.
at_time(collide, T, S) :- vel(a, V, S), vel(b, W, S), V =\\= W, start(T0, S),
                          pos(a, X, S), pos(b, Y, S), T is T0+(Y-X)/(V-W),
                          T > T0.
wall(0).  wall(120).
time(bounce(_, T), T).  time(collide(T), T).
start(T, do(A, _)) :- time(A, T).
pos(B, X, do(A, S)) :- pos(B, X0, S), vel(B, V, S), start(T0, S), time(A, T),
                       X is X0+V*(T-T0).
vel(B, V, do(A, S)) :- A = bounce(B, _), vel(B, V0, S), V is -V0.
vel(B, V, do(A, S)) :- A = collide(_), other(B, C), vel(C, V, S).
vel(B, V, do(A, S)) :- A = bounce(C, _), C \\= B, vel(B, V, S).
other(a, b).  other(b, a).
start(0, s0).  vel(a, 10, s0).  vel(b, -5, s0).  pos(a, 0, s0).
pos(b, 120, s0).
proc(events(N), if(N = 0, ?(true),
                   pi(t, pi(b, bounce(b, t)) # collide(t)) :
                   pi(m, ?(m is N-1) : events(m)))).
").

:- dynamic loaded_/1.

loaded(elevator) :-
    !,
    load_files(elevator:example(golog_classic), [if(not_loaded)]).
loaded(Name) :-
    (   loaded_(Name)
    ->  true
    ;   program(Name, Text),
        assertz(loaded_(Name)),
        '$set_source_module'(Old, Name),
        setup_call_cleanup(
            open_string(Text, In),
            ( Name:use_module(library(ev3dev/golog_classic)),
              load_files(Name:Name, [stream(In)]) ),
            ( close(In), '$set_source_module'(_, Old) ))
    ).

ways(Name, Program, Count, Ways) :-
    loaded(Name),
    findall(Way,
            limit(Count, ( Name:do(Program, s0, S), situation_history(S, As),
                           reverse(As, Way) )),
            Ways).

:- begin_tests(golog_classic).
test(the_elevator_has_both_orders,
     Ways == [ [ down(3), off(3), open, up(5), off(5), open, down(0), open ],
               [ up(5), off(5), open, down(3), off(3), open, down(0), open ]
             ]) :-
    ways(elevator, control, 9, Ways).
test(coffee, Ways == [[ pour, go(office(P)), give(P), go(machine), pour,
                        go(office(Q)), give(Q) ]]) :-
    P = sue, Q = bob,
    ways(coffee, day, 1, Ways).
test(blocks, Ways == [[move(a, table), move(a, c), move(b, a)]]) :-
    ways(blocks, flatten : steps(2), 1, Ways).
test(fluents_may_be_clauses_of_holds, Ways == [[on]]) :-
    ways(lamp, light : light, 9, Ways).
test(two_balls, Ways == [[collide(8), bounce(b, 12)]]) :-
    ways(two_balls, events(2), 1, Ways).
test(it_runs_on_a_robot, Floor-Angle == 0-0) :-
    loaded(elevator),
    with_sim(room, ( elevator:start, motor_position(outA, Angle0) )),
    elevator:now(H),
    once(elevator:holds(floor(Floor), H)),
    Angle is round(Angle0/10).
test(a_search_finds_a_whole_run_first, H == [down(3)]) :-
    loaded(elevator),
    elevator:golog(search((up(9) # down(3)) : ?(-floor(9))), [limit(1), history(H), reason(_)]).
test(why_not_names_the_part_of_the_axiom,
     Base-Why == 'golog_classic.pl'-not_possible([failure(waits(4, '$VAR'('S')), [], Place)])) :-
    loaded(elevator),
    elevator:golog(?(true) : off(4), [reason(_)]),
    elevator:why_not(off(4), Why),
    Why = not_possible([failure(_, _, Place)]),
    Place = File:_,
    file_base_name(File, Base).
test(why_a_fluent_of_a_situation_has_its_value, By = entry(1, down(3), _)) :-
    loaded(elevator),
    with_sim(room, elevator:golog(down(3) : off(3), [])),
    why(floor(4), fluent(false, By)).
test(conditions, [all(Floor == [4])]) :-
    loaded(elevator),
    elevator:holds(floor(F) & -(-floor(4)) & -(waits(F) & true) & (-waits(F) v waits(9)) & (waits(9) => floor(F)), s0),
    Floor = F.
test(a_situation_in_the_middle, S == do(up(9), do(off(5), do(up(5), s0)))) :-
    loaded(elevator),
    once(elevator:do(go(9), do(off(5), do(up(5), s0)), S)).
test(a_condition_without_its_situation, true(sub_atom(Text, _, _, 0, 'There is place/2 with a situation: restoreSitArg/3 must name it'))) :-
    catch(ways(blocks, ?(place(a)), 1, _), error(_, context(_, Text)), true).
test(an_unknown_part_is_named,
     throws(error(existence_error(golog_program, fly/0), _))) :-
    ways(elevator, open : fly, 1, _).
:- end_tests(golog_classic).
