//! Poses and points. Headings are degrees, 0 = +y, clockwise positive, as a robot's `turn/2`.
//!
//! Sines and cosines come from the `libm` crate, not from the platform: the same bits everywhere.

use parry2d_f64::math::{Isometry, Rotation, Translation, Vector};

/// A vector, or a point as the vector to it.
pub(crate) type Vec2 = Vector<f64>;
/// A frame of reference in the world.
pub(crate) type Frame = Isometry<f64>;

/// The largest coordinate, in cm, and heading, in degrees: 10 km. Up to there sums of lengths keep
/// a thousand millionth of a cm.
const FARTHEST: f64 = 1e6;

/// What is wrong with a larger one.
pub(crate) const OUT_OF_RANGE: &str = "has a number beyond 1000000";

/// False for what is too large, and what is no number.
pub(crate) fn is_in_range(number: f64) -> bool {
    number.abs() <= FARTHEST
}

/// Where something is and which way it looks: centimeters and degrees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// To the right, in cm.
    pub x: f64,
    /// Up, in cm.
    pub y: f64,
    /// Degrees clockwise from +y.
    pub heading: f64,
}

impl Pose {
    /// A pose from its three numbers.
    #[must_use]
    pub const fn new(x: f64, y: f64, heading: f64) -> Pose {
        Pose { x, y, heading }
    }

    pub(crate) fn is_in_range(&self) -> bool {
        [self.x, self.y, self.heading].into_iter().all(is_in_range)
    }

    /// The frame whose x is to the right of this pose and whose y lies ahead of it.
    pub(crate) fn frame(&self) -> Frame {
        let (sin, cos) = sin_cos(self.heading);
        frame(self.point(), cos, -sin)
    }

    /// A pose given in this one's frame, in the world's.
    #[must_use]
    pub fn compose(&self, inner: &Pose) -> Pose {
        let point = outside(&self.frame(), inner.point());
        Pose { x: point.x, y: point.y, heading: self.heading + inner.heading }
    }

    pub(crate) fn point(&self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }
}

/// A frame at a point, turned counter-clockwise by the angle with this cosine and sine.
pub(crate) fn frame(at: Vec2, cos: f64, sin: f64) -> Frame {
    Frame::from_parts(Translation::from(at), Rotation::from_cos_sin_unchecked(cos, sin))
}

/// A point of a frame, in the world.
pub(crate) fn outside(frame: &Frame, point: Vec2) -> Vec2 {
    frame.rotation * point + frame.translation.vector
}

/// The length of a vector.
pub(crate) fn length(vector: Vec2) -> f64 {
    libm::hypot(vector.x, vector.y)
}

/// Sine and cosine of degrees.
pub(crate) fn sin_cos(degrees: f64) -> (f64, f64) {
    libm::sincos(degrees.to_radians())
}

/// The direction in which a heading points.
pub(crate) fn direction(heading: f64) -> Vec2 {
    let (sin, cos) = sin_cos(heading);
    Vec2::new(sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heading_is_clockwise_from_up() {
        let robot = Pose::new(10.0, 20.0, 90.0);
        let nose = robot.compose(&Pose::new(0.0, 5.0, 0.0));
        assert!((nose.x - 15.0).abs() < 1e-9 && (nose.y - 20.0).abs() < 1e-9, "{nose:?}");
        let right = robot.compose(&Pose::new(5.0, 0.0, 45.0));
        assert!((right.x - 10.0).abs() < 1e-9 && (right.y - 15.0).abs() < 1e-9, "{right:?}");
        assert!((right.heading - 135.0).abs() < 1e-9);
    }
}
