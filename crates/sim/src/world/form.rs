//! The forms of facts: a name, and arguments of some kinds.

use std::fmt;

use crate::brick::port::Port;
use crate::noise::Echo;
use crate::world::color::Color;
use crate::world::{Gripper, Hull, Traits};

/// A kind of argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[expect(missing_docs, reason = "named as in `Value`")]
pub enum Kind {
    Number,
    Channel,
    Color,
    Port,
    Text,
    Places,
    Rows,
    Hull,
    Traits,
    WheelOptions,
    MotorOptions,
    SensorOptions,
    EchoOptions,
    GripperOptions,
}

/// An argument that was read.
#[derive(Clone, Debug)]
pub enum Value {
    /// A number, in the unit that the form means.
    Number(f64),
    /// A channel of beacons and remote controls.
    Channel(u8),
    /// A color.
    Color(Color),
    /// A port.
    Port(Port),
    /// A name.
    Text(String),
    /// A place. No form has one: its two numbers are two arguments.
    Place([f64; 2]),
    /// A list of places.
    Places(Vec<[f64; 2]>),
    /// The rows of a drawn world.
    Rows(Vec<String>),
    /// An outline of a robot.
    Hull(Hull),
    /// The properties of a box or circle.
    Traits(Traits),
    /// How a wheel is mounted.
    WheelOptions {
        /// The other way round.
        inverted: bool,
        /// The share of its way that it loses.
        slip: f64,
    },
    /// The stops of a motor's shaft.
    MotorOptions(Option<[f64; 2]>),
    /// How a sensor is mounted.
    SensorOptions {
        /// It sees what stands ahead of it, not the floor.
        looks_ahead: bool,
    },
    /// What an ultrasonic sensor hears.
    EchoOptions(Echo),
    /// A gripper at no place yet.
    GripperOptions(Gripper),
}

impl Value {
    /// As it stands in a file.
    pub(crate) fn saved(&self) -> String {
        match self {
            Value::Color(color) => format!("'{color}'"),
            Value::Traits(traits) => traits.saved(),
            Value::Places(places) => {
                format!("[{}]", places.iter().map(pair).collect::<Vec<_>>().join(", "))
            }
            other => other.to_string(),
        }
    }
}

/// As it stands in a message; of a list of places only the first.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Number(number) => write!(f, "{number}"),
            Value::Channel(channel) => write!(f, "{channel}"),
            Value::Color(color) => write!(f, "{color}"),
            Value::Port(port) => write!(f, "{port}"),
            Value::Text(text) => f.write_str(text),
            Value::Traits(traits) => write!(f, "{traits}"),
            Value::Place([x, y]) => write!(f, "{x}, {y}"),
            Value::Places(places) => match &places[..] {
                [] => f.write_str("[]"),
                [only] => write!(f, "[{}]", pair(only)),
                [first, ..] => write!(f, "[{}|...]", pair(first)),
            },
            other => write!(f, "{other:?}"),
        }
    }
}

/// `X-Y`. A minus before a number needs a space before it.
fn pair([x, y]: &[f64; 2]) -> String {
    if y.is_sign_negative() { format!("{x} - {y}") } else { format!("{x}-{y}") }
}

/// What a fact looks like.
#[derive(Clone, Copy, Debug)]
pub struct Form {
    /// Its name.
    pub name: &'static str,
    /// The name and the kind of each argument.
    pub arguments: &'static [(&'static str, Kind)],
    /// How few arguments it may have.
    pub least: usize,
}

/// With all its arguments.
impl fmt::Display for Form {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names: Vec<_> = self.arguments.iter().map(|(name, _)| *name).collect();
        write!(f, "{}({})", self.name, names.join(", "))
    }
}

impl Form {
    /// A form with all arguments.
    pub(crate) const fn new(
        name: &'static str,
        arguments: &'static [(&'static str, Kind)],
    ) -> Form {
        Form { name, arguments, least: arguments.len() }
    }

    /// A form whose last argument may be left out.
    pub(crate) const fn with_default(
        name: &'static str,
        arguments: &'static [(&'static str, Kind)],
    ) -> Form {
        Form::with_defaults(name, arguments, 1)
    }

    /// A form whose last arguments may be left out.
    pub(crate) const fn with_defaults(
        name: &'static str,
        arguments: &'static [(&'static str, Kind)],
        count: usize,
    ) -> Form {
        Form { name, arguments, least: arguments.len() - count }
    }

    /// Whether a fact may have `count` arguments.
    pub fn takes(&self, count: usize) -> bool {
        (self.least..=self.arguments.len()).contains(&count)
    }
}
