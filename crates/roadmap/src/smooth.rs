//! Cutting detours short, and rounding corners.
use crate::geometry::{Point, angle, distance, point, vec2};
use crate::map::Map;
use ev3_motion::{Path, Segment};

/// Number of pieces that each line is cut into. A detour may be left at each cut.
const PIECES: u8 = 4;
/// How often the radius is halved in the search for the widest arc that fits.
const HALVINGS: u8 = 10;
/// A corner with a smaller angle, in radians, is straight.
const STRAIGHT: f64 = 1e-6;

/// A way from corner to corner, without the detours.
pub(crate) fn shortened(map: &Map, corners: &[Point], keep: f64) -> Vec<Point> {
    let once = taut(map, corners, keep);
    let mut pieces = vec![once[0]];
    for pair in once.windows(2) {
        let way = vec2(pair[1]) - vec2(pair[0]);
        let share = |piece: u8| f64::from(piece) / f64::from(PIECES);
        pieces.extend((1..PIECES).map(|piece| point(vec2(pair[0]) + way * share(piece))));
        pieces.push(pair[1]);
    }
    let again = taut(map, &pieces, keep);
    if length_of(&again) < length_of(&once) { again } else { once }
}

/// From each corner straight to the farthest that can be reached so.
fn taut(map: &Map, corners: &[Point], keep: f64) -> Vec<Point> {
    let mut way = vec![corners[0]];
    let mut at = 0;
    while at + 1 < corners.len() {
        let clear = |to: &usize| map.line_clear(corners[at], corners[*to], keep);
        at = (at + 2..corners.len()).rev().find(clear).unwrap_or(at + 1);
        way.push(corners[at]);
    }
    way
}

fn length_of(corners: &[Point]) -> f64 {
    corners.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
}

/// A way with arcs of at least a radius in the place of corners, as wide as
/// fits between the obstacles and on half of the lines at the corner.
pub(crate) fn rounded(map: &Map, corners: &[Point], keep: f64, arc_radius: f64) -> Path {
    let mut segments = Vec::new();
    let mut at = corners[0];
    for (index, corner) in corners.windows(3).enumerate() {
        let room = |line: usize, is_outer: bool| {
            let length = distance(corners[line], corners[line + 1]);
            if is_outer { length } else { length / 2.0 }
        };
        let room = room(index, index == 0).min(room(index + 1, index + 3 == corners.len()));
        let arc = widest(map, [corner[0], corner[1], corner[2]], room, keep, arc_radius);
        let until = arc.map_or(corner[1], |arc| arc.from());
        segments.push(Segment::line(at, until));
        segments.extend(arc);
        at = arc.map_or(corner[1], |arc| arc.to());
    }
    segments.push(Segment::line(at, corners[corners.len() - 1]));
    Path::new(segments)
}

/// The widest arc at a corner that keeps the distance, if there is one.
fn widest(map: &Map, corner: [Point; 3], room: f64, keep: f64, arc_radius: f64) -> Option<Segment> {
    let turn = angle(vec2(corner[1]) - vec2(corner[0]), vec2(corner[2]) - vec2(corner[1]));
    if turn.abs() < STRAIGHT {
        return None;
    }
    let fits =
        |radius| Some(Segment::rounding(corner, radius)).filter(|arc| map.arc_clear(arc, keep));
    let mut high = room / libm::tan(turn.abs() / 2.0);
    if high < arc_radius {
        return None;
    }
    if let Some(arc) = fits(high) {
        return Some(arc);
    }
    let mut low = arc_radius;
    let mut best = fits(low)?;
    for _ in 0..HALVINGS {
        let radius = f64::midpoint(low, high);
        match fits(radius) {
            Some(arc) => (low, best) = (radius, arc),
            None => high = radius,
        }
    }
    Some(best)
}
