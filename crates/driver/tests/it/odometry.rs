//! The pose of a robot, from its wheels and its gyro.
use ev3_driver::drive::odometry::{Estimate, Wheels};
use ev3_motion::{Pose, wrapped};
use proptest::prelude::*;

const WHEELS: Wheels = Wheels::new([5.6, 5.6], [false, false], 10.6, 0.0);

fn near(a: Pose, b: Pose, within: f64) -> bool {
    (a.x - b.x).hypot(a.y - b.y) <= within && (a.heading - b.heading).abs() <= within
}

#[test]
fn a_quarter_circle_to_the_right_ends_ahead_and_to_the_right() {
    let mut estimate = Estimate::default();
    let quarter = std::f64::consts::FRAC_PI_2;
    estimate.predict(&WHEELS, [quarter * 25.3, quarter * 14.7], 1.0);
    assert!(near(estimate.pose(), Pose { x: 20.0, y: 20.0, heading: 90.0 }, 1e-9));
}

#[test]
fn a_wheel_whose_motor_is_inverted_rolls_the_other_way() {
    let wheels = Wheels::new(WHEELS.diameters, [true, false], WHEELS.axle(), 0.0);
    assert!(wheels.cm_per_count(0, 360.0) < 0.0);
    assert!((wheels.cm_per_count(1, 360.0) * 360.0 - 17.593).abs() < 0.001);
}

#[test]
fn what_the_gyro_shows_first_is_its_zero() {
    let mut estimate = Estimate::default();
    estimate.observe_gyro(123.0);
    assert!(near(estimate.pose(), Pose::default(), 1e-9));
}

#[test]
fn readings_that_agree_change_little_and_those_that_do_not_turn_the_robot() {
    let mut estimate = Estimate::default();
    estimate.observe_gyro(0.0);
    for step in 0..50 {
        // The left wheel slips: the robot turns, and the wheels do not show it.
        estimate.predict(&WHEELS, [1.0, 1.0], 0.05);
        estimate.observe_gyro((f64::from(step) / 5.0).round());
    }
    let heading = estimate.pose().heading;
    assert!((heading - 10.0).abs() < 1.5, "{heading}");
}

#[test]
fn a_gyro_that_starts_anew_does_not_turn_the_robot() {
    let mut estimate = Estimate::default();
    estimate.observe_gyro(0.0);
    estimate.predict(&WHEELS, [10.0, -10.0], 1.0);
    let turned = estimate.pose().heading;
    estimate.observe_gyro(turned.round());
    estimate.observe_gyro(0.0);
    assert!((estimate.pose().heading - turned).abs() < 1.0);
}

#[test]
fn drift_shows_at_rest() {
    let mut estimate = Estimate::default();
    for step in 0..100 {
        estimate.predict(&WHEELS, [0.0, 0.0], 0.1);
        estimate.observe_gyro((f64::from(step) * 0.1 * -1.5).round());
    }
    assert!((estimate.drift() + 1.5).abs() < 0.1, "{}", estimate.drift());
    assert!(estimate.pose().heading.abs() < 2.0, "{}", estimate.pose().heading);
}

#[test]
fn a_place_that_is_known_is_certain() {
    let mut estimate = Estimate::default();
    estimate.predict(&WHEELS, [100.0, 90.0], 5.0);
    assert!(estimate.uncertainty()[0][0] > 0.0);
    estimate.set_pose(Pose { x: 1.0, y: 2.0, heading: 3.0 });
    assert_eq!(estimate.uncertainty(), [[0.0; 3]; 3]);
    assert!(near(estimate.pose(), Pose { x: 1.0, y: 2.0, heading: 3.0 }, 1e-9));
}

/// A robot whose wheels and axle are not what it thinks they are.
struct Ride {
    estimate: Estimate,
    truth: Estimate,
    /// By what share each wheel rolls more than it should, and the robot turns.
    errors: [f64; 3],
    /// Degrees a second; nothing for a robot without a gyro.
    drift: Option<f64>,
    /// Degrees that the motors have turned, and seconds.
    angles: [f64; 2],
    seconds: f64,
}

impl Ride {
    const STEP: f64 = 0.02;

    fn new(errors: [f64; 3], drift: Option<f64>) -> Self {
        let (estimate, truth) = (Estimate::default(), Estimate::default());
        Self { estimate, truth, errors, drift, angles: [0.0; 2], seconds: 0.0 }
    }

    /// Speed in cm/s and rate of turn in degrees a second, by the wheels.
    fn go(&mut self, speed: f64, rate: f64, seconds: f64) {
        let end = self.seconds + seconds;
        while self.seconds < end {
            let ways = WHEELS.ways(speed * Self::STEP, rate.to_radians() * Self::STEP);
            let [left, right, axle] = self.errors;
            let axle = WHEELS.axle() / (1.0 + axle);
            let really = Wheels::new(WHEELS.diameters, WHEELS.inverted, axle, 0.0);
            self.truth.predict(
                &really,
                [ways[0] * (1.0 + left), ways[1] * (1.0 + right)],
                Self::STEP,
            );
            // Both encoders and the gyro report whole degrees.
            let per_degree = WHEELS.cm_per_count(0, 360.0);
            let told = std::array::from_fn(|side| {
                let before = self.angles[side].round();
                self.angles[side] += ways[side] / per_degree;
                (self.angles[side].round() - before) * per_degree
            });
            self.seconds += Self::STEP;
            self.estimate.predict(&WHEELS, told, Self::STEP);
            if let Some(drift) = self.drift {
                let shown = self.truth.pose().heading + drift * self.seconds;
                self.estimate.observe_gyro(shown.round());
            }
        }
    }

    /// How far the heading is off, in degrees.
    fn off(&self) -> f64 {
        self.estimate.pose().heading - self.truth.pose().heading
    }
}

#[test]
fn a_long_turn_is_the_gyros() {
    for errors in [[0.0, 0.0, 0.05], [0.0, 0.0, -0.05], [-0.05, -0.05, 0.0], [-0.05, 0.0, 0.0]] {
        let mut ride = Ride::new(errors, Some(0.02));
        ride.go(0.0, 0.0, 10.0);
        ride.go(0.0, 60.0, 60.0);
        assert!(ride.off().abs() < 2.0, "{errors:?}: {}", ride.off());
        let drift = ride.estimate.drift();
        assert!((drift - 0.02).abs() < 0.03, "{errors:?}: {drift}");
    }
}

#[test]
fn without_rest_too() {
    let mut ride = Ride::new([0.0, 0.0, -0.05], Some(0.02));
    ride.go(0.0, 60.0, 60.0);
    assert!(ride.off().abs() < 4.0, "{}", ride.off());
}

#[test]
fn what_the_gyro_has_taught_stays_when_it_is_gone() {
    let mut ride = Ride::new([0.0, -0.03, 0.05], Some(0.02));
    ride.go(0.0, 0.0, 10.0);
    ride.go(20.0, 0.0, 10.0);
    ride.go(0.0, 60.0, 12.0);
    ride.estimate.gyro_lost();
    ride.drift = None;
    let before = ride.off();
    ride.go(0.0, -60.0, 30.0);
    ride.go(20.0, 0.0, 10.0);
    // By the wheels as they should be it would be 100 degrees.
    assert!((ride.off() - before).abs() < 8.0, "{before} and then {}", ride.off());
}

#[test]
fn other_wheels_are_not_the_ones_that_were_learned() {
    let mut ride = Ride::new([0.0, -0.03, 0.05], Some(0.02));
    ride.go(20.0, 60.0, 20.0);
    ride.estimate.gyro_lost();
    let before = ride.estimate.pose();
    ride.estimate.forget_wheels();
    assert!(near(ride.estimate.pose(), before, 1e-9));
    let half = std::f64::consts::PI * WHEELS.axle() / 2.0;
    ride.estimate.predict(&WHEELS, [half, -half], 1.0);
    let turned = ride.estimate.pose().heading - before.heading;
    assert!((turned - 180.0).abs() < 1e-6, "{turned}");
}

#[test]
fn drift_that_is_more_than_thought_is_known_as_well_from_all_of_a_rest() {
    for drift in [0.3, -0.5, 1.0, -2.0] {
        let mut ride = Ride::new([0.0; 3], Some(drift));
        ride.go(0.0, 0.0, 10.0);
        assert!((ride.estimate.drift() - drift).abs() < 0.05, "{drift}: {}", ride.estimate.drift());
    }
}

fn way() -> impl Strategy<Value = f64> {
    -30.0..30.0
}

#[test]
fn a_pose_is_as_uncertain_as_wheels_and_axle() {
    let deviation = |speed, rate, seconds| {
        let mut ride = Ride::new([0.0; 3], None);
        ride.go(speed, rate, seconds);
        ride.estimate.uncertainty()[2][2].sqrt()
    };
    // 3 % of two turns, and 1 % of 2 m that one wheel rolls more.
    let turned = deviation(0.0, 60.0, 12.0);
    assert!((turned - 21.6).abs() < 1.0, "{turned}");
    let ahead = deviation(20.0, 0.0, 10.0);
    assert!((ahead - (2.0_f64 / 10.6).to_degrees()).abs() < 1.0, "{ahead}");
}

/// The ways of both wheels; the robot may rest.
fn step() -> impl Strategy<Value = (f64, f64)> {
    prop_oneof![3 => Just((0.0, 0.0)), 1 => (way(), way())]
}

proptest! {
    /// An arc is the same in one piece or in many.
    #[test]
    fn arcs_may_be_cut(left in way(), right in way(), pieces in 1_u32..50) {
        let (mut whole, mut cut) = (Estimate::default(), Estimate::default());
        whole.predict(&WHEELS, [left, right], 1.0);
        let share = 1.0 / f64::from(pieces);
        for _ in 0..pieces {
            cut.predict(&WHEELS, [left * share, right * share], share);
        }
        prop_assert!(near(whole.pose(), cut.pose(), 1e-6));
    }

    /// Rolling back undoes what rolling has done.
    #[test]
    fn ways_back_undo(steps in prop::collection::vec((way(), way()), 1..20)) {
        let mut estimate = Estimate::default();
        for (left, right) in &steps {
            estimate.predict(&WHEELS, [*left, *right], 0.1);
        }
        for (left, right) in steps.iter().rev() {
            estimate.predict(&WHEELS, [-left, -right], 0.1);
        }
        prop_assert!(near(estimate.pose(), Pose::default(), 1e-6));
    }

    /// The covariance stays one: no negative variances, symmetric.
    #[test]
    fn covariances_stay_so(
        steps in prop::collection::vec((step(), -3.0_f64..3.0), 1..200),
        drift in -3.0_f64..3.0,
    ) {
        let mut estimate = Estimate::default();
        for (count, ((left, right), off)) in (0_u32..).zip(steps) {
            estimate.predict(&WHEELS, [left / 10.0, right / 10.0], 0.1);
            let drifted = f64::from(count) * 0.1 * drift;
            estimate.observe_gyro((estimate.pose().heading + drifted + off).round());
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

    /// Whatever wheels and axle are like, the gyro knows better.
    #[test]
    fn with_a_gyro_the_heading_is_right(
        left in -0.02_f64..0.02, right in -0.02_f64..0.02, axle in -0.05_f64..0.05,
        drift in -0.03_f64..0.03,
        moves in prop::collection::vec((-30.0_f64..30.0, -90.0_f64..90.0, 0.5_f64..4.0), 1..12),
    ) {
        let mut ride = Ride::new([left, right, axle], Some(drift));
        ride.go(0.0, 0.0, 10.0);
        for (speed, rate, seconds) in moves {
            ride.go(speed, rate, seconds);
            prop_assert!(ride.off().abs() < 3.0, "{}", ride.off());
        }
    }

    /// Without one the pose is as uncertain as wheels and axle.
    #[test]
    fn without_a_gyro_the_errors_of_the_wheels_are_in_the_covariance(
        left in -0.0075_f64..0.0075, right in -0.0075_f64..0.0075, axle in -0.03_f64..0.03,
        moves in prop::collection::vec((-30.0_f64..30.0, -60.0_f64..60.0, 0.5_f64..3.0), 1..6),
    ) {
        let mut ride = Ride::new([left, right, axle], None);
        let (mut way, mut bent) = (0.0, 0.0_f64);
        for (speed, rate, seconds) in moves {
            ride.go(speed, rate, seconds);
            way += speed.abs() * seconds;
            bent = bent.max(ride.off().to_radians().abs());
        }
        let (pose, truth) = (ride.estimate.pose(), ride.truth.pose());
        let variances = ride.estimate.uncertainty();
        // Each of the three errors is within its standard deviation, so what they do together is
        // within the root of 3; but that arcs are no straight lines, and that encoders report whole
        // degrees.
        let off = [pose.x - truth.x, pose.y - truth.y, pose.heading - truth.heading];
        let curved = way * bent * bent;
        for (state, more) in [curved, curved, 0.0].into_iter().enumerate() {
            let within = (3.0 * variances[state][state]).sqrt() + more + 0.4;
            prop_assert!(off[state].abs() < within, "{state}: {} of {within}", off[state]);
        }
    }

    /// Way and turn, and the ways of the wheels, say the same.
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
