//! The vocabulary of world and robot files, for everyone who reads them.

use crate::brick::port::Port;
use crate::noise::{Echo, Noise};
use crate::robot::{Chassis, MotorMount, RobotSpec, SensorMount, Wheel};
use crate::world::color::Color;
pub use crate::world::form::{Form, Kind, Value};
use crate::world::{Drawing, Drawn, Gripper, Hull, Item, Part, SpecError, THINGS, WorldSpec};
use ev3_motion::{Bounds, Pose};

/// The subject of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A world.
    World,
    /// A robot.
    Robot,
}

/// The facts of worlds that are no things, and those of robots. A name may have several forms.
const SETTINGS: &[Form] = {
    use Kind::{Color, Number, Rows, Text};
    const NAMED: &[(&str, Kind)] =
        &[("Name", Text), ("X", Number), ("Y", Number), ("Heading", Number)];
    const CORNERS: &[(&str, Kind)] =
        &[("X1", Number), ("Y1", Number), ("X2", Number), ("Y2", Number)];
    &[
        Form::new("bounds", CORNERS),
        Form::new("floor", &[("Color", Color)]),
        Form::new("ambient", &[("Percent", Number)]),
        Form::new("temperature", &[("Celsius", Number)]),
        Form::new("loudness", &[("Percent", Number)]),
        Form::new("start", NAMED.split_at(1).1),
        Form::new("start", NAMED),
        Form::new("map", &[("CellSize", Number), ("Rows", Rows)]),
    ]
};
const OF_ROBOTS: &[Form] = {
    use Kind::{
        EchoOptions, GripperOptions, Hull, MotorOptions, Number, Port, SensorOptions, Text,
        WheelOptions,
    };
    const PORT: (&str, Kind) = ("Port", Port);
    const TYPE: (&str, Kind) = ("Type", Text);
    const SIGMA: (&str, Kind) = ("Sigma", Number);
    const GRIPPER: &[(&str, Kind)] =
        &[PORT, ("X", Number), ("Y", Number), ("Options", GripperOptions)];
    const SENSOR: &[(&str, Kind)] = &[
        PORT,
        TYPE,
        ("X", Number),
        ("Y", Number),
        ("Heading", Number),
        ("Options", SensorOptions),
    ];
    const WHEEL: &[(&str, Kind)] = &[PORT, ("Diameter", Number), ("Options", WheelOptions)];
    &[
        Form::with_default("left_wheel", WHEEL),
        Form::with_default("right_wheel", WHEEL),
        Form::new("axle", &[("Length", Number)]),
        Form::new("hull", &[("Hull", Hull)]),
        Form::new("mass", &[("Kilograms", Number)]),
        Form::with_default("motor", &[PORT, TYPE, ("Options", MotorOptions)]),
        Form::with_default("sensor", SENSOR),
        Form::new("noise", &[PORT, SIGMA, ("Bias", Number)]),
        Form::new("encoder_noise", &[PORT, SIGMA]),
        Form::new("echo", &[PORT, ("Options", EchoOptions)]),
        Form::with_default("gripper", GRIPPER),
    ]
};

impl Subject {
    /// The word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Subject::World => "world",
            Subject::Robot => "robot",
        }
    }

    /// The forms of its facts, and of which of them are things.
    pub fn forms(self) -> impl Iterator<Item = (&'static Form, bool)> {
        let (things, others) = match self {
            Subject::World => (THINGS, SETTINGS),
            Subject::Robot => (&[][..], OF_ROBOTS),
        };
        let things = things.iter().map(|form| (form, true));
        things.chain(others.iter().map(|form| (form, false)))
    }

    /// What is expected instead of a fact that is not in the vocabulary: another number of
    /// arguments, or another name.
    pub fn expected(self, name: &str) -> String {
        let alike = self.forms().filter(|(form, _)| form.name == name);
        let counts: Vec<_> =
            alike.flat_map(|(form, _)| form.least..=form.arguments.len()).collect();
        if !counts.is_empty() {
            let plural = if counts == [1] { "" } else { "s" };
            let counts: Vec<_> = counts.iter().map(usize::to_string).collect();
            return format!("{name} has {} argument{plural}", counts.join(" or "));
        }
        let mut names: Vec<_> = self.forms().map(|(form, _)| form.name).collect();
        names.dedup();
        format!("a {} has: {}", self.name(), names.join(", "))
    }

    /// What is expected instead of what is no thing: the form of this name, else those of all.
    /// They have as few arguments as they may.
    pub fn expected_thing(self, name: &str) -> String {
        let shown = |form: &Form| {
            let names: Vec<_> =
                form.arguments[..form.least].iter().map(|(name, _)| *name).collect();
            format!("{}({})", form.name, names.join(", "))
        };
        let things: Vec<_> = self.forms().filter(|(_, is_thing)| *is_thing).collect();
        if let Some((form, _)) = things.iter().find(|(form, _)| form.name == name) {
            return format!("expected {}", shown(form));
        }
        let all: Vec<_> = things.iter().map(|(form, _)| shown(form)).collect();
        format!("expected one of: {}", all.join(", "))
    }

    /// The form of a fact with this name and number of arguments.
    pub fn form(self, name: &str, arity: usize) -> Option<&'static Form> {
        self.forms().map(|(form, _)| form).find(|form| form.name == name && form.takes(arity))
    }
}

/// A fact of a world or robot file.
#[derive(Clone, Debug, PartialEq)]
#[expect(missing_docs, reason = "named as in the files; see `WorldSpec` and `RobotSpec`")]
pub enum Fact {
    Bounds(Bounds),
    Floor(Color),
    Ambient(f64),
    Temperature(f64),
    Loudness(f64),
    Start(Pose),
    NamedStart(String, Pose),
    Item(Item),
    Map(Drawn),
    LeftWheel(Wheel),
    RightWheel(Wheel),
    Axle(f64),
    Hull(Hull),
    Mass(f64),
    Motor(MotorMount),
    Sensor(SensorMount),
    Noise(Port, Noise),
    EncoderNoise(Port, f64),
    Echo(Port, Echo),
    Gripper(Gripper),
}

impl Fact {
    /// The fact with this name. `None` if its arguments are others than its form says.
    /// Errors: if a world cannot be drawn like that.
    pub fn of(name: &str, arguments: &[Value]) -> Result<Option<Fact>, SpecError> {
        use Value::{
            Color, EchoOptions, GripperOptions, MotorOptions, Number, Port, Rows, SensorOptions,
            Text, WheelOptions,
        };
        if let Some(item) = Item::of(name, arguments) {
            return Ok(Some(Fact::Item(item)));
        }
        Ok(Some(match (name, arguments) {
            ("bounds", [Number(x1), Number(y1), Number(x2), Number(y2)]) => {
                Fact::Bounds(Bounds { low: [*x1, *y1], high: [*x2, *y2] })
            }
            ("floor", [Color(color)]) => Fact::Floor(*color),
            ("ambient", [Number(percent)]) => Fact::Ambient(*percent),
            ("temperature", [Number(celsius)]) => Fact::Temperature(*celsius),
            ("loudness", [Number(percent)]) => Fact::Loudness(*percent),
            ("start", [Number(x), Number(y), Number(h)]) => Fact::Start(Pose::new(*x, *y, *h)),
            ("start", [Text(name), Number(x), Number(y), Number(h)]) => {
                Fact::NamedStart(name.clone(), Pose::new(*x, *y, *h))
            }
            ("map", [Number(size), Rows(rows)]) => Fact::Map(Drawing::read(rows)?.drawn(*size)?),
            ("left_wheel" | "right_wheel", [Port(port), Number(diameter), options @ ..]) => {
                let (inverted, slip) = match options {
                    [WheelOptions { inverted, slip }] => (*inverted, *slip),
                    _ => (false, 0.0),
                };
                let wheel = Wheel { port: *port, diameter: *diameter, inverted, slip };
                if name == "left_wheel" { Fact::LeftWheel(wheel) } else { Fact::RightWheel(wheel) }
            }
            ("axle", [Number(length)]) => Fact::Axle(*length),
            ("hull", [Value::Hull(hull)]) => Fact::Hull(*hull),
            ("mass", [Number(mass)]) => Fact::Mass(*mass),
            ("motor", [Port(port), Text(driver), options @ ..]) => Fact::Motor(MotorMount {
                port: *port,
                driver: driver.clone(),
                noise: None,
                encoder_noise: None,
                stops: if let [MotorOptions(stops)] = options { *stops } else { None },
            }),
            (
                "sensor",
                [Port(port), Text(driver), Number(x), Number(y), Number(h), options @ ..],
            ) => Fact::Sensor(SensorMount {
                port: *port,
                driver: driver.clone(),
                pose: Pose::new(*x, *y, *h),
                noise: None,
                echo: Echo::default(),
                looks_ahead: matches!(options, [SensorOptions { looks_ahead: true }]),
            }),
            ("noise", [Port(port), Number(sigma), Number(bias)]) => {
                Fact::Noise(*port, Noise { sigma: *sigma, bias: *bias })
            }
            ("encoder_noise", [Port(port), Number(sigma)]) => Fact::EncoderNoise(*port, *sigma),
            ("echo", [Port(port), EchoOptions(echo)]) => Fact::Echo(*port, *echo),
            ("gripper", [Port(port), Number(x), Number(y), options @ ..]) => {
                let given =
                    if let [GripperOptions(given)] = options { *given } else { Gripper::default() };
                Fact::Gripper(Gripper { port: *port, at: [*x, *y], ..given })
            }
            _ => return Ok(None),
        }))
    }

    /// Whether this fact sets a part, where `items`, `motors` and `sensors` count those of the facts
    /// before it.
    fn sets(&self, part: Part, [items, motors, sensors]: [usize; 3]) -> bool {
        match (self, part) {
            (Fact::Bounds(_), Part::Bounds)
            | (Fact::Ambient(_), Part::Ambient)
            | (Fact::Temperature(_), Part::Temperature)
            | (Fact::Loudness(_), Part::Loudness)
            | (
                Fact::Start(_) | Fact::NamedStart(..) | Fact::Map(Drawn { start: Some(_), .. }),
                Part::Start,
            )
            | (Fact::LeftWheel(_), Part::LeftWheel)
            | (Fact::RightWheel(_), Part::RightWheel)
            | (Fact::Axle(_), Part::Axle)
            | (Fact::Hull(_), Part::Hull)
            | (Fact::Mass(_), Part::Mass) => true,
            (Fact::Item(_), Part::Item(index)) => index == items,
            (Fact::Map(map), Part::Item(index)) => {
                (items..items + map.items.len()).contains(&index)
            }
            (Fact::Motor(_), Part::Motor(index)) => index == motors,
            (Fact::Sensor(_), Part::Sensor(index)) => index == sensors,
            (Fact::EncoderNoise(at, _), Part::EncoderNoise(other))
            | (Fact::Noise(at, _), Part::Noise(other))
            | (Fact::Echo(at, _), Part::Echo(other))
            | (Fact::Gripper(Gripper { port: at, .. }), Part::Gripper(other)) => *at == other,
            _ => false,
        }
    }
}

/// The place among some facts of the one to blame for an error: the last one that sets the
/// likeliest part. `None` if something is missing instead.
#[must_use]
pub fn culprit(facts: &[Fact], error: &SpecError) -> Option<usize> {
    error.parts.iter().find_map(|part| {
        let mut counts = [0, 0, 0];
        let mut last = None;
        for (index, fact) in facts.iter().enumerate() {
            if fact.sets(*part, counts) {
                last = Some(index);
            }
            match fact {
                Fact::Item(_) => counts[0] += 1,
                Fact::Map(map) => counts[0] += map.items.len(),
                Fact::Motor(_) => counts[1] += 1,
                Fact::Sensor(_) => counts[2] += 1,
                _ => {}
            }
        }
        last
    })
}

impl WorldSpec {
    /// The world that facts describe. Later ones override earlier ones. Facts about robots are
    /// ignored.
    pub fn from_facts(facts: &[Fact]) -> WorldSpec {
        let mut world = WorldSpec::default();
        for fact in facts {
            match fact {
                Fact::Bounds(bounds) => world.bounds = Some(*bounds),
                Fact::Floor(color) => world.floor = *color,
                Fact::Ambient(percent) => world.ambient = *percent,
                Fact::Temperature(celsius) => world.temperature = *celsius,
                Fact::Loudness(percent) => world.loudness = *percent,
                Fact::Start(pose) => world.start = *pose,
                Fact::NamedStart(name, pose) => world.starts.push((name.clone(), *pose)),
                Fact::Item(item) => world.items.push(item.clone()),
                Fact::Map(map) => {
                    world.items.extend(map.items.iter().cloned());
                    world.start = map.start.unwrap_or(world.start);
                }
                _ => {}
            }
        }
        world
    }
}

impl RobotSpec {
    /// The robot that facts describe. Later ones override earlier ones. Facts about worlds are
    /// ignored. Errors: names the first impossible part, else all parts that are missing.
    pub fn from_facts(facts: &[Fact]) -> Result<RobotSpec, SpecError> {
        let mut chassis = Chassis::default();
        let (mut motors, mut sensors): (Vec<MotorMount>, Vec<SensorMount>) = Default::default();
        let mut grippers = Vec::new();
        for fact in facts {
            match fact {
                Fact::LeftWheel(wheel) => chassis.left = Some(*wheel),
                Fact::RightWheel(wheel) => chassis.right = Some(*wheel),
                Fact::Axle(length) => chassis.axle = Some(*length),
                Fact::Hull(hull) => chassis.hull = Some(*hull),
                Fact::Mass(mass) => chassis.mass = Some(*mass),
                Fact::Motor(motor) => motors.push(motor.clone()),
                Fact::Sensor(sensor) => sensors.push(sensor.clone()),
                Fact::Gripper(gripper) => grippers.push(*gripper),
                Fact::Noise(port, noise) => {
                    for motor in motors.iter_mut().filter(|motor| motor.port == *port) {
                        motor.noise = Some(*noise);
                    }
                    for sensor in sensors.iter_mut().filter(|sensor| sensor.port == *port) {
                        sensor.noise = Some(*noise);
                    }
                }
                Fact::EncoderNoise(port, sigma) => {
                    for motor in motors.iter_mut().filter(|motor| motor.port == *port) {
                        motor.encoder_noise = Some(*sigma);
                    }
                }
                Fact::Echo(port, echo) => {
                    for sensor in sensors.iter_mut().filter(|sensor| sensor.port == *port) {
                        sensor.echo = *echo;
                    }
                }
                _ => {}
            }
        }
        chassis.complete(motors, sensors, grippers)
    }
}
