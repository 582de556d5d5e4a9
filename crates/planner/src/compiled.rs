//! A task in the form in which the searches read it.
use crate::task::{Fault, Formula, Task};
use std::collections::BTreeMap;

/// A state has one bit for each fact.
pub(crate) type Word = u64;

/// A fact, or its absence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Literal(u32);

impl Literal {
    pub(crate) fn new(fact: usize, value: bool) -> Literal {
        Literal(2 * index(fact) + u32::from(!value))
    }

    pub(crate) fn fact(self) -> usize {
        (self.0 / 2) as usize
    }

    pub(crate) fn value(self) -> bool {
        self.0 % 2 == 0
    }

    /// A number of its own, below twice the number of facts.
    pub(crate) fn number(self) -> usize {
        self.0 as usize
    }

    fn opposite(self) -> Literal {
        Literal(self.0 ^ 1)
    }

    pub(crate) fn holds(self, state: &[Word]) -> bool {
        has(state, self.fact()) == self.value()
    }
}

/// Numbers of facts, actions and states fit into 32 bits: memory ends earlier.
pub(crate) fn index(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

pub(crate) fn has(state: &[Word], fact: usize) -> bool {
    state[fact / 64] >> (fact % 64) & 1 == 1
}

pub(crate) fn set(state: &mut [Word], fact: usize, value: bool) {
    let bit = 1 << (fact % 64);
    if value {
        state[fact / 64] |= bit;
    } else {
        state[fact / 64] &= !bit;
    }
}

/// The facts that are true, in their order.
pub(crate) fn facts(state: &[Word]) -> impl Iterator<Item = usize> {
    state.iter().enumerate().flat_map(|(at, &word)| {
        std::iter::successors(Some(word), |left| Some(left & left.wrapping_sub(1)))
            .take_while(|&left| left != 0)
            .map(move |left| 64 * at + left.trailing_zeros() as usize)
    })
}

/// All literals hold, and of each list of alternatives one.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Condition {
    /// Sorted, none twice.
    pub(crate) literals: Vec<Literal>,
    pub(crate) alternatives: Vec<Vec<Condition>>,
}

impl Condition {
    /// The condition of a formula, or `None` if it cannot hold.
    pub(crate) fn new(formula: &Formula, value: bool) -> Option<Condition> {
        let mut all = Condition::default();
        match (formula, value) {
            (Formula::Fact(fact), _) => all.literals.push(Literal::new(*fact, value)),
            (Formula::Not(part), _) => return Condition::new(part, !value),
            (Formula::And(parts), true) | (Formula::Or(parts), false) => {
                for part in parts {
                    let part = Condition::new(part, value)?;
                    all.literals.extend(part.literals);
                    all.alternatives.extend(part.alternatives);
                }
                all.literals.sort_unstable();
                all.literals.dedup();
                if all.literals.windows(2).any(|two| two[0].opposite() == two[1]) {
                    return None;
                }
            }
            (Formula::Or(parts), true) | (Formula::And(parts), false) => {
                let mut any: Vec<_> =
                    parts.iter().filter_map(|part| Condition::new(part, value)).collect();
                if any.len() < 2 {
                    return any.pop();
                }
                if any.iter().any(Condition::is_true) {
                    return Some(all);
                }
                all.alternatives.push(any);
            }
        }
        Some(all)
    }

    /// One of the others holds, too.
    fn require_one(&mut self, mut others: Vec<Condition>) {
        if others.iter().any(Condition::is_true) {
            return;
        }
        match (others.pop(), others.is_empty()) {
            (Some(other), true) => {
                self.literals.extend(other.literals);
                self.literals.sort_unstable();
                self.literals.dedup();
                self.alternatives.extend(other.alternatives);
            }
            (last, _) => {
                others.extend(last);
                self.alternatives.push(others);
            }
        }
    }

    fn is_true(&self) -> bool {
        self.literals.is_empty() && self.alternatives.is_empty()
    }

    pub(crate) fn holds(&self, state: &[Word]) -> bool {
        self.literals.iter().all(|literal| literal.holds(state)) && self.rest_holds(state)
    }

    /// It holds, if its literals do.
    pub(crate) fn rest_holds(&self, state: &[Word]) -> bool {
        self.alternatives.iter().all(|any| any.iter().any(|one| one.holds(state)))
    }

    /// How many of its parts do not hold.
    pub(crate) fn missing(&self, state: &[Word]) -> usize {
        let literals = self.literals.iter().filter(|literal| !literal.holds(state)).count();
        let any_holds = |any: &&Vec<Condition>| !any.iter().any(|one| one.holds(state));
        literals + self.alternatives.iter().filter(any_holds).count()
    }

    fn walk(&self, visit: &mut impl FnMut(Literal)) {
        self.literals.iter().copied().for_each(&mut *visit);
        for one in self.alternatives.iter().flatten() {
            one.walk(visit);
        }
    }
}

/// The changes of an action under one condition.
#[derive(Clone, Debug)]
pub(crate) struct Change {
    pub(crate) condition: Condition,
    pub(crate) adds: Vec<usize>,
    pub(crate) deletes: Vec<usize>,
}

/// An action that can be possible.
#[derive(Clone, Debug)]
pub(crate) struct Operator {
    /// Its index in the task.
    pub(crate) action: usize,
    pub(crate) condition: Condition,
    pub(crate) changes: Vec<Change>,
    pub(crate) cost: u32,
}

/// A rule for a derived fact.
#[derive(Clone, Debug)]
pub(crate) struct Derivation {
    pub(crate) fact: usize,
    pub(crate) condition: Condition,
}

/// A task without what can never hold.
#[derive(Clone, Debug)]
pub(crate) struct Compiled {
    pub(crate) facts: usize,
    pub(crate) initial: Vec<Word>,
    pub(crate) operators: Vec<Operator>,
    /// The rules, in strata: a rule asks for the absence of earlier ones' facts only.
    pub(crate) strata: Vec<Vec<Derivation>>,
    derived: Vec<Word>,
    /// `None` if it cannot hold.
    pub(crate) goal: Option<Condition>,
}

impl Compiled {
    pub(crate) fn new(task: &Task) -> Result<Compiled, Fault> {
        let mut asked = asked(task)?;
        if task.concurrent.is_some() {
            // Two agents may contradict each other in any fact.
            asked.fill(Word::MAX);
        }
        let mut derived = vec![0; task.facts.div_ceil(64)];
        for rule in &task.rules {
            set(&mut derived, rule.fact, true);
        }
        let effects = task.actions.iter().flat_map(|action| &action.effects);
        if let Some(effect) = effects.into_iter().find(|effect| has(&derived, effect.fact)) {
            return Err(Fault::DerivedEffect(effect.fact));
        }
        let rules = task.rules.iter().filter_map(|rule| {
            let condition = Condition::new(&rule.condition, true)?;
            Some(Derivation { fact: rule.fact, condition })
        });
        let mut compiled = Compiled {
            facts: task.facts,
            initial: vec![0; task.facts.div_ceil(64)],
            operators: with_others(&operators(task, &asked), task),
            strata: strata(rules.collect(), &derived)?,
            derived,
            goal: Condition::new(&task.goal, true),
        };
        let mut initial = vec![0; compiled.words()];
        for &fact in &task.initial {
            set(&mut initial, fact, true);
        }
        compiled.derive(&mut initial);
        compiled.initial = initial;
        Ok(compiled)
    }

    pub(crate) fn words(&self) -> usize {
        self.facts.div_ceil(64)
    }

    pub(crate) fn is_derived(&self, fact: usize) -> bool {
        has(&self.derived, fact)
    }

    pub(crate) fn reaches_goal(&self, state: &[Word]) -> bool {
        self.goal.as_ref().is_some_and(|goal| goal.holds(state))
    }

    /// What an operator changes in a state.
    pub(crate) fn changes(&self, operator: u32, state: &[Word]) -> impl Iterator<Item = &Change> {
        let changes = self.operators[operator as usize].changes.iter();
        changes.filter(move |change| change.condition.holds(state))
    }

    /// `to` becomes the state after operators of one step.
    pub(crate) fn apply(&self, operators: &[u32], from: &[Word], to: &mut [Word]) {
        to.copy_from_slice(from);
        let changes = || operators.iter().flat_map(|&operator| self.changes(operator, from));
        for fact in changes().flat_map(|change| &change.deletes) {
            set(to, *fact, false);
        }
        for fact in changes().flat_map(|change| &change.adds) {
            set(to, *fact, true);
        }
        self.derive(to);
    }

    fn derive(&self, state: &mut [Word]) {
        if self.strata.is_empty() {
            return;
        }
        for (word, derived) in state.iter_mut().zip(&self.derived) {
            *word &= !derived;
        }
        for rules in &self.strata {
            let mut changed = true;
            while changed {
                changed = false;
                for rule in rules {
                    if !has(state, rule.fact) && rule.condition.holds(state) {
                        set(state, rule.fact, true);
                        changed = true;
                    }
                }
            }
        }
    }
}

/// The facts that some condition asks for.
fn asked(task: &Task) -> Result<Vec<Word>, Fault> {
    fn facts(formula: &Formula, visit: &mut impl FnMut(usize)) {
        match formula {
            Formula::Fact(fact) => visit(*fact),
            Formula::Not(part) => facts(part, visit),
            Formula::And(parts) | Formula::Or(parts) => {
                for part in parts {
                    facts(part, visit);
                }
            }
        }
    }
    let heads = task.rules.iter().map(|rule| rule.fact);
    let effects = || task.actions.iter().flat_map(|action| &action.effects);
    let changed = task.initial.iter().copied().chain(heads).chain(effects().map(|one| one.fact));
    let mut wrong = changed.into_iter().find(|&fact| fact >= task.facts);
    let mut asked = vec![0; task.facts.div_ceil(64)];
    let mut visit = |fact| {
        if fact < task.facts {
            set(&mut asked, fact, true);
        } else {
            wrong = Some(fact);
        }
    };
    let conditions = task.actions.iter().map(|action| &action.condition);
    let conditions = conditions.chain(effects().map(|effect| &effect.condition));
    for condition in conditions.chain(task.rules.iter().map(|rule| &rule.condition)) {
        facts(condition, &mut visit);
    }
    facts(&task.goal, &mut visit);
    if let Some(concurrent) = &task.concurrent {
        facts(&concurrent.always, &mut visit);
    }
    wrong.map_or(Ok(asked), |fact| Err(Fault::NoSuchFact(fact)))
}

fn operators(task: &Task, asked: &[Word]) -> Vec<Operator> {
    let operator = |(action, of): (usize, &crate::task::Action)| {
        let mut changes: BTreeMap<Condition, [Vec<usize>; 2]> = BTreeMap::new();
        for effect in of.effects.iter().filter(|effect| has(asked, effect.fact)) {
            let Some(condition) = Condition::new(&effect.condition, true) else { continue };
            changes.entry(condition).or_default()[usize::from(effect.value)].push(effect.fact);
        }
        let condition = Condition::new(&of.condition, true)?;
        let changes = changes.into_iter();
        let changes: Vec<_> = changes
            .map(|(condition, [deletes, adds])| Change { condition, adds, deletes })
            .collect();
        // Another agent's action may need it.
        let is_useful = !changes.is_empty() || task.concurrent.is_some();
        is_useful.then_some(Operator { action, condition, changes, cost: of.cost })
    };
    task.actions.iter().enumerate().filter_map(operator).collect()
}

/// The operators with the conditions of those that they need in the same step.
fn with_others(operators: &[Operator], task: &Task) -> Vec<Operator> {
    let needs = task.concurrent.iter().flat_map(|concurrent| &concurrent.needs);
    let mut with = operators.to_vec();
    for (action, others) in needs {
        let others = operators.iter().filter(|operator| others.contains(&operator.action));
        let mut others: Vec<_> = others.map(|operator| operator.condition.clone()).collect();
        others.sort_unstable();
        others.dedup();
        for operator in with.iter_mut().filter(|operator| operator.action == *action) {
            operator.condition.require_one(others.clone());
        }
    }
    with
}

fn strata(rules: Vec<Derivation>, derived: &[Word]) -> Result<Vec<Vec<Derivation>>, Fault> {
    let mut level = BTreeMap::new();
    let most = rules.len();
    let mut changed = true;
    while changed {
        changed = false;
        for rule in &rules {
            let mut least = 0;
            rule.condition.walk(&mut |literal| {
                if has(derived, literal.fact()) {
                    let of = level.get(&literal.fact()).copied().unwrap_or(0);
                    least = least.max(of + usize::from(!literal.value()));
                }
            });
            let now = level.entry(rule.fact).or_insert(0);
            if least > *now {
                if least > most {
                    return Err(Fault::NotStratified(rule.fact));
                }
                *now = least;
                changed = true;
            }
        }
    }
    let mut strata: BTreeMap<_, Vec<_>> = BTreeMap::new();
    for rule in rules {
        strata.entry(level[&rule.fact]).or_default().push(rule);
    }
    Ok(strata.into_values().collect())
}
