//! Terms of JSON, as Prolog has them.
use crate::glue::call::Call;
use crate::glue::terms::Prolog;
use ev3_json::Json;
use swipl::prelude::*;

/// Writes `json(Pairs)` of `Name=Value`, a list, a number, `true`, `false`, `null`, or a text.
fn report<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>, json: &mut Json) -> PrologResult<()> {
    let mut done = Ok(());
    match term.term_type() {
        TermType::Integer | TermType::Float => json.number(call.float(term)?, 6),
        TermType::Nil | TermType::ListPair => {
            let parts = call.list(term)?;
            json.array(|json| done = parts.iter().try_for_each(|part| report(call, part, json)));
        }
        TermType::CompoundTerm => {
            let [pairs] = call.arguments(term)?;
            let pairs = call.list(&pairs)?;
            json.object(|json| {
                done = pairs.iter().try_for_each(|pair| {
                    let [name, value] = call.arguments(pair)?;
                    report(call, &value, json.key(&call.text(&name)?))
                });
            });
        }
        _ => match &*call.text(term)? {
            word @ ("true" | "false" | "null") if term.is_atom() => json.raw(word),
            text => json.text(text),
        },
    }
    done
}

/// A term as JSON.
pub(super) fn text<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<String> {
    let mut json = Json::new();
    report(call, term, &mut json)?;
    Ok(json.into_text())
}
