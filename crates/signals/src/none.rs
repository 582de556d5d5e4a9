//! Without signals and processes: a page ends a program by ending its worker, and no
//! motor outlives that.
use crate::latch::{self, Reason};
use std::io;
use std::time::Duration;

/// What a watchdog asks. Nobody does here.
pub struct Asked {
    /// Whether a signal will end the program.
    pub ends: fn(&'static str, bool) -> bool,
    /// Stops the motors.
    pub stop: fn(),
    /// Stops those of a thread that computes.
    pub computes: fn(u64, Duration),
}

/// No signal arrives.
pub fn watch(_asked: Asked) -> io::Result<()> {
    Ok(())
}

/// On a virtual clock nothing moves while a thread computes.
pub fn guard(_name: u64, _limit: Duration) {}

/// Nobody asks.
pub fn lives() {}

/// Nothing outlives the program.
pub fn survive(_is_wanted: bool) {}

/// There is no handler.
pub fn own_handlers_stack() {}

/// No signal has arrived.
pub fn halts(_signal: &str) {}

/// Nobody waits for the end.
pub fn is_to_halt(_halts: bool) {}

/// No file is kept.
pub fn leave() {}

/// Keeps all motors from starting.
pub fn stop_for(reason: Reason) {
    latch::set(reason);
}
