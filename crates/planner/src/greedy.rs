//! Greedy search by the lengths of relaxed plans.
//!
//! A state is estimated when it is expanded; until then it stands in the open list with the
//! estimate of the state before it. A second list has only those that a relaxed plan begins with;
//! it gets more turns whenever the search comes nearer to the goal.
//!
//! Sources: Helmert: The Fast Downward Planning System (2006). Richter, Helmert: Preferred
//! Operators and Deferred Evaluation in Satisficing Planning (2009).
use crate::compiled::Word;
use crate::heuristic::RelaxedPlan;
use crate::open_list::OpenList;
use crate::problem::Problem;
use crate::states::{Step, Tree};

/// The turns that preferred operators get when the search comes nearer.
const BOOST: i64 = 1000;

#[derive(Debug)]
pub(crate) struct Greedy {
    pub(crate) tree: Tree,
    plans: RelaxedPlan,
    /// All, and those that are preferred: a state and the step from it.
    open: [OpenList<u32, (u32, u32)>; 2],
    /// The turns that each list has had.
    turns: [i64; 2],
    nearest: u32,
    state: Vec<Word>,
    possible: Vec<u32>,
    work: u64,
}

impl Greedy {
    pub(crate) fn new(problem: &mut Problem) -> Greedy {
        let mut greedy = Greedy {
            tree: Tree::new(&problem.task.initial),
            plans: RelaxedPlan::new(&problem.task, &problem.relaxed),
            open: [OpenList::new(), OpenList::new()],
            turns: [0, 0],
            nearest: u32::MAX,
            state: problem.task.initial.clone(),
            possible: vec![],
            work: 0,
        };
        greedy.expand(problem, 0);
        greedy
    }

    pub(crate) fn step(&mut self, problem: &mut Problem) -> Step {
        let preferred =
            self.open[0].is_empty() || !self.open[1].is_empty() && self.turns[1] <= self.turns[0];
        let list = usize::from(preferred);
        self.turns[list] += 1;
        let Some((from, step)) = self.open[list].pop() else { return Step::Exhausted };
        problem.apply(step, self.tree.states.get(from), &mut self.state);
        self.work += self.state.len() as u64 + 8;
        let Some(number) = self.tree.grow(&self.state, from, step) else { return Step::Open };
        if problem.task.reaches_goal(&self.state) {
            return Step::Plan(self.tree.plan(number));
        }
        self.expand(problem, number);
        Step::Open
    }

    fn expand(&mut self, problem: &mut Problem, number: u32) {
        let Some(estimate) = self.plans.estimate(&problem.relaxed, &self.state) else { return };
        if estimate < self.nearest {
            self.nearest = estimate;
            self.turns[1] -= BOOST;
        }
        self.work += problem.possible(&self.state, &mut self.possible);
        for step in &self.possible {
            self.open[0].push(estimate, (number, *step));
            if problem.operators(step).iter().all(|&operator| self.plans.helps(operator)) {
                self.open[1].push(estimate, (number, *step));
            }
        }
    }

    pub(crate) fn work(&self) -> u64 {
        self.work + self.plans.work
    }

    pub(crate) fn bytes(&self) -> usize {
        self.tree.bytes() + self.open[0].bytes() + self.open[1].bytes()
    }
}
