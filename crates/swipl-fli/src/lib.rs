//! The low layer under the [`swipl`] crate, written by hand.
//!
//! The published `swipl-fli` is made by bindgen from the headers of whichever
//! SWI-Prolog is installed, and links that version's library. A binary made so
//! runs with that version alone. This crate has the same name, version and
//! interface, as far as `swipl` uses it, and differs in six points:
//!
//! * **Nothing is linked.** The process that loads the library is SWI-Prolog
//!   and resolves the symbols. Neither libclang nor SWI-Prolog is needed to
//!   build.
//! * **One binary for every version from 7.2 to 10.** Functions that return
//!   `int` in old headers and `bool` in new ones are called as returning a
//!   byte, which is right for both ([`functions`]). Functions that old versions
//!   lack are looked up when first used ([`late`]).
//! * **32 bit.** [`qid_t`] is wide enough for `swipl`, which turns a
//!   `u64` into one, and is narrowed where it is passed on.
//! * **Counts.** Where headers say `int` in old versions and `size_t` in new
//!   ones, a `usize` is passed: a callee that takes an `int` reads the low half
//!   of the register, or, on 32 bit, the same word.
//! * **One end.** Old versions end a predicate that throws twice; here the second
//!   time is left out. And a predicate may answer the common calls at once ([`pruned`]).
//! * **The prompt, the output, and the end.** What is to be done while Prolog waits for input
//!   ([`prompt`]), when it writes ([`output`]), and when it halts ([`halt`]).
//!
//! In WebAssembly all functions are imported from the module `swipl`, which the loader binds to
//! SWI-Prolog's, and memory is SWI-Prolog's (`memory`).
//!
//! Names and meanings are those of `SWI-Prolog.h`; its manual documents them.
//!
//! [`swipl`]: https://docs.rs/swipl
#![allow(
    missing_docs,
    non_camel_case_types,
    non_snake_case,
    non_upper_case_globals,
    clippy::missing_safety_doc,
    clippy::must_use_candidate,
    reason = "names are C's, and documented in SWI-Prolog's manual"
)]

pub mod functions;
pub mod halt;
pub mod late;
#[cfg(target_family = "wasm")]
mod memory;
pub mod output;
pub mod prompt;
pub mod pruned;
pub mod types;
mod version;

pub use functions::*;
pub use halt::act_at_halt;
pub use late::*;
pub use output::{see_output, see_output_no_more};
pub use prompt::{Act, act_without_input};
pub use pruned::{_PL_retry_address, Arguments, PL_register_foreign_in_module, answer_quickly};
pub use types::*;
