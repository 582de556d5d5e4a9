//! A robot that is driven: how close, how long, and what when it goes wrong.
use crate::brick::{Brick, ms};
use ev3_driver::drive::odometry::Wheels;
use ev3_driver::drive::steering::Leg;
use ev3_driver::drive::{Command, Drive, DriveOptions, Robot};
use ev3_driver::motor::wait::Reason;
use ev3_driver::motor::{self, Run, Speed, StopAction, run_forever};
use ev3_driver::{Class, Error, Registry};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::Arc;
use std::time::Duration;

const GYRO: &[(&str, &[i64], i64)] =
    &[("GYRO-ANG", &[0], 0), ("GYRO-RATE", &[0], 0), ("GYRO-G&A", &[0, 0], 0)];

/// How close to the angle a turn ends, in degrees: the gyro shows whole ones, cut off and late.
const WITHIN: f64 = 2.5;

/// A robot whose axle is 2.2 wheel diameters long, and which turns as one with an
/// axle of `gearing`. Its gyro lags as LEGO's does.
struct Driven {
    brick: Arc<Brick>,
    registry: Arc<Registry>,
    drive: Arc<Drive>,
}

impl Driven {
    fn new(gearing: f64) -> Self {
        Self::with(gearing, [false, false])
    }

    /// One that is believed to have these motors mounted the other way round.
    fn with(gearing: f64, inverted: [bool; 2]) -> Self {
        let brick = Brick::new(&["outB", "outC"]);
        let mut world = brick.world();
        world.gearing = gearing;
        let gyro = world.plug_sensor("in2", "lego-ev3-gyro", GYRO);
        (gyro.gyro, gyro.gyro_lag) = (Some(1.0), ms(20));
        drop(world);
        let registry = brick.devices();
        let robot = Robot {
            ports: ["outB".to_owned(), "outC".to_owned()],
            wheels: Wheels::new([5.0, 5.0], inverted, 11.0, 0.0),
        };
        let drive = Drive::new(Arc::clone(&registry), &robot);
        Self { brick, registry, drive }
    }

    /// Carries out a command with interruptions by `interrupted`, and sees to it
    /// that the motors rest afterwards, or hold, whatever happens.
    fn driven(
        &self,
        percent: f64,
        legs: &[Leg],
        interrupted: &mut dyn FnMut() -> bool,
    ) -> ev3_driver::Result<Option<Reason>> {
        let options = DriveOptions {
            percent,
            acceleration: 50.0,
            stop_action: StopAction::Brake,
            use_gyro: true,
        };
        let command = Command::Legs(legs.to_vec(), false);
        let begun = self.drive.begin(&command, &options, &mut *interrupted);
        let ended = begun.and_then(|begun| {
            begun
                .map(|outcome| self.drive.until_ended(outcome, None).block(interrupted))
                .transpose()
        });
        self.assert_at_rest();
        ended
    }

    fn turned(&self, percent: f64, degrees: f64) -> ev3_driver::Result<Option<Reason>> {
        self.driven(percent, &[Leg::Turn(degrees)], &mut self.brick.attentive())
    }

    /// Turns and checks how far; answers how long it took.
    fn assert_turned(&self, percent: f64, degrees: f64, bound: Duration) -> Duration {
        let (from, started) = (self.heading(), self.brick.now());
        let ended = self.turned(percent, degrees).unwrap();
        let took = self.brick.since(started);
        self.brick.pass(ms(1000));
        let error = self.brick.world().heading - from - degrees;
        assert_eq!(ended, Some(Reason::Reached), "off by {error} of {degrees} degrees");
        assert!(error.abs() <= WITHIN, "off by {error} of {degrees} degrees at {percent} %");
        assert!(took <= bound, "took {took:?}: {degrees} at {percent} %");
        took
    }

    fn assert_at_rest(&self) {
        let mut world = self.brick.world();
        for port in ["outB", "outC"] {
            let is_plugged_in = world
                .motors
                .iter()
                .any(|motor| motor.address.ends_with(port) && !motor.is_unplugged);
            assert!(!is_plugged_in || !world.motor(port).is_powered(), "{port} goes on turning");
        }
    }

    fn heading(&self) -> f64 {
        self.brick.world().heading
    }
}

#[test]
fn a_robot_turns_by_the_angle_whichever_way_and_however_fast() {
    for degrees in [-720.0, -90.0, -45.0, -7.0, -2.0, 2.0, 5.0, 30.0, 90.0, 180.0, 360.0] {
        for percent in [10.0, 30.0, 100.0] {
            Driven::new(2.2).assert_turned(percent, degrees, Duration::from_secs(60));
        }
    }
}

#[test]
fn a_quarter_takes_a_second_and_a_half() {
    Driven::new(2.2).assert_turned(40.0, 90.0, ms(1500));
}

#[test]
fn turns_add_up_though_the_gyro_starts_anywhere() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").gyro_zero = 1234.0;
    for _ in 0..4 {
        assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Reached));
        robot.brick.pass(ms(1000));
    }
    let heading = robot.heading();
    assert!((heading - 360.0).abs() <= 4.0, "{heading}");
}

#[test]
fn turns_to_one_side_never_fill_the_gyro() {
    for (zero, degrees) in [(16_300.0, 90.0), (-16_300.0, -90.0)] {
        let robot = Driven::new(2.2);
        robot.brick.world().sensor("in2").gyro_zero = zero;
        for _ in 0..3 {
            robot.assert_turned(40.0, degrees, ms(2000));
        }
        let zero = robot.brick.world().sensor("in2").gyro_zero;
        assert!(zero.abs() < 1000.0, "{zero}");
    }
}

#[test]
fn a_gyro_that_is_full_already_is_emptied() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").gyro_zero = 40_000.0;
    robot.assert_turned(40.0, 90.0, ms(2000));
}

#[test]
fn a_gyro_that_fills_under_way_leaves_the_rest_to_the_wheels() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").gyro_zero = 16_000.0;
    let turned = robot.turned(100.0, 18_000.0).unwrap();
    assert_eq!(turned, Some(Reason::Reached));
    let heading = robot.heading();
    assert!((heading - 18_000.0).abs() <= 50.0, "{heading}");
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Reached));
}

#[test]
fn a_turn_that_its_acceleration_makes_swing_ends_all_the_same() {
    for acceleration in [3.0e3, 1.0e4, 4.3e9, 1.0e300] {
        let robot = Driven::new(2.2);
        let command = Command::Legs(vec![Leg::Turn(90.0)], false);
        let options = DriveOptions {
            percent: 80.0,
            acceleration,
            stop_action: StopAction::Brake,
            use_gyro: true,
        };
        let never = &mut robot.brick.attentive();
        let begun = robot.drive.begin(&command, &options, &mut *never).unwrap().unwrap();
        let ended = robot.drive.until_ended(begun, Some(ms(10_000))).block(never).unwrap();
        let heading = robot.heading();
        assert_eq!(ended, Reason::Reached, "{acceleration}");
        assert!((heading - 90.0).abs() <= 5.0, "{acceleration}: {heading}");
    }
}

proptest! {
    // The same robots each time.
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(3),
        ..Default::default()
    })]

    #[test]
    fn no_robot_is_turned_too_far(
        degrees in -400_i32..400,
        percent in 15_i32..=100,
        motor_lag in 5_u64..60,
    ) {
        let robot = Driven::new(2.2);
        for port in ["outB", "outC"] {
            robot.brick.world().motor(port).lag = ms(motor_lag);
        }
        robot.assert_turned(f64::from(percent), f64::from(degrees), Duration::from_secs(30));
    }
}

#[test]
fn wheels_of_other_counts_turn_the_robot_as_fast() {
    let usual = Driven::new(2.2).assert_turned(40.0, 90.0, ms(1500));
    let robot = Driven::new(2.2);
    for port in ["outB", "outC"] {
        robot.brick.world().motor(port).count_per_rot = 720;
        robot.brick.world().motor(port).max_speed = 2100;
    }
    robot.assert_turned(40.0, 90.0, usual + ms(200));
}

#[test]
fn an_impossible_command_is_none_and_writes_nothing() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").modes.reverse();
    for percent in [0.0, 101.0, f64::NAN] {
        assert_eq!(robot.turned(percent, 90.0).unwrap(), None);
    }
    for leg in [
        Leg::Turn(f64::NAN),
        Leg::Turn(1e300),
        Leg::Turn(f64::INFINITY),
        Leg::Arc(1e12, 0.0),
        Leg::Arc(10.0, f64::INFINITY),
        Leg::To([0.0, f64::INFINITY]),
        Leg::Through(vec![[0.0, 1.0], [1e300, 0.0]], 0.0),
    ] {
        let ended = robot.driven(40.0, std::slice::from_ref(&leg), &mut robot.brick.attentive());
        assert_eq!(ended.unwrap(), None, "{leg:?}");
    }
    robot.brick.world().motor("outC").is_unplugged = true;
    robot.brick.pass(ms(200));
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), None);
    assert_eq!(robot.brick.take_written(), Vec::<String>::new());
}

#[test]
fn blocked_wheels_are_given_two_seconds() {
    let robot = Driven::new(2.2);
    robot.brick.at(ms(300), |world| {
        for motor in &mut world.motors {
            motor.is_blocked = true;
        }
    });
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Stalled));
    assert!(robot.brick.now() < ms(2500), "{:?}", robot.brick.now());
}

#[test]
fn so_are_those_that_a_program_commands_again_and_again() {
    let robot = Driven::new(2.2);
    robot.brick.at(ms(300), |world| {
        for motor in &mut world.motors {
            motor.is_blocked = true;
        }
    });
    let options = DriveOptions {
        percent: 100.0,
        acceleration: 50.0,
        stop_action: StopAction::Brake,
        use_gyro: true,
    };
    let again = |speed| {
        let never = &mut robot.brick.attentive();
        let begun = robot.drive.begin(&Command::Cruise(speed, 0.0), &options, &mut *never);
        let ended = robot.drive.until_last_ended(Some(ms(50))).block(never);
        ended.map(|ended| (begun.unwrap().is_some(), ended))
    };
    // To push one way and then the other is not a stall.
    for speed in [15.0, -15.0, 15.0, -15.0] {
        let started = robot.brick.now();
        while robot.brick.since(started) < ms(1200) {
            assert_eq!(again(speed).unwrap(), (true, Reason::Timeout));
        }
    }
    let started = robot.brick.now();
    while again(15.0).unwrap() == (true, Reason::Timeout) {
        assert!(robot.brick.since(started) < ms(2500));
    }
    robot.assert_at_rest();
}

#[test]
fn a_gyro_mounted_upside_down_leads_astray_but_not_far() {
    for (percent, degrees) in [(40.0, 90.0), (40.0, -90.0), (10.0, 90.0), (100.0, -360.0)] {
        let robot = Driven::new(2.2);
        robot.brick.world().sensor("in2").gyro = Some(-1.0);
        assert_eq!(robot.turned(percent, degrees).unwrap(), Some(Reason::Astray));
        robot.brick.pass(ms(500));
        let heading = robot.heading();
        assert!(heading.abs() < 45.0, "{heading}");
    }
}

#[test]
fn one_that_shows_no_turn_does_so_too() {
    for degrees in [90.0, -360.0] {
        let robot = Driven::new(2.2);
        robot.brick.world().sensor("in2").gyro = Some(0.0);
        assert_eq!(robot.turned(40.0, degrees).unwrap(), Some(Reason::Astray));
        robot.brick.pass(ms(500));
        let heading = robot.heading();
        assert!(heading.abs() < 90.0, "{heading}");
    }
}

#[test]
fn so_does_one_that_freezes_under_way() {
    let robot = Driven::new(2.2);
    robot.brick.at(ms(400), super::brick::World::freeze_gyro);
    assert_eq!(robot.turned(40.0, 360.0).unwrap(), Some(Reason::Astray));
    robot.brick.pass(ms(500));
    let heading = robot.heading();
    assert!(heading < 180.0, "{heading}");
}

#[test]
fn an_upside_down_gyro_does_not_let_a_straight_line_become_a_spiral() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").gyro = Some(-1.0);
    // The robot pulls to one side.
    robot.brick.world().motor("outB").lag = ms(120);
    let ended = robot.driven(60.0, &[Leg::Arc(300.0, 0.0)], &mut robot.brick.attentive());
    assert!(matches!(ended.unwrap(), Some(Reason::Astray | Reason::Reached)));
    let heading = robot.heading();
    assert!(heading.abs() < 60.0, "{heading}");
}

#[test]
fn one_motor_mounted_backwards_ends_a_move_before_the_robot_has_spun_around() {
    let legs = [Leg::Arc(50.0, 0.0), Leg::Arc(-50.0, 0.0), Leg::Arc(40.0, 1.0 / 60.0)];
    for (leg, inverted) in legs.iter().flat_map(|leg| [(leg, [true, false]), (leg, [false, true])])
    {
        for percent in [5.0, 40.0, 100.0] {
            let robot = Driven::with(2.2, inverted);
            let legs = std::slice::from_ref(leg);
            let ended = robot.driven(percent, legs, &mut robot.brick.attentive());
            assert_eq!(ended.unwrap(), Some(Reason::Astray), "{leg:?} at {percent} %");
            robot.brick.pass(ms(500));
            let heading = robot.heading();
            assert!(heading.abs() < 180.0, "{leg:?} at {percent} %: {heading}");
        }
    }
}

#[test]
fn a_line_goes_on_though_the_gyro_is_stuck_or_the_motors_are_swapped() {
    for factor in [0.0, -1.0] {
        let robot = Driven::new(2.2);
        robot.brick.world().sensor("in2").gyro = Some(factor);
        let ended = robot.driven(30.0, &[Leg::Arc(50.0, 0.0)], &mut robot.brick.attentive());
        assert_eq!(ended.unwrap(), Some(Reason::Reached));
    }
}

#[test]
fn after_going_astray_the_wheels_are_believed_again() {
    let robot = Driven::new(2.2);
    robot.brick.world().sensor("in2").gyro = Some(-1.0);
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Astray));
    robot.brick.pass(ms(500));
    robot.brick.world().sensor("in2").gyro = Some(1.0);
    let from = robot.heading();
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Reached));
    let turned = robot.heading() - from;
    assert!((turned - 90.0).abs() <= 5.0, "{turned}");
}

#[test]
fn a_gyro_that_loses_contact_leaves_the_heading_to_the_wheels() {
    let robot = Driven::new(2.2);
    robot.brick.at(ms(400), |world| world.sensor("in2").out_of_contact_until = ms(10_000));
    assert_eq!(robot.turned(40.0, 90.0).unwrap(), Some(Reason::Reached));
    let heading = robot.heading();
    assert!((heading - 90.0).abs() <= 10.0, "{heading}");
}

#[test]
fn an_unplugged_gyro_is_gone_and_the_motors_brake() {
    let robot = Driven::new(2.2);
    robot.brick.at(ms(400), |world| world.sensor("in2").is_unplugged = true);
    let error = robot.turned(40.0, 90.0).unwrap_err();
    assert!(matches!(error, Error::Unplugged { class: Class::Sensor, port } if port == "in2"));
}

#[test]
fn an_unplugged_motor_is_gone_and_the_other_brakes() {
    for vanishing in ["outB", "outC"] {
        let robot = Driven::new(2.2);
        robot.brick.at(ms(400), move |world| world.motor(vanishing).is_unplugged = true);
        let error = robot.turned(40.0, 90.0).unwrap_err();
        let Error::Unplugged { class: Class::TachoMotor, port } = error else { panic!("{error}") };
        assert_eq!(port, vanishing);
    }
}

#[test]
fn an_interrupted_turn_stops_the_motors() {
    for after in [0, 5, 300, 600] {
        let robot = Driven::new(2.2);
        let interrupt = &mut robot.brick.interrupting(ms(after));
        let error = robot.driven(40.0, &[Leg::Turn(360.0)], interrupt).unwrap_err();
        assert!(matches!(error, Error::Interrupted));
    }
}

#[test]
fn a_motor_whose_files_udev_has_not_opened_is_waited_for() {
    let robot = Driven::new(2.2);
    robot.brick.world().motor("outC").closed_until = ms(300);
    robot.assert_turned(40.0, 90.0, ms(1900));
}

#[test]
fn a_robot_that_rolls_already_is_turned_and_stopped() {
    let robot = Driven::new(2.2);
    let runs = ["outB", "outC"].map(|port| Run { port, speed: Speed::Percent(30.0) });
    run_forever(&robot.registry, &runs, &mut || false).unwrap();
    robot.brick.pass(ms(500));
    robot.assert_turned(40.0, 90.0, ms(2500));
}

/// Turns, while another thread does something after some time.
fn turned_while(
    robot: &Driven,
    after: Duration,
    other: impl Fn(&Registry),
) -> ev3_driver::Result<Option<Reason>> {
    let started = robot.brick.now();
    let (mut attentive, mut is_done) = (robot.brick.attentive(), false);
    let mut interrupted = || {
        if !is_done && robot.brick.since(started) >= after {
            is_done = true;
            other(&robot.registry);
            robot.brick.take_written();
        }
        attentive()
    };
    let options = DriveOptions {
        percent: 50.0,
        acceleration: 50.0,
        stop_action: StopAction::Brake,
        use_gyro: true,
    };
    let command = Command::Legs(vec![Leg::Turn(90.0)], false);
    let begun = robot.drive.begin(&command, &options, &mut interrupted)?.unwrap();
    let ended = robot.drive.until_ended(begun, None).block(&mut interrupted);
    assert!(is_done, "it was over before");
    ended.map(Some)
}

#[test]
fn a_turn_ends_when_another_thread_stops_a_motor_in_whatever_phase() {
    for after in [20, 200, 600, 800] {
        for ports in [&["outB", "outC"][..], &["outB"], &["outC"]] {
            let robot = Driven::new(2.2);
            let ended = turned_while(&robot, ms(after), |registry| {
                for port in ports {
                    let motor = registry.find(Class::TachoMotor, port).unwrap().unwrap();
                    motor::stop(&motor, StopAction::Coast).unwrap();
                }
            });
            assert_eq!(ended.unwrap(), Some(Reason::Stopped), "{ports:?} after {after} ms");
            let written = robot.brick.take_written();
            assert!(!written.iter().any(|line| line.contains("run-")), "{written:?}");
            robot.assert_at_rest();
        }
    }
}

#[test]
fn a_turn_leaves_alone_what_another_thread_has_started() {
    let robot = Driven::new(2.2);
    let ended = turned_while(&robot, ms(200), |registry| {
        let run = Run { port: "outB", speed: Speed::Percent(30.0) };
        assert!(run_forever(registry, &[run], &mut || false).unwrap().is_some());
    });
    assert_eq!(ended.unwrap(), Some(Reason::Stopped));
    let mut world = robot.brick.world();
    assert!(world.motor("outB").is_powered() && !world.motor("outC").is_powered());
}
