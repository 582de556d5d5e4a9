//! The units in which simulated time passes.

/// One turn of the kernel's motor loop.
pub(crate) const TICK_MS: u64 = 2;
pub(crate) const TICK_US: u64 = TICK_MS * 1000;
pub(crate) const TICK_SECONDS: f64 = 0.002;
/// Kernel timers fire on a grid of 10 ms (HZ = 100).
pub(crate) const JIFFY_TICKS: u64 = 5;

/// The number of ticks that take at least this long. No time is negative here.
pub(crate) fn ticks_from_ms(ms: i32) -> u64 {
    u64::from(ms.unsigned_abs()).div_ceil(TICK_MS)
}
