//! Locks under which files are read.
//!
//! On the virtual clock, reading a file advances time, and advancing time runs the
//! periodic callbacks ([`Sysfs::every`](crate::sysfs::Sysfs::every)) inside that
//! read. A callback must therefore not take a lock that its own thread already
//! holds. If another thread holds it, the callback must wait, or simulated time
//! would run ahead of a thread that was merely descheduled.
use std::cell::Cell;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

thread_local! {
    /// The number of these locks that this thread holds.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// The guard of such a lock.
pub(crate) struct Held<'a, T>(MutexGuard<'a, T>);

impl<'a, T> Held<'a, T> {
    /// Waits for the lock.
    pub(crate) fn lock(mutex: &'a Mutex<T>) -> Self {
        Self::new(mutex.lock().unwrap_or_else(PoisonError::into_inner))
    }

    pub(crate) fn new(guard: MutexGuard<'a, T>) -> Self {
        COUNT.set(COUNT.get() + 1);
        Self(guard)
    }
}

impl<T> Drop for Held<'_, T> {
    fn drop(&mut self) {
        COUNT.set(COUNT.get() - 1);
    }
}

impl<T> Deref for Held<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T> DerefMut for Held<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}

/// Whether this thread holds one.
pub(crate) fn by_this_thread() -> bool {
    COUNT.get() > 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_is_the_thread_that_holds_one() {
        let (first, second) = (Mutex::new(1), Mutex::new(2));
        assert!(!by_this_thread());
        let one = Held::lock(&first);
        let mut two = Held::lock(&second);
        *two += *one;
        drop(one);
        assert!(by_this_thread(), "of two");
        let other = std::thread::spawn(by_this_thread).join();
        assert!(matches!(other, Ok(false)));
        drop(two);
        assert!(!by_this_thread());
        assert_eq!(*Held::lock(&second), 3);
    }
}
