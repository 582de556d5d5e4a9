//! `prolog/ev3dev/motors.pl`, `motor_moves.pl`, `motor_settings.pl`: motors.
use crate::driver::{class_of, unify_port};
use crate::glue::call::{Call, ListedDevices, Text, has_prepared_motors};
use crate::glue::due::has_guards;
use crate::glue::error::wrong_value;
use crate::glue::interned::word_in;
use crate::glue::known::{self, Found, Look};
use crate::glue::state::chosen_devices;
use crate::glue::terms::{Prolog, unify_atom, unify_value};
use crate::glue::waiting;
use ev3_driver::device::retry;
use ev3_driver::journal;
use ev3_driver::motor::wait::{self, UntilDone, UntilFlag};
use ev3_driver::motor::{self, Extent, Move, MoveOptions, Moving, Run, Speed, StopAction};
use ev3_driver::wait::Slices;
use ev3_driver::{Class, Device};
use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;
use swipl::fli::Arguments;
use swipl::prelude::*;

natives! {
    /// motor_run_(+Port, +Speed): a percentage, or dps(DegreesPerSecond).
    semidet fn "motor_run_"(context, port, percent) as call("motor_run", 2) {
        let (name, speed) = (call.text(port)?, speed_of(&call, percent)?);
        let (run, devices) = (Run { port: &name, speed }, call.devices_to_move()?);
        let (look, interrupted) = (Look::at(&devices, Class::TachoMotor), &mut call.interrupted());
        let motors = call.or_fail(motor::run_forever(&devices, &[run], interrupted))?;
        if let (Some(look), [motor]) = (look, &*motors) {
            look.keep([word_in(port), Some(0), Some(0)], &devices, motor, Text::Borrowed(""), 0);
        }
        Ok(())
    }

    /// run_forever_(+Port, +CountsPerSecond)
    semidet fn "run_forever_"(context, port, speed) as call("run_forever", 2) {
        let (port, speed) = (call.text(port)?, Speed::CountsPerSecond(call.integer(speed)?));
        let (run, devices) = (Run { port: &port, speed }, call.devices_to_move()?);
        let interrupted = &mut call.interrupted();
        call.or_fail(motor::run_forever(&devices, &[run], interrupted)).map(drop)
    }

    /// motors_run_(+Runs): a list of run(Port, Speed), started together.
    semidet fn "motors_run_"(context, runs) as call("motors_run", 1) {
        let run = |run: &Term<'a>| -> PrologResult<_> {
            let [port, percent] = call.arguments(run)?;
            Ok((call.text(&port)?, speed_of(&call, &percent)?))
        };
        let runs = call.list(runs)?.iter().map(run).collect::<PrologResult<Vec<_>>>()?;
        let runs = runs.iter().map(|(port, speed)| Run { port, speed: *speed });
        let (runs, devices) = (runs.collect::<Vec<_>>(), call.devices_to_move()?);
        let interrupted = &mut call.interrupted();
        call.or_fail(motor::run_forever(&devices, &runs, interrupted)).map(drop)
    }

    /// motor_turn_(+Moves, +Options, -Reason): moves is a list of
    /// move(Port, Speed, Degrees), to(Port, Speed, Degrees) and
    /// for(Port, Speed, Seconds), options is
    /// options(StopAction, RampUp, RampDown, Wait, Timeout). If the wait is left, the
    /// motors stop.
    nondet fn "motor_turn_"<Slices<Moving>>(context, moves, options, reason) as call("motor_run", 4) {
        setup => {
            let turn = |turn: &Term<'a>| -> PrologResult<_> {
                let [port, percent, way] = call.arguments(turn)?;
                let speed = speed_of(&call, &percent)?;
                Ok((call.text(&port)?, speed, self::way(&call, turn, &way)?))
            };
            let moves = call.list(moves)?.iter().map(turn).collect::<PrologResult<Vec<_>>>()?;
            let moves = moves.iter().map(|(port, speed, way)| Move { port, speed: *speed, extent: *way });
            let (moves, options) = (moves.collect::<Vec<_>>(), move_options(&call, options)?);
            let (devices, interrupted) = (call.devices_to_move()?, &mut call.interrupted());
            call.or_fail(motor::begin(&devices, &moves, &options, interrupted)).map(Some)
        },
        call(moving) => {
            call.slice_of_move(moving, reason)
        }
    }

    /// motor_stop_(+Class, +Port, +StopAction)
    semidet fn "motor_stop_"(context, class, port, action) as call("motor_stop", 2) {
        let class = class_of(context, class)?;
        let (name, action) = (call.text(port)?, stop_action(&call, action)?);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let stop = |motor: &Arc<Device>| motor::stop(motor, action);
        call.or_absent(class, port, retry::with(&devices, class, &name, interrupted, stop))
    }

    /// stop_all_motors_
    semidet fn "stop_all_motors_"(context) as call("stop_all_motors", 0) {
        call.or_throw(motor::stop_connected(&*call.devices_to_command()?, &mut call.interrupted()))
    }

    /// commands_(-Count): how many commands the program has given to motors.
    semidet fn "commands_"(_context, count) {
        count.unify(u64::from(motor::command_count()))
    }

    /// motors_stop_(+From, +Before): stops the motors whose last command was one of
    /// these, of this thread.
    semidet fn "motors_stop_"(context, from, before) as call("behave", 2) {
        let commands = commands_of(&call, from, before)?;
        call.devices_to_command()?;
        call.stop_commanded(&commands)
    }

    /// motors_leave_(+From, +Before): the same at the first wait of this thread, in the place of
    /// other commands since From.
    semidet fn "motors_leave_"(context, from, before) as call("behave", 2) {
        waiting::stop_at_wait(commands_of(&call, from, before)?);
        Ok(())
    }

    /// motor_reset_(+Port)
    semidet fn "motor_reset_"(context, port) as call("motor_reset", 1) {
        let (class, name) = (Class::TachoMotor, call.text(port)?);
        let (devices, interrupted) = (call.devices_to_command()?, &mut call.interrupted());
        let reset = |motor: &Arc<Device>| motor::reset(motor);
        call.or_absent(class, port, retry::with(&devices, class, &name, interrupted, reset))
    }

    /// motor_wait_(+Ports, +Timeout, -Reason)
    nondet fn "motor_wait_"<Slices<UntilDone>>(context, ports, timeout, reason) as call("motor_wait", 3) {
        setup => {
            let devices = call.devices()?;
            let ports = call.list(ports)?.iter().map(|p| call.text(p)).collect::<PrologResult<Vec<_>>>()?;
            let timeout = call.seconds(timeout)?;
            let motors = call.or_fail(motor::find_all(&devices, ports.iter().map(AsRef::as_ref)))?;
            Ok(Some(wait::until_done(&devices, &motors, timeout)))
        },
        call(waiting) => {
            call.slice_of_move(waiting, reason)
        }
    }

    /// motor_wait_flag_(+Port, +Flag, +Present, -Reason): `over` at the end.
    nondet fn "motor_wait_flag_"<Slices<UntilFlag>>(context, port, flag, present, reason) as call("motor_wait_while", 2) {
        setup => {
            let devices = call.devices()?;
            let (name, flag, present) = (call.text(port)?, call.text(flag)?, present.get_ex()?);
            let found = devices.find(Class::TachoMotor, &name);
            let motor = call.or_absent(Class::TachoMotor, port, found)?;
            Ok(Some(wait::until_flag(&devices, &motor, &flag, present)))
        },
        call(waiting) => {
            call.slice(waiting, reason, |()| unify_atom(reason, "over"))
        }
    }

    /// motor_run_direct_(+Class, +Port, +Percent)
    semidet fn "motor_run_direct_"(context, class, port, percent) as call("motor_run_direct", 2) {
        let class = class_of(context, class)?;
        let (port, percent) = (call.text(port)?, call.float(percent)?);
        let (devices, interrupted) = (call.devices_to_move()?, &mut call.interrupted());
        let runs = motor::run_direct(&devices, class, &port, percent, interrupted);
        into_prolog_result(call.or_throw(runs)?)
    }

    /// motor_position_(?Port, -Position)
    nondet fn "motor_position_"<ListedDevices>(context, port, position) as call("motor_position", 2) {
        setup => {
            call.listed(&*call.devices()?, Class::TachoMotor, port).map(Some)
        },
        call(motors) => {
            next_measured(&call, motors, "position", port, position)
        }
    }

    /// motor_speed_(?Port, -Speed)
    nondet fn "motor_speed_"<ListedDevices>(context, port, speed) as call("motor_speed", 2) {
        setup => {
            call.listed(&*call.devices()?, Class::TachoMotor, port).map(Some)
        },
        call(motors) => {
            next_measured(&call, motors, "speed", port, speed)
        }
    }

    /// motor_counts_(+Port, +Constant, -Counts): `max_speed`, or `count_per_rot` with the gear,
    /// of a motor of which the driver has read it. Asks no device.
    semidet fn "motor_counts_"(context, port, constant, counts) as call("why", 1) {
        let devices = chosen_devices().ok_or(PrologError::Failure)?;
        let known = motor::known_counts(&devices, &call.text(port)?, &call.text(constant)?);
        counts.unify(known.ok_or(PrologError::Failure)?)
    }

    /// motor_gear_(?Port, -Ratio)
    nondet fn "motor_gear_"<ListedDevices>(context, port, ratio) as call("motor_gear", 2) {
        setup => {
            call.listed(&*call.devices()?, Class::TachoMotor, port).map(Some)
        },
        call(motors) => {
            call.next(motors, |motor| Ok(motor.gear()), |motor, gear| {
                ratio.unify(gear)?;
                unify_port(port, motor.port())
            })
        }
    }

    /// motor_set_gear_(+Port, +Ratio)
    semidet fn "motor_set_gear_"(context, port, ratio) as call("motor_gear", 2) {
        let (name, ratio) = (call.text(port)?, call.float(ratio)?);
        let devices = call.devices()?;
        let set = |motor: &Arc<Device>| motor::set_gear(motor, ratio);
        call.or_absent(Class::TachoMotor, port, devices.with(Class::TachoMotor, &name, set))
    }

    /// motor_set_position_(+Port, +Position)
    semidet fn "motor_set_position_"(context, port, position) as call("motor_position", 2) {
        let (name, position) = (call.text(port)?, call.float(position)?);
        let (devices, interrupted) = (call.devices()?, &mut call.interrupted());
        let set = |motor: &Arc<Device>| motor::set_position(motor, position);
        let set = retry::with(&devices, Class::TachoMotor, &name, interrupted, set);
        into_prolog_result(call.or_absent(Class::TachoMotor, port, set)?)
    }
}

/// A call of `motor_run_` with a motor that is known.
pub(crate) fn known_run(arguments: &Arguments) -> Option<bool> {
    let (port, percent) = (arguments.atom(0)?, arguments.float(1)?);
    if !has_prepared_motors() || has_guards() {
        return None;
    }
    known::with([port, 0, 0], |Found { device, now, .. }| {
        device.check_present_at(now).ok()?;
        journal::set_called("motor_run", 2);
        motor::run_one(device, Speed::Percent(percent)).ok()
    })
}

/// The next motor's port, and an attribute of it in degrees or millimeters.
fn next_measured<'a, C: Prolog>(
    call: &Call<'a, C>,
    motors: &mut ListedDevices,
    attribute: &str,
    port: &Term<'a>,
    value: &Term<'a>,
) -> PrologResult<bool> {
    let devices = &call.devices()?;
    let measured = |motor: &Device| motor::measured(motor, attribute);
    let read = |motor: &Arc<Device>| call.or_fail(devices.read(motor, measured));
    call.next(motors, read, |motor, read| {
        unify_value(value, read)?;
        unify_port(port, motor.port())
    })
}

/// A percentage, or `dps(DegreesPerSecond)`.
fn speed_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Speed> {
    if let Some(percent) = attempt_opt(term.get())? {
        return Ok(Speed::Percent(percent));
    }
    match attempt_opt(call.context.compound_terms::<1>(term))? {
        Some([degrees]) => call.float(&degrees).map(Speed::DegreesPerSecond),
        None => call.float(term).map(Speed::Percent),
    }
}

/// Commands by their numbers.
fn commands_of<C: Prolog>(call: &Call<C>, from: &Term, before: &Term) -> PrologResult<Range<u32>> {
    let number = |term| u32::try_from(call.integer(term)?).map_err(|_| PrologError::Failure);
    Ok(number(from)?..number(before)?)
}

/// How far a move goes, by the name of its term.
fn way<C: Prolog>(call: &Call<C>, turn: &Term, way: &Term) -> PrologResult<Extent> {
    match &*turn.get::<Functor>()?.name_string() {
        "to" => Ok(Extent::To(call.float(way)?)),
        "for" => Ok(Extent::For(call.time(way)?)),
        "move" => Ok(Extent::By(call.float(way)?)),
        _ => wrong_value(call, "motor_move", turn),
    }
}

pub(crate) fn move_options<'a, C: Prolog>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<MoveOptions> {
    let [action, ramp_up, ramp_down, wait, timeout] = call.arguments(options)?;
    let ramp =
        |ramp: &Term| if ramp.is_integer() { call.integer(ramp).map(Some) } else { Ok(None) };
    Ok(MoveOptions {
        stop_action: stop_action(call, &action)?,
        ramp_up_ms: ramp(&ramp_up)?,
        ramp_down_ms: ramp(&ramp_down)?,
        wait: wait.get_ex()?,
        timeout: call.seconds(&timeout)?.filter(|timeout| *timeout < Duration::MAX),
    })
}

/// One of the stop actions.
pub(crate) fn stop_action<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<StopAction> {
    match StopAction::named(&call.text(term)?) {
        Some(action) => Ok(action),
        None => wrong_value(call, "stop_action", term),
    }
}
