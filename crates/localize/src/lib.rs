//! Localization of a robot with an ultrasonic sensor on a map.
//!
//! Pure: no devices, no clock, no Prolog. The caller gives each measurement with the pose by
//! odometry, and asks for the poses that are possible.
//!
//! A [`Field`] is a map prepared for the question what is heard where, a [`Model`] says how
//! likely another measurement is there. A [`Localizer`] first remembers what it hears while the
//! robot looks around, then searches the whole map once, and from there follows the poses that
//! are possible as a particle filter.
//!
//! A [`Mapper`] makes a first map, if there is none yet.
//!
//! Sources: Thrun, Burgard, Fox: Probabilistic Robotics (2005), chapters 4, 6, 8; for the number
//! of particles Fox: Adapting the sample size in particle filters through KLD-sampling (2003).
//!
//! Lengths are in centimeters. X goes to the right and y up; headings are in degrees, 0 along +y
//! and clockwise positive. The same input gives the same bits on every machine.
//!
//! ```
//! use ev3_localize::{Field, Localizer, Options, Pose, Step};
//! use ev3_roadmap::{Bounds, Map, Obstacle};
//!
//! let crate_ = Obstacle::rectangle([60.0, 120.0], 40.0, 30.0, 0.0)?;
//! let bounds = Bounds { low: [0.0, 0.0], high: [200.0, 150.0] };
//! let map = Map::new(vec![crate_], Some(bounds))?;
//! let field = Field::new(&map, 8.0, 15.0).unwrap();
//! let mut localizer = Localizer::new(field.clone(), Options::default());
//!
//! // It turns once around at 150, 40; by odometry, which began with its power, at 0, 0.
//! let found = (0..90).find(|look| {
//!     let heading = f64::from(look * 4);
//!     let there = Pose { x: 150.0, y: 40.0, heading: heading + 30.0 };
//!     let heard = field.heard(there.ahead(7.0)).unwrap_or(255.0);
//!     localizer.step(Pose { x: 0.0, y: 0.0, heading }, heard) == Step::Found
//! });
//! assert!(found.is_some());
//! let best = localizer.best().unwrap();
//! assert!((best.pose.x - 150.0).abs() < 3.0 && (best.pose.y - 40.0).abs() < 3.0);
//! # Ok::<(), ev3_roadmap::Fault>(())
//! ```
#![forbid(unsafe_code)]

mod field;
mod localizer;
mod mapper;
mod model;
mod particles;
mod start;

pub use ev3_motion::Pose;
pub use field::{Field, Unfit};
pub use localizer::{Localizer, Options, Step};
pub use mapper::{Mapper, Wall};
pub use model::{FAR, Model, Wander};
pub use particles::{Cluster, Count, Particle};
