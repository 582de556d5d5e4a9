//! Paths of lines and arcs, and where along them a robot is.
//!
//! A path is seen in the direction of travel: a robot that backs along it has
//! its own heading turned by half a turn.
use crate::drive::odometry::Pose;

/// Rounder than this, in 1/cm, a path is a line.
const STRAIGHT: f64 = 1e-6;

/// Corners that turn farther than this, in degrees, are not rounded.
const SHARPEST: f64 = 135.0;

/// Corners are not rounded with less than this radius, in cm.
const TIGHTEST: f64 = 5.0;

/// A line or an arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where it starts, and the direction of travel there.
    pub start: Pose,
    /// Its length in cm.
    pub length: f64,
    /// 1 / radius in 1/cm, clockwise positive; 0 for a line.
    pub curvature: f64,
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
    #[must_use]
    pub fn line([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> Self {
        let heading = direction([x0, y0], [x1, y1]);
        let length = (x1 - x0).hypot(y1 - y0);
        Self { start: Pose { x: x0, y: y0, heading }, length, curvature: 0.0 }
    }

    /// The pose `along` cm from its start.
    #[must_use]
    pub fn at(&self, along: f64) -> Pose {
        self.start.along_arc(along, (along * self.curvature).to_degrees())
    }

    /// Where its end is.
    #[must_use]
    pub fn end(&self) -> Pose {
        self.at(self.length)
    }

    /// Where a point is with respect to it. `near` is a guess of how far along,
    /// which tells the turns of an arc apart.
    #[must_use]
    pub fn locate(&self, [x, y]: [f64; 2], near: f64) -> Place {
        let (sin, cos) = self.start.heading.to_radians().sin_cos();
        let (dx, dy) = (x - self.start.x, y - self.start.y);
        let (ahead, right) = (dx * sin + dy * cos, dx * cos - dy * sin);
        if self.curvature.abs() < STRAIGHT {
            return Place { along: ahead, aside: right };
        }
        let radius = 1.0 / self.curvature;
        // The center is `radius` to the right of the start.
        let side = radius.signum();
        let angle = ahead.atan2((radius - right) * side);
        let along = angle * radius.abs();
        let turn = std::f64::consts::TAU * radius.abs();
        let along = along + ((near - along) / turn).round() * turn;
        let distance = ahead.hypot(radius - right);
        Place { along, aside: (radius.abs() - distance) * side }
    }
}

/// The compass direction from one place to another, in degrees.
#[must_use]
pub fn direction([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    (x1 - x0).atan2(y1 - y0).to_degrees()
}

/// A path through points, its corners rounded with a radius, or with less where
/// the legs are too short for it. Each element of the answer is a piece without
/// a corner: those that are too sharp to be rounded remain.
#[must_use]
pub fn rounded(points: &[[f64; 2]], radius: f64) -> Vec<Vec<Segment>> {
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
        let heading = direction(before, corner);
        let turn = crate::drive::odometry::wrapped(direction(corner, next) - heading);
        let half = (turn.to_radians() / 2.0).abs();
        let is_last = index + 2 == points.len();
        let share = |is_end: bool| if is_end { 1.0 } else { 0.5 };
        let room = (distance(before, corner) * share(index == 1))
            .min(distance(corner, next) * share(is_last));
        let used = (radius * half.tan()).min(room);
        let radius = if half > 1e-6 { used / half.tan() } else { f64::INFINITY };
        if turn.abs() < 1e-3 {
            push_line(&mut piece, from, corner);
            from = corner;
        } else if turn.abs() > SHARPEST || radius < TIGHTEST {
            push_line(&mut piece, from, corner);
            pieces.push(std::mem::take(&mut piece));
            from = corner;
        } else {
            let start = Pose { x: corner[0], y: corner[1], heading }.ahead(-used);
            push_line(&mut piece, from, [start.x, start.y]);
            let length = radius * turn.to_radians().abs();
            let arc = Segment { start, length, curvature: turn.signum() / radius };
            let end = arc.end();
            piece.push(arc);
            from = [end.x, end.y];
        }
    }
    pieces.push(piece);
    pieces.retain(|piece| !piece.is_empty());
    pieces
}

fn push_line(piece: &mut Vec<Segment>, from: [f64; 2], to: [f64; 2]) {
    if distance(from, to) > 1e-3 {
        piece.push(Segment::line(from, to));
    }
}

fn distance([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> f64 {
    (x1 - x0).hypot(y1 - y0)
}
