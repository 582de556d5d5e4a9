//! Commands to a motor with ramps, where the kernel's ramps are treacherous
//! (docs/ev3dev-sysfs.md, 3.5).
//!
//! A ramp begins at the measured speed. If that is `speed_sp` already, the kernel takes the ramp as
//! done and sends the motor nothing: a move to a position is ignored, and a motor that turned turns
//! on. It may also lead the motor away from its target, if it turns the other way when the ramp
//! begins. So a motor that may turn gets a move to a position without ramps, which does neither.
//!
//! A timed run that is over before its ramp up is, starts again: the kernel
//! forgets to cancel the ramp. With a ramp down, however short, it does not.
use crate::class::Class;
use crate::device::Device;
use crate::device::motion::End;
use crate::error::Result;
use crate::motor::wait::has;
use ev3_os::Errno;
use std::time::Duration;

/// How much longer than its set-point a ramp up may take: two of its steps.
const STEPS: Duration = Duration::from_millis(200);

/// What a command needs besides. The set-points that are changed for it are put
/// back when this is dropped.
pub(super) struct Ramped<'a> {
    motor: &'a Device,
    /// Where a position move ends.
    target: Option<i64>,
    changed: Vec<(&'static str, i64)>,
}

impl<'a> Ramped<'a> {
    /// For a run with this end; `None` if its command can be written as it is.
    pub(super) fn before(motor: &'a Device, end: Option<End>) -> Result<Option<Self>> {
        let target = match end {
            Some(End::Position { target, .. }) => Some(target),
            Some(End::Time(_)) => None,
            Some(End::Never) | None => return Ok(None),
        };
        if motor.class() != Class::TachoMotor {
            return Ok(None);
        }
        let [up, down] = ramps(motor)?;
        let is_treacherous = match end {
            Some(End::Time(time)) => {
                let ramp_up = Duration::from_millis(up.unsigned_abs());
                up > 0 && down == 0 && time < ramp_up.saturating_add(STEPS)
            }
            _ => (up > 0 || down > 0) && may_turn(motor)?,
        };
        Ok(is_treacherous.then_some(Ramped { motor, target, changed: Vec::new() }))
    }

    /// The command to write. A relative one would count from where the motor has got by now.
    pub(super) fn word<'w>(&self, word: &'w str) -> &'w str {
        if self.target.is_some() { "run-to-abs-pos" } else { word }
    }

    /// The writes before the command.
    pub(super) fn prepare(&mut self) -> Result<()> {
        let Some(target) = self.target else {
            return self.set("ramp_down_sp", 1);
        };
        self.set("position_sp", target)?;
        self.set("ramp_up_sp", 0)?;
        self.set("ramp_down_sp", 0)
    }

    fn set(&mut self, attribute: &'static str, value: i64) -> Result<()> {
        self.changed.push((attribute, self.motor.number(attribute)?));
        self.motor.write_number(attribute, value)
    }
}

impl Drop for Ramped<'_> {
    fn drop(&mut self) {
        for (attribute, value) in self.changed.drain(..).rev() {
            // An error is ignored: the motor was unplugged.
            let _ = self.motor.write_number(attribute, value);
        }
    }
}

/// Set-points of the ramps up and down; 0 where a board has none.
pub(super) fn ramps(motor: &Device) -> Result<[i64; 2]> {
    let ramp = |attribute| match motor.number(attribute) {
        Err(error) if error.errno() == Some(Errno::OPNOTSUPP) => Ok(0),
        ramp => ramp,
    };
    Ok([ramp("ramp_up_sp")?, ramp("ramp_down_sp")?])
}

/// Whether the motor may turn, or the kernel take it for ramping.
fn may_turn(motor: &Device) -> Result<bool> {
    let is_busy = |state: &str| has(state, "running") || has(state, "ramping");
    Ok(motor.with_word("state", is_busy)? || motor.number("speed")? != 0)
}
