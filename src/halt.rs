//! `prolog/ev3dev/halt.pl`: stops motors when a program ends.
use crate::glue::call::Call;
use crate::glue::state::devices;
use ev3_driver::motor;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_stop_started();
}

predicates! {
    /// stop_started_: stops the motors that the program started.
    #[module("ev3dev_native")]
    #[name("stop_started_")]
    semidet fn stop_started(context) {
        Call::of(context, "halt", 0).or_throw(motor::stop_started(&devices()))
    }
}
