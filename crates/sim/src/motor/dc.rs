//! A plain motor without a counter (`dc-motor`, driver `rcx-motor`): it gets a duty, and its
//! speed is not measured. It appears when `dc-motor` is written to an output port's mode.
//!
//! Every change of the duty goes through a ramp with steps of 100 ms, even one without length.
//! While a step is scheduled, a command or a new duty waits for it: up to 100 ms
//! (`docs/ev3dev-sysfs.md`, 4.1).

use crate::brick::port::Port;
use crate::files::attr::{Attr, Effect, Table, text, uevent, write_uevent};
use crate::files::text::{lenient_unsigned, strict_int_in, word};
use crate::motor::Bridge;
use crate::{Errno, JIFFY_TICKS, ticks_from_ms};

const DRIVER: &str = "rcx-motor";
const COMMANDS: [&str; 4] = ["run-forever", "run-timed", "run-direct", "stop"];
const TIMED: usize = 1;
const DIRECT: usize = 2;
const STOP: usize = 3;
const STOP_ACTIONS: [&str; 2] = ["coast", "brake"];
const POLARITIES: [&str; 2] = ["normal", "inversed"];
const LONGEST_RAMP_MS: u32 = 10_000;
const LONGEST_TIME_MS: i32 = 60_000;
const STEP_MS: i32 = 100;

#[derive(Clone, Copy, Debug, Default)]
struct Setpoints {
    duty: i32,
    time_ms: i32,
    ramp_up_ms: u32,
    ramp_down_ms: u32,
    brake: bool,
    inversed: bool,
}

impl Setpoints {
    fn signed_duty(&self) -> i32 {
        if self.inversed { -self.duty } else { self.duty }
    }
}

/// A motor as the driver sees it.
#[derive(Clone, Debug)]
pub(crate) struct DcMotor {
    port: Port,
    set: Setpoints,
    active: Setpoints,
    command: usize,
    bridge: Bridge,
    duty: i32,
    target: i32,
    stopping: bool,
    next_step: Option<u64>,
    timer: Option<u64>,
    now: u64,
}

impl DcMotor {
    pub(crate) fn new(port: Port, now: u64) -> Self {
        DcMotor {
            port,
            set: Setpoints::default(),
            active: Setpoints::default(),
            command: STOP,
            bridge: Bridge::Float,
            duty: 0,
            target: 0,
            stopping: true,
            next_step: None,
            timer: None,
            now,
        }
    }

    pub(crate) fn bridge(&self) -> Bridge {
        self.bridge
    }

    /// The tick of the next timer or ramp step.
    pub(crate) fn next_timer(&self) -> Option<u64> {
        let due = self.timer.into_iter().chain(self.next_step).min();
        due.map(|due| due.next_multiple_of(JIFFY_TICKS))
    }

    fn start(&mut self, command: usize) {
        self.command = command;
        self.active = self.set;
        self.timer = None;
        if command == TIMED {
            self.timer = Some(self.now + ticks_from_ms(self.active.time_ms));
        }
        self.stopping = command == STOP;
        self.aim(if self.stopping { 0 } else { self.active.signed_duty() });
    }

    fn aim(&mut self, target: i32) {
        self.target = target;
        if self.next_step.is_none() {
            self.step();
        }
    }

    /// One step of the ramp. Rising, in the signed duty, follows the ramp up, falling the other.
    fn step(&mut self) {
        let rising = self.target > self.duty;
        let full_ms = if rising { self.active.ramp_up_ms } else { self.active.ramp_down_ms };
        let most = 100 * STEP_MS.unsigned_abs() / full_ms.max(1);
        let way = (self.target - self.duty).unsigned_abs();
        let arrived = full_ms == 0 || way <= most;
        let scheduled = self.next_step.is_some();
        let unchanged = way == 0;
        let part = i32::try_from(most.min(way)).unwrap_or(0);
        self.duty = match (arrived, rising) {
            (true, _) => self.target,
            (false, true) => self.duty + part,
            (false, false) => self.duty - part,
        };
        self.bridge = Bridge::Driven(self.duty);
        self.next_step = Some(self.now + ticks_from_ms(STEP_MS));
        if arrived && self.stopping {
            self.bridge = if self.active.brake { Bridge::Short } else { Bridge::Float };
            self.next_step = None;
        } else if scheduled && unchanged {
            self.next_step = None;
        }
    }

    /// Every 2 ms; its timers live on the 10 ms grid.
    pub(crate) fn sample(&mut self, now: u64) {
        self.now = now;
        if now % JIFFY_TICKS != 0 {
            return;
        }
        if self.next_step.is_some_and(|due| due <= now) {
            self.step();
        }
        if self.timer.is_some_and(|due| due <= now) {
            self.timer = None;
            self.stopping = true;
            self.aim(0);
        }
    }

    fn state(&self) -> String {
        let running = matches!(self.bridge, Bridge::Driven(_)).then_some("running");
        let ramping = self.next_step.is_some().then_some("ramping");
        running.into_iter().chain(ramping).collect::<Vec<_>>().join(" ")
    }
}

fn ramp(bytes: &[u8]) -> Result<u32, Errno> {
    lenient_unsigned(bytes)
        .and_then(|ms| if ms <= LONGEST_RAMP_MS { Ok(ms) } else { Err(Errno::EINVAL) })
}

impl Table for DcMotor {
    const ATTRS: &'static [Attr<DcMotor>] = &[
        Attr::ro("address", |m| text(m.port.address())),
        Attr::wo("command", |m, bytes| {
            m.start(word(bytes, COMMANDS.into_iter())?);
            Ok(Effect::Done)
        }),
        Attr::ro("commands", |_| text(COMMANDS.join(" "))),
        Attr::ro("driver_name", |_| text(DRIVER)),
        Attr::ro("duty_cycle", |m| text(m.duty)),
        Attr::rw(
            "duty_cycle_sp",
            |m| text(m.set.duty),
            |m, bytes| {
                m.set.duty = strict_int_in(bytes, -100, 100)?;
                if m.command == DIRECT {
                    m.active.duty = m.set.duty;
                    m.aim(m.active.signed_duty());
                }
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "polarity",
            |m| text(POLARITIES[usize::from(m.set.inversed)]),
            |m, bytes| {
                m.set.inversed = word(bytes, POLARITIES.into_iter())? == 1;
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "ramp_down_sp",
            |m| text(m.set.ramp_down_ms),
            |m, bytes| {
                m.set.ramp_down_ms = ramp(bytes)?;
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "ramp_up_sp",
            |m| text(m.set.ramp_up_ms),
            |m, bytes| {
                m.set.ramp_up_ms = ramp(bytes)?;
                Ok(Effect::Done)
            },
        ),
        Attr::ro("state", |m| text(m.state())),
        // It cannot be read, unlike that of a tacho motor.
        Attr::wo("stop_action", |m, bytes| {
            m.set.brake = word(bytes, STOP_ACTIONS.into_iter())? == 1;
            Ok(Effect::Done)
        }),
        Attr::ro("stop_actions", |_| text(STOP_ACTIONS.join(" "))),
        Attr::rw(
            "time_sp",
            |m| text(m.set.time_ms),
            |m, bytes| {
                m.set.time_ms = strict_int_in(bytes, 0, LONGEST_TIME_MS)?;
                Ok(Effect::Done)
            },
        ),
        Attr::rw("uevent", |m| uevent(DRIVER, m.port.address()), |_, bytes| write_uevent(bytes)),
    ];
}
