//! The simulation that runs: there is at most one in a process.
use super::dev::SimulatedDev;
use super::files::SimulatedFiles;
use super::mount;
use crate::glue::call::Call;
use crate::glue::error::no_such;
use crate::glue::state::{Selected, select, selected, use_dev, use_tree};
use crate::glue::waiting::tick_at_once;
use crate::glue::watch;
use ev3_driver::lock::locked;
use ev3_sim::{Clock, Machine, Simulation};
use std::sync::{Arc, Mutex};
use swipl::fli::has_other_threads;
use swipl::prelude::*;

static RUNNING: Mutex<Option<Running>> = Mutex::new(None);

struct Running {
    simulation: Arc<Simulation>,
    /// The files that were in use before.
    before: Selected,
}

/// The running simulation, in which it is this thread's turn; fails if there is none.
pub(super) fn simulation<C: QueryableContextType>(
    context: &Context<C>,
) -> PrologResult<Arc<Simulation>> {
    let simulation = locked(&RUNNING).as_ref().map(|running| Arc::clone(&running.simulation));
    let call = Call::of(context, "sim_start", 1);
    let Some(simulation) = simulation else {
        return none(&call);
    };
    call.wait_for(|about| simulation.turn(about))?;
    Ok(simulation)
}

/// The running simulation, for somebody who only looks or reaches in from outside.
pub(crate) fn running_simulation() -> Option<Arc<Simulation>> {
    locked(&RUNNING).as_ref().map(|running| Arc::clone(&running.simulation))
}

/// Fails because no simulation runs.
fn none<C: QueryableContextType, T>(call: &Call<C>) -> PrologResult<T> {
    let context = call.context;
    call.fail_because(&term! {context: no_simulation}?)
}

/// Whether a simulation runs.
pub(super) fn is_running() -> bool {
    locked(&RUNNING).is_some()
}

/// Starts a simulation and ends the running one.
pub(super) fn start<C: QueryableContextType>(
    call: &Call<C>,
    mut machine: Machine,
    clock: Clock,
) -> PrologResult<()> {
    machine.keep_samples(watch::is_watched());
    let simulation = match Simulation::new(machine, clock, has_other_threads) {
        Ok(simulation) => Arc::new(simulation),
        Err(error) => return no_such(call, "resource", "thread", &error.to_string()),
    };
    mount::end();
    let before = locked(&RUNNING).as_ref().map(|running| running.before.clone());
    let before = before.unwrap_or_else(selected);
    let ended = locked(&RUNNING).replace(Running { simulation: Arc::clone(&simulation), before });
    drop(ended);
    use_dev(Arc::new(SimulatedDev::new(Arc::clone(&simulation))));
    watch::set_simulated(true);
    tick_at_once();
    call.or_throw(use_tree(Arc::new(SimulatedFiles::new(simulation))))
}

/// Ends the simulation and goes back to the files before it; fails if there is none.
pub(super) fn stop<C: QueryableContextType>(call: &Call<C>) -> PrologResult<()> {
    if !is_running() {
        return none(call);
    }
    mount::end();
    let ended = locked(&RUNNING).take();
    tick_at_once();
    match ended {
        Some(ended) => call.or_throw(select(ended.before)),
        None => none(call),
    }
}

/// Ends the simulation after the program has selected other files, unless a mount shows
/// it to other programs.
pub(crate) fn end_unless_mounted() {
    if !mount::is_mounted() {
        let ended = locked(&RUNNING).take();
        drop(ended);
    }
}
