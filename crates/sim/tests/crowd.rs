//! Several robots in one world: they see each other, push as far as their tires grip, and each has
//! a processor of its own.

#[path = "it/access.rs"]
mod access;
#[path = "it/robots.rs"]
mod robots;

use ev3_sim::{
    Clock, Hull, Item, Machine, Options, Port, Pose, RobotSpec, Simulation, WorldSpec, robot_of,
};
use robots::default_robot;
use std::time::Duration;

const RADIUS: f64 = 8.0;

fn world(items: Vec<Item>) -> WorldSpec {
    WorldSpec { items, ..WorldSpec::default() }
}

fn at(world: &WorldSpec, robot: &RobotSpec, start: Pose) -> Machine {
    let world = WorldSpec { start, ..world.clone() };
    Machine::new(&world, robot, Options { instant: true, ..Options::default() }).unwrap()
}

fn crowd(machines: Vec<Machine>) -> Vec<Simulation> {
    Simulation::crowd(machines, Clock::Virtual, || false).unwrap().unwrap()
}

fn pair(first: &RobotSpec, second: &RobotSpec, places: [Pose; 2]) -> Vec<Simulation> {
    let world = world(Vec::new());
    crowd(vec![at(&world, first, places[0]), at(&world, second, places[1])])
}

fn heavy(mass: f64) -> RobotSpec {
    RobotSpec { mass, ..default_robot() }
}

fn command(simulation: &Simulation, speed: i32, command: &str) {
    let mut machine = simulation.machine();
    for motor in ["tacho-motor/motor1", "tacho-motor/motor2"] {
        machine.write_path(&format!("{motor}/speed_sp"), &speed.to_string()).unwrap();
        machine.write_path(&format!("{motor}/command"), command).unwrap();
    }
}

fn drive(simulation: &Simulation, speed: i32) {
    command(simulation, speed, "run-forever");
}

fn pose(simulation: &Simulation) -> Pose {
    simulation.machine().pose()
}

fn sonar(simulation: &Simulation) -> i32 {
    let mut machine = simulation.machine();
    machine.read_path("lego-sensor/sensor0/value0").unwrap().trim().parse().unwrap()
}

fn apart(crowd: &[Simulation]) -> f64 {
    let (a, b) = (pose(&crowd[0]), pose(&crowd[1]));
    (a.x - b.x).hypot(a.y - b.y)
}

/// Steps, and answers how near two round robots came.
fn nearest(crowd: &[Simulation], seconds: u64) -> f64 {
    let mut nearest = f64::INFINITY;
    for _ in 0..seconds * 100 {
        crowd[0].step(Duration::from_millis(10));
        nearest = nearest.min(apart(crowd) - 2.0 * RADIUS);
    }
    nearest
}

#[test]
fn a_robot_far_from_others_moves_as_if_alone() {
    let world = world(vec![Item::wall([-50.0, 60.0], [50.0, 60.0])]);
    let start = Pose::new(0.0, 0.0, 10.0);
    let alone =
        Simulation::new(at(&world, &default_robot(), start), Clock::Virtual, || false).unwrap();
    let crowd = crowd(vec![
        at(&world, &default_robot(), start),
        at(&world, &default_robot(), Pose::new(200.0, 0.0, 0.0)),
    ]);
    for simulation in [&alone, &crowd[0]] {
        drive(simulation, 400);
        simulation.step(Duration::from_secs(5));
    }
    assert_eq!(pose(&alone), pose(&crowd[0]));
    assert_eq!(alone.machine().now(), crowd[1].machine().now());
    assert_eq!(alone.machine().trace().collision_count(), 1);
}

#[test]
fn sensors_see_other_robots() {
    let crowd =
        pair(&default_robot(), &default_robot(), [Pose::default(), Pose::new(0.0, 60.0, 180.0)]);
    let before = sonar(&crowd[0]);
    assert!((300..600).contains(&before), "{before}");
    assert_eq!(before, sonar(&crowd[1]), "they stand the same");
    drive(&crowd[1], 200);
    crowd[0].step(Duration::from_secs(1));
    let moved = pose(&crowd[1]).y - 60.0;
    let after = sonar(&crowd[0]);
    assert!((f64::from(before - after) + moved * 10.0).abs() < 3.0, "{before} {after} {moved}");
}

#[test]
fn the_heavier_one_pushes_the_lighter_one_back() {
    for (first, second) in [(0.75, 1.5), (1.5, 0.75)] {
        let places = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 30.0, 180.0)];
        let crowd = pair(&heavy(first), &heavy(second), places);
        drive(&crowd[0], 900);
        drive(&crowd[1], 900);
        let gap = nearest(&crowd, 1);
        let met = pose(&crowd[0]).y;
        let gap = gap.min(nearest(&crowd, 2));
        let pushed = pose(&crowd[0]).y - met;
        assert!(gap > 0.0, "{gap}");
        assert!(if first < second { pushed < -3.0 } else { pushed > 3.0 }, "{first}: {pushed}");
    }
}

#[test]
fn equal_ones_stay_where_they_meet() {
    let places = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 30.0, 180.0)];
    let crowd = pair(&default_robot(), &default_robot(), places);
    drive(&crowd[0], 500);
    drive(&crowd[1], 500);
    assert!(nearest(&crowd, 3) > 0.0);
    assert!((pose(&crowd[0]).y + pose(&crowd[1]).y - 30.0).abs() < 0.2, "{:?}", pose(&crowd[0]));
}

#[test]
fn brakes_do_not_hold_more_than_tires() {
    let places = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 20.0, 0.0)];
    let crowd = pair(&heavy(2.0), &heavy(0.5), places);
    command(&crowd[1], 0, "stop");
    drive(&crowd[0], 300);
    assert!(nearest(&crowd, 3) > 0.0);
    assert!(pose(&crowd[1]).y > 30.0, "{:?}", pose(&crowd[1]));
    let angle = crowd[1].machine().shaft_angle(Port::OutB);
    // One that only rolls along turns its wheels by the way; this one may slide, too.
    let rolled = angle.to_radians() * 2.8;
    assert!(rolled <= pose(&crowd[1]).y - 20.0 + 0.1, "{rolled}");
}

#[test]
fn one_from_the_side_is_shoved_aside() {
    let places = [Pose::new(-20.0, 0.0, 90.0), Pose::new(0.0, 0.0, 0.0)];
    let crowd = pair(&heavy(2.0), &heavy(0.5), places);
    drive(&crowd[0], 300);
    assert!(nearest(&crowd, 3) > 0.0);
    assert!(pose(&crowd[1]).x > 8.0, "{:?}", pose(&crowd[1]));
}

#[test]
fn rectangles_push_and_turn_each_other() {
    let hull = Hull::Rectangle { width: 14.0, length: 18.0, offset: 2.0 };
    let robot = RobotSpec { hull, ..default_robot() };
    let crowd = pair(&robot, &robot, [Pose::new(0.0, 0.0, 0.0), Pose::new(6.0, 25.0, 90.0)]);
    drive(&crowd[0], 500);
    crowd[0].step(Duration::from_secs(3));
    let (first, second) = (pose(&crowd[0]), pose(&crowd[1]));
    // Beside its middle, so both turn; their sides stay flat against each other.
    assert!(first.heading > 45.0, "{first:?}");
    assert!((second.heading - first.heading - 90.0).abs() < 1.0, "{first:?} {second:?}");
}

#[test]
fn a_robot_at_a_wall_cannot_be_pushed_into_it() {
    let world = world(vec![Item::wall([-50.0, 40.0], [50.0, 40.0])]);
    let crowd = crowd(vec![
        at(&world, &heavy(3.0), Pose::new(0.0, 0.0, 0.0)),
        at(&world, &heavy(0.5), Pose::new(0.0, 28.0, 0.0)),
    ]);
    drive(&crowd[0], 900);
    assert!(nearest(&crowd, 4) > 0.0);
    let pushed = pose(&crowd[1]);
    assert!(pushed.y > 31.0 && pushed.y < 39.5 - RADIUS, "{pushed:?}");
}

#[test]
fn a_robot_that_was_pushed_rolls_again_as_before() {
    let places = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 20.0, 0.0)];
    let crowd = pair(&heavy(2.0), &heavy(0.5), places);
    drive(&crowd[0], 300);
    crowd[0].step(Duration::from_secs(2));
    drive(&crowd[0], -300);
    drive(&crowd[1], 300);
    crowd[0].step(Duration::from_secs(2));
    let turned = || {
        let machine = crowd[1].machine();
        f64::midpoint(machine.shaft_angle(Port::OutB), machine.shaft_angle(Port::OutC))
    };
    let (from, before) = (pose(&crowd[1]), turned());
    crowd[0].step(Duration::from_secs(1));
    let way = (pose(&crowd[1]).y - from.y).hypot(pose(&crowd[1]).x - from.x);
    let rolled = (turned() - before).to_radians() * 2.8;
    assert!((way - rolled).abs() < 1e-6, "{way} {rolled}");
}

#[test]
fn collisions_name_the_other_robot() {
    let places = [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 20.0, 0.0)];
    let crowd = pair(&default_robot(), &default_robot(), places);
    drive(&crowd[0], 300);
    crowd[0].step(Duration::from_secs(2));
    let hits = |index: usize| -> Vec<_> {
        let machine = crowd[index].machine();
        machine.trace().collisions().map(|hit| robot_of(hit.item)).collect()
    };
    assert_eq!((hits(0), hits(1)), (vec![Some(1)], vec![Some(0)]));
}

#[test]
fn a_picture_shows_all_robots() {
    let crowd = pair(
        &default_robot(),
        &default_robot(),
        [Pose::new(0.0, 0.0, 0.0), Pose::new(0.0, 200.0, 180.0)],
    );
    let picture = crowd[0].machine().svg();
    assert!(picture.contains("cx=\"0.00\" cy=\"200.00\" r=\"8.00\""), "{picture}");
    let top = crowd[0].machine().frame().high[1];
    assert!(top > 200.0 + RADIUS, "{top}");
}

#[test]
fn the_same_in_each_run() {
    let run = || {
        let machines: Vec<_> = (0..12u32)
            .map(|index| {
                let angle = f64::from(index) * 30.0;
                let (sin, cos) = angle.to_radians().sin_cos();
                let start = Pose::new(70.0 * sin, 70.0 * cos, angle + 180.0);
                at(&world(Vec::new()), &heavy(0.5 + f64::from(index) / 10.0), start)
            })
            .collect();
        let crowd = crowd(machines);
        for simulation in &crowd {
            drive(simulation, 400);
        }
        let mut least = f64::INFINITY;
        for _ in 0..200 {
            crowd[0].step(Duration::from_millis(20));
            for (index, one) in crowd.iter().enumerate() {
                for other in &crowd[..index] {
                    let (a, b) = (pose(one), pose(other));
                    least = least.min((a.x - b.x).hypot(a.y - b.y) - 2.0 * RADIUS);
                }
            }
        }
        assert!(least > 0.0, "{least}");
        crowd.iter().map(pose).collect::<Vec<_>>()
    };
    assert_eq!(run(), run());
}

#[test]
fn robots_do_not_start_in_each_other() {
    let world = world(Vec::new());
    let machines = vec![
        at(&world, &default_robot(), Pose::default()),
        at(&world, &default_robot(), Pose::new(0.0, 15.0, 0.0)),
    ];
    let (index, error) =
        Simulation::crowd(machines, Clock::Virtual, || false).unwrap().unwrap_err();
    assert_eq!(index, 0);
    assert!(error.to_string().contains("another robot"), "{error}");
}

#[test]
fn what_a_hand_changes_is_there_for_all() {
    let places = [Pose::default(), Pose::new(0.0, 200.0, 180.0)];
    let crowd = pair(&default_robot(), &default_robot(), places);
    let circle = Item::circle([0.0, 100.0], 5.0);
    crowd[0].change_world(|machine| machine.add_item(circle)).unwrap();
    crowd[0].step(Duration::from_millis(200));
    assert!((800..1000).contains(&sonar(&crowd[1])), "{}", sonar(&crowd[1]));
    let on_top = Item::circle([0.0, 200.0], 5.0);
    assert!(crowd[0].change_world(|machine| machine.add_item(on_top)).is_err());
    let there = Pose::new(0.0, 200.0, 0.0);
    assert!(crowd[0].change_world(|machine| machine.place(there)).is_err());
    crowd[0].change_world(|machine| machine.place(Pose::new(0.0, 300.0, 0.0))).unwrap();
    crowd[1].step(Duration::from_millis(200));
    assert_eq!(crowd[0].machine().items().count(), 1);
}

#[test]
fn each_has_a_processor_of_its_own() {
    let places = [Pose::default(), Pose::new(0.0, 200.0, 180.0)];
    let crowd = pair(&default_robot(), &default_robot(), places);
    let call = |simulation: &Simulation| while !simulation.turn(&mut String::new) {};
    for _ in 0..100 {
        for simulation in &crowd {
            call(simulation);
            access::read(simulation, "tacho-motor/motor0/position");
        }
    }
    for simulation in &crowd {
        call(simulation);
    }
    assert_eq!(crowd[0].machine().now(), Duration::from_millis(50));
}
