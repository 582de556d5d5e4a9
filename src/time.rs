//! `prolog/ev3dev/time.pl`: the clock of the tree in use.
use crate::glue::call::Call;
use crate::glue::terms::unify_atom;
use crate::glue::waiting;
use ev3_driver::device::sleep::Sleep;
use ev3_driver::wait::Slices;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_now();
    register_wait();
    register_tick_after();
    register_tick_never();
    register_slices();
}

predicates! {
    /// now_(-Seconds): since some fixed moment.
    #[module("ev3dev_native")]
    #[name("now_")]
    semidet fn now(context, seconds) {
        let call = Call::of(context, "ev3_time", 1);
        seconds.unify(call.devices()?.tree().now().as_secs_f64())
    }

    /// wait_(+Seconds, -Reason): `over` at the end.
    #[module("ev3dev_native")]
    #[name("wait_")]
    nondet fn wait<Slices<Sleep>>(context, seconds, reason) {
        setup => {
            let call = Call::of(context, "wait", 1);
            let (devices, seconds) = (call.devices()?, call.time(seconds)?);
            Ok(Some(Sleep::new(devices, seconds)))
        },
        call(sleep) => {
            let call = Call::of(context, "wait", 1);
            call.slice(sleep, reason, |()| unify_atom(reason, "over"))
        }
    }

    /// tick_after_(+Seconds): this thread serves its events after some time.
    #[module("ev3dev_native")]
    #[name("tick_after_")]
    semidet fn tick_after(context, seconds) {
        let call = Call::of(context, "every", 2);
        let now = call.devices()?.tree().now();
        waiting::tick_at(Some(now.saturating_add(call.time(seconds)?)));
        Ok(())
    }

    /// tick_never_: this thread has no events.
    #[module("ev3dev_native")]
    #[name("tick_never_")]
    semidet fn tick_never(_context) {
        waiting::tick_at(None);
        Ok(())
    }

    /// slices_(-Count): how many slices of time this thread has waited.
    #[module("ev3dev_native")]
    #[name("slices_")]
    semidet fn slices(_context, count) {
        count.unify(waiting::slices())
    }
}
