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
use crate::value::{Value, holds_integer, integer};
use crate::{motor, sensor};

/// Reads an attribute; `None` where the device is gone. Errors: the kernel's, as EACCES for an
/// attribute that can only be written; [`Error::Malformed`](crate::Error::Malformed).
pub fn read(registry: &Registry, device: &Device, name: &str) -> Result<Option<Value>> {
    registry.read(device, |device| value(device, name))
}

/// What most attributes show.
pub enum Short<'a> {
    /// A number.
    Integer(i64),
    /// A short text, which may stand for a number, too.
    Text(&'a str),
}

/// Calls `show` with an attribute of a device that is there. `None` where that answers so,
/// or [`read`] is to be asked: it knows what else may be in the file.
pub fn look<T>(device: &Device, name: &str, show: impl FnOnce(Short) -> Option<T>) -> Option<T> {
    device.with_short(name, |text, holds_integer| match integer(text) {
        Some(integer) => show(Short::Integer(integer)),
        None if holds_integer => None,
        None => show(Short::Text(std::str::from_utf8(text).ok()?)),
    })
}

fn value(device: &Device, name: &str) -> Result<Value> {
    if device.class() == Class::Sensor {
        if let Some(index) = sensor::VALUES.iter().position(|value| *value == name) {
            return sensor::raw_value(device, index).map(Value::Integer);
        }
    }
    if holds_integer(name) {
        device.number(name).map(Value::Integer)
    } else {
        device.text(name).map(Value::parse)
    }
}

/// Writes an attribute; `None` where the device is absent.
/// Errors: the kernel's, as EINVAL for a value that is not accepted, EACCES for an attribute that
/// can only be read; [`Error::Interrupted`](crate::Error).
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
