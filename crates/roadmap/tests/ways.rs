//! Laws that hold for every map and every way.
#![expect(
    clippy::cast_possible_truncation,
    clippy::cast_precision_loss,
    clippy::cast_sign_loss,
    reason = "small counts"
)]
use ev3_roadmap::{
    Bounds, Map, Method, NoWay, Obstacle, Options, Path, Point, Segment, Solution, plan,
};
use proptest::prelude::*;

const KEEP: f64 = 8.0;
const DRAWN: [Method; 4] = [Method::Prm, Method::Rrt, Method::RrtFromBoth, Method::RrtStar];

/// An obstacle, and as it is measured here: by itself, not by the crate.
#[derive(Clone, Debug)]
enum Thing {
    Polygon(Vec<Point>),
    Circle(Point, f64),
}

impl Thing {
    fn obstacle(&self) -> Obstacle {
        match self {
            Thing::Polygon(corners) => Obstacle::polygon(corners.clone()).unwrap(),
            Thing::Circle(center, radius) => Obstacle::circle(*center, *radius).unwrap(),
        }
    }

    /// How far a point is from it; negative inside.
    fn distance(&self, [x, y]: Point) -> f64 {
        match self {
            Thing::Circle([cx, cy], radius) => (x - cx).hypot(y - cy) - radius,
            Thing::Polygon(corners) => {
                let mut least = f64::INFINITY;
                let mut inside = false;
                for (index, [ax, ay]) in corners.iter().enumerate() {
                    let [bx, by] = corners[(index + 1) % corners.len()];
                    let (dx, dy) = (bx - ax, by - ay);
                    let at = ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy);
                    let at = at.clamp(0.0, 1.0);
                    least = least.min((x - ax - at * dx).hypot(y - ay - at * dy));
                    if (*ay > y) != (by > y) && x < (bx - ax) * (y - ay) / (by - ay) + ax {
                        inside = !inside;
                    }
                }
                if inside { -least } else { least }
            }
        }
    }
}

/// A star around its middle: simple, and mostly concave.
fn star() -> impl Strategy<Value = Thing> {
    let spokes = prop::collection::vec(3.0..30.0_f64, 3..9);
    (0.0..200.0_f64, 0.0..200.0_f64, spokes, 0.0..6.0_f64).prop_map(|(x, y, spokes, turn)| {
        let step = std::f64::consts::TAU / spokes.len() as f64;
        let corner = |(index, spoke): (usize, &f64)| {
            let (sin, cos) = (turn + step * index as f64).sin_cos();
            [x + spoke * cos, y + spoke * sin]
        };
        Thing::Polygon(spokes.iter().enumerate().map(corner).collect())
    })
}

fn thing() -> impl Strategy<Value = Thing> {
    let circle = (0.0..200.0_f64, 0.0..200.0_f64, 1.0..20.0_f64)
        .prop_map(|(x, y, radius)| Thing::Circle([x, y], radius));
    prop_oneof![3 => star(), 1 => circle]
}

/// The side of the outline that a place is within, of those with corners each 45
/// degrees around what is blown up; 0 if it is outside of all.
fn within_outlines(things: &[Thing], at: Point) -> f64 {
    let half = std::f64::consts::PI / 8.0;
    let side = |thing: &Thing| {
        let reach = KEEP + if let Thing::Circle(_, radius) = thing { *radius } else { 0.0 };
        let depth = reach * (1.0 / half.cos() - 1.0);
        if thing.distance(at) < KEEP + depth { reach * half.tan() } else { 0.0 }
    };
    things.iter().map(side).fold(0.0, f64::max)
}

fn map_of(things: &[Thing], bounds: Option<Bounds>) -> Map {
    Map::new(things.iter().map(Thing::obstacle).collect(), bounds).unwrap()
}

const BOUNDS: Bounds = Bounds { low: [-20.0, -20.0], high: [220.0, 220.0] };

/// Points along a way, at most 0.2 cm apart.
fn along(path: &Path) -> impl Iterator<Item = Point> + '_ {
    path.segments().iter().flat_map(|leg| {
        let count = (leg.length() / 0.2).ceil() as u32;
        (0..=count)
            .map(move |i| leg.at(leg.length() * f64::from(i) / f64::from(count.max(1))).point())
    })
}

fn least_distance(things: &[Thing], path: &Path, bounds: Option<Bounds>) -> f64 {
    let to_bounds = |[x, y]: Point| {
        bounds.map_or(f64::INFINITY, |Bounds { low, high }| {
            (x - low[0]).min(high[0] - x).min(y - low[1]).min(high[1] - y)
        })
    };
    let distance =
        |at: Point| things.iter().map(|thing| thing.distance(at)).fold(to_bounds(at), f64::min);
    along(path).map(distance).fold(f64::INFINITY, f64::min)
}

fn distance([ax, ay]: Point, [bx, by]: Point) -> f64 {
    (bx - ax).hypot(by - ay)
}

/// Directions of going at the beginning and the end of a leg.
fn directions(leg: &Segment) -> [Point; 2] {
    let step = 1e-5 * leg.length();
    let unit = |a: Point, b: Point| [b[0] - a[0], b[1] - a[1]].map(|n| n / distance(a, b));
    let at = |way| leg.at(way).point();
    [unit(at(0.0), at(step)), unit(at(leg.length() - step), at(leg.length()))]
}

fn is_sound(
    found: &Solution,
    start: Point,
    goal: Point,
    arc_radius: f64,
) -> Result<(), TestCaseError> {
    let points = found.path.points();
    prop_assert!(distance(points[0], start) < 1e-9);
    prop_assert!(distance(points[points.len() - 1], goal) < 1e-9);
    for pair in found.path.segments().windows(2) {
        prop_assert!(distance(pair[0].to(), pair[1].from()) < 1e-6);
        if pair[0].radius().is_none() && pair[1].radius().is_none() {
            continue;
        }
        let ([_, before], [after, _]) = (directions(&pair[0]), directions(&pair[1]));
        prop_assert!(distance(before, after) < 1e-3, "a kink before or after an arc: {pair:?}");
    }
    for leg in found.path.segments() {
        if let (Some(radius), Some(center)) = (leg.radius(), leg.center()) {
            let (radius, to) = (radius.abs(), leg.to());
            prop_assert!(radius >= arc_radius - 1e-9);
            prop_assert!((distance(leg.from(), center) - radius).abs() < 1e-6);
            prop_assert!((distance(to, center) - radius).abs() < 1e-6);
            prop_assert!(distance(leg.at(leg.length()).point(), to) < 1e-6);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..Default::default() })]

    #[test]
    fn no_way_is_nearer_than_the_radius(
        things in prop::collection::vec(thing(), 1..9),
        (x, y, u, v) in (-10.0..210.0_f64, -10.0..210.0_f64, -10.0..210.0_f64, -10.0..210.0_f64),
        method in prop::sample::select([&[Method::Visibility], &DRAWN[..]].concat()),
        arc_radius in 0.5..30.0_f64,
        seed in any::<u64>(),
        bounded in any::<bool>(),
    ) {
        let bounds = bounded.then_some(BOUNDS);
        let map = map_of(&things, bounds);
        let options = Options { keep: KEEP, arc_radius, method, samples: 150, seed };
        if let Ok(found) = plan(&map, [x, y], [u, v], &options) {
            let least = least_distance(&things, &found.path, bounds);
            prop_assert!(least >= KEEP - 1e-6, "{least} along {:?}", found.path);
            is_sound(&found, [x, y], [u, v], arc_radius)?;
            let raw: f64 = found.raw.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
            prop_assert!(found.path.length() <= raw + 1e-6);
            prop_assert!(found.path.length() >= distance([x, y], [u, v]) - 1e-6);
        }
    }

    #[test]
    fn chance_finds_no_way_where_there_is_none_and_none_that_is_shorter(
        things in prop::collection::vec(thing(), 1..7),
        (x, y, u, v) in (0.0..200.0_f64, 0.0..200.0_f64, 0.0..200.0_f64, 0.0..200.0_f64),
        method in prop::sample::select(DRAWN.to_vec()),
        seed in any::<u64>(),
    ) {
        let map = map_of(&things, Some(BOUNDS));
        let options = Options { keep: KEEP, samples: 300, seed, ..Options::default() };
        let best = plan(&map, [x, y], [u, v], &options);
        let drawn = plan(&map, [x, y], [u, v], &Options { method, ..options });
        match (best, drawn) {
            (Ok(best), Ok(drawn)) => {
                let length = |found: &Solution| -> f64 {
                    found.raw.windows(2).map(|pair| distance(pair[0], pair[1])).sum()
                };
                // Around the outside of its polygons it is longer by at most this; where it begins
                // or ends within them, it may go to a corner and back, too.
                let most = length(&drawn) / (std::f64::consts::PI / 8.0).cos();
                let within = [[x, y], [u, v]].map(|end| within_outlines(&things, end));
                let ends: f64 = within.iter().sum();
                prop_assert!(length(&best) <= most + 2.0 * ends + 1e-3);
            }
            (Err(_), Ok(drawn)) => {
                // Around a corner it keeps 2 % of the radius farther away.
                let options = Options { keep: 0.98 * KEEP, ..options };
                let narrow = plan(&map, [x, y], [u, v], &options);
                prop_assert!(narrow.is_ok(), "a way where there is none: {:?}", drawn.path);
            }
            _ => {}
        }
    }
}

/// The shortest way over all corners: every pair is joined that can be, by
/// points close to one another, and all ways are compared.
fn brute_force(things: &[Thing], nodes: &[Point]) -> Option<f64> {
    let count = nodes.len();
    let free = |a: Point, b: Point| {
        let steps = (distance(a, b) / 0.05).ceil() as u32;
        (0..=steps).all(|i| {
            let share = f64::from(i) / f64::from(steps.max(1));
            let at = [a[0] + (b[0] - a[0]) * share, a[1] + (b[1] - a[1]) * share];
            things.iter().all(|thing| thing.distance(at) >= KEEP - 1e-6)
        })
    };
    let mut far = vec![vec![f64::INFINITY; count]; count];
    for a in 0..count {
        for b in 0..a {
            if free(nodes[a], nodes[b]) {
                far[a][b] = distance(nodes[a], nodes[b]);
                far[b][a] = far[a][b];
            }
        }
    }
    for through in 0..count {
        for a in 0..count {
            for b in 0..count {
                far[a][b] = far[a][b].min(far[a][through] + far[through][b]);
            }
        }
    }
    Some(far[0][1]).filter(|length| length.is_finite())
}

/// The corners of rectangles blown up by the radius, as the crate describes
/// them: at these degrees to the left and right of the diagonal.
fn blown_up(corners: &[Point], half: f64, sides: &[f64]) -> Vec<Point> {
    let middle = [0, 1].map(|axis| corners.iter().map(|c| c[axis]).sum::<f64>() / 4.0);
    let reach = (KEEP + 1e-4) / half.to_radians().cos();
    let around = |corner: &Point| {
        let diagonal = [0, 1].map(|axis| if corner[axis] > middle[axis] { 1.0_f64 } else { -1.0 });
        let heading = diagonal[1].atan2(diagonal[0]);
        let place = |side: &f64| {
            let (sin, cos) = (heading + side.to_radians()).sin_cos();
            [corner[0] + reach * cos, corner[1] + reach * sin]
        };
        sides.iter().map(place).collect::<Vec<_>>()
    };
    corners.iter().flat_map(around).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..Default::default() })]

    #[test]
    fn the_visibility_graph_has_the_shortest_way(
        boxes in prop::collection::vec(
            (20.0..180.0_f64, 20.0..180.0_f64, 5.0..60.0_f64, 5.0..60.0_f64), 1..5),
        (x, y, u, v) in (0.0..200.0_f64, 0.0..200.0_f64, 0.0..200.0_f64, 0.0..200.0_f64),
    ) {
        let corners: Vec<Vec<Point>> = boxes
            .iter()
            .map(|(x, y, w, h)| vec![[*x, *y], [x + w, *y], [x + w, y + h], [*x, y + h]])
            .collect();
        let things: Vec<Thing> = corners.iter().cloned().map(Thing::Polygon).collect();
        let map = map_of(&things, None);
        let options = Options { keep: KEEP, ..Options::default() };
        let best = |half: f64, sides: &[f64]| {
            let mut nodes = vec![[x, y], [u, v]];
            nodes.extend(corners.iter().flat_map(|corners| blown_up(corners, half, sides)));
            brute_force(&things, &nodes)
        };
        let best = || {
            let coarse = best(22.5, &[-22.5, 22.5]);
            coarse.or_else(|| best(11.25, &[-33.75, -11.25, 11.25, 33.75]))
        };
        match plan(&map, [x, y], [u, v], &options) {
            Err(NoWay::None) => prop_assert_eq!(best(), None),
            Ok(found) => {
                let best = best();
                let length: f64 =
                    found.raw.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
                prop_assert!(best.is_some_and(|best| (length - best).abs() < 1e-3),
                             "{length} for {best:?}");
            }
            Err(_) => {}
        }
    }
}

#[test]
fn the_same_seed_gives_the_same_way() {
    let wall = |x: f64, low: f64, high: f64| Obstacle::wall([x, low], [x, high], 2.0).unwrap();
    let map = Map::new(vec![wall(50.0, -20.0, 150.0), wall(120.0, 50.0, 220.0)], Some(BOUNDS));
    let map = map.unwrap();
    for method in DRAWN {
        let way = |seed| {
            let options = Options { method, seed, ..Options::default() };
            plan(&map, [10.0, 10.0], [200.0, 200.0], &options).unwrap().path
        };
        assert_eq!(way(1), way(1));
        assert_ne!(way(1), way(2), "{method:?}");
    }
}

#[test]
fn more_samples_come_closer_to_the_shortest() {
    let bar = Obstacle::rectangle([100.0, 100.0], 120.0, 10.0, 20.0).unwrap();
    let map = Map::new(vec![bar], Some(BOUNDS)).unwrap();
    let raw = |method, samples| {
        let options = Options { method, samples, ..Options::default() };
        let found = plan(&map, [100.0, 50.0], [100.0, 150.0], &options).unwrap();
        found.raw.windows(2).map(|pair| distance(pair[0], pair[1])).sum::<f64>()
    };
    let best = raw(Method::Visibility, 0);
    for method in [Method::Prm, Method::RrtStar] {
        assert!(raw(method, 3000) < 1.05 * best, "{method:?} {} {best}", raw(method, 3000));
    }
}

#[test]
fn a_tree_that_is_not_rewired_is_done_when_it_is_there() {
    let bar = Obstacle::rectangle([100.0, 100.0], 120.0, 10.0, 20.0).unwrap();
    let map = Map::new(vec![bar], Some(BOUNDS)).unwrap();
    let lines = |method, seed| {
        let options = Options { method, samples: 2000, seed, ..Options::default() };
        plan(&map, [100.0, 50.0], [100.0, 150.0], &options).unwrap().roadmap.len()
    };
    let all = |method| (0..20).map(|seed| lines(method, seed)).sum::<usize>();
    let (one, both, star) = (all(Method::Rrt), all(Method::RrtFromBoth), all(Method::RrtStar));
    // Two trees see each other sooner than one sees the goal.
    assert!(5 * both < 4 * one, "{both} lines of two trees, {one} of one");
    assert!(10 * one < star, "{one} lines, {star} of RRT*");
}

#[test]
fn a_roadmap_of_trees_has_its_way() {
    let bar = Obstacle::rectangle([100.0, 100.0], 120.0, 10.0, 20.0).unwrap();
    let map = Map::new(vec![bar], Some(BOUNDS)).unwrap();
    for method in [Method::Rrt, Method::RrtFromBoth, Method::RrtStar] {
        for seed in 0..20 {
            let options = Options { method, seed, ..Options::default() };
            let found = plan(&map, [100.0, 50.0], [100.0, 150.0], &options).unwrap();
            for leg in found.raw.windows(2) {
                let is_leg =
                    |line: &[Point; 2]| line == &[leg[0], leg[1]] || line == &[leg[1], leg[0]];
                assert!(found.roadmap.iter().any(is_leg), "{method:?} {seed}: {leg:?}");
            }
        }
    }
}

#[test]
fn a_picture_has_what_is_kept_free_around_a_circle() {
    let circle = Obstacle::circle([50.0, 50.0], 4.0).unwrap();
    let map = Map::new(vec![circle], None).unwrap();
    let found = plan(&map, [0.0, 0.0], [100.0, 100.0], &Options::default()).unwrap();
    let text = ev3_roadmap::svg(&map, &found, 12.0);
    let (kept, obstacle) = (text.find("r=\"16.00\" fill=\"#eee\""), text.find("r=\"4.00\""));
    assert!(kept.is_some() && kept < obstacle, "{text}");
}

#[test]
fn why_there_is_no_way() {
    let ring = Obstacle::polygon(vec![
        [0.0, 0.0],
        [100.0, 0.0],
        [100.0, 100.0],
        [0.0, 100.0],
        [0.0, 5.0],
        [5.0, 5.0],
        [5.0, 95.0],
        [95.0, 95.0],
        [95.0, 5.0],
        [0.5, 5.0],
        [0.5, 4.0],
        [0.0, 4.0],
    ]);
    assert!(ring.is_err(), "an edge lies on another");
    let horseshoe = Obstacle::polygon(vec![
        [0.0, 0.0],
        [40.0, 0.0],
        [40.0, 5.0],
        [5.0, 5.0],
        [5.0, 95.0],
        [95.0, 95.0],
        [95.0, 5.0],
        [55.0, 5.0],
        [55.0, 0.0],
        [100.0, 0.0],
        [100.0, 100.0],
        [0.0, 100.0],
    ])
    .unwrap();
    let map = Map::new(vec![horseshoe], None).unwrap();
    let options = |keep| Options { keep, ..Options::default() };
    let why = |start, goal, keep| plan(&map, start, goal, &options(keep)).err();
    assert_eq!(why([50.0, 50.0], [50.0, -50.0], 7.0), None, "through the gap of 15 cm");
    assert_eq!(why([50.0, 50.0], [50.0, -50.0], 8.0), Some(NoWay::None));
    assert_eq!(why([50.0, 90.0], [50.0, -50.0], 7.0), Some(NoWay::StartBlocked));
    for method in DRAWN {
        let drawn = |keep, samples| {
            let options = Options { keep, samples, method, ..Options::default() };
            plan(&map, [20.0, 50.0], [50.0, -50.0], &options).err()
        };
        assert_eq!(drawn(4.0, 3000), None, "{method:?}");
        assert_eq!(drawn(8.0, 3000), Some(NoWay::None), "{method:?}");
        assert_eq!(drawn(4.0, 0), Some(NoWay::None), "{method:?} without points");
    }
    assert_eq!(why([50.0, 50.0], [2.0, 50.0], 7.0), Some(NoWay::GoalBlocked));
}

#[test]
fn a_goal_close_to_something_round_is_reached_without_a_detour() {
    // Within the polygon that is taken for the circle, which it is outside of
    let things = [
        Thing::Circle([66.1, 55.4], 9.27),
        Thing::Polygon(vec![[3.0, 148.6], [-1.5, 151.2], [-1.5, 146.0]]),
    ];
    let options = Options { keep: KEEP, ..Options::default() };
    let found = plan(&map_of(&things, Some(BOUNDS)), [0.0, 0.0], [73.9, 71.9], &options).unwrap();
    let raw: f64 = found.raw.windows(2).map(|pair| distance(pair[0], pair[1])).sum();
    assert!(raw < 120.0, "{:?}", found.raw);
}
