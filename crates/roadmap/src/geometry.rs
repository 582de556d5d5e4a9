//! Points, vectors and angles.
pub(crate) use ev3_motion::{
    Point, Vec2, distance, heading_vector, is_in_range, length, point, vec2,
};
use parry2d_f64::math::Point as ParryPoint;

pub(crate) fn parry([x, y]: Point) -> ParryPoint<f64> {
    ParryPoint::new(x, y)
}

/// A vector of length 1, or zero for one without a length.
pub(crate) fn unit(vector: Vec2) -> Vec2 {
    let length = length(vector);
    if length > 0.0 { vector / length } else { Vec2::zeros() }
}

/// The vector turned by a right angle counter-clockwise.
pub(crate) fn left_of(vector: Vec2) -> Vec2 {
    Vec2::new(-vector.y, vector.x)
}

/// Positive if `b` lies counter-clockwise of `a`.
pub(crate) fn cross(a: Vec2, b: Vec2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The angle from `a` to `b` in radians, counter-clockwise positive.
pub(crate) fn angle(a: Vec2, b: Vec2) -> f64 {
    libm::atan2(cross(a, b), a.dot(&b))
}

/// The vector turned counter-clockwise, by radians.
pub(crate) fn rotated(vector: Vec2, radians: f64) -> Vec2 {
    let (sin, cos) = libm::sincos(radians);
    Vec2::new(vector.x * cos - vector.y * sin, vector.x * sin + vector.y * cos)
}

/// The smallest box around points, as its lower left and upper right corner.
pub(crate) fn around(points: impl IntoIterator<Item = Point>) -> [Point; 2] {
    let nothing = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    points.into_iter().fold(nothing, |[low, high], [x, y]| {
        [[low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]]
    })
}

/// True if two boxes are farther apart than a distance.
pub(crate) fn apart([low, high]: &[Point; 2], other: &[Point; 2], distance: f64) -> bool {
    low[0] - other[1][0] > distance
        || low[1] - other[1][1] > distance
        || other[0][0] - high[0] > distance
        || other[0][1] - high[1] > distance
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_are_apart_if_they_are_so_on_any_side() {
        let here = [[0.0, 0.0], [2.0, 2.0]];
        for there in [[5.0, 0.0], [-5.0, 0.0], [0.0, 5.0], [0.0, -5.0]] {
            let other = here.map(|[x, y]| [x + there[0], y + there[1]]);
            assert!(apart(&here, &other, 2.9), "{there:?}");
            assert!(!apart(&here, &other, 3.1), "{there:?}");
        }
    }
}
