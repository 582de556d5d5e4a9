//! The parts of the robot, as plain data: the vocabulary of robot files.
use crate::brick::port::Port;
use crate::motor::{MOTOR_KINDS, MotorKind};
use crate::noise::{Echo, Noise, TYPICAL_TEETH};
use crate::sensor::SensorKind;
use crate::world::{Gripper, Hull, Part, SpecError};
use ev3_motion::{OUT_OF_RANGE, Pose};
use std::ops::RangeInclusive;

/// Lengths of a robot, in cm, and its mass, in kg.
const LENGTHS: RangeInclusive<f64> = 0.01..=1000.0;
const MASSES: RangeInclusive<f64> = 0.001..=1000.0;
/// The hold of a gripper, in N and N m.
const MOST_FORCE: f64 = 100.0;
const MOST_TORQUE: f64 = 10.0;
/// The farthest stop, in degrees.
const MOST_TURN: f64 = 1e6;
/// A brick without a chassis: its outline in cm, and its mass with batteries in kg.
const BRICK: Hull = Hull::Rectangle { width: 7.2, length: 11.2, offset: 0.0 };
const BRICK_MASS: f64 = 0.28;
const DIAMETER: &str = "needs a diameter from 0.01 to 1000 cm";

/// A driven wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// The output port of its motor.
    pub port: Port,
    /// Diameter in cm.
    pub diameter: f64,
    /// The motor is mounted the other way round: positive turns drive backward.
    pub inverted: bool,
    /// Share of its way that the wheel loses by slipping: 0 none, 0.01 one per cent.
    pub slip: f64,
}

/// What the robot drives on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels {
    /// Left wheel.
    pub left: Wheel,
    /// Right wheel.
    pub right: Wheel,
    /// Distance between them in cm.
    pub axle: f64,
}

impl Wheels {
    /// The ports of their motors, the left one first.
    pub fn ports(&self) -> [Port; 2] {
        [self.left.port, self.right.port]
    }
}

/// A motor on an output port.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorMount {
    /// Its port.
    pub port: Port,
    /// The driver's name, such as `lego-ev3-l-motor`: see [`MOTOR_KINDS`](crate::MOTOR_KINDS).
    pub driver: String,
    /// Its errors; `None` if nothing is said about them.
    pub noise: Option<Noise>,
    /// Standard deviation of the errors of its encoder's teeth, in degrees. They add to
    /// `position`, are the same at every turn, and depend on the seed. `None` as above.
    pub encoder_noise: Option<f64>,
    /// Between which angles its shaft can turn, in degrees from where it is at the start; `None`
    /// without end.
    pub stops: Option<[f64; 2]>,
}

/// A sensor on an input port.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorMount {
    /// Its port.
    pub port: Port,
    /// The driver's name, such as `lego-ev3-us`.
    pub driver: String,
    /// Its place from the middle of the axle, x to the right, y ahead, in cm, and its heading. A
    /// color sensor sees the floor below this point, and lamps in its direction; a touch
    /// sensor is an 8 cm wide bumper across its heading.
    pub pose: Pose,
    /// Its errors; `None` if nothing is said about them.
    pub noise: Option<Noise>,
    /// What an ultrasonic sensor hears.
    pub echo: Echo,
    /// A color sensor that sees what stands ahead of it, not the floor.
    pub looks_ahead: bool,
}

/// A robot: with two driven wheels, or one that stays where it is.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotSpec {
    /// Its wheels, if it drives.
    pub wheels: Option<Wheels>,
    /// Its outline.
    pub hull: Hull,
    /// Mass in kg.
    pub mass: f64,
    /// Motors, those of the wheels included.
    pub motors: Vec<MotorMount>,
    /// Sensors.
    pub sensors: Vec<SensorMount>,
    /// Grippers.
    pub grippers: Vec<Gripper>,
}

impl RobotSpec {
    /// Gives every device the errors that such a device might plausibly have, unless its own
    /// are known.
    pub fn with_typical_noise(mut self) -> RobotSpec {
        for motor in &mut self.motors {
            motor.noise.get_or_insert_with(|| Noise::typical(&motor.driver));
            motor.encoder_noise.get_or_insert(TYPICAL_TEETH);
        }
        for sensor in &mut self.sensors {
            sensor.noise.get_or_insert_with(|| Noise::typical(&sensor.driver));
        }
        self
    }

    /// Checks the numbers, the drivers' names, and that no port is used twice.
    /// Errors: names the first offending part.
    pub fn validate(&self) -> Result<(), SpecError> {
        let RobotSpec { wheels, hull, mass, .. } = *self;
        let parts = Chassis {
            left: wheels.map(|wheels| wheels.left),
            right: wheels.map(|wheels| wheels.right),
            axle: wheels.map(|wheels| wheels.axle),
            hull: Some(hull),
            mass: Some(mass),
        };
        parts.validate()?;
        validate_devices(&self.motors, &self.sensors, wheels)?;
        validate_grippers(&self.grippers, &self.motors)
    }
}

/// The parts that each robot has once. `None` is a part that is still missing.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Chassis {
    pub(crate) left: Option<Wheel>,
    pub(crate) right: Option<Wheel>,
    pub(crate) axle: Option<f64>,
    pub(crate) hull: Option<Hull>,
    pub(crate) mass: Option<f64>,
}

impl Chassis {
    /// Checks the parts that are there.
    pub(crate) fn validate(&self) -> Result<(), SpecError> {
        let diameter = |wheel: Option<Wheel>| wheel.map(|wheel| wheel.diameter);
        let numbers = [
            (Part::LeftWheel, "left wheel", diameter(self.left), LENGTHS, DIAMETER),
            (Part::RightWheel, "right wheel", diameter(self.right), LENGTHS, DIAMETER),
            (Part::Axle, "axle", self.axle, LENGTHS, "needs a length from 0.01 to 1000 cm"),
            (Part::Mass, "mass", self.mass, MASSES, "must be from 0.001 to 1000 kg"),
        ];
        for (part, name, number, range, reason) in numbers {
            if number.is_some_and(|number| !range.contains(&number)) {
                return Err(SpecError::new(name, reason).in_part(part));
            }
        }
        let ports = [self.left, self.right].map(|wheel| wheel.map(|wheel| wheel.port));
        let is_shared = ports[0].is_some() && ports[0] == ports[1];
        let wheels = [
            (Part::LeftWheel, "left wheel", self.left),
            (Part::RightWheel, "right wheel", self.right),
        ];
        for (part, name, wheel) in wheels {
            let Some(wheel) = wheel else { continue };
            if !(0.0..1.0).contains(&wheel.slip) {
                let error = SpecError::new(name, "needs a slip from 0 to below 1");
                return Err(error.in_part(part));
            }
            if !wheel.port.is_output() || is_shared {
                let error = SpecError::new(name, "needs an output port of its own");
                return Err(error.in_part(part));
            }
        }
        let reach = self.hull.map(|hull| hull.reach());
        if reach.is_some_and(|reach| !LENGTHS.contains(&reach)) {
            let error = SpecError::new("hull", "needs an extent from 0.01 to 1000 cm");
            return Err(error.in_part(Part::Hull));
        }
        Ok(())
    }

    /// The robot with these parts, if none is missing.
    pub(crate) fn complete(
        self,
        motors: Vec<MotorMount>,
        sensors: Vec<SensorMount>,
        grippers: Vec<Gripper>,
    ) -> Result<RobotSpec, SpecError> {
        self.validate()?;
        let wheels = match self {
            Chassis { left: Some(left), right: Some(right), axle: Some(axle), .. } => {
                Some(Wheels { left, right, axle })
            }
            _ => None,
        };
        validate_devices(&motors, &sensors, wheels)?;
        validate_grippers(&grippers, &motors)?;
        let stays = self.left.is_none() && self.right.is_none() && self.axle.is_none();
        if stays && !(motors.is_empty() && sensors.is_empty()) {
            let hull = self.hull.unwrap_or(BRICK);
            let mass = self.mass.unwrap_or(BRICK_MASS);
            return Ok(RobotSpec { wheels, hull, mass, motors, sensors, grippers });
        }
        let (Some(_), Some(hull), Some(mass)) = (wheels, self.hull, self.mass) else {
            return Err(self.missing());
        };
        Ok(RobotSpec { wheels, hull, mass, motors, sensors, grippers })
    }

    fn missing(&self) -> SpecError {
        let parts = [
            ("left_wheel", self.left.is_none()),
            ("right_wheel", self.right.is_none()),
            ("axle", self.axle.is_none()),
            ("hull", self.hull.is_none()),
            ("mass", self.mass.is_none()),
        ];
        let missing: Vec<_> =
            parts.iter().filter(|(_, is_missing)| *is_missing).map(|(name, _)| *name).collect();
        SpecError::new("robot", format!("has no {}", missing.join(", no ")))
    }
}

fn validate_devices(
    motors: &[MotorMount],
    sensors: &[SensorMount],
    wheels: Option<Wheels>,
) -> Result<(), SpecError> {
    let mut used = Vec::new();
    for (index, mount) in motors.iter().enumerate() {
        let MotorMount { port, driver, encoder_noise, stops, .. } = mount;
        let fault = |reason: &str| {
            Err(SpecError::new(format!("motor {driver} on {port}"), reason)
                .in_part(Part::Motor(index)))
        };
        let Some(kind) = MotorKind::named(driver) else {
            return fault(&format!("is of no known type; there are: {}", motors_alike(driver)));
        };
        if !port.is_output() || used.contains(port) {
            return fault("needs an output port of its own");
        }
        if encoder_noise.is_some_and(|sigma| !(sigma.is_finite() && sigma >= 0.0)) {
            let item = format!("encoder noise on {port}");
            let error = SpecError::new(item, "must not be below 0");
            return Err(error.in_part(Part::EncoderNoise(*port)).in_part(Part::Motor(index)));
        }
        if let Some([low, high]) = stops {
            let is_around_start =
                (-MOST_TURN..=0.0).contains(low) && (0.0..=MOST_TURN).contains(high);
            if !is_around_start || low >= high {
                return fault(
                    "needs stops(Min, Max) with Min =< 0 =< Max, Min < Max, in degrees, \
                     at most 1000000",
                );
            }
            if kind.travel.is_some() {
                return fault("has the stops of its stroke");
            }
            if wheels.is_some_and(|wheels| wheels.ports().contains(port)) {
                return fault("turns a wheel, which has no stops");
            }
        }
        used.push(*port);
    }
    for (index, mount) in sensors.iter().enumerate() {
        let SensorMount { port, driver, pose, echo, looks_ahead, .. } = mount;
        let fault = |reason: &str| {
            Err(SpecError::new(format!("sensor {driver} on {port}"), reason)
                .in_part(Part::Sensor(index)))
        };
        let Some(kind) = SensorKind::named(driver) else {
            return fault(&format!("is of no known type; there are: {}", sensors_alike(driver)));
        };
        if *looks_ahead && !kind.modes.iter().any(|mode| mode.sense.is_of_spot()) {
            return fault("cannot look ahead: looks(ahead) is for color and light sensors");
        }
        if port.is_output() || used.contains(port) {
            return fault("needs an input port of its own");
        }
        if !pose.is_in_range() {
            return fault(OUT_OF_RANGE);
        }
        if let Err(reason) = echo.validate() {
            let error = SpecError::new(format!("echo of the sensor on {port}"), reason);
            return Err(error.in_part(Part::Echo(*port)).in_part(Part::Sensor(index)));
        }
        used.push(*port);
    }
    let motors = motors.iter().enumerate().map(|(at, it)| (it.port, it.noise, Part::Motor(at)));
    let sensors = sensors.iter().enumerate().map(|(at, it)| (it.port, it.noise, Part::Sensor(at)));
    for (port, noise, part) in motors.chain(sensors) {
        let Noise { sigma, bias } = noise.unwrap_or_default();
        if !(sigma.is_finite() && sigma >= 0.0 && bias.is_finite()) {
            let error = SpecError::new(
                format!("noise on {port}"),
                "needs a spread that is not below 0, and a bias",
            );
            return Err(error.in_part(Part::Noise(port)).in_part(part));
        }
    }
    Ok(())
}

fn validate_grippers(grippers: &[Gripper], motors: &[MotorMount]) -> Result<(), SpecError> {
    for Gripper { port, at, opening, force, torque, .. } in grippers {
        let motor = motors.iter().find(|motor| motor.port == *port);
        let is_second = grippers.iter().filter(|other| other.port == *port).count() > 1;
        let checks = [
            (is_second, "needs a motor of its own"),
            (motor.is_none_or(|motor| motor.stops.is_none()), "needs a motor with stops(Min, Max)"),
            (!at.iter().all(|number| number.abs() <= *LENGTHS.end()), OUT_OF_RANGE),
            (!LENGTHS.contains(opening), "needs an opening from 0.01 to 1000 cm"),
            (!(0.0..=MOST_FORCE).contains(force), "needs a force from 0 to 100 N"),
            (!(0.0..=MOST_TORQUE).contains(torque), "needs a torque from 0 to 10 N m"),
        ];
        if let Some((_, reason)) = checks.into_iter().find(|(is_wrong, _)| *is_wrong) {
            let error = SpecError::new(format!("gripper on {port}"), reason);
            return Err(error.in_part(Part::Gripper(*port)));
        }
    }
    Ok(())
}

/// The types of motors that begin most like an unknown name.
pub(crate) fn motors_alike(name: &str) -> String {
    alike(name, MOTOR_KINDS.iter().map(|kind| kind.driver_name))
}

/// The types of sensors that begin most like an unknown name.
pub(crate) fn sensors_alike(name: &str) -> String {
    alike(name, SensorKind::all().map(|kind| kind.driver_name))
}

/// The names that begin most like an unknown one, or those of the EV3's own devices.
fn alike(name: &str, all: impl Iterator<Item = &'static str> + Clone) -> String {
    let shared = |other: &str| name.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let most = all.clone().map(shared).max().unwrap_or(0);
    let is_alike = |other: &&str| match most {
        0 => other.starts_with("lego-ev3-"),
        _ => shared(other) == most,
    };
    all.filter(is_alike).collect::<Vec<_>>().join(", ")
}
