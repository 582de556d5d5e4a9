//! Commands and courses in the journal.
use crate::brick::{Brick, ms};
use ev3_driver::drive::odometry::Wheels;
use ev3_driver::drive::steering::Leg;
use ev3_driver::drive::{Command, Drive, DriveOptions, Robot};
use ev3_driver::journal::{Act, Word, set_called, set_cause};
use ev3_driver::motor::{self, Run, Speed, StopAction, run_forever};
use ev3_driver::{Class, Registry};
use std::sync::Arc;

/// The acts, the first one first, in few words.
fn acts(registry: &Registry) -> Vec<String> {
    let short = |act: &Act| match act {
        Act::Motor(port, command) => {
            let numbers: Vec<_> = command.numbers().map(|(_, number)| number.to_string()).collect();
            format!("{} {} {}", port.text(), command.word.text(), numbers.join(","))
        }
        Act::Course(course) => format!("course {:?}", course.course),
        Act::Ended(_, reason) => format!("ended {reason}"),
        Act::Pose(_) | Act::Light(..) | Act::Sound(_) => String::new(),
    };
    registry.journal().entries().iter().rev().map(|entry| short(&entry.act)).collect()
}

#[test]
fn a_command_has_its_set_points_time_and_cause() {
    let brick = Brick::new(&["outB"]);
    let registry = brick.devices();
    brick.pass(ms(500));
    let before = brick.now();
    set_cause(5);
    set_called("motor_run", 2);
    let run = Run { port: "outB", speed: Speed::CountsPerSecond(200) };
    assert!(run_forever(&registry, &[run], &mut brick.attentive()).unwrap().is_some());
    set_cause(0);
    let entries = registry.journal().entries();
    let [entry] = &*entries else { panic!("{entries:?}") };
    assert!(entry.time >= before && entry.time <= brick.now());
    assert_eq!((entry.origin.cause, entry.origin.called), (5, Some(("motor_run", 2))));
    let Act::Motor(port, command) = &entry.act else { panic!("{entry:?}") };
    assert_eq!((port.text(), command.word), ("outB", Word::RunForever));
    assert_eq!(command.numbers().collect::<Vec<_>>(), [("speed_sp", 200)]);
    assert_eq!(command.stop_action(), None);
}

#[test]
fn a_reset_motor_has_no_known_set_points() {
    let brick = Brick::new(&["outB"]);
    let registry = brick.devices();
    let run = Run { port: "outB", speed: Speed::CountsPerSecond(200) };
    run_forever(&registry, &[run], &mut brick.attentive()).unwrap();
    let found = registry.find(Class::TachoMotor, "outB").unwrap().unwrap();
    motor::reset(&found).unwrap();
    motor::command(&found, "run-forever").unwrap();
    motor::stop(&found, StopAction::Hold).unwrap();
    let expected = ["outB run-forever 200", "outB reset ", "outB run-forever ", "outB stop "];
    assert_eq!(acts(&registry), expected);
}

#[test]
fn a_course_is_noted_when_it_begins_and_ends_and_not_in_between() {
    let brick = Brick::new(&["outB", "outC"]);
    let registry = brick.devices();
    let wheels = Wheels::new([5.0, 5.0], [false, false], 11.0, 0.0);
    let robot = Robot { ports: ["outB".to_owned(), "outC".to_owned()], wheels };
    let drive = Drive::new(Arc::clone(&registry), &robot);
    let options = DriveOptions {
        percent: 30.0,
        acceleration: 50.0,
        stop_action: StopAction::Brake,
        use_gyro: false,
    };
    let course = Command::Legs(vec![Leg::Arc(20.0, 0.0)], false);
    set_cause(9);
    let begun = drive.begin(&course, &options, &mut brick.attentive()).unwrap().unwrap();
    set_cause(0);
    drive.until_ended(begun, None).block(&mut brick.attentive()).unwrap();
    assert_eq!(acts(&registry), ["course Legs([Arc(20.0, 0.0)], false)", "ended reached"]);
    assert!(registry.journal().entries().iter().all(|entry| entry.origin.cause == 9));
    // What changes nothing is not noted.
    let change = Command::Change(1.0, 2.0);
    drive.begin(&change, &options, &mut brick.attentive()).unwrap();
    assert_eq!(acts(&registry).len(), 2);
}
