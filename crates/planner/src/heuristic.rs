//! How far it is to the goal if nothing that is true becomes false: relaxed plans.
//!
//! Sources: Hoffmann, Nebel: The FF Planning System (2001): relaxed plans and helpful actions.
//! Keyder, Geffner: Heuristics for Planning with Action Costs Revisited (2008): the reasons of a
//! relaxed plan by the sums of their costs.
use crate::compiled::{Compiled, Condition, Literal, Word, index};

/// A cost that is never reached.
pub(crate) const NEVER: u32 = u32::MAX;
/// Sums of costs end here: long chains double them at each link.
const MOST: u32 = 1 << 16;
/// No rule, no operator.
pub(crate) const NONE: u32 = u32::MAX;
/// A proposition that always holds.
const ALWAYS: u32 = 0;

/// From `conditions` follow `effects`, at the cost of the operator.
#[derive(Debug)]
pub(crate) struct Implication {
    pub(crate) conditions: Vec<u32>,
    pub(crate) effects: Vec<u32>,
    /// `NONE` if it costs nothing.
    pub(crate) operator: u32,
}

/// The relaxed task. A proposition is a literal that some condition asks for, or one of several
/// alternatives.
#[derive(Debug)]
pub(crate) struct Relaxed {
    pub(crate) implications: Vec<Implication>,
    /// How many conditions each implication has.
    pub(crate) counts: Vec<u32>,
    /// The implications that have a proposition among their conditions.
    pub(crate) uses: Vec<Vec<u32>>,
    /// The literals that are propositions, with their numbers.
    literals: Vec<(Literal, u32)>,
    proposition_of: Vec<u32>,
    pub(crate) goal: u32,
}

impl Relaxed {
    pub(crate) fn new(task: &Compiled) -> Relaxed {
        let mut relaxed = Relaxed {
            implications: vec![],
            counts: vec![],
            uses: vec![vec![]],
            literals: vec![],
            proposition_of: vec![NONE; 2 * task.facts],
            goal: ALWAYS,
        };
        let mut pending = Vec::new();
        for (at, operator) in task.operators.iter().enumerate() {
            let conditions = relaxed.propositions(&operator.condition);
            for change in &operator.changes {
                let mut all = relaxed.propositions(&change.condition);
                all.extend_from_slice(&conditions);
                let adds = change.adds.iter().map(|&fact| Literal::new(fact, true));
                let deletes = change.deletes.iter().map(|&fact| Literal::new(fact, false));
                pending.push((all, adds.chain(deletes).collect::<Vec<_>>(), index(at)));
            }
        }
        for rule in task.strata.iter().flatten() {
            let conditions = relaxed.propositions(&rule.condition);
            pending.push((conditions, vec![Literal::new(rule.fact, true)], NONE));
        }
        if let Some(goal) = &task.goal {
            let conditions = relaxed.propositions(goal);
            relaxed.goal = relaxed.proposition();
            relaxed.imply(conditions, vec![relaxed.goal], NONE);
        }
        // Now it is known which literals conditions ask for.
        for (conditions, effects, operator) in pending {
            let known = effects.iter().map(|effect| relaxed.proposition_of[effect.number()]);
            let effects: Vec<_> = known.filter(|&effect| effect != NONE).collect();
            // What makes a rule's condition false may help, too.
            if !effects.is_empty() || !task.strata.is_empty() {
                relaxed.imply(conditions, effects, operator);
            }
        }
        // A derived fact that is to be false may be so at once.
        let derived = |literal: Literal| task.is_derived(literal.fact()) && !literal.value();
        let free: Vec<_> =
            relaxed.literals.iter().filter(|known| derived(known.0)).map(|known| known.1).collect();
        if !free.is_empty() {
            relaxed.imply(vec![], free, NONE);
        }
        relaxed
    }

    pub(crate) fn propositions_count(&self) -> usize {
        self.uses.len()
    }

    fn proposition(&mut self) -> u32 {
        self.uses.push(vec![]);
        index(self.uses.len() - 1)
    }

    fn imply(&mut self, mut conditions: Vec<u32>, effects: Vec<u32>, operator: u32) {
        if conditions.is_empty() {
            conditions.push(ALWAYS);
        }
        conditions.sort_unstable();
        conditions.dedup();
        for &condition in &conditions {
            self.uses[condition as usize].push(index(self.implications.len()));
        }
        self.counts.push(index(conditions.len()));
        self.implications.push(Implication { conditions, effects, operator });
    }

    fn propositions(&mut self, condition: &Condition) -> Vec<u32> {
        let mut all = Vec::new();
        for &literal in &condition.literals {
            if self.proposition_of[literal.number()] == NONE {
                let new = self.proposition();
                self.proposition_of[literal.number()] = new;
                self.literals.push((literal, new));
            }
            all.push(self.proposition_of[literal.number()]);
        }
        for any in &condition.alternatives {
            let one_of_them = self.proposition();
            for one in any {
                let conditions = self.propositions(one);
                self.imply(conditions, vec![one_of_them], NONE);
            }
            all.push(one_of_them);
        }
        all
    }

    /// The propositions that hold in a state.
    pub(crate) fn holding(&self, state: &[Word]) -> impl Iterator<Item = u32> {
        let literals = self.literals.iter().filter(|(literal, _)| literal.holds(state));
        std::iter::once(ALWAYS).chain(literals.map(|&(_, proposition)| proposition))
    }

    /// The fact that a proposition says is true, if it is such a one.
    pub(crate) fn true_facts(&self) -> impl Iterator<Item = (u32, usize)> {
        let literals = self.literals.iter().filter(|(literal, _)| literal.value());
        literals.map(|&(literal, proposition)| (proposition, literal.fact()))
    }
}

/// Propositions in the order of their costs. A cost has a list of its own.
#[derive(Debug, Default)]
pub(crate) struct Queue {
    lists: Vec<Vec<u32>>,
    at: usize,
}

impl Queue {
    pub(crate) fn push(&mut self, cost: u32, proposition: u32) {
        let cost = cost as usize;
        if self.lists.len() <= cost {
            self.lists.resize_with(cost + 1, Vec::new);
        }
        self.at = self.at.min(cost);
        self.lists[cost].push(proposition);
    }

    pub(crate) fn pop(&mut self) -> Option<(u32, u32)> {
        while let Some(list) = self.lists.get_mut(self.at) {
            if let Some(proposition) = list.pop() {
                return Some((index(self.at), proposition));
            }
            self.at += 1;
        }
        self.at = 0;
        None
    }

    pub(crate) fn clear(&mut self) {
        self.lists.iter_mut().for_each(Vec::clear);
        self.at = 0;
    }
}

/// The estimate of a state by a relaxed plan. Each operator counts as one step, whatever it costs.
#[derive(Debug)]
pub(crate) struct RelaxedPlan {
    costs: Vec<u32>,
    reasons: Vec<u32>,
    sums: Vec<u32>,
    missing: Vec<u32>,
    queue: Queue,
    in_plan: Vec<bool>,
    /// The operators of the last relaxed plan.
    pub(crate) operators: Vec<u32>,
    /// The propositions of the last relaxed plan.
    pub(crate) propositions: Vec<u32>,
    seen: Vec<bool>,
    /// Steps of computation so far.
    pub(crate) work: u64,
}

impl RelaxedPlan {
    pub(crate) fn new(task: &Compiled, relaxed: &Relaxed) -> RelaxedPlan {
        let count = relaxed.propositions_count();
        RelaxedPlan {
            costs: vec![NEVER; count],
            reasons: vec![NONE; count],
            sums: vec![0; relaxed.implications.len()],
            missing: vec![],
            queue: Queue::default(),
            in_plan: vec![false; task.operators.len()],
            operators: vec![],
            propositions: vec![],
            seen: vec![false; count],
            work: 0,
        }
    }

    /// The steps of a relaxed plan from a state, or `None` if not even that reaches the goal.
    pub(crate) fn estimate(&mut self, relaxed: &Relaxed, state: &[Word]) -> Option<u32> {
        self.explore(relaxed, state, Some(relaxed.goal));
        (self.costs[relaxed.goal as usize] != NEVER).then(|| self.extract(relaxed))
    }

    /// The operators that can become possible, when nothing becomes false.
    pub(crate) fn reachable(&mut self, relaxed: &Relaxed, state: &[Word]) -> Vec<bool> {
        self.explore(relaxed, state, None);
        let mut reachable = vec![false; self.in_plan.len()];
        for (implied, &missing) in relaxed.implications.iter().zip(&self.missing) {
            if missing == 0 && implied.operator != NONE {
                reachable[implied.operator as usize] = true;
            }
        }
        reachable
    }

    fn explore(&mut self, relaxed: &Relaxed, state: &[Word], until: Option<u32>) {
        self.costs.fill(NEVER);
        self.sums.fill(0);
        self.missing.clone_from(&relaxed.counts);
        self.queue.clear();
        self.work += (self.costs.len() + self.sums.len()) as u64 / 16;
        for proposition in relaxed.holding(state) {
            self.costs[proposition as usize] = 0;
            self.reasons[proposition as usize] = NONE;
            self.queue.push(0, proposition);
        }
        while let Some((cost, proposition)) = self.queue.pop() {
            if cost > self.costs[proposition as usize] {
                continue;
            }
            if Some(proposition) == until {
                break;
            }
            self.work += relaxed.uses[proposition as usize].len() as u64;
            for &at in &relaxed.uses[proposition as usize] {
                let user = at as usize;
                self.missing[user] -= 1;
                self.sums[user] = (self.sums[user] + cost).min(MOST);
                if self.missing[user] == 0 {
                    self.follow(relaxed, at);
                }
            }
        }
    }

    fn follow(&mut self, relaxed: &Relaxed, implication: u32) {
        let implied = &relaxed.implications[implication as usize];
        let step = u32::from(implied.operator != NONE);
        let cost = (self.sums[implication as usize] + step).min(MOST);
        for &effect in &implied.effects {
            if cost < self.costs[effect as usize] {
                self.costs[effect as usize] = cost;
                self.reasons[effect as usize] = implication;
                self.queue.push(cost, effect);
            }
        }
    }

    fn extract(&mut self, relaxed: &Relaxed) -> u32 {
        for operator in self.operators.drain(..) {
            self.in_plan[operator as usize] = false;
        }
        for proposition in self.propositions.drain(..) {
            self.seen[proposition as usize] = false;
        }
        self.seen[relaxed.goal as usize] = true;
        self.propositions.push(relaxed.goal);
        let mut at = 0;
        while let Some(&proposition) = self.propositions.get(at) {
            at += 1;
            let reason = self.reasons[proposition as usize];
            let Some(implied) = relaxed.implications.get(reason as usize) else { continue };
            for &condition in &implied.conditions {
                if !std::mem::replace(&mut self.seen[condition as usize], true) {
                    self.propositions.push(condition);
                }
            }
            let operator = implied.operator;
            if operator != NONE && !std::mem::replace(&mut self.in_plan[operator as usize], true) {
                self.operators.push(operator);
            }
        }
        self.work += self.propositions.len() as u64;
        index(self.operators.len())
    }

    /// True if an operator is in the last relaxed plan.
    pub(crate) fn helps(&self, operator: u32) -> bool {
        self.in_plan[operator as usize]
    }
}
