//! The latch: while it is set, no motor can be started, by no thread and in no tree.
//!
//! A program whose motors were stopped could start them again before it ends, or before it has been
//! interrupted. So whatever starts a motor looks at the latch last, beside its write and under the
//! motor's lock; and a stop of the motors sets it first. A handler of a signal may do so, too.
use std::sync::atomic::{AtomicU8, AtomicU32, Ordering};

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

/// How many threads are between their look at the latch and the end of their write.
static STARTING: AtomicU32 = AtomicU32::new(0);

/// A thread that is about to start a motor, until it has written that.
#[must_use]
pub struct Starting(());

impl Starting {
    /// To be called before the look at the latch.
    #[inline]
    pub fn begin() -> Self {
        STARTING.fetch_add(1, Ordering::SeqCst);
        Self(())
    }
}

impl Drop for Starting {
    #[inline]
    fn drop(&mut self) {
        STARTING.fetch_sub(1, Ordering::SeqCst);
    }
}

/// Whether a thread may have looked at the latch before it was set, and has not written yet.
#[cfg(unix)]
pub(crate) fn is_any_starting() -> bool {
    STARTING.load(Ordering::SeqCst) != 0
}

/// Sets the latch for a reason.
pub fn set(reason: Reason) {
    REASONS.fetch_or(reason as u8, Ordering::SeqCst);
}

/// That reason holds no more.
pub fn lift(reason: Reason) {
    REASONS.fetch_and(!(reason as u8), Ordering::SeqCst);
}

/// Whether motors may not be started now.
pub fn is_set() -> bool {
    REASONS.load(Ordering::SeqCst) != 0
}

/// Whether it is set for that reason.
pub fn is_set_as(reason: Reason) -> bool {
    REASONS.load(Ordering::SeqCst) & reason as u8 != 0
}

/// Whether the program is about to end.
pub fn is_ending() -> bool {
    is_set_as(Reason::Ending) || is_set_as(Reason::Halting)
}

/// A stop is one of all motors, also of those of another test.
#[cfg(test)]
pub(crate) static ALONE: std::sync::Mutex<()> = std::sync::Mutex::new(());

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicBool;
    use std::sync::mpsc;
    use std::thread;
    use std::time::Duration;

    static WRITTEN: AtomicBool = AtomicBool::new(false);

    #[test]
    fn a_stop_waits_for_those_who_looked_at_the_latch_before() {
        let _alone = ALONE.lock().unwrap();
        let (looks, looked) = mpsc::channel();
        let writer = thread::spawn(move || {
            let starting = Starting::begin();
            assert!(!is_set());
            looks.send(()).unwrap();
            thread::sleep(Duration::from_millis(20));
            WRITTEN.store(true, Ordering::SeqCst);
            drop(starting);
        });
        looked.recv().unwrap();
        crate::stop_for(Reason::Crashed);
        assert!(WRITTEN.load(Ordering::SeqCst));
        lift(Reason::Crashed);
        writer.join().unwrap();
        assert!(!is_any_starting());
    }
}
