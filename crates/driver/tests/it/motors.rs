//! Commands, moves of several motors at once, and what stops them.
use crate::brick::{Brick, motors, ms};
use crate::files::PlainTree;
use ev3_driver::Class;
use ev3_driver::motor::wait::{Reason, wait_for};
use ev3_driver::motor::{
    Extent, Move, MoveOptions, Run, Speed, StopAction, command, measured, reset, run_forever,
    run_one, run_to, stop, stop_all, stop_connected, stop_started,
};
use ev3_driver::{Errno, Error, attributes};
use std::fs;
use std::sync::Arc;
use std::time::Duration;

fn run(port: &str, percent: f64) -> Run<'_> {
    Run { port, speed: Speed::Percent(percent) }
}

fn turn(port: &str, percent: f64, degrees: f64) -> Move<'_> {
    Move { port, speed: Speed::Percent(percent), extent: Extent::By(degrees) }
}

fn position(brick: &Brick, port: &str) -> i64 {
    brick.world().motor(port).counts()
}

fn is_powered(brick: &Brick, port: &str) -> bool {
    brick.world().motor(port).is_powered()
}

fn assert_near(position: i64, expected: i64) {
    assert!((position - expected).abs() <= 5, "at {position} instead of {expected}");
}

#[test]
fn all_motors_get_their_speeds_before_the_first_starts() {
    let brick = Brick::new(&["outB", "outC"]);
    assert!(
        run_forever(&brick.devices(), &[run("outB", 50.0), run("outC", -50.0)], &mut || false)
            .unwrap()
            .is_some()
    );
    let expected = [
        "outB speed_sp 525",
        "outC speed_sp -525",
        "outB command run-forever",
        "outC command run-forever",
    ];
    assert_eq!(brick.take_written(), expected);
}

#[test]
fn motors_that_cannot_all_run_as_asked_are_left_alone() {
    let (brick, devices) = Brick::with_devices(&["outB", "outC"]);
    for impossible in [run("outA", 50.0), run("outC", 101.0), run("outC", f64::NAN)] {
        assert!(
            run_forever(&devices, &[run("outB", 50.0), impossible], &mut || false)
                .unwrap()
                .is_none()
        );
    }
    let too_fast = Run { port: "outC", speed: Speed::CountsPerSecond(-1051) };
    assert!(
        run_forever(&devices, &[run("outB", 50.0), too_fast], &mut || false).unwrap().is_none()
    );
    assert!(run_forever(&devices, &[], &mut || false).unwrap().is_some());
    assert!(brick.take_written().is_empty());
}

#[test]
fn a_speed_in_percent_is_rounded_down_to_whole_counts() {
    let devices = Brick::new(&["outA"]).devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    let counts = |speed: Speed| speed.in_counts(&motor).unwrap();
    for (percent, expected) in [
        (100.0, Some(1050)),
        (-100.0, Some(-1050)),
        (0.0, Some(0)),
        (1.0, Some(10)),
        (-1.0, Some(-11)),
        (0.01, Some(0)),
        (100.1, None),
        (f64::INFINITY, None),
        (f64::NAN, None),
    ] {
        assert_eq!(counts(Speed::Percent(percent)), expected, "{percent} %");
    }
    for (speed, expected) in [(1050, true), (-1050, true), (1051, false), (i64::MIN, false)] {
        let expected = expected.then_some(speed);
        assert_eq!(counts(Speed::CountsPerSecond(speed)), expected);
    }
}

#[test]
fn a_percentage_is_not_off_by_one_for_want_of_a_binary_fraction() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").max_speed = 1560;
    let devices = brick.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    for percent in -100_i32..=100 {
        let expected = (i64::from(percent) * 1560).div_euclid(100);
        let counts = Speed::Percent(f64::from(percent)).in_counts(&motor).unwrap();
        assert_eq!(counts, Some(expected), "{percent} %");
    }
}

#[test]
fn a_motor_that_cannot_start_stops_those_that_did() {
    let brick = Brick::new(&["outB", "outC"]);
    brick.world().motor("outC").refuses.push(("command", Errno::IO));
    let devices = brick.devices();
    let error = run_forever(&devices, &[run("outB", 50.0), run("outC", 50.0)], &mut || false)
        .err()
        .unwrap();
    assert_eq!(error.errno(), Some(Errno::IO));
    assert!(brick.world().motor("outB").is_braking());
}

#[test]
fn a_motor_replugged_since_the_last_look_is_found_under_its_new_number() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    assert!(run_forever(&devices, &[run("outA", 50.0)], &mut || false).unwrap().is_some());
    brick.world().motor("outA").is_unplugged = true;
    brick.world().plug_motor("outA");
    assert!(run_forever(&devices, &[run("outA", 25.0)], &mut || false).unwrap().is_some());
    assert_eq!(brick.world().motor("outA").speed_sp, 262);
    assert!(is_powered(&brick, "outA"));
}

#[test]
fn a_move_writes_all_set_points_then_the_commands() {
    let (brick, devices) = Brick::with_devices(&["outB", "outC"]);
    let options = MoveOptions { wait: false, ..MoveOptions::default() };
    let moves = [turn("outB", 50.0, 90.0), turn("ev3-ports:outC", 20.0, -90.0)];
    let reason = run_to(&devices, &moves, &options, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Some(Reason::Reached));
    let written = brick.take_written();
    let (set_points, commands) = written.split_at(written.len() - 2);
    assert!(!set_points.iter().any(|line| line.contains(" command run")), "{written:?}");
    for (line, port) in commands.iter().zip(["outB", "outC"]) {
        assert!(line.starts_with(&format!("{port} command run-to-rel-pos")), "{written:?}");
    }
    for line in ["outB speed_sp 525", "outC speed_sp 210", "outB stop_action hold"] {
        assert!(set_points.iter().any(|written| written == line), "{line} in {written:?}");
    }
}

#[test]
fn a_move_takes_the_motors_to_the_angle_and_holds_them_there() {
    let (brick, devices) = Brick::with_devices(&["outB", "outC"]);
    let moves = [turn("outB", 50.0, 360.0), turn("outC", 25.0, 180.0)];
    let reason = run_to(&devices, &moves, &MoveOptions::default(), &mut brick.attentive()).unwrap();
    assert_eq!(reason, Some(Reason::Reached));
    brick.pass(ms(500));
    assert_near(position(&brick, "outB"), 360);
    assert_near(position(&brick, "outC"), 180);
    assert!(is_powered(&brick, "outB") && is_powered(&brick, "outC"));
}

#[test]
fn the_signs_of_speed_and_angle_make_the_direction() {
    for (percent, degrees, expected) in
        [(50.0, 90.0, 90), (50.0, -90.0, -90), (-50.0, 90.0, -90), (-50.0, -90.0, 90)]
    {
        let brick = Brick::new(&["outA"]);
        let moves = [turn("outA", percent, degrees)];
        let options = MoveOptions::default();
        run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap().unwrap();
        brick.pass(ms(500));
        assert_near(position(&brick, "outA"), expected);
    }
}

#[test]
fn an_angle_is_converted_by_the_counts_of_a_rotation() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").count_per_rot = 720;
    let options = MoveOptions::default();
    let moves = [turn("outA", 50.0, 45.0)];
    run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap().unwrap();
    brick.pass(ms(500));
    assert_near(position(&brick, "outA"), 90);
}

#[test]
fn a_motor_without_counts_is_an_error_and_no_number() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").count_per_rot = 0;
    let found = motors(&brick.devices(), &["outA"]);
    let error = measured(&found[0], "position").unwrap_err();
    assert!(error.to_string().contains("count_per_rot holds \"0\""), "{error}");
}

#[test]
fn an_impossible_move_writes_nothing() {
    let (brick, devices) = Brick::with_devices(&["outB", "outC"]);
    for impossible in [
        turn("outA", 50.0, 90.0),
        turn("outC", 0.0, 90.0),
        turn("outC", 101.0, 90.0),
        turn("outC", f64::NAN, 90.0),
        turn("outC", 50.0, f64::NAN),
        turn("outC", 50.0, f64::INFINITY),
        turn("outC", 50.0, 3e9),
    ] {
        let moves = [turn("outB", 50.0, 90.0), impossible];
        let options = MoveOptions { ramp_up_ms: Some(100), ..MoveOptions::default() };
        let reason = run_to(&devices, &moves, &options, &mut brick.attentive()).unwrap();
        assert_eq!(reason, None);
    }
    assert!(brick.take_written().is_empty());
}

#[test]
fn a_move_by_nothing_is_over_at_once() {
    let brick = Brick::new(&["outA"]);
    let moves = [turn("outA", 50.0, 0.0)];
    let options = MoveOptions::default();
    let reason = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Some(Reason::Reached));
    assert!(brick.world().motor("outA").counts() == 0);
}

#[test]
fn a_move_stops_as_its_options_say() {
    for action in [StopAction::Coast, StopAction::Brake, StopAction::Hold] {
        let brick = Brick::new(&["outA"]);
        let options = MoveOptions { stop_action: action, ..MoveOptions::default() };
        let moves = [turn("outA", 50.0, 90.0)];
        run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap().unwrap();
        brick.pass(ms(50));
        let mut world = brick.world();
        let motor = world.motor("outA");
        assert_eq!(motor.stop_action, action.word());
        assert_eq!(motor.is_powered(), action == StopAction::Hold);
        assert_eq!(motor.is_braking(), action == StopAction::Brake);
    }
}

#[test]
fn ramps_are_those_of_one_move() {
    let brick = Brick::new(&["outB", "outC"]);
    for (port, ramp) in [("outB", 300), ("outC", 400)] {
        let mut world = brick.world();
        (world.motor(port).ramp_up_sp, world.motor(port).ramp_down_sp) = (ramp, ramp + 1);
    }
    let options = MoveOptions {
        ramp_up_ms: Some(100),
        ramp_down_ms: Some(200),
        wait: false,
        ..MoveOptions::default()
    };
    let moves = [turn("outB", 50.0, 90.0), turn("outC", 50.0, 90.0)];
    run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap().unwrap();
    let written = brick.take_written();
    let at = |line: &str| written.iter().position(|one| one == line).expect(line);
    let first_command = written.iter().position(|line| line.contains("command run")).unwrap();
    for line in ["outB ramp_up_sp 100", "outC ramp_down_sp 200"] {
        assert!(at(line) < first_command);
    }
    for line in ["outB ramp_up_sp 300", "outC ramp_down_sp 401"] {
        assert!(at(line) > first_command + 1);
    }
}

#[test]
fn ramps_are_put_back_when_a_move_cannot_start() {
    for refused in ["command", "ramp_up_sp"] {
        let brick = Brick::new(&["outB", "outC"]);
        brick.world().motor("outB").ramp_up_sp = 300;
        brick.world().motor("outC").refuses.push((refused, Errno::IO));
        let options = MoveOptions { ramp_up_ms: Some(100), ..MoveOptions::default() };
        let moves = [turn("outB", 50.0, 90.0), turn("outC", 50.0, 90.0)];
        let error = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap_err();
        assert_eq!(error.errno(), Some(Errno::IO));
        assert_eq!(brick.world().motor("outB").ramp_up_sp, 300, "{refused} was refused");
        assert!(!is_powered(&brick, "outB"));
    }
}

#[test]
fn a_motor_named_twice_is_refused_and_nothing_is_written() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    let asked = &mut brick.attentive();
    let moves = [turn("outA", 50.0, 90.0), turn("outB", 5.0, 9.0), turn("outA", 50.0, 90.0)];
    let error = run_to(&devices, &moves, &MoveOptions::default(), asked).unwrap_err();
    assert_eq!(error.to_string(), "outA is named twice");
    let runs = [run("outB", 50.0), run("ev3-ports:outB", 20.0)];
    let error = run_forever(&devices, &runs, asked).err().unwrap();
    assert!(matches!(error, Error::DuplicatePort { port } if port == "outB"));
    assert!(brick.take_written().is_empty());
}

#[test]
fn a_move_that_takes_too_long_is_stopped() {
    let brick = Brick::new(&["outB", "outC"]);
    let options = MoveOptions { timeout: Some(ms(200)), ..MoveOptions::default() };
    let moves = [turn("outB", 50.0, 9000.0), turn("outC", 50.0, 9000.0)];
    let reason = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Some(Reason::Timeout));
    assert!(brick.world().motor("outB").is_braking());
    assert!(brick.world().motor("outC").is_braking());
}

#[test]
fn an_interrupted_move_stops_all_its_motors() {
    let brick = Brick::new(&["outB", "outC"]);
    let moves = [turn("outB", 50.0, 9000.0), turn("outC", 50.0, 9000.0)];
    let options = MoveOptions::default();
    let interrupt = &mut brick.interrupting(ms(100));
    let error = run_to(&brick.devices(), &moves, &options, interrupt).unwrap_err();
    assert!(matches!(error, Error::Interrupted));
    assert!(brick.world().motor("outB").is_braking());
    assert!(brick.world().motor("outC").is_braking());
}

#[test]
fn a_motor_that_vanishes_stops_the_others_and_is_named() {
    for vanishing in ["outB", "outC"] {
        let brick = Brick::new(&["outB", "outC"]);
        let other = if vanishing == "outB" { "outC" } else { "outB" };
        brick.at(ms(333), move |world| world.motor(vanishing).is_unplugged = true);
        let moves = [turn("outB", 50.0, 9000.0), turn("outC", 50.0, 9000.0)];
        let options = MoveOptions::default();
        let error = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap_err();
        let message = error.to_string();
        let Error::Unplugged { class: Class::TachoMotor, port } = error else { panic!("{error}") };
        assert_eq!(port, vanishing);
        assert_eq!(message, format!("the motor at {vanishing} was unplugged"));
        assert!(brick.world().motor(other).is_braking());
    }
}

#[test]
fn a_motor_that_is_replugged_within_a_move_is_gone_all_the_same() {
    let brick = Brick::new(&["outA"]);
    brick.at(ms(333), |world| {
        world.motor("outA").is_unplugged = true;
        world.plug_motor("outA");
    });
    let moves = [turn("outA", 50.0, 9000.0)];
    let options = MoveOptions::default();
    let error = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap_err();
    assert!(matches!(error, Error::Unplugged { port, .. } if port == "outA"));
}

#[test]
fn a_blocked_motor_stops_the_move_of_all() {
    let brick = Brick::new(&["outB", "outC"]);
    brick.at(ms(300), |world| world.motor("outC").is_blocked = true);
    let moves = [turn("outB", 50.0, 9000.0), turn("outC", 50.0, 9000.0)];
    let options = MoveOptions::default();
    let reason = run_to(&brick.devices(), &moves, &options, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Some(Reason::Stalled));
    assert!(brick.world().motor("outB").is_braking());
    assert!(brick.now() < ms(700), "noticed at {:?}", brick.now());
}

#[test]
fn moves_add_up_whatever_went_on_in_between() {
    // An old kernel counts a move from where the motor is, a newer one from
    // where the last one was to end.
    for is_jessie in [false, true] {
        let brick = Brick::new(&["outA"]);
        brick.world().motor("outA").is_jessie = is_jessie;
        let devices = brick.devices();
        let turn_by = |degrees, wait| {
            let options = MoveOptions { wait, ..MoveOptions::default() };
            let moves = [turn("outA", 50.0, degrees)];
            run_to(&devices, &moves, &options, &mut brick.attentive()).unwrap().unwrap()
        };
        for _ in 0..4 {
            assert_eq!(turn_by(90.0, true), Reason::Reached);
        }
        brick.pass(ms(500));
        assert_near(position(&brick, "outA"), 360);
        // Under way, back again.
        turn_by(360.0, false);
        brick.pass(ms(300));
        let from = position(&brick, "outA");
        assert!(from < 600);
        assert_eq!(turn_by(-360.0, true), Reason::Reached);
        brick.pass(ms(500));
        assert_near(position(&brick, "outA"), from - 360);
    }
}

#[test]
fn a_new_zero_does_not_change_how_far_the_next_move_goes() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let options = MoveOptions { stop_action: StopAction::Coast, ..MoveOptions::default() };
    let moves = [turn("outA", 20.0, 360.0)];
    run_to(&devices, &moves, &options, &mut brick.attentive()).unwrap().unwrap();
    brick.pass(ms(1000));
    devices.with(Class::TachoMotor, "outA", |motor| motor.write("position", "0")).unwrap();
    let options = MoveOptions::default();
    assert_eq!(
        run_to(&devices, &moves, &options, &mut brick.attentive()).unwrap(),
        Some(Reason::Reached)
    );
    brick.pass(ms(1000));
    assert_near(position(&brick, "outA"), 360);
}

#[test]
fn a_motor_is_stopped_even_if_it_has_not_the_action_asked_for() {
    // The BrickPi's motors cannot brake.
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").stop_actions = &["coast", "hold"];
    let devices = brick.devices();
    run_forever(&devices, &[run("outA", 50.0)], &mut || false).unwrap();
    let all = motors(&devices, &["outA"]);
    let stopped = stop(&all[0], StopAction::Brake);
    assert_eq!(stopped.unwrap_err().errno(), Some(Errno::INVAL));
    assert!(!is_powered(&brick, "outA"));
    run_forever(&devices, &[run("outA", 50.0)], &mut || false).unwrap();
    stop_all(&all, StopAction::Brake).unwrap();
    assert!(!is_powered(&brick, "outA"));
    run_forever(&devices, &[run("outA", 50.0)], &mut || false).unwrap();
    stop_started(&devices).unwrap();
    assert!(!is_powered(&brick, "outA"));
}

#[test]
fn one_motor_that_fails_does_not_keep_the_others_from_being_stopped() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB", "outC"]);
    let runs = ["outA", "outB", "outC"].map(|port| run(port, 50.0));
    run_forever(&devices, &runs, &mut || false).unwrap();
    brick.world().motor("outB").refuses.push(("command", Errno::IO));
    let error = stop_all(&motors(&devices, &["outA", "outB", "outC"]), StopAction::Brake);
    assert_eq!(error.unwrap_err().errno(), Some(Errno::IO));
    assert!(!is_powered(&brick, "outA") && !is_powered(&brick, "outC"));
}

#[test]
fn one_that_udev_has_not_opened_is_stopped_once_it_has_and_the_others_at_once() {
    let brick = Brick::new(&["outA", "outB", "outC"]);
    let runs = ["outA", "outC"].map(|port| run(port, 50.0));
    run_forever(&brick.devices(), &runs, &mut || false).unwrap();
    brick.world().motor("outA").closed_until = ms(300);
    brick.take_written();
    stop_connected(&brick.devices(), &mut brick.attentive()).unwrap();
    assert!(brick.now() >= ms(300) && brick.now() < ms(360), "{:?}", brick.now());
    let commands: Vec<_> =
        brick.take_written().into_iter().filter(|line| line.contains("command")).collect();
    assert_eq!(commands, ["outB command stop", "outC command stop", "outA command stop"]);
}

#[test]
fn one_that_udev_never_opens_is_an_error_after_a_second() {
    let brick = Brick::new(&["outA", "outB"]);
    run_forever(&brick.devices(), &[run("outB", 50.0)], &mut || false).unwrap();
    brick.world().motor("outA").closed_until = Duration::MAX;
    let stopped = stop_connected(&brick.devices(), &mut brick.attentive());
    assert_eq!(stopped.unwrap_err().errno(), Some(Errno::ACCESS));
    assert!(!is_powered(&brick, "outB"));
}

#[test]
fn a_motor_that_is_gone_needs_no_stop() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    run_forever(&devices, &[run("outA", 50.0), run("outB", 50.0)], &mut || false).unwrap();
    let all = motors(&devices, &["outA", "outB"]);
    brick.world().motor("outA").is_unplugged = true;
    stop_all(&all, StopAction::Brake).unwrap();
    assert!(brick.world().motor("outB").is_braking());
}

#[test]
fn what_was_started_and_only_that_is_stopped_at_the_end() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB", "outC", "outD"]);
    let all = motors(&devices, &["outA", "outB", "outC", "outD"]);
    run_forever(&devices, &[run("outA", 50.0), run("outB", 50.0)], &mut || false).unwrap();
    stop(&all[1], StopAction::Coast).unwrap();
    let write = |name, text| {
        attributes::write(&devices, Class::TachoMotor, "outC", name, text, &mut || false)
    };
    write("speed_sp", "100").unwrap();
    write("command", "run-forever").unwrap();
    brick.take_written();
    stop_started(&devices).unwrap();
    let stopped: Vec<_> =
        brick.take_written().into_iter().filter(|line| line.ends_with("command stop")).collect();
    assert_eq!(stopped, ["outA command stop", "outC command stop"]);
    stop_started(&devices).unwrap();
    assert!(brick.take_written().is_empty(), "nothing is left to stop");
}

#[test]
fn a_reset_motor_need_not_be_stopped_and_a_gone_one_cannot() {
    let (brick, devices) = Brick::with_devices(&["outA", "outB"]);
    run_forever(&devices, &[run("outA", 50.0), run("outB", 50.0)], &mut || false).unwrap();
    reset(&motors(&devices, &["outA"])[0]).unwrap();
    brick.world().motor("outB").is_unplugged = true;
    brick.take_written();
    stop_started(&devices).unwrap();
    assert!(brick.take_written().is_empty());
}

#[test]
fn a_motor_that_could_not_be_stopped_is_tried_again() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    run_forever(&devices, &[run("outA", 50.0)], &mut || false).unwrap();
    brick.world().motor("outA").refuses.push(("command", Errno::IO));
    stop_started(&devices).unwrap_err();
    brick.world().motor("outA").refuses.clear();
    stop_started(&devices).unwrap();
    assert!(!is_powered(&brick, "outA"));
}

#[test]
fn an_unknown_command_is_the_kernels_to_refuse() {
    let devices = Brick::new(&["outA"]).devices();
    let error = command(&motors(&devices, &["outA"])[0], "fly").unwrap_err();
    assert_eq!(error.errno(), Some(Errno::INVAL));
}

#[test]
fn a_wait_knows_the_end_of_a_command_that_was_given_by_hand() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let all = motors(&devices, &["outA"]);
    for (set_point, number, word) in
        [("position_sp", "300", "run-to-abs-pos"), ("time_sp", "400", "run-timed")]
    {
        all[0].write("speed_sp", "500").unwrap();
        all[0].write(set_point, number).unwrap();
        command(&all[0], word).unwrap();
        let started = brick.now();
        let reason = wait_for(&devices, &all, None, &mut brick.attentive()).unwrap();
        assert_eq!(reason, Reason::Reached, "{word}");
        assert!(brick.since(started) < ms(800));
    }
}

#[test]
fn a_wait_knows_where_a_relative_command_counts_from() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let all = motors(&devices, &["outA"]);
    all[0].write("speed_sp", "500").unwrap();
    for distance in ["300", "-300"] {
        all[0].write("position_sp", distance).unwrap();
        command(&all[0], "run-to-rel-pos").unwrap();
        brick.pass(ms(200));
    }
    let reason = wait_for(&devices, &all, None, &mut brick.attentive()).unwrap();
    assert_eq!(reason, Reason::Reached);
    assert!(position(&brick, "outA").abs() <= 15, "back from under way");
}

#[test]
fn absurd_positions_do_not_overflow() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").position = -9e18;
    let devices = brick.devices();
    let moves = [turn("outA", 50.0, 2e9)];
    let options = MoveOptions { timeout: Some(Duration::MAX), ..MoveOptions::default() };
    let interrupt = &mut brick.interrupting(ms(100));
    let _ = run_to(&devices, &moves, &options, interrupt);
    let all: Vec<Arc<_>> = motors(&devices, &["outA"]);
    command(&all[0], "run-to-abs-pos").unwrap();
    let _ = wait_for(&devices, &all, Some(ms(100)), &mut brick.attentive());
}

#[test]
fn one_motor_runs_as_several_do() {
    let tree = PlainTree::new();
    let files =
        [("max_speed", "1050"), ("speed_sp", "0"), ("command", ""), ("stop_action", "coast")];
    let path = tree.plug(Class::TachoMotor, "motor0", "outA", &files);
    let devices = tree.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    let read = |name: &str| fs::read_to_string(path.join(name)).unwrap();
    assert!(!run_one(&motor, Speed::Percent(100.1)).unwrap());
    assert_eq!(read("command").trim(), "", "nothing has moved");
    assert!(run_one(&motor, Speed::Percent(-50.0)).unwrap());
    assert_eq!((read("speed_sp").trim(), read("command").trim()), ("-525", "run-forever"));
    stop_started(&devices).unwrap();
    assert_eq!(read("command").trim(), "stop", "it was recorded");
}
