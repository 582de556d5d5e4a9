//! Class ramps: `docs/ev3dev-sysfs.md`, 3.5.
//!
//! The speed setpoint walks from the present speed to the wanted one in steps of 100 ms. The
//! first step comes at once, as if 50 ms had passed, the second 50 ms later. A change of sign is
//! split into one leg down to zero and one up.

use super::{Goal, Tacho};
use crate::{TICK_MS, ticks_from_ms};

#[derive(Clone, Debug)]
pub(crate) struct Ramp {
    from: i32,
    to: i32,
    end: i32,
    duration_ms: i64,
    started: u64,
    steps: u32,
    goal: Option<Goal>,
    /// Tick of the next step.
    pub(crate) due: u64,
    /// The stop action follows.
    pub(crate) then_stop: bool,
}

impl Tacho {
    /// Starts to ramp. If the speed does not change, a stop takes effect at once, and any other
    /// command has no effect, as in the kernel.
    pub(super) fn start_ramp(&mut self, end: i32, goal: Option<Goal>, then_stop: bool) {
        let from = if self.ramping { self.ramp_value } else { self.speed };
        if from == end {
            if then_stop {
                self.ramping = false;
                self.stop_now();
            }
            return;
        }
        self.ramping = true;
        let mut ramp = Ramp {
            from,
            to: end,
            end,
            duration_ms: 0,
            started: self.now,
            steps: 0,
            goal,
            due: self.now,
            then_stop,
        };
        if i64::from(from) * i64::from(end) < 0 {
            ramp.to = 0;
        }
        ramp.duration_ms = self.leg_duration_ms(ramp.from, ramp.to);
        self.ramp = Some(ramp);
        self.ramp_step();
    }

    fn leg_duration_ms(&self, from: i32, to: i32) -> i64 {
        let up = to.unsigned_abs() > from.unsigned_abs();
        let full = if up { self.active.ramp_up_ms } else { self.active.ramp_down_ms };
        let difference = (i64::from(to) - i64::from(from)).abs();
        i64::from(full) * difference / i64::from(self.kind.max_speed)
    }

    pub(super) fn ramp_step(&mut self) {
        let Some(mut ramp) = self.ramp.take() else {
            return;
        };
        let passed = i64::try_from((self.now - ramp.started) * TICK_MS).unwrap_or(i64::MAX);
        let elapsed = passed.saturating_add(50);
        let arrived = elapsed >= ramp.duration_ms;
        let value = if arrived {
            ramp.to
        } else {
            let way = (i64::from(ramp.to) - i64::from(ramp.from)) * elapsed / ramp.duration_ms;
            ramp.from + i32::try_from(way).unwrap_or(0)
        };
        self.ramp_value = value;
        self.regulate(value, ramp.goal);
        if !arrived || ramp.steps == 0 {
            ramp.due = self.now + ticks_from_ms(if ramp.steps == 0 { 50 } else { 100 });
            ramp.steps += 1;
            self.ramp = Some(ramp);
        } else if ramp.to != ramp.end {
            ramp.from = ramp.to;
            ramp.to = ramp.end;
            ramp.duration_ms = self.leg_duration_ms(ramp.from, ramp.to);
            ramp.started = self.now;
            ramp.steps = 0;
            self.ramp = Some(ramp);
            self.ramp_step();
        } else {
            self.ramping = false;
            if ramp.then_stop {
                self.stop_now();
            }
        }
    }
}
