//! Where a robot is, from what its wheels and its gyro tell.
use ev3_driver::odometry::{Estimate, Pose, Wheels, wrapped};
use proptest::prelude::*;

const WHEELS: Wheels =
    Wheels { diameters: [5.6, 5.6], inverted: [false, false], axle: 10.6, offset: 0.0 };

fn near(a: Pose, b: Pose, within: f64) -> bool {
    (a.x - b.x).hypot(a.y - b.y) <= within && (a.heading - b.heading).abs() <= within
}

#[test]
fn a_quarter_circle_to_the_right_ends_ahead_and_to_the_right() {
    let mut estimate = Estimate::default();
    let quarter = std::f64::consts::FRAC_PI_2;
    estimate.roll(&WHEELS, [quarter * 25.3, quarter * 14.7], 1.0);
    assert!(near(estimate.pose(), Pose { x: 20.0, y: 20.0, heading: 90.0 }, 1e-9));
}

#[test]
fn a_wheel_whose_motor_is_inverted_rolls_the_other_way() {
    let wheels = Wheels { inverted: [true, false], ..WHEELS };
    assert!(wheels.cm_per_count(0, 360.0) < 0.0);
    assert!((wheels.cm_per_count(1, 360.0) * 360.0 - 17.593).abs() < 0.001);
}

#[test]
fn what_the_gyro_shows_first_is_its_zero() {
    let mut estimate = Estimate::default();
    estimate.see(123.0);
    assert!(near(estimate.pose(), Pose::default(), 1e-9));
}

#[test]
fn readings_that_agree_change_little_and_those_that_do_not_turn_the_robot() {
    let mut estimate = Estimate::default();
    estimate.see(0.0);
    for step in 0..50 {
        // The left wheel slips: the robot turns, and the wheels do not tell.
        estimate.roll(&WHEELS, [1.0, 1.0], 0.05);
        estimate.see((f64::from(step) / 5.0).round());
    }
    let heading = estimate.pose().heading;
    assert!((heading - 10.0).abs() < 1.5, "{heading}");
}

#[test]
fn a_gyro_that_starts_anew_does_not_turn_the_robot() {
    let mut estimate = Estimate::default();
    estimate.see(0.0);
    estimate.roll(&WHEELS, [10.0, -10.0], 1.0);
    let turned = estimate.pose().heading;
    estimate.see(turned.round());
    estimate.see(0.0);
    assert!((estimate.pose().heading - turned).abs() < 1.0);
}

#[test]
fn drift_shows_at_rest() {
    let mut estimate = Estimate::default();
    for step in 0..100 {
        estimate.roll(&WHEELS, [0.0, 0.0], 0.1);
        estimate.see((f64::from(step) * 0.1 * -1.5).round());
    }
    assert!((estimate.drift() + 1.5).abs() < 0.1, "{}", estimate.drift());
    assert!(estimate.pose().heading.abs() < 2.0, "{}", estimate.pose().heading);
}

#[test]
fn a_place_that_is_known_is_certain() {
    let mut estimate = Estimate::default();
    estimate.roll(&WHEELS, [100.0, 90.0], 5.0);
    assert!(estimate.uncertainty()[0][0] > 0.0);
    estimate.place(Pose { x: 1.0, y: 2.0, heading: 3.0 });
    assert_eq!(estimate.uncertainty(), [[0.0; 3]; 3]);
    assert!(near(estimate.pose(), Pose { x: 1.0, y: 2.0, heading: 3.0 }, 1e-9));
}

fn way() -> impl Strategy<Value = f64> {
    -30.0..30.0
}

proptest! {
    /// An arc is the same in one piece or in many.
    #[test]
    fn arcs_may_be_cut(left in way(), right in way(), pieces in 1_u32..50) {
        let (mut whole, mut cut) = (Estimate::default(), Estimate::default());
        whole.roll(&WHEELS, [left, right], 1.0);
        let share = 1.0 / f64::from(pieces);
        for _ in 0..pieces {
            cut.roll(&WHEELS, [left * share, right * share], share);
        }
        prop_assert!(near(whole.pose(), cut.pose(), 1e-6));
    }

    /// What is rolled back is undone.
    #[test]
    fn ways_back_undo(steps in prop::collection::vec((way(), way()), 1..20)) {
        let mut estimate = Estimate::default();
        for (left, right) in &steps {
            estimate.roll(&WHEELS, [*left, *right], 0.1);
        }
        for (left, right) in steps.iter().rev() {
            estimate.roll(&WHEELS, [-left, -right], 0.1);
        }
        prop_assert!(near(estimate.pose(), Pose::default(), 1e-6));
    }

    /// The covariance stays one: no negative variances, symmetric.
    #[test]
    fn covariances_stay_so(
        steps in prop::collection::vec((way(), way(), -3.0_f64..3.0), 1..200),
    ) {
        let mut estimate = Estimate::default();
        for (left, right, off) in steps {
            estimate.roll(&WHEELS, [left / 10.0, right / 10.0], 0.02);
            estimate.see((estimate.pose().heading + off).round());
            let p = estimate.uncertainty();
            for i in 0..3 {
                prop_assert!(p[i][i] >= -1e-9);
                for j in 0..3 {
                    prop_assert!((p[i][j] - p[j][i]).abs() <= 1e-6 * (1.0 + p[i][j].abs()));
                    prop_assert!(p[i][j] * p[i][j] <= p[i][i] * p[j][j] * 1.001 + 1e-9);
                }
            }
            let pose = estimate.pose();
            prop_assert!(pose.x.is_finite() && pose.y.is_finite() && pose.heading.is_finite());
        }
    }

    /// Way and turn, and the ways of the wheels, tell the same.
    #[test]
    fn twists_and_ways_agree(left in way(), right in way()) {
        let (way, turn) = WHEELS.twist([left, right]);
        let [l, r] = WHEELS.ways(way, turn);
        prop_assert!((l - left).abs() < 1e-9 && (r - right).abs() < 1e-9);
    }

    /// Wrapped headings point the same way.
    #[test]
    fn wrapped_headings_are_within_half_a_turn(heading in -1e5_f64..1e5) {
        let short = wrapped(heading);
        prop_assert!(short > -180.0 && short <= 180.0);
        let turns = (heading - short) / 360.0;
        prop_assert!((turns - turns.round()).abs() < 1e-6);
    }
}
