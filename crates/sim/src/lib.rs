//! An ev3dev brick, its robot and the world around it, simulated.
//!
//! [`Machine`] owns everything: a file tree shaped like `/sys/class` of ev3dev-stretch, the
//! drivers behind the files, motors with inertia and friction, a robot with two driven wheels, and
//! a flat world with walls, boxes, colored floors, lamps and infrared beacons. Time passes only in
//! [`Machine::step`], in ticks of 2 ms, which is the period of the kernel's motor loop. The same
//! seed and the same calls give the same bytes on every machine, however time is sliced: all
//! arithmetic is integer or IEEE `f64`, and sines and cosines come from the `libm` crate.
//!
//! ```
//! use std::time::Duration;
//! use ev3_sim::facts::Fact;
//! use ev3_sim::{Access, Hull, Machine, MotorMount, Noise, Options, Port, RobotSpec, Wheel};
//! use ev3_sim::WorldSpec;
//!
//! let wheel = |port| Wheel { port, diameter: 5.6, inverted: false, slip: 0.0 };
//! let motor = |port| MotorMount {
//!     port,
//!     driver: "lego-ev3-l-motor".to_owned(),
//!     noise: None,
//!     encoder_noise: None,
//!     stops: None,
//! };
//! let robot = RobotSpec::from_facts(&[
//!     Fact::LeftWheel(wheel(Port::OutB)),
//!     Fact::RightWheel(wheel(Port::OutC)),
//!     Fact::Axle(10.6),
//!     Fact::Hull(Hull::Circle { radius: 8.0 }),
//!     Fact::Mass(0.75),
//!     Fact::Motor(motor(Port::OutB)),
//!     Fact::Motor(motor(Port::OutC)),
//! ])?;
//! let mut machine = Machine::new(&WorldSpec::default(), &robot, Options::default())?;
//! machine.write_path("tacho-motor/motor0/speed_sp", "300").unwrap();
//! machine.write_path("tacho-motor/motor0/command", "run-forever").unwrap();
//! machine.step(Duration::from_secs(1));
//! assert_eq!(machine.read_path("tacho-motor/motor0/state").unwrap(), "running\n");
//! let motor = machine.open("tacho-motor/motor0/position", Access::ReadOnly).unwrap();
//! let text = String::from_utf8(machine.read(motor).unwrap()).unwrap();
//! assert!((250..300).contains(&text.trim().parse::<i32>().unwrap()), "{text}");
//! # Ok::<(), ev3_sim::SpecError>(())
//! ```
//!
//! A program's adapter (in the process, or FUSE) only translates; see [`Descriptor`] for what
//! `pread` and `poll` do on an open file, and [`Written::blocks`] for calls that take their time.
//! A [`Machine`] is a plain value: `clone` is a snapshot, assignment restores it.
//!
//! # Waiting
//!
//! A [`Machine`] has no clock of its own; a [`Simulation`] gives it one, by the wall or virtual. An
//! adapter may also step the machine itself. Here a program that waits for a file lets time jump:
//!
//! ```no_run
//! # use ev3_sim::{Access, Descriptor, Machine};
//! # fn wait(mut machine: Machine) -> Result<(), ev3_sim::Errno> {
//! let mut state = Descriptor::open(&machine, "tacho-motor/motor0/state", Access::ReadOnly)?;
//! let mut text = [0; 64];
//! loop {
//!     let length = state.pread(&mut machine, 0, &mut text)?;
//!     if !text[..length].starts_with(b"running") {
//!         break;
//!     }
//!     while !state.poll(&machine) {
//!         machine.step(machine.next_event().saturating_sub(machine.now()));
//!     }
//! }
//! # Ok(())
//! # }
//! ```
//!
//! A program that reads sensors in a loop and never waits would stop time; an adapter lets each
//! access cost a little (a real brick needs about 40 µs for one).
//!
//! # Where to read on
//!
//! Each folder's comments say how the hardware behaves that it models. Each imports only from those
//! before it, and from `noise.rs`:
//!
//! - `files`: what attribute files have in common;
//! - `brick`: ports, lights, battery, buttons, speaker and screen;
//! - `world`: walls, boxes, floors and lamps, and how they stop rays and hulls;
//! - `motor`, `sensor`: the kernel's drivers, and what is inside the devices;
//! - `robot.rs`: what a robot is made of;
//! - [`facts`]: the vocabulary of world and robot files;
//! - `mechanics`: shafts, wheels and the body;
//! - `sense`: what the sensors notice of the world;
//! - `log.rs`, `trace.rs`: what has happened;
//! - `machine`: all of these as one value, its file tree, and time;
//! - `shared.rs`, `clock`: a machine that several threads use, and how time passes for it;
//! - `access.rs`, [`far`]: what a program does with its files, here or from another process;
//! - `fuse`: the tree as real files.
#![forbid(unsafe_code)]

mod access;
mod brick;
mod clock;
pub mod facts;
pub mod far;
mod files;
#[cfg(feature = "fuse")]
mod fuse;
mod log;
mod machine;
mod mechanics;
mod motor;
mod noise;
mod robot;
mod sense;
mod sensor;
mod shared;
mod ticks;
mod trace;
mod wheel;
mod world;

pub use access::OpenDevice;
pub use brick::panel::{Button, UnknownButton};
pub use brick::port::{Port, UnknownPort};
pub use brick::remote::RemoteButton;
pub use brick::screen::Depth;
pub use clock::{Act, Clock, Simulation, is_outside, stay_outside};
pub use ev3_motion::{Bounds, Point, Pose};
pub use ev3_os::linux::Errno;
pub use files::attr::Access;
#[cfg(feature = "fuse")]
pub use fuse::{Mount, MountError};
pub use machine::crowd::{Misplaced, robot_of};
pub use machine::descriptor::Descriptor;
pub use machine::dev::DevDescriptor;
pub use machine::film::Sample;
pub use machine::shown::{Shown, ShownMotor, ShownSensor};
pub use machine::tree::{Entry, FileKind, NodeId, Stat};
pub use machine::{Machine, Options, Written};
pub use mechanics::thing::Thing;
pub use motor::{MOTOR_KINDS, MotorKind};
pub use noise::{Echo, Noise};
pub use robot::{MotorMount, RobotSpec, SensorMount, Wheel, Wheels};
pub use sense::sight::Sight;
pub use sensor::{Link, SensorKind};
pub use shared::Shared;
pub use trace::{Action, Collision, Event, Trace};
pub use world::color::{Color, UnknownColor};
pub use world::{
    Cell, Drawing, Drawn, Gripper, Hull, Item, ItemId, Part, Shape, SpecError, Traits, WorldSpec,
    check_bounds,
};
