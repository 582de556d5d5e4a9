//! Goals that are planned for a simulated time, and run in the thread that planned them;
//! guards, which may not do what others may.
use std::cell::{Cell, OnceCell};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Whether a bell has ever rung. A program that plans nothing pays for one load.
static ANY: AtomicBool = AtomicBool::new(false);

thread_local! {
    static MINE: OnceCell<Bell> = const { OnceCell::new() };
    /// Whether this thread runs a branch: an engine of its own, which has planned no goals.
    static IS_IN_BRANCH: Cell<bool> = const { Cell::new(false) };
}

/// Rings when a goal of a thread is due.
#[derive(Clone, Default)]
pub(crate) struct Bell(Arc<AtomicBool>);

impl Bell {
    /// The bell of this thread.
    #[cfg(feature = "sim")]
    pub(crate) fn of_this_thread() -> Self {
        MINE.with(|mine| mine.get_or_init(Self::default).clone())
    }

    /// A goal is due.
    #[cfg(feature = "sim")]
    pub(crate) fn ring(&self) {
        self.0.store(true, Ordering::Release);
        ANY.store(true, Ordering::Release);
    }
}

/// Another clock is in use: what this thread has planned by it may be due.
pub(crate) fn look_again() {
    MINE.with(|mine| {
        if let Some(bell) = mine.get() {
            bell.0.store(true, Ordering::Release);
        }
    });
}

/// Whether the program has guards. One that has none pays for one load.
static GUARDS: AtomicBool = AtomicBool::new(false);

/// From now on the program may have guards, which must not move anything.
pub(crate) fn note_guards() {
    GUARDS.store(true, Ordering::Relaxed);
}

/// Whether this may be called by a guard.
pub(crate) fn has_guards() -> bool {
    GUARDS.load(Ordering::Relaxed)
}

/// Whether a goal may be due, of any thread.
pub(crate) fn is_any_due() -> bool {
    ANY.load(Ordering::Acquire)
}

/// Goals that are due wait while this thread runs a branch.
pub(crate) fn set_in_branch(is_in_branch: bool) {
    IS_IN_BRANCH.set(is_in_branch);
}

/// Whether this thread runs a branch.
pub(crate) fn is_in_branch() -> bool {
    IS_IN_BRANCH.get()
}

/// Whether this thread's bell has rung since the last call, and its goals can run.
pub(crate) fn has_rung() -> bool {
    is_any_due()
        && !IS_IN_BRANCH.get()
        && MINE.with(|mine| mine.get().is_some_and(|bell| bell.0.swap(false, Ordering::AcqRel)))
}
