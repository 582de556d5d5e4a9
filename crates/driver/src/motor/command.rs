//! Commands to one motor, and the record of the last one.
//!
//! A command that starts a motor is recorded with the device: a wait must know where the motor is
//! to end, and at the end of the program every motor that runs is stopped.
use crate::device::Device;
use crate::device::motion::{End, MotorRun};
use crate::error::{Error, Result};
use crate::motor::ramped::Ramped;
pub use crate::stop_action::StopAction;
use ev3_os::Errno;
use std::sync::Arc;
use std::time::Duration;

/// Writes a command to one motor and leaves its set-points as they are.
/// Errors: the kernel's, as EINVAL for a command the motor does not have.
pub fn command(motor: &Device, word: &str) -> Result<()> {
    let end = match word {
        // The last one is a servo's.
        "run-forever" | "run-direct" | "run" => Some(End::Never),
        "run-timed" => {
            let milliseconds = motor.number("time_sp")?;
            Some(End::Time(Duration::from_millis(milliseconds.unsigned_abs())))
        }
        "run-to-abs-pos" => {
            let (from, target) = (motor.number("position")?, motor.number("position_sp")?);
            Some(End::Position { from, target })
        }
        "run-to-rel-pos" => {
            let (from, distance) = (motor.number("position")?, motor.number("position_sp")?);
            // Since ev3dev-stretch, after another one: from where that was to end.
            let base = motor.run().and_then(MotorRun::relative_target).unwrap_or(from);
            Some(End::Position { from, target: base.saturating_add(distance) })
        }
        _ => None,
    };
    start(motor, word, end)
}

/// Writes a command, and records the end of the run that it starts; `None` for a
/// command that stops.
pub(crate) fn start(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    if word == "reset" {
        return motor.without_counting(&mut || start_as(motor, word, end));
    }
    start_as(motor, word, end)?;
    motor.was_commanded();
    if end.is_some() {
        motor.started();
    }
    Ok(())
}

fn start_as(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    let mut ramped = Ramped::before(motor, end)?;
    let word = ramped.as_ref().map_or(word, |ramped| ramped.word(word));
    let run = end.map(|end| run(motor, word, end));
    // Write the command under the lock: a drive must not restart a motor that was just stopped.
    let mut present = motor.run();
    if run.is_some() {
        // Record the run before writing the command. If we are killed in between,
        // we stop a motor that never started, rather than leave one running.
        *present = run;
    }
    if let Some(ramped) = &mut ramped {
        ramped.prepare()?;
    }
    motor.write("command", word)?;
    let now = run.map_or_else(|| motor.tree().now(), |run| run.started);
    motor.note_command(now, word);
    *present = run;
    Ok(())
}

/// Stops a motor, unless it got another command after this run began. The stop
/// action is that of the set-points.
pub(super) fn stop_run(motor: &Device, run: MotorRun) -> Result<()> {
    let mut present = motor.run();
    if *present == Some(run) {
        motor.write("command", "stop")?;
        motor.note_command(motor.tree().now(), "stop");
        *present = None;
    }
    Ok(())
}

fn run(motor: &Device, word: &str, end: End) -> MotorRun {
    let is_relative = word == "run-to-rel-pos";
    MotorRun { started: motor.tree().now(), is_relative, claim: None, end }
}

/// Whether the last command to a motor makes it run until it is stopped, or for a time.
pub(crate) fn runs_on(motor: &Device) -> bool {
    let end = motor.run().map(|run| run.end);
    matches!(end, Some(End::Never | End::Time(_)))
}

/// Stops a motor, in some way even if it does not have that action: the `BrickPi`'s motors cannot
/// brake. Errors: the kernel's, as EINVAL for the action.
pub fn stop(motor: &Device, action: StopAction) -> Result<()> {
    let chosen = motor.write("stop_action", action.word());
    let stopped = start(motor, "stop", None);
    stopped.and(chosen)
}

/// Stops a motor as [`stop`] does, and succeeds also if the motor does not have the
/// action and just stops, or was unplugged.
pub(super) fn stop_best_effort(motor: &Device, action: StopAction) -> Result<()> {
    best_effort(stop(motor, action))
}

/// Takes a stop as successful if the motor has no such action, or was unplugged.
pub(crate) fn best_effort(stopped: Result<()>) -> Result<()> {
    let is_at_rest = |error: &Error| {
        let is_action = error.path().is_some_and(|path| path.ends_with("stop_action"));
        is_action && error.errno() == Some(Errno::INVAL) || error.is_stale()
    };
    stopped.or_else(|error| if is_at_rest(&error) { Ok(()) } else { Err(error) })
}

/// Stops all of these motors, even where one of them fails. An unplugged
/// motor counts as stopped, and one that does not have the action just stops.
pub fn stop_all(motors: &[Arc<Device>], action: StopAction) -> Result<()> {
    let mut result = Ok(());
    for motor in motors {
        result = result.and(stop_best_effort(motor, action));
    }
    result
}

/// Stops a motor and puts its position, set-points and constants back to what
/// they are after plugging in.
pub fn reset(motor: &Device) -> Result<()> {
    start(motor, "reset", None)
}

/// Opens the motors' files for writing, before anything is written to one of them: what
/// starts them, and what stops them, since there may be no descriptors left then.
pub(crate) fn prepare(motors: &[Arc<Device>]) -> Result<()> {
    motors.iter().filter(|motor| !motor.is_prepared()).try_for_each(|motor| {
        // Without it, the command to stop is enough.
        let action = motor.prepare("stop_action");
        motor.prepare("command")?;
        if action.is_ok() {
            motor.note_prepared();
        }
        Ok(())
    })
}

/// Starts all motors, or none: if one fails, those that run are stopped.
pub(super) fn start_all(
    motors: &[Arc<Device>],
    mut start: impl FnMut(&Device) -> Result<()>,
) -> Result<()> {
    motors.iter().try_for_each(|motor| {
        start(motor).map_err(|error| {
            let _ = stop_all(motors, StopAction::Brake);
            if error.is_unplugged() { motor.unplugged() } else { error }
        })
    })
}
