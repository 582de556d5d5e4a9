//! Signals that ask the program to end.
use crate::glue::terms::unify_atom;
use ev3_signals::Asked;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use swipl::prelude::*;

/// Takes such signals from now on: first the motors stop, then Prolog gets the signal.
/// Where Prolog need not be asked, `stop` stops them.
pub(crate) fn watch(stop: fn()) {
    static WATCHED: Once = Once::new();
    // Without a thread, Prolog gets the signals as ever.
    WATCHED.call_once(|| drop(ev3_signals::watch(Asked { ends, stop })));
}

/// Motors may start from now on. The first time, Prolog says whether they are to be stopped
/// when the process is killed.
#[inline]
pub(crate) fn before_motors<C: QueryableContextType>(context: &Context<C>) -> PrologResult<()> {
    static IS_ASKED: AtomicBool = AtomicBool::new(false);
    if IS_ASKED.load(Ordering::Relaxed) {
        return Ok(());
    }
    let survives = context.call_once(pred!("ev3dev_halt:stops_at_kill/0"), []);
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
        .and_then(|()| context.call_once(pred!("ev3dev_halt:told_to_end/2"), [&name, &terminal]));
    stops.is_ok()
}
