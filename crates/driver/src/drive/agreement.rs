//! A test whether the gyro follows the wheels.
//!
//! A gyro that is mounted upside down counts the other way, and so does one whose robot has its
//! left and right motor swapped. Steering by it turns the robot farther from its course with each
//! correction. A gyro that shows no turn is broken, or the wheels spin on the spot. Both show
//! within a short turn, and wheels that merely slip, or an axle that was measured badly, do not
//! look like either.
//!
//! A robot that has one motor mounted backwards spins while its wheels seem to go straight. It
//! turns by as much as its wheels would if one of them ran the other way. An obstacle turns a robot
//! less: a robot with one wheel held turns by half of that.
use crate::drive::motion::{PERIOD, seconds};
use std::time::Duration;

/// The time in which the robot must turn far enough for a comparison. Slower
/// than that, the gyro's drift may look like a turn.
const WINDOW: Duration = Duration::from_secs(4);

/// A turn by the wheels, in degrees, after which the gyro must not show one of
/// at least [`OPPOSITE`] the other way.
const SHORT_TURN: f64 = 20.0;

/// See [`SHORT_TURN`]; less may be due to lag.
const OPPOSITE: f64 = 10.0;

/// A turn by the wheels, in degrees, of which the gyro must show a share of [`FOLLOWS`].
const LONG_TURN: f64 = 45.0;

/// See [`LONG_TURN`].
const FOLLOWS: f64 = 0.25;

/// The share of a turn by wheels of which one runs the other way, from [`LONG_TURN`] on, that the
/// gyro must not show while they seem to go straight.
const SPINS: f64 = 0.75;

/// The share of such a turn up to which wheels go straight.
const STRAIGHT: f64 = 0.5;

/// No robot turns faster, in degrees a second. If the gyro shows more, it
/// restarted with another zero, or its 16 bits overflowed.
const FASTEST: f64 = 600.0;

/// How far it turns at most in a period, in degrees. Less is not a leap, however much time
/// has passed, and need not be compared with that.
const SHORT_LEAP: f64 = FASTEST * PERIOD.as_secs_f64();

/// A comparison of the gyro with the wheels over the latest part of a motion.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Agreement {
    /// What the comparison starts from.
    start: Option<Start>,
    /// Degrees that the robot has turned since, by its wheels.
    turned: f64,
    /// The same if one of them ran the other way.
    reversed: f64,
    /// When the last sample was, and what the gyro showed.
    sampled: Duration,
    shown: f64,
    is_broken: bool,
}

#[derive(Clone, Copy, Debug)]
struct Start {
    at: Duration,
    shown: f64,
}

impl Agreement {
    /// A sample: the robot has turned by this many degrees since the one before,
    /// by its wheels, or `reversed` if one of them ran the other way, and the gyro shows `angle`.
    pub(super) fn sample(&mut self, now: Duration, turned: f64, reversed: f64, angle: f64) {
        let passed = now.saturating_sub(self.sampled).max(PERIOD);
        let leap = (angle - self.shown).abs();
        let jumped = leap > SHORT_LEAP && leap > FASTEST * seconds(passed);
        (self.sampled, self.shown) = (now, angle);
        let is_recent = |start: &Start| now.saturating_sub(start.at) <= WINDOW;
        let Some(start) = self.start.filter(|start| is_recent(start) && !jumped) else {
            self.restart(now);
            return;
        };
        self.turned += turned;
        self.reversed += reversed;
        let beyond = (angle - start.shown - self.turned).abs();
        let by_gyro = (angle - start.shown) * self.turned.signum();
        let spin = self.reversed.abs();
        let by_wheels = self.turned.abs();
        if by_wheels >= SHORT_TURN && by_gyro <= -OPPOSITE
            || by_wheels >= LONG_TURN && by_gyro < by_wheels * FOLLOWS
            || spin >= LONG_TURN && by_wheels <= spin * STRAIGHT && beyond >= spin * SPINS
        {
            self.is_broken = true;
        } else if by_wheels >= LONG_TURN {
            self.restart(now);
        }
    }

    /// Whether the gyro has contradicted the wheels since the last [`default`](Self::default).
    pub(super) fn is_broken(&self) -> bool {
        self.is_broken
    }

    fn restart(&mut self, now: Duration) {
        (self.turned, self.reversed) = (0.0, 0.0);
        self.start = Some(Start { at: now, shown: self.shown });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Samples a turn at a rate in degrees per second, 20 ms each; the gyro shows
    /// `shows` of it. Answers by how far the wheels had turned when it broke.
    fn broken_at(rate: f64, degrees: f64, shows: impl Fn(f64) -> f64) -> Option<f64> {
        let (mut agreement, mut turned, mut now) = (Agreement::default(), 0.0, Duration::ZERO);
        agreement.sample(now, 0.0, 0.0, shows(0.0).round());
        while turned < degrees {
            let by = rate * 0.02;
            turned += by.abs();
            now += Duration::from_millis(20);
            agreement.sample(now, by, 0.0, shows(turned * rate.signum()).round());
            if agreement.is_broken() {
                return Some(turned);
            }
        }
        None
    }

    #[test]
    fn a_gyro_that_counts_the_other_way_shows_after_20_degrees() {
        for rate in [10.0, -10.0, 90.0, 400.0, -400.0] {
            let at = broken_at(rate, 720.0, |turned| 1234.0 - turned);
            assert!(at.is_some_and(|at| at < 30.0), "{rate}: {at:?}");
        }
    }

    #[test]
    fn a_gyro_that_does_not_follow_shows_after_45_degrees() {
        for rate in [20.0, -90.0, 400.0] {
            let at = broken_at(rate, 720.0, |_| -7.0);
            assert!(at.is_some_and(|at| at < 60.0), "{rate}: {at:?}");
        }
    }

    #[test]
    fn wheels_that_slip_and_a_wrong_axle_are_no_contradiction() {
        for rate in [3.0, -20.0, 90.0, 400.0] {
            for share in [0.4, 0.8, 1.0, 1.3, 2.0] {
                assert_eq!(broken_at(rate, 720.0, |turned| turned * share), None);
            }
        }
    }

    #[test]
    fn a_gyro_that_lags_is_no_contradiction() {
        // By 60 ms at half a turn per second.
        assert_eq!(broken_at(180.0, 720.0, |turned| (turned - 11.0).max(0.0)), None);
    }

    #[test]
    fn neither_is_one_that_drifts_while_the_robot_goes_straight() {
        let mut agreement = Agreement::default();
        for step in 0..3000_u32 {
            let seconds = f64::from(step) * 0.02;
            let now = Duration::from_millis(u64::from(step) * 20);
            // Steering turns the robot slowly to where the gyro shows none.
            agreement.sample(now, 2.0 * 0.02, 40.0 * 0.02, -(2.0 * seconds).round());
        }
        assert!(!agreement.is_broken());
    }

    /// Goes straight, so fast that it would spin at a rate in degrees per second if one wheel ran
    /// the other way; the gyro shows this share of it.
    fn goes_straight(rate: f64, share: f64) -> bool {
        let mut agreement = Agreement::default();
        for step in 0..1000_u32 {
            let now = Duration::from_millis(u64::from(step) * 20);
            let spin = rate * 0.02;
            agreement.sample(now, 0.0, spin, (spin * share * f64::from(step)).round());
        }
        !agreement.is_broken()
    }

    #[test]
    fn a_robot_that_spins_while_its_wheels_go_straight_shows() {
        for rate in [15.0, -55.0, 500.0] {
            for share in [-1.2, -0.85, 0.85, 1.0, 1.2] {
                assert!(!goes_straight(rate, share), "{share} of {rate}");
            }
        }
    }

    #[test]
    fn a_robot_that_something_turns_while_its_wheels_go_straight_is_no_contradiction() {
        for rate in [15.0, -55.0, 500.0] {
            for share in [-0.6, -0.1, 0.0, 0.3, 0.6] {
                assert!(goes_straight(rate, share), "{share} of {rate}");
            }
        }
    }

    #[test]
    fn neither_is_one_that_restarts_with_another_zero() {
        let restarts = |turned: f64| if turned < 60.0 { turned } else { turned - 60.0 };
        assert_eq!(broken_at(90.0, 300.0, restarts), None);
        let overflows =
            |turned: f64| if turned < 30.0 { 32_730.0 + turned } else { turned - 32_800.0 };
        assert_eq!(broken_at(90.0, 300.0, overflows), None);
    }
}
