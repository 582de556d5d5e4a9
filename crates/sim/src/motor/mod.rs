//! Tacho motors: what the driver does with a wheel, from the word in `command` to the duty on the
//! wires, every 2 ms.
//!
//! Inside, positions and speeds have their physical sign; `polarity` flips the sign only at the
//! files ([`attrs`]). Everything a program sets is first kept in `set` and copied, whole, into
//! `active` when a command is written (`docs/ev3dev-sysfs.md`, 2).

mod attrs;
mod command;
pub(crate) mod dc;
mod encoder;
mod kind;
mod pid;
mod ramp;
mod sample;
pub(crate) mod servo;

pub(crate) use encoder::Encoder;
pub(crate) use kind::{Bridge, RATED_VOLTS};
pub use kind::{MOTOR_KINDS, MotorKind};
use pid::Pid;
use ramp::Ramp;

use crate::JIFFY_TICKS;
use crate::brick::port::Port;

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
    pub(crate) const WORDS: [(&'static str, StopAction); 3] =
        [("coast", StopAction::Coast), ("brake", StopAction::Brake), ("hold", StopAction::Hold)];
}

/// The set-points of a program before it writes a command.
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

/// The target of a position move: the test is one-sided, in the direction chosen at its start.
#[derive(Clone, Copy, Debug)]
struct Goal {
    at: i32,
    upwards: bool,
}

impl Goal {
    fn reached(self, position: i32) -> bool {
        if self.upwards { position >= self.at } else { position <= self.at }
    }

    fn passed_by(self, end: i64) -> bool {
        if self.upwards { end > i64::from(self.at) } else { end < i64::from(self.at) }
    }
}

/// The way in which the driver uses the bridge.
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
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own in the kernel, too")]
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

    /// The state of the bridge at the wires of the motor.
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
        self.timer.into_iter().chain(ramp).min().map(|due| due.next_multiple_of(JIFFY_TICKS))
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
        let set = words.iter().enumerate().filter(|(bit, _)| flags & (1 << bit) != 0);
        set.map(|(_, word)| *word).collect::<Vec<_>>().join(" ")
    }
}
