% Domains in the dialects of the published interpreters run when one line loads
% library(ev3dev/golog) in the place of the interpreter. The domains, in
% tests/support/golog, are our own, in the vocabulary of: the plain interpreter
% of IndiGolog (elevator_plain), full IndiGolog with basic action theories
% (elevator_full, wumpus), and Legolog (delivery_legolog).

:- use_module('../support/simulation').
:- use_module(library(ev3dev/golog)).

:- prolog_load_context(directory, Here),
   atom_concat(Here, '/../support/golog/', Directory),
   assertz(domain_directory(Directory)).

%   with_domain_file(+Name, +More, -Module, :Goal): Module is a new one that
%   loads the library and then the domain, as a main file does, and has the
%   clauses More.

with_domain_file(Name, More, Module, Goal) :-
    flag(golog_domain, N, N+1),
    atomic_list_concat([golog_domain_, N], Module),
    domain_directory(Directory),
    atom_concat(Directory, Name, File),
    format(string(Text),
           ":- module(~q, []).~n\c
            :- use_module(library(ev3dev/golog)).~n\c
            :- include(~q).~n", [Module, File]),
    with_file(Text, Main, load_files(Main, [])),
    forall(member(Clause, More), assertz(Module:Clause)),
    call(Goal).

%   The history of a run, oldest entry first

run(Goal, Options, Run) :-
    call(golog_of(Goal, [history(H)|Options])),
    reverse(H, Run).

golog_of(Module:Program, Options) :-
    golog(Module:Program, Options).

:- begin_tests(golog_plain).
test(the_simple_elevator,
     Run == [down, down, serve(1), up, up, up, serve(4), down, down, down]) :-
    plain(control(simple), [], Run).
test(it_searches_the_shorter_way,
     Run == [up, serve(4), down, down, down, serve(1)]) :-
    plain(control(short), [], Run).
test(without_a_search_it_gets_stuck, R = no_step(_)) :-
    with_domain_file(elevator_plain, [], M,
                     run(M:control(reckless), [reason(R)], [])).
test(exogenous_actions_are_asked_for,
     Run == [down, press(2), press(5), down, serve(1), up, serve(2), up, up,
             serve(4), up, serve(5), down, down, down, down]) :-
    plain(control(simple), [happens(1, press(2)), happens(1, press(5))],
          Run).
test(all_is_executed, Count == 4) :-
    with_domain_file(elevator_plain, [], M,
                     ( run(M:[move(up), serve(4), move(up), move(down)], [], _),
                       findall(x, M:executed(_), Xs) )),
    length(Xs, Count).

plain(Program, More, Run) :-
    with_domain_file(elevator_plain, More, M, run(M:Program, [], Run0)),
    findall(E, ( member(E0, Run0), ( E0 = move(E) -> true ; E = E0 ) ), Run).
:- end_tests(golog_plain).

:- begin_tests(golog_full).
test(main_is_the_controller,
     Run == [ down, open_door, serve(1), shut_door, up, up, up, up,
              open_door, serve(5), shut_door, down, down, down, down ]) :-
    full(1, [], Run).
test(it_searches,
     Run == [ down, open_door, serve(1), shut_door, up, up, up, up,
              open_door, serve(5), shut_door ]) :-
    full(2, [], Run).
test(a_call_on_the_way_is_planned_for,
     Run == [ unset(new_call), down, open_door, serve(1), shut_door, up,
              press(3), fire, ring, clear, unset(new_call), up, open_door,
              serve(3), shut_door, up, up, open_door, serve(5), shut_door,
              down, down, down, down, weigh, e(load, 64) ]) :-
    full(3, [trace(user:at_first_up)], Run).
test(the_codes_went_to_their_devices, All == [do(up)-cabin, sample-scales]) :-
    with_domain_file(elevator_full, [], M,
                     ( golog(M:[up, weigh], []),
                       findall(A-D, ( M:executed(D, A0),
                                      ( D == cabin -> A = do(A0) ; A = A0 ) ),
                               All) )).

full(Controller, Options, Run) :-
    with_domain_file(elevator_full, [controller(Controller)], M,
                     ( nb_setval(golog_full, M-0),
                       run(M:main, Options, Run) )).
:- end_tests(golog_full).

%   At the first `up`: a call, and smoke that goes away when the bell rings.

user:at_first_up(E) :-
    nb_getval(golog_full, M-Seen),
    (   E == action(up),
        Seen == 0
    ->  nb_setval(golog_full, M-1),
        M:golog_exog(button(3)),
        M:golog_exog(smoke_sensor(1))
    ;   E == action(ring)
    ->  M:golog_exog(smoke_sensor(0))
    ;   true
    ).

:- begin_tests(golog_legolog).
test(the_post_goes_from_door_to_door,
     Run == [ order(4, 1), leave, reached, leave, reached, honk, loaded,
              turn_back, leave, reached, leave, reached, leave, reached,
              honk, loaded ]) :-
    delivery(M, ( assertz(M:robot_action(leave, M:golog_exog(3))),
                  assertz(M:robot_action(honk, M:golog_exog(5))),
                  assertz(M:robot_action(turn_back, true)),
                  M:golog_exog(order(4, 1)),
                  run(M:control, [timeout(0.2), reason(_)], Run) )).
test(it_is_put_back_when_it_is_lost,
     Run-Told == [order(4, 1), leave, lost, reached, leave]-[put_back(2, 1)]) :-
    delivery(M, ( assertz((M:robot_action(leave, Goal) :-
                               (   M:told(_)
                               ->  Goal = true
                               ;   Goal = M:golog_exog(4)
                               ))),
                  M:golog_exog(order(4, 1)),
                  run(M:control, [timeout(0.2), reason(_)], Run),
                  findall(T, M:told(T), Told) )).
test(the_domain_may_read_its_fluents, Value == 3) :-
    with_domain_file(delivery_legolog, [], M,
                     M:execute(other, [reached, leave], Value)).

delivery(M, Goal) :-
    with_sim(room, with_domain_file(delivery_legolog, [], M, Goal)).
:- end_tests(golog_legolog).

:- begin_tests(golog_wumpus).
cave(1, [ wumpus(loc(1, 3)), pit(loc(3, 1)), pit(loc(3, 3)), pit(loc(4, 4)),
          gold(loc(2, 3)) ]).
cave(2, [wumpus(loc(4, 4)), pit(loc(4, 1)), gold(loc(3, 3))]).
cave(3, [wumpus(loc(3, 1)), pit(loc(1, 3)), pit(loc(2, 2)), gold(loc(4, 4))]).

%   Cave 3 has no safe way to the gold.

test(the_agent_comes_home, [ forall(nth1(Cave, [1, 1, 0], Nuggets)),
                             true([Last, Got, Dead] == [climb, Nuggets, []]) ]) :-
    cave(Cave, Facts),
    findall(in_cave(Fact), member(Fact, Facts), More),
    with_domain_file(wumpus, More, M,
                     ( golog(M:main, [ device(M:cave), history(H),
                                       limit(2000) ]),
                       H = [Last|_],
                       has_val(M:nuggets, Got, H),
                       findall(L, ( append(_, Before, H),
                                    Before = [forward|_],
                                    has_val(M:at, L, Before),
                                    deadly(L, Before, M) ),
                               Dead) )).
test(it_shoots_the_wumpus, [Shots, Screams] == [1, 1]) :-
    cave(1, Facts),
    findall(in_cave(Fact), member(Fact, Facts), More),
    with_domain_file(wumpus, More, M,
                     golog(M:main, [device(M:cave), history(H)])),
    findall(x, member(shoot, H), Xs),
    length(Xs, Shots),
    findall(x, member(scream, H), Ys),
    length(Ys, Screams).
:- end_tests(golog_wumpus).

%   To be at L after the history H is deadly.

deadly(L, _, M) :-
    M:in_cave(pit(L)).
deadly(L, H, M) :-
    M:in_cave(wumpus(L)),
    holds(M:alive, H).
