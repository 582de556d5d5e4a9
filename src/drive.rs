//! `prolog/ev3dev/odometry.pl`, `drive_moves.pl`, `calibrate.pl`: curves, odometry, going to places.
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::places::places;
use crate::glue::state;
use crate::glue::terms::{Prolog, unify_atom};
use crate::glue::watch::Frame;
use crate::motors::stop_action;
use crate::sim::watched_simulation;
use ev3_driver::drive::odometry::Wheels;
use ev3_driver::drive::steering::Leg;
use ev3_driver::drive::{Command, Drive, DriveOptions, Robot, UntilEnded};
use ev3_driver::journal;
use ev3_driver::motor::wait::Reason;
use ev3_driver::wait::Slices;
use ev3_motion::{Pose, wrapped};
use std::sync::Arc;
use std::time::Duration;
use swipl::prelude::*;

natives! {
    /// odometry_(+Robot): starts the odometry if it does not run yet.
    semidet fn "odometry_"(context, robot) as call("set_robot", 4) {
        into_prolog_result(call.or_throw(robots_drive(&call, robot)?.start())?)
    }

    /// pose_(+Robot, +UseGyro, -X, -Y, -Heading)
    semidet fn "pose_"(context, robot, use_gyro, x, y, heading) as call("pose", 3) {
        let drive = drive_of(&call, robot, use_gyro)?;
        let pose = call.or_fail(drive.pose())?;
        x.unify(pose.x)?;
        y.unify(pose.y)?;
        heading.unify(pose.heading)
    }

    /// set_pose_(+Robot, +UseGyro, +X, +Y, +Heading)
    semidet fn "set_pose_"(context, robot, use_gyro, x, y, heading) as call("set_pose", 3) {
        let drive = drive_of(&call, robot, use_gyro)?;
        let pose = Pose { x: call.float(x)?, y: call.float(y)?, heading: call.float(heading)? };
        let is_set = call.or_throw(drive.set_pose(pose))?;
        pose_is_set(pose);
        into_prolog_result(is_set)
    }

    /// pose_uncertainty_(+Robot, +UseGyro, -Rows)
    semidet fn "pose_uncertainty_"(context, robot, use_gyro, rows) as call("pose_uncertainty", 1) {
        let drive = drive_of(&call, robot, use_gyro)?;
        let covariance = call.or_fail(drive.uncertainty())?;
        let lists = covariance.map(|row| call.floats(&row)).into_iter();
        rows.unify(lists.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// heading_wrapped_(+Heading, -Wrapped)
    semidet fn "heading_wrapped_"(context, heading, result) as call("heading_wrapped", 2) {
        result.unify(wrapped(call.float(heading)?))
    }

    /// drive_(+Robot, +Course, +Options, -Reason): options is
    /// `options(Percent, Acceleration, StopAction, UseGyro, Wait, Timeout)`. Who leaves
    /// the wait ends the motion.
    nondet fn "drive_"<Option<Slices<UntilEnded>>>(context, robot, course, options, reason) as call("go_to", 4) {
        setup => {
            let (course, drive) = (course_of(&call, course)?, robots_drive(&call, robot)?);
            call.may_move()?;
            // The course says more than the name of one of its predicates.
            journal::forget_called();
            let (options, wait, timeout) = options_of(&call, options)?;
            let begun = drive.begin(&course, &options, &mut call.interrupted());
            let begun = call.or_fail(begun)?;
            Ok(Some(wait.then(|| drive.until_ended(begun, timeout))))
        },
        call(waiting) => {
            match waiting {
                Some(waiting) => call.slice_of_move(waiting, reason),
                None => unify_atom(reason, Reason::Reached.word()).map(|()| false),
            }
        }
    }

    /// drive_wait_(+Robot, +Timeout, -Reason)
    nondet fn "drive_wait_"<Slices<UntilEnded>>(context, robot, timeout, reason) as call("drive_wait", 2) {
        setup => {
            let (timeout, drive) = (call.seconds(timeout)?, robots_drive(&call, robot)?);
            Ok(Some(drive.until_last_ended(timeout)))
        },
        call(waiting) => {
            call.slice_of_move(waiting, reason)
        }
    }
}

/// How far a pose may be from the true one to be one in the world, in cm and degrees.
const NEAR: f64 = 25.0;
const ABOUT: f64 = 30.0;

/// The odometry counts from this pose on. If it is near the true one, then the program counts in
/// the world's frame. Else its frame is laid on the robot as it truly is now.
fn pose_is_set(believed: Pose) {
    let Some(simulation) = watched_simulation() else {
        return counts_in_world();
    };
    let real = simulation.machine().pose();
    let is_near = (believed.x - real.x).hypot(believed.y - real.y) <= NEAR
        && wrapped(believed.heading - real.heading).abs() <= ABOUT;
    *state::watched().frame() = (!is_near).then_some(Frame { believed, real });
}

/// The program knows where the robot is in the world.
pub(crate) fn counts_in_world() {
    *state::watched().frame() = None;
}

/// `robot(Left, Right, LeftDiameter, RightDiameter, LeftInverted, RightInverted, Axle, Offset)`
fn robot_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Robot> {
    let [left, right, left_diameter, right_diameter, left_inverted, right_inverted, axle, offset] =
        call.arguments(term)?;
    let diameters = [call.float(&left_diameter)?, call.float(&right_diameter)?];
    let inverted = [left_inverted.get_ex()?, right_inverted.get_ex()?];
    let wheels = Wheels::new(diameters, inverted, call.float(&axle)?, call.float(&offset)?);
    Ok(Robot { ports: [call.text(&left)?.into(), call.text(&right)?.into()], wheels })
}

/// The drive of a robot, and whether it is to use its gyro.
pub(crate) fn drive_of<'a, C: Prolog>(
    call: &Call<'a, C>,
    robot: &Term<'a>,
    use_gyro: &Term<'a>,
) -> PrologResult<Arc<Drive>> {
    let drive = robots_drive(call, robot)?;
    drive.use_gyro(use_gyro.get_ex()?);
    Ok(drive)
}

/// The drive of a robot in the tree in use. If no tree is chosen yet, asks Prolog to choose one.
fn robots_drive<'a, C: Prolog>(call: &Call<'a, C>, robot: &Term<'a>) -> PrologResult<Arc<Drive>> {
    call.devices()?;
    let robot = robot_of(call, robot)?;
    if state::known_drive().is_none() {
        pose_is_set(Pose { x: 0.0, y: 0.0, heading: 0.0 });
    }
    Ok(state::drive(&robot))
}

/// `legs(Legs, Backwards)`, `cruise(CmPerSecond, DegreesPerSecond)`, `change` with
/// the same, or `wheels(LeftShare, RightShare)`
fn course_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Command> {
    let [first, second] = call.arguments(term)?;
    let name = term.get::<Functor>()?.name_string();
    Ok(match &*name {
        "cruise" => Command::Cruise(call.float(&first)?, call.float(&second)?),
        "change" => Command::Change(call.float(&first)?, call.float(&second)?),
        "wheels" => Command::Wheels([call.float(&first)?, call.float(&second)?]),
        _ => {
            let legs = call.list(&first)?;
            let legs = legs.iter().map(|leg| leg_of(call, leg)).collect::<PrologResult<_>>()?;
            Command::Legs(legs, second.get_ex()?)
        }
    })
}

fn leg_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Leg> {
    let Some((name, arguments)) = call.compound(term)? else {
        return wrong_value(call, "leg", term);
    };
    Ok(match (&*name, &*arguments) {
        ("turn", [degrees]) => Leg::Turn(call.float(degrees)?),
        ("heading", [heading]) => Leg::Heading(call.float(heading)?),
        ("face", [heading]) => Leg::Face(call.float(heading)?),
        ("towards", [x, y]) => Leg::Towards([call.float(x)?, call.float(y)?]),
        ("to", [x, y]) => Leg::To([call.float(x)?, call.float(y)?]),
        ("reach", [x, y]) => Leg::Reach([call.float(x)?, call.float(y)?]),
        ("arc", [length, curvature]) => Leg::Arc(call.float(length)?, call.float(curvature)?),
        ("through", [points, radius]) => Leg::Through(places(call, points)?, call.float(radius)?),
        _ => return wrong_value(call, "leg", term),
    })
}

fn options_of<'a, C: Prolog>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<(DriveOptions, bool, Option<Duration>)> {
    let [percent, acceleration, action, use_gyro, wait, timeout] = call.arguments(term)?;
    let options = DriveOptions {
        percent: call.float(&percent)?,
        acceleration: call.float(&acceleration)?,
        stop_action: stop_action(call, &action)?,
        use_gyro: use_gyro.get_ex()?,
    };
    Ok((options, wait.get_ex()?, call.seconds(&timeout)?))
}
