//! The immediate effect of each command: `docs/ev3dev-sysfs.md`, 3.3. First the class, which knows
//! commands, times and ramps; then the driver below it, which knows the wheel and the bridge.
use super::{Command, Drive, Pid, Setpoints, StopAction, Tacho};
use crate::brick::output::Pins;
use crate::wheel::{Timer, jiffies_from_ms, jiffy};

// ---- the class ----------------------------------------------------------------------------

impl Tacho {
    /// Takes a command over, at once: the next read of `state` shows it.
    pub(crate) fn command(&mut self, command: Command) {
        self.stop_timer = None;
        self.ramp_timer = None;
        if command == Command::Reset {
            self.set = Setpoints::DEFAULT;
            self.inversed = false;
        }
        let previous = self.written.replace(command);
        let mut next = self.set;
        let mut act = command;
        if command == Command::RunToRelPos {
            if next.position == 0 {
                act = Command::Stop;
            }
            // A chain of relative moves counts from target to target, whether reached or not.
            let base = match previous {
                Some(Command::RunToRelPos) => self.active.position,
                _ => self.position(),
            };
            next.position = base.wrapping_add(next.position);
        }
        if matches!(act, Command::Stop | Command::Reset) {
            (next.duty, next.speed) = (0, 0);
        }
        self.active = next;
        self.command = command;
        self.carry_out(act);
    }

    fn carry_out(&mut self, command: Command) {
        let ramps = self.active.ramp_up_ms > 0 || self.active.ramp_down_ms > 0;
        match command {
            Command::RunDirect => self.run_direct(self.active.duty),
            Command::Reset => self.reset(),
            _ if ramps => self.start_ramp(),
            Command::RunForever | Command::RunTimed => self.run_regulated(self.active.speed),
            Command::RunToAbsPos | Command::RunToRelPos => {
                self.run_to(self.active.position, self.active.speed);
            }
            Command::Stop => self.stop(),
        }
        if command == Command::RunTimed {
            if self.active.time_ms == 0 {
                self.time_is_up();
            } else {
                let length = jiffies_from_ms(self.active.time_ms);
                self.stop_timer = Some(Timer::new(jiffy(self.now), length));
            }
        }
    }

    /// The end of run-timed. A step of a ramp up that is still scheduled is not canceled: it
    /// starts the motor again.
    pub(super) fn time_is_up(&mut self) {
        self.command = Command::Stop;
        if self.active.ramp_down_ms > 0 {
            self.active.speed = 0;
            self.start_ramp();
        } else {
            self.stop();
        }
    }

    /// The driver reached the target of a position move. The flag of a ramp that this ends stays.
    fn target_is_reached(&mut self) {
        self.stop_timer = None;
        self.ramp_timer = None;
        self.active.speed = 0;
        self.ramp.last = 0;
    }
}

// ---- the driver ---------------------------------------------------------------------------

impl Tacho {
    pub(super) fn run_direct(&mut self, duty: i32) {
        self.drive = Drive::Direct;
        self.drive_bridge(duty);
    }

    /// Puts the speed regulator to work. Its memory is kept from a motion that it replaces.
    pub(super) fn run_regulated(&mut self, speed: i32) {
        self.drive = Drive::Speed;
        self.speed_pid.setpoint = speed;
    }

    /// The same towards a target. The sign of the speed does not count.
    pub(super) fn run_to(&mut self, target: i32, speed: i32) {
        let speed = speed.wrapping_abs();
        self.drive = Drive::Position;
        self.target = target;
        self.end_action = self.active.stop_action;
        self.speed_pid.setpoint =
            if self.position() > target { speed.wrapping_neg() } else { speed };
    }

    /// Carries out the stop action where the motor is.
    pub(super) fn stop(&mut self) {
        self.stop_as(self.active.stop_action, self.position());
    }

    /// Ends a position move, and holds at its target.
    pub(super) fn arrive(&mut self) {
        self.stop_as(self.end_action, self.target);
        self.braking = false;
        self.target_is_reached();
    }

    /// To coast and to brake changes the pins only, and to hold not even these: the bridge keeps
    /// its PWM until a regulator writes another duty than the 0 that the driver notes here.
    fn stop_as(&mut self, action: StopAction, hold_at: i32) {
        self.speed_pid.clear();
        self.hold_pid.clear();
        self.duty = 0;
        self.drive = Drive::Stopped;
        match action {
            StopAction::Coast => self.output.pins = Pins::Coast,
            StopAction::Brake => self.output.pins = Pins::Brake,
            StopAction::Hold => {
                self.hold_pid.setpoint = hold_at;
                self.drive = Drive::Hold;
            }
        }
    }

    pub(super) fn drive_bridge(&mut self, duty: i32) {
        self.duty = duty;
        self.output.drive(if duty > 0 { Pins::Forward } else { Pins::Reverse }, duty);
    }

    fn reset(&mut self) {
        self.stop_as(StopAction::Coast, 0);
        self.target = 0;
        self.zero = self.count;
        self.stalled = false;
        self.zero_speed_ticks = 0;
        self.speed_pid = Pid::new(1000, 60, 0);
        self.hold_pid = Pid::new(self.kind.hold_kp, 0, 0);
    }

    /// A write to `position`: the numbers change, and the driver's target with them, so that a
    /// position move ends at the next sample; the point that is held stays where it was in
    /// numbers, so that a holding motor is driven through the difference.
    pub(super) fn redefine_position(&mut self, position: i32) {
        self.zero = self.count.wrapping_sub(position);
        self.target = position;
    }
}
