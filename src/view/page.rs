//! The page itself is where this library runs: it is talked with without a server.
use super::terms;
use crate::glue::call::Call;
use crate::glue::terms::{Prolog, unify_atom};
use ev3_os::page;
use swipl::prelude::*;

natives! {
    /// view_hear_(+Page, +Seconds, -Line): the next line of the page; `none` if there is none.
    semidet fn "view_hear_"(_context, _page, _seconds, line) {
        match page::hear() {
            Some(text) => line.unify(text.as_str()),
            None => unify_atom(line, "none"),
        }
    }

    /// view_say_(+Page, +Json)
    semidet fn "view_say_"(context, page, answer) as call("view", 1) {
        say(&call, page, &terms::text(&call, answer)?)
    }
}

pub(super) fn say<C: Prolog>(_call: &Call<C>, _page: &Term, text: &str) -> PrologResult<()> {
    page::say_to_page(text);
    Ok(())
}
