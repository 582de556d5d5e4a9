//! Small random tasks against a search through all states that shares no code with the crate.
use ev3_planner::{
    Action, Concurrent, Effect, Fault, Formula, Limits, Planner, Progress, Rule, Task,
};
use proptest::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

const FACTS: usize = 7;
/// These are derived.
const DERIVED: std::ops::Range<usize> = 5..FACTS;

type State = BTreeSet<usize>;

fn holds(formula: &Formula, state: &State) -> bool {
    match formula {
        Formula::Fact(fact) => state.contains(fact),
        Formula::Not(part) => !holds(part, state),
        Formula::And(parts) => parts.iter().all(|part| holds(part, state)),
        Formula::Or(parts) => parts.iter().any(|part| holds(part, state)),
    }
}

/// The state with what the rules derive. Fact 5 does not depend on fact 6.
fn derive(task: &Task, mut state: State) -> State {
    for derived in DERIVED {
        state.remove(&derived);
    }
    for derived in DERIVED {
        for _ in &task.rules {
            for rule in task.rules.iter().filter(|rule| rule.fact == derived) {
                if holds(&rule.condition, &state) {
                    state.insert(derived);
                }
            }
        }
    }
    state
}

fn after(task: &Task, action: &Action, state: &State) -> State {
    let mut next = state.clone();
    let effects = action.effects.iter().filter(|effect| holds(&effect.condition, state));
    let (adds, deletes): (Vec<_>, Vec<_>) = effects.partition(|effect| effect.value);
    for effect in deletes {
        next.remove(&effect.fact);
    }
    next.extend(adds.iter().map(|effect| effect.fact));
    derive(task, next)
}

/// The least cost of a plan.
fn least_cost(task: &Task) -> Option<u32> {
    let mut costs = BTreeMap::from([(derive(task, task.initial.iter().copied().collect()), 0)]);
    loop {
        let mut better = BTreeMap::new();
        for (state, cost) in &costs {
            for action in task.actions.iter().filter(|action| holds(&action.condition, state)) {
                let next = after(task, action, state);
                let cost = cost + action.cost;
                if costs.get(&next).is_none_or(|&known| cost < known) {
                    better
                        .entry(next)
                        .and_modify(|old: &mut u32| *old = cost.min(*old))
                        .or_insert(cost);
                }
            }
        }
        if better.is_empty() {
            break;
        }
        costs.extend(better);
    }
    costs.iter().filter(|(state, _)| holds(&task.goal, state)).map(|(_, &cost)| cost).min()
}

/// The cost of a plan, if it is one.
fn cost(task: &Task, plan: &[usize]) -> Option<u32> {
    let mut state = derive(task, task.initial.iter().copied().collect());
    let mut cost = 0;
    for &action in plan {
        let action = &task.actions[action];
        if !holds(&action.condition, &state) {
            return None;
        }
        state = after(task, action, &state);
        cost += action.cost;
    }
    holds(&task.goal, &state).then_some(cost)
}

fn formula(facts: usize) -> impl Strategy<Value = Formula> {
    let fact = (0..facts, any::<bool>()).prop_map(|(fact, value)| {
        let fact = Formula::Fact(fact);
        if value { fact } else { Formula::Not(Box::new(fact)) }
    });
    fact.prop_recursive(2, 6, 3, |part| {
        let parts = || prop::collection::vec(part.clone(), 0..4);
        prop_oneof![
            4 => parts().prop_map(Formula::And),
            1 => parts().prop_map(Formula::Or),
            1 => part.clone().prop_map(|part| Formula::Not(Box::new(part))),
        ]
    })
}

fn action() -> impl Strategy<Value = Action> {
    let effect = (formula(FACTS), any::<bool>(), 0..DERIVED.start, any::<bool>());
    let effect = effect.prop_map(|(condition, always, fact, value)| {
        let condition = if always { Formula::TRUE } else { condition };
        Effect { condition, fact, value }
    });
    (formula(FACTS), prop::collection::vec(effect, 1..4), 0..4_u32)
        .prop_map(|(condition, effects, cost)| Action { condition, effects, cost })
}

fn task() -> impl Strategy<Value = Task> {
    let rule = |fact| formula(fact).prop_map(move |condition| Rule { fact, condition });
    let rules = prop::collection::vec(prop_oneof![rule(5), rule(6)], 0..4);
    let initial = prop::collection::vec(0..DERIVED.start, 0..3);
    (initial, prop::collection::vec(action(), 1..7), rules, formula(FACTS)).prop_map(
        |(initial, actions, rules, goal)| Task {
            facts: FACTS,
            initial,
            actions,
            rules,
            goal,
            concurrent: None,
        },
    )
}

fn solve(task: &Task, cheapest: bool) -> Progress {
    let mut planner = Planner::new(task, &Limits { cheapest, ..Limits::default() }).unwrap();
    loop {
        // Small pieces: the end of a piece changes nothing.
        let progress = planner.work(50);
        if progress != Progress::Working {
            return progress;
        }
    }
}

fn several_agents() -> impl Strategy<Value = Task> {
    let actions = prop::collection::vec(action(), 2..6);
    let agents = prop::collection::vec(prop::option::weighted(0.9, 0..3_usize), 6);
    let pairs = || prop::collection::vec((0..6_usize, 0..6_usize), 0..3);
    let needs = prop::collection::vec((0..6_usize, prop::collection::vec(0..6_usize, 0..3)), 0..3);
    (task(), actions, agents, needs, pairs(), formula(FACTS), any::<bool>()).prop_map(
        |(task, actions, agents, needs, excludes, always, is_free)| {
            let count = actions.len();
            let other = |(one, other)| (one % count, other % count);
            let need = |(one, others): (usize, Vec<usize>)| {
                (one % count, others.iter().map(|other| other % count).collect())
            };
            let concurrent = Concurrent {
                agents: agents[..count].to_vec(),
                needs: needs.into_iter().map(need).collect(),
                excludes: excludes.into_iter().map(other).collect(),
                always: if is_free { Formula::TRUE } else { always },
            };
            Task { actions, concurrent: Some(concurrent), ..task }
        },
    )
}

/// The state after the actions of a step, if they are one.
fn after_step(task: &Task, step: &[usize], state: &State) -> Option<State> {
    let concurrent = task.concurrent.as_ref()?;
    let pairs = || step.iter().flat_map(|&one| step.iter().map(move |&other| (one, other)));
    let fits = !step.is_empty()
        && step.iter().all(|&action| holds(&task.actions[action].condition, state))
        && pairs().filter(|(one, other)| one < other).all(|(one, other)| {
            let (of_one, of_other) = (concurrent.agents[one], concurrent.agents[other]);
            of_one.is_some() && of_other.is_some() && of_one != of_other
        })
        && (concurrent.needs.iter().filter(|(action, _)| step.contains(action)))
            .all(|(_, others)| others.iter().any(|other| step.contains(other)))
        && pairs()
            .filter(|(one, other)| one != other)
            .all(|pair| !concurrent.excludes.contains(&pair));
    let changes = |value: bool, action: usize| -> BTreeSet<usize> {
        let effects = task.actions[action].effects.iter();
        let effects = effects.filter(|effect| holds(&effect.condition, state));
        effects.filter(|effect| effect.value == value).map(|effect| effect.fact).collect()
    };
    let contradict = pairs()
        .filter(|(one, other)| one != other)
        .any(|(one, other)| !changes(true, one).is_disjoint(&changes(false, other)));
    if !fits || contradict {
        return None;
    }
    let mut next = state.clone();
    for &action in step {
        next.retain(|fact| !changes(false, action).contains(fact));
    }
    for &action in step {
        next.extend(changes(true, action));
    }
    let next = derive(task, next);
    holds(&concurrent.always, &next).then_some(next)
}

/// The least steps of a plan of several agents, and the least actions of those plans.
fn least_steps(task: &Task) -> Option<(usize, usize)> {
    let count = task.actions.len();
    let steps: Vec<Vec<usize>> = (1..1_usize << count)
        .map(|bits| (0..count).filter(|action| bits >> action & 1 == 1).collect())
        .collect();
    let mut states = BTreeMap::from([(derive(task, task.initial.iter().copied().collect()), 0)]);
    let mut seen = states.clone();
    for length in 0.. {
        let goals = states.iter().filter(|(state, _)| holds(&task.goal, state));
        if let Some(actions) = goals.map(|(_, &actions)| actions).min() {
            return Some((length, actions));
        }
        let mut next: BTreeMap<State, usize> = BTreeMap::new();
        for (state, actions) in &states {
            for step in &steps {
                let Some(after) = after_step(task, step, state) else { continue };
                let actions = actions + step.len();
                let known = next.entry(after).or_insert(actions);
                *known = actions.min(*known);
            }
        }
        next.retain(|state, _| !seen.contains_key(state));
        if next.is_empty() {
            break;
        }
        seen.extend(next.clone());
        states = next;
    }
    None
}

/// The steps and the actions of a plan, if it is one.
fn steps_of(task: &Task, plan: &[Vec<usize>]) -> Option<(usize, usize)> {
    let mut state = derive(task, task.initial.iter().copied().collect());
    for step in plan {
        state = after_step(task, step, &state)?;
    }
    holds(&task.goal, &state).then(|| (plan.len(), plan.iter().map(Vec::len).sum()))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn several_agents_get_a_plan_with_the_fewest_steps_and_actions(task in several_agents()) {
        match solve(&task, true) {
            Progress::Steps(plan) => {
                prop_assert!(steps_of(&task, &plan).is_some(), "{plan:?}");
                prop_assert_eq!(steps_of(&task, &plan), least_steps(&task));
            }
            progress => {
                prop_assert_eq!(progress, Progress::NoPlan);
                prop_assert_eq!(least_steps(&task), None);
            }
        }
    }

    #[test]
    fn any_plan_of_several_agents_is_one_and_no_plan_is_true(task in several_agents()) {
        match solve(&task, false) {
            Progress::Steps(plan) => prop_assert!(steps_of(&task, &plan).is_some(), "{plan:?}"),
            progress => {
                prop_assert_eq!(progress, Progress::NoPlan);
                prop_assert_eq!(least_steps(&task), None);
            }
        }
    }

    #[test]
    fn any_plan_is_one_and_no_plan_is_true(task in task()) {
        match solve(&task, false) {
            Progress::Plan(plan) => prop_assert!(cost(&task, &plan).is_some(), "{plan:?}"),
            progress => {
                prop_assert_eq!(progress, Progress::NoPlan);
                prop_assert_eq!(least_cost(&task), None);
            }
        }
    }

    #[test]
    fn the_cheapest_plan_costs_least(task in task()) {
        let found = match solve(&task, true) {
            Progress::Plan(plan) => {
                prop_assert!(cost(&task, &plan).is_some(), "{plan:?}");
                cost(&task, &plan)
            }
            progress => {
                prop_assert_eq!(progress, Progress::NoPlan);
                None
            }
        };
        prop_assert_eq!(found, least_cost(&task));
    }

    #[test]
    fn the_same_task_gets_the_same_plan_in_pieces_of_any_size(task in task()) {
        for cheapest in [false, true] {
            let mut planner = Planner::new(&task, &Limits { cheapest, ..Limits::default() }).unwrap();
            prop_assert_eq!(planner.work(u64::MAX / 2), solve(&task, cheapest));
        }
    }
}

fn lamp(facts: usize, rules: Vec<Rule>) -> Task {
    let effects = vec![Effect { condition: Formula::TRUE, fact: 0, value: true }];
    let action = Action { condition: Formula::TRUE, effects, cost: 1 };
    Task {
        facts,
        initial: vec![],
        actions: vec![action],
        rules,
        goal: Formula::Fact(0),
        concurrent: None,
    }
}

#[test]
fn too_many_agents_end_the_search() {
    let task = Task { facts: 2, goal: Formula::Fact(1), ..lamp(2, vec![]) };
    let mut action = task.actions[0].clone();
    action.effects[0].value = false;
    let agents: Vec<_> = (0..90).map(|at| Some(at / 10)).collect();
    let concurrent = Concurrent { agents, always: Formula::TRUE, ..Concurrent::default() };
    let mut actions = vec![action; 90];
    // The goal is in reach, so that the search begins.
    actions[0].effects[0] = Effect { condition: Formula::Fact(0), fact: 1, value: true };
    actions[1].effects[0].value = true;
    let task = Task { actions, concurrent: Some(concurrent), ..task };
    assert_eq!(solve(&task, true), Progress::OutOfMemory);
}

#[test]
fn a_task_that_contradicts_itself_is_refused() {
    let fault = |task: &Task| Planner::new(task, &Limits::default()).err();
    assert_eq!(fault(&lamp(1, vec![])), None);
    assert_eq!(fault(&lamp(0, vec![])), Some(Fault::NoSuchFact(0)));
    let rule = |fact, condition| Rule { fact, condition };
    assert_eq!(fault(&lamp(1, vec![rule(0, Formula::TRUE)])), Some(Fault::DerivedEffect(0)));
    let not = |fact| Formula::Not(Box::new(Formula::Fact(fact)));
    assert_eq!(
        fault(&lamp(3, vec![rule(1, not(2)), rule(2, Formula::Fact(1))])),
        Some(Fault::NotStratified(1))
    );
    assert_eq!(fault(&lamp(3, vec![rule(1, not(2)), rule(2, Formula::Fact(0))])), None);
    let together = |needs, excludes| {
        let agents = vec![Some(0)];
        let concurrent = Concurrent { agents, needs, excludes, always: Formula::TRUE };
        fault(&Task { concurrent: Some(concurrent), ..lamp(1, vec![]) })
    };
    assert_eq!(together(vec![], vec![]), None);
    assert_eq!(together(vec![(0, vec![2])], vec![]), Some(Fault::NoSuchAction(2)));
    assert_eq!(together(vec![], vec![(1, 0)]), Some(Fault::NoSuchAction(1)));
}
