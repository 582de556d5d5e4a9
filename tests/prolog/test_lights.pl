:- use_module('../support/trees').

% The EV3's lights in Tree.
lit(Tree, Goal) :-
    on(Tree, ( equip(Tree, [ 'led0:red:brick-status'-led,
                             'led0:green:brick-status'-led,
                             'led1:red:brick-status'-led,
                             'led1:green:brick-status'-led,
                             'input3::capslock'-led ]),
               led(left, green), led(right, green),
               Goal )).

% A light's files.
brightness(Led, Text) :-
    led_file(Led, brightness, File),
    file_read(File, Text).

led_file(Led, Attribute, File) :-
    ev3_sysfs(Root),
    atomic_list_concat([Root, leds, Led, Attribute], /, File).

% A plain tree with these LEDs.
leds(Names, Goal) :-
    with_tree(plain, [], ( forall(member(Name, Names), plug(Name, led)),
                    once(Goal) )).

% The trigger in a file: in brackets, or, in a plain file, all there is.
chosen(File, Trigger) :-
    file_read(File, Text),
    atomic_list_concat(Words, ' ', Text),
    (   member(Word, Words),
        atom_concat('[', Rest, Word)
    ->  atom_concat(Trigger, ']', Rest)
    ;   Words = [Trigger|_]
    ).

:- begin_tests(led).
test(left_and_right, [forall(tree(Tree)), true(Lights == [left, right])]) :-
    lit(Tree, findall(L, led(L), Lights)).
test(a_light_is_there_or_not, [forall(tree(Tree))]) :-
    lit(Tree, ( led(left), \+ led(up), \+ led(outA) )).
test(a_colour_is_made_of_red_and_green,
     [ forall(( tree(Tree),
                member(Color-Red-Green,
                       [ off-0-0, red-255-0, green-0-255, amber-255-255,
                         orange-255-128, yellow-26-255,
                         levels(20, 40)-51-102, levels(100, 0)-255-0,
                         levels(10*2, 80/2)-51-102 ]) )),
       true(R-G == Red-Green) ]) :-
    lit(Tree, ( led(left, Color),
                brightness('led0:red:brick-status', R),
                brightness('led0:green:brick-status', G) )).
test(the_other_light_stays_as_it_is, [forall(tree(Tree)), true(C == green)]) :-
    lit(Tree, ( led(left, red), led(right, C) )).
test(what_was_set_is_read,
     [ forall(( tree(Tree),
                member(Color, [off, red, green, amber, orange, yellow,
                                levels(20, 40), levels(1, 99)]) )),
       true(C == Color) ]) :-
    lit(Tree, ( led(right, Color), led(right, C) )).
test(levels_that_have_a_name_are_read_as_that,
     [forall(tree(Tree)), true(C == orange)]) :-
    lit(Tree, ( led(right, levels(100, 50)), led(right, C) )).
test(an_unbound_side_enumerates,
     [forall(tree(Tree)), true(Cs == [left-red, right-green])]) :-
    lit(Tree, ( led(left, red), findall(L-C, led(L, C), Cs) )).
test(a_colour_that_the_light_does_not_have_fails_and_changes_nothing,
     [forall(tree(Tree)), true(C == green)]) :-
    lit(Tree, ( \+ led(left, blue), \+ led(left, 50), \+ led(left, on),
                \+ led(left, levels(0, 0, 1)), led(left, C) )).
test(an_absent_light_fails, [forall(tree(Tree)), fail]) :-
    lit(Tree, led(up, red)).
test(no_lights_at_all, [fail]) :-
    with_tree(plain, [], ( led(_) ; led(_, _) ; led(left, red) )).
test(what_is_no_colour_throws_and_changes_nothing,
     [ forall(member(Color-Error,
                     [ pink-domain_error(led_color, pink),
                       levels(101, 0)-domain_error(led_color, 101),
                       levels(0, -1)-domain_error(led_color, -1),
                       levels(red, 0)-type_error(evaluable, red/0),
                       levels(_, 0)-instantiation_error,
                       levels(1)-domain_error(led_color, levels(1)),
                       -1-domain_error(led_color, -1),
                       "pink"-domain_error(led_color, pink),
                       f(x)-domain_error(led_color, f(x)) ])),
       true(E-W == caught-[]) ]) :-
    leds(['led0:red:brick-status', 'led0:green:brick-status'],
         ( catch(led(left, Color), error(Error, _), E = caught),
           written(W) )).
test(an_unbound_light_cannot_be_set, error(instantiation_error, _)) :-
    leds(['led0:red:brick-status'], led(_, red)).
test(a_light_is_an_atom, error(type_error(_, 7), _)) :-
    leds(['led0:red:brick-status'], led(7, _)).
test(a_light_that_something_else_switches_is_ours_then,
     [forall(tree(Tree)), true(T-C == none-red)]) :-
    lit(Tree, ( led_trigger(left, heartbeat), led(left, red),
                led_trigger(left, T), led(left, C) )).

% Other boards

test(jessie,
     true(Cs-B == [left-off, right-amber]-'255')) :-
    leds([ 'ev3:left:red:ev3dev', 'ev3:left:green:ev3dev',
           'ev3:right:red:ev3dev', 'ev3:right:green:ev3dev' ],
         ( led(right, amber), findall(L-C, led(L, C), Cs),
           get_attribute('ev3:right:green:ev3dev', brightness, B) )).
test(brick_pi,
     [ forall(member(L1-L2, [ 'led1:blue:brick-status'-'led2:blue:brick-status',
                              'brickpi:led1:blue:ev3dev'-'brickpi:led2:blue:ev3dev' ])),
       true(Cs-R == [left-blue, right-40]-'102') ]) :-
    leds([L2, L1],
         ( led(left, blue), led(right, 40), findall(L-C, led(L, C), Cs),
           \+ led(left, red), get_attribute(L2, brightness, R) )).
test(brick_pi_3, true(Cs-B == [left-amber]-'100')) :-
    leds(['led1:amber:brick-status'],
         ( put_attribute('led1:amber:brick-status', max_brightness, 100),
           led(left, amber), findall(L-C, led(L, C), Cs),
           get_attribute('led1:amber:brick-status', brightness, B) )).
test(pi_storms, true(Cs == [left-levels(100, 0, 50), right-blue])) :-
    leds([ 'pistorms:BA:red:brick-status', 'pistorms:BA:green:brick-status',
           'pistorms:BA:blue:brick-status', 'pistorms:BB:red:brick-status',
           'pistorms:BB:green:brick-status', 'pistorms:BB:blue:brick-status' ],
         ( led(left, levels(100, 0, 50)), led(right, blue),
           get_attribute('pistorms:BB:red:brick-status', brightness, '255'),
           findall(L-C, led(L, C), Cs) )).
test(a_lamp_on_a_port_is_a_light,
     [forall(tree(Tree)), true(Cs == [off, 40, on])]) :-
    on(Tree, ( ( Tree == plain
               ->  plug('ev3-ports:outD::brick-status', led),
                   put_attribute('ev3-ports:outD::brick-status',
                                 max_brightness, 100)
               ;   port_mode(outD, led) ),
               led(outD, C1), led(outD, 40), led('ev3-ports:outD', C2),
               led(outD, on), led(outD, C3), \+ led(outD, red),
               findall(L, led(L), Ls), last(Ls, outD),
               Cs = [C1, C2, C3] )).
test(a_lamp_on_a_port_lights_the_world, [forall(behaving(Tree))]) :-
    on(Tree, ( sim_add(lamp(60, 120, 12, outD)), sim_place(60, 70, 30),
               port_mode(outD, led),
               col_ambient(in2, Dark), Dark < 5,
               led(outD, on), sim_step(0.05), col_ambient(in2, Lit),
               Lit > Dark + 20,
               led(outD, 50), sim_step(0.05), col_ambient(in2, Half),
               Half > Dark + 10, Half < Lit - 10 )).

test(a_lamp_on_a_port_in_a_world, true(Dark-Half-Lit == 0-24-48)) :-
    with_sim([ start(0, 0, 30), ambient(0), lamp(0, 50, 12, outD) ],
             ( port_mode('ev3-ports:outD', 'dc-motor'),
               col_ambient(in2, Dark),
               dc_motor_run(outD, -50), sim_step(0.2), col_ambient(in2, Half),
               dc_motor_run(outD, 100), sim_step(0.2), col_ambient(in2, Lit) )).
test(a_lamp_needs_an_output_port,
     [ forall(member(Port-Error, [ in1-domain_error(possible_geometry, _),
                                   outE-domain_error(port, outE),
                                   _-instantiation_error ])),
       error(Error, _) ]) :-
    with_sim(room, sim_add(lamp(10, 10, 12, Port))).
:- end_tests(led).

:- begin_tests(led_trigger).
test(none_at_first, [forall(tree(Tree)), true(Ts == [left-none, right-none])]) :-
    lit(Tree, findall(L-T, led_trigger(L, T), Ts)).
test(what_there_is, [forall(tree(Tree))]) :-
    lit(Tree, ( led_triggers(left, Triggers),
                forall(member(T, [none, timer, heartbeat, 'default-on']),
                       memberchk(T, Triggers)) )).
test(the_light_keeps_its_colour,
     [forall(tree(Tree)), true(Ts == heartbeat-none)]) :-
    lit(Tree, ( led(left, red), led_trigger(left, heartbeat),
                led_file('led0:red:brick-status', trigger, Red),
                led_file('led0:green:brick-status', trigger, Green),
                chosen(Red, R), chosen(Green, G), Ts = R-G )).
test(a_light_that_is_off_gets_it_as_a_whole,
     [forall(tree(Tree)), true(Ts == timer-timer)]) :-
    lit(Tree, ( led(left, off), led_trigger(left, timer),
                led_file('led0:red:brick-status', trigger, Red),
                led_file('led0:green:brick-status', trigger, Green),
                chosen(Red, R), chosen(Green, G), Ts = R-G )).
test(what_was_set_is_read, [forall(tree(Tree)), true(T == heartbeat)]) :-
    lit(Tree, ( led_trigger(right, heartbeat), led_trigger(right, T) )).
test(none_puts_it_out, [forall(behaving(Tree)), true(C == off)]) :-
    lit(Tree, ( led_trigger(right, heartbeat), led_trigger(right, none),
                led(right, C) )).
test(an_unknown_one_throws,
     [forall(behaving(Tree)), error(domain_error(trigger, jump), _)]) :-
    lit(Tree, led_trigger(left, jump)).
test(an_absent_light_fails, [forall(tree(Tree)), fail]) :-
    lit(Tree, ( led_trigger(up, none) ; led_trigger(up, _) ; led_triggers(up, _) )).
test(a_trigger_is_an_atom, error(type_error(atom, 7), _)) :-
    leds(['led0:red:brick-status'], led_trigger(left, 7)).
test(an_unbound_light_cannot_be_set, error(instantiation_error, _)) :-
    leds(['led0:red:brick-status'], led_trigger(_, none)).
:- end_tests(led_trigger).

:- begin_tests(led_blink).
test(blinks, [forall(behaving(Tree)), true(T-On-Off == timer-200-800)]) :-
    lit(Tree, ( led(left, red), led_blink(left, 200, 800),
                led_trigger(left, T), led_blink(left, On, Off),
                led_file('led0:red:brick-status', delay_off, File),
                file_read(File, 800) )).
test(the_files_may_come_later, true(On-Off == '200'-'800')) :-
    leds(['led0:red:brick-status'],
         ( led_file('led0:red:brick-status', delay_on, File),
           meanwhile(( eventually(get_attribute('led0:red:brick-status', trigger, timer)),
                       put_attribute('led0:red:brick-status', delay_on, 500),
                       put_attribute('led0:red:brick-status', delay_off, 500),
                       eventually(file_read(File, 200)) ),
                     led_blink(left, 200, 800)),
           get_attribute('led0:red:brick-status', delay_on, On),
           get_attribute('led0:red:brick-status', delay_off, Off) )).
test(can_blink_again_at_another_pace, [forall(behaving(Tree)), true(On == 50)]) :-
    lit(Tree, ( led_blink(left, 200, 800), led(left, off),
                led_blink(left, 50, 60), led_blink(left, On, _) )).
test(the_pace_of_a_light_that_blinks_can_be_changed_and_its_colour_stays,
     [forall(behaving(Tree)), true(C-On == orange-50)]) :-
    lit(Tree, ( led(left, orange), led_blink(left, 200, 800),
                led_blink(left, 50, 60), led_blink(left, On, _), led(left, C) )).
test(a_light_that_does_not_blink_fails, [forall(tree(Tree)), fail]) :-
    lit(Tree, led_blink(left, _, _)).
test(a_colour_ends_it, forall(behaving(Tree))) :-
    lit(Tree, ( led_blink(left, 200, 800), led(left, red),
                \+ led_blink(left, _, _) )).
test(an_absent_light_fails, [forall(tree(Tree)), fail]) :-
    lit(Tree, led_blink(up, 100, 100)).
test(files_that_never_come_throw, error(existence_error(file, _), _)) :-
    leds(['led0:red:brick-status'], led_blink(left, 200, 800)).
test(what_is_no_time_throws_and_changes_nothing,
     [ forall(member(Times-Error,
                     [ 0/5-domain_error(milliseconds, 0),
                       5/(-1)-domain_error(milliseconds, -1),
                       5/_-instantiation_error, _/5-instantiation_error,
                       5/long-type_error(integer, long),
                       0.5/5-type_error(integer, 0.5) ])),
       true(E-W == caught-[]) ]) :-
    leds(['led0:red:brick-status'],
         ( Times = On/Off,
           catch(led_blink(left, On, Off), error(Error, _), E = caught),
           written(W) )).
test(an_unbound_light_cannot_be_set, error(instantiation_error, _)) :-
    leds(['led0:red:brick-status'], led_blink(_, 100, 100)).
:- end_tests(led_blink).
