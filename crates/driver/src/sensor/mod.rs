//! Sensors: a value in a mode.
//!
//! A sensor measures one thing at a time, named by its `mode`. Writing `mode` restarts the
//! measurement, even where nothing changes (and resets a gyro's angle), so it is written only when
//! it differs. After a real change the first values are still those of the old mode: the first read
//! waits until they have settled.
mod bin_data;
pub(crate) mod gyro;
pub mod registers;
pub mod wait;

use crate::class::Class;
use crate::device::registry::Registry;
use crate::device::retry::{Retry, until_some};
use crate::device::{Device, Use};
use crate::error::{Error, Interrupted, Result};
use crate::sysfs::sleep;
use crate::value::Value;
use ev3_os::Errno;
use std::sync::Arc;
use std::time::Duration;

/// How long values are unsettled after a change of mode, by LEGO's firmware.
const SETTLING: Duration = Duration::from_millis(10);

/// The same for the infrared sensor.
const SETTLING_INFRARED: Duration = Duration::from_millis(1100);

/// The same for a sensor on the I2C bus: the kernel reads it at once, which may take some 25 ms at
/// 9600 bits a second, and some sensors need as long again to measure something else.
const SETTLING_ON_BUS: Duration = Duration::from_millis(50);

/// How long a sensor may take to answer again after losing contact: it is
/// noticed after 0.7 s, and the sensor introduces itself again in about 1 s.
const RETRY_FOR: Duration = Duration::from_secs(2);

/// The files of the values; a sensor has at most eight.
pub(crate) const VALUES: [&str; 8] =
    ["value0", "value1", "value2", "value3", "value4", "value5", "value6", "value7"];

/// Reads value `index` of a sensor in a mode, or in its present one, scaled by the sensor's
/// decimals. `None` where the sensor is gone. Errors: [`Error::NoValue`] where the mode has no such
/// value; the kernel's, as EINVAL for a mode the sensor does not have, and after two seconds of
/// trying as ENXIO for a sensor that does not answer; [`Error::Interrupted`].
pub fn read(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: Option<&str>,
    index: usize,
    interrupted: Interrupted,
) -> Result<Option<Value>> {
    let [value] =
        read_all(registry, sensor, mode, [index], interrupted)?.map_or([None], |all| all.map(Some));
    Ok(value)
}

/// Reads several values of a sensor in a mode, as [`read`] does.
pub fn read_all<const N: usize>(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: Option<&str>,
    indices: [usize; N],
    interrupted: Interrupted,
) -> Result<Option<[Value; N]>> {
    let is_first = indices.iter().all(|index| *index == 0);
    let wanted = Wanted { mode, or: mode.filter(|_| is_first).and_then(gyro::same_angle) };
    in_mode(registry, sensor, wanted, interrupted, |sensor| {
        let mut values = [const { Value::Integer(0) }; N];
        for (value, index) in values.iter_mut().zip(indices) {
            *value = read_value(sensor, mode, index)?;
        }
        Ok(values)
    })
}

/// Reads the first `count` values of a sensor in a mode, or all that the mode has, at most eight,
/// as [`read`] does. They are of one moment where the sensor allows it, see the module `bin_data`.
pub fn read_several(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: &str,
    count: Option<usize>,
    interrupted: Interrupted,
) -> Result<Option<Vec<Value>>> {
    let wanted = Wanted::only(mode);
    in_mode(registry, sensor, wanted, interrupted, |sensor| values_in(sensor, mode, count))
}

/// The first values of a sensor that is in that mode.
fn values_in(sensor: &Device, mode: &str, count: Option<usize>) -> Result<Vec<Value>> {
    let count = match count {
        Some(count) => count,
        None => count_in(sensor, mode)?,
    };
    if let Some(decimals) = sensor.known_in("decimals", mode) {
        if let Some(raw) = bin_data::values::<{ VALUES.len() }>(sensor, mode, decimals, count)? {
            let shown = |(index, raw)| gyro::shown(sensor, Some(mode), index, raw);
            let raw = raw.into_iter().take(count).enumerate().map(shown);
            return Ok(raw.map(|raw| Value::scaled(raw, decimals)).collect());
        }
    }
    let values: Result<_> = (0..count).map(|index| read_value(sensor, Some(mode), index)).collect();
    let values = values?;
    bin_data::learn(sensor, mode)?;
    Ok(values)
}

/// How many values there are files for in a mode. A sensor that is getting into
/// contact has none; then its first value says so.
fn count_in(sensor: &Device, mode: &str) -> Result<usize> {
    let count = match sensor.known_in("num_values", mode) {
        Some(count) => count,
        None => sensor.number("num_values")?,
    };
    if count > 0 {
        sensor.know_in("num_values", mode, count);
    }
    Ok(usize::try_from(count).unwrap_or_default().clamp(1, VALUES.len()))
}

/// Puts a sensor into a mode, if it is in another, and waits until its values
/// are that mode's. `None` where the sensor is gone.
pub fn set_mode(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: &str,
    interrupted: Interrupted,
) -> Result<Option<()>> {
    in_mode(registry, sensor, Wanted::only(mode), interrupted, |_| Ok(()))
}

/// Lets a gyro measure its angle, and waits until its values are that. `None` where
/// the gyro is gone.
pub(crate) fn measure_angle(
    registry: &Registry,
    sensor: &Arc<Device>,
    interrupted: Interrupted,
) -> Result<Option<()>> {
    let wanted = Wanted { mode: Some(gyro::ANGLE), or: gyro::same_angle(gyro::ANGLE) };
    in_mode(registry, sensor, wanted, interrupted, |_| Ok(()))
}

/// Restarts a sensor in a mode, be it in that mode already or not; in the present one, if that
/// shows the same. A gyro's angle is 0 afterwards. `None` where the sensor is gone.
pub fn restart(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: &str,
    interrupted: Interrupted,
) -> Result<Option<()>> {
    while_it_connects(registry, sensor, interrupted, |sensor, interrupted| {
        write_mode(sensor, gyro::angle_mode_or(sensor, mode))?;
        gyro::restart(sensor);
        settle(registry, sensor, interrupted).map(drop)
    })
}

/// An integer of the sensor scaled as its values are in its present mode.
pub fn scale(sensor: &Device, raw: i64) -> Result<Value> {
    Ok(Value::scaled(raw, sensor.number("decimals")?))
}

/// Reads value `index` once, as it is now; the mode is that which the sensor is known to be in.
pub(crate) fn read_value(sensor: &Device, mode: Option<&str>, index: usize) -> Result<Value> {
    let raw = gyro::shown(sensor, mode, index, raw_value(sensor, index)?);
    let decimals = match mode {
        Some(mode) => sensor.constant_in("decimals", mode)?,
        None => sensor.number("decimals")?,
    };
    Ok(Value::scaled(raw, decimals))
}

/// Reads value `index` as the file has it. Errors: [`Error::NoValue`] where the present mode has no
/// such value; the kernel's, as ENXIO for a sensor that does not answer.
pub fn raw_value(sensor: &Device, index: usize) -> Result<i64> {
    let no_value = |mode: String| Error::NoValue { port: sensor.port().to_owned(), mode, index };
    let Some(attribute) = VALUES.get(index) else {
        return Err(no_value(sensor.text("mode")?));
    };
    match sensor.number(attribute) {
        Err(error) if error.errno() == Some(Errno::NXIO) => {
            // No such value in this mode, or no contact with the sensor.
            let count = sensor.number("num_values").unwrap_or_default();
            let is_beyond = count > 0 && usize::try_from(count).is_ok_and(|count| index >= count);
            Err(if is_beyond { no_value(sensor.text("mode")?) } else { error })
        }
        raw => raw,
    }
}

/// The mode that a sensor is to be in, if any.
#[derive(Clone, Copy)]
struct Wanted<'a> {
    mode: Option<&'a str>,
    /// Another mode that shows the same.
    or: Option<&'a str>,
}

impl<'a> Wanted<'a> {
    fn only(mode: &'a str) -> Self {
        Self { mode: Some(mode), or: None }
    }
}

/// Puts a sensor into a mode, if one is given, and waits for its values.
fn ensure_settled(
    registry: &Registry,
    sensor: &Device,
    wanted: Wanted,
    interrupted: Interrupted,
) -> Result<()> {
    ensure_mode(sensor, wanted)?;
    if settle(registry, sensor, interrupted)? {
        // A signal that was handled meanwhile may have read it in another mode.
        ensure_mode(sensor, wanted)?;
        settle(registry, sensor, interrupted)?;
    }
    Ok(())
}

fn ensure_mode(sensor: &Device, Wanted { mode, or }: Wanted) -> Result<()> {
    let Some(mode) = mode else {
        return Ok(());
    };
    let is_in = match or {
        None => sensor.is_word("mode", mode)?,
        Some(_) => sensor.with_word("mode", |word| word == mode || Some(word) == or)?,
    };
    if is_in { Ok(()) } else { write_mode(sensor, mode) }
}

fn write_mode(sensor: &Device, mode: &str) -> Result<()> {
    gyro::leave(sensor, mode, || raw_value(sensor, 0));
    sensor.write("mode", mode)?;
    let settling = match sensor.driver() {
        "lego-ev3-ir" => SETTLING_INFRARED,
        _ if is_on_bus(sensor) => SETTLING_ON_BUS,
        _ => SETTLING,
    };
    *sensor.settled_at() = sensor.tree().now().saturating_add(settling);
    Ok(())
}

/// Whether the sensor is on the I2C bus: then its own address is part of its port's.
fn is_on_bus(sensor: &Device) -> bool {
    sensor.port().contains(":i2c")
}

/// Waits until the values are those of the mode; `false` if they were already. If
/// the wait is interrupted, the next caller waits for the rest.
fn settle(registry: &Registry, sensor: &Device, interrupted: Interrupted) -> Result<bool> {
    let settled_at = *sensor.settled_at();
    if settled_at.is_zero() {
        return Ok(false);
    }
    sleep(registry.tree(), settled_at.saturating_sub(registry.tree().now()), interrupted)?;
    gyro::go_on(sensor, || raw_value(sensor, 0))?;
    *sensor.settled_at() = Duration::ZERO;
    Ok(true)
}

/// Waits for the right to change the sensor's mode: another thread must not change
/// it between our write of the mode and our read of the value.
fn in_use<'a>(
    registry: &Registry,
    sensor: &'a Device,
    interrupted: Interrupted,
) -> Result<Use<'a>> {
    loop {
        match sensor.try_use() {
            Some(guard) => return Ok(guard),
            None => sleep(registry.tree(), Duration::from_millis(1), interrupted)?,
        }
    }
}

/// Does something with a sensor that is in a mode, if one is given, and shows values
/// of it. `None` where the sensor is gone.
fn in_mode<T>(
    registry: &Registry,
    sensor: &Arc<Device>,
    wanted: Wanted,
    interrupted: Interrupted,
    mut act: impl FnMut(&Device) -> Result<T>,
) -> Result<Option<T>> {
    while_it_connects(registry, sensor, interrupted, |sensor, interrupted| {
        sensor.check_present()?;
        ensure_settled(registry, sensor, wanted, interrupted)?;
        act(sensor)
    })
}

/// Does something with a sensor that no other thread uses meanwhile, and repeats it
/// while the sensor is getting into contact, or udev has not opened its files yet.
/// `None` where the sensor is gone.
fn while_it_connects<T>(
    registry: &Registry,
    sensor: &Arc<Device>,
    interrupted: Interrupted,
    mut act: impl FnMut(&Arc<Device>, Interrupted) -> Result<T>,
) -> Result<Option<T>> {
    let mut sensor = Arc::clone(sensor);
    let mut connecting = Connecting::default();
    until_some(registry.tree(), interrupted, |interrupted| {
        loop {
            let done = in_use(registry, &sensor, &mut *interrupted)
                .and_then(|_using| act(&sensor, &mut *interrupted));
            let error = match done {
                Ok(value) => return Ok(Some(Some(value))),
                Err(error) => error,
            };
            // Before the listing: reading it may take its time.
            let now = registry.tree().now();
            if error.is_stale() {
                match present(registry, &sensor)? {
                    None => return Ok(Some(None)),
                    Some(other) if !Arc::ptr_eq(&other, &sensor) => {
                        sensor = other;
                        continue;
                    }
                    Some(_) if error.errno() == Some(Errno::NOENT) => return Err(error),
                    Some(_) => {}
                }
            }
            return if connecting.may_last(registry, &sensor, &error, now) {
                Ok(None)
            } else {
                Err(error)
            };
        }
    })
}

/// How long a sensor has been out of contact.
#[derive(Default)]
struct Connecting {
    since: Option<Duration>,
    permissions: Retry,
}

impl Connecting {
    /// Whether an error at this time is one that passes while a sensor gets into contact.
    fn may_last(
        &mut self,
        registry: &Registry,
        sensor: &Device,
        error: &Error,
        now: Duration,
    ) -> bool {
        let is_out_of_contact = match error.errno() {
            Some(Errno::NODEV | Errno::NXIO | Errno::BUSY | Errno::TIMEDOUT) => true,
            // A sensor that introduces itself has no mode yet, and knows none.
            Some(Errno::INVAL) => sensor.with_word("mode", str::is_empty).unwrap_or(false),
            _ => false,
        };
        if is_out_of_contact {
            now < *self.since.get_or_insert(now) + RETRY_FOR
        } else {
            self.permissions.is_worthwhile(registry, error)
        }
    }
}

/// The sensor of that type that is at the port now.
fn present(registry: &Registry, sensor: &Device) -> Result<Option<Arc<Device>>> {
    registry.forget_listings();
    let present = registry.find(Class::Sensor, sensor.port())?;
    Ok(present.filter(|present| present.driver() == sensor.driver()))
}

/// The sensor at a port, if it is one of these types; of any type where none is named.
pub fn at(registry: &Registry, port: &str, types: &[impl AsRef<str>]) -> Result<Vec<Arc<Device>>> {
    let sensor = registry.find(Class::Sensor, port)?;
    let is_meant = |sensor: &Arc<Device>| {
        types.is_empty() || types.iter().any(|kind| kind.as_ref() == sensor.driver())
    };
    Ok(sensor.into_iter().filter(is_meant).collect())
}

/// All sensors of these types; where none is named, all that have the mode.
pub fn with_mode(
    registry: &Registry,
    types: &[impl AsRef<str>],
    mode: &str,
) -> Result<Vec<Arc<Device>>> {
    let all = registry.all(Class::Sensor)?;
    let is_meant = |sensor: &&Arc<Device>| {
        if types.is_empty() {
            // A sensor whose modes cannot be read has none.
            sensor.text("modes").is_ok_and(|modes| modes.split(' ').any(|name| name == mode))
        } else {
            types.iter().any(|kind| kind.as_ref() == sensor.driver())
        }
    };
    Ok(all.iter().filter(is_meant).cloned().collect())
}
