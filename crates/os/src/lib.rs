//! The operating system, for the other crates: the kernel's error numbers, the
//! clock of the wall, and sleep.
//!
//! On Unix these are rustix's and the standard library's. In WebAssembly there is no operating
//! system: error numbers and their words are those of Linux, a page has the clock ([`page`]), and
//! nobody can sleep.
pub mod linux;
#[cfg(unix)]
pub mod mailbox;
#[cfg(not(unix))]
pub mod page;
pub mod processes;
#[cfg(unix)]
pub mod sockets;

#[cfg(not(unix))]
pub use linux::Errno;
#[cfg(not(unix))]
pub use page::{Instant, process_id, sleep};
#[cfg(unix)]
pub use rustix::io::Errno;
#[cfg(unix)]
pub use std::process::id as process_id;
#[cfg(unix)]
pub use std::thread::sleep;
#[cfg(unix)]
pub use std::time::Instant;

use std::error::Error;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Locks a mutex. A thread that panicked while it held the lock has left the value in order.
pub fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What the kernel says of an error, without the number that Rust adds.
pub fn words(error: &(dyn Error + 'static)) -> String {
    #[cfg(not(unix))]
    if let Some(errno) = error.downcast_ref().and_then(Errno::from_io_error) {
        return errno.to_string();
    }
    let mut text = error.to_string();
    if let Some(number) = text.find(" (os error ") {
        text.truncate(number);
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_are_without_the_number() {
        assert_eq!(words(&std::io::Error::from(Errno::NODEV)), "No such device");
        assert_eq!(words(&std::io::Error::other("no text")), "no text");
    }
}
