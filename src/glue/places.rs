//! Places: `X-Y` in cm. Read as `[X, Y]`, too, as `prolog/ev3dev/private/checks/places.pl` does.
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::terms::Prolog;
use swipl::prelude::*;

/// The x and y of a place.
pub(crate) fn place<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<[f64; 2]> {
    let pair = if matches!(term.term_type(), TermType::Nil | TermType::ListPair) {
        <[Term; 2]>::try_from(call.list(term)?).ok()
    } else if term.is_var() {
        Some(call.arguments(term)?)
    } else {
        attempt_opt(call.context.compound_terms(term))?
            .filter(|_| term.get::<Functor>().is_ok_and(|f| f.name_string() == "-"))
    };
    match pair {
        Some([x, y]) => Ok([call.float(&x)?, call.float(&y)?]),
        None => wrong_value(call, "place", term),
    }
}

/// A list of places.
pub(crate) fn places<'a, C: Prolog>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<Vec<[f64; 2]>> {
    call.map_list(term, |at| place(call, &at))
}

/// `X-Y`.
pub(crate) fn place_term<'a, C: Prolog>(
    call: &Call<'a, C>,
    [x, y]: [f64; 2],
) -> PrologResult<Term<'a>> {
    let term = call.context.new_term_ref();
    term.unify(Functor::new("-", 2))?;
    term.unify_arg(1, x)?;
    term.unify_arg(2, y)?;
    Ok(term)
}

/// A list of `X-Y`.
pub(crate) fn places_term<'a, C: Prolog>(
    call: &Call<'a, C>,
    places: &[[f64; 2]],
) -> PrologResult<Term<'a>> {
    let terms = places.iter().map(|at| place_term(call, *at)).collect::<PrologResult<Vec<_>>>()?;
    let list = call.context.new_term_ref();
    list.unify(terms.as_slice())?;
    Ok(list)
}
