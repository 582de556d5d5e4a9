//! The wall clock: a thread steps the machine.
use super::acts::PeriodicActs;
use crate::shared::{Crowd, Shared};
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::Duration;

/// How often the machine is stepped.
pub(super) const STEP: Duration = Duration::from_millis(2);

/// Steps a machine by the wall clock.
#[derive(Debug)]
pub(super) struct Stepper {
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Stepper {
    pub(super) fn start(
        shared: Arc<Shared>,
        crowd: Option<Arc<Crowd>>,
        acts: Arc<PeriodicActs>,
        factor: f64,
    ) -> io::Result<Self> {
        shared.follow(factor);
        let stop = Arc::new(AtomicBool::new(false));
        let is_over = Arc::clone(&stop);
        let thread = std::thread::Builder::new().name("ev3-sim".to_owned()).spawn(move || {
            // Its robots are there as long as this.
            let _crowd = crowd;
            while !is_over.load(Ordering::Relaxed) {
                std::thread::sleep(STEP);
                let machine = shared.lock_as_it_is();
                let passed = shared.behind();
                drop(acts.step(&shared, machine, passed));
                shared.wake();
            }
        })?;
        Ok(Self { stop, thread: Some(thread) })
    }
}

impl Drop for Stepper {
    fn drop(&mut self) {
        self.stop.store(true, Ordering::Relaxed);
        // The stepper's own thread may hold the last reference to the simulation.
        let is_me = |thread: &JoinHandle<()>| thread.thread().id() == std::thread::current().id();
        if let Some(thread) = self.thread.take_if(|thread| !is_me(thread)) {
            // It ends within a step. If it panicked, that was reported there.
            let _ = thread.join();
        }
    }
}
