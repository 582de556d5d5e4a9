//! RC servos on a controller: class `servo-motor`.
//!
//! A servo turns its shaft to a position and keeps it there, until it is let
//! float. Its positions go from -100 to 100 percent of its travel; the controller
//! sends them as pulses of different lengths.
use crate::device::Device;
use crate::device::motion::End;
use crate::error::Result;
use crate::motor::command::start;
use crate::motor::plan::duty;
use crate::motor::wait::has;

/// Sends a servo to a position from -100 to 100 percent, where it stays. `false`
/// if the position is beyond that; then nothing has moved.
pub fn set_position(servo: &Device, percent: f64) -> Result<bool> {
    let Some(percent) = duty(percent) else {
        return Ok(false);
    };
    servo.write_number("position_sp", percent)?;
    start(servo, "run", Some(End::Never))?;
    Ok(true)
}

/// The position a servo was sent to, in percent; `None` while it floats.
///
/// The kernel computes it from the pulse, and does not apply the polarity to it
/// (`servo_motor_class.c`).
pub fn position(servo: &Device) -> Result<Option<i64>> {
    if !servo.with_word("state", |state| has(state, "running"))? {
        return Ok(None);
    }
    let percent = servo.number("position_sp")?;
    let is_inversed = servo.with_word("polarity", |polarity| polarity == "inversed")?;
    Ok(Some(if is_inversed { -percent } else { percent }))
}

/// Lets a servo float: it no longer keeps its position.
pub fn float(servo: &Device) -> Result<()> {
    start(servo, "float", None)
}
