//! A robot's gripper, as plain data.

use crate::brick::port::Port;

/// A gripper: two jaws that a motor closes toward its upper stop. It holds the thing between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gripper {
    /// The output port of its motor.
    pub port: Port,
    /// The point between the jaws, from the middle of the axle, x to the right, y ahead, in cm.
    pub at: [f64; 2],
    /// How far apart the jaws are at the lower stop, in cm.
    pub opening: f64,
    /// The most force with which it holds, in N.
    pub force: f64,
    /// The most torque with which it keeps a thing from turning, in N m; 0 for a pivot.
    pub torque: f64,
    /// The thing leaves the floor.
    pub lifts: bool,
}

impl Default for Gripper {
    fn default() -> Gripper {
        let (force, torque) = (2.0, 0.02);
        Gripper { port: Port::OutA, at: [0.0; 2], opening: 8.0, force, torque, lifts: false }
    }
}
