//! How time passes for a machine that several threads use.
//!
//! With a *wall clock* a thread steps the machine every 2 ms, by the wall time that has passed
//! times a factor. With the *virtual clock* time stands still while the program computes. It
//! passes when the program waits, then it jumps to the end of the wait, and a little with each
//! access to a file, so that a program that polls a sensor makes progress, too.
//!
//! [`Simulation::repeat`] is for control loops. On the virtual clock an act runs at exactly its
//! time, so a loop that controls motors does the same in each run.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{JoinHandle, ThreadId};
use std::time::{Duration, Instant};

use crate::machine::Machine;
use crate::shared::Shared;

/// Duration of a read on the virtual clock: that of a fast program on a brick.
const READ_TAKES: Duration = Duration::from_micros(500);

/// Duration of a write on the virtual clock.
const WRITE_TAKES: Duration = Duration::from_micros(100);

/// How often the wall clock steps the machine.
const STEP: Duration = Duration::from_millis(2);

/// The most wall time that one step makes up for.
const LATE: Duration = Duration::from_millis(100);

/// Longest wait, by the wall clock, before the caller can handle signals.
const SLICE: Duration = Duration::from_millis(20);

/// How long after its last access, by the wall clock, a thread counts as busy. The
/// virtual clock waits for busy threads.
const BUSY_FOR: Duration = Duration::from_millis(1);

/// How simulated time relates to the wall clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clock {
    /// It passes with the wall clock, faster by this factor.
    Wall(f64),
    /// It passes only while the program waits or accesses files.
    Virtual,
}

/// A machine whose time passes.
#[derive(Debug)]
pub struct Simulation {
    shared: Arc<Shared>,
    acts: Arc<PeriodicActs>,
    clock: Clock,
    threads: Mutex<Threads>,
    stepper: Option<Stepper>,
}

/// The threads of the program, for the virtual clock.
#[derive(Debug, Default)]
struct Threads {
    /// When each last accessed a file, by the wall clock. There are few.
    accesses: Vec<(ThreadId, Instant)>,
    /// The simulated time at which each wait ends.
    waits: HashMap<ThreadId, Duration>,
    /// The threads that hold time: it passes only while they wait.
    holders: HashSet<ThreadId>,
}

impl Threads {
    /// Notes that a thread accesses a file now.
    fn accessed(&mut self, thread: ThreadId) {
        let now = Instant::now();
        if let Some((_, last)) = self.accesses.iter_mut().find(|(other, _)| *other == thread) {
            *last = now;
        } else {
            self.forget_idle();
            self.accesses.push((thread, now));
        }
    }

    fn forget_idle(&mut self) {
        self.accesses.retain(|(_, last)| last.elapsed() < BUSY_FOR);
    }
}

impl Simulation {
    /// Starts the clock of a machine.
    ///
    /// # Errors
    /// If the wall clock's thread cannot be started.
    pub fn new(machine: Machine, clock: Clock) -> io::Result<Self> {
        let shared = Arc::new(Shared::new(machine));
        let acts = Arc::new(PeriodicActs::default());
        let stepper = match clock {
            Clock::Wall(factor) => {
                Some(Stepper::start(Arc::clone(&shared), Arc::clone(&acts), factor)?)
            }
            Clock::Virtual => None,
        };
        Ok(Self { shared, acts, clock, threads: Mutex::default(), stepper })
    }

    /// The machine behind its lock, as a mount needs it.
    #[must_use]
    pub fn shared(&self) -> Arc<Shared> {
        Arc::clone(&self.shared)
    }

    /// The machine, for as long as the guard lives.
    pub fn machine(&self) -> MutexGuard<'_, Machine> {
        self.shared.lock()
    }

    /// Lets time pass, with any clock.
    pub fn step(&self, time: Duration) {
        drop(self.acts.step(&self.shared, self.shared.lock(), time));
        self.shared.wake();
    }

    /// Holds the virtual clock: until [`release`](Self::release), time passes only
    /// while this thread waits, however long it computes.
    pub fn hold(&self) {
        self.threads().holders.insert(std::thread::current().id());
    }

    /// Ends what [`hold`](Self::hold) began.
    pub fn release(&self) {
        self.threads().holders.remove(&std::thread::current().id());
        self.shared.wake();
    }

    /// A read of a file by this thread. On the virtual clock it takes some time.
    pub fn read<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        let mut machine = self.shared.lock();
        if self.takes_time() {
            self.was_busy();
            machine = self.acts.step(&self.shared, machine, READ_TAKES);
        }
        act(&mut machine)
    }

    /// A write to a file by this thread. No periodic act runs before it: the
    /// caller may hold a lock that such an act would wait for.
    pub fn write<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        let mut machine = self.shared.lock();
        if self.takes_time() {
            self.was_busy();
            machine.step(WRITE_TAKES);
        }
        act(&mut machine)
    }

    /// Runs an act at a fixed period from now on. A thread that lets time pass runs
    /// it at that very moment, on the virtual clock in no time.
    pub fn repeat(&self, period: Duration, act: Act) {
        let now = self.machine().now();
        self.acts.add(now, period, act);
    }

    /// Whether this thread runs an act just now.
    #[must_use]
    pub fn is_acting(&self) -> bool {
        self.acts.is_acting()
    }

    fn takes_time(&self) -> bool {
        self.clock == Clock::Virtual && !self.acts.is_acting()
    }

    fn was_busy(&self) {
        self.threads().accessed(std::thread::current().id());
    }

    /// Lets time pass until `is_done` holds, but at most `time`. The virtual clock
    /// jumps only to a planned press of a button: a person may press one at any
    /// time.
    pub fn pause_until(&self, time: Duration, is_done: impl Fn(&Machine) -> bool) {
        let machine = self.shared.lock();
        if is_done(&machine) {
            return;
        }
        let now = machine.now();
        match (self.clock, machine.next_button()) {
            (Clock::Wall(_), _) => {
                let latest = Instant::now() + SLICE;
                let mut machine = machine;
                while machine.now() < now.saturating_add(time) && !is_done(&machine) {
                    let left = latest.saturating_duration_since(Instant::now());
                    if left.is_zero() {
                        return;
                    }
                    machine = self.shared.wait(machine, left);
                }
            }
            (Clock::Virtual, Some(at)) => {
                drop(machine);
                self.pause(time.min(at.saturating_sub(now) + STEP));
            }
            (Clock::Virtual, None) => {
                let machine = self.shared.wait(machine, BUSY_FOR);
                let was_done = is_done(&machine);
                drop(machine);
                if !was_done {
                    self.pause(time);
                }
            }
        }
    }

    /// Lets time pass. By the wall clock, and while another thread keeps the virtual
    /// clock from passing, it returns after 20 ms at the latest, so that the caller
    /// can handle signals.
    pub fn pause(&self, time: Duration) {
        match self.clock {
            Clock::Wall(_) => self.pause_by_wall(time),
            Clock::Virtual => self.pause_virtually(time),
        }
    }

    fn pause_by_wall(&self, time: Duration) {
        let machine = self.shared.lock();
        let until = machine.now().saturating_add(time);
        let latest = Instant::now() + SLICE;
        let mut machine = machine;
        while machine.now() < until {
            let left = latest.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return;
            }
            machine = self.shared.wait(machine, left);
        }
    }

    /// Jumps to the end of the wait, unless another thread is busy or waits for an
    /// earlier time.
    fn pause_virtually(&self, time: Duration) {
        let me = std::thread::current().id();
        let mut machine = self.shared.lock();
        let until = machine.now().saturating_add(time);
        let latest = Instant::now() + SLICE;
        self.threads().waits.insert(me, until);
        while machine.now() < until {
            if self.is_next(me, until) {
                let left = until.saturating_sub(machine.now());
                machine = self.acts.step(&self.shared, machine, left);
                self.shared.wake();
            } else if Instant::now() < latest {
                machine = self.shared.wait(machine, BUSY_FOR);
            } else {
                break;
            }
        }
        let mut threads = self.threads();
        threads.waits.remove(&me);
        threads.accessed(me);
    }

    /// Whether the next thing to happen is the end of this thread's wait.
    fn is_next(&self, me: ThreadId, until: Duration) -> bool {
        let mut threads = self.threads();
        threads.forget_idle();
        let Threads { accesses, waits, holders } = &*threads;
        let mut busy = accesses.iter().map(|(thread, _)| thread).chain(holders.iter());
        let is_busy = busy.any(|other| *other != me && !waits.contains_key(other));
        !is_busy && waits.values().all(|other| *other >= until)
    }

    fn threads(&self) -> MutexGuard<'_, Threads> {
        self.threads.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A periodic act in simulated time. It returns the time to its next run, or `None`
/// if it ends.
pub type Act = Box<dyn FnMut() -> Option<Duration> + Send>;

/// The acts, and which thread runs one.
#[derive(Default)]
struct PeriodicActs(Mutex<Acts>);

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
    fn add(&self, now: Duration, period: Duration, act: Act) {
        self.acts().due.push(Due { at: now.saturating_add(period), period, act });
    }

    /// Whether this thread runs an act. Its reads then take no time.
    fn is_acting(&self) -> bool {
        self.acts().actor.is_some_and(|actor| actor == std::thread::current().id())
    }

    /// Lets time pass, and runs the acts that become due meanwhile.
    fn step<'a>(
        &self,
        shared: &'a Shared,
        mut machine: MutexGuard<'a, Machine>,
        time: Duration,
    ) -> MutexGuard<'a, Machine> {
        let end = machine.now().saturating_add(time);
        while let Some(Due { at, mut act, .. }) = self.due(machine.now(), end) {
            let left = at.saturating_sub(machine.now());
            machine.step(left);
            drop(machine);
            let next = act();
            self.acts().actor = None;
            machine = shared.lock();
            if let Some(next) = next {
                self.add(machine.now(), next, act);
            }
        }
        let left = end.saturating_sub(machine.now());
        machine.step(left);
        machine
    }

    /// Takes the first act that is due by `end`, for this thread to run. There is one
    /// at a time: while a thread runs one, other threads let time pass without.
    fn due(&self, now: Duration, end: Duration) -> Option<Due> {
        let mut acts = self.acts();
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
        acts.actor = Some(std::thread::current().id());
        Some(acts.due.swap_remove(index))
    }

    fn acts(&self) -> MutexGuard<'_, Acts> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Steps a machine by the wall clock.
#[derive(Debug)]
struct Stepper {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Stepper {
    fn start(shared: Arc<Shared>, acts: Arc<PeriodicActs>, factor: f64) -> io::Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
        let is_over = Arc::clone(&stop);
        let thread = std::thread::Builder::new().name("ev3-sim".to_owned()).spawn(move || {
            let mut last = Instant::now();
            while !is_over.load(Ordering::Relaxed) {
                std::thread::sleep(STEP);
                let now = Instant::now();
                // A machine that cannot keep up falls behind, but not without limit.
                let passed = (now - last).min(LATE).mul_f64(factor);
                drop(acts.step(&shared, shared.lock(), passed));
                shared.wake();
                last = now;
            }
        })?;
        Ok(Self { stop, thread: Some(thread) })
    }
}

impl Drop for Stepper {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        // The stepper's own thread may hold the last reference to the simulation.
        let is_me = |thread: &JoinHandle<()>| thread.thread().id() == std::thread::current().id();
        if let Some(thread) = self.thread.take_if(|thread| !is_me(thread)) {
            // It ends within a step. If it panicked, that was reported there.
            let _ = thread.join();
        }
    }
}

impl Drop for Simulation {
    fn drop(&mut self) {
        drop(self.stepper.take());
    }
}
