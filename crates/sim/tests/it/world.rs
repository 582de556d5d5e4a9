//! Ground truth: items, collisions, snapshots, trace, picture.
use crate::desk::{B, C, Desk, furnished};
use crate::robots::{default_robot, wheels, with_axle};
use ev3_sim::facts::{Fact, Form, Kind, Subject, Value, culprit};
use ev3_sim::{
    Action, Bounds, Drawing, Hull, Item, ItemId, Machine, MotorMount, Options, Port, Pose,
    RobotSpec, Traits, WorldSpec,
};

#[test]
fn impossible_worlds_and_robots_are_named() {
    let build = |world: &WorldSpec, robot: &RobotSpec| {
        Machine::new(world, robot, Options::default()).map(|_| ()).unwrap_err().to_string()
    };
    let robot = default_robot();
    let mut world = furnished();
    world.items.push(Item::circle([0.0, 0.0], 0.0));
    assert!(build(&world, &robot).contains("needs a radius"), "{}", build(&world, &robot));
    let world = WorldSpec {
        bounds: Some(Bounds { low: [10.0, 0.0], high: [0.0, 10.0] }),
        ..WorldSpec::default()
    };
    assert!(build(&world, &robot).starts_with("bounds"));
    let mut world = furnished();
    world.start = Pose::new(3.0, 3.0, 0.0);
    assert!(build(&world, &robot).contains("inside the walls"), "{}", build(&world, &robot));
    world.start = Pose::new(0.0, 9000.0, 0.0);
    assert!(build(&world, &robot).contains("outside of the world"), "{}", build(&world, &robot));

    let world = WorldSpec::default();
    let mut robot = default_robot();
    robot.sensors[1].port = robot.sensors[0].port;
    assert!(build(&world, &robot).contains("in1"), "{}", build(&world, &robot));
    let mut robot = default_robot();
    "lego-ev3-radar".clone_into(&mut robot.sensors[2].driver);
    assert!(build(&world, &robot).contains("lego-ev3-radar"));
    let mut robot = default_robot();
    wheels(&mut robot).left.port = wheels(&mut robot).right.port;
    assert!(build(&world, &robot).contains("wheel"));
    assert!(build(&world, &with_axle(-1.0)).contains("axle"));
}

#[test]
fn numbers_are_within_10_km() {
    let build = |world: &WorldSpec, robot: &RobotSpec| {
        Machine::new(world, robot, Options::default()).map(|_| ()).map_err(|e| e.to_string())
    };
    let robot = default_robot();
    for number in [1e20, -1e20, 1.1e6, f64::NAN, f64::INFINITY] {
        let start = Pose::new(0.0, number, 0.0);
        let turned = Pose::new(0.0, 0.0, number);
        let worlds = [
            WorldSpec { start, ..WorldSpec::default() },
            WorldSpec { start: turned, ..WorldSpec::default() },
            WorldSpec {
                items: vec![Item::wall([20.0, 0.0], [20.0, number])],
                ..WorldSpec::default()
            },
            WorldSpec {
                bounds: Some(Bounds { low: [-50.0, -50.0], high: [50.0, number] }),
                ..WorldSpec::default()
            },
        ];
        for world in &worlds {
            assert!(build(world, &robot).is_err(), "{world:?}");
        }
        let robots = [
            with_axle(number),
            RobotSpec { mass: number, ..default_robot() },
            RobotSpec { hull: Hull::Circle { radius: number }, ..default_robot() },
        ];
        for robot in &robots {
            assert!(build(&WorldSpec::default(), robot).is_err(), "{robot:?}");
        }
        assert!(Desk::new().0.place(start).is_err());
    }
    let start = Pose::new(1e6, -1e6, 1e6);
    assert!(build(&WorldSpec { start, ..WorldSpec::default() }, &robot).is_ok());
    assert!(build(&WorldSpec::default(), &with_axle(1e-300)).is_err());
}

#[test]
fn errors_are_put_to_the_fact_that_is_to_blame() {
    let circle = |x: f64| Fact::Item(Item::circle([x, 0.0], 3.0));
    let drawn = Fact::Map(Drawing::read(&["#.", ".#"]).unwrap().drawn(20.0).unwrap());
    let start = |x: f64| Fact::Start(Pose::new(x, 0.0, 0.0));
    let blamed = |facts: &[Fact]| {
        let world = WorldSpec::from_facts(facts);
        let error = Machine::new(&world, &default_robot(), Options::default()).unwrap_err();
        culprit(facts, &error)
    };
    assert_eq!(blamed(&[circle(50.0), drawn.clone(), circle(1.0), start(0.0)]), Some(3));
    assert_eq!(
        blamed(&[circle(50.0), circle(1.0)]),
        Some(1),
        "without a start, what is in the way"
    );
    assert_eq!(
        blamed(&[circle(1.0), start(0.0), drawn.clone()]),
        Some(1),
        "a drawing without a start sets none"
    );
    assert_eq!(blamed(&[start(0.0), Fact::Ambient(1.0), Fact::Ambient(-1.0)]), Some(2));
    let tiny = Fact::Item(Item::circle([0.0, 90.0], 0.0));
    assert_eq!(blamed(&[circle(50.0), drawn, tiny]), Some(2), "items of a drawing count");

    let motor = |port| {
        let driver = "lego-ev3-l-motor".to_owned();
        Fact::Motor(MotorMount { port, driver, noise: None, encoder_noise: None, stops: None })
    };
    let facts = [Fact::Axle(9.0), motor(Port::OutB), motor(Port::OutB)];
    let error = RobotSpec::from_facts(&facts).unwrap_err();
    assert_eq!(culprit(&facts, &error), Some(2));
    let error = RobotSpec::from_facts(&facts[..2]).unwrap_err();
    assert_eq!(error.to_string(), "robot has no left_wheel, no right_wheel, no hull, no mass");
    assert_eq!(culprit(&facts, &error), None);
}

/// An argument of each kind; numbers count up, so that a wall has a length and a box a size.
fn argument(place: u8, kind: Kind) -> Value {
    match kind {
        Kind::Number => Value::Number((place + 1).into()),
        Kind::Channel => Value::Channel(2),
        Kind::Color => Value::Color(ev3_sim::Color::BLACK),
        Kind::Port => Value::Port(Port::OutA),
        Kind::Text => Value::Text("anna".to_owned()),
        Kind::Places => Value::Places(vec![[0.0, 0.0], [9.0, 0.0], [9.0, -9.0]]),
        Kind::Rows => Value::Rows(vec!["#.".to_owned()]),
        Kind::Hull => Value::Hull(Hull::Circle { radius: 1.0 }),
        Kind::Traits => Value::Traits(Traits { mass: Some(0.05), ..Traits::default() }),
        Kind::WheelOptions => Value::WheelOptions { inverted: true, slip: 0.1 },
        Kind::MotorOptions => Value::MotorOptions(Some([-1.0, 1.0])),
        Kind::SensorOptions => Value::SensorOptions { looks_ahead: false },
        Kind::GripperOptions => Value::GripperOptions(ev3_sim::Gripper::default()),
        Kind::EchoOptions => Value::EchoOptions(ev3_sim::Echo::default()),
    }
}

/// The facts of a form, with fewer and with all arguments.
fn facts(form: &'static Form) -> impl Iterator<Item = Fact> {
    (form.least..=form.arguments.len()).map(move |count| {
        let kinds = form.arguments[..count].iter().map(|(_, kind)| *kind);
        let arguments: Vec<_> = (0..).zip(kinds).map(|(at, kind)| argument(at, kind)).collect();
        Fact::of(form.name, &arguments).unwrap().unwrap_or_else(|| panic!("{form:?}"))
    })
}

#[test]
fn each_form_is_read_and_each_thing_is_saved_as_a_fact_of_its_form() {
    for (form, is_thing) in Subject::World.forms().chain(Subject::Robot.forms()) {
        for fact in facts(form) {
            let Fact::Item(item) = fact else {
                assert!(!is_thing, "{form:?}");
                continue;
            };
            item.validate().unwrap();
            let world = WorldSpec {
                items: vec![item.clone()],
                start: Pose::new(500.0, 500.0, 0.0),
                ..WorldSpec::default()
            };
            let machine = Machine::new(&world, &default_robot(), Options::default()).unwrap();
            let saved = machine.world_facts();
            let fact = saved.lines().find(|line| line.starts_with(&format!("{}(", form.name)));
            let place = |(_, value): &(&str, Value)| usize::from(matches!(value, Value::Place(_)));
            let (_, members) = item.members();
            let count = members.len() + members.iter().map(place).sum::<usize>();
            assert!(fact.is_some() && form.takes(count), "{item}: {saved}");
            assert!(machine.svg().contains("id=\"item1\""), "{item}");
        }
    }
}

#[test]
fn items_come_and_go_but_not_onto_the_robot() {
    let mut desk = Desk::new();
    let on_top = Item::boxed(Pose::new(5.0, 5.0, 0.0), 4.0, 4.0);
    assert!(desk.0.add_item(on_top.clone()).is_err());
    assert_eq!(desk.0.items().count(), 0);
    desk.0.place(Pose::new(50.0, 50.0, 0.0)).unwrap();
    let id = desk.0.add_item(on_top).unwrap();
    let error = desk.0.place(Pose::default()).unwrap_err();
    assert_eq!(error.to_string(), "robot at 0, 0 is inside box(5, 5, 4, 4, 0)");
    assert!(desk.0.remove_item(id) && !desk.0.remove_item(id));
    desk.0.place(Pose::default()).unwrap();
    let lamp = desk.0.add_item(Item::Lamp { at: [0.0, 0.0], intensity: 5.0 }).unwrap();
    assert!(lamp > id, "numbers are not used again");
}

fn drive_into_a_wall() -> Desk {
    let mut desk = Desk::with(&furnished(), &default_robot());
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
    assert!(trace.path().count() > 20);
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
    desk.step(240_000);
    assert!(desk.0.trace().path().count() <= 2048, "memory stays flat");
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
