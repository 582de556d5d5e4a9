//! The last command to a motor: pure data that is kept with the device.
use std::num::NonZeroU32;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// How many commands the program has given to motors. What a drive does on its course is the
/// command that began the course.
static COMMANDS: AtomicU32 = AtomicU32::new(0);

/// The number of the next command.
pub(crate) fn command_count() -> u32 {
    COMMANDS.load(Ordering::Relaxed)
}

pub(super) fn next_command() -> u32 {
    COMMANDS.fetch_add(1, Ordering::Relaxed)
}

/// A number of this thread.
pub(crate) fn commander() -> u32 {
    static THREADS: AtomicU32 = AtomicU32::new(0);
    thread_local! {
        static ME: u32 = THREADS.fetch_add(1, Ordering::Relaxed);
    }
    ME.with(|me| *me)
}

/// The last command to a motor, as far as a wait for its end needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct MotorRun {
    /// When it was started, by the tree's clock.
    pub(crate) started: Duration,
    /// Whether it was started by `run-to-rel-pos`.
    pub(crate) is_relative: bool,
    /// The coordinated motion that has claimed the motor.
    pub(crate) claim: Option<NonZeroU32>,
    pub(crate) end: End,
}

impl MotorRun {
    /// The position at which it ends.
    pub(crate) fn target(self) -> Option<i64> {
        match self.end {
            End::Position { target, .. } => Some(target),
            End::Time(_) | End::Never => None,
        }
    }

    /// The position at which a relative run ends.
    pub(crate) fn relative_target(self) -> Option<i64> {
        self.target().filter(|_| self.is_relative)
    }
}

/// How a run is meant to end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// At a position, in tacho counts, coming from another one.
    Position { from: i64, target: i64 },
    /// After a time.
    Time(Duration),
    /// Not by itself.
    Never,
}
