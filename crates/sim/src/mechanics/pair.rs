//! Robots at each other: they push as far as their tires grip.
//!
//! A contact is a limit as that of an obstacle, but both bodies answer its impulse. The tires tie
//! body and shafts with friction at most their own, in all directions together; so a robot that is
//! heavier, or whose motors are stronger, pushes the other one, and wheels spin. The tires of one
//! that holds its motors let it slide.
//!
//! Things that robots push take part in the same way. Among them each step begins with the
//! impulses of the last one.
use super::{Body, CONTACT_OVER, Load, MARGIN, ROUNDS, SOLVED, STRIDE, Step, TICK_SECONDS};
use crate::ItemId;
use crate::mechanics::limit::{Limit, SKIN, Speeds, Touch};
use crate::mechanics::warm::Key;
use crate::world::Hull;
use crate::world::obstacle::{Contact, Obstacle};
use crate::world::scene::Scene;
use ev3_motion::{Pose, Vec2, length, outside};

/// How often robots that are too near are pushed from each other.
const PUSHES: usize = 8;
/// The share of what a held thing is off that a step makes good.
const SETTLES: f64 = 0.2;
/// Wheels that spin slower than this over the floor roll, in cm/s.
const ROLLS: f64 = 1e-3;
/// Contacts of things nearer than this take part, in cm: farther than both move in a step.
const NEAR: f64 = 2.0 * STRIDE + 0.05;
/// Among things a step begins with the impulses of the last one. After this number of rounds it is
/// enough that no speed changes by more than the second number, in cm/s.
const WARM_ROUNDS: usize = 16;
const WARM_SOLVED: f64 = 1e-3;

/// A robot near another one, or a thing, for a tick.
pub(crate) struct Rider<'a> {
    pub(crate) id: ItemId,
    pub(crate) body: &'a mut Body,
    pub(crate) omega: [f64; 2],
    pub(crate) loads: [Load; 2],
    pub(crate) hull: Hull,
    pub(crate) scene: &'a Scene,
    /// What it has run into.
    pub(crate) hits: Vec<ItemId>,
}

impl Rider<'_> {
    fn obstacle(&self) -> Obstacle {
        Obstacle::robot(self.id, self.hull, &self.body.pose)
    }

    fn is_thing(&self) -> bool {
        self.body.floor.is_some()
    }

    /// Where it is nearer than this to another one. The outlines are its own and the other one's.
    fn contacts(&self, [own, other]: [&Obstacle; 2], margin: f64, mut each: impl FnMut(Contact)) {
        if own.may_be_within(other, margin) {
            other.touch_points(self.hull, &self.body.pose.frame(), 0, |contact| {
                if contact.gap < margin {
                    each(contact);
                }
            });
        }
    }

    fn stop_at(&mut self, pose: Pose) {
        self.body.place(pose);
        self.body.halts += 1;
        self.body.spins = Some([0.0; 2]);
        self.omega = [0.0; 2];
    }

    /// Moves aside by this, if there is room.
    fn shift(&mut self, by: Vec2) {
        let pose =
            Pose { x: self.body.pose.x + by.x, y: self.body.pose.y + by.y, ..self.body.pose };
        if self.scene.overlap(self.hull, &pose).is_none() {
            self.body.pose = pose;
            self.body.world_changed();
        }
    }
}

/// Two bodies at one place: the limits act on the first one.
struct Pair {
    bodies: [usize; 2],
    touch: Touch,
    rubbed: Both,
    pushed: Both,
    gap: f64,
    key: Key,
}

/// What a limit of two bodies does: their gains, how they answer, and how much an impulse changes
/// the limited speed.
struct Both {
    gains: [[f64; 3]; 2],
    answers: [[f64; 3]; 2],
    softness: f64,
}

/// A thing that a gripper holds: a point of one body stays at a point of another one, and so does
/// its heading, as far as the gripper is strong.
pub(crate) struct Joint<'a> {
    /// The robot and the thing.
    pub(crate) bodies: [usize; 2],
    /// The point in the frames of both, in cm.
    pub(crate) at: [Vec2; 2],
    /// How far the thing is turned from the robot, in degrees.
    pub(crate) turned: f64,
    /// The most force in N, and the most torque in N m.
    pub(crate) force: f64,
    pub(crate) torque: f64,
    /// The impulses of the last step, per second: along x and y, turning.
    pub(crate) impulses: &'a mut [f64; 3],
}

impl Joint<'_> {
    fn limits(&self, riders: &[Rider], steps: &[Step], seconds: f64) -> [(Limit, Both); 3] {
        let bodies = self.bodies.map(|index| &*riders[index].body);
        let steps = self.bodies.map(|index| &steps[index]);
        let points = [0, 1].map(|i| outside(&bodies[i].pose.frame(), self.at[i]));
        let off = points[1] - points[0];
        let limit = |gains: [Speeds; 2], most: f64, off: f64| {
            let mut limit = Limit::friction(gains[0], most * seconds);
            limit.target = off * SETTLES / seconds;
            (limit, Both::new(gains, steps))
        };
        let along = |axis: Vec2| {
            let gains = [bodies[0].gain(points[0], axis), bodies[1].gain(points[1], -axis)];
            limit(gains, self.force / 100.0, off.dot(&axis))
        };
        let turn = [0.0, 0.0, 0.0, 0.0, 1.0];
        let turned = bodies[1].pose.heading - bodies[0].pose.heading - self.turned;
        [
            along(Vec2::new(1.0, 0.0)),
            along(Vec2::new(0.0, 1.0)),
            limit([turn, turn.map(|one: f64| -one)], self.torque, turned.to_radians()),
        ]
    }

    /// How far the two points are from each other, in cm.
    fn off(&self, riders: &[Rider]) -> f64 {
        let points = [0, 1].map(|i| outside(&riders[self.bodies[i]].body.pose.frame(), self.at[i]));
        length(points[1] - points[0])
    }
}

/// A tick of robots and things that are near each other. `joints` answer how far off they are.
pub(crate) fn advance(riders: &mut [Rider], joints: &mut [Joint]) -> Vec<f64> {
    let mut parts: f64 = 1.0;
    for rider in &mut *riders {
        let (ahead, turn) = rider.body.twist(rider.omega);
        rider.body.spins.get_or_insert([ahead, turn]);
        parts = parts.max((rider.body.way_in_a_tick(rider.omega, rider.hull) / STRIDE).ceil());
    }
    let mut part = 0.0;
    while part < parts {
        advance_part(riders, joints, TICK_SECONDS / parts);
        part += 1.0;
    }
    for rider in &mut *riders {
        if !rider.is_thing() && rider.body.bumps.is_empty() && rider.body.rolls(rider.omega) {
            rider.body.spins = None;
        }
    }
    joints.iter().map(|joint| joint.off(riders)).collect()
}

fn advance_part(riders: &mut [Rider], joints: &mut [Joint], seconds: f64) {
    let mut steps: Vec<Step> = Vec::with_capacity(riders.len());
    for rider in &mut *riders {
        let Rider { body, omega, loads, hull, scene, .. } = rider;
        steps.push(body.begin(seconds, *omega, loads, *hull, scene));
    }
    let mut pairs = pairs(riders, &steps, seconds);
    let mut holds: Vec<_> =
        joints.iter().map(|joint| joint.limits(riders, &steps, seconds)).collect();
    let is_warm = riders.iter().any(Rider::is_thing);
    if is_warm {
        for pair in &mut pairs {
            if let Some(impulses) = riders[pair.bodies[0]].body.warm.at(pair.key, seconds) {
                pair.begin_with(impulses, &mut steps);
            }
        }
        for (joint, hold) in joints.iter().zip(&mut holds) {
            for ((limit, both), impulse) in hold.iter_mut().zip(*joint.impulses) {
                limit.impulse = (impulse * seconds).clamp(-limit.whole, limit.whole);
                both.give(limit.impulse, joint.bodies, &mut steps);
            }
        }
        for (rider, step) in riders.iter().zip(&mut steps) {
            step.warm_up(rider.body, seconds);
        }
    }
    for round in 1..=ROUNDS {
        let rounds = steps.iter_mut().map(|step| step.limits.round(&mut step.speeds, &step.answer));
        let mut change = rounds.fold(0.0, f64::max);
        for (joint, hold) in joints.iter().zip(&mut holds) {
            for (limit, both) in hold {
                change = change.max(both.apply(limit, joint.bodies, &mut steps));
            }
        }
        for pair in &mut pairs {
            change = change.max(pair.round(&mut steps));
        }
        let enough = if is_warm && round >= WARM_ROUNDS { WARM_SOLVED } else { SOLVED };
        if change < enough {
            break;
        }
    }
    for (rider, step) in riders.iter_mut().zip(&mut steps).filter(|_| is_warm) {
        step.keep(rider.body, seconds);
    }
    for pair in pairs.iter().filter(|_| is_warm) {
        riders[pair.bodies[0]].body.warm.note(pair.key, &pair.touch, seconds);
    }
    for (joint, hold) in joints.iter_mut().zip(&holds) {
        *joint.impulses = [0, 1, 2].map(|i| hold[i].0.impulse / seconds);
    }
    report(riders, &pairs);
    let before: Vec<_> = riders.iter().map(|rider| rider.body.pose).collect();
    for (rider, step) in riders.iter_mut().zip(steps) {
        let Rider { body, omega, loads, hull, scene, hits, .. } = rider;
        *omega = body.finish(step, seconds, loads, *hull, scene, &mut |item| hits.push(item));
    }
    part_them(riders, &before);
}

fn pairs(riders: &[Rider], steps: &[Step], seconds: f64) -> Vec<Pair> {
    let outlines: Vec<_> = riders.iter().map(Rider::obstacle).collect();
    let mut pairs = Vec::new();
    for (second, outline) in outlines.iter().enumerate() {
        for (first, rider) in riders[..second].iter().enumerate() {
            let other = &riders[second];
            let margin = if rider.is_thing() || other.is_thing() { NEAR } else { MARGIN };
            rider.contacts([&outlines[first], outline], margin, |contact| {
                let Contact { gap, normal, point, corner, .. } = contact;
                let [push, rub] = [normal, contact.along()].map(|into| {
                    let gains = [rider.body.gain(point, into), other.body.gain(point, -into)];
                    (gains[0], Both::new(gains, [&steps[first], &steps[second]]))
                });
                let ((push, pushed), (rub, rubbed)) = (push, rub);
                let mut push = Limit::push(push, gap, seconds);
                let bounce = rider.body.bounce.max(other.body.bounce);
                let speed = pushed.speed([first, second], steps);
                push.bounce(speed, gap, bounce, seconds);
                pairs.push(Pair {
                    bodies: [first, second],
                    touch: Touch { push, rub: Limit::friction(rub, 0.0) },
                    rubbed,
                    pushed,
                    gap,
                    key: Key([rider.id.0, other.id.0, corner]),
                });
            });
        }
    }
    pairs
}

/// The part of a speed, or of an answer, that is of the body; no shaft takes part here.
fn of_body([_, _, aside, ahead, turn]: Speeds) -> [f64; 3] {
    [aside, ahead, turn]
}

fn dot([a, b, c]: [f64; 3], [_, _, aside, ahead, turn]: &Speeds) -> f64 {
    a * aside + b * ahead + c * turn
}

fn add([_, _, aside, ahead, turn]: &mut Speeds, [a, b, c]: [f64; 3], step: f64) {
    *aside += a * step;
    *ahead += b * step;
    *turn += c * step;
}

impl Both {
    fn new(gains: [Speeds; 2], steps: [&Step; 2]) -> Both {
        let [first, second] = [0, 1].map(|i| steps[i].answer.of(gains[i]));
        let gains = gains.map(of_body);
        let softness = dot(gains[0], &first) + dot(gains[1], &second);
        Both { gains, answers: [first, second].map(of_body), softness }
    }

    /// How fast both are at it.
    fn speed(&self, [first, second]: [usize; 2], steps: &[Step]) -> f64 {
        dot(self.gains[0], &steps[first].speeds) + dot(self.gains[1], &steps[second].speeds)
    }

    /// Gives both bodies an impulse.
    fn give(&self, step: f64, [first, second]: [usize; 2], steps: &mut [Step]) {
        add(&mut steps[first].speeds, self.answers[0], step);
        add(&mut steps[second].speeds, self.answers[1], step);
    }

    /// Gives both bodies the impulse that is missing.
    fn apply(&self, limit: &mut Limit, bodies: [usize; 2], steps: &mut [Step]) -> f64 {
        let step = limit.step(self.speed(bodies, steps), self.softness);
        self.give(step, bodies, steps);
        (step * self.softness).abs()
    }
}

impl Pair {
    fn round(&mut self, steps: &mut [Step]) -> f64 {
        let Pair { bodies, touch, rubbed, pushed, .. } = self;
        let mut both = [rubbed, pushed].into_iter();
        touch.round(|limit| both.next().map_or(0.0, |both| both.apply(limit, *bodies, steps)))
    }

    /// Begins with these impulses of push and rub.
    fn begin_with(&mut self, [push, rub]: [f64; 2], steps: &mut [Step]) {
        self.touch.push.impulse = push;
        self.pushed.give(push, self.bodies, steps);
        self.touch.rub.impulse = rub;
        self.rubbed.give(rub, self.bodies, steps);
    }
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
    let mut outlines: Vec<_> = riders.iter().map(Rider::obstacle).collect();
    for push in 0..=PUSHES {
        let mut is_free = true;
        for second in 1..riders.len() {
            for first in 0..second {
                let mut nearest: Option<Contact> = None;
                let both = [&outlines[first], &outlines[second]];
                riders[first].contacts(both, SKIN / 2.0, |contact| {
                    if nearest.is_none_or(|nearest| contact.gap < nearest.gap) {
                        nearest = Some(contact);
                    }
                });
                let Some(Contact { gap, normal, .. }) = nearest else { continue };
                is_free = false;
                if push == PUSHES {
                    riders[first].stop_at(before[first]);
                    riders[second].stop_at(before[second]);
                } else {
                    let half = normal * ((SKIN - gap) / 2.0);
                    riders[first].shift(half);
                    riders[second].shift(-half);
                }
                for moved in [first, second] {
                    outlines[moved] = riders[moved].obstacle();
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
