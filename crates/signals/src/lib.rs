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
//! * At SIGKILL nothing can be done within the process. A small one beside it
//!   ([`survive`]) stops the motors as soon as this one has gone.
//!
//! Prolog's own end, as by halt/0, is the affair of `prolog/ev3dev/private/halt.pl`.
#![expect(unsafe_code, reason = "handlers of signals, and processes, are C's")]
mod crash;
mod handlers;
mod kept;
pub mod latch;
mod stack;
mod survivor;
mod watchdog;

pub use kept::{Kept, leave};
use latch::Reason;
pub use stack::own_handlers_stack;
pub use survivor::survive;
pub use watchdog::{Asked, PATIENCE, halts, is_to_halt, watch};

/// Stops the motors that run and whose files are kept, and keeps all from starting.
pub fn stop_for(reason: Reason) {
    handlers::stop_for(reason);
}
