//! Signals that ask the program to end.
use crate::glue::terms::unify_atom;
use std::sync::Once;
use swipl::prelude::*;

/// Takes such signals from now on: first the motors stop, then Prolog gets the signal.
pub(crate) fn watch() {
    static WATCHED: Once = Once::new();
    // Without a thread, Prolog gets the signals as ever.
    WATCHED.call_once(|| drop(ev3_signals::watch(stops_for)));
}

/// Asks Prolog in an engine of its own, as the program's may be busy.
fn stops_for(signal: &'static str) -> bool {
    let engine = Engine::new();
    let context: Context<_> = engine.activate().into();
    let name = context.new_term_ref();
    let stops = unify_atom(&name, signal)
        .and_then(|()| context.call_once(pred!("ev3dev_halt:told_to_end/1"), [&name]));
    stops.is_ok()
}
