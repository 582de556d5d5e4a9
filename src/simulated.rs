//! The simulated brick as a [`Sysfs`]: the driver works on it as on files.
//!
//! This is also where simulated time passes. With a *wall clock* a thread steps
//! the machine every 2 ms, by as much as has passed times a factor. With the
//! *virtual clock* time stands still while the program thinks. It passes when
//! the program waits (then it jumps to the end of the wait) and, a little, with
//! each access to a file, so that a program that polls a sensor in a loop gets
//! somewhere, too.
//!
//! What is to be done at a fixed period ([`Sysfs::every`]) is done by whoever
//! makes time pass, at that very moment and, on the virtual clock, in no time:
//! a loop that controls motors does the same in each run.
use ev3_driver::error::Access;
use ev3_driver::sysfs::{AttributeFile, Entry, Repeated, Sysfs, SysfsDir};
use ev3_sim::{Errno, Machine, NodeId, Shared};
use std::collections::{HashMap, HashSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{JoinHandle, ThreadId};
use std::time::{Duration, Instant};

/// Where programs see the tree.
const ROOT: &str = "/sys/class";

/// What a read takes on the virtual clock: as on a brick, by a quick program.
const READ_TAKES: Duration = Duration::from_micros(500);

/// What a write takes on the virtual clock.
const WRITE_TAKES: Duration = Duration::from_micros(100);

/// How often the wall clock steps the machine.
const STEP: Duration = Duration::from_millis(2);

/// At most so much of the wall clock is made up for in one step.
const LATE: Duration = Duration::from_millis(100);

/// How long, by the wall, a wait returns at the latest, so that signals are
/// handled.
const SLICE: Duration = Duration::from_millis(20);

/// How long after its last access, by the wall, a thread still counts as busy:
/// the virtual clock waits for it.
const BUSY_FOR: Duration = Duration::from_millis(1);

/// How simulated time relates to the wall clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Clock {
    /// So many simulated seconds a second.
    Wall(f64),
    /// Only when the program waits.
    Virtual,
}

/// A running simulation.
pub(crate) struct Simulation {
    shared: Arc<Shared>,
    repeated: Arc<RepeatedActs>,
    clock: Clock,
    threads: Mutex<Threads>,
    stepper: Option<Stepper>,
}

/// The threads of the program, for the virtual clock.
#[derive(Default)]
struct Threads {
    /// When each last accessed a file, by the wall. They are few.
    accesses: Vec<(ThreadId, Instant)>,
    /// Until when each that waits does.
    waits: HashMap<ThreadId, Duration>,
    /// Those without which time stands still unless they wait.
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
    pub(crate) fn new(machine: Machine, clock: Clock) -> io::Result<Self> {
        let shared = Arc::new(Shared::new(machine));
        let repeated = Arc::new(RepeatedActs::default());
        let stepper = match clock {
            Clock::Wall(factor) => {
                Some(Stepper::start(Arc::clone(&shared), Arc::clone(&repeated), factor)?)
            }
            Clock::Virtual => None,
        };
        Ok(Self { shared, repeated, clock, threads: Mutex::default(), stepper })
    }

    /// The machine behind its lock, as a mount needs it.
    pub(crate) fn shared(&self) -> Arc<Shared> {
        Arc::clone(&self.shared)
    }

    /// The machine, for as long as the guard lives.
    pub(crate) fn machine(&self) -> MutexGuard<'_, Machine> {
        self.shared.lock()
    }

    /// Lets time pass, whatever the clock.
    pub(crate) fn step(&self, time: Duration) {
        drop(self.repeated.step(&self.shared, self.shared.lock(), time));
        self.shared.wake();
    }

    /// Lets no time pass on the virtual clock from now on unless this thread
    /// waits, however long it computes.
    pub(crate) fn hold(&self) {
        self.threads().holders.insert(std::thread::current().id());
    }

    /// Ends what [`hold`](Self::hold) began.
    pub(crate) fn release(&self) {
        self.threads().holders.remove(&std::thread::current().id());
        self.shared.wake();
    }

    /// A read of a file by this thread, which takes its time.
    pub(crate) fn read<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        let mut machine = self.shared.lock();
        if self.takes_time() {
            self.was_busy();
            machine = self.repeated.step(&self.shared, machine, READ_TAKES);
        }
        act(&mut machine)
    }

    /// A write by this thread. Nothing else is done meanwhile: who writes may
    /// have taken care that nobody else does.
    pub(crate) fn write<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        let mut machine = self.shared.lock();
        if self.takes_time() {
            self.was_busy();
            machine.step(WRITE_TAKES);
        }
        act(&mut machine)
    }

    fn takes_time(&self) -> bool {
        self.clock == Clock::Virtual && !self.repeated.is_acting()
    }

    fn was_busy(&self) {
        self.threads().accessed(std::thread::current().id());
    }

    /// Lets time pass until `is_it` holds, after so much at the latest. Time
    /// jumps only where it is known when something will happen: somebody who
    /// presses a key is no thread that could be waited for.
    pub(crate) fn pause_until(&self, time: Duration, is_it: impl Fn(&Machine) -> bool) {
        let machine = self.shared.lock();
        if is_it(&machine) {
            return;
        }
        let now = machine.now();
        match (self.clock, machine.next_key()) {
            (Clock::Wall(_), _) => {
                let latest = Instant::now() + SLICE;
                let mut machine = machine;
                while machine.now() < now.saturating_add(time) && !is_it(&machine) {
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
                let is_so = is_it(&machine);
                drop(machine);
                if !is_so {
                    self.pause(time);
                }
            }
        }
    }

    pub(crate) fn pause(&self, time: Duration) {
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

    /// Jumps to the end of the wait, unless another thread has something to do
    /// before.
    fn pause_virtually(&self, time: Duration) {
        let me = std::thread::current().id();
        let mut machine = self.shared.lock();
        let until = machine.now().saturating_add(time);
        self.threads().waits.insert(me, until);
        while machine.now() < until {
            if self.is_next(me, until) {
                let left = until.saturating_sub(machine.now());
                machine = self.repeated.step(&self.shared, machine, left);
                self.shared.wake();
            } else {
                machine = self.shared.wait(machine, BUSY_FOR);
            }
        }
        let mut threads = self.threads();
        threads.waits.remove(&me);
        threads.accessed(me);
    }

    /// Whether no other thread is busy, or waits for an earlier time.
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

/// What is to be done at a fixed period of the simulated time.
#[derive(Default)]
struct RepeatedActs(Mutex<Acts>);

#[derive(Default)]
struct Acts {
    due: Vec<Due>,
    /// The thread that is doing one.
    actor: Option<ThreadId>,
}

struct Due {
    at: Duration,
    period: Duration,
    act: Repeated,
}

impl RepeatedActs {
    fn add(&self, now: Duration, period: Duration, act: Repeated) {
        self.acts().due.push(Due { at: now.saturating_add(period), period, act });
    }

    /// Whether this thread is doing one: its own waiting and reading is not the
    /// program's.
    fn is_acting(&self) -> bool {
        self.acts().actor.is_some_and(|actor| actor == std::thread::current().id())
    }

    /// Lets time pass, and does what is due on the way.
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

    /// The first that is due by then, for this thread to do. One at a time: while
    /// a thread is at it, others let time pass without.
    fn due(&self, now: Duration, end: Duration) -> Option<Due> {
        let mut acts = self.acts();
        if acts.actor.is_some() {
            return None;
        }
        for due in &mut acts.due {
            // A machine that was put back to an earlier moment.
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
struct Stepper {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Stepper {
    fn start(shared: Arc<Shared>, repeated: Arc<RepeatedActs>, factor: f64) -> io::Result<Self> {
        let stop = Arc::new(AtomicBool::new(false));
        let is_over = Arc::clone(&stop);
        let thread = std::thread::Builder::new().name("ev3-sim".to_owned()).spawn(move || {
            let mut last = Instant::now();
            while !is_over.load(Ordering::Relaxed) {
                std::thread::sleep(STEP);
                let now = Instant::now();
                // Where the machine cannot keep up, it is late, and not ever later.
                let passed = (now - last).min(LATE).mul_f64(factor);
                drop(repeated.step(&shared, shared.lock(), passed));
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
        // It may be this very thread that was the last to use the simulation.
        let is_me = |thread: &JoinHandle<()>| thread.thread().id() == std::thread::current().id();
        if let Some(thread) = self.thread.take_if(|thread| !is_me(thread)) {
            // It ends within a step; that it panicked is not news to this one.
            let _ = thread.join();
        }
    }
}

impl Drop for Simulation {
    fn drop(&mut self) {
        drop(self.stepper.take());
    }
}

/// The files of a simulation.
pub(crate) struct SimulatedFiles {
    simulation: Arc<Simulation>,
    root: PathBuf,
    /// Files that are not ev3dev's.
    others: SysfsDir,
}

impl SimulatedFiles {
    pub(crate) fn new(simulation: Arc<Simulation>) -> Self {
        Self { simulation, root: ROOT.into(), others: SysfsDir::new("/") }
    }

    /// The path below the root, if it is there.
    fn below<'a>(&self, path: &'a Path) -> Option<&'a str> {
        path.strip_prefix(&self.root).ok()?.to_str()
    }

    fn list_below(&self, path: &str) -> io::Result<Vec<Entry>> {
        let machine = self.simulation.machine();
        let directory = machine.resolve(path).map_err(error)?;
        let entries = machine.read_dir(directory).map_err(error)?;
        let entry = |entry: ev3_sim::Entry| Entry { name: entry.name, inode: entry.node.0 };
        Ok(entries.into_iter().map(entry).collect())
    }
}

impl Sysfs for SimulatedFiles {
    fn root(&self) -> &Path {
        &self.root
    }

    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        self.list_below(self.below(directory).ok_or(io::ErrorKind::NotFound)?)
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        let Some(below) = self.below(path) else {
            return self.others.open(path, access);
        };
        let wanted = match access {
            Access::Read => ev3_sim::Access::ReadOnly,
            Access::Write => ev3_sim::Access::WriteOnly,
        };
        let node = self.simulation.machine().open(below, wanted).map_err(error)?;
        Ok(Box::new(SimulatedFile { simulation: Arc::clone(&self.simulation), node }))
    }

    fn matching(&self, pattern: &str) -> ev3_driver::Result<Vec<PathBuf>> {
        let matcher = glob::Pattern::new(pattern.trim_end_matches('/'))
            .map_err(|source| ev3_driver::Error::Pattern { pattern: pattern.to_owned(), source })?;
        let mut paths = Vec::new();
        for class in self.list_below("").unwrap_or_default() {
            for device in self.list_below(&class.name).unwrap_or_default() {
                paths.push(self.root.join(&class.name).join(device.name));
            }
        }
        paths.retain(|path| matcher.matches_path(path));
        paths.sort_unstable();
        Ok(paths)
    }

    fn now(&self) -> Duration {
        self.simulation.machine().now()
    }

    fn pause(&self, _nodes: &[&dyn AttributeFile], timeout: Duration) -> io::Result<()> {
        self.simulation.pause(timeout);
        Ok(())
    }

    fn every(&self, period: Duration, act: Repeated) -> io::Result<()> {
        let simulation = &self.simulation;
        let now = simulation.machine().now();
        simulation.repeated.add(now, period, act);
        Ok(())
    }
}

/// An open file of a simulation.
struct SimulatedFile {
    simulation: Arc<Simulation>,
    node: NodeId,
}

impl AttributeFile for SimulatedFile {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let text = self.simulation.read(|machine| machine.read(self.node));
        let text = text.map_err(error)?;
        let length = text.len().min(buffer.len());
        buffer[..length].copy_from_slice(&text[..length]);
        Ok(length)
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        let written = self.simulation.write(|machine| machine.write(self.node, text));
        let blocks = written.map_err(error)?.blocks;
        if !blocks.is_zero() && !self.simulation.repeated.is_acting() {
            self.simulation.pause(blocks);
        }
        Ok(())
    }
}

pub(crate) fn error(errno: Errno) -> io::Error {
    io::Error::from_raw_os_error(errno.0)
}
