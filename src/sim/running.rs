//! The simulation that runs: there is at most one of each brick.
use super::dev::SimulatedDev;
use super::files::SimulatedFiles;
use super::mount;
use crate::glue::call::Call;
use crate::glue::error::no_such;
use crate::glue::state::{
    Selected, brick_number, devices, select, selected, show_robot, use_brick, use_dev, use_tree,
    watched,
};
use crate::glue::terms::Prolog;
use crate::glue::waiting::tick_at_once;
use crate::glue::watch;
use ev3_os::locked;
use ev3_sim::{Clock, ItemId, Machine, Misplaced, Simulation, robot_of};
use std::collections::BTreeMap;
use std::io;
use std::sync::{Arc, Mutex};
use swipl::fli::has_other_threads;
use swipl::prelude::*;

/// By the number of its brick.
static RUNNING: Mutex<BTreeMap<u32, Running>> = Mutex::new(BTreeMap::new());

struct Running {
    simulation: Arc<Simulation>,
    /// The files that were in use before.
    before: Selected,
    /// All robots in its world by their numbers, if it is one of several.
    names: Arc<[String]>,
}

/// The running simulation, in which it is this thread's turn; fails if there is none.
pub(super) fn simulation<C: Prolog>(context: &Context<C>) -> PrologResult<Arc<Simulation>> {
    let simulation = running_simulation();
    let call = Call::of(context, "sim_start", 1);
    let Some(simulation) = simulation else {
        return none(&call);
    };
    call.think(&devices())?;
    call.wait_for(|about| simulation.turn(about))?;
    Ok(simulation)
}

/// The running simulation whose tree is in use, for somebody who only looks or reaches in from
/// outside.
pub(crate) fn watched_simulation() -> Option<Arc<Simulation>> {
    running_simulation().filter(|_| watched().is_simulated())
}

/// The running simulation.
pub(super) fn running_simulation() -> Option<Arc<Simulation>> {
    locked(&RUNNING).get(&brick_number()).map(|running| Arc::clone(&running.simulation))
}

/// The simulations of all bricks.
pub(crate) fn running_simulations() -> Vec<Arc<Simulation>> {
    locked(&RUNNING).values().map(|running| Arc::clone(&running.simulation)).collect()
}

/// The name of another robot in the world of the brick in use.
pub(crate) fn robot_name(id: ItemId) -> Option<String> {
    locked(&RUNNING).get(&brick_number())?.names.get(robot_of(id)?).cloned()
}

/// Whether a simulation on the virtual clock runs in a brick.
pub(crate) fn has_virtual_clock(brick: u32) -> bool {
    let running = locked(&RUNNING);
    running.get(&brick).is_some_and(|running| running.simulation.clock() == Clock::Virtual)
}

/// Fails because no simulation runs.
fn none<C: Prolog, T>(call: &Call<C>) -> PrologResult<T> {
    let context = call.context;
    call.fail_because(&term! {context: no_simulation}?)
}

/// Whether a simulation runs.
pub(super) fn is_running() -> bool {
    locked(&RUNNING).contains_key(&brick_number())
}

/// Starts a simulation and ends the running one.
pub(super) fn start<C: Prolog>(
    call: &Call<C>,
    mut machine: Machine,
    clock: Clock,
) -> PrologResult<()> {
    call.begin_to_think()?;
    machine.keep_samples(watch::is_watched());
    match Simulation::new(machine, clock, has_other_threads) {
        Ok(simulation) => run(call, simulation, Arc::default()),
        Err(error) => no_thread(call, &error),
    }
}

/// Starts a simulation of several robots, each in the brick of this number and with its name. The
/// inner error is that of a robot, by its index.
pub(super) fn start_crowd<C: Prolog>(
    call: &Call<C>,
    robots: &[(u32, String)],
    machines: Vec<Machine>,
    clock: Clock,
) -> PrologResult<Result<(), Misplaced>> {
    let simulations = match Simulation::crowd(machines, clock, has_other_threads) {
        Ok(Ok(simulations)) => simulations,
        Ok(Err(misplaced)) => return Ok(Err(misplaced)),
        Err(error) => return no_thread(call, &error),
    };
    call.begin_to_think()?;
    let outer = brick_number();
    let names: Arc<[String]> = robots.iter().map(|(_, name)| name.clone()).collect();
    // Somebody who looks sees a match, and not its end.
    let pace = watch::drawn_film().filter(|_| clock == Clock::Virtual).map(|_| 1.0);
    let mut started = Ok(());
    for ((brick, _), simulation) in robots.iter().zip(simulations) {
        if started.is_ok() && use_brick(*brick) {
            simulation.machine().keep_samples(watch::is_watched());
            simulation.set_pace(pace);
            started = run(call, simulation, Arc::clone(&names));
        }
    }
    use_brick(outer);
    robots.iter().take(1).for_each(|(brick, _)| show_robot(*brick));
    started.map(Ok)
}

fn no_thread<T, C: Prolog>(call: &Call<C>, error: &io::Error) -> PrologResult<T> {
    no_such(call, "resource", "thread", &error.to_string())
}

/// Runs a simulation in the brick in use, in the place of the running one. Somebody who watches
/// sees it at the pace of that.
fn run<C: Prolog>(
    call: &Call<C>,
    simulation: Simulation,
    names: Arc<[String]>,
) -> PrologResult<()> {
    let simulation = Arc::new(simulation);
    mount::end();
    let before = locked(&RUNNING).get(&brick_number()).map(|running| running.before.clone());
    let before = before.unwrap_or_else(selected);
    let running = Running { simulation: Arc::clone(&simulation), before, names };
    let ended = locked(&RUNNING).insert(brick_number(), running);
    let clock = simulation.clock();
    if let Some(same) = ended.filter(|ended| ended.simulation.clock() == clock) {
        if watch::is_watched() {
            simulation.set_pace(same.simulation.pace());
        }
    }
    use_simulated(call, simulation, true)
}

/// Uses the files of a simulation from now on; its machine may be in another process.
pub(super) fn use_simulated<C: Prolog>(
    call: &Call<C>,
    simulation: Arc<Simulation>,
    is_here: bool,
) -> PrologResult<()> {
    use_dev(Arc::new(SimulatedDev::new(Arc::clone(&simulation))));
    watched().set_simulated(is_here);
    tick_at_once();
    call.or_throw(use_tree(Arc::new(SimulatedFiles::new(simulation))))
}

/// Ends the simulation and goes back to the files before it; fails if there is none.
pub(super) fn stop<C: Prolog>(call: &Call<C>) -> PrologResult<()> {
    if !is_running() {
        return none(call);
    }
    mount::end();
    let ended = locked(&RUNNING).remove(&brick_number());
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
        end_of(brick_number());
    }
}

/// Ends the simulation of a brick, if it has one, and its mount.
pub(crate) fn end_of(brick: u32) {
    mount::end_of(brick);
    let ended = locked(&RUNNING).remove(&brick);
    drop(ended);
}
