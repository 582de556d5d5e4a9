//! One step of a drive through a room that is not wholly known.
use crate::geometry::{Point, heading_vector, point, vec2};
use crate::map::Map;
use crate::plan::{NoWay, plan};
use crate::problem::Options;
use crate::views::{FAR, Views};
use ev3_motion::{Path, Segment, wrapped};

/// Ranges of echoes that count, in cm, one after the other. Far echoes are vague,
/// so if they leave no way, only near ones count.
const HEARD: [f64; 2] = [FAR, 40.0];
/// The parts of the margin that are tried, one after the other. The least is
/// for a robot that has come too near to something and is to get away.
const MARGINS: [f64; 3] = [1.0, 0.7, 0.1];
/// How much wider than the hull the way must be free, in cm: a robot does not
/// keep to its way exactly.
const BESIDE: f64 = 0.5;
/// Segments whose directions differ by less, in degrees, go on without a corner.
const SMOOTH: f64 = 1.15;
/// A corner so near to the start is gone round without a stop, in cm.
const SHORT: f64 = 1.0;
/// How far a robot steps back that stands too near to something, in cm, and in
/// how many directions that is tried.
const BACK: [f64; 4] = [2.0, 4.0, 6.0, 8.0];
const DIRECTIONS: u8 = 24;

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
    /// Plans with the map and with what has been seen. The distance to keep is the hull's radius
    /// and a margin in cm, or a part of that if no way is wide enough.
    /// Errors: says why there is no way.
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
            headings.clone().map(move |heading| point(vec2(start) + heading_vector(heading) * far))
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
    let segments = path.segments();
    let goes_on =
        |pair: &[Segment]| wrapped(pair[1].start().heading - pair[0].end().heading).abs() < SMOOTH;
    let mut way = 0.0;
    let is_corner = |pair: &[Segment]| {
        way += pair[0].length();
        way > SHORT && !goes_on(pair)
    };
    match segments.windows(2).position(is_corner) {
        None => (path, 0.0),
        Some(last) => {
            let rest = segments[last + 1..].iter().map(Segment::length).sum();
            (Path::new(segments[..=last].to_vec()), rest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::distance;
    use crate::{Obstacle, View};
    use ev3_motion::Pose;

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
            let ahead = heading_vector(heading) * 7.0;
            views.add(View { at: [ahead.x, ahead.y], heading, range: 255.0 });
        }
        let safe = step(&mut views).safe;
        assert!((90.0..100.0).contains(&safe), "{safe}");
        let wall = Obstacle::wall([-20.0, 30.0], [5.0, 30.0], 1.0).unwrap();
        let map = Map::new(vec![wall], None).unwrap();
        // No arc of half a meter fits beside the wall.
        let options = Options { arc_radius: 50.0, ..Options::default() };
        let step = views.next_step(&map, [0.0, 0.0], [0.0, 60.0], 2.0, &options).unwrap();
        assert_eq!(step.run.segments().len(), 1);
        assert!(step.rest > 20.0);
    }

    #[test]
    fn steering_keeps_to_lines_and_arcs() {
        let wall = Obstacle::wall([-100.0, 50.0], [10.0, 50.0], 2.0).unwrap();
        let map = Map::new(vec![wall], None).unwrap();
        let path = crate::plan(&map, [0.0, 0.0], [0.0, 100.0], &Options::default()).unwrap().path;
        let mut way = 0.0;
        let mut at = Pose { x: 0.5, y: 0.0, heading: path.heading() + 5.0 };
        let mut farthest: f64 = 0.0;
        for _ in 0..1000 {
            let (on, turn) = path.steer(at, way);
            way = on;
            at = at.along_arc(0.2, turn * 0.2);
            let off = path.samples(0.1).map(|(_, pose)| distance(pose.point(), at.point()));
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
