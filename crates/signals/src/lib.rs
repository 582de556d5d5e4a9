//! The end of a program, in whatever way: its motors stop.
//!
//! The kernel lets a motor run on when the program that started it has gone. So:
//!
//! * A stop of the motors sets a [`latch`] first: from then on none starts.
//! * A signal that asks the program to end, as SIGTERM, goes to two threads first
//!   ([`watch`]). They stop the motors and then let Prolog have the signal; and the process
//!   ends within [`PATIENCE`], whatever Prolog does.
//! * At any other signal that ends a process or makes it stand, the handler itself stops the
//!   motors, by files that are kept open for that ([`Kept`]).
//! * A thread that computes while its motors run ([`guard`]) has them stopped.
//! * At SIGKILL nothing can be done within the process. A small one beside it
//!   ([`survive`]) stops the motors as soon as this one has gone.
//!
//! Prolog's own end, as by halt/0, is the affair of `prolog/ev3dev/private/run/halt.pl`.
//!
//! A signal that asks the program to end goes through these states:
//!
//! ```text
//!            handler: SIGNAL           asker: GOES_ON
//!   nothing ----------------> asked ------------------> nothing; Prolog gets the signal
//!      ^                      |   |
//!      |              500 ms  |   |  asker: ENDS, motors are stopped
//!      |                      v   v
//!      |  asker: GOES_ON   late   ending; Prolog gets the signal
//!      `------------------- |       |
//!   the latch is lifted     |       |  2 s after the signal
//!                           v       v
//!                     the watchdog ends the process
//! ```
//!
//! *Late*: the motors are stopped, and Prolog gets the signal without an answer.
//!
//! If there are no signals there is the latch alone.
#![cfg_attr(unix, expect(unsafe_code, reason = "handlers of signals, and processes, are C's"))]
#[cfg(unix)]
mod computing;
#[cfg(unix)]
mod crash;
#[cfg(unix)]
mod events;
#[cfg(unix)]
mod handlers;
#[cfg(unix)]
mod kept;
pub mod latch;
#[cfg(unix)]
mod lines;
#[cfg(not(unix))]
mod none;
#[cfg(unix)]
mod stack;
#[cfg(unix)]
mod survivor;
#[cfg(unix)]
mod watchdog;

#[cfg(unix)]
pub use computing::{guard, lives};
#[cfg(unix)]
pub use kept::Kept;
#[cfg(unix)]
pub use lines::leave;
#[cfg(not(unix))]
pub use none::{
    Asked, guard, halts, is_to_halt, leave, lives, own_handlers_stack, stop_for, survive, watch,
};
#[cfg(unix)]
pub use stack::own_handlers_stack;
#[cfg(unix)]
pub use survivor::survive;
#[cfg(unix)]
pub use watchdog::{Asked, PATIENCE, halts, is_to_halt, watch};

/// Ends this process at once, by SIGKILL.
#[cfg(unix)]
pub fn vanish() {
    let _ = nix::sys::signal::raise(nix::sys::signal::SIGKILL);
}

/// Stops the motors that run and whose files are kept, and keeps all from starting.
#[cfg(unix)]
pub fn stop_for(reason: latch::Reason) {
    handlers::stop_for(reason);
}
