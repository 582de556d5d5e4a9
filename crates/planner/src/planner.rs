//! The searches together.
use crate::greedy::Greedy;
use crate::novelty::Novelty;
use crate::problem::Problem;
use crate::shortest::Shortest;
use crate::states::Step;
use crate::task::{Fault, Task};

/// What a planner may use, and what it is to find.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// The plan of the least cost, not just any plan.
    pub cheapest: bool,
    /// About the bytes of memory that it may take.
    pub bytes: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Limits { cheapest: false, bytes: 512 << 20 }
    }
}

/// How far a planner has come.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Progress {
    /// A plan, as indices of actions.
    Plan(Vec<usize>),
    /// It is proven that there is no plan.
    NoPlan,
    /// It has not ended yet.
    Working,
    /// It cannot go on with the memory that it may take.
    OutOfMemory,
}

/// The search for a plan of one task.
#[derive(Debug)]
pub struct Planner {
    problem: Problem,
    search: Search,
    bytes: usize,
}

#[derive(Debug)]
enum Search {
    /// It takes turns; the second search may be gone, as it needs the more memory.
    Any(Box<Greedy>, Option<Box<Novelty>>),
    Cheapest(Box<Shortest>),
}

impl Planner {
    /// A planner that has not begun yet.
    ///
    /// # Errors
    /// If the task contradicts itself.
    pub fn new(task: &Task, limits: &Limits) -> Result<Planner, Fault> {
        let problem = Problem::new(task)?;
        let search = if limits.cheapest {
            Search::Cheapest(Box::new(Shortest::new(&problem)))
        } else {
            let novelty = Novelty::new(&problem, limits.bytes / 4);
            Search::Any(Box::new(Greedy::new(&problem)), Some(Box::new(novelty)))
        };
        Ok(Planner { problem, search, bytes: limits.bytes })
    }

    /// Goes on for about this number of steps of computation. A computer does some hundred million
    /// in a second.
    pub fn work(&mut self, steps: u64) -> Progress {
        if self.problem.task.goal.is_none() {
            return Progress::NoPlan;
        }
        if self.problem.task.reaches_goal(&self.problem.task.initial) {
            return Progress::Plan(vec![]);
        }
        let end = self.worked() + steps;
        while self.worked() < end {
            match self.step() {
                Step::Plan(plan) => {
                    let plan = self.without_needless(plan);
                    let action =
                        |&operator: &u32| self.problem.task.operators[operator as usize].action;
                    return Progress::Plan(plan.iter().map(action).collect());
                }
                Step::Exhausted => return Progress::NoPlan,
                Step::Open => (),
            }
        }
        if self.within_memory() { Progress::Working } else { Progress::OutOfMemory }
    }

    /// How many states it has seen so far.
    pub fn states(&self) -> usize {
        match &self.search {
            Search::Any(greedy, novelty) => {
                let novelty = novelty.as_ref().map_or(0, |novelty| novelty.tree.before.len());
                greedy.tree.before.len() + novelty
            }
            Search::Cheapest(shortest) => shortest.tree.before.len(),
        }
    }

    fn step(&mut self) -> Step {
        match &mut self.search {
            Search::Any(greedy, Some(novelty)) if novelty.work() < greedy.work() => {
                novelty.step(&self.problem)
            }
            Search::Any(greedy, _) => greedy.step(&self.problem),
            Search::Cheapest(shortest) => shortest.step(&self.problem),
        }
    }

    fn worked(&self) -> u64 {
        match &self.search {
            Search::Any(greedy, novelty) => {
                greedy.work() + novelty.as_ref().map_or(0, |novelty| novelty.work())
            }
            Search::Cheapest(shortest) => shortest.work(),
        }
    }

    fn within_memory(&mut self) -> bool {
        match &mut self.search {
            Search::Any(greedy, novelty) => {
                let rest = self.bytes.saturating_sub(greedy.bytes());
                novelty.take_if(|novelty| novelty.bytes() > rest);
                rest > 0
            }
            Search::Cheapest(shortest) => shortest.bytes() < self.bytes,
        }
    }

    /// A plan of any kind without the actions that it does not need.
    fn without_needless(&self, mut plan: Vec<u32>) -> Vec<u32> {
        if matches!(self.search, Search::Cheapest(_)) {
            return plan;
        }
        let mut at = 0;
        while at < plan.len() {
            match self.without(&plan, at) {
                Some(shorter) => plan = shorter,
                None => at += 1,
            }
        }
        plan
    }

    /// A plan without the action at an index and those that are not possible then, if it still
    /// reaches the goal.
    fn without(&self, plan: &[u32], at: usize) -> Option<Vec<u32>> {
        let mut state = self.problem.task.initial.clone();
        let mut next = state.clone();
        let mut rest = Vec::new();
        for (index, &operator) in plan.iter().enumerate() {
            let possible = self.problem.task.operators[operator as usize].condition.holds(&state);
            if index != at && possible {
                self.problem.task.apply(operator as usize, &state, &mut next);
                std::mem::swap(&mut state, &mut next);
                rest.push(operator);
            }
        }
        self.problem.task.reaches_goal(&state).then_some(rest)
    }
}
