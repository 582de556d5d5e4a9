//! A robot on two wheels that knows where it is and is kept on its course.
//!
//! One place does both, at a fixed period of 20 ms while the wheels turn or a
//! motion is under way: it reads wheels and gyro, moves the estimate on
//! ([`odometry`](crate::odometry)), and tells the motors what the motion wants
//! next ([`steering`](crate::steering)). The tree calls it
//! ([`Tree::every`](crate::tree::Tree::every)): where there are real files by a
//! thread of its own, which ends when the robot has come to rest. Whoever asks
//! for the pose meanwhile gets it as it is now, and does that step himself.
//!
//! The kernel takes a new `speed_sp` only with the next command, so each change
//! is both; `run-forever` over `run-forever` keeps the regulator's memory
//! (`tacho_motor_class.c`). The end of a motion is a position that is gone to.
use crate::Interrupted;
use crate::device::Device;
use crate::devices::{Class, Devices};
use crate::error::{Error, Result};
use crate::motor::{self, End, Ramps, Speed, StopAction, find_all};
use crate::odometry::{Estimate, Pose, Wheels};
use crate::sensor;
use crate::steering::{Leg, Limits, Order, Steering};
use crate::value::Value;
use crate::wait::{Reason, sleep};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError, Weak};
use std::time::Duration;

/// The period of the control.
pub const PERIOD: Duration = Duration::from_millis(20);

/// When to come again if the estimate is in use by another thread.
const BUSY: Duration = Duration::from_millis(1);

/// How long the wheels must stand still to be at rest.
const AT_REST: Duration = Duration::from_secs(1);

/// The period while they are, in which the gyro's drift is measured.
const REST_PERIOD: Duration = Duration::from_millis(100);

/// How long that takes at most; then nothing is done until a motor is started.
const MEASURED: Duration = Duration::from_secs(30);

/// How long a wheel that is to turn may stand still.
const STUCK_FOR: Duration = Duration::from_millis(1500);

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

/// Counts that a wheel may seem to turn beyond what it can: more means that the
/// counter was written.
const MARGIN: f64 = 30.0;

/// The gyro's mode in which it tells its angle.
const GYRO_MODE: &str = "GYRO-ANG";

/// The type of a gyro.
const GYRO: &str = "lego-ev3-gyro";

/// A robot: where its motors are, and how it is built.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Ports of the left and the right motor.
    pub ports: [String; 2],
    /// Its wheels.
    pub wheels: Wheels,
}

/// What to do.
#[derive(Clone, Debug)]
pub enum Course {
    /// One part after the other. The second says whether rear first.
    Legs(Vec<Leg>, bool),
    /// On and on: speed in cm/s, rate of turn in degrees a second.
    Cruise(f64, f64),
    /// On and on: the speed of each wheel as a share of that of the faster one.
    Wheels([f64; 2]),
}

/// How to do it.
#[derive(Clone, Copy, Debug)]
pub struct DriveOptions {
    /// Of the faster wheel, in percent of what it can. Not for a cruise.
    pub percent: f64,
    /// In cm/s².
    pub acceleration: f64,
    /// What the wheels do at the end.
    pub stop_action: StopAction,
    /// Whether the gyro, if there is one, tells the heading.
    pub use_gyro: bool,
}

/// Odometry and control of one robot.
pub struct Drive {
    devices: Weak<Devices>,
    /// Whether the tree calls us.
    is_called: Mutex<bool>,
    inner: Mutex<Inner>,
}

struct Inner {
    robot: Robot,
    found: Option<Found>,
    use_gyro: bool,
    /// When the estimate was last moved on.
    now: Duration,
    /// When the wheels last turned.
    moved: Duration,
    estimate: Estimate,
    /// Where the motion before was to end.
    goal: Option<Pose>,
    job: Option<Job>,
    jobs: u32,
    last: Option<Arc<Status>>,
}

/// The robot's devices as they are plugged in now.
struct Found {
    motors: Vec<Arc<Device>>,
    gyro: Option<Arc<Device>>,
    counts: [i64; 2],
    cm_per_count: [f64; 2],
    /// Counts per second.
    fastest: f64,
}

/// A motion under way.
struct Job {
    id: u32,
    motors: Vec<Arc<Device>>,
    steering: Steering,
    stop_action: StopAction,
    at: Duration,
    /// What the wheels were last told, in counts per second.
    speeds: Option<[i64; 2]>,
    landing: Option<Landing>,
    /// Counts, and since when each wheel has stood there.
    stuck: [(i64, Duration); 2],
    status: Arc<Status>,
    /// Put back when the motion ends.
    _ramps: Ramps,
}

/// The wheels go to their last counts.
struct Landing {
    targets: [i64; 2],
    since: Duration,
    before: [i64; 2],
}

/// How a motion ended, once it has.
#[derive(Default)]
pub struct Status(Mutex<Option<Result<Reason>>>);

impl Status {
    fn end(&self, result: Result<Reason>) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(result);
    }

    /// What it ended with; an error for the first who asks.
    fn ended(&self) -> Option<Result<Reason>> {
        let mut status = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let after = match status.as_ref()? {
            Ok(reason) => *reason,
            Err(error) if error.is_gone() => Reason::Unplugged,
            Err(_) => Reason::Stopped,
        };
        status.replace(Ok(after))
    }
}

impl Drive {
    /// The drive of a robot; that of before, if it is the same robot.
    pub fn of(devices: &Arc<Devices>, robot: &Robot) -> Arc<Self> {
        let mut slot = devices.drive();
        if let Some(drive) = slot.as_ref() {
            let mut inner = drive.lock();
            if inner.robot != *robot {
                inner.end_job(Ok(Reason::Stopped));
                let pose = inner.pose();
                inner.robot = robot.clone();
                inner.found = None;
                inner.goal = None;
                inner.estimate.forget_wheels();
                inner.place(pose);
            }
            drop(inner);
            return Arc::clone(drive);
        }
        let inner = Inner {
            robot: robot.clone(),
            found: None,
            use_gyro: true,
            now: Duration::ZERO,
            moved: Duration::ZERO,
            estimate: Estimate::default(),
            goal: None,
            job: None,
            jobs: 0,
            last: None,
        };
        let drive = Arc::new(Self {
            devices: Arc::downgrade(devices),
            is_called: Mutex::default(),
            inner: Mutex::new(inner),
        });
        drive.lock().place(Pose::default());
        devices.watch().set(Arc::downgrade(&drive));
        *slot = Some(Arc::clone(&drive));
        drive
    }

    /// Starts counting, if the robot is there.
    ///
    /// # Errors
    /// The kernel's.
    pub fn start(&self, devices: &Devices) -> Result<bool> {
        let mut inner = self.lock();
        let is_there = devices.afresh(|| inner.integrate(devices))?;
        drop(inner);
        if is_there {
            self.be_called(devices);
        }
        Ok(is_there)
    }

    /// Where the robot is; `None` where a motor is absent.
    ///
    /// # Errors
    /// The kernel's.
    pub fn pose(&self, devices: &Devices) -> Result<Option<Pose>> {
        let mut inner = self.lock();
        let is_there = devices.afresh(|| inner.integrate(devices))?;
        Ok(is_there.then(|| inner.pose()))
    }

    /// Says where the robot is.
    ///
    /// # Errors
    /// The kernel's.
    pub fn set_pose(&self, devices: &Devices, pose: Pose) -> Result<bool> {
        let mut inner = self.lock();
        let is_there = devices.afresh(|| inner.integrate(devices))?;
        if is_there {
            inner.goal = None;
            inner.place(pose);
        }
        Ok(is_there)
    }

    /// Covariance of the pose.
    ///
    /// # Errors
    /// The kernel's.
    pub fn uncertainty(&self, devices: &Devices) -> Result<Option<[[f64; 3]; 3]>> {
        let mut inner = self.lock();
        let is_there = devices.afresh(|| inner.integrate(devices))?;
        Ok(is_there.then(|| inner.estimate.uncertainty()))
    }

    /// Whether the gyro, if there is one, tells the heading.
    pub fn use_gyro(&self, use_gyro: bool) {
        let mut inner = self.lock();
        if inner.use_gyro != use_gyro {
            inner.use_gyro = use_gyro;
            inner.estimate.lose_gyro();
            if !use_gyro {
                inner.estimate.forget_wheels();
            }
        }
    }

    /// Begins a motion in the place of the one under way. `None` if a motor is
    /// absent or the motion is impossible; then nothing has moved.
    ///
    /// # Errors
    /// The kernel's; [`Error::Interrupted`].
    pub fn begin(
        &self,
        devices: &Devices,
        course: &Course,
        options: &DriveOptions,
        interrupted: Interrupted,
    ) -> Result<Option<Arc<Status>>> {
        self.use_gyro(options.use_gyro);
        let is_there = devices.afresh(|| self.lock().integrate(devices))?;
        if !is_there {
            return Ok(None);
        }
        let gyro = self.lock().found.as_ref().and_then(|found| found.gyro.clone());
        if let Some(gyro) = gyro.filter(|_| options.use_gyro) {
            sensor::set_mode(devices, &gyro, GYRO_MODE, interrupted)?;
        }
        let mut inner = self.lock();
        inner.integrate(devices)?;
        let begun = inner.begin(course, options)?;
        if begun.is_some() {
            let stepped = inner.control();
            inner.conclude(stepped);
        }
        drop(inner);
        if begun.is_some() {
            self.be_called(devices);
        }
        Ok(begun)
    }

    /// Waits for the end of a motion.
    ///
    /// # Errors
    /// [`Error::Gone`] if a motor or the gyro was unplugged; the kernel's;
    /// [`Error::Interrupted`]. The motors are stopped before.
    pub fn wait(
        &self,
        devices: &Devices,
        status: &Arc<Status>,
        timeout: Option<Duration>,
        interrupted: Interrupted,
    ) -> Result<Reason> {
        let ended = Self::watch(devices, status, timeout, interrupted);
        let mut inner = self.lock();
        inner.last.take_if(|last| Arc::ptr_eq(last, status));
        let is_mine = inner.job.as_ref().is_some_and(|job| Arc::ptr_eq(&job.status, status));
        if is_mine && matches!(ended, Ok(Reason::Timeout) | Err(_)) {
            inner.end_job(Ok(Reason::Stopped));
        }
        ended
    }

    /// Waits for the end of the motion under way or last begun, and stops
    /// nothing.
    ///
    /// # Errors
    /// As [`wait`](Self::wait).
    pub fn wait_last(
        &self,
        devices: &Devices,
        timeout: Option<Duration>,
        interrupted: Interrupted,
    ) -> Result<Reason> {
        let last = self.lock().last.clone();
        match last {
            Some(status) => {
                let ended = Self::watch(devices, &status, timeout, interrupted);
                if !matches!(ended, Ok(Reason::Timeout) | Err(Error::Interrupted)) {
                    let mut inner = self.lock();
                    inner.last.take_if(|last| Arc::ptr_eq(last, &status));
                }
                ended
            }
            None => Ok(Reason::Reached),
        }
    }

    fn watch(
        devices: &Devices,
        status: &Status,
        timeout: Option<Duration>,
        interrupted: Interrupted,
    ) -> Result<Reason> {
        let deadline = timeout.map(|timeout| devices.tree().now().saturating_add(timeout));
        loop {
            if let Some(ended) = status.ended() {
                return ended;
            }
            let left = deadline.map(|deadline| deadline.saturating_sub(devices.tree().now()));
            if left.is_some_and(|left| left.is_zero()) {
                return Ok(Reason::Timeout);
            }
            sleep(devices, left.map_or(PERIOD, |left| left.min(PERIOD)), interrupted)?;
        }
    }

    /// A motor was started: if the robot is ours, its wheels may turn.
    pub(crate) fn started(&self) {
        if let Some(devices) = self.devices.upgrade() {
            self.be_called(&devices);
        }
    }

    /// Writes what changes a motor's count without turning it.
    pub(crate) fn recount(
        &self,
        motor: &Device,
        write: &mut dyn FnMut() -> Result<()>,
    ) -> Result<()> {
        let Some(devices) = self.devices.upgrade() else {
            return write();
        };
        let mut inner = self.lock();
        if !inner.robot.ports.iter().any(|port| crate::port::short(port) == motor.port()) {
            drop(inner);
            return write();
        }
        // What cannot be read now will be found out by whoever reads it next.
        let _ = inner.integrate(&devices);
        let written = write();
        if let Some(found) = &mut inner.found {
            if let Ok(counts) = counts(&found.motors) {
                found.counts = counts;
            }
        }
        inner.goal = None;
        written
    }

    /// Makes the tree call us, unless it does.
    fn be_called(&self, devices: &Devices) {
        let mut is_called = self.is_called();
        if *is_called {
            return;
        }
        let weak = Weak::clone(&self.devices);
        let act = move || {
            let devices = weak.upgrade()?;
            let drive = devices.drive().clone()?;
            drive.called(&devices)
        };
        // Where no thread can be had, each look at the pose still does a step.
        *is_called = devices.tree().every(PERIOD, Box::new(act)).is_ok();
    }

    /// One period; answers when to come again.
    fn called(&self, devices: &Devices) -> Option<Duration> {
        let mut inner = match self.inner.try_lock() {
            Ok(inner) => inner,
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => return Some(BUSY),
        };
        let integrated = inner.integrate(devices);
        let stepped = match integrated {
            Ok(true) => inner.control(),
            Ok(false) => Err(inner.absent()),
            Err(error) => Err(error),
        };
        inner.conclude(stepped);
        let mut is_called = self.is_called();
        let next = inner.next_call();
        *is_called = next.is_some();
        next
    }

    fn is_called(&self) -> MutexGuard<'_, bool> {
        self.is_called.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn lock(&self) -> MutexGuard<'_, Inner> {
        self.inner.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Inner {
    /// The pose of the point that programs mean.
    fn pose(&self) -> Pose {
        self.estimate.pose().ahead(-self.robot.wheels.offset)
    }

    fn place(&mut self, pose: Pose) {
        self.estimate.place(pose.ahead(self.robot.wheels.offset));
    }

    /// Moves the estimate on to now. `false` where a motor is absent.
    fn integrate(&mut self, devices: &Devices) -> Result<bool> {
        let before = self.now;
        if self.found.as_ref().is_some_and(|found| !found.is_there()) {
            self.found = None;
        }
        let is_new = self.found.is_none();
        if is_new {
            self.found = Found::look(devices, &self.robot)?;
            self.estimate.lose_gyro();
        }
        let Some(found) = &mut self.found else {
            return Ok(false);
        };
        let read = counts(&found.motors);
        let now = devices.tree().now();
        let counts = match read {
            Ok(counts) => counts,
            Err(error) => {
                self.found = None;
                return Err(error);
            }
        };
        self.now = now;
        if now < before {
            // A simulation that was put back to an earlier moment.
            found.counts = counts;
            self.end_job(Ok(Reason::Stopped));
            return Ok(true);
        }
        let seconds = if is_new { 0.0 } else { now.saturating_sub(before).as_secs_f64() };
        let ways = found.ways(counts, seconds);
        found.counts = counts;
        if ways != [0.0, 0.0] || is_new {
            self.moved = now;
        }
        self.estimate.roll(&self.robot.wheels, ways, seconds);
        match found.gyro.as_ref().filter(|_| self.use_gyro).map(angle) {
            Some(Ok(Some(angle))) => self.estimate.see(angle),
            Some(Ok(None)) => self.estimate.lose_gyro(),
            Some(Err(error)) => {
                self.estimate.lose_gyro();
                let gone =
                    found.gyro.take_if(|gyro| error.is_gone() || gyro.check_present().is_err());
                if let (Some(gyro), true) = (gone, self.job.is_some()) {
                    return Err(gyro.gone());
                }
            }
            None => {}
        }
        Ok(true)
    }

    /// The motor that is missing.
    fn absent(&self) -> Error {
        let port = crate::port::short(&self.robot.ports[0]).to_owned();
        Error::Gone { class: Class::TachoMotor, port }
    }

    fn begin(&mut self, course: &Course, options: &DriveOptions) -> Result<Option<Arc<Status>>> {
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
            Course::Cruise(speed, rate) => {
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
        self.install(steering, options.stop_action).map(Some)
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
        self.jobs = self.jobs.wrapping_add(1).max(1);
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
            motor::own(motor, self.jobs);
        }
        self.last = Some(Arc::clone(&status));
        self.goal = None;
        self.job = Some(Job {
            id: self.jobs,
            motors: found.motors.clone(),
            steering,
            stop_action,
            at: self.now.saturating_sub(PERIOD),
            speeds: None,
            landing: None,
            stuck: found.counts.map(|count| (count, self.now)),
            status: Arc::clone(&status),
            _ramps: ramps,
        });
        Ok(status)
    }

    /// One period of the motion under way; `Some` when it has ended.
    fn control(&mut self) -> Result<Option<Reason>> {
        let (Some(job), Some(found)) = (&mut self.job, &self.found) else {
            return Ok(None);
        };
        let pose = self.estimate.pose();
        let order = match &mut job.landing {
            Some(landing) => match landing.look(found.counts, self.now) {
                Landed::NotYet => return Ok(job.is_foreign(found).then_some(Reason::Stopped)),
                Landed::Never => return Ok(Some(Reason::Stalled)),
                Landed::There => {
                    job.landing = None;
                    job.stuck = found.counts.map(|count| (count, self.now));
                    job.steering.landed(pose)
                }
            },
            None => None,
        };
        let seconds = self.now.saturating_sub(job.at).as_secs_f64().clamp(0.001, 0.1);
        job.at = self.now;
        let order = match order {
            Some(order) => order,
            None => job.steering.step(pose, seconds),
        };
        match order {
            Order::Arrived => Ok(Some(Reason::Reached)),
            Order::Roll(ways) => job.roll(found, ways, self.now),
            Order::Land(ways) => job.land(found, ways, self.now),
        }
    }

    /// Ends the motion if its last period says so.
    fn conclude(&mut self, stepped: Result<Option<Reason>>) {
        match stepped {
            Ok(None) => {}
            Ok(Some(reason)) => self.end_job(Ok(reason)),
            Err(error) => {
                let error = self.named(error);
                self.end_job(Err(error));
            }
        }
    }

    fn end_job(&mut self, result: Result<Reason>) {
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
                let _ = motor::stop_owned(motor, action, job.id);
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

    /// When to look again; `None` if there is nothing to do until a motor is
    /// started.
    fn next_call(&self) -> Option<Duration> {
        if self.job.is_some() {
            return Some(PERIOD);
        }
        let found = self.found.as_ref()?;
        let rests = self.now.saturating_sub(self.moved);
        if rests < AT_REST || found.motors.iter().any(|motor| motor::runs_on(motor)) {
            Some(PERIOD)
        } else {
            (found.gyro.is_some() && self.use_gyro && rests < MEASURED).then_some(REST_PERIOD)
        }
    }
}

impl Found {
    /// The robot's devices; `None` where a motor is absent.
    fn look(devices: &Devices, robot: &Robot) -> Result<Option<Self>> {
        let Some(motors) = find_all(devices, robot.ports.iter().map(String::as_str))? else {
            return Ok(None);
        };
        let [left, right] = &*motors else {
            return Ok(None);
        };
        let way = |side, motor: &Device| -> Result<f64> {
            #[expect(clippy::cast_precision_loss, reason = "a rotation has a few hundred counts")]
            let counts = motor.constant("count_per_rot")? as f64;
            Ok(robot.wheels.cm_per_count(side, counts))
        };
        let cm_per_count = [way(0, left)?, way(1, right)?];
        let fastest = left.constant("max_speed")?.min(right.constant("max_speed")?);
        let counts = counts(&motors)?;
        let sensors = devices.all(Class::Sensor)?;
        let gyro = sensors.iter().find(|sensor| sensor.driver() == GYRO).cloned();
        #[expect(clippy::cast_precision_loss, reason = "a motor's speed is small")]
        let fastest = fastest as f64;
        Ok(Some(Self { motors, gyro, counts, cm_per_count, fastest }))
    }

    /// Whether the motors are still plugged in.
    fn is_there(&self) -> bool {
        self.motors.iter().all(|motor| motor.check_present().is_ok())
    }

    /// How far the wheels have rolled since the counts before. A counter that
    /// was written elsewhere has not turned a wheel.
    #[expect(clippy::cast_precision_loss, reason = "a plausible difference is small")]
    fn ways(&self, counts: [i64; 2], seconds: f64) -> [f64; 2] {
        let most = self.fastest * 1.5 * seconds + MARGIN;
        std::array::from_fn(|side| {
            let turned = counts[side].saturating_sub(self.counts[side]) as f64;
            if turned.abs() <= most { turned * self.cm_per_count[side] } else { 0.0 }
        })
    }

    /// Counts from a way in cm, or counts per second from a speed.
    fn in_counts(&self, ways: [f64; 2]) -> [f64; 2] {
        [ways[0] / self.cm_per_count[0], ways[1] / self.cm_per_count[1]]
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a motor's speed or a short way")]
fn whole(counts: f64) -> i64 {
    counts.round() as i64
}

fn counts(motors: &[Arc<Device>]) -> Result<[i64; 2]> {
    let mut counts = [0; 2];
    for (count, motor) in counts.iter_mut().zip(motors) {
        motor.check_present()?;
        *count = motor.number("position")?;
    }
    Ok(counts)
}

/// What the gyro shows, in degrees; `None` if that is no angle.
fn angle(gyro: &Arc<Device>) -> Result<Option<f64>> {
    gyro.check_present()?;
    if !gyro.with_word("mode", |mode| mode == GYRO_MODE)? {
        return Ok(None);
    }
    Ok(match sensor::read_value(gyro, Some(GYRO_MODE), 0)? {
        #[expect(clippy::cast_precision_loss, reason = "a gyro's angle has 16 bits")]
        Value::Integer(degrees) => Some(degrees as f64),
        Value::Float(degrees) => Some(degrees),
        Value::Text(_) => None,
    })
}

impl Job {
    /// Tells the wheels their speeds in cm/s.
    fn roll(&mut self, found: &Found, ways: [f64; 2], now: Duration) -> Result<Option<Reason>> {
        let wanted = found.in_counts(ways);
        // Too fast for one is too fast for both: the curve stays the same.
        let most = wanted[0].abs().max(wanted[1].abs());
        let share = if most > found.fastest { found.fastest / most } else { 1.0 };
        let speeds = wanted.map(|speed| whole(speed * share));
        if self.is_stuck(found, speeds, now) {
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
            if !motor::start_owned(motor, "run-forever", End::Never, self.id)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = Some(speeds);
        Ok(None)
    }

    /// Makes the wheels roll by the last few counts.
    fn land(&mut self, found: &Found, ways: [f64; 2], now: Duration) -> Result<Option<Reason>> {
        let by = found.in_counts(ways).map(whole);
        let targets = [found.counts[0] + by[0], found.counts[1] + by[1]];
        for (motor, target) in found.motors.iter().zip(targets) {
            motor.write_number("position_sp", target)?;
            motor.write_number("speed_sp", LANDING_SPEED)?;
        }
        for (side, motor) in found.motors.iter().enumerate() {
            let end = End::Position { from: found.counts[side], target: targets[side] };
            if !motor::start_owned(motor, "run-to-abs-pos", end, self.id)? {
                return Ok(Some(Reason::Stopped));
            }
        }
        self.speeds = None;
        self.landing = Some(Landing { targets, since: now, before: found.counts });
        Ok(None)
    }

    /// Whether a wheel that is to turn does not.
    fn is_stuck(&mut self, found: &Found, speeds: [i64; 2], now: Duration) -> bool {
        let mut is_stuck = false;
        for (side, (count, since)) in self.stuck.iter_mut().enumerate() {
            let is_still = found.counts[side].abs_diff(*count) < STUCK_WITHIN;
            if speeds[side].abs() < LANDING_SPEED / 4 || !is_still {
                (*count, *since) = (found.counts[side], now);
            }
            is_stuck |= now.saturating_sub(*since) >= STUCK_FOR;
        }
        is_stuck
    }

    /// Whether somebody else has told a motor something.
    fn is_foreign(&self, found: &Found) -> bool {
        found.motors.iter().any(|motor| !motor::is_owned(motor, self.id))
    }
}

enum Landed {
    NotYet,
    There,
    Never,
}

impl Landing {
    fn look(&mut self, counts: [i64; 2], now: Duration) -> Landed {
        let off = |side: usize| counts[side].abs_diff(self.targets[side]);
        let farthest = off(0).max(off(1));
        let stands = std::mem::replace(&mut self.before, counts) == counts;
        let took = now.saturating_sub(self.since);
        if farthest <= LANDED_WITHIN && stands && took >= PERIOD * 2 {
            Landed::There
        } else if took < LANDING_TAKES || !stands {
            Landed::NotYet
        } else if farthest <= LANDED_SOMEHOW {
            Landed::There
        } else {
            Landed::Never
        }
    }
}
