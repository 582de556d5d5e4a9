//! The probability of a measurement, and the uncertainty of a move.
use ev3_motion::{Pose, wrapped};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg32;

/// Farther the sensor hears nothing, in cm.
pub const FAR: f64 = 255.0;

/// What an ultrasonic sensor may measure where a map says something. Shares add up to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Model {
    /// How far its cone goes to each side, in degrees.
    pub half_angle: f64,
    /// Standard deviation of a good measurement, in cm, and what is added for each cm.
    pub sigma: [f64; 2],
    /// The share of good measurements.
    pub hit: f64,
    /// The share of those of something nearer that the map lacks.
    pub short: f64,
    /// The share of those that hear nothing.
    pub missing: f64,
    /// The share of those that may be anything.
    pub random: f64,
    /// The power to which a likelihood is raised, as measurements from places near to one another
    /// have much the same errors: 1 takes each for a new one.
    pub exponent: f64,
}

impl Default for Model {
    fn default() -> Self {
        Model {
            half_angle: 15.0,
            sigma: [2.0, 0.02],
            hit: 0.75,
            short: 0.10,
            missing: 0.08,
            random: 0.07,
            exponent: 0.6,
        }
    }
}

impl Model {
    /// How likely it is to hear something at a distance in cm where the map has it at
    /// `expected`; `None` is nothing. A deviation in cm adds to that of the model.
    pub fn likelihood(&self, expected: Option<f64>, heard: Option<f64>, more: f64) -> f64 {
        let anything = self.random / FAR;
        match (expected, heard) {
            (None, None) => self.hit + self.missing,
            (Some(_), None) => self.missing,
            (None, Some(_)) => anything + self.short / FAR,
            (Some(expected), Some(heard)) => {
                let sigma = self.deviation(expected) + more;
                let off = (heard - expected) / sigma;
                let hit = self.hit * PEAK / sigma * libm::exp(-0.5 * off * off);
                let short = if heard < expected { self.short / expected.max(1.0) } else { 0.0 };
                hit + short + anything
            }
        }
    }

    /// How well a measurement of that likelihood fits, from 0 to 1: its ratio to the likelihood
    /// of what the map says.
    pub(crate) fn fit(&self, expected: Option<f64>, likelihood: f64) -> f64 {
        let hit = |expected: f64| self.hit * PEAK / self.deviation(expected);
        let peak =
            expected.map_or(self.hit + self.missing, |expected| hit(expected) + self.random / FAR);
        (likelihood / peak).min(1.0)
    }

    fn deviation(&self, expected: f64) -> f64 {
        self.sigma[0] + self.sigma[1] * expected
    }
}

/// The density of the bell curve in its middle.
const PEAK: f64 = 0.398_942_280_401_432_7;

/// How uncertain a move is: standard deviations after 1 cm or 1 degree, which grow with the
/// square root of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wander {
    /// Of the way, in cm after 1 cm.
    pub way: f64,
    /// Of the heading, in degrees after a turn by 1 degree.
    pub turn: f64,
    /// Of the heading, in degrees after 1 cm.
    pub drift: f64,
}

impl Wander {
    /// With a gyro.
    pub const GYRO: Wander = Wander { way: 0.1, turn: 0.12, drift: 0.2 };
    /// By the wheels alone.
    pub const WHEELS: Wander = Wander { way: 0.1, turn: 0.2, drift: 0.5 };
}

/// A move as the robot sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Move {
    /// To the right and ahead, in cm.
    pub(crate) by: [f64; 2],
    pub(crate) way: f64,
    pub(crate) turn: f64,
}

impl Move {
    /// From one pose to another, full turns left out.
    pub(crate) fn between(from: Pose, to: Pose) -> Move {
        let (sin, cos) = libm::sincos(from.heading.to_radians());
        let [x, y] = [to.x - from.x, to.y - from.y];
        let by = [x * cos - y * sin, x * sin + y * cos];
        Move { by, way: libm::hypot(x, y), turn: wrapped(to.heading - from.heading) }
    }

    /// The pose after it.
    pub(crate) fn from(self, pose: Pose) -> Pose {
        let [right, ahead] = self.by;
        let (sin, cos) = libm::sincos(pose.heading.to_radians());
        Pose {
            x: pose.x + right * cos + ahead * sin,
            y: pose.y - right * sin + ahead * cos,
            heading: pose.heading + self.turn,
        }
    }

    /// One of the moves that it may have been.
    pub(crate) fn drawn(self, wander: Wander, generator: &mut Pcg32) -> Move {
        let along = wander.way * self.way.sqrt();
        let turned = wander.turn * wander.turn * self.turn.abs();
        let around = (turned + wander.drift * wander.drift * self.way).sqrt();
        let [right, ahead] = self.by;
        Move {
            by: [right + bell(generator) * along * 0.5, ahead + bell(generator) * along],
            turn: self.turn + bell(generator) * around,
            ..self
        }
    }
}

pub(crate) fn bell(generator: &mut Pcg32) -> f64 {
    StandardNormal.sample(generator)
}
