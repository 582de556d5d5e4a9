//! `prolog/ev3dev/sim_hand.pl`, too: the buttons of the simulated brick.
use super::running::simulation;
use crate::facts::named;
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use ev3_sim::{Button, Machine};
use std::time::Duration;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_sim_key();
    register_sim_plan_key();
}

predicates! {
    /// sim_key_(+Button, +IsPress)
    #[module("ev3dev_native")]
    #[name("sim_key_")]
    semidet fn sim_key(context, key, is_press) {
        let key: Button = named(&Call::of(context, "sim_press", 1), "button", key)?;
        let (simulation, is_press) = (simulation(context)?, is_press.get_ex()?);
        let act = if is_press { Machine::press } else { Machine::release };
        act(&mut simulation.machine(), key);
        simulation.shared().wake();
        Ok(())
    }

    /// sim_plan_key_(+Button, +After, +For): seconds; an atom as For means without end.
    #[module("ev3dev_native")]
    #[name("sim_plan_key_")]
    semidet fn sim_plan_key(context, key, after, lasts) {
        let call = Call::of(context, "sim_press", 2);
        let (key, at) = (named::<Button, _>(&call, "button", key)?, time(&call, after)?);
        let lasts = if lasts.is_atom() { None } else { Some(time(&call, lasts)?) };
        let simulation = simulation(context)?;
        simulation.machine().plan_button(key, true, at);
        if let Some(lasts) = lasts {
            simulation.machine().plan_button(key, false, at.saturating_add(lasts));
        }
        Ok(())
    }
}

fn time<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<Duration> {
    Duration::try_from_secs_f64(call.float(term)?).or_else(|_| wrong_value(call, "seconds", term))
}
