//! Several values at once, and sensors on the I2C bus.
use crate::brick::{Brick, ms};
use ev3_driver::sensor::{at, read_several, set_mode};
use ev3_driver::{Class, Device, Errno, Error, Registry, Value};
use std::sync::Arc;
use std::time::Duration;

const SEEKER: &[(&str, &[i64], i64)] =
    &[("DC", &[5], 0), ("AC-ALL", &[5, 0, 40, 200, 30, 0], 0), ("OTHER", &[7, 8], 0)];
const POWER: &[(&str, &[i64], i64)] = &[("ALL", &[7200, -15, 0, 1, 50, 2, 3], 3)];
const IMU: &[(&str, &[i64], i64)] = &[("GYRO", &[1, 2, 3], 1)];

/// Accesses take this long.
const ACCESS: Duration = Duration::from_micros(40);

fn sensor(devices: &Arc<Registry>, port: &str) -> Arc<Device> {
    devices.find(Class::Sensor, port).unwrap().unwrap()
}

fn brick(
    driver: &'static str,
    modes: &[(&'static str, &[i64], i64)],
) -> (Arc<Brick>, Arc<Registry>) {
    let brick = Brick::new(&[]);
    brick.world().plug_sensor("in1:i2c8", driver, modes).settling = ms(30);
    let devices = brick.devices();
    (brick, devices)
}

/// The values, and how many accesses it took to read them.
fn read(
    brick: &Arc<Brick>,
    devices: &Arc<Registry>,
    mode: &str,
    count: Option<usize>,
) -> (ev3_driver::Result<Option<Vec<Value>>>, u128) {
    let sensor = sensor(devices, "in1");
    let start = brick.now();
    let values = read_several(devices, &sensor, mode, count, &mut brick.attentive());
    (values, brick.since(start).as_micros() / ACCESS.as_micros())
}

fn integers(numbers: &[i64]) -> Vec<Value> {
    numbers.iter().copied().map(Value::Integer).collect()
}

#[test]
fn all_values_of_a_mode_come_from_one_read() {
    for format in ["u8", "s16_be"] {
        let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
        brick.world().sensor("in1:i2c8").raw_format = Some(format);
        let expected = integers(&[5, 0, 40, 200, 30, 0]);
        let (first, _) = read(&brick, &devices, "AC-ALL", None);
        assert_eq!(first.unwrap(), Some(expected.clone()));
        // Each file is opened once. Then: the mode, and the data.
        read(&brick, &devices, "AC-ALL", None).0.unwrap();
        let (again, accesses) = read(&brick, &devices, "AC-ALL", None);
        assert_eq!((again.unwrap(), accesses), (Some(expected.clone()), 2), "{format}");
        let (some, accesses) = read(&brick, &devices, "AC-ALL", Some(3));
        assert_eq!((some.unwrap(), accesses), (Some(expected[..3].to_vec()), 2));
    }
}

#[test]
fn raw_data_follow_the_values() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    brick.world().sensor("in1:i2c8").raw_format = Some("u8");
    for number in [1, 9, 200] {
        brick.world().sensor("in1:i2c8").modes[1].1[2] = number;
        let (values, _) = read(&brick, &devices, "AC-ALL", None);
        assert_eq!(values.unwrap().unwrap()[2], Value::Integer(number));
    }
}

#[test]
fn raw_data_are_scaled_by_the_decimals() {
    let (brick, devices) = brick("lego-power-storage", POWER);
    brick.world().sensor("in1:i2c8").raw_format = Some("s16_be");
    let expected = [7.2, -0.015, 0.0, 0.001, 0.05, 0.002, 0.003].map(Value::Float).to_vec();
    for _ in 0..3 {
        assert_eq!(read(&brick, &devices, "ALL", None).0.unwrap(), Some(expected.clone()));
    }
}

#[test]
fn what_the_kernel_scales_is_read_value_by_value() {
    let (brick, devices) = brick("ms-absolute-imu", IMU);
    brick.world().sensor("in1:i2c8").raw_format = Some("u8");
    for _ in 0..2 {
        read(&brick, &devices, "GYRO", None).0.unwrap();
    }
    let (values, accesses) = read(&brick, &devices, "GYRO", None);
    assert_eq!(values.unwrap(), Some([0.1, 0.2, 0.3].map(Value::Float).to_vec()));
    assert_eq!(accesses, 4, "the mode, and three values");
}

#[test]
fn a_tree_without_raw_data_is_read_value_by_value() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    for _ in 0..3 {
        let (values, _) = read(&brick, &devices, "AC-ALL", None);
        assert_eq!(values.unwrap(), Some(integers(&[5, 0, 40, 200, 30, 0])));
    }
}

#[test]
fn more_values_than_the_mode_has_are_an_error() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    brick.world().sensor("in1:i2c8").raw_format = Some("u8");
    for _ in 0..2 {
        read(&brick, &devices, "AC-ALL", None).0.unwrap();
        let (values, _) = read(&brick, &devices, "AC-ALL", Some(7));
        assert!(matches!(values, Err(Error::NoValue { index: 6, .. })), "{values:?}");
    }
    let (values, _) = read(&brick, &devices, "OTHER", None);
    assert_eq!(values.unwrap(), Some(integers(&[7, 8])));
    let (values, _) = read(&brick, &devices, "NONE", None);
    assert_eq!(values.unwrap_err().errno(), Some(Errno::INVAL));
}

#[test]
fn a_sensor_that_is_out_of_contact_is_waited_for() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    brick.world().sensor("in1:i2c8").raw_format = Some("u8");
    for _ in 0..3 {
        read(&brick, &devices, "AC-ALL", None).0.unwrap();
    }
    let back = brick.now() + ms(700);
    brick.world().sensor("in1:i2c8").out_of_contact_until = back;
    let (values, _) = read(&brick, &devices, "AC-ALL", None);
    assert_eq!(values.unwrap(), Some(integers(&[5, 0, 40, 200, 30, 0])));
    assert!(brick.now() >= back);
    brick.world().sensor("in1:i2c8").out_of_contact_until = Duration::MAX;
    let (values, _) = read(&brick, &devices, "AC-ALL", None);
    assert!(values.unwrap_err().errno().is_some());
}

#[test]
fn a_sensor_on_the_bus_is_found_by_its_socket() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    brick.world().plug_sensor("in2", "lego-ev3-ir", &[("IR-PROX", &[70], 0)]);
    for port in ["in1", "ev3-ports:in1", "in1:i2c8", "ev3-ports:in1:i2c8"] {
        assert_eq!(sensor(&devices, port).port(), "in1:i2c8");
        assert_eq!(at(&devices, port, &["ht-nxt-ir-seek-v2"]).unwrap().len(), 1);
    }
    assert!(devices.find(Class::Sensor, "in1:i2c1").unwrap().is_none());
    assert!(devices.find(Class::Sensor, "in3").unwrap().is_none());
    brick.world().plug_sensor("in1:i2c1", "lego-nxt-us", &[("US-DIST-CM", &[70], 0)]);
    brick.pass(ms(200));
    assert_eq!(sensor(&devices, "in1").port(), "in1:i2c1", "of two the first");
    assert_eq!(sensor(&devices, "in1:i2c8").driver(), "ht-nxt-ir-seek-v2");
    brick.world().plug_sensor("in1", "lego-ev3-us", &[("US-DIST-CM", &[700], 1)]);
    brick.pass(ms(200));
    assert_eq!(sensor(&devices, "in1").driver(), "lego-ev3-us", "the very port comes first");
}

#[test]
fn a_new_mode_on_the_bus_is_given_time() {
    let (brick, devices) = brick("ht-nxt-ir-seek-v2", SEEKER);
    let seeker = sensor(&devices, "in1");
    let start = brick.now();
    set_mode(&devices, &seeker, "AC-ALL", &mut brick.attentive()).unwrap().unwrap();
    assert!(brick.since(start) >= ms(50) && brick.since(start) < ms(80));
}
