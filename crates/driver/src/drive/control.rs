//! Odometry and control of one robot, one period at a time.
use crate::class::Class;
pub use crate::course::{Command, DriveOptions};
use crate::device::registry::Registry;
use crate::drive::agreement::Agreement;
use crate::drive::devices::{DriveDevices, Robot, angle, counts};
use crate::drive::motion::{ActiveMotion, LONGEST_LOOK, Landed, Outcome, PERIOD, Stuck, seconds};
use crate::drive::odometry::Estimate;
use crate::drive::steering::{Limits, Order, Steering};
use crate::drive::track::Track;
use crate::error::{Error, Result};
use crate::journal::{Act, Course, origin};
use crate::motor::claim::Claim;
use crate::motor::wait::Reason;
use crate::motor::{self, Ramps, Speed, StopAction};
use ev3_motion::Pose;
use std::sync::Arc;
use std::time::Duration;

/// How long the wheels must stand still to be at rest.
const AT_REST: Duration = Duration::from_secs(1);

/// The period while they are, in which the gyro's drift is measured.
const REST_PERIOD: Duration = Duration::from_millis(100);

/// How long that takes at most; then nothing is done until a motor is started.
const MEASURED: Duration = Duration::from_secs(30);

/// The farthest that a wheel can be commanded to turn, in counts: the kernel counts with 32 bits.
const MOST_COUNTS: f64 = 2_147_483_647.0;

/// The state of a robot and its motion.
pub(super) struct Inner {
    pub(super) robot: Robot,
    pub(super) devices: Option<DriveDevices>,
    pub(super) use_gyro: bool,
    /// The time of the last update of the estimate.
    pub(super) now: Duration,
    /// When the wheels last turned.
    pub(super) moved: Duration,
    pub(super) estimate: Estimate,
    /// The estimated pose when it was last set, and the one that it would have had otherwise.
    was_set: [Pose; 2],
    /// The pose when it was last corrected, and the estimated one.
    corrected: [Pose; 2],
    /// Whether the gyro follows the wheels in the motion under way.
    agreement: Agreement,
    /// The end of the previous motion.
    pub(super) goal: Option<Pose>,
    pub(super) active: Option<ActiveMotion>,
    pub(super) last: Option<Arc<Outcome>>,
    pub(super) track: Track,
}

impl Inner {
    /// A robot at the origin.
    pub(super) fn new(robot: &Robot) -> Self {
        let mut inner = Self {
            robot: robot.clone(),
            devices: None,
            use_gyro: true,
            now: Duration::ZERO,
            moved: Duration::ZERO,
            estimate: Estimate::default(),
            was_set: [Pose::default(); 2],
            corrected: [Pose::default(); 2],
            agreement: Agreement::default(),
            goal: None,
            active: None,
            last: None,
            track: Track::default(),
        };
        inner.set_pose(Pose::default());
        inner
    }

    /// Ends the motion of this robot, and goes on with another one at its pose.
    pub(super) fn set_robot(&mut self, robot: &Robot) {
        self.end_motion(Ok(Reason::Stopped));
        let pose = self.pose();
        self.robot = robot.clone();
        self.devices = None;
        self.goal = None;
        self.estimate.forget_wheels();
        self.set_pose(pose);
    }

    /// The pose of the robot's reference point.
    pub(super) fn pose(&self) -> Pose {
        let [corrected, estimated] = self.corrected;
        corrected.moved(estimated, self.estimated())
    }

    /// The pose of the middle of the axle.
    fn axle(&self) -> Pose {
        self.pose().ahead(self.robot.wheels.offset)
    }

    fn estimated(&self) -> Pose {
        self.estimate.pose().ahead(-self.robot.wheels.offset)
    }

    /// The pose goes on from another one. The estimate does not know: it has learnt how wheels
    /// and gyro err by how its own pose has become uncertain.
    pub(super) fn correct_pose(&mut self, pose: Pose) {
        self.corrected = [pose, self.estimated()];
    }

    /// The covariance of the pose.
    pub(super) fn uncertainty(&self) -> [[f64; 3]; 3] {
        let turn = self.corrected[0].heading - self.corrected[1].heading;
        let (sin, cos) = libm::sincos(turn.to_radians());
        let turned = [[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]];
        let rows = self.estimate.uncertainty();
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let pairs = (0..3).flat_map(|a| (0..3).map(move |b| (a, b)));
                pairs.map(|(a, b)| turned[i][a] * rows[a][b] * turned[j][b]).sum()
            })
        })
    }

    /// Where wheels and gyro have brought it, whatever poses have been set.
    pub(super) fn rolled(&self) -> Pose {
        let [set, rolled] = self.was_set;
        rolled.moved(set, self.estimated())
    }

    pub(super) fn set_pose(&mut self, pose: Pose) {
        self.was_set = [pose, self.rolled()];
        self.corrected = [Pose::default(); 2];
        self.estimate.set_pose(pose.ahead(self.robot.wheels.offset));
    }

    /// Updates the estimate to the present time. `false` where a motor is absent.
    pub(super) fn integrate(&mut self, registry: &Registry) -> Result<bool> {
        let before = self.now;
        if self.devices.as_ref().is_some_and(|devices| !devices.is_there()) {
            self.devices = None;
        }
        let is_new = self.devices.is_none();
        if is_new {
            self.devices = DriveDevices::find(registry, &self.robot)?;
            self.estimate.gyro_lost();
        }
        let Some(devices) = &mut self.devices else {
            return Ok(false);
        };
        let read = counts(&devices.motors);
        let now = registry.tree().now();
        let counts = match read {
            Ok(counts) => counts,
            Err(error) => {
                self.devices = None;
                return Err(error);
            }
        };
        self.now = now;
        if now < before {
            // A simulation that was put back to an earlier moment.
            devices.counts = counts;
            self.end_motion(Ok(Reason::Stopped));
            return Ok(true);
        }
        let seconds = if is_new { 0.0 } else { seconds(now.saturating_sub(before)) };
        let ways = devices.ways(counts, seconds);
        devices.counts = counts;
        if ways != [0.0, 0.0] || is_new {
            self.moved = now;
        }
        self.estimate.predict(&self.robot.wheels, ways, seconds);
        match devices.gyro.as_ref().filter(|_| self.use_gyro).map(angle) {
            Some(Ok(Some(angle))) => {
                let turn = |ways| self.robot.wheels.twist(ways).1.to_degrees();
                let [left, right] = ways;
                self.agreement.sample(now, turn(ways), turn([left, -right]), angle);
                self.estimate.observe_gyro(angle);
            }
            Some(Ok(None)) => self.estimate.gyro_lost(),
            Some(Err(error)) => {
                self.estimate.gyro_lost();
                let gone = devices
                    .gyro
                    .take_if(|gyro| error.is_unplugged() || gyro.check_present().is_err());
                if let (Some(gyro), true) = (gone, self.active.is_some()) {
                    return Err(gyro.unplugged());
                }
            }
            None => {}
        }
        if self.track.is_due(now) {
            let pose = self.pose();
            self.track.note(now, pose);
        }
        Ok(true)
    }

    /// The motor that is missing.
    pub(super) fn absent(&self, registry: &Registry) -> Error {
        let [left, right] = &self.robot.ports;
        let is_left = !matches!(registry.find(Class::TachoMotor, left), Ok(Some(_)));
        let port = crate::port_name::short(if is_left { left } else { right }).to_owned();
        Error::Unplugged { class: Class::TachoMotor, port }
    }

    /// The time to the next call; `None` if there is nothing to do until a motor is started.
    pub(super) fn next_call(&self) -> Option<Duration> {
        if self.active.is_some() {
            return Some(PERIOD);
        }
        let devices = self.devices.as_ref()?;
        let rests = self.now.saturating_sub(self.moved);
        if rests < AT_REST || devices.motors.iter().any(|motor| motor::runs_on(motor)) {
            Some(PERIOD)
        } else {
            (devices.gyro.is_some() && self.use_gyro && rests < MEASURED).then_some(REST_PERIOD)
        }
    }

    /// Begins a motion, or changes the one under way. `None` if that is impossible.
    pub(super) fn begin(
        &mut self,
        command: &Command,
        options: &DriveOptions,
    ) -> Result<Option<Arc<Outcome>>> {
        let Some(steering) = self.steering(command, options)? else {
            return Ok(None);
        };
        if let Command::Change(..) = command {
            return Ok(Some(self.change(steering)));
        }
        self.install(steering, options.stop_action).map(Some)
    }

    /// How to carry out a command; `None` if it is impossible.
    pub(super) fn steering(
        &self,
        command: &Command,
        options: &DriveOptions,
    ) -> Result<Option<Steering>> {
        let Some(devices) = &self.devices else {
            return Ok(None);
        };
        let wheels = self.robot.wheels;
        let slowest =
            devices.cm_per_count.iter().fold(f64::INFINITY, |least, way| way.abs().min(least));
        let fastest = devices.fastest * slowest;
        let percent = devices
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
        Ok(Some(match command {
            Command::Wheels(shares) => {
                let (way, turn) = wheels.twist(shares.map(|share| share * limits.speed));
                Steering::cruise(wheels, limits, way, turn.to_degrees())
            }
            Command::Cruise(speed, rate) | Command::Change(speed, rate) => {
                let ways = wheels.ways(*speed, rate.to_radians());
                let is_possible = ways.iter().all(|way| way.abs() <= fastest * 1.000_001);
                if !is_possible {
                    return Ok(None);
                }
                Steering::cruise(wheels, limits, *speed, *rate)
            }
            Command::Legs(legs, is_backwards) => {
                let from = self.axle();
                let longest = legs.iter().map(|leg| leg.wheels_roll(&wheels, from));
                let is_possible = longest.fold(0.0, f64::max) / slowest <= MOST_COUNTS;
                if speed == 0 || !is_possible {
                    return Ok(None);
                }
                let from = (from, self.goal);
                Steering::along(wheels, limits, *is_backwards, legs.clone(), from)
            }
        }))
    }

    /// Changes the motion under way. A motion that has ended stays ended: the
    /// outcome is that of the ended motion.
    fn change(&mut self, mut steering: Steering) -> Arc<Outcome> {
        if let Some(active) = &mut self.active {
            steering.take_over(&active.steering);
            active.steering = steering;
            active.landing = None;
        }
        Arc::clone(self.last.get_or_insert_with(Outcome::stopped))
    }

    /// Puts a motion in the place of the one under way.
    fn install(&mut self, mut steering: Steering, stop_action: StopAction) -> Result<Arc<Outcome>> {
        let before = self.active.take();
        if let Some(before) = &before {
            steering.take_over(&before.steering);
            before.outcome.end(Ok(Reason::Stopped));
        }
        // A wheel that is blocked stays so, however often the program begins a motion.
        let stuck = before.as_ref().map(|before| before.stuck);
        // Its ramps are put back first.
        drop(before);
        let claim = Claim::new();
        let outcome = Arc::new(Outcome::default());
        let Some(devices) = &self.devices else {
            return Ok(outcome);
        };
        let options = motor::MoveOptions {
            ramp_up_ms: Some(0),
            ramp_down_ms: Some(0),
            ..motor::MoveOptions::default()
        };
        let mut ramps = Ramps::default();
        for motor in &devices.motors {
            ramps.set(motor, &options)?;
            motor.write("stop_action", StopAction::Hold.word())?;
            claim.take(motor);
        }
        self.last = Some(Arc::clone(&outcome));
        self.goal = None;
        self.agreement = Agreement::default();
        self.active = Some(ActiveMotion {
            claim,
            motors: devices.motors.clone(),
            steering,
            stop_action,
            controlled: self.now,
            steered: self.now.saturating_sub(PERIOD),
            speeds: None,
            landing: None,
            stuck: stuck.unwrap_or_else(|| devices.counts.map(Stuck::new)),
            outcome: Arc::clone(&outcome),
            noted: None,
            _ramps: ramps,
        });
        Ok(outcome)
    }

    /// One period of the motion under way; `Some` when it has ended.
    pub(super) fn control(&mut self) -> Result<Option<Reason>> {
        let pose = self.axle();
        let (Some(active), Some(devices)) = (&mut self.active, &self.devices) else {
            return Ok(None);
        };
        let passed = self.now.saturating_sub(active.controlled).min(LONGEST_LOOK);
        active.controlled = self.now;
        if self.agreement.is_broken() {
            // It has learned from the gyro what is not so.
            self.estimate.forget_gyro();
            return Ok(Some(Reason::Astray));
        }
        let order = match &mut active.landing {
            Some(landing) => match landing.look(devices.counts, passed) {
                Landed::NotYet => return Ok(active.is_foreign(devices).then_some(Reason::Stopped)),
                Landed::Never => return Ok(Some(Reason::Stalled)),
                Landed::There => {
                    active.landing = None;
                    active.stuck = devices.counts.map(Stuck::new);
                    active.steering.landed(pose)
                }
            },
            None => None,
        };
        let seconds = seconds(self.now.saturating_sub(active.steered)).clamp(0.001, 0.1);
        active.steered = self.now;
        let order = match order {
            Some(order) => order,
            None => active.steering.step(pose, seconds),
        };
        match order {
            Order::Arrived => Ok(Some(Reason::Reached)),
            Order::Roll(ways) => active.roll(devices, ways, passed),
            Order::Land(ways) => active.land(devices, ways),
        }
    }

    /// Does a period of the motion under way, if a whole one was left out.
    pub(super) fn catch_up(&mut self) {
        let missed = self.active.as_ref().map(|active| self.now.saturating_sub(active.controlled));
        if missed.is_some_and(|missed| missed >= PERIOD * 2) {
            let stepped = self.control();
            self.conclude(stepped);
        }
    }

    /// Ends the motion if its last period says so.
    pub(super) fn conclude(&mut self, stepped: Result<Option<Reason>>) {
        match stepped {
            Ok(None) => {}
            Ok(Some(reason)) => self.end_motion(Ok(reason)),
            Err(error) => {
                let error = self.named(error);
                self.end_motion(Err(error));
            }
        }
    }

    pub(super) fn end_motion(&mut self, result: Result<Reason>) {
        let Some(active) = self.active.take() else {
            return;
        };
        let is_reached = matches!(result, Ok(Reason::Reached));
        if is_reached {
            self.goal = active.steering.goal();
        }
        let action = if is_reached { active.stop_action } else { StopAction::Brake };
        let is_held = is_reached && action == StopAction::Hold && active.hold().is_ok();
        if !is_held {
            for motor in &active.motors {
                // One that is gone has nothing to stop.
                let _ = active.claim.stop(motor, action);
            }
        }
        if let Some((origin, course)) = &active.noted {
            let reason = result.as_ref().map_or(Reason::Unplugged, |reason| *reason).word();
            if let Some(motor) = active.motors.first() {
                let act = Act::Ended(Arc::clone(course), reason);
                motor.journal().note_for(*origin, motor.tree().now(), act);
            }
        }
        active.outcome.end(result);
    }

    /// Notes the course that has begun or changed.
    pub(super) fn note_course(&mut self, command: &Command, options: &DriveOptions) {
        let wheels = self.robot.names();
        let (Some(active), Some(devices)) = (&mut self.active, &self.devices) else {
            return;
        };
        let [motor, _] = &*devices.motors else { return };
        let course = Arc::new(Course { wheels, course: command.clone(), options: *options });
        let origin = origin();
        motor.journal().note(self.now, Act::Course(Arc::clone(&course)));
        active.noted = Some((origin, course));
    }

    /// The error with the device that is gone, where one is.
    fn named(&self, error: Error) -> Error {
        if !error.is_stale() {
            return error;
        }
        let motors = self.active.as_ref().map(|active| active.motors.iter());
        let path = error.path();
        match motors.into_iter().flatten().find(|d| path.is_some_and(|p| p.starts_with(d.path()))) {
            Some(gone) => gone.unplugged(),
            None => error,
        }
    }
}
