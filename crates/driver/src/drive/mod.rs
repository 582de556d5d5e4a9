//! A robot on two wheels that knows where it is and is kept on its course.
//!
//! One place does both, at a fixed period of 20 ms while the wheels turn or a motion is under way:
//! it reads wheels and gyro, updates the estimate ([`odometry`]), and commands the motors
//! ([`steering`]). The tree calls it ([`Sysfs::every`](crate::sysfs::Sysfs::every)); over real
//! files a thread does, which ends when the robot has come to rest. A thread that asks for the pose
//! meanwhile does that step itself, and gets the pose of now.
//!
//! The kernel takes a new `speed_sp` only with the next command, so each change
//! is both; `run-forever` over `run-forever` keeps the regulator's memory
//! (`tacho_motor_class.c`). The wheels end a motion at a position.
mod agreement;
mod control;
mod devices;
mod motion;
pub mod odometry;
pub mod steering;
mod track;

use crate::device::registry::Registry;
use crate::device::retry::while_permissions_settle;
use crate::device::{Device, MotionObserver};
use crate::error::{Interrupted, Result};
use crate::journal::{Act, Place};
use crate::motor;
use crate::motor::wait::Reason;
use crate::sensor::{self, gyro};
use crate::sysfs::sleep;
use crate::wait::{Look, Slices, Wait};
use control::Inner;
pub use control::{Command, DriveOptions};
pub use devices::Robot;
use devices::{angle, counts};
use ev3_motion::{Pose, distance};
use ev3_os::locked;
pub use motion::{Outcome, PERIOD};
use std::sync::{Arc, Mutex, MutexGuard, Weak};
use std::time::Duration;

/// By how much the pose may be corrected in a motion, in cm and degrees.
const AWAY: [f64; 2] = [20.0, 20.0];

/// How far the gyro may turn either way before its angle is put back to 0, in
/// degrees: half of what its 16 bits hold, so that no move fills them.
const MUCH_TURNED: f64 = 16_384.0;

/// How long the wheels must stand before that.
const STANDS: Duration = Duration::from_millis(100);

/// Where a robot believes to be.
#[derive(Clone, Debug)]
pub struct Believed {
    /// Its wheels.
    pub robot: Robot,
    /// Its pose.
    pub pose: Pose,
    /// The covariance of x, y and heading, in cm and degrees.
    pub covariance: [[f64; 3]; 3],
    /// When it was where.
    pub way: Vec<(Duration, Pose)>,
    /// Points of the way that it is to go, while it goes one.
    pub course: Option<Vec<[f64; 2]>>,
}

/// Odometry and control of one robot.
///
/// Motors report to it when they are started. The owner of the registry owns the
/// drive, and a registry has one.
pub struct Drive {
    this: Weak<Self>,
    /// Whether the tree calls the drive periodically.
    is_called: Mutex<bool>,
    inner: Mutex<Inner>,
    /// The last field, so that the motors' files are closed before it goes.
    registry: Arc<Registry>,
}

impl Drive {
    /// The drive of a robot whose devices are in `registry`. A registry has one drive.
    pub fn new(registry: Arc<Registry>, robot: &Robot) -> Arc<Self> {
        let drive = Arc::new_cyclic(|this| Self {
            this: Weak::clone(this),
            is_called: Mutex::default(),
            inner: Mutex::new(Inner::new(robot)),
            registry,
        });
        let this: Weak<Self> = Weak::clone(&drive.this);
        drive.registry.observe(this);
        drive
    }

    /// Changes the robot, and keeps the pose. Nothing happens if it is the same robot.
    pub fn set_robot(&self, robot: &Robot) {
        let mut inner = locked(&self.inner);
        if inner.robot == *robot {
            return;
        }
        inner.set_robot(robot);
    }

    /// Starts counting, if the robot is there.
    pub fn start(&self) -> Result<bool> {
        let is_there = self.look()?.is_some();
        if is_there {
            self.be_called();
        }
        Ok(is_there)
    }

    /// Where the robot is; `None` where a motor is absent.
    pub fn pose(&self) -> Result<Option<Pose>> {
        Ok(self.look()?.map(|inner| inner.pose()))
    }

    /// Where wheels and gyro have brought it since the start, whatever poses have been set;
    /// `None` where a motor is absent.
    pub fn rolled(&self) -> Result<Option<Pose>> {
        Ok(self.look()?.map(|inner| inner.rolled()))
    }

    /// Corrects the pose of the robot, by a map for one. A motion under way goes on, and steers
    /// back to its course; where that would be too far away, nothing changes. `false` then, and
    /// where a motor is absent.
    pub fn correct_pose(&self, pose: Pose) -> Result<bool> {
        let Some(mut inner) = self.look()? else {
            return Ok(false);
        };
        let before = inner.pose();
        let is_far = distance(before.point(), pose.point()) > AWAY[0]
            || (pose.heading - before.heading).abs() > AWAY[1];
        if inner.active.is_some() && is_far {
            return Ok(false);
        }
        inner.correct_pose(pose);
        Ok(true)
    }

    /// Sets the pose of the robot; `false` where a motor is absent.
    pub fn set_pose(&self, pose: Pose) -> Result<bool> {
        let Some(mut inner) = self.look()? else {
            return Ok(false);
        };
        inner.goal = None;
        inner.set_pose(pose);
        let act = Act::Pose(Box::new(Place { wheels: inner.robot.names(), pose }));
        self.registry.journal().note(inner.now, act);
        Ok(true)
    }

    /// Covariance of the pose.
    pub fn uncertainty(&self) -> Result<Option<[[f64; 3]; 3]>> {
        Ok(self.look()?.map(|inner| inner.uncertainty()))
    }

    /// What is known without looking: the pose, its covariance, and the way after a moment, with
    /// the last point before. `None` while another thread is at it. Reads nothing, and changes
    /// nothing.
    pub fn peek(&self, after: Duration) -> Option<Believed> {
        let inner = self.inner.try_lock().ok()?;
        Some(Believed {
            robot: inner.robot.clone(),
            pose: inner.pose(),
            covariance: inner.uncertainty(),
            way: inner.track.since(after).to_vec(),
            course: inner.active.as_ref().map(|active| active.steering.course()),
        })
    }

    /// Brings the estimate up to date; `None` where a motor is absent. A caller that polls
    /// continuously starves the periodic callback, so this runs any control period that was missed.
    fn look(&self) -> Result<Option<MutexGuard<'_, Inner>>> {
        let mut inner = locked(&self.inner);
        let is_there = self.registry.retry_after_relisting(|| inner.integrate(&self.registry))?;
        if is_there {
            inner.catch_up();
        }
        Ok(is_there.then_some(inner))
    }

    /// Whether the gyro, if there is one, measures the heading.
    pub fn use_gyro(&self, use_gyro: bool) {
        let mut inner = locked(&self.inner);
        if inner.use_gyro != use_gyro {
            inner.use_gyro = use_gyro;
            inner.estimate.gyro_lost();
            if !use_gyro {
                inner.estimate.forget_wheels();
            }
        }
    }

    /// Begins a motion in the place of the one under way. `None` if a motor is absent or the motion
    /// is impossible; then nothing has moved. Errors: the kernel's; [`Error::Interrupted`].
    pub fn begin(
        &self,
        command: &Command,
        options: &DriveOptions,
        interrupted: Interrupted,
    ) -> Result<Option<Arc<Outcome>>> {
        self.use_gyro(options.use_gyro);
        let prepare = || {
            let mut inner = locked(&self.inner);
            let is_there = inner.integrate(&self.registry)?;
            let is_possible = is_there && inner.steering(command, options)?.is_some();
            let Some(devices) = inner.devices.as_ref().filter(|_| is_possible) else {
                return Ok(None);
            };
            motor::prepare(&devices.motors)?;
            Ok(Some(devices.gyro.clone()))
        };
        let Some(gyro) = while_permissions_settle(&self.registry, &mut *interrupted, prepare)?
        else {
            return Ok(None);
        };
        if let Some(gyro) = gyro.filter(|_| options.use_gyro) {
            sensor::measure_angle(&self.registry, &gyro, &mut *interrupted)?;
            self.keep_from_filling(&gyro, interrupted)?;
        }
        let mut inner = locked(&self.inner);
        inner.integrate(&self.registry)?;
        let begun = inner.begin(command, options)?;
        if begun.is_some() {
            inner.note_course(command, options);
            inner.devices.iter().flat_map(|devices| &devices.motors).for_each(|motor| {
                motor.was_commanded();
            });
            let stepped = inner.control();
            inner.conclude(stepped);
        }
        drop(inner);
        if begun.is_some() {
            self.be_called();
        }
        Ok(begun)
    }

    /// Puts the angle of a gyro that has turned much back to 0, if the robot stands.
    fn keep_from_filling(&self, gyro: &Arc<Device>, interrupted: Interrupted) -> Result<()> {
        if locked(&self.inner).active.is_some()
            || angle(gyro)?.is_some_and(|angle| angle.abs() < MUCH_TURNED)
        {
            return Ok(());
        }
        sleep(self.registry.tree(), STANDS, &mut *interrupted)?;
        let mut inner = locked(&self.inner);
        inner.integrate(&self.registry)?;
        let stands = inner.now.saturating_sub(inner.moved) >= STANDS;
        drop(inner);
        if stands {
            sensor::restart(&self.registry, gyro, gyro::ANGLE, interrupted)?;
            locked(&self.inner).estimate.gyro_lost();
        }
        Ok(())
    }

    /// Waits for the end of a motion, which ends it when it is left.
    pub fn until_ended(
        self: &Arc<Self>,
        outcome: Arc<Outcome>,
        timeout: Option<Duration>,
    ) -> Slices<UntilEnded> {
        self.until(Some(outcome), timeout, true)
    }

    /// Waits for the end of the motion under way or last begun, and stops nothing.
    pub fn until_last_ended(self: &Arc<Self>, timeout: Option<Duration>) -> Slices<UntilEnded> {
        let last = locked(&self.inner).last.clone();
        self.until(last, timeout, false)
    }

    fn until(
        self: &Arc<Self>,
        outcome: Option<Arc<Outcome>>,
        timeout: Option<Duration>,
        ends: bool,
    ) -> Slices<UntilEnded> {
        let deadline = timeout.map(|timeout| self.registry.tree().now().saturating_add(timeout));
        Slices::new(UntilEnded { drive: Arc::clone(self), outcome, deadline, ends })
    }

    /// Nobody waits any more for a motion.
    fn leave(&self, outcome: &Arc<Outcome>) {
        let mut inner = locked(&self.inner);
        inner.last.take_if(|last| Arc::ptr_eq(last, outcome));
        let active = inner.active.as_ref();
        if active.is_some_and(|active| Arc::ptr_eq(&active.outcome, outcome)) {
            inner.end_motion(Ok(Reason::Stopped));
        }
    }

    /// Makes the tree call the drive periodically, unless it does already.
    fn be_called(&self) {
        let mut is_called = locked(&self.is_called);
        if *is_called {
            return;
        }
        let this = Weak::clone(&self.this);
        let act = move || this.upgrade()?.called();
        // Without a thread, each request for the pose still does a step.
        *is_called = self.registry.tree().every(PERIOD, Box::new(act)).is_ok();
    }

    /// Does one period; returns the time to the next call.
    fn called(&self) -> Option<Duration> {
        let mut inner = locked(&self.inner);
        let integrated = inner.integrate(&self.registry);
        let stepped = match integrated {
            Ok(true) => inner.control(),
            Ok(false) => Err(inner.absent(&self.registry)),
            Err(error) => Err(error),
        };
        inner.conclude(stepped);
        let mut is_called = locked(&self.is_called);
        let next = inner.next_call();
        *is_called = next.is_some();
        next
    }
}

/// Until a motion has ended.
///
/// The errors are [`Error::Unplugged`](crate::Error::Unplugged) if a motor or the gyro was
/// unplugged, and the kernel's. The motors are stopped before.
pub struct UntilEnded {
    drive: Arc<Drive>,
    /// `None` if there was no motion.
    outcome: Option<Arc<Outcome>>,
    deadline: Option<Duration>,
    /// Whether the motion ends with the wait.
    ends: bool,
}

impl Wait for UntilEnded {
    type End = Reason;

    fn look(&mut self) -> Result<Look<Reason>> {
        let Some(outcome) = &self.outcome else {
            return Ok(Look::Over(Reason::Reached));
        };
        if let Some(ended) = outcome.ended() {
            locked(&self.drive.inner).last.take_if(|last| Arc::ptr_eq(last, outcome));
            return ended.map(Look::Over);
        }
        let now = self.drive.registry.tree().now();
        Ok(Look::again(now, PERIOD, self.deadline, Reason::Timeout))
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        Ok(self.drive.registry.tree().pause(&[], end).unwrap_or(true))
    }
}

impl Drop for UntilEnded {
    fn drop(&mut self) {
        if let Some(outcome) = self.outcome.as_ref().filter(|_| self.ends) {
            self.drive.leave(outcome);
        }
    }
}

impl MotionObserver for Drive {
    /// The motor may be one of the robot's.
    fn motor_started(&self) {
        self.be_called();
    }

    fn without_counting(&self, port: &str, write: &mut dyn FnMut() -> Result<()>) -> Result<()> {
        let mut inner = locked(&self.inner);
        if !inner.robot.ports.iter().any(|ours| crate::port_name::short(ours) == port) {
            drop(inner);
            return write();
        }
        // An error shows again at the next reading.
        let _ = inner.integrate(&self.registry);
        let written = write();
        let Inner { devices, robot, .. } = &mut *inner;
        if let Some(devices) = devices {
            // The gear may be what was written.
            let _ = devices.measure(&robot.wheels);
            if let Ok(counts) = counts(&devices.motors) {
                devices.counts = counts;
            }
        }
        inner.goal = None;
        written
    }
}
