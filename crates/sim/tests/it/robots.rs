//! The robots that the pack ships, for tests and examples.
#![allow(dead_code, reason = "each program that includes this uses a part")]

use ev3_sim::facts::Fact;
use ev3_sim::{Echo, Hull, Machine, MotorMount, Options, Pose, RobotSpec, SensorMount};
use ev3_sim::{Wheel, Wheels, WorldSpec};

/// The robot of the paper.
pub(crate) fn default_robot() -> RobotSpec {
    read(include_str!("../../../../prolog/ev3dev/robots/default.pl"))
}

/// The same with a bumper on in4 in the place of the gyro.
pub(crate) fn touch_robot() -> RobotSpec {
    read(include_str!("../../../../prolog/ev3dev/robots/touch.pl"))
}

/// The wheels of a robot that has some.
pub(crate) fn wheels(robot: &mut RobotSpec) -> &mut Wheels {
    robot.wheels.as_mut().unwrap()
}

/// The robot of the paper with another axle.
pub(crate) fn with_axle(axle: f64) -> RobotSpec {
    let mut robot = default_robot();
    wheels(&mut robot).axle = axle;
    robot
}

/// The default robot on an endless floor, without noise.
pub(crate) fn default_machine() -> Machine {
    Machine::new(&WorldSpec::default(), &default_robot(), Options::default()).unwrap()
}

/// Reads the facts that the shipped robots have, each on a line of its own.
fn read(text: &str) -> RobotSpec {
    let lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with('%'));
    RobotSpec::from_facts(&lines.map(fact).collect::<Vec<_>>()).unwrap()
}

fn fact(line: &str) -> Fact {
    let (name, rest) = line.split_once('(').unwrap();
    let arguments = rest.trim_end_matches('.').strip_suffix(')').unwrap().split(',');
    let words: Vec<&str> = arguments.map(|word| word.trim().trim_matches('\'')).collect();
    let number = |index: usize| words[index].parse::<f64>().unwrap();
    let port = || words[0].parse().unwrap();
    let wheel = || Wheel { port: port(), diameter: number(1), inverted: false, slip: 0.0 };
    match name {
        "left_wheel" => Fact::LeftWheel(wheel()),
        "right_wheel" => Fact::RightWheel(wheel()),
        "axle" => Fact::Axle(number(0)),
        "hull" => {
            let radius = words[0].strip_prefix("circle(").and_then(|word| word.strip_suffix(')'));
            Fact::Hull(Hull::Circle { radius: radius.unwrap().parse().unwrap() })
        }
        "mass" => Fact::Mass(number(0)),
        "motor" => Fact::Motor(MotorMount {
            port: port(),
            driver: words[1].into(),
            noise: None,
            encoder_noise: None,
            stops: None,
        }),
        "sensor" => {
            let pose = Pose::new(number(2), number(3), number(4));
            Fact::Sensor(SensorMount {
                port: port(),
                driver: words[1].into(),
                pose,
                noise: None,
                echo: Echo::default(),
                looks_ahead: false,
            })
        }
        _ => panic!("unknown fact: {line}"),
    }
}
