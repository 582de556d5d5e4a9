:- use_module('../support/cases').
:- use_module('../support/naive_layers').
:- use_module('../support/simulation').
:- use_module('../support/trees').
:- use_module(library(ev3dev/drive)).
:- use_module(library(ev3dev/events), [after/2]).
:- use_module(library(ev3dev/journal)).
:- use_module(library(ev3dev/layers)).

% ---------------- SUPPORT

:- dynamic
    row/2,                              % Number of a moment, What
    noted/1,
    used/2.                             % Number of a moment, Counts

forget :-
    retractall(row(_, _)),
    retractall(noted(_)),
    retractall(used(_, _)).

note(Event) :-
    assertz(noted(Event)).

note_line(_) :-
    once(ev3dev_causes:active_clause(Clause)),
    clause_property(Clause, line_count(Line)),
    note(Line).

noted_events(Events) :-
    findall(Event, retract(noted(Event)), Events).

% Goal with a program of that Text, in the module `layered`.
:- meta_predicate layered(+, 0).

layered(Text, Goal) :-
    load(Text),
    with_sim([], Goal).

load(Text) :-
    folder(Folder),
    atom_concat(Folder, '/program.pl', File),
    setup_call_cleanup(
        open(File, write, Stream),
        write(Stream, Text),
        close(Stream)),
    call_cleanup(load_files(layered:File, []), delete_file(File)).

:- dynamic folder/1.
:- initialization(( tmp_file(layers, Folder), make_directory(Folder),
                    assertz(folder(Folder)),
                    at_halt(catch(delete_directory(Folder), _, true)) )).

% The file has `sense` of what the test says.
program(Rules, Text) :-
    with_output_to(string(Text),
                   ( writeln(':- use_module(library(ev3dev/layers)).'),
                     writeln('sense(s(N), V) <- user:shown(s(N), V).'),
                     forall(member(Rule, Rules), portray_clause(Rule)) )).

run_layers(Options) :-
    layered:control(Options).

% What ends a run of these rules, which name no library.
ends(Rules, End) :-
    ends(Rules, [timeout(0.2)], End).

ends(Rules, Options, End) :-
    atomic_list_concat([':- use_module(library(ev3dev/layers)).\n', Rules], Text),
    layered(Text,
            ( catch(( run_layers(Options) -> End0 = ended ; End0 = failed ),
                    error(Formal, context(_, Words)),
                    End0 = Formal/Words),
              assertion(at_rest) )),
    End = End0.

says(Words, Part) :-
    once(sub_atom(Words, _, _, _, Part)).

commands(Commands) :-
    journal(Journal),
    findall(Port-Speed,
            ( member(command(_, Port, tacho_motor('run-forever', SetPoints), _), Journal),
              memberchk(speed_sp(Speed), SetPoints) ),
            Commands).

% ---------------- RANDOM PROGRAMS

:- dynamic shown_at/3.

shown(Sense, Value) :-
    moment(Moment),
    shown_at(Moment, Sense, Value).

% The time hardly passes otherwise.
moment(Moment) :-
    sense(time, Time),
    Moment is round(Time/0.05).

% What a program does, as naive_table/3 says it. Times are those of its moments.
played(case(Rules, Count, Senses), Times, Table) :-
    retractall(row(_, _)),
    retractall(shown_at(_, _, _)),
    forall(member(sense(Moment, Sense, Value), Senses),
           assertz(shown_at(Moment, Sense, Value))),
    program(Rules, Text),
    load(Text),
    findall(Fluent, member((assign(Fluent, _) <- _), Rules), Fluents0),
    sort(Fluents0, Fluents),
    catch(( run_layers([ until(user:noted(Count, Fluents)), trace(user:command) ]),
            What = none ),
          error(permission_error(What, _, _), _),
          true),
    aggregate_all(count, row(_, time(_)), Ended),
    member(What-Last, [none-Count, assign-Ended, set-(Ended-1)]),
    !,
    ( What == none -> End = [] ; Moment is Last, End = [contradiction(Moment)] ),
    Latest is Last - 1,
    findall(Time, ( row(M, time(Time)), M =< Latest ), Times0),
    findall(at(M, Values, Sets),
            ( between(0, Latest, M),
              findall(F-V, row(M, val(F, V)), Values0), sort(Values0, Values),
              findall(P-S, row(M, set(P, S)), Sets0), sort(Sets0, Sets) ),
            Rows),
    append(Rows, End, Table),
    (   End == []
    ->  Times = Times0
    ;   % The rules have not come to an end there.
        ( last(Times0, Time0) -> true ; Time0 = -0.05 ),
        Next is Time0 + 0.05,
        append(Times0, [Next], Times)
    ).

% Called once in each moment, before the motors get their commands.
noted(Count, Fluents) :-
    moment(Moment),
    sense(time, Time),
    forall(( member(Fluent, Fluents), value_of(Fluent, Value) ),
           assertz(row(Moment, val(Fluent, Value)))),
    assertz(row(Moment, time(Time))),
    Moment =:= Count.

value_of(Fluent, Value) :-
    (   Fluent = seen(X)
    ->  between(0, 4, X)
    ;   true
    ),
    val(Fluent, Value).

command(set(Port, Speed)) :-
    moment(Moment),
    assertz(row(Moment, set(Port, Speed))).
command(assign(_, _)).

% The sets of a table that change a speed.
commanded([], _, []).
commanded([at(M, Values, Sets)|Rows], Speeds0, [at(M, Values, New)|Commanded]) :-
    !,
    subtract(Sets, Speeds0, New),
    findall(Port-Speed,
            ( member(Port-Speed, Speeds0), \+ memberchk(Port-_, New) ), Kept),
    append(New, Kept, Speeds),
    commanded(Rows, Speeds, Commanded).
commanded(Rows, _, Rows).

differs(Seed, Expected-Found) :-
    layered_program(Seed, Case),
    played(Case, Times, Found),
    naive_table(Case, Times, Table),
    commanded(Table, [], Expected),
    Expected \== Found.

:- begin_tests(layers_random).
test(random_programs_agree_with_a_naive_evaluation, true(Different == [])) :-
    schedules(First, Last),
    with_sim([],
             findall(Seed, ( between(First, Last, Seed), differs(Seed, _) ),
                     Different)).
:- end_tests(layers_random).

% What Prolog has in use at the given moments of one run.

measured(Moments, Last) :-
    val(count, Moment),
    (   memberchk(Moment, Moments)
    ->  garbage_collect,
        garbage_collect_atoms,
        garbage_collect_clauses,
        findall(Used,
                ( member(Key, [ atoms, clauses, functors, predicates, globalused,
                                trailused, localused ]),
                  statistics(Key, Used) ),
                Useds),
        assertz(used(Moment, Useds))
    ;   true
    ),
    Moment =:= Last.

:- begin_tests(layers_memory).
test(memory_is_the_same_after_ten_times_the_moments,
     [ condition(all_cases), setup(forget), true(More == []) ]) :-
    Few = 10000,
    Many = 100000,
    layered(":- use_module(library(ev3dev/layers)).
             assign(count, 1) <- \\+ was(count, _, _).
             assign(count, N) <- was(count, M, _), N is M + 1.
             assign(seen(R), yes) <- val(count, N), R is N mod 7.
             assign(word, W) <- val(count, N), atom_concat(w, N, W).
             assign(pairs, [N-M]) <- val(count, N), was(count, M, Since), Since >= 0.
             even <- val(count, N), N mod 2 =:= 0.
             set(outB, 20) <- even.
             set(outB, 30) <- \\+ even.",
            run_layers([until(user:measured([Few, Many], Many))])),
    used(Few, Before),
    used(Many, After),
    % The journal is full after 10 000 moments; what it has of the last ones differs.
    findall(A-B,
            ( nth1(I, Before, A), nth1(I, After, B), B > A + 2000 ),
            More).
:- end_tests(layers_memory).

:- begin_tests(layers).
test(a_fluent_keeps_its_value_until_it_is_assigned_another_one,
     true(Values == [0-1, 1-1, 2-5, 3-5])) :-
    forget,
    ends("assign(a, 1) <- \\+ was(a, _, _).
          assign(a, 5) <- sense(time, T), T > 0.08, was(a, 1, _).
          see <- sense(time, T), N is round(T/0.05), val(a, V), user:assertz(row(N, V)), N = 3.",
         [until(see)], _),
    findall(N-V, row(N, V), Values).
test(was_is_the_value_before_and_its_time, true(Rows == [1-1-0.0, 2-2-0.05, 3-3-0.1])) :-
    forget,
    ends("assign(a, N) <- sense(time, T), N is round(T/0.05) + 1.
          see <- val(a, V), was(a, W, S), N is V - 1, user:assertz(row(N, W-S)), N = 3.",
         [until(see)], _),
    findall(N-W-S, ( row(N, W-S0), S is round(S0*100)/100.0 ), Rows).
test(all_rules_see_the_same_value_of_a_sense, true(Reads == 3)) :-
    forget,
    ends("sense(x, V) <- user:assertz(row(0, x)), user:aggregate_all(count, row(0, x), V).
          assign(a, V) <- sense(x, V).
          assign(b, V) <- sense(x, V).
          set(outB, V) <- sense(x, V).
          end <- val(a, V), val(b, V), V = 3.",
         [until(end)], _),
    aggregate_all(count, row(0, x), Reads).
test(a_program_may_say_what_a_sensor_shows, true(Commands == [outB-210])) :-
    layered(":- use_module(library(ev3dev/layers)).
             sense(us_dist_cm, 20) <- true.
             set(outB, D) <- sense(us_dist_cm, D).",
            ( run_layers([timeout(0.2)]), commands(Commands) )).
test(a_sensor_is_read, true(End == ended)) :-
    ends("far <- sense(us_dist_cm, D), D > 100, sense(us_dist_cm(in1), D).", [until(far)], End).
test(the_pose_is_a_sense, true(Pose == pose(3.0, 4.0, 0.0))) :-
    layered(":- use_module(library(ev3dev/layers)).
             assign(p, P) <- sense(pose, P).",
            ( set_robot(5.6, 10.6, outB, outC), set_pose(3, 4, 0),
              run_layers([timeout(0.2)]),
              why(p, fluent(Pose, _, _)) )).
test(a_motor_gets_a_command_when_its_speed_changes_or_its_rules,
     true(Commands == [outB-210, outB-210, outB-315])) :-
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, 20) <- sense(time, T), T < 0.3.
             set(outB, 20.0) <- sense(time, T), T >= 0.3, T < 0.6.
             set(outB, 10*3) <- sense(time, T), T >= 0.6.",
            ( run_layers([timeout(1)]), commands(Commands) )).
test(the_reason_is_why_it_ended,
     [ forall(member(Until-Reason0, [fail-timeout, (sense(time, T), T > 0.1)-until])),
       true(Reason == Reason0) ]) :-
    layered(":- use_module(library(ev3dev/layers)). assign(a, 1) <- true.",
            run_layers([until(Until), timeout(0.3), reason(Reason)])).
test(the_period_is_the_time_between_two_looks, true(Count == 11)) :-
    forget,
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, 20) <- user:assertz(row(0, x)).",
            run_layers([timeout(1.05), period(0.1)])),
    aggregate_all(count, row(0, x), Count).
test(trace_is_called_at_each_change,
     true(Events == [ assign(a, 1), assign(b, x), set(outB, 20), assign(a, 2), set(outB, 40) ])) :-
    forget,
    layered(":- use_module(library(ev3dev/layers)).
             assign(b, x) <- val(a, _).
             assign(a, 1) <- sense(time, T), T < 0.2.
             assign(a, 2) <- sense(time, T), T >= 0.2.
             set(outB, S) <- val(a, A), S is 20*A.",
            run_layers([timeout(0.4), trace(user:note)])),
    noted_events(Events).

test(the_motors_rest_at_the_end, [forall(member(End, [timeout(0.5), until(sense(time, 0.0))])),
                                  true(Cause == layers(ended))]) :-
    layered(":- use_module(library(ev3dev/layers)). set(outB, 20) <- true.",
            ( run_layers([timeout(0.3)]), run_layers([End]), at_rest,
              why(outB, why(_, tacho_motor(stop, _), [Cause|_])) )).
test(a_fluent_with_arguments_is_assigned_before_anybody_asks,
     true(Rows == [a, b])) :-
    forget,
    ends("assign(seen(X), yes) <- member(X, [a, b]), sense(time, 0.0).
          see <- sense(time, T), T > 0.08, was(seen(X), yes, 0.0), user:assertz(row(0, X)), X = b.",
         [until(see)], _),
    findall(X, row(_, X), Rows).
test(nothing_of_a_time_is_left_and_of_one_run_the_fluents, true(Left == [a, outB])) :-
    ends("assign(a, 1) <- sense(time, _). set(outB, 10) <- true.", _),
    ends("assign(a, 1) <- sense(time, _). set(outB, 10) <- true.", _),
    findall(F,
            (   ev3dev_layers:now_assigned(_, F, _)
            ;   ev3dev_layers:now_sensed(_, F, _)
            ;   ev3dev_layers:fluent(_, F, _, _, _)
            ;   ev3dev_layers:motor(_, F, _, _)
            ),
            Left).
test(one_rule_may_set_another_speed_each_time, true(Commands == [outB-105, outB-210, outB-315])) :-
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, S) <- sense(time, T), S is 10 + 10*round(T/0.05).",
            ( run_layers([timeout(0.12)]), commands(Commands) )).
test(the_view_sees_the_rule_that_sets_a_motor, true(Line == 3)) :-
    forget,
    layered(":- use_module(library(ev3dev/layers)).
             set(outC, 5) <- fail.
             set(outB, 10) <- true.",
            run_layers([timeout(0.1), trace(user:note_line)])),
    noted_events([Line]).
test(other_modules_may_have_facts_of_these_names, true(Printed == [])) :-
    warnings(setup_call_cleanup(
                 open_string("assign(a, 1). set(b, 2). set(X, 3) :- X = 1.", Stream),
                 load_files(unlayered:'other.pl', [stream(Stream)]),
                 close(Stream)), Printed),
    unlayered:assign(a, 1).
test(a_module_with_rules_has_no_such_facts, true(Printed \== [])) :-
    nb_setval(printed, []),
    setup_call_cleanup(
        asserta((user:message_hook(Term, error, _) :- nb_setval(printed, Term)), Ref),
        load(":- use_module(library(ev3dev/layers)). assign(b, 1) <- true. assign(a, 1)."),
        erase(Ref)),
    nb_getval(printed, Printed),
    Printed = error(permission_error(define, predicate, assign(a, 1)), _).
test(an_if_then_else_is_one, true(Commands == [outB-315, outC-52, outB-210])) :-
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, S) <- ( sense(time, T), T < 0.2 -> S = 30 ; S = 20 ).
             set(outC, S) <- ( true -> S = 5 ).
             set(outC, 6) <- ( fail -> true ).",
            ( run_layers([timeout(0.4)]), commands(Commands) )).
test(a_relation_may_call_itself_with_other_arguments, true(V == 3)) :-
    layered(":- use_module(library(ev3dev/layers)).
             sum([], 0) <- true.
             sum([X|Xs], S) <- sum(Xs, S0), S is S0 + X.
             assign(a, S) <- sum([1, 2], S).",
            ( run_layers([timeout(0.1)]), why(a, fluent(V, _, _)) )).
test(predicates_of_prolog_may_ask, true(V == [1, 1, 0.0])) :-
    layered(":- use_module(library(ev3dev/layers)).
             assign(a, 1) <- \\+ was(a, _, _).
             assign(b, L) <- all(L).
             all([V, W, S]) :- val(a, V), ( was(a, W, S) -> true ; W = 1, S = 0.0 ).",
            ( run_layers([timeout(0.2)]), why(b, fluent(V, _, _)) )).
:- end_tests(layers).

:- begin_tests(layers_taken_away).
three(Text) :-
    Text = ":- use_module(library(ev3dev/layers)).
            :- layer(top).
            assign(goal, 40) <- \\+ arrived.
            :- layer(middle).
            speed(S) <- val(goal, S).
            arrived <- sense(time, T), T > 0.5.
            :- layer(bottom).
            set(outB, S) <- speed(S).".

test(each_layer_alone_is_loaded_and_runs,
     [ forall(member(Layers-Expected, [ [top, middle, bottom]-[outB-420], [top, middle]-[],
                                        [top]-[], [bottom]-[], [middle, bottom]-[] ])),
       true(Commands == Expected) ]) :-
    three(Text),
    layered(Text, ( run_layers([timeout(0.2), layers(Layers)]), commands(Commands) )).
test(a_layer_that_does_not_exist, [ true(Formal == existence_error(layer, buttom)) ]) :-
    three(Text),
    layered(Text, catch(run_layers([layers([buttom])]), error(Formal, context(_, Words)), true)),
    says(Words, 'there are: top, middle, bottom. Did you mean bottom?').
test(those_above_load_without_the_file_of_the_lower_one, true(Formal-Printed == none-[])) :-
    warnings(load(":- use_module(library(ev3dev/layers)).
                   assign(goal, 40) <- \\+ was(goal, _, _).
                   speed(S) <- val(goal, S)."), Printed),
    with_sim([], catch(( run_layers([timeout(0.2)]), Formal = none ), error(Formal, _), true)).
test(what_is_asked_of_them_is_missed_at_the_beginning,
     true(End = existence_error(relation, arrived/0)/_)) :-
    ends("assign(goal, 40) <- \\+ arrived.", End).
test(the_name_of_the_file_is_that_of_its_first_layer, true(Layer == program)) :-
    layered(":- use_module(library(ev3dev/layers)). set(outB, 10) <- true.",
            ( run_layers([timeout(0.2)]), last_proof(outB, [by(_, Layer, _)]) )).
test(a_file_that_is_loaded_again_begins_without_a_layer, true(Layer == program)) :-
    three(Text),
    load(Text),
    layered(":- use_module(library(ev3dev/layers)). set(outB, 10) <- true.",
            ( run_layers([timeout(0.2)]), last_proof(outB, [by(_, Layer, _)]) )).
test(a_layer_begins_in_a_file, error(permission_error(begin, layer, a), context(layer/1, _))) :-
    layer(a).
test(a_layer_has_a_name, error(type_error(atom, 7), context(layer/1, _))) :-
    layer(7).
:- end_tests(layers_taken_away).

last_proof(Port, Proof) :-
    journal(Journal),
    last_of(Journal, Port, Proof).

last_of(Journal, Port, Proof) :-
    findall(Proof0,
            ( member(command(_, Port, _, [layers(Proof0)|_]), Journal), is_list(Proof0) ),
            Proofs),
    last(Proofs, Proof).

:- begin_tests(layers_why).
test(why_names_the_layers_with_file_and_line,
     true(Steps == [ by(set(outB, 30), wheels, 9), by(steer(ahead), steering, 7),
                     by(assign(goal, north), places, 3), sense(y, 2) ])) :-
    layered(":- use_module(library(ev3dev/layers)).
:- layer(places).
assign(goal, north) <- \\+ was(goal, _, _).
assign(unused, 1) <- true.
sense(y, 2) <- true.
:- layer(steering).
steer(ahead) <- val(goal, north), sense(y, 2), 1 < 2.
:- layer(wheels).
set(outB, S) <- steer(ahead), S = 30.",
            ( run_layers([timeout(0.5)]), last_proof(outB, Proof) )),
    findall(Step,
            (   member(by(Head, Layer, _:Line), Proof),
                Step = by(Head, Layer, Line)
            ;   member(Step, Proof), Step = sense(_, _)
            ),
            Steps).
test(why_in_words,
     true(Said == "outB runs at 30 %, since 0.00 s: set(outB,30), layer motors (program.pl:4); us_dist_cm is 2.33; speed(30), layer program (program.pl:2)")) :-
    layered(":- use_module(library(ev3dev/layers)).
speed(30) <- true. sense(us_dist_cm, 2.3333) <- true.
:- layer(motors).
set(outB, S) <- sense(us_dist_cm, D), speed(S), D < 3.",
            ( forget, after(0.2, asked(outB)), run_layers([timeout(0.5)]) )),
    noted_events([Said]).
test(why_of_a_fluent, [ true(Said-Why == "goal is 1-2, since 0.00 s: assign(goal,1-2), layer program (program.pl:2)"-(1-2)) ]) :-
    layered(":- use_module(library(ev3dev/layers)).
assign(goal, 1-2) <- \\+ was(goal, _, _).",
            ( forget, run_layers([timeout(0.5)]), asked(goal), why(goal, fluent(Why, _, _)) )),
    noted_events([Said]).
test(the_fluents_of_the_last_run_are_known, [ fail ]) :-
    layered(":- use_module(library(ev3dev/layers)). assign(a, 1) <- true.",
            ( run_layers([timeout(0.2)]), why(a, fluent(1, _, _)) )),
    layered(":- use_module(library(ev3dev/layers)). assign(b, 1) <- true.",
            ( run_layers([timeout(0.2)]), why(b, fluent(1, _, _)), why(a, fluent(_, _, _)) )).
:- end_tests(layers_why).

% What why/1 prints.
asked(What) :-
    setup_call_cleanup(
        asserta((user:message_hook(Term, help, Lines) :-
                     nonvar(Term), Term = ev3dev(_), user:said(Lines)), Ref),
        why(What),
        erase(Ref)).

:- multifile user:message_hook/3.
:- dynamic user:message_hook/3.

said(Lines) :-
    with_output_to(string(Text), print_message_lines(current_output, '', Lines)),
    split_string(Text, "\n", "\n", [Said|_]),
    assertz(noted(Said)).

:- begin_tests(layers_wrong).
% Rules, the error, and words of its message.
wrong("set(outE, 30) <- true.", existence_error(motor, outE), 'there are: outA, outB').
wrong("set(in1, 30) <- true.", existence_error(motor, in1), '(program.pl:2)').
wrong("a <- sense(us_dist, _).", existence_error(sense, us_dist), '(program.pl:2)').
wrong("a <- sense(touhc, _).", existence_error(sense, touhc), 'Did you mean touch?').
wrong("a <- sense(us_dist(in1), _).", existence_error(sense, us_dist(in1)), '').
wrong("a <- ( true ; \\+ ( sense(x, _) -> true ) ).", existence_error(sense, x), '').
wrong("a <- S = xx, sense(S, _). set(outB, 1) <- a.", existence_error(sense, xx), '(program.pl:2)').
wrong("a <- naer. near <- true.", existence_error(relation, naer/0), 'Did you mean near?').
wrong("a <- val(gaol, _). assign(goal, 1) <- true.", existence_error(fluent, gaol), 'Did you mean goal?').
wrong("a <- was(b, _, _).", existence_error(fluent, b), '(program.pl:2)').
wrong("", existence_error(layer, layered), 'Head <- Body').
% They contradict each other.
wrong("set(outB, 30) <- true.\nset(outB, -30) <- sense(time, T), T > 0.1.",
      permission_error(set, motor, outB),
      'set to 30 by layer program (program.pl:2), and at the same time -30 by layer program (program.pl:3)').
wrong("assign(a, 1) <- true.\n:- layer(b).\nassign(a, X) <- member(X, [1, 2]).",
      permission_error(assign, fluent, a),
      'assigned 1 by layer program (program.pl:2), and at the same time 2 by layer b (program.pl:4)').
% They depend on themselves.
wrong("a <- b. b <- \\+ a. set(outB, 30) <- a.", domain_error(acyclic_relation, a), ': a, b, a').
wrong("assign(a, X) <- val(b, X). assign(b, X) <- p(X). p(X) <- val(a, X).",
      domain_error(acyclic_relation, assign(a, _)), ': assign(a,_), assign(b,_), p(_), assign(a,_)').
wrong("sense(s, X) <- sense(s, X). set(outB, X) <- sense(s, X).",
      domain_error(acyclic_relation, sense(s, _)), '').
wrong("assign(f, 1) <- helper. helper :- val(f, _).", domain_error(acyclic_relation, val(f, _)), 'val(f,_)').
% A variable has no value.
wrong("set(outB, 1) <- \\+ was(a, X, _), X = 3. assign(a, 1) <- true.",
      instantiation_error, '\\+was(a,_,_) has no value, in layer program (program.pl:2)').
wrong("set(outB, 1) <- \\+ ( \\+ was(a, X, _) ), X = 3. assign(a, 1) <- true.",
      instantiation_error, '\\+ \\+was(a,_,_) has').
wrong("set(outB, 1) <- \\+ ( was(a, X, _), X < 3 ), X = 3. assign(a, 1) <- true.",
      instantiation_error, '\\+ (was(a,_,_),_<3) has').
wrong("assign(a, _) <- true.", instantiation_error, 'assign(a,_)').
wrong("assign(_, 1) <- true.", instantiation_error, 'assign(_,_)').
wrong("assign(a(1), 1) <- val(a(_), 1).", instantiation_error, 'val(a(_),1)').
wrong("assign(a, 1) <- sense(_, 1).", instantiation_error, 'sense(_,1)').
wrong("sense(s, _) <- true. assign(a, 1) <- sense(s, _).", instantiation_error, 'sense(s,_)').
wrong("set(outB, _) <- true.", instantiation_error, 'set(outB,_)').
wrong("set(_, 4) <- true.", instantiation_error, 'set(_,4)').
% What Prolog says has the rule.
wrong("assign(a, X) <- X is foo + 1.", type_error(evaluable, foo/0), 'in layer program (program.pl:2)').
wrong("set(outB, fast) <- true.", type_error(evaluable, fast/0), 'in layer program (program.pl:2)').
wrong("set(P, 4) <- P = 7.", type_error(atom, 7), 'in layer program').
wrong("set(outB, 4) <- wait(1).", permission_error(wait, guard, layers), 'in layer program').

test(an_error_names_the_rule,
     [ forall(wrong(Rules, Formal, Part)), true(Formal0 =@= Formal) ]) :-
    ends(Rules, End),
    End = Formal0/Words,
    says(Words, Part).
test(nothing_has_moved, true(Commands == [])) :-
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, 50) <- true. a <- naer.",
            ( catch(run_layers([]), error(_, _), true), commands(Commands) )).
test(what_no_motor_can_do_fails, [forall(member(Speed, [130, dps(99999)])), true(End == failed)]) :-
    format(atom(Rules), "set(outB, ~w) <- true.", [Speed]),
    ends(Rules, End).
test(a_motor_that_is_unplugged_ends_it, true(End == failed)) :-
    layered(":- use_module(library(ev3dev/layers)).
             set(outB, S) <- sense(time, T), S is 20 + 100*T.",
            ( sim_at(0.2, sim_unplug(outB)),
              ( run_layers([timeout(0.5)]) -> End = ended ; End = failed ) )).
test(the_option_until_is_checked,
     [ forall(member(Until-Formal, [ naer-existence_error(relation, naer/0),
                                     val(b, _)-existence_error(fluent, b),
                                     _-instantiation_error ])),
       true(Formal0 == Formal) ]) :-
    ends("assign(a, 1) <- true.", [until(Until)], Formal0/_).
test(an_option, [ forall(member(Option-Formal,
                                [ timeout(a)-type_error(evaluable, a/0),
                                  period(-1)-domain_error(positive_number, -1),
                                  period(0)-domain_error(positive_number, 0),
                                  layers(a)-type_error(list, a),
                                  layers([7])-type_error(atom, 7),
                                  trace(7)-type_error(callable, 7),
                                  till(a)-domain_error(control_option, till(a)) ])),
                  true(Formal0 == Formal) ]) :-
    ends("assign(a, 1) <- true.", [Option], Formal0/_).

% Rules that cannot be loaded.
refused((assign(a, 1) :- true), permission_error(define, predicate, assign(a, 1))).
refused(assign(a, 1), permission_error(define, predicate, assign(a, 1))).
refused((set(outB, 1) :- true), permission_error(define, predicate, set(outB, 1))).
refused(set(outB, 1), permission_error(define, predicate, set(outB, 1))).
refused((val(a, 1) <- true), permission_error(define, relation, val/2)).
refused((was(a, 1, _) <- true), permission_error(define, relation, was/3)).
refused((_ < 3 <- true), permission_error(define, relation, (<)/2)).
refused(((a, b) <- true), permission_error(define, relation, (',')/2)).
refused((\+ a <- true), permission_error(define, relation, (\+)/1)).
refused((_ <- true), instantiation_error).
refused((7 <- true), type_error(callable, 7)).
refused((a <- _), instantiation_error).
refused((a <- b, 7), type_error(callable, 7)).
refused((a <- b, !), domain_error(layer_goal, !)).
refused((set(7, 1) <- true), type_error(atom, 7)).

test(a_rule_is_refused, [forall(refused(Rule, Formal)), error(Formal, _)]) :-
    expand_term(Rule, _).
test(what_asks_outside_of_a_run,
     [ forall(member(Goal, [sense(time, _), val(a, _), was(a, _, _)])),
       error(permission_error(ask, layers, none), context(Called, _)) ]) :-
    functor(Goal, Name, Arity),
    Called = Name/Arity,
    call(Goal).
:- end_tests(layers_wrong).

:- begin_tests(three_places).
load_example :-
    load_files(three_places:example(three_places), [if(not_loaded)]).

visited(World, Options, Passed, Collisions) :-
    load_example,
    with_sim([bounds(0, 0, 220, 200), start(30, 30, 0)|World],
             ( three_places:start,
               sim_collisions(Collisions),
               sim_trace(Trace),
               assertion(at_rest) ),
             Options),
    findall(Place,
            ( member(Place, [80-40, 170-90, 60-150]),
              Place = X-Y,
              member(_-pose(X1, Y1, _), Trace),
              sqrt((X - X1)^2 + (Y - Y1)^2) < 8 ),
            Passed0),
    sort(0, @<, Passed0, Passed).

test(three_places_are_visited_in_an_empty_room,
     true(Passed-Collisions == [60-150, 80-40, 170-90]-[])) :-
    visited([], [], Passed, Collisions).
test(it_drives_around_what_is_in_the_way,
     [ forall(member(World, [[box(120, 70, 30, 20)],
                             [box(120, 70, 30, 20), circle(110, 130, 12)]])),
       true(Passed-Collisions == [60-150, 80-40, 170-90]-[]) ]) :-
    visited(World, [], Passed, Collisions).
test(with_noise, [ forall(case(5, Seed)),
                   true(Passed-Collisions == [60-150, 80-40, 170-90]-[]) ]) :-
    visited([box(120, 70, 30, 20)], [noise(true), seed(Seed)], Passed, Collisions).
test(why_names_its_three_layers, true(Layers == [wheels, steering, places])) :-
    load_example,
    with_sim([bounds(0, 0, 220, 200), start(30, 30, 0)],
             ( three_places:start, last_proof(outB, Proof) )),
    findall(Layer, member(by(_, Layer, _), Proof), Layers0),
    list_to_set(Layers0, Layers).
:- end_tests(three_places).
