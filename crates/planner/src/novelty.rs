//! Search for what is new: best-first width search.
//!
//! States are compared with those that miss as many parts of the goal, and have reached as much of
//! a relaxed plan. Among these a state has novelty 1 if a fact is true for the first time, 2 if two
//! facts are true together for the first time, else 3. The search expands low novelty first.
//!
//! Source: Lipovetzky, Geffner: Best-First Width Search: Exploration and Exploitation in Classical
//! Planning (2017), BFWS(f5).
use crate::compiled::{Word, facts, has, index, set};
use crate::heuristic::{NONE, RelaxedPlan};
use crate::open_list::OpenList;
use crate::problem::Problem;
use crate::states::{Step, Tree};
use std::collections::BTreeMap;

/// What is known of a state.
#[derive(Clone, Copy, Debug)]
struct Known {
    /// The parts of the goal that do not hold.
    missing: u32,
    /// The relaxed plan that shows the way, and where its facts reached so far stand.
    way: u32,
    reached: u32,
    /// The states that it is compared with.
    group: u32,
}

/// What the states of a group have shown.
#[derive(Debug)]
struct Group {
    facts: Vec<Word>,
    /// Fact I and fact J before it: bit I (I-1) / 2 + J. Empty if memory is short.
    pairs: Vec<Word>,
}

#[derive(Debug)]
pub(crate) struct Novelty {
    pub(crate) tree: Tree,
    known: Vec<Known>,
    /// The facts that each relaxed plan makes true.
    ways: Vec<Vec<usize>>,
    reached: Vec<Word>,
    groups: Vec<Group>,
    group_of: BTreeMap<(u32, u32), u32>,
    /// The bytes that pairs may take.
    bytes_for_pairs: usize,
    plans: RelaxedPlan,
    facts_of: Vec<usize>,
    open: OpenList<(u8, u32), u32>,
    state: Vec<Word>,
    possible: Vec<u32>,
    /// The facts of a state, and those that are new in it.
    lists: [Vec<usize>; 2],
    work: u64,
}

impl Novelty {
    pub(crate) fn new(problem: &Problem, bytes_for_pairs: usize) -> Novelty {
        let mut facts_of = vec![usize::MAX; problem.relaxed.propositions_count()];
        for (proposition, fact) in problem.relaxed.true_facts() {
            facts_of[proposition as usize] = fact;
        }
        let mut novelty = Novelty {
            tree: Tree::new(&problem.task.initial),
            known: vec![],
            ways: vec![],
            reached: vec![],
            groups: vec![],
            group_of: BTreeMap::new(),
            bytes_for_pairs,
            plans: RelaxedPlan::new(&problem.task, &problem.relaxed),
            facts_of,
            open: OpenList::new(),
            state: problem.task.initial.clone(),
            possible: vec![],
            lists: [vec![], vec![]],
            work: 0,
        };
        novelty.add(problem, None);
        novelty
    }

    pub(crate) fn step(&mut self, problem: &mut Problem) -> Step {
        let Some(from) = self.open.pop() else { return Step::Exhausted };
        let mut possible = std::mem::take(&mut self.possible);
        self.work += problem.possible(self.tree.states.get(from), &mut possible);
        for &step in &possible {
            problem.apply(step, self.tree.states.get(from), &mut self.state);
            self.work += self.state.len() as u64 + 8;
            let Some(number) = self.tree.grow(&self.state, from, step) else { continue };
            if problem.task.reaches_goal(&self.state) {
                return Step::Plan(self.tree.plan(number));
            }
            self.add(problem, Some(from));
        }
        self.possible = possible;
        Step::Open
    }

    /// The state is the newest of the tree.
    fn add(&mut self, problem: &Problem, from: Option<u32>) {
        let number = index(self.known.len());
        let missing = problem.task.goal.as_ref().map_or(0, |goal| index(goal.missing(&self.state)));
        let parent = from.map(|from| self.known[from as usize]);
        let way = match parent {
            Some(parent) if parent.missing <= missing => Some((parent.way, parent.reached)),
            _ => self.new_way(problem),
        };
        let Some((way, before)) = way else {
            // The goal cannot be reached from here.
            self.known.push(Known { missing, way: 0, reached: 0, group: NONE });
            return;
        };
        let (reached, count) = self.reach(way, before);
        let group = self.group(problem, missing, count);
        self.known.push(Known { missing, way, reached, group });
        let seen = parent.filter(|parent| parent.group == group).and(from);
        let novelty = self.novelty(group as usize, seen);
        self.open.push((novelty, missing), number);
    }

    /// A relaxed plan from the state, of which nothing is reached yet.
    fn new_way(&mut self, problem: &Problem) -> Option<(u32, u32)> {
        self.plans.estimate(&problem.relaxed, &self.state)?;
        let facts = self.plans.propositions.iter().map(|&at| self.facts_of[at as usize]);
        let facts = facts.filter(|&fact| fact != usize::MAX && !has(&self.state, fact));
        let way: Vec<_> = facts.collect();
        let reached = index(self.reached.len());
        self.reached.resize(self.reached.len() + way.len().div_ceil(64), 0);
        self.ways.push(way);
        Some((index(self.ways.len() - 1), reached))
    }

    /// Where it stands what was reached before, and what the state reaches; and how much.
    fn reach(&mut self, way: u32, before: u32) -> (u32, u32) {
        let facts = &self.ways[way as usize];
        let words = facts.len().div_ceil(64);
        let (start, end) = (before as usize, self.reached.len());
        self.reached.extend_from_within(start..start + words);
        for (at, &fact) in facts.iter().enumerate() {
            if has(&self.state, fact) {
                set(&mut self.reached[end..], at, true);
            }
        }
        let count = self.reached[end..].iter().map(|word| word.count_ones()).sum();
        if self.reached[start..start + words] == self.reached[end..] {
            self.reached.truncate(end);
            return (before, count);
        }
        (index(end), count)
    }

    fn group(&mut self, problem: &Problem, missing: u32, count: u32) -> u32 {
        *self.group_of.entry((missing, count)).or_insert_with(|| {
            let words = (problem.task.facts * problem.task.facts / 2).div_ceil(64);
            let pairs = if 8 * words <= self.bytes_for_pairs {
                self.bytes_for_pairs -= 8 * words;
                vec![0; words]
            } else {
                vec![]
            };
            self.groups.push(Group { facts: vec![0; problem.task.words()], pairs });
            index(self.groups.len() - 1)
        })
    }

    /// The novelty of the state, which is in the group from now on. A state `seen` is the one
    /// before it, if that is in the group, too.
    fn novelty(&mut self, group: usize, seen: Option<u32>) -> u8 {
        let group = &mut self.groups[group];
        let [all, new] = &mut self.lists;
        all.clear();
        all.extend(facts(&self.state));
        new.clear();
        new.extend(
            all.iter()
                .copied()
                .filter(|&fact| seen.is_none_or(|seen| !has(self.tree.states.get(seen), fact))),
        );
        let mut novelty = 3;
        for &fact in &*new {
            if !has(&group.facts, fact) {
                set(&mut group.facts, fact, true);
                novelty = 1;
            }
        }
        if !group.pairs.is_empty() {
            self.work += (all.len() * new.len()) as u64 / 4;
            for &one in &*new {
                for &other in &*all {
                    if one == other {
                        continue;
                    }
                    let (high, low) = (one.max(other), one.min(other));
                    let pair = high * (high - 1) / 2 + low;
                    if !has(&group.pairs, pair) {
                        set(&mut group.pairs, pair, true);
                        novelty = novelty.min(2);
                    }
                }
            }
        }
        novelty
    }

    pub(crate) fn work(&self) -> u64 {
        self.work + self.plans.work
    }

    pub(crate) fn bytes(&self) -> usize {
        let groups: usize =
            self.groups.iter().map(|group| 8 * (group.facts.len() + group.pairs.len())).sum();
        let known = self.known.capacity() * size_of::<Known>() + 8 * self.reached.capacity();
        self.tree.bytes() + self.open.bytes() + groups + known
    }
}
