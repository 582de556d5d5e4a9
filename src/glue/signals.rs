//! Signals that ask the program to end.
use crate::glue::terms::{Ask as _, unify_atom};
use ev3_signals::Asked;
use std::io;
use swipl::prelude::*;

/// Takes such signals from now on: first the motors stop, then Prolog gets the signal.
/// Where Prolog need not be asked, `stop` stops them. After an error, as where no descriptor
/// is left, Prolog gets the signals as ever.
pub(crate) fn watch(stop: fn()) -> io::Result<()> {
    ev3_signals::watch(Asked { ends, stop })
}

/// Asks Prolog in an engine of its own, as the program's may be busy. It gets none from a
/// Prolog that halts already.
fn ends(signal: &'static str, has_terminal: bool) -> bool {
    let engine = Engine::new();
    let activation = engine.activate();
    if activation.engine_ptr().is_null() {
        return true;
    }
    let context: Context<_> = activation.into();
    let [name, terminal] = context.new_term_refs();
    let stops = unify_atom(&name, signal)
        .and_then(|()| terminal.unify(has_terminal))
        .and_then(|()| context.ask(pred!("ev3dev_halt:told_to_end/2"), [&name, &terminal]));
    stops.is_ok()
}
