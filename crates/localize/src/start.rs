//! The places where a robot that has looked around may be: a search over all of the map.
//!
//! Particles spread evenly and weighed by one measurement after the other, as textbooks have it,
//! are soon sure of a wrong place: too few of them are near to the right one, and each
//! measurement counts as a new one. Here all of a look around is weighed at once, first as if
//! the sensor were vague, then more and more exactly (annealing), and what is left is refined.
use crate::field::{Field, float};
use crate::model::{Model, Move};
use crate::particles::{Particle, Particles, beside};
use ev3_motion::{Pose, wrapped};
use rand_distr::{Distribution, StandardUniform};
use rand_pcg::Pcg32;

/// Poses to begin with, for a free area of up to this in square meters, and the most.
const POSES: f64 = 20_000.0;
const AREA: f64 = 12.0;
const MOST_POSES: f64 = 400_000.0;
/// Looks of one turn share more of their errors than those of a drive.
const LOOK_AROUND: f64 = 0.5;
/// Looks that are weighed.
const LOOKS: usize = 36;

/// Each round of the search: by how much the sensor is taken to be vaguer than it is, in cm, how
/// many places are refined, and the steps of that, in cm and degrees.
const ROUNDS: [(f64, usize, &[f64]); 3] =
    [(8.0, 100, &[6.0, 3.0]), (3.0, 40, &[2.0, 1.0]), (0.0, 20, &[0.5, 0.25, 0.125])];
/// A place is the same as a better one if it is so near, in cm and degrees.
const SAME: [f64; 2] = [10.0, 10.0];

/// One measurement on the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Look {
    /// By odometry.
    pub(crate) pose: Pose,
    pub(crate) heard: Option<f64>,
}

/// A place where the robot may be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Place {
    /// At the last look.
    pub(crate) pose: Pose,
    /// Its share of the probability of all places.
    pub(crate) weight: f64,
    /// How well the looks fit, from 0 to 1.
    pub(crate) fit: f64,
}

/// Looks, each with the way to its sensor from the pose at the last one.
struct Round<'a> {
    field: &'a Field,
    model: &'a Model,
    looks: Vec<(Move, Option<f64>)>,
}

impl Round<'_> {
    fn log_likelihood(&self, pose: Pose, vague: f64) -> f64 {
        let each = self.looks.iter().map(|(sensor, heard)| {
            let expected = self.field.heard(sensor.from(pose));
            libm::log(self.model.likelihood(expected, *heard, vague))
        });
        each.sum()
    }

    fn fit(&self, pose: Pose) -> f64 {
        let each = self.looks.iter().map(|(sensor, heard)| {
            let expected = self.field.heard(sensor.from(pose));
            let likelihood = self.model.likelihood(expected, *heard, 0.0);
            self.model.fit(expected, likelihood)
        });
        each.sum::<f64>() / float(self.looks.len())
    }

    /// The best pose nearby, and its log likelihood.
    fn refined(&self, pose: Pose, vague: f64, steps: &[f64]) -> (Pose, f64) {
        let mut best = (pose, self.log_likelihood(pose, vague));
        for step in steps {
            loop {
                let Pose { x, y, heading } = best.0;
                let nearby = [
                    Pose { x: x + step, ..best.0 },
                    Pose { x: x - step, ..best.0 },
                    Pose { y: y + step, ..best.0 },
                    Pose { y: y - step, ..best.0 },
                    Pose { heading: heading + step, ..best.0 },
                    Pose { heading: heading - step, ..best.0 },
                ];
                let free = nearby.into_iter().filter(|pose| self.field.is_free(pose.point()));
                let weighed = free.map(|pose| (pose, self.log_likelihood(pose, vague)));
                match weighed.max_by(|(_, a), (_, b)| a.total_cmp(b)) {
                    Some(better) if better.1 > best.1 + 1e-9 => best = better,
                    _ => break,
                }
            }
        }
        best
    }
}

/// Where the robot may be, the most probable place first.
pub(crate) fn places(
    field: &Field,
    model: &Model,
    sensor: Move,
    looks: &[Look],
    generator: &mut Pcg32,
) -> Vec<Place> {
    let Some(last) = looks.last() else {
        return Vec::new();
    };
    let seen = |look: &Look| (Move::between(last.pose, sensor.from(look.pose)), look.heard);
    let all = Round { field, model, looks: looks.iter().map(seen).collect() };
    let count = LOOKS.min(looks.len());
    let some = (0..count).map(|index| all.looks[index * looks.len() / count]).collect();
    let some = Round { looks: some, field, model };
    let area = (field.free_area() / AREA).max(1.0);
    let poses = spread(field, (POSES * area).min(MOST_POSES), generator);
    let vague = ROUNDS[0].0;
    let mut found: Vec<(Pose, f64)> =
        poses.into_iter().map(|pose| (pose, some.log_likelihood(pose, vague))).collect();
    for (vague, count, steps) in ROUNDS {
        let round = if vague > 0.0 { &some } else { &all };
        let refined = distinct(found, count).into_iter();
        found = refined.map(|(pose, _)| round.refined(pose, vague, steps)).collect();
    }
    let distinct = distinct(found, usize::MAX);
    let best = distinct.first().map_or(0.0, |(_, best)| *best);
    let weight = |log: f64| libm::exp(model.exponent * LOOK_AROUND * (log - best));
    let sum: f64 = distinct.iter().map(|(_, log)| weight(*log)).sum();
    let place =
        |(pose, log): (Pose, f64)| Place { pose, weight: weight(log) / sum, fit: all.fit(pose) };
    distinct.into_iter().map(place).collect()
}

fn is_same(a: Pose, b: Pose) -> bool {
    libm::hypot(a.x - b.x, a.y - b.y) < SAME[0] && wrapped(a.heading - b.heading).abs() < SAME[1]
}

/// Free poses at random.
fn spread(field: &Field, count: f64, generator: &mut Pcg32) -> Vec<Pose> {
    let ev3_roadmap::Bounds { low, high } = field.bounds();
    let mut unit = || -> f64 { StandardUniform.sample(generator) };
    let mut poses = Vec::new();
    while float(poses.len()) < count {
        let x = low[0] + unit() * (high[0] - low[0]);
        let y = low[1] + unit() * (high[1] - low[1]);
        if field.is_free([x, y]) {
            poses.push(Pose { x, y, heading: unit() * 360.0 });
        }
    }
    poses
}

/// The most probable places that are not the same, up to a number.
fn distinct(mut found: Vec<(Pose, f64)>, most: usize) -> Vec<(Pose, f64)> {
    found.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    let mut places: Vec<(Pose, f64)> = Vec::new();
    for (pose, log) in found {
        if places.len() == most {
            break;
        }
        if !places.iter().any(|(other, _)| is_same(*other, pose)) {
            places.push((pose, log));
        }
    }
    places
}

/// Particles all over the map.
pub(crate) fn spread_particles(field: &Field, count: usize, generator: &mut Pcg32) -> Particles {
    let weight = 1.0 / float(count.max(1));
    let poses = spread(field, float(count), generator);
    Particles { all: poses.into_iter().map(|pose| Particle { pose, weight }).collect() }
}

/// Particles around places.
pub(crate) fn particles(
    places: &[Place],
    count: usize,
    least: f64,
    generator: &mut Pcg32,
) -> Particles {
    let mut all = Vec::new();
    for place in places {
        let share = libm::round(float(count) * place.weight).max(least);
        let mut drawn = 0.0;
        while drawn < share {
            let pose = beside(place.pose, [1.5, 1.5], generator);
            all.push(Particle { pose, weight: place.weight / share });
            drawn += 1.0;
        }
    }
    Particles { all }
}
