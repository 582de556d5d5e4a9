//! Locks under which files are read.
//!
//! On a clock that passes as files are read, what is to be done at a fixed
//! period ([`Sysfs::every`](crate::sysfs::Sysfs::every)) is done in the middle of
//! a read. What that needs may then be locked by this very thread, which must
//! not wait for itself, or by another one, for which it must wait: otherwise
//! time would run away from a thread that has just lost its processor.
use std::cell::Cell;
use std::ops::{Deref, DerefMut};
use std::sync::{Mutex, MutexGuard, PoisonError};

thread_local! {
    /// How many of them this thread holds.
    static COUNT: Cell<usize> = const { Cell::new(0) };
}

/// What is behind such a lock, for as long as this lives.
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
