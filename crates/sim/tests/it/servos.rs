//! RC servos behind a controller (`docs/ev3dev-sysfs.md`, 4.3).
use crate::desk::Desk;
use ev3_sim::{Errno, Port};

const S: &str = "servo-motor/motor0/";

fn file(name: &str) -> String {
    format!("{S}{name}")
}

/// A controller at in1.
fn desk() -> Desk {
    let mut desk = Desk::new();
    desk.0.plug(Port::In1, "ms-8ch-servo").unwrap();
    desk.step(2500);
    desk
}

#[test]
fn eight_servos_come_and_go_with_their_controller() {
    let mut desk = desk();
    for (number, name) in [(0, "sv1"), (7, "sv8")] {
        let directory = format!("servo-motor/motor{number}");
        let address = format!("ev3-ports:in1:i2c88:{name}");
        assert_eq!(desk.get(&format!("{directory}/address")), address);
        assert_eq!(desk.get(&format!("{directory}/driver_name")), "ms-8ch-servo");
    }
    assert_eq!(desk.try_get("servo-motor/motor8/state"), Err(Errno::ENOENT));
    assert!(desk.0.unplug(Port::In1));
    desk.step(200);
    assert_eq!(desk.try_get(&file("state")), Err(Errno::ENOENT));
}

#[test]
fn files_and_their_limits() {
    let mut desk = desk();
    let texts = [
        ("min_pulse_sp", "500"),
        ("mid_pulse_sp", "1500"),
        ("max_pulse_sp", "2500"),
        ("polarity", "normal"),
        ("position_sp", "-150"),
        ("rate_sp", "0"),
        ("state", ""),
    ];
    for (name, text) in texts {
        assert_eq!(desk.get(&file(name)), text, "{name}");
    }
    assert_eq!(desk.try_get(&file("command")), Err(Errno::EACCES));
    let refused = [
        ("command", "stop"),
        ("min_pulse_sp", "1001"),
        ("mid_pulse_sp", "999"),
        ("max_pulse_sp", "3001"),
        ("position_sp", "101"),
        ("position_sp", "-101"),
        ("position_sp", "left"),
        ("rate_sp", "-1"),
        ("polarity", "inverted"),
    ];
    for (name, text) in refused {
        assert_eq!(desk.try_put(&file(name), text), Err(Errno::EINVAL), "{name} <- {text}");
    }
    desk.put(&file("position_sp"), " 12 %");
    for (written, read) in [(93, 0), (94, 94), (100, 100), (7000, 8000)] {
        desk.put(&file("rate_sp"), written);
        assert_eq!(desk.number(&file("rate_sp")), read, "{written}");
    }
}

#[test]
fn what_a_division_leaves_over_is_lost_upwards_from_the_lower_end() {
    let mut desk = desk();
    desk.put(&file("min_pulse_sp"), 501);
    desk.put(&file("command"), "run");
    for (position, read) in [(-50, -51), (-33, -34), (-100, -100), (0, 0), (33, 33)] {
        desk.put(&file("position_sp"), position);
        assert_eq!(desk.number(&file("position_sp")), read, "{position}");
    }
}

#[test]
fn the_polarity_that_it_has_sends_nothing() {
    let mut desk = desk();
    desk.put(&file("command"), "run");
    desk.put(&file("position_sp"), 100);
    desk.put(&file("max_pulse_sp"), 2000);
    desk.put(&file("polarity"), "normal");
    assert_eq!(desk.number(&file("position_sp")), 200, "2500 us");
    desk.put(&file("polarity"), "inversed");
    assert_eq!(desk.number(&file("position_sp")), -100);
}

#[test]
fn a_position_is_the_length_of_a_pulse() {
    let mut desk = desk();
    desk.put(&file("position_sp"), 40);
    assert_eq!(desk.number(&file("position_sp")), -150, "remembered, and not sent");
    desk.put(&file("command"), "run");
    assert_eq!(desk.get(&file("state")), "running");
    assert_eq!(desk.number(&file("position_sp")), 40);
    desk.put(&file("polarity"), "inversed");
    assert_eq!(desk.number(&file("position_sp")), -40, "sent at once, and read as sent");
    desk.put(&file("min_pulse_sp"), 1000);
    desk.put(&file("command"), "run");
    assert_eq!(desk.number(&file("position_sp")), -80, "1100 us, as the same command does nothing");
    desk.put(&file("position_sp"), 40);
    assert_eq!(desk.number(&file("position_sp")), -40);
    desk.put(&file("command"), "float");
    assert_eq!(desk.get(&file("state")), "");
    assert_eq!(desk.number(&file("position_sp")), -300);
}
