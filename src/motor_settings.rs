//! `prolog/ev3dev/motor_settings.pl`: what a motor is set to.
use crate::call::{Call, ListedDevices, unify_value};
use crate::driver::unify_port;
use ev3_driver::device::retry;
use ev3_driver::{Class, Device, motor};
use std::sync::Arc;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_motor_position();
    register_motor_set_position();
}

predicates! {
    /// motor_position_(?Port, -Position)
    #[module("ev3dev_motor_settings")]
    #[name("motor_position_")]
    nondet fn motor_position<ListedDevices>(context, port, position) {
        setup => {
            let call = Call::of(context, "motor_position", 2);
            call.listed(Class::TachoMotor, port)
        },
        call(motors) => {
            let call = Call::of(context, "motor_position", 2);
            let devices = &call.devices()?;
            let read = |motor: &Arc<Device>| call.found(devices.read(motor, motor::position));
            call.next(motors, read, |motor, read| {
                unify_value(position, read)?;
                unify_port(port, motor.port())
            })
        }
    }

    /// motor_set_position_(+Port, +Position)
    #[module("ev3dev_motor_settings")]
    #[name("motor_set_position_")]
    semidet fn motor_set_position(context, port, position) {
        let call = Call::of(context, "motor_position", 2);
        let (port, position) = (call.text(port)?, call.float(position)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let set = |motor: &Arc<Device>| motor::set_position(motor, position);
        let set = retry::with(&devices, Class::TachoMotor, &port, interrupted, set);
        into_prolog_result(call.found(set)?)
    }
}
