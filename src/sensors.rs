//! `prolog/ev3dev/sensors.pl`: sensors.
use crate::driver::unify_asked;
use crate::glue::call::{Call, ListedDevices, Text};
use crate::glue::error::wrong_value;
use crate::glue::interned::words;
use crate::glue::terms::{unify_atom, unify_value};
use ev3_driver::sensor::registers;
use ev3_driver::sensor::wait::{Until, UntilShown, until_shown};
use ev3_driver::wait::Slices;
use ev3_driver::{Class, Device, Registry, Value, sensor};
use std::cell::Cell;
use std::sync::Arc;
use swipl::prelude::*;

natives! {
    /// sensor_value_(?Port, +Types, +Mode, +Index, -Value)
    nondet fn "sensor_value_"<Readings>(context, port, types, mode, index, value) {
        setup => {
            let call = Call::of(context, "sensor_value", 4);
            if call.serve_before("sensor_value_", [port, types, mode, index, value])? {
                return Ok(None);
            }
            let index = index_of(&call, index)?;
            readings(&call, port, types, mode, index).map(Some)
        },
        call(readings) => {
            next_value(&Call::of(context, "sensor_value", 4), readings, port, value)
        }
    }

    /// sensor_value_or_why_(?Port, +Types, +Mode, +Index, -Value): the same, but explains
    /// it if there is no value.
    nondet fn "sensor_value_or_why_"<Readings>(context, port, types, mode, index, value) {
        setup => {
            let call = Call::of(context, "sensor_value", 4);
            if call.serve_before("sensor_value_or_why_", [port, types, mode, index, value])? {
                return Ok(None);
            }
            let index = index_of(&call, index)?;
            readings(&call, port, types, mode, index).map(Some)
        },
        call(readings) => {
            let call = Call::of(context, "sensor_value", 4);
            match next_value(&call, readings, port, value) {
                Err(PrologError::Failure) if !readings.has_value => no_sensor(&call, port, types, mode),
                next => next,
            }
        }
    }

    /// sensor_values_(?Port, +Types, +Mode, +Count, ?Values): the list of the first
    /// Count values, or of all values of the mode if Count is 0.
    nondet fn "sensor_values_"<Readings>(context, port, types, mode, count, values) {
        setup => {
            let call = Call::of(context, "sensor_values", 3);
            if call.serve_before("sensor_values_", [port, types, mode, count, values])? {
                return Ok(None);
            }
            let count = usize::try_from(call.integer(count)?).unwrap_or_default();
            let readings = readings(&call, port, types, mode, count)?;
            if readings.sensors.len() == 0 { no_sensor(&call, port, types, mode) } else { Ok(Some(readings)) }
        },
        call(readings) => {
            let call = Call::of(context, "sensor_values", 3);
            let Readings { devices, sensors, names_port, mode, index: count, .. } = readings;
            let count = (*count > 0).then_some(*count);
            let read = |device: &Arc<Device>| {
                let interrupted = &mut call.interrupted();
                let read = sensor::read_several(devices, device, mode, count, interrupted);
                call.terms(&call.or_fail(read)?)
            };
            call.next(sensors, read, |device, read| {
                values.unify(read.as_slice())?;
                unify_asked(*names_port, port, device.port())
            })
        }
    }

    /// sensor_restart_(+Port, +Types, +Mode)
    semidet fn "sensor_restart_"(context, port, types, mode) {
        let call = Call::of(context, "gyro_reset", 1);
        call.text(port)?;
        let Readings { devices, mut sensors, mode: name, .. } = readings(&call, port, types, mode, 0)?;
        let Some(sensor) = sensors.next() else {
            return no_sensor(&call, port, types, mode);
        };
        let interrupted = &mut call.interrupted();
        call.or_fail(sensor::restart(&devices, &sensor, &name, interrupted))
    }

    /// sensor_wait_(+Port, +Reading, +Test, +Timeout, -Ended): reading is
    /// reading(Types, Mode, Index), test is test(Operator, Number) or `bumped`.
    nondet fn "sensor_wait_"<Slices<UntilShown>>(context, port, reading, test, timeout, ended) {
        setup => {
            let call = Call::of(context, "sensor_wait", 2);
            let [types, mode, index] = call.arguments(reading)?;
            let (index, until) = (index_of(&call, &index)?, until(&call, test)?);
            let timeout = call.seconds(timeout)?;
            let Readings { devices, mut sensors, mode, .. } =
                readings(&call, port, &types, &mode, index)?;
            let sensor = sensors.next().ok_or(PrologError::Failure)?;
            Ok(Some(until_shown(&devices, &sensor, &mode, index, until, timeout)))
        },
        call(waiting) => {
            let call = Call::of(context, "sensor_wait", 2);
            call.slice(waiting, ended, |end| unify_atom(ended, end.word()))
        }
    }

    /// sensor_scale_(+Port, +Raw, -Value)
    semidet fn "sensor_scale_"(context, port, raw, value) {
        let call = Call::of(context, "adjust_val", 3);
        let (name, raw) = (call.text(port)?, call.integer(raw)?);
        let devices = call.devices()?;
        let scaled = devices.with(Class::Sensor, &name, |device| sensor::scale(device, raw));
        unify_value(value, &call.or_absent(Class::Sensor, port, scaled)?)
    }

    /// i2c_read_(+Port, +Register, +Count, -Bytes)
    semidet fn "i2c_read_"(context, port, register, count, bytes) {
        let call = Call::of(context, "i2c_read", 4);
        let (name, register) = (call.text(port)?, byte(&call, register)?);
        let mut buffer = vec![0; byte(&call, count)?.into()];
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let read = registers::read(&devices, &name, register, &mut buffer, interrupted);
        call.or_absent(Class::Sensor, port, read)?;
        let read: Vec<_> = buffer.into_iter().map(|byte| Value::Integer(byte.into())).collect();
        bytes.unify(call.terms(&read)?.as_slice())
    }

    /// i2c_write_(+Port, +Register, +Bytes)
    semidet fn "i2c_write_"(context, port, register, bytes) {
        let call = Call::of(context, "i2c_write", 3);
        let (name, register) = (call.text(port)?, byte(&call, register)?);
        let bytes = call.map_list(bytes, |term| byte(&call, &term))?;
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let written = registers::write(&devices, &name, register, &bytes, interrupted);
        call.or_absent(Class::Sensor, port, written)
    }
}

/// An integer from 0 to 255.
fn byte<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<u8> {
    match u8::try_from(call.integer(term)?) {
        Ok(byte) => Ok(byte),
        Err(_) => wrong_value(call, "byte", term),
    }
}

/// The sensors that the call has not read yet.
struct Readings {
    devices: Arc<Registry>,
    sensors: ListedDevices,
    names_port: bool,
    mode: Text,
    /// The index of a value, or the number of values.
    index: usize,
    /// Whether a sensor has shown a value.
    has_value: bool,
}

/// The next value that unifies.
fn next_value<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    readings: &mut Readings,
    port: &Term<'a>,
    value: &Term<'a>,
) -> PrologResult<bool> {
    let Readings { devices, sensors, names_port, mode, index, has_value } = readings;
    let has_value = Cell::from_mut(has_value);
    let read = |device: &Arc<Device>| {
        let interrupted = &mut call.interrupted();
        let read = sensor::read(devices, device, Some(mode), *index, interrupted);
        let read = call.or_fail(read)?;
        has_value.set(true);
        Ok(read)
    };
    call.next(sensors, read, |device, read| {
        unify_value(value, read)?;
        unify_asked(*names_port, port, device.port())
    })
}

/// The condition to wait for.
fn until<'a, C: QueryableContextType>(call: &Call<'a, C>, test: &Term<'a>) -> PrologResult<Until> {
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

/// The sensors of a call: at a port, or all; of the given types, or, if there are none,
/// all sensors that have the mode.
fn readings<'a, C: QueryableContextType>(
    call: &Call<'a, C>,
    port: &Term<'a>,
    types: &Term<'a>,
    mode: &Term<'a>,
    index: usize,
) -> PrologResult<Readings> {
    let mode = call.text(mode)?;
    let (port, devices) = (call.text_if_bound(port)?, call.devices()?);
    let found = with_types(call, types, |types| {
        call.or_throw(match &port {
            Some(port) => sensor::at(&devices, port, types),
            None => sensor::with_mode(&devices, types, &mode),
        })
    })?;
    let (sensors, names_port) = (found.into_iter(), port.is_none());
    Ok(Readings { devices, sensors, names_port, mode, index, has_value: false })
}

/// Fails because no sensor is of one of the types; or, if there are none, has the mode.
fn no_sensor<'a, C: QueryableContextType, T>(
    call: &Call<'a, C>,
    port: &Term<'a>,
    types: &Term<'a>,
    mode: &Term<'a>,
) -> PrologResult<T> {
    let context = call.context;
    let kind = if types.term_type() == TermType::Nil {
        term! {context: mode(#mode)}?
    } else {
        types.clone()
    };
    call.fail_because(&term! {context: absent(#&kind, #port)}?)
}

/// Calls a closure with a list of types; the empty list admits all.
fn with_types<'a, C: QueryableContextType, T>(
    call: &Call<'a, C>,
    types: &Term<'a>,
    act: impl FnOnce(&[&str]) -> PrologResult<T>,
) -> PrologResult<T> {
    if let Some(words) = words(types) {
        return act(&words);
    }
    let types = call.map_list(types, |kind| call.text(&kind))?;
    act(&types.iter().map(AsRef::as_ref).collect::<Vec<_>>())
}

/// The number of a value: sensors have `value0` to `value7`.
fn index_of<C: QueryableContextType>(call: &Call<C>, index: &Term) -> PrologResult<usize> {
    match usize::try_from(call.integer(index)?) {
        Ok(number) if number < 8 => Ok(number),
        _ => wrong_value(call, "sensor_value_index", index),
    }
}
