//! Moves in the kernel's units: speeds, angles and times as set-points.
use crate::class::Class;
use crate::device::Device;
use crate::device::motion::{End, MotorRun};
use crate::device::registry::Registry;
use crate::error::{Error, Result};
use crate::motor::wait::{TOLERANCE, has};
use crate::value::Value;
use std::time::Duration;

/// A motor, and how far to turn it.
#[derive(Clone, Debug)]
pub struct Move<'a> {
    /// The motor's port.
    pub port: &'a str,
    /// The speed; its sign is a direction.
    pub speed: Speed,
    /// The target of the move.
    pub extent: Extent,
}

/// How far a move goes. Angles are in degrees of what the motor drives, or, of a
/// linear actuator, in millimeters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// By an angle; its sign and that of the speed make the direction.
    By(f64),
    /// To an angle, counted from where the position is 0, whatever the sign of the speed.
    To(f64),
    /// For a time.
    For(Duration),
}

/// A motor's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// In percent of `max_speed`.
    Percent(f64),
    /// In degrees per second of what the motor drives.
    DegreesPerSecond(f64),
    /// In tacho counts per second.
    CountsPerSecond(i64),
}

impl Speed {
    /// Tacho counts per second, `floor(percent / 100 * max_speed)` of a percentage, or `None`
    /// beyond what the motor accepts. Errors: the kernel's, of reading `max_speed`.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "a speed in range fits either type"
    )]
    pub fn in_counts(self, motor: &Device) -> Result<Option<i64>> {
        let max = motor.constant("max_speed")?;
        // Also false for NaN.
        let within = |counts: f64| (counts.abs() <= max as f64).then_some(counts as i64);
        let counts = match self {
            Self::Percent(percent) => {
                // Multiplied first: most percentages are no binary fractions.
                within((percent * max as f64 / 100.0).floor())
            }
            // A linear actuator does not turn.
            Self::DegreesPerSecond(_) if motor.is_linear() => None,
            Self::DegreesPerSecond(degrees) => within((degrees * counts_per_unit(motor)?).round()),
            Self::CountsPerSecond(counts) => Some(counts),
        };
        Ok(counts.filter(|counts| counts.unsigned_abs() <= max.unsigned_abs()))
    }
}

/// A move in the kernel's units.
pub(super) struct Plan {
    pub(super) command: &'static str,
    pub(super) end: End,
    pub(super) speed: i64,
    /// The set-point that says how far, and its value.
    pub(super) set_point: &'static str,
    pub(super) value: i64,
}

/// Converts a move; `None` if it is impossible.
pub(super) fn plan(motor: &Device, one: &Move) -> Result<Option<Plan>> {
    let Some(speed) = one.speed.in_counts(motor)?.filter(|speed| *speed != 0) else {
        return Ok(None);
    };
    Ok(match one.extent {
        Extent::By(angle) => plan_by(motor, speed, angle)?,
        Extent::To(angle) => {
            let (from, target) = (motor.number("position")?, counts(motor, angle)?);
            target.map(|target| Plan {
                command: "run-to-abs-pos",
                end: End::Position { from, target },
                speed: speed.abs(),
                set_point: "position_sp",
                value: target,
            })
        }
        Extent::For(time) => milliseconds(time, i32::MAX).map(|value| Plan {
            command: "run-timed",
            end: End::Time(time),
            speed,
            set_point: "time_sp",
            value,
        }),
    })
}

/// The kernel ignores the sign of `speed_sp` in position moves, so that of the
/// speed goes into the distance.
///
/// Since ev3dev-stretch a relative move that comes right after another counts from
/// where that was to end, even if the position was written meanwhile or the motor
/// turned by hand (`tacho_motor_class.c`); on jessie it does not. So that one is
/// made a move to the target. A stop in between would also make them agree, but a
/// stop that holds leaves the bridge as it is, and the motor creeps on by a count.
fn plan_by(motor: &Device, speed: i64, angle: f64) -> Result<Option<Plan>> {
    let Some(counts) = counts(motor, angle)? else {
        return Ok(None);
    };
    let position = motor.number("position")?;
    let from = base(motor, position)?;
    let target = from.saturating_add(counts * speed.signum());
    // From where the motor is to the target.
    let distance = target.saturating_sub(position);
    // The kernel counts in 32 bits.
    let is_possible = i32::try_from(target).is_ok() && i32::try_from(distance).is_ok();
    let follows_relative = motor.run().is_some_and(|run| run.is_relative);
    let (command, value) =
        if follows_relative { ("run-to-abs-pos", target) } else { ("run-to-rel-pos", distance) };
    Ok(is_possible.then_some(Plan {
        command,
        end: End::Position { from, target },
        speed: speed.abs(),
        set_point: "position_sp",
        value,
    }))
}

/// An angle, or a length, in tacho counts; `None` beyond what the kernel counts.
#[expect(clippy::cast_possible_truncation, reason = "checked to fit 32 bits")]
fn counts(motor: &Device, angle: f64) -> Result<Option<i64>> {
    let counts = (angle * counts_per_unit(motor)?).round();
    // Also false for NaN.
    Ok((counts.abs() <= f64::from(i32::MAX)).then_some(counts as i64))
}

/// Tacho counts for a degree of what the motor drives, or a millimeter of a linear actuator.
#[expect(clippy::cast_precision_loss, reason = "counts are few")]
pub fn counts_per_unit(motor: &Device) -> Result<f64> {
    let (attribute, units) =
        if motor.is_linear() { ("count_per_m", 1000.0) } else { ("count_per_rot", 360.0) };
    let counts = motor.constant(attribute)?;
    if counts == 0 {
        let (path, text) = (motor.path().join(attribute), "0".to_owned());
        return Err(Error::Malformed { path, text, expected: "a number of counts" });
    }
    Ok(counts as f64 / units * motor.gear())
}

/// `max_speed`, or `count_per_rot` for a turn of what the motor drives, if the driver has
/// read it from the motor at a port. Asks no device.
#[expect(clippy::cast_precision_loss, reason = "counts are few")]
pub fn known_counts(devices: &Registry, port: &str, constant: &str) -> Option<f64> {
    let motors = devices.known(Class::TachoMotor);
    let motor = motors.iter().find(|motor| motor.port() == port)?;
    let counts = motor.known_in(constant, "").filter(|counts| *counts > 0)? as f64;
    Some(if constant == "count_per_rot" { counts * motor.gear() } else { counts })
}

/// A time as the kernel takes it; `None` if it is longer than that.
pub(crate) fn milliseconds(time: Duration, longest: i32) -> Option<i64> {
    let milliseconds = i64::try_from((time + Duration::from_micros(500)).as_millis()).ok()?;
    (milliseconds <= i64::from(longest)).then_some(milliseconds)
}

/// The start of a move: the motor's position, or the position where it is held, so
/// that the errors of consecutive moves do not add up.
fn base(motor: &Device, position: i64) -> Result<i64> {
    let target = motor.run().and_then(MotorRun::target);
    let is_near = |target: &i64| target.abs_diff(position) <= TOLERANCE;
    match target.filter(is_near) {
        Some(target) if motor.with_word("state", |state| has(state, "holding"))? => Ok(target),
        _ => Ok(position),
    }
}

/// A share of the voltage in whole percent, or `None` beyond 100.
#[expect(clippy::cast_possible_truncation, reason = "checked to be a percentage")]
pub(crate) fn duty(percent: f64) -> Option<i64> {
    let whole = percent.round();
    // Also false for NaN.
    (whole.abs() <= 100.0).then_some(whole as i64)
}

/// The `position` or `speed` of a motor in degrees, or millimeters of a linear actuator:
/// an integer if a tacho count is one of these, else a float.
#[expect(clippy::cast_precision_loss, reason = "these have 32 bits")]
pub fn measured(motor: &Device, attribute: &str) -> Result<Value> {
    let (counts, per_unit) = (motor.number(attribute)?, counts_per_unit(motor)?);
    let is_unit = (per_unit - 1.0).abs() < f64::EPSILON;
    Ok(if is_unit { Value::Integer(counts) } else { Value::Float(counts as f64 / per_unit) })
}

/// Sets the position of a motor, in the units of [`measured`], without turning it.
/// `false` if that is beyond what the kernel counts.
pub fn set_position(motor: &Device, position: f64) -> Result<bool> {
    match counts(motor, position)? {
        Some(counts) => {
            let write = &mut || motor.write_number("position", counts);
            motor.without_counting(write).map(|()| true)
        }
        None => Ok(false),
    }
}

/// Sets how many times a motor turns while what it drives turns once. What the motor has
/// turned so far, it has turned with the gear before.
pub fn set_gear(motor: &Device, ratio: f64) -> Result<()> {
    motor.without_counting(&mut || {
        motor.set_gear(ratio);
        Ok(())
    })
}
