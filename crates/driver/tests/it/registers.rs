//! The registers of sensors on the I2C bus.
use crate::brick::{Brick, ms};
use crate::files::PlainTree;
use ev3_driver::sensor::registers::{read, write};
use ev3_driver::{Class, Errno, Error, Registry};
use std::fs;
use std::sync::Arc;
use std::time::Duration;

const COMPASS: &[(&str, &[i64], i64)] = &[("COMPASS", &[90], 0)];

/// A brick with a compass on the bus at in1, and another sensor at in2.
fn brick() -> Arc<Brick> {
    let brick = Brick::new(&[]);
    brick.world().plug_sensor("in2", "lego-ev3-us", &[("US-DIST-CM", &[100], 1)]);
    plug(&brick);
    brick
}

fn plug(brick: &Brick) {
    let mut world = brick.world();
    let compass = world.plug_sensor("in1:i2c1", "ht-nxt-compass", COMPASS);
    compass.registers = (0..=254).collect();
}

fn get(
    brick: &Arc<Brick>,
    devices: &Registry,
    port: &str,
    register: u8,
) -> ev3_driver::Result<Option<[u8; 2]>> {
    let mut buffer = [0; 2];
    let read = read(devices, port, register, &mut buffer, &mut brick.attentive())?;
    Ok(read.map(|()| buffer))
}

fn put(
    brick: &Arc<Brick>,
    devices: &Registry,
    port: &str,
    register: u8,
) -> ev3_driver::Result<Option<()>> {
    write(devices, port, register, &[70, 71], &mut brick.attentive())
}

#[test]
fn registers_are_read_and_written() {
    let brick = brick();
    let devices = brick.devices();
    for port in ["in1", "in1:i2c1", "ev3-ports:in1"] {
        assert_eq!(get(&brick, &devices, port, 0x42).unwrap(), Some([0x42, 0x43]));
    }
    put(&brick, &devices, "in1", 0x42).unwrap().unwrap();
    assert_eq!(get(&brick, &devices, "in1", 0x41).unwrap(), Some([0x41, 70]));
    assert_eq!(get(&brick, &devices, "in1", 253).unwrap(), Some([253, 254]));
    let error = get(&brick, &devices, "in1", 254).unwrap_err();
    assert!(matches!(error, Error::Malformed { .. }), "{error}");
}

#[test]
fn a_sensor_that_is_not_on_the_bus_is_named() {
    let brick = brick();
    let devices = brick.devices();
    for error in
        [get(&brick, &devices, "in2", 0).unwrap_err(), put(&brick, &devices, "in2", 0).unwrap_err()]
    {
        assert_eq!(error.to_string(), "the lego-ev3-us at in2 is not on the I2C bus");
    }
    assert!(get(&brick, &devices, "in3", 0).unwrap().is_none());
    assert!(put(&brick, &devices, "in3", 0).unwrap().is_none());
}

#[test]
fn a_bus_that_fails_for_a_moment_is_read_again_but_not_written() {
    for errno in [Errno::NXIO, Errno::TIMEDOUT] {
        let brick = brick();
        let devices = brick.devices();
        brick.world().sensor("in1:i2c1").bus_error = Some((errno, ms(300)));
        assert_eq!(put(&brick, &devices, "in1", 0).unwrap_err().errno(), Some(errno));
        assert_eq!(get(&brick, &devices, "in1", 9).unwrap(), Some([9, 10]));
        assert!(brick.now() >= ms(300) && brick.now() < ms(400), "{:?}", brick.now());
    }
}

#[test]
fn a_bus_that_goes_on_failing_throws() {
    let brick = brick();
    let devices = brick.devices();
    let bus_error = |errno| Some((errno, Duration::from_secs(100)));
    brick.world().sensor("in1:i2c1").bus_error = bus_error(Errno::IO);
    assert_eq!(get(&brick, &devices, "in1", 0).unwrap_err().errno(), Some(Errno::IO));
    assert!(brick.now() < ms(20), "at once");
    brick.world().sensor("in1:i2c1").bus_error = bus_error(Errno::NXIO);
    assert_eq!(get(&brick, &devices, "in1", 0).unwrap_err().errno(), Some(Errno::NXIO));
    assert!(brick.now() >= Duration::from_secs(2) && brick.now() < ms(2200));
}

#[test]
fn a_sensor_that_was_plugged_in_again_is_found() {
    let brick = brick();
    let devices = brick.devices();
    get(&brick, &devices, "in1", 0).unwrap().unwrap();
    put(&brick, &devices, "in1", 0).unwrap().unwrap();
    brick.world().sensor("in1:i2c1").is_unplugged = true;
    assert!(get(&brick, &devices, "in1", 0).unwrap().is_none());
    assert!(put(&brick, &devices, "in1", 0).unwrap().is_none());
    plug(&brick);
    let opened = brick.now() + ms(500);
    brick.world().sensors.last_mut().unwrap().closed_until = opened;
    assert_eq!(get(&brick, &devices, "in1", 0).unwrap(), Some([0, 1]));
    assert!(brick.now() < opened);
    put(&brick, &devices, "in1", 0).unwrap().unwrap();
    assert!(brick.now() >= opened, "as udev opens the files late");
    assert_eq!(get(&brick, &devices, "in1", 0).unwrap(), Some([70, 71]));
}

#[test]
fn a_plain_file_keeps_what_is_around() {
    let tree = PlainTree::new();
    let path = tree.plug(Class::Sensor, "sensor0", "ev3-ports:in1:i2c1", &[("direct", "compass")]);
    let devices = tree.devices();
    let mut buffer = [0; 3];
    write(&devices, "in1", 2, b"MP", &mut || false).unwrap().unwrap();
    read(&devices, "in1", 1, &mut buffer, &mut || false).unwrap().unwrap();
    assert_eq!(&buffer, b"oMP");
    assert_eq!(fs::read(path.join("direct")).unwrap(), b"coMPass\n");
}
