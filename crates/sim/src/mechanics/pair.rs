//! Robots at each other: they push as far as their tires grip.
//!
//! A contact is a limit as that of an obstacle, but both bodies answer its impulse. The tires tie
//! body and shafts with friction at most their own, in all directions together; so a robot that is
//! heavier, or whose motors are stronger, pushes the other one, and wheels spin. The tires of one
//! that holds its motors let it slide.
use super::{
    Body, CONTACT_OVER, Load, MARGIN, ROUNDS, SKIN, SOLVED, STRIDE, Speeds, Step, TICK_SECONDS,
    Touch, add, dot,
};
use crate::ItemId;
use crate::mechanics::Limit;
use crate::robot::RobotSpec;
use crate::world::obstacle::{Contact, Obstacle};
use crate::world::scene::Scene;
use ev3_motion::{Pose, Vec2};

/// How often robots that are too near are pushed from each other.
const PUSHES: usize = 8;
/// Wheels that spin slower than this over the floor roll, in cm/s.
const ROLLS: f64 = 1e-3;

/// A robot near another one, for a tick.
pub(crate) struct Rider<'a> {
    pub(crate) id: ItemId,
    pub(crate) body: &'a mut Body,
    pub(crate) omega: [f64; 2],
    pub(crate) loads: [Load; 2],
    pub(crate) robot: &'a RobotSpec,
    pub(crate) scene: &'a Scene,
    /// What it has run into.
    pub(crate) hits: Vec<ItemId>,
}

impl Rider<'_> {
    fn obstacle(&self) -> Obstacle {
        Obstacle::robot(self.id, self.robot.hull, &self.body.pose)
    }

    /// Where it is nearer than the margin to another one.
    fn contacts(&self, other: &Obstacle) -> Vec<Contact> {
        let (hull, frame) = (self.robot.hull, self.body.pose.frame());
        let mut contacts = Vec::new();
        if other.at_least(frame.translation.vector, hull.reach()) < MARGIN {
            other.touch_points(hull, &frame, |gap, normal, point| {
                if gap < MARGIN {
                    contacts.push(Contact { id: other.id, gap, normal, point });
                }
            });
        }
        contacts
    }

    fn stop_at(&mut self, pose: Pose) {
        self.body.place(pose);
        self.body.spins = Some([0.0; 2]);
        self.omega = [0.0; 2];
    }

    /// Moves aside by this, if there is room.
    fn shift(&mut self, by: Vec2) {
        let pose =
            Pose { x: self.body.pose.x + by.x, y: self.body.pose.y + by.y, ..self.body.pose };
        if self.scene.overlap(self.robot.hull, &pose).is_none() {
            self.body.pose = pose;
            self.body.world_changed();
        }
    }
}

/// Two robots at one place: the limits act on the first one, these gains on the second one.
struct Pair {
    bodies: [usize; 2],
    touch: Touch,
    pushed: Speeds,
    rubbed: Speeds,
    gap: f64,
}

/// A tick of robots that are near each other.
pub(crate) fn advance(riders: &mut [Rider]) {
    let mut parts: f64 = 1.0;
    for rider in &mut *riders {
        let (ahead, turn) = rider.body.twist(rider.omega);
        rider.body.spins.get_or_insert([ahead, turn]);
        parts = parts.max((rider.body.way_in_a_tick(rider.omega, rider.robot) / STRIDE).ceil());
    }
    let mut part = 0.0;
    while part < parts {
        advance_part(riders, TICK_SECONDS / parts);
        part += 1.0;
    }
    for rider in riders {
        if rider.body.bumps.is_empty() && rider.body.rolls(rider.omega) {
            rider.body.spins = None;
        }
    }
}

fn advance_part(riders: &mut [Rider], seconds: f64) {
    let mut steps: Vec<Step> = Vec::with_capacity(riders.len());
    for rider in &mut *riders {
        let Rider { body, omega, loads, robot, scene, .. } = rider;
        steps.push(body.begin(seconds, *omega, loads, robot, scene));
    }
    let mut pairs = pairs(riders, seconds);
    for _ in 0..ROUNDS {
        let rounds = steps.iter_mut().map(|step| step.limits.round(&mut step.speeds, &step.answer));
        let mut change = rounds.fold(0.0, f64::max);
        for pair in &mut pairs {
            change = change.max(pair.round(&mut steps));
        }
        if change < SOLVED {
            break;
        }
    }
    report(riders, &pairs);
    let before: Vec<_> = riders.iter().map(|rider| rider.body.pose).collect();
    for (rider, step) in riders.iter_mut().zip(steps) {
        let Rider { body, omega, loads, robot, scene, hits, .. } = rider;
        *omega = body.finish(step, seconds, loads, robot, scene, &mut |item| hits.push(item));
    }
    part_them(riders, &before);
}

fn pairs(riders: &[Rider], seconds: f64) -> Vec<Pair> {
    let obstacles: Vec<_> = riders.iter().map(Rider::obstacle).collect();
    let mut pairs = Vec::new();
    for (second, obstacle) in obstacles.iter().enumerate() {
        for (first, rider) in riders[..second].iter().enumerate() {
            for contact in rider.contacts(obstacle) {
                let (point, normal, along) = (contact.point, contact.normal, contact.along());
                let other = &riders[second].body;
                let touch = Touch {
                    push: Limit::push(rider.body.gain(point, normal), contact.gap, seconds),
                    rub: Limit::friction(rider.body.gain(point, along), 0.0),
                };
                let pushed = other.gain(point, -normal);
                let rubbed = other.gain(point, -along);
                pairs.push(Pair {
                    bodies: [first, second],
                    touch,
                    pushed,
                    rubbed,
                    gap: contact.gap,
                });
            }
        }
    }
    pairs
}

impl Pair {
    fn round(&mut self, steps: &mut [Step]) -> f64 {
        let Pair { bodies, touch, pushed, rubbed, .. } = self;
        let mut gains = [*rubbed, *pushed].into_iter();
        touch.round(|limit| apply(limit, gains.next().unwrap_or_default(), *bodies, steps))
    }
}

/// Gives both bodies the impulse that is missing.
fn apply(limit: &mut Limit, gain: Speeds, [first, second]: [usize; 2], steps: &mut [Step]) -> f64 {
    let answers = [steps[first].answer.of(limit.gain), steps[second].answer.of(gain)];
    let softness = dot(limit.gain, answers[0]) + dot(gain, answers[1]);
    let speed = dot(limit.gain, steps[first].speeds) + dot(gain, steps[second].speeds);
    let step = limit.step(speed, softness);
    add(&mut steps[first].speeds, answers[0], step);
    add(&mut steps[second].speeds, answers[1], step);
    (step * softness).abs()
}

/// A collision is counted when one begins to push.
fn report(riders: &mut [Rider], pairs: &[Pair]) {
    let ids: Vec<_> = riders.iter().map(|rider| rider.id).collect();
    for (index, rider) in riders.iter_mut().enumerate() {
        let before = std::mem::take(&mut rider.body.bumps);
        for pair in pairs.iter().filter(|pair| pair.bodies.contains(&index)) {
            let other = ids[pair.bodies[usize::from(pair.bodies[0] == index)]];
            let was = before.contains(&other);
            if pair.gap < CONTACT_OVER
                && (was || pair.touch.push.impulse > 0.0)
                && !rider.body.bumps.contains(&other)
            {
                rider.body.bumps.push(other);
                if !was {
                    rider.hits.push(other);
                }
            }
        }
    }
}

/// Rounding, and contacts whose direction changes on the way, may lead too near.
fn part_them(riders: &mut [Rider], before: &[Pose]) {
    for push in 0..=PUSHES {
        let mut is_free = true;
        for second in 1..riders.len() {
            for first in 0..second {
                let contacts = riders[first].contacts(&riders[second].obstacle());
                let nearest = contacts.into_iter().min_by(|a, b| a.gap.total_cmp(&b.gap));
                let Some(Contact { gap, normal, .. }) = nearest.filter(|c| c.gap < SKIN / 2.0)
                else {
                    continue;
                };
                is_free = false;
                if push == PUSHES {
                    riders[first].stop_at(before[first]);
                    riders[second].stop_at(before[second]);
                } else {
                    let half = normal * ((SKIN - gap) / 2.0);
                    riders[first].shift(half);
                    riders[second].shift(-half);
                }
            }
        }
        if is_free {
            return;
        }
    }
}

impl Body {
    /// Whether its wheels roll, and nothing shifts it.
    fn rolls(&self, omega: [f64; 2]) -> bool {
        let (ahead, turn) = self.twist(omega);
        let rolls =
            |[a, t]: [f64; 2]| (ahead - a).abs() < ROLLS && ((turn - t) * self.axle).abs() < ROLLS;
        self.spins.is_none_or(rolls)
    }
}
