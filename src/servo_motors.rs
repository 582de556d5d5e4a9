//! `prolog/ev3dev/servo_motors.pl`: RC servos.
use crate::driver::unify_port;
use crate::glue::call::ListedDevices;
use ev3_driver::device::retry;
use ev3_driver::motor::servo;
use ev3_driver::{Class, Device};
use std::sync::Arc;
use swipl::prelude::*;

natives! {
    /// servo_position_(?Port, -Percent)
    nondet fn "servo_position_"<ListedDevices>(context, port, percent) as call("servo_motor_position", 2) {
        setup => {
            call.listed(&*call.devices()?, Class::ServoMotor, port).map(Some)
        },
        call(servos) => {
            let devices = &call.devices()?;
            let read = |servo: &Arc<Device>| {
                call.or_fail(devices.read(servo, servo::position).map(Option::flatten))
            };
            call.next(servos, read, |servo, read| {
                percent.unify(*read)?;
                unify_port(port, servo.port())
            })
        }
    }

    /// servo_set_position_(+Port, +Percent)
    semidet fn "servo_set_position_"(context, port, percent) as call("servo_motor_position", 2) {
        let (port, percent) = (call.text(port)?, call.float(percent)?);
        let (devices, interrupted) = (call.devices_to_move()?, &mut call.interrupted());
        let set = |servo: &Arc<Device>| servo::set_position(servo, percent);
        let set = retry::with(&devices, Class::ServoMotor, &port, interrupted, set);
        into_prolog_result(call.or_fail(set)?)
    }

    /// servo_motor_float_(+Port)
    semidet fn "servo_motor_float_"(context, port) as call("servo_motor_float", 1) {
        let (class, name) = (Class::ServoMotor, call.text(port)?);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let float = |servo: &Arc<Device>| servo::float(servo);
        call.or_absent(class, port, retry::with(&devices, class, &name, interrupted, float))
    }
}
