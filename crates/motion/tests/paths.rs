//! Lines, arcs and paths: where they lead, and where along them a point is.
use ev3_motion::{Path, Pose, Segment, distance, rounded, wrapped};
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
fn beside_a_path_one_steers_back_to_it() {
    let path = Path::straight(&[[0.0, 0.0], [0.0, 100.0]]);
    let pose = Pose { x: 1.0, y: 20.0, heading: 0.0 };
    let (gone, turn) = path.steer(pose, 18.0);
    assert!((gone - 20.0).abs() < 0.5, "{gone}");
    assert!(turn < 0.0, "to the left: {turn}");
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
        let end = arc.at(arc.length());
        prop_assert!(distance(end.point(), arc.to()) < 1e-6, "{:?} {:?}", end, arc);
        prop_assert!(wrapped(end.heading - direction - turn).abs() < 1e-6);
        let center = arc.center().unwrap();
        prop_assert!((distance(center, arc.from()) - radius).abs() < 1e-9);
        prop_assert!((distance(center, arc.to()) - radius).abs() < 1e-6);
    }
}
