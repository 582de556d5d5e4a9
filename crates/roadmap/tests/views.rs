//! Obstacles that are found by the looks of an ultrasonic sensor.
use ev3_roadmap::{Map, Obstacle, Options, Point, View, Views, plan};
use proptest::prelude::*;

const HULL: f64 = 8.0;

/// How far a ray goes before it meets a circle.
fn cast(from: Point, to: Point, (center, radius): (Point, f64)) -> Option<f64> {
    let offset = [center[0] - from[0], center[1] - from[1]];
    let along = offset[0] * to[0] + offset[1] * to[1];
    let square = offset[0].powi(2) + offset[1].powi(2) - along * along;
    let half = (radius * radius - square).max(0.0).sqrt();
    (square <= radius * radius && along > half).then_some(along - half)
}

/// What a sensor 7 cm ahead of the middle of a robot shows among pillars.
fn look(pillars: &[(Point, f64)], robot: Point, heading: f64) -> View {
    let direction = |degrees: f64| [degrees.to_radians().sin(), degrees.to_radians().cos()];
    let ahead = direction(heading);
    let at = [robot[0] + 7.0 * ahead[0], robot[1] + 7.0 * ahead[1]];
    let ray = |index: i32| direction(heading + f64::from(index) / 10.0);
    let ranges = (-150..=150)
        .flat_map(|index| pillars.iter().filter_map(move |pillar| cast(at, ray(index), *pillar)));
    View { at, heading, range: ranges.fold(255.0, f64::min).max(3.0) }
}

fn look_around(views: &mut Views, pillars: &[(Point, f64)], robot: Point) {
    views.stand(robot);
    (0..120).for_each(|index| views.add(look(pillars, robot, f64::from(index) * 3.0)));
}

fn gap(at: Point, (center, radius): (Point, f64)) -> f64 {
    (at[0] - center[0]).hypot(at[1] - center[1]) - radius
}

fn pillar() -> impl Strategy<Value = (Point, f64)> {
    (10.0..90.0_f64, 0.0..360.0_f64, 0.5..10.0_f64).prop_map(|(far, bearing, radius)| {
        let (sin, cos) = bearing.to_radians().sin_cos();
        ([(far + radius) * sin, (far + radius) * cos], radius)
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 30, failure_persistence: None, ..Default::default() })]

    #[test]
    fn what_is_free_is_free(pillars in prop::collection::vec(pillar(), 0..6)) {
        let mut views = Views::new(HULL);
        look_around(&mut views, &pillars, [0.0, 0.0]);
        for x in -50..50 {
            for y in -50..50 {
                let at = [f64::from(2 * x), f64::from(2 * y)];
                if views.is_free(at) {
                    prop_assert!(pillars.iter().all(|pillar| gap(at, *pillar) > 0.0), "{at:?}");
                }
            }
        }
    }

    #[test]
    fn a_safe_way_meets_nothing(
        pillars in prop::collection::vec(pillar(), 0..6),
        (x, y) in (-80.0..80.0_f64, -80.0..80.0_f64),
    ) {
        let mut views = Views::new(HULL);
        look_around(&mut views, &pillars, [0.0, 0.0]);
        let nothing = Map::new(Vec::new(), None).unwrap();
        let path = plan(&nothing, [0.0, 0.0], [x, y], &Options::default()).unwrap().path;
        let safe = views.safe(&path, 0.5);
        prop_assert!(safe.way <= path.length() + 1e-9);
        prop_assert_eq!(safe.unseen.is_none(), safe.way >= path.length() - 1e-9);
        let gone = path.until(safe.way);
        for leg in gone.segments() {
            for step in 0..200 {
                let at = leg.at(leg.length() * f64::from(step) / 199.0).point();
                prop_assert!(pillars.iter().all(|pillar| gap(at, *pillar) > HULL), "{at:?}");
            }
        }
    }

    #[test]
    fn a_pillar_becomes_a_polygon_where_it_stands(pillar in pillar()) {
        let mut views = Views::new(HULL);
        look_around(&mut views, &[pillar], [0.0, 0.0]);
        let nothing = Map::new(Vec::new(), None).unwrap();
        let found = views.obstacles(&nothing);
        prop_assert!(!found.is_empty());
        for corner in found.iter().flat_map(|polygon| polygon.corners().unwrap()) {
            // The farther, the vaguer.
            let far = corner[0].hypot(corner[1]);
            prop_assert!(gap(*corner, pillar) < 6.0 + 0.15 * far, "{corner:?}");
        }
        // An obstacle of the map is not reported again.
        let known = Map::new(vec![Obstacle::circle(pillar.0, pillar.1).unwrap()], None).unwrap();
        prop_assert!(views.obstacles(&known).is_empty());
    }
}

#[test]
fn nothing_is_free_before_it_was_looked_at() {
    let mut views = Views::new(HULL);
    views.stand([0.0, 0.0]);
    assert!(views.is_free([0.0, 7.0]) && !views.is_free([0.0, 9.0]));
    views.add(View { at: [0.0, 7.0], heading: 0.0, range: 50.0 });
    assert!(views.is_free([0.0, 50.0]) && !views.is_free([0.0, 57.0]));
    assert!(views.is_free([9.0, 53.0]) && !views.is_free([15.0, 50.0]));
    views.forget();
    assert!(!views.is_free([0.0, 50.0]));
}

#[test]
fn a_sensor_that_shows_its_least_shows_nothing_free() {
    let mut views = Views::new(HULL);
    views.stand([0.0, 0.0]);
    views.add(View { at: [0.0, 7.0], heading: 0.0, range: 3.0 });
    assert!(!views.is_free([0.0, 8.5]));
}

#[test]
fn what_cannot_be_seen_can_be_taken_for_an_obstacle() {
    let nothing = Map::new(Vec::new(), None).unwrap();
    let mut views = Views::new(HULL);
    views.block([33.0, 44.0]);
    let map = Map::new(views.obstacles(&nothing), None).unwrap();
    assert!(map.clearance([33.0, 44.0]) <= 0.0);
    assert!(map.clearance([36.0, 44.0]) > 2.0);
}

#[test]
fn what_walks_into_free_space_is_noticed() {
    let mount = |range| View { at: [0.0, 7.0], heading: 0.0, range };
    let mut views = Views::new(HULL);
    for heading in -40..=40 {
        assert!(!views.look([0.0, 0.0], f64::from(heading), mount(60.0)));
    }
    // Nearer as the robot goes on, and not exactly
    assert!(!views.look([0.0, 20.0], 0.0, mount(39.0)));
    assert!(views.is_free([0.0, 57.0]));
    assert!(views.look([0.0, 20.0], 0.0, mount(20.0)));
    assert!(!views.is_free([0.0, 57.0]));
    // Not where nobody has looked
    assert!(!views.look([0.0, 20.0], 180.0, mount(20.0)));
}
