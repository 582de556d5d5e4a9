//! Lines, arcs and paths: where they lead, and where along them a point is.
use ev3_motion::{Path, Pose, Segment, distance, rounded, sinc, wrapped};
use proptest::prelude::*;

#[test]
fn corners_are_rounded_without_a_kink() {
    let pieces = rounded(&[[0.0, 0.0], [0.0, 50.0], [50.0, 50.0]], 10.0);
    let [piece] = &*pieces else { panic!("{pieces:?}") };
    assert_eq!(piece.len(), 3);
    for pair in piece.windows(2) {
        let (end, start) = (pair[0].end(), pair[1].start());
        assert!((end.x - start.x).hypot(end.y - start.y) < 1e-9);
        assert!((end.heading - start.heading).abs() < 1e-9);
    }
    let length: f64 = piece.iter().map(Segment::length).sum();
    assert!((length - (80.0 + 5.0 * std::f64::consts::PI)).abs() < 1e-9);
}

#[test]
fn corners_that_are_too_sharp_remain() {
    let pieces = rounded(&[[0.0, 0.0], [0.0, 50.0], [1.0, 0.0]], 10.0);
    assert_eq!(pieces.len(), 2);
}

#[test]
fn points_at_the_same_place_are_one() {
    assert_eq!(rounded(&[[1.0, 1.0], [1.0, 1.0]], 5.0), Vec::<Vec<Segment>>::new());
    assert_eq!(rounded(&[], 5.0), Vec::<Vec<Segment>>::new());
}

#[test]
fn a_line_ends_exactly_where_it_was_to_and_has_no_radius() {
    let (from, to) = ([0.1, 0.2], [33.3, -70.7]);
    let line = Segment::line(from, to);
    assert_eq!((line.from(), line.to()), (from, to));
    assert_eq!((line.radius(), line.center(), line.turn().abs()), (None, None, 0.0));
    assert!(distance(line.at(line.length()).point(), to) < 1e-12);
}

#[test]
fn a_path_is_cut_where_it_is_to_end() {
    let path = Path::new(rounded(&[[0.0, 0.0], [0.0, 50.0], [50.0, 50.0]], 10.0).concat());
    for way in [5.0, 45.0, path.length() - 1.0] {
        let until = path.until(way);
        assert!((until.length() - way).abs() < 1e-9, "{way}");
        let last = until.points().pop().unwrap();
        let there = path.samples(0.01).find(|(along, _)| *along >= way - 0.005).unwrap().1;
        assert!(distance(last, there.point()) < 0.02, "{way}");
    }
    assert_eq!(path.until(1000.0), path);
    assert!(Path::default().points().is_empty());
}

#[test]
fn beside_a_path_one_steers_to_the_point_four_cm_ahead_on_it() {
    let path = Path::straight(&[[0.0, 0.0], [0.0, 100.0]]);
    for (x, y, turn) in [(0.0, 20.0, 0.0), (1.0, 20.0, -2.0 / 17.0), (-2.0, 98.0, 4.0 / 20.0)] {
        let (gone, steered) = path.steer(Pose { x, y, heading: 0.0 }, y - 2.0);
        assert!(near(gone, y), "{gone}");
        assert!(near(steered, f64::to_degrees(turn)), "{steered}");
    }
}

/// Where a way comes by twice, one is where one was last, though the other is nearer.
#[test]
fn on_the_way_back_one_is_not_on_the_way_there() {
    let path = Path::straight(&[[0.0, 0.0], [0.0, 50.0], [1.0, 50.0], [1.0, 0.0]]);
    assert!(near(path.steer(Pose { x: 0.8, y: 20.0, heading: 0.0 }, 16.0).0, 20.0));
    assert!(near(path.steer(Pose { x: 0.2, y: 20.0, heading: 180.0 }, 77.0).0, 81.0));
}

#[test]
fn the_samples_of_a_path_are_evenly_on_it_from_end_to_end() {
    let path = Path::straight(&[[0.0, 0.0], [0.0, 5.0], [7.0, 5.0]]);
    let samples: Vec<_> = path.samples(2.0).map(|(way, pose)| (way, pose.point())).collect();
    let (thirds, quarters) = ([0.0, 1.0, 2.0, 3.0], [0.0, 1.0, 2.0, 3.0, 4.0]);
    let first = thirds.map(|third| 5.0 * third / 3.0);
    let second = quarters.map(|quarter| 5.0 + 7.0 * quarter / 4.0);
    let ways = [&first[..], &second].concat();
    assert_eq!(samples.len(), ways.len());
    for ((way, point), expected) in samples.into_iter().zip(ways) {
        assert!(near(way, expected), "{way}");
        let there = [(way - 5.0).max(0.0), way.min(5.0)];
        assert!(distance(point, there) < 1e-9, "{point:?}");
    }
}

#[test]
fn the_heading_of_a_path_is_that_to_the_point_four_cm_ahead() {
    assert!(near(Path::straight(&[[1.0, 0.0], [1.0, -9.0]]).heading().abs(), 180.0));
    assert!(near(Path::straight(&[[0.0, 0.0], [0.0, 2.0], [9.0, 2.0]]).heading(), 45.0));
    assert!(near(Path::straight(&[[0.0, 0.0], [1.0, 0.0]]).heading(), 90.0));
}

#[test]
fn a_corner_between_short_legs_is_rounded_less() {
    // A leg at an end may be used up, one between two corners by half.
    let radius = |points: &[_]| rounded(points, 50.0)[0].iter().find_map(Segment::radius).unwrap();
    assert!(near(radius(&[[0.0, 0.0], [0.0, 20.0], [90.0, 20.0]]), 20.0));
    assert!(near(radius(&[[0.0, 0.0], [0.0, 90.0], [20.0, 90.0]]), 20.0));
    assert!(near(radius(&[[0.0, 0.0], [0.0, 90.0], [20.0, 90.0], [20.0, 180.0]]), 10.0));
    let after = Pose { x: 0.0, y: 20.0, heading: 60.0 }.ahead(90.0).point();
    assert!(near(radius(&[[0.0, 0.0], [0.0, 20.0], after]), 20.0 * f64::sqrt(3.0)));
    let first = rounded(&[[0.0, 0.0], [0.0, 20.0], [90.0, 20.0]], 50.0)[0][0];
    assert!(near(first.turn(), 90.0), "nothing is left of the leg: {first:?}");
}

#[test]
fn a_corner_with_hardly_any_room_remains() {
    assert_eq!(rounded(&[[0.0, 0.0], [0.0, 4.0], [90.0, 4.0]], 50.0).len(), 2);
    assert_eq!(rounded(&[[0.0, 0.0], [0.0, 6.0], [90.0, 6.0]], 50.0).len(), 1);
}

#[test]
fn angles_are_wrapped_to_half_a_turn() {
    for (angle, expected) in [
        (0.0, 0.0),
        (179.0, 179.0),
        (180.0, 180.0),
        (181.0, -179.0),
        (-180.0, 180.0),
        (-179.0, -179.0),
        (-181.0, 179.0),
        (540.0, 180.0),
        (-900.0, 180.0),
        (725.0, 5.0),
    ] {
        assert!(near(wrapped(angle), expected), "{angle}");
    }
}

#[test]
fn the_chord_of_an_arc_is_right_in_all_digits() {
    assert!((sinc(0.0) - 1.0).abs() < 1e-16);
    for x in [1e-5, -0.05, 0.004, 0.006, 0.05, 0.099, 0.101, 1.0, 3.0] {
        assert!((sinc(x) - f64::sin(x) / x).abs() < 3e-16, "{x}");
    }
}

#[test]
fn an_arc_of_a_quarter_ends_beside_its_center() {
    let start = Pose { x: 1.0, y: 2.0, heading: 90.0 };
    let quarter = std::f64::consts::FRAC_PI_2 * 10.0;
    let right = start.along_arc(quarter, 90.0);
    assert!(
        distance(right.point(), [11.0, -8.0]) < 1e-9 && near(right.heading, 180.0),
        "{right:?}"
    );
    let left = start.along_arc(quarter, -90.0);
    assert!(distance(left.point(), [11.0, 12.0]) < 1e-9 && near(left.heading, 0.0), "{left:?}");
}

#[test]
fn the_heading_along_an_arc_turns_evenly() {
    let arc = Segment::arc(Pose { heading: 30.0, ..Pose::default() }, 10.0, 0.1);
    for (along, expected) in
        [(0.0, 30.0), (5.0, 30.0 + f64::to_degrees(0.5)), (10.0, arc.end().heading)]
    {
        assert!(near(arc.heading_at(along), expected) && near(arc.at(along).heading, expected));
    }
    assert!(distance(arc.to(), arc.at(10.0).point()) < 1e-9);
    assert!(near(Segment::line([0.0, 0.0], [5.0, 0.0]).heading_at(3.0), 90.0));
}

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..Default::default() })]

    /// A point of a segment is found where it is.
    #[test]
    fn points_are_located(
        heading in -400.0_f64..400.0,
        curvature in -0.2_f64..0.2,
        length in 1.0_f64..60.0,
        share in 0.0_f64..1.0,
        aside in -3.0_f64..3.0,
    ) {
        let start = Pose { x: 3.0, y: -4.0, heading };
        let segment = Segment::arc(start, length, curvature);
        let along = length * share;
        let at = segment.at(along);
        let right = Pose { heading: at.heading + 90.0, ..at }.ahead(aside);
        let place = segment.locate([right.x, right.y], along);
        prop_assert!((place.along - along).abs() < 1e-3, "{:?}", place);
        prop_assert!((place.aside - aside).abs() < 1e-3, "{:?}", place);
    }

    /// The arc at a corner touches both lines.
    #[test]
    fn corners_are_touched(
        (x, y) in (-50.0_f64..50.0, -50.0_f64..50.0),
        direction in -180.0_f64..180.0,
        turn in prop_oneof![-170.0_f64..-1.0, 1.0_f64..170.0],
        radius in 0.5_f64..30.0,
    ) {
        let corner = Pose { x, y, heading: direction };
        let before = corner.ahead(-500.0).point();
        let after = Pose { heading: direction + turn, ..corner }.ahead(500.0).point();
        let arc = Segment::rounding([before, corner.point(), after], radius);
        prop_assert!((arc.radius().unwrap().abs() - radius).abs() < 1e-9);
        prop_assert!((arc.turn() - turn).abs() < 1e-6);
        let cut = radius * (turn.to_radians().abs() / 2.0).tan();
        prop_assert!(distance(arc.from(), corner.ahead(-cut).point()) < 1e-6);
        let end = arc.at(arc.length());
        prop_assert!(distance(end.point(), arc.to()) < 1e-6, "{:?} {:?}", end, arc);
        prop_assert!(wrapped(end.heading - direction - turn).abs() < 1e-6);
        let center = arc.center().unwrap();
        prop_assert!((distance(center, arc.from()) - radius).abs() < 1e-9);
        prop_assert!((distance(center, arc.to()) - radius).abs() < 1e-6);
    }
}
