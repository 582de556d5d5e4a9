//! The robot's outline in the plane.

/// The outline that walls and boxes stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hull {
    /// A circle around the middle of the axle.
    Circle {
        /// Radius in cm.
        radius: f64,
    },
    /// A rectangle.
    Rectangle {
        /// Extent from left to right, in cm.
        width: f64,
        /// Extent from back to front, in cm.
        length: f64,
        /// How far its center lies ahead of the axle, in cm.
        offset: f64,
    },
}

impl Hull {
    /// The largest distance of a point of it from the middle of the axle.
    pub(crate) fn reach(&self) -> f64 {
        match *self {
            Hull::Circle { radius } => radius,
            Hull::Rectangle { width, length, offset } => {
                libm::hypot(width / 2.0, length / 2.0 + offset.abs())
            }
        }
    }
}
