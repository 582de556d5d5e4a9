//! `prolog/ev3dev/robot.pl`: what takes more than motors.
use crate::glue::call::Call;
use crate::glue::terms::unify_atom;
use ev3_driver::Class;
use ev3_driver::drive::turn::{self, Ended, Turn};
use ev3_driver::motor::Speed;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_turn_by_gyro();
}

predicates! {
    /// turn_by_gyro_(+Gyro, +wheels(Left, Right, LeftSign, RightSign, Gearing), +Percent, +Degrees, -Ended)
    #[module("ev3dev_native")]
    #[name("turn_by_gyro_")]
    semidet fn turn_by_gyro(context, gyro, wheels, percent, degrees, ended) {
        let call = Call::of(context, "turn", 2);
        let devices = call.devices()?;
        let [left, right, left_sign, right_sign, gearing] = call.arguments(wheels)?;
        let turn = Turn {
            left: call.text(&left)?.into(),
            right: call.text(&right)?.into(),
            signs: [call.integer(&left_sign)?, call.integer(&right_sign)?],
            speed: Speed::Percent(call.float(percent)?),
            degrees: call.float(degrees)?,
            gearing: call.float(&gearing)?,
        };
        let gyro = call.or_fail(devices.find(Class::Sensor, &call.text(gyro)?))?;
        let turned = turn::by_gyro(&devices, &gyro, &turn, &mut call.interrupted());
        unify_atom(ended, word(call.or_fail(turned)?))
    }
}

fn word(ended: Ended) -> &'static str {
    match ended {
        Ended::Reached => "reached",
        Ended::Stalled => "stalled",
        Ended::Astray => "astray",
        Ended::Missed(_) => "missed",
        Ended::Stopped => "stopped",
    }
}
