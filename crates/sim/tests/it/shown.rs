//! The state of the machine that those who look on see.
use crate::desk::furnished;
use crate::robots::default_robot;
use ev3_sim::{Item, Machine, Options, Pose, Sample, Shown, Sight, WorldSpec};
use std::time::Duration;

fn machine() -> Machine {
    Machine::new(&furnished(), &default_robot(), Options::default()).unwrap()
}

fn drive(machine: &mut Machine) {
    machine.write_path("tacho-motor/motor1/speed_sp", "300").unwrap();
    machine.write_path("tacho-motor/motor1/command", "run-forever").unwrap();
}

fn look(machine: &Machine) -> String {
    let ports = ev3_sim::Port::ALL.map(|port| machine.shown(port));
    let sights: Vec<_> = machine.sights().collect();
    let bulbs: Vec<_> = machine.bulbs().collect();
    let brick = (machine.lights(), machine.battery(), machine.pixels(), machine.is_moving());
    format!("{ports:?} {sights:?} {bulbs:?} {brick:?} {:?}", machine.frame())
}

#[test]
fn nothing_changes_by_looking() {
    let (mut watched, mut alone) = (machine(), machine());
    watched.keep_samples(true);
    drive(&mut watched);
    drive(&mut alone);
    for _ in 0..100 {
        assert_eq!(look(&watched), look(&watched));
        watched.step(Duration::from_millis(7));
        alone.step(Duration::from_millis(7));
        for machine in [&mut watched, &mut alone] {
            machine.read_path("lego-sensor/sensor0/value0").unwrap();
        }
    }
    assert_eq!(watched.pose(), alone.pose());
    let events = |machine: &Machine| format!("{:?}", machine.trace());
    assert_eq!(events(&watched), events(&alone));
}

#[test]
fn values_are_those_that_a_program_reads() {
    let mut machine = machine();
    machine.step(Duration::from_millis(100));
    let Shown::Sensor(sensor) = machine.shown("in1".parse().unwrap()) else { panic!() };
    let read = machine.read_path("lego-sensor/sensor0/value0").unwrap();
    let tenths: f64 = read.trim().parse().unwrap();
    assert_eq!((sensor.values, sensor.units), (vec![tenths / 10.0], "cm"));
}

#[test]
fn ports_say_what_is_plugged_in() {
    let mut machine = machine();
    let [sensor, motor] = ["in1", "outD"].map(|port| port.parse().unwrap());
    machine.unplug(sensor);
    machine.plug(motor, "lego-ev3-m-motor").unwrap();
    assert_eq!(machine.shown(motor), Shown::Coming("lego-ev3-m-motor"));
    machine.step(Duration::from_secs(2));
    assert!(matches!(machine.shown(motor), Shown::Motor(_)), "{:?}", machine.shown(motor));
    assert_eq!(machine.shown(sensor), Shown::Nothing);
}

#[test]
fn a_cone_ends_at_what_is_in_it() {
    let mut machine = machine();
    machine.place(Pose::new(60.0, 120.0, 0.0)).unwrap();
    let hit = machine.sights().find_map(|(.., sight)| match sight {
        Sight::Cone { hit, .. } => hit,
        _ => None,
    });
    let [x, y] = hit.unwrap();
    // The box around 70, 155.
    assert!((x - 70.0).hypot(y - 155.0) < 26.0, "{x} {y}");
}

#[test]
fn samples_are_a_film_of_the_run() {
    let mut machine = machine();
    assert!(machine.samples(None).is_empty());
    machine.keep_samples(true);
    drive(&mut machine);
    machine.step(Duration::from_secs(1));
    let times = |machine: &Machine, after| {
        let samples = machine.samples(after).into_iter();
        samples.map(|sample| sample.at.as_millis()).collect::<Vec<_>>()
    };
    let all: Vec<_> = (0..=1000).step_by(50).collect();
    assert_eq!(times(&machine, None), all);
    let first: Sample = machine.samples(None)[0].clone();
    assert_eq!(first.pose, Pose::new(60.0, 50.0, 0.0));
    assert_eq!(first.values("outA".parse().unwrap()), [0.0; 3]);
    let second = Some(Duration::from_secs(1));
    assert!(times(&machine, second).is_empty());
    machine.step(Duration::from_millis(60));
    assert_eq!(times(&machine, second), [1050]);
}

#[test]
fn samples_are_thinned_and_time_that_stands_takes_no_memory() {
    let mut machine = machine();
    machine.keep_samples(true);
    machine.step(Duration::from_secs(100));
    assert!(machine.samples(None).len() < 9);
    drive(&mut machine);
    machine.step(Duration::from_secs(120));
    let count = machine.samples(None).len();
    assert!((1000..2050).contains(&count), "{count}");
}

#[test]
fn the_world_has_a_version() {
    let mut machine = machine();
    let versions = |machine: &Machine| machine.world_version();
    let first = versions(&machine);
    let id = machine.add_item(Item::circle([20.0, 20.0], 5.0)).unwrap();
    let second = versions(&machine);
    assert!(machine.move_item(id, [30.0, 20.0], None).unwrap());
    let third = versions(&machine);
    machine.remove_item(id);
    let all = [first, second, third, versions(&machine)];
    assert!((1..4).all(|n| !all[..n].contains(&all[n])), "{all:?}");
}

#[test]
fn things_move_but_not_into_the_robot() {
    let mut machine = machine();
    let id = machine.add_item(Item::circle([150.0, 20.0], 5.0)).unwrap();
    assert!(machine.move_item(id, [160.0, 30.0], Some(5.0)).unwrap());
    let at = |machine: &Machine| {
        machine.items().find(|(other, _)| *other == id).map(|(_, item)| item.into_owned())
    };
    assert_eq!(at(&machine).unwrap(), Item::circle([160.0, 30.0], 5.0));
    let error = machine.move_item(id, [60.0, 50.0], None).unwrap_err();
    assert!(error.to_string().ends_with("is where the robot stands"), "{error}");
    assert_eq!(at(&machine).unwrap(), Item::circle([160.0, 30.0], 5.0));
    machine.remove_item(id);
    assert!(!machine.move_item(id, [0.0, 0.0], None).unwrap());
}

#[test]
fn the_start_is_known_wherever_the_robot_is() {
    let mut machine = machine();
    let start = machine.start();
    assert_eq!(start, machine.pose());
    machine.place(Pose::new(150.0, 20.0, 90.0)).unwrap();
    assert_eq!(machine.start(), start);
}

#[test]
fn the_world_is_written_as_facts() {
    let machine = Machine::new(
        &WorldSpec {
            items: vec![Item::rectangle([-5.0, -6.0], [7.0, 8.0], ev3_sim::Color::BLACK)],
            start: Pose::new(1.0, 2.0, 3.0),
            ..WorldSpec::default()
        },
        &default_robot(),
        Options::default(),
    );
    let facts = machine.unwrap().world_facts();
    assert!(facts.contains("patch('#0f0f0f', [-5 - -6, 7 - -6, 7-8, -5-8]).\n"), "{facts}");
    assert!(facts.contains("start(1.00, 2.00, 3.0).\n"), "{facts}");
}
