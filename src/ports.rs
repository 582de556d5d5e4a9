//! `prolog/ev3dev/ports.pl`: ports.
use crate::driver::unify_port;
use crate::glue::call::ListedDevices;
use crate::glue::terms::unify_atom;
use ev3_driver::brick::port as lego_port;
use swipl::prelude::*;

natives! {
    /// port_set_mode_(+Port, +Mode)
    semidet fn "port_set_mode_"(context, port, mode) as call("port_mode", 2) {
        let (port, mode) = (call.text(port)?, call.text(mode)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let set = lego_port::set_mode(&devices, &port, &mode, interrupted);
        into_prolog_result(call.or_fail(set)?)
    }

    /// port_device_(?Port, -Type)
    nondet fn "port_device_"<ListedDevices>(context, port, kind) as call("port_device", 2) {
        setup => {
            let (bound, devices) = (call.text_if_bound(port)?, call.devices()?);
            let found = call.or_throw(lego_port::devices_at(&devices, bound.as_deref()))?;
            Ok(Some(found.into_iter().collect()))
        },
        call(found) => {
            call.next(found, |_| Ok(()), |device, ()| {
                unify_atom(kind, device.driver())?;
                unify_port(port, device.port())
            })
        }
    }

    /// port_set_device_(+Port, +Name)
    semidet fn "port_set_device_"(context, port, name) as call("port_device", 2) {
        let (port, name) = (call.text(port)?, call.text(name)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let set = lego_port::set_device(&devices, &port, &name, interrupted);
        into_prolog_result(call.or_fail(set)?)
    }
}
