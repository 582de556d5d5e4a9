//! Ground truth: items, collisions, snapshots, trace, picture.

use ev3_sim::{Action, Bounds, Item, ItemId, Machine, Options, Pose, RobotSpec, WorldSpec};

use crate::desk::{B, C, Desk, furnished};

#[test]
fn impossible_worlds_and_robots_are_named() {
    let build = |world: &WorldSpec, robot: &RobotSpec| {
        Machine::new(world, robot, Options::default()).map(|_| ()).unwrap_err().to_string()
    };
    let robot = RobotSpec::default();
    let mut world = furnished();
    world.items.push(Item::Circle { center: [0.0, 0.0], radius: 0.0 });
    assert!(build(&world, &robot).contains("needs a radius"), "{}", build(&world, &robot));
    let world = WorldSpec {
        bounds: Some(Bounds { low: [10.0, 0.0], high: [0.0, 10.0] }),
        ..WorldSpec::default()
    };
    assert!(build(&world, &robot).starts_with("bounds"));
    let mut world = furnished();
    world.start = Pose::new(3.0, 3.0, 0.0);
    assert!(build(&world, &robot).contains("inside bounds"), "{}", build(&world, &robot));

    let world = WorldSpec::default();
    let mut robot = RobotSpec::default();
    robot.sensors[1].port = robot.sensors[0].port;
    assert!(build(&world, &robot).contains("in1"), "{}", build(&world, &robot));
    let mut robot = RobotSpec::default();
    "lego-ev3-radar".clone_into(&mut robot.sensors[2].driver);
    assert!(build(&world, &robot).contains("lego-ev3-radar"));
    let mut robot = RobotSpec::default();
    robot.left.port = robot.right.port;
    assert!(build(&world, &robot).contains("wheel"));
    let robot = RobotSpec { axle: -1.0, ..RobotSpec::default() };
    assert!(build(&world, &robot).contains("axle"));
}

#[test]
fn items_come_and_go_but_not_onto_the_robot() {
    let mut desk = Desk::new();
    let on_top = Item::Box { pose: Pose::new(5.0, 5.0, 0.0), width: 4.0, depth: 4.0 };
    assert!(desk.0.add_item(on_top.clone()).is_err());
    assert!(desk.0.items().is_empty());
    desk.0.place(Pose::new(50.0, 50.0, 0.0)).unwrap();
    let id = desk.0.add_item(on_top).unwrap();
    let error = desk.0.place(Pose::default()).unwrap_err();
    assert!(error.to_string().contains("Box"), "{error}");
    assert!(desk.0.remove_item(id) && !desk.0.remove_item(id));
    desk.0.place(Pose::default()).unwrap();
    let lamp = desk.0.add_item(Item::Lamp { at: [0.0, 0.0], intensity: 5.0 }).unwrap();
    assert!(lamp > id, "numbers are not used again");
}

fn drive_into_a_wall() -> Desk {
    let mut desk = Desk::with(&furnished(), &RobotSpec::default());
    for motor in [B, C] {
        desk.run(motor, &[("speed_sp", 500)], "run-forever");
    }
    desk.step(2000);
    desk.number("lego-sensor/sensor0/value0");
    desk.step(8000);
    desk
}

#[test]
fn collisions_and_events_are_recorded() {
    let mut desk = drive_into_a_wall();
    let trace = desk.0.trace();
    assert!(trace.collision_count() >= 1);
    let first = trace.collisions().next().unwrap();
    assert!(first.item == ItemId(1) && first.pose.y > 80.0, "{first:?}");
    let events = trace.events();
    assert_eq!(events[1].path, "tacho-motor/motor1/command");
    assert_eq!((events[1].action, events[1].text.as_str()), (Action::Written, "run-forever"));
    assert_eq!(events[4].action, Action::Read);
    assert!(trace.path().len() > 20);
    let svg = desk.0.svg();
    for part in [
        "<svg",
        "</svg>",
        "class=\"path\"",
        "class=\"robot\"",
        "id=\"item1\"",
        "class=\"collision\"",
    ] {
        assert!(svg.contains(part), "{part} in {svg}");
    }
    desk.step(1_200_000);
    assert!(desk.0.trace().path().len() <= 2048, "memory stays flat");
}

#[test]
fn a_snapshot_goes_on_exactly_as_the_original() {
    let mut desk = drive_into_a_wall();
    desk.run(B, &[("speed_sp", -300), ("position_sp", -500)], "run-to-rel-pos");
    desk.step(123);
    let snapshot = desk.0.clone();
    let mut run = |machine: Machine| {
        desk.0 = machine;
        desk.step(3000);
        (desk.0.pose(), desk.position(B), desk.number("lego-sensor/sensor0/value0"))
    };
    let first = run(snapshot.clone());
    assert_eq!(first, run(snapshot));
}
