//! A motion under way: how it begins, what the wheels are told, how it ends.
use super::devices::Found;
use super::{Course, DriveOptions, Inner, PERIOD};
use crate::device::Device;
use crate::device::motion::End;
use crate::drive::steering::{Limits, Order, Steering};
use crate::error::{Error, Result};
use crate::motor::claim::Claim;
use crate::motor::wait::Reason;
use crate::motor::{self, Ramps, Speed, StopAction};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// How long a wheel that is to turn may stand still.
const STUCK_FOR: Duration = Duration::from_millis(1500);

/// At most so much of the time between two looks counts as standing still: what
/// nobody looked at may have moved, and a look that was held up between reading
/// a wheel and the clock tells an old count at a new time.
const LONGEST_LOOK: Duration = Duration::from_millis(100);

/// Less movement than this, in counts, is standing still.
const STUCK_WITHIN: u64 = 2;

/// Speed of the wheels on their last counts, per second.
const LANDING_SPEED: i64 = 100;

/// How long the wheels may take for their last counts.
const LANDING_TAKES: Duration = Duration::from_millis(800);

/// How far from its target a wheel may land, in counts.
const LANDED_WITHIN: u64 = 1;

/// The same if it takes too long.
const LANDED_SOMEHOW: u64 = 5;

/// A motion under way.
pub(super) struct Job {
    claim: Claim,
    motors: Vec<Arc<Device>>,
    steering: Steering,
    stop_action: StopAction,
    /// When its last period was done.
    controlled: Duration,
    /// When the steering was last asked.
    steered: Duration,
    /// What the wheels were last told, in counts per second.
    speeds: Option<[i64; 2]>,
    landing: Option<Landing>,
    /// Counts, and how long each wheel has stood there.
    stuck: [(i64, Duration); 2],
    pub(super) status: Arc<Status>,
    /// Put back when the motion ends.
    _ramps: Ramps,
}

/// The wheels go to their last counts.
struct Landing {
    targets: [i64; 2],
    took: Duration,
    before: [i64; 2],
    /// How long they have stood there.
    stood: Duration,
}

/// How a motion ended, once it has.
#[derive(Default)]
pub struct Status(Mutex<Option<Result<Reason>>>);

impl Status {
    fn stopped() -> Arc<Self> {
        Arc::new(Self(Mutex::new(Some(Ok(Reason::Stopped)))))
    }

    fn end(&self, result: Result<Reason>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(result);
    }

    /// What it ended with; an error for the first who asks.
    pub(super) fn ended(&self) -> Option<Result<Reason>> {
        let mut status = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let after = match status.as_ref()? {
            Ok(reason) => *reason,
            Err(error) if error.is_gone() => Reason::Unplugged,
            Err(_) => Reason::Stopped,
        };
        status.replace(Ok(after))
    }
}

impl Inner {
    pub(super) fn begin(
        &mut self,
        course: &Course,
        options: &DriveOptions,
    ) -> Result<Option<Arc<Status>>> {
        let Some(found) = &self.found else {
            return Ok(None);
        };
        let wheels = self.robot.wheels;
        let slowest =
            found.cm_per_count.iter().fold(f64::INFINITY, |least, way| way.abs().min(least));
        let fastest = found.fastest * slowest;
        let percent = found
            .motors
            .iter()
            .map(|motor| Speed::Percent(options.percent).in_counts(motor))
            .collect::<Result<Option<Vec<_>>>>()?;
        let Some([left, right]) = percent.as_deref() else {
            return Ok(None);
        };
        let speed = left.abs().min(right.abs());
        #[expect(clippy::cast_precision_loss, reason = "a motor's speed is small")]
        let limits = Limits { speed: speed as f64 * slowest, acceleration: options.acceleration };
        let steering = match course {
            Course::Wheels(shares) => {
                let (way, turn) = wheels.twist(shares.map(|share| share * limits.speed));
                Steering::cruise(wheels, limits, way, turn.to_degrees())
            }
            Course::Cruise(speed, rate) | Course::Change(speed, rate) => {
                let ways = wheels.ways(*speed, rate.to_radians());
                let is_possible = ways.iter().all(|way| way.abs() <= fastest * 1.000_001);
                if !is_possible {
                    return Ok(None);
                }
                Steering::cruise(wheels, limits, *speed, *rate)
            }
            Course::Legs(legs, is_backwards) => {
                if speed == 0 {
                    return Ok(None);
                }
                let from = (self.estimate.pose(), self.goal);
                Steering::along(wheels, limits, *is_backwards, legs.clone(), from)
            }
        };
        if let Course::Change(..) = course {
            return Ok(Some(self.change(steering)));
        }
        self.install(steering, options.stop_action).map(Some)
    }

    /// Makes the motion under way another one. What has ended stays so: it is
    /// the end of that which is told.
    fn change(&mut self, mut steering: Steering) -> Arc<Status> {
        if let Some(job) = &mut self.job {
            steering.take_over(&job.steering);
            job.steering = steering;
            job.landing = None;
        }
        Arc::clone(self.last.get_or_insert_with(Status::stopped))
    }

    /// Puts a motion in the place of the one under way.
    fn install(&mut self, mut steering: Steering, stop_action: StopAction) -> Result<Arc<Status>> {
        let before = self.job.take();
        if let Some(before) = &before {
            steering.take_over(&before.steering);
            before.status.end(Ok(Reason::Stopped));
        }
        // Its ramps are put back first.
        drop(before);
        let claim = Claim::new();
        let status = Arc::new(Status::default());
        let Some(found) = &self.found else {
            return Ok(status);
        };
        let options = motor::MoveOptions {
            ramp_up_ms: Some(0),
            ramp_down_ms: Some(0),
            ..motor::MoveOptions::default()
        };
        let mut ramps = Ramps::default();
        for motor in &found.motors {
            ramps.set(motor, &options)?;
            motor.write("stop_action", StopAction::Hold.word())?;
            claim.take(motor);
        }
        self.last = Some(Arc::clone(&status));
        self.goal = None;
        self.job = Some(Job {
            claim,
            motors: found.motors.clone(),
            steering,
            stop_action,
            controlled: self.now,
            steered: self.now.saturating_sub(PERIOD),
            speeds: None,
            landing: None,
            stuck: found.counts.map(|count| (count, Duration::ZERO)),
            status: Arc::clone(&status),
            _ramps: ramps,
        });
        Ok(status)
    }

    /// One period of the motion under way; `Some` when it has ended.
    pub(super) fn control(&mut self) -> Result<Option<Reason>> {
        let (Some(job), Some(found)) = (&mut self.job, &self.found) else {
            return Ok(None);
        };
        let passed = self.now.saturating_sub(job.controlled).min(LONGEST_LOOK);
        job.controlled = self.now;
        let pose = self.estimate.pose();
        let order = match &mut job.landing {
            Some(landing) => match landing.look(found.counts, passed) {
                Landed::NotYet => return Ok(job.is_foreign(found).then_some(Reason::Stopped)),
                Landed::Never => return Ok(Some(Reason::Stalled)),
                Landed::There => {
                    job.landing = None;
                    job.stuck = found.counts.map(|count| (count, Duration::ZERO));
                    job.steering.landed(pose)
                }
            },
            None => None,
        };
        let seconds = self.now.saturating_sub(job.steered).as_secs_f64().clamp(0.001, 0.1);
        job.steered = self.now;
        let order = match order {
            Some(order) => order,
            None => job.steering.step(pose, seconds),
        };
        match order {
            Order::Arrived => Ok(Some(Reason::Reached)),
            Order::Roll(ways) => job.roll(found, ways, passed),
            Order::Land(ways) => job.land(found, ways),
        }
    }

    /// Does a period of the motion under way, if a whole one was left out.
    pub(super) fn catch_up(&mut self) {
        let missed = self.job.as_ref().map(|job| self.now.saturating_sub(job.controlled));
        if missed.is_some_and(|missed| missed >= PERIOD * 2) {
            let stepped = self.control();
            self.conclude(stepped);
        }
    }

    /// Ends the motion if its last period says so.
    pub(super) fn conclude(&mut self, stepped: Result<Option<Reason>>) {
        match stepped {
            Ok(None) => {}
            Ok(Some(reason)) => self.end_job(Ok(reason)),
            Err(error) => {
                let error = self.named(error);
                self.end_job(Err(error));
            }
        }
    }

    pub(super) fn end_job(&mut self, result: Result<Reason>) {
        let Some(job) = self.job.take() else {
            return;
        };
        let is_reached = matches!(result, Ok(Reason::Reached));
        if is_reached {
            self.goal = job.steering.goal();
        }
        let action = if is_reached { job.stop_action } else { StopAction::Brake };
        if !(is_reached && action == StopAction::Hold) {
            for motor in &job.motors {
                // One that is gone has nothing to stop.
                let _ = job.claim.stop(motor, action);
            }
        }
        job.status.end(result);
    }

    /// The error with the device that is gone, where one is.
    fn named(&self, error: Error) -> Error {
        if !error.is_stale() {
            return error;
        }
        let devices = self.job.as_ref().map(|job| job.motors.iter());
        let path = error.path();
        match devices.into_iter().flatten().find(|d| path.is_some_and(|p| p.starts_with(d.path())))
        {
            Some(gone) => gone.gone(),
            None => error,
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a motor's speed or a short way")]
fn whole(counts: f64) -> i64 {
    counts.round() as i64
}

impl Job {
    /// Tells the wheels their speeds in cm/s. So much time has passed since they
    /// were last looked at.
    fn roll(&mut self, found: &Found, ways: [f64; 2], passed: Duration) -> Result<Option<Reason>> {
        let wanted = found.in_counts(ways);
        // Too fast for one is too fast for both: the curve stays the same.
        let most = wanted[0].abs().max(wanted[1].abs());
        let share = if most > found.fastest { found.fastest / most } else { 1.0 };
        let speeds = wanted.map(|speed| whole(speed * share));
        if self.is_stuck(found, speeds, passed) {
            return Ok(Some(Reason::Stalled));
        }
        if self.is_foreign(found) {
            return Ok(Some(Reason::Stopped));
        }
        if self.speeds == Some(speeds) {
            return Ok(None);
        }
        for (motor, speed) in found.motors.iter().zip(speeds) {
            motor.write_number("speed_sp", speed)?;
        }
        for motor in &found.motors {
            if !self.claim.start(motor, "run-forever", End::Never)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = Some(speeds);
        Ok(None)
    }

    /// Makes the wheels roll by the last few counts.
    fn land(&mut self, found: &Found, ways: [f64; 2]) -> Result<Option<Reason>> {
        let by = found.in_counts(ways).map(whole);
        let targets = [found.counts[0] + by[0], found.counts[1] + by[1]];
        for (motor, target) in found.motors.iter().zip(targets) {
            motor.write_number("position_sp", target)?;
            motor.write_number("speed_sp", LANDING_SPEED)?;
        }
        for (side, motor) in found.motors.iter().enumerate() {
            let end = End::Position { from: found.counts[side], target: targets[side] };
            if !self.claim.start(motor, "run-to-abs-pos", end)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = None;
        self.landing = Some(Landing {
            targets,
            took: Duration::ZERO,
            before: found.counts,
            stood: Duration::ZERO,
        });
        Ok(None)
    }

    /// Whether a wheel that is to turn does not.
    fn is_stuck(&mut self, found: &Found, speeds: [i64; 2], passed: Duration) -> bool {
        let mut is_stuck = false;
        for (side, (count, stood)) in self.stuck.iter_mut().enumerate() {
            let is_still = found.counts[side].abs_diff(*count) < STUCK_WITHIN;
            if speeds[side].abs() < LANDING_SPEED / 4 || !is_still {
                (*count, *stood) = (found.counts[side], Duration::ZERO);
            } else {
                *stood += passed;
            }
            is_stuck |= *stood >= STUCK_FOR;
        }
        is_stuck
    }

    /// Whether somebody else has told a motor something.
    fn is_foreign(&self, found: &Found) -> bool {
        found.motors.iter().any(|motor| !self.claim.holds(motor))
    }
}

enum Landed {
    NotYet,
    There,
    Never,
}

impl Landing {
    fn look(&mut self, counts: [i64; 2], passed: Duration) -> Landed {
        let off = |side: usize| counts[side].abs_diff(self.targets[side]);
        let farthest = off(0).max(off(1));
        let stood = std::mem::replace(&mut self.before, counts) == counts;
        self.stood = if stood { self.stood + passed } else { Duration::ZERO };
        // Two looks may follow each other at once.
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
