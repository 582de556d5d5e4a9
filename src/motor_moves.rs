//! `prolog/ev3dev/motor_moves.pl`: more ways to run a motor.
use crate::call::Call;
use crate::driver::class_of;
use ev3_driver::motor;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_motor_run_direct();
}

predicates! {
    /// motor_run_direct_(+Class, +Port, +Percent)
    #[module("ev3dev_native")]
    #[name("motor_run_direct_")]
    semidet fn motor_run_direct(context, class, port, percent) {
        let call = Call::of(context, "motor_run_direct", 2);
        let class = class_of(context, class)?;
        let (port, percent) = (call.text(port)?, call.float(percent)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let runs = motor::run_direct(&devices, class, &port, percent, interrupted);
        into_prolog_result(call.check(runs)?)
    }
}
