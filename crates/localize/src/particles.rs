//! Many poses, each as probable as its weight.
use crate::field::{Field, float};
use crate::model::{Model, Move, Wander, bell};
use ev3_motion::{Pose, wrapped};
use rand_distr::{Distribution, StandardUniform};
use rand_pcg::Pcg32;
use std::collections::BTreeMap;

/// A pose of the robot, and how probable it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Particle {
    /// Its pose; the heading may have full turns.
    pub pose: Pose,
    /// From 0 to 1.
    pub weight: f64,
}

/// Particles near to one another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cluster {
    /// Its share of the probability.
    pub weight: f64,
    /// Its middle; the heading is between -180 and 180 degrees.
    pub pose: Pose,
    /// Variances and covariances of x, y and heading, in cm and degrees.
    pub covariance: [[f64; 3]; 3],
}

impl Cluster {
    /// Standard deviation of the place, in cm.
    pub fn deviation(&self) -> f64 {
        (self.covariance[0][0] + self.covariance[1][1]).sqrt()
    }
}

/// Bins of which those that touch make a cluster, in cm and degrees.
const NEAR: [f64; 2] = [15.0, 20.0];
/// Bins that say how many particles are needed.
const BIN: [f64; 2] = [10.0, 15.0];
/// By how much, and how surely, particles may be wrong about the distribution.
const ERROR: f64 = 0.05;
const QUANTILE: f64 = 2.33;
/// The least number that a cluster keeps.
const LEAST_OF_CLUSTER: f64 = 30.0;
/// And ends with less of the probability.
const LEAST_WEIGHT: f64 = 0.001;
/// How much less probable a place is where the robot does not fit.
const NOT_FREE: f64 = 1e-3;

/// How many particles there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Count {
    /// Always this number.
    Fixed(usize),
    /// As many as the distribution needs, within limits.
    Adaptive(usize, usize),
}

/// What is calculated of whole centimeters, which are all that a table has.
struct Known([Option<(f64, f64)>; 257]);

impl Default for Known {
    fn default() -> Self {
        Known([None; 257])
    }
}

impl Known {
    fn or_else(
        &mut self,
        expected: Option<f64>,
        calculated: impl FnOnce() -> (f64, f64),
    ) -> (f64, f64) {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let index = expected.map_or(256, |centimeters| centimeters as usize);
        *self.0[index].get_or_insert_with(calculated)
    }
}

/// All particles, and their clusters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Particles {
    pub(crate) all: Vec<Particle>,
}

type Bin = [i32; 3];

fn bin(pose: Pose, [side, turn]: [f64; 2]) -> Bin {
    #[expect(clippy::cast_possible_truncation, reason = "saturates")]
    let index = |value: f64| value.floor() as i32;
    [index(pose.x / side), index(pose.y / side), index(pose.heading.rem_euclid(360.0) / turn)]
}

impl Particles {
    /// Moves all.
    pub(crate) fn go(&mut self, moved: Move, wander: Wander, generator: &mut Pcg32) {
        for particle in &mut self.all {
            particle.pose = moved.drawn(wander, generator).from(particle.pose);
        }
    }

    /// Weighs all by a measurement; returns how well it fits, from 0 to 1.
    pub(crate) fn weigh(
        &mut self,
        field: &Field,
        model: &Model,
        sensor: Move,
        heard: Option<f64>,
    ) -> f64 {
        let (mut sum, mut fit) = (0.0, 0.0);
        let weighed = |expected| {
            let likelihood = model.likelihood(expected, heard, 0.0);
            let factor = libm::pow(likelihood, model.exponent);
            (factor, model.fit(expected, likelihood))
        };
        let mut known = Known::default();
        for particle in &mut self.all {
            let expected = field.heard(sensor.from(particle.pose));
            let (factor, fits) = if field.has_table() {
                known.or_else(expected, || weighed(expected))
            } else {
                weighed(expected)
            };
            let place = if field.is_free(particle.pose.point()) { 1.0 } else { NOT_FREE };
            particle.weight *= factor * place;
            sum += particle.weight;
            fit += particle.weight * fits;
        }
        if sum <= 0.0 {
            self.even();
            return 0.0;
        }
        self.scale(1.0);
        fit / sum
    }

    /// Adds others, which get a share of the probability.
    pub(crate) fn add(&mut self, mut others: Particles, share: f64) {
        others.scale(share);
        self.scale(1.0 - share);
        self.all.append(&mut others.all);
    }

    /// Makes the weights sum up to a share.
    fn scale(&mut self, share: f64) {
        let sum: f64 = self.all.iter().map(|particle| particle.weight).sum();
        if share <= 0.0 || sum <= 0.0 {
            self.all.clear();
        }
        self.all.iter_mut().for_each(|particle| particle.weight *= share / sum);
    }

    /// Weighs all the same.
    pub(crate) fn even(&mut self) {
        let weight = 1.0 / float(self.all.len().max(1));
        self.all.iter_mut().for_each(|particle| particle.weight = weight);
    }

    /// How many of them carry the weight.
    pub(crate) fn effective(&self) -> f64 {
        let squares: f64 = self.all.iter().map(|particle| particle.weight * particle.weight).sum();
        if squares > 0.0 { 1.0 / squares } else { 0.0 }
    }

    /// Draws them again, in each cluster as many as it has of the probability, so that none dies
    /// by chance.
    pub(crate) fn resample(&mut self, count: Count, generator: &mut Pcg32) {
        let total = float(self.needed(count));
        let mut drawn = Vec::new();
        for (weight, members) in self.groups() {
            if weight < LEAST_WEIGHT {
                continue;
            }
            let share = libm::round(total * weight).max(LEAST_OF_CLUSTER.min(total));
            let from = members.iter().map(|index| self.all[*index]);
            let start: f64 = StandardUniform.sample(generator);
            let poses = low_variance(from, weight, share, start);
            drawn.extend(poses.map(|pose| Particle { pose, weight: weight / share }));
        }
        if !drawn.is_empty() {
            self.all = drawn;
            self.scale(1.0);
        }
    }

    /// How many are needed. Source: Fox, Adapting the sample size in particle filters through
    /// KLD-sampling (2003).
    fn needed(&self, count: Count) -> usize {
        let (least, most) = match count {
            Count::Fixed(count) => return count,
            Count::Adaptive(least, most) => (least, most),
        };
        let mut bins = BTreeMap::new();
        for particle in &self.all {
            *bins.entry(bin(particle.pose, BIN)).or_insert(0.0) += particle.weight;
        }
        let occupied = bins.values().filter(|weight| **weight > LEAST_WEIGHT).count();
        if occupied < 2 {
            return least;
        }
        let free = float(occupied - 1);
        let part = 2.0 / (9.0 * free);
        let root = 1.0 - part + part.sqrt() * QUANTILE;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
        let needed = (free / (2.0 * ERROR) * root * root * root).ceil() as usize;
        needed.clamp(least, most)
    }

    /// The weight of each cluster and its particles, the largest weight first.
    fn groups(&self) -> Vec<(f64, Vec<usize>)> {
        let mut bins: BTreeMap<Bin, Vec<usize>> = BTreeMap::new();
        for (index, particle) in self.all.iter().enumerate() {
            bins.entry(bin(particle.pose, NEAR)).or_default().push(index);
        }
        let mut groups = Vec::new();
        while let Some((first, members)) = bins.pop_first() {
            let (mut group, mut border) = (members, vec![first]);
            while let Some(at) = border.pop() {
                for near in neighbors(at) {
                    if let Some(members) = bins.remove(&near) {
                        group.extend(members);
                        border.push(near);
                    }
                }
            }
            let weight: f64 = group.iter().map(|index| self.all[*index].weight).sum();
            groups.push((weight, group));
        }
        groups.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        groups
    }

    /// The clusters, the most probable one first.
    pub(crate) fn clusters(&self) -> Vec<Cluster> {
        let cluster = |(weight, members): (f64, Vec<usize>)| {
            let members = members.iter().map(|index| self.all[*index]);
            summary(members, weight)
        };
        self.groups().into_iter().filter(|(weight, _)| *weight > 0.0).map(cluster).collect()
    }
}

/// The bins around one; the heading goes round.
fn neighbors([x, y, turn]: Bin) -> impl Iterator<Item = Bin> {
    #[expect(clippy::cast_possible_truncation, reason = "18")]
    let turns = (360.0 / NEAR[1]) as i32;
    (0..27).map(move |index| {
        let step = |digit: i32| digit % 3 - 1;
        [x + step(index), y + step(index / 3), (turn + step(index / 9)).rem_euclid(turns)]
    })
}

/// `count` poses at even steps through the weights.
pub(crate) fn low_variance(
    from: impl Iterator<Item = Particle>,
    weight: f64,
    count: f64,
    start: f64,
) -> impl Iterator<Item = Pose> {
    let step = weight / count;
    let (mut passed, mut next) = (0.0, start * step);
    from.flat_map(move |particle| {
        passed += particle.weight;
        let mut copies = 0;
        while next < passed {
            next += step;
            copies += 1;
        }
        std::iter::repeat_n(particle.pose, copies)
    })
}

fn summary(members: impl Iterator<Item = Particle> + Clone, weight: f64) -> Cluster {
    let (mut x, mut y, mut sin, mut cos) = (0.0, 0.0, 0.0, 0.0);
    for Particle { pose, weight } in members.clone() {
        let turn = libm::sincos(pose.heading.to_radians());
        x += weight * pose.x;
        y += weight * pose.y;
        sin += weight * turn.0;
        cos += weight * turn.1;
    }
    let heading = libm::atan2(sin, cos).to_degrees();
    let middle = Pose { x: x / weight, y: y / weight, heading };
    let mut covariance = [[0.0; 3]; 3];
    for particle in members {
        let Pose { x, y, heading } = particle.pose;
        let off = [x - middle.x, y - middle.y, wrapped(heading - middle.heading)];
        for (row, a) in covariance.iter_mut().zip(off) {
            for (value, b) in row.iter_mut().zip(off) {
                *value += particle.weight / weight * a * b;
            }
        }
    }
    Cluster { weight, pose: middle, covariance }
}

/// A pose beside another, by standard deviations in cm and degrees.
pub(crate) fn beside(pose: Pose, [place, turn]: [f64; 2], generator: &mut Pcg32) -> Pose {
    Pose {
        x: pose.x + bell(generator) * place,
        y: pose.y + bell(generator) * place,
        heading: pose.heading + bell(generator) * turn,
    }
}
