//! The robot drives: distances, turns, walls.
use crate::desk::{B, C, Desk};
use crate::robots::{default_robot, wheels};
use ev3_sim::{Bounds, Hull, Item, Pose, RobotSpec, Wheels, WorldSpec};

/// Counts per cm of way with 5.6 cm wheels.
const PER_CM: f64 = 360.0 / (std::f64::consts::PI * 5.6);

fn move_both(desk: &mut Desk, speed: i32, left: f64, right: f64) {
    for (motor, counts) in [(B, left), (C, right)] {
        desk.put(&format!("{motor}stop_action"), "hold");
        #[expect(clippy::cast_possible_truncation, reason = "some turns of a wheel")]
        let counts = counts.round() as i32;
        desk.put(&format!("{motor}position_sp"), counts);
        desk.put(&format!("{motor}speed_sp"), speed);
    }
    for motor in [B, C] {
        desk.put(&format!("{motor}command"), "run-to-rel-pos");
    }
    desk.until(B, "holding", 60_000);
    desk.until(C, "holding", 1000);
    desk.step(1000);
}

/// Counts for which each wheel has to turn for a turn of the robot on the spot.
fn turn(degrees: f64) -> f64 {
    degrees / 360.0 * std::f64::consts::PI * 10.6 * PER_CM
}

fn assert_near(pose: Pose, expected: Pose, cm: f64, degrees: f64) {
    let off = (pose.x - expected.x).hypot(pose.y - expected.y);
    assert!(off <= cm, "{pose:?} is {off:.2} cm off {expected:?}");
    let turned = (pose.heading - expected.heading).abs();
    assert!(turned <= degrees, "{pose:?} is {turned:.2} degrees off {expected:?}");
}

#[test]
fn twice_the_speed_is_four_times_the_energy() {
    let energy = |speed: i32| {
        let mut desk = Desk::new();
        for motor in [B, C] {
            desk.put(&format!("{motor}speed_sp"), speed);
            desk.put(&format!("{motor}command"), "run-forever");
        }
        desk.step(1000);
        desk.0.kinetic_energy()
    };
    let (slow, fast) = (energy(200), energy(400));
    assert!((fast / slow - 4.0).abs() < 0.1, "{slow} J and {fast} J");
    // 0.75 kg at 9.8 cm/s are 3.6 mJ, and the rotors of two motors have five times as much.
    assert!((0.01..0.04).contains(&slow), "{slow} J");
}

#[test]
fn a_metre_is_a_metre() {
    let mut desk = Desk::new();
    move_both(&mut desk, 315, 100.0 * PER_CM, 100.0 * PER_CM);
    assert_near(desk.0.pose(), Pose::new(0.0, 100.0, 0.0), 0.3, 0.1);
    move_both(&mut desk, 315, -50.0 * PER_CM, -50.0 * PER_CM);
    assert_near(desk.0.pose(), Pose::new(0.0, 50.0, 0.0), 0.3, 0.1);
}

#[test]
fn a_square_returns_to_its_start() {
    let mut desk = Desk::new();
    for side in 1..=4 {
        move_both(&mut desk, 400, 40.0 * PER_CM, 40.0 * PER_CM);
        move_both(&mut desk, 200, turn(90.0), -turn(90.0));
        let heading = f64::from(side) * 90.0;
        assert!((desk.0.pose().heading - heading).abs() < 1.0, "{:?}", desk.0.pose());
        let gyro = desk.number("lego-sensor/sensor3/value0");
        assert!((f64::from(gyro) - heading).abs() < 1.5, "gyro {gyro} at {heading}");
    }
    assert_near(desk.0.pose(), Pose::new(0.0, 0.0, 360.0), 1.0, 1.5);
}

#[test]
fn mounting_and_wheels_make_a_difference() {
    let forward = |robot: &RobotSpec| {
        let mut desk = Desk::with(&WorldSpec::default(), robot);
        move_both(&mut desk, 300, 720.0, 720.0);
        desk.0.pose()
    };
    let mut robot = default_robot();
    wheels(&mut robot).left.inverted = true;
    wheels(&mut robot).right.inverted = true;
    assert_near(forward(&robot), Pose::new(0.0, -720.0 / PER_CM, 0.0), 0.3, 0.1);
    let mut robot = default_robot();
    let Wheels { left, right, .. } = wheels(&mut robot);
    std::mem::swap(&mut left.port, &mut right.port);
    left.diameter = 5.5;
    let pose = forward(&robot);
    assert!(pose.heading < -3.0 && pose.x < -0.5, "pulls to the smaller, left wheel: {pose:?}");
    let mut robot = default_robot();
    wheels(&mut robot).right.slip = 0.05;
    assert!(forward(&robot).heading > 5.0, "pulls to the slipping, right wheel");
}

fn corridor(hull: Hull) -> Desk {
    let world = WorldSpec {
        items: vec![Item::wall([-100.0, 60.0], [100.0, 60.0])],
        ..WorldSpec::default()
    };
    Desk::with(&world, &RobotSpec { hull, ..default_robot() })
}

#[test]
fn a_wall_stops_the_wheels_and_stalls_the_motors() {
    for hull in
        [Hull::Circle { radius: 8.0 }, Hull::Rectangle { width: 14.0, length: 16.0, offset: 0.0 }]
    {
        let mut desk = corridor(hull);
        for motor in [B, C] {
            desk.run(motor, &[("speed_sp", 500)], "run-forever");
        }
        desk.step(5000);
        // The wall is 1 cm thick, the hull reaches 8 cm ahead.
        assert_near(desk.0.pose(), Pose::new(0.0, 51.5, 0.0), 0.1, 0.5);
        for motor in [B, C] {
            assert!(desk.state(motor).ends_with("stalled"), "{}", desk.state(motor));
            let counts = f64::from(desk.position(motor));
            assert!((counts / PER_CM - 51.5).abs() < 0.5, "wheels do not spin: {counts}");
        }
        assert_eq!(desk.0.trace().collision_count(), 1);
        for motor in [B, C] {
            desk.run(motor, &[("speed_sp", -300)], "run-forever");
        }
        desk.step(2000);
        assert!(desk.0.pose().y < 30.0, "drives away again: {:?}", desk.0.pose());
    }
}

#[test]
fn an_oblique_wall_is_never_passed() {
    for heading in [-75.0, -60.0, -30.0, -10.0, 10.0, 30.0, 60.0, 75.0] {
        for hull in [
            Hull::Circle { radius: 8.0 },
            Hull::Rectangle { width: 12.0, length: 20.0, offset: 3.0 },
        ] {
            let mut desk = corridor(hull);
            desk.0.place(Pose::new(0.0, 20.0, heading)).unwrap();
            for (motor, speed) in [(B, 700), (C, 600)] {
                desk.run(motor, &[("speed_sp", speed)], "run-forever");
            }
            for _ in 0..400 {
                desk.step(20);
                let pose = desk.0.pose();
                // A place that is free would be allowed; one in the wall is an error.
                assert!(
                    desk.0.place(pose).is_ok(),
                    "{hull:?} from {heading}: in the wall {pose:?}"
                );
                if pose.x.abs() < 80.0 {
                    assert!(pose.y < 52.0, "{hull:?} from {heading}: behind the wall {pose:?}");
                }
                for motor in [B, C] {
                    desk.run(motor, &[], "run-forever");
                }
            }
        }
    }
}

#[test]
fn a_free_wheel_and_a_jammed_one() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 300)], "run-forever");
    desk.step(2000);
    assert!(desk.0.pose().heading > 60.0, "turns around the other wheel");
    let mut desk = Desk::new();
    desk.0.jam(ev3_sim::Port::OutC, true);
    for motor in [B, C] {
        desk.run(motor, &[("speed_sp", 300)], "run-forever");
    }
    desk.step(2000);
    assert!(desk.state(C).ends_with("stalled"), "{}", desk.state(C));
    assert_eq!(desk.position(C), 0);
    assert_eq!(desk.state(B), "running");
}

#[test]
fn the_battery_sags_under_load() {
    let mut desk = Desk::with(
        &WorldSpec {
            bounds: Some(Bounds { low: [-20.0, -20.0], high: [20.0, 20.0] }),
            ..WorldSpec::default()
        },
        &default_robot(),
    );
    let volts = "power_supply/lego-ev3-battery/voltage_now";
    let rest = desk.number(volts);
    for motor in [B, C] {
        desk.run(motor, &[("duty_cycle_sp", 100)], "run-direct");
    }
    desk.step(3000);
    let load = desk.number(volts);
    assert!((300_000..700_000).contains(&(rest - load)), "{rest} {load}");
    assert!(desk.number("power_supply/lego-ev3-battery/current_now") > 2_000_000);
}
