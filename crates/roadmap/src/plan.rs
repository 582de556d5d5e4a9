//! From a start to a goal.
use crate::geometry::Point;
use crate::map::Map;
use crate::problem::{Method, Options, Sought};
use crate::{prm, rrt, smooth, visibility};
use ev3_motion::Path;

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
    /// The search found no path. If the visibility graph found none, there is no path
    /// that keeps 2 % more distance.
    #[error("there is no path between the obstacles")]
    None,
}

/// A way, and the roadmap it was found on.
#[derive(Clone, Debug)]
pub struct Solution {
    /// The way, smoothed.
    pub path: Path,
    /// The way along the roadmap, from corner to corner.
    pub raw: Vec<Point>,
    /// The lines of the roadmap that the search checked and that keep the distance.
    pub roadmap: Vec<[Point; 2]>,
}

/// Finds a way from a start to a goal. Errors: the reason why there is no path.
pub fn plan(map: &Map, start: Point, goal: Point, options: &Options) -> Result<Solution, NoWay> {
    if !map.point_clear(start, options.keep) {
        return Err(NoWay::StartBlocked);
    }
    if !map.point_clear(goal, options.keep) {
        return Err(NoWay::GoalBlocked);
    }
    if map.line_clear(start, goal, options.keep) {
        let raw = vec![start, goal];
        return Ok(Solution { path: Path::straight(&raw), roadmap: vec![[start, goal]], raw });
    }
    let sought =
        Sought { start, goal, keep: options.keep, samples: options.samples, seed: options.seed };
    let search = match options.method {
        Method::Visibility => visibility::search,
        Method::Prm => prm::search,
        Method::Rrt => rrt::search,
        Method::RrtFromBoth => rrt::search_from_both,
        Method::RrtStar => rrt::search_star,
    };
    let (points, searched) = search(map, &sought);
    let way = searched.way.ok_or(NoWay::None)?;
    let raw: Vec<Point> = way.into_iter().map(|node| points[node]).collect();
    let roadmap = searched.edges.into_iter().map(|[a, b]| [points[a], points[b]]).collect();
    let straight = smooth::shortened(map, &raw, options.keep);
    let path = smooth::rounded(map, &straight, options.keep, options.arc_radius);
    Ok(Solution { path, raw, roadmap })
}
