//! Ways for a round robot among obstacles in the plane.
//!
//! A [`Map`] holds polygons, which may be concave, and circles. A way is found for the robot's
//! center, which keeps a distance from all of them: the robot's radius, and what it is to leave as
//! a margin. [`plan`] does it in two steps:
//!
//! 1. a **roadmap**, straight lines that keep the distance, and the shortest
//!    way along it: the *visibility graph* joins the corners of the obstacles
//!    blown up by the distance, and so has the shortest way there is; a
//!    *probabilistic roadmap* joins points drawn at random, *RRT*
//!    grows a tree from the start, or a second one from the goal, and *RRT\** makes
//!    its ways shorter. These do not mind how many corners the obstacles have;
//! 2. **smoothing**: detours are cut short, and corners become arcs that keep
//!    the distance, too, as wide as fits.
//!
//! [`Views`] is what an ultrasonic sensor has seen on the way: where nothing
//! stands, so that the robot may go there, and obstacles that the map lacks.
//! [`Views::next_step`] plans with both, and says how far the robot may go.
//!
//! Lengths are in centimeters. X goes to the right and y up; headings are in degrees, 0 along +y
//! and clockwise positive. The same input gives the same bits on every machine.
//!
//! ```
//! use ev3_roadmap::{Map, Obstacle, Options, plan};
//!
//! let wall = Obstacle::wall([0.0, 50.0], [100.0, 50.0], 2.0)?;
//! let map = Map::new(vec![wall], None)?;
//! let found = plan(&map, [20.0, 0.0], [20.0, 100.0], &Options::default()).unwrap();
//! assert!(found.path.length() < 140.0);
//! assert!(found.path.points().len() > 2, "around the wall's end");
//! # Ok::<(), ev3_roadmap::Fault>(())
//! ```
#![forbid(unsafe_code)]

mod arc;
mod explore;
mod geometry;
mod map;
mod plan;
mod prm;
mod problem;
mod rrt;
mod search;
mod smooth;
mod svg;
mod views;
mod visibility;

pub use ev3_motion::{Bounds, Path, Point, Segment};
pub use explore::Step;
pub use map::{Fault, Map, Obstacle};
pub use plan::{NoWay, Solution, plan};
pub use problem::{Method, Options};
pub use svg::svg;
pub use views::{Safe, View, Views};
