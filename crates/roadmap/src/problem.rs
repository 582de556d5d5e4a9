//! A planning problem: its options, the task of the search, and its random points.
use crate::geometry::{Point, distance};
use crate::map::Map;
use ev3_motion::Bounds;
use rand_pcg::Pcg32;
use rand_pcg::rand_core::Rng;

/// Planning keeps this much more distance than it must, in cm, so that rounding does no harm.
pub(crate) const SLACK: f64 = 1e-4;

/// How a roadmap is made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// All corners of the obstacles: the shortest way.
    #[default]
    Visibility,
    /// Points drawn at random, each joined with those next to it.
    Prm,
    /// A tree that grows from the start until it is at the goal.
    Rrt,
    /// Two trees, from the start and from the goal, until they meet.
    RrtFromBoth,
    /// A tree that grows from the start, and is rewired where that shortens a way.
    RrtStar,
}

/// The options of a plan.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// How far the robot's center keeps from obstacles, in cm.
    pub keep: f64,
    /// Arcs have at least this radius, in cm. Where none fits, a corner stays.
    pub arc_radius: f64,
    /// How the roadmap is made.
    pub method: Method,
    /// How many points are drawn at random.
    pub samples: u32,
    /// The seed of the random numbers.
    pub seed: u64,
}

impl Default for Options {
    /// For the robot of the paper, with a margin of 4 cm.
    fn default() -> Self {
        Options { keep: 12.0, arc_radius: 6.0, method: Method::default(), samples: 500, seed: 1 }
    }
}

/// The task of a search.
pub(crate) struct Sought {
    pub(crate) start: Point,
    pub(crate) goal: Point,
    pub(crate) keep: f64,
    pub(crate) samples: u32,
    pub(crate) seed: u64,
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
