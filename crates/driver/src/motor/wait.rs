//! Waiting for motors.
//!
//! The kernel announces a change of `state` every 50 ms, on the EV3 only, and a state that comes
//! and goes between two announcements never. Other boards announce nothing, and plain files cannot.
//! So a wait here sleeps in poll(2), but never for longer than [`SLICE`], then samples again;
//! toward the end that position and speed predict it samples every [`SHORT_SLICE`].
use crate::device::Device;
use crate::device::motion::{End, MotorRun};
use crate::device::registry::Registry;
use crate::error::{Interrupted, Result};
use crate::sysfs::{AttributeFile, SLICE};
use crate::wait::{Look, Slices, Wait};
use ev3_os::Errno;
use std::sync::Arc;
use std::time::Duration;

/// The time between two samples when the end is near.
const SHORT_SLICE: Duration = Duration::from_millis(2);

/// How long after a command `running` may still be missing: controllers on I2C and SPI report late.
const GRACE: Duration = Duration::from_millis(100);

/// How long `stalled` must last to be believed: some boards flag each start.
const STALLED_FOR: Duration = Duration::from_millis(100);

/// Position error, in counts, at which the regulator's torque must have overcome
/// static friction. The EV3 adds 3 % of its torque for each count (`Ki` 60 every
/// 2 ms), and a motor with a wheel needs some 10 % to break away: a slow one
/// stands still for longer than [`STALLED_FOR`] at each start.
const BEHIND: u64 = 8;

/// How long `stalled` must last while the kernel walks up a ramp. The longest has 60 s to
/// the highest speed, 1020 counts a second or more: it is [`BEHIND`] after
/// `sqrt(2 * 8 * 60 / 1020)` = 0.97 s.
const RAMPS_FOR: Duration = Duration::from_secs(1);

/// How long a position may stay the same under way to one where the board never flags a stall.
const STUCK_FOR: Duration = Duration::from_secs(2);

/// The same for a linear actuator, flagged or not: at 24 counts a second at most
/// its regulation takes seconds to push it off.
const SLOW_STUCK_FOR: Duration = Duration::from_secs(5);

/// How much too early a timed run may end: the kernel's timers count in these.
const TICK: Duration = Duration::from_millis(10);

/// How far from its target a motor may end a move, in tacho counts. The
/// `BrickPi3` ends its moves within 10.
pub(crate) const TOLERANCE: u64 = 10;

/// Why a wait ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// The motors are where they were to go, or have run as long as they were to.
    Reached,
    /// A motor is blocked.
    Stalled,
    /// The time is up.
    Timeout,
    /// A motor is no longer plugged in.
    Unplugged,
    /// Another command stopped a motor before it got there.
    Stopped,
    /// The gyro contradicts the wheels; only of a drive.
    Astray,
}

impl Reason {
    /// The word programs see.
    pub fn word(self) -> &'static str {
        match self {
            Self::Reached => "reached",
            Self::Stalled => "stalled",
            Self::Timeout => "timeout",
            Self::Unplugged => "unplugged",
            Self::Stopped => "stopped",
            Self::Astray => "astray",
        }
    }
}

/// Waits until none of the motors runs, or one of them is blocked or unplugged.
/// Errors: the kernel's; [`Error::Interrupted`](crate::Error::Interrupted).
pub fn wait_for(
    registry: &Arc<Registry>,
    motors: &[Arc<Device>],
    timeout: Option<Duration>,
    interrupted: Interrupted,
) -> Result<Reason> {
    until_done(registry, motors, timeout).block(interrupted)
}

/// The same as a wait that can be left.
pub fn until_done(
    registry: &Arc<Registry>,
    motors: &[Arc<Device>],
    timeout: Option<Duration>,
) -> Slices<UntilDone> {
    Slices::new(UntilDone::new(registry, motors, timeout, Box::new(|_, _| Ok(()))))
}

/// A wait until a flag is among the motor's states, or no longer. Its errors are
/// [`Error::Unplugged`](crate::Error::Unplugged) when the motor is unplugged, the kernel's,
/// and [`Error::Interrupted`](crate::Error::Interrupted).
pub fn until_flag(
    registry: &Arc<Registry>,
    motor: &Arc<Device>,
    flag: &str,
    present: bool,
) -> Slices<UntilFlag> {
    let samples = Samples::new(registry, std::slice::from_ref(motor), None);
    let progress = Progress::new(motor);
    Slices::new(UntilFlag { samples, progress, flag: flag.to_owned(), present })
}

/// Ends a timed run.
pub(super) type EndRun = Box<dyn Fn(&Arc<Device>, MotorRun) -> Result<()> + Send>;

/// Until none of some motors runs.
pub struct UntilDone {
    samples: Samples,
    all: Vec<Progress>,
    reason: Reason,
    end: EndRun,
}

impl UntilDone {
    /// `end` ends a run that goes on after its time.
    pub(super) fn new(
        registry: &Arc<Registry>,
        motors: &[Arc<Device>],
        timeout: Option<Duration>,
        end: EndRun,
    ) -> Self {
        Self {
            samples: Samples::new(registry, motors, timeout),
            all: motors.iter().map(Progress::new).collect(),
            reason: Reason::Reached,
            end,
        }
    }

    fn sample(&mut self) -> Result<Look<Reason>> {
        let now = self.samples.begin()?;
        let mut nearest = None;
        for progress in self.all.iter_mut().filter(|one| !one.is_done) {
            match progress.sample(now)? {
                Sample::Runs(_) if progress.is_overdue(now) => {
                    progress.run.map_or(Ok(()), |run| (self.end)(&progress.motor, run))?;
                    nearest = Some(SHORT_SLICE);
                }
                Sample::Runs(slice) => nearest = nearest.into_iter().chain([slice]).min(),
                Sample::Blocked => return Ok(Look::Over(Reason::Stalled)),
                Sample::Done(Reason::Reached) => {}
                Sample::Done(other) => self.reason = other,
            }
        }
        Ok(match nearest {
            None => Look::Over(self.reason),
            Some(slice) => self.samples.again(now, slice, Reason::Timeout),
        })
    }
}

impl Wait for UntilDone {
    type End = Reason;

    fn look(&mut self) -> Result<Look<Reason>> {
        match self.sample() {
            Err(error) if error.is_unplugged() => {
                // The caller may ask which motor it was: list again at once.
                self.samples.registry.forget_listings();
                Ok(Look::Over(Reason::Unplugged))
            }
            sampled => sampled,
        }
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        Ok(self.samples.pause(end))
    }
}

/// Until a motor's state has a flag, or no longer.
pub struct UntilFlag {
    samples: Samples,
    progress: Progress,
    flag: String,
    present: bool,
}

impl UntilFlag {
    fn sample(&mut self) -> Result<Look<()>> {
        let now = self.samples.begin()?;
        let Self { samples, progress, flag, present } = self;
        let is_there = progress.motor.with_word("state", |state| has(state, flag))?;
        let slice = if !is_there && !progress.is_confirmed()? {
            SHORT_SLICE
        } else {
            progress.has_run |= is_there && flag == "running";
            // Right after a command the motor may not run yet; this is not its end.
            if is_there == *present && (*present || flag != "running" || progress.is_over(now)?) {
                return Ok(Look::Over(()));
            }
            progress.slice(now)?
        };
        Ok(samples.again(now, slice, ()))
    }
}

impl Wait for UntilFlag {
    type End = ();

    fn look(&mut self) -> Result<Look<()>> {
        match self.sample() {
            Err(error) if error.is_unplugged() => Err(self.progress.motor.unplugged()),
            sampled => sampled,
        }
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        Ok(self.samples.pause(end))
    }
}

/// When to look at motors again.
struct Samples {
    registry: Arc<Registry>,
    motors: Vec<Arc<Device>>,
    deadline: Option<Duration>,
    /// Whether the kernel may announce the next change.
    listens: bool,
    /// Whether time has passed since the last sample.
    has_paused: bool,
}

impl Samples {
    fn new(registry: &Arc<Registry>, motors: &[Arc<Device>], timeout: Option<Duration>) -> Self {
        let now = registry.tree().now();
        Self {
            registry: Arc::clone(registry),
            motors: motors.to_vec(),
            deadline: timeout.map(|timeout| now.saturating_add(timeout)),
            listens: true,
            has_paused: false,
        }
    }

    /// The time of the next sample; an error if a motor is gone.
    fn begin(&mut self) -> Result<Duration> {
        if std::mem::take(&mut self.has_paused) {
            for motor in &self.motors {
                if !self.registry.has(motor)? {
                    return Err(motor.unplugged());
                }
            }
        }
        Ok(self.registry.tree().now())
    }

    /// When to take the next one, unless the time is up.
    fn again<T>(&self, now: Duration, slice: Duration, over: T) -> Look<T> {
        Look::again(now, slice.min(SLICE), self.deadline, over)
    }

    fn pause(&mut self, end: Duration) -> bool {
        let tree = self.registry.tree();
        let attributes: Vec<_> = self.motors.iter().map(|one| one.attribute("state")).collect();
        let nodes: Vec<&dyn AttributeFile> = attributes
            .iter()
            .filter(|_| self.listens)
            .filter_map(|attribute| attribute.reader(tree).ok())
            .collect();
        if !tree.pause(&nodes, end).unwrap_or(true) {
            return false;
        }
        // Woken early, and perhaps for nothing: sleep through the next slice, so that a
        // descriptor that is always ready does not make us spin.
        self.listens = !self.listens || tree.now() >= end;
        self.has_paused = true;
        true
    }
}

/// One motor under observation.
struct Progress {
    motor: Arc<Device>,
    /// The command under way when the wait began. If the motor gets another one, it
    /// does not reach the end of this one.
    run: Option<MotorRun>,
    has_run: bool,
    is_done: bool,
    /// Whether the last sample found nothing running.
    was_quiet: bool,
    stalled_since: Option<Duration>,
    /// A position, and since when it has been that.
    stuck: Option<(i64, Duration)>,
}

/// The result of one sample.
enum Sample {
    /// It runs; take the next sample after this time.
    Runs(Duration),
    /// It runs, and does not move.
    Blocked,
    /// It does not run any more.
    Done(Reason),
}

impl Progress {
    fn new(motor: &Arc<Device>) -> Self {
        Self {
            motor: Arc::clone(motor),
            run: *motor.run(),
            has_run: false,
            is_done: false,
            was_quiet: false,
            stalled_since: None,
            stuck: None,
        }
    }

    fn sample(&mut self, now: Duration) -> Result<Sample> {
        let [runs, holds, stalled, ramps] = self.motor.with_word("state", |state| {
            ["running", "holding", "stalled", "ramping"].map(|flag| has(state, flag))
        })?;
        // Controllers on I2C go on running while they hold. As theirs may be
        // the state of the move before, what counts is whether it is there.
        if runs && !(holds && self.is_at_end(now)?) {
            self.has_run = true;
            self.was_quiet = false;
            let since = stalled.then(|| *self.stalled_since.get_or_insert(now));
            self.stalled_since = since;
            let lasts = match since {
                Some(since) => now.saturating_sub(since) >= self.believed_after(ramps)?,
                None => false,
            };
            if lasts || self.is_stuck(now)? {
                return Ok(Sample::Blocked);
            }
            return Ok(Sample::Runs(self.slice(now)?));
        }
        if !self.is_confirmed()? {
            return Ok(Sample::Runs(SHORT_SLICE));
        }
        // Not even `holding` is believed at once: it may be that of the move before.
        if !self.is_over(now)? {
            return Ok(Sample::Runs(self.slice(now)?));
        }
        self.is_done = true;
        let is_there = self.is_at_end(now)? || !self.has_run && self.is_plain()?;
        Ok(Sample::Done(if is_there { Reason::Reached } else { Reason::Stopped }))
    }

    /// Whether a missing flag can be believed. A plain file is empty for a
    /// moment while another program writes it: that takes a second sample.
    fn is_confirmed(&mut self) -> Result<bool> {
        let was_quiet = std::mem::replace(&mut self.was_quiet, true);
        Ok(was_quiet || !self.is_plain()?)
    }

    /// Whether the motor consists of plain files. There no motor ever moves, so a motor
    /// that does not run counts as arrived, as in the paper.
    fn is_plain(&self) -> Result<bool> {
        self.motor.attribute("state").is_plain(self.motor.tree())
    }

    /// Whether a motor that does not run has run already, rather than not yet.
    fn is_over(&self, now: Duration) -> Result<bool> {
        let started = self.run.map(|run| run.started);
        let is_late = started.is_none_or(|started| now.saturating_sub(started) >= GRACE);
        Ok(is_late || self.has_run || self.is_at_end(now)?)
    }

    /// Whether the motor is where its motion was to end, or beyond that, as a
    /// motor that coasts; or whether it has run for its time.
    fn is_at_end(&self, now: Duration) -> Result<bool> {
        let Some(run) = self.run else {
            return Ok(true);
        };
        Ok(match run.end {
            End::Position { from, target } => {
                let position = self.motor.number("position")?;
                let is_beyond =
                    if target >= from { position >= target } else { position <= target };
                is_beyond || target.abs_diff(position) <= TOLERANCE
            }
            End::Time(time) => now.saturating_add(TICK) >= run.started.saturating_add(time),
            End::Never => false,
        })
    }

    /// Whether a timed run is to be ended: its time is up, and the motor got no other command.
    fn is_overdue(&self, now: Duration) -> bool {
        let end = self.run.and_then(|run| match run.end {
            End::Time(time) => Some(run.started.saturating_add(time)),
            End::Position { .. } | End::Never => None,
        });
        end.is_some_and(|end| now >= end) && *self.motor.run() == self.run
    }

    /// How long `stalled` must last to be believed, at the motor's speed. A ramp begins with none.
    fn believed_after(&self, ramps: bool) -> Result<Duration> {
        let speed = self.motor.number("speed_sp")?.unsigned_abs();
        let slowly = Duration::from_millis((BEHIND * 1000).checked_div(speed).unwrap_or(0));
        Ok(if self.motor.is_linear() {
            SLOW_STUCK_FOR
        } else {
            slowly.clamp(if ramps { RAMPS_FOR } else { STALLED_FOR }, STUCK_FOR)
        })
    }

    /// Whether the position has been the same for too long under way.
    fn is_stuck(&mut self, now: Duration) -> Result<bool> {
        if !matches!(self.run, Some(MotorRun { end: End::Position { .. }, .. })) {
            return Ok(false);
        }
        let position = self.motor.number("position")?;
        let patience = if self.motor.is_linear() { SLOW_STUCK_FOR } else { STUCK_FOR };
        match self.stuck {
            Some((before, since)) if before == position => {
                Ok(now.saturating_sub(since) >= patience)
            }
            _ => {
                self.stuck = Some((position, now));
                Ok(false)
            }
        }
    }

    /// The time to the next sample: until shortly before the predicted end.
    fn slice(&self, now: Duration) -> Result<Duration> {
        let left = match self.run.map(|run| (run.started, run.end)) {
            Some((_, End::Position { target, .. })) => {
                let position = self.motor.number("position")?;
                let speed = match self.motor.number("speed") {
                    // Controllers on I2C do not measure it.
                    Err(error) if error.errno() == Some(Errno::OPNOTSUPP) => 0,
                    speed => speed?.unsigned_abs(),
                };
                let counts = target.abs_diff(position);
                let milliseconds = counts.saturating_mul(1000).checked_div(speed);
                milliseconds.map_or(SLICE, Duration::from_millis)
            }
            Some((started, End::Time(time))) => started.saturating_add(time).saturating_sub(now),
            Some((_, End::Never)) | None => SLICE,
        };
        Ok(left.clamp(SHORT_SLICE, SLICE))
    }
}

/// Whether a flag is among those of a state.
pub(crate) fn has(state: &str, flag: &str) -> bool {
    state.split_ascii_whitespace().any(|word| word == flag)
}
