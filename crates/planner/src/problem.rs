//! A task with all that the searches read of it.
use crate::compiled::Compiled;
use crate::heuristic::{Relaxed, RelaxedPlan};
use crate::successors::Successors;
use crate::task::{Fault, Task};

#[derive(Debug)]
pub(crate) struct Problem {
    pub(crate) task: Compiled,
    pub(crate) relaxed: Relaxed,
    pub(crate) successors: Successors,
}

impl Problem {
    /// The problem of a task, without the operators that can never become possible.
    pub(crate) fn new(task: &Task) -> Result<Problem, Fault> {
        let mut task = Compiled::new(task)?;
        let relaxed = Relaxed::new(&task);
        let mut reachable =
            RelaxedPlan::new(&task, &relaxed).reachable(&relaxed, &task.initial).into_iter();
        task.operators.retain(|_| reachable.next() == Some(true));
        let (relaxed, successors) = (Relaxed::new(&task), Successors::new(&task));
        Ok(Problem { task, relaxed, successors })
    }
}
