//! A plain motor without a counter (`dc-motor`, driver `rcx-motor`): it gets a duty, and its
//! speed is not measured. It appears when `dc-motor` is written to an output port's mode.
//!
//! Every change of the duty goes through a ramp with steps of 110 ms, even one without length.
//! While a step is scheduled, a command or a new duty waits for it
//! (`docs/ev3dev-sysfs.md`, 4.1). The class has a duty of its own, 0 at first; what the files show
//! is that of the port, which outlives the motor.
use crate::brick::output::{Output, Pins};
use crate::brick::port::Port;
use crate::files::attr::{Attr, Effect, Table, text, uevent, write_uevent};
use crate::files::text::{lenient_unsigned, strict_int_in, strict_int_to, word};
use crate::ticks::JIFFY_TICKS;
use crate::wheel::{Timer, jiffies_from_ms, jiffy};
use ev3_os::linux::Errno;

const DRIVER: &str = "rcx-motor";
const COMMANDS: [&str; 4] = ["run-forever", "run-timed", "run-direct", "stop"];
const TIMED: usize = 1;
const DIRECT: usize = 2;
const STOP: usize = 3;
const STOP_ACTIONS: [&str; 2] = ["coast", "brake"];
const POLARITIES: [&str; 2] = ["normal", "inversed"];
const LONGEST_RAMP_MS: i32 = 10_000;
const LONGEST_TIME_MS: i32 = 60_000;
/// Jiffies from one step of a ramp to the next.
const PERIOD: u64 = 10;

#[derive(Clone, Copy, Debug, Default)]
struct Setpoints {
    duty: i32,
    time_ms: i32,
    ramp_up_ms: i32,
    ramp_down_ms: i32,
    brake: bool,
    inversed: bool,
}

/// A motor as the driver sees it.
#[derive(Clone, Debug)]
pub(crate) struct DcMotor {
    port: Port,
    set: Setpoints,
    /// Their duty has the physical sign, and is 0 for a stop.
    active: Setpoints,
    command: usize,
    /// What the last step set.
    duty: i32,
    change: i32,
    duration: u64,
    ends: u64,
    stepped: u64,
    step_timer: Option<Timer>,
    stop_timer: Option<Timer>,
    pub(crate) output: Output,
    now: u64,
}

impl DcMotor {
    pub(crate) fn new(port: Port, output: Output, now: u64) -> Self {
        DcMotor {
            port,
            set: Setpoints::default(),
            active: Setpoints::default(),
            command: STOP,
            duty: 0,
            change: 0,
            duration: 0,
            ends: 0,
            stepped: 0,
            step_timer: None,
            stop_timer: None,
            output,
            now,
        }
    }

    /// The tick of the next timer or ramp step.
    pub(crate) fn next_timer(&self) -> Option<u64> {
        self.stop_timer.into_iter().chain(self.step_timer).map(Timer::tick).min()
    }

    fn start(&mut self, command: usize) {
        self.active = self.set;
        self.command = command;
        self.aim(if command == STOP { 0 } else { self.set.duty });
        self.stop_timer = None;
        if command == TIMED {
            if self.active.time_ms == 0 {
                self.time_is_up();
            } else {
                let length = jiffies_from_ms(self.active.time_ms);
                self.stop_timer = Some(Timer::new(jiffy(self.now), length));
            }
        }
    }

    fn time_is_up(&mut self) {
        self.command = STOP;
        self.aim(0);
    }

    /// Heads for a duty. Rising, in the physical sign, follows the ramp up, falling the other.
    fn aim(&mut self, duty: i32) {
        self.active.duty = if self.active.inversed { duty.wrapping_neg() } else { duty };
        self.change = self.active.duty.wrapping_sub(self.duty);
        let is_up = self.change > 0;
        let full = if is_up { self.active.ramp_up_ms } else { self.active.ramp_down_ms };
        self.duration = jiffies_from_ms(full) * u64::from(self.change.unsigned_abs()) / 100;
        self.stepped = jiffy(self.now);
        self.ends = self.stepped + self.duration;
        if self.step_timer.is_none() {
            self.step();
        }
    }

    /// A step, and the next one if it is due at once.
    fn step(&mut self) {
        while self.step_once() {}
    }

    /// One step. A run with the duty that it has already does nothing at all. True if the next
    /// one is due at once.
    fn step_once(&mut self) -> bool {
        let runs = self.command != STOP;
        if runs && self.active.duty == self.duty {
            return false;
        }
        let now = jiffy(self.now);
        let left = self.ends.saturating_sub(now);
        self.duty = self.active.duty;
        if self.duration != 0 && left != 0 {
            let left = i128::from(self.change) * i128::from(left) / i128::from(self.duration);
            let duty = i128::from(self.duty) - left;
            self.duty = i32::try_from(duty.clamp(-100, 100)).unwrap_or(0);
        }
        let pins = match (runs || self.duty != 0, self.duty >= 0) {
            (true, true) => Pins::Forward,
            (true, false) => Pins::Reverse,
            (false, _) if self.active.brake => Pins::Brake,
            (false, _) => Pins::Coast,
        };
        self.output.drive(pins, self.duty);
        if !runs && !self.output.is_driving() {
            return false;
        }
        let passed = now - self.stepped;
        self.stepped = now;
        if passed < PERIOD {
            self.step_timer = Some(Timer::new(now, PERIOD - passed));
        }
        passed >= PERIOD
    }

    /// Every 2 ms; its timers live on the 10 ms grid.
    pub(crate) fn sample(&mut self, now: u64) {
        self.now = now;
        if now % JIFFY_TICKS != 0 {
            return;
        }
        let is_due = |timer: &mut Timer| timer.is_due(jiffy(now));
        match (self.step_timer.take_if(is_due), self.stop_timer.take_if(is_due)) {
            (Some(step), Some(end)) => {
                // The step that would follow at once is the first one of the stop.
                if step.turn() < end.turn() {
                    self.step_once();
                }
                self.time_is_up();
            }
            (Some(_), None) => self.step(),
            (None, Some(_)) => self.time_is_up(),
            (None, None) => {}
        }
    }

    /// The duty of the port, in the sign of the program.
    pub(crate) fn shown_duty(&self) -> i32 {
        if self.active.inversed { -self.output.duty() } else { self.output.duty() }
    }

    pub(crate) fn state(&self) -> String {
        let running = self.output.is_driving().then_some("running");
        let ramping = self.step_timer.is_some().then_some("ramping");
        running.into_iter().chain(ramping).collect::<Vec<_>>().join(" ")
    }
}

fn ramp(bytes: &[u8]) -> Result<i32, Errno> {
    let ms = i32::try_from(lenient_unsigned(bytes)?).ok();
    ms.filter(|ms| *ms <= LONGEST_RAMP_MS).ok_or(Errno::EINVAL)
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
        Attr::ro("duty_cycle", |m| text(m.shown_duty())),
        Attr::rw(
            "duty_cycle_sp",
            |m| text(m.set.duty),
            |m, bytes| {
                m.set.duty = strict_int_to(bytes, 100)?;
                if m.command == DIRECT {
                    m.aim(m.set.duty);
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
