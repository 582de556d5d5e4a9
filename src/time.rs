//! `prolog/ev3dev/time.pl`: the clock of the tree in use.
use crate::glue::due::note_guards;
use crate::glue::state::{chosen_devices, devices};
use crate::glue::terms::unify_atom;
use crate::glue::waiting::{self, Round};
use crate::sim::has_virtual_clock;
use ev3_driver::device::sleep::Sleep;
use ev3_driver::wait::Slices;
use std::time::Duration;
use swipl::prelude::*;

natives! {
    /// now_(-Seconds): since some fixed moment.
    semidet fn "now_"(context, seconds) as call("ev3_time", 1) {
        seconds.unify(call.devices()?.tree().now().as_secs_f64())
    }

    /// wait_(+Seconds, -Reason): `over` at the end.
    nondet fn "wait_"<Slices<Sleep>>(context, seconds, reason) as call("wait", 1) {
        setup => {
            let (devices, seconds) = (call.devices()?, call.time(seconds)?);
            Ok(Some(Sleep::new(devices, seconds)))
        },
        call(sleep) => {
            call.slice(sleep, reason, |()| unify_atom(reason, "over"))
        }
    }

    /// thought_begins_(-Inferences): how many of this thread have not had their time; fails if they
    /// take none.
    semidet fn "thought_begins_"(context, inferences) as call("ev3_time", 1) {
        if devices().tree().thinking() == 0 {
            return Err(PrologError::Failure);
        }
        inferences.unify(call.thought()?)
    }

    /// thought_nothing_(+Inferences, +Before): what this thread has done since thought_begins_ said
    /// that takes no time, nor do that many inferences before it.
    semidet fn "thought_nothing_"(context, thought, before) as call("ev3_time", 1) {
        call.thought_nothing(thought.get::<u64>()?.saturating_sub(before.get()?))
    }

    /// guards_: the program may have guards from now on.
    semidet fn "guards_"(_context) {
        note_guards();
        into_prolog_result(true)
    }

    /// tick_after_(+Seconds): this thread serves its events after some time, or, if that
    /// is `infinite`, has none. This is not a use of a device: it chooses no tree.
    semidet fn "tick_after_"(context, seconds) as call("every", 2) {
        waiting::tick_at(match call.seconds(seconds)? {
            Some(time) => {
                let is_chosen = chosen_devices().is_some();
                let devices = if is_chosen { call.devices()? } else { devices() };
                Some(devices.tree().now().saturating_add(time))
            }
            None => None,
        });
        Ok(())
    }

    /// tick_at_once_: this thread serves its events when it waits next, by any clock.
    semidet fn "tick_at_once_"(_context) {
        waiting::tick_at(Some(Duration::ZERO));
        into_prolog_result(true)
    }

    /// branches_begin_: from now on the waits of this thread let no time pass.
    semidet fn "branches_begin_"(context) as call("both", 2) {
        if chosen_devices().is_some() {
            call.devices()?; // runs planned goals that are due
        }
        waiting::begin_branches(Round::GoesOn(Vec::new()));
        into_prolog_result(true)
    }

    /// branches_leave_: a branch is left from now on. Its clean-ups may wait, and time passes.
    semidet fn "branches_leave_"(_context) {
        waiting::leave_branches();
        into_prolog_result(true)
    }

    /// read_on_: the next read of a branch lets no other go on before.
    semidet fn "read_on_"(_context) {
        waiting::read_on();
        into_prolog_result(true)
    }

    /// serve_if_due_: serves the events of this thread, if it is time to.
    semidet fn "serve_if_due_"(context) as call("both", 2) {
        call.serve_if_due()
    }

    /// branches_look_(-Seconds, -Bricks): after what time the first of them has to look again, and
    /// the numbers of the bricks in which it is to pass: of those on the wall's clock one does.
    semidet fn "branches_look_"(_context, seconds, bricks) {
        let (first, waiting) = waiting::branches_wait();
        seconds.unify(first.as_secs_f64())?;
        let (mut waiting, real): (Vec<_>, Vec<_>) =
            waiting.into_iter().partition(|brick| has_virtual_clock(*brick));
        waiting.extend(real.first());
        let numbers: Vec<_> = waiting.into_iter().map(u64::from).collect();
        bricks.unify(numbers.as_slice())
    }

    /// branches_end_: they pause. An engine of theirs may be gone.
    semidet fn "branches_end_"(_context) {
        waiting::end_branches();
        ev3_signals::own_handlers_stack();
        into_prolog_result(true)
    }

    /// serve_at_prompt_: from now on the main thread serves its events at the prompt, too.
    semidet fn "serve_at_prompt_"(_context) {
        waiting::serve_at_prompt();
        into_prolog_result(true)
    }

    /// slices_(-Count): how many slices of time this thread has waited.
    semidet fn "slices_"(_context, count) {
        count.unify(waiting::slices())
    }
}
