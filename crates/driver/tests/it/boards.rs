//! Parts of the boards: lights, batteries, ports.
use crate::files::PlainTree;
use ev3_driver::brick::light::{self, Color};
use ev3_driver::brick::{battery, port as lego_port};
use ev3_driver::{Class, Error, Registry};
use std::fs;
use std::path::Path;
use std::sync::Arc;

/// A tree with LEDs of these names.
fn lights(names: &[&str]) -> (PlainTree, Arc<Registry>) {
    let tree = PlainTree::new();
    for name in names {
        let files =
            [("brightness", "0"), ("max_brightness", "255"), ("trigger", "[none] timer heartbeat")];
        tree.named(Class::Led, name, &files);
    }
    let devices = tree.devices();
    (tree, devices)
}

fn names(devices: &Registry) -> Vec<String> {
    light::lights(devices).unwrap().iter().map(|light| light.name().to_owned()).collect()
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap().trim_end().to_owned()
}

#[test]
fn lights_are_left_and_right_on_every_board_and_then_those_on_ports() {
    for (leds, expected) in [
        (&["led1:red:brick-status", "led0:green:brick-status", "led0:red:brick-status"][..], 2),
        (&["ev3:right:red:ev3dev", "ev3:left:red:ev3dev"], 2),
        (&["led1:blue:brick-status", "led2:blue:brick-status"], 2),
        (&["brickpi:led1:blue:ev3dev", "brickpi:led2:blue:ev3dev"], 2),
        (&["led1:amber:brick-status"], 1),
        (&["pistorms:BA:red:brick-status", "pistorms:BB:red:brick-status"], 2),
        (&["input3::capslock", "mmc0::"], 0),
    ] {
        let (_tree, devices) = lights(leds);
        assert_eq!(names(&devices), ["left", "right"][..expected], "{leds:?}");
    }
    let (_tree, devices) = lights(&[
        "ev3-ports:outD::brick-status",
        "ev3-ports:outB::brick-status",
        "led0:red:brick-status",
    ]);
    assert_eq!(names(&devices), ["left", "outB", "outD"]);
    assert!(light::find(&devices, "ev3-ports:outB").unwrap().is_some());
    assert!(light::find(&devices, "right").unwrap().is_none());
}

#[test]
fn every_level_is_read_as_it_was_set() {
    let (tree, devices) = lights(&["led0:red:brick-status", "led0:green:brick-status"]);
    for full in ["255", "100"] {
        for led in ["led0:red:brick-status", "led0:green:brick-status"] {
            fs::write(tree.root().join("leds").join(led).join("max_brightness"), full).unwrap();
        }
        let devices = tree.devices();
        for level in 0..=100 {
            let color = Color::Levels(vec![level, 3]);
            let set = light::set_color(&devices, "left", &color, &mut || false).unwrap();
            assert_eq!(set, Some(true));
            let light = light::find(&devices, "left").unwrap().unwrap();
            assert_eq!(light.color().unwrap(), color);
        }
    }
    assert_eq!(light::set_color(&devices, "up", &Color::Level(1), &mut || false).unwrap(), None);
}

#[test]
fn a_color_that_cannot_be_shown_is_refused_and_nothing_is_written() {
    let (tree, devices) = lights(&["led1:blue:brick-status"]);
    for color in [Color::Named("red"), Color::Levels(vec![0, 1])] {
        let set = light::set_color(&devices, "left", &color, &mut || false).unwrap();
        assert_eq!(set, Some(false), "{color:?}");
    }
    assert_eq!(text(&tree.root().join("leds/led1:blue:brick-status/brightness")), "0");
    let set = |color| light::set_color(&devices, "left", &color, &mut || false).unwrap();
    assert_eq!(set(Color::Named("blue")), Some(true));
    assert_eq!(text(&tree.root().join("leds/led1:blue:brick-status/brightness")), "255");
    assert_eq!(Color::named("pink"), None);
}

#[test]
fn a_battery_that_is_none_of_the_boards_is_none() {
    let tree = PlainTree::new();
    tree.named(Class::Battery, "BAT0", &[("voltage_now", "12000000")]);
    assert!(battery::battery(&tree.devices()).unwrap().is_none());
}

#[test]
fn a_file_that_a_board_does_not_have_is_an_answer_and_not_an_error() {
    let tree = PlainTree::new();
    tree.named(Class::Battery, "evb-battery", &[("voltage_now", "7412345")]);
    let battery = battery::battery(&tree.devices()).unwrap().unwrap();
    assert!((battery::volts(&battery).unwrap() - 7.412_345).abs() < 1e-9);
    assert_eq!(battery::amperes(&battery).unwrap(), None);
    assert_eq!(battery::chemistry(&battery).unwrap(), None);
    assert_eq!(battery::percent(&battery).unwrap(), None);
}

/// A port for motors with a motor in it.
fn port() -> (PlainTree, Arc<Registry>) {
    let tree = PlainTree::new();
    let files = [("mode", "auto"), ("set_device", "")];
    let port = tree.plug(Class::Port, "port4", "ev3-ports:outA", &files);
    fs::write(port.join("driver_name"), "ev3-output-port\n").unwrap();
    tree.motor("motor0", "ev3-ports:outA");
    let devices = tree.devices();
    (tree, devices)
}

#[test]
fn a_device_that_is_there_already_is_not_made_again() {
    let (tree, devices) = port();
    let set = lego_port::set_device(&devices, "outA", "lego-ev3-l-motor", &mut || false).unwrap();
    assert_eq!(set, Some(true));
    assert_eq!(text(&tree.root().join("lego-port/port4/set_device")), "");
    assert_eq!(lego_port::set_mode(&devices, "outA", "auto", &mut || false).unwrap(), Some(true));
    assert_eq!(lego_port::set_mode(&devices, "outB", "auto", &mut || false).unwrap(), None);
}

#[test]
fn an_unknown_motor_is_refused_before_anything_is_written() {
    let (tree, devices) = port();
    for name in ["lego-xl-motor", "", "rcx-motor"] {
        let error = lego_port::set_device(&devices, "outA", name, &mut || false).unwrap_err();
        assert!(matches!(error, Error::UnknownMotorType { .. }), "{error}");
    }
    assert_eq!(text(&tree.root().join("lego-port/port4/set_device")), "");
}

#[test]
fn a_device_that_does_not_appear_is_waited_for_and_that_can_be_interrupted() {
    let (tree, devices) = port();
    let mut asked = 0;
    let set = lego_port::set_mode(&devices, "outA", "dc-motor", &mut || {
        asked += 1;
        asked == 3
    });
    assert!(matches!(set, Err(Error::Interrupted)));
    assert_eq!(text(&tree.root().join("lego-port/port4/mode")), "dc-motor");
    let mut plugged = false;
    let set = lego_port::set_mode(&devices, "outA", "dc-motor", &mut || {
        if !std::mem::replace(&mut plugged, true) {
            tree.plug(Class::DcMotor, "motor0", "ev3-ports:outA", &[("command", "")]);
        }
        false
    });
    assert_eq!(set.unwrap(), Some(true));
}

#[test]
fn of_two_devices_at_one_port_the_newer_one_is_listed() {
    let tree = PlainTree::new();
    for name in ["motor2", "motor10", "motor9"] {
        tree.motor(name, "ev3-ports:outA");
    }
    tree.motor("motor3", "ev3-ports:outB");
    let all = tree.devices().all(Class::TachoMotor).unwrap();
    let listed: Vec<_> = all.iter().map(|motor| motor.path().file_name().unwrap()).collect();
    assert_eq!(listed, ["motor10", "motor3"]);
}

#[test]
fn a_light_that_is_gone_is_gone_at_once() {
    let (tree, devices) = lights(&["ev3-ports:outB::brick-status", "ev3-ports:outD::brick-status"]);
    assert_eq!(names(&devices), ["outB", "outD"]);
    tree.unplug(Class::Led, "ev3-ports:outB::brick-status");
    // Longer than a device is believed to be there.
    std::thread::sleep(std::time::Duration::from_millis(1));
    assert_eq!(names(&devices), ["outD"]);
}
