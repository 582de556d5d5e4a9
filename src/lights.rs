//! `prolog/ev3dev/lights.pl`: lights.
use crate::driver::unify_port;
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::terms::{Prolog, unify_atom};
use ev3_driver::brick::light::{self, Color, Light};
use std::vec::IntoIter;
use swipl::prelude::*;

/// The lights that the call has not returned yet.
type Lights = IntoIter<Light>;

natives! {
    /// led_(?Light, +What, -Value): what is `name`, `color`, `trigger`, `triggers`,
    /// or `delays`, whose value is `delays(On, Off)`.
    nondet fn "led_"<Lights>(context, name, what, value) as call("led", 2) {
        setup => {
            let (name, devices) = (call.text_if_bound(name)?, call.devices()?);
            let mut lights = call.or_throw(light::lights(&devices))?;
            lights.retain(|light| name.as_deref().is_none_or(|name| light.is_called(name)));
            Ok(Some(lights.into_iter()))
        },
        call(lights) => {
            let what = call.text(what)?;
            let read = |light: &Light| call.or_fail(read(light, &what));
            call.next(lights, read, |light, read| {
                unify_read(value, read)?;
                unify_port(name, light.name())
            })
        }
    }

    /// led_set_color_(+Light, +Color)
    semidet fn "led_set_color_"(context, name, color) as call("led", 2) {
        let (name, color) = (call.text(name)?, color_of(&call, color)?);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let set = light::set_color(&devices, &name, &color, interrupted);
        into_prolog_result(call.or_fail(set)?)
    }

    /// led_set_trigger_(+Light, +Trigger)
    semidet fn "led_set_trigger_"(context, name, trigger) as call("led_trigger", 2) {
        let (name, trigger) = (call.text(name)?, call.text(trigger)?);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        call.or_fail(light::set_trigger(&devices, &name, &trigger, interrupted))
    }

    /// led_set_delays_(+Light, +On, +Off)
    semidet fn "led_set_delays_"(context, name, on, off) as call("led_blink", 3) {
        let (name, delays) = (call.text(name)?, [call.integer(on)?, call.integer(off)?]);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        call.or_fail(light::blink(&devices, &name, delays, interrupted))
    }
}

/// The readable properties of a light.
enum Read {
    Nothing,
    Color(Color),
    Trigger(String),
    Triggers(Vec<String>),
    Delays(i64, i64),
}

fn read(light: &Light, what: &str) -> ev3_driver::Result<Option<Read>> {
    Ok(match what {
        "color" => Some(Read::Color(light.color()?)),
        "trigger" => Some(Read::Trigger(light.trigger()?)),
        "triggers" => Some(Read::Triggers(light.triggers()?)),
        "delays" => light.delays()?.map(|(on, off)| Read::Delays(on, off)),
        _ => Some(Read::Nothing),
    })
}

fn unify_read(term: &Term, read: &Read) -> PrologResult<()> {
    match read {
        Read::Nothing => Ok(()),
        Read::Color(Color::Named(name)) => unify_atom(term, name),
        Read::Color(Color::Level(level)) => term.unify(*level),
        Read::Color(Color::Levels(levels)) => unify_integers(term, "levels", levels),
        Read::Trigger(word) => unify_atom(term, word),
        Read::Triggers(words) => {
            let words: Vec<_> = words.iter().map(|word| atomable(word.as_str())).collect();
            term.unify(words.as_slice())
        }
        Read::Delays(on, off) => unify_integers(term, "delays", &[*on, *off]),
    }
}

/// Unifies with a compound of two or three integers.
fn unify_integers(term: &Term, name: &str, integers: &[i64]) -> PrologResult<()> {
    let arity = if integers.len() == 2 { 2 } else { 3 };
    term.unify(Functor::new(name, arity))?;
    integers.iter().zip(1..).try_for_each(|(integer, nth)| term.unify_arg(nth, *integer))
}

/// A color's name, a percentage, or `levels` of two or three.
fn color_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Color> {
    let percent = |term: &Term| Ok((0..=100).contains(&call.integer(term)?));
    let color = if term.is_integer() {
        percent(term)?.then_some(Color::Level(call.integer(term)?))
    } else if term.term_type() == TermType::CompoundTerm {
        let levels = call.context.compound_terms_vec(term)?;
        let are_percent = levels.iter().map(percent).collect::<PrologResult<Vec<bool>>>()?;
        let integers = levels.iter().map(|level| call.integer(level));
        let levels = integers.collect::<PrologResult<Vec<_>>>()?;
        are_percent.into_iter().all(|is| is).then_some(Color::Levels(levels))
    } else {
        Color::named(&call.text(term)?)
    };
    color.map_or_else(|| wrong_value(call, "led_color", term), Ok)
}
