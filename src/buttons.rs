//! `prolog/ev3dev/buttons.pl`: the buttons of the brick.
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::sources::Source;
use crate::glue::terms::{Prolog, unify_atom};
use ev3_driver::brick::buttons::{self as keys, Button, Event, Events};
use ev3_driver::wait::AnyWait;
use std::sync::Arc;
use swipl::prelude::*;

natives! {
    /// buttons_(-Keys)
    semidet fn "buttons_"(context, keys) as call("button", 1) {
        let pressed = call.or_throw(keys::pressed(&*call.dev()?))?;
        let pressed = pressed.map_or_else(|| call.lacking("buttons"), Ok)?;
        let words: Vec<_> = pressed.into_iter().map(|key| atomable(key.word())).collect();
        keys.unify(words.as_slice())
    }

    /// button_wait_(?Key, ?Event, +Timeout, -Reason): `over` at the end. Fails if the time
    /// is up before.
    nondet fn "button_wait_"<UntilEvent>(context, key, event, timeout, reason) as call("button_wait", 3) {
        setup => {
            let (wanted, is_press) = (key_of(&call, key)?, is_press_of(&call, event)?);
            let timeout = call.seconds(timeout)?;
            let events = Arc::new(events_from_now(&call)?);
            Ok(Some(events.until_next(wanted, is_press, timeout)))
        },
        call(waiting) => {
            next_event(&call, waiting, key, event, reason)
        }
    }

    /// button_source_(-Source)
    semidet fn "button_source_"(context, source) as call("button_events", 1) {
        let events = events_from_now(&call)?;
        source.unify(Source::open(events))
    }

    /// button_event_(+Source, +Index, -Key, -Event, -Reason): `over` at the end.
    nondet fn "button_event_"<UntilEvent>(context, source, index, key, event, reason) as call("button_events", 1) {
        setup => {
            let source: Arc<Source> = source.get_ex()?;
            let index = usize::try_from(call.integer(index)?).map_err(|_| PrologError::Failure)?;
            let events = source.events().ok_or(PrologError::Failure)?;
            Ok(Some(events.until_nth(index)))
        },
        call(waiting) => {
            next_event(&call, waiting, key, event, reason)
        }
    }
}

/// A wait for a button.
type UntilEvent = AnyWait<'static, Option<Event>>;

/// A slice of that wait.
fn next_event<C: Prolog>(
    call: &Call<C>,
    waiting: &mut UntilEvent,
    key: &Term,
    event: &Term,
    reason: &Term,
) -> PrologResult<bool> {
    call.slice(waiting, reason, |read| {
        unify_event(key, event, read.ok_or(PrologError::Failure)?)?;
        unify_atom(reason, "over")
    })
}

/// The events from now on; fails if the brick has no buttons.
fn events_from_now<C: Prolog>(call: &Call<C>) -> PrologResult<Events> {
    call.or_throw(Events::from_now(call.dev()?))?.map_or_else(|| call.lacking("buttons"), Ok)
}

fn unify_event(key: &Term, event: &Term, read: Event) -> PrologResult<()> {
    unify_atom(key, read.button.word())?;
    unify_atom(event, if read.is_press { "pressed" } else { "released" })
}

/// A button by its name, or any.
fn key_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Option<Button>> {
    let Some(word) = call.text_if_bound(term)? else {
        return Ok(None);
    };
    Button::named(&word).map_or_else(|| wrong_value(call, "button", term), |key| Ok(Some(key)))
}

/// `pressed` or `released`, or any.
fn is_press_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Option<bool>> {
    match call.text_if_bound(term)?.as_deref() {
        None => Ok(None),
        Some("pressed") => Ok(Some(true)),
        Some("released") => Ok(Some(false)),
        Some(_) => wrong_value(call, "button_event", term),
    }
}
