//! `prolog/ev3dev/time.pl`: the clock of the tree in use.
use crate::glue::call::Call;
use crate::glue::terms::unify_atom;
use crate::glue::waiting;
use ev3_driver::device::sleep::Sleep;
use ev3_driver::wait::Slices;
use std::time::Duration;
use swipl::prelude::*;

/// The longest time between two looks of branches.
const BRANCHES_LOOK: Duration = Duration::from_millis(20);

/// Registers the predicates below.
pub(crate) fn register() {
    register_now();
    register_wait();
    register_tick_after();
    register_slices();
    register_branches_begin();
    register_branches_end();
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

    /// tick_after_(+Seconds): this thread serves its events after some time, or, if that
    /// is `infinite`, has none.
    #[module("ev3dev_native")]
    #[name("tick_after_")]
    semidet fn tick_after(context, seconds) {
        let call = Call::of(context, "every", 2);
        waiting::tick_at(match call.seconds(seconds)? {
            Some(time) => Some(call.devices()?.tree().now().saturating_add(time)),
            None => None,
        });
        Ok(())
    }

    /// branches_begin_: from now on the waits of this thread let no time pass.
    #[module("ev3dev_native")]
    #[name("branches_begin_")]
    semidet fn branches_begin(context) {
        let now = Call::of(context, "both", 2).devices()?.tree().now();
        waiting::set_branches(Some(now.saturating_add(BRANCHES_LOOK)));
        Ok(())
    }

    /// branches_end_(-Seconds): after what time the first of them has to look again.
    #[module("ev3dev_native")]
    #[name("branches_end_")]
    semidet fn branches_end(context, seconds) {
        let now = Call::of(context, "both", 2).devices()?.tree().now();
        let next = waiting::set_branches(None).unwrap_or(now);
        seconds.unify(next.saturating_sub(now).as_secs_f64())
    }

    /// slices_(-Count): how many slices of time this thread has waited.
    #[module("ev3dev_native")]
    #[name("slices_")]
    semidet fn slices(_context, count) {
        count.unify(waiting::slices())
    }
}
