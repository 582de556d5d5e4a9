//! The passage of time for a machine that several threads use.
//!
//! With a *wall clock* a thread steps the machine every 2 ms, by the wall time that has passed
//! times a factor. With the *virtual clock* time stands still while the program computes. It
//! passes when the program waits, then it jumps to the end of the wait, and a little with each
//! access to a file, so that a program that polls a sensor makes progress, too.
//!
//! On the virtual clock one thread runs at a time, in the order of simulated time ([`baton`]). A
//! thread waits for its turn at the beginning of each call ([`Simulation::turn`]) and when it
//! pauses. At these points it holds no lock that another thread may need. In between it may take
//! locks and access files, and nobody else has a turn.
//!
//! [`Simulation::repeat`] is for control loops. An act runs when a thread lets time pass, or has
//! its turn: on the virtual clock at exactly its time during a pause, else at the next call. So a
//! loop that controls motors does the same in each run.

mod acts;
mod baton;
pub(crate) mod pace;
mod processor;
mod threads;
mod wall;

use self::acts::PeriodicActs;
use self::baton::{Baton, Wish};
use self::pace::{Leave, Pace};
use self::processor::Processor;
use self::wall::{STEP, Stepper};
use crate::far::{Answer, Far, Kind, Question};
use crate::machine::Machine;
use crate::machine::crowd::{self, Misplaced};
use crate::shared::{Crowd, Shared};
use ev3_os::Instant;
use std::cell::Cell;
use std::sync::{Arc, MutexGuard};
use std::time::Duration;
use std::{fmt, io};

pub use self::acts::Act;

/// Duration of a call on the virtual clock while another thread waits: so a thread that only asks
/// for the time lets the others go on.
const CALL_TAKES: Duration = Duration::from_micros(10);

/// Longest wait, by the wall clock, before the caller can handle signals.
const SLICE: Duration = Duration::from_millis(20);

/// How long a person has, by the wall clock, to press a button while the virtual clock stands.
const PRESS: Duration = Duration::from_millis(1);

/// How simulated time relates to the wall clock.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Clock {
    /// It passes with the wall clock, faster by this factor.
    Wall(f64),
    /// It passes only while the program waits or accesses files.
    Virtual,
}

thread_local! {
    static IS_OUTSIDE: Cell<bool> = const { Cell::new(false) };
}

/// Makes this thread a hand that reaches into simulations from outside, or a part of the program
/// again. What a hand does takes no simulated time, and needs no turn. Its waits take wall time.
pub fn stay_outside(is_outside: bool) {
    IS_OUTSIDE.set(is_outside);
    threads::stay_outside(is_outside);
}

/// Whether this thread reaches in from outside.
pub fn is_outside() -> bool {
    IS_OUTSIDE.get()
}

/// A machine whose time passes.
pub struct Simulation {
    shared: Arc<Shared>,
    acts: Arc<PeriodicActs>,
    clock: Passing,
    /// See [`Options`](crate::Options).
    thinking: u64,
    /// Of one of several robots in a world.
    processor: Option<Processor>,
    /// The machine that is meant, if this one is but its clock.
    far: Option<Box<dyn Far>>,
}

impl fmt::Debug for Simulation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Simulation").field("clock", &self.clock).finish_non_exhaustive()
    }
}

/// How the time of a simulation, or of a crowd, passes.
#[derive(Clone, Debug)]
enum Passing {
    Wall { _stepper: Arc<Stepper>, factor: f64 },
    Virtual { baton: Arc<Baton>, has_others: fn() -> bool },
}

fn started(
    shared: &Arc<Shared>,
    crowd: Option<&Arc<Crowd>>,
    clock: Clock,
    has_others: fn() -> bool,
) -> io::Result<(Arc<PeriodicActs>, Passing)> {
    let acts = Arc::new(PeriodicActs::default());
    let passing = match clock {
        Clock::Wall(factor) => {
            let stepper =
                Stepper::start(Arc::clone(shared), crowd.cloned(), Arc::clone(&acts), factor)?;
            Passing::Wall { _stepper: Arc::new(stepper), factor }
        }
        Clock::Virtual => Passing::Virtual { baton: Arc::new(Baton::new()), has_others },
    };
    Ok((acts, passing))
}

impl Simulation {
    /// Starts the clock of a machine. `has_others` says whether the program has threads but the
    /// one that calls it; if not, it need not wait for its turn.
    /// Errors: if the wall clock's thread cannot be started.
    pub fn new(machine: Machine, clock: Clock, has_others: fn() -> bool) -> io::Result<Self> {
        let thinking = machine.thinking();
        let shared = Arc::new(Shared::new(machine));
        let (acts, clock) = started(&shared, None, clock, has_others)?;
        Ok(Self { shared, acts, clock, thinking, processor: None, far: None })
    }

    /// The virtual clock, which begins at this moment, of a machine in another process.
    /// Errors: none: as those of [`Simulation::new`].
    pub fn far(far: Box<dyn Far>, now: Duration, has_others: fn() -> bool) -> io::Result<Self> {
        let machine = Machine::bare().map_err(io::Error::other)?;
        let simulation = Self::new(machine, Clock::Virtual, has_others)?;
        simulation.shared.step(now);
        Ok(Self { thinking: far.thinking(), far: Some(far), ..simulation })
    }

    /// The same for several robots, which come into the world of the first one. They have one time.
    /// Each has a processor of its own: an access to a file takes the time of its own program only.
    /// Errors: the outer one if the wall clock's thread cannot be started; the inner one names the
    /// robot, by its index, that stands where another one does, or something else.
    pub fn crowd(
        mut machines: Vec<Machine>,
        clock: Clock,
        has_others: fn() -> bool,
    ) -> io::Result<Result<Vec<Self>, Misplaced>> {
        if let Err(fault) = crowd::join(&mut machines) {
            return Ok(Err(fault));
        }
        let thinking = machines.first().map_or(0, Machine::thinking);
        let crowd = Crowd::new(machines);
        let Some(first) = crowd.members().first() else {
            return Ok(Ok(Vec::new()));
        };
        let (acts, clock) = started(first, Some(&crowd), clock, has_others)?;
        let simulation = |shared: &Arc<Shared>| Self {
            shared: Arc::clone(shared),
            acts: Arc::clone(&acts),
            clock: clock.clone(),
            thinking,
            processor: Some(Processor::new(Arc::clone(&crowd))),
            far: None,
        };
        Ok(Ok(crowd.members().iter().map(simulation).collect()))
    }

    /// How many inferences of the program take a second; 0 if they take no time.
    pub fn thinking(&self) -> u64 {
        self.thinking
    }

    /// How many robots are in its world.
    pub fn robots(&self) -> usize {
        self.processor.as_ref().map_or(1, |processor| processor.crowd.members().len())
    }

    /// Changes the world, or a place in it, for all robots in it.
    pub fn change_world<T>(&self, act: impl FnOnce(&mut Machine) -> T) -> T {
        self.shared.change_world(act)
    }

    /// The machine behind its lock, as a mount needs it.
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

    /// A call of the program begins. On the virtual clock this waits for the thread's turn;
    /// `false` when the caller has to handle signals, and to call again: every 20 ms of wall time,
    /// and when the turn has come after a wait for it. The caller holds no lock. `about` says what is called, and with what.
    pub fn turn(&self, about: &mut dyn FnMut() -> String) -> bool {
        let Passing::Virtual { baton, has_others } = &self.clock else {
            return true;
        };
        if self.takes_no_time() {
            return true;
        }
        let far_behind = |processor: &Processor| processor.far_behind(self.machine().now());
        if self.processor.as_ref().and_then(far_behind).is_some_and(|busy| !self.pause(busy)) {
            return false;
        }
        let mut takes = Duration::ZERO;
        if !self.begins_at_once(baton) && (!baton.is_freely_mine() || has_others()) {
            let wish = Wish::Turn(self.machine().now());
            if !baton.stand(wish, about, SLICE) {
                return false;
            }
            if baton.is_wanted() {
                takes = CALL_TAKES;
            }
        }
        if !self.may_go_on() {
            baton.keep(Wish::Turn(self.machine().now()));
            return false;
        }
        drop(self.acts.step(&self.shared, self.shared.lock(), takes));
        true
    }

    /// Whether a call of one in a crowd, which has its turn, begins before anybody else goes on: as
    /// no time passes, but not forever. It need not look at all threads, as most calls would.
    fn begins_at_once(&self, baton: &Baton) -> bool {
        let Some(processor) = self.processor.as_ref().filter(|_| baton.is_freely_mine()) else {
            return false;
        };
        let now = self.machine().now();
        processor.may_begin(now) && baton.is_before_others(now)
    }

    /// Holds this thread back, which has its turn, if time is to pass more slowly; `false` if it
    /// has to handle signals, and to call again.
    fn may_go_on(&self) -> bool {
        if !self.shared.with_pace(Pace::is_limited) {
            return true;
        }
        let now = self.machine().now();
        match self.shared.with_pace(|pace| pace.leave(now)) {
            Leave::Go(_) => true,
            Leave::Wait(sleep) => {
                ev3_os::sleep(sleep);
                // In a page nobody sleeps, and the program is held back between two calls.
                !cfg!(unix) || matches!(self.shared.with_pace(|pace| pace.leave(now)), Leave::Go(_))
            }
        }
    }

    /// The fastest that simulated time may pass, in seconds in a second of the wall clock. By the
    /// wall clock it multiplies the factor of the clock. `None` is no limit.
    pub fn set_pace(&self, factor: Option<f64>) {
        self.shared.with_pace(|pace| pace.set_factor(factor));
    }

    /// The limit of [`Simulation::set_pace`].
    pub fn pace(&self) -> Option<f64> {
        self.shared.with_pace(Pace::factor)
    }

    /// Lets time stand, with any clock, or pass again. A program that waits, waits on.
    pub fn set_paused(&self, is_paused: bool) {
        self.shared.with_pace(|pace| pace.set_paused(is_paused));
    }

    /// Whether time stands.
    pub fn is_paused(&self) -> bool {
        self.shared.with_pace(Pace::is_paused)
    }

    /// Whether no time may pass just now, by the pace or as it is paused.
    pub fn is_held(&self) -> bool {
        let now = self.machine().now();
        matches!(self.shared.with_pace(|pace| pace.leave(now)), Leave::Wait(_))
    }

    /// Lets this time pass while paused, as far as the program uses it.
    pub fn allow(&self, time: Duration) {
        let now = self.machine().now();
        self.shared.with_pace(|pace| pace.allow(now, time));
    }

    /// How time passes.
    pub fn clock(&self) -> Clock {
        match self.clock {
            Passing::Wall { factor, .. } => Clock::Wall(factor),
            Passing::Virtual { .. } => Clock::Virtual,
        }
    }

    /// Whether what this thread does takes no time.
    fn takes_no_time(&self) -> bool {
        self.acts.is_acting() || IS_OUTSIDE.get()
    }

    /// An access by this thread to a file, which on the virtual clock takes some time. No periodic act runs, and no other thread has a turn: the caller may hold a lock that
    /// these would wait for.
    pub(crate) fn access(&self, takes: Duration) -> MutexGuard<'_, Machine> {
        let Passing::Virtual { baton, .. } = &self.clock else {
            return self.shared.lock();
        };
        if self.takes_no_time() {
            return self.shared.lock();
        }
        // A thread without a turn, as at the end of the program, waits, but not forever.
        if !baton.is_mine() {
            let wish = Wish::Turn(self.machine().now());
            baton.stand(wish, &mut String::new, SLICE);
        }
        let machine = self.shared.lock();
        let Some(processor) = &self.processor else {
            return self.shared.pass(machine, takes);
        };
        processor.work(machine.now(), takes);
        machine
    }

    /// The answer of a far machine; `None` if it is here.
    pub(crate) fn elsewhere(&self, question: Question, takes: Duration) -> Option<Answer> {
        let far = self.far.as_ref()?;
        let is_free = takes.is_zero() || self.takes_no_time();
        let machine = if is_free { self.shared.lock() } else { self.access(takes) };
        let question = Question { at: machine.now(), is_free, ..question };
        drop(machine);
        // Until the answer comes, nobody else has a turn.
        match &self.clock {
            Passing::Virtual { baton, .. } => Some(baton.busy(|| far.ask(&question))),
            Passing::Wall { .. } => Some(far.ask(&question)),
        }
    }

    /// How many events of buttons there were, and when the next planned one is.
    fn buttons(&self) -> (u64, Option<Duration>) {
        let far = self.elsewhere(Question::of(Kind::Buttons, &[]), Duration::ZERO);
        if let Some(answer) = far {
            return (answer.number, answer.number_in_bytes().map(Duration::from_nanos));
        }
        let machine = self.machine();
        (machine.button_events(), machine.next_button())
    }

    /// Runs an act at a fixed period from now on. A thread that lets time pass runs
    /// it at that very moment, on the virtual clock in no time.
    pub fn repeat(&self, period: Duration, act: Act) {
        let now = self.machine().now();
        self.acts.add(now, period, act);
    }

    /// When the next act is due, if there is one.
    pub fn next_act(&self) -> Option<Duration> {
        self.acts.next()
    }

    /// Whether this thread runs an act just now.
    pub fn is_acting(&self) -> bool {
        self.acts.is_acting()
    }

    /// Lets time pass until a moment. By the wall clock it returns after 20 ms at the latest. On
    /// the virtual clock it returns `false` when the caller has to handle signals, and to call
    /// again: every 20 ms of wall time, and when the thread's turn has come after a wait for it.
    pub fn pause(&self, end: Duration) -> bool {
        self.pause_until(end, |_| false, None)
    }

    /// The same, but at most until a button is pressed or released. The virtual clock jumps only to
    /// a planned press: a person may press a button at any time.
    pub fn pause_for_button(&self, end: Duration) -> bool {
        let (count, planned) = self.buttons();
        let end = end.min(planned.map_or(end, |at| at.saturating_add(STEP)));
        let wall = planned.is_none().then(|| Instant::now() + PRESS);
        self.pause_until(end, |machine| machine.button_events() != count, wall)
    }

    fn pause_until(
        &self,
        end: Duration,
        is_done: impl Fn(&Machine) -> bool,
        wall: Option<Instant>,
    ) -> bool {
        if IS_OUTSIDE.get() {
            ev3_os::sleep(SLICE);
            return true;
        }
        let end = self.processor.as_ref().map_or(end, |processor| end.max(processor.busy()));
        match &self.clock {
            Passing::Wall { .. } => self.pause_by_wall(end, is_done),
            Passing::Virtual { baton, has_others } => {
                let wish = wall.map_or(Wish::Moment(end), |wall| Wish::NotBefore(end, wall));
                let is_alone = baton.is_freely_mine() && wall.is_none() && !has_others();
                if !is_alone && !baton.stand(wish, &mut String::new, SLICE) {
                    return false;
                }
                if !self.pass_until(end) {
                    baton.keep(wish);
                    return false;
                }
            }
        }
        true
    }

    /// Lets time pass until a moment, as fast as it may; `false` if it is not over yet, and the
    /// caller has to handle signals first.
    fn pass_until(&self, end: Duration) -> bool {
        let machine = self.shared.lock();
        let left = end.saturating_sub(machine.now());
        let now = machine.now();
        let most = match self.shared.with_pace(|pace| pace.leave(now)) {
            Leave::Go(most) => most,
            Leave::Wait(sleep) => {
                drop(machine);
                ev3_os::sleep(sleep);
                return left.is_zero();
            }
        };
        drop(self.acts.step(&self.shared, machine, left.min(most)));
        self.shared.wake();
        // A far machine goes as far as the clock here has.
        self.elsewhere(Question::of(Kind::Pass, &[]), Duration::ZERO);
        left <= most
    }

    fn pause_by_wall(&self, end: Duration, is_done: impl Fn(&Machine) -> bool) {
        let latest = Instant::now() + SLICE;
        let mut machine = self.shared.lock();
        while machine.now() < end && !is_done(&machine) {
            let left = latest.saturating_duration_since(Instant::now());
            if left.is_zero() {
                return;
            }
            machine = self.shared.wait(machine, left);
        }
    }
}
