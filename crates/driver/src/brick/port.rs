//! Ports themselves: class `lego-port`.
//!
//! Most devices are detected when they are plugged in. The others, as a motor without rotation
//! sensor, appear when their port is put into a *mode*; and a program may set which of several
//! types is plugged in. Both make a new device, even where nothing changes. So these functions
//! write only where something changes, and wait for the device.
use crate::brick::light;
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::device::retry;
use crate::device::retry::until_some;
use crate::error::{Error, Interrupted, Result};
use std::sync::Arc;
use std::time::Duration;

/// How long a device may take to appear and to be open to us: a serial sensor introduces itself in
/// about 1.5 s, an I2C sensor is given 1 s to boot, and udev may take another second.
pub const APPEARS_WITHIN: Duration = Duration::from_secs(4);

/// How long a port takes to detect what is plugged in: 0.4 s.
const DETECTED_WITHIN: Duration = Duration::from_millis(600);

/// What a port's status is while nothing is detected.
const NOTHING: [&str; 2] = ["no-motor", "no-sensor"];

/// The classes of devices that are on ports.
const ON_PORTS: [Class; 4] = [Class::TachoMotor, Class::DcMotor, Class::ServoMotor, Class::Sensor];

/// The types of tacho motors that can be set on an output port (`ev3_motor_defs.c`).
const MOTOR_TYPES: [&str; 5] =
    ["lego-ev3-l-motor", "lego-ev3-m-motor", "lego-nxt-motor", "act-l12-ev3-50", "act-l12-ev3-100"];

/// The class of the device that a mode of a port always makes.
/// In other modes it depends on the detected device, or on the one that was set.
fn made_by(mode: &str) -> Option<Class> {
    match mode {
        "tacho-motor" => Some(Class::TachoMotor),
        "dc-motor" => Some(Class::DcMotor),
        "led" => Some(Class::Led),
        "nxt-analog" | "ev3-analog" => Some(Class::Sensor),
        _ => None,
    }
}

/// The devices at a port, or at all ports in their order, of whichever class.
pub fn devices_at(registry: &Registry, port: Option<&str>) -> Result<Vec<Arc<Device>>> {
    let mut all = Vec::new();
    for class in ON_PORTS {
        all.extend(registry.all(class)?.iter().cloned());
    }
    let port = port.map(crate::port_name::short);
    all.retain(|device| port.is_none_or(|port| device.port() == port));
    all.sort_unstable_by(|a, b| crate::port_name::order(a.port(), b.port()));
    Ok(all)
}

fn device_at(registry: &Registry, port: &str) -> Result<Option<Arc<Device>>> {
    for class in ON_PORTS {
        if let Some(device) = registry.find(class, port)? {
            return Ok(Some(device));
        }
    }
    Ok(None)
}

/// Puts a port into a mode, if it is in another, and waits until the device that the mode makes is
/// there and can be written. The mode `auto` makes none, but looks for one: what is detected is
/// waited for. `None` if there is no such port, `false` if that device does not appear.
/// Errors: the kernel's, as EINVAL for a mode the port does not have; [`Error::Interrupted`].
pub fn set_mode(
    registry: &Registry,
    port: &str,
    mode: &str,
    interrupted: Interrupted,
) -> Result<Option<bool>> {
    let written = retry::with(registry, Class::Port, port, &mut *interrupted, |port| {
        let is_new = !port.with_word("mode", |present| present == mode)?;
        if is_new {
            port.write("mode", mode)?;
            registry.forget_listings();
        }
        Ok(is_new)
    })?;
    let Some(is_new) = written else {
        return Ok(None);
    };
    if mode == "auto" && is_new && detects(registry, port, &mut *interrupted)? {
        let find = || device_at(registry, port);
        return wait_for(registry, find, interrupted).map(|_| Some(true));
    }
    let Some(class) = made_by(mode) else { return Ok(Some(true)) };
    let find = || match class {
        Class::Led => light::on_port(registry, port),
        class => registry.find(class, port),
    };
    wait_for(registry, find, interrupted).map(Some)
}

/// Waits until a port has detected something; `false` if there is nothing, or no
/// device that could come of it.
fn detects(registry: &Registry, port: &str, interrupted: Interrupted) -> Result<bool> {
    let Some(port) = registry.find(Class::Port, port)? else {
        return Ok(false);
    };
    let latest = registry.tree().now().saturating_add(DETECTED_WITHIN);
    until_some(registry.tree(), interrupted, |_| {
        let (is_empty, makes) = port.with_word("status", |status| {
            (NOTHING.contains(&status), !matches!(status, "error" | "nxt-color"))
        })?;
        let is_late = registry.tree().now() >= latest;
        Ok((!is_empty || is_late).then_some(!is_empty && makes))
    })
}

/// Sets the device of a port, if another one is there, and waits until that one is there and can be
/// written. `None` if there is no such port, `false` if the device does not appear.
/// Errors: [`Error::UnknownMotorType`] for a type that no output port has; the kernel's, as
/// EOPNOTSUPP where the port has no device to set; [`Error::Interrupted`].
pub fn set_device(
    registry: &Registry,
    port: &str,
    name: &str,
    interrupted: Interrupted,
) -> Result<Option<bool>> {
    // On I2C an address follows.
    let driver = name.split(' ').next().unwrap_or(name);
    let is_it = |device: &Arc<Device>| device.driver() == driver;
    let written = retry::with(registry, Class::Port, port, &mut *interrupted, |lego_port| {
        // An unknown name would take away the motor that is there.
        let is_output =
            lego_port.driver().ends_with("output-port") || lego_port.driver().ends_with("out-port");
        if driver.is_empty() || is_output && !MOTOR_TYPES.contains(&driver) {
            return Err(Error::UnknownMotorType { name: name.to_owned() });
        }
        if !device_at(registry, port)?.as_ref().is_some_and(is_it) {
            lego_port.write("set_device", name)?;
            registry.forget_listings();
        }
        Ok(())
    })?;
    if written.is_none() {
        return Ok(None);
    }
    let find = || Ok(device_at(registry, port)?.filter(is_it));
    wait_for(registry, find, interrupted).map(Some)
}

/// Waits until any device, or one of a certain type, is at a port and can be written; `false` if
/// that takes too long. Errors: the kernel's; [`Error::Interrupted`].
fn wait_for(
    registry: &Registry,
    find: impl Fn() -> Result<Option<Arc<Device>>>,
    interrupted: Interrupted,
) -> Result<bool> {
    let latest = registry.tree().now().saturating_add(APPEARS_WITHIN);
    until_some(registry.tree(), interrupted, |_| {
        if find()?.is_some_and(|device| device.is_writable()) {
            return Ok(Some(true));
        }
        Ok((registry.tree().now() >= latest).then_some(false))
    })
}
