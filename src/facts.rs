//! From terms to the facts of worlds and robots, for the simulator and for roadmaps.
use crate::glue::call::Call;
use crate::glue::error::{wrong_because, wrong_type, wrong_type_because};
use crate::glue::places::places;
use crate::glue::terms::Ask as _;
use ev3_sim::facts::{Fact, Kind, Subject, Value};
use ev3_sim::{Drawing, Echo, Gripper, Hull, Part, SpecError, Traits, check_bounds};
use std::str::FromStr;
use swipl::prelude::*;

/// Reads a fact of a world or a robot, and checks it alone. `None` if there is no such fact.
pub(crate) fn fact<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    subject: Subject,
    term: &Term<'a>,
) -> PrologResult<Option<Fact>> {
    let Some((name, arguments)) = call.compound(term)? else {
        return Ok(None);
    };
    let Some(form) = subject.form(&name, arguments.len()) else {
        return Ok(None);
    };
    let kinds = arguments.iter().zip(form.arguments);
    let values = kinds.map(|(argument, (name, kind))| match kind {
        Kind::Number if matches!(argument.term_type(), TermType::Nil | TermType::ListPair) => {
            let reason = format!("{name} must be a number, not a list: {form}");
            wrong_type_because(call, "number", argument, &reason)
        }
        _ => value(call, *kind, argument),
    });
    let values = values.collect::<PrologResult<Vec<_>>>()?;
    let read = Fact::of(&name, &values).or_else(|error| {
        wrong_because(call, "possible_geometry", &arguments[0], &error.to_string())
    })?;
    let Some(fact) = read else {
        return Ok(None);
    };
    must_be_ground(call, term)?;
    match &fact {
        Fact::Item(item) => impossible(call, term, item.validate())?,
        Fact::Bounds(bounds) => impossible(call, term, check_bounds(bounds))?,
        _ => {}
    }
    Ok(Some(fact))
}

/// `Kind(Form)`, where Form has `count` arguments, each `Name:Kind`.
#[cfg(feature = "sim")]
pub(crate) fn form_term<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    kind: &str,
    form: &ev3_sim::facts::Form,
    count: usize,
) -> PrologResult<Term<'a>> {
    let compound = |name: &str, arguments: &[Term<'a>]| {
        let term = call.context.new_term_ref();
        term.unify(Functor::new(name, u16::try_from(arguments.len()).unwrap_or(u16::MAX)))?;
        for (place, argument) in (1..).zip(arguments) {
            term.unify_arg(place, argument)?;
        }
        Ok(term)
    };
    let argument = |(name, kind): &(&str, Kind)| {
        let (of, context) = (format!("{kind:?}").to_lowercase(), call.context);
        compound(":", &[term! {context: #atomable(*name)}?, term! {context: #atomable(of)}?])
    };
    let arguments = form.arguments[..count].iter().map(argument);
    let fact = compound(form.name, &arguments.collect::<PrologResult<Vec<_>>>()?)?;
    compound(kind, &[fact])
}

/// Raises that there is no such fact, and says which there are.
pub(crate) fn unknown<T, C: QueryableContextType>(
    call: &Call<C>,
    domain: &str,
    subject: Subject,
    term: &Term,
) -> PrologResult<T> {
    let (name, _) = call.compound(term)?.unwrap_or_default();
    wrong_because(call, domain, term, &subject.expected(&name))
}

/// Raises `instantiation_error` for a fact that is not ground, as one with a partial list.
pub(crate) fn must_be_ground<C: QueryableContextType>(
    call: &Call<C>,
    term: &Term,
) -> PrologResult<()> {
    if attempt(call.context.ask(pred!("system:ground/1"), [term]))? {
        return Ok(());
    }
    wrong_type(call, "ground", &call.context.new_term_ref())
}

/// Raises what is impossible about a fact.
fn impossible<C: QueryableContextType>(
    call: &Call<C>,
    term: &Term,
    checked: Result<(), SpecError>,
) -> PrologResult<()> {
    checked.or_else(|error| wrong_because(call, "possible_geometry", term, &error.reason))
}

/// An argument of a fact.
fn value<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    kind: Kind,
    term: &Term<'a>,
) -> PrologResult<Value> {
    Ok(match kind {
        Kind::Number => Value::Number(call.float(term)?),
        Kind::Channel => Value::Channel(channel_of(call, term)?),
        Kind::Color => Value::Color(named(call, "color", term)?),
        Kind::Port => Value::Port(named(call, "port", term)?),
        Kind::Text => Value::Text(call.text(term)?.into()),
        Kind::Places => Value::Places(places(call, term)?),
        Kind::Rows => Value::Rows(drawing(call, term)?.0),
        Kind::Hull => Value::Hull(hull(call, term)?),
        Kind::Traits => Value::Traits(traits(call, term)?),
        Kind::WheelOptions => wheel_options(call, term)?,
        Kind::MotorOptions => Value::MotorOptions(stops(call, term)?),
        Kind::SensorOptions => sensor_options(call, term)?,
        Kind::GripperOptions => Value::GripperOptions(gripper(call, term)?),
        Kind::EchoOptions => Value::EchoOptions(echo(call, term)?),
    })
}

/// A map that is drawn, a list of texts from above: these, and what they mean.
pub(crate) fn drawing<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    rows: &Term<'a>,
) -> PrologResult<(Vec<String>, Drawing)> {
    let list = call.list(rows)?;
    let texts = list.iter().map(|row| call.text(row).map(Into::into));
    let texts = texts.collect::<PrologResult<Vec<String>>>()?;
    let drawing = Drawing::read(&texts).or_else(|error| {
        let row = match *error.parts {
            [Part::MapRow(row)] => list.get(row),
            _ => None,
        };
        wrong_because(call, "map_row", row.unwrap_or(rows), &error.to_string())
    })?;
    Ok((texts, drawing))
}

/// A pose from three numbers: cm, cm, degrees.
#[cfg(feature = "sim")]
pub(crate) fn pose<C: QueryableContextType>(
    call: &Call<C>,
    [x, y, heading]: [&Term; 3],
) -> PrologResult<ev3_sim::Pose> {
    Ok(ev3_sim::Pose::new(call.float(x)?, call.float(y)?, call.float(heading)?))
}

/// Something that has a name: a port, a color.
pub(crate) fn named<T: FromStr, C: QueryableContextType>(
    call: &Call<C>,
    domain: &str,
    term: &Term,
) -> PrologResult<T> {
    call.text(term)?.parse().or_else(|_| wrong_because(call, domain, term, ""))
}

/// A channel of beacons and remote controls.
pub(crate) fn channel_of<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<u8> {
    match u8::try_from(call.integer(term)?) {
        Ok(channel @ 1..=4) => Ok(channel),
        _ => wrong_because(call, "ir_channel", term, ""),
    }
}

/// A list of buttons of a remote control.
#[cfg(feature = "sim")]
pub(crate) fn remote_buttons<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<Vec<ev3_sim::RemoteButton>> {
    use ev3_sim::RemoteButton;
    let button = |term: &Term<'a>| match &*call.text(term)? {
        "red_up" => Ok(RemoteButton::RedUp),
        "red_down" => Ok(RemoteButton::RedDown),
        "blue_up" => Ok(RemoteButton::BlueUp),
        "blue_down" => Ok(RemoteButton::BlueDown),
        "beacon" => Ok(RemoteButton::Beacon),
        _ => wrong_because(call, "ir_button", term, ""),
    };
    call.list(term)?.iter().map(button).collect()
}

/// Calls `set` with the name and the value of each option of a list. It answers whether there is
/// such an option.
fn each_option<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    domain: &str,
    options: &Term<'a>,
    mut set: impl FnMut(&str, &Term<'a>) -> PrologResult<bool>,
) -> PrologResult<()> {
    for option in call.list(options)? {
        let (name, values) = call.compound(&option)?.unwrap_or_default();
        let is_known = if let [value] = &*values { set(&name, value)? } else { false };
        if !is_known {
            return wrong_because(call, domain, &option, "");
        }
    }
    Ok(())
}

/// A list of `mass(Kg)`, `friction(Share)`, `height(Cm)`, `rolls(Bool)`, `bounces(Share)`,
/// `color(Color)` and `name(Name)`.
fn traits<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<Traits> {
    let mut traits = Traits::default();
    each_option(call, "thing_option", options, |name, value| {
        match name {
            "mass" => traits.mass = Some(call.float(value)?),
            "friction" => traits.friction = Some(call.float(value)?),
            "height" => traits.height = Some(call.float(value)?),
            "bounces" => traits.bounces = Some(call.float(value)?),
            "rolls" => traits.rolls = boolean(call, value)?,
            "color" => traits.color = Some(named(call, "color", value)?),
            "name" => traits.name = Some(call.text(value)?.into()),
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok(traits)
}

/// A list of `inverted(Bool)` and `slip(Share)`.
fn wheel_options<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<Value> {
    let (mut inverted, mut slip) = (false, 0.0);
    for option in call.list(options)? {
        let [value] = call.arguments(&option)?;
        match &*option.get::<Functor>()?.name_string() {
            "inverted" => inverted = boolean(call, &value)?,
            "slip" => slip = call.float(&value)?,
            _ => return wrong_because(call, "wheel_option", &option, ""),
        }
    }
    Ok(Value::WheelOptions { inverted, slip })
}

/// A list of `looks(Direction)`.
fn sensor_options<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<Value> {
    let mut looks_ahead = false;
    each_option(call, "sensor_option", options, |name, value| {
        looks_ahead = match (name, &*call.text(value)?) {
            ("looks", "ahead") => true,
            ("looks", "down") => false,
            _ => return Ok(false),
        };
        Ok(true)
    })?;
    Ok(Value::SensorOptions { looks_ahead })
}

/// A list of `half_angle(Degrees)`, `incidence(Degrees)`, `miss(Share)`, `spurious(Share)`.
fn echo<'a, C: QueryableContextType>(call: &Call<'a, C>, options: &Term<'a>) -> PrologResult<Echo> {
    let mut echo = Echo::default();
    each_option(call, "echo_option", options, |name, value| {
        let field = match name {
            "half_angle" => &mut echo.half_angle,
            "incidence" => &mut echo.incidence,
            "miss" => &mut echo.miss,
            "spurious" => &mut echo.spurious,
            _ => return Ok(false),
        };
        *field = call.float(value)?;
        Ok(true)
    })?;
    Ok(echo)
}

/// A list of `opening(Cm)`, `force(Newton)`, `torque(NewtonMeter)` or `pivot(Bool)`, and
/// `lifts(Bool)`.
fn gripper<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<Gripper> {
    let mut gripper = Gripper::default();
    each_option(call, "gripper_option", options, |name, value| {
        match name {
            "opening" => gripper.opening = call.float(value)?,
            "force" => gripper.force = call.float(value)?,
            "torque" => gripper.torque = call.float(value)?,
            "pivot" if boolean(call, value)? => gripper.torque = 0.0,
            "pivot" => {}
            "lifts" => gripper.lifts = boolean(call, value)?,
            _ => return Ok(false),
        }
        Ok(true)
    })?;
    Ok(gripper)
}

/// What a list of `stops(Min, Max)` says, in degrees.
fn stops<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<Option<[f64; 2]>> {
    let mut stops = None;
    for option in call.list(options)? {
        match call.compound(&option)? {
            Some((name, ends)) if name == "stops" && ends.len() == 2 => {
                stops = Some([call.float(&ends[0])?, call.float(&ends[1])?]);
            }
            _ => return wrong_because(call, "mounting_option", &option, ""),
        }
    }
    Ok(stops)
}

fn boolean<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<bool> {
    attempt_opt(term.get())?.map_or_else(|| wrong_type(call, "bool", term), Ok)
}

/// `circle(Radius)` or `rectangle(Width, Length, Offset)`.
fn hull<'a, C: QueryableContextType>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Hull> {
    let (name, arguments) = call.compound(term)?.unwrap_or_default();
    match (&*name, &*arguments) {
        ("circle", [radius]) => Ok(Hull::Circle { radius: call.float(radius)? }),
        ("rectangle", [width, length, offset]) => Ok(Hull::Rectangle {
            width: call.float(width)?,
            length: call.float(length)?,
            offset: call.float(offset)?,
        }),
        _ if term.is_var() => wrong_type(call, "hull", term),
        _ => wrong_because(call, "hull", term, ""),
    }
}
