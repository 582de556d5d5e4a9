//! `prolog/ev3dev/halt.pl`: stops motors when a program ends.
use crate::glue::call::Call;
use crate::glue::state::{chosen_devices, devices};
use crate::glue::waiting;
use ev3_driver::motor;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_running();
    register_ending();
    register_stop_started();
}

predicates! {
    /// running_(-Ports): the motors that the program started and that still turn.
    #[module("ev3dev_native")]
    #[name("running_")]
    semidet fn running(_context, ports) {
        let motors = chosen_devices().map(|devices| motor::running(&devices)).unwrap_or_default();
        let names: Vec<_> = motors.iter().map(|motor| atomable(motor.port())).collect();
        ports.unify(names.as_slice())
    }

    /// ending_(+Ending): whether the program is told to end, and Prolog has not got the
    /// signal yet.
    #[module("ev3dev_native")]
    #[name("ending_")]
    semidet fn ending(_context, ending) {
        waiting::set_ending(ending.get_ex()?);
        Ok(())
    }

    /// stop_started_: stops the motors that the program started.
    #[module("ev3dev_native")]
    #[name("stop_started_")]
    semidet fn stop_started(context) {
        Call::of(context, "halt", 0).or_throw(motor::stop_started(&devices()))
    }
}
