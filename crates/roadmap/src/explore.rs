//! One step of a drive through a room that is not wholly known.
use crate::geometry::{Point, Vec2, angle, cross, direction, distance, length, point, vec2};
use crate::map::Map;
use crate::path::{Leg, Path};
use crate::plan::{NoWay, plan};
use crate::problem::Options;
use crate::views::{FAR, Views};

/// Ranges of echoes that count, in cm, one after the other. Far echoes are vague,
/// so if they leave no way, only near ones count.
const HEARD: [f64; 2] = [FAR, 40.0];
/// The parts of the margin that are tried, one after the other. The least is
/// for a robot that has come too near to something and is to get away.
const MARGINS: [f64; 3] = [1.0, 0.7, 0.1];
/// How much wider than the hull the way must be free, in cm: a robot does not
/// keep to its way exactly.
const BESIDE: f64 = 0.5;
/// Legs whose directions differ by less, in radians, go on without a corner.
const SMOOTH: f64 = 0.02;
/// A corner so near to the start is gone round without a stop, in cm.
const SHORT: f64 = 1.0;
/// How far a robot steps back that stands too near to something, in cm, and in
/// how many directions that is tried.
const BACK: [f64; 4] = [2.0, 4.0, 6.0, 8.0];
const DIRECTIONS: u8 = 24;
/// How far ahead on its way a robot aims, in cm.
const AHEAD: f64 = 4.0;

/// The next action.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// The way up to its first corner.
    pub run: Path,
    /// How much of that has been seen free, in cm.
    pub safe: f64,
    /// The first place there that has not been seen free.
    pub unseen: Option<Point>,
    /// How far it is to the goal from the end of the run, in cm.
    pub rest: f64,
}

impl Views {
    /// Plans with the map and with what has been seen. The distance to keep is
    /// the hull's radius and a margin in cm, or a part of that if no way is
    /// wide enough.
    ///
    /// # Errors
    /// Says why there is no way.
    pub fn next_step(
        &mut self,
        known: &Map,
        start: Point,
        goal: Point,
        margin: f64,
        options: &Options,
    ) -> Result<Step, NoWay> {
        let mut answer = Err(NoWay::None);
        for far in HEARD {
            let mut map = known.clone();
            for obstacle in self.obstacles_within(far, known) {
                map.add(obstacle);
            }
            for part in MARGINS {
                let options = Options { keep: self.hull() + margin * part, ..*options };
                answer = plan(&map, start, goal, &options).map(|found| {
                    let (run, rest) = until_corner(found.path);
                    let safe = self.safe(&run, BESIDE);
                    Step { run, safe: safe.way, unseen: safe.unseen, rest }
                });
                if answer.is_ok() {
                    return answer;
                }
            }
            let options = Options { keep: self.hull() + margin * MARGINS[1], ..*options };
            if let Some(step) = self.step_back(&map, start, goal, &options) {
                return Ok(step);
            }
        }
        answer
    }

    /// A straight line over what has been seen free, from a place too near to
    /// something to one from where there is a way.
    fn step_back(&self, map: &Map, start: Point, goal: Point, options: &Options) -> Option<Step> {
        if map.point_clear(start, options.keep) {
            return None;
        }
        let headings = (0..DIRECTIONS).map(|n| 360.0 * f64::from(n) / f64::from(DIRECTIONS));
        let places = BACK.into_iter().flat_map(|far| {
            headings.clone().map(move |heading| point(vec2(start) + direction(heading) * far))
        });
        let mut steps = places.filter_map(|place| {
            let run = Path::straight(&[start, place]);
            if !map.point_clear(place, options.keep) || self.safe(&run, BESIDE).unseen.is_some() {
                return None;
            }
            let found = plan(map, place, goal, options).ok()?;
            Some(Step { safe: run.length(), run, unseen: None, rest: found.path.length() })
        });
        steps.next()
    }
}

/// A way up to its first corner, and how much is left.
fn until_corner(path: Path) -> (Path, f64) {
    let legs = path.legs();
    let goes_on = |pair: &[Leg]| {
        let (before, after) = (pair[0].direction_at(pair[0].length()), pair[1].direction_at(0.0));
        angle(before, after).abs() < SMOOTH
    };
    let mut way = 0.0;
    let is_corner = |pair: &[Leg]| {
        way += pair[0].length();
        way > SHORT && !goes_on(pair)
    };
    match legs.windows(2).position(is_corner) {
        None => (path, 0.0),
        Some(last) => {
            let rest = legs[last + 1..].iter().map(Leg::length).sum();
            (Path::new(legs[..=last].to_vec()), rest)
        }
    }
}

impl Path {
    /// The heading at its start, in degrees.
    #[must_use]
    pub fn heading(&self) -> f64 {
        let start = self.legs().first().map_or(Vec2::zeros(), |leg| vec2(leg.start()));
        let ahead = self.beyond(AHEAD) - start;
        libm::atan2(ahead.x, ahead.y).to_degrees()
    }

    /// How a robot at a pose stays on its way: how much of the way it has
    /// behind it, in cm, given how much it had before; and by how much to turn
    /// on each cm, in degrees, clockwise positive.
    #[must_use]
    pub fn steer(&self, at: Point, heading: f64, before: f64) -> (f64, f64) {
        let window = before..=before + 2.0 * AHEAD;
        let near = self.samples(0.5).filter(|(way, _, _)| window.contains(way));
        let nearest = near.min_by(|a, b| distance(a.1, at).total_cmp(&distance(b.1, at)));
        let way = nearest.map_or(before, |(way, _, _)| way);
        let aim = self.beyond(way + AHEAD);
        let offset = aim - vec2(at);
        let far = length(offset).max(1.0);
        // The arc through the pose that meets the point aimed at
        let curvature = -2.0 * cross(direction(heading), offset) / (far * far);
        (way, curvature.to_degrees())
    }

    /// The point after a distance in cm; past the end straight on.
    fn beyond(&self, way: f64) -> Vec2 {
        let mut left = way;
        for leg in self.legs() {
            if left <= leg.length() {
                return vec2(leg.at(left));
            }
            left -= leg.length();
        }
        self.legs()
            .last()
            .map_or(Vec2::zeros(), |leg| vec2(leg.end()) + leg.direction_at(leg.length()) * left)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Obstacle, View};

    #[test]
    fn a_step_ends_at_a_corner_or_at_what_is_not_seen() {
        let map = Map::new(Vec::new(), None).unwrap();
        let mut views = Views::new(8.0);
        views.stand([0.0, 0.0]);
        let step = |views: &mut Views| {
            views.next_step(&map, [0.0, 0.0], [0.0, 150.0], 2.0, &Options::default()).unwrap()
        };
        let first = step(&mut views);
        assert!(first.safe < 1.0 && first.unseen.is_some());
        for turn in -60..=60 {
            let heading = f64::from(turn) * 1.5;
            let ahead = direction(heading) * 7.0;
            views.add(View { at: [ahead.x, ahead.y], heading, range: 255.0 });
        }
        let safe = step(&mut views).safe;
        assert!((90.0..100.0).contains(&safe), "{safe}");
        let wall = Obstacle::wall([-20.0, 30.0], [5.0, 30.0], 1.0).unwrap();
        let map = Map::new(vec![wall], None).unwrap();
        // No arc of half a meter fits beside the wall.
        let options = Options { arc_radius: 50.0, ..Options::default() };
        let step = views.next_step(&map, [0.0, 0.0], [0.0, 60.0], 2.0, &options).unwrap();
        assert_eq!(step.run.legs().len(), 1);
        assert!(step.rest > 20.0);
    }

    #[test]
    fn steering_keeps_to_lines_and_arcs() {
        let wall = Obstacle::wall([-100.0, 50.0], [10.0, 50.0], 2.0).unwrap();
        let map = Map::new(vec![wall], None).unwrap();
        let path = crate::plan(&map, [0.0, 0.0], [0.0, 100.0], &Options::default()).unwrap().path;
        let (mut at, mut heading, mut way) = (vec2([0.5, 0.0]), path.heading() + 5.0, 0.0);
        let mut farthest: f64 = 0.0;
        for _ in 0..1000 {
            let (on, turn) = path.steer([at.x, at.y], heading, way);
            way = on;
            heading += turn * 0.2;
            at += direction(heading) * 0.2;
            let off = path.samples(0.1).map(|(_, p, _)| distance(p, [at.x, at.y]));
            let off = off.fold(f64::INFINITY, f64::min);
            if way > 10.0 {
                farthest = farthest.max(off);
            }
            if way >= path.length() - 0.5 {
                break;
            }
        }
        assert!(way >= path.length() - 0.5, "{way}");
        assert!(farthest < 0.5, "{farthest}");
    }
}
