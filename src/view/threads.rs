//! The threads that serve pages.
use crate::glue::state::follow_main_thread;
use crate::glue::watch;
use ev3_sim::stay_outside;
use std::cell::Cell;
use std::fs;
use swipl::fli::{pass_over_thread, this_thread};

/// The clock of the simulation takes threads with such names for no part of the program.
const NAME: &str = "ev3-view";

thread_local! {
    static SERVES: Cell<bool> = const { Cell::new(false) };
}

/// This thread serves a page from now on, or ends.
pub(super) fn serve(serves: bool) {
    if serves != SERVES.replace(serves) {
        // Where the kernel has no such file, the clock takes the thread for one of the program's.
        let _ = fs::write("/proc/thread-self/comm", NAME);
        stay_outside(serves);
        follow_main_thread(serves);
    }
    pass_over_thread(this_thread(), serves);
}

/// The program's threads that have used devices, by their numbers.
pub(super) fn users() -> impl Iterator<Item = u64> {
    watch::users().filter_map(|thread| u64::try_from(thread).ok())
}

/// Whether this thread serves a page.
pub(super) fn serves() -> bool {
    SERVES.get()
}
