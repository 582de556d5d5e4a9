//! The events that the watchdog learns: two bytes, the kind of an event and the number of a signal.
//!
//! The bytes go through a socket, so a handler of a signal may write them, too: it takes no lock
//! and never waits.
use nix::libc::c_int;
use std::io::Write;
use std::os::unix::net::UnixStream;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};

/// A handler withholds a signal until the watchdog has looked at it.
pub(crate) const SIGNAL: u8 = b'S';
/// The program stood and was continued.
pub(crate) const CONTINUED: u8 = b'C';
/// The signal will end the program, says the asker.
pub(crate) const ENDS: u8 = b'E';
/// The program goes on after the signal, says the asker.
pub(crate) const GOES_ON: u8 = b'G';
/// Prolog ends the program because of the signal.
pub(crate) const HALTS: u8 = b'H';
/// Prolog has begun to halt, or no longer does if the number is 0.
pub(crate) const IS_TO_HALT: u8 = b'A';
/// The main thread has ended.
pub(crate) const MAIN_IS_OVER: u8 = b'M';
/// A thread computes for too long; the number is that of its slot.
pub(crate) const COMPUTES: u8 = b'T';
/// The program has a child of fork(2).
pub(crate) const FORKED: u8 = b'F';

/// The way to the watchdog.
static WATCHDOG: OnceLock<UnixStream> = OnceLock::new();

/// Whether this is a child of the process that has the threads.
static IS_CHILD: AtomicBool = AtomicBool::new(false);

/// Whether this is a child of fork(2), which has no motors of its own yet.
pub(crate) fn is_child() -> bool {
    IS_CHILD.load(Ordering::Relaxed)
}

/// This is a child of fork(2).
pub(crate) fn be_child() {
    IS_CHILD.store(true, Ordering::Relaxed);
}

/// Whether there is a watchdog.
pub(crate) fn has_watchdog() -> bool {
    WATCHDOG.get().is_some()
}

/// Events go this way from now on.
pub(crate) fn send_to(way: UnixStream) {
    let _ = WATCHDOG.set(way); // the caller has looked that there is none
}

/// Sends the watchdog an event; `false` if there is none.
pub(crate) fn send(event: u8, signal: c_int) -> bool {
    let number = u8::try_from(signal).unwrap_or_default();
    let sent = |mut way: &UnixStream| way.write_all(&[event, number]).is_ok();
    !is_child() && WATCHDOG.get().is_some_and(sent)
}
