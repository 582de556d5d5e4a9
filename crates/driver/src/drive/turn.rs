//! Turning a robot on the spot by its gyro.
//!
//! The wheels run against each other at a speed in proportion to the angle
//! that is left, down to a slow crawl. At the target they brake; once the robot
//! stands, the gyro says whether it overshot, and the rest is corrected, at a
//! crawl and a bounded number of times. So a turn ends within [`WITHIN`], or
//! reports why it does not; it never swings forever. It is given up as soon as
//! another thread has given a motor a command.
use crate::device::Device;
use crate::device::motion::End;
use crate::device::registry::Registry;
use crate::device::retry::while_permissions_settle;
use crate::error::{Error, Interrupted, Result};
use crate::motor::claim::Claim;
use crate::motor::{Speed, StopAction, find_all, prepare};
use crate::sensor;
use crate::sysfs::sleep;
use crate::value::Value;
use std::sync::Arc;
use std::time::Duration;

/// How close to the angle a turn ends, in degrees: the gyro's resolution.
pub const WITHIN: f64 = 1.0;

/// The gyro's mode in which it measures its angle.
const MODE: &str = "GYRO-ANG";

/// Time between two looks at the gyro.
const PERIOD: Duration = Duration::from_millis(10);

/// Rate of turn for each degree that is left, per second. With the gyro's and
/// the motors' lag of some 20 ms this slows down without overshooting.
const GAIN: f64 = 3.0;

/// The slowest rate of turn, in degrees per second. Slower, friction wins.
const CRAWL: f64 = 15.0;

/// How long the robot must stand still before its angle is believed.
const STANDSTILL: Duration = Duration::from_millis(100);

/// How long the gyro may show no progress.
const STUCK_FOR: Duration = Duration::from_secs(2);

/// How far the robot may turn the wrong way, in degrees.
const ASTRAY: f64 = 20.0;

/// The farthest turn, in degrees: the gyro counts with 16 bits.
const FARTHEST: f64 = 32_767.0;

/// How often the turn is corrected.
const CORRECTIONS: u32 = 5;

/// The robot and the turn to make.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Port of the left motor.
    pub left: String,
    /// Port of the right motor.
    pub right: String,
    /// 1, or -1 for a motor that is mounted the other way round.
    pub signs: [i64; 2],
    /// The fastest the wheels turn; its sign is ignored.
    pub speed: Speed,
    /// Degrees to turn, clockwise positive.
    pub degrees: f64,
    /// Degrees that a wheel turns for a degree of the robot: axle length by
    /// wheel diameter.
    pub gearing: f64,
}

/// How a turn ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Ended {
    /// Within a degree of the target.
    Reached,
    /// The gyro showed no movement.
    Stalled,
    /// The gyro counted the other way.
    Astray,
    /// Corrected as often as is sensible, and still off by this many degrees.
    Missed(f64),
    /// Another thread stopped a motor, or gave it another command.
    Stopped,
}

/// Turns a robot on the spot. `None` if a motor or the gyro is absent, the
/// speed is 0 or beyond the motors', the angle beyond what the gyro counts, or
/// the gearing no number.
///
/// Its zero does not matter: the gyro is read at the start, and not reset.
///
/// # Errors
/// The kernel's; [`Error::Unplugged`] when a device is unplugged under way;
/// [`Error::Interrupted`]. Both motors are stopped before, unless they obey
/// another thread by then.
pub fn by_gyro(
    registry: &Registry,
    gyro: &Arc<Device>,
    turn: &Turn,
    interrupted: Interrupted,
) -> Result<Option<Ended>> {
    if turn.degrees.is_nan() || turn.degrees.abs() > FARTHEST || !turn.gearing.is_finite() {
        return Ok(None);
    }
    let ports = [turn.left.as_str(), turn.right.as_str()];
    let motors = while_permissions_settle(registry, &mut *interrupted, || {
        let motors = find_all(registry, ports)?;
        motors.iter().try_for_each(|motors| prepare(motors)).map(|()| motors)
    })?;
    let Some(motors) = motors else {
        return Ok(None);
    };
    let Some(fastest) = fastest(&motors, turn.speed)? else {
        return Ok(None);
    };
    let Some(start) = angle(registry, gyro, interrupted)? else {
        return Ok(None);
    };
    let per_degree = counts_per_degree(&motors)? * turn.gearing;
    let mut control = Control {
        registry,
        gyro,
        motors: &motors,
        signs: turn.signs,
        per_degree,
        fastest,
        claim: Claim::new(),
        running: None,
    };
    control.take_motors();
    let ended = control.turn_to(start, start + turn.degrees, interrupted);
    let stopped = control.claim.stop_all(&motors, StopAction::Brake);
    let ended = ended.and_then(|ended| stopped.map(|()| ended));
    ended.map(Some).map_err(|error| control.named(error))
}

/// The robot's angle in degrees once the gyro can measure it; `None` where the
/// gyro is gone.
fn angle(registry: &Registry, gyro: &Arc<Device>, interrupted: Interrupted) -> Result<Option<f64>> {
    Ok(sensor::read(registry, gyro, Some(MODE), 0, interrupted)?.as_ref().map(degrees))
}

fn degrees(angle: &Value) -> f64 {
    match angle {
        #[expect(clippy::cast_precision_loss, reason = "a gyro's angle has 16 bits")]
        Value::Integer(degrees) => *degrees as f64,
        Value::Float(degrees) => *degrees,
        Value::Text(_) => f64::NAN,
    }
}

/// The wheels' fastest speed in counts per second.
fn fastest(motors: &[Arc<Device>], speed: Speed) -> Result<Option<f64>> {
    let mut slowest = f64::INFINITY;
    for motor in motors {
        match speed.in_counts(motor)? {
            None | Some(0) => return Ok(None),
            #[expect(clippy::cast_precision_loss, reason = "a speed in range is small")]
            Some(counts) => slowest = slowest.min(counts.abs() as f64),
        }
    }
    Ok(slowest.is_finite().then_some(slowest))
}

/// The wheels' tacho counts for a degree. Both are of one type.
#[expect(clippy::cast_precision_loss, reason = "a rotation has a few hundred counts")]
fn counts_per_degree(motors: &[Arc<Device>]) -> Result<f64> {
    let counts = motors.first().map(|motor| motor.constant("count_per_rot")).transpose()?;
    Ok(counts.map_or(1.0, |counts| counts as f64 / 360.0))
}

struct Control<'a> {
    registry: &'a Registry,
    gyro: &'a Arc<Device>,
    motors: &'a [Arc<Device>],
    signs: [i64; 2],
    /// Tacho counts of a wheel for a degree of the robot.
    per_degree: f64,
    /// The fastest speed of a wheel, in counts per second.
    fastest: f64,
    /// The turn's claim to the motors.
    claim: Claim,
    /// The last commanded speed of the left wheel.
    running: Option<i64>,
}

impl Control<'_> {
    fn take_motors(&self) {
        for motor in self.motors {
            self.claim.take(motor);
            motor.started();
        }
    }

    fn turn_to(&mut self, start: f64, target: f64, interrupted: Interrupted) -> Result<Ended> {
        let mut slowest_only = false;
        for _ in 0..=CORRECTIONS {
            if let Some(failed) = self.approach(start, target, slowest_only, interrupted)? {
                return Ok(failed);
            }
            let Some(settled) = self.settled(interrupted)? else {
                return Ok(Ended::Stopped);
            };
            if (target - settled).abs() <= WITHIN {
                return Ok(Ended::Reached);
            }
            slowest_only = true;
        }
        Ok(Ended::Missed(target - self.angle()?))
    }

    /// Turns until the target is reached or passed, and brakes there.
    fn approach(
        &mut self,
        start: f64,
        target: f64,
        slowest_only: bool,
        interrupted: Interrupted,
    ) -> Result<Option<Ended>> {
        let mut angle = self.angle()?;
        let direction = (target - angle).signum();
        let whole = (target - start).signum();
        let mut moved = (angle, self.now());
        while (target - angle) * direction > WITHIN / 2.0 {
            let rate =
                if slowest_only { CRAWL } else { ((target - angle) * GAIN).abs().max(CRAWL) };
            if !self.run(rate * direction)? || !self.pass(interrupted)? {
                return Ok(Some(Ended::Stopped));
            }
            angle = self.angle()?;
            if (angle - moved.0).abs() >= WITHIN {
                moved = (angle, self.now());
            }
            if self.now().saturating_sub(moved.1) >= STUCK_FOR {
                return Ok(Some(Ended::Stalled));
            }
            if (start - angle) * whole >= ASTRAY {
                return Ok(Some(Ended::Astray));
            }
        }
        Ok((!self.run(0.0)?).then_some(Ended::Stopped))
    }

    /// The angle once it no longer changes; `None` if the motors are no longer
    /// ours.
    fn settled(&self, interrupted: Interrupted) -> Result<Option<f64>> {
        let mut angle = self.angle()?;
        let (mut since, limit) = (self.now(), self.now() + STUCK_FOR);
        while self.now().saturating_sub(since) < STANDSTILL && self.now() < limit {
            if !self.pass(interrupted)? {
                return Ok(None);
            }
            let next = self.angle()?;
            if (next - angle).abs() >= WITHIN {
                (angle, since) = (next, self.now());
            }
        }
        self.angle().map(Some)
    }

    /// Turns the robot at a rate in degrees per second, clockwise positive; 0
    /// brakes. Writes nothing where nothing changes. `false` if a motor is no
    /// longer ours.
    fn run(&mut self, rate: f64) -> Result<bool> {
        let counts = (rate * self.per_degree).clamp(-self.fastest, self.fastest).round();
        #[expect(clippy::cast_possible_truncation, reason = "clamped to a motor's speed")]
        let counts = counts as i64;
        if self.running == Some(counts) {
            return Ok(true);
        }
        if counts != 0 {
            for (motor, sign) in self.motors.iter().zip([self.signs[0], -self.signs[1]]) {
                motor.write_number("speed_sp", sign * counts)?;
            }
        }
        for motor in self.motors {
            let is_ours = if counts == 0 {
                self.claim.brake(motor)?
            } else {
                self.claim.start(motor, "run-forever", End::Never)?
            };
            if !is_ours {
                return Ok(false);
            }
        }
        self.running = Some(counts);
        Ok(true)
    }

    /// Lets the robot turn on for a moment. `false` if a motor is no longer ours
    /// after that.
    fn pass(&self, interrupted: Interrupted) -> Result<bool> {
        sleep(self.registry.tree(), PERIOD, interrupted)?;
        for device in self.motors.iter().chain([self.gyro]) {
            if !self.registry.has(device)? {
                return Err(device.unplugged());
            }
        }
        Ok(self.motors.iter().all(|motor| self.claim.holds(motor)))
    }

    /// The robot's angle. While it turns there is no time to wait for a gyro
    /// that has lost contact, and after that its angle would be another.
    fn angle(&self) -> Result<f64> {
        sensor::read_value(self.gyro, Some(MODE), 0).map(|angle| degrees(&angle))
    }

    /// The error with the device that is gone, where one is.
    fn named(&self, error: Error) -> Error {
        let mut devices = self.motors.iter().chain([self.gyro]);
        let path = error.path().filter(|_| error.is_stale());
        match path.and_then(|path| devices.find(|device| path.starts_with(device.path()))) {
            Some(gone) => gone.unplugged(),
            None => error,
        }
    }

    fn now(&self) -> Duration {
        self.registry.tree().now()
    }
}
