//! The claim of a coordinated motion to its motors.
//!
//! A drive commands its motors again and again. Another thread may stop one of them, or give it
//! another command, at any time. From then on the motor is no longer claimed, and the motion must
//! leave it alone. Each write here is made under the lock of the motor's run, so that a motion
//! cannot restart a motor that was just stopped.
use crate::device::Device;
use crate::device::motion::{End, MotorRun};
use crate::error::Result;
use crate::motor::command::StopAction;
use std::num::NonZeroU32;
use std::sync::atomic::{AtomicU32, Ordering};

/// A process-wide unique id for a coordinated motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Claim(NonZeroU32);

impl Claim {
    /// A claim that no motor has yet.
    pub(crate) fn new() -> Self {
        static LAST: AtomicU32 = AtomicU32::new(0);
        let next = LAST.fetch_add(1, Ordering::Relaxed).wrapping_add(1);
        Self(NonZeroU32::new(next).unwrap_or(NonZeroU32::MIN))
    }

    /// Claims a motor, whatever its last command was.
    pub(crate) fn take(self, motor: &Device) {
        *motor.run() = Some(self.run(motor, End::Never));
    }

    /// Whether the motor is still claimed: nobody else has given it a command since.
    pub(crate) fn holds(self, motor: &Device) -> bool {
        self.is_of(*motor.run())
    }

    /// Writes a command to a claimed motor. `false`, and nothing is written, if
    /// it is no longer claimed.
    pub(crate) fn start(self, motor: &Device, word: &str, end: End) -> Result<bool> {
        let next = self.run(motor, end);
        let mut present = motor.run();
        if !self.is_of(*present) {
            return Ok(false);
        }
        motor.write("command", word)?;
        *present = Some(next);
        Ok(true)
    }

    /// Stops a claimed motor and gives up the claim. Does nothing if the motor
    /// is no longer claimed.
    pub(crate) fn stop(self, motor: &Device, action: StopAction) -> Result<()> {
        let mut present = motor.run();
        if !self.is_of(*present) {
            return Ok(());
        }
        let chosen = motor.write("stop_action", action.word());
        motor.write("command", "stop")?;
        *present = None;
        chosen
    }

    fn is_of(self, run: Option<MotorRun>) -> bool {
        run.is_some_and(|run| run.claim == Some(self.0))
    }

    fn run(self, motor: &Device, end: End) -> MotorRun {
        let started = motor.tree().now();
        MotorRun { started, is_relative: false, claim: Some(self.0), end }
    }
}
