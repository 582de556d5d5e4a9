//! Foreign library of the pack `ev3dev`: Prolog's view of [`ev3_driver`].
//!
//! One file for each Prolog module. Each predicate takes its arguments out of
//! their terms, calls the driver once, and unifies what it answers. Where the
//! driver answers "there is none", the predicate fails; an error becomes an
//! ISO exception in [`error`], and nowhere else.
//!
//! A native predicate `p_/M` is the twin of the public `p/N` of the Prolog
//! module, and names that in its errors.
mod call;
mod drive;
mod driver;
mod error;
mod motors;
#[cfg(all(feature = "sim", feature = "fuse"))]
mod mount;
#[cfg(all(feature = "sim", not(feature = "fuse")))]
#[path = "no_mount.rs"]
mod mount;
mod navigation;
mod roadmap;
mod robot;
mod sensors;
#[cfg(feature = "sim")]
mod sim;
#[cfg(feature = "sim")]
mod simulated;
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
    sensors::register();
    robot::register();
    roadmap::register();
    navigation::register();
    drive::register();
    #[cfg(feature = "sim")]
    sim::register();
}
