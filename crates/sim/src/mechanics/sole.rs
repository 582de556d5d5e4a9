//! Dry friction of a thing on the floor.
//!
//! What slides and turns at once slides farther, and turns farther, than what does one of them
//! alone: the floor's hold is shared. So the impulse that the floor gives lies in an ellipsoid: at
//! most the friction against sliding, at most the friction at the mean radius against turning.

use crate::mechanics::limit::{Answer, Speeds};
use crate::world::Hull;

/// The floor's hold on a thing.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Floor {
    /// The friction against sliding, in N.
    pub(crate) force: f64,
    /// The radius at which it holds against turning, in m.
    pub(crate) radius: f64,
}

impl Floor {
    /// The mean distance of the points of an outline from its center, in m.
    pub(crate) fn radius_of(hull: Hull) -> f64 {
        let mean = match hull {
            Hull::Circle { radius } => radius * 2.0 / 3.0,
            Hull::Rectangle { width, length, .. } => {
                let (a, b) = (width / 2.0, length / 2.0);
                let corner = libm::hypot(a, b);
                let sides = |a: f64, b: f64| a * a * a * libm::log((b + corner) / a);
                (2.0 * a * b * corner + sides(a, b) + sides(b, a)) / (6.0 * a * b)
            }
        };
        mean / 100.0
    }
}

/// The floor under a thing in a step. Its impulse is a share of the most in each direction.
pub(super) struct Sole {
    /// The most against sliding, for a speed in cm/s, and against turning, in N m s.
    most: [f64; 2],
    /// Aside, ahead, turning; together at most 1.
    pub(super) share: [f64; 3],
    /// What share a speed asks for.
    pace: f64,
}

impl Sole {
    /// `answers` say how a speed over the floor, and one of turning, answer an impulse.
    pub(super) fn new(floor: Floor, [lightness, turn]: [f64; 2], seconds: f64) -> Sole {
        let force = floor.force * seconds / 100.0;
        let torque = floor.force * floor.radius * seconds;
        let stiff = (force * force * lightness).max(torque * torque * turn);
        let pace = if stiff > 0.0 { 1.0 / stiff } else { 0.0 };
        Sole { most: [force, torque], share: [0.0; 3], pace }
    }

    /// Gives the impulse that is missing, and answers by how much that changes a speed.
    pub(super) fn apply(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let [force, torque] = self.most;
        let asked = [force * speeds[2], force * speeds[3], torque * speeds[4]];
        let mut share = self.share;
        for (part, asked) in share.iter_mut().zip(asked) {
            *part -= self.pace * asked;
        }
        let long = libm::sqrt(share.iter().map(|part| part * part).sum());
        if long > 1.0 {
            share = share.map(|part| part / long);
        }
        self.give(share, speeds, answer)
    }

    /// Gives this share in the place of the one so far.
    pub(super) fn give(&mut self, share: [f64; 3], speeds: &mut Speeds, answer: &Answer) -> f64 {
        let [force, torque] = self.most;
        let mut change: f64 = 0.0;
        for (i, most) in [force, force, torque].into_iter().enumerate() {
            let step = (share[i] - self.share[i]) * most * answer.body[i];
            speeds[i + 2] += step;
            change = change.max(step.abs());
        }
        self.share = share;
        change
    }
}
