//! Arcs of circles, of less than half a turn.
use crate::geometry::{Point, Vec2, cross, distance, length, parry, rotated, unit, vec2};
use parry2d_f64::query::PointQuery;
use parry2d_f64::shape::Segment;

/// An arc from `from` to `to` around `center`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    pub(crate) from: Point,
    pub(crate) to: Point,
    pub(crate) center: Point,
    pub(crate) radius: f64,
    /// Radians, counter-clockwise positive, less than pi.
    pub(crate) sweep: f64,
}

impl Arc {
    /// True if the arc passes the center in this direction.
    fn spans(&self, direction: Vec2) -> bool {
        let side = self.sweep.signum();
        let (first, last) =
            (vec2(self.from) - vec2(self.center), vec2(self.to) - vec2(self.center));
        side * cross(first, direction) >= 0.0 && side * cross(direction, last) >= 0.0
    }

    /// How far a point is from the arc.
    pub(crate) fn distance_to(&self, point: Point) -> f64 {
        let offset = vec2(point) - vec2(self.center);
        if self.spans(offset) {
            (length(offset) - self.radius).abs()
        } else {
            distance(point, self.from).min(distance(point, self.to))
        }
    }

    /// How far a segment is from the arc; 0 if they meet.
    ///
    /// They are nearest at an end of one of them, or on the line from the
    /// center that is square to the segment, or where they cross.
    pub(crate) fn distance_to_segment(&self, segment: &Segment) -> f64 {
        let (a, b) = ([segment.a.x, segment.a.y], [segment.b.x, segment.b.y]);
        let to_segment = |at: Point| segment.distance_to_local_point(&parry(at), true);
        let mut least = to_segment(self.from).min(to_segment(self.to));
        least = least.min(self.distance_to(a)).min(self.distance_to(b));
        let along = vec2(b) - vec2(a);
        let start = vec2(a) - vec2(self.center);
        let square = along.dot(&along);
        if square <= 0.0 {
            return least;
        }
        let foot_at = -start.dot(&along) / square;
        let foot = start + along * foot_at;
        let offset = length(foot);
        if (0.0..=1.0).contains(&foot_at) && self.spans(foot) {
            least = least.min((offset - self.radius).abs());
        }
        if offset < self.radius {
            let half = libm::sqrt((self.radius * self.radius - offset * offset) / square);
            let crosses = |at: f64| (0.0..=1.0).contains(&at) && self.spans(start + along * at);
            if crosses(foot_at - half) || crosses(foot_at + half) {
                return 0.0;
            }
        }
        least
    }

    /// The point after a share of the arc, from 0 to 1.
    pub(crate) fn at(&self, share: f64) -> Point {
        let start = vec2(self.from) - vec2(self.center);
        crate::geometry::point(vec2(self.center) + rotated(start, self.sweep * share))
    }

    /// The direction of going after a share of the arc.
    pub(crate) fn direction_at(&self, share: f64) -> Vec2 {
        let outwards = unit(vec2(self.at(share)) - vec2(self.center));
        crate::geometry::left_of(outwards) * self.sweep.signum()
    }

    pub(crate) fn length(&self) -> f64 {
        self.radius * self.sweep.abs()
    }
}
