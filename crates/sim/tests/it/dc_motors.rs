//! `dc-motor`: duty and nothing else (`docs/ev3dev-sysfs.md`, 4.1).
use crate::desk::Desk;
use crate::robots::default_robot;
use ev3_sim::{Errno, Item, Port, Pose, WorldSpec};

const M: &str = "dc-motor/motor0/";

/// outA's medium motor, driven as a plain one.
fn desk() -> Desk {
    let mut desk = Desk::new();
    desk.put("lego-port/port4/mode", "dc-motor");
    desk.step(500);
    desk
}

fn file(name: &str) -> String {
    format!("{M}{name}")
}

#[test]
fn files_after_the_mode_was_written() {
    let mut desk = desk();
    assert_eq!(desk.try_get("tacho-motor/motor0/state"), Err(Errno::ENOENT));
    let texts = [
        ("address", "ev3-ports:outA"),
        ("driver_name", "rcx-motor"),
        ("commands", "run-forever run-timed run-direct stop"),
        ("stop_actions", "coast brake"),
        ("duty_cycle", "0"),
        ("duty_cycle_sp", "0"),
        ("polarity", "normal"),
        ("ramp_up_sp", "0"),
        ("ramp_down_sp", "0"),
        ("time_sp", "0"),
        ("state", ""),
    ];
    for (name, text) in texts {
        assert_eq!(desk.get(&file(name)), text, "{name}");
    }
    assert_eq!(desk.try_get(&file("stop_action")), Err(Errno::EACCES), "write-only");
    assert_eq!(desk.get("lego-port/port4/status"), "dc-motor");
    let refused = [
        ("command", "reset", Errno::EINVAL),
        ("stop_action", "hold", Errno::EINVAL),
        ("duty_cycle_sp", "101", Errno::EINVAL),
        ("time_sp", "60001", Errno::EINVAL),
        ("time_sp", "99999999999", Errno::ERANGE),
        ("ramp_up_sp", "10001", Errno::EINVAL),
        ("ramp_up_sp", "-1", Errno::EINVAL),
    ];
    for (name, text, errno) in refused {
        assert_eq!(desk.try_put(&file(name), text), Err(errno), "{name} <- {text}");
    }
    desk.put(&file("ramp_up_sp"), " 12 ms");
    assert_eq!(desk.get(&file("ramp_up_sp")), "12", "junk behind the digits is taken");
}

#[test]
fn ramping_shows_for_110_ms_and_makes_others_wait() {
    let mut desk = desk();
    desk.put(&file("duty_cycle_sp"), 60);
    assert_eq!(desk.get(&file("state")), "");
    desk.put(&file("command"), "run-forever");
    assert_eq!(desk.get(&file("state")), "running ramping");
    assert_eq!(desk.number(&file("duty_cycle")), 60);
    desk.put(&file("command"), "stop");
    assert_eq!(desk.get(&file("state")), "running ramping", "the stop waits for the step");
    desk.step(110);
    assert_eq!(desk.get(&file("state")), "");
    desk.put(&file("command"), "run-forever");
    desk.step(108);
    assert_eq!(desk.get(&file("state")), "running ramping");
    desk.step(2);
    assert_eq!(desk.get(&file("state")), "running");
    desk.put(&file("command"), "run-direct");
    assert_eq!(desk.get(&file("state")), "running", "no step for the same duty");
    desk.put(&file("command"), "stop");
    assert_eq!(desk.get(&file("state")), "", "at once when no step is scheduled");
}

#[test]
fn it_turns_the_motor_that_is_plugged_in() {
    let mut desk = desk();
    desk.put(&file("polarity"), "inversed");
    desk.put(&file("duty_cycle_sp"), 50);
    desk.put(&file("time_sp"), 500);
    desk.put(&file("command"), "run-timed");
    desk.step(490);
    assert_eq!(desk.get(&file("state")), "running");
    assert_eq!(desk.number(&file("duty_cycle")), 50, "in the sign of the program");
    assert!(desk.0.shaft_angle(Port::OutA) < -100.0);
    desk.step(20);
    assert_eq!(desk.get(&file("state")), "");
}

#[test]
fn a_timed_run_that_ends_with_a_step_of_its_ramp_stops_in_that_step() {
    for (ramp, time) in [(1000, 100), (2000, 210), (10_000, 320), (10_000, 540)] {
        let mut desk = desk();
        desk.put(&file("ramp_up_sp"), ramp);
        desk.put(&file("duty_cycle_sp"), 100);
        desk.put(&file("time_sp"), time);
        desk.put(&file("command"), "run-timed");
        let mut took = 0;
        while !desk.get(&file("state")).is_empty() {
            desk.step(2);
            took += 2;
        }
        assert!((time..=time + 10).contains(&took), "{time} ms took {took}");
    }
}

#[test]
fn ramps_follow_the_signed_duty() {
    let mut desk = desk();
    desk.put(&file("ramp_down_sp"), 1000);
    desk.put(&file("duty_cycle_sp"), -50);
    desk.put(&file("command"), "run-direct");
    assert_eq!(desk.number(&file("duty_cycle")), 0, "the first step comes at once");
    desk.step(120);
    assert_eq!(desk.number(&file("duty_cycle")), -11, "backwards is down");
    desk.step(110);
    assert_eq!(desk.number(&file("duty_cycle")), -22);
    desk.put(&file("duty_cycle_sp"), 0);
    desk.step(110);
    assert_eq!(desk.number(&file("duty_cycle")), 0, "up has no ramp");
    assert!(desk.get(&file("state")).starts_with("running"), "also with duty 0");
}

#[test]
fn a_lamp_on_a_port_is_seen_as_bright_as_the_port_drives_it() {
    let mut robot = default_robot();
    robot.sensors[1].pose = Pose::new(0.0, 0.0, 0.0);
    let bulb = Item::Bulb { at: [0.0, 50.0], intensity: 12.0, port: Port::OutD };
    let world = WorldSpec { ambient: 0.0, items: vec![bulb], ..WorldSpec::default() };
    let mut desk = Desk::with(&world, &robot);
    desk.put("lego-sensor/sensor1/mode", "COL-AMBIENT");
    desk.step(50);
    let light = |desk: &mut Desk| {
        desk.step(20);
        desk.number("lego-sensor/sensor1/value0")
    };
    assert_eq!(light(&mut desk), 0, "nobody drives it");
    desk.put("lego-port/port7/mode", "dc-motor");
    desk.step(500);
    desk.put("dc-motor/motor0/duty_cycle_sp", -50);
    desk.put("dc-motor/motor0/command", "run-forever");
    assert_eq!(light(&mut desk), 19, "a lamp has no direction");
    desk.put("dc-motor/motor0/duty_cycle_sp", 100);
    assert_eq!(light(&mut desk), 19, "not before the next command");
    desk.step(100);
    desk.put("dc-motor/motor0/command", "run-forever");
    assert_eq!(light(&mut desk), 38);
    desk.put("lego-port/port7/mode", "led");
    assert_eq!(light(&mut desk), 38, "lit with the PWM that the motor left");
    assert_eq!(desk.number("leds/ev3-ports:outD::brick-status/brightness"), 100);
    desk.put("lego-port/port7/mode", "led");
    assert_eq!(light(&mut desk), 0, "a light leaves none");
    desk.step(500);
    desk.put("leds/ev3-ports:outD::brick-status/brightness", 50);
    assert_eq!(light(&mut desk), 19);
    let impossible = Item::Bulb { at: [0.0, 0.0], intensity: 1.0, port: Port::In1 };
    assert!(impossible.validate().is_err());
}

#[test]
fn a_port_can_be_a_light() {
    let mut desk = desk();
    desk.put("lego-port/port7/mode", "led");
    let light = "leds/ev3-ports:outD::brick-status/brightness";
    assert_eq!(desk.number(light), 0);
    desk.step(500);
    desk.put(light, 255);
    assert_eq!(desk.number(light), 100);
}

#[test]
fn a_run_that_does_not_change_the_duty_is_no_run() {
    let mut desk = desk();
    desk.put(&file("command"), "run-forever");
    assert_eq!(desk.get(&file("state")), "");
    desk.put(&file("duty_cycle_sp"), i32::MIN);
    assert_eq!(desk.number(&file("duty_cycle_sp")), i32::MIN);
}

#[test]
fn the_bridge_outlives_the_motor_that_drove_it() {
    let mut desk = Desk::new();
    desk.run("tacho-motor/motor0/", &[("duty_cycle_sp", -40)], "run-direct");
    desk.put("lego-port/port4/mode", "dc-motor");
    assert_eq!(desk.get(&file("state")), "running");
    assert_eq!(desk.number(&file("duty_cycle")), -40);
    desk.step(500);
    assert!(desk.0.shaft_angle(Port::OutA) < -50.0, "it turns on");
    desk.put("lego-port/port4/mode", "tacho-motor");
    desk.step(2000);
    let at = desk.0.shaft_angle(Port::OutA);
    desk.step(1000);
    assert!((desk.0.shaft_angle(Port::OutA) - at).abs() < 1e-9, "the tacho driver lets go");
}
