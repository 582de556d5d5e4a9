//! Native waits, as Prolog sees them.
//!
//! A wait is a nondeterministic predicate. Its last argument is the end of the wait, or before that
//! `pause` or `tick`, each time with a choice point: `private/waits.pl` handles it, and
//! fails back into the wait. So Prolog handles signals and serves events between two slices,
//! and an engine can yield there. What leaves the wait, as an exception, drops its state, and so
//! stops the motors of a move.
use crate::glue::call::Call;
use crate::glue::due;
use crate::glue::error;
use crate::glue::state;
use crate::glue::terms::unify_atom;
use ev3_driver::Error;
use ev3_driver::motor::{self, wait::Reason};
use ev3_driver::wait::{Look, Slices, Wait};
use std::cell::{Cell, RefCell};
use std::ops::Range;
use std::time::Duration;
use swipl::prelude::*;

thread_local! {
    /// When this thread serves its events next, by the tree's clock; `None` if it has none.
    static NEXT_TICK: Cell<Option<Duration>> = const { Cell::new(None) };
    /// While this thread runs one of several branches, the time at which the first of them
    /// has to look again. No time passes then, and the branches' own ticks are not of the thread.
    static BRANCHES: Cell<Option<Duration>> = const { Cell::new(None) };
    /// The motors, by their last commands, to stop at the first wait.
    static LEFT: RefCell<Option<Range<u32>>> = const { RefCell::new(None) };
    /// How many slices of time this thread has waited.
    static SLICES: Cell<u64> = const { Cell::new(0) };
}

/// Sets when this thread serves its events next.
pub(crate) fn tick_at(time: Option<Duration>) {
    if BRANCHES.get().is_none() {
        NEXT_TICK.set(time);
    }
}

/// Branches run from now on, which let no time pass, and look again at this time at the
/// latest; or the branches pause.
pub(crate) fn set_branches(latest: Option<Duration>) -> Option<Duration> {
    BRANCHES.replace(latest)
}

/// Sets which motors are stopped when this thread waits next, by their last commands.
pub(crate) fn stop_at_wait(commands: Option<Range<u32>>) {
    LEFT.set(commands);
}

/// How many slices of time this thread has waited so far.
pub(crate) fn slices() -> u64 {
    SLICES.get()
}

/// Whether it is time for this thread to serve its events.
pub(crate) fn is_tick_due(now: impl FnOnce() -> Duration) -> bool {
    NEXT_TICK.get().is_some_and(|tick| now() >= tick)
}

impl<C: QueryableContextType> Call<'_, C> {
    /// One slice of a wait: unifies `reason` with what is to be done before the next one, or calls
    /// `ended`. The result is that of a nondeterministic predicate.
    pub(crate) fn slice<W: Wait>(
        &self,
        wait: &mut Slices<W>,
        reason: &Term,
        ended: impl FnOnce(W::End) -> PrologResult<()>,
    ) -> PrologResult<bool> {
        let tick = NEXT_TICK.get();
        if let Some(commands) = LEFT.take() {
            self.or_throw(motor::stop_commanded(&state::devices(), &commands))?;
        }
        if let Some(next) = BRANCHES.get() {
            let now = state::devices().tree().now();
            return match wait.poll(now) {
                Err(error) => self.leave(&error, reason),
                Ok(Look::Over(end)) => ended(end).map(|()| false),
                Ok(Look::Again(end)) => {
                    SLICES.set(SLICES.get() + 1);
                    BRANCHES.set(Some(next.min(end)));
                    unify_atom(reason, "tick").map(|()| true)
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
        unify_atom(reason, if is_tick { "tick" } else { "pause" }).map(|()| true)
    }

    /// Has Prolog serve the events of this thread, if it is time to: a read of a sensor is
    /// such a time, too, for programs that never wait.
    pub(crate) fn serve_if_due(&self) -> PrologResult<()> {
        if is_tick_due(|| state::devices().tree().now()) {
            self.context.call_once(pred!("ev3dev_waits:serve_at_read/0"), [])?;
        }
        Ok(())
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
        self.slice(wait, reason, |ended| unify_atom(reason, ended.word()))
    }
}
