//! Foreign library of the pack `ev3dev`: Prolog's view of [`ev3_driver`].
//!
//! One file for each Prolog module. Each predicate takes its arguments out of
//! their terms, calls the driver once, and unifies what it answers. Where the
//! driver answers "there is none", the predicate fails; an error becomes an
//! ISO exception in [`error`], and nowhere else.
//!
//! A native predicate `p_/M` is the twin of the public `p/N` of the Prolog
//! module, and names that in its errors.
mod battery;
mod call;
mod dc_motors;
mod dev;
mod drive;
mod driver;
mod error;
mod halt;
mod keys;
mod lights;
mod motor_moves;
mod motor_settings;
mod motors;
#[cfg(all(feature = "sim", feature = "fuse"))]
mod mount;
#[cfg(all(feature = "sim", not(feature = "fuse")))]
#[path = "no_mount.rs"]
mod mount;
mod navigation;
mod ports;
mod roadmap;
mod robot;
mod screen;
mod sensors;
mod servo_motors;
#[cfg(feature = "sim")]
mod sim;
#[cfg(feature = "sim")]
mod sim_front;
#[cfg(feature = "sim")]
mod simulated;
#[cfg(feature = "sim")]
mod simulated_dev;
mod sound;
#[cfg(feature = "sim")]
mod spec;
mod state;
mod words;

/// Registers all predicates; SWI-Prolog calls it when it loads the library.
// Safety: the name is SWI-Prolog's, and no other library is asked for it: it is
// looked up in this one only.
#[unsafe(no_mangle)]
pub extern "C" fn install() {
    words::register();
    driver::register();
    motors::register();
    motor_moves::register();
    motor_settings::register();
    dc_motors::register();
    servo_motors::register();
    halt::register();
    lights::register();
    battery::register();
    ports::register();
    sensors::register();
    robot::register();
    dev::register();
    keys::register();
    sound::register();
    screen::register();
    roadmap::register();
    navigation::register();
    drive::register();
    #[cfg(feature = "sim")]
    sim::register();
    #[cfg(feature = "sim")]
    sim_front::register();
}
