//! A task with all that the searches read of it.
use crate::compiled::{Compiled, Word, index};
use crate::concurrent::Concurrent;
use crate::heuristic::{Relaxed, RelaxedPlan};
use crate::successors::Successors;
use crate::task::{Fault, Task};

/// What one step more costs, if agents act at the same time, and what one action more costs.
const STEP: u32 = 1 << 16;

#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) task: Compiled,
    pub(crate) relaxed: Relaxed,
    successors: Successors,
    concurrent: Option<Concurrent>,
}

/// A search goes by steps: an operator is one, unless several agents act at the same time.
impl Problem {
    /// The problem of a task, without the operators that can never become possible.
    pub(crate) fn new(task: &Task) -> Result<Problem, Fault> {
        let mut compiled = Compiled::new(task)?;
        if task.concurrent.is_none() {
            let relaxed = Relaxed::new(&compiled);
            let mut reachable = RelaxedPlan::new(&compiled, &relaxed)
                .reachable(&relaxed, &compiled.initial)
                .into_iter();
            compiled.operators.retain(|_| reachable.next() == Some(true));
        }
        let (relaxed, successors) = (Relaxed::new(&compiled), Successors::new(&compiled));
        let concurrent = Concurrent::new(task, &compiled)?;
        Ok(Problem { task: compiled, relaxed, successors, concurrent })
    }

    /// The possible steps, in their order; answers the work.
    pub(crate) fn possible(&mut self, state: &[Word], steps: &mut Vec<u32>) -> u64 {
        self.successors.of(&self.task, state, steps);
        let work = steps.len() as u64;
        match &mut self.concurrent {
            Some(concurrent) => work + concurrent.of(&self.task, state, steps),
            None => work,
        }
    }

    pub(crate) fn is_possible(&mut self, step: u32, state: &[Word]) -> bool {
        match &mut self.concurrent {
            Some(concurrent) => concurrent.is_possible(&self.task, step, state),
            None => self.task.operators[step as usize].condition.holds(state),
        }
    }

    /// The operators of a step.
    pub(crate) fn operators<'a>(&'a self, step: &'a u32) -> &'a [u32] {
        match &self.concurrent {
            Some(concurrent) => concurrent.operators(*step),
            None => std::slice::from_ref(step),
        }
    }

    /// `to` becomes the state after a step.
    pub(crate) fn apply(&self, step: u32, from: &[Word], to: &mut [Word]) {
        self.task.apply(self.operators(&step), from, to);
    }

    /// What a step costs.
    pub(crate) fn cost(&self, step: u32) -> u32 {
        match &self.concurrent {
            Some(concurrent) => STEP + index(concurrent.operators(step).len()),
            None => self.task.operators[step as usize].cost,
        }
    }

    /// The least cost of steps of several agents.
    pub(crate) fn cost_of_steps(steps: u32) -> u32 {
        (STEP + 1).saturating_mul(steps)
    }

    pub(crate) fn is_concurrent(&self) -> bool {
        self.concurrent.is_some()
    }

    /// The bytes that its steps take.
    pub(crate) fn bytes(&self) -> usize {
        self.concurrent.as_ref().map_or(0, Concurrent::bytes)
    }
}
