//! Motors, sensors, lights, ports and the battery over an ev3dev file tree.
//!
//! ev3dev shows each device as a directory of small text files, its *attributes*:
//! `/sys/class/tacho-motor/motor0/position` holds a motor's position, and writing `run-forever` to
//! `command` beside it makes the motor turn. This crate finds devices by the port they are plugged
//! into, keeps their attribute files open, and does on top of that what takes more than one read or
//! write: run several motors at once, wait until they are done, read a sensor in a given mode, turn
//! a robot by its gyro.
//!
//! ```no_run
//! use ev3_driver::motor::{Extent, Move, MoveOptions, Speed, run_to};
//! use ev3_driver::{Class, Registry, SysfsDir};
//! use std::sync::Arc;
//!
//! let devices = Arc::new(Registry::new(Arc::new(SysfsDir::new("/sys/class"))));
//! let interrupted = &mut || false; // asked every few milliseconds
//! if let Some(motor) = devices.find(Class::TachoMotor, "outB")? {
//!     println!("{} counts a turn", motor.number("count_per_rot")?);
//! }
//! // One turn at half speed, to its end; `None` if there is no such motor.
//! let turn = Move { port: "outB", speed: Speed::Percent(50.0), extent: Extent::By(360.0) };
//! match run_to(&devices, &[turn], &MoveOptions::default(), interrupted)? {
//!     Some(reason) => println!("{}", reason.word()),
//!     None => println!("no motor at outB"),
//! }
//! # Ok::<(), ev3_driver::Error>(())
//! ```
//!
//! From the bottom up (`tools/layers.txt` says who may import whom):
//!
//! * [`sysfs`]: where the attribute files are: the kernel's, any directory
//!   shaped like it, or something that only behaves so. It also owns the clock.
//! * [`devfs`]: the device files below `/dev`.
//! * [`course`], [`journal`]: what a program asks of a robot, and what it has done.
//! * [`device`]: one device, its kept descriptors and its constants; which
//!   devices there are, by class and port ([`device::registry`]).
//! * [`motor`], [`sensor`], [`attributes`]: running motors and waiting for them,
//!   reading sensors, any attribute by its name.
//! * [`brick`]: lights, battery, buttons, sound, screen and ports.
//! * [`drive`]: where a robot is and how it gets elsewhere.
//!
//! The facts about ev3dev's drivers in the comments were read out of the
//! kernel drivers of `ev3dev/lego-linux-drivers` (stretch and later).
//!
//! Nothing here but [`Sysfs::every`] over real files starts a thread; nothing prints, or waits
//! without asking its caller every few milliseconds whether to go on ([`Interrupted`]).
#![forbid(unsafe_code)]

pub mod attributes;
pub mod brick;
pub mod class;
pub mod course;
pub mod devfs;
pub mod device;
pub mod drive;
pub mod error;
mod files;
pub mod journal;
pub mod motor;
pub mod port_name;
pub mod sensor;
mod stop_action;
pub mod sysfs;
pub mod value;
pub mod wait;

pub use class::Class;
pub use devfs::Devfs;
pub use device::Device;
pub use device::registry::Registry;
pub use error::{Error, Interrupted, Result};
pub use ev3_os::Errno;
pub use files::{DevfsDir, SysfsDir};
pub use sysfs::Sysfs;
pub use value::Value;
