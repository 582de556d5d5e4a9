//! Terms of the driver's values.
pub(crate) use crate::glue::interned::unify_atom;
use ev3_driver::Value;
use swipl::prelude::*;

/// What the context of a native predicate can do: call Prolog.
pub(crate) use swipl::prelude::QueryableContextType as Prolog;

/// Unifies with a number or an atom.
pub(crate) fn unify_value(term: &Term, value: &Value) -> PrologResult<()> {
    match value {
        Value::Integer(integer) => term.unify(*integer),
        Value::Float(float) => term.unify(*float),
        Value::Text(text) => unify_atom(term, text),
    }
}

/// Calls a predicate of Prolog once.
pub(crate) trait Ask {
    /// As `call_once`, but after an exception nothing is called: Prolog's handlers of signals
    /// may raise one at any moment. And the query is cut, not closed: to close it undoes what
    /// it did, and 9.0.4 may lose the exception with that.
    fn ask<P: Callable<N>, const N: usize>(
        &self,
        predicate: P,
        arguments: [&Term; N],
    ) -> PrologResult<()>;
}

impl<C: Prolog> Ask for Context<'_, C> {
    fn ask<P: Callable<N>, const N: usize>(
        &self,
        predicate: P,
        arguments: [&Term; N],
    ) -> PrologResult<()> {
        if self.has_exception() {
            return Err(PrologError::Exception);
        }
        let query = self.open(predicate, arguments);
        let result = query.next_solution().map(|_| ());
        query.cut();
        result
    }
}
