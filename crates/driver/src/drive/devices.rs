//! The devices of a robot, and their readings.
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::drive::odometry::Wheels;
use crate::error::Result;
use crate::journal::Name;
use crate::motor::find_all;
use crate::port_name;
use crate::sensor::{self, gyro};
use crate::value::Value;
use std::sync::Arc;

/// Tolerance, in counts, beyond the fastest that a wheel can turn. A larger
/// difference means that the counter was written.
const MARGIN: f64 = 30.0;

/// The last angle that a gyro shows either way: it has 16 bits. What it shows
/// there is no angle any more.
const FULL: f64 = 32_767.0;

/// A robot: where its motors are, and how it is built.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Ports of the left and the right motor.
    pub ports: [String; 2],
    /// Its wheels.
    pub wheels: Wheels,
}

impl Robot {
    /// The ports, as the journal has them.
    pub(super) fn names(&self) -> [Name; 2] {
        self.ports.each_ref().map(|port| Name::from(port_name::short(port)))
    }
}

/// The robot's devices as they are plugged in now.
pub(super) struct DriveDevices {
    pub(super) motors: Vec<Arc<Device>>,
    pub(super) gyro: Option<Arc<Device>>,
    pub(super) counts: [i64; 2],
    pub(super) cm_per_count: [f64; 2],
    counts_per_cm: [f64; 2],
    /// Counts per second.
    pub(super) fastest: f64,
}

impl DriveDevices {
    /// The robot's devices; `None` where a motor is absent.
    pub(super) fn find(registry: &Registry, robot: &Robot) -> Result<Option<Self>> {
        let Some(motors) = find_all(registry, robot.ports.iter().map(String::as_str))? else {
            return Ok(None);
        };
        let [left, right] = &*motors else {
            return Ok(None);
        };
        let fastest = left.constant("max_speed")?.min(right.constant("max_speed")?);
        let counts = counts(&motors)?;
        let sensors = registry.all(Class::Sensor)?;
        let gyro = sensors.iter().find(|sensor| sensor.driver() == gyro::DRIVER).cloned();
        #[expect(clippy::cast_precision_loss, reason = "a motor's speed is small")]
        let fastest = fastest as f64;
        let (cm_per_count, counts_per_cm) = ([0.0; 2], [0.0; 2]);
        let mut found = Self { motors, gyro, counts, cm_per_count, counts_per_cm, fastest };
        found.measure(&robot.wheels)?;
        Ok(Some(found))
    }

    /// How far the wheels roll for a count, with the gears as they are now.
    pub(super) fn measure(&mut self, wheels: &Wheels) -> Result<()> {
        for (side, motor) in self.motors.iter().enumerate() {
            #[expect(clippy::cast_precision_loss, reason = "a rotation has a few hundred counts")]
            let counts = motor.constant("count_per_rot")? as f64 * motor.gear();
            let way = wheels.cm_per_count(side, counts);
            self.cm_per_count[side] = way;
            self.counts_per_cm[side] = 1.0 / way;
        }
        Ok(())
    }

    /// Whether the motors are still plugged in.
    pub(super) fn is_there(&self) -> bool {
        self.motors.iter().all(|motor| motor.check_present().is_ok())
    }

    /// The distances that the wheels have rolled since the previous counts. A
    /// write to a counter has not turned a wheel.
    #[expect(clippy::cast_precision_loss, reason = "a plausible difference is small")]
    pub(super) fn ways(&self, counts: [i64; 2], seconds: f64) -> [f64; 2] {
        let most = self.fastest * 1.5 * seconds + MARGIN;
        std::array::from_fn(|side| {
            let turned = counts[side].saturating_sub(self.counts[side]) as f64;
            if turned.abs() <= most { turned * self.cm_per_count[side] } else { 0.0 }
        })
    }

    /// Counts from a distance in cm, or counts per second from a speed.
    pub(super) fn in_counts(&self, ways: [f64; 2]) -> [f64; 2] {
        [ways[0] * self.counts_per_cm[0], ways[1] * self.counts_per_cm[1]]
    }
}

pub(super) fn counts(motors: &[Arc<Device>]) -> Result<[i64; 2]> {
    let mut counts = [0; 2];
    for (count, motor) in counts.iter_mut().zip(motors) {
        motor.check_present()?;
        *count = motor.number("position")?;
    }
    Ok(counts)
}

/// The gyro's angle in degrees; `None` while the gyro does not measure it, or if it is full.
pub(super) fn angle(gyro: &Arc<Device>) -> Result<Option<f64>> {
    gyro.check_present()?;
    let Some(mode) = gyro::angle_mode(gyro)? else {
        return Ok(None);
    };
    let angle = match sensor::read_value(gyro, Some(mode), 0)? {
        #[expect(clippy::cast_precision_loss, reason = "a gyro's angle has 16 bits")]
        Value::Integer(degrees) => Some(degrees as f64),
        Value::Float(degrees) => Some(degrees),
        Value::Text(_) => None,
    };
    Ok(angle.filter(|angle| angle.abs() < FULL))
}
