//! Thinking takes time, by the virtual clock of a simulation that asks for it: what a thread has
//! inferred since its last use of the robot passes as time at the next one.
use crate::glue::call::Call;
use crate::glue::due::is_in_branch;
use crate::glue::state::devices;
use crate::glue::terms::{Ask as _, Prolog, unify_atom};
use ev3_driver::sysfs::Sysfs;
use ev3_driver::{Device, Registry, Value, journal, motor};
use ev3_sim::is_outside;
use std::cell::{Cell, RefCell};
use std::time::Duration;
use swipl::fli::this_thread;
use swipl::prelude::*;

/// A thought that is worth a word.
const LONG: Duration = Duration::from_millis(500);

thread_local! {
    /// How many inferences of each engine of this thread, by its number, have had their time.
    static PASSED: RefCell<Vec<(i32, u64)>> = const { RefCell::new(Vec::new()) };
    /// The inferences that had not had their time when this thread began to wait between two slices
    /// of time.
    static THOUGHT_BEFORE: Cell<Option<u64>> = const { Cell::new(None) };
}

/// Calls `act` with the inferences of this engine that have had their time, and whether they are
/// known.
fn with_passed<T>(act: impl FnOnce(&mut u64, bool) -> T) -> T {
    let me = this_thread();
    PASSED.with_borrow_mut(|all| {
        if let Some((_, passed)) = all.iter_mut().find(|(engine, _)| *engine == me) {
            return act(passed, true);
        }
        let mut passed = 0;
        let answer = act(&mut passed, false);
        all.push((me, passed));
        answer
    })
}

/// The position of a motor in degrees; 0 if it cannot be read.
fn position(motor: &Device) -> f64 {
    match motor::measured(motor, "position") {
        #[expect(clippy::cast_precision_loss, reason = "it has 32 bits")]
        Ok(Value::Integer(degrees)) => degrees as f64,
        Ok(Value::Float(degrees)) => degrees,
        _ => 0.0,
    }
}

impl<C: Prolog> Call<'_, C> {
    /// How many inferences this engine has made.
    pub(crate) fn inferences(&self) -> PrologResult<u64> {
        let [key, count] = self.context.new_term_refs();
        unify_atom(&key, "inferences")?;
        self.context.ask(pred!("system:statistics/2"), [&key, &count])?;
        count.get()
    }

    /// What this thread has thought so far takes no time.
    #[cfg(feature = "sim")]
    pub(crate) fn begin_to_think(&self) -> PrologResult<()> {
        let inferences = self.inferences()?;
        with_passed(|passed, _| *passed = inferences);
        Ok(())
    }

    /// How many inferences of this engine have not had their time.
    pub(crate) fn thought(&self) -> PrologResult<u64> {
        let inferences = self.inferences()?;
        Ok(with_passed(|passed, _| inferences.saturating_sub(*passed)))
    }

    /// What it has thought since [`thought`](Self::thought) answered this takes no time. Such
    /// times may lie in each other.
    pub(crate) fn thought_nothing(&self, thought: u64) -> PrologResult<()> {
        let (now, again) = (self.inferences()?, self.inferences()?);
        // To ask for the number is an inference, too: twice here, and once before.
        let free = (again + (again - now)).saturating_sub(thought);
        with_passed(|passed, _| *passed = free.max(*passed));
        Ok(())
    }

    /// Calls Prolog for something that takes no time.
    pub(crate) fn thinks_nothing<T>(
        &self,
        act: impl FnOnce() -> PrologResult<T>,
    ) -> PrologResult<T> {
        if devices().tree().thinking() == 0 {
            return act();
        }
        let thought = self.thought()?;
        let answer = act()?;
        self.thought_nothing(thought)?;
        Ok(answer)
    }

    /// A slice of a wait begins: what Prolog did since the last one depends on how busy the
    /// machine is.
    pub(crate) fn wait_goes_on(&self) -> PrologResult<()> {
        THOUGHT_BEFORE.take().map_or(Ok(()), |thought| self.thought_nothing(thought))
    }

    /// It ends, and the wait is not over.
    pub(crate) fn wait_pauses(&self) -> PrologResult<()> {
        if devices().tree().thinking() != 0 {
            THOUGHT_BEFORE.set(Some(self.thought()?));
        }
        Ok(())
    }

    /// Lets the time of what this thread has thought pass.
    pub(crate) fn think(&self, devices: &Registry) -> PrologResult<()> {
        let tree = devices.tree();
        let rate = tree.thinking();
        if rate == 0 || is_outside() {
            return Ok(());
        }
        let inferences = self.inferences()?;
        let thought = with_passed(|passed, is_known| {
            // An engine begins at 0; another one may have had its number.
            let new = match inferences.checked_sub(*passed) {
                Some(_) if !is_known && !is_in_branch() => 0,
                Some(new) => new,
                None => inferences,
            };
            *passed = inferences;
            new
        });
        let nanoseconds = u128::from(thought) * 1_000_000_000 / u128::from(rate);
        let time = Duration::from_nanos(u64::try_from(nanoseconds).unwrap_or(u64::MAX));
        let start = tree.now();
        let long = || self.long_thought(devices, start, time);
        if time < LONG { self.passes(tree, start + time) } else { long() }
    }

    /// The motors of this thread stop if it has thought for too long.
    #[cold]
    fn long_thought(
        &self,
        devices: &Registry,
        start: Duration,
        time: Duration,
    ) -> PrologResult<()> {
        let turning = motor::running(devices).into_iter();
        let before: Vec<_> = turning.map(|motor| (position(&motor), motor)).collect();
        let limit = self.limit()?;
        let mut stopped = Vec::new();
        if !limit.is_zero() && time >= limit {
            self.passes(devices.tree(), start + limit)?;
            journal::set_called("ev3dev_watchdog", 0);
            stopped = motor::stop_turning(devices, Some(motor::commander()));
        }
        self.passes(devices.tree(), start.saturating_add(time))?;
        let turned = before.iter().map(|(from, motor)| (position(motor) - from).abs());
        let ports: Vec<_> = stopped.iter().map(|motor| atomable(motor.port())).collect();
        let arguments = self.context.new_term_refs::<4>();
        arguments[0].unify(time.as_secs_f64())?;
        arguments[1].unify(turned.fold(0.0, f64::max))?;
        arguments[2].unify(limit.as_secs_f64())?;
        arguments[3].unify(ports.as_slice())?;
        self.context.ask(pred!("ev3dev_watchdog:thought/4"), arguments.each_ref())
    }

    fn passes(&self, tree: &dyn Sysfs, end: Duration) -> PrologResult<()> {
        self.wait_for(|_| tree.now() >= end || tree.pause(&[], end).unwrap_or(true))
    }
}
