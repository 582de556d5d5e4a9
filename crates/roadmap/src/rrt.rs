//! RRT*: a tree that grows from the start toward points drawn at random, and
//! is rewired where that shortens a way.
use crate::geometry::{Point, distance, point, vec2};
use crate::map::Map;
use crate::problem::{SLACK, Sought};
use crate::search::Searched;

/// One in this many draws is the goal itself.
const GOAL_EVERY: u32 = 16;

struct Tree<'a> {
    map: &'a Map,
    keep: f64,
    points: Vec<Point>,
    parent: Vec<usize>,
    cost: Vec<f64>,
}

pub(crate) fn search(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let mut draws = sought.draws(map);
    let step = draws.diagonal() / 10.0;
    let mut tree = Tree {
        map,
        keep: sought.keep + SLACK / 2.0,
        points: vec![sought.start],
        parent: vec![0],
        cost: vec![0.0],
    };
    // The index of the goal in the tree
    let mut arrived: Option<usize> = None;
    for draw in 0..sought.samples {
        let to_goal = arrived.is_none() && draw % GOAL_EVERY == 0;
        let towards = if to_goal { sought.goal } else { draws.point() };
        let nearest = tree.nearest(towards);
        let at = stepped(tree.points[nearest], towards, step);
        let clear = map.point_clear(at, sought.keep) && tree.joined(tree.points[nearest], at);
        if clear && distance(at, tree.points[nearest]) > 1e-9 {
            let added = tree.add(at, nearest, step);
            let reached = distance(at, sought.goal) < 1e-9;
            if arrived.is_none() && reached {
                arrived = Some(added);
            }
        }
        // Straight on to the goal, as soon as it can be seen from there
        if arrived.is_none() && clear && distance(at, sought.goal) <= step {
            let last = tree.points.len() - 1;
            if tree.joined(tree.points[last], sought.goal) {
                arrived = Some(tree.add(sought.goal, last, step));
            }
        }
    }
    tree.finish(arrived, sought.goal)
}

impl Tree<'_> {
    fn joined(&self, from: Point, to: Point) -> bool {
        self.map.line_clear(from, to, self.keep)
    }

    fn nearest(&self, to: Point) -> usize {
        let nodes = self.points.iter().enumerate();
        let nearer = |a: &(usize, &Point), b: &(usize, &Point)| {
            distance(*a.1, to).total_cmp(&distance(*b.1, to))
        };
        nodes.min_by(nearer).map_or(0, |(node, _)| node)
    }

    /// Adds a point by way of the neighbor that makes its way shortest, and
    /// takes the neighbors' ways through it where that is shorter.
    fn add(&mut self, at: Point, nearest: usize, step: f64) -> usize {
        #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
        let count = (self.points.len() + 1) as f64;
        // RRT*'s own bound is 1.4 times the root of the area, and so less than 10 steps.
        let reach = (10.0 * step * libm::sqrt(libm::log(count) / count)).min(step);
        let mut near: Vec<usize> = (0..self.points.len())
            .filter(|node| *node == nearest || distance(self.points[*node], at) <= reach)
            .collect();
        let through = |tree: &Self, node: usize| tree.cost[node] + distance(tree.points[node], at);
        near.sort_unstable_by(|a, b| {
            through(self, *a).total_cmp(&through(self, *b)).then(a.cmp(b))
        });
        let best = near.iter().copied().find(|node| self.joined(self.points[*node], at));
        let parent = best.unwrap_or(nearest);
        let added = self.points.len();
        self.points.push(at);
        self.parent.push(parent);
        self.cost.push(through(self, parent));
        for node in near {
            let shorter = self.cost[added] + distance(at, self.points[node]);
            if shorter + 1e-9 < self.cost[node] && self.joined(at, self.points[node]) {
                self.parent[node] = added;
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
            let children = (1..self.parent.len()).filter(|child| self.parent[*child] == node);
            behind.extend(children);
        }
    }

    /// The tree with the goal as node 1, as a search answers it.
    fn finish(self, arrived: Option<usize>, goal: Point) -> (Vec<Point>, Searched) {
        let Tree { mut points, parent, .. } = self;
        points.insert(1, goal);
        let node = |index: usize| match index {
            0 => 0,
            index if Some(index) == arrived => 1,
            index => index + 1,
        };
        let edges = (1..parent.len()).map(|child| [node(parent[child]), node(child)]).collect();
        let way = arrived.map(|last| {
            let mut way: Vec<usize> =
                std::iter::successors(Some(last), |at| (*at != 0).then(|| parent[*at]))
                    .map(node)
                    .collect();
            way.reverse();
            way
        });
        (points, Searched { way, edges })
    }
}

/// The point itself, or one on the way to it.
fn stepped(from: Point, to: Point, step: f64) -> Point {
    let far = distance(from, to);
    if far <= step { to } else { point(vec2(from) + (vec2(to) - vec2(from)) * (step / far)) }
}
