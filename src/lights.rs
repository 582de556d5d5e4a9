//! `prolog/ev3dev/lights.pl`: lights.
use crate::call::{Call, unify_atom};
use crate::driver::unify_port;
use crate::error::wrong_value;
use ev3_driver::light::{self, Colour, Light};
use std::vec::IntoIter;
use swipl::prelude::*;

/// Registers the predicates below.
pub(crate) fn register() {
    register_led();
    register_led_colour();
    register_led_set_colour();
    register_led_trigger();
    register_led_triggers();
    register_led_set_trigger();
    register_led_delays();
    register_led_set_delays();
}

/// Lights that are still to be answered.
type Lights = IntoIter<Light>;

predicates! {
    /// led(?Light)
    #[module("ev3dev_lights")]
    nondet fn led<Lights>(context, name) {
        setup => {
            let call = Call::of(context, "led", 1);
            lights(&call, name)
        },
        call(lights) => {
            Call::of(context, "led", 1)
                .next(lights, |_| Ok(()), |light, ()| unify_port(name, light.name()))
        }
    }

    /// led_colour_(?Light, -Colour)
    #[module("ev3dev_lights")]
    #[name("led_colour_")]
    nondet fn led_colour<Lights>(context, name, colour) {
        setup => {
            let call = Call::of(context, "led", 2);
            lights(&call, name)
        },
        call(lights) => {
            let call = Call::of(context, "led", 2);
            let read = |light: &Light| call.check(light.colour());
            call.next(lights, read, |light, read| {
                unify_colour(colour, read)?;
                unify_port(name, light.name())
            })
        }
    }

    /// led_set_colour_(+Light, +Colour)
    #[module("ev3dev_lights")]
    #[name("led_set_colour_")]
    semidet fn led_set_colour(context, name, colour) {
        let call = Call::of(context, "led", 2);
        let (name, colour) = (call.text(name)?, colour_of(&call, colour)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let set = light::set_colour(&devices, &name, &colour, interrupted);
        into_prolog_result(call.found(set)?)
    }

    /// led_trigger_(?Light, -Trigger)
    #[module("ev3dev_lights")]
    #[name("led_trigger_")]
    nondet fn led_trigger<Lights>(context, name, trigger) {
        setup => {
            let call = Call::of(context, "led_trigger", 2);
            lights(&call, name)
        },
        call(lights) => {
            let call = Call::of(context, "led_trigger", 2);
            let read = |light: &Light| call.check(light.trigger());
            call.next(lights, read, |light, read| {
                unify_atom(trigger, read)?;
                unify_port(name, light.name())
            })
        }
    }

    /// led_triggers_(?Light, -Triggers)
    #[module("ev3dev_lights")]
    #[name("led_triggers_")]
    nondet fn led_triggers<Lights>(context, name, triggers) {
        setup => {
            let call = Call::of(context, "led_triggers", 2);
            lights(&call, name)
        },
        call(lights) => {
            let call = Call::of(context, "led_triggers", 2);
            let read = |light: &Light| call.check(light.triggers());
            call.next(lights, read, |light, read| {
                let words: Vec<_> = read.iter().map(|word| atomable(word.as_str())).collect();
                triggers.unify(words.as_slice())?;
                unify_port(name, light.name())
            })
        }
    }

    /// led_set_trigger_(+Light, +Trigger)
    #[module("ev3dev_lights")]
    #[name("led_set_trigger_")]
    semidet fn led_set_trigger(context, name, trigger) {
        let call = Call::of(context, "led_trigger", 2);
        let (name, trigger) = (call.text(name)?, call.text(trigger)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        call.found(light::set_trigger(&devices, &name, &trigger, interrupted))
    }

    /// led_delays_(?Light, -On, -Off)
    #[module("ev3dev_lights")]
    #[name("led_delays_")]
    nondet fn led_delays<Lights>(context, name, on, off) {
        setup => {
            let call = Call::of(context, "led_blink", 3);
            lights(&call, name)
        },
        call(lights) => {
            let call = Call::of(context, "led_blink", 3);
            let read = |light: &Light| call.found(light.delays());
            call.next(lights, read, |light, read| {
                on.unify(read.0)?;
                off.unify(read.1)?;
                unify_port(name, light.name())
            })
        }
    }

    /// led_set_delays_(+Light, +On, +Off)
    #[module("ev3dev_lights")]
    #[name("led_set_delays_")]
    semidet fn led_set_delays(context, name, on, off) {
        let call = Call::of(context, "led_blink", 3);
        let (name, delays) = (call.text(name)?, [call.integer(on)?, call.integer(off)?]);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        call.found(light::blink(&devices, &name, delays, interrupted))
    }
}

/// All lights, or the one that is bound.
fn lights<C: QueryableContextType>(call: &Call<C>, name: &Term) -> PrologResult<Option<Lights>> {
    let (name, devices) = (call.text_if_bound(name)?, call.devices()?);
    let found = call.check(match name {
        Some(name) => light::find(&devices, &name).map(|light| light.into_iter().collect()),
        None => light::lights(&devices),
    })?;
    Ok(Some(found.into_iter()))
}

/// A colour's name, a percentage, or `levels` of two or three.
fn colour_of<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<Colour> {
    let percent = |term: &Term| Ok((0..=100).contains(&call.integer(term)?));
    let colour = if term.is_integer() {
        percent(term)?.then_some(Colour::Level(call.integer(term)?))
    } else if term.term_type() == TermType::CompoundTerm {
        let levels = call.context.compound_terms_vec(term)?;
        let are_percent = levels.iter().map(percent).collect::<PrologResult<Vec<bool>>>()?;
        let integers = levels.iter().map(|level| call.integer(level));
        let levels = integers.collect::<PrologResult<Vec<_>>>()?;
        are_percent.into_iter().all(|is| is).then_some(Colour::Levels(levels))
    } else {
        Colour::named(&call.text(term)?)
    };
    colour.map_or_else(|| wrong_value(call, "led_colour", term), Ok)
}

fn unify_colour(term: &Term, colour: &Colour) -> PrologResult<()> {
    let levels = match colour {
        Colour::Named(name) => return unify_atom(term, name),
        Colour::Level(level) => return term.unify(*level),
        Colour::Levels(levels) => levels,
    };
    let arity = if levels.len() == 2 { 2 } else { 3 };
    term.unify(Functor::new("levels", arity))?;
    levels.iter().zip(1..).try_for_each(|(level, nth)| term.unify_arg(nth, *level))
}
