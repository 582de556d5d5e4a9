//! Linear actuators (`docs/ev3dev-sysfs.md`, 1, 2 and 2.1).
use crate::desk::Desk;
use ev3_sim::{Errno, Port};

const L: &str = "tacho-motor/linear4/";

fn file(name: &str) -> String {
    format!("{L}{name}")
}

/// A short one at outD, and its port set to it.
fn desk() -> Desk {
    let mut desk = Desk::new();
    desk.0.plug(Port::OutD, "act-l12-ev3-50").unwrap();
    desk.step(1000);
    assert_eq!(desk.get("tacho-motor/motor3/driver_name"), "lego-ev3-l-motor", "not recognized");
    desk.put("lego-port/port7/set_device", "act-l12-ev3-50");
    desk.step(500);
    desk
}

#[test]
fn files_of_a_linear_actuator() {
    let mut desk = desk();
    let texts = [
        ("driver_name", "act-l12-ev3-50"),
        ("max_speed", "24"),
        ("count_per_m", "2000"),
        ("full_travel_count", "100"),
        ("hold_pid/Kp", "40000"),
    ];
    for (name, text) in texts {
        assert_eq!(desk.get(&file(name)), text, "{name}");
    }
    assert_eq!(desk.try_get(&file("count_per_rot")), Err(Errno::ENOENT));
    assert_eq!(desk.try_get("tacho-motor/motor0/count_per_m"), Err(Errno::ENOENT));
    assert_eq!(desk.try_put(&file("speed_sp"), "25"), Err(Errno::EINVAL));
    desk.put("lego-port/port7/set_device", "act-l12-ev3-100");
    assert_eq!(desk.get("tacho-motor/linear5/full_travel_count"), "200");
}

#[test]
fn it_goes_out_and_stays_there_without_voltage() {
    let mut desk = desk();
    let start = desk.position(L);
    desk.run(L, &[("speed_sp", 12), ("position_sp", 40)], "run-to-rel-pos");
    desk.until(L, "", 8000);
    let there = desk.position(L) - start;
    assert!((40..=42).contains(&there), "{there}");
    desk.step(2000);
    assert!((desk.position(L) - start - there).abs() <= 1, "the screw holds it");
}

#[test]
fn it_stalls_at_either_end() {
    let mut desk = desk();
    for (speed, end) in [(24, 100.0), (-24, 0.0)] {
        desk.run(L, &[("speed_sp", speed)], "run-forever");
        desk.step(9000);
        assert!(desk.state(L).contains("stalled"), "{}", desk.state(L));
        assert!((desk.0.shaft_angle(Port::OutD) - end).abs() < 0.1);
    }
}
