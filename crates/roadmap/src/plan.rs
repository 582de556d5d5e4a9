//! From a start to a goal.
use crate::geometry::{Point, distance};
use crate::map::{Bounds, Map};
use crate::path::Path;
use crate::{prm, rrt, smooth, visibility};
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// What planning leaves more than it has to, in cm, for rounding to use up.
pub(crate) const SLACK: f64 = 1e-4;

/// How a roadmap is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All corners of the obstacles: the shortest way.
    #[default]
    Visibility,
    /// Points drawn at random, each joined with those next to it.
    Prm,
    /// A tree that grows from the start.
    RrtStar,
}

/// What to plan for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How far the robot's centre keeps from obstacles, in cm.
    pub keep: f64,
    /// Arcs have at least this radius, in cm. Where none fits, a corner stays.
    pub arc_radius: f64,
    /// How the roadmap is made.
    pub method: Method,
    /// How many points are drawn at random.
    pub samples: u32,
    /// Where chance starts from.
    pub seed: u64,
}

impl Default for Options {
    /// For the robot of the paper, with a margin of 4 cm.
    fn default() -> Self {
        Options { keep: 12.0, arc_radius: 6.0, method: Method::default(), samples: 500, seed: 1 }
    }
}

/// Why there is no way.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum NoWay {
    /// An obstacle is too near.
    #[error("an obstacle is too near to the start")]
    StartBlocked,
    /// An obstacle is too near.
    #[error("an obstacle is too near to the goal")]
    GoalBlocked,
    /// None was found. There is none, if it is the visibility graph that says so:
    /// at least none that keeps 2 % more.
    #[error("there is no way between the obstacles")]
    None,
}

/// A way, and the roadmap it was found on.
#[derive(Clone, Debug)]
pub struct Found {
    /// The way, smoothed.
    pub path: Path,
    /// The way along the roadmap, from corner to corner.
    pub raw: Vec<Point>,
    /// The lines of the roadmap that were looked at and keep the distance.
    pub roadmap: Vec<[Point; 2]>,
}

/// What a search looks for.
pub(crate) struct Sought {
    pub(crate) start: Point,
    pub(crate) goal: Point,
    pub(crate) keep: f64,
    pub(crate) samples: u32,
    seed: u64,
}

impl Sought {
    pub(crate) fn draws(&self, map: &Map) -> Draws {
        let extent = map.extent([self.start, self.goal], 4.0 * self.keep);
        Draws { generator: Pcg32::new(self.seed, 0), extent }
    }
}

/// Points at random.
pub(crate) struct Draws {
    generator: Pcg32,
    extent: Bounds,
}

impl Draws {
    pub(crate) fn point(&mut self) -> Point {
        let Bounds { low, high } = self.extent;
        [0, 1].map(|axis| {
            let share = f64::from(self.generator.next_u32()) / f64::from(u32::MAX);
            low[axis] + (high[axis] - low[axis]) * share
        })
    }

    pub(crate) fn diagonal(&self) -> f64 {
        distance(self.extent.low, self.extent.high)
    }
}

/// Finds a way from a start to a goal.
///
/// # Errors
/// Says why there is none.
pub fn plan(map: &Map, start: Point, goal: Point, options: &Options) -> Result<Found, NoWay> {
    if !map.point_clear(start, options.keep) {
        return Err(NoWay::StartBlocked);
    }
    if !map.point_clear(goal, options.keep) {
        return Err(NoWay::GoalBlocked);
    }
    if map.line_clear(start, goal, options.keep) {
        let raw = vec![start, goal];
        return Ok(Found { path: Path::straight(&raw), roadmap: vec![[start, goal]], raw });
    }
    let sought =
        Sought { start, goal, keep: options.keep, samples: options.samples, seed: options.seed };
    let search = match options.method {
        Method::Visibility => visibility::search,
        Method::Prm => prm::search,
        Method::RrtStar => rrt::search,
    };
    let (points, searched) = search(map, &sought);
    let way = searched.way.ok_or(NoWay::None)?;
    let raw: Vec<Point> = way.into_iter().map(|node| points[node]).collect();
    let roadmap = searched.edges.into_iter().map(|[a, b]| [points[a], points[b]]).collect();
    let straight = smooth::shortened(map, &raw, options.keep);
    let path = smooth::rounded(map, &straight, options.keep, options.arc_radius);
    Ok(Found { path, raw, roadmap })
}
