//! Sensors: values in modes, and sensors that are not ready to give them.
use crate::brick::{Brick, World, ms};
use ev3_driver::sensor::{at, raw_value, read, read_all, restart, scale, set_mode, with_mode};
use ev3_driver::{Class, Device, Errno, Error, Registry, Value, attributes};
use std::sync::Arc;
use std::time::Duration;

const COLOR: &[(&str, &[i64], i64)] =
    &[("COL-REFLECT", &[40], 0), ("COL-COLOR", &[5], 0), ("RGB-RAW", &[10, 20, 30], 0)];
const ULTRASONIC: &[(&str, &[i64], i64)] = &[("US-DIST-CM", &[2550], 1), ("US-LISTEN", &[1], 0)];
const INFRARED: &[(&str, &[i64], i64)] = &[("IR-PROX", &[70], 0), ("IR-SEEK", &[-3, 50], 0)];

fn plug_color(world: &mut World) {
    world.plug_sensor("in1", "lego-ev3-color", COLOR);
}

fn brick() -> Arc<Brick> {
    let brick = Brick::new(&[]);
    plug_color(&mut brick.world());
    brick.world().plug_sensor("in2", "lego-ev3-us", ULTRASONIC);
    brick.world().plug_sensor("in4", "lego-ev3-ir", INFRARED);
    brick
}

fn sensor(devices: &Arc<Registry>, port: &str) -> Arc<Device> {
    devices.find(Class::Sensor, port).unwrap().unwrap()
}

/// Reads a value, or says why not.
fn value(
    brick: &Arc<Brick>,
    devices: &Arc<Registry>,
    port: &str,
    mode: &str,
    index: usize,
) -> ev3_driver::Result<Option<Value>> {
    read(devices, &sensor(devices, port), Some(mode), index, &mut brick.attentive())
}

#[expect(clippy::unnecessary_wraps, reason = "what a read answers")]
fn integer(number: i64) -> Option<Value> {
    Some(Value::Integer(number))
}

#[test]
fn the_mode_is_written_only_when_it_differs() {
    let brick = brick();
    let devices = brick.devices();
    for _ in 0..3 {
        assert_eq!(value(&brick, &devices, "in1", "COL-REFLECT", 0).unwrap(), integer(40));
    }
    assert!(brick.take_written().is_empty());
    for _ in 0..3 {
        assert_eq!(value(&brick, &devices, "in1", "COL-COLOR", 0).unwrap(), integer(5));
    }
    assert_eq!(brick.take_written(), ["in1 mode COL-COLOR"]);
}

#[test]
fn the_present_mode_is_read_without_writing_any() {
    let brick = brick();
    let devices = brick.devices();
    let sensor = sensor(&devices, "in1");
    set_mode(&devices, &sensor, "RGB-RAW", &mut brick.attentive()).unwrap().unwrap();
    brick.take_written();
    let blue = read(&devices, &sensor, None, 2, &mut brick.attentive()).unwrap();
    assert_eq!((blue, brick.take_written().len()), (integer(30), 0));
}

#[test]
fn unsettled_values_are_waited_out_once() {
    for (port, driver_time, mode, expected) in
        [("in1", ms(10), "COL-COLOR", 5), ("in4", ms(1100), "IR-SEEK", -3)]
    {
        let brick = brick();
        brick.world().sensor(port).settling = driver_time;
        let devices = brick.devices();
        assert_eq!(value(&brick, &devices, port, mode, 0).unwrap(), integer(expected));
        let changed = brick.now();
        assert!(changed >= driver_time && changed < driver_time + ms(10), "{changed:?}");
        assert_eq!(value(&brick, &devices, port, mode, 0).unwrap(), integer(expected));
        assert!(brick.since(changed) < ms(1));
    }
}

#[test]
fn unsettled_values_are_not_read_after_an_interrupted_wait_either() {
    let brick = brick();
    brick.world().sensor("in4").settling = ms(1100);
    let devices = brick.devices();
    let infrared = sensor(&devices, "in4");
    let interrupt = &mut brick.interrupting(ms(100));
    let error = read(&devices, &infrared, Some("IR-SEEK"), 0, interrupt).unwrap_err();
    assert!(matches!(error, Error::Interrupted));
    assert_eq!(value(&brick, &devices, "in4", "IR-SEEK", 0).unwrap(), integer(-3));
    assert_eq!(brick.take_written(), ["in4 mode IR-SEEK"]);
}

#[test]
fn values_are_scaled_by_the_decimals_of_their_mode() {
    let brick = brick();
    let devices = brick.devices();
    for _ in 0..2 {
        let distance = value(&brick, &devices, "in2", "US-DIST-CM", 0).unwrap();
        assert_eq!(distance, Some(Value::Float(255.0)));
        assert_eq!(value(&brick, &devices, "in2", "US-LISTEN", 0).unwrap(), integer(1));
    }
    let ultrasonic = sensor(&devices, "in2");
    assert_eq!(scale(&ultrasonic, 25).unwrap(), Value::Integer(25));
    assert_eq!(raw_value(&ultrasonic, 0).unwrap(), 1);
}

#[test]
fn several_values_are_of_one_mode() {
    let brick = brick();
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    let rgb =
        read_all(&devices, &color, Some("RGB-RAW"), [0, 1, 2], &mut brick.attentive()).unwrap();
    assert_eq!(rgb, Some([10, 20, 30].map(Value::Integer)));
}

#[test]
fn a_value_that_the_mode_does_not_have_is_an_error_at_once() {
    let brick = brick();
    let devices = brick.devices();
    for index in [1, 7, 8, usize::MAX] {
        let error = value(&brick, &devices, "in1", "COL-REFLECT", index).unwrap_err();
        let Error::NoValue { port, mode, index: no } = &error else { panic!("{error}") };
        assert_eq!((&**port, &**mode, *no), ("in1", "COL-REFLECT", index));
    }
    assert!(brick.now() < ms(5));
}

#[test]
fn a_mode_that_the_sensor_does_not_have_is_an_error_at_once() {
    let brick = brick();
    let devices = brick.devices();
    let error = value(&brick, &devices, "in1", "GYRO-ANG", 0).unwrap_err();
    assert_eq!(error.errno(), Some(Errno::INVAL));
    assert!(brick.now() < ms(5), "{:?}", brick.now());
}

#[test]
fn a_restart_writes_the_mode_even_if_it_is_the_same() {
    let brick = brick();
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    for _ in 0..2 {
        restart(&devices, &color, "COL-REFLECT", &mut brick.attentive()).unwrap().unwrap();
    }
    assert_eq!(brick.take_written(), ["in1 mode COL-REFLECT", "in1 mode COL-REFLECT"]);
}

#[test]
fn a_mode_written_as_an_attribute_is_written_only_when_it_differs_and_waited_out() {
    let brick = brick();
    let devices = brick.devices();
    let write = |mode| {
        let asked = &mut brick.attentive();
        attributes::write(&devices, Class::Sensor, "in1", "mode", mode, asked).unwrap().unwrap();
    };
    write("COL-REFLECT");
    assert!(brick.take_written().is_empty());
    write("COL-COLOR");
    assert_eq!(attributes::read(&devices, &sensor(&devices, "in1"), "value0").unwrap(), integer(5));
}

#[test]
fn a_sensor_without_contact_is_waited_for() {
    for refusal in [Errno::NODEV, Errno::INVAL, Errno::BUSY, Errno::TIMEDOUT] {
        for mode in ["COL-REFLECT", "COL-COLOR"] {
            let brick = brick();
            let devices = brick.devices();
            value(&brick, &devices, "in1", "COL-REFLECT", 0).unwrap();
            brick.world().sensor("in1").out_of_contact_until = ms(1500);
            brick.world().sensor("in1").refuses_mode_with = refusal;
            let expected = if mode == "COL-COLOR" { 5 } else { 40 };
            let read = value(&brick, &devices, "in1", mode, 0).unwrap();
            assert_eq!(read, integer(expected), "{mode} after {refusal}");
            assert!(brick.now() < ms(1560), "{:?}", brick.now());
        }
    }
}

#[test]
fn a_sensor_without_contact_is_waited_for_two_seconds_and_no_longer() {
    let brick = brick();
    brick.world().sensor("in1").out_of_contact_until = Duration::from_secs(100);
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    for mode in [None, Some("COL-COLOR")] {
        let started = brick.now();
        let error = read(&devices, &color, mode, 0, &mut brick.attentive()).unwrap_err();
        let expected = if mode.is_none() { Errno::NXIO } else { Errno::NODEV };
        assert_eq!(error.errno(), Some(expected));
        let waited = brick.since(started);
        assert!(waited >= ms(2000) && waited < ms(2050), "{waited:?}");
    }
}

#[test]
fn the_wait_for_a_sensor_can_be_interrupted() {
    let brick = brick();
    brick.world().sensor("in1").out_of_contact_until = Duration::from_secs(100);
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    let interrupt = &mut brick.interrupting(ms(100));
    let error = read(&devices, &color, None, 0, interrupt).unwrap_err();
    assert!(matches!(error, Error::Interrupted));
    assert!(brick.now() < ms(150));
}

#[test]
fn files_that_udev_has_not_opened_yet_are_waited_for_one_second_from_the_plug_in() {
    for (opened, can_write) in [(ms(700), true), (ms(5000), false)] {
        let (brick, devices) = Brick::with_devices(&[]);
        plug_color(&mut brick.world());
        brick.world().sensor("in1").closed_until = opened;
        let read = value(&brick, &devices, "in1", "COL-COLOR", 0);
        if can_write {
            assert_eq!(read.unwrap(), integer(5));
        } else {
            assert_eq!(read.unwrap_err().errno(), Some(Errno::ACCESS));
            assert!(brick.now() >= ms(1000) && brick.now() < ms(1050), "{:?}", brick.now());
            value(&brick, &devices, "in1", "COL-COLOR", 0).unwrap_err();
            assert!(brick.now() < ms(1100), "refused at once from now on");
        }
    }
}

#[test]
fn a_sensor_that_is_unplugged_is_no_sensor() {
    let brick = brick();
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    assert_eq!(value(&brick, &devices, "in1", "COL-REFLECT", 0).unwrap(), integer(40));
    brick.world().sensor("in1").is_unplugged = true;
    let started = brick.now();
    let asked = &mut brick.attentive();
    assert_eq!(read(&devices, &color, Some("COL-REFLECT"), 0, asked).unwrap(), None);
    assert_eq!(set_mode(&devices, &color, "COL-COLOR", asked).unwrap(), None);
    assert_eq!(restart(&devices, &color, "COL-COLOR", asked).unwrap(), None);
    assert!(brick.since(started) < ms(5));
}

#[test]
fn a_sensor_that_is_replaced_by_its_like_is_found_again() {
    let brick = brick();
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    let asked = &mut brick.attentive();
    assert_eq!(read(&devices, &color, Some("COL-COLOR"), 0, asked).unwrap(), integer(5));
    brick.world().sensor("in1").is_unplugged = true;
    plug_color(&mut brick.world());
    brick.world().sensor("in1").modes[1].1 = vec![7];
    assert_eq!(read(&devices, &color, Some("COL-COLOR"), 0, asked).unwrap(), integer(7));
    assert_eq!(brick.take_written().len(), 2, "the new one was put into the mode, too");
}

#[test]
fn a_sensor_that_is_replaced_by_another_type_is_gone() {
    let brick = brick();
    let devices = brick.devices();
    let color = sensor(&devices, "in1");
    let asked = &mut brick.attentive();
    read(&devices, &color, None, 0, asked).unwrap();
    brick.world().sensor("in1").is_unplugged = true;
    brick.world().plug_sensor("in1", "lego-ev3-us", ULTRASONIC);
    assert_eq!(read(&devices, &color, None, 0, asked).unwrap(), None);
}

#[test]
fn a_sensor_unplugged_while_its_values_settle_is_gone() {
    let brick = brick();
    let devices = brick.devices();
    brick.at(ms(500), |world| world.sensor("in4").is_unplugged = true);
    assert_eq!(value(&brick, &devices, "in4", "IR-SEEK", 0).unwrap(), None);
}

#[test]
fn threads_that_want_different_modes_each_read_their_own() {
    let brick = brick();
    let devices = &brick.devices();
    std::thread::scope(|scope| {
        for (mode, expected) in [("COL-REFLECT", 40), ("COL-COLOR", 5), ("RGB-RAW", 10)] {
            scope.spawn(move || {
                let color = sensor(devices, "in1");
                for _ in 0..50 {
                    let value = read(devices, &color, Some(mode), 0, &mut || false);
                    assert_eq!(value.unwrap(), integer(expected), "in {mode}");
                }
            });
        }
    });
}

#[test]
fn sensors_are_found_by_type_or_by_mode() {
    let brick = brick();
    let devices = brick.devices();
    let ports = |sensors: Vec<Arc<Device>>| -> Vec<String> {
        sensors.iter().map(|sensor| sensor.port().to_owned()).collect()
    };
    let types = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
    assert_eq!(ports(with_mode(&devices, &[""; 0], "US-LISTEN").unwrap()), ["in2"]);
    assert_eq!(ports(with_mode(&devices, &[""; 0], "US").unwrap()), [""; 0]);
    let meant = types(&["lego-ev3-ir", "lego-ev3-color"]);
    assert_eq!(ports(with_mode(&devices, &meant, "X").unwrap()), ["in1", "in4"]);
    assert_eq!(ports(at(&devices, "ev3-ports:in1", &[""; 0]).unwrap()), ["in1"]);
    assert_eq!(ports(at(&devices, "in1", &types(&["lego-ev3-us"])).unwrap()), [""; 0]);
    assert_eq!(ports(at(&devices, "in3", &[""; 0]).unwrap()), [""; 0]);
}
