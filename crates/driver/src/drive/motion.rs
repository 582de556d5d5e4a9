//! A motion under way: the commands to the wheels, and how it ends.
use crate::device::Device;
use crate::device::motion::End;
use crate::drive::devices::DriveDevices;
use crate::drive::steering::Steering;
use crate::error::Result;
use crate::journal::{Course, Origin};
use crate::motor::claim::Claim;
use crate::motor::wait::{Reason, has};
use crate::motor::{Ramps, StopAction};
use ev3_os::locked;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The period of the control.
pub const PERIOD: Duration = Duration::from_millis(20);

/// How long a wheel that is to turn may stand still.
const STUCK_FOR: Duration = Duration::from_millis(1500);

/// By how many counts it should have turned meanwhile: a wheel that is to turn slowly
/// may stand longer.
const STUCK_OWES: f64 = 37.0;

/// Upper bound on the interval that counts towards a stall. After a longer gap we
/// do not know whether the wheel moved, and a sample delayed between reading the
/// encoder and the clock pairs an old count with a new time.
pub(super) const LONGEST_LOOK: Duration = Duration::from_millis(100);

/// Less movement than this, in counts, is standing still.
const STUCK_WITHIN: u64 = 2;

/// Less than this, in counts per second, is not a speed.
const SLOWEST: f64 = 0.05;

/// Speed of the wheels on their last counts, per second.
const LANDING_SPEED: i64 = 100;

/// How long the wheels may take for their last counts.
const LANDING_TAKES: Duration = Duration::from_millis(800);

/// How far from its target a wheel may land, in counts.
const LANDED_WITHIN: u64 = 1;

/// The same if it takes too long.
const LANDED_SOMEHOW: u64 = 5;

/// A motion under way.
pub(super) struct ActiveMotion {
    pub(super) claim: Claim,
    pub(super) motors: Vec<Arc<Device>>,
    pub(super) steering: Steering,
    pub(super) stop_action: StopAction,
    /// When its last period was done.
    pub(super) controlled: Duration,
    /// When the steering last did a step.
    pub(super) steered: Duration,
    /// The last commanded speeds, in counts per second.
    pub(super) speeds: Option<[i64; 2]>,
    pub(super) landing: Option<Landing>,
    pub(super) stuck: [Stuck; 2],
    pub(super) outcome: Arc<Outcome>,
    /// Its course in the journal.
    pub(super) noted: Option<(Origin, Arc<Course>)>,
    /// Put back when the motion ends.
    pub(super) _ramps: Ramps,
}

/// For how long a wheel that is to turn one way has stood still, and by how many
/// counts it should have turned meanwhile.
#[derive(Clone, Copy)]
pub(super) struct Stuck {
    count: i64,
    way: i64,
    stood: Duration,
    owed: f64,
}

impl Stuck {
    /// A wheel that may turn.
    pub(super) fn new(count: i64) -> Self {
        Self { count, way: 0, stood: Duration::ZERO, owed: 0.0 }
    }
}

/// The wheels go to their last counts.
pub(super) struct Landing {
    pub(super) targets: [i64; 2],
    pub(super) took: Duration,
    pub(super) before: [i64; 2],
    /// How long they have stood there.
    pub(super) stood: Duration,
}

/// How a motion ended, once it has.
#[derive(Default)]
pub struct Outcome(Mutex<Option<Result<Reason>>>);

impl Outcome {
    pub(super) fn stopped() -> Arc<Self> {
        Arc::new(Self(Mutex::new(Some(Ok(Reason::Stopped)))))
    }

    pub(super) fn end(&self, result: Result<Reason>) {
        locked(&self.0).get_or_insert(result);
    }

    /// The result, once there is one. Only the first caller gets an error.
    pub(super) fn ended(&self) -> Option<Result<Reason>> {
        let mut outcome = locked(&self.0);
        let after = match outcome.as_ref()? {
            Ok(reason) => *reason,
            Err(error) if error.is_unplugged() => Reason::Unplugged,
            Err(_) => Reason::Stopped,
        };
        outcome.replace(Ok(after))
    }
}

/// A time in seconds. The standard library's divides, which the brick's processor does in software.
pub(super) fn seconds(time: Duration) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "no robot drives for so long")]
    let whole = time.as_secs() as f64;
    whole + f64::from(time.subsec_nanos()) * 1e-9
}

#[expect(clippy::cast_possible_truncation, reason = "a motor's speed or a short way")]
fn whole(counts: f64) -> i64 {
    counts.round() as i64
}

/// A speed in whole counts per second. A wheel that is to turn does: with both at 0 a
/// slow robot would stand before its end forever.
fn least(speed: f64) -> i64 {
    let rounded = whole(speed);
    if rounded == 0 && speed.abs() > SLOWEST { whole(speed.signum()) } else { rounded }
}

impl ActiveMotion {
    /// Commands the speeds of the wheels, in cm/s. `passed` is the time since the last sample.
    pub(super) fn roll(
        &mut self,
        devices: &DriveDevices,
        ways: [f64; 2],
        passed: Duration,
    ) -> Result<Option<Reason>> {
        let mut wanted = devices.in_counts(ways);
        // Too fast for one is too fast for both: the curve stays the same.
        let most = wanted[0].abs().max(wanted[1].abs());
        if most > devices.fastest {
            wanted = wanted.map(|speed| speed * (devices.fastest / most));
        }
        let speeds = wanted.map(least);
        if self.is_stuck(devices, speeds, passed) {
            return Ok(Some(Reason::Stalled));
        }
        if self.is_foreign(devices) {
            return Ok(Some(Reason::Stopped));
        }
        if self.speeds == Some(speeds) {
            return Ok(None);
        }
        for (motor, speed) in devices.motors.iter().zip(speeds) {
            motor.write_number("speed_sp", speed)?;
        }
        for motor in &devices.motors {
            if !self.claim.start(motor, "run-forever", End::Never)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = Some(speeds);
        Ok(None)
    }

    /// Makes the wheels roll by the last few counts.
    pub(super) fn land(
        &mut self,
        devices: &DriveDevices,
        ways: [f64; 2],
    ) -> Result<Option<Reason>> {
        let by = devices.in_counts(ways).map(whole);
        let targets = [devices.counts[0] + by[0], devices.counts[1] + by[1]];
        for (motor, target) in devices.motors.iter().zip(targets) {
            motor.write_number("position_sp", target)?;
            motor.write_number("speed_sp", LANDING_SPEED)?;
        }
        for (side, motor) in devices.motors.iter().enumerate() {
            let end = End::Position { from: devices.counts[side], target: targets[side] };
            if !self.claim.start(motor, "run-to-abs-pos", end)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = None;
        self.landing = Some(Landing {
            targets,
            took: Duration::ZERO,
            before: devices.counts,
            stood: Duration::ZERO,
        });
        Ok(None)
    }

    /// Whether a wheel that should turn stands still.
    #[expect(clippy::cast_precision_loss, reason = "a motor's speed is small")]
    fn is_stuck(&mut self, devices: &DriveDevices, speeds: [i64; 2], passed: Duration) -> bool {
        let mut is_stuck = false;
        for (side, wheel) in self.stuck.iter_mut().enumerate() {
            let (count, way) = (devices.counts[side], speeds[side].signum());
            let is_still = count.abs_diff(wheel.count) < STUCK_WITHIN && way == wheel.way;
            if is_still {
                wheel.stood += passed;
                wheel.owed += speeds[side].abs() as f64 * seconds(passed);
            } else {
                *wheel = Stuck { way, ..Stuck::new(count) };
            }
            is_stuck |= wheel.stood >= STUCK_FOR && wheel.owed >= STUCK_OWES;
        }
        is_stuck
    }

    /// Ends the motion at its goal. The kernel holds a wheel only at the very count:
    /// one that something keeps from it would be pushed forever.
    pub(super) fn hold(&self) -> Result<()> {
        // Controllers on I2C go on running while they hold.
        let pushes = |state: &str| has(state, "running") && !has(state, "holding");
        for motor in &self.motors {
            if motor.with_word("state", pushes)? {
                let here = motor.number("position")?;
                self.claim.start(motor, "stop", End::Position { from: here, target: here })?;
            }
        }
        Ok(())
    }

    /// Whether another command has ended the claim to a motor.
    pub(super) fn is_foreign(&self, devices: &DriveDevices) -> bool {
        devices.motors.iter().any(|motor| !self.claim.holds(motor))
    }
}

pub(super) enum Landed {
    NotYet,
    There,
    Never,
}

impl Landing {
    pub(super) fn look(&mut self, counts: [i64; 2], passed: Duration) -> Landed {
        let off = |side: usize| counts[side].abs_diff(self.targets[side]);
        let farthest = off(0).max(off(1));
        let stood = std::mem::replace(&mut self.before, counts) == counts;
        self.stood = if stood { self.stood + passed } else { Duration::ZERO };
        // Two samples may follow each other at once.
        let stands = self.stood >= PERIOD / 2;
        self.took += passed;
        if farthest <= LANDED_WITHIN && stands && self.took >= PERIOD * 2 {
            Landed::There
        } else if self.took < LANDING_TAKES || !stands {
            Landed::NotYet
        } else if farthest <= LANDED_SOMEHOW {
            Landed::There
        } else {
            Landed::Never
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn landing() -> Landing {
        Landing { targets: [100, 100], took: Duration::ZERO, before: [0, 0], stood: Duration::ZERO }
    }

    #[test]
    fn wheels_that_stand_on_their_counts_are_there() {
        let mut landing = landing();
        assert!(matches!(landing.look([100, 99], PERIOD), Landed::NotYet));
        assert!(matches!(landing.look([100, 99], PERIOD), Landed::There));
    }

    #[test]
    fn wheels_that_stand_elsewhere_never_get_there() {
        let mut landing = landing();
        let looks = (0..50).map(|_| landing.look([50, 50], PERIOD));
        let before = looks.take_while(|landed| matches!(landed, Landed::NotYet)).count();
        assert_eq!(before, 39, "in 800 ms");
        assert!(matches!(landing.look([50, 50], PERIOD), Landed::Never));
    }

    #[test]
    fn wheels_that_turn_do_not_stand_because_two_looks_follow_each_other() {
        let mut landing = landing();
        for count in 0..90 {
            assert!(matches!(landing.look([count, count], PERIOD), Landed::NotYet));
            let at_once = landing.look([count, count], PERIOD / 20);
            assert!(matches!(at_once, Landed::NotYet), "at {count}");
        }
    }
}
