//! Terms of the driver's values.
pub(crate) use crate::glue::interned::unify_atom;
use ev3_driver::Value;
use swipl::prelude::*;

/// Unifies with a number or an atom.
pub(crate) fn unify_value(term: &Term, value: &Value) -> PrologResult<()> {
    match value {
        Value::Integer(integer) => term.unify(*integer),
        Value::Float(float) => term.unify(*float),
        Value::Text(text) => unify_atom(term, text),
    }
}
