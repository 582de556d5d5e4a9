//! Ways of straight lines and arcs.
use crate::arc::Arc;
use crate::geometry::{Point, Vec2, distance, point, unit, vec2};

/// A part of a way.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Leg {
    /// Straight on.
    Line {
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
    },
    /// Along a circle, by less than half a turn.
    Arc {
        /// Where it begins.
        from: Point,
        /// Where it ends.
        to: Point,
        /// The middle of the circle.
        center: Point,
        /// In cm.
        radius: f64,
        /// By how much the heading changes: degrees, clockwise positive.
        angle: f64,
    },
}

impl From<Arc> for Leg {
    fn from(arc: Arc) -> Leg {
        let Arc { from, to, center, radius, sweep } = arc;
        Leg::Arc { from, to, center, radius, angle: -sweep.to_degrees() }
    }
}

impl Leg {
    pub(crate) fn line(from: Point, to: Point) -> Leg {
        Leg::Line { from, to }
    }

    fn arc(&self) -> Option<Arc> {
        match *self {
            Leg::Arc { from, to, center, radius, angle } => {
                Some(Arc { from, to, center, radius, sweep: -angle.to_radians() })
            }
            Leg::Line { .. } => None,
        }
    }

    /// Where it begins.
    #[must_use]
    pub fn start(&self) -> Point {
        match *self {
            Leg::Line { from, .. } | Leg::Arc { from, .. } => from,
        }
    }

    /// Where it ends.
    #[must_use]
    pub fn end(&self) -> Point {
        match *self {
            Leg::Line { to, .. } | Leg::Arc { to, .. } => to,
        }
    }

    /// In cm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.arc().map_or_else(|| distance(self.start(), self.end()), |arc| arc.length())
    }

    /// The point after a distance in cm.
    #[must_use]
    pub fn at(&self, way: f64) -> Point {
        let share = if self.length() > 0.0 { (way / self.length()).clamp(0.0, 1.0) } else { 0.0 };
        match self.arc() {
            Some(arc) => arc.at(share),
            None => point(vec2(self.start()) + (vec2(self.end()) - vec2(self.start())) * share),
        }
    }

    /// The direction of motion after a distance in cm.
    pub(crate) fn direction_at(&self, way: f64) -> Vec2 {
        match self.arc() {
            Some(arc) => arc.direction_at((way / arc.length()).clamp(0.0, 1.0)),
            None => unit(vec2(self.end()) - vec2(self.start())),
        }
    }

    /// Its beginning, up to a distance in cm.
    pub(crate) fn until(&self, way: f64) -> Leg {
        match *self {
            Leg::Line { from, .. } => Leg::Line { from, to: self.at(way) },
            Leg::Arc { from, center, radius, angle, .. } => {
                let share = (way / self.length()).clamp(0.0, 1.0);
                Leg::Arc { from, to: self.at(way), center, radius, angle: angle * share }
            }
        }
    }
}

/// A way: legs, each of which begins where the one before ends.
///
/// Arcs begin and end in the direction of the lines next to them. Where two
/// lines meet is a corner, at which the robot turns on the spot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    legs: Vec<Leg>,
}

impl Path {
    /// A way of these legs; those without a length are left out.
    #[must_use]
    pub fn new(mut legs: Vec<Leg>) -> Path {
        legs.retain(|leg| leg.length() > 1e-9);
        Path { legs }
    }

    pub(crate) fn straight(corners: &[Point]) -> Path {
        Path::new(corners.windows(2).map(|pair| Leg::line(pair[0], pair[1])).collect())
    }

    /// Its legs.
    #[must_use]
    pub fn legs(&self) -> &[Leg] {
        &self.legs
    }

    /// Where legs begin and end.
    #[must_use]
    pub fn points(&self) -> Vec<Point> {
        let first = self.legs.first().map(Leg::start);
        first.into_iter().chain(self.legs.iter().map(Leg::end)).collect()
    }

    /// In cm.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.legs.iter().map(Leg::length).sum()
    }

    /// Its beginning, up to a distance in cm.
    #[must_use]
    pub fn until(&self, mut way: f64) -> Path {
        let mut legs = Vec::new();
        for leg in &self.legs {
            legs.push(if leg.length() > way { leg.until(way) } else { *leg });
            way -= leg.length();
            if way <= 0.0 {
                break;
            }
        }
        Path::new(legs)
    }

    /// Points along it, at most a step apart, each with the direction of going
    /// and the way up to there.
    pub(crate) fn samples(&self, step: f64) -> impl Iterator<Item = (f64, Point, Vec2)> + '_ {
        let mut before = 0.0;
        self.legs.iter().flat_map(move |leg| {
            let start = before;
            before += leg.length();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
            let count = libm::ceil(leg.length() / step) as u32;
            (0..=count).map(move |index| {
                let way = leg.length() * f64::from(index) / f64::from(count.max(1));
                (start + way, leg.at(way), leg.direction_at(way))
            })
        })
    }
}
