//! The thing in a socket, and the device that the kernel has registered for it.
//!
//! The two differ for a while after a plug was moved: the port samples its pins every 10 ms, wants
//! 350 ms of the same reading (after 20 ms of settling) before it adds a device and 100 ms before
//! it removes one; a serial sensor then introduces itself at 2400 baud, which takes about a second.

use crate::brick::port::Port;
use crate::motor::MotorKind;
use crate::sensor::{Link, SensorKind};
use crate::ticks_from_ms;

const ADD_MS: i32 = 370;
const REMOVE_MS: i32 = 120;
const INTRODUCTION_MS: i32 = 900;
const I2C_BOOT_MS: i32 = 1000;
/// The device of an unknown voltage on pin 1.
const GENERIC: &str = "nxt-analog";

/// A thing with a plug.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Plug {
    Motor(&'static MotorKind),
    Sensor(&'static SensorKind),
}

impl Plug {
    /// The thing with this driver name that fits this port.
    pub(crate) fn named(driver: &str, port: Port) -> Option<Plug> {
        if port.is_output() {
            MotorKind::named(driver).map(Plug::Motor)
        } else {
            SensorKind::named(driver).map(Plug::Sensor)
        }
    }

    /// How long the kernel takes to register it.
    fn delay(self) -> u64 {
        match self {
            Plug::Sensor(kind) if kind.link == Link::Uart => {
                ticks_from_ms(ADD_MS) + ticks_from_ms(INTRODUCTION_MS)
            }
            Plug::Sensor(SensorKind { link: Link::I2c(_), .. }) => {
                ticks_from_ms(ADD_MS) + ticks_from_ms(I2C_BOOT_MS)
            }
            _ => ticks_from_ms(ADD_MS),
        }
    }

    /// True if it is a sensor that is a voltage on pin 1.
    pub(crate) fn is_nxt_analog(self) -> bool {
        matches!(self, Plug::Sensor(SensorKind { link: Link::NxtAnalog { .. }, .. }))
    }

    /// True if the brick cannot distinguish it from others of that kind.
    fn is_unrecognized(self) -> bool {
        let Plug::Sensor(kind) = self else {
            return false;
        };
        kind.link == Link::NxtAnalog { recognized: false }
    }

    /// Its name in `status` of the port.
    pub(crate) fn detected(plug: Option<Plug>, port: Port) -> &'static str {
        match plug {
            None if port.is_output() => "no-motor",
            None => "no-sensor",
            Some(Plug::Motor(_)) => "tacho-motor",
            Some(Plug::Sensor(kind)) => match kind.link {
                Link::Uart => "ev3-uart",
                Link::Analog => "ev3-analog",
                Link::NxtAnalog { .. } => "nxt-analog",
                Link::I2c(_) => "nxt-i2c",
            },
        }
    }
}

/// A socket of the brick.
#[derive(Clone, Debug)]
pub(crate) struct Socket {
    pub(crate) port: Port,
    pub(crate) plug: Option<Plug>,
    /// Tick at which the kernel notices the change.
    pub(crate) due: Option<u64>,
    /// Serial number of the registered device.
    pub(crate) device: Option<u64>,
    /// Serial numbers of the servos behind it.
    pub(crate) servos: Vec<u64>,
    /// Serial number of the `lego-port` device.
    pub(crate) lego_port: u64,
    /// Name given through `set_device`.
    pub(crate) forced: Option<String>,
}

impl Socket {
    /// A plug is put in or pulled out.
    pub(crate) fn change(&mut self, plug: Option<Plug>, now: u64, instant: bool) {
        self.plug = plug;
        let delay = match plug {
            _ if instant => 0,
            Some(plug) => plug.delay(),
            None => ticks_from_ms(REMOVE_MS),
        };
        self.due = Some(now + delay);
    }

    /// The driver that the port would load in a mode.
    pub(crate) fn driver(&self, mode: &str) -> Option<Plug> {
        let named = |name: &str| Plug::named(name, self.port);
        if let Some(name) = &self.forced {
            // An input takes the names of sensors that are a voltage on pin 1.
            return named(name).filter(|plug| self.port.is_output() || plug.is_nxt_analog());
        }
        match (mode, self.plug) {
            // The brick only distinguishes medium motors from others.
            ("auto", Some(Plug::Motor(kind))) if kind.driver_name != "lego-ev3-m-motor" => {
                named("lego-ev3-l-motor")
            }
            ("auto", Some(plug)) if plug.is_unrecognized() => named(GENERIC),
            ("auto", plug) => plug,
            ("tacho-motor", _) => named("lego-ev3-l-motor"),
            ("ev3-uart", Some(Plug::Sensor(kind))) if kind.link == Link::Uart => {
                Some(Plug::Sensor(kind))
            }
            ("ev3-analog", _) => named("ev3-analog-01"),
            ("nxt-analog", _) => named(GENERIC),
            ("nxt-i2c", Some(Plug::Sensor(kind))) if matches!(kind.link, Link::I2c(_)) => {
                Some(Plug::Sensor(kind))
            }
            _ => None,
        }
    }
}
