//! Any attribute of any device, by its name.
//!
//! Most are read and written as they are. A few mean more: a motor's `command`
//! starts something that must be stopped at the end, a sensor's `mode` is
//! written only when it differs and then needs time to settle.
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::device::retry;
use crate::error::{Interrupted, Result};
use crate::value::Value;
use crate::{motor, sensor};

/// Attributes that hold an integer and nothing else.
const INTEGERS: [&str; 25] = [
    "count_per_m",
    "count_per_rot",
    "decimals",
    "duty_cycle",
    "duty_cycle_sp",
    "full_travel_count",
    "hold_pid/Kd",
    "hold_pid/Ki",
    "hold_pid/Kp",
    "max_pulse_sp",
    "max_speed",
    "mid_pulse_sp",
    "min_pulse_sp",
    "num_values",
    "position",
    "position_sp",
    "ramp_down_sp",
    "ramp_up_sp",
    "rate_sp",
    "speed",
    "speed_pid/Kd",
    "speed_pid/Ki",
    "speed_pid/Kp",
    "speed_sp",
    "time_sp",
];

/// Reads an attribute; `None` where the device is gone.
///
/// # Errors
/// The kernel's, as EACCES for an attribute that can only be written;
/// [`Error::Malformed`](crate::Error::Malformed).
pub fn read(registry: &Registry, device: &Device, name: &str) -> Result<Option<Value>> {
    registry.read(device, |device| value(device, name))
}

fn value(device: &Device, name: &str) -> Result<Value> {
    let index = sensor::VALUES.iter().position(|value| *value == name);
    match (device.class(), index) {
        (Class::Sensor, Some(index)) => sensor::raw_value(device, index).map(Value::Integer),
        _ if INTEGERS.contains(&name) => device.number(name).map(Value::Integer),
        _ => device.text(name).map(Value::parse),
    }
}

/// Writes an attribute; `None` where the device is absent.
///
/// # Errors
/// The kernel's, as EINVAL for a value that is not accepted, EACCES for an
/// attribute that can only be read; [`Error::Interrupted`](crate::Error).
pub fn write(
    registry: &Registry,
    class: Class,
    port: &str,
    name: &str,
    text: &str,
    interrupted: Interrupted,
) -> Result<Option<()>> {
    if (class, name) == (Class::Sensor, "mode") {
        return match registry.find(class, port)? {
            Some(sensor) => sensor::set_mode(registry, &sensor, text, interrupted),
            None => Ok(None),
        };
    }
    retry::with(registry, class, port, interrupted, |device| match name {
        "command" if Class::MOTORS.contains(&class) => motor::command(device, text),
        "position" if class == Class::TachoMotor => {
            device.without_counting(&mut || device.write(name, text))
        }
        _ => device.write(name, text),
    })
}
