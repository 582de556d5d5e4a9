//! The operators that are possible in a state, found by a decision tree over facts.
//!
//! Source: Helmert: The Fast Downward Planning System (2006), section 5.3.1. Here a node asks for
//! all facts that may come next, so the tree is as deep as the longest condition.
use crate::compiled::{Compiled, Literal, Word, has, index};

#[derive(Debug, Default)]
struct Node {
    /// The operators whose literals have all been asked for.
    operators: Vec<u32>,
    asks: Vec<Ask>,
}

/// What is below a fact that is true, and below one that is false.
#[derive(Debug)]
struct Ask {
    fact: usize,
    below: [Option<Box<Node>>; 2],
}

#[derive(Debug)]
pub(crate) struct Successors {
    root: Node,
}

impl Successors {
    pub(crate) fn new(task: &Compiled) -> Successors {
        let literals = task.operators.iter().map(|operator| &*operator.condition.literals);
        let mut all: Vec<_> =
            literals.zip(0..).map(|(literals, at)| (literals, index(at))).collect();
        all.sort_unstable();
        Successors { root: node(&all, 0) }
    }

    /// The possible operators, in their order.
    pub(crate) fn of(&self, task: &Compiled, state: &[Word], operators: &mut Vec<u32>) {
        operators.clear();
        gather(&self.root, state, operators);
        operators.retain(|&at| task.operators[at as usize].condition.rest_holds(state));
        operators.sort_unstable();
    }
}

/// The node of operators whose first literals have been asked for. They are sorted.
fn node(operators: &[(&[Literal], u32)], asked: usize) -> Node {
    let done = operators.partition_point(|(literals, _)| literals.len() == asked);
    let (done, rest) = operators.split_at(done);
    let mut asks = Vec::new();
    for group in rest.chunk_by(|one, other| one.0[asked].fact() == other.0[asked].fact()) {
        let yes = group.partition_point(|(literals, _)| literals[asked].value());
        let (yes, no) = group.split_at(yes);
        let below =
            [no, yes].map(|part| (!part.is_empty()).then(|| Box::new(node(part, asked + 1))));
        asks.push(Ask { fact: group[0].0[asked].fact(), below });
    }
    Node { operators: done.iter().map(|(_, operator)| *operator).collect(), asks }
}

fn gather(node: &Node, state: &[Word], operators: &mut Vec<u32>) {
    operators.extend_from_slice(&node.operators);
    for ask in &node.asks {
        if let Some(below) = &ask.below[usize::from(has(state, ask.fact))] {
            gather(below, state, operators);
        }
    }
}
