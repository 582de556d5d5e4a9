//! The thing in a socket, and the device that the kernel has registered for it.
//!
//! The two differ for a while after a plug was moved: the port samples its pins every 10 ms and
//! wants 350 ms of the same reading before it acts and 100 ms before it removes a device. A motor
//! port then looks at single pins for some samples more. An I2C sensor gets a second to boot; a
//! serial sensor introduces itself at 2400 baud, which takes about as long
//! (`docs/ev3dev-sysfs.md`, 1).
use crate::brick::output::Output;
use crate::brick::port::Port;
use crate::motor::MotorKind;
use crate::sensor::{INTRODUCTION_MS, Link, Mode, Reading, SUPPLY_MV, SensorKind};
use crate::ticks::ticks_from_ms;

/// From the plug to a new `status`.
const NOTICE_SENSOR_MS: i32 = 360;
const NOTICE_MOTOR_MS: i32 = 390;
/// From the status to the device.
const REGISTER_MOTOR_MS: i32 = 10;
const I2C_BOOT_MS: i32 = 1000;
const REMOVE_MS: i32 = 100;
/// A port whose detection starts again waits for its pins to settle first.
const SETTLE_MS: i32 = 20;
/// The device of an unknown voltage on pin 1.
const GENERIC: &str = "nxt-analog";
/// Its driver exists, but the kernel's table of names lacks it.
const UNLOADABLE: &str = "di-dflex";

/// The sensors of the EV3 that are a voltage: the millivolts that their resistor leaves on pin 1.
const RESISTORS: [(&str, i32); 14] = [
    ("ev3-analog-01", 206),
    ("lego-ev3-touch", 417),
    ("ev3-analog-03", 575),
    ("ev3-analog-04", 833),
    ("ev3-analog-05", 1063),
    ("ev3-analog-06", 1241),
    ("ev3-analog-07", 1403),
    ("ev3-analog-08", 1599),
    ("ev3-analog-09", 1795),
    ("ev3-analog-10", 2024),
    ("ev3-analog-11", 2204),
    ("ev3-analog-12", 2382),
    ("ev3-analog-13", 2619),
    ("ev3-analog-14", 2826),
];
/// The generic driver's mode in which pin 5, which switches lamps, is low.
const DARK: &str = "ANALOG-0";

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

    /// The name of its driver.
    pub(crate) fn driver(self) -> &'static str {
        match self {
            Plug::Motor(kind) => kind.driver_name,
            Plug::Sensor(kind) => kind.driver_name,
        }
    }

    /// How long the kernel takes to notice it.
    fn notice(self) -> u64 {
        ticks_from_ms(match self {
            Plug::Motor(_) => NOTICE_MOTOR_MS,
            Plug::Sensor(_) => NOTICE_SENSOR_MS,
        })
    }

    /// How long it then takes to register its device.
    fn register(self) -> u64 {
        ticks_from_ms(match self {
            Plug::Motor(_) => REGISTER_MOTOR_MS,
            Plug::Sensor(kind) => match kind.link {
                Link::Uart => INTRODUCTION_MS,
                Link::I2c(_) => I2C_BOOT_MS,
                Link::Analog | Link::NxtAnalog { .. } => 0,
            },
        })
    }

    /// What it makes of pin 1, in millivolts, while another driver than its own has the port in
    /// a mode; `raw` measures in a mode of its own.
    pub(crate) fn pin1(self, driver: &Mode, raw: impl Fn(&Mode) -> Reading) -> i32 {
        let Plug::Sensor(kind) = self else {
            return SUPPLY_MV;
        };
        match kind.link {
            Link::NxtAnalog { .. } => {
                // Of two modes the first one has the lamp on.
                let dark = kind.modes.last().filter(|_| driver.name == DARK);
                dark.or(kind.modes.first()).map_or(SUPPLY_MV, |mode| raw(mode)[0])
            }
            Link::Analog => {
                let own = RESISTORS.iter().find(|(name, _)| *name == kind.driver_name);
                own.map_or(SUPPLY_MV, |(_, millivolts)| *millivolts)
            }
            Link::Uart => 0,
            Link::I2c(_) => SUPPLY_MV,
        }
    }

    /// True if it is a sensor of this type.
    pub(crate) fn is_of(self, kind: &SensorKind) -> bool {
        matches!(self, Plug::Sensor(own) if std::ptr::eq(own, kind))
    }

    pub(crate) fn is_serial(self) -> bool {
        matches!(self, Plug::Sensor(SensorKind { link: Link::Uart, .. }))
    }

    /// True if it is a sensor that is a voltage on pin 6.
    pub(crate) fn is_analog(self) -> bool {
        matches!(self, Plug::Sensor(SensorKind { link: Link::Analog, .. }))
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
    /// Tick at which the kernel notices what is plugged in now.
    pub(crate) noticed: Option<u64>,
    /// Tick at which the device of that comes, or goes.
    pub(crate) due: Option<u64>,
    /// Serial number of the registered device.
    pub(crate) device: Option<u64>,
    /// Serial numbers of the servos behind it.
    pub(crate) servos: Vec<u64>,
    /// Serial number of the `lego-port` device.
    pub(crate) lego_port: u64,
    /// Name given through `set_device`.
    pub(crate) forced: Option<String>,
    /// Of an output port: its bridge, while no driver has it.
    pub(crate) output: Output,
}

impl Socket {
    /// A plug is put in or pulled out.
    pub(crate) fn change(&mut self, plug: Option<Plug>, now: u64) {
        self.plug = plug;
        if let Some(plug) = plug {
            self.await_plug(plug, now);
        } else {
            self.noticed = Some(now + ticks_from_ms(REMOVE_MS));
            self.due = self.noticed;
        }
    }

    /// Detection starts again, with nothing.
    pub(crate) fn look_again(&mut self, now: u64) {
        (self.noticed, self.due) = (None, None);
        if let Some(plug) = self.plug {
            self.await_plug(plug, now + ticks_from_ms(SETTLE_MS));
        }
    }

    fn await_plug(&mut self, plug: Plug, now: u64) {
        let noticed = now + plug.notice();
        self.noticed = Some(noticed);
        self.due = Some(noticed + plug.register());
    }

    /// A serial line was attached: the sensor on it introduces itself.
    pub(crate) fn await_introduction(&mut self, now: u64) {
        self.due = Some(now + ticks_from_ms(INTRODUCTION_MS));
    }

    /// The driver that the port would load in a mode.
    pub(crate) fn driver(&self, mode: &str) -> Option<Plug> {
        let named = |name: &str| Plug::named(name, self.port);
        if let Some(name) = &self.forced {
            // An input takes the names of sensors that are a voltage on pin 1.
            let fits = |plug: &Plug| self.port.is_output() || plug.is_nxt_analog();
            return named(name).filter(fits).filter(|_| name != UNLOADABLE);
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
