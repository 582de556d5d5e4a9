//! Motors: set-points, commands, moves of several motors at once.
//!
//! A command to a motor takes two steps. Set-points (`speed_sp`, `position_sp`, `stop_action`,
//! `ramp_up_sp` ...) are stored; the next `command` copies them all and starts. Nothing that is
//! written to a set-point changes a motion under way (kernel, `tacho_motor_class.c`). So each
//! function here writes the set-points that its command depends on first. Several motors get all
//! their set-points first and then their commands one right after the other.
pub(crate) mod claim;
pub(crate) mod command;
pub mod dc;
pub(crate) mod plan;
mod ramped;
pub mod servo;
pub mod wait;

use crate::class::Class;
use crate::device::Device;
use crate::device::motion::{self, End, MotorRun};
use crate::device::registry::Registry;
use crate::device::retry::{self, while_permissions_settle};
use crate::error::{Error, Interrupted, Result};
use crate::wait::{Look, Slices, Wait};
pub use command::{StopAction, command, reset, stop, stop_all};
use command::{best_effort, start_all, stop_best_effort, stop_run};
pub(crate) use command::{prepare, runs_on, start};
use plan::plan;
pub use plan::{
    Extent, Move, Speed, counts_per_unit, known_counts, measured, set_gear, set_position,
};
pub(crate) use plan::{duty, milliseconds};
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;
use wait::{Reason, UntilDone, has};

/// A motor and the speed at which to run.
#[derive(Clone, Debug)]
pub struct Run<'a> {
    /// The motor's port.
    pub port: &'a str,
    /// The speed; its sign is the direction.
    pub speed: Speed,
}

/// How a move is made and ended.
#[derive(Clone, Copy, Debug)]
pub struct MoveOptions {
    /// The action of the motors once they are there.
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
    /// To the very position, and wait for it. A motor that coasts or brakes overshoots its target.
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

/// Stops every motor, of any class, that was started and not stopped since. One
/// that is gone has nothing to stop.
pub fn stop_started(registry: &Registry) -> Result<()> {
    let mut result = Ok(());
    for class in Class::MOTORS {
        // Motors that were started are listed already: nothing needs to be opened.
        for motor in registry.known(class).iter().filter(|motor| motor.run().is_some()) {
            result = result.and(match class {
                Class::ServoMotor => best_effort(start(motor, "float", None)),
                _ => stop_best_effort(motor, StopAction::Brake),
            });
        }
    }
    result
}

/// The motors that were started and still turn. One that cannot be read does not.
pub fn running(registry: &Registry) -> Vec<Arc<Device>> {
    let turns = |motor: &Arc<Device>| {
        let is_running = |state: &str| has(state, "running") && !has(state, "holding");
        motor.run().is_some() && motor.with_word("state", is_running).unwrap_or(false)
    };
    let known = [Class::TachoMotor, Class::DcMotor].map(|class| registry.known(class));
    known.iter().flat_map(|motors| motors.iter().filter(|motor| turns(motor))).cloned().collect()
}

/// The number of this thread among those that command motors.
pub fn commander() -> u32 {
    motion::commander()
}

/// Stops the motors that turn, and got their last command from that thread, or from any; those that
/// turned.
pub fn stop_turning(registry: &Registry, commander: Option<u32>) -> Vec<Arc<Device>> {
    let mut motors = running(registry);
    motors.retain(|motor| commander.is_none_or(|by| motor.is_commanded_by(by)));
    for motor in &motors {
        // One that is gone has nothing to stop.
        let _ = stop_best_effort(motor, StopAction::Brake);
    }
    motors
}

/// How many commands the program has given to motors so far.
pub fn command_count() -> u32 {
    motion::command_count()
}

/// Stops the motors that were started, and whose last command by the program was one of
/// these, counted from 0, and of this thread. A robot's motors are commanded when its course begins.
pub fn stop_commanded(registry: &Registry, commands: &Range<u32>) -> Result<()> {
    let mut result = Ok(());
    for class in [Class::TachoMotor, Class::DcMotor] {
        let all = registry.known(class);
        let is_one =
            |motor: &&Arc<Device>| motor.is_commanded_in(commands) && motor.run().is_some();
        for motor in all.iter().filter(is_one) {
            result = result.and(stop_best_effort(motor, StopAction::Brake));
        }
    }
    result
}

/// Stops all motors that are connected, also those of other programs; servos keep their positions.
/// One whose files udev has not opened yet is waited for, once all others are stopped.
/// Errors: the kernel's. If the motors cannot be listed, those of the last listing are stopped.
/// [`Error::Interrupted`].
pub fn stop_connected(registry: &Registry, interrupted: Interrupted) -> Result<()> {
    let (mut left, mut listed) = (Vec::new(), Ok(()));
    for class in [Class::TachoMotor, Class::DcMotor] {
        let motors = registry.all(class).unwrap_or_else(|error| {
            listed = Err(error);
            registry.known(class)
        });
        left.extend(motors.iter().cloned());
    }
    let stop_rest = || {
        let mut result = Ok(());
        left.retain(|motor| match stop_best_effort(motor, StopAction::Brake) {
            Ok(()) => false,
            Err(error) => {
                result = Err(error);
                true
            }
        });
        result
    };
    while_permissions_settle(registry, interrupted, stop_rest).and(listed)
}

/// Runs motors until they are stopped: the motors, or `None` if one is absent or cannot run at its
/// speed; then nothing has moved. Errors: the kernel's. A motor that goes away while the others
/// start stops them. [`Error::DuplicatePort`]; [`Interrupted`](Error::Interrupted).
pub fn run_forever(
    registry: &Registry,
    runs: &[Run],
    interrupted: Interrupted,
) -> Result<Option<Vec<Arc<Device>>>> {
    while_permissions_settle(registry, interrupted, || run_forever_once(registry, runs))
}

fn run_forever_once(registry: &Registry, runs: &[Run]) -> Result<Option<Vec<Arc<Device>>>> {
    let Some(motors) = find_each(registry, runs.iter().map(|run| run.port))? else {
        return Ok(None);
    };
    let speed = |(motor, run): (&Arc<Device>, &Run)| run.speed.in_counts(motor);
    // All of them, before anything is written.
    let possible = motors.iter().zip(runs).map(speed).collect::<Result<Option<Vec<i64>>>>()?;
    let Some(speeds) = possible else {
        return Ok(None);
    };
    prepare(&motors)?;
    run_at(&motors, speeds)?;
    Ok(Some(motors))
}

/// Runs a motor until it is stopped, as [`run_forever`] does, if nothing has to be waited for.
pub fn run_one(motor: &Arc<Device>, speed: Speed) -> Result<bool> {
    let Some(counts) = speed.in_counts(motor)? else {
        return Ok(false);
    };
    let motors = std::slice::from_ref(motor);
    prepare(motors)?;
    run_at(motors, [counts])?;
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
/// Errors: the kernel's, as EINVAL of a motor that cannot; [`Error::Interrupted`].
pub fn run_direct(
    registry: &Registry,
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
    Ok(retry::with(registry, class, port, interrupted, run)?.is_some())
}

/// Turns motors, all at once. `None` if one is absent, or the move is impossible: a speed of 0 or
/// beyond the motor's, an angle or a time beyond what the kernel counts; then nothing has moved.
///
/// Without [`MoveOptions::wait`] the answer is [`Reason::Reached`] once the
/// motors are started. A move that does not reach its end is stopped.
/// Errors: the kernel's; [`Unplugged`](crate::Error::Unplugged) if one is unplugged under way;
/// [`Interrupted`](crate::Error::Interrupted) if the caller abandoned the wait. The motors are
/// stopped before. [`Error::DuplicatePort`].
pub fn run_to(
    registry: &Arc<Registry>,
    moves: &[Move],
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Option<Reason>> {
    match begin(registry, moves, options, &mut *interrupted)? {
        Some(moving) => moving.block(interrupted).map(Some),
        None => Ok(None),
    }
}

/// The same as a wait that can be left: that stops the motors.
pub fn begin(
    registry: &Arc<Registry>,
    moves: &[Move],
    options: &MoveOptions,
    interrupted: Interrupted,
) -> Result<Option<Slices<Moving>>> {
    let start = || start_moves(registry, moves, options);
    let motors = while_permissions_settle(registry, interrupted, start)?;
    Ok(motors.map(|motors| Slices::new(Moving::new(registry, motors, options))))
}

/// Motors that make a move.
pub struct Moving {
    registry: Arc<Registry>,
    motors: Vec<Arc<Device>>,
    /// `None` if nobody waits for the end.
    wait: Option<UntilDone>,
    is_left_alone: bool,
}

impl Moving {
    pub(crate) fn new(
        registry: &Arc<Registry>,
        motors: Vec<Arc<Device>>,
        options: &MoveOptions,
    ) -> Self {
        let options = *options;
        let end = move |motor: &Arc<Device>, run| end_timed_run(motor, run, &options);
        let wait =
            options.wait.then(|| UntilDone::new(registry, &motors, options.timeout, Box::new(end)));
        let registry = Arc::clone(registry);
        Self { registry, motors, wait, is_left_alone: !options.wait }
    }
}

impl Wait for Moving {
    type End = Reason;

    fn look(&mut self) -> Result<Look<Reason>> {
        let Some(wait) = &mut self.wait else {
            return Ok(Look::Over(Reason::Reached));
        };
        let found = wait.look()?;
        let Look::Over(reason) = found else {
            return Ok(found);
        };
        let gone = self.motors.iter().find(|motor| !self.registry.has(motor).unwrap_or(false));
        if let (Reason::Unplugged, Some(gone)) = (reason, gone) {
            return Err(gone.unplugged());
        }
        self.is_left_alone = reason == Reason::Reached;
        Ok(found)
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        self.wait.as_mut().map_or(Ok(true), |wait| wait.pause(end))
    }
}

impl Drop for Moving {
    /// No motor may keep turning, however the wait ended. The result already says
    /// that a motor was unplugged, so the error of stopping it is ignored.
    fn drop(&mut self) {
        if !self.is_left_alone {
            let _ = stop_all(&self.motors, StopAction::Brake);
        }
    }
}

/// Ends a timed run at its time: the kernel's timer is late, by up to an eighth of it
/// (docs/ev3dev-sysfs.md, 0.5).
fn end_timed_run(motor: &Arc<Device>, run: MotorRun, options: &MoveOptions) -> Result<()> {
    // A stop with a ramp up only would take a step of it.
    let has_ramp_up = ramped::ramps(motor)?[0] > 0;
    let ramp_up_ms = has_ramp_up.then_some(0);
    let mut ramps = Ramps::default();
    ramps.set(motor, &MoveOptions { ramp_up_ms, ..*options })?;
    stop_run(motor, run)
}

/// Starts the motors of a move; `None` if one is absent or cannot make it.
fn start_moves(
    registry: &Registry,
    moves: &[Move],
    options: &MoveOptions,
) -> Result<Option<Vec<Arc<Device>>>> {
    let Some(motors) = find_each(registry, moves.iter().map(|one| one.port))? else {
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

/// Makes the first relative move count from where the motor is: the last command of an earlier
/// program is unknown, and may be another relative move. See `plan_by`.
fn count_from_here(motor: &Device) -> Result<()> {
    if motor.run().is_none() { motor.write("command", "stop") } else { Ok(()) }
}

/// The ramps that the motors had before a move with its own. The command copies them, so that they
/// are put back as soon as the motors run, or when they could not start.
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
        // In reverse order. Errors are ignored: the motor was unplugged.
        for (motor, attribute, milliseconds) in self.0.drain(..).rev() {
            let _ = motor.write_number(attribute, milliseconds);
        }
    }
}

/// The tacho motors at these ports, each of them another, or `None` if one is absent.
fn find_each<'a>(
    registry: &Registry,
    ports: impl IntoIterator<Item = &'a str>,
) -> Result<Option<Vec<Arc<Device>>>> {
    let found = find_all(registry, ports)?;
    for (index, motor) in found.iter().flatten().enumerate() {
        if found.iter().flatten().take(index).any(|other| Arc::ptr_eq(other, motor)) {
            return Err(Error::DuplicatePort { port: motor.port().to_owned() });
        }
    }
    Ok(found)
}

/// The tacho motors at these ports, or `None` if one is absent.
/// Errors: the kernel's, as ENODEV for one that was just unplugged.
pub fn find_all<'a>(
    registry: &Registry,
    ports: impl IntoIterator<Item = &'a str>,
) -> Result<Option<Vec<Arc<Device>>>> {
    let find = |port| match registry.find(Class::TachoMotor, port)? {
        Some(motor) => motor.check_present().map(|()| Some(motor)),
        None => Ok(None),
    };
    ports.into_iter().map(find).collect()
}
