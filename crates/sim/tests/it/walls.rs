//! The robot at walls: it slides along them, never enters one, and comes off again.
use crate::desk::{B, C, Desk};
use crate::robots::{default_robot, wheels};
use ev3_sim::{Bounds, Hull, Item, Machine, Pose, RobotSpec, Wheels, WorldSpec};
use proptest::prelude::*;

/// A wall along the y axis, 1 cm thick, and the robot left of it.
fn beside_a_wall(heading: f64) -> Desk {
    let world = WorldSpec {
        items: vec![Item::wall([0.0, -500.0], [0.0, 1500.0])],
        start: Pose::new(-9.0, 0.0, heading),
        ..WorldSpec::default()
    };
    Desk::with(&world, &default_robot())
}

fn run(desk: &mut Desk, speeds: [i32; 2]) {
    for (motor, speed) in [B, C].into_iter().zip(speeds) {
        desk.run(motor, &[("speed_sp", speed)], "run-forever");
    }
}

/// How far it went.
fn way(from: Pose, to: Pose) -> f64 {
    (to.x - from.x).hypot(to.y - from.y)
}

#[test]
fn a_robot_that_grazes_a_wall_slides_along() {
    for heading in [2.0, 5.0, 20.0, 45.0] {
        let mut desk = beside_a_wall(heading);
        run(&mut desk, [210, 210]);
        desk.step(2000);
        let before = desk.0.pose();
        desk.step(4000);
        let pose = desk.0.pose();
        assert!(pose.y - before.y > 15.0, "{heading}: from {before:?} to {pose:?}");
        assert!(pose.x <= -8.5 && pose.x > -8.6, "{heading}: {pose:?}");
        assert_eq!(desk.0.trace().collision_count(), 1, "sliding is one collision");
        assert!(!desk.state(B).contains("stalled"), "{heading}");
    }
}

#[test]
fn a_robot_that_runs_straight_into_a_wall_stalls() {
    let mut desk = beside_a_wall(88.0);
    run(&mut desk, [210, 210]);
    desk.step(2000);
    let before = desk.0.pose();
    desk.step(2000);
    assert!(way(before, desk.0.pose()) < 0.1, "{before:?} {:?}", desk.0.pose());
    assert!(desk.state(B).contains("stalled"), "{}", desk.state(B));
}

#[test]
fn a_robot_at_a_wall_can_be_steered_away() {
    for speeds in [[150, 210], [50, 210], [0, 210], [-100, 210]] {
        let mut desk = beside_a_wall(5.0);
        run(&mut desk, [210, 210]);
        desk.step(3000);
        let before = desk.0.pose();
        run(&mut desk, speeds);
        desk.step(1000);
        let turned = desk.0.pose().heading - before.heading;
        assert!(turned < -10.0, "{speeds:?}: {turned}");
    }
}

#[test]
fn it_turns_on_the_spot_while_it_touches() {
    let mut desk = beside_a_wall(30.0);
    run(&mut desk, [210, 210]);
    desk.step(2000);
    let before = desk.0.pose();
    run(&mut desk, [210, -210]);
    desk.step(2000);
    let pose = desk.0.pose();
    assert!((pose.heading - before.heading - 222.0).abs() < 25.0, "{before:?} {pose:?}");
    assert!(way(before, pose) < 1.5, "{before:?} {pose:?}");
}

#[test]
fn slipping_ends_with_the_wall() {
    let world = WorldSpec {
        items: vec![Item::wall([0.0, -50.0], [0.0, 20.0])],
        start: Pose::new(-9.0, 0.0, 20.0),
        ..WorldSpec::default()
    };
    let mut desk = Desk::with(&world, &default_robot());
    run(&mut desk, [400, 400]);
    desk.step(4000);
    let before = desk.0.pose();
    desk.step(1000);
    let pose = desk.0.pose();
    let course = (pose.x - before.x).atan2(pose.y - before.y).to_degrees();
    assert!((course - pose.heading).abs() < 0.1, "rolls straight on: {course} {pose:?}");
}

/// A room with boxes and thin walls, and a robot whose wheels are this many times as large.
#[derive(Clone, Debug)]
struct Room {
    items: Vec<Item>,
    hull: Hull,
    size: f64,
}

fn rooms(largest: f64) -> impl Strategy<Value = Room> {
    let place = || (-65.0..65.0f64, -65.0..65.0f64);
    let boxes = (place(), 0.0..180.0f64, 3.0..30.0f64).prop_map(|((x, y), heading, size)| {
        Item::boxed(Pose::new(x, y, heading), size, size / 2.0)
    });
    let walls = (place(), 0.0..360.0f64, 0.1..100.0f64, 0.001..1.0f64).prop_map(
        |((x, y), heading, length, thickness)| {
            let (sin, cos) = heading.to_radians().sin_cos();
            Item::Wall { from: [x, y], to: [x + sin * length, y + cos * length], thickness }
        },
    );
    let pillars = (place(), 0.5..8.0f64).prop_map(|((x, y), radius)| Item::circle([x, y], radius));
    let hull = prop_oneof![
        Just(Hull::Circle { radius: 8.0 }),
        Just(Hull::Rectangle { width: 13.0, length: 19.0, offset: 2.0 }),
        Just(Hull::Rectangle { width: 10.0, length: 8.0, offset: -3.0 }),
    ];
    let items = prop::collection::vec(prop_oneof![boxes, walls, pillars], 1..7);
    (items, hull, 1.0..largest).prop_map(|(items, hull, size)| Room { items, hull, size })
}

impl Room {
    fn desk(&self) -> Desk {
        let mut robot = RobotSpec { hull: self.hull, ..default_robot() };
        let Wheels { left, right, .. } = wheels(&mut robot);
        left.diameter *= self.size;
        right.diameter *= self.size;
        let bounds = Some(Bounds { low: [-70.0, -70.0], high: [70.0, 70.0] });
        let mut desk = Desk::with(&WorldSpec { bounds, ..WorldSpec::default() }, &robot);
        for item in &self.items {
            // What would stand on the robot is left out.
            let _ = desk.0.add_item(item.clone());
        }
        desk
    }
}

fn drives() -> impl Strategy<Value = Vec<([i32; 2], u64)>> {
    let duty = || prop_oneof![4 => -100..=100i32, 1 => Just(100), 1 => Just(-100), 1 => Just(0)];
    let drive = ((duty(), duty()), 50..1500u64).prop_map(|((left, right), ms)| ([left, right], ms));
    prop::collection::vec(drive, 1..12)
}

fn push(desk: &mut Desk, duties: [i32; 2]) {
    for (motor, duty) in [B, C].into_iter().zip(duties) {
        desk.run(motor, &[("duty_cycle_sp", duty)], "run-direct");
    }
}

/// Whether the robot may roll this way for 2 cm (or turn 20 degrees) without nearing anything.
fn has_room(machine: &Machine, ahead: f64, turn: f64) -> bool {
    let mut hand = machine.clone();
    let Pose { x, y, heading } = machine.pose();
    let (sin, cos) = heading.to_radians().sin_cos();
    let mut place = |share: f64, aside: f64, along: f64| {
        let ahead = ahead * share + along;
        let pose = Pose::new(
            x + sin * ahead + cos * aside,
            y + cos * ahead - sin * aside,
            heading + turn * share,
        );
        hand.place(pose).is_ok()
    };
    let shares = (1..=20).map(|part| f64::from(part) / 20.0);
    shares.into_iter().all(|share| {
        let off = 0.015 * share.min(0.9);
        [(0.0, 0.0), (off, 0.0), (-off, 0.0), (0.0, off), (0.0, -off)]
            .into_iter()
            .all(|(aside, along)| place(share, aside, along))
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn it_is_never_inside_anything_nor_jumps_over_it(room in rooms(12.0), program in drives()) {
        let mut desk = room.desk();
        let mut hand = desk.0.clone();
        for (duties, ms) in program {
            push(&mut desk, duties);
            for _ in 0..ms / 2 {
                let before = desk.0.pose();
                desk.step(2);
                let pose = desk.0.pose();
                if pose == before {
                    break;
                }
                // The way between is free, too: no thin wall is jumped over.
                let parts = if way(before, pose) > 0.1 { 5 } else { 1 };
                for part in 1..=parts {
                    let share = f64::from(part) / f64::from(parts);
                    let on = |from: f64, to: f64| from + (to - from) * share;
                    let between = Pose::new(
                        on(before.x, pose.x),
                        on(before.y, pose.y),
                        on(before.heading, pose.heading),
                    );
                    prop_assert!(hand.place(between).is_ok(), "from {:?} to {:?}", before, pose);
                }
            }
        }
    }

    #[test]
    fn it_never_sticks_where_the_wheels_pull_it_away(room in rooms(1.5), program in drives()) {
        let mut desk = room.desk();
        for (duties, ms) in program {
            push(&mut desk, duties);
            desk.step(ms);
        }
        for (duties, ahead, turn) in
            [([60, 60], 2.0, 0.0), ([-60, -60], -2.0, 0.0), ([60, -60], 0.0, 20.0), ([-60, 60], 0.0, -20.0)]
        {
            let mut desk = Desk(desk.0.clone());
            push(&mut desk, [0, 0]);
            desk.step(300);
            if !has_room(&desk.0, ahead, turn) {
                continue;
            }
            let before = desk.0.pose();
            push(&mut desk, duties);
            desk.step(1000);
            let pose = desk.0.pose();
            let moved = way(before, pose).max((pose.heading - before.heading).abs() / 10.0);
            prop_assert!(moved >= 1.9, "{duties:?}: from {:?} to {:?}", before, pose);
        }
    }
}
