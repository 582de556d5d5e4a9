//! How far things are from arcs of less than half a turn.
use crate::geometry::{Point, Vec2, cross, distance, length, parry, vec2};
use ev3_motion::Segment;
use parry2d_f64::query::PointQuery;
use parry2d_f64::shape;

/// An arc from `from` to `to` around `center`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    from: Point,
    to: Point,
    center: Point,
    radius: f64,
    /// 1 if it is counter-clockwise, else -1.
    side: f64,
}

impl Arc {
    /// `None` for a line.
    pub(crate) fn of(segment: &Segment) -> Option<Self> {
        let (radius, center) = (segment.radius()?, segment.center()?);
        let (from, to) = (segment.from(), segment.to());
        Some(Self { from, to, center, radius: radius.abs(), side: -radius.signum() })
    }

    /// True if the arc passes the center in this direction.
    fn spans(&self, direction: Vec2) -> bool {
        let side = self.side;
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
    pub(crate) fn distance_to_segment(&self, segment: &shape::Segment) -> f64 {
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
}
