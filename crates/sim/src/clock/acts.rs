//! Acts that happen periodically in simulated time.
use crate::machine::Machine;
use crate::shared::Shared;
use ev3_os::locked;
use std::fmt;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard};
use std::thread::{self, ThreadId};
use std::time::Duration;

/// A periodic act in simulated time. It returns the time to its next run, or `None` if it ends.
pub type Act = Box<dyn FnMut() -> Option<Duration> + Send>;

/// The acts, and which thread runs one.
#[derive(Default)]
pub(super) struct PeriodicActs {
    acts: Mutex<Acts>,
    /// Whether a thread runs one: set by itself, so it knows.
    is_any: AtomicBool,
}

#[derive(Default)]
struct Acts {
    due: Vec<Due>,
    /// The thread that runs one now.
    actor: Option<ThreadId>,
}

struct Due {
    at: Duration,
    period: Duration,
    act: Act,
}

impl fmt::Debug for PeriodicActs {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("PeriodicActs").finish_non_exhaustive()
    }
}

impl PeriodicActs {
    pub(super) fn add(&self, now: Duration, period: Duration, act: Act) {
        locked(&self.acts).due.push(Due { at: now.saturating_add(period), period, act });
    }

    /// When the next act is due at the earliest.
    pub(super) fn next(&self) -> Option<Duration> {
        locked(&self.acts).due.iter().map(|due| due.at).min()
    }

    /// Whether this thread runs an act. Its reads then take no time.
    pub(super) fn is_acting(&self) -> bool {
        self.is_any.load(Ordering::Relaxed)
            && locked(&self.acts).actor.is_some_and(|actor| actor == thread::current().id())
    }

    /// Lets time pass, and runs the acts that become due meanwhile.
    pub(super) fn step<'a>(
        &self,
        shared: &'a Shared,
        mut machine: MutexGuard<'a, Machine>,
        time: Duration,
    ) -> MutexGuard<'a, Machine> {
        let end = machine.now().saturating_add(time);
        while let Some(Due { at, mut act, .. }) = self.due(machine.now(), end) {
            let left = at.saturating_sub(machine.now());
            drop(shared.pass(machine, left));
            let next = act();
            self.ends();
            machine = shared.lock();
            if let Some(next) = next {
                // One that comes late keeps its rhythm.
                let now = machine.now();
                let from = if at.saturating_add(next) > now { at.min(now) } else { now };
                self.add(from, next, act);
            }
        }
        let left = end.saturating_sub(machine.now());
        shared.pass(machine, left)
    }

    /// Takes the first act that is due by `end`, for this thread to run. There is one
    /// at a time: while a thread runs one, other threads let time pass without.
    fn due(&self, now: Duration, end: Duration) -> Option<Due> {
        let mut acts = locked(&self.acts);
        if acts.actor.is_some() {
            return None;
        }
        for due in &mut acts.due {
            // The machine may have been restored to an earlier moment.
            due.at = due.at.min(now.saturating_add(due.period));
        }
        let (index, due) = acts.due.iter().enumerate().min_by_key(|(_, due)| due.at)?;
        if due.at > end {
            return None;
        }
        acts.actor = Some(thread::current().id());
        self.is_any.store(true, Ordering::Relaxed);
        Some(acts.due.swap_remove(index))
    }

    /// The act that this thread ran is over.
    fn ends(&self) {
        let mut acts = locked(&self.acts);
        self.is_any.store(false, Ordering::Relaxed);
        acts.actor = None;
    }
}
