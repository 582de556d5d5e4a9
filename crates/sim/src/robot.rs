//! What the robot is made of, as plain data: the vocabulary of robot files.

use crate::brick::port::Port;
use crate::motor::MotorKind;
use crate::noise::{Noise, TYPICAL_TEETH};
use crate::sensor::SensorKind;
use crate::world::geometry::Pose;
use crate::world::{Hull, SpecError};

/// A driven wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheel {
    /// The output port of its motor.
    pub port: Port,
    /// Diameter in cm.
    pub diameter: f64,
    /// The motor is mounted the other way round: positive turns drive backwards.
    pub inverted: bool,
    /// Share of its way that the wheel loses by slipping: 0 none, 0.01 one per cent.
    pub slip: f64,
}

/// A motor on an output port.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorMount {
    /// Its port.
    pub port: Port,
    /// The driver's name, such as `lego-ev3-l-motor`: see [`MOTOR_KINDS`](crate::MOTOR_KINDS).
    pub driver: String,
    /// Its errors.
    pub noise: Noise,
    /// Standard deviation of the errors of its encoder's teeth, in degrees. They add to
    /// `position`, are the same at every turn, and depend on the seed.
    pub encoder_noise: f64,
}

/// A sensor on an input port.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorMount {
    /// Its port.
    pub port: Port,
    /// The driver's name, such as `lego-ev3-us`.
    pub driver: String,
    /// Where it sits, from the middle of the axle: x to the right, y ahead, in cm, and where it
    /// looks. A color sensor sees the floor below this point, and lamps in its direction; a touch
    /// sensor is an 8 cm wide bumper across its heading.
    pub pose: Pose,
    /// Its errors.
    pub noise: Noise,
}

/// A robot with two driven wheels.
#[derive(Clone, Debug, PartialEq)]
pub struct RobotSpec {
    /// Left wheel.
    pub left: Wheel,
    /// Right wheel.
    pub right: Wheel,
    /// Distance between the wheels in cm.
    pub axle: f64,
    /// Its outline.
    pub hull: Hull,
    /// Mass in kg.
    pub mass: f64,
    /// Motors, those of the wheels included.
    pub motors: Vec<MotorMount>,
    /// Sensors.
    pub sensors: Vec<SensorMount>,
}

impl Default for RobotSpec {
    /// The paper's vehicle: 5.6 cm wheels 10.6 cm apart on outB (left) and outC (right), a medium
    /// motor on outA, ultrasonic ahead on in1, color right on in2 and left on in3, gyro on in4.
    fn default() -> Self {
        let wheel = |port| Wheel { port, diameter: 5.6, inverted: false, slip: 0.0 };
        let motor = |port, driver: &str| MotorMount {
            port,
            driver: driver.to_owned(),
            noise: Noise::NONE,
            encoder_noise: 0.0,
        };
        let sensor = |port, driver: &str, x, y, heading| SensorMount {
            port,
            driver: driver.to_owned(),
            pose: Pose::new(x, y, heading),
            noise: Noise::NONE,
        };
        RobotSpec {
            left: wheel(Port::OutB),
            right: wheel(Port::OutC),
            axle: 10.6,
            hull: Hull::Circle { radius: 8.0 },
            mass: 0.75,
            motors: vec![
                motor(Port::OutA, "lego-ev3-m-motor"),
                motor(Port::OutB, "lego-ev3-l-motor"),
                motor(Port::OutC, "lego-ev3-l-motor"),
            ],
            sensors: vec![
                sensor(Port::In1, "lego-ev3-us", 0.0, 7.0, 0.0),
                sensor(Port::In2, "lego-ev3-color", 3.0, 6.5, 30.0),
                sensor(Port::In3, "lego-ev3-color", -3.0, 6.5, -30.0),
                sensor(Port::In4, "lego-ev3-gyro", 0.0, 0.0, 0.0),
            ],
        }
    }
}

impl RobotSpec {
    /// The default robot with a bumper on in4 in the place of the gyro.
    #[must_use]
    pub fn with_touch() -> RobotSpec {
        let mut robot = RobotSpec::default();
        for sensor in &mut robot.sensors {
            if sensor.port == Port::In4 {
                "lego-ev3-touch".clone_into(&mut sensor.driver);
                sensor.pose = Pose::new(0.0, 8.0, 0.0);
            }
        }
        robot
    }

    /// The default robot with its wheels' wires exchanged, right on outB and left on outC: so the
    /// paper's Braitenberg vehicle 2 (right eye in2 to outB, left eye in3 to outC) shies away from
    /// a lamp as it should.
    #[must_use]
    pub fn swapped() -> RobotSpec {
        let mut robot = RobotSpec::default();
        std::mem::swap(&mut robot.left.port, &mut robot.right.port);
        robot
    }

    /// Gives every device the errors that such a device might plausibly have.
    #[must_use]
    pub fn with_typical_noise(mut self) -> RobotSpec {
        for motor in &mut self.motors {
            motor.noise = Noise::typical(&motor.driver);
            motor.encoder_noise = TYPICAL_TEETH;
        }
        for sensor in &mut self.sensors {
            sensor.noise = Noise::typical(&sensor.driver);
        }
        self
    }

    /// Checks the numbers, the drivers' names, and that no port is used twice.
    ///
    /// # Errors
    /// Names the first offending part.
    pub fn validate(&self) -> Result<(), SpecError> {
        let lengths = [
            ("left wheel", self.left.diameter, "needs a diameter above 0"),
            ("right wheel", self.right.diameter, "needs a diameter above 0"),
            ("axle", self.axle, "needs a length above 0"),
            ("mass", self.mass, "must be above 0"),
        ];
        for (name, number, reason) in lengths {
            if !(number.is_finite() && number > 0.0) {
                return Err(SpecError::new(name, reason));
            }
        }
        for (name, wheel) in [("left wheel", self.left), ("right wheel", self.right)] {
            if !(0.0..1.0).contains(&wheel.slip) {
                return Err(SpecError::new(name, "needs a slip from 0 to below 1"));
            }
            if !wheel.port.is_output() || self.left.port == self.right.port {
                return Err(SpecError::new(name, "needs an output port of its own"));
            }
        }
        let hull = self.hull.reach();
        if !(hull.is_finite() && hull > 0.0) {
            return Err(SpecError::new("hull", "needs an extent above 0"));
        }
        let mut used = Vec::new();
        for MotorMount { port, driver, encoder_noise, .. } in &self.motors {
            let item = || format!("motor {driver} on {port}");
            if MotorKind::named(driver).is_none() {
                return Err(SpecError::new(item(), "is of no known type"));
            }
            if !port.is_output() || used.contains(port) {
                return Err(SpecError::new(item(), "needs an output port of its own"));
            }
            if !(encoder_noise.is_finite() && *encoder_noise >= 0.0) {
                let item = format!("encoder noise on {port}");
                return Err(SpecError::new(item, "must not be below 0"));
            }
            used.push(*port);
        }
        for SensorMount { port, driver, pose, .. } in &self.sensors {
            let item = || format!("sensor {driver} on {port}");
            if SensorKind::named(driver).is_none() {
                return Err(SpecError::new(item(), "is of no known type"));
            }
            if port.is_output() || used.contains(port) {
                return Err(SpecError::new(item(), "needs an input port of its own"));
            }
            if !pose.is_finite() {
                return Err(SpecError::new(item(), "has a number that is not finite"));
            }
            used.push(*port);
        }
        Ok(())
    }
}
