//! The classes of devices, and which entries of their directories are devices.
use std::fmt;
use std::path::PathBuf;

/// The kinds of devices that are plugged into ports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Class {
    /// Motors with a rotation sensor, all that LEGO makes for EV3 and NXT.
    TachoMotor,
    /// Sensors.
    Sensor,
    /// RC servos on a controller.
    ServoMotor,
    /// Motors without rotation sensor.
    DcMotor,
    /// The ports themselves.
    Port,
    /// Lights: those of the brick, and those on ports.
    Led,
    /// The battery.
    Battery,
}

impl Class {
    /// All classes.
    pub const ALL: [Self; 7] = [
        Self::TachoMotor,
        Self::Sensor,
        Self::ServoMotor,
        Self::DcMotor,
        Self::Port,
        Self::Led,
        Self::Battery,
    ];

    /// The classes of motors.
    pub const MOTORS: [Self; 3] = [Self::TachoMotor, Self::DcMotor, Self::ServoMotor];

    /// The class's directory below the tree's root.
    pub fn directory(self) -> &'static str {
        match self {
            Self::TachoMotor => "tacho-motor",
            Self::Sensor => "lego-sensor",
            Self::ServoMotor => "servo-motor",
            Self::DcMotor => "dc-motor",
            Self::Port => "lego-port",
            Self::Led => "leds",
            Self::Battery => "power_supply",
        }
    }

    /// Whether an entry of the class's directory may be a device of ev3dev's:
    /// any computer has lights and batteries of its own.
    pub(crate) fn admits(self, name: &str) -> bool {
        match self {
            Self::Led => led_name(name).is_some(),
            Self::Battery => BATTERIES.contains(&name),
            _ => true,
        }
    }
}

impl fmt::Display for Class {
    /// The noun that error terms use.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::TachoMotor | Self::ServoMotor | Self::DcMotor => "motor",
            Self::Sensor => "sensor",
            Self::Port => "port",
            Self::Led => "led",
            Self::Battery => "battery",
        })
    }
}

/// A device found by a pattern, not necessarily of a known class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Detected {
    /// Its port, by the short name.
    pub port: String,
    /// Its type.
    pub driver: String,
    /// Its directory.
    pub path: PathBuf,
}

/// The names of the boards' batteries: the EV3 since ev3dev-stretch and on
/// jessie, then other boards (docs/ev3dev-sysfs.md, 8.5).
const BATTERIES: [&str; 6] = [
    "lego-ev3-battery",
    "legoev3-battery",
    "brickpi-battery",
    "brickpi3-battery",
    "pistorms-battery",
    "evb-battery",
];

/// The endings of LED names: since ev3dev-stretch, and on jessie (docs/ev3dev-sysfs.md, 8.1).
const LED_SUFFIXES: [&str; 2] = [":brick-status", ":ev3dev"];

/// An LED's own color.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Hue {
    Red,
    Green,
    Blue,
    Amber,
    /// The color of whatever is plugged into a port.
    Any,
}

impl Hue {
    const ALL: [(&'static str, Self); 5] = [
        ("red", Self::Red),
        ("green", Self::Green),
        ("blue", Self::Blue),
        ("amber", Self::Amber),
        ("", Self::Any),
    ];

    fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(word, _)| *word == name).map(|(_, hue)| hue)
    }
}

/// The parts of an LED's name: whose it is and its color. `None` for an LED that is not ev3dev's.
pub(crate) fn led_name(name: &str) -> Option<(&str, Hue)> {
    let rest = LED_SUFFIXES.iter().find_map(|suffix| name.strip_suffix(suffix))?;
    let (owner, hue) = rest.rsplit_once(':')?;
    (!owner.is_empty()).then_some((owner, Hue::named(hue)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_all_boards_have_an_owner_and_a_color() {
        for (name, expected) in [
            ("led0:red:brick-status", Some(("led0", Hue::Red))),
            ("ev3:left:green:ev3dev", Some(("ev3:left", Hue::Green))),
            ("brickpi:led1:blue:ev3dev", Some(("brickpi:led1", Hue::Blue))),
            ("led1:amber:brick-status", Some(("led1", Hue::Amber))),
            ("pistorms:BB:blue:brick-status", Some(("pistorms:BB", Hue::Blue))),
            ("ev3-ports:outD::brick-status", Some(("ev3-ports:outD", Hue::Any))),
            ("outD::ev3dev", Some(("outD", Hue::Any))),
            ("input3::capslock", None),
            ("led0:pink:brick-status", None),
            (":red:brick-status", None),
            ("brick-status", None),
        ] {
            assert_eq!(led_name(name), expected, "{name}");
        }
    }

    #[test]
    fn only_the_boards_own_lights_and_batteries_are_devices() {
        assert!(Class::Battery.admits("lego-ev3-battery"));
        assert!(!Class::Battery.admits("BAT0"));
        assert!(Class::Led.admits("led0:red:brick-status"));
        assert!(!Class::Led.admits("input3::capslock"));
        assert!(Class::TachoMotor.admits("motor0"));
    }
}
