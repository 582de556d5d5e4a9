//! The landmark-cut heuristic: never more than the cost that is left.
//!
//! A cut is a set of operators of which each plan has one. Its least cost is counted, and taken
//! from the cost of each of them; then the next cut is looked for. An operator has one cost for all
//! of its conditional effects, so it is not counted twice.
//!
//! Source: Helmert, Domshlak: Landmarks, Critical Paths and Abstractions: What's the Difference
//! Anyway? (2009).
use crate::compiled::{Compiled, Word};
use crate::heuristic::{NEVER, NONE, Relaxed};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

#[derive(Debug)]
pub(crate) struct LandmarkCut {
    /// The implications that have a proposition as an effect.
    makers: Vec<Vec<u32>>,
    operator_costs: Vec<u32>,
    /// What is left of them.
    left: Vec<u32>,
    /// The cost of the most expensive condition.
    costs: Vec<u32>,
    /// The most expensive condition of an implication.
    dearest: Vec<u32>,
    missing: Vec<u32>,
    queue: BinaryHeap<Reverse<(u32, u32)>>,
    /// Whether the goal follows from a proposition at no cost.
    in_zone: Vec<bool>,
    seen: Vec<bool>,
    stack: Vec<u32>,
    cut: Vec<u32>,
    pub(crate) work: u64,
}

impl LandmarkCut {
    pub(crate) fn new(task: &Compiled, relaxed: &Relaxed) -> LandmarkCut {
        let propositions = relaxed.propositions_count();
        let mut makers = vec![vec![]; propositions];
        for (implied, at) in relaxed.implications.iter().zip(0..) {
            for &effect in &implied.effects {
                makers[effect as usize].push(at);
            }
        }
        LandmarkCut {
            makers,
            operator_costs: task.operators.iter().map(|operator| operator.cost).collect(),
            left: vec![],
            costs: vec![NEVER; propositions],
            dearest: vec![NONE; relaxed.implications.len()],
            missing: vec![],
            queue: BinaryHeap::new(),
            in_zone: vec![false; propositions],
            seen: vec![false; propositions],
            stack: vec![],
            cut: vec![],
            work: 0,
        }
    }

    /// A cost that operators which must come one after the other have at least, or `None` if there
    /// is no plan. Those that several agents do at the same time count once.
    ///
    /// Source: Haslum, Geffner: Admissible Heuristics for Optimal Planning (2000).
    pub(crate) fn longest(&mut self, relaxed: &Relaxed, state: &[Word]) -> Option<u32> {
        self.left.clone_from(&self.operator_costs);
        self.explore(relaxed, state);
        let longest = self.costs[relaxed.goal as usize];
        (longest != NEVER).then_some(longest)
    }

    /// A cost that each plan from a state has at least, or `None` if there is no plan.
    pub(crate) fn estimate(&mut self, relaxed: &Relaxed, state: &[Word]) -> Option<u32> {
        self.left.clone_from(&self.operator_costs);
        self.explore(relaxed, state);
        let goal = relaxed.goal as usize;
        let mut estimate = 0_u32;
        while self.costs[goal] != 0 {
            if self.costs[goal] == NEVER {
                return None;
            }
            self.find_cut(relaxed, state);
            let costs = self.cut.iter().map(|&operator| self.left[operator as usize]);
            let least = costs.min().unwrap_or(0);
            estimate = estimate.saturating_add(least);
            for &operator in &self.cut {
                self.left[operator as usize] -= least;
            }
            self.explore(relaxed, state);
        }
        Some(estimate)
    }

    fn cost_of(&self, operator: u32) -> u32 {
        if operator == NONE { 0 } else { self.left[operator as usize] }
    }

    /// Costs of propositions, each the cost of the dearest condition and of the operator.
    fn explore(&mut self, relaxed: &Relaxed, state: &[Word]) {
        self.costs.fill(NEVER);
        self.missing.clone_from(&relaxed.counts);
        self.work += (self.costs.len() + self.missing.len()) as u64 / 8;
        for proposition in relaxed.holding(state) {
            self.costs[proposition as usize] = 0;
            self.queue.push(Reverse((0, proposition)));
        }
        while let Some(Reverse((cost, proposition))) = self.queue.pop() {
            if cost > self.costs[proposition as usize] {
                continue;
            }
            self.work += relaxed.uses[proposition as usize].len() as u64 + 2;
            for &user in &relaxed.uses[proposition as usize] {
                let at = user as usize;
                self.missing[at] -= 1;
                if self.missing[at] > 0 {
                    continue;
                }
                // The last condition to come is the dearest.
                self.dearest[at] = proposition;
                let implied = &relaxed.implications[at];
                let cost = cost.saturating_add(self.cost_of(implied.operator)).min(NEVER - 1);
                for &effect in &implied.effects {
                    if cost < self.costs[effect as usize] {
                        self.costs[effect as usize] = cost;
                        self.queue.push(Reverse((cost, effect)));
                    }
                }
            }
        }
    }

    /// The operators that lead into the zone in which the goal costs nothing more.
    fn find_cut(&mut self, relaxed: &Relaxed, state: &[Word]) {
        self.in_zone.fill(false);
        self.in_zone[relaxed.goal as usize] = true;
        self.stack.push(relaxed.goal);
        while let Some(proposition) = self.stack.pop() {
            for &maker in &self.makers[proposition as usize] {
                let implied = &relaxed.implications[maker as usize];
                self.work += 1;
                if self.missing[maker as usize] == 0 && self.cost_of(implied.operator) == 0 {
                    let dearest = self.dearest[maker as usize];
                    if !std::mem::replace(&mut self.in_zone[dearest as usize], true) {
                        self.stack.push(dearest);
                    }
                }
            }
        }
        self.cut.clear();
        self.seen.fill(false);
        for proposition in relaxed.holding(state) {
            self.seen[proposition as usize] = true;
            self.stack.push(proposition);
        }
        while let Some(proposition) = self.stack.pop() {
            for &user in &relaxed.uses[proposition as usize] {
                let at = user as usize;
                self.work += 1;
                if self.missing[at] > 0 || self.dearest[at] != proposition {
                    continue;
                }
                let implied = &relaxed.implications[at];
                if implied.effects.iter().any(|&effect| self.in_zone[effect as usize]) {
                    self.cut.push(implied.operator);
                    continue;
                }
                for &effect in &implied.effects {
                    if !std::mem::replace(&mut self.seen[effect as usize], true) {
                        self.stack.push(effect);
                    }
                }
            }
        }
        self.cut.sort_unstable();
        self.cut.dedup();
    }
}
