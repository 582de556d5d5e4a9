//! The eight sockets of the brick, and the `lego-port` class that speaks for them.
use crate::files::attr::{Attr, Effect, Table, text, write_uevent};
use crate::files::text::{name, word};
use ev3_os::linux::Errno;
use std::fmt;
use std::str::FromStr;

/// A socket: four inputs, four outputs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Port {
    /// Sensor socket 1.
    In1,
    /// Sensor socket 2.
    In2,
    /// Sensor socket 3.
    In3,
    /// Sensor socket 4.
    In4,
    /// Motor socket A.
    OutA,
    /// Motor socket B.
    OutB,
    /// Motor socket C.
    OutC,
    /// Motor socket D.
    OutD,
}

const ADDRESSES: [&str; 8] = [
    "ev3-ports:in1",
    "ev3-ports:in2",
    "ev3-ports:in3",
    "ev3-ports:in4",
    "ev3-ports:outA",
    "ev3-ports:outB",
    "ev3-ports:outC",
    "ev3-ports:outD",
];
const PREFIX: usize = "ev3-ports:".len();

impl Port {
    /// All of them, in the order of `port0` … `port7`.
    pub const ALL: [Port; 8] = [
        Port::In1,
        Port::In2,
        Port::In3,
        Port::In4,
        Port::OutA,
        Port::OutB,
        Port::OutC,
        Port::OutD,
    ];

    /// The address as the files spell it since ev3dev-stretch, such as `ev3-ports:outA`.
    pub const fn address(self) -> &'static str {
        ADDRESSES[self as usize]
    }

    /// The short form, such as `outA`.
    pub fn name(self) -> &'static str {
        &self.address()[PREFIX..]
    }

    /// True for outA … outD.
    pub const fn is_output(self) -> bool {
        self as usize >= 4
    }

    /// 0…3 among the inputs or among the outputs.
    pub(crate) const fn slot(self) -> usize {
        self as usize % 4
    }
}

impl fmt::Display for Port {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// No socket of the brick is called this.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such port: {0} (in1 to in4, outA to outD)")]
pub struct UnknownPort(pub String);

impl FromStr for Port {
    type Err = UnknownPort;

    /// Takes both `outA` and `ev3-ports:outA`.
    fn from_str(text: &str) -> Result<Port, UnknownPort> {
        let found = Port::ALL.into_iter().find(|p| p.name() == text || p.address() == text);
        found.ok_or_else(|| UnknownPort(text.to_owned()))
    }
}

/// The modes of an input port. `auto` is the default.
const IN_MODES: [&str; 9] = [
    "auto",
    "nxt-analog",
    "nxt-color",
    "nxt-i2c",
    "other-i2c",
    "ev3-analog",
    "ev3-uart",
    "other-uart",
    "raw",
];
/// The modes of an output port.
const OUT_MODES: [&str; 5] = ["auto", "tacho-motor", "dc-motor", "led", "raw"];

/// A `lego-port` device.
#[derive(Clone, Debug)]
pub(crate) struct LegoPort {
    pub(crate) port: Port,
    pub(crate) mode: usize,
    /// The result of detection, as `status` shows it while the mode is `auto`.
    pub(crate) detected: &'static str,
}

impl LegoPort {
    pub(crate) fn new(port: Port) -> Self {
        let mut port = LegoPort { port, mode: 0, detected: "" };
        port.forget();
        port
    }

    /// Nothing is detected.
    pub(crate) fn forget(&mut self) {
        self.detected = if self.port.is_output() { "no-motor" } else { "no-sensor" };
    }

    fn modes(&self) -> &'static [&'static str] {
        if self.port.is_output() { &OUT_MODES } else { &IN_MODES }
    }

    pub(crate) fn mode_name(&self) -> &'static str {
        self.modes()[self.mode]
    }

    fn driver_name(&self) -> &'static str {
        if self.port.is_output() { "ev3-output-port" } else { "ev3-input-port" }
    }

    /// What was detected, or what a mode makes of the port. The modes that switch detection off
    /// for another program leave an input without a sensor.
    fn status(&self) -> &'static str {
        match self.mode_name() {
            "auto" => self.detected,
            "other-i2c" | "other-uart" => "no-sensor",
            "raw" if !self.port.is_output() => "no-sensor",
            mode => mode,
        }
    }

    /// True if a program can set the device of the port: it knows the kind, but not the type.
    fn takes_device(&self) -> bool {
        matches!(self.status(), "tacho-motor" | "nxt-analog")
    }
}

impl Table for LegoPort {
    const ATTRS: &'static [Attr<LegoPort>] = &[
        Attr::ro("address", |p| text(p.port.address())),
        Attr::ro("driver_name", |p| text(p.driver_name())),
        Attr::rw(
            "mode",
            |p| text(p.mode_name()),
            |p, bytes| word(bytes, p.modes().iter().copied()).map(Effect::PortMode),
        ),
        Attr::ro("modes", |p| text(p.modes().join(" "))),
        Attr::wo("set_device", |p, bytes| {
            if !p.takes_device() {
                return Err(Errno::EOPNOTSUPP);
            }
            Ok(Effect::PortDevice(name(bytes)))
        }),
        Attr::ro("status", |p| text(p.status())),
        Attr::rw(
            "uevent",
            |p| {
                text(format_args!(
                    "DEVTYPE={0}\nLEGO_DRIVER_NAME={0}\nLEGO_ADDRESS={1}",
                    p.driver_name(),
                    p.port.address()
                ))
            },
            |_, bytes| write_uevent(bytes),
        ),
    ];
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_spellings_name_the_port() {
        assert_eq!("outB".parse(), Ok(Port::OutB));
        assert_eq!("ev3-ports:in4".parse(), Ok(Port::In4));
        assert!("ev3-ports:outE".parse::<Port>().is_err());
        assert_eq!(Port::OutD.name(), "outD");
        assert_eq!(Port::OutD.slot(), 3);
    }
}
