//! The courses of a robot on two wheels, as a program asks for them.
use crate::stop_action::StopAction;
use ev3_motion::Segment;

/// A command to the drive.
#[derive(Clone, Debug)]
pub enum Command {
    /// One part after the other. The second says whether rear first.
    Legs(Vec<Leg>, bool),
    /// On and on: speed in cm/s, rate of turn in degrees a second.
    Cruise(f64, f64),
    /// The same for the motion under way, unless it has ended.
    Change(f64, f64),
    /// On and on: the speed of each wheel as a share of that of the faster one.
    Wheels([f64; 2]),
}

/// How to carry out a command.
#[derive(Clone, Copy, Debug)]
pub struct DriveOptions {
    /// Of the faster wheel, in percent of what it can. Not for a cruise.
    pub percent: f64,
    /// In cm/s².
    pub acceleration: f64,
    /// The action of the motors at the end.
    pub stop_action: StopAction,
    /// Whether the gyro, if there is one, measures the heading.
    pub use_gyro: bool,
}

/// A part of a motion. Relative ones count from where the part before was to end.
#[derive(Clone, Debug, PartialEq)]
pub enum Leg {
    /// Turn on the spot by an angle in degrees.
    Turn(f64),
    /// Turn on the spot to a heading as it is, full turns included.
    Heading(f64),
    /// Turn on the spot to a heading, the shorter way round.
    Face(f64),
    /// Turn on the spot towards a place, front or rear first.
    Towards([f64; 2]),
    /// Go to a place with the middle of the axle.
    To([f64; 2]),
    /// Go to a place with the robot's reference point.
    Reach([f64; 2]),
    /// An arc: its length in cm and its curvature in the direction of travel.
    Arc(f64, f64),
    /// A path through places, its corners rounded with a radius.
    Through(Vec<[f64; 2]>, f64),
    /// A path without corners.
    Pieces(Vec<Segment>),
}
