//! The states that a search has seen, each stored once.
use crate::compiled::{Word, index};
use hashbrown::HashTable;

#[derive(Debug)]
pub(crate) struct States {
    words: usize,
    bits: Vec<Word>,
    /// The hash and the number of each: so the table grows without a look at the states.
    table: HashTable<(u32, u32)>,
}

impl States {
    pub(crate) fn new(words: usize) -> States {
        States { words, bits: Vec::new(), table: HashTable::new() }
    }

    pub(crate) fn get(&self, state: u32) -> &[Word] {
        slice(&self.bits, self.words, state)
    }

    /// The number of a state, and whether it is new. Numbers count from 0.
    pub(crate) fn insert(&mut self, state: &[Word]) -> (u32, bool) {
        let (bits, words, hash) = (&self.bits, self.words, hash(state));
        let is_same =
            |&(other, known): &(u32, u32)| other == hash && slice(bits, words, known) == state;
        if let Some(&(_, known)) = self.table.find(spread(hash), is_same) {
            return (known, false);
        }
        let new = index(self.table.len());
        self.bits.extend_from_slice(state);
        self.table.insert_unique(spread(hash), (hash, new), |&(hash, _)| spread(hash));
        (new, true)
    }

    /// The bytes that they take.
    pub(crate) fn bytes(&self) -> usize {
        8 * self.bits.capacity() + 9 * self.table.capacity()
    }
}

fn slice(bits: &[Word], words: usize, state: u32) -> &[Word] {
    &bits[state as usize * words..][..words]
}

/// The hash of Firefox and rustc: fast, and the same everywhere.
fn hash(state: &[Word]) -> u32 {
    let hash = state.iter().fold(0_u64, |hash, &word| {
        (hash.rotate_left(5) ^ word).wrapping_mul(0x517c_c1b7_2722_0a95)
    });
    (hash >> 32) as u32
}

/// The table looks at the highest bits and at the lowest.
fn spread(hash: u32) -> u64 {
    u64::from(hash).wrapping_mul(0x9e37_79b9_7f4a_7c15)
}

/// The states that a search has seen, and how it has come to each.
#[derive(Debug)]
pub(crate) struct Tree {
    pub(crate) states: States,
    /// The state before, and the step from it.
    pub(crate) before: Vec<(u32, u32)>,
}

impl Tree {
    /// The tree of an initial state, whose number is 0.
    pub(crate) fn new(initial: &[Word]) -> Tree {
        let mut states = States::new(initial.len());
        states.insert(initial);
        Tree { states, before: vec![(0, 0)] }
    }

    /// The number of a state, if it is new.
    pub(crate) fn grow(&mut self, state: &[Word], from: u32, step: u32) -> Option<u32> {
        let (number, is_new) = self.states.insert(state);
        is_new.then(|| {
            self.before.push((from, step));
            number
        })
    }

    /// The steps that lead to a state.
    pub(crate) fn plan(&self, mut state: u32) -> Vec<u32> {
        let mut plan = Vec::new();
        while state != 0 {
            let (from, step) = self.before[state as usize];
            plan.push(step);
            state = from;
        }
        plan.reverse();
        plan
    }

    pub(crate) fn bytes(&self) -> usize {
        self.states.bytes() + 8 * self.before.capacity()
    }
}

/// The result of one step of a search.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// A plan, as steps.
    Plan(Vec<u32>),
    /// There is no state left that could lead to the goal.
    Exhausted,
    /// The search goes on.
    Open,
}
