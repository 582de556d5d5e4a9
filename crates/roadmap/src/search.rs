//! The shortest path in a graph. The search checks an edge only when it needs the edge.
use crate::geometry::{Point, distance};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A node to go on from; the one with the least estimate first.
#[derive(PartialEq)]
struct Open {
    estimate: f64,
    node: usize,
}

impl Eq for Open {}

impl PartialOrd for Open {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Open {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.estimate.total_cmp(&other.estimate).then(self.node.cmp(&other.node))
    }
}

/// The result of a search.
pub(crate) struct Searched {
    /// The nodes of the shortest way, if there is one.
    pub(crate) way: Option<Vec<usize>>,
    /// The edges that were found to be there.
    pub(crate) edges: Vec<[usize; 2]>,
}

/// A* from node 0 to node 1, by straight lines.
///
/// An edge costs its length. Whether it is there, `joined` is asked at most
/// once in each direction, and only if a shorter way could go along it.
pub(crate) fn shortest<I: IntoIterator<Item = usize>>(
    points: &[Point],
    neighbors: impl Fn(usize) -> I,
    joined: impl Fn(usize, usize) -> bool,
) -> Searched {
    let mut cost = vec![f64::INFINITY; points.len()];
    let mut before = vec![0; points.len()];
    let mut closed = vec![false; points.len()];
    let mut edges = Vec::new();
    let mut open = BinaryHeap::new();
    cost[0] = 0.0;
    open.push(Reverse(Open { estimate: distance(points[0], points[1]), node: 0 }));
    while let Some(Reverse(Open { node, .. })) = open.pop() {
        if std::mem::replace(&mut closed[node], true) {
            continue;
        }
        if node == 1 {
            break;
        }
        for next in neighbors(node) {
            let through = cost[node] + distance(points[node], points[next]);
            if closed[next] || through >= cost[next] || !joined(node, next) {
                continue;
            }
            edges.push([node, next]);
            cost[next] = through;
            before[next] = node;
            let estimate = through + distance(points[next], points[1]);
            open.push(Reverse(Open { estimate, node: next }));
        }
    }
    Searched { way: closed[1].then(|| way_back(&before)), edges }
}

fn way_back(before: &[usize]) -> Vec<usize> {
    let mut way: Vec<usize> =
        std::iter::successors(Some(1), |node| (*node != 0).then(|| before[*node])).collect();
    way.reverse();
    way
}
