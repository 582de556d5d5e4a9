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
use crate::error::{Error, Result};
use crate::wait::{Reason, TOLERANCE, has, wait_for};
use rustix::io::Errno;
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
                // Multiplied first: most percentages are no binary fractions.
                let counts = (percent * max as f64 / 100.0).floor();
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
    /// Whether by `run-to-rel-pos`.
    is_relative: bool,
    /// The number of the drive's motion that it is part of; 0 for none.
    owner: u32,
    pub(crate) end: End,
}

impl Motion {
    fn target(self) -> Option<i64> {
        match self.end {
            End::Position { target, .. } => Some(target),
            End::Time(_) | End::Never => None,
        }
    }

    fn relative_target(self) -> Option<i64> {
        self.target().filter(|_| self.is_relative)
    }
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
            // Since ev3dev-stretch, after another one: from where that was to end.
            let base = motor.motion().and_then(Motion::relative_target).unwrap_or(from);
            Some(End::Position { from, target: base.saturating_add(distance) })
        }
        _ => None,
    };
    start(motor, word, end)
}

/// Writes a command, and remembers what it started: `None` if it stops.
fn start(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    if word == "reset" {
        return motor.recount(&mut || start_as(motor, word, end));
    }
    start_as(motor, word, end)?;
    if end.is_some() {
        motor.started();
    }
    Ok(())
}

fn start_as(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    let motion = motion(motor, word, end, 0);
    // The command under the lock: a drive must not start again what was just
    // stopped.
    let mut present = motor.motion();
    if motion.is_some() {
        // Before the command: were we stopped in between, it would be one stop
        // too many rather than one too few.
        *present = motion;
    }
    motor.write("command", word)?;
    *present = motion;
    Ok(())
}

fn motion(motor: &Device, word: &str, end: Option<End>, owner: u32) -> Option<Motion> {
    let is_relative = word == "run-to-rel-pos";
    end.map(|end| Motion { started: motor.tree().now(), is_relative, owner, end })
}

/// Makes a motor part of a drive's motion.
pub(crate) fn own(motor: &Device, owner: u32) {
    *motor.motion() = motion(motor, "run-forever", Some(End::Never), owner);
}

/// Whether a motor is still part of a drive's motion: nobody else has told it
/// anything since.
pub(crate) fn is_owned(motor: &Device, owner: u32) -> bool {
    motor.motion().is_some_and(|motion| motion.owner == owner)
}

/// Writes a command to a motor that is part of a drive's motion; `false`, and
/// nothing is written, if it no longer is.
pub(crate) fn start_owned(motor: &Device, word: &str, end: End, owner: u32) -> Result<bool> {
    let next = motion(motor, word, Some(end), owner);
    let mut present = motor.motion();
    if present.is_none_or(|motion| motion.owner != owner) {
        return Ok(false);
    }
    motor.write("command", word)?;
    *present = next;
    Ok(true)
}

/// Stops a motor that is part of a drive's motion; not if it no longer is.
pub(crate) fn stop_owned(motor: &Device, action: StopAction, owner: u32) -> Result<()> {
    let mut present = motor.motion();
    if present.is_none_or(|motion| motion.owner != owner) {
        return Ok(());
    }
    let chosen = motor.write("stop_action", action.word());
    motor.write("command", "stop")?;
    *present = None;
    chosen
}

/// Whether a motor was told to run and not to stop by itself.
pub(crate) fn runs_on(motor: &Device) -> bool {
    let end = motor.motion().map(|motion| motion.end);
    matches!(end, Some(End::Never | End::Time(_)))
}

/// Stops a motor, in some way even if it does not have that action: the
/// `BrickPi`'s motors cannot brake.
///
/// # Errors
/// The kernel's, as EINVAL for the action.
pub fn stop(motor: &Device, action: StopAction) -> Result<()> {
    let chosen = motor.write("stop_action", action.word());
    let stopped = start(motor, "stop", None);
    stopped.and(chosen)
}

/// Stops a motor as [`stop`] does, and is content if it stops without having
/// that action, or is gone.
fn stop_somehow(motor: &Device, action: StopAction) -> Result<()> {
    let is_at_rest = |error: &Error| {
        let is_action = error.path().is_some_and(|path| path.ends_with("stop_action"));
        is_action && error.errno() == Some(Errno::INVAL) || error.is_stale()
    };
    stop(motor, action).or_else(|error| if is_at_rest(&error) { Ok(()) } else { Err(error) })
}

/// Stops all of these motors, even where one of them fails. One that is gone
/// has nothing to stop, and one that does not have that action just stops.
///
/// # Errors
/// The first that occurred.
pub fn stop_all(motors: &[Arc<Device>], action: StopAction) -> Result<()> {
    let mut result = Ok(());
    for motor in motors {
        result = result.and(stop_somehow(motor, action));
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
        result = result.and(stop_somehow(motor, StopAction::Brake));
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
    run_at(&motors, speeds)?;
    Ok(true)
}

/// Runs motors at speeds in counts per second until they are stopped.
pub(crate) fn run_at(motors: &[Arc<Device>], speeds: impl IntoIterator<Item = i64>) -> Result<()> {
    for (motor, speed) in motors.iter().zip(speeds) {
        motor.write_number("speed_sp", speed)?;
    }
    start_all(motors, |motor| start(motor, "run-forever", Some(End::Never)))
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
        count_from_here(motor)?;
        motor.write_number("position_sp", plan.distance)?;
        motor.write_number("speed_sp", plan.speed)?;
        motor.write("stop_action", options.stop_action.word())?;
    }
    let mut ramps = Ramps::default();
    ramps.set(&motors, options)?;
    let mut ends = plans.iter().map(|plan| End::Position { from: plan.from, target: plan.target });
    start_all(&motors, |motor| start(motor, "run-to-rel-pos", ends.next()))?;
    Ok(Some(motors))
}

/// A move in the kernel's units.
struct Plan {
    from: i64,
    target: i64,
    /// From where the motor is to the target.
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
    let position = motor.number("position")?;
    let from = base(motor, position)?;
    let target = from.saturating_add(counts as i64 * speed.signum());
    let distance = target.saturating_sub(position);
    // The kernel counts in 32 bits.
    let is_possible = i32::try_from(target).is_ok() && i32::try_from(distance).is_ok();
    Ok(is_possible.then_some(Plan { from, target, distance, speed: speed.abs() }))
}

/// Where a move begins: where the motor is, or where it is held, so that many
/// moves one after the other do not add up what each is off.
fn base(motor: &Device, position: i64) -> Result<i64> {
    let target = motor.motion().and_then(Motion::target);
    let is_near = |target: &i64| target.abs_diff(position) <= TOLERANCE;
    match target.filter(is_near) {
        Some(target) if motor.with_word("state", |state| has(state, "holding"))? => Ok(target),
        _ => Ok(position),
    }
}

/// Makes the next relative move count from where the motor is.
///
/// Since ev3dev-stretch one that comes right after another counts from where
/// that was to end, even if the position was written meanwhile or the motor
/// turned by hand (`tacho_motor_class.c`); on jessie it does not. Any other
/// command in between makes them agree. What an earlier program told the motor
/// is not known, so that it may need one, too.
fn count_from_here(motor: &Device) -> Result<()> {
    let may_follow_relative = motor.motion().is_none_or(|motion| motion.is_relative);
    if may_follow_relative { motor.write("command", "stop") } else { Ok(()) }
}

/// The ramps that the motors had before a move with its own. The command
/// copies them, so that they are put back as soon as the motors run, or when
/// they could not start.
#[derive(Default)]
pub(crate) struct Ramps(Vec<(Arc<Device>, &'static str, i64)>);

impl Ramps {
    pub(crate) fn set(&mut self, motors: &[Arc<Device>], options: &MoveOptions) -> Result<()> {
        let given = [("ramp_up_sp", options.ramp_up_ms), ("ramp_down_sp", options.ramp_down_ms)];
        for motor in motors {
            for (attribute, milliseconds) in given {
                if let Some(milliseconds) = milliseconds {
                    self.0.push((Arc::clone(motor), attribute, motor.number(attribute)?));
                    motor.write_number(attribute, milliseconds)?;
                }
            }
        }
        Ok(())
    }
}

impl Drop for Ramps {
    fn drop(&mut self) {
        // The last first, as a motor may have been named twice. What cannot be
        // put back belongs to a motor that was unplugged.
        for (motor, attribute, milliseconds) in self.0.drain(..).rev() {
            let _ = motor.write_number(attribute, milliseconds);
        }
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
