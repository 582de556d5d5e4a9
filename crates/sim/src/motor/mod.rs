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

use crate::brick::output::{Output, Pins};
use crate::brick::port::Port;
use crate::wheel::{Timer, jiffy};
pub(crate) use encoder::Encoder;
pub(crate) use kind::{COUNT_PER_M, RATED_VOLTS};
pub use kind::{MOTOR_KINDS, MotorKind};
use pid::Pid;

/// A blocked motor shows `stalled` after more than 100 ms at speed 0: the first sample begins them.
const STALL_TICKS: u32 = 51;
/// The class looks at the flags of `state` every 50 ms, which the wheel makes 60 ms.
const NOTIFY_JIFFIES: u64 = 5;

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

    fn is_position_move(self) -> bool {
        matches!(self, Command::RunToAbsPos | Command::RunToRelPos)
    }
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
}

/// The way in which the driver uses the bridge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    /// Nothing, after coast or brake.
    Stopped,
    /// Hold PID around a position.
    Hold,
    /// A fixed duty, no regulation.
    Direct,
    /// Speed PID around a speed.
    Speed,
    /// The same, towards a target.
    Position,
}

/// The leg of a ramp that is under way, or the last one: `ramp.rs`.
#[derive(Clone, Debug, Default)]
struct Ramp {
    /// The speed that was set last.
    last: i32,
    end: i32,
    change: i32,
    duration: u32,
    /// Since when the leg is counted: half a period before it began.
    started: i64,
    stepped: i64,
}

/// What the files show of a motor that turns.
pub(crate) struct Shown {
    pub(crate) position: i32,
    pub(crate) speed: i32,
    pub(crate) duty: i32,
    pub(crate) stop_action: &'static str,
}

/// A motor as the class and its driver see it.
#[derive(Clone, Debug)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own in the kernel, too")]
pub(crate) struct Tacho {
    pub(crate) kind: &'static MotorKind,
    port: Port,
    set: Setpoints,
    active: Setpoints,
    inversed: bool,
    /// The word that was written to `command` last.
    written: Option<Command>,
    /// What is being done: that word, until the time of a timed run is up.
    command: Command,
    stop_timer: Option<Timer>,
    ramp: Ramp,
    ramp_timer: Option<Timer>,
    /// Sticky: only the end of a ramp clears it (3.5).
    ramping: bool,
    speed_pid: Pid,
    hold_pid: Pid,
    drive: Drive,
    /// Where a position move ends, and how.
    target: i32,
    end_action: StopAction,
    /// Sticky, too: the driver's own slowing down before a target.
    braking: bool,
    stalled: bool,
    zero_speed_ticks: u32,
    /// The duty that the driver last wrote to the bridge, or 0 since it stopped.
    duty: i32,
    pub(crate) output: Output,
    count: i32,
    zero: i32,
    speed: i32,
    now: u64,
    notify_timer: Timer,
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
        output: Output,
        now: u64,
    ) -> Self {
        Tacho {
            kind,
            port,
            set: Setpoints::DEFAULT,
            active: Setpoints::DEFAULT,
            inversed: false,
            written: None,
            command: Command::RunForever,
            stop_timer: None,
            ramp: Ramp::default(),
            ramp_timer: None,
            ramping: false,
            speed_pid: Pid::new(1000, 60, 0),
            hold_pid: Pid::new(kind.hold_kp, 0, 0),
            drive: Drive::Stopped,
            target: 0,
            end_action: StopAction::Coast,
            braking: false,
            stalled: false,
            zero_speed_ticks: 0,
            duty: 0,
            output: Output { pins: Pins::Coast, ..output },
            count,
            zero: if at_boot { count } else { 0 },
            speed: 0,
            now,
            notify_timer: Timer::new(jiffy(now), NOTIFY_JIFFIES),
            seen_flags: 0,
            events: 0,
        }
    }

    fn position(&self) -> i32 {
        self.count.wrapping_sub(self.zero)
    }

    /// Position, speed, duty and the stop action, as the files show them.
    pub(crate) fn shown(&self) -> Shown {
        let stop_action =
            StopAction::WORDS.iter().find(|(_, action)| *action == self.set.stop_action);
        Shown {
            position: self.sign(self.position()),
            speed: self.sign(self.speed),
            duty: self.sign(self.duty),
            stop_action: stop_action.map_or("", |(word, _)| word),
        }
    }

    fn running(&self) -> bool {
        matches!(self.drive, Drive::Direct | Drive::Speed | Drive::Position)
    }

    /// The tick of the next timer, ramp step or look at the flags.
    pub(crate) fn next_timer(&self) -> u64 {
        let timers = [self.stop_timer, self.ramp_timer].into_iter().flatten();
        timers.fold(self.notify_timer.tick(), |next, timer| next.min(timer.tick()))
    }

    /// The flags of `state`, in their order, as bits.
    fn flags(&self) -> u8 {
        let running = self.running();
        let overloaded = match self.drive {
            Drive::Speed | Drive::Position => self.speed_pid.overloaded,
            Drive::Hold => self.hold_pid.overloaded,
            Drive::Stopped | Drive::Direct => false,
        };
        [
            running,
            self.ramping || (running && self.braking),
            self.drive == Drive::Hold,
            overloaded,
            running && self.stalled,
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
