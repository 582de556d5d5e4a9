//! Motors without a rotation sensor, and lamps: class `dc-motor`.
//!
//! Such a device gets a share of the battery's voltage, its *duty*, and reports
//! nothing back. The kernel does not detect one: an output port has to be put
//! into the mode `dc-motor` ([`lego_port`](crate::brick::port)).
//!
//! Each change of the duty is a ramp with steps of 100 ms, even one without length, and a change
//! that comes while a step is due waits for it (`dc_motor_class.c`). So a command within 100 ms of
//! the last command or change takes effect up to 100 ms late.
use crate::class::Class;
use crate::device::motion::End;
use crate::device::registry::Registry;
use crate::device::retry;
use crate::device::retry::while_permissions_settle;
use crate::error::{Interrupted, Result};
use crate::motor::{self, MoveOptions, Moving, Ramps};
use crate::wait::Slices;
use std::sync::Arc;
use std::time::Duration;

/// The longest `time_sp`, in milliseconds.
const LONGEST_MS: i32 = 60_000;

/// Runs a motor at a duty until it is stopped. `false` if it is absent or the percentage beyond
/// 100; then nothing has moved. Errors: the kernel's; [`Interrupted`](crate::Error::Interrupted).
pub fn run_forever(
    registry: &Registry,
    port: &str,
    percent: f64,
    interrupted: Interrupted,
) -> Result<bool> {
    let Some(duty) = motor::duty(percent) else {
        return Ok(false);
    };
    let run = retry::with(registry, Class::DcMotor, port, interrupted, |motor| {
        motor.write_number("duty_cycle_sp", duty)?;
        motor::start(motor, "run-forever", Some(End::Never))
    })?;
    Ok(run.is_some())
}

/// Runs a motor at a duty for a time, and then stops it. `None` if it is absent, the percentage
/// beyond 100 or the time beyond a minute; then nothing has moved. Otherwise as [`motor::begin`].
pub fn begin_timed(
    registry: &Arc<Registry>,
    port: &str,
    percent: f64,
    time: Duration,
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Option<Slices<Moving>>> {
    let (Some(duty), Some(milliseconds)) =
        (motor::duty(percent), motor::milliseconds(time, LONGEST_MS))
    else {
        return Ok(None);
    };
    let start = || {
        registry.with(Class::DcMotor, port, |motor| {
            motor.write_number("duty_cycle_sp", duty)?;
            motor.write_number("time_sp", milliseconds)?;
            motor.write("stop_action", options.stop_action.word())?;
            let mut ramps = Ramps::default();
            ramps.set(motor, options)?;
            motor::start(motor, "run-timed", Some(End::Time(time)))?;
            Ok(Arc::clone(motor))
        })
    };
    let motor = while_permissions_settle(registry, interrupted, start)?;
    Ok(motor.map(|motor| Slices::new(Moving::new(registry, vec![motor], options))))
}
