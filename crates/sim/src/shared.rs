//! A machine that several threads use, and a way to wait for its time to pass.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use crate::machine::Machine;

/// A machine behind a lock. Whoever has the clock calls [`Shared::step`], or steps under the lock
/// and calls [`Shared::wake`]; whoever waits for something calls [`Shared::wait`] and looks again.
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

    /// Lets virtual time pass and wakes everybody who waits.
    pub fn step(&self, dt: Duration) {
        self.lock().step(dt);
        self.wake();
    }

    /// Wakes everybody who waits, to look again.
    pub fn wake(&self) {
        self.changed.notify_all();
    }

    /// Gives the lock away until somebody calls [`Shared::wake`], for so much wall time at most.
    pub fn wait<'a>(
        &self,
        guard: MutexGuard<'a, Machine>,
        at_most: Duration,
    ) -> MutexGuard<'a, Machine> {
        let woken = self.changed.wait_timeout(guard, at_most);
        woken.unwrap_or_else(PoisonError::into_inner).0
    }
}
