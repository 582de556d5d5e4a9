//! The periodic work of the driver: every 2 ms, at its timers, and when it samples its flags.

use super::{Drive, Tacho};
use crate::JIFFY_TICKS;

impl Tacho {
    /// One turn of the driver's loop: position, speed, stall test, PID, target test; then, every
    /// 10 ms, the timers.
    pub(crate) fn sample(&mut self, now: u64, count: i32, speed: i32) {
        self.now = now;
        self.count = count;
        self.speed = speed;
        let still = self.running() && speed == 0;
        self.zero_speed_ticks = if still { self.zero_speed_ticks.saturating_add(1) } else { 0 };
        self.regulate_sample();
        self.approach_goal();
        if now % JIFFY_TICKS == 0 {
            self.run_timers();
        }
    }

    fn regulate_sample(&mut self) {
        let output = match self.drive {
            Drive::Speed(0) => {
                self.speed_pid.clear();
                self.overloaded = false;
                self.duty = 0;
                return;
            }
            Drive::Speed(setpoint) => self.speed_pid.update(setpoint.wrapping_sub(self.speed)),
            Drive::Hold(at) => self.hold_pid.update(at.wrapping_sub(self.position())),
            Drive::Coast | Drive::Brake | Drive::Direct(_) => return,
        };
        self.duty = output.duty;
        self.overloaded = output.overloaded;
    }

    fn approach_goal(&mut self) {
        let (Some(goal), Drive::Speed(_)) = (self.goal, self.drive) else {
            return;
        };
        let position = self.position();
        if goal.reached(position) {
            self.ramp = None;
            self.braking = false;
            self.end(goal.at);
            return;
        }
        if self.active.ramp_down_ms > 0 {
            let speed = i64::from(self.speed);
            let down = i64::from(self.active.ramp_down_ms);
            let time = speed.abs() * down / (i64::from(self.kind.max_speed) + 1);
            if goal.passed_by(i64::from(position) + speed * time / 2000) {
                let left = i64::from(goal.at) - i64::from(position);
                self.braking = true;
                self.drive = Drive::Speed(i32::try_from(2000 * left / (time + 1)).unwrap_or(0));
            }
        }
    }

    fn run_timers(&mut self) {
        if self.ramp.as_ref().is_some_and(|ramp| ramp.due <= self.now) {
            self.ramp_step();
        }
        if self.timer.is_some_and(|due| due <= self.now) {
            self.time_is_up();
        }
    }

    pub(super) fn time_is_up(&mut self) {
        self.timer = None;
        if self.active.ramp_down_ms > 0 {
            self.ramp = None;
            self.start_ramp(0, None, true);
        } else {
            // A ramp up that is still under way is not canceled: it restarts the motor (3.5).
            if let Some(ramp) = &mut self.ramp {
                ramp.then_stop = true;
            }
            self.stop_now();
        }
    }

    /// The class's 50 ms look at the flags, which wakes those who poll `state`.
    pub(crate) fn notify(&mut self) {
        let flags = self.flags();
        if flags != self.seen_flags {
            self.seen_flags = flags;
            self.events = self.events.wrapping_add(1);
        }
    }
}
