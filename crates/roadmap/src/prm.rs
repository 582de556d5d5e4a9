//! A probabilistic roadmap: points drawn at random, each joined with those next to it. As many
//! neighbors as PRM* takes, so that with more points the way comes ever closer to the shortest.
use crate::geometry::{Point, distance};
use crate::map::Map;
use crate::problem::{SLACK, Sought};
use crate::search::{Searched, shortest};

pub(crate) fn search(map: &Map, sought: &Sought) -> (Vec<Point>, Searched) {
    let mut points = vec![sought.start, sought.goal];
    let mut draws = sought.draws(map);
    for _ in 0..sought.samples {
        let at = draws.point();
        if map.point_clear(at, sought.keep) {
            points.push(at);
        }
    }
    let neighbors = nearest(&points);
    let joined =
        |a: usize, b: usize| map.line_clear(points[a], points[b], sought.keep + SLACK / 2.0);
    let searched = shortest(&points, |node| neighbors[node].iter().copied(), joined);
    (points, searched)
}

/// For each point those that are joined with it, if nothing is in between.
fn nearest(points: &[Point]) -> Vec<Vec<usize>> {
    // e (1 + 1/d) log n in d = 2 dimensions
    #[expect(clippy::cast_precision_loss, reason = "a count of samples")]
    let most = 1.5 * std::f64::consts::E * libm::log(points.len() as f64);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
    let most = libm::ceil(most) as usize;
    let mut neighbors = vec![Vec::new(); points.len()];
    for (node, at) in points.iter().enumerate() {
        let mut others: Vec<usize> = (0..points.len()).filter(|other| *other != node).collect();
        let nearer = |a: &usize, b: &usize| {
            distance(*at, points[*a]).total_cmp(&distance(*at, points[*b])).then(a.cmp(b))
        };
        if others.len() > most {
            others.select_nth_unstable_by(most, nearer);
            others.truncate(most);
        }
        for other in others {
            neighbors[node].push(other);
            neighbors[other].push(node);
        }
    }
    for list in &mut neighbors {
        list.sort_unstable();
        list.dedup();
    }
    neighbors
}
