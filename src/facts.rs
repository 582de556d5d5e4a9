//! From terms to the facts of worlds and robots, for the simulator and for
//! roadmaps.
use crate::glue::call::Call;
use crate::glue::error::{wrong_because, wrong_type};
use crate::glue::places::places;
use crate::glue::terms::Ask as _;
use ev3_sim::facts::{Fact, Subject};
use ev3_sim::{
    Bounds, Drawing, Drawn, Echo, Hull, Item, MotorMount, Noise, Part, Pose, SensorMount,
    SpecError, Wheel, check_bounds,
};
use std::str::FromStr;
use swipl::prelude::*;

/// Reads a fact of a world or a robot, and checks it alone. `None` if there is
/// no such fact.
pub(crate) fn fact<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    subject: Subject,
    term: &Term<'a>,
) -> PrologResult<Option<Fact>> {
    let Some((name, arguments)) = call.compound(term)? else {
        return Ok(None);
    };
    if !subject.has(&name, arguments.len()) {
        return Ok(None);
    }
    let Some(fact) = read(call, &name, &arguments)? else {
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

/// The fact with this name. `None` if its arguments do not fit.
fn read<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    name: &str,
    arguments: &[Term<'a>],
) -> PrologResult<Option<Fact>> {
    let number = |term: &Term| call.float(term);
    let fact = match (name, arguments) {
        ("bounds", [x1, y1, x2, y2]) => Fact::Bounds(Bounds {
            low: [number(x1)?, number(y1)?],
            high: [number(x2)?, number(y2)?],
        }),
        ("wall", [x1, y1, x2, y2]) => {
            Fact::Item(Item::wall([number(x1)?, number(y1)?], [number(x2)?, number(y2)?]))
        }
        ("wall", [x1, y1, x2, y2, thickness]) => Fact::Item(Item::Wall {
            from: [number(x1)?, number(y1)?],
            to: [number(x2)?, number(y2)?],
            thickness: number(thickness)?,
        }),
        ("box", [x, y, width, depth]) => Fact::Item(Item::Box {
            pose: Pose::new(number(x)?, number(y)?, 0.0),
            width: number(width)?,
            depth: number(depth)?,
        }),
        ("box", [x, y, width, depth, heading]) => Fact::Item(Item::Box {
            pose: Pose::new(number(x)?, number(y)?, number(heading)?),
            width: number(width)?,
            depth: number(depth)?,
        }),
        ("circle", [x, y, radius]) => {
            Fact::Item(Item::Circle { center: [number(x)?, number(y)?], radius: number(radius)? })
        }
        ("floor", [color]) => Fact::Floor(named(call, "color", color)?),
        ("patch", [color, corners]) => Fact::Item(Item::Patch {
            corners: places(call, corners)?,
            color: named(call, "color", color)?,
        }),
        ("line", [color, width, along]) => Fact::Item(Item::Line {
            points: places(call, along)?,
            width: number(width)?,
            color: named(call, "color", color)?,
        }),
        ("lamp", [x, y, intensity]) => {
            Fact::Item(Item::Lamp { at: [number(x)?, number(y)?], intensity: number(intensity)? })
        }
        ("lamp", [x, y, intensity, port]) => Fact::Item(Item::Bulb {
            at: [number(x)?, number(y)?],
            intensity: number(intensity)?,
            port: named(call, "port", port)?,
        }),
        ("beacon", [x, y, channel]) => {
            let channel = channel_of(call, channel)?;
            Fact::Item(Item::Beacon { at: [number(x)?, number(y)?], channel })
        }
        ("ambient", [percent]) => Fact::Ambient(number(percent)?),
        ("temperature", [celsius]) => Fact::Temperature(number(celsius)?),
        ("loudness", [percent]) => Fact::Loudness(number(percent)?),
        ("start", [x, y, heading]) => Fact::Start(pose(call, [x, y, heading])?),
        ("start", [name, x, y, heading]) => {
            Fact::NamedStart(call.text(name)?.into(), pose(call, [x, y, heading])?)
        }
        ("map", [size, rows]) => Fact::Map(drawn(call, size, rows)?),
        ("left_wheel", [port, diameter, options @ ..]) => {
            Fact::LeftWheel(wheel(call, port, diameter, options)?)
        }
        ("right_wheel", [port, diameter, options @ ..]) => {
            Fact::RightWheel(wheel(call, port, diameter, options)?)
        }
        ("axle", [length]) => Fact::Axle(number(length)?),
        ("hull", [hull]) => Fact::Hull(self::hull(call, hull)?),
        ("mass", [mass]) => Fact::Mass(number(mass)?),
        ("motor", [port, driver, options @ ..]) => Fact::Motor(MotorMount {
            port: named(call, "port", port)?,
            driver: call.text(driver)?.into(),
            noise: None,
            encoder_noise: None,
            stops: stops(call, options)?,
        }),
        ("sensor", [port, driver, x, y, heading]) => Fact::Sensor(SensorMount {
            port: named(call, "port", port)?,
            driver: call.text(driver)?.into(),
            pose: pose(call, [x, y, heading])?,
            noise: None,
            echo: Echo::default(),
        }),
        ("noise", [port, sigma, bias]) => Fact::Noise(
            named(call, "port", port)?,
            Noise { sigma: number(sigma)?, bias: number(bias)? },
        ),
        ("echo", [port, options]) => Fact::Echo(named(call, "port", port)?, echo(call, options)?),
        ("encoder_noise", [port, sigma]) => {
            Fact::EncoderNoise(named(call, "port", port)?, number(sigma)?)
        }
        _ => return Ok(None),
    };
    Ok(Some(fact))
}

/// The items that a drawing adds to a world.
fn drawn<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    size: &Term<'a>,
    rows: &Term<'a>,
) -> PrologResult<Drawn> {
    let drawn = drawing(call, rows)?.drawn(call.float(size)?);
    drawn.or_else(|error| wrong_because(call, "possible_geometry", size, &error.to_string()))
}

/// A map that is drawn: a list of texts, from above.
pub(crate) fn drawing<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    rows: &Term<'a>,
) -> PrologResult<Drawing> {
    let list = call.list(rows)?;
    let texts = list.iter().map(|row| call.text(row)).collect::<PrologResult<Vec<_>>>()?;
    Drawing::read(&texts).or_else(|error| {
        let row = match *error.parts {
            [Part::MapRow(row)] => list.get(row),
            _ => None,
        };
        wrong_because(call, "map_row", row.unwrap_or(rows), &error.to_string())
    })
}

/// A pose from three numbers: cm, cm, degrees.
pub(crate) fn pose<C: QueryableContextType>(
    call: &Call<C>,
    [x, y, heading]: [&Term; 3],
) -> PrologResult<Pose> {
    Ok(Pose::new(call.float(x)?, call.float(y)?, call.float(heading)?))
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

/// A wheel: its port, its diameter in cm, and perhaps a list of `inverted(Bool)`
/// and `slip(Share)`.
fn wheel<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    port: &Term<'a>,
    diameter: &Term<'a>,
    options: &[Term<'a>],
) -> PrologResult<Wheel> {
    let mut wheel = Wheel {
        port: named(call, "port", port)?,
        diameter: call.float(diameter)?,
        inverted: false,
        slip: 0.0,
    };
    for options in options {
        for option in call.list(options)? {
            let [value] = call.arguments(&option)?;
            match &*option.get::<Functor>()?.name_string() {
                "inverted" => wheel.inverted = boolean(call, &value)?,
                "slip" => wheel.slip = call.float(&value)?,
                _ => return wrong_because(call, "wheel_option", &option, ""),
            }
        }
    }
    Ok(wheel)
}

/// A list of `half_angle(Degrees)`, `incidence(Degrees)`, `miss(Share)`, `spurious(Share)`.
fn echo<'a, C: QueryableContextType>(call: &Call<'a, C>, options: &Term<'a>) -> PrologResult<Echo> {
    let mut echo = Echo::default();
    for option in call.list(options)? {
        let (name, values) = call.compound(&option)?.unwrap_or_default();
        let field = match &*name {
            "half_angle" => &mut echo.half_angle,
            "incidence" => &mut echo.incidence,
            "miss" => &mut echo.miss,
            "spurious" => &mut echo.spurious,
            _ => return wrong_because(call, "echo_option", &option, ""),
        };
        let [value] = &*values else {
            return wrong_because(call, "echo_option", &option, "");
        };
        *field = call.float(value)?;
    }
    Ok(echo)
}

/// What an optional list of `stops(Min, Max)` says, in degrees.
fn stops<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    options: &[Term<'a>],
) -> PrologResult<Option<[f64; 2]>> {
    let mut stops = None;
    for options in options {
        for option in call.list(options)? {
            match call.compound(&option)? {
                Some((name, ends)) if name == "stops" && ends.len() == 2 => {
                    stops = Some([call.float(&ends[0])?, call.float(&ends[1])?]);
                }
                _ => return wrong_because(call, "mounting_option", &option, ""),
            }
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
