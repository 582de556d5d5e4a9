//! The pose of a robot in the plane, and the lines and arcs along which it goes.
//!
//! Pure geometry: no devices, no obstacles, no clock. The driver steers along
//! what is here, and the roadmap finds it.
//!
//! Lengths are in centimeters. X goes to the right and y up; headings are in degrees, 0 along +y
//! and clockwise positive. The same input gives the same bits on every machine.
//!
//! A [`Svg`] is a picture of the plane. A [`Segment`] is a line or an arc, a [`Path`] is made of segments. Corners
//! become arcs:
//!
//! ```
//! use ev3_motion::{Path, Segment, rounded};
//!
//! // A corner at 0, 50 with a radius of 10 cm.
//! let pieces = rounded(&[[0.0, 0.0], [0.0, 50.0], [50.0, 50.0]], 10.0);
//! let path = Path::new(pieces.concat());
//! let [before, arc, _] = path.segments() else { panic!() };
//! assert_eq!(before.to(), arc.from());
//! assert!((arc.radius().unwrap() - 10.0).abs() < 1e-9, "to the right");
//! assert!((arc.turn() - 90.0).abs() < 1e-9);
//!
//! // A robot in the middle of the arc, 1 cm too far out.
//! let middle = arc.at(arc.length() / 2.0);
//! let out = [middle.x - 0.5_f64.sqrt(), middle.y + 0.5_f64.sqrt()];
//! let place = arc.locate(out, 0.0);
//! assert!((place.along - arc.length() / 2.0).abs() < 1e-9);
//! assert!((place.aside + 1.0).abs() < 1e-9, "to the left of it");
//! ```
#![forbid(unsafe_code)]

mod path;
mod plane;
mod pose;
mod segment;
mod svg;

pub use path::Path;
pub use plane::{
    Bounds, FARTHEST, Frame, OUT_OF_RANGE, Point, Vec2, direction, distance, frame, heading_vector,
    is_in_range, length, outside, point, sin_cos, vec2,
};
pub use pose::{Pose, sinc, wrapped};
pub use segment::{Place, Segment, rounded};
pub use svg::{Svg, points};
