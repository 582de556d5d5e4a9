//! The gyro's angle, which goes on when its mode changes.
//!
//! Two modes measure the angle: one it alone, the other the rate, too. Older
//! gyros cannot leave the latter (docs/ev3dev-sysfs.md, 5.4). So a gyro gets into
//! it only when the rate is asked for, and stays there. A change of mode restarts
//! the angle at 0; then what the gyro had turned by before is added.
use crate::device::{Device, Turned};
use crate::error::Result;

/// The type of a gyro.
pub(crate) const DRIVER: &str = "lego-ev3-gyro";

/// The mode that measures the angle.
pub(crate) const ANGLE: &str = "GYRO-ANG";

/// The mode that measures angle and rate.
const ANGLE_AND_RATE: &str = "GYRO-G&A";

/// Another mode whose first value is that of `mode`.
pub(super) fn same_angle(mode: &str) -> Option<&'static str> {
    (mode == ANGLE).then_some(ANGLE_AND_RATE)
}

/// The mode to restart a sensor in: the present one, if its first value is that of `mode`.
pub(super) fn angle_mode_or<'a>(sensor: &Device, mode: &'a str) -> &'a str {
    if mode == ANGLE && is_in(sensor, ANGLE_AND_RATE) { ANGLE_AND_RATE } else { mode }
}

/// The mode in which a gyro measures its angle now, if it is in one and its values have settled.
pub(crate) fn angle_mode(gyro: &Device) -> Result<Option<&'static str>> {
    if !gyro.settled_at().is_zero() {
        return Ok(None);
    }
    gyro.with_word("mode", |mode| [ANGLE, ANGLE_AND_RATE].into_iter().find(|word| *word == mode))
}

/// Puts down the angle that a gyro shows before it changes into a mode.
pub(super) fn leave(sensor: &Device, mode: &str, shown: impl FnOnce() -> Result<i64>) {
    if sensor.driver() == DRIVER {
        let goes_on = mode == ANGLE_AND_RATE && is_in(sensor, ANGLE);
        let before = if goes_on { shown().ok() } else { None };
        *sensor.turned() = Turned { offset: 0, before };
    }
}

/// Lets the angle go on from where it was, once the values have settled.
pub(super) fn go_on(sensor: &Device, shown: impl FnOnce() -> Result<i64>) -> Result<()> {
    let before = sensor.turned().before;
    if let Some(before) = before {
        let offset = before - shown()?;
        *sensor.turned() = Turned { offset, before: None };
    }
    Ok(())
}

/// Makes the angle 0 after the sensor has been restarted.
pub(super) fn restart(sensor: &Device) {
    *sensor.turned() = Turned::default();
}

/// A value as the program is to see it. (In the mode of the angle alone, the offset is 0.)
pub(super) fn shown(sensor: &Device, mode: Option<&str>, index: usize, raw: i64) -> i64 {
    let is_angle = index == 0 && matches!(mode, Some(ANGLE | ANGLE_AND_RATE));
    if is_angle { raw.saturating_add(sensor.turned().offset) } else { raw }
}

fn is_in(sensor: &Device, mode: &str) -> bool {
    sensor.is_word("mode", mode).unwrap_or(false)
}
