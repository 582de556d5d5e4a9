//! Tasks, as their caller writes them down.

/// A task of planning. Facts are numbered from 0.
#[derive(Clone, Debug, Default)]
pub struct Task {
    /// How many facts there are, derived ones included.
    pub facts: usize,
    /// The facts that are true at the beginning. Derived ones do not count.
    pub initial: Vec<usize>,
    /// The actions. A plan is a list of their indices.
    pub actions: Vec<Action>,
    /// What makes derived facts true.
    pub rules: Vec<Rule>,
    /// The condition that is to hold in the end.
    pub goal: Formula,
    /// If several agents act at the same time: what they may do in one step.
    pub concurrent: Option<Concurrent>,
}

/// What several agents may do in one step. An agent does at most one action in it, and no two
/// actions of a step change a fact in different ways. Conditions are those before the step.
#[derive(Clone, Debug, Default)]
pub struct Concurrent {
    /// The agent of each action, numbered from 0. An action of no agent is a step by itself.
    pub agents: Vec<Option<usize>>,
    /// A step with the action has one of the others, too.
    pub needs: Vec<(usize, Vec<usize>)>,
    /// Two actions that are in no step together.
    pub excludes: Vec<(usize, usize)>,
    /// The condition that holds after each step.
    pub always: Formula,
}

/// An action.
#[derive(Clone, Debug, Default)]
pub struct Action {
    /// The condition in which it is possible.
    pub condition: Formula,
    /// What it changes. If it makes a fact true and false, the fact is true.
    pub effects: Vec<Effect>,
    /// Its cost, of which the cheapest plan has the least sum.
    pub cost: u32,
}

/// A change of a fact by an action.
#[derive(Clone, Debug)]
pub struct Effect {
    /// The condition before the action in which the effect takes place.
    pub condition: Formula,
    /// The fact that changes.
    pub fact: usize,
    /// Its value after the action.
    pub value: bool,
}

/// A rule: `fact` is true if `condition` holds. A fact that is the head of a rule is false unless
/// a rule makes it true.
#[derive(Clone, Debug)]
pub struct Rule {
    /// The derived fact.
    pub fact: usize,
    /// The condition, which may be about derived facts.
    pub condition: Formula,
}

/// A condition.
#[derive(Clone, Debug)]
pub enum Formula {
    /// The fact is true.
    Fact(usize),
    /// The formula does not hold.
    Not(Box<Formula>),
    /// All of them hold; an empty list is true.
    And(Vec<Formula>),
    /// One of them holds; an empty list is false.
    Or(Vec<Formula>),
}

impl Formula {
    /// It always holds.
    pub const TRUE: Formula = Formula::And(Vec::new());
    /// It never holds.
    pub const FALSE: Formula = Formula::Or(Vec::new());
}

impl Default for Formula {
    fn default() -> Self {
        Formula::TRUE
    }
}

/// Why a task cannot be solved as it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// A number that is no fact's.
    #[error("there is no fact {0}")]
    NoSuchFact(usize),
    /// An action has an effect on a derived fact.
    #[error("an action changes the derived fact {0}")]
    DerivedEffect(usize),
    /// A derived fact depends on its own absence.
    #[error("the derived fact {0} depends on its own absence")]
    NotStratified(usize),
    /// A number that is no action's.
    #[error("there is no action {0}")]
    NoSuchAction(usize),
}
