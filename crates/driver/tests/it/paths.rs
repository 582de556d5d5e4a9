//! Steering along lines and arcs.
use ev3_driver::drive::odometry::Wheels;
use ev3_driver::drive::steering::{Leg, Limits, Order, Steering};
use ev3_motion::Pose;
use proptest::prelude::*;

const WHEELS: Wheels = Wheels::new([5.6, 5.6], [false, false], 10.6, 0.0);
const LIMITS: Limits = Limits { speed: 20.0, acceleration: 50.0 };

/// Steers a robot whose motors follow with a lag of 30 ms, and whose wheels make
/// these shares of their speed; where it ends, and how far it rolled.
fn steered(legs: Vec<Leg>, is_backwards: bool, shares: [f64; 2]) -> Option<(Pose, f64)> {
    let mut pose = Pose::default();
    let mut steering = Steering::along(WHEELS, LIMITS, is_backwards, legs, (pose, None));
    let (mut length, mut next, mut rolling) = (0.0, None, [0.0; 2]);
    for _ in 0..5000 {
        let order = match next.take() {
            Some(order) => order,
            None => steering.step(pose, 0.02),
        };
        let ways = match order {
            Order::Arrived => return Some((pose, length)),
            Order::Roll(speeds) => {
                assert!(speeds.iter().all(|speed| speed.abs() < 60.0), "{speeds:?}");
                for side in 0..2 {
                    rolling[side] += (speeds[side] * shares[side] - rolling[side]) * 0.4;
                }
                rolling.map(|speed| speed * 0.02)
            }
            Order::Land(ways) => {
                rolling = [0.0; 2];
                ways
            }
        };
        let (way, turn) = WHEELS.twist(ways);
        pose = pose.along_arc(way, turn.to_degrees());
        length += way.abs();
        if matches!(order, Order::Land(_)) {
            next = steering.landed(pose);
        }
    }
    None
}

#[test]
fn a_wheel_that_lags_is_made_up_for() {
    let line = vec![Leg::Arc(100.0, 0.0)];
    let (pose, _) = steered(line, false, [1.0, 0.9]).unwrap();
    assert!(pose.x.abs() < 1.0 && (pose.y - 100.0).abs() < 0.1, "{pose:?}");
    assert!(pose.heading.abs() < 0.1, "{pose:?}");
}

/// A line of a millimeter before the first corner, and none at all: the robot faces
/// the way before it rolls.
#[test]
fn a_path_may_begin_with_its_corner() {
    for (points, radius) in [
        (vec![[13.337, -12.425], [44.264, 16.837]], 19.273),
        (vec![[0.175, -3.727], [31.905, -29.255]], 7.987),
        (vec![[10.0, 0.0], [10.0, 30.0]], 10.0),
    ] {
        let last = points[1];
        let (pose, _) = steered(vec![Leg::Through(points, radius)], false, [1.0, 1.0]).unwrap();
        assert!((pose.x - last[0]).hypot(pose.y - last[1]) < 0.7, "{pose:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// Each move ends where it should, front or rear first.
    #[test]
    fn places_are_reached(x in -80.0_f64..80.0, y in -80.0_f64..80.0, is_backwards: bool) {
        let legs = vec![Leg::Towards([x, y]), Leg::To([x, y]), Leg::Face(30.0)];
        let (pose, _) = steered(legs, is_backwards, [1.0, 1.0]).unwrap();
        prop_assert!((pose.x - x).hypot(pose.y - y) < 0.5, "{:?}", pose);
        prop_assert!((pose.heading - 30.0).rem_euclid(360.0).min(
            (30.0 - pose.heading).rem_euclid(360.0)) < 0.6, "{:?}", pose);
    }

    /// Arcs keep their radius and end with their heading.
    #[test]
    fn arcs_end_where_they_should(
        radius in 3.0_f64..80.0,
        degrees in 10.0_f64..400.0,
        side in prop::sample::select(vec![-1.0, 1.0]),
        is_backwards: bool,
    ) {
        let length = radius * degrees.to_radians();
        let legs = vec![Leg::Arc(length, side / radius)];
        let travel = if is_backwards { 180.0 } else { 0.0 };
        let start = Pose { heading: travel, ..Pose::default() };
        let end = start.along_arc(length, side * degrees);
        let (pose, rolled) = steered(legs, is_backwards, [1.0, 1.0]).unwrap();
        prop_assert!((pose.x - end.x).hypot(pose.y - end.y) < 0.5, "{:?} {:?}", pose, end);
        prop_assert!((pose.heading + travel - end.heading).abs() < 1.0, "{:?}", pose);
        prop_assert!((rolled - length).abs() < 0.02 * length + 0.5);
    }

    /// A path with rounded corners passes through no point in particular, but ends at the last.
    #[test]
    fn paths_end_at_the_last_point(
        points in prop::collection::vec((-60.0_f64..60.0, -60.0_f64..60.0), 1..6),
        radius in 0.0_f64..30.0,
    ) {
        let points: Vec<[f64; 2]> = points.into_iter().map(|(x, y)| [x, y]).collect();
        let last = points[points.len() - 1];
        let (pose, _) = steered(vec![Leg::Through(points, radius)], false, [1.0, 1.0]).unwrap();
        prop_assert!((pose.x - last[0]).hypot(pose.y - last[1]) < 0.7, "{:?} {:?}", pose, last);
    }
}
