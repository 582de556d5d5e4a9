//! `prolog/ev3dev/time.pl`: the clock of the tree in use.
use crate::glue::call::Call;
use ev3_driver::sysfs::sleep;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_now();
    register_wait();
}

predicates! {
    /// now_(-Seconds): since some fixed moment.
    #[module("ev3dev_native")]
    #[name("now_")]
    semidet fn now(context, seconds) {
        let call = Call::of(context, "ev3_time", 1);
        seconds.unify(call.devices()?.tree().now().as_secs_f64())
    }

    /// wait_(+Seconds)
    #[module("ev3dev_native")]
    #[name("wait_")]
    semidet fn wait(context, seconds) {
        let call = Call::of(context, "wait", 1);
        let (devices, seconds) = (call.devices()?, call.time(seconds)?);
        call.or_throw(sleep(devices.tree(), seconds, &mut call.interrupted()))
    }
}
