//! `prolog/ev3dev/view.pl`: what a page in a browser shows of the robot.
//!
//! What is shown is taken from the simulation under its lock, or is what the driver knows: no
//! time passes, and nothing is read on the program's behalf.
mod believed;
mod brick;
mod commands;
pub(crate) mod door;
mod frame;
pub(crate) mod hand;
mod notes;
mod reach;
mod threads;

pub(crate) use self::believed::{counting_begins, pose_is_set};

use self::notes::{Entry, notes};
use self::reach::{keep_samples, running_simulation, seconds, stop_motors};
use crate::glue::call::{Call, Text};
use crate::glue::terms::{Ask as _, unify_atom};
use crate::glue::watch;
use ev3_json::Json;
use ev3_signals::latch::{self, Reason};
use swipl::prelude::*;

/// Adds what the program has commanded meanwhile to the log.
fn log_commands<'a, C: QueryableContextType>(
    context: &'a Context<'a, C>,
    call: &Call<'a, C>,
) -> PrologResult<()> {
    commands::log_new(|cause| {
        let texts = context.new_term_ref();
        let number = context.new_term_ref();
        number.unify(u64::from(cause))?;
        context.ask(pred!("ev3dev_view_log:cause_texts/2"), [&number, &texts])?;
        call.map_list(&texts, |text| call.text(&text).map(Text::into_owned))
    })
}

natives! {
    /// view_open_: somebody may watch from now on.
    semidet fn "view_open_"(_context) {
        watch::set_watched(true);
        keep_samples(true);
        into_prolog_result(true)
    }

    /// view_close_: nobody does any more. Time passes as fast as ever.
    semidet fn "view_close_"(_context) {
        watch::set_watched(false);
        keep_samples(false);
        if let Some(simulation) = running_simulation() {
            simulation.set_pace(None);
            simulation.set_paused(false);
        }
        latch::lift(Reason::Stopped);
        into_prolog_result(true)
    }

    /// view_thread_(+Serves): this thread serves a page from now on, and is no part of the
    /// program; or it ends.
    semidet fn "view_thread_"(_context, serves) {
        threads::serve(serves.get_ex()?);
        Ok(())
    }

    /// view_frame_(+Have, +State, +Settings, -Text): the next frame for a page that has some. State is
    /// that of the program; Settings are members of the frame that never change.
    semidet fn "view_frame_"(context, have, state, settings, text) {
        let call = Call::of(context, "view", 1);
        let (have, state, settings) = (call.text(have)?, call.text(state)?, call.text(settings)?);
        log_commands(context, &call)?;
        text.unify(frame::next(&have, &state, &settings).as_str())
    }

    /// view_keep_(+Name, +Json): a member of the frames that is sent when it has changed.
    semidet fn "view_keep_"(context, name, json) {
        let call = Call::of(context, "view", 1);
        let (name, json) = (call.text(name)?, call.text(json)?);
        notes().keep(&name, &json);
        Ok(())
    }

    /// view_log_(+Kind, +Text, +Causes, +Thread)
    semidet fn "view_log_"(context, kind, text, causes, thread) {
        let call = Call::of(context, "view_mark", 1);
        let owned = |term: &Term| call.text(term).map(Text::into_owned);
        // What was commanded before stands before it.
        log_commands(context, &call)?;
        let entry = Entry {
            time: seconds(),
            kind: owned(kind)?,
            text: owned(text)?,
            causes: call.map_list(causes, |cause| owned(&cause))?,
            thread: owned(thread)?,
        };
        notes().log(entry);
        Ok(())
    }

    /// view_value_(+Name, +Number)
    semidet fn "view_value_"(context, name, number) {
        let call = Call::of(context, "view_value", 2);
        let (name, number, time) = (call.text(name)?, call.float(number)?, seconds());
        notes().value(&name, time, number);
        Ok(())
    }

    /// view_latch_: no motor starts from now on.
    semidet fn "view_latch_"(_context) {
        latch::set(Reason::Stopped);
        into_prolog_result(true)
    }

    /// view_lift_: motors may start again.
    semidet fn "view_lift_"(_context) {
        latch::lift(Reason::Stopped);
        into_prolog_result(true)
    }

    /// view_stop_motors_: stops all motors that are connected, with brake, at once.
    semidet fn "view_stop_motors_"(context) {
        Call::of(context, "view", 1).or_throw(stop_motors())
    }

    /// view_users_(-Threads): the numbers of the threads that have used devices.
    semidet fn "view_users_"(_context, list) {
        list.unify(threads::users().collect::<Vec<_>>().as_slice())
    }

    /// view_serves_: this thread serves a page.
    semidet fn "view_serves_"(_context) {
        into_prolog_result(threads::serves())
    }

    /// view_json_(+Text, -Json): a text as JSON, all of it ASCII.
    semidet fn "view_json_"(context, text, json) {
        let mut written = Json::new();
        written.text(&Call::of(context, "view", 1).text(text)?);
        json.unify(written.as_text())
    }

    /// view_to_world_(+X, +Y, -WorldX, -WorldY, -Turn): a place of the odometry in the world, and
    /// the turn from its frame to the world's.
    semidet fn "view_to_world_"(context, x, y, world_x, world_y, turn) {
        let call = Call::of(context, "view", 1);
        let to_world = believed::ToWorld::now();
        let [x, y] = to_world.point([call.float(x)?, call.float(y)?]);
        world_x.unify(x)?;
        world_y.unify(y)?;
        turn.unify(to_world.turn())
    }

    /// view_source_(-Source): `sim`, `brick` or `none`.
    semidet fn "view_source_"(_context, source) {
        unify_atom(source, frame::source())
    }
}
