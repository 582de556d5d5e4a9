//! Replaces `mount.rs` if the library is built without FUSE.
use crate::glue::call::Call;
use crate::glue::error::no_such;
use crate::glue::terms::Prolog;
use ev3_sim::Shared;
use std::sync::Arc;
use swipl::prelude::*;

/// Raises the error that the library has no FUSE.
pub(crate) fn mount<C: Prolog>(
    call: &Call<C>,
    _machine: &Arc<Shared>,
    _classes: &Term,
    _dev: Option<&Term>,
) -> PrologResult<()> {
    no_such(call, "feature", "fuse", "this library was built without FUSE")
}

/// Fails: nothing is mounted.
pub(crate) fn unmount<C: Prolog>(_call: &Call<C>) -> PrologResult<()> {
    Err(PrologError::Failure)
}

/// Nothing is mounted.
pub(crate) fn end() {}

/// Nothing is mounted.
pub(crate) fn end_of(_brick: u32) {}

/// Nothing is.
pub(crate) fn is_mounted() -> bool {
    false
}
