//! Turning a robot on the spot by its gyro.
//!
//! The wheels run against each other at a speed in proportion to the angle
//! that is left, down to a slow crawl. At the target they brake; once the robot
//! stands, the gyro says whether it overshot, and the rest is corrected, at a
//! crawl and a bounded number of times. So a turn ends within [`WITHIN`], or
//! tells why it does not; it never swings for ever.
use crate::Interrupted;
use crate::device::Device;
use crate::devices::Devices;
use crate::error::{Error, Result};
use crate::motor::{Run, Speed, StopAction, find_all, run_forever, stop_all};
use crate::sensor;
use crate::value::Value;
use crate::wait::sleep;
use std::sync::Arc;
use std::time::Duration;

/// How close to the angle a turn ends, in degrees: the gyro's resolution.
pub const WITHIN: f64 = 1.0;

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

/// How often the turn is corrected.
const CORRECTIONS: u32 = 5;

/// The robot and the turn to make.
#[derive(Clone, Debug)]
pub struct Turn {
    /// Port of the left motor.
    pub left: String,
    /// Port of the right motor.
    pub right: String,
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
}

/// Turns a robot on the spot. `None` if a motor or the gyro is absent, or the
/// speed is 0 or beyond the motors'.
///
/// Its zero does not matter: the gyro is read at the start, and not reset.
///
/// # Errors
/// The kernel's; [`Error::Gone`] when a device is unplugged under way;
/// [`Error::Interrupted`]. Both motors are stopped before.
pub fn by_gyro(
    devices: &Devices,
    gyro: &Arc<Device>,
    turn: &Turn,
    interrupted: Interrupted,
) -> Result<Option<Ended>> {
    let ports = [turn.left.as_str(), turn.right.as_str()];
    let Some(motors) = devices.afresh(|| find_all(devices, ports))? else {
        return Ok(None);
    };
    let Some(fastest) = fastest(&motors, turn.speed)? else {
        return Ok(None);
    };
    let Some(start) = angle(devices, gyro, interrupted)? else {
        return Ok(None);
    };
    let mut control = Control { devices, gyro, motors: &motors, turn, fastest, running: None };
    let ended = control.turn_to(start, start + turn.degrees, interrupted);
    let stopped = stop_all(&motors, StopAction::Brake);
    let ended = ended?;
    stopped?;
    Ok(Some(ended))
}

/// The robot's angle in degrees; `None` where the gyro is gone.
fn angle(devices: &Devices, gyro: &Arc<Device>, interrupted: Interrupted) -> Result<Option<f64>> {
    let angle = sensor::read(devices, gyro, Some("GYRO-ANG"), 0, interrupted)?;
    Ok(angle.map(|angle| match angle {
        #[expect(clippy::cast_precision_loss, reason = "a gyro's angle has 16 bits")]
        Value::Integer(degrees) => degrees as f64,
        Value::Float(degrees) => degrees,
        Value::Text(_) => f64::NAN,
    }))
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

struct Control<'a> {
    devices: &'a Devices,
    gyro: &'a Arc<Device>,
    motors: &'a [Arc<Device>],
    turn: &'a Turn,
    /// The fastest speed of a wheel, in counts per second.
    fastest: f64,
    /// What the left wheel was last told to do.
    running: Option<i64>,
}

impl Control<'_> {
    fn turn_to(&mut self, start: f64, target: f64, interrupted: Interrupted) -> Result<Ended> {
        let mut slowest_only = false;
        for _ in 0..=CORRECTIONS {
            if let Some(failed) = self.approach(start, target, slowest_only, interrupted)? {
                return Ok(failed);
            }
            if (target - self.settled(interrupted)?).abs() <= WITHIN {
                return Ok(Ended::Reached);
            }
            slowest_only = true;
        }
        Ok(Ended::Missed(target - self.angle(interrupted)?))
    }

    /// Turns until the target is reached or passed, and brakes there.
    fn approach(
        &mut self,
        start: f64,
        target: f64,
        slowest_only: bool,
        interrupted: Interrupted,
    ) -> Result<Option<Ended>> {
        let mut angle = self.angle(interrupted)?;
        let direction = (target - angle).signum();
        let whole = (target - start).signum();
        let mut moved = (angle, self.now());
        while (target - angle) * direction > WITHIN / 2.0 {
            let rate =
                if slowest_only { CRAWL } else { ((target - angle) * GAIN).abs().max(CRAWL) };
            self.run(rate * direction)?;
            sleep(self.devices, PERIOD, interrupted)?;
            angle = self.angle(interrupted)?;
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
        self.run(0.0)?;
        Ok(None)
    }

    /// The angle once it no longer changes.
    fn settled(&self, interrupted: Interrupted) -> Result<f64> {
        let mut angle = self.angle(interrupted)?;
        let (mut since, limit) = (self.now(), self.now() + STUCK_FOR);
        while self.now().saturating_sub(since) < STANDSTILL && self.now() < limit {
            sleep(self.devices, PERIOD, interrupted)?;
            let next = self.angle(interrupted)?;
            if (next - angle).abs() >= WITHIN {
                (angle, since) = (next, self.now());
            }
        }
        self.angle(interrupted)
    }

    /// Turns the robot at a rate in degrees per second, clockwise positive; 0
    /// brakes. Writes nothing where nothing changes.
    fn run(&mut self, rate: f64) -> Result<()> {
        let counts = (rate * self.turn.gearing).clamp(-self.fastest, self.fastest).round();
        #[expect(clippy::cast_possible_truncation, reason = "clamped to a motor's speed")]
        let counts = counts as i64;
        if self.running == Some(counts) {
            return Ok(());
        }
        let speed = Speed::CountsPerSecond;
        let wheels = [
            Run { port: &self.turn.left, speed: speed(counts) },
            Run { port: &self.turn.right, speed: speed(-counts) },
        ];
        let is_present = if counts == 0 {
            stop_all(self.motors, StopAction::Brake)?;
            true
        } else {
            run_forever(self.devices, &wheels)?
        };
        self.running = Some(counts);
        // Their speeds are possible, so that it is a motor that is missing.
        if is_present { Ok(()) } else { Err(self.missing()) }
    }

    fn angle(&self, interrupted: Interrupted) -> Result<f64> {
        let angle = angle(self.devices, self.gyro, interrupted)?;
        angle.ok_or_else(|| self.gyro.gone())
    }

    fn missing(&self) -> Error {
        let is_missing = |motor: &&Arc<Device>| !self.devices.has(motor).unwrap_or(false);
        self.motors.iter().find(is_missing).unwrap_or(self.gyro).gone()
    }

    fn now(&self) -> Duration {
        self.devices.tree().now()
    }
}
