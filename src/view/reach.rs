//! Reaching into the simulation that runs, from outside of the program.
use super::threads;
use crate::glue::state::{devices, on_all_bricks};
use crate::sim::{running_simulations, watched_simulation};
use ev3_driver::{Error, motor};
use ev3_sim::stay_outside;
use std::time::Duration;

/// Reaches in from outside: no simulated time passes, and no turn is waited for.
pub(super) fn outside<T>(act: impl FnOnce() -> T) -> T {
    stay_outside(true);
    let done = act();
    stay_outside(threads::serves());
    done
}

/// The time in frames.
fn now() -> Duration {
    match watched_simulation() {
        Some(simulation) => simulation.machine().now(),
        None => devices().tree().now(),
    }
}

/// The same in seconds.
pub(super) fn seconds() -> f64 {
    now().as_secs_f64()
}

/// Keeps samples from now on, or none.
pub(super) fn keep_samples(keep: bool) {
    for simulation in running_simulations() {
        simulation.machine().keep_samples(keep);
    }
}

/// Stops all motors that are connected to any brick, with brake, at once.
pub(super) fn stop_motors() -> ev3_driver::Result<()> {
    on_all_bricks(|devices| match outside(|| motor::stop_connected(devices, &mut || true)) {
        // A motor whose files are not open yet does not run.
        Err(Error::Interrupted) => Ok(()),
        stopped => stopped,
    })
}
