//! `prolog/ev3dev/bricks.pl`, `private/run/brick.pl`: which brick predicates are about.
use crate::glue::{due, state, waiting};
use ev3_driver::motor;
use swipl::fli::this_thread;
use swipl::prelude::*;

natives! {
    /// brick_(-Number): the brick that this thread has in use.
    semidet fn "brick_"(_context, number) {
        number.unify(u64::from(state::brick_number()))
    }

    /// brick_use_(+Number): fails if that is not open.
    semidet fn "brick_use_"(context, number) as call("use_brick", 1) {
        let number = call.integer(number)?;
        let is_open = u32::try_from(number).is_ok_and(state::use_brick);
        // Its clock may be another one, and what was planned by it may be due.
        waiting::tick_at_once();
        due::look_again();
        into_prolog_result(is_open)
    }

    /// brick_open_(-Number)
    semidet fn "brick_open_"(_context, number) {
        number.unify(u64::from(state::open_brick()))
    }

    /// brick_close_(+Number): stops its motors, and ends its simulation; fails if it is not open.
    semidet fn "brick_close_"(context, number) as call("brick_close", 1) {
        let number = u32::try_from(call.integer(number)?).map_err(|_| PrologError::Failure)?;
        let closed = state::close_brick(number).ok_or(PrologError::Failure)?;
        crate::sim::end_of(number);
        call.or_throw(closed)
    }

    /// far_guard_(-Thread): this thread, of that number, has called a goal of a far brick, whose
    /// motors may turn.
    semidet fn "far_guard_"(context, thread) as call("far", 2) {
        thread.unify(i64::from(this_thread()))?;
        let _ = state::watch_signals();
        call.guard(true)
    }

    /// stop_turning_(-Ports): stops the motors that turn, of all bricks.
    semidet fn "stop_turning_"(_context, ports) {
        let stopped = state::stop_turning(None);
        let names: Vec<_> = stopped.iter().map(|motor| atomable(motor.port())).collect();
        ports.unify(names.as_slice())
    }

    /// stop_all_bricks_: stops all motors that are connected to the bricks in use.
    semidet fn "stop_all_bricks_"(context) as call("stop_all_bricks", 0) {
        let stop = |devices: &_| motor::stop_connected(devices, &mut call.interrupted());
        call.or_throw(state::on_all_bricks(stop))
    }
}
