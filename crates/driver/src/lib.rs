//! Motors, sensors, lights, ports and the battery over an ev3dev file tree.
//!
//! ev3dev shows each device as a directory of small text files, its
//! *attributes*: `/sys/class/tacho-motor/motor0/position` holds a motor's
//! position, and writing `run-forever` to `command` beside it makes the motor
//! turn. This crate finds devices by the port they are plugged into, keeps
//! their attribute files open, and does on top of that what takes more than
//! one read or write: run several motors at once, wait until they are done,
//! read a sensor in a given mode, turn a robot by its gyro.
//!
//! From the bottom up:
//!
//! * [`tree`]: where the files are: the kernel's, any directory shaped like
//!   it, or something that only behaves so. It also owns the clock.
//! * [`device`]: one device, its kept descriptors and its constants.
//! * [`devices`]: which devices there are, by class and port.
//! * [`dev`]: the device files below `/dev`; [`keys`], [`sound`] and
//!   [`screen`] work on them, with a [`frame`] to draw on and a [`picture`] for files.
//! * [`attributes`], [`motor`], [`dc`], [`servo`], [`wait`], [`sensor`],
//!   [`turn`], [`light`], [`battery`], [`lego_port`]: what robots do.
//! * [`odometry`], [`path`], [`steering`]: where a robot is and how it gets
//!   elsewhere, without any device; [`drive`]: the same with its devices.
//!
//! The facts about ev3dev's drivers in the comments were read out of the
//! kernel drivers of `ev3dev/lego-linux-drivers` (stretch and later).
//!
//! Nothing here but [`Tree::every`] over real files starts a thread; nothing
//! prints, or waits without asking its caller
//! every few milliseconds whether to go on ([`Interrupted`]).
#![forbid(unsafe_code)]

pub mod attributes;
pub mod battery;
mod bin_data;
pub mod dc;
pub mod dev;
pub mod device;
pub mod devices;
pub mod drive;
pub mod error;
pub mod frame;
mod held;
pub mod keys;
pub mod lego_port;
pub mod light;
mod list;
pub mod motor;
pub mod odometry;
pub mod path;
mod patience;
pub mod picture;
pub mod port;
mod programs;
pub mod screen;
pub mod sensor;
pub mod servo;
pub mod sound;
pub mod steering;
pub mod tree;
pub mod turn;
pub mod value;
pub mod wait;

pub use dev::{Dev, DevFiles};
pub use device::Device;
pub use devices::{Class, Devices};
pub use error::{Error, Result};
pub use rustix::io::Errno;
pub use tree::{Files, Tree};
pub use value::Value;

/// Asked at least every 20 ms while something waits; `true` abandons the wait
/// with [`Error::Interrupted`]. Ctrl-C, time limits and signals come in here.
pub type Interrupted<'a> = &'a mut dyn FnMut() -> bool;
