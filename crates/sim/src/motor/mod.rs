//! Tacho motors: what the driver does with a wheel, from the word in `command` to the duty on the
//! wires, every 2 ms.
//!
//! Inside, positions and speeds have their physical sign; `polarity` flips the sign only at the
//! files ([`attrs`]). Everything a program sets is first kept in `set` and copied, whole, into
//! `active` when a command is written (section 2 of the reference sheet).

mod attrs;
mod encoder;
mod kind;
mod pid;
mod ramp;

pub(crate) use encoder::Encoder;
pub(crate) use kind::{Bridge, RATED_VOLTS};
pub use kind::{MOTOR_KINDS, MotorKind};
use pid::Pid;
use ramp::Ramp;

use crate::port::Port;
use crate::{JIFFY_TICKS, ticks_from_ms};

/// A blocked motor shows `stalled` after more than 100 ms at speed 0.
const STALL_TICKS: u32 = 50;

/// The words of `command`, in the order of `commands`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Command {
    RunForever,
    RunToAbsPos,
    RunToRelPos,
    RunTimed,
    RunDirect,
    Stop,
    Reset,
}

impl Command {
    pub(crate) const WORDS: [(&'static str, Command); 7] = [
        ("run-forever", Command::RunForever),
        ("run-to-abs-pos", Command::RunToAbsPos),
        ("run-to-rel-pos", Command::RunToRelPos),
        ("run-timed", Command::RunTimed),
        ("run-direct", Command::RunDirect),
        ("stop", Command::Stop),
        ("reset", Command::Reset),
    ];
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StopAction {
    Coast,
    Brake,
    Hold,
}

impl StopAction {
    pub(crate) const WORDS: [(&'static str, StopAction); 3] = [
        ("coast", StopAction::Coast),
        ("brake", StopAction::Brake),
        ("hold", StopAction::Hold),
    ];
}

/// What a program sets before it writes a command.
#[derive(Clone, Copy, Debug)]
struct Setpoints {
    speed: i32,
    position: i32,
    time_ms: i32,
    duty: i32,
    ramp_up_ms: i32,
    ramp_down_ms: i32,
    stop_action: StopAction,
}

impl Setpoints {
    const DEFAULT: Setpoints = Setpoints {
        speed: 0,
        position: 0,
        time_ms: 0,
        duty: 0,
        ramp_up_ms: 0,
        ramp_down_ms: 0,
        stop_action: StopAction::Coast,
    };

    fn ramps(&self) -> bool {
        self.ramp_up_ms > 0 || self.ramp_down_ms > 0
    }
}

/// Where a position move ends: the test is one-sided, in the direction chosen at its start.
#[derive(Clone, Copy, Debug)]
struct Goal {
    at: i32,
    upwards: bool,
}

impl Goal {
    fn reached(self, position: i32) -> bool {
        if self.upwards {
            position >= self.at
        } else {
            position <= self.at
        }
    }

    fn passed_by(self, end: i64) -> bool {
        if self.upwards {
            end > i64::from(self.at)
        } else {
            end < i64::from(self.at)
        }
    }
}

/// What the driver does with the bridge.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Drive {
    Coast,
    Brake,
    /// Hold PID around a position.
    Hold(i32),
    /// A fixed duty, no regulation.
    Direct(i32),
    /// Speed PID around a speed.
    Speed(i32),
}

/// A motor as the driver sees it.
#[derive(Clone, Debug)]
#[expect(
    clippy::struct_excessive_bools,
    reason = "each is a flag of its own in the kernel, too"
)]
pub(crate) struct Tacho {
    pub(crate) kind: &'static MotorKind,
    port: Port,
    set: Setpoints,
    active: Setpoints,
    inversed: bool,
    speed_pid: Pid,
    hold_pid: Pid,
    drive: Drive,
    goal: Option<Goal>,
    last_command: Option<Command>,
    relative_target: i32,
    timer: Option<u64>,
    ramp: Option<Ramp>,
    /// Sticky: only the end of a ramp clears it (3.5).
    ramping: bool,
    ramp_value: i32,
    /// Sticky, too: the driver's own slowing down before a target.
    braking: bool,
    overloaded: bool,
    zero_speed_ticks: u32,
    duty: i32,
    count: i32,
    zero: i32,
    speed: i32,
    now: u64,
    seen_flags: u8,
    pub(crate) events: u32,
}

impl Tacho {
    /// A motor just registered. The counter of its port is not zeroed by that.
    /// At boot it reads 0; a motor that was plugged in later shows what had accumulated.
    pub(crate) fn new(
        kind: &'static MotorKind,
        port: Port,
        count: i32,
        at_boot: bool,
        now: u64,
    ) -> Self {
        Tacho {
            kind,
            port,
            set: Setpoints::DEFAULT,
            active: Setpoints::DEFAULT,
            inversed: false,
            speed_pid: Pid::new(1000, 60, 0),
            hold_pid: Pid::new(kind.hold_kp, 0, 0),
            drive: Drive::Coast,
            goal: None,
            last_command: None,
            relative_target: 0,
            timer: None,
            ramp: None,
            ramping: false,
            ramp_value: 0,
            braking: false,
            overloaded: false,
            zero_speed_ticks: 0,
            duty: 0,
            count,
            zero: if at_boot { count } else { 0 },
            speed: 0,
            now,
            seen_flags: 0,
            events: 0,
        }
    }

    /// What the wires of the motor get.
    pub(crate) fn bridge(&self) -> Bridge {
        match self.drive {
            Drive::Coast => Bridge::Float,
            Drive::Brake => Bridge::Short,
            Drive::Hold(_) | Drive::Direct(_) | Drive::Speed(_) => Bridge::Driven(self.duty),
        }
    }

    fn position(&self) -> i32 {
        self.count.wrapping_sub(self.zero)
    }

    fn running(&self) -> bool {
        matches!(self.drive, Drive::Direct(_) | Drive::Speed(_))
    }

    /// The tick of the next timer or ramp step.
    pub(crate) fn next_timer(&self) -> Option<u64> {
        let ramp = self.ramp.as_ref().map(|ramp| ramp.due);
        self.timer
            .into_iter()
            .chain(ramp)
            .min()
            .map(|due| due.next_multiple_of(JIFFY_TICKS))
    }

    /// The flags of `state`, in their order, as bits.
    fn flags(&self) -> u8 {
        let stalled = self.running() && self.zero_speed_ticks > STALL_TICKS;
        [
            self.running(),
            self.ramping || self.braking,
            matches!(self.drive, Drive::Hold(_)),
            self.overloaded,
            stalled,
        ]
        .into_iter()
        .enumerate()
        .map(|(bit, set)| u8::from(set) << bit)
        .sum()
    }

    /// The text of `state`, without its newline.
    pub(crate) fn state(&self) -> String {
        let words = ["running", "ramping", "holding", "overloaded", "stalled"];
        let flags = self.flags();
        let set = words
            .iter()
            .enumerate()
            .filter(|(bit, _)| flags & (1 << bit) != 0);
        set.map(|(_, word)| *word).collect::<Vec<_>>().join(" ")
    }

    // ---- commands -------------------------------------------------------------------------

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

    fn run_direct(&mut self, duty: i32) {
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
        let goal = Goal {
            at: target,
            upwards,
        };
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
    fn regulate(&mut self, speed: i32, goal: Option<Goal>) {
        if !self.running() {
            self.overloaded = false;
        }
        self.goal = goal;
        self.drive = Drive::Speed(speed);
    }

    /// Carries out the stop action where the motor is.
    fn stop_now(&mut self) {
        self.end(self.position());
    }

    fn end(&mut self, hold_at: i32) {
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
    fn redefine_position(&mut self, position: i32) {
        self.zero = self.count.wrapping_sub(position);
        if let Some(goal) = &mut self.goal {
            goal.at = position;
        }
    }

    // ---- every 2 ms -----------------------------------------------------------------------

    /// One turn of the driver's loop: position, speed, stall test, PID, target test; then, every
    /// 10 ms, the timers.
    pub(crate) fn sample(&mut self, now: u64, count: i32, speed: i32) {
        self.now = now;
        self.count = count;
        self.speed = speed;
        let still = self.running() && speed == 0;
        self.zero_speed_ticks = if still {
            self.zero_speed_ticks.saturating_add(1)
        } else {
            0
        };
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

    fn time_is_up(&mut self) {
        self.timer = None;
        if self.active.ramp_down_ms > 0 {
            self.ramp = None;
            self.start_ramp(0, None, true);
        } else {
            // A ramp up that is still under way is not cancelled: it restarts the motor (3.5).
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
