//! A person's acts on a page: they change the simulated world and its time.
use super::reach::outside;
use crate::glue::call::Call;
use crate::glue::error::{wrong_because, wrong_value};
use crate::glue::state::watched;
use crate::glue::terms::{Prolog, unify_atom};
use crate::sim::watched_simulation;
use ev3_os::locked;
use ev3_sim::{Clock, ItemId, Port, Simulation, SpecError};
use std::sync::{Arc, Mutex};
use swipl::prelude::*;

/// The driver of what was pulled out of each port.
type Pulled = [Option<&'static str>; 8];

/// The same, and the film in which that happened.
static PULLED: Mutex<(u64, Pulled)> = Mutex::new((0, [None; 8]));

natives! {
    /// view_pace_(+Factor): simulated seconds in a second at most; 0 is no limit.
    semidet fn "view_pace_"(context, factor) as call("view", 1) {
        let factor = call.float(factor)?;
        let simulation = simulation()?;
        let limit = match simulation.clock() {
            Clock::Wall(_) => f64::INFINITY,
            Clock::Virtual => 0.0,
        };
        let factor = if factor > 0.0 { factor } else { limit };
        simulation.set_pace((factor > 0.0).then_some(factor));
        Ok(())
    }

    /// view_pause_(+Pauses)
    semidet fn "view_pause_"(_context, pauses) {
        simulation()?.set_paused(pauses.get_ex()?);
        Ok(())
    }

    /// view_step_(+Seconds, +IsIdle): lets time pass while paused. If the program waits for a
    /// person, nobody else would.
    semidet fn "view_step_"(context, seconds, is_idle) as call("view", 1) {
        let (time, is_idle) = (call.time(seconds)?, is_idle.get_ex()?);
        let simulation = simulation()?;
        if is_idle && simulation.clock() == Clock::Virtual {
            outside(|| simulation.step(time));
        } else {
            simulation.allow(time);
        }
        Ok(())
    }

    /// view_stands_: the clock is virtual, so time stands while no program runs.
    semidet fn "view_stands_"(_context) {
        into_prolog_result(simulation()?.clock() == Clock::Virtual)
    }

    /// view_facts_(-Text): the world as a file of facts.
    semidet fn "view_facts_"(_context, text) {
        let facts = simulation()?.machine().world_facts();
        text.unify(facts.as_str())
    }

    /// view_held_: no time may pass just now, by the pace or as it is paused.
    semidet fn "view_held_"(_context) {
        into_prolog_result(simulation()?.is_held())
    }

    /// view_pull_(+Port): fails if nothing is plugged in.
    semidet fn "view_pull_"(context, port) as call("view", 1) {
        let (port, simulation) = (port_of(&call, port)?, simulation()?);
        let driver = simulation.machine().plugged(port);
        let is_pulled = simulation.machine().unplug(port);
        if is_pulled {
            let mut now = pulled();
            now[port as usize] = driver;
            *locked(&PULLED) = (watched().film(), now);
        }
        into_prolog_result(is_pulled)
    }

    /// view_put_back_(+Port, -Driver): what was pulled out of a port; fails if nothing was.
    semidet fn "view_put_back_"(context, port, driver) as call("view", 1) {
        let port = port_of(&call, port)?;
        match pulled()[port as usize] {
            Some(name) => unify_atom(driver, name),
            None => Err(PrologError::Failure),
        }
    }

    /// view_move_(+Id, +X, +Y, +Heading): heading may be an atom. Fails if there is no such item.
    semidet fn "view_move_"(context, id, x, y, heading) as call("view", 1) {
        let item = ItemId(u32::try_from(call.integer(id)?).map_err(|_| PrologError::Failure)?);
        let to = [call.float(x)?, call.float(y)?];
        let heading = if heading.is_atom() { None } else { Some(call.float(heading)?) };
        let moved = simulation()?.change_world(|machine| machine.move_item(item, to, heading));
        match moved {
            Ok(is_there) => into_prolog_result(is_there),
            Err(SpecError { item, reason, .. }) => {
                let item = term! {context: #atomable(item.as_str())}?;
                wrong_because(&call, "possible_geometry", &item, &reason)
            }
        }
    }
}

/// The simulation; fails if none runs.
fn simulation() -> PrologResult<Arc<Simulation>> {
    watched_simulation().ok_or(PrologError::Failure)
}

/// The device that was pulled out of each port.
pub(super) fn pulled() -> Pulled {
    let (of, pulled) = *locked(&PULLED);
    if of == watched().film() { pulled } else { Pulled::default() }
}

fn port_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Port> {
    match call.text(term)?.parse() {
        Ok(port) => Ok(port),
        Err(_) => wrong_value(call, "port", term),
    }
}
