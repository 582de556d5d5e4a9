//! Rapidly exploring random trees: a tree that grows from the start toward points drawn at random,
//! until it is at the goal; two of them, from the start and from the goal, which meet; and RRT*,
//! which is rewired where that shortens a way, and goes on as long as it may.
use crate::geometry::{Point, distance, point, vec2};
use crate::map::Map;
use crate::problem::{SLACK, Sought};
use crate::search::Searched;

/// One in this many draws is the goal itself.
const GOAL_EVERY: u32 = 16;

struct Tree<'a> {
    map: &'a Map,
    sought: &'a Sought,
    /// The longest line
    step: f64,
    points: Vec<Point>,
    parent: Vec<usize>,
}

/// One tree, which ends at the goal.
pub(crate) fn search(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let mut draws = sought.draws(map);
    let mut tree = Tree::new(map, sought, sought.start, draws.diagonal());
    let mut arrived = None;
    for draw in 0..sought.samples {
        let towards = if draw % GOAL_EVERY == 0 { sought.goal } else { draws.point() };
        let Some((at, nearest)) = tree.reach(towards) else { continue };
        let added = tree.push(at, nearest);
        if tree.is_goal(added) {
            arrived = Some(added);
        } else if tree.sees_goal(added) {
            arrived = Some(tree.push(sought.goal, added));
        }
        if arrived.is_some() {
            break;
        }
    }
    tree.finish(arrived, sought.goal)
}

/// Two trees in turn: what one has grown by, the other one grows to as far as it can.
pub(crate) fn search_from_both(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let mut draws = sought.draws(map);
    let tree = |root| Tree::new(map, sought, root, draws.diagonal());
    let mut trees = [tree(sought.start), tree(sought.goal)];
    let mut met = None;
    for draw in 0..sought.samples {
        let (first, second) = trees.split_at_mut(1);
        let (one, other) = match draw % 2 {
            0 => (&mut first[0], &mut second[0]),
            _ => (&mut second[0], &mut first[0]),
        };
        let Some((at, nearest)) = one.reach(draws.point()) else { continue };
        let grown = one.push(at, nearest);
        if let Some(there) = other.connect(at) {
            met = Some(if draw % 2 == 0 { [grown, there] } else { [there, grown] });
            break;
        }
    }
    let [from_start, from_goal] = trees;
    from_start.joined_with(&from_goal, met)
}

/// RRT*
pub(crate) fn search_star(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let mut draws = sought.draws(map);
    let mut star =
        Star { tree: Tree::new(map, sought, sought.start, draws.diagonal()), cost: vec![0.0] };
    // The index of the goal in the tree
    let mut arrived: Option<usize> = None;
    for draw in 0..sought.samples {
        let to_goal = arrived.is_none() && draw % GOAL_EVERY == 0;
        let towards = if to_goal { sought.goal } else { draws.point() };
        let Some((at, nearest)) = star.tree.reach(towards) else { continue };
        let added = star.add(at, nearest);
        if arrived.is_none() && star.tree.is_goal(added) {
            arrived = Some(added);
        } else if arrived.is_none() && star.tree.sees_goal(added) {
            arrived = Some(star.add(sought.goal, added));
        }
    }
    star.tree.finish(arrived, sought.goal)
}

impl<'a> Tree<'a> {
    fn new(map: &'a Map, sought: &'a Sought, root: Point, diagonal: f64) -> Self {
        Tree { map, sought, step: diagonal / 10.0, points: vec![root], parent: vec![0] }
    }

    fn joined(&self, from: Point, to: Point) -> bool {
        self.map.line_clear(from, to, self.sought.keep + SLACK / 2.0)
    }

    fn nearest(&self, to: Point) -> usize {
        let nodes = self.points.iter().enumerate();
        let nearer = |a: &(usize, &Point), b: &(usize, &Point)| {
            distance(*a.1, to).total_cmp(&distance(*b.1, to))
        };
        nodes.min_by(nearer).map_or(0, |(node, _)| node)
    }

    /// A new point one step towards another one, and the node from which it is reached.
    fn reach(&self, towards: Point) -> Option<(Point, usize)> {
        let nearest = self.nearest(towards);
        let from = self.points[nearest];
        let at = stepped(from, towards, self.step);
        let clear = distance(at, from) > 1e-9
            && self.map.point_clear(at, self.sought.keep)
            && self.joined(from, at);
        clear.then_some((at, nearest))
    }

    fn push(&mut self, at: Point, parent: usize) -> usize {
        self.points.push(at);
        self.parent.push(parent);
        self.points.len() - 1
    }

    fn is_goal(&self, node: usize) -> bool {
        distance(self.points[node], self.sought.goal) < 1e-9
    }

    /// From there it is one step to the goal.
    fn sees_goal(&self, node: usize) -> bool {
        let (at, goal) = (self.points[node], self.sought.goal);
        distance(at, goal) <= self.step && self.joined(at, goal)
    }

    /// Grows straight to a point, step by step, until something is in the way: the node there.
    fn connect(&mut self, to: Point) -> Option<usize> {
        while let Some((at, nearest)) = self.reach(to) {
            let added = self.push(at, nearest);
            if distance(at, to) < 1e-9 {
                return Some(added);
            }
        }
        None
    }

    /// From a node to the root.
    fn way_back(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        std::iter::successors(Some(node), |at| (*at != 0).then(|| self.parent[*at]))
    }

    /// The tree with the goal as node 1, as a search answers it.
    fn finish(self, arrived: Option<usize>, goal: Point) -> (Vec<Point>, Searched) {
        let node = |index: usize| match index {
            0 => 0,
            index if Some(index) == arrived => 1,
            index => index + 1,
        };
        let edges =
            (1..self.parent.len()).map(|child| [node(self.parent[child]), node(child)]).collect();
        let way = arrived.map(|last| {
            let mut way: Vec<usize> = self.way_back(last).map(node).collect();
            way.reverse();
            way
        });
        let mut points = self.points;
        points.insert(1, goal);
        (points, Searched { way, edges })
    }

    /// Both trees as one, with the goal as node 1: the roots are the start and the goal, and `met`
    /// are the nodes at the place where they meet.
    fn joined_with(self, other: &Tree, met: Option<[usize; 2]>) -> (Vec<Point>, Searched) {
        let behind = self.points.len();
        let node = |index: usize| if index == 0 { 0 } else { index + 1 };
        let node_of_other = |index: usize| if index == 0 { 1 } else { behind + index };
        let way = met.map(|[here, there]| {
            let mut way: Vec<usize> = self.way_back(here).map(node).collect();
            way.reverse();
            // They meet in one place, which has a node in each.
            way.extend(other.way_back(there).skip(1).map(node_of_other));
            way
        });
        let edges_of = |tree: &Tree| (1..tree.parent.len()).map(|i| [tree.parent[i], i]).collect();
        let (ours, theirs): (Vec<_>, Vec<_>) = (edges_of(&self), edges_of(other));
        let edges = ours.into_iter().map(|edge| edge.map(node));
        let edges = edges.chain(theirs.into_iter().map(|edge| edge.map(node_of_other))).collect();
        let mut points = self.points;
        points.insert(1, other.points[0]);
        points.extend(&other.points[1..]);
        (points, Searched { way, edges })
    }
}

/// A tree with the length of the way to each node.
struct Star<'a> {
    tree: Tree<'a>,
    cost: Vec<f64>,
}

impl Star<'_> {
    /// Adds a point by way of the neighbor that makes its way shortest, and
    /// takes the neighbors' ways through it where that is shorter.
    fn add(&mut self, at: Point, nearest: usize) -> usize {
        let (points, step) = (&self.tree.points, self.tree.step);
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        let count = (points.len() + 1) as f64;
        // RRT*'s own bound is 1.4 times the root of the area, and so less than 10 steps.
        let reach = (10.0 * step * libm::sqrt(libm::log(count) / count)).min(step);
        let mut near: Vec<usize> = (0..points.len())
            .filter(|node| *node == nearest || distance(points[*node], at) <= reach)
            .collect();
        let through =
            |star: &Self, node: usize| star.cost[node] + distance(star.tree.points[node], at);
        near.sort_unstable_by(|a, b| {
            through(self, *a).total_cmp(&through(self, *b)).then(a.cmp(b))
        });
        let best = near.iter().copied().find(|node| self.tree.joined(self.tree.points[*node], at));
        let parent = best.unwrap_or(nearest);
        self.cost.push(through(self, parent));
        let added = self.tree.push(at, parent);
        for node in near {
            let shorter = self.cost[added] + distance(at, self.tree.points[node]);
            if shorter + 1e-9 < self.cost[node] && self.tree.joined(at, self.tree.points[node]) {
                self.tree.parent[node] = added;
                self.lower(node, self.cost[node] - shorter);
            }
        }
        added
    }

    /// Makes the ways to a node and to all behind it shorter by a length.
    fn lower(&mut self, node: usize, by: f64) {
        let mut behind = vec![node];
        while let Some(node) = behind.pop() {
            self.cost[node] -= by;
            let parent = &self.tree.parent;
            behind.extend((1..parent.len()).filter(|child| parent[*child] == node));
        }
    }
}

/// The point itself, or one on the way to it.
fn stepped(from: Point, to: Point, step: f64) -> Point {
    let far = distance(from, to);
    if far <= step { to } else { point(vec2(from) + (vec2(to) - vec2(from)) * (step / far)) }
}
