//! `prolog/ev3dev/private/run/halt.pl`: stops motors when a program ends.
use crate::glue::state::{self, all_devices, on_all_bricks};
use ev3_driver::{Registry, motor};
use ev3_signals::latch::Reason;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use swipl::fli::act_at_halt;
use swipl::prelude::*;

/// Whether the motors are stopped when Prolog halts.
static STOPS: AtomicBool = AtomicBool::new(true);

/// Prolog halts for good. Its threads may go on for a while, and start motors.
pub(crate) fn halts() {
    if STOPS.load(Ordering::Relaxed) {
        ev3_signals::stop_for(Reason::Halting);
        // What fails was to be stopped before, and said so.
        state::stop_started();
    } else {
        ev3_signals::leave();
    }
}

natives! {
    /// running_(-Ports): the motors that the program started and that still turn.
    semidet fn "running_"(_context, ports) {
        let running = |devices: Arc<Registry>| motor::running(&devices);
        let motors: Vec<_> = all_devices().into_iter().flat_map(running).collect();
        let names: Vec<_> = motors.iter().map(|motor| atomable(motor.port())).collect();
        ports.unify(names.as_slice())
    }

    /// at_halt_(+Stops): Prolog is about to halt, and is to stop the motors, or to leave them,
    /// if that is not canceled.
    semidet fn "at_halt_"(_context, stops) {
        let stops = stops.get_ex()?;
        STOPS.store(stops, Ordering::Relaxed);
        ev3_signals::is_to_halt(stops);
        act_at_halt(halts);
        Ok(())
    }

    /// halt_canceled_: a goal of `at_halt/1` has canceled that.
    semidet fn "halt_canceled_"(_context) {
        ev3_signals::is_to_halt(false);
        into_prolog_result(true)
    }

    /// told_to_end_: a signal ends the program. From now on no motor starts.
    semidet fn "told_to_end_"(_context) {
        ev3_signals::stop_for(Reason::Ending);
        into_prolog_result(true)
    }

    /// stop_started_: stops the motors that the program started.
    semidet fn "stop_started_"(context) as call("halt", 0) {
        call.or_throw(on_all_bricks(motor::stop_started))
    }

    /// halts_by_(+Signal): Prolog halts because of a signal, `term`, `hup` or `int`.
    semidet fn "halts_by_"(context, signal) as call("halt", 0) {
        let signal = call.text(signal)?;
        ev3_signals::halts(&signal);
        Ok(())
    }
}
