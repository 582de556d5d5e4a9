//! The vocabulary of world and robot files, for everyone who reads them.

use crate::brick::port::Port;
use crate::noise::{Echo, Noise};
use crate::robot::{Chassis, MotorMount, RobotSpec, SensorMount, Wheel};
use crate::world::color::Color;
use crate::world::{Drawn, Hull, Item, Part, SpecError, WorldSpec};
use ev3_motion::{Bounds, Pose};

/// The subject of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// A world.
    World,
    /// A robot.
    Robot,
}

impl Subject {
    /// The names of its facts, and how many arguments each may have.
    #[must_use]
    pub const fn vocabulary(self) -> &'static [(&'static str, &'static [usize])] {
        match self {
            Subject::World => &[
                ("bounds", &[4]),
                ("wall", &[4, 5]),
                ("box", &[4, 5]),
                ("circle", &[3]),
                ("floor", &[1]),
                ("patch", &[2]),
                ("line", &[3]),
                ("lamp", &[3, 4]),
                ("beacon", &[3]),
                ("ambient", &[1]),
                ("temperature", &[1]),
                ("loudness", &[1]),
                ("start", &[3, 4]),
                ("map", &[2]),
            ],
            Subject::Robot => &[
                ("left_wheel", &[2, 3]),
                ("right_wheel", &[2, 3]),
                ("axle", &[1]),
                ("hull", &[1]),
                ("mass", &[1]),
                ("motor", &[2, 3]),
                ("sensor", &[5]),
                ("noise", &[3]),
                ("encoder_noise", &[2]),
                ("echo", &[2]),
            ],
        }
    }

    /// What is expected instead of a fact that is not in the vocabulary: another number of
    /// arguments, or another name.
    #[must_use]
    pub fn expected(self, name: &str) -> String {
        let vocabulary = self.vocabulary();
        if let Some((_, arities)) = vocabulary.iter().find(|(other, _)| *other == name) {
            let counts: Vec<_> = arities.iter().map(usize::to_string).collect();
            let plural = if arities == &[1] { "" } else { "s" };
            return format!("{name} has {} argument{plural}", counts.join(" or "));
        }
        let names: Vec<_> = vocabulary.iter().map(|(name, _)| *name).collect();
        let kind = match self {
            Subject::World => "world",
            Subject::Robot => "robot",
        };
        format!("a {kind} has: {}", names.join(", "))
    }

    /// Whether a fact with this name and number of arguments is in the vocabulary.
    #[must_use]
    pub fn has(self, name: &str, arity: usize) -> bool {
        self.vocabulary().iter().any(|(other, arities)| *other == name && arities.contains(&arity))
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
}

impl Fact {
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
            | (Fact::Echo(at, _), Part::Echo(other)) => *at == other,
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
    #[must_use]
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
    /// ignored.
    ///
    /// # Errors
    /// Names the first impossible part, else all parts that are missing.
    pub fn from_facts(facts: &[Fact]) -> Result<RobotSpec, SpecError> {
        let mut chassis = Chassis::default();
        let (mut motors, mut sensors): (Vec<MotorMount>, Vec<SensorMount>) = Default::default();
        for fact in facts {
            match fact {
                Fact::LeftWheel(wheel) => chassis.left = Some(*wheel),
                Fact::RightWheel(wheel) => chassis.right = Some(*wheel),
                Fact::Axle(length) => chassis.axle = Some(*length),
                Fact::Hull(hull) => chassis.hull = Some(*hull),
                Fact::Mass(mass) => chassis.mass = Some(*mass),
                Fact::Motor(motor) => motors.push(motor.clone()),
                Fact::Sensor(sensor) => sensors.push(sensor.clone()),
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
        chassis.complete(motors, sensors)
    }
}
