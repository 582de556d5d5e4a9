//! Lines and arcs, and where along them a robot is.
//!
//! A segment is seen in the direction of travel: a robot that backs along it has
//! its own heading turned by half a turn.
use crate::plane::{Point, direction, distance};
use crate::pose::{Pose, wrapped};

/// Rounder than this, in 1/cm, a segment is a line.
const STRAIGHT: f64 = 1e-6;

/// Corners that turn farther than this, in degrees, are not rounded.
const SHARPEST: f64 = 135.0;

/// Corners are not rounded with less than this radius, in cm.
const TIGHTEST: f64 = 5.0;

/// A line or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    start: Pose,
    /// Sine and cosine of the heading at the start.
    direction: [f64; 2],
    length: f64,
    curvature: f64,
    /// The radius with its sign, kept because a division is dear; `None` for a line.
    radius: Option<f64>,
    to: Point,
}

/// Where a robot is with respect to a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// How far along, in cm; negative before its start.
    pub along: f64,
    /// How far to the right of it, in cm.
    pub aside: f64,
}

impl Segment {
    /// The line from one place to another.
    pub fn line(from: Point, to: Point) -> Self {
        let [x, y] = from;
        let start = Pose { x, y, heading: direction(from, to) };
        Self::new(start, distance(from, to), 0.0, to)
    }

    /// The arc from a pose: its length in cm, and 1 / radius in 1/cm, clockwise
    /// positive; 0 makes a line.
    pub fn arc(start: Pose, length: f64, curvature: f64) -> Self {
        let to = start.along_arc(length, (length * curvature).to_degrees()).point();
        Self::new(start, length, curvature, to)
    }

    fn new(start: Pose, length: f64, curvature: f64, to: Point) -> Self {
        let (sin, cos) = libm::sincos(start.heading.to_radians());
        let radius = (curvature.abs() >= STRAIGHT).then(|| 1.0 / curvature);
        Self { start, direction: [sin, cos], length, curvature, radius, to }
    }

    /// The arc of a radius that touches both lines of a corner, the second of
    /// three places that do not lie on one line.
    pub fn rounding([before, corner, after]: [Point; 3], radius: f64) -> Self {
        let turn = turn_at([before, corner, after]);
        let cut = radius * libm::tan(turn.to_radians().abs() / 2.0);
        let towards = |[x, y]: Point| {
            let share = cut / distance(corner, [x, y]);
            [corner[0] + (x - corner[0]) * share, corner[1] + (y - corner[1]) * share]
        };
        let ([x, y], to) = (towards(before), towards(after));
        let start = Pose { x, y, heading: direction(before, corner) };
        Self::new(start, radius * turn.to_radians().abs(), turn.signum() / radius, to)
    }

    /// Where it starts, and the direction of travel there.
    pub fn start(&self) -> Pose {
        self.start
    }

    /// Where it ends, and the direction of travel there.
    pub fn end(&self) -> Pose {
        let [x, y] = self.to;
        Pose { x, y, heading: self.start.heading + self.turn() }
    }

    /// Where it starts.
    pub fn from(&self) -> Point {
        self.start.point()
    }

    /// Where it ends.
    pub fn to(&self) -> Point {
        self.to
    }

    /// In cm.
    pub fn length(&self) -> f64 {
        self.length
    }

    /// 1 / radius in 1/cm, clockwise positive; 0 for a line.
    pub fn curvature(&self) -> f64 {
        self.curvature
    }

    /// By how much the heading changes: degrees, clockwise positive.
    pub fn turn(&self) -> f64 {
        (self.length * self.curvature).to_degrees()
    }

    /// In cm, positive if the center is on the right, negative if on the left. `None` for a line.
    pub fn radius(&self) -> Option<f64> {
        self.radius
    }

    /// The middle of an arc's circle. `None` for a line.
    pub fn center(&self) -> Option<Point> {
        let to_the_right = Pose { heading: self.start.heading + 90.0, ..self.start };
        self.radius().map(|radius| to_the_right.ahead(radius).point())
    }

    /// The pose `along` cm from its start.
    pub fn at(&self, along: f64) -> Pose {
        if self.curvature != 0.0 || self.length <= 0.0 {
            return self.start.along_arc(along, (along * self.curvature).to_degrees());
        }
        let share = along / self.length;
        let Pose { x, y, heading } = self.start;
        Pose { x: x + (self.to[0] - x) * share, y: y + (self.to[1] - y) * share, heading }
    }

    /// The direction of travel `along` cm from its start.
    pub fn heading_at(&self, along: f64) -> f64 {
        self.start.heading + (along * self.curvature).to_degrees()
    }

    /// The same with another length, which may be longer.
    pub fn with_length(&self, length: f64) -> Self {
        Self { length, to: self.at(length).point(), ..*self }
    }

    /// Where a point is with respect to it. `near` is a guess of how far along, which distinguishes
    /// the turns of an arc.
    pub fn locate(&self, [x, y]: Point, near: f64) -> Place {
        let [sin, cos] = self.direction;
        let (dx, dy) = (x - self.start.x, y - self.start.y);
        let (ahead, right) = (dx * sin + dy * cos, dx * cos - dy * sin);
        let Some(radius) = self.radius else {
            return Place { along: ahead, aside: right };
        };
        // The center is `radius` to the right of the start.
        let (side, radius, inward) = (radius.signum(), radius.abs(), radius - right);
        let mut along = libm::atan2(ahead, inward * side) * radius;
        let turn = std::f64::consts::TAU * radius;
        if (near - along).abs() > turn * 0.5 {
            along += ((near - along) / turn).round() * turn;
        }
        let distance = libm::sqrt(ahead * ahead + inward * inward);
        Place { along, aside: (radius - distance) * side }
    }
}

/// A path through points, its corners rounded with a radius, or with less where
/// the legs are too short for it. Each element of the answer is a piece without
/// a corner: those that are too sharp to be rounded remain.
pub fn rounded(points: &[Point], radius: f64) -> Vec<Vec<Segment>> {
    let mut points = points.to_vec();
    points.dedup_by(|a, b| distance(*a, *b) < 1e-3);
    let mut pieces = Vec::new();
    let mut piece = Vec::new();
    let Some(mut from) = points.first().copied() else {
        return pieces;
    };
    for index in 1..points.len() {
        let corner = points[index];
        let Some(&next) = points.get(index + 1) else {
            push_line(&mut piece, from, corner);
            continue;
        };
        let before = points[index - 1];
        let turn = turn_at([before, corner, next]);
        let half = (turn.to_radians() / 2.0).abs();
        let is_last = index + 2 == points.len();
        let share = |is_end: bool| if is_end { 1.0 } else { 0.5 };
        let room = (distance(before, corner) * share(index == 1))
            .min(distance(corner, next) * share(is_last));
        let used = (radius * libm::tan(half)).min(room);
        let radius = if half > 1e-6 { used / libm::tan(half) } else { f64::INFINITY };
        if turn.abs() < 1e-3 {
            push_line(&mut piece, from, corner);
            from = corner;
        } else if turn.abs() > SHARPEST || radius < TIGHTEST {
            push_line(&mut piece, from, corner);
            pieces.push(std::mem::take(&mut piece));
            from = corner;
        } else {
            let arc = Segment::rounding([before, corner, next], radius);
            push_line(&mut piece, from, arc.from());
            piece.push(arc);
            from = arc.to();
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

/// By how much a way through three places turns at the second, in degrees.
fn turn_at([before, corner, after]: [Point; 3]) -> f64 {
    wrapped(direction(corner, after) - direction(before, corner))
}

fn push_line(piece: &mut Vec<Segment>, from: Point, to: Point) {
    if distance(from, to) > 1e-3 {
        piece.push(Segment::line(from, to));
    }
}
