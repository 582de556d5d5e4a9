//! The room of a robot among things that move.
use ev3_motion::Pose;

/// How far the robot may go from a place until a thing may be near.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub(super) from: Pose,
    /// In cm, for each point of the hull.
    pub(super) way: f64,
}

impl Room {
    /// No thing is near, wherever the robot goes.
    pub(super) const ENDLESS: Room = Room { from: Pose::new(0.0, 0.0, 0.0), way: f64::INFINITY };
}
