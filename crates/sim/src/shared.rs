//! A machine that several threads use, and a way to wait for its time to pass.

use ev3_os::Instant;
use std::sync::{Condvar, Mutex, MutexGuard, OnceLock, PoisonError};
use std::time::Duration;

use crate::clock::pace::Pace;
use crate::lock::locked;
use crate::machine::Machine;

/// A machine behind a lock. The thread with the clock calls [`Shared::step`], or steps under the
/// lock and calls [`Shared::wake`]. A thread that waits for a change calls [`Shared::wait`] and
/// checks again.
#[derive(Debug)]
pub struct Shared {
    machine: Mutex<Machine>,
    changed: Condvar,
    /// Locked after the machine.
    wall: OnceLock<Mutex<Wall>>,
    pace: Pace,
}

/// How the machine follows the wall clock.
#[derive(Clone, Copy, Debug)]
struct Wall {
    factor: f64,
    /// Up to when it has.
    last: Instant,
}

/// The most wall time that one step makes up for.
const LATE: Duration = Duration::from_millis(100);

impl Shared {
    /// Takes a machine in.
    #[must_use]
    pub fn new(machine: Machine) -> Shared {
        Shared {
            machine: Mutex::new(machine),
            changed: Condvar::new(),
            wall: OnceLock::new(),
            pace: Pace::default(),
        }
    }

    /// The machine, for as long as the guard lives. A thread that panicked with the lock in its
    /// hand leaves a machine that is still in order, at most in the middle of a step.
    ///
    /// If the machine is to follow the wall clock, this makes up for what has passed since its
    /// last step: so a program that waits 10 ms between two accesses waits 10 ms of the machine's
    /// time, also on a busy computer.
    pub fn lock(&self) -> MutexGuard<'_, Machine> {
        let mut machine = self.lock_as_it_is();
        if self.wall.get().is_some() {
            machine.step(self.behind());
        }
        machine
    }

    /// The same, whatever the time.
    pub(crate) fn lock_as_it_is(&self) -> MutexGuard<'_, Machine> {
        locked(&self.machine)
    }

    /// Follows the wall clock from now on, faster by a factor.
    pub fn follow(&self, factor: f64) {
        let wall = Wall { factor, last: Instant::now() };
        *locked(self.wall.get_or_init(|| Mutex::new(wall))) = wall;
    }

    /// How far the machine is behind the wall clock, in its own time. The caller makes up for it. A
    /// machine that cannot keep up falls behind, but not without limit.
    pub(crate) fn behind(&self) -> Duration {
        let Some(wall) = self.wall.get() else {
            return Duration::ZERO;
        };
        let Wall { factor, last } = &mut *locked(wall);
        let now = Instant::now();
        let passed = now - *last;
        *last = now;
        self.pace.of_wall(passed.min(LATE), *factor)
    }

    /// How fast time may pass.
    pub(crate) fn pace(&self) -> &Pace {
        &self.pace
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
