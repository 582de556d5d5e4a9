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
    /// A plan of several agents: the actions of each step.
    Steps(Vec<Vec<usize>>),
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
    found: Option<Found>,
    bytes: usize,
}

/// A plan of which each step is left out to see whether it is needed.
#[derive(Debug)]
struct Found {
    plan: Vec<u32>,
    /// All before it are needed.
    at: usize,
    work: u64,
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
        let mut problem = Problem::new(task)?;
        let search = if limits.cheapest {
            Search::Cheapest(Box::new(Shortest::new(&problem)))
        } else {
            let novelty = Novelty::new(&problem, limits.bytes / 4);
            Search::Any(Box::new(Greedy::new(&mut problem)), Some(Box::new(novelty)))
        };
        Ok(Planner { problem, search, found: None, bytes: limits.bytes })
    }

    /// Goes on for about this number of steps of computation. A computer does some hundred million
    /// in a second.
    pub fn work(&mut self, steps: u64) -> Progress {
        if self.problem.task.goal.is_none() {
            return Progress::NoPlan;
        }
        if self.problem.task.reaches_goal(&self.problem.task.initial) {
            return self.progress(&[]);
        }
        let end = self.worked() + steps;
        while self.worked() < end {
            match self.step() {
                Step::Plan(plan) if self.found.is_none() && !self.is_cheapest() => {
                    self.found = Some(Found { plan, at: 0, work: 0 });
                }
                Step::Plan(plan) => return self.progress(&plan),
                Step::Exhausted => return Progress::NoPlan,
                Step::Open => (),
            }
        }
        if self.within_memory() { Progress::Working } else { Progress::OutOfMemory }
    }

    fn progress(&self, plan: &[u32]) -> Progress {
        let problem = &self.problem;
        let actions = plan.iter().map(|step| {
            let operators = problem.operators(step).iter();
            operators.map(|&operator| problem.task.operators[operator as usize].action)
        });
        if problem.is_concurrent() {
            Progress::Steps(actions.map(Iterator::collect).collect())
        } else {
            Progress::Plan(actions.flatten().collect())
        }
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

    fn is_cheapest(&self) -> bool {
        matches!(self.search, Search::Cheapest(_))
    }

    fn step(&mut self) -> Step {
        if let Some(found) = &mut self.found {
            return found.step(&mut self.problem);
        }
        match &mut self.search {
            Search::Any(greedy, Some(novelty)) if novelty.work() < greedy.work() => {
                novelty.step(&mut self.problem)
            }
            Search::Any(greedy, _) => greedy.step(&mut self.problem),
            Search::Cheapest(shortest) => shortest.step(&mut self.problem),
        }
    }

    fn worked(&self) -> u64 {
        let search = match &self.search {
            Search::Any(greedy, novelty) => {
                greedy.work() + novelty.as_ref().map_or(0, |novelty| novelty.work())
            }
            Search::Cheapest(shortest) => shortest.work(),
        };
        search + self.found.as_ref().map_or(0, |found| found.work)
    }

    fn within_memory(&mut self) -> bool {
        match &mut self.search {
            Search::Any(greedy, novelty) => {
                let rest = self.bytes.saturating_sub(greedy.bytes() + self.problem.bytes());
                novelty.take_if(|novelty| novelty.bytes() > rest);
                rest > 0
            }
            Search::Cheapest(shortest) => shortest.bytes() + self.problem.bytes() < self.bytes,
        }
    }
}

impl Found {
    /// Leaves out the next step and those that are not possible then, if the plan still reaches
    /// the goal.
    fn step(&mut self, problem: &mut Problem) -> Step {
        if self.at == self.plan.len() {
            return Step::Plan(std::mem::take(&mut self.plan));
        }
        let mut state = problem.task.initial.clone();
        let mut next = state.clone();
        let mut rest = Vec::new();
        for (index, &step) in self.plan.iter().enumerate() {
            if index != self.at && problem.is_possible(step, &state) {
                problem.apply(step, &state, &mut next);
                std::mem::swap(&mut state, &mut next);
                rest.push(step);
            }
        }
        self.work += (self.plan.len() * (state.len() + 8)) as u64;
        if problem.task.reaches_goal(&state) {
            self.plan = rest;
        } else {
            self.at += 1;
        }
        Step::Open
    }
}
