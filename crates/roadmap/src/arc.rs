//! Distances of things from arcs of less than half a turn.
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

#[cfg(test)]
mod tests {
    use super::*;
    use ev3_motion::Pose;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

        /// What is as far from an arc as the nearest of many points on it.
        #[test]
        fn distances_are_those_of_the_nearest_point(
            heading in -180.0_f64..180.0,
            radius in prop_oneof![-30.0_f64..-5.0, 5.0_f64..30.0],
            turn in 5.0_f64..175.0,
            (a, b) in (prop::array::uniform2(-50.0_f64..50.0), prop::array::uniform2(-50.0_f64..50.0)),
        ) {
            let start = Pose { x: 3.0, y: -4.0, heading };
            let path = Segment::arc(start, turn.to_radians() * radius.abs(), 1.0 / radius);
            let arc = Arc::of(&path).unwrap();
            let nearest = |far: &dyn Fn(Point) -> f64| {
                let points = (0..=1000).map(|n| path.at(path.length() * f64::from(n) / 1000.0));
                points.map(|pose| far(pose.point())).fold(f64::INFINITY, f64::min)
            };
            let off = nearest(&|point| distance(point, a)) - arc.distance_to(a);
            prop_assert!((-1e-6..0.1).contains(&off), "{off}");
            let segment = shape::Segment::new(parry(a), parry(b));
            let to_segment = |point: Point| segment.distance_to_local_point(&parry(point), true);
            let off = nearest(&to_segment) - arc.distance_to_segment(&segment);
            prop_assert!((-1e-6..0.1).contains(&off), "{off}");
        }
    }

    #[test]
    fn a_line_is_no_arc_and_a_segment_may_be_a_point() {
        assert!(Arc::of(&Segment::line([0.0, 0.0], [9.0, 0.0])).is_none());
        let arc = Arc::of(&Segment::arc(Pose::default(), 10.0, 0.1)).unwrap();
        let point = shape::Segment::new(parry([7.0, 5.0]), parry([7.0, 5.0]));
        assert!((arc.distance_to_segment(&point) - arc.distance_to([7.0, 5.0])).abs() < 1e-9);
    }
}
