//! The simulation that runs: there is at most one in a process.
use super::dev::SimulatedDev;
use super::files::SimulatedFiles;
use super::mount;
use crate::glue::call::Call;
use crate::glue::error::no_such;
use crate::glue::state::{dev, devices, use_dev, use_dev_files, use_files, use_tree};
use ev3_sim::{Clock, Machine, Simulation};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use swipl::fli::has_other_threads;
use swipl::prelude::*;

static RUNNING: Mutex<Option<Running>> = Mutex::new(None);

struct Running {
    simulation: Arc<Simulation>,
    /// The directories of attributes and device files that were in use before.
    before: [PathBuf; 2],
}

fn running() -> MutexGuard<'static, Option<Running>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The running simulation; fails if there is none.
fn current() -> PrologResult<Arc<Simulation>> {
    match &*running() {
        Some(running) => Ok(Arc::clone(&running.simulation)),
        None => Err(PrologError::Failure),
    }
}

/// The running simulation, in which it is this thread's turn; fails if there is none.
pub(super) fn simulation<C: QueryableContextType>(call: &Call<C>) -> PrologResult<Arc<Simulation>> {
    let simulation = current()?;
    call.wait_for(|about| simulation.turn(about))?;
    Ok(simulation)
}

/// Starts a simulation and ends the running one.
pub(super) fn start<C: QueryableContextType>(
    call: &Call<C>,
    machine: Machine,
    clock: Clock,
) -> PrologResult<()> {
    let simulation = match Simulation::new(machine, clock, has_other_threads) {
        Ok(simulation) => Arc::new(simulation),
        Err(error) => return no_such(call, "resource", "thread", &error.to_string()),
    };
    mount::end();
    let before = running().as_ref().map(|running| running.before.clone());
    let before =
        before.unwrap_or_else(|| [devices().tree().root().to_owned(), dev().root().to_owned()]);
    let ended = running().replace(Running { simulation: Arc::clone(&simulation), before });
    drop(ended);
    use_dev(Arc::new(SimulatedDev::new(Arc::clone(&simulation))));
    call.or_throw(use_tree(Arc::new(SimulatedFiles::new(simulation))))
}

/// Ends the simulation and goes back to the directories before it; fails if there is none.
pub(super) fn stop<C: QueryableContextType>(call: &Call<C>) -> PrologResult<()> {
    simulation(call)?;
    mount::end();
    let ended = running().take().ok_or(PrologError::Failure)?;
    let [files, dev] = ended.before.clone();
    use_dev_files(dev);
    call.or_throw(use_files(files))
}

/// Ends the simulation after the program has selected other files, unless a mount shows
/// it to other programs.
pub(crate) fn end_unless_mounted() {
    if !mount::is_mounted() {
        let ended = running().take();
        drop(ended);
    }
}
