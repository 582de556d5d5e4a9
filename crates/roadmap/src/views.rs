//! The echoes that an ultrasonic sensor has measured.
//!
//! The sensor measures the distance of the nearest thing in a cone, 15 degrees to each side, but
//! not its direction in the cone. So one look has two results: the cone is free up to that
//! distance, and a thing stands somewhere on the arc at that distance. The robot relies on the
//! first: it drives only where it has looked. Looks from other directions narrow the second: they
//! show parts of the arc to be free, and the thing is on the rest of the arc.
use crate::geometry::{
    Point, Vec2, cross, distance, heading_vector, left_of, length, parry, point, rotated, vec2,
};
use crate::map::{Map, Obstacle};
use ev3_motion::Path;
use parry2d_f64::transformation::convex_hull;
use std::collections::BTreeMap;

/// Half of the cone: what may have sent an echo, and what is surely free.
const ECHO_HALF_ANGLE: f64 = 15.0;
const FREE_HALF_ANGLE: f64 = 12.0;
/// The uncertainty of a measured distance, in cm and as a part of it: errors of the
/// sensor and of the estimated pose.
const DOUBT: [f64; 2] = [0.5, 0.03];
/// By how much two measured places of one thing may differ, in cm.
const DIFFER: f64 = 2.0;
/// A thing has moved if its echo comes from a free place, by more than this distance,
/// in cm, and if it is near enough to be sure.
const MOVED: f64 = 6.0;
const MOVED_WITHIN: f64 = 40.0;
/// Below this distance, in cm, the sensor does not measure the distance.
const NEAR: f64 = 3.05;
/// Echoes from farther than this, in cm, make no obstacle: the cone is too wide.
pub(crate) const FAR: f64 = 100.0;
/// Echoes that may come from farther across than this wait for more looks, in cm.
const WIDE: f64 = 12.0;
/// Unless looks that differ by this much, as a sine, agree on the place.
const AGREED: f64 = 0.2;
/// An echo from so near to a known obstacle is that obstacle's, in cm.
const KNOWN: f64 = 4.0;
/// Points across an echo are so far apart, in cm.
const GRAIN: f64 = 1.5;
/// Points of echoes in one square of this size, in cm, become one polygon.
const SQUARE: f64 = 10.0;
/// A polygon reaches so far beyond its points, in cm.
const AROUND: f64 = 0.75;
/// Steps along a way at which it is checked, in cm.
const STEP: f64 = 1.0;
/// How far to the left and right the front of the hull is checked, in degrees.
const FRONT: [f64; 17] = [
    0.0, 10.0, -10.0, 20.0, -20.0, 30.0, -30.0, 40.0, -40.0, 50.0, -50.0, 60.0, -60.0, 70.0, -70.0,
    80.0, -80.0,
];

/// A measurement of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// The place of the sensor.
    pub at: Point,
    /// Its heading, in degrees.
    pub heading: f64,
    /// The measured distance, in cm.
    pub range: f64,
}

/// The information of one measurement.
#[derive(Clone, Copy, Debug)]
struct Look {
    at: Point,
    ahead: Vec2,
    range: f64,
    /// Up to here the cone is free.
    free: f64,
}

impl Look {
    fn shows_free(&self, at: Point, cos: f64) -> bool {
        let offset = vec2(at) - vec2(self.at);
        let along = offset.dot(&self.ahead);
        let square = offset.dot(&offset);
        along >= 0.0 && square < self.free * self.free && along * along >= cos * cos * square
    }

    /// How far a place that may have sent this echo is off the middle of the
    /// cone, to the left, as a sine.
    fn aside(&self, at: Point) -> Option<f64> {
        let offset = vec2(at) - vec2(self.at);
        let farthest = self.range + DIFFER;
        if offset.dot(&self.ahead) <= 0.0 || offset.dot(&offset) > farthest * farthest {
            return None;
        }
        let edge = libm::sin(ECHO_HALF_ANGLE.to_radians()) + 1e-9;
        let far = length(offset);
        let aside = cross(self.ahead, offset) / far;
        ((far - self.range).abs() < DIFFER && aside.abs() <= edge).then_some(aside)
    }

    /// The points from which the echo may have come.
    fn across(&self) -> Vec<Point> {
        let half = ECHO_HALF_ANGLE.to_radians();
        let steps = self.steps();
        let turn = |index: u32| half * (f64::from(index) / f64::from(steps) - 1.0);
        (0..=2 * steps)
            .map(|index| point(vec2(self.at) + rotated(self.ahead, turn(index)) * self.range))
            .collect()
    }

    /// How many of them are on each side of the middle.
    fn steps(&self) -> u32 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
        let steps = libm::ceil(self.range * ECHO_HALF_ANGLE.to_radians() / GRAIN) as u32;
        steps
    }
}

/// A place from which an echo may have come, as no look shows it free.
#[derive(Clone, Copy, Debug)]
struct Place {
    at: Point,
    /// How far to the right and to the left of the middle looks have an echo from here, as sines.
    aside: [f64; 2],
}

/// A look, and the places where its echo may have come from.
#[derive(Clone, Debug)]
struct Seen {
    look: Look,
    places: Vec<Place>,
}

impl Seen {
    /// Updates the places with another look, or with this one.
    fn learn(&mut self, look: &Look, cos: f64) {
        self.places.retain_mut(|place| {
            if look.shows_free(place.at, cos) {
                return false;
            }
            if let Some(aside) = look.aside(place.at) {
                let [right, left] = place.aside;
                place.aside = [right.min(aside), left.max(aside)];
            }
            true
        });
    }
}

/// How far a way can be gone safely.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Safe {
    /// How much of the path, in cm.
    pub way: f64,
    /// The first place there that has not been seen free.
    pub unseen: Option<Point>,
}

/// All looks of a drive.
#[derive(Clone, Debug)]
pub struct Views {
    hull: f64,
    seen: Vec<Seen>,
    /// The number of looks whose places have been compared with all looks before.
    sifted: usize,
    trail: Vec<Point>,
    blocked: Vec<Point>,
    free_cos: f64,
}

impl Views {
    /// No looks yet, of a robot with a round hull of a radius in cm.
    pub fn new(hull: f64) -> Views {
        let free_cos = libm::cos(FREE_HALF_ANGLE.to_radians());
        Views {
            hull,
            seen: Vec::new(),
            sifted: 0,
            trail: Vec::new(),
            blocked: Vec::new(),
            free_cos,
        }
    }

    /// The radius of the hull, in cm.
    pub fn hull(&self) -> f64 {
        self.hull
    }

    /// Adds a look of a robot at a place with a heading. The mount has place and
    /// heading of the sensor on the robot, and the measured distance.
    ///
    /// True if a thing stands where earlier looks showed a free place: it has moved, or
    /// was too thin for an echo. This forgets those looks.
    pub fn look(&mut self, at: Point, heading: f64, mount: View) -> bool {
        let ahead = heading_vector(heading);
        let [aside, forward] = mount.at;
        let sensor = vec2(at) + ahead * forward - left_of(ahead) * aside;
        let view = View { at: point(sensor), heading: heading + mount.heading, range: mount.range };
        let moved = view.range < MOVED_WITHIN && self.forget_contradicted(view);
        self.stand(at);
        self.add(view);
        moved
    }

    /// If looks showed free from where this one has its echo, forgets those.
    fn forget_contradicted(&mut self, view: View) -> bool {
        let ahead = heading_vector(view.heading);
        let cos = self.free_cos;
        let beyond = Look { at: view.at, ahead, range: view.range + MOVED, free: 0.0 };
        let places = beyond.across();
        let contradicted = places.iter().all(|place| self.shown_free(*place));
        if contradicted {
            self.seen.retain(|seen| !places.iter().any(|place| seen.look.shows_free(*place, cos)));
            self.sifted = 0;
        }
        contradicted
    }

    /// Notes where the middle of the robot is. Nothing else can be there.
    pub fn stand(&mut self, at: Point) {
        if self.trail.last().is_none_or(|last| distance(*last, at) > STEP) {
            self.trail.push(at);
        }
    }

    /// Notes a look. One from where the last one was, to where it looked, is left out.
    pub fn add(&mut self, view: View) {
        let ahead = heading_vector(view.heading);
        let is_new = |Seen { look: last, .. }: &Seen| {
            distance(last.at, view.at) > STEP
                || last.ahead.dot(&ahead) < 0.9986
                || view.range < last.range - STEP
        };
        if self.seen.last().is_none_or(is_new) {
            let far = view.range.min(FAR);
            let free = if far > NEAR { far - DOUBT[0] - DOUBT[1] * far } else { 0.0 };
            let look = Look { at: view.at, ahead, range: view.range, free };
            self.seen.push(Seen { look, places: Vec::new() });
        }
    }

    /// Forgets all looks, and what was made of them.
    pub fn forget(&mut self) {
        self.seen.clear();
        self.sifted = 0;
        self.blocked.clear();
        self.trail.clear();
    }

    /// Takes something small for granted at a place that cannot be seen.
    pub fn block(&mut self, at: Point) {
        self.blocked.push(at);
    }

    /// True if nothing stands at a place.
    pub fn is_free(&self, at: Point) -> bool {
        self.was_at(at, self.hull) || self.shown_free(at)
    }

    fn shown_free(&self, at: Point) -> bool {
        self.seen.iter().rev().any(|seen| seen.look.shows_free(at, self.free_cos))
    }

    fn was_at(&self, at: Point, reach: f64) -> bool {
        self.trail.iter().rev().any(|place| distance(*place, at) < reach)
    }

    /// How far the robot can follow a path and stay, with a margin in cm, where nothing stands.
    pub fn safe(&self, path: &Path, margin: f64) -> Safe {
        let mut safe = Safe { way: 0.0, unseen: None };
        for (way, pose) in path.samples(STEP) {
            if way > 0.0 {
                let front = FRONT.map(|degrees| {
                    let out = rotated(heading_vector(pose.heading), degrees.to_radians());
                    point(vec2(pose.point()) + out * (self.hull + margin))
                });
                safe.unseen = front.into_iter().find(|place| !self.is_free(*place));
            }
            if safe.unseen.is_some() {
                break;
            }
            safe.way = way;
        }
        safe
    }

    /// The obstacles that have been seen and that the map lacks.
    pub fn obstacles(&mut self, known: &Map) -> Vec<Obstacle> {
        self.obstacles_within(FAR, known)
    }

    /// The same, from echoes within a distance in cm, at most [`FAR`].
    pub(crate) fn obstacles_within(&mut self, far: f64, known: &Map) -> Vec<Obstacle> {
        self.sift();
        let mut squares: BTreeMap<[i64; 2], Vec<Point>> = BTreeMap::new();
        let near = self.seen.iter().filter(|seen| seen.look.range <= far);
        let places = near.flat_map(|seen| self.echo(seen, known));
        for place in places.chain(self.blocked.iter().copied()) {
            #[expect(clippy::cast_possible_truncation, reason = "saturates")]
            let square = place.map(|n| libm::floor(n / SQUARE) as i64);
            squares.entry(square).or_default().push(place);
        }
        squares
            .into_values()
            .filter_map(|places| Obstacle::polygon(outline(&places)).ok())
            .collect()
    }

    /// Compares the places of all looks with each other. Looks that were compared
    /// before are compared only with the new ones.
    fn sift(&mut self) {
        let cos = self.free_cos;
        for new in self.sifted..self.seen.len() {
            let (before, rest) = self.seen.split_at_mut(new);
            let seen = &mut rest[0];
            let look = seen.look;
            let nowhere = [f64::INFINITY, f64::NEG_INFINITY];
            let places = if look.range <= FAR { look.across() } else { Vec::new() };
            seen.places = places.into_iter().map(|at| Place { at, aside: nowhere }).collect();
            for other in before.iter_mut() {
                seen.learn(&other.look, cos);
                other.learn(&look, cos);
            }
            seen.learn(&look, cos);
        }
        self.sifted = self.seen.len();
    }

    /// The places that a look's echo may have come from, unless the map has an obstacle there.
    fn echo(&self, seen: &Seen, known: &Map) -> Vec<Point> {
        if seen.places.iter().any(|place| !known.point_clear(place.at, KNOWN)) {
            return Vec::new();
        }
        let grain = ECHO_HALF_ANGLE.to_radians() * seen.look.range / f64::from(seen.look.steps());
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let is_narrow = seen.places.len() as f64 * grain <= WIDE;
        // Or looks in different directions agree.
        let is_clear = |place: &&Place| is_narrow || place.aside[1] - place.aside[0] >= AGREED;
        let clear = seen.places.iter().filter(is_clear).map(|place| place.at);
        clear.filter(|at| !self.was_at(*at, self.hull + AROUND)).collect()
    }
}

/// The corners of a polygon around some points.
fn outline(places: &[Point]) -> Vec<Point> {
    let corners = [[-AROUND, -AROUND], [AROUND, -AROUND], [AROUND, AROUND], [-AROUND, AROUND]];
    let around = |place: &Point| corners.map(|[x, y]| parry([place[0] + x, place[1] + y]));
    let cloud: Vec<_> = places.iter().flat_map(around).collect();
    let mut outline: Vec<Point> =
        convex_hull(&cloud).into_iter().map(|corner| [corner.x, corner.y]).collect();
    outline.dedup_by(|a, b| length(vec2(*a) - vec2(*b)) < 1e-6);
    outline
}
