% The example with everything that is built into the brick.

:- use_module('../support/simulation').
:- use_module('../support/dev', [picture/1]).

:- initialization(load_files(traffic_light:example(traffic_light), [])).

:- begin_tests(traffic_light).
test(shows_each_colour,
     [ forall(member(Color, [red, amber, green])),
       true(Colors-Same == [left-Color, right-Color]-true)
     ]) :-
    atomic_list_concat(['tests/pictures/traffic_', Color, '.png'], File),
    with_sim(room,
             ( traffic_light:show(Color),
               findall(Light-Shown, led(Light, Shown), Colors),
               picture(Drawn),
               screen_clear, screen_image(0, 0, File), screen_show,
               picture(Kept) )),
    (   Drawn == Kept
    ->  Same = true
    ;   Same = false
    ).
test(turns_green_for_who_presses_enter_and_ends_at_another_key,
     true(Seen-Lights == Expected-[off, off])) :-
    with_sim(room,
             ( sim_press(enter, [after(2)]),
               sim_press(left, [after(20)]),
               traffic_light:start,
               findall(Color, led(_, Color), Lights),
               sim_time(End),
               sim_trace(Trace) )),
    End > 20,
    End < 20.2,
    findall(Event,
            ( member(_-Event, Trace),
              ( Event = pressed(_) ; Event = tone(Hertz), Hertz > 0 )
            ),
            Seen),
    Expected = [ pressed(enter), tone(880), tone(1200), tone(1200), tone(1200),
                 tone(1200), tone(1200), pressed(left)
               ].
test(fails_without_a_brick, fail) :-
    ev3_sysfs(tests),
    ev3_dev(tests),
    traffic_light:start.
:- end_tests(traffic_light).
