//! Motors: set-points, commands, moves of several motors at once.
//!
//! A motor is told what to do in two steps. Set-points (`speed_sp`,
//! `position_sp`, `stop_action`, `ramp_up_sp` ...) are stored; the next
//! `command` copies them all and starts. Nothing that is written to a
//! set-point changes a motion under way (kernel, `tacho_motor_class.c`). So
//! each function here writes the set-points that its command depends on first.
//! Several motors get all their set-points first and then their commands one
//! right after the other.
use crate::Interrupted;
use crate::device::Device;
use crate::devices::{Class, Devices};
use crate::error::Result;
use crate::wait::{Reason, wait_for};
use std::sync::Arc;
use std::time::Duration;

/// What a motor does at the end of a move, or when it is stopped.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum StopAction {
    /// Rolls out freely.
    Coast,
    /// Rolls out with its winding shorted.
    #[default]
    Brake,
    /// Keeps its position, actively.
    Hold,
}

impl StopAction {
    /// The kernel's word for it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Coast => "coast",
            Self::Brake => "brake",
            Self::Hold => "hold",
        }
    }
}

/// A motor and the speed at which to run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The motor's port.
    pub port: &'a str,
    /// The speed; its sign is the direction.
    pub speed: Speed,
}

/// A motor, and how far to turn it.
#[derive(Clone, Debug)]
pub struct Move<'a> {
    /// The motor's port.
    pub port: &'a str,
    /// The speed; with the sign of `degrees` it makes the direction.
    pub speed: Speed,
    /// The angle in degrees of the output shaft.
    pub degrees: f64,
}

/// A motor's speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Speed {
    /// In percent of `max_speed`.
    Percent(f64),
    /// In tacho counts per second.
    CountsPerSecond(i64),
}

impl Speed {
    /// Tacho counts per second, `floor(percent / 100 * max_speed)`, or `None`
    /// beyond what the motor accepts.
    ///
    /// # Errors
    /// The kernel's, of reading `max_speed`.
    #[expect(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        reason = "a speed in range fits either type"
    )]
    pub fn in_counts(self, motor: &Device) -> Result<Option<i64>> {
        let max = motor.constant("max_speed")?;
        let counts = match self {
            Self::Percent(percent) => {
                let counts = (percent / 100.0 * max as f64).floor();
                // Also false for NaN.
                (counts.abs() <= max as f64).then_some(counts as i64)
            }
            Self::CountsPerSecond(counts) => Some(counts),
        };
        Ok(counts.filter(|counts| counts.unsigned_abs() <= max.unsigned_abs()))
    }
}

/// How a move is made and ended.
#[derive(Clone, Copy, Debug)]
pub struct MoveOptions {
    /// What the motors do once they are there.
    pub stop_action: StopAction,
    /// Milliseconds for speeding up from 0 to `max_speed`.
    pub ramp_up_ms: Option<i64>,
    /// Milliseconds for slowing down from `max_speed` to 0.
    pub ramp_down_ms: Option<i64>,
    /// Whether to return only when the motors are done.
    pub wait: bool,
    /// How long to wait at most.
    pub timeout: Option<Duration>,
}

impl Default for MoveOptions {
    /// To the very position, and wait for it. A motor that coasts or brakes
    /// overshoots its target.
    fn default() -> Self {
        Self {
            stop_action: StopAction::Hold,
            ramp_up_ms: None,
            ramp_down_ms: None,
            wait: true,
            timeout: None,
        }
    }
}

/// What a motor was told to do, as far as a wait for its end can use it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Motion {
    /// When, by the tree's clock.
    pub(crate) started: Duration,
    pub(crate) end: End,
}

/// How a motion is meant to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// At a position, in tacho counts, coming from another one.
    Position { from: i64, target: i64 },
    /// After a time.
    Time(Duration),
    /// Not by itself.
    Never,
}

/// Writes a command to one motor, whatever its set-points are.
///
/// # Errors
/// The kernel's, as EINVAL for a command the motor does not have.
pub fn command(motor: &Device, word: &str) -> Result<()> {
    let end = match word {
        "run-forever" | "run-direct" => Some(End::Never),
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
            Some(End::Position { from, target: from.saturating_add(distance) })
        }
        _ => None,
    };
    start(motor, word, end)
}

/// Writes a command, and remembers what it started: `None` if it stops.
fn start(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    let motion = end.map(|end| Motion { started: motor.tree().now(), end });
    if motion.is_some() {
        // Before the command: were we stopped in between, it would be one stop
        // too many rather than one too few.
        *motor.motion() = motion;
    }
    motor.write("command", word)?;
    *motor.motion() = motion;
    Ok(())
}

/// Stops a motor.
///
/// # Errors
/// The kernel's.
pub fn stop(motor: &Device, action: StopAction) -> Result<()> {
    motor.write("stop_action", action.word())?;
    start(motor, "stop", None)
}

/// Stops all of these motors, even where one of them fails.
///
/// # Errors
/// The first that occurred.
pub fn stop_all(motors: &[Arc<Device>], action: StopAction) -> Result<()> {
    let mut result = Ok(());
    for motor in motors {
        result = result.and(stop(motor, action));
    }
    result
}

/// Stops every motor that was started and not stopped since. One that is gone
/// has nothing to stop.
///
/// # Errors
/// The first that occurred.
pub fn stop_started(devices: &Devices) -> Result<()> {
    let motors = devices.all(Class::TachoMotor)?;
    let mut result = Ok(());
    for motor in motors.iter().filter(|motor| motor.motion().is_some()) {
        let stopped = stop(motor, StopAction::Brake);
        result = result.and(stopped.or_else(|e| if e.is_stale() { Ok(()) } else { Err(e) }));
    }
    result
}

/// Stops a motor and puts its position, set-points and constants back to what
/// they are after plugging in.
///
/// # Errors
/// The kernel's.
pub fn reset(motor: &Device) -> Result<()> {
    start(motor, "reset", None)
}

/// Runs motors until they are stopped. `false` if one is absent or cannot run
/// at its speed; then nothing has moved.
///
/// # Errors
/// The kernel's. A motor that goes away while the others start stops them.
pub fn run_forever(devices: &Devices, runs: &[Run]) -> Result<bool> {
    devices.afresh(|| run_forever_once(devices, runs))
}

fn run_forever_once(devices: &Devices, runs: &[Run]) -> Result<bool> {
    let Some(motors) = find_all(devices, runs.iter().map(|run| run.port))? else {
        return Ok(false);
    };
    let speed = |(motor, run): (&Arc<Device>, &Run)| run.speed.in_counts(motor);
    // All of them, before anything is written.
    let possible = motors.iter().zip(runs).map(speed).collect::<Result<Option<Vec<i64>>>>()?;
    let Some(speeds) = possible else {
        return Ok(false);
    };
    for (motor, speed) in motors.iter().zip(speeds) {
        motor.write_number("speed_sp", speed)?;
    }
    start_all(&motors, |motor| start(motor, "run-forever", Some(End::Never)))?;
    Ok(true)
}

/// Turns motors by angles, all at once. `None` if one is absent, or the move
/// is impossible: a speed of 0 or beyond the motor's, an angle beyond what the
/// kernel counts; then nothing has moved.
///
/// Without [`MoveOptions::wait`] the answer is [`Reason::Reached`] once the
/// motors are started. A move that does not reach its end is stopped.
///
/// # Errors
/// The kernel's; [`Gone`](crate::Error::Gone) if one is unplugged under way;
/// [`Interrupted`](crate::Error::Interrupted) if the caller abandoned the wait.
/// The motors are stopped before.
pub fn run_to(
    devices: &Devices,
    moves: &[Move],
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Option<Reason>> {
    let Some(motors) = devices.afresh(|| start_moves(devices, moves, options))? else {
        return Ok(None);
    };
    if !options.wait {
        return Ok(Some(Reason::Reached));
    }
    let result = wait_for(devices, &motors, options.timeout, interrupted);
    if !matches!(result, Ok(Reason::Reached)) {
        // Whatever ended it: nothing may go on turning. That a motor cannot be
        // stopped, because it is gone, is no news to who gets this result.
        let _ = stop_all(&motors, StopAction::Brake);
    }
    match (result?, motors.iter().find(|motor| !devices.has(motor).unwrap_or(false))) {
        (Reason::Unplugged, Some(gone)) => Err(gone.gone()),
        (reason, _) => Ok(Some(reason)),
    }
}

/// Starts the motors of a move; `None` if one is absent or cannot make it.
fn start_moves(
    devices: &Devices,
    moves: &[Move],
    options: &MoveOptions,
) -> Result<Option<Vec<Arc<Device>>>> {
    let Some(motors) = find_all(devices, moves.iter().map(|one| one.port))? else {
        return Ok(None);
    };
    let mut plans = Vec::with_capacity(moves.len());
    for (motor, one) in motors.iter().zip(moves) {
        match plan(motor, one)? {
            Some(plan) => plans.push(plan),
            None => return Ok(None),
        }
    }
    for (motor, plan) in motors.iter().zip(&plans) {
        motor.write_number("position_sp", plan.distance)?;
        motor.write_number("speed_sp", plan.speed)?;
        motor.write("stop_action", options.stop_action.word())?;
    }
    let ramps = Ramps::set(&motors, options)?;
    let mut ends = plans.iter().map(|plan| End::Position {
        from: plan.from,
        target: plan.from.saturating_add(plan.distance),
    });
    start_all(&motors, |motor| start(motor, "run-to-rel-pos", ends.next()))?;
    ramps.restore()?;
    Ok(Some(motors))
}

/// A move in the kernel's units.
struct Plan {
    from: i64,
    distance: i64,
    speed: i64,
}

/// Converts a move; `None` if it is impossible.
///
/// The kernel ignores the sign of `speed_sp` in position moves, so that of the
/// speed goes into the distance.
#[expect(
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    reason = "checked to fit 32 bits, as the kernel's positions do"
)]
fn plan(motor: &Device, one: &Move) -> Result<Option<Plan>> {
    let Some(speed) = one.speed.in_counts(motor)?.filter(|speed| *speed != 0) else {
        return Ok(None);
    };
    let counts_per_rotation = motor.constant("count_per_rot")?;
    let counts = (one.degrees * counts_per_rotation as f64 / 360.0).round();
    // Also false for NaN.
    if counts.abs() > f64::from(i32::MAX) || counts.is_nan() {
        return Ok(None);
    }
    Ok(Some(Plan {
        from: motor.number("position")?,
        distance: counts as i64 * speed.signum(),
        speed: speed.abs(),
    }))
}

/// Ramps of one move. The command copies them, so that what was set before can
/// be put back as soon as the motors run.
struct Ramps<'a>(Vec<(&'a Device, &'static str, i64)>);

impl<'a> Ramps<'a> {
    fn set(motors: &'a [Arc<Device>], options: &MoveOptions) -> Result<Self> {
        let given = [("ramp_up_sp", options.ramp_up_ms), ("ramp_down_sp", options.ramp_down_ms)];
        let mut before = Vec::new();
        for motor in motors {
            for (attribute, milliseconds) in given {
                if let Some(milliseconds) = milliseconds {
                    before.push((&**motor, attribute, motor.number(attribute)?));
                    motor.write_number(attribute, milliseconds)?;
                }
            }
        }
        Ok(Self(before))
    }

    fn restore(self) -> Result<()> {
        self.0
            .into_iter()
            .try_for_each(|(motor, attribute, value)| motor.write_number(attribute, value))
    }
}

/// Starts all motors, or none: if one fails, those that run are stopped.
fn start_all(motors: &[Arc<Device>], mut start: impl FnMut(&Device) -> Result<()>) -> Result<()> {
    motors.iter().try_for_each(|motor| {
        start(motor).map_err(|error| {
            let _ = stop_all(motors, StopAction::Brake);
            if error.is_gone() { motor.gone() } else { error }
        })
    })
}

/// The tacho motors at these ports, or `None` if one is absent.
///
/// # Errors
/// The kernel's, as ENODEV for one that was just unplugged.
pub fn find_all<'a>(
    devices: &Devices,
    ports: impl IntoIterator<Item = &'a str>,
) -> Result<Option<Vec<Arc<Device>>>> {
    let find = |port| match devices.find(Class::TachoMotor, port)? {
        Some(motor) => motor.check_present().map(|()| Some(motor)),
        None => Ok(None),
    };
    ports.into_iter().map(find).collect()
}
