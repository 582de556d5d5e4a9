//! Turning by the gyro: how close, how long, and what when it goes wrong.
use crate::brick::{Brick, ms};
use ev3_driver::drive::turn::{Ended, Turn, WITHIN, by_gyro};
use ev3_driver::motor::{self, Run, Speed, StopAction, run_forever};
use ev3_driver::{Class, Error};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::sync::Arc;
use std::time::Duration;

const GYRO: &[(&str, &[i64], i64)] =
    &[("GYRO-ANG", &[0], 0), ("GYRO-RATE", &[0], 0), ("GYRO-G&A", &[0, 0], 0)];

/// A robot with a gyro that lags as LEGO's does.
fn robot(gearing: f64) -> Arc<Brick> {
    let brick = Brick::new(&["outB", "outC"]);
    let mut world = brick.world();
    world.gearing = gearing;
    let gyro = world.plug_sensor("in2", "lego-ev3-gyro", GYRO);
    (gyro.gyro, gyro.gyro_lag) = (Some(1.0), ms(20));
    drop(world);
    brick
}

fn turn(percent: f64, degrees: f64, gearing: f64) -> Turn {
    let (left, right) = ("outB".to_owned(), "outC".to_owned());
    Turn { left, right, signs: [1, 1], speed: Speed::Percent(percent), degrees, gearing }
}

/// Turns, and sees to it that the motors brake afterwards whatever happens.
fn turned(brick: &Arc<Brick>, turn: &Turn) -> ev3_driver::Result<Option<Ended>> {
    let devices = brick.devices();
    let gyro = devices.find(Class::Sensor, "in2").unwrap().unwrap();
    let ended = by_gyro(&devices, &gyro, turn, &mut brick.attentive());
    assert_at_rest(brick);
    ended
}

fn assert_at_rest(brick: &Brick) {
    let mut world = brick.world();
    for port in ["outB", "outC"] {
        let is_plugged_in =
            world.motors.iter().any(|motor| motor.address.ends_with(port) && !motor.is_unplugged);
        assert!(!is_plugged_in || !world.motor(port).is_powered(), "{port} goes on turning");
    }
}

/// Turns and checks how far; answers how long it took.
fn assert_turned(brick: &Arc<Brick>, turn: &Turn, bound: Duration) -> Duration {
    let from = brick.world().heading;
    let started = brick.now();
    let ended = turned(brick, turn).unwrap().unwrap();
    let took = brick.since(started);
    brick.pass(ms(1000));
    let error = brick.world().heading - from - turn.degrees;
    assert_eq!(ended, Ended::Reached, "off by {error} degrees: {turn:?}");
    // The gyro shows whole degrees only, and the robot may creep on a little.
    assert!(error.abs() <= WITHIN + 1.5, "off by {error} degrees: {turn:?}");
    assert!(took <= bound, "took {took:?}: {turn:?}");
    took
}

#[test]
fn a_robot_turns_by_the_angle_whichever_way_and_however_fast() {
    for degrees in [-720.0, -90.0, -45.0, -7.0, -2.0, 2.0, 5.0, 30.0, 90.0, 180.0, 360.0] {
        for percent in [10.0, 30.0, 100.0, -30.0] {
            let brick = robot(2.2);
            assert_turned(&brick, &turn(percent, degrees, 2.2), Duration::from_secs(60));
        }
    }
}

#[test]
fn a_quarter_takes_two_seconds() {
    assert_turned(&robot(2.2), &turn(40.0, 90.0, 2.2), ms(2600));
}

#[test]
fn turns_add_up_though_the_gyro_starts_anywhere() {
    let brick = robot(2.2);
    brick.world().sensor("in2").gyro_zero = 1234.0;
    for _ in 0..4 {
        assert_turned(&brick, &turn(40.0, 90.0, 2.2), ms(5000));
    }
    let heading = brick.world().heading;
    assert!((heading - 360.0).abs() <= 8.0, "{heading}");
}

#[test]
fn a_turn_by_less_than_the_gyro_shows_is_none() {
    for degrees in [0.0, 0.3, -0.3] {
        let brick = robot(2.2);
        assert_eq!(turned(&brick, &turn(40.0, degrees, 2.2)).unwrap(), Some(Ended::Reached));
        assert!(!brick.take_written().iter().any(|line| line.contains("run-forever")));
    }
}

proptest! {
    // The same robots each time: how far one creeps on has no sharp bound.
    #![proptest_config(ProptestConfig {
        cases: 64,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(3),
        ..Default::default()
    })]

    #[test]
    fn no_robot_overshoots_for_good(
        degrees in -400_i32..400,
        percent in 15_i32..=100,
        gearing in 0.8..4.0,
        gyro_lag in 0_u64..60,
        motor_lag in 5_u64..80,
    ) {
        let brick = robot(gearing);
        brick.world().sensor("in2").gyro_lag = ms(gyro_lag);
        for port in ["outB", "outC"] {
            brick.world().motor(port).lag = ms(motor_lag);
        }
        let turn = turn(f64::from(percent), f64::from(degrees), gearing);
        assert_turned(&brick, &turn, Duration::from_secs(30));
    }
}

#[test]
fn wheels_of_other_counts_turn_the_robot_as_fast() {
    let usual = assert_turned(&robot(2.2), &turn(40.0, 90.0, 2.2), ms(2600));
    let brick = robot(2.2);
    for port in ["outB", "outC"] {
        brick.world().motor(port).count_per_rot = 720;
        brick.world().motor(port).max_speed = 2100;
    }
    assert_turned(&brick, &turn(40.0, 90.0, 2.2), usual + ms(100));
}

#[test]
fn an_impossible_turn_is_none_and_writes_nothing() {
    let brick = robot(2.2);
    for percent in [0.0, 101.0, f64::NAN] {
        assert_eq!(turned(&brick, &turn(percent, 90.0, 2.2)).unwrap(), None);
    }
    let absent = Turn { right: "outD".to_owned(), ..turn(40.0, 90.0, 2.2) };
    assert_eq!(turned(&brick, &absent).unwrap(), None);
    for (degrees, gearing) in [(f64::NAN, 2.2), (f64::INFINITY, 2.2), (90.0, f64::NAN)] {
        assert_eq!(turned(&brick, &turn(40.0, degrees, gearing)).unwrap(), None);
    }
    assert!(brick.take_written().is_empty());
}

#[test]
fn blocked_wheels_are_given_two_seconds() {
    let brick = robot(2.2);
    brick.at(ms(300), |world| {
        for motor in &mut world.motors {
            motor.is_blocked = true;
        }
    });
    assert_eq!(turned(&brick, &turn(40.0, 90.0, 2.2)).unwrap(), Some(Ended::Stalled));
    assert!(brick.now() < ms(2500), "{:?}", brick.now());
}

#[test]
fn a_gyro_mounted_upside_down_leads_astray_but_not_far() {
    for degrees in [90.0, -90.0] {
        let brick = robot(2.2);
        brick.world().sensor("in2").gyro = Some(-1.0);
        assert_eq!(turned(&brick, &turn(40.0, degrees, 2.2)).unwrap(), Some(Ended::Astray));
        brick.pass(ms(500));
        let heading = brick.world().heading;
        assert!(heading.abs() < 45.0, "{heading}");
    }
}

#[test]
fn a_robot_that_always_slides_on_misses() {
    let brick = robot(2.2);
    // Even at a crawl, it is past the target when the gyro shows it.
    brick.world().sensor("in2").gyro_lag = ms(300);
    let ended = turned(&brick, &turn(60.0, 90.0, 2.2)).unwrap().unwrap();
    assert!(matches!(ended, Ended::Missed(left) if left.abs() > WITHIN), "{ended:?}");
    assert!(brick.now() < Duration::from_secs(40), "{:?}", brick.now());
}

#[test]
fn a_frozen_gyro_does_not_leave_the_robot_spinning_for_long() {
    let brick = robot(2.2);
    brick.at(ms(400), super::brick::World::freeze_gyro);
    assert_eq!(turned(&brick, &turn(40.0, 90.0, 2.2)).unwrap(), Some(Ended::Stalled));
    assert!(brick.now() < ms(2600));
}

#[test]
fn a_gyro_that_loses_contact_does_not_leave_the_robot_spinning() {
    let brick = robot(2.2);
    brick.at(ms(400), |world| world.sensor("in2").out_of_contact_until = ms(10_000));
    turned(&brick, &turn(40.0, 90.0, 2.2)).unwrap_err();
    brick.pass(ms(1000));
    let heading = brick.world().heading;
    assert!(heading < 90.0, "turned by {heading} degrees");
}

#[test]
fn an_unplugged_gyro_is_gone_and_the_motors_brake() {
    let brick = robot(2.2);
    brick.at(ms(400), |world| world.sensor("in2").is_unplugged = true);
    let error = turned(&brick, &turn(40.0, 90.0, 2.2)).unwrap_err();
    assert!(matches!(error, Error::Unplugged { class: Class::Sensor, port } if port == "in2"));
}

#[test]
fn an_unplugged_motor_is_gone_and_the_other_brakes() {
    for vanishing in ["outB", "outC"] {
        let brick = robot(2.2);
        brick.at(ms(400), move |world| world.motor(vanishing).is_unplugged = true);
        let error = turned(&brick, &turn(40.0, 90.0, 2.2)).unwrap_err();
        let Error::Unplugged { class: Class::TachoMotor, port } = error else { panic!("{error}") };
        assert_eq!(port, vanishing);
    }
}

#[test]
fn a_motor_replugged_under_way_does_not_go_on_turning() {
    let brick = robot(2.2);
    // At full speed nothing is written for long.
    brick.at(ms(400), |world| world.motor("outB").is_unplugged = true);
    brick.at(ms(900), |world| {
        world.plug_motor("outB");
    });
    let error = turned(&brick, &turn(20.0, 360.0, 2.2)).unwrap_err();
    assert!(matches!(error, Error::Unplugged { port, .. } if port == "outB"));
}

#[test]
fn an_interrupted_turn_brakes_the_motors() {
    for after in [0, 5, 300, 2000] {
        let brick = robot(2.2);
        let devices = brick.devices();
        let gyro = devices.find(Class::Sensor, "in2").unwrap().unwrap();
        let interrupt = &mut brick.interrupting(ms(after));
        let error = by_gyro(&devices, &gyro, &turn(40.0, 360.0, 2.2), interrupt).unwrap_err();
        assert!(matches!(error, Error::Interrupted));
        assert_at_rest(&brick);
    }
}

#[test]
fn a_robot_that_rolls_already_is_turned_and_stopped() {
    let brick = robot(2.2);
    let devices = brick.devices();
    let runs =
        ["outB", "outC"].map(|port| ev3_driver::motor::Run { port, speed: Speed::Percent(30.0) });
    run_forever(&devices, &runs, &mut || false).unwrap();
    brick.pass(ms(500));
    assert_turned(&brick, &turn(40.0, 90.0, 2.2), ms(5000));
}

/// Turns, while another thread does something after some time.
fn turned_while(
    brick: &Arc<Brick>,
    after: Duration,
    other: impl Fn(&ev3_driver::Registry),
) -> Option<Ended> {
    let devices = brick.devices();
    let gyro = devices.find(Class::Sensor, "in2").unwrap().unwrap();
    let started = brick.now();
    let (mut attentive, mut is_done) = (brick.attentive(), false);
    let mut interrupted = || {
        if !is_done && brick.since(started) >= after {
            is_done = true;
            other(&devices);
            brick.take_written();
        }
        attentive()
    };
    let ended = by_gyro(&devices, &gyro, &turn(50.0, 90.0, 2.2), &mut interrupted);
    assert!(is_done, "it was over before");
    ended.unwrap()
}

#[test]
fn a_turn_ends_when_another_thread_stops_a_motor_in_whatever_phase() {
    for after in [20, 200, 600, 900, 1100] {
        for ports in [&["outB", "outC"][..], &["outB"], &["outC"]] {
            let brick = robot(2.2);
            let ended = turned_while(&brick, ms(after), |devices| {
                for port in ports {
                    let motor = devices.find(Class::TachoMotor, port).unwrap().unwrap();
                    motor::stop(&motor, StopAction::Coast).unwrap();
                }
            });
            assert_eq!(ended, Some(Ended::Stopped), "{ports:?} after {after} ms");
            let written = brick.take_written();
            assert!(!written.iter().any(|line| line.contains("run-forever")), "{written:?}");
            assert_at_rest(&brick);
        }
    }
}

#[test]
fn a_turn_leaves_alone_what_another_thread_has_started() {
    let brick = robot(2.2);
    let ended = turned_while(&brick, ms(200), |devices| {
        let run = Run { port: "outB", speed: Speed::Percent(30.0) };
        assert!(run_forever(devices, &[run], &mut || false).unwrap());
    });
    assert_eq!(ended, Some(Ended::Stopped));
    let mut world = brick.world();
    assert!(world.motor("outB").is_powered() && !world.motor("outC").is_powered());
}
