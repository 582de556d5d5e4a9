//! Points, vectors and boxes in the plane, and which numbers there may be.
//!
//! Sines and cosines come from the `libm` crate, not from the platform: the same bits everywhere.
use parry2d_f64::math::{Isometry, Rotation, Translation, Vector};

/// X and y, in cm.
pub type Point = [f64; 2];

/// A vector, or a point as the vector to it.
pub type Vec2 = Vector<f64>;

/// A frame of reference in the plane.
pub type Frame = Isometry<f64>;

/// The largest coordinate, in cm, and heading, in degrees: 10 km. Up to there sums of lengths keep
/// a thousand millionth of a cm.
pub const FARTHEST: f64 = 1e6;

/// What is wrong with a larger one.
pub const OUT_OF_RANGE: &str = "has a number beyond 1000000";

/// False for what is too large, and what is not a number.
pub fn is_in_range(number: f64) -> bool {
    number.abs() <= FARTHEST
}

/// The vector to a point.
pub fn vec2([x, y]: Point) -> Vec2 {
    Vec2::new(x, y)
}

/// The point to which a vector leads.
pub fn point(vector: Vec2) -> Point {
    [vector.x, vector.y]
}

/// The length of a vector.
pub fn length(vector: Vec2) -> f64 {
    libm::hypot(vector.x, vector.y)
}

/// Sine and cosine of degrees.
pub fn sin_cos(degrees: f64) -> (f64, f64) {
    libm::sincos(degrees.to_radians())
}

/// The vector of length 1 that points where a heading does.
pub fn heading_vector(heading: f64) -> Vec2 {
    let (sin, cos) = sin_cos(heading);
    Vec2::new(sin, cos)
}

/// A frame at a point, turned counter-clockwise by the angle with this cosine and sine.
pub fn frame(at: Vec2, cos: f64, sin: f64) -> Frame {
    Frame::from_parts(Translation::from(at), Rotation::from_cos_sin_unchecked(cos, sin))
}

/// A point of a frame, in the world.
pub fn outside(frame: &Frame, point: Vec2) -> Vec2 {
    frame.rotation * point + frame.translation.vector
}

/// The compass direction from one place to another, in degrees.
pub fn direction([x0, y0]: Point, [x1, y1]: Point) -> f64 {
    libm::atan2(x1 - x0, y1 - y0).to_degrees()
}

/// How far one place is from another, in cm.
pub fn distance([x0, y0]: Point, [x1, y1]: Point) -> f64 {
    libm::hypot(x1 - x0, y1 - y0)
}

/// A rectangle with walls around it, which no robot leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Lower left corner.
    pub low: Point,
    /// Upper right corner.
    pub high: Point,
}

impl Bounds {
    /// Whether all its numbers are in range.
    pub fn is_in_range(&self) -> bool {
        [self.low, self.high].into_iter().flatten().all(is_in_range)
    }

    /// Whether it has an inside.
    pub fn has_inside(&self) -> bool {
        self.low[0] < self.high[0] && self.low[1] < self.high[1]
    }

    /// Its width and its height.
    pub fn size(&self) -> [f64; 2] {
        [self.high[0] - self.low[0], self.high[1] - self.low[1]]
    }

    /// Whether a place is within, or on the edge.
    pub fn contain(&self, place: Point) -> bool {
        (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&place[axis]))
    }

    /// Grows until a circle is in it.
    pub fn include(&mut self, [x, y]: Point, reach: f64) {
        self.low = [self.low[0].min(x - reach), self.low[1].min(y - reach)];
        self.high = [self.high[0].max(x + reach), self.high[1].max(y + reach)];
    }

    /// The same with room around it.
    pub fn with_room(&self, room: f64) -> Self {
        Self { low: self.low.map(|n| n - room), high: self.high.map(|n| n + room) }
    }
}
