//! Waiting until a sensor shows what the program waits for.
use crate::device::Device;
use crate::device::registry::Registry;
use crate::error::{Interrupted, Result};
use crate::sensor::read;
use crate::sysfs::sleep;
use crate::value::Value;
use std::sync::Arc;
use std::time::Duration;

/// The time between two samples. The EV3's sensors measure less often.
const PERIOD: Duration = Duration::from_millis(10);

/// What to wait for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Until {
    /// The value is below the number.
    Less(f64),
    /// The value is at most the number.
    AtMost(f64),
    /// The value is above the number.
    Greater(f64),
    /// The value is at least the number.
    AtLeast(f64),
    /// The value is the number.
    Equal(f64),
    /// The value is another one.
    Unequal(f64),
    /// The value is 1, and later 0 again.
    Bumped,
}

/// How a wait ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ended {
    /// The sensor shows it.
    Reached,
    /// The time is up.
    Timeout,
    /// The sensor is no longer plugged in.
    Unplugged,
}

impl Ended {
    /// As programs see it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::Timeout => "timeout",
            Self::Unplugged => "unplugged",
        }
    }
}

/// Waits until value `index` of a sensor in a mode is as it should be. Samples it
/// at least once.
///
/// # Errors
/// As [`read`].
pub fn wait_until(
    registry: &Registry,
    sensor: &Arc<Device>,
    mode: &str,
    index: usize,
    until: Until,
    timeout: Option<Duration>,
    interrupted: Interrupted,
) -> Result<Ended> {
    let tree = registry.tree();
    let deadline = timeout.map(|timeout| tree.now().saturating_add(timeout));
    let mut was_pressed = false;
    loop {
        let Some(value) = read(registry, sensor, Some(mode), index, &mut *interrupted)? else {
            return Ok(Ended::Unplugged);
        };
        if is_met(until, number(&value), &mut was_pressed) {
            return Ok(Ended::Reached);
        }
        let left = deadline.map_or(PERIOD, |deadline| deadline.saturating_sub(tree.now()));
        if left.is_zero() {
            return Ok(Ended::Timeout);
        }
        sleep(tree, left.min(PERIOD), &mut *interrupted)?;
    }
}

#[expect(clippy::cast_precision_loss, reason = "sensors' values have 32 bits")]
fn number(value: &Value) -> f64 {
    match value {
        Value::Integer(integer) => *integer as f64,
        Value::Float(float) => *float,
        Value::Text(_) => f64::NAN,
    }
}

#[expect(clippy::float_cmp, reason = "the program compares so, too")]
fn is_met(until: Until, value: f64, was_pressed: &mut bool) -> bool {
    match until {
        Until::Less(number) => value < number,
        Until::AtMost(number) => value <= number,
        Until::Greater(number) => value > number,
        Until::AtLeast(number) => value >= number,
        Until::Equal(number) => value == number,
        Until::Unequal(number) => value != number,
        Until::Bumped => {
            let is_pressed = value != 0.0;
            let is_released = *was_pressed && !is_pressed;
            *was_pressed |= is_pressed;
            is_released
        }
    }
}
