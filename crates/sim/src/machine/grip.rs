//! The grippers of a robot: what they hold, and when they lose it.
use crate::mechanics::pair::Joint;
use crate::mechanics::shaft::Shaft;
use crate::mechanics::thing::Thing;
use crate::world::{Gripper, ItemId};
use ev3_motion::{Pose, Vec2, outside};
use parry2d_f64::math::Point;

/// What is farther off than this, in cm, is lost.
const LOST: f64 = 1.0;
/// A gripper that opens by this, in degrees of its motor, lets go.
const LETS_GO: f64 = 5.0;

/// The state of a gripper.
#[derive(Clone, Debug, Default)]
pub(crate) struct Grip {
    /// How far its jaws were apart after the last tick, in cm.
    opening: f64,
    held: Option<Held>,
}

#[derive(Clone, Debug)]
struct Held {
    thing: ItemId,
    /// The point between the jaws in the frames of robot and thing.
    at: [Vec2; 2],
    /// How far the thing is turned from the robot, in degrees.
    turned: f64,
    /// The angle of the motor at which the jaws met it.
    angle: f64,
    impulses: [f64; 3],
}

impl Grip {
    /// The thing that it holds.
    pub(crate) fn held(&self) -> Option<ItemId> {
        self.held.as_ref().map(|held| held.thing)
    }

    /// It loses what it holds if that is too far off.
    pub(crate) fn is_off(&mut self, off: f64) {
        self.held.take_if(|_| off > LOST);
    }

    /// What it holds, as a joint of these two bodies.
    pub(crate) fn joint(&mut self, gripper: &Gripper, bodies: [usize; 2]) -> Option<Joint<'_>> {
        let Gripper { force, torque, .. } = *gripper;
        let Held { at, turned, impulses, .. } = self.held.as_mut()?;
        Some(Joint { bodies, at: *at, turned: *turned, force, torque, impulses })
    }

    /// It loses what is meant: that lies there now.
    pub(super) fn let_go(&mut self, is_meant: impl Fn(ItemId) -> bool) {
        self.held.take_if(|held| is_meant(held.thing));
    }

    /// The jaws hold what is between them when they close, and lose it when they open.
    pub(super) fn turn(
        &mut self,
        gripper: &Gripper,
        shaft: &mut Shaft,
        robot: &Pose,
        things: &[Thing],
    ) {
        let Some(share) = shaft.share() else { return };
        let opening = gripper.opening * (1.0 - share);
        let angle = shaft.angle;
        self.held.take_if(|held| {
            angle < held.angle - LETS_GO || things.iter().all(|thing| thing.id != held.thing)
        });
        if self.held.is_none() {
            let (frame, at) = (robot.frame(), Vec2::from(gripper.at));
            let point = outside(&frame, at);
            let across = frame.rotation * Vec2::new(1.0, 0.0);
            let met = things.iter().find(|thing| {
                let wide = thing.obstacle().chord(point, across);
                wide.is_some_and(|wide| self.opening > wide && opening <= wide)
            });
            self.held = met.map(|thing| {
                let inside = thing.pose().frame().inverse() * Point::from(point);
                let turned = thing.pose().heading - robot.heading;
                let at = [at, inside.coords];
                Held { thing: thing.id, at, turned, angle, impulses: [0.0; 3] }
            });
        }
        shaft.blocked = self.held.as_ref().map(|held| held.angle);
        self.opening = opening;
    }
}
