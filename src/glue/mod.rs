//! The code that all predicates share: a call and its arguments, errors, terms, and the
//! brick in use.
pub(crate) mod call;
pub(crate) mod due;
pub(crate) mod error;
pub(crate) mod interned;
pub(crate) mod known;
#[macro_use]
mod natives;
pub(crate) mod places;
pub(crate) mod signals;
pub(crate) mod sources;
pub(crate) mod state;
pub(crate) mod terms;
pub(crate) mod thinking;
pub(crate) mod waiting;
pub(crate) mod watch;
