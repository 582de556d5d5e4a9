//! RC servos behind a controller by mindsensors (`servo-motor`, driver `ms-8ch-servo`).
//!
//! The controller sends each servo a pulse again and again, whose length is the position; without
//! a pulse the servo floats. The driver keeps no position that it could show: it reads the pulse
//! back, so that a floating servo is at -150 %, and one with another polarity at the opposite of
//! what was written (`docs/ev3dev-sysfs.md`, 4.3).
use crate::brick::port::Port;
use crate::files::attr::{Attr, Effect, Table, text, uevent, write_uevent};
use crate::files::text::{lenient_int_in, lenient_unsigned, word};
use ev3_os::linux::Errno;

/// Of the controller, which is a sensor to the kernel, and of its servos.
pub(crate) const DRIVER: &str = "ms-8ch-servo";
/// The controller's address on the I2C bus.
const BUS_ADDRESS: u8 = 88;
const COMMANDS: [&str; 2] = ["run", "float"];
const POLARITIES: [&str; 2] = ["normal", "inversed"];
/// The controller counts speeds in parts of this many ms, with a byte.
const RATE_MS: u32 = 24_000;
const FASTEST_MS: u32 = 94;

/// One of the eight servos.
#[derive(Clone, Debug)]
pub(crate) struct Servo {
    address: String,
    running: bool,
    /// µs, at -100, 0 and 100 %.
    pulses: [i32; 3],
    position: i32,
    inversed: bool,
    /// The speed setting of the controller: 0 is the fastest.
    rate: u32,
    /// The pulse that the controller sends: µs, 0 for no pulse.
    pulse: i32,
}

impl Servo {
    /// The servos of a controller at a port.
    pub(crate) fn all(port: Port) -> impl Iterator<Item = Servo> {
        (1..=8).map(move |number| Servo {
            address: format!("{}:i2c{BUS_ADDRESS}:sv{number}", port.address()),
            running: false,
            pulses: [500, 1500, 2500],
            position: 0,
            inversed: false,
            rate: 0,
            pulse: 0,
        })
    }

    /// Sends the position to the controller.
    fn send(&mut self) {
        let position = if self.inversed { -self.position } else { self.position };
        let [min, mid, max] = self.pulses;
        self.pulse = if position > 0 {
            scaled(position, [0, 100], [mid, max])
        } else {
            scaled(position, [-100, 0], [min, mid])
        };
    }

    fn command(&mut self, running: bool) {
        if running != self.running {
            self.running = running;
            if running {
                self.send();
            } else {
                self.pulse = 0;
            }
        }
    }

    /// The pulse as a position.
    fn read_back(&self) -> i32 {
        let [min, mid, max] = self.pulses;
        if self.pulse < mid {
            scaled(self.pulse, [min, mid], [-100, 0])
        } else {
            scaled(self.pulse, [mid, max], [0, 100])
        }
    }

    fn set_pulse(&mut self, index: usize, bytes: &[u8]) -> Result<Effect, Errno> {
        let low = [0, 1000, 2000][index];
        self.pulses[index] = lenient_int_in(bytes, low, low + 1000)?;
        Ok(Effect::Done)
    }
}

/// A value of one range in another one, upwards from the lower end of both, as the driver has
/// it: what a division leaves over is lost on the side of that end. Where a range is empty the
/// processor's division gives 0.
fn scaled(value: i32, [from, to]: [i32; 2], [low, high]: [i32; 2]) -> i32 {
    ((value - from) * (high - low)).checked_div(to - from).unwrap_or(0) + low
}

impl Table for Servo {
    const ATTRS: &'static [Attr<Servo>] = &[
        Attr::ro("address", |s| text(&s.address)),
        Attr::wo("command", |s, bytes| {
            s.command(word(bytes, COMMANDS.into_iter())? == 0);
            Ok(Effect::Done)
        }),
        Attr::ro("driver_name", |_| text(DRIVER)),
        Attr::rw("max_pulse_sp", |s| text(s.pulses[2]), |s, bytes| s.set_pulse(2, bytes)),
        Attr::rw("mid_pulse_sp", |s| text(s.pulses[1]), |s, bytes| s.set_pulse(1, bytes)),
        Attr::rw("min_pulse_sp", |s| text(s.pulses[0]), |s, bytes| s.set_pulse(0, bytes)),
        Attr::rw(
            "polarity",
            |s| text(POLARITIES[usize::from(s.inversed)]),
            |s, bytes| {
                let inversed = word(bytes, POLARITIES.into_iter())? == 1;
                if s.inversed != inversed {
                    s.inversed = inversed;
                    if s.running {
                        s.send();
                    }
                }
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "position_sp",
            |s| text(s.read_back()),
            |s, bytes| {
                s.position = lenient_int_in(bytes, -100, 100)?;
                if s.running {
                    s.send();
                }
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "rate_sp",
            |s| text(RATE_MS.checked_div(s.rate).unwrap_or(0)),
            |s, bytes| {
                let ms = lenient_unsigned(bytes)?;
                s.rate = if ms < FASTEST_MS { 0 } else { (RATE_MS / ms).max(1) };
                Ok(Effect::Done)
            },
        ),
        Attr::ro("state", |s| text(if s.running { "running" } else { "" })),
        Attr::rw("uevent", |s| uevent(DRIVER, &s.address), |_, bytes| write_uevent(bytes)),
    ];
}
