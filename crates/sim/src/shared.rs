//! A machine that several threads use, and a way to wait for its time to pass.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::machine::Machine;

/// A machine behind a lock. The thread with the clock calls [`Shared::step`], or steps under the
/// lock and calls [`Shared::wake`]. A thread that waits for a change calls [`Shared::wait`] and
/// checks again.
#[derive(Debug)]
pub struct Shared {
    machine: Mutex<Machine>,
    changed: Condvar,
}

impl Shared {
    /// Takes a machine in.
    #[must_use]
    pub fn new(machine: Machine) -> Shared {
        Shared { machine: Mutex::new(machine), changed: Condvar::new() }
    }

    /// The machine, for as long as the guard lives. A thread that panicked with the lock in its
    /// hand leaves a machine that is still in order, at most in the middle of a step.
    pub fn lock(&self) -> MutexGuard<'_, Machine> {
        self.machine.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Lets virtual time pass and wakes all waiting threads.
    pub fn step(&self, dt: Duration) {
        self.lock().step(dt);
        self.wake();
    }

    /// Wakes all waiting threads, to check again.
    pub fn wake(&self) {
        self.changed.notify_all();
    }

    /// Releases the lock until [`Shared::wake`] is called, for at most this wall time.
    pub fn wait<'a>(
        &self,
        guard: MutexGuard<'a, Machine>,
        at_most: Duration,
    ) -> MutexGuard<'a, Machine> {
        let woken = self.changed.wait_timeout(guard, at_most);
        woken.unwrap_or_else(PoisonError::into_inner).0
    }
}
