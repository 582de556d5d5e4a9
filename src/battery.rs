//! `prolog/ev3dev/battery.pl`: the battery.
use crate::glue::error::wrong_value;
use crate::glue::terms::unify_value;
use ev3_driver::Value;
use ev3_driver::brick::battery;
use swipl::prelude::*;

natives! {
    /// battery_(+Key, -Value)
    semidet fn "battery_"(context, key, value) as call("battery", 2) {
        let (name, devices) = (call.text(key)?, call.devices()?);
        let battery = call.or_throw(battery::battery(&devices))?;
        let battery = &battery.map_or_else(|| call.lacking("battery"), Ok)?;
        let read = match &*name {
            "voltage" => battery::volts(battery).map(|volts| Some(Value::Float(volts))),
            "current" => battery::amperes(battery).map(|read| read.map(Value::Float)),
            "percent" => battery::percent(battery).map(|read| read.map(Value::Integer)),
            "type" => battery::chemistry(battery).map(|read| read.map(Value::Text)),
            _ => return wrong_value(&call, "battery_key", key),
        };
        unify_value(value, &call.or_fail(read)?)
    }
}
