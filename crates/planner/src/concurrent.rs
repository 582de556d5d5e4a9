//! The steps of several agents that act at the same time.
//!
//! The operators that are possible in a state are those of single agents. Here they become steps:
//! for each agent one of its operators, or none.
//!
//! Source: Boutilier, Brafman: Partial-Order Planning with Concurrent Interacting Actions (2001),
//! for actions that need, or exclude, others in the same step.
use crate::compiled::{Compiled, Condition, Word, index};
use crate::task::{Fault, Task};
use std::collections::BTreeMap;

/// The work for one state, after which the steps are too many.
const MOST_WORK: u64 = 1 << 24;

#[derive(Debug)]
pub(crate) struct Concurrent {
    /// How many agents there are.
    agents_count: usize,
    /// The agent of an operator.
    agents: Vec<Option<usize>>,
    /// A step with an operator has one operator of each of these lists, which are sorted.
    needs: Vec<Vec<Vec<u32>>>,
    /// The operators that are in no step with it, sorted.
    excludes: Vec<Vec<u32>>,
    /// It holds after each step; `None` if it cannot hold.
    always: Option<Condition>,
    /// The steps that were possible in some state so far.
    steps: Vec<Box<[u32]>>,
    numbers: BTreeMap<Box<[u32]>, u32>,
    bytes: usize,
    /// A state had too many steps.
    is_too_much: bool,
    after: Vec<Word>,
}

/// The steps of one state, while they are enumerated.
struct Choice<'a> {
    task: &'a Compiled,
    state: &'a [Word],
    /// The possible operators of each agent.
    of_agents: Vec<Vec<u32>>,
    chosen: Vec<u32>,
    work: u64,
}

impl Concurrent {
    pub(crate) fn new(task: &Task, compiled: &Compiled) -> Result<Option<Concurrent>, Fault> {
        let Some(given) = &task.concurrent else { return Ok(None) };
        let actions = task.actions.len();
        let named = given.needs.iter().flat_map(|(action, others)| others.iter().chain([action]));
        let mut named = named.chain(given.excludes.iter().flat_map(|(one, other)| [one, other]));
        if let Some(&wrong) = named.find(|&&action| action >= actions) {
            return Err(Fault::NoSuchAction(wrong));
        }
        let mut operator_of = vec![None; actions];
        for (operator, at) in compiled.operators.iter().zip(0..) {
            operator_of[operator.action] = Some(index(at));
        }
        let count = compiled.operators.len();
        let agent = |action: usize| given.agents.get(action).copied().flatten();
        let mut needs = vec![vec![]; count];
        for (action, others) in &given.needs {
            let mut others: Vec<_> = others.iter().filter_map(|&at| operator_of[at]).collect();
            others.sort_unstable();
            if let Some(operator) = operator_of[*action] {
                needs[operator as usize].push(others);
            }
        }
        let mut excludes = vec![vec![]; count];
        for &(one, other) in &given.excludes {
            if let (Some(one), Some(other)) = (operator_of[one], operator_of[other]) {
                excludes[one as usize].push(other);
                excludes[other as usize].push(one);
            }
        }
        for list in &mut excludes {
            list.sort_unstable();
        }
        Ok(Some(Concurrent {
            agents_count: given.agents.iter().flatten().max().map_or(0, |most| most + 1),
            agents: compiled.operators.iter().map(|operator| agent(operator.action)).collect(),
            needs,
            excludes,
            always: Condition::new(&given.always, true),
            steps: vec![],
            numbers: BTreeMap::new(),
            bytes: 0,
            is_too_much: false,
            after: vec![0; compiled.words()],
        }))
    }

    /// The operators of a step.
    pub(crate) fn operators(&self, step: u32) -> &[u32] {
        &self.steps[step as usize]
    }

    /// Puts the possible steps in the place of the possible operators; answers the work.
    pub(crate) fn of(&mut self, task: &Compiled, state: &[Word], possible: &mut Vec<u32>) -> u64 {
        let mut of_agents = vec![vec![]; self.agents_count];
        let mut alone = Vec::new();
        for operator in possible.drain(..) {
            match self.agents[operator as usize] {
                Some(agent) => of_agents[agent].push(operator),
                None => alone.push(operator),
            }
        }
        let mut choice = Choice { task, state, of_agents, chosen: vec![], work: 0 };
        for operator in alone {
            choice.chosen.push(operator);
            self.complete(&mut choice, possible);
            choice.chosen.clear();
        }
        self.choose(0, &mut choice, possible);
        self.is_too_much |= choice.work > MOST_WORK;
        choice.work
    }

    fn choose(&mut self, agent: usize, choice: &mut Choice, possible: &mut Vec<u32>) {
        if agent == choice.of_agents.len() {
            if !choice.chosen.is_empty() {
                self.complete(choice, possible);
            }
            return;
        }
        for at in 0..choice.of_agents[agent].len() {
            if choice.work > MOST_WORK {
                return;
            }
            let operator = choice.of_agents[agent][at];
            choice.work += 8 * choice.chosen.len() as u64 + 1;
            if choice.chosen.iter().all(|&other| self.agree(choice, operator, other)) {
                choice.chosen.push(operator);
                self.choose(agent + 1, choice, possible);
                choice.chosen.pop();
            }
        }
        self.choose(agent + 1, choice, possible);
    }

    fn agree(&self, choice: &Choice, one: u32, other: u32) -> bool {
        self.excludes[one as usize].binary_search(&other).is_err()
            && agree(choice.task, choice.state, one, other)
    }

    fn complete(&mut self, choice: &mut Choice, possible: &mut Vec<u32>) {
        let needs = choice.chosen.iter().flat_map(|&operator| &self.needs[operator as usize]);
        let mut needs =
            needs.map(|any| choice.chosen.iter().any(|at| any.binary_search(at).is_ok()));
        if !needs.all(|is_met| is_met) {
            return;
        }
        choice.work += choice.state.len() as u64 + 8;
        if self.keeps_always(choice.task, &choice.chosen, choice.state) {
            possible.push(self.number(&choice.chosen));
        }
    }

    fn keeps_always(&mut self, task: &Compiled, operators: &[u32], state: &[Word]) -> bool {
        task.apply(operators, state, &mut self.after);
        self.always.as_ref().is_some_and(|always| always.holds(&self.after))
    }

    fn number(&mut self, operators: &[u32]) -> u32 {
        if let Some(&number) = self.numbers.get(operators) {
            return number;
        }
        let number = index(self.steps.len());
        self.steps.push(operators.into());
        self.numbers.insert(operators.into(), number);
        self.bytes += 2 * (4 * operators.len() + 24);
        number
    }

    /// True if a step that was possible once is possible in a state.
    pub(crate) fn is_possible(&mut self, task: &Compiled, step: u32, state: &[Word]) -> bool {
        let operators = self.steps[step as usize].clone();
        let condition = |operator: u32| &task.operators[operator as usize].condition;
        operators.iter().enumerate().all(|(at, &one)| {
            condition(one).holds(state)
                && operators[..at].iter().all(|&other| agree(task, state, one, other))
        }) && self.keeps_always(task, &operators, state)
    }

    /// The bytes that the steps take; more than there are if a state had too many.
    pub(crate) fn bytes(&self) -> usize {
        if self.is_too_much { usize::MAX / 2 } else { self.bytes }
    }
}

/// True if two operators do not change a fact in different ways.
fn agree(task: &Compiled, state: &[Word], one: u32, other: u32) -> bool {
    let contradict = |one, other| {
        task.changes(one, state).any(|change| {
            task.changes(other, state)
                .any(|against| change.adds.iter().any(|fact| against.deletes.contains(fact)))
        })
    };
    !contradict(one, other) && !contradict(other, one)
}
