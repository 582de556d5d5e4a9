//! A machine that several threads use, and a way to wait for its time to pass.
use crate::clock::pace::Pace;
use crate::machine::{Machine, crowd};
use ev3_os::Instant;
use ev3_os::locked;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, OnceLock, PoisonError, Weak};
use std::time::Duration;

/// A machine behind a lock. The thread with the clock calls [`Shared::step`], or steps under the
/// lock and calls [`Shared::wake`]. A thread that waits for a change calls [`Shared::wait`] and
/// checks again.
#[derive(Debug)]
pub struct Shared {
    machine: Mutex<Machine>,
    changed: Condvar,
    /// How many wait for that: to wake nobody asks the kernel, too.
    waiting: AtomicUsize,
    /// Locked after the machine.
    wall: OnceLock<Mutex<Wall>>,
    pace: Pace,
    /// Those in whose world it is, and its place among them.
    crowd: OnceLock<(Weak<Crowd>, usize)>,
}

/// Machines in one world, whose time passes together. Their locks are taken in their order.
#[derive(Debug)]
pub(crate) struct Crowd {
    members: Vec<Arc<Shared>>,
}

impl Crowd {
    /// Machines that [`crowd::join`] has put together.
    pub(crate) fn new(machines: Vec<Machine>) -> Arc<Crowd> {
        let members = machines.into_iter().map(Shared::new).map(Arc::new).collect();
        let crowd = Arc::new(Crowd { members });
        for (index, member) in crowd.members.iter().enumerate() {
            member.crowd.get_or_init(|| (Arc::downgrade(&crowd), index));
        }
        crowd
    }

    pub(crate) fn members(&self) -> &[Arc<Shared>] {
        &self.members
    }

    fn with_all<T>(&self, act: impl FnOnce(&mut [&mut Machine]) -> T) -> T {
        let mut guards: Vec<_> = self.members.iter().map(|member| member.lock_as_it_is()).collect();
        let mut machines: Vec<_> = guards.iter_mut().map(|guard| &mut **guard).collect();
        act(&mut machines)
    }

    fn step(&self, dt: Duration) {
        self.with_all(|machines| crowd::step(machines, dt));
        for member in &self.members {
            member.wake();
        }
    }
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
    pub fn new(machine: Machine) -> Shared {
        Shared {
            machine: Mutex::new(machine),
            changed: Condvar::new(),
            waiting: AtomicUsize::new(0),
            wall: OnceLock::new(),
            pace: Pace::default(),
            crowd: OnceLock::new(),
        }
    }

    fn crowd(&self) -> Option<(Arc<Crowd>, usize)> {
        let (crowd, index) = self.crowd.get()?;
        Some((crowd.upgrade()?, *index))
    }

    /// The one whose clock and pace are those of all in this world.
    fn first<T>(&self, ask: impl FnOnce(&Shared) -> T) -> T {
        match self.crowd() {
            Some((crowd, 1..)) => ask(&crowd.members[0]),
            _ => ask(self),
        }
    }

    /// Lets time pass for a machine that is locked, and those in its world. Their locks are open
    /// meanwhile.
    pub(crate) fn pass<'a>(
        &'a self,
        mut machine: MutexGuard<'a, Machine>,
        dt: Duration,
    ) -> MutexGuard<'a, Machine> {
        match self.crowd() {
            None => {
                machine.step(dt);
                machine
            }
            Some(_) if dt.is_zero() => machine,
            Some((crowd, _)) => {
                drop(machine);
                crowd.step(dt);
                self.lock_as_it_is()
            }
        }
    }

    /// Changes the world, or a place in it, for all that are there.
    pub fn change_world<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        drop(self.lock());
        match self.crowd() {
            None => act(&mut self.lock_as_it_is()),
            Some((crowd, index)) => crowd.with_all(|machines| {
                let answer = act(machines[index]);
                crowd::share_world(machines, index);
                answer
            }),
        }
    }

    /// The machine, for as long as the guard lives. A thread that panicked with the lock in its
    /// hand leaves a machine that is still in order, at most in the middle of a step.
    ///
    /// If the machine is to follow the wall clock, this makes up for what has passed since its
    /// last step: so a program that waits 10 ms between two accesses waits 10 ms of the machine's
    /// time, also on a busy computer.
    pub fn lock(&self) -> MutexGuard<'_, Machine> {
        let machine = self.lock_as_it_is();
        if !self.first(|first| first.wall.get().is_some()) {
            return machine;
        }
        let behind = self.behind();
        self.pass(machine, behind)
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
        self.first(|first| {
            let Some(wall) = first.wall.get() else {
                return Duration::ZERO;
            };
            let Wall { factor, last } = &mut *locked(wall);
            let now = Instant::now();
            let passed = now - *last;
            *last = now;
            first.pace.of_wall(passed.min(LATE), *factor)
        })
    }

    /// How fast time may pass.
    pub(crate) fn with_pace<T>(&self, ask: impl FnOnce(&Pace) -> T) -> T {
        self.first(|first| ask(&first.pace))
    }

    /// Lets virtual time pass and wakes all waiting threads.
    pub fn step(&self, dt: Duration) {
        drop(self.pass(self.lock(), dt));
        self.wake();
    }

    /// Wakes all waiting threads, to check again.
    pub fn wake(&self) {
        if self.waiting.load(Ordering::SeqCst) > 0 {
            self.changed.notify_all();
        }
    }

    /// Releases the lock until [`Shared::wake`] is called, for at most this wall time.
    pub fn wait<'a>(
        &self,
        guard: MutexGuard<'a, Machine>,
        at_most: Duration,
    ) -> MutexGuard<'a, Machine> {
        // Under the lock: who changes something under it afterwards knows of this one.
        self.waiting.fetch_add(1, Ordering::SeqCst);
        let woken = self.changed.wait_timeout(guard, at_most);
        self.waiting.fetch_sub(1, Ordering::SeqCst);
        woken.unwrap_or_else(PoisonError::into_inner).0
    }
}
