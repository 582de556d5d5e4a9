//! The page's server, and the talk with each page: what `crates/door` has, for Prolog.
use super::reach::{outside, stop_motors};
use super::{simulated, terms};
use crate::glue::call::{Call, Text};
use crate::glue::terms::{Prolog, unify_atom};
use crate::sim::watched_simulation;
use ev3_door::{Door, Heard, Made, Page, Site, Visit};
use ev3_os::locked;
use ev3_signals::latch::{self, Reason};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use swipl::prelude::*;

/// The server, if there is one.
static DOOR: Mutex<Option<Arc<Door>>> = Mutex::new(None);

/// The files that a page can save.
const MADE: [Made; 1] = [Made {
    path: "/samples.csv",
    kind: "text/csv; charset=utf-8",
    make: || outside(|| simulated::csv(&watched_simulation()?.machine())),
    lacking: "There are no samples.",
}];

natives! {
    /// view_serve_(+Address, +Port, +Token, +Files, -Served): serves the page, with the files of a
    /// folder, at a port; 0 is any. Served is the port, or a text that says why not. If Token is
    /// empty, everybody may read the folder.
    semidet fn "view_serve_"(context, address, port, token, files, served) as call("view", 1) {
        let owned = |term: &Term| call.text(term).map(Text::into_owned);
        let any = call.text(address)? == "any";
        let port = u16::try_from(call.integer(port)?).unwrap_or_default();
        let (token, files) = (owned(token)?, PathBuf::from(owned(files)?));
        match Door::open(Site { any, port, token, files, made: &MADE, stop }) {
            Ok(door) => {
                let port = door.port();
                *locked(&DOOR) = Some(Arc::new(door));
                served.unify(u64::from(port))
            }
            Err(error) => served.unify(error.to_string().as_str()),
        }
    }

    /// view_visit_(-Visit): waits until a page comes, and is its number, or until STOP is pressed
    /// without one, and is `stop`. Fails if the server has ended.
    semidet fn "view_visit_"(_context, visit) {
        match door()?.visit() {
            Some(Visit::Page(number)) => visit.unify(u64::from(number)),
            Some(Visit::Stop) => unify_atom(visit, "stop"),
            None => Err(PrologError::Failure),
        }
    }

    /// view_hear_(+Page, +Seconds, -Line): waits so long for a line; `none` if there was none.
    /// Fails if the page has gone.
    semidet fn "view_hear_"(context, page, seconds, line) as call("view", 1) {
        match page_of(&call, page)?.hear(call.time(seconds)?) {
            Heard::Line(text) => line.unify(text.as_str()),
            Heard::Nothing => unify_atom(line, "none"),
            Heard::End => Err(PrologError::Failure),
        }
    }

    /// view_say_(+Page, +Json): does nothing if the page was left.
    semidet fn "view_say_"(context, page, answer) as call("view", 1) {
        say(&call, page, &terms::text(&call, answer)?)
    }

    /// view_end_(+Page, +Code): ends the connection with the reason for that (RFC 6455, 7.4).
    semidet fn "view_end_"(context, page, code) as call("view", 1) {
        page_of(&call, page)?.end(u16::try_from(call.integer(code)?).unwrap_or_default());
        Ok(())
    }

    /// view_leave_(+Page): nobody serves this page any more.
    semidet fn "view_leave_"(context, page) as call("view", 1) {
        door()?.leave(number_of(&call, page)?);
        Ok(())
    }

    /// view_shut_(+Bye): ends the server and all pages, which get this word.
    semidet fn "view_shut_"(context, bye) as call("view_stop", 0) {
        let bye = terms::text(&call, bye)?;
        door()?.close(&bye);
        *locked(&DOOR) = None;
        Ok(())
    }
}

/// Does nothing if the page was left.
pub(super) fn say<C: Prolog>(call: &Call<C>, page: &Term, text: &str) -> PrologResult<()> {
    attempt_opt(page_of(call, page))?.iter().for_each(|page| page.say(text));
    Ok(())
}

/// Without Prolog, which interrupts the program as soon as it can.
fn stop() {
    latch::set(Reason::Stopped);
    // The program's own stop says what went wrong.
    let _ = stop_motors();
}

/// The server; fails if there is none.
fn door() -> PrologResult<Arc<Door>> {
    locked(&DOOR).clone().ok_or(PrologError::Failure)
}

/// A page; fails if it was left.
fn page_of<C: Prolog>(call: &Call<C>, page: &Term) -> PrologResult<Arc<Page>> {
    door()?.page(number_of(call, page)?).ok_or(PrologError::Failure)
}

fn number_of<C: Prolog>(call: &Call<C>, page: &Term) -> PrologResult<u32> {
    u32::try_from(call.integer(page)?).map_err(|_| PrologError::Failure)
}
