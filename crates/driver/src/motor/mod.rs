//! Motors: set-points, commands, moves of several motors at once.
//!
//! A motor is told what to do in two steps. Set-points (`speed_sp`,
//! `position_sp`, `stop_action`, `ramp_up_sp` ...) are stored; the next
//! `command` copies them all and starts. Nothing that is written to a
//! set-point changes a motion under way (kernel, `tacho_motor_class.c`). So
//! each function here writes the set-points that its command depends on first.
//! Several motors get all their set-points first and then their commands one
//! right after the other.
pub mod dc;
pub mod servo;
pub mod wait;

use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Devices;
use crate::device::retry::patiently;
use crate::error::{Error, Interrupted, Result};
use crate::motor::wait::{Reason, TOLERANCE, has, wait_for};
use crate::value::Value;
use rustix::io::Errno;
use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
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
    /// The speed; its sign is a direction.
    pub speed: Speed,
    /// Where the move ends.
    pub way: Way,
}

/// How far a move goes. Angles are in degrees of the output shaft, or, of a
/// linear actuator, in millimetres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// By an angle; its sign and that of the speed make the direction.
    By(f64),
    /// To an angle, counted from where the position is 0, whatever the sign of
    /// the speed.
    To(f64),
    /// For a time.
    For(Duration),
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
            let base = motor.motion().and_then(Motion::relative_target).unwrap_or(from);
            Some(End::Position { from, target: base.saturating_add(distance) })
        }
        _ => None,
    };
    start(motor, word, end)
}

/// Writes a command, and remembers what it started: `None` if it stops.
pub(crate) fn start(motor: &Device, word: &str, end: Option<End>) -> Result<()> {
    if word == "reset" {
        return motor.without_counting(&mut || start_as(motor, word, end));
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

/// A number that tells a motion of several motors from others.
pub(crate) fn new_owner() -> u32 {
    static LAST: AtomicU32 = AtomicU32::new(0);
    // 0 is nobody.
    LAST.fetch_add(1, Ordering::Relaxed).wrapping_add(1).max(1)
}

/// Makes a motor part of such a motion.
pub(crate) fn own(motor: &Device, owner: u32) {
    *motor.motion() = motion(motor, "run-forever", Some(End::Never), owner);
}

/// Whether a motor is still part of the motion: nobody else has told it anything
/// since.
pub(crate) fn is_owned(motor: &Device, owner: u32) -> bool {
    motor.motion().is_some_and(|motion| motion.owner == owner)
}

/// Writes a command to a motor that is part of the motion; `false`, and
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

/// Brakes a motor that is part of the motion, and stays so; `false` if it no longer
/// is. One that cannot brake just stops.
pub(crate) fn brake_owned(motor: &Device, owner: u32) -> Result<bool> {
    somehow(motor.write("stop_action", StopAction::Brake.word()))?;
    start_owned(motor, "stop", End::Never, owner)
}

/// Stops a motor that is part of the motion; not if it no longer is.
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
    somehow(stop(motor, action))
}

fn somehow(stopped: Result<()>) -> Result<()> {
    let is_at_rest = |error: &Error| {
        let is_action = error.path().is_some_and(|path| path.ends_with("stop_action"));
        is_action && error.errno() == Some(Errno::INVAL) || error.is_stale()
    };
    stopped.or_else(|error| if is_at_rest(&error) { Ok(()) } else { Err(error) })
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

/// Stops those of these motors that are still part of the motion, as
/// [`stop_all`] does.
///
/// # Errors
/// The first that occurred.
pub(crate) fn stop_all_owned(motors: &[Arc<Device>], action: StopAction, owner: u32) -> Result<()> {
    let mut result = Ok(());
    for motor in motors {
        result = result.and(somehow(stop_owned(motor, action, owner)));
    }
    result
}

/// Stops every motor, of any class, that was started and not stopped since. One
/// that is gone has nothing to stop.
///
/// # Errors
/// The first that occurred.
pub fn stop_started(devices: &Devices) -> Result<()> {
    let mut result = Ok(());
    for class in Class::MOTORS {
        // Those that were started are known: nothing needs to be opened for them.
        for motor in devices.known(class).iter().filter(|motor| motor.motion().is_some()) {
            result = result.and(match class {
                Class::ServoMotor => crate::motor::servo::float_somehow(motor),
                _ => stop_somehow(motor, StopAction::Brake),
            });
        }
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
/// [`Error::Twice`]; [`Interrupted`](Error::Interrupted).
pub fn run_forever(devices: &Devices, runs: &[Run], interrupted: Interrupted) -> Result<bool> {
    patiently(devices, interrupted, || run_forever_once(devices, runs))
}

fn run_forever_once(devices: &Devices, runs: &[Run]) -> Result<bool> {
    let Some(motors) = find_each(devices, runs.iter().map(|run| run.port))? else {
        return Ok(false);
    };
    let speed = |(motor, run): (&Arc<Device>, &Run)| run.speed.in_counts(motor);
    // All of them, before anything is written.
    let possible = motors.iter().zip(runs).map(speed).collect::<Result<Option<Vec<i64>>>>()?;
    let Some(speeds) = possible else {
        return Ok(false);
    };
    prepare(&motors)?;
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

/// Gives a motor without regulation, of either class, a share of the voltage
/// until it is stopped; when it runs so already, from now on. `false` if it is
/// absent or the percentage beyond 100; then nothing has moved.
///
/// # Errors
/// The kernel's, as EINVAL of a motor that cannot; [`Error::Interrupted`].
pub fn run_direct(
    devices: &Devices,
    class: Class,
    port: &str,
    percent: f64,
    interrupted: Interrupted,
) -> Result<bool> {
    let Some(duty) = duty(percent) else {
        return Ok(false);
    };
    let run = |motor: &Arc<Device>| {
        motor.write_number("duty_cycle_sp", duty)?;
        start(motor, "run-direct", Some(End::Never))
    };
    Ok(devices.with_patience(class, port, interrupted, run)?.is_some())
}

/// A share of the voltage in whole percent, or `None` beyond 100.
#[expect(clippy::cast_possible_truncation, reason = "checked to be a percentage")]
pub(crate) fn duty(percent: f64) -> Option<i64> {
    let whole = percent.round();
    // Also false for NaN.
    (whole.abs() <= 100.0).then_some(whole as i64)
}

/// Where a motor is, in degrees, or millimetres of a linear actuator: an
/// integer where a tacho count is one, else a float.
///
/// # Errors
/// The kernel's.
#[expect(clippy::cast_precision_loss, reason = "positions have 32 bits")]
pub fn position(motor: &Device) -> Result<Value> {
    let (counts, per_unit) = (motor.number("position")?, counts_per_unit(motor)?);
    let is_unit = (per_unit - 1.0).abs() < f64::EPSILON;
    Ok(if is_unit { Value::Integer(counts) } else { Value::Float(counts as f64 / per_unit) })
}

/// Says what a motor's present position, in the units of [`position`], is
/// called from now on. `false` if that is beyond what the kernel counts.
///
/// # Errors
/// The kernel's.
pub fn set_position(motor: &Device, position: f64) -> Result<bool> {
    match counts(motor, position)? {
        Some(counts) => motor.write_number("position", counts).map(|()| true),
        None => Ok(false),
    }
}

/// Turns motors, all at once. `None` if one is absent, or the move
/// is impossible: a speed of 0 or beyond the motor's, an angle or a time beyond
/// what the kernel counts; then nothing has moved.
///
/// Without [`MoveOptions::wait`] the answer is [`Reason::Reached`] once the
/// motors are started. A move that does not reach its end is stopped.
///
/// # Errors
/// The kernel's; [`Gone`](crate::Error::Gone) if one is unplugged under way;
/// [`Interrupted`](crate::Error::Interrupted) if the caller abandoned the wait.
/// The motors are stopped before. [`Error::Twice`].
pub fn run_to(
    devices: &Devices,
    moves: &[Move],
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Option<Reason>> {
    let start = || start_moves(devices, moves, options);
    match patiently(devices, &mut *interrupted, start)? {
        Some(motors) => finish(devices, &motors, options, interrupted).map(Some),
        None => Ok(None),
    }
}

/// Waits, if that is asked for, until motors that were started are done. Those
/// that do not get there are stopped.
pub(crate) fn finish(
    devices: &Devices,
    motors: &[Arc<Device>],
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Reason> {
    if !options.wait {
        return Ok(Reason::Reached);
    }
    let result = wait_for(devices, motors, options.timeout, interrupted);
    if !matches!(result, Ok(Reason::Reached)) {
        // Whatever ended it: nothing may go on turning. That a motor cannot be
        // stopped, because it is gone, is no news to who gets this result.
        let _ = stop_all(motors, StopAction::Brake);
    }
    match (result?, motors.iter().find(|motor| !devices.has(motor).unwrap_or(false))) {
        (Reason::Unplugged, Some(gone)) => Err(gone.gone()),
        (reason, _) => Ok(reason),
    }
}

/// Starts the motors of a move; `None` if one is absent or cannot make it.
fn start_moves(
    devices: &Devices,
    moves: &[Move],
    options: &MoveOptions,
) -> Result<Option<Vec<Arc<Device>>>> {
    let Some(motors) = find_each(devices, moves.iter().map(|one| one.port))? else {
        return Ok(None);
    };
    let mut plans = Vec::with_capacity(moves.len());
    for (motor, one) in motors.iter().zip(moves) {
        match plan(motor, one)? {
            Some(plan) => plans.push(plan),
            None => return Ok(None),
        }
    }
    prepare(&motors)?;
    for (motor, plan) in motors.iter().zip(&plans) {
        if plan.command == "run-to-rel-pos" {
            count_from_here(motor)?;
        }
        motor.write_number(plan.set_point, plan.value)?;
        motor.write_number("speed_sp", plan.speed)?;
        motor.write("stop_action", options.stop_action.word())?;
    }
    let mut ramps = Ramps::default();
    for motor in &motors {
        ramps.set(motor, options)?;
    }
    let mut plans = plans.iter();
    start_all(&motors, |motor| match plans.next() {
        Some(plan) => start(motor, plan.command, Some(plan.end)),
        None => Ok(()),
    })?;
    Ok(Some(motors))
}

/// A move in the kernel's units.
struct Plan {
    command: &'static str,
    end: End,
    speed: i64,
    /// The set-point that says how far, and its value.
    set_point: &'static str,
    value: i64,
}

/// Converts a move; `None` if it is impossible.
fn plan(motor: &Device, one: &Move) -> Result<Option<Plan>> {
    let Some(speed) = one.speed.in_counts(motor)?.filter(|speed| *speed != 0) else {
        return Ok(None);
    };
    Ok(match one.way {
        Way::By(angle) => plan_by(motor, speed, angle)?,
        Way::To(angle) => {
            let (from, target) = (motor.number("position")?, counts(motor, angle)?);
            target.map(|target| Plan {
                command: "run-to-abs-pos",
                end: End::Position { from, target },
                speed: speed.abs(),
                set_point: "position_sp",
                value: target,
            })
        }
        Way::For(time) => milliseconds(time, i32::MAX).map(|value| Plan {
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
    Ok(is_possible.then_some(Plan {
        command: "run-to-rel-pos",
        end: End::Position { from, target },
        speed: speed.abs(),
        set_point: "position_sp",
        value: distance,
    }))
}

/// An angle, or a length, in tacho counts; `None` beyond what the kernel counts.
#[expect(clippy::cast_possible_truncation, reason = "checked to fit 32 bits")]
fn counts(motor: &Device, angle: f64) -> Result<Option<i64>> {
    let counts = (angle * counts_per_unit(motor)?).round();
    // Also false for NaN.
    Ok((counts.abs() <= f64::from(i32::MAX)).then_some(counts as i64))
}

/// Tacho counts for a degree of the shaft, or a millimetre of a linear actuator.
#[expect(clippy::cast_precision_loss, reason = "counts are few")]
fn counts_per_unit(motor: &Device) -> Result<f64> {
    Ok(if motor.is_linear() {
        motor.constant("count_per_m")? as f64 / 1000.0
    } else {
        motor.constant("count_per_rot")? as f64 / 360.0
    })
}

/// A time as the kernel takes it; `None` if it is longer than that.
pub(crate) fn milliseconds(time: Duration, longest: i32) -> Option<i64> {
    let milliseconds = i64::try_from((time + Duration::from_micros(500)).as_millis()).ok()?;
    (milliseconds <= i64::from(longest)).then_some(milliseconds)
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
    pub(crate) fn set(&mut self, motor: &Arc<Device>, options: &MoveOptions) -> Result<()> {
        let given = [("ramp_up_sp", options.ramp_up_ms), ("ramp_down_sp", options.ramp_down_ms)];
        for (attribute, milliseconds) in given {
            if let Some(milliseconds) = milliseconds {
                self.0.push((Arc::clone(motor), attribute, motor.number(attribute)?));
                motor.write_number(attribute, milliseconds)?;
            }
        }
        Ok(())
    }
}

impl Drop for Ramps {
    fn drop(&mut self) {
        // In reverse. What cannot be put back belongs to a motor that was
        // unplugged.
        for (motor, attribute, milliseconds) in self.0.drain(..).rev() {
            let _ = motor.write_number(attribute, milliseconds);
        }
    }
}

/// Finds out, before anything is written to any of them, whether the motors'
/// files are open to us.
pub(crate) fn prepare(motors: &[Arc<Device>]) -> Result<()> {
    motors.iter().try_for_each(|motor| motor.prepare("command"))
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

/// The tacho motors at these ports, each of them another, or `None` if one is
/// absent.
fn find_each<'a>(
    devices: &Devices,
    ports: impl IntoIterator<Item = &'a str>,
) -> Result<Option<Vec<Arc<Device>>>> {
    let found = find_all(devices, ports)?;
    for (index, motor) in found.iter().flatten().enumerate() {
        if found.iter().flatten().take(index).any(|other| Arc::ptr_eq(other, motor)) {
            return Err(Error::Twice { port: motor.port().to_owned() });
        }
    }
    Ok(found)
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
