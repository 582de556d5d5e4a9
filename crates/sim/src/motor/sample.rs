//! The driver's own work: every 2 ms, and at its timers.
use super::{Drive, NOTIFY_JIFFIES, STALL_TICKS, Tacho};
use crate::ticks::JIFFY_TICKS;
use crate::wheel::{Timer, jiffy};

/// What a timer does in a jiffy.
type Work = fn(&mut Tacho, u64);

impl Tacho {
    /// One turn of the driver's loop: position, speed, stall test, PID, target test; then, every
    /// 10 ms, the timers.
    pub(crate) fn sample(&mut self, now: u64, count: i32, speed: i32) {
        self.now = now;
        self.count = count;
        self.speed = speed;
        let still = self.running() && speed == 0;
        self.zero_speed_ticks = if still { self.zero_speed_ticks.saturating_add(1) } else { 0 };
        self.stalled = self.zero_speed_ticks > STALL_TICKS;
        self.regulate();
        if self.drive == Drive::Position {
            self.approach_target();
        }
        if now % JIFFY_TICKS == 0 {
            self.run_timers();
        }
    }

    /// Writes to the bridge only what differs from the duty that the driver last wrote.
    fn regulate(&mut self) {
        let duty = match self.drive {
            Drive::Speed | Drive::Position if self.speed_pid.setpoint == 0 => {
                self.speed_pid.clear();
                0
            }
            Drive::Speed | Drive::Position => self.speed_pid.update(self.speed),
            Drive::Hold => self.hold_pid.update(self.position()),
            Drive::Stopped | Drive::Direct => return,
        };
        if duty != self.duty {
            self.drive_bridge(duty);
        }
    }

    /// Foresees where the motor would be after a ramp down, slows it if that is behind the target,
    /// and ends the move at or behind it. The direction is that of the present setpoint; without
    /// one the move ends only exactly at the target. All in 32 bits, as in the kernel.
    fn approach_target(&mut self) {
        let (position, target) = (self.position(), self.target);
        let time = self.speed.wrapping_abs().wrapping_mul(self.active.ramp_down_ms)
            / (1 + self.kind.max_speed);
        let end = position.wrapping_add(self.speed.wrapping_mul(time) / 2000);
        let slower = target.wrapping_sub(position).wrapping_mul(2000) / (1 + time);
        let (is_beyond, is_reached) = match self.speed_pid.setpoint.signum() {
            1 => (end > target, position >= target),
            -1 => (end < target, position <= target),
            _ => (false, position == target),
        };
        if is_beyond {
            self.speed_pid.setpoint = slower;
            self.braking = true;
        }
        if is_reached {
            self.arrive();
        }
    }

    fn run_timers(&mut self) {
        let now = jiffy(self.now);
        let mut timers: [(Option<Timer>, Work); 3] = [
            (self.stop_timer, Self::run_stop_timer),
            (self.ramp_timer, Self::run_ramp_timer),
            (Some(self.notify_timer), Self::run_notify_timer),
        ];
        timers.sort_by_key(|(timer, _)| timer.map(Timer::turn));
        for (timer, run) in timers {
            if timer.is_some_and(|timer| timer.is_due(now)) {
                run(self, now);
            }
        }
    }

    fn run_stop_timer(&mut self, now: u64) {
        if self.stop_timer.take_if(|timer| timer.is_due(now)).is_some() {
            self.time_is_up();
        }
    }

    fn run_ramp_timer(&mut self, now: u64) {
        if self.ramp_timer.take_if(|timer| timer.is_due(now)).is_some() {
            self.ramp_step();
        }
    }

    /// The class's look at the flags, which wakes those who poll `state`.
    fn run_notify_timer(&mut self, now: u64) {
        self.notify_timer = Timer::new(now, NOTIFY_JIFFIES);
        let flags = self.flags();
        if flags != self.seen_flags {
            self.seen_flags = flags;
            self.events = self.events.wrapping_add(1);
        }
    }
}
