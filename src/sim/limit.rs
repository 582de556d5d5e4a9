//! `prolog/ev3dev/private/simulation/time_limits.pl`: a goal that is left, whatever it catches.
//!
//! catch/3 throws an abort again when it has caught one, so no goal of Prolog ends it: only a
//! query of native code does.
use crate::glue::terms::{Ask as _, Prolog};
use crate::glue::waiting;
use std::cell::RefCell;
use swipl::prelude::*;

thread_local! {
    /// The limits whose goals this thread runs, the innermost last.
    static LIMITS: RefCell<Vec<i64>> = const { RefCell::new(Vec::new()) };
}

natives! {
    /// limit_call_(+Id, :Goal): calls Goal once. What it throws ends it well if
    /// `ev3dev_time_limits:is_left_by/2` says so.
    semidet fn "limit_call_"(context, id, goal) {
        let rounds = waiting::rounds();
        let number = id.get()?;
        LIMITS.with_borrow_mut(|limits| limits.push(number));
        let result = context.ask(pred!("ev3dev_frames:goal_of_program/1"), [goal]);
        LIMITS.with_borrow_mut(Vec::pop);
        if matches!(result, Err(PrologError::Exception)) && is_left(context, id) {
            context.clear_exception();
            waiting::back_to_rounds(rounds);
            return Ok(());
        }
        result
    }

    /// limit_insist_(+Id, +Thread, :Goal, +Ball): if this thread still is in that limit, throws
    /// Ball, and has Goal called as soon as that was caught: also before the first goal of a
    /// recovery.
    semidet fn "limit_insist_"(context, id, thread, goal, ball) {
        let number: i64 = id.get()?;
        if LIMITS.with_borrow(|limits| limits.contains(&number)) {
            context.ask(pred!("thread_signal/2"), [thread, goal])?;
            return context.raise_exception(ball);
        }
        Ok(())
    }
}

/// Whether the exception that is thrown now is how a limit leaves its goal.
fn is_left<C: Prolog>(context: &Context<C>, id: &Term) -> bool {
    context.with_exception(|ball| {
        let by = |ball| context.ask(pred!("ev3dev_time_limits:is_left_by/2"), [id, ball]);
        ball.is_some_and(|ball| by(ball).is_ok())
    })
}
