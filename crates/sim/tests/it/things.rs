//! Things that robots push: friction on the floor, pushes, heaps, balls.
use crate::desk::{A, B, C, Desk};
use crate::robots::{default_robot, touch_robot};
use ev3_sim::facts::Subject;
use ev3_sim::{
    Bounds, Gripper, Item, ItemId, Machine, Options, Port, Pose, RobotSpec, Sample, Thing, Traits,
    WorldSpec,
};
use std::fmt::Write;

const GRAVITY: f64 = 980.665;
const STEP: f64 = 0.002;

fn mass(mass: f64) -> Traits {
    Traits { mass: Some(mass), ..Traits::default() }
}

fn square([x, y]: [f64; 2], side: f64, traits: Traits) -> Item {
    Item::Box { pose: Pose::new(x, y, 0.0), width: side, depth: side, traits }
}

fn ball(center: [f64; 2], traits: Traits) -> Item {
    Item::Circle { center, radius: 2.0, traits: Traits { rolls: true, ..traits } }
}

/// The default robot at 0, 0, with these things in a wide world.
fn desk(items: Vec<Item>) -> Desk {
    Desk::with(&WorldSpec { items, ..WorldSpec::default() }, &default_robot())
}

impl Desk {
    fn thing(&self) -> &Thing {
        &self.0.things()[0]
    }

    fn drive(&mut self, left: i32, right: i32) {
        self.run(B, &[("speed_sp", left)], "run-forever");
        self.run(C, &[("speed_sp", right)], "run-forever");
    }

    fn hold(&mut self) {
        for motor in [B, C] {
            self.put(&format!("{motor}stop_action"), "hold");
            self.put(&format!("{motor}command"), "stop");
        }
    }

    /// Throws the first thing, and steps until it rests; the way that it went.
    fn throw(&mut self, speeds: [f64; 3]) -> [f64; 3] {
        let (id, before) = (self.thing().id(), self.thing().pose());
        assert!(self.0.throw(id, speeds));
        for _ in 0..20_000 {
            if !self.0.is_moving() {
                break;
            }
            self.step(2);
        }
        assert!(!self.thing().is_moving());
        let after = self.thing().pose();
        [after.x - before.x, after.y - before.y, after.heading - before.heading]
    }
}

fn halts(machine: &Machine) -> u32 {
    machine.things().iter().map(Thing::halts).sum()
}

#[test]
fn a_robot_pushes_what_is_lighter_than_its_grip() {
    for kg in [0.05, 0.3, 1.0] {
        let mut desk = desk(vec![square([0.0, 20.0], 6.0, mass(kg))]);
        desk.drive(400, 400);
        desk.step(2000);
        let (robot, thing) = (desk.0.pose(), desk.thing().pose());
        desk.step(1000);
        let (robot_way, thing_way) = (desk.0.pose().y - robot.y, desk.thing().pose().y - thing.y);
        assert!((robot_way - thing_way).abs() < 0.001, "{kg}: {robot_way} {thing_way}");
        assert!(robot_way > 10.0, "{kg}: {robot_way}");
        assert!(desk.thing().pose().heading.abs() < 0.01, "{kg}");
        assert!(desk.0.pose().heading.abs() < 0.01, "{kg}");
        let gap = desk.0.gaps().into_iter().fold(f64::INFINITY, f64::min);
        assert!((0.019..0.021).contains(&gap), "{kg}: {gap}");
        desk.hold();
        let before = desk.thing().pose().y;
        desk.step(1000);
        let slid = desk.thing().pose().y - before;
        assert!((0.4..0.7).contains(&slid), "{kg}: {slid}");
        assert!(!desk.thing().is_moving());
        assert_eq!(desk.0.trace().collision_count(), 1, "one push");
        assert_eq!(halts(&desk.0), 0);
    }
}

#[test]
fn a_robot_does_not_push_what_is_too_heavy() {
    let mut desk = desk(vec![square([0.0, 20.0], 6.0, mass(1.2))]);
    desk.drive(400, 400);
    desk.step(2000);
    let (at, turned) = (desk.0.pose(), desk.position(B));
    let rests = desk.thing().pose();
    assert!(rests.y < 22.0, "the robot's speed took it a part of the way: {rests:?}");
    assert!(!desk.thing().is_moving());
    desk.step(1000);
    assert_eq!(desk.thing().pose(), rests);
    assert!((desk.0.pose().y - at.y).abs() < 0.001);
    assert!(desk.position(B) - turned > 300, "the wheels spin");
}

#[test]
fn the_floor_stops_what_slides() {
    let fast = 40.0;
    let mut far = desk(vec![square([50.0, 50.0], 6.0, mass(0.1))]);
    // An implicit step loses half of what it moves.
    let way = fast * fast / (2.0 * 0.4 * GRAVITY) - fast * STEP / 2.0;
    assert!((way - 1.9994).abs() < 1e-4);
    let [east, north, turned] = far.throw([fast, 0.0, 0.0]);
    assert!((east - way).abs() < 0.005 && north == 0.0 && turned == 0.0, "{east} {north} {turned}");
    let [_, _, turned] = far.throw([0.0, 0.0, 10.0_f64.to_degrees()]);
    assert!((turned - 18.52).abs() < 0.1, "{turned}");
    let alone = far.throw([fast, 0.0, 0.0])[0];
    let [east, _, turned] = far.throw([fast, 0.0, 10.0_f64.to_degrees()]);
    assert!(east > 1.05 * alone && turned > 1.05 * 18.52, "both: {east} {turned}");
}

#[test]
fn what_turns_keeps_its_way() {
    let mut far = desk(vec![square([50.0, 50.0], 6.0, mass(0.1))]);
    let [east, north, turned] = far.throw([60.0, 0.0, 2000.0]);
    assert!(turned > 90.0, "{turned}");
    assert!(north.abs() < 0.001 && east > 4.0, "{east} {north}");
}

#[test]
fn a_ball_rolls_far_and_comes_back_from_a_wall() {
    let (fast, slows) = (40.0, 0.02 * GRAVITY / 1.4);
    let way = fast * fast / (2.0 * slows) - fast * STEP / 2.0;
    let mut far = desk(vec![ball([50.0, 50.0], mass(0.03))]);
    let [east, ..] = far.throw([fast, 0.0, 0.0]);
    assert!((east - way).abs() < 0.05, "{east} {way}");
    for (bounces, share) in [(Some(0.0), 0.0), (None, 0.5), (Some(0.9), 0.9)] {
        let traits = Traits { bounces, ..mass(0.03) };
        let wall = Item::wall([60.0, 0.0], [60.0, 100.0]);
        let mut desk = desk(vec![ball([50.0, 50.0], traits), wall]);
        let free = 60.0 - 0.5 - 2.0 - 50.0;
        let hits = (fast * fast - 2.0 * slows * free).sqrt();
        let back = (share * hits).powi(2) / (2.0 * slows);
        let [east, north, _] = desk.throw([fast, 0.0, 0.0]);
        assert!((free - east - back).abs() < 0.25, "{bounces:?}: {} {back}", free - east);
        assert!(north.abs() < 1e-6);
    }
}

#[test]
fn boxes_that_are_pushed_against_a_wall_do_not_creep() {
    let mut items: Vec<_> =
        (0..3).map(|i| square([0.0, 25.0 + 6.5 * f64::from(i)], 6.0, mass(0.02))).collect();
    items.push(Item::wall([-50.0, 50.0], [50.0, 50.0]));
    let mut desk = desk(items);
    desk.drive(300, 300);
    desk.step(4000);
    let places: Vec<_> = desk.0.things().iter().map(Thing::pose).collect();
    desk.step(3000);
    for (thing, before) in desk.0.things().iter().zip(places) {
        let after = thing.pose();
        let crept = (after.x - before.x).hypot(after.y - before.y);
        assert!(crept < 0.001 && (after.heading - before.heading).abs() < 0.01, "{crept}");
    }
    assert!(desk.0.gaps().into_iter().all(|gap| gap > 0.0), "{:?}", desk.0.gaps());
    assert_eq!(halts(&desk.0), 0);
}

#[test]
fn thrown_things_never_gain_energy() {
    let bounds = Some(Bounds { low: [-40.0, -40.0], high: [60.0, 60.0] });
    let mut items = Vec::new();
    for (x, y) in [(20.0, 20.0), (28.0, 20.0), (20.0, 28.0), (30.0, 30.0), (40.0, 25.0)] {
        items.push(square([x, y], 6.0, mass(0.1)));
        items.push(ball([x - 40.0, y + 12.0], mass(0.05)));
    }
    let world =
        WorldSpec { items, bounds, start: Pose::new(-20.0, -20.0, 0.0), ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &default_robot());
    let ids: Vec<_> = desk.0.things().iter().map(Thing::id).collect();
    for (index, id) in (0..).zip(ids) {
        let turn = f64::from(index) * 1.3;
        desk.0.throw(id, [90.0 * turn.cos(), 90.0 * turn.sin(), 300.0 * turn]);
    }
    let mut energy = desk.0.kinetic_energy();
    for _ in 0..5000 {
        desk.step(2);
        let now = desk.0.kinetic_energy();
        assert!(now <= energy + 1e-9, "{now} {energy}");
        energy = now;
    }
    assert!(desk.0.gaps().into_iter().all(|gap| gap > 0.0));
    assert_eq!(halts(&desk.0), 0);
}

/// The robot drives about among 12 things; each byte of where all are.
fn crowded() -> Desk {
    let place = |i: u32| [f64::from(i % 4) * 14.0 - 20.0, 20.0 + f64::from(i / 4) * 13.0];
    let thing = |i: u32| {
        let traits = mass(0.03 + 0.02 * f64::from(i));
        if i % 3 == 0 { ball(place(i), traits) } else { square(place(i), 5.0, traits) }
    };
    let bounds = Some(Bounds { low: [-60.0, -30.0], high: [60.0, 90.0] });
    let world = WorldSpec { items: (0..12).map(thing).collect(), bounds, ..WorldSpec::default() };
    let robot = default_robot().with_typical_noise();
    let options = Options { seed: 42, ..Options::default() };
    Desk(Machine::new(&world, &robot, options).unwrap())
}

fn go_about(desk: &mut Desk, steps: std::ops::Range<u32>) -> String {
    let mut bytes = String::new();
    for step in steps {
        let (left, right) = [(500, 480), (450, 500), (-300, -400)][step as usize / 20 % 3];
        desk.drive(left, right);
        desk.step(50);
        let poses = desk.0.things().iter().map(Thing::pose).chain([desk.0.pose()]);
        for Pose { x, y, heading } in poses {
            writeln!(bytes, "{:?}", [x, y, heading].map(f64::to_bits)).unwrap();
        }
    }
    bytes
}

#[test]
fn a_golden_run_among_things() {
    let mut desk = crowded();
    let first = go_about(&mut desk, 0..18);
    let pushed = desk.0.things().iter().filter(|thing| thing.is_moving()).count();
    assert!(pushed > 0, "it pushes");
    let snapshot = desk.0.clone();
    let rest = go_about(&mut desk, 18..200);
    let bytes = go_about(&mut crowded(), 0..200);
    assert!(bytes == first + &rest, "twice the same");
    desk.0.restore(snapshot);
    assert!(go_about(&mut desk, 18..200) == rest, "the same after a snapshot in a push");
    assert_eq!(halts(&desk.0), 0);
    assert_eq!(format!("{:016x}", crate::golden::digest(bytes.as_bytes())), "8cd18d5021910a89");
}

#[test]
fn sensors_see_things_where_they_are() {
    let mut desk = desk(vec![square([0.0, 40.0], 6.0, mass(0.1))]);
    let sonar = |desk: &mut Desk| {
        desk.step(200);
        desk.number("lego-sensor/sensor0/value0")
    };
    let before = sonar(&mut desk);
    let id = desk.thing().id();
    assert!(desk.0.move_item(id, [0.0, 50.0], None).unwrap());
    let after = sonar(&mut desk);
    assert!((after - before - 100).abs() <= 1, "{before} {after}");
    desk.throw([0.0, 100.0, 0.0]);
    let moved = desk.thing().pose().y - 50.0;
    let now = sonar(&mut desk);
    assert!(moved > 10.0 && (f64::from(now - after) - 10.0 * moved).abs() <= 1.0, "{now} {moved}");
    let low = Traits { height: Some(3.0), ..mass(0.1) };
    desk.0.add_item(square([0.0, 30.0], 6.0, low)).unwrap();
    assert_eq!(sonar(&mut desk), now, "it looks over what is low");
}

#[test]
fn a_ball_presses_a_bumper() {
    let world = WorldSpec { items: vec![ball([0.0, 40.0], mass(0.5))], ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &touch_robot());
    let id = desk.thing().id();
    desk.0.throw(id, [0.0, -60.0, 0.0]);
    let pressed = |desk: &mut Desk| desk.number("lego-sensor/sensor3/value0");
    assert_eq!(pressed(&mut desk), 0);
    let mut seen = 0;
    for _ in 0..100 {
        desk.step(10);
        seen += pressed(&mut desk);
    }
    assert!(seen > 0);
}

#[test]
fn things_stand_in_nothing() {
    let world =
        |items| WorldSpec { items, start: Pose::new(-50.0, 0.0, 0.0), ..WorldSpec::default() };
    let error = |items| {
        Machine::new(&world(items), &default_robot(), Options::default()).unwrap_err().to_string()
    };
    let thing = |x: f64| square([x, 0.0], 6.0, mass(0.1));
    assert!(
        error(vec![thing(0.0), thing(5.0)]).contains("is where box(0, 0, 6, 6, 0, [mass(0.1)])")
    );
    assert!(
        error(vec![Item::circle([0.0, 0.0], 4.0), thing(5.0)])
            .contains("is inside circle(0, 0, 4)")
    );
    assert!(error(vec![thing(-50.0)]).contains("robot"));
    let bounded = WorldSpec {
        bounds: Some(Bounds { low: [-90.0, -90.0], high: [90.0, 90.0] }),
        ..world(vec![thing(100.0)])
    };
    assert!(
        Machine::new(&bounded, &default_robot(), Options::default())
            .unwrap_err()
            .to_string()
            .contains("is outside of the world")
    );
    let many = (0..65).map(|i| thing(f64::from(i) * 10.0)).collect();
    assert!(error(many).contains("at most 64"));
    let mut desk = desk(vec![thing(30.0), Item::circle([60.0, 0.0], 4.0)]);
    let id = desk.thing().id();
    for to in [[0.0, 0.0], [62.0, 0.0]] {
        assert!(desk.0.move_item(id, to, None).is_err());
    }
    assert!(desk.0.add_item(Item::circle([31.0, 0.0], 4.0)).is_err());
    assert_eq!(desk.thing().pose(), Pose::new(30.0, 0.0, 0.0));
    assert!(desk.0.place(Pose::new(30.0, 0.0, 0.0)).is_err());
    assert!(desk.0.remove_item(id) && desk.0.things().is_empty());
    assert!(desk.0.place(Pose::new(30.0, 0.0, 0.0)).is_ok());
    assert!(!desk.0.throw(ItemId(2), [1.0, 0.0, 0.0]), "what does not move is not thrown");
}

#[test]
fn impossible_things_are_refused() {
    let fault = |item: Item| item.validate().unwrap_err().reason;
    let no_mass = Traits { friction: Some(0.1), ..Traits::default() };
    for (traits, words) in [
        (mass(0.001), "needs a mass from 0.005 to 100 kg"),
        (mass(f64::NAN), "needs a mass"),
        (Traits { friction: Some(2.1), ..mass(1.0) }, "needs a friction from 0 to 2"),
        (Traits { bounces: Some(1.0), ..mass(1.0) }, "needs bounces(Share)"),
        (Traits { height: Some(0.0), ..mass(1.0) }, "needs a height"),
        (Traits { rolls: true, ..mass(1.0) }, "rolls(true) is for circles"),
        (no_mass, "needs mass(Kg), too"),
    ] {
        let reason = fault(square([0.0, 0.0], 6.0, traits));
        assert!(reason.contains(words), "{reason}");
    }
    assert!(fault(square([0.0, 0.0], 0.9, mass(1.0))).contains("too small"));
    assert!(Subject::World.form("box", 6).is_some() && Subject::World.form("box", 3).is_none());
}

#[test]
fn a_saved_world_has_things_where_they_are() {
    let traits = Traits { name: Some("the cargo".to_owned()), ..mass(0.1) };
    let mut desk = desk(vec![square([50.0, 50.0], 6.0, traits)]);
    desk.throw([40.0, 0.0, 0.0]);
    let Pose { x, .. } = desk.thing().pose();
    let fact = format!("box({x}, 50, 6, 6, 0, [mass(0.1), name('the cargo')])");
    assert!(desk.0.world_facts().contains(&fact), "{}", desk.0.world_facts());
    let at = format!("translate({x:.2},50.00)");
    let svg = desk.0.svg();
    let drawn = svg.lines().find(|line| line.contains("class=\"thing\""));
    assert!(drawn.is_some_and(|line| line.contains(&at)), "{at} in {svg}");
}

#[test]
fn a_picture_has_things_that_a_script_can_move() {
    let traits = Traits { rolls: true, ..mass(0.1) };
    let moved = ball([50.0, 60.0], traits);
    let pillar = Item::Circle { center: [90.0, 60.0], radius: 3.0, traits: Traits::default() };
    let svg = desk(vec![moved, pillar]).0.svg();
    let line = |id| svg.lines().find(|line| line.contains(id)).unwrap_or_default();
    assert_eq!(
        line("item1"),
        "<circle id=\"item1\" class=\"thing\" stroke=\"#111\" stroke-width=\"0.7\" cx=\"0.00\" cy=\"0.00\" r=\"2.00\" fill=\"#987\" \
         transform=\"translate(50.00,60.00) rotate(-0.00)\"/>"
    );
    assert_eq!(
        line("item2"),
        "<circle id=\"item2\" cx=\"90.00\" cy=\"60.00\" r=\"3.00\" fill=\"#987\"/>"
    );
    assert!(svg.find("item1") > svg.find("item2"), "a thing may lie on what the floor has");
    assert!(!svg.contains("jaw"));
    let held = carrying(Gripper::default());
    let jaws = held.0.svg().matches("class=\"jaw\"").count();
    assert_eq!(jaws, 2);
}

const JAWS: [f64; 2] = [0.0, 12.0];

/// The default robot with a gripper at outA.
fn with_gripper(gripper: Gripper) -> RobotSpec {
    let mut robot = default_robot();
    robot.motors[0].stops = Some([0.0, 90.0]);
    robot.grippers = vec![Gripper { at: JAWS, ..gripper }];
    robot
}

/// A robot that has closed its gripper on a thing of 0.1 kg.
fn carrying(gripper: Gripper) -> Desk {
    let world =
        WorldSpec { items: vec![square([0.0, 12.0], 6.0, mass(0.1))], ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &with_gripper(gripper));
    desk.run(A, &[("duty_cycle_sp", 40)], "run-direct");
    desk.step(1000);
    assert!(desk.0.held().eq([desk.thing().id()]));
    desk
}

/// How far the thing is from where the gripper took it: in cm and in degrees.
fn off(desk: &Desk) -> (f64, f64) {
    let (robot, thing) = (desk.0.pose(), desk.thing().pose());
    let (sin, cos) = robot.heading.to_radians().sin_cos();
    let [x, y] = [robot.x + 12.0 * sin, robot.y + 12.0 * cos];
    ((thing.x - x).hypot(thing.y - y), (thing.heading - robot.heading).abs())
}

#[test]
fn what_a_gripper_holds_comes_along() {
    for lifts in [false, true] {
        let mut desk = carrying(Gripper { lifts, ..Gripper::default() });
        let closed = desk.position(A);
        assert!((20..30).contains(&closed), "{closed}: it stalls at a thing of 6 cm");
        assert_eq!(desk.state(A), "running stalled");
        let mut worst: (f64, f64) = (0.0, 0.0);
        for (left, right) in [(400, 400), (300, -300), (-400, -400), (1000, 1000), (0, 600)] {
            desk.drive(left, right);
            for _ in 0..100 {
                desk.step(10);
                let (far, turned) = off(&desk);
                worst = (worst.0.max(far), worst.1.max(turned));
            }
        }
        assert!(worst.0 < 0.01 && worst.1 < 0.1, "{lifts}: {worst:?}");
        assert!(desk.0.pose().y.hypot(desk.0.pose().x) > 10.0);
        desk.run(A, &[("duty_cycle_sp", -40)], "run-direct");
        desk.step(1000);
        assert_eq!(desk.0.held().count(), 0);
        desk.hold();
        desk.step(1000);
        assert!(!desk.thing().is_moving(), "it lies on the floor");
        assert_eq!(halts(&desk.0), 0);
    }
}

#[test]
fn samples_have_things_and_jaws_as_they_were() {
    let world =
        WorldSpec { items: vec![square([0.0, 12.0], 6.0, mass(0.1))], ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &with_gripper(Gripper::default()));
    desk.0.keep_samples(true);
    desk.run(A, &[("duty_cycle_sp", 40)], "run-direct");
    desk.step(1000);
    desk.drive(300, 300);
    desk.step(1000);
    let samples = desk.0.samples(None);
    let (first, last) = (samples[0], samples[samples.len() - 1]);
    let place = |sample: &Sample| sample.things[0].1.y - sample.pose.y;
    assert!(samples.iter().all(|sample| (place(sample) - 12.0).abs() < 0.01));
    assert!(last.things[0].1.y > 20.0 && last.things[0].0 == desk.thing().id());
    let opening = |sample: &Sample| sample.values(Port::OutA)[3];
    assert!((opening(first), opening(last).round()) == (8.0, 6.0), "{}", opening(last));
}

#[test]
fn a_weak_gripper_loses_what_it_holds() {
    let mut desk = carrying(Gripper { force: 0.05, ..Gripper::default() });
    desk.drive(-600, -600);
    desk.step(1500);
    assert_eq!(desk.0.held().count(), 0);
    assert!(!desk.thing().is_moving());
    assert!(off(&desk).0 > 10.0);
}

#[test]
fn a_gripper_closes_on_nothing_beside_it() {
    let world =
        WorldSpec { items: vec![square([9.0, 12.0], 6.0, mass(0.1))], ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &with_gripper(Gripper::default()));
    desk.run(A, &[("duty_cycle_sp", 40)], "run-direct");
    desk.step(1000);
    assert_eq!((desk.0.held().count(), desk.position(A)), (0, 90));
}

#[test]
fn a_robot_that_is_lifted_loses_what_it_holds() {
    let mut desk = carrying(Gripper::default());
    desk.0.place(Pose::new(50.0, 50.0, 0.0)).unwrap();
    desk.drive(100, 100);
    desk.step(500);
    assert_eq!(desk.0.held().count(), 0);
    assert!(desk.thing().pose().y < 13.0);
}

#[test]
fn impossible_grippers_are_refused() {
    let fault = |robot: RobotSpec| robot.validate().unwrap_err().to_string();
    assert!(fault(with_gripper(Gripper { force: -1.0, ..Gripper::default() })).contains("force"));
    assert!(
        fault(with_gripper(Gripper { port: Port::OutB, ..Gripper::default() })).contains("stops")
    );
    let mut twice = with_gripper(Gripper::default());
    twice.grippers.push(twice.grippers[0]);
    assert!(fault(twice).contains("of its own"));
}
