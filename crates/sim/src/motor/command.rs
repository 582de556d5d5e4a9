//! The immediate effect of each command: `docs/ev3dev-sysfs.md`, 3.3.

use super::{Command, Drive, Goal, Pid, Setpoints, StopAction, Tacho};
use crate::ticks_from_ms;

impl Tacho {
    /// Takes a command over, at once: the next read of `state` shows it.
    pub(crate) fn command(&mut self, command: Command) {
        let previous = self.last_command.replace(command);
        self.timer = None;
        self.ramp = None;
        self.active = self.set;
        match command {
            Command::RunForever => self.begin(self.active.speed, None, false),
            Command::RunTimed => self.run_timed(),
            Command::RunToAbsPos => self.run_to(self.active.position),
            Command::RunToRelPos => self.run_relative(previous),
            Command::RunDirect => self.run_direct(self.active.duty),
            Command::Stop => self.begin_stop(),
            Command::Reset => self.reset(),
        }
    }

    pub(super) fn run_direct(&mut self, duty: i32) {
        self.goal = None;
        self.overloaded = false;
        self.duty = duty;
        self.drive = Drive::Direct(duty);
    }

    fn run_timed(&mut self) {
        self.begin(self.active.speed, None, false);
        self.timer = Some(self.now + ticks_from_ms(self.active.time_ms));
        if self.active.time_ms == 0 {
            self.time_is_up();
        }
    }

    fn run_to(&mut self, target: i32) {
        let upwards = target >= self.position();
        let speed = self.active.speed.abs();
        let goal = Goal { at: target, upwards };
        self.begin(if upwards { speed } else { -speed }, Some(goal), false);
    }

    /// A chain of relative moves counts from target to target, whether reached or not.
    fn run_relative(&mut self, previous: Option<Command>) {
        let base = match previous {
            Some(Command::RunToRelPos) => self.relative_target,
            _ => self.position(),
        };
        self.relative_target = base.wrapping_add(self.active.position);
        if self.active.position != 0 {
            self.run_to(self.relative_target);
        } else if self.active.ramps() {
            self.begin(0, None, false);
        } else {
            self.stop_now();
        }
    }

    fn begin_stop(&mut self) {
        if self.active.ramps() {
            self.start_ramp(0, None, true);
        } else {
            self.stop_now();
        }
    }

    fn begin(&mut self, speed: i32, goal: Option<Goal>, then_stop: bool) {
        if self.active.ramps() {
            self.start_ramp(speed, goal, then_stop);
        } else {
            self.regulate(speed, goal);
        }
    }

    /// Puts the speed regulator to work. Its memory is kept from a motion that it replaces.
    pub(super) fn regulate(&mut self, speed: i32, goal: Option<Goal>) {
        if !self.running() {
            self.overloaded = false;
        }
        self.goal = goal;
        self.drive = Drive::Speed(speed);
    }

    /// Carries out the stop action where the motor is.
    pub(super) fn stop_now(&mut self) {
        self.end(self.position());
    }

    pub(super) fn end(&mut self, hold_at: i32) {
        self.speed_pid.clear();
        self.hold_pid.clear();
        self.goal = None;
        self.overloaded = false;
        self.zero_speed_ticks = 0;
        self.duty = 0;
        self.drive = match self.active.stop_action {
            StopAction::Coast => Drive::Coast,
            StopAction::Brake => Drive::Brake,
            StopAction::Hold => Drive::Hold(hold_at),
        };
    }

    fn reset(&mut self) {
        self.set = Setpoints::DEFAULT;
        self.active = Setpoints::DEFAULT;
        self.inversed = false;
        self.speed_pid = Pid::new(1000, 60, 0);
        self.hold_pid = Pid::new(self.kind.hold_kp, 0, 0);
        self.stop_now();
        self.zero = self.count;
    }

    /// A write to `position`: the numbers change, and the driver's target with them, so that a
    /// position move ends at the next sample; the point that is held stays where it was in
    /// numbers, so that a holding motor is driven through the difference.
    pub(super) fn redefine_position(&mut self, position: i32) {
        self.zero = self.count.wrapping_sub(position);
        if let Some(goal) = &mut self.goal {
            goal.at = position;
        }
    }
}
