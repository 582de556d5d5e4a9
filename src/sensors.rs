//! `prolog/ev3dev/sensors.pl`: sensors.
use crate::driver::unify_asked;
use crate::glue::call::{Call, ListedDevices, Text, start};
use crate::glue::error::{wrong_type, wrong_value};
use crate::glue::interned::{handle, word_in};
use crate::glue::known::{self, Found, Look};
use crate::glue::state::watched;
use crate::glue::terms::{Ask as _, Prolog, unify_atom, unify_value};
use crate::glue::waiting::is_serving;
use ev3_driver::sensor::registers;
use ev3_driver::sensor::wait::{Until, UntilShown, until_shown};
use ev3_driver::wait::Slices;
use ev3_driver::{Class, Device, Registry, Value, sensor};
use ev3_os::locked;
use std::cell::Cell;
use std::sync::{Arc, Mutex};
use swipl::fli::{Arguments, atom_in};
use swipl::prelude::*;

natives! {
    /// sensor_known_(+Reading, ?Port, ?Value): succeeds at once if `sensor_value_` would, and
    /// leave no choice, as one of the last calls has shown. Fails where that is not known.
    semidet fn "sensor_known_"(_context, _reading, _port, _value) {
        Err(PrologError::Failure)
    }

    /// sensor_value_(?Port, +Types, +Mode, +Index, -Value): Types is a list, or the name of a
    /// reading that has one row in the table of `sensors.pl`, which has mode and index, too.
    nondet fn "sensor_value_"<Readings>(context, port, types, mode, index, value) as call("sensor_value", 4) {
        setup => {
            if call.serve_before("sensor_value_", [port, types, mode, index, value])? {
                return Ok(None);
            }
            let row = row(&call, types, mode, || index_of(&call, index))?;
            let readings = readings(&call, port, types, row)?;
            start(readings, |all| &all.sensors, |all| all.next_value(&call, port, value))
        },
        call(readings) => {
            readings.next_value(&call, port, value)
        }
    }

    /// sensor_value_or_why_(?Port, +Types, +Mode, +Index, -Value): the same, but explains
    /// it if there is no value.
    nondet fn "sensor_value_or_why_"<Readings>(context, port, types, mode, index, value) as call("sensor_value", 4) {
        setup => {
            if call.serve_before("sensor_value_or_why_", [port, types, mode, index, value])? {
                return Ok(None);
            }
            let row = row(&call, types, mode, || index_of(&call, index))?;
            let readings = readings(&call, port, types, row)?;
            start(readings, |all| &all.sensors, |all| {
                all.next_or_why(&call, [port, types, mode], value)
            })
        },
        call(readings) => {
            readings.next_or_why(&call, [port, types, mode], value)
        }
    }

    /// sensor_values_(?Port, +Types, +Mode, +Count, ?Values): the list of the first
    /// Count values, or of all values of the mode if Count is 0.
    nondet fn "sensor_values_"<Readings>(context, port, types, mode, count, values) as call("sensor_values", 3) {
        setup => {
            if call.serve_before("sensor_values_", [port, types, mode, count, values])? {
                return Ok(None);
            }
            let count = || Ok(usize::try_from(call.integer(count)?).unwrap_or_default());
            let readings = readings(&call, port, types, row(&call, types, mode, count)?)?;
            if readings.sensors.len() == 0 { no_sensor(&call, port, types, mode) } else { Ok(Some(readings)) }
        },
        call(readings) => {
            let Readings { devices, sensors, names_port, row, .. } = readings;
            let count = (row.index > 0).then_some(row.index);
            let read = |device: &Arc<Device>| {
                let interrupted = &mut call.interrupted();
                let read = sensor::read_several(devices, device, &row.mode, count, interrupted);
                watched().note_read(device.port());
                call.terms(&call.or_fail(read)?)
            };
            call.next(sensors, read, |device, read| {
                values.unify(read.as_slice())?;
                unify_asked(*names_port, port, device.port())
            })
        }
    }

    /// sensor_restart_(+Port, +Types, +Mode)
    semidet fn "sensor_restart_"(context, port, types, mode) as call("gyro_reset", 1) {
        call.text(port)?;
        let row = row(&call, types, mode, || Ok(0))?;
        let Readings { devices, mut sensors, row, .. } = readings(&call, port, types, row)?;
        let Some(sensor) = sensors.next() else {
            return no_sensor(&call, port, types, mode);
        };
        let interrupted = &mut call.interrupted();
        call.or_fail(sensor::restart(&devices, &sensor, &row.mode, interrupted))
    }

    /// sensor_wait_(+Port, +Reading, +Test, +Timeout, -Ended): reading is
    /// reading(Types, Mode, Index), test is test(Operator, Number) or `bumped`.
    nondet fn "sensor_wait_"<Slices<UntilShown>>(context, port, reading, test, timeout, ended) as call("sensor_wait", 2) {
        setup => {
            let [types, mode, index] = call.arguments(reading)?;
            let row = row(&call, &types, &mode, || index_of(&call, &index))?;
            let (until, timeout) = (until(&call, test)?, call.seconds(timeout)?);
            let Readings { devices, mut sensors, row, .. } = readings(&call, port, &types, row)?;
            let sensor = sensors.next().ok_or(PrologError::Failure)?;
            watched().note_read(sensor.port());
            Ok(Some(until_shown(&devices, &sensor, &row.mode, row.index, until, timeout)))
        },
        call(waiting) => {
            call.slice(waiting, ended, |end| unify_atom(ended, end.word()))
        }
    }

    /// sensor_scale_(+Port, +Raw, -Value)
    semidet fn "sensor_scale_"(context, port, raw, value) as call("adjust_val", 3) {
        let (name, raw) = (call.text(port)?, call.integer(raw)?);
        let devices = call.devices()?;
        let scaled = devices.with(Class::Sensor, &name, |device| sensor::scale(device, raw));
        unify_value(value, &call.or_absent(Class::Sensor, port, scaled)?)
    }

    /// i2c_read_(+Port, +Register, +Count, -Bytes)
    semidet fn "i2c_read_"(context, port, register, count, bytes) as call("i2c_read", 4) {
        let (name, register) = (call.text(port)?, byte(&call, register)?);
        let mut buffer = vec![0; byte(&call, count)?.into()];
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let read = registers::read(&devices, &name, register, &mut buffer, interrupted);
        call.or_absent(Class::Sensor, port, read)?;
        let read: Vec<_> = buffer.into_iter().map(|byte| Value::Integer(byte.into())).collect();
        bytes.unify(call.terms(&read)?.as_slice())
    }

    /// i2c_write_(+Port, +Register, +Bytes)
    semidet fn "i2c_write_"(context, port, register, bytes) as call("i2c_write", 3) {
        let (name, register) = (call.text(port)?, byte(&call, register)?);
        let bytes = call.map_list(bytes, |term| byte(&call, &term))?;
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let written = registers::write(&devices, &name, register, &bytes, interrupted);
        call.or_absent(Class::Sensor, port, written)
    }
}

/// An integer from 0 to 255.
fn byte<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<u8> {
    match u8::try_from(call.integer(term)?) {
        Ok(byte) => Ok(byte),
        Err(_) => wrong_value(call, "byte", term),
    }
}

/// What sensors are to show.
struct Row {
    /// If there are none, any that has the mode.
    types: Vec<Text>,
    mode: Text,
    /// The index of a value, or the number of values.
    index: usize,
}

/// The rows of readings, by the atoms of their names, from Prolog's table.
static ROWS: Mutex<Vec<(Atom, Arc<Row>)>> = Mutex::new(Vec::new());

/// The row that is asked for: by its name, or by its columns.
fn row<'a, C: Prolog>(
    call: &Call<'a, C>,
    types: &Term<'a>,
    mode: &Term<'a>,
    index: impl FnOnce() -> PrologResult<usize>,
) -> PrologResult<Arc<Row>> {
    if types.is_atom() && types.term_type() != TermType::Nil {
        return named_row(call, types);
    }
    let index = index()?;
    let types = call.map_list(types, |kind| call.text(&kind))?;
    Ok(Arc::new(Row { types, mode: call.text(mode)?, index }))
}

fn named_row<'a, C: Prolog>(call: &Call<'a, C>, name: &Term<'a>) -> PrologResult<Arc<Row>> {
    let atom: Atom = name.get()?;
    if let Some((_, row)) = locked(&ROWS).iter().find(|known| known.0 == atom) {
        return Ok(Arc::clone(row));
    }
    let [types, mode, index] = row_called(call, name)?;
    let row = row(call, &types, &mode, || index_of(call, &index))?;
    locked(&ROWS).push((atom, Arc::clone(&row)));
    Ok(row)
}

/// The columns of the row of that name: types, mode and index.
fn row_called<'a, C: Prolog>(call: &Call<'a, C>, name: &Term<'a>) -> PrologResult<[Term<'a>; 3]> {
    let row @ [types, mode, index] = &call.context.new_term_refs();
    let is_row = call.context.ask(pred!("ev3dev_sensors:known/4"), [name, types, mode, index]);
    if !attempt(is_row)? {
        return wrong_type(call, "list", name);
    }
    Ok(row.clone())
}

/// The sensors that the call has not read yet.
struct Readings {
    devices: Arc<Registry>,
    sensors: ListedDevices,
    names_port: bool,
    row: Arc<Row>,
    /// Whether a sensor has shown a value.
    has_value: bool,
}

impl Readings {
    /// The next value that unifies.
    fn next_value<'a, C: Prolog>(
        &mut self,
        call: &Call<'a, C>,
        port: &Term<'a>,
        value: &Term<'a>,
    ) -> PrologResult<bool> {
        let Self { devices, sensors, names_port, row, has_value } = self;
        let has_value = Cell::from_mut(has_value);
        let read = |device: &Arc<Device>| {
            let interrupted = &mut call.interrupted();
            let read = sensor::read(devices, device, Some(&row.mode), row.index, interrupted);
            let read = call.or_fail(read)?;
            watched().note_read(device.port());
            has_value.set(true);
            Ok(read)
        };
        call.next(sensors, read, |device, read| {
            unify_value(value, read)?;
            unify_asked(*names_port, port, device.port())
        })
    }

    /// The same, but explains it if no sensor has a value.
    fn next_or_why<'a, C: Prolog>(
        &mut self,
        call: &Call<'a, C>,
        [port, types, mode]: [&Term<'a>; 3],
        value: &Term<'a>,
    ) -> PrologResult<bool> {
        match self.next_value(call, port, value) {
            Err(PrologError::Failure) if !self.has_value => no_sensor(call, port, types, mode),
            next => next,
        }
    }
}

/// A call of `sensor_known_`.
pub(crate) fn known_value(arguments: &Arguments) -> Option<bool> {
    let (row, port) = (arguments.atom(0)?, arguments.atom(1));
    if port.is_none() && !arguments.is_variable(1) || !arguments.is_variable(2) || is_serving() {
        return None;
    }
    known::with([row, port.unwrap_or(0), 0], |found| {
        let Found { registry, device, name, index, .. } = found;
        // Where it would have to wait, the whole way is gone.
        let read = sensor::read(registry, device, Some(name), index, &mut || true).ok()??;
        let is_port = port.is_some() || arguments.unify_atom(1, handle(device.port())?);
        Some(is_port && known::unify_value(arguments, 2, &read)?)
    })
}

/// The condition to wait for.
fn until<'a, C: Prolog>(call: &Call<'a, C>, test: &Term<'a>) -> PrologResult<Until> {
    let Some([operator, number]) = attempt_opt(call.context.compound_terms::<2>(test))? else {
        return Ok(Until::Bumped);
    };
    let number = call.float(&number)?;
    Ok(match &*call.text(&operator)? {
        "<" => Until::Less(number),
        "=<" => Until::AtMost(number),
        ">" => Until::Greater(number),
        ">=" => Until::AtLeast(number),
        "=:=" => Until::Equal(number),
        "=\\=" => Until::Unequal(number),
        _ => return wrong_value(call, "sensor_condition", test),
    })
}

/// The sensors of a call: at a port, or all; of the types, or, if there are none,
/// all sensors that have the mode.
fn readings<'a, C: Prolog>(
    call: &Call<'a, C>,
    port: &Term<'a>,
    types: &Term<'a>,
    row: Arc<Row>,
) -> PrologResult<Readings> {
    let (name, devices) = (call.text_if_bound(port)?, call.devices()?);
    let look = Look::at(&devices, Class::Sensor);
    let found = call.or_throw(match &name {
        Some(name) => sensor::at(&devices, name, &row.types),
        None => sensor::with_mode(&devices, &row.types, &row.mode),
    })?;
    let (sensors, names_port): (ListedDevices, _) = (found.into_iter().collect(), name.is_none());
    if let (Some(look), 1, Some(sensor)) = (look, sensors.len(), sensors.first()) {
        let port = if names_port { handle(sensor.port()).map(|_| 0) } else { word_in(port) };
        let atoms = [atom_in!(types), port, Some(0)];
        look.keep(atoms, &devices, sensor, row.mode.clone(), row.index);
    }
    Ok(Readings { devices, sensors, names_port, row, has_value: false })
}

/// Fails because no sensor is of one of the types; or, if there are none, has the mode.
fn no_sensor<'a, C: Prolog, T>(
    call: &Call<'a, C>,
    port: &Term<'a>,
    types: &Term<'a>,
    mode: &Term<'a>,
) -> PrologResult<T> {
    let context = call.context;
    let kind = match types.term_type() {
        TermType::Nil => term! {context: mode(#mode)}?,
        TermType::Atom => row_called(call, types)?[0].clone(),
        _ => types.clone(),
    };
    call.fail_because(&term! {context: absent(#&kind, #port)}?)
}

/// The number of a value: sensors have `value0` to `value7`.
fn index_of<C: Prolog>(call: &Call<C>, index: &Term) -> PrologResult<usize> {
    match usize::try_from(call.integer(index)?) {
        Ok(number) if number < 8 => Ok(number),
        _ => wrong_value(call, "sensor_value_index", index),
    }
}
