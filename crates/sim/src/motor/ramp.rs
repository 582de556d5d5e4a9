//! Class ramps: `docs/ev3dev-sysfs.md`, 3.5.
//!
//! The class walks the speed that it gives to the driver from the measured speed to the wanted
//! one. A ramp whose ends have different signs has two legs, one to zero and one from there. All
//! times are in jiffies. A step comes 100 ms after the time of the one before the last, so that
//! they are 50 to 60 ms apart.
use super::{Command, Ramp, Tacho};
use crate::wheel::{Timer, jiffies_from_ms, jiffy};

const PERIOD: u64 = 10;
const HALF_PERIOD: i64 = 5;

impl Tacho {
    /// The present jiffy. It is counted from boot, and a leg may count from before that.
    fn jiffy(&self) -> i64 {
        i64::try_from(jiffy(self.now)).unwrap_or(i64::MAX)
    }

    /// Begins a leg. It starts at the measured speed, or at the last step of a ramp that is still
    /// flagged; and it heads for the speed of the active setpoints, whose sign is that of the
    /// motion only if the program chose it so.
    pub(super) fn start_ramp(&mut self) {
        if !self.ramping {
            self.ramp.last = self.speed;
        }
        let (from, wanted) = (self.ramp.last, self.active.speed);
        let end = if from.wrapping_mul(wanted) < 0 { 0 } else { wanted };
        let change = end.wrapping_sub(from);
        let is_up = from.wrapping_mul(change) >= 0;
        let full = if is_up { self.active.ramp_up_ms } else { self.active.ramp_down_ms };
        let full = u32::try_from(jiffies_from_ms(full)).unwrap_or(u32::MAX);
        let most = self.kind.max_speed.unsigned_abs();
        let duration = full.wrapping_mul(change.unsigned_abs()) / most;
        let started = self.jiffy() - HALF_PERIOD;
        self.ramp = Ramp { last: from, end, change, duration, started, stepped: started };
        self.ramping = true;
        self.ramp_step();
    }

    /// One step. If the last one set the wanted speed, the ramp is done, and the driver hears of it
    /// nothing: also when no step came before, as the measured speed was the wanted one.
    pub(super) fn ramp_step(&mut self) {
        if self.ramp.last == self.active.speed {
            self.ramping = false;
            if self.command == Command::Stop {
                self.stop();
            }
            return;
        }
        if self.ramp.last == self.ramp.end {
            self.start_ramp();
            return;
        }
        let now = self.jiffy();
        let left = (self.ramp.started + i64::from(self.ramp.duration) - now).max(0);
        self.ramp.last = if self.ramp.duration == 0 {
            self.ramping = false;
            self.ramp.end
        } else {
            // In the 32 bits of the kernel's int.
            let left = i32::try_from(left).unwrap_or(i32::MAX);
            let duration = i32::try_from(self.ramp.duration).unwrap_or(i32::MAX);
            let off = self.ramp.change.wrapping_mul(left).wrapping_div(duration);
            self.ramp.end.wrapping_sub(off)
        };
        if self.command.is_position_move() {
            self.run_to(self.active.position, self.ramp.last);
        } else {
            self.run_regulated(self.ramp.last);
        }
        let passed = (now - self.ramp.stepped).unsigned_abs();
        self.ramp.stepped = now;
        if self.ramp_timer.is_some() {
            // A step that is scheduled already stays where it is.
        } else if passed < PERIOD {
            self.ramp_timer = Some(Timer::new(jiffy(self.now), PERIOD - passed));
        } else {
            self.ramp_step();
        }
    }
}
