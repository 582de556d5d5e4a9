//! `prolog/ev3dev/private/golog/planning_task.pl`: plans for domains of Golog.
use crate::glue::call::Call;
use crate::glue::error::wrong_because;
use crate::glue::terms::Prolog;
use ev3_os::locked;
use ev3_planner::{Action, Concurrent, Effect, Formula, Limits, Planner, Progress, Rule, Task};
use std::sync::{Arc, Mutex};
use swipl::prelude::*;

/// The memory that a search may take: a brick has 64 MB for all.
const BYTES: usize = if cfg!(target_pointer_width = "64") { 512 << 20 } else { 16 << 20 };

/// A search that has begun.
#[arc_blob("ev3_planner", defaults)]
struct PlannerBlob {
    /// `None` once it has ended: Prolog may keep the blob for long.
    planner: Mutex<Option<Planner>>,
}

natives! {
    /// planner_new_(+Task, +Cheapest, -Planner): task(Facts, Initial, Actions, Rules, Goal,
    /// Concurrent). Facts is their number, initial a list of facts, actions a list of
    /// action(Condition, Effects, Cost), whose effects are effect(Truth, Fact, Condition), and rules
    /// a list of rule(Fact, Condition). Conditions are those of `ground.pl`, with the numbers of
    /// facts. Concurrent is `none`, or concurrent(Agents, Needs, Excludes, Always): the agent of
    /// each action, a number or `none`; a list of Action-Others; a list of Action-Other; a condition.
    semidet fn "planner_new_"(context, task, cheapest, planner) as call("do", 2) {
        let limits = Limits { cheapest: truth(&call, cheapest)?, bytes: BYTES };
        match Planner::new(&task_of(&call, task)?, &limits) {
            Ok(made) => planner.unify(Arc::new(PlannerBlob { planner: Mutex::new(Some(made)) })),
            Err(fault) => wrong_because(&call, "planning_task", task, &fault.to_string()),
        }
    }

    /// planner_work_(+Planner, +Steps, -Progress, -States): progress is plan(Actions), with their
    /// indices from 0, steps(Lists) with the actions of each step, no_plan, working or
    /// gave_up(Limit).
    semidet fn "planner_work_"(context, planner, steps, progress, states) as call("do", 2) {
        let steps = u64::try_from(call.integer(steps)?).unwrap_or(0);
        let blob: Arc<PlannerBlob> = planner.get_ex()?;
        let mut planner = locked(&blob.planner);
        let planner = planner.as_mut().ok_or(PrologError::Failure)?;
        let now = planner.work(steps);
        states.unify(planner.states() as u64)?;
        progress.unify(&progress_term(&call, now)?)
    }

    /// planner_end_(+Planner): what it has in memory is released.
    semidet fn "planner_end_"(_context, planner) {
        let blob: Arc<PlannerBlob> = planner.get_ex()?;
        *locked(&blob.planner) = None;
        Ok(())
    }
}

fn progress_term<'a, C: Prolog>(call: &Call<'a, C>, progress: Progress) -> PrologResult<Term<'a>> {
    let context = call.context;
    let list = |actions: Vec<usize>| {
        let list = context.new_term_ref();
        let actions: Vec<_> = actions.into_iter().map(|action| action as u64).collect();
        list.unify(actions.as_slice())?;
        Ok::<_, PrologError>(list)
    };
    match progress {
        Progress::Plan(plan) => {
            let plan = list(plan)?;
            term! {context: plan(#&plan)}
        }
        Progress::Steps(steps) => {
            let steps = steps.into_iter().map(list).collect::<PrologResult<Vec<_>>>()?;
            let plan = context.new_term_ref();
            plan.unify(steps.as_slice())?;
            term! {context: steps(#&plan)}
        }
        Progress::NoPlan => term! {context: no_plan},
        Progress::Working => term! {context: working},
        Progress::OutOfMemory => {
            let megabytes = (BYTES >> 20) as u64;
            term! {context: gave_up(megabytes(#megabytes))}
        }
    }
}

fn number<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<usize> {
    Ok(usize::try_from(call.integer(term)?).unwrap_or(usize::MAX))
}

fn truth<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<bool> {
    Ok(&*call.text(term)? == "true")
}

fn task_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Task> {
    let [facts, initial, actions, rules, goal, concurrent] = call.arguments(term)?;
    Ok(Task {
        facts: number(call, &facts)?,
        initial: call.map_list(&initial, |fact| number(call, &fact))?,
        actions: call.map_list(&actions, |action| action_of(call, &action))?,
        rules: call.map_list(&rules, |rule| rule_of(call, &rule))?,
        goal: formula(call, &goal)?,
        concurrent: concurrent_of(call, &concurrent)?,
    })
}

fn concurrent_of<'a, C: Prolog>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<Option<Concurrent>> {
    if term.is_atom() {
        return Ok(None);
    }
    let [agents, needs, excludes, always] = call.arguments(term)?;
    let agent = |term: Term<'a>| Ok(if term.is_atom() { None } else { Some(number(call, &term)?) });
    let need = |term: Term<'a>| {
        let [action, others] = call.arguments(&term)?;
        Ok((number(call, &action)?, call.map_list(&others, |other| number(call, &other))?))
    };
    let exclude = |term: Term<'a>| {
        let [action, other] = call.arguments(&term)?;
        Ok((number(call, &action)?, number(call, &other)?))
    };
    Ok(Some(Concurrent {
        agents: call.map_list(&agents, agent)?,
        needs: call.map_list(&needs, need)?,
        excludes: call.map_list(&excludes, exclude)?,
        always: formula(call, &always)?,
    }))
}

fn action_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Action> {
    let [condition, effects, cost] = call.arguments(term)?;
    let effect = |term: Term<'a>| {
        let [value, fact, condition] = call.arguments(&term)?;
        Ok(Effect {
            condition: formula(call, &condition)?,
            fact: number(call, &fact)?,
            value: truth(call, &value)?,
        })
    };
    Ok(Action {
        condition: formula(call, &condition)?,
        effects: call.map_list(&effects, effect)?,
        cost: u32::try_from(call.integer(&cost)?).unwrap_or(u32::MAX),
    })
}

fn rule_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Rule> {
    let [fact, condition] = call.arguments(term)?;
    Ok(Rule { fact: number(call, &fact)?, condition: formula(call, &condition)? })
}

fn formula<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Formula> {
    if term.is_integer() {
        return Ok(Formula::Fact(number(call, term)?));
    }
    if term.is_atom() {
        return Ok(if truth(call, term)? { Formula::TRUE } else { Formula::FALSE });
    }
    let terms = call.list(term)?;
    let [word, parts @ ..] = &*terms else { return Ok(Formula::TRUE) };
    let mut parts =
        parts.iter().map(|part| formula(call, part)).collect::<PrologResult<Vec<_>>>()?;
    Ok(match (&*call.text(word)?, parts.pop()) {
        ("not", Some(part)) => Formula::Not(Box::new(part)),
        (word, last) => {
            parts.extend(last);
            if word == "and" { Formula::And(parts) } else { Formula::Or(parts) }
        }
    })
}
