:- use_module('../support/trees').

% A plain tree with a battery of that name and these files.
powered(Name, Files, Goal) :-
    with_tree(plain, [], ( plug(Name, battery),
                    forall(member(File=Text, Files),
                           put_attribute(Name, File, Text)),
                    once(Goal) )).

% Battery Goal in Tree.
in_tree(Tree, Goal) :-
    on(Tree, ( equip(Tree, ['lego-ev3-battery'-battery]), Goal )).

:- begin_tests(battery).
test(tells_what_it_knows, [forall(tree(Tree))]) :-
    in_tree(Tree, ( battery(voltage, Volts), float(Volts), near(Volts, 7.8, 0.3),
                    battery(current, Amperes), float(Amperes), near(Amperes, 0.18, 0.02),
                    battery(percent, Percent), integer(Percent),
                    Percent > 60, Percent < 95,
                    battery(type, 'Li-ion') )).
test(an_unbound_key_enumerates,
     [forall(tree(Tree)), true(Keys == [voltage, current, percent, type])]) :-
    in_tree(Tree, findall(Key, battery(Key, _), Keys)).
test(a_wrong_value_fails, [forall(tree(Tree)), fail]) :-
    in_tree(Tree, battery(voltage, 1.0)).
test(the_voltage_falls_under_load, [forall(behaving(Tree))]) :-
    in_tree(Tree, ( battery(voltage, Rest),
                    forall(member(Port, [outA, outB, outC]), motor_run(Port, 100)),
                    eventually(( motor_wait(outA, [timeout(0.05)], timeout),
                                 battery(voltage, Load), Load < Rest,
                                 battery(current, Amperes), Amperes > 0.3 )) )).
test(no_battery, [fail]) :-
    with_tree(plain, [], ( battery(voltage, _) ; battery(_, _) )).
test(the_battery_of_another_computer_is_none, [fail]) :-
    powered('BAT0', [], battery(_, _)).
test(an_unknown_key_throws, error(domain_error(battery_key, charge), _)) :-
    powered('lego-ev3-battery', [], battery(charge, _)).
test(a_key_is_an_atom, error(type_error(atom, 7), _)) :-
    powered('lego-ev3-battery', [], battery(7, _)).
test(every_boards_battery_has_a_voltage,
     [ forall(member(Name, [ 'lego-ev3-battery', 'legoev3-battery',
                             'brickpi-battery', 'brickpi3-battery',
                             'pistorms-battery', 'evb-battery' ])),
       true(V == 7.6) ]) :-
    powered(Name, [], battery(voltage, V)).
test(what_a_board_does_not_measure_fails, true(Keys == [voltage-12.2])) :-
    powered('evb-battery', [voltage_now=12200000],
            ( forall(member(File, [current_now, technology]),
                     ( attribute_path('evb-battery', File, Path),
                       delete_file(Path) )),
              findall(K-V, battery(K, V), Keys),
              \+ battery(current, _), \+ battery(percent, _) )).
test(percent_by_the_chemistry,
     [ forall(member(Type-Microvolts-Percent,
                     [ 'Li-ion'-8400000-100, 'Li-ion'-7400000-52,
                       'Li-ion'-6000000-0, 'Li-ion'-0-0,
                       'NiMH'-8100000-100, 'NiMH'-7200000-35,
                       'Unknown'-9000000-100, 'Unknown'-7500000-57,
                       'Unknown'-4500000-0 ])),
       true(P-T == Percent-Type) ]) :-
    powered('lego-ev3-battery', [technology=Type, voltage_now=Microvolts],
            ( battery(percent, P), battery(type, T) )).
test(a_chemistry_of_which_nothing_is_known_fails, [fail]) :-
    powered('lego-ev3-battery', [technology='Pb'], battery(percent, _)).
test(what_is_no_number_throws, error(syntax_error(attribute), _)) :-
    powered('lego-ev3-battery', [voltage_now=much], battery(voltage, _)).
:- end_tests(battery).
