//! `prolog/ev3dev/time.pl`: the clock of the tree in use.
use crate::glue::call::Call;
use crate::glue::due::note_guards;
use crate::glue::terms::unify_atom;
use crate::glue::waiting::{self, Round};
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
    register_guards();
    register_tick_after();
    register_tick_at_once();
    register_serve_at_prompt();
    register_slices();
    register_branches_begin();
    register_branches_leave();
    register_branches_look();
    register_read_on();
    register_serve_if_due();
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

    /// guards_: the program may have guards from now on.
    #[module("ev3dev_native")]
    #[name("guards_")]
    semidet fn guards(_context) {
        note_guards();
        into_prolog_result(true)
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

    /// tick_at_once_: this thread serves its events when it waits next, by any clock.
    #[module("ev3dev_native")]
    #[name("tick_at_once_")]
    semidet fn tick_at_once(_context) {
        waiting::tick_at(Some(Duration::ZERO));
        into_prolog_result(true)
    }

    /// branches_begin_: from now on the waits of this thread let no time pass.
    #[module("ev3dev_native")]
    #[name("branches_begin_")]
    semidet fn branches_begin(context) {
        let now = Call::of(context, "both", 2).devices()?.tree().now();
        waiting::begin_branches(Round::GoesOn(now.saturating_add(BRANCHES_LOOK)));
        Ok(())
    }

    /// branches_leave_: a branch is left from now on. Its clean-ups may wait, and time passes.
    #[module("ev3dev_native")]
    #[name("branches_leave_")]
    semidet fn branches_leave(_context) {
        waiting::leave_branches();
        into_prolog_result(true)
    }

    /// read_on_: the next read of a branch lets no other go on before.
    #[module("ev3dev_native")]
    #[name("read_on_")]
    semidet fn read_on(_context) {
        waiting::read_on();
        into_prolog_result(true)
    }

    /// serve_if_due_: serves the events of this thread, if it is time to.
    #[module("ev3dev_native")]
    #[name("serve_if_due_")]
    semidet fn serve_if_due(context) {
        Call::of(context, "both", 2).serve_if_due()
    }

    /// branches_look_(-Seconds): after what time the first of them has to look again.
    #[module("ev3dev_native")]
    #[name("branches_look_")]
    semidet fn branches_look(context, seconds) {
        let now = Call::of(context, "both", 2).devices()?.tree().now();
        let look = waiting::branches_look().unwrap_or(now);
        seconds.unify(look.saturating_sub(now).as_secs_f64())
    }

    /// branches_end_: they pause.
    #[module("ev3dev_native")]
    #[name("branches_end_")]
    semidet fn branches_end(_context) {
        waiting::end_branches();
        into_prolog_result(true)
    }

    /// serve_at_prompt_: from now on the main thread serves its events at the prompt, too.
    #[module("ev3dev_native")]
    #[name("serve_at_prompt_")]
    semidet fn serve_at_prompt(_context) {
        waiting::serve_at_prompt();
        into_prolog_result(true)
    }

    /// slices_(-Count): how many slices of time this thread has waited.
    #[module("ev3dev_native")]
    #[name("slices_")]
    semidet fn slices(_context, count) {
        count.unify(waiting::slices())
    }
}
