//! Positions and headings.

/// X and y, in cm.
pub type Point = [f64; 2];

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
    /// The pose `ahead` cm further on.
    #[must_use]
    pub fn ahead(self, ahead: f64) -> Self {
        let (sin, cos) = libm::sincos(self.heading.to_radians());
        Self { x: self.x + ahead * sin, y: self.y + ahead * cos, ..self }
    }

    /// The pose after an arc: `way` cm long, turning by `turn` degrees.
    #[must_use]
    pub fn along_arc(self, way: f64, turn: f64) -> Self {
        let half = turn.to_radians() / 2.0;
        let chord = way * sinc(half);
        let (sin, cos) = libm::sincos(self.heading.to_radians() + half);
        Self { x: self.x + chord * sin, y: self.y + chord * cos, heading: self.heading + turn }
    }

    /// The pose that is to this one as `to` is to `from`.
    #[must_use]
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
    #[must_use]
    pub fn point(self) -> Point {
        [self.x, self.y]
    }
}

/// The compass direction from one place to another, in degrees.
#[must_use]
pub fn direction([x0, y0]: Point, [x1, y1]: Point) -> f64 {
    libm::atan2(x1 - x0, y1 - y0).to_degrees()
}

/// How far one place is from another, in cm.
#[must_use]
pub fn distance([x0, y0]: Point, [x1, y1]: Point) -> f64 {
    libm::hypot(x1 - x0, y1 - y0)
}

/// An angle between -180 and 180 degrees, the latter included.
#[must_use]
pub fn wrapped(degrees: f64) -> f64 {
    if degrees > -180.0 && degrees <= 180.0 {
        return degrees;
    }
    let wrapped = degrees.rem_euclid(360.0);
    if wrapped > 180.0 { wrapped - 360.0 } else { wrapped }
}

/// sin(x) / x: the chord of an arc by its length, for half of its turn in radians.
#[must_use]
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
