//! The visibility graph of obstacles that are blown up by the robot's radius.
//!
//! A shortest way runs straight from corner to corner. Blown up, an obstacle's corner is an arc;
//! that is taken as a piece of the polygon around it whose corners are at most 45 degrees apart. So
//! a way is at most 8 % of the radius farther out than it would have to be, and smoothing has it
//! back. Where that is too far out for a narrow place, 22.5 degrees make it 2 %.
use crate::geometry::{Point, Vec2, angle, cross, left_of, point, rotated, unit, vec2};
use crate::map::{Map, Obstacle, Shape};
use crate::problem::{SLACK, Sought};
use crate::search::{Searched, shortest};
use std::f64::consts::{FRAC_PI_4, FRAC_PI_8, TAU};

/// A corner, and the two directions in which the outline goes on from it.
struct Corner {
    at: Point,
    sides: [Vec2; 2],
}

/// How far apart corners are, in radians: first so, then closer.
const APART: [f64; 2] = [FRAC_PI_4, FRAC_PI_8];

pub(crate) fn search(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let coarse = search_with(map, sought, APART[0]);
    if coarse.1.way.is_some() { coarse } else { search_with(map, sought, APART[1]) }
}

fn search_with(map: &Map, sought: &Sought, apart: f64) -> (Vec<Point>, Searched) {
    let radius = sought.keep + SLACK;
    let mut corners: Vec<Corner> =
        map.obstacles.iter().flat_map(|obstacle| blown_up(obstacle, radius, apart)).collect();
    corners.retain(|corner| map.point_clear(corner.at, sought.keep));
    let mut points = vec![sought.start, sought.goal];
    points.extend(corners.iter().map(|corner| corner.at));

    // A shortest way touches each corner that it bends at, but next to its ends:
    // these may be closer to an arc than the corner is.
    let corner_at = |node: usize| node.checked_sub(2).and_then(|index| corners.get(index));
    let touches = |node: usize, towards: usize| {
        let (Some(corner), Some(_)) = (corner_at(node), corner_at(towards)) else {
            return true;
        };
        let way = unit(vec2(points[towards]) - vec2(corner.at));
        let [a, b] = corner.sides.map(|side| cross(way, side));
        a * b >= -1e-9
    };
    let joined = |a: usize, b: usize| {
        touches(a, b)
            && touches(b, a)
            && map.line_clear(points[a], points[b], sought.keep + SLACK / 2.0)
    };
    let searched = shortest(&points, |node| (1..points.len()).filter(move |n| *n != node), joined);
    (points, searched)
}

/// The corners of an obstacle that is blown up by a radius.
fn blown_up(obstacle: &Obstacle, radius: f64, apart: f64) -> Vec<Corner> {
    match &obstacle.0 {
        Shape::Polygon(corners) => {
            let count = corners.len();
            (0..count)
                .flat_map(|i| {
                    let at = |index: usize| vec2(corners[index % count]);
                    let (before, corner, after) = (at(i + count - 1), at(i), at(i + 1));
                    let (along, on) = (corner - before, after - corner);
                    around_corner(corner, -left_of(unit(along)), angle(along, on), radius, apart)
                })
                .collect()
        }
        Shape::Circle { center, radius: own } => {
            around_corner(vec2(*center), Vec2::new(1.0, 0.0), TAU, own + radius, apart)
        }
    }
}

/// Corners around an arc that begins in a direction and goes counter-clockwise
/// by an angle; none if that is not positive.
fn around_corner(center: Vec2, first: Vec2, turn: f64, radius: f64, apart: f64) -> Vec<Corner> {
    if turn < 1e-9 {
        return Vec::new();
    }
    let mut count: u8 = 1;
    while turn / f64::from(count) > apart + 1e-9 {
        count += 1;
    }
    let half = turn / f64::from(count) / 2.0;
    let reach = radius / libm::cos(half);
    (0..count)
        .map(|index| {
            let out = rotated(first, half * f64::from(2 * index + 1));
            let sides = [rotated(out, -half), rotated(out, half)].map(left_of);
            Corner { at: point(center + out * reach), sides: [-sides[0], sides[1]] }
        })
        .collect()
}
