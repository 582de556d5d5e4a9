//! `prolog/ev3dev/sim_hand.pl`, too: what a hand can press.
use super::running::simulation;
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::terms::Prolog;
use ev3_driver::port_name;
use ev3_sim::{Button, Machine, Port, Simulation};
use std::sync::Arc;
use std::time::Duration;
use swipl::prelude::*;

/// What a hand can press.
#[derive(Clone, Copy)]
enum Key {
    Button(Button),
    /// The touch sensor at a port.
    Touch(Port),
}

impl Key {
    fn of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Self> {
        let text = call.text(term)?;
        if let Ok(button) = text.parse() {
            return Ok(Self::Button(button));
        }
        match port_name::socket(&text).parse::<Port>() {
            Ok(port) if !port.is_output() => Ok(Self::Touch(port)),
            _ => wrong_value(call, "key", term),
        }
    }

    /// Presses or releases it now; false if there is no such sensor.
    fn set(self, machine: &mut Machine, is_press: bool) -> bool {
        match self {
            Self::Button(button) if is_press => machine.press(button),
            Self::Button(button) => machine.release(button),
            Self::Touch(port) => return machine.press_touch(port, is_press),
        }
        true
    }

    /// Presses or releases it at a time.
    fn plan(self, simulation: &Simulation, is_press: bool, at: Duration) {
        if let Self::Button(button) = self {
            simulation.machine().plan_button(button, is_press, at);
            return;
        }
        let shared = Arc::downgrade(&simulation.shared());
        let act = move || {
            let shared = shared.upgrade()?;
            self.set(&mut shared.lock(), is_press);
            shared.wake();
            None
        };
        simulation.repeat(at, Box::new(act));
    }
}

natives! {
    /// sim_key_(+Key, +IsPress)
    semidet fn "sim_key_"(context, key, is_press) as call("sim_press", 1) {
        let key = Key::of(&call, key)?;
        let (simulation, is_press) = (simulation(context)?, is_press.get_ex()?);
        let is_there = key.set(&mut simulation.machine(), is_press);
        simulation.shared().wake();
        into_prolog_result(is_there)
    }

    /// sim_plan_key_(+Key, +After, +For): seconds; an atom as For means without end.
    semidet fn "sim_plan_key_"(context, key, after, lasts) as call("sim_press", 2) {
        let (key, at) = (Key::of(&call, key)?, call.time(after)?);
        let lasts = if lasts.is_atom() { None } else { Some(call.time(lasts)?) };
        let simulation = simulation(context)?;
        key.plan(&simulation, true, at);
        if let Some(lasts) = lasts {
            key.plan(&simulation, false, at.saturating_add(lasts));
        }
        Ok(())
    }
}
