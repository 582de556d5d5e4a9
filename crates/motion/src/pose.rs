//! Positions and headings.
use crate::plane::{Frame, Point, Vec2, frame, is_in_range, outside, sin_cos};

/// A position in cm and a heading in degrees: 0 looks along y, clockwise is
/// positive, and full turns count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// To the right.
    pub x: f64,
    /// Ahead at heading 0.
    pub y: f64,
    /// Degrees.
    pub heading: f64,
}

impl Pose {
    /// A pose from its three numbers.
    pub const fn new(x: f64, y: f64, heading: f64) -> Self {
        Self { x, y, heading }
    }

    /// False if a number is too large or none.
    pub fn is_in_range(&self) -> bool {
        [self.x, self.y, self.heading].into_iter().all(is_in_range)
    }

    /// The frame whose x is to the right of this pose and whose y lies ahead of it.
    pub fn frame(&self) -> Frame {
        let (sin, cos) = sin_cos(self.heading);
        frame(self.vec2(), cos, -sin)
    }

    /// A pose given in this one's frame, in the world's.
    pub fn compose(&self, inner: &Self) -> Self {
        let point = outside(&self.frame(), inner.vec2());
        Self::new(point.x, point.y, self.heading + inner.heading)
    }

    /// The pose `ahead` cm further on.
    pub fn ahead(self, ahead: f64) -> Self {
        let (sin, cos) = libm::sincos(self.heading.to_radians());
        Self { x: self.x + ahead * sin, y: self.y + ahead * cos, ..self }
    }

    /// The pose after an arc: `way` cm long, turning by `turn` degrees.
    pub fn along_arc(self, way: f64, turn: f64) -> Self {
        let half = turn.to_radians() / 2.0;
        let chord = way * sinc(half);
        let (sin, cos) = libm::sincos(self.heading.to_radians() + half);
        Self { x: self.x + chord * sin, y: self.y + chord * cos, heading: self.heading + turn }
    }

    /// The pose that is to this one as `to` is to `from`.
    pub fn moved(self, from: Self, to: Self) -> Self {
        let (sin, cos) = libm::sincos((self.heading - from.heading).to_radians());
        let [x, y] = [to.x - from.x, to.y - from.y];
        Self {
            x: self.x + x * cos + y * sin,
            y: self.y - x * sin + y * cos,
            heading: self.heading + to.heading - from.heading,
        }
    }

    /// Where it is.
    pub fn point(self) -> Point {
        [self.x, self.y]
    }

    /// Where it is, as a vector.
    pub fn vec2(self) -> Vec2 {
        Vec2::new(self.x, self.y)
    }
}

/// An angle between -180 and 180 degrees, the latter included.
pub fn wrapped(degrees: f64) -> f64 {
    if degrees > -180.0 && degrees <= 180.0 {
        return degrees;
    }
    let wrapped = degrees.rem_euclid(360.0);
    if wrapped > 180.0 { wrapped - 360.0 } else { wrapped }
}

/// sin(x) / x: the chord of an arc by its length, for half of its turn in radians.
pub fn sinc(x: f64) -> f64 {
    if x.abs() > SHORT_ARC {
        return libm::sin(x) / x;
    }
    let square = x * x;
    let terms = if x.abs() > SHORTER_ARC { &SERIES[..] } else { &SERIES[2..] };
    terms.iter().fold(0.0, |sum, term| sum * square + term)
}

/// Up to here, in radians, [`SERIES`] is sin(x) / x in all digits.
const SHORT_ARC: f64 = 0.1;

/// Up to here its last three terms are.
const SHORTER_ARC: f64 = 0.005;

/// The factors of the powers of x², highest first. They take a processor without
/// floating point unit less time than a sine and a division.
const SERIES: [f64; 5] = [1.0 / 362_880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0, 1.0];

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

    #[test]
    fn a_move_is_the_same_from_another_pose() {
        let from = Pose { x: 1.0, y: 2.0, heading: 90.0 };
        let to = Pose { x: 4.0, y: 2.0, heading: 450.0 };
        let moved = Pose { x: 10.0, y: 10.0, heading: 0.0 }.moved(from, to);
        // Ahead, and once around.
        assert!((moved.x - 10.0).abs() < 1e-12 && (moved.y - 13.0).abs() < 1e-12, "{moved:?}");
        assert!((moved.heading - 360.0).abs() < 1e-12);
        let back = moved.moved(to, from);
        assert!((back.x - 10.0).abs() < 1e-12 && (back.y - 10.0).abs() < 1e-12, "{back:?}");
    }
}
