//! Native waits, as Prolog sees them.
//!
//! A wait is a nondeterministic predicate. Its last argument is the end of the wait, or before that
//! `pause`, `tick` or `yield`, each time with a choice point: `private/run/waits.pl` handles it, and
//! fails back into the wait. So Prolog handles signals and serves events between two slices,
//! and an engine can yield there. What leaves the wait, as an exception, drops its state, and so
//! stops the motors of a move.
use crate::glue::call::Call;
use crate::glue::due;
use crate::glue::error;
use crate::glue::state;
use crate::glue::terms::{Ask as _, Prolog, unify_atom};
use ev3_driver::Error;
use ev3_driver::motor::{self, wait::Reason};
use ev3_driver::wait::{Look, Slices, Wait};
use ev3_signals::latch;
use std::cell::{Cell, RefCell};
use std::ops::Range;
use std::time::Duration;
use swipl::fli::{Act, act_without_input, this_thread};
use swipl::prelude::*;

/// The longest time between two looks of branches.
const BRANCHES_LOOK: Duration = Duration::from_millis(20);

/// How often Prolog looks for a signal that ends the program, once the motors are stopped.
const SIGNAL: Duration = Duration::from_millis(10);

/// The number of Prolog's main thread.
const MAIN_THREAD: i32 = 1;

thread_local! {
    /// When this thread serves its events next, by the tree's clock; `None` if it has none.
    static NEXT_TICK: Cell<Option<Duration>> = const { Cell::new(None) };
    /// The branches that this thread runs, the innermost last. The branches' own ticks are not of
    /// the thread.
    static BRANCHES: RefCell<Vec<Round>> = const { RefCell::new(Vec::new()) };
    /// Whether this thread has a next tick, or runs branches: all that a read has to test.
    static IS_SERVING: Cell<bool> = const { Cell::new(false) };
    /// Whether the next read of a branch happens without a look at the time.
    static READS_ON: Cell<bool> = const { Cell::new(false) };
    /// The motors, by their last commands, to stop at the first wait: for each of the rule sets
    /// that are within each other.
    static LEFT: RefCell<Vec<Range<u32>>> = const { RefCell::new(Vec::new()) };
    /// How many slices of time this thread has waited.
    static SLICES: Cell<u64> = const { Cell::new(0) };
}

/// One round of branches.
pub(crate) enum Round {
    /// Each goes on until it waits; no time passes. By the clock of each brick that they are
    /// about, the first of them has to look again at this time, and one that reads sensors then
    /// lets the others go on.
    GoesOn(Vec<(u32, Duration)>),
    /// One of them is left, and time passes while its clean-ups wait. Later the thread's own
    /// ticks go on, the next of which is this.
    Left(Option<Duration>),
}

/// Sets when this thread serves its events next.
pub(crate) fn tick_at(time: Option<Duration>) {
    if !branches_go_on() {
        NEXT_TICK.set(time);
        note_serving();
    }
}

/// The clock is another one from now on: a tick of before is due at once.
pub(crate) fn tick_at_once() {
    if NEXT_TICK.get().is_some() {
        NEXT_TICK.set(Some(Duration::ZERO));
    }
}

fn note_serving() {
    let is_in_branch = BRANCHES.with_borrow(|rounds| !rounds.is_empty());
    due::set_in_branch(is_in_branch);
    IS_SERVING.set(NEXT_TICK.get().is_some() || is_in_branch);
}

/// Whether this thread serves events, or runs branches, so that others may go on before a read.
#[inline]
pub(crate) fn is_serving() -> bool {
    IS_SERVING.get()
}

/// Branches run from now on.
pub(crate) fn begin_branches(round: Round) {
    BRANCHES.with_borrow_mut(|rounds| rounds.push(round));
    note_serving();
}

/// How many branches, within each other, this thread runs.
#[cfg(feature = "sim")]
pub(crate) fn rounds() -> usize {
    BRANCHES.with_borrow(Vec::len)
}

/// Those that were added since are over: what ran them was left without a clean-up.
#[cfg(feature = "sim")]
pub(crate) fn back_to_rounds(count: usize) {
    while rounds() > count {
        end_branches();
    }
}

fn branches_go_on() -> bool {
    BRANCHES.with_borrow(|rounds| matches!(rounds.last(), Some(Round::GoesOn(_))))
}

/// By the clock of the brick in use, when the first of the branches that go on has to look again.
fn branches_look() -> Option<Duration> {
    BRANCHES.with_borrow_mut(|rounds| {
        let Some(Round::GoesOn(looks)) = rounds.last_mut() else { return None };
        let brick = state::brick_number();
        let known = looks.iter().find(|(of, _)| *of == brick).map(|(_, look)| *look);
        Some(known.unwrap_or_else(|| {
            let look = state::devices().tree().now().saturating_add(BRANCHES_LOOK);
            looks.push((brick, look));
            look
        }))
    })
}

/// After what time the first of the branches has to look again, and the bricks they are about.
pub(crate) fn branches_wait() -> (Duration, Vec<u32>) {
    let looks = BRANCHES.with_borrow(|rounds| match rounds.last() {
        Some(Round::GoesOn(looks)) => looks.clone(),
        _ => Vec::new(),
    });
    let left = looks.iter().map(|&(brick, look)| look.saturating_sub(state::now_of(brick)));
    let first = left.min().unwrap_or_default();
    (first, looks.into_iter().map(|(brick, _)| brick).collect())
}

/// A branch is left from now on.
pub(crate) fn leave_branches() {
    begin_branches(Round::Left(NEXT_TICK.take()));
}

/// The branches pause. If they are within another branch, this runs on.
pub(crate) fn end_branches() {
    if let Some(Round::Left(tick)) = BRANCHES.with_borrow_mut(Vec::pop) {
        NEXT_TICK.set(tick);
    }
    note_serving();
}

/// A branch has to look again at this time.
fn look_at(time: Duration) {
    BRANCHES.with_borrow_mut(|rounds| {
        let Some(Round::GoesOn(looks)) = rounds.last_mut() else { return };
        let brick = state::brick_number();
        if let Some((_, look)) = looks.iter_mut().find(|(of, _)| *of == brick) {
            *look = time.min(*look);
        }
    });
}

/// Lets the next read of a branch happen: the others have gone on.
pub(crate) fn read_on() {
    READS_ON.set(true);
}

/// Sets which motors are stopped when this thread waits next, by their last commands, in the
/// place of those that start at the same one.
pub(crate) fn stop_at_wait(commands: Range<u32>) {
    LEFT.with_borrow_mut(|left| {
        left.retain(|range| range.start != commands.start);
        if !commands.is_empty() {
            left.push(commands);
        }
    });
}

/// How many slices of time this thread has waited so far.
pub(crate) fn slices() -> u64 {
    SLICES.get()
}

/// Whether it is time for this thread to serve its events.
pub(crate) fn is_tick_due(now: impl FnOnce() -> Duration) -> bool {
    NEXT_TICK.get().is_some_and(|tick| now() >= tick)
}

/// From now on the main thread serves its events at the prompt, too.
pub(crate) fn serve_at_prompt() {
    if this_thread() == MAIN_THREAD {
        act_without_input(Act {
            is_due: is_tick_due_at_prompt,
            module: c"ev3dev_events",
            name: c"serve_at_prompt",
        });
    }
}

/// No time passes on a virtual clock there.
fn is_tick_due_at_prompt() -> bool {
    NEXT_TICK.get().is_some_and(|tick| {
        let devices = state::devices();
        devices.tree().goes_on() && devices.tree().now() >= tick
    })
}

impl<C: Prolog> Call<'_, C> {
    /// Stops the motors of all bricks whose last command was one of these, of this thread.
    pub(crate) fn stop_commanded(&self, commands: &Range<u32>) -> PrologResult<()> {
        let stop = |devices: &_| motor::stop_commanded(devices, commands);
        self.or_throw(state::on_all_bricks(stop))
    }

    /// One slice of a wait: unifies `reason` with what is to be done before the next one, or calls
    /// `ended`. The result is that of a nondeterministic predicate.
    pub(crate) fn slice<W: Wait>(
        &self,
        wait: &mut Slices<W>,
        reason: &Term,
        ended: impl FnOnce(W::End) -> PrologResult<()>,
    ) -> PrologResult<bool> {
        self.wait_goes_on()?;
        let tick = NEXT_TICK.get();
        for commands in LEFT.take() {
            self.stop_commanded(&commands)?;
        }
        if branches_look().is_some() {
            let now = state::devices().tree().now();
            return match wait.poll(now) {
                Err(error) => self.leave(&error, reason),
                Ok(Look::Over(end)) => ended(end).map(|()| false),
                Ok(Look::Again(end)) => {
                    SLICES.set(SLICES.get() + 1);
                    look_at(end);
                    self.wait_pauses()?;
                    unify_atom(reason, "yield").map(|()| true)
                }
            };
        }
        match wait.slice(tick) {
            Err(error) => return self.leave(&error, reason),
            Ok(Some(end)) => return ended(end).map(|()| false),
            Ok(None) => {}
        }
        SLICES.set(SLICES.get() + 1);
        let now = || state::devices().tree().now();
        let is_tick = due::has_rung() || is_tick_due(now);
        if !is_tick {
            self.wait_pauses()?;
        }
        unify_atom(reason, if is_tick { "tick" } else { "pause" }).map(|()| true)
    }

    /// Has Prolog serve the events of this thread, if it is time to: a read of a sensor is
    /// such a time, too, for programs that never wait.
    pub(crate) fn serve_if_due(&self) -> PrologResult<()> {
        if is_tick_due(|| state::devices().tree().now()) {
            self.context.ask(pred!("ev3dev_waits:serve_at_read/0"), [])?;
        }
        Ok(())
    }

    /// The same before a native predicate `name` reads sensors with these arguments. In a branch
    /// whose time is over it is `true`: then the predicate is to succeed without reading, and
    /// Prolog calls it again when the other branches have gone on.
    #[inline]
    pub(crate) fn serve_before(
        &self,
        name: &'static str,
        arguments: [&Term; 5],
    ) -> PrologResult<bool> {
        if is_serving() { self.serve_before_read(name, arguments) } else { Ok(false) }
    }

    #[cold]
    #[inline(never)]
    fn serve_before_read(&self, name: &str, arguments: [&Term; 5]) -> PrologResult<bool> {
        match branches_look() {
            None => self.serve_if_due().map(|()| false),
            Some(time) => self.goes_on_later(time, name, arguments),
        }
    }

    /// An engine cannot yield within a call from here, but in a goal that waits for a variable:
    /// Prolog itself calls this, at the exit of the native predicate.
    fn goes_on_later(
        &self,
        time: Duration,
        name: &str,
        [port, types, mode, number, value]: [&Term; 5],
    ) -> PrologResult<bool> {
        if READS_ON.take() || state::devices().tree().now() < time {
            return Ok(false);
        }
        let [called, woken] = self.context.new_term_refs();
        unify_atom(&called, name)?;
        let arguments = [&called, port, types, mode, number, value, &woken];
        self.context.ask(pred!("ev3dev_waits:read_later/7"), arguments)?;
        unify_atom(&woken, "true").map(|()| true)
    }

    /// The end of a wait by an error, for Prolog to throw.
    fn leave(&self, error: &Error, reason: &Term) -> PrologResult<bool> {
        reason.unify(&error::to_be_thrown(self, error, &state::devices())?)?;
        Ok(false)
    }

    /// The same for a wait whose end is a reason.
    pub(crate) fn slice_of_move<W: Wait<End = Reason>>(
        &self,
        wait: &mut Slices<W>,
        reason: &Term,
    ) -> PrologResult<bool> {
        let mut is_ending = false;
        let goes_on = self.slice(wait, reason, |ended| {
            // It ends because the motors were stopped: the program would go on by that.
            is_ending = latch::is_ending();
            unify_atom(reason, if is_ending { "pause" } else { ended.word() })
        })?;
        if is_ending {
            ev3_os::sleep(SIGNAL);
        }
        Ok(goes_on || is_ending)
    }
}
