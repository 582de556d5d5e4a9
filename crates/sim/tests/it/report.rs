//! What a page is told of the machine.

use std::time::Duration;

use ev3_json::Json;
use ev3_sim::{Beside, Item, Machine, Options, Pose, WorldSpec};

use crate::desk::furnished;
use crate::robots::default_robot;

fn machine() -> Machine {
    Machine::new(&furnished(), &default_robot(), Options::default()).unwrap()
}

fn text(write: impl FnOnce(&mut Json)) -> String {
    let mut json = Json::new();
    write(&mut json);
    json.into_text()
}

fn state(machine: &Machine) -> String {
    text(|json| json.object(|json| machine.report_state(json, &Beside::default())))
}

fn drive(machine: &mut Machine) {
    machine.write_path("tacho-motor/motor1/speed_sp", "300").unwrap();
    machine.write_path("tacho-motor/motor1/command", "run-forever").unwrap();
}

#[test]
fn nothing_changes_by_looking() {
    let (mut watched, mut alone) = (machine(), machine());
    watched.keep_samples(true);
    drive(&mut watched);
    drive(&mut alone);
    for _ in 0..100 {
        state(&watched);
        text(|json| {
            json.object(|json| watched.report_world(json));
            watched.report_robot(json);
            watched.report_screen(json);
        });
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
    let shown = state(&machine);
    let read = machine.read_path("lego-sensor/sensor0/value0").unwrap();
    let tenths: f64 = read.trim().parse().unwrap();
    assert!(shown.contains(&format!("\"values\":[{}],\"units\":\"cm\"", tenths / 10.0)), "{shown}");
}

#[test]
fn ports_say_what_is_plugged_in() {
    let mut machine = machine();
    let beside = Beside { pulled: [Some("lego-ev3-us"), None, None, None, None, None, None, None] };
    machine.unplug("in1".parse().unwrap());
    machine.plug("outD".parse().unwrap(), "lego-ev3-m-motor").unwrap();
    let shown = text(|json| json.object(|json| machine.report_state(json, &beside)));
    assert!(shown.contains(r#"{"port":"outD","kind":"coming","driver":"lego-ev3-m-motor""#));
    assert!(shown.contains(r#"{"port":"in1","kind":"gone","driver":"lego-ev3-us""#), "{shown}");
    machine.step(Duration::from_secs(2));
    assert!(
        state(&machine).contains(r#"{"port":"outD","kind":"motor","driver":"lego-ev3-m-motor""#)
    );
    assert!(state(&machine).contains(r#"{"port":"in1","kind":"empty"}"#));
}

#[test]
fn a_cone_ends_at_what_is_in_it() {
    let mut machine = machine();
    machine.place(Pose::new(60.0, 120.0, 0.0)).unwrap();
    let shown = state(&machine);
    let hit = shown.split("\"hit\":[").nth(1).and_then(|rest| rest.split(']').next()).unwrap();
    let [x, y] = *hit.split(',').map(|n| n.parse::<f64>().unwrap()).collect::<Vec<_>>() else {
        panic!("{hit}");
    };
    // The box around 70, 155.
    assert!((x - 70.0).hypot(y - 155.0) < 26.0, "{hit}");
}

#[test]
fn samples_are_a_film_of_the_run() {
    let mut machine = machine();
    assert!(machine.samples_csv().is_none());
    machine.keep_samples(true);
    drive(&mut machine);
    machine.step(Duration::from_secs(1));
    let csv = machine.samples_csv().unwrap();
    let lines: Vec<_> = csv.lines().collect();
    assert!(lines[0].starts_with("time,x,y,heading,outA.position,"), "{}", lines[0]);
    assert_eq!(lines.len(), 22);
    assert!(lines[1].starts_with("0,60,50,0,"), "{}", lines[1]);
    assert!(lines[21].starts_with("1,"), "{}", lines[21]);
    let mut last = None;
    let mut report = |machine: &Machine, after| {
        text(|json| json.object(|json| last = machine.report_samples(json, after, &mut |_| None)))
    };
    assert!(report(&machine, None).contains("[0.95,"));
    assert_eq!(report(&machine, Some(Duration::from_secs(1))), "{}");
    machine.step(Duration::from_millis(60));
    let more = report(&machine, Some(Duration::from_secs(1)));
    assert!(more.contains("\"rows\":[[1.05,"), "{more}");
    assert_eq!(last, Some(Duration::from_millis(1050)));
}

#[test]
fn samples_are_thinned_and_time_that_stands_takes_no_memory() {
    let mut machine = machine();
    machine.keep_samples(true);
    machine.step(Duration::from_secs(3600));
    assert!(machine.samples_csv().unwrap().lines().count() < 10);
    drive(&mut machine);
    machine.step(Duration::from_secs(600));
    let count = machine.samples_csv().unwrap().lines().count();
    assert!((1000..2050).contains(&count), "{count}");
}

#[test]
fn the_world_has_a_version() {
    let mut machine = machine();
    let versions = |machine: &Machine| machine.world_version();
    let first = versions(&machine);
    let id = machine.add_item(Item::Circle { center: [20.0, 20.0], radius: 5.0 }).unwrap();
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
    let id = machine.add_item(Item::Circle { center: [150.0, 20.0], radius: 5.0 }).unwrap();
    assert!(machine.move_item(id, [160.0, 30.0], Some(5.0)).unwrap());
    let at = |machine: &Machine| machine.items().iter().find(|(other, _)| *other == id).cloned();
    assert_eq!(at(&machine).unwrap().1, Item::Circle { center: [160.0, 30.0], radius: 5.0 });
    let error = machine.move_item(id, [60.0, 50.0], None).unwrap_err();
    assert!(error.to_string().ends_with("is where the robot stands"), "{error}");
    assert_eq!(at(&machine).unwrap().1, Item::Circle { center: [160.0, 30.0], radius: 5.0 });
    machine.remove_item(id);
    assert!(!machine.move_item(id, [0.0, 0.0], None).unwrap());
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
