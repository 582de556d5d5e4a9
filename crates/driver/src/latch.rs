//! The latch of an emergency stop.
//!
//! While it is set, no motor can be started, by no thread and in no tree: so a program whose
//! motors were stopped cannot start them again before it has been interrupted.
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

static IS_SET: AtomicBool = AtomicBool::new(false);

/// Sets the latch, or lifts it.
pub fn set(is_set: bool) {
    IS_SET.store(is_set, Ordering::SeqCst);
}

/// Whether motors may not be started now.
#[must_use]
pub fn is_set() -> bool {
    IS_SET.load(Ordering::SeqCst)
}

/// Whether a text may not be written to this file, because it starts a motor.
pub(crate) fn refuses(path: &Path, text: &str) -> bool {
    is_set() && path.ends_with("command") && text.trim_start().starts_with("run")
}
