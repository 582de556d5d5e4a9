//! The observer that learns that a motor was started.
//!
//! A drive keeps the odometry of a robot. It must know when a motor may turn a
//! wheel, and when a write to `position` moves the count and not the wheel.
//! Devices report both to an observer, so that they need not know the drive.
use crate::error::Result;
use std::sync::{Arc, OnceLock, Weak};

/// Learns what happens to the motors of a tree.
pub(crate) trait MotionObserver: Send + Sync {
    /// A motor was started.
    fn motor_started(&self);

    /// Does a write that changes the count of the motor at `port` without turning the motor.
    fn without_counting(&self, port: &str, write: &mut dyn FnMut() -> Result<()>) -> Result<()>;
}

/// The observer of a tree's motors, once there is one. All devices of a registry share it.
#[derive(Default)]
pub(crate) struct Observer(OnceLock<Weak<dyn MotionObserver>>);

impl Observer {
    /// Sets the observer. A tree has one: later ones are ignored.
    pub(crate) fn set(&self, observer: Weak<dyn MotionObserver>) {
        let _ = self.0.set(observer);
    }

    pub(crate) fn get(&self) -> Option<Arc<dyn MotionObserver>> {
        self.0.get().and_then(Weak::upgrade)
    }
}
