//! Encoders whose teeth are not quite where they should be.
use crate::desk::{A, B, C, Desk};
use crate::robots::default_robot;
use ev3_sim::{Machine, Noise, Options, WorldSpec};
use std::collections::{BTreeMap, BTreeSet};

fn desk_of(sigma: f64, seed: u64) -> Desk {
    let mut robot = default_robot();
    for motor in &mut robot.motors {
        motor.encoder_noise = Some(sigma);
    }
    let options = Options { seed, ..Options::default() };
    Desk(Machine::new(&WorldSpec::default(), &robot, options).unwrap())
}

/// How far off each true position was, by whole turns. A motor that gets a fixed duty does not know
/// of its position, so one without errors moves the same and is exact.
fn errors(sigma: f64, seed: u64) -> Vec<BTreeMap<i32, BTreeSet<i32>>> {
    let (mut wrong, mut right) = (desk_of(sigma, seed), desk_of(0.0, seed));
    for desk in [&mut wrong, &mut right] {
        desk.run(A, &[("duty_cycle_sp", 10)], "run-direct");
    }
    let mut turns = vec![BTreeMap::new(); 4];
    loop {
        wrong.step(2);
        right.step(2);
        let truth = right.position(A);
        let Some(turn) = turns.get_mut(usize::try_from(truth / 360).unwrap()) else {
            return turns;
        };
        let errors: &mut BTreeSet<i32> = turn.entry(truth % 360).or_default();
        errors.insert(wrong.position(A) - truth);
    }
}

#[test]
fn errors_sit_on_the_disc() {
    let turns = errors(5.0, 1);
    // The first begins and the last ends in between.
    assert_eq!(turns[1].len(), 360);
    assert_eq!(turns[1], turns[2], "the same at each turn");
    let all: Vec<f64> = turns[1].values().flatten().map(|off| f64::from(*off)).collect();
    let count = f64::from(u32::try_from(all.len()).unwrap());
    let mean = all.iter().sum::<f64>() / count;
    let spread = (all.iter().map(|off| (off - mean).powi(2)).sum::<f64>() / count).sqrt();
    assert!((3.0..5.5).contains(&spread), "{spread}: 5 at each tooth, less between two");
}

#[test]
fn they_come_from_the_seed_and_are_off_until_asked_for() {
    assert_eq!(errors(1.0, 7), errors(1.0, 7));
    assert_ne!(errors(1.0, 7), errors(1.0, 8));
    let none = BTreeSet::from([0]);
    assert!(errors(0.0, 7).iter().flat_map(BTreeMap::values).all(|errors| *errors == none));
}

#[test]
fn each_motor_has_its_own() {
    let mut desk = desk_of(2.0, 1);
    for motor in [B, C] {
        desk.run(motor, &[("duty_cycle_sp", 30)], "run-direct");
    }
    let mut differences = BTreeSet::new();
    for _ in 0..500 {
        desk.step(2);
        differences.insert(desk.position(B) - desk.position(C));
    }
    assert!(differences.len() > 4, "{differences:?}");
}

#[test]
fn a_motor_at_rest_shows_the_same_always() {
    let mut desk = desk_of(0.5, 1);
    for by in [100, -37, 41, 90, 3] {
        desk.run(B, &[("position_sp", by), ("speed_sp", 200)], "run-to-rel-pos");
        desk.until(B, "", 5000);
        desk.step(1000);
        let shown = desk.position(B);
        for _ in 0..500 {
            desk.step(2);
            assert_eq!(desk.position(B), shown);
        }
    }
}

#[test]
fn positions_that_are_held_are_those_that_are_shown() {
    let mut desk = desk_of(0.5, 1);
    desk.put(&format!("{B}stop_action"), "hold");
    for target in [100, 63, 500, -20] {
        desk.run(B, &[("position_sp", target), ("speed_sp", 200)], "run-to-abs-pos");
        desk.until(B, "holding", 5000);
        desk.step(1000);
        assert!((desk.position(B) - target).abs() <= 1, "{} for {target}", desk.position(B));
    }
}

#[test]
fn errors_are_not_below_0() {
    for sigma in [-1.0, f64::NAN, f64::INFINITY] {
        let mut robot = default_robot();
        robot.motors[1].encoder_noise = Some(sigma);
        let error = robot.validate().unwrap_err();
        assert!(error.to_string().starts_with("encoder noise on outB"), "{error}");
    }
}

#[test]
fn noise_is_of_numbers() {
    for (sigma, bias) in [(-1.0, 0.0), (f64::NAN, 0.0), (0.0, f64::NAN), (1.0, f64::INFINITY)] {
        let (mut motor, mut sensor) = (default_robot(), default_robot());
        motor.motors[1].noise = Some(Noise { sigma, bias });
        sensor.sensors[0].noise = Some(Noise { sigma, bias });
        for (robot, port) in [(motor, "outB"), (sensor, "in1")] {
            let error = robot.validate().unwrap_err();
            assert!(error.to_string().starts_with(&format!("noise on {port}")), "{error}");
        }
    }
}
