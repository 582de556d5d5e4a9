//! `prolog/ev3dev/view.pl`: what a page in a browser shows of the robot.
//!
//! What is shown is taken from the simulation under its lock, or is what the driver knows: no
//! time passes, and nothing is read on the program's behalf.
mod believed;
mod brick;
#[cfg(unix)]
pub(crate) mod door;
#[cfg(not(unix))]
#[path = "page.rs"]
pub(crate) mod door;
pub(crate) mod frame;
pub(crate) mod hand;
pub(crate) mod located;
mod notes;
mod printed;
mod reach;
mod simulated;
mod state;
mod terms;
mod threads;

use self::notes::notes;
use self::reach::{keep_samples, seconds, stop_motors};
use self::state::{Decimal, Entry};
use crate::glue::call::Call;
use crate::glue::state::{has_tree, show_brick};
use crate::glue::terms::Prolog;
use crate::glue::watch;
use crate::sim::running_simulations;
use ev3_signals::latch::{self, Reason};
use swipl::prelude::*;

natives! {
    /// view_open_: somebody may watch from now on.
    semidet fn "view_open_"(_context) {
        watch::set_watched(true);
        keep_samples(true);
        swipl::fli::see_output(printed::written);
        into_prolog_result(true)
    }

    /// view_expect_: a browser was begun, in which a page will come.
    semidet fn "view_expect_"(_context) {
        watch::look(0, 4 * watch::LOOKS);
        into_prolog_result(true)
    }

    /// view_close_: nobody does any more. Time passes as fast as ever.
    semidet fn "view_close_"(_context) {
        watch::set_watched(false);
        keep_samples(false);
        printed::keep(false);
        swipl::fli::see_output_no_more();
        show_brick(None);
        for simulation in running_simulations() {
            simulation.set_pace(None);
            simulation.set_paused(false);
        }
        latch::lift(Reason::Stopped);
        into_prolog_result(true)
    }

    /// view_thread_(+Serves): this thread serves a page from now on, and is not a part of the
    /// program; or it ends.
    semidet fn "view_thread_"(_context, serves) {
        threads::serve(serves.get_ex()?);
        Ok(())
    }

    /// view_show_(+Brick): pages show this brick from now on; fails if it is not open.
    semidet fn "view_show_"(context, number) as call("view", 1) {
        let number = call.integer(number)?;
        into_prolog_result(u32::try_from(number).is_ok_and(|number| show_brick(Some(number))))
    }

    /// view_has_robot_(+Brick): a tree was chosen for it.
    semidet fn "view_has_robot_"(context, number) as call("view", 1) {
        let number = call.integer(number)?;
        into_prolog_result(u32::try_from(number).is_ok_and(has_tree))
    }

    /// view_keep_(+Name, +Json): a member of the frames that is sent when it has changed.
    semidet fn "view_keep_"(context, name, json) as call("view", 1) {
        let (name, json) = (call.text(name)?, terms::text(&call, json)?);
        notes().keep(&name, json);
        Ok(())
    }

    /// view_log_(+Time, +Kind, +Text, +Causes, +About, +Thread): Time is in seconds, or `now`, or
    /// span(From, Until, Times).
    semidet fn "view_log_"(context, time, kind, text, causes, about, thread) as call("view_mark", 1) {
        let owned = |term: &Term| Ok(call.text(term)?.into_owned().into());
        let some = |list: &Term| -> PrologResult<_> {
            let texts: Vec<state::Text> = call.map_list(list, |text| owned(&text))?;
            Ok(Some(texts).filter(|all| !all.is_empty()))
        };
        let (time, until, times) = span(&call, time)?;
        let (kind, text, thread) = (owned(kind)?, owned(text)?, owned(thread)?);
        let thread = Some(thread).filter(|name: &state::Text| !name.is_empty());
        let (causes, about) = (some(causes)?, some(about)?);
        notes().log(Entry { n: 0, time, until, times, kind, text, causes, about, thread });
        Ok(())
    }

    /// view_value_(+Name, +Number)
    semidet fn "view_value_"(context, name, number) as call("view_value", 2) {
        let (name, number, time) = (call.text(name)?, call.float(number)?, seconds());
        notes().value(&name, time, number);
        Ok(())
    }

    /// view_prints_(+Keeps): whether the program prints, so that what is written to the standard
    /// output is kept.
    semidet fn "view_prints_"(_context, keeps) {
        printed::keep(keeps.get_ex()?);
        Ok(())
    }

    /// view_printed_(+Ended, -Times, -Texts): what was printed since the last call, and when. The
    /// beginning of a line is held back, unless Ended.
    semidet fn "view_printed_"(_context, ended, times, texts) {
        let (when, what) = printed::take(ended.get_ex()?);
        times.unify(when.as_slice())?;
        texts.unify(what.iter().map(String::as_str).collect::<Vec<_>>().as_slice())
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
    semidet fn "view_stop_motors_"(context) as call("view", 1) {
        call.or_throw(stop_motors())
    }

    /// view_users_(-Threads): the numbers of the threads that have used devices.
    semidet fn "view_users_"(_context, list) {
        list.unify(threads::users().collect::<Vec<_>>().as_slice())
    }

    /// view_serves_: this thread serves a page.
    semidet fn "view_serves_"(_context) {
        into_prolog_result(threads::serves())
    }

    /// view_to_world_(+X, +Y, -WorldX, -WorldY, -Turn): a place of the odometry in the world, and
    /// the turn from its frame to the world's.
    semidet fn "view_to_world_"(context, x, y, world_x, world_y, turn) as call("view", 1) {
        let to_world = believed::ToWorld::now();
        let [x, y] = to_world.point([call.float(x)?, call.float(y)?]);
        world_x.unify(x)?;
        world_y.unify(y)?;
        turn.unify(to_world.turn())
    }

    /// view_part_: this thread is a part of the program, before it uses a device.
    semidet fn "view_part_"(_context) {
        watch::note_user();
        into_prolog_result(true)
    }
}

/// From when until when, and how often, something was done; the last two if it was more than once.
fn span<C: Prolog>(
    call: &Call<C>,
    time: &Term,
) -> PrologResult<(Decimal<3>, Option<Decimal<3>>, Option<u64>)> {
    let arguments = call.compound(time)?.map(|(_, arguments)| arguments);
    let [from, until, times] = &arguments.unwrap_or_default()[..] else {
        let at = if time.is_atom() { seconds() } else { call.float(time)? };
        return Ok((Decimal(at), None, None));
    };
    let again = u64::try_from(call.integer(times)?).ok().filter(|times| *times > 1);
    let until = Decimal(call.float(until)?);
    Ok((Decimal(call.float(from)?), again.map(|_| until), again))
}
