//! Signals that ask the program to end.
use crate::glue::call::Call;
use crate::glue::state;
use crate::glue::terms::{Ask as _, unify_atom};
use ev3_driver::error::{Access, Error};
use ev3_driver::lock::locked;
use ev3_signals::Asked;
use std::io;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use swipl::prelude::*;

/// Takes such signals from now on: first the motors stop, then Prolog gets the signal.
/// Where Prolog need not be asked, `stop` stops them. After an error, as where no descriptor
/// is left, Prolog gets the signals as ever.
pub(crate) fn watch() -> io::Result<()> {
    static IS_WATCHED: Mutex<bool> = Mutex::new(false);
    let mut is_watched = locked(&IS_WATCHED);
    if !*is_watched {
        ev3_signals::watch(Asked { ends, stop: state::stop_started })?;
        *is_watched = true;
    }
    Ok(())
}

/// Motors may start from now on, which signals can stop. The first time, Prolog says whether
/// they are to be stopped when the process is killed.
#[inline]
pub(crate) fn before_motors<C: QueryableContextType>(call: &Call<C>) -> PrologResult<()> {
    static IS_ASKED: AtomicBool = AtomicBool::new(false);
    if IS_ASKED.load(Ordering::Relaxed) {
        return Ok(());
    }
    call.or_throw(watch().map_err(|source| Error::Open {
        path: "a pipe for signals".into(),
        access: Access::Write,
        source,
    }))?;
    let survives = call.context.ask(pred!("ev3dev_halt:before_motors/0"), []);
    ev3_signals::survive(attempt(survives)?);
    IS_ASKED.store(true, Ordering::Relaxed);
    Ok(())
}

/// Asks Prolog in an engine of its own, as the program's may be busy.
fn ends(signal: &'static str, has_terminal: bool) -> bool {
    let engine = Engine::new();
    let context: Context<_> = engine.activate().into();
    let [name, terminal] = context.new_term_refs();
    let stops = unify_atom(&name, signal)
        .and_then(|()| terminal.unify(has_terminal))
        .and_then(|()| context.ask(pred!("ev3dev_halt:told_to_end/2"), [&name, &terminal]));
    stops.is_ok()
}
