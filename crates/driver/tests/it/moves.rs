//! Moves for a time, to a position and without regulation; motors that are new.
use crate::brick::{Brick, ms};
use crate::files::PlainTree;
use ev3_driver::motor::wait::Reason;
use ev3_driver::motor::{
    Extent, Move, MoveOptions, Run, Speed, measured, run_direct, run_forever, run_to, set_gear,
    set_position,
};
use ev3_driver::motor::{dc, servo};
use ev3_driver::{Class, Errno, Error, Value};
use std::fs;
use std::path::Path;
use std::time::Duration;

fn go(port: &str, percent: f64, extent: Extent) -> Move<'_> {
    Move { port, speed: Speed::Percent(percent), extent }
}

#[test]
fn a_timed_run_ends_with_its_time() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let moves = [go("outA", -50.0, Extent::For(ms(700)))];
    let ended = run_to(&devices, &moves, &MoveOptions::default(), &mut brick.attentive());
    assert_eq!(ended.unwrap(), Some(Reason::Reached));
    assert!(brick.now() >= ms(690) && brick.now() < ms(760), "{:?}", brick.now());
    assert!(brick.world().motor("outA").counts() < -300);
}

#[test]
fn a_timed_run_that_somebody_stops_is_stopped() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    brick.at(ms(300), |world| world.motor("outA").be_stopped());
    let moves = [go("outA", 50.0, Extent::For(ms(700)))];
    let ended = run_to(&devices, &moves, &MoveOptions::default(), &mut brick.attentive());
    assert_eq!(ended.unwrap(), Some(Reason::Stopped));
}

#[test]
fn an_absolute_move_goes_there_from_either_side() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    for (percent, angle) in [(50.0, 200.0), (50.0, -100.0), (-50.0, 30.0), (50.0, 30.0)] {
        let moves = [go("outA", percent, Extent::To(angle))];
        let ended = run_to(&devices, &moves, &MoveOptions::default(), &mut brick.attentive());
        assert_eq!(ended.unwrap(), Some(Reason::Reached));
        brick.pass(ms(300));
        let there = brick.world().motor("outA").position;
        assert!((there - angle).abs() <= 2.0, "at {there}, not {angle}");
    }
}

#[test]
fn an_impossible_move_writes_nothing() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    let day = Duration::from_secs(86_400);
    for (percent, way) in [
        (0.0, Extent::For(ms(100))),
        (101.0, Extent::For(ms(100))),
        (50.0, Extent::For(30 * day)),
        (50.0, Extent::To(f64::NAN)),
        (50.0, Extent::To(3e9)),
        (0.0, Extent::To(90.0)),
    ] {
        let ended = run_to(
            &devices,
            &[go("outA", percent, way)],
            &MoveOptions::default(),
            &mut brick.attentive(),
        );
        assert_eq!(ended.unwrap(), None, "{percent} {way:?}");
    }
    for percent in [100.6, -101.0, f64::NAN, f64::INFINITY] {
        let runs = run_direct(&devices, Class::TachoMotor, "outA", percent, &mut || false);
        assert!(!runs.unwrap(), "{percent}");
    }
    assert!(brick.take_written().is_empty());
}

#[test]
fn without_regulation_the_duty_comes_first() {
    let (brick, devices) = Brick::with_devices(&["outA"]);
    assert!(run_direct(&devices, Class::TachoMotor, "outA", 33.5, &mut || false).unwrap());
    assert_eq!(brick.take_written(), ["outA duty_cycle_sp 34", "outA command run-direct"]);
    assert!(!run_direct(&devices, Class::TachoMotor, "outB", 5.0, &mut || false).unwrap());
}

#[test]
fn a_position_is_in_degrees_of_the_shaft() {
    let devices = Brick::new(&["outA"]).devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert!(set_position(&motor, 90.4).unwrap());
    assert_eq!(measured(&motor, "position").unwrap(), Value::Integer(90));
    assert!(!set_position(&motor, 1e12).unwrap());
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").count_per_rot = 180;
    let devices = brick.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert!(set_position(&motor, 90.0).unwrap());
    assert_eq!(brick.world().motor("outA").counts(), 45);
    assert_eq!(measured(&motor, "position").unwrap(), Value::Float(90.0));
    set_gear(&motor, 3.0).unwrap();
    assert_eq!(measured(&motor, "position").unwrap(), Value::Float(30.0));
}

fn run(port: &str) -> Run<'_> {
    Run { port, speed: Speed::Percent(50.0) }
}

#[test]
fn a_motor_whose_files_udev_has_not_opened_is_waited_for_and_the_others_with_it() {
    for open_at in [ms(300), ms(900)] {
        let brick = Brick::new(&["outA", "outB"]);
        brick.world().motor("outB").closed_until = open_at;
        let devices = brick.devices();
        let runs = [run("outA"), run("outB")];
        assert!(run_forever(&devices, &runs, &mut brick.attentive()).unwrap().is_some());
        assert!(brick.now() >= open_at && brick.now() < open_at + ms(60), "{:?}", brick.now());
        let commands = brick.take_written().into_iter().filter(|line| line.contains("command"));
        assert_eq!(commands.count(), 2, "each is started once");
    }
}

#[test]
fn one_that_udev_never_opens_is_refused_after_a_second_and_nothing_moves() {
    let brick = Brick::new(&["outA", "outB"]);
    brick.world().motor("outB").closed_until = Duration::MAX;
    let devices = brick.devices();
    let moves = [go("outA", 50.0, Extent::By(90.0)), go("outB", 50.0, Extent::By(90.0))];
    let ended = run_to(&devices, &moves, &MoveOptions::default(), &mut brick.attentive());
    assert_eq!(ended.unwrap_err().errno(), Some(Errno::ACCESS));
    assert!(brick.now() >= ms(1000) && brick.now() < ms(1100), "{:?}", brick.now());
    assert!(!brick.world().motor("outA").is_powered());
}

#[test]
fn the_patience_can_be_interrupted() {
    let brick = Brick::new(&["outA"]);
    brick.world().motor("outA").closed_until = ms(800);
    let devices = brick.devices();
    let ended = run_forever(&devices, &[run("outA")], &mut brick.interrupting(ms(100)));
    assert!(matches!(ended, Err(Error::Interrupted)));
    assert!(brick.now() < ms(140), "{:?}", brick.now());
}

fn text(directory: &Path, file: &str) -> String {
    fs::read_to_string(directory.join(file)).unwrap().trim_end().to_owned()
}

#[test]
fn a_motor_without_sensor_gets_whole_percents_and_milliseconds() {
    let tree = PlainTree::new();
    let files = ["command", "duty_cycle_sp", "time_sp", "stop_action", "state", "ramp_up_sp"];
    let files = files.map(|file| (file, "0"));
    let path = tree.plug(Class::DcMotor, "motor0", "ev3-ports:outA", &files);
    let devices = tree.devices();
    let options = MoveOptions { ramp_up_ms: Some(70), wait: false, ..MoveOptions::default() };
    let start = |percent, time| {
        dc::begin_timed(&devices, "outA", percent, time, &options, &mut || false)
            .unwrap()
            .map(|moving| moving.block(&mut || false).unwrap())
    };
    assert_eq!(start(33.4, Duration::from_secs(61)), None);
    assert_eq!(start(100.5, ms(10)), None);
    assert_eq!(text(&path, "duty_cycle_sp"), "0", "nothing is written before all is possible");
    assert_eq!(start(-33.4, Duration::from_micros(1_234_500)), Some(Reason::Reached));
    let written = ["duty_cycle_sp", "time_sp", "ramp_up_sp", "command"].map(|f| text(&path, f));
    assert_eq!(written, ["-33", "1235", "0", "run-timed"]);
    assert!(dc::run_forever(&devices, "outA", 99.9, &mut || false).unwrap());
    assert_eq!(text(&path, "duty_cycle_sp"), "100");
    assert!(!dc::run_forever(&devices, "outB", 5.0, &mut || false).unwrap());
}

#[test]
fn a_servo_that_floats_has_no_position_and_polarity_does_not_change_its_sign() {
    let tree = PlainTree::new();
    let files = [("command", ""), ("position_sp", "-150"), ("polarity", "normal"), ("state", "")];
    let path = tree.plug(Class::ServoMotor, "motor0", "ev3-ports:in1:i2c88:sv1", &files);
    let devices = tree.devices();
    let servo = devices.find(Class::ServoMotor, "in1:i2c88:sv1").unwrap().unwrap();
    assert_eq!(servo::position(&servo).unwrap(), None);
    assert!(!servo::set_position(&servo, 101.0).unwrap());
    assert_eq!(text(&path, "command"), "");
    assert!(servo::set_position(&servo, -50.4).unwrap());
    assert_eq!([text(&path, "position_sp"), text(&path, "command")], ["-50", "run"]);
    fs::write(path.join("state"), "running\n").unwrap();
    assert_eq!(servo::position(&servo).unwrap(), Some(-50));
    // As the kernel reads it back.
    fs::write(path.join("polarity"), "inversed\n").unwrap();
    fs::write(path.join("position_sp"), "50\n").unwrap();
    assert_eq!(servo::position(&servo).unwrap(), Some(-50));
}
