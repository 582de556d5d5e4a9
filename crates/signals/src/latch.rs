//! The latch: while it is set, no motor can be started, by no thread and in no tree.
//!
//! A program whose motors were stopped could start them again before it ends, or before it
//! has been interrupted. So whatever starts a motor looks at the latch last, beside its
//! write and under the motor's lock; and a stop of the motors sets it first. A handler
//! of a signal may do so, too.
use std::sync::atomic::{AtomicU8, Ordering};

/// Why no motor may start. Each reason is set and lifted for itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Reason {
    /// Somebody pressed STOP, and the program has not been interrupted yet.
    Stopped = 1,
    /// A signal ends the program.
    Ending = 2,
    /// The program has crashed, as far as is known.
    Crashed = 4,
    /// The program stands, as after Ctrl-Z, or has just been continued.
    Standing = 8,
    /// Prolog halts for good, or has begun to, and takes too long.
    Halting = 16,
}

static REASONS: AtomicU8 = AtomicU8::new(0);

/// Sets the latch for a reason.
pub fn set(reason: Reason) {
    REASONS.fetch_or(reason as u8, Ordering::SeqCst);
}

/// That reason holds no more.
pub fn lift(reason: Reason) {
    REASONS.fetch_and(!(reason as u8), Ordering::SeqCst);
}

/// Whether motors may not be started now.
#[must_use]
pub fn is_set() -> bool {
    REASONS.load(Ordering::SeqCst) != 0
}

/// Whether it is set for that reason.
#[must_use]
pub fn is_set_as(reason: Reason) -> bool {
    REASONS.load(Ordering::SeqCst) & reason as u8 != 0
}

/// Whether the program is about to end.
#[must_use]
pub fn is_ending() -> bool {
    is_set_as(Reason::Ending) || is_set_as(Reason::Halting)
}
