//! `prolog/ev3dev/driver.pl`: devices and their attributes.
use crate::glue::call::{Call, ListedDevices, Text, start};
use crate::glue::error::wrong_value;
use crate::glue::interned::{handle, word_in};
use crate::glue::known::{self, Look};
use crate::glue::terms::{Prolog, unify_atom, unify_value};
use ev3_driver::attributes::Short;
use ev3_driver::class::Detected;
use ev3_driver::{Class, Device, Registry, attributes};
use std::sync::Arc;
use swipl::fli::Arguments;
use swipl::prelude::*;

natives! {
    /// device_(+Class, ?Port, ?Type): the native twin of `tacho_motor/2` and the like.
    nondet fn "device_"<Found>(context, class, port, kind) as call("tacho_motor", 2) {
        setup => {
            let found = found(context, class, port, kind)?;
            Ok(Some(found))
        },
        call(found) => {
            let Found { devices, names_port, names_type } = found;
            call.next(devices, |_| Ok(()), |device, ()| {
                unify_asked(*names_port, port, device.port())?;
                unify_asked(*names_type, kind, device.driver())
            })
        }
    }

    /// device_(+Class, ?Port, ?Type, ?Path)
    nondet fn "device_"<Found>(context, class, port, kind, path) as call("tacho_motor", 3) {
        setup => {
            let mut found = found(context, class, port, kind)?;
            if let Some(path) = call.text_if_bound(path)? {
                let is_it = |device: &Arc<Device>| *device.path().to_string_lossy() == *path;
                found.devices = found.devices.filter(is_it).collect();
            }
            Ok(Some(found))
        },
        call(found) => {
            let Found { devices, names_port, names_type } = found;
            call.next(devices, |_| Ok(()), |device, ()| {
                unify_asked(*names_port, port, device.port())?;
                unify_asked(*names_type, kind, device.driver())?;
                unify_asked(path.is_var(), path, &device.path().to_string_lossy())
            })
        }
    }

    /// attribute_(+Class, ?Port, +Attribute, ?Value)
    nondet fn "attribute_"<AttributeReads>(context, class_term, port, attribute, value) {
        setup => {
            let class = class_of(context, class_term)?;
            let call = Call::of(context, accessor(class), 3);
            let name = call.text(attribute)?;
            let devices = call.devices()?;
            let (names_port, look) = (port.is_var(), Look::at(&devices, class));
            let found = call.listed(&devices, class, port)?;
            if let (false, Some(look), Some(device)) = (names_port, look, found.first()) {
                let atoms = [class_term, port, attribute].map(word_in);
                look.keep(atoms, &devices, device, name.clone(), 0);
            }
            let reads = AttributeReads { devices, found, names_port, name };
            start(reads, |reads| &reads.found, |reads| reads.next(&call, port, value))
        },
        call(reads) => {
            let class = class_of(context, class_term)?;
            reads.next(&Call::of(context, accessor(class), 3), port, value)
        }
    }

    /// attribute_write_(+Class, +Port, +Attribute, +Value)
    semidet fn "attribute_write_"(context, class, port, attribute, value) {
        let class = class_of(context, class)?;
        let call = Call::of(context, accessor(class), 3);
        let socket = call.text(port)?;
        let (name, text) = (call.text(attribute)?, call.value(value)?);
        call.before_motors()?;
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let written = attributes::write(&devices, class, &socket, &name, &text, interrupted);
        call.or_absent(class, port, written)
    }
}

/// The call of `attribute_` with a device that is known.
pub(crate) fn known_attribute(arguments: &Arguments) -> Option<bool> {
    let key = [arguments.atom(0)?, arguments.atom(1)?, arguments.atom(2)?];
    if !arguments.is_variable(3) {
        return None;
    }
    known::with(key, |found| {
        found.device.check_present_at(found.now).ok()?;
        attributes::look(found.device, found.name, |shown| match shown {
            Short::Integer(integer) => Some(arguments.unify_integer(3, integer)),
            Short::Text(text) => Some(arguments.unify_atom(3, handle(text)?)),
        })
    })
}

/// The part of a device that the caller knows.
pub(crate) struct Bound {
    port: Option<Text>,
    kind: Option<Text>,
    path: Option<Text>,
}

impl Bound {
    pub(crate) fn of<C: Prolog>(
        call: &Call<C>,
        port: &Term,
        kind: &Term,
        path: &Term,
    ) -> PrologResult<Self> {
        Ok(Self {
            port: call.text_if_bound(port)?,
            kind: call.text_if_bound(kind)?,
            path: call.text_if_bound(path)?,
        })
    }

    pub(crate) fn admits(&self, device: &Detected) -> bool {
        let admits = |bound: &Option<Text>, text: &str| bound.as_deref().is_none_or(|b| b == text);
        let port = self.port.as_deref();
        port.is_none_or(|port| ev3_driver::port_name::names(port, &device.port))
            && admits(&self.kind, &device.driver)
            && admits(&self.path, &device.path.to_string_lossy())
    }
}

/// The devices whose attribute the call has not read yet.
struct AttributeReads {
    devices: Arc<Registry>,
    found: ListedDevices,
    names_port: bool,
    name: Text,
}

impl AttributeReads {
    fn next<'a, C: Prolog>(
        &mut self,
        call: &Call<'a, C>,
        port: &Term<'a>,
        value: &Term<'a>,
    ) -> PrologResult<bool> {
        let Self { devices, found, names_port, name } = self;
        let read = |device: &Arc<Device>| call.or_fail(attributes::read(devices, device, name));
        call.next(found, read, |device, read| {
            unify_value(value, read)?;
            unify_asked(*names_port, port, device.port())
        })
    }
}

/// Devices that are still to be answered, and what is asked about them.
struct Found {
    devices: ListedDevices,
    names_port: bool,
    names_type: bool,
}

/// The devices of a class, all or the one at a port, of one type or of any.
fn found<'a, C: Prolog>(
    context: &'a Context<'a, C>,
    class: &Term,
    port: &Term,
    kind: &Term,
) -> PrologResult<Found> {
    let class = class_of(context, class)?;
    let (name, arity) = detector(class);
    let call = Call::of(context, name, arity);
    let (port, kind) = (call.text_if_bound(port)?, call.text_if_bound(kind)?);
    let mut devices = call.or_throw(listed(&*call.devices()?, class, port.as_deref()))?;
    if let Some(kind) = &kind {
        devices.retain(|device| device.driver() == kind);
    }
    let devices = devices.into_iter().collect();
    Ok(Found { devices, names_port: port.is_none(), names_type: kind.is_none() })
}

/// The devices of a class: all, or the one at a port.
fn listed(
    devices: &Registry,
    class: Class,
    port: Option<&str>,
) -> ev3_driver::Result<Vec<Arc<Device>>> {
    Ok(match port {
        Some(port) => devices.find(class, port)?.into_iter().collect(),
        None => devices.all(class)?.to_vec(),
    })
}

pub(crate) fn unify_device(
    device: &Detected,
    port: &Term,
    kind: &Term,
    path: &Term,
) -> PrologResult<()> {
    unify_port(port, &device.port)?;
    if kind.is_var() {
        unify_atom(kind, &device.driver)?;
    }
    if path.is_var() { unify_atom(path, &device.path.to_string_lossy()) } else { Ok(()) }
}

/// A bound port unifies in either spelling.
pub(crate) fn unify_port(term: &Term, port: &str) -> PrologResult<()> {
    unify_asked(term.is_var(), term, port)
}

/// Unifies what is asked for. What is not has been compared before.
pub(crate) fn unify_asked(is_asked: bool, term: &Term, text: &str) -> PrologResult<()> {
    if is_asked { unify_atom(term, text) } else { Ok(()) }
}

/// The public predicate that finds devices of a class.
fn detector(class: Class) -> (&'static str, u64) {
    match class {
        Class::Sensor => ("lego_sensor", 3),
        Class::DcMotor => ("dc_motor", 1),
        Class::ServoMotor => ("servo_motor", 1),
        Class::Port => ("lego_port", 1),
        _ => ("tacho_motor", 3),
    }
}

/// The public predicate that reads and writes attributes of a class.
fn accessor(class: Class) -> &'static str {
    match class {
        Class::Sensor => "sensor_attribute",
        Class::DcMotor => "dc_motor_attribute",
        Class::ServoMotor => "servo_motor_attribute",
        Class::Port => "port_attribute",
        _ => "motor_attribute",
    }
}

/// The class, as the pack's Prolog files name it.
pub(crate) fn class_of<'a, C: Prolog>(
    context: &'a Context<'a, C>,
    term: &Term,
) -> PrologResult<Class> {
    let call = Call::of(context, "subsystem_detect", 4);
    let name = call.text(term)?;
    match Class::ALL.into_iter().find(|class| class.directory() == name) {
        Some(class) => Ok(class),
        None => wrong_value(&call, "device_class", term),
    }
}
