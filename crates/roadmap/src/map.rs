//! Obstacles, and how far a way is from them.
use crate::arc::Arc;
use crate::geometry::{
    Point, apart, around, cross, distance, heading_vector, is_in_range, left_of, parry, point,
    unit, vec2,
};
use ev3_motion::Bounds;
use parry2d_f64::math::{Isometry, Point as ParryPoint};
use parry2d_f64::query::PointQuery;
use parry2d_f64::query::details::distance_segment_segment;
use parry2d_f64::shape::Segment;
use parry2d_f64::utils::{point_in_poly2d, segments_intersection2d};

/// Something solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Obstacle(pub(crate) Shape);

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Shape {
    /// Corners, counter-clockwise.
    Polygon(Vec<Point>),
    Circle {
        center: Point,
        radius: f64,
    },
}

/// An impossible part of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Fault {
    /// A polygon of a point or a line.
    #[error("needs at least three corners")]
    TooFewCorners,
    /// A number beyond [`FARTHEST`](ev3_motion::FARTHEST), or none.
    #[error("has a number beyond 1000000")]
    OutOfRange,
    /// Two edges meet that are not neighbors, or neighbors that lie on one another.
    #[error("its edges cross or touch")]
    SelfIntersecting,
    /// A length of 0 or less.
    #[error("needs lengths above 0")]
    NoSize,
    /// Bounds whose lower left is not below and to the left.
    #[error("must have an inside")]
    NoInside,
}

impl Obstacle {
    /// A polygon by its corners, in either order; the first is not repeated.
    /// Errors: if it has fewer than three corners or crosses or touches itself.
    pub fn polygon(mut corners: Vec<Point>) -> Result<Obstacle, Fault> {
        in_range(corners.iter().flatten())?;
        if corners.len() < 3 {
            return Err(Fault::TooFewCorners);
        }
        if !is_simple(&corners) {
            return Err(Fault::SelfIntersecting);
        }
        if doubled_area(&corners) < 0.0 {
            corners.reverse();
        }
        Ok(Obstacle(Shape::Polygon(corners)))
    }

    /// A box by its middle; the depth is along its heading. Errors: if it has no size.
    pub fn rectangle(
        middle: Point,
        width: f64,
        depth: f64,
        heading: f64,
    ) -> Result<Obstacle, Fault> {
        in_range(&[middle[0], middle[1], heading])?;
        positive(&[width, depth])?;
        let ahead = heading_vector(heading) * (depth / 2.0);
        let aside = -left_of(heading_vector(heading)) * (width / 2.0);
        let corners = [-aside - ahead, aside - ahead, aside + ahead, ahead - aside];
        Self::polygon(corners.map(|corner| point(vec2(middle) + corner)).to_vec())
    }

    /// A wall from a point to another. Errors: if it has no length or thickness.
    pub fn wall(from: Point, to: Point, thickness: f64) -> Result<Obstacle, Fault> {
        in_range(from.iter().chain(&to))?;
        positive(&[distance(from, to), thickness])?;
        let aside = left_of(unit(vec2(to) - vec2(from))) * (thickness / 2.0);
        let (from, to) = (vec2(from), vec2(to));
        Self::polygon([from - aside, to - aside, to + aside, from + aside].map(point).to_vec())
    }

    /// Something round. Errors: if it has no size.
    pub fn circle(center: Point, radius: f64) -> Result<Obstacle, Fault> {
        in_range(&center)?;
        positive(&[radius])?;
        Ok(Obstacle(Shape::Circle { center, radius }))
    }

    /// The corners, counter-clockwise, of one that has some.
    pub fn corners(&self) -> Option<&[Point]> {
        match &self.0 {
            Shape::Polygon(corners) => Some(corners),
            Shape::Circle { .. } => None,
        }
    }

    /// Center and radius of a round one.
    pub fn round(&self) -> Option<(Point, f64)> {
        match self.0 {
            Shape::Circle { center, radius } => Some((center, radius)),
            Shape::Polygon(_) => None,
        }
    }
}

/// A segment with the box around it.
#[derive(Clone, Debug)]
struct Edge {
    segment: Segment,
    extent: [Point; 2],
}

impl Edge {
    fn new([from, to]: [Point; 2]) -> Edge {
        Edge { segment: Segment::new(parry(from), parry(to)), extent: around([from, to]) }
    }
}

/// The inside of a polygon with the box around it.
#[derive(Clone, Debug)]
struct Area {
    corners: Vec<ParryPoint<f64>>,
    extent: [Point; 2],
}

/// All obstacles, and bounds if there are some.
#[derive(Clone, Debug, Default)]
pub struct Map {
    pub(crate) obstacles: Vec<Obstacle>,
    pub(crate) bounds: Option<Bounds>,
    edges: Vec<Edge>,
    areas: Vec<Area>,
}

impl Map {
    /// A map of these obstacles. Errors: if the bounds have no inside.
    pub fn new(obstacles: Vec<Obstacle>, bounds: Option<Bounds>) -> Result<Map, Fault> {
        let mut map = Map { bounds, ..Map::default() };
        if let Some(bounds) = bounds {
            let Bounds { low, high } = bounds;
            in_range(low.iter().chain(&high))?;
            if !bounds.has_inside() {
                return Err(Fault::NoInside);
            }
            let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
            map.edges.extend(edges(&corners).map(Edge::new));
        }
        for obstacle in obstacles {
            map.add(obstacle);
        }
        Ok(map)
    }

    /// Adds an obstacle.
    pub fn add(&mut self, obstacle: Obstacle) {
        if let Shape::Polygon(corners) = &obstacle.0 {
            self.edges.extend(edges(corners).map(Edge::new));
            let extent = around(corners.iter().copied());
            let corners = corners.iter().copied().map(parry).collect();
            self.areas.push(Area { corners, extent });
        }
        self.obstacles.push(obstacle);
    }

    /// The obstacles, in the order in which they were added.
    pub fn obstacles(&self) -> &[Obstacle] {
        &self.obstacles
    }

    /// The rectangle that the robot does not leave.
    pub fn bounds(&self) -> Option<&Bounds> {
        self.bounds.as_ref()
    }

    fn circles(&self) -> impl Iterator<Item = (Point, f64)> + '_ {
        self.obstacles.iter().filter_map(Obstacle::round)
    }

    /// How far a point is from the nearest obstacle; 0 inside of one and
    /// outside of the bounds, infinite if there is no obstacle.
    pub fn clearance(&self, at: Point) -> f64 {
        if self.covers(at) {
            return 0.0;
        }
        let to_edge = |edge: &Edge| edge.segment.distance_to_local_point(&parry(at), true);
        let to_edges = self.edges.iter().map(to_edge);
        let to_circles =
            self.circles().map(|(center, radius)| (distance(at, center) - radius).max(0.0));
        to_edges.chain(to_circles).fold(f64::INFINITY, f64::min)
    }

    /// True inside of an obstacle or outside of the bounds.
    fn covers(&self, at: Point) -> bool {
        let outside = self.bounds.is_some_and(|bounds| !bounds.contain(at));
        let is_around = |area: &Area| {
            !apart(&area.extent, &[at, at], 0.0) && point_in_poly2d(&parry(at), &area.corners)
        };
        outside
            || self.circles().any(|(center, radius)| distance(at, center) < radius)
            || self.areas.iter().any(is_around)
    }

    /// True if a point keeps a distance.
    pub(crate) fn point_clear(&self, at: Point, keep: f64) -> bool {
        let near = |edge: &&Edge| !apart(&edge.extent, &[at, at], keep);
        self.edges
            .iter()
            .filter(near)
            .all(|edge| edge.segment.distance_to_local_point(&parry(at), true) >= keep)
            && self.circles().all(|(center, radius)| distance(at, center) - radius >= keep)
            && !self.covers(at)
    }

    /// True if a straight line, of which one end is outside of all obstacles, keeps a distance.
    pub(crate) fn line_clear(&self, from: Point, to: Point, keep: f64) -> bool {
        let line = Edge::new([from, to]);
        let near = |edge: &&Edge| !apart(&edge.extent, &line.extent, keep);
        let identity = Isometry::identity();
        let to_edge =
            |edge: &Edge| distance_segment_segment(&identity, &edge.segment, &line.segment);
        let to_point = |at| line.segment.distance_to_local_point(&parry(at), true);
        self.circles().all(|(center, radius)| to_point(center) - radius >= keep)
            && self.edges.iter().filter(near).all(|edge| to_edge(edge) >= keep)
    }

    /// True if an arc, of which one end is outside of all obstacles, keeps a distance.
    pub(crate) fn arc_clear(&self, segment: &ev3_motion::Segment, keep: f64) -> bool {
        let Some(arc) = Arc::of(segment) else {
            return self.line_clear(segment.from(), segment.to(), keep);
        };
        let (reach, from) = (keep + segment.length(), segment.from());
        let near = |edge: &&Edge| !apart(&edge.extent, &[from, from], reach);
        self.circles().all(|(center, radius)| arc.distance_to(center) - radius >= keep)
            && self
                .edges
                .iter()
                .filter(near)
                .all(|edge| arc.distance_to_segment(&edge.segment) >= keep)
    }

    /// The bounds, or else a box around all obstacles and these points with room for a robot.
    pub(crate) fn extent(&self, points: [Point; 2], room: f64) -> Bounds {
        if let Some(bounds) = self.bounds {
            return bounds;
        }
        let of_circles = self.circles().flat_map(|([x, y], r)| [[x - r, y - r], [x + r, y + r]]);
        let of_edges = self.edges.iter().flat_map(|edge| edge.extent);
        let [low, high] = around(of_edges.chain(of_circles).chain(points));
        Bounds { low, high }.with_room(room)
    }
}

/// The edges of a polygon, each as its ends.
fn edges(corners: &[Point]) -> impl Iterator<Item = [Point; 2]> + '_ {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).map(|(from, to)| [*from, *to])
}

/// Twice the area; negative if the corners go clockwise.
fn doubled_area(corners: &[Point]) -> f64 {
    let origin = vec2(corners[0]);
    edges(corners).map(|[a, b]| cross(vec2(a) - origin, vec2(b) - origin)).sum()
}

/// True if edges meet only at the corners between neighbors.
fn is_simple(corners: &[Point]) -> bool {
    let edges: Vec<_> = edges(corners).collect();
    let last = edges.len() - 1;
    edges.iter().enumerate().all(|(i, &[a, b])| {
        distance(a, b) > 0.0
            && edges.iter().enumerate().skip(i + 1).all(|(j, &[c, d])| {
                if j == i + 1 {
                    !folds([a, b], d)
                } else if i == 0 && j == last {
                    !folds([c, d], b)
                } else {
                    segments_intersection2d(&parry(a), &parry(b), &parry(c), &parry(d), 1e-12)
                        .is_none()
                }
            })
    })
}

/// True if the edge that goes on to a corner goes back on this one.
fn folds([from, to]: [Point; 2], next: Point) -> bool {
    let (before, after) = (vec2(to) - vec2(from), vec2(next) - vec2(to));
    let turn = cross(unit(before), unit(after));
    turn.abs() < 1e-9 && before.dot(&after) < 0.0
}

fn in_range<'a>(numbers: impl IntoIterator<Item = &'a f64>) -> Result<(), Fault> {
    if numbers.into_iter().all(|number| is_in_range(*number)) {
        Ok(())
    } else {
        Err(Fault::OutOfRange)
    }
}

fn positive(lengths: &[f64]) -> Result<(), Fault> {
    in_range(lengths)?;
    if lengths.iter().all(|length| *length > 0.0) { Ok(()) } else { Err(Fault::NoSize) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_bounds_there_is_room_around_all() {
        let circle = Obstacle::circle([10.0, 20.0], 3.0).unwrap();
        let corners = vec![[-9.0, 0.0], [0.0, 0.0], [0.0, 5.0]];
        let map = Map::new(vec![circle, Obstacle::polygon(corners).unwrap()], None).unwrap();
        let Bounds { low, high } = map.extent([[1.0, -7.0], [2.0, 4.0]], 2.0);
        assert_eq!((low, high), ([-11.0, -9.0], [15.0, 25.0]));
    }

    #[test]
    fn impossible_polygons_are_refused() {
        let fault = |corners: &[Point]| Obstacle::polygon(corners.to_vec()).err();
        assert_eq!(fault(&[[0.0, 0.0], [1.0, 0.0]]), Some(Fault::TooFewCorners));
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        assert_eq!(fault(&bow), Some(Fault::SelfIntersecting));
        let flat = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0]];
        assert_eq!(fault(&flat), Some(Fault::SelfIntersecting));
        let twice = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert_eq!(fault(&twice), Some(Fault::SelfIntersecting));
        let touching = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]];
        assert_eq!(fault(&touching), Some(Fault::SelfIntersecting));
        let endless = [[0.0, 0.0], [f64::NAN, 0.0], [1.0, 1.0]];
        assert_eq!(fault(&endless), Some(Fault::OutOfRange));
        let concave = [[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 1.0], [0.0, 4.0]];
        assert_eq!(fault(&concave), None);
        assert_eq!(Obstacle::circle([0.0, 0.0], 0.0), Err(Fault::NoSize));
        assert_eq!(Obstacle::wall([1.0, 1.0], [1.0, 1.0], 1.0), Err(Fault::NoSize));
    }

    #[test]
    fn corners_go_counter_clockwise() {
        let corners = vec![[0.0, 0.0], [0.0, 1.0], [1.0, 0.0]];
        let triangle = Obstacle::polygon(corners).unwrap();
        assert!(doubled_area(triangle.corners().unwrap()) > 0.0);
        let tilted = Obstacle::rectangle([5.0, 5.0], 4.0, 2.0, 30.0).unwrap();
        assert!((doubled_area(tilted.corners().unwrap()) - 16.0).abs() < 1e-9);
    }

    #[test]
    fn clearance_is_that_of_the_nearest() {
        let square = Obstacle::rectangle([10.0, 0.0], 4.0, 4.0, 0.0).unwrap();
        let ball = Obstacle::circle([-10.0, 0.0], 3.0).unwrap();
        let bounds = Bounds { low: [-50.0, -5.0], high: [50.0, 50.0] };
        let map = Map::new(vec![square, ball], Some(bounds)).unwrap();
        for (at, expected) in
            [([0.0, 0.0], 5.0), ([5.0, 0.0], 3.0), ([10.0, 1.0], 0.0), ([-6.0, 0.0], 1.0)]
        {
            assert!((map.clearance(at) - expected).abs() < 1e-12, "{at:?}");
        }
        assert!(map.clearance([0.0, -6.0]) <= 0.0);
    }
}
