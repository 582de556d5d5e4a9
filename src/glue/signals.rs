//! Signals that ask the program to end.
use crate::glue::terms::{Ask as _, unify_atom};
use ev3_driver::motor;
use ev3_signals::Asked;
use std::cell::Cell;
use std::io;
use std::time::Duration;
use swipl::fli::this_thread;
use swipl::prelude::*;

/// Takes such signals from now on: first the motors stop, then Prolog gets the signal.
/// Where Prolog need not be asked, `stop` stops them. `computes` stops those of a thread, by its
/// name, that has computed for so long. After an error, as where no descriptor
/// is left, Prolog gets the signals as ever.
pub(crate) fn watch(stop: fn(), computes: fn(u64, Duration)) -> io::Result<()> {
    ev3_signals::watch(Asked { ends, stop, computes })
}

/// The highest bit of a name for the watchdog: the thread has started motors of far bricks, too.
const FAR: u64 = 1 << 63;

/// This thread is about to start a motor, and may compute for so long while it runs.
pub(crate) fn guard(far: bool, limit: Duration) {
    thread_local! {
        static IS_FAR: Cell<u64> = const { Cell::new(0) };
    }
    if far {
        IS_FAR.set(FAR);
    }
    let name = u64::from(this_thread().unsigned_abs()) << 32 | u64::from(motor::commander());
    ev3_signals::guard(IS_FAR.get() | name, limit);
}

/// Has Prolog say that the thread of that name has computed for so long, and that motors stopped:
/// those at these ports, and those of far bricks.
pub(crate) fn say_computed(name: u64, limit: Duration, ports: &[&str]) {
    if ports.is_empty() && name & FAR == 0 {
        return;
    }
    let ports: Vec<_> = ports.iter().map(|port| atomable(*port)).collect();
    in_engine(|context| {
        let [thread, seconds, list] = context.new_term_refs();
        thread.unify((name & !FAR) >> 32)?;
        seconds.unify(limit.as_secs_f64())?;
        list.unify(ports.as_slice())?;
        context.ask(pred!("ev3dev_watchdog:computes/3"), [&thread, &seconds, &list])
    });
}

/// Asks Prolog in an engine of its own, as the program's may be busy. It gets none from a
/// Prolog that halts already: `None`.
fn in_engine(
    ask: impl FnOnce(&Context<ActivatedEngine>) -> PrologResult<()>,
) -> Option<PrologResult<()>> {
    let engine = Engine::new();
    let activation = engine.activate();
    if activation.engine_ptr().is_null() {
        return None;
    }
    let context: Context<_> = activation.into();
    Some(ask(&context))
}

/// Whether Prolog says that a signal ends the program; one that halts already does.
fn ends(signal: &'static str, has_terminal: bool) -> bool {
    let stops = in_engine(|context| {
        let [name, terminal] = context.new_term_refs();
        unify_atom(&name, signal)?;
        terminal.unify(has_terminal)?;
        context.ask(pred!("ev3dev_halt:told_to_end/2"), [&name, &terminal])
    });
    stops.is_none_or(|stops| stops.is_ok())
}
