//! Waiting until a sensor shows what the program waits for.
use crate::device::Device;
use crate::device::registry::Registry;
use crate::error::Result;
use crate::sensor::read;
use crate::value::Value;
use crate::wait::{Look, Slices, Wait};
use std::sync::Arc;
use std::time::Duration;

/// The time between two samples. The EV3's sensors measure less often.
const PERIOD: Duration = Duration::from_millis(10);

/// The condition to wait for.
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
    pub fn word(self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::Timeout => "timeout",
            Self::Unplugged => "unplugged",
        }
    }
}

/// A wait until value `index` of a sensor in a mode is as it should be. Samples it at
/// least once. Its errors are those of [`read`].
pub fn until_shown(
    registry: &Arc<Registry>,
    sensor: &Arc<Device>,
    mode: &str,
    index: usize,
    until: Until,
    timeout: Option<Duration>,
) -> Slices<UntilShown> {
    Slices::new(UntilShown {
        registry: Arc::clone(registry),
        sensor: Arc::clone(sensor),
        mode: mode.to_owned(),
        index,
        until,
        deadline: timeout.map(|timeout| registry.tree().now().saturating_add(timeout)),
        was_pressed: false,
    })
}

/// Until a sensor shows something.
pub struct UntilShown {
    registry: Arc<Registry>,
    sensor: Arc<Device>,
    mode: String,
    index: usize,
    until: Until,
    deadline: Option<Duration>,
    was_pressed: bool,
}

impl Wait for UntilShown {
    type End = Ended;

    fn look(&mut self) -> Result<Look<Ended>> {
        let Self { registry, sensor, mode, index, .. } = self;
        // A sensor that settles in its mode is waited for without handling signals: for a
        // hundredth of a second.
        let Some(value) = read(registry, sensor, Some(mode), *index, &mut || false)? else {
            return Ok(Look::Over(Ended::Unplugged));
        };
        if is_met(self.until, number(&value), &mut self.was_pressed) {
            return Ok(Look::Over(Ended::Reached));
        }
        Ok(Look::again(self.registry.tree().now(), PERIOD, self.deadline, Ended::Timeout))
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        Ok(self.registry.tree().pause(&[], end).unwrap_or(true))
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
