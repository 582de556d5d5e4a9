//! The registers of a sensor on the I2C bus.
//!
//! Such a sensor is a row of bytes, each with a number. The kernel's driver reads those that are
//! measurements; a program reads and writes any by the file `direct`, in which a register is an
//! offset. What goes over the bus at once is at most 32 bytes; the kernel drops what is beyond, and
//! does not say so. The file ends before register 255 (docs/ev3dev-sysfs.md, 5.1).
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::device::retry;
use crate::error::{Error, Interrupted, Result};
use crate::sensor::{is_on_bus, while_it_connects};

/// The file of the registers.
const REGISTERS: &str = "direct";

/// Reads as many registers as the buffer holds, at most 32. `None` if there is no sensor.
/// Errors: [`Error::NotOnBus`]; the bus's, after two seconds of trying where it is ENXIO, EBUSY or
/// ETIMEDOUT; [`Error::Interrupted`].
pub fn read(
    registry: &Registry,
    port: &str,
    register: u8,
    buffer: &mut [u8],
    interrupted: Interrupted,
) -> Result<Option<()>> {
    let Some(sensor) = registry.find(Class::Sensor, port)? else {
        return Ok(None);
    };
    while_it_connects(registry, &sensor, interrupted, |sensor, _| {
        check_bus(sensor)?;
        sensor.check_present()?;
        sensor.read_at(REGISTERS, buffer, register)
    })
}

/// Writes registers, at most 32, once: a sensor may act on what is written to it. `None` if there
/// is no sensor. Errors: [`Error::NotOnBus`]; the bus's; [`Error::Interrupted`].
pub fn write(
    registry: &Registry,
    port: &str,
    register: u8,
    bytes: &[u8],
    interrupted: Interrupted,
) -> Result<Option<()>> {
    retry::with(registry, Class::Sensor, port, interrupted, |sensor| {
        check_bus(sensor)?;
        sensor.write_at(REGISTERS, bytes, register)
    })
}

fn check_bus(sensor: &Device) -> Result<()> {
    if is_on_bus(sensor) {
        return Ok(());
    }
    Err(Error::NotOnBus { port: sensor.port().to_owned(), driver: sensor.driver().to_owned() })
}
