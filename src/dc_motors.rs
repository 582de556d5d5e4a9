//! `prolog/ev3dev/dc_motors.pl`: motors without a rotation sensor.
use crate::motors::move_options;
use ev3_driver::motor::{Moving, dc};
use ev3_driver::wait::Slices;
use swipl::prelude::*;

natives! {
    /// dc_motor_run_(+Port, +Percent)
    semidet fn "dc_motor_run_"(context, port, percent) as call("dc_motor_run", 2) {
        let (port, percent) = (call.text(port)?, call.float(percent)?);
        let (devices, interrupted) = (call.devices_to_move()?, &mut call.interrupted());
        into_prolog_result(call.or_throw(dc::run_forever(&devices, &port, percent, interrupted))?)
    }

    /// dc_motor_run_timed_(+Port, +Percent, +Seconds, +Options, -Reason): options
    /// as those of motor_turn_/3.
    nondet fn "dc_motor_run_timed_"<Slices<Moving>>(context, port, percent, seconds, options, reason) as call("dc_motor_run_timed", 4) {
        setup => {
            let (port, percent) = (call.text(port)?, call.float(percent)?);
            let (time, options) = (call.time(seconds)?, move_options(&call, options)?);
            let (devices, interrupted) = (call.devices_to_move()?, &mut call.interrupted());
            let begun = dc::begin_timed(&devices, &port, percent, time, &options, interrupted);
            call.or_fail(begun).map(Some)
        },
        call(moving) => {
            call.slice_of_move(moving, reason)
        }
    }
}
