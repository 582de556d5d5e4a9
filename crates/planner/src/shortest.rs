//! A\*: the plan whose actions cost least together.
use crate::compiled::Word;
use crate::heuristic::NEVER;
use crate::landmark_cut::LandmarkCut;
use crate::problem::Problem;
use crate::states::{Step, Tree};
use std::collections::BTreeMap;

#[derive(Debug)]
pub(crate) struct Shortest {
    pub(crate) tree: Tree,
    cut: LandmarkCut,
    /// The cost of the best way to a state so far, and the estimate of what is left.
    costs: Vec<(u32, u32)>,
    /// By the sum of both and the estimate: states, with the cost of their way.
    open: BTreeMap<(u32, u32), Vec<(u32, u32)>>,
    open_count: usize,
    state: Vec<Word>,
    possible: Vec<u32>,
    work: u64,
}

impl Shortest {
    pub(crate) fn new(problem: &Problem) -> Shortest {
        let mut shortest = Shortest {
            tree: Tree::new(&problem.task.initial),
            cut: LandmarkCut::new(&problem.task, &problem.relaxed),
            costs: vec![],
            open: BTreeMap::new(),
            open_count: 0,
            state: problem.task.initial.clone(),
            possible: vec![],
            work: 0,
        };
        let estimate = shortest.estimate(problem);
        shortest.costs.push((0, estimate));
        shortest.push(0);
        shortest
    }

    /// The least cost that is left from the state.
    fn estimate(&mut self, problem: &Problem) -> u32 {
        let estimate = if problem.is_concurrent() {
            self.cut.longest(&problem.relaxed, &self.state).map(Problem::cost_of_steps)
        } else {
            self.cut.estimate(&problem.relaxed, &self.state)
        };
        estimate.unwrap_or(NEVER)
    }

    fn push(&mut self, state: u32) {
        let (cost, estimate) = self.costs[state as usize];
        if estimate != NEVER {
            let key = (cost.saturating_add(estimate), estimate);
            self.open.entry(key).or_default().push((state, cost));
            self.open_count += 1;
        }
    }

    fn pop(&mut self) -> Option<(u32, u32)> {
        let mut first = self.open.first_entry()?;
        let entry = first.get_mut().pop();
        if first.get().is_empty() {
            first.remove();
        }
        self.open_count -= 1;
        entry
    }

    pub(crate) fn step(&mut self, problem: &mut Problem) -> Step {
        let Some((from, cost)) = self.pop() else { return Step::Exhausted };
        if cost > self.costs[from as usize].0 {
            return Step::Open;
        }
        if problem.task.reaches_goal(self.tree.states.get(from)) {
            return Step::Plan(self.tree.plan(from));
        }
        let mut possible = std::mem::take(&mut self.possible);
        self.work += problem.possible(self.tree.states.get(from), &mut possible);
        for &step in &possible {
            problem.apply(step, self.tree.states.get(from), &mut self.state);
            self.work += self.state.len() as u64 + 8;
            let cost = cost.saturating_add(problem.cost(step));
            let (number, is_new) = self.tree.states.insert(&self.state);
            if is_new {
                self.tree.before.push((from, step));
                let estimate = self.estimate(problem);
                self.costs.push((cost, estimate));
                self.push(number);
            } else if cost < self.costs[number as usize].0 {
                self.tree.before[number as usize] = (from, step);
                self.costs[number as usize].0 = cost;
                self.push(number);
            }
        }
        self.possible = possible;
        Step::Open
    }

    pub(crate) fn work(&self) -> u64 {
        self.work + self.cut.work
    }

    pub(crate) fn bytes(&self) -> usize {
        self.tree.bytes() + 8 * self.costs.capacity() + 16 * self.open_count
    }
}
