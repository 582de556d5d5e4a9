//! Plans for tasks of classical planning: facts that are true or false, actions with conditions and
//! conditional effects, facts that rules derive, and a goal. Several agents may act at the same time.
//!
//! A [`Task`] has numbered facts and actions. A [`Planner`] looks for a plan, piece by piece, so
//! that its caller can do other things between two pieces, and can stop it:
//!
//! - **any plan**: two searches take turns, one guided by relaxed plans, the other by what is new
//!   in a state;
//! - **the cheapest plan**: A\* with the landmark-cut heuristic; of several agents the one with the
//!   fewest steps, and of these with the fewest actions.
//!
//! "No plan" is an answer only where the whole space has been searched. The same task gets the
//! same plan each time and on each machine, as no clock and no random number is used.
//!
//! ```
//! use ev3_planner::{Action, Effect, Formula, Limits, Planner, Progress, Task};
//!
//! // Fact 0: the lamp is on. Fact 1: it has power.
//! let action = |condition, fact| Action {
//!     condition,
//!     effects: vec![Effect { condition: Formula::TRUE, fact, value: true }],
//!     cost: 1,
//! };
//! let task = Task {
//!     facts: 2,
//!     initial: vec![],
//!     actions: vec![action(Formula::Fact(1), 0), action(Formula::TRUE, 1)],
//!     rules: vec![],
//!     goal: Formula::Fact(0),
//!     concurrent: None,
//! };
//! let mut planner = Planner::new(&task, &Limits::default())?;
//! assert_eq!(planner.work(1_000_000), Progress::Plan(vec![1, 0]));
//! # Ok::<(), ev3_planner::Fault>(())
//! ```
#![forbid(unsafe_code)]

mod compiled;
mod concurrent;
mod greedy;
mod heuristic;
mod landmark_cut;
mod novelty;
mod open_list;
mod planner;
mod problem;
mod shortest;
mod states;
mod successors;
mod task;

pub use planner::{Limits, Planner, Progress};
pub use task::{Action, Concurrent, Effect, Fault, Formula, Rule, Task};
