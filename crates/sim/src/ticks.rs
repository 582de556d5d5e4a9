//! The units in which simulated time passes.
use std::time::Duration;

/// One turn of the kernel's motor loop.
pub(crate) const TICK_MS: u64 = 2;
pub(crate) const TICK_US: u64 = TICK_MS * 1000;
pub(crate) const TICK_SECONDS: f64 = 0.002;
/// Kernel timers fire on a grid of 10 ms (HZ = 100).
pub(crate) const JIFFY_TICKS: u64 = 5;

/// A time in milliseconds. None is negative here.
pub(crate) fn milliseconds(ms: i32) -> Duration {
    Duration::from_millis(ms.unsigned_abs().into())
}

/// The number of ticks that take at least this long.
pub(crate) fn ticks_from_ms(ms: i32) -> u64 {
    u64::from(ms.unsigned_abs()).div_ceil(TICK_MS)
}
