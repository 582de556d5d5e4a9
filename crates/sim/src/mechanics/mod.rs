//! The mechanics: two wheels, the body they carry, and what stops them.
//!
//! The speeds of the two motor shafts are the coordinates, and the speed at which the body slips
//! sideways. Free of walls the wheels roll and do not slip sideways. Motors push through their
//! back-EMF, which is taken implicitly so that no step is too long. Friction, a jammed wheel and an
//! obstacle are limits: each gives the impulse that it needs and not more (friction at most its
//! own, an obstacle only pushes). So a robot that runs straight into a wall stops its own motors,
//! one that runs into it at an angle slides along, and a motor too weak for its friction does not
//! creep.
//!
//! Along their way the wheels of a robot that is alone hold without limit. Those of a light robot
//! on a smooth table would spin before the motors stall; here a wall stalls them, as it stalls
//! those of a heavy robot. Between robots it is their grip that decides who pushes whom: see
//! `pair`. There the body has speeds of its own, ahead and turning, and the tires tie them to the
//! shafts as far as they hold. A thing that robots push is such a body, too (`thing`): it has no
//! wheels, and the floor holds it by dry friction (`sole`).

mod limit;
pub(crate) mod pair;
pub(crate) mod shaft;
pub(crate) mod sole;
pub(crate) mod thing;
mod warm;

use crate::ItemId;
use crate::mechanics::limit::{Answer, Limit, SKIN, Speeds, Touch, add, apply, dot};
use crate::mechanics::sole::{Floor, Sole};
use crate::mechanics::warm::{Key, Warm};
use crate::robot::{RobotSpec, Wheel};
use crate::ticks::TICK_SECONDS;
use crate::world::Hull;
use crate::world::obstacle::Contact;
use crate::world::scene::Scene;
use ev3_motion::{Pose, Vec2, heading_vector, sin_cos};

/// Contacts nearer than this take part in the mechanics, in cm.
const MARGIN: f64 = 1.0;
/// A contact is over when the hull is this far off again, in cm.
const CONTACT_OVER: f64 = 0.5;
/// Slower than this is standing still, in rad/s: what the solver leaves of a wheel at rest.
const REST: f64 = 1e-7;
/// Slower than this the body does not slip sideways, in cm/s.
const NO_SLIP: f64 = 1e-6;
/// The most rounds of the solver. Without contacts it needs two.
const ROUNDS: usize = 64;
/// It ends when no speed changes by more in a round.
const SOLVED: f64 = 1e-9;
/// Near obstacles no point of the hull moves further than this at once, in cm: a fifth of
/// [`MARGIN`], so no wall is jumped over, and on an arc of this length the direction of a contact
/// is still true.
const STRIDE: f64 = 0.2;
/// How often a place that is too near to an obstacle is pushed away from it.
const PUSHES: usize = 8;

/// Friction of the tires against slipping sideways, as a share of the robot's weight. Rubber wheels
/// of robots have 0.5 to 0.9 in pull tests, more at rest than while they slip.
const TIRE_FRICTION: f64 = 0.6;
/// Standard gravity, m/s².
const GRAVITY: f64 = 9.806_65;

/// The influences on one motor shaft during a tick.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Load {
    /// Torque that does not depend on speed, N m.
    pub(crate) torque: f64,
    /// Torque lost per rad/s, N m s.
    pub(crate) damping: f64,
    /// Dry friction, N m.
    pub(crate) friction: f64,
    /// Inertia of the shaft itself, kg m².
    pub(crate) inertia: f64,
    /// Something holds it fast.
    pub(crate) jammed: bool,
}

impl Load {
    /// The speed of a shaft that carries nothing, in rad/s, one tick later.
    pub(crate) fn turn_free(&self, omega: f64) -> f64 {
        if self.jammed {
            return 0.0;
        }
        let pushed = (self.inertia * omega + self.torque * TICK_SECONDS)
            / (self.inertia + self.damping * TICK_SECONDS);
        let friction = self.friction * TICK_SECONDS / self.inertia;
        pushed - pushed.clamp(-friction, friction)
    }
}

/// A part of a tick: the speeds so far, how they answer, and what limits them.
struct Step {
    speeds: Speeds,
    answer: Answer,
    limits: Limits,
}

/// All limits of a step.
struct Limits {
    /// The floor under a thing; a thing has no shafts and no tires.
    sole: Option<Sole>,
    shafts: [Limit; 2],
    /// The tires against slipping sideways; `None` if nothing makes them slip.
    tires: Option<Limit>,
    /// The tires along their way, left and right, if they do not hold without limit.
    grips: Option<[Limit; 2]>,
    touches: Vec<Touch>,
}

impl Limits {
    /// Finds the impulses by turns (projected Gauss–Seidel).
    fn solve(&mut self, speeds: &mut Speeds, answer: &Answer) {
        for _ in 0..ROUNDS {
            if self.round(speeds, answer) < SOLVED {
                break;
            }
        }
    }

    /// Each limit once, obstacles last: they win. Answers the largest change of a speed.
    fn round(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let mut change;
        if let Some(sole) = &mut self.sole {
            change = sole.apply(speeds, answer);
        } else {
            change = self.wheels(speeds, answer);
        }
        for touch in &mut self.touches {
            change = change.max(touch.round(|limit| limit.apply(speeds, answer)));
        }
        change
    }

    /// The limits of shafts and tires.
    fn wheels(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let mut change: f64 = 0.0;
        for limit in self.shafts.iter_mut().chain(&mut self.tires) {
            change = change.max(limit.apply(speeds, answer));
        }
        if let Some(grips) = &mut self.grips {
            // What the tires hold aside they do not hold along.
            let aside = self.tires.as_ref().map_or(0.0, |tires| tires.impulse);
            for grip in grips {
                let whole = grip.whole;
                grip.high = libm::sqrt((whole * whole - aside * aside / 4.0).max(0.0));
                grip.low = -grip.high;
                change = change.max(grip.apply(speeds, answer));
            }
        }
        change
    }
}

impl Limits {
    /// The limits of shafts, tires and grips, each at its place.
    fn of_wheels(&mut self) -> impl Iterator<Item = (usize, &mut Limit)> {
        let grips = self.grips.iter_mut().flatten();
        let shafts = self.shafts.iter_mut().enumerate();
        shafts.chain(self.tires.iter_mut().map(|tires| (2, tires))).chain((3..).zip(grips))
    }
}

/// The name of a contact with something that does not move.
fn of_wall(contact: &Contact) -> Key {
    Key([contact.id.0, 0, contact.corner])
}

fn begin_with(limit: &mut Limit, impulse: f64, speeds: &mut Speeds, answer: &Answer) {
    limit.impulse = impulse.clamp(-limit.whole, limit.whole);
    add(speeds, answer.of(limit.gain), limit.impulse);
}

impl Step {
    /// Begins with the impulses of the body's last step.
    fn warm_up(&mut self, body: &Body, seconds: f64) {
        let Step { speeds, answer, limits } = self;
        if let Some(sole) = &mut limits.sole {
            sole.give(body.warm.sole, speeds, answer);
        } else {
            for (place, limit) in limits.of_wheels() {
                begin_with(limit, body.warm.wheels[place] * seconds, speeds, answer);
            }
        }
        for (touch, contact) in limits.touches.iter_mut().zip(&body.contacts) {
            let Some([push, rub]) = body.warm.at(of_wall(contact), seconds) else { continue };
            touch.push.impulse = push;
            add(speeds, answer.of(touch.push.gain), push);
            touch.rub.impulse = rub;
            add(speeds, answer.of(touch.rub.gain), rub);
        }
    }

    /// Keeps the impulses for the next one.
    fn keep(&mut self, body: &mut Body, seconds: f64) {
        body.warm.forget();
        body.warm.sole = self.limits.sole.as_ref().map_or([0.0; 3], |sole| sole.share);
        for (place, limit) in self.limits.of_wheels() {
            body.warm.wheels[place] = limit.impulse / seconds;
        }
        for (touch, contact) in self.limits.touches.iter().zip(&body.contacts) {
            body.warm.note(of_wall(contact), touch, seconds);
        }
    }
}

/// The body on its wheels.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) pose: Pose,
    /// Way of a wheel's contact point per rad of its motor, in cm; 0 without wheels.
    roll: [f64; 2],
    axle: f64,
    mass: f64,
    /// Moment of inertia around the middle of the axle, kg m².
    moment: f64,
    /// Degrees per second, clockwise.
    pub(crate) turn_rate: f64,
    /// How fast it slips to the right, pushed by an obstacle, in cm/s.
    pub(crate) slip: f64,
    /// Its speeds ahead (cm/s) and clockwise (rad/s), where its wheels may spin: at another robot,
    /// and until they roll again.
    pub(crate) spins: Option<[f64; 2]>,
    /// The floor's hold on a thing; `None` for a robot.
    pub(crate) floor: Option<Floor>,
    /// The share of its speed with which a thing comes back from a wall.
    bounce: f64,
    /// The impulses of its last step among things.
    warm: Warm,
    /// How often it was stopped, since no place was free where it went.
    pub(crate) halts: u32,
    /// How far the hull may still move before contacts have to be looked for again, in cm.
    free_way: f64,
    contacts: Vec<Contact>,
    touching: Vec<ItemId>,
    /// The robots that it pushes, or is pushed by.
    bumps: Vec<ItemId>,
}

fn roll(wheel: Wheel) -> f64 {
    let roll = wheel.diameter / 2.0 * (1.0 - wheel.slip);
    if wheel.inverted { -roll } else { roll }
}

impl Body {
    pub(crate) fn new(robot: &RobotSpec, pose: Pose) -> Body {
        let reach_m = robot.hull.reach() / 100.0;
        let wheels = robot.wheels;
        let moment = robot.mass * reach_m * reach_m / 2.0;
        Body {
            roll: wheels.map_or([0.0; 2], |wheels| [roll(wheels.left), roll(wheels.right)]),
            axle: wheels.map_or(1.0, |wheels| wheels.axle),
            ..Body::still(pose, robot.mass, moment)
        }
    }

    /// A thing of this inertia, in kg, and moment of inertia around its center, in kg m². It comes
    /// back from a wall with a share of its speed.
    pub(crate) fn thing(pose: Pose, inertia: f64, moment: f64, floor: Floor, bounce: f64) -> Body {
        let (spins, floor) = (Some([0.0; 2]), Some(floor));
        Body { spins, floor, bounce, ..Body::still(pose, inertia, moment) }
    }

    fn still(pose: Pose, mass: f64, moment: f64) -> Body {
        Body {
            pose,
            roll: [0.0; 2],
            axle: 1.0,
            mass,
            moment,
            turn_rate: 0.0,
            slip: 0.0,
            spins: None,
            floor: None,
            bounce: 0.0,
            warm: Warm::default(),
            halts: 0,
            free_way: 0.0,
            contacts: Vec::new(),
            touching: Vec::new(),
            bumps: Vec::new(),
        }
    }

    /// Puts it somewhere else, at rest.
    pub(crate) fn place(&mut self, pose: Pose) {
        self.pose = pose;
        self.turn_rate = 0.0;
        self.slip = 0.0;
        self.spins = self.floor.map(|_| [0.0; 2]);
        self.world_changed();
        self.touching.clear();
    }

    /// Something was added or taken away.
    pub(crate) fn world_changed(&mut self) {
        self.free_way = 0.0;
        self.warm.forget();
    }

    /// Speed ahead (cm/s) and turning clockwise (rad/s).
    fn twist(&self, omega: [f64; 2]) -> (f64, f64) {
        let [left, right] = [self.roll[0] * omega[0], self.roll[1] * omega[1]];
        (f64::midpoint(left, right), (left - right) / self.axle)
    }

    /// Inertia of the whole as seen from the two shafts.
    fn inertia(&self, loads: &[Load; 2]) -> [[f64; 2]; 2] {
        let ahead = [self.roll[0] / 200.0, self.roll[1] / 200.0];
        let turn = [self.roll[0] / self.axle, -self.roll[1] / self.axle];
        let part = |i: usize, j: usize| {
            let shaft = if i == j { loads[i].inertia } else { 0.0 };
            shaft + self.mass * ahead[i] * ahead[j] + self.moment * turn[i] * turn[j]
        };
        [[part(0, 0), part(0, 1)], [part(1, 0), part(1, 1)]]
    }

    /// Energy of motion, in joules.
    pub(crate) fn energy(&self, omega: [f64; 2], loads: &[Load; 2]) -> f64 {
        let slipping = self.mass * (self.slip / 100.0).powi(2) / 2.0;
        if let Some([ahead, turn]) = self.spins {
            let shaft = |i: usize| loads[i].inertia * omega[i] * omega[i] / 2.0;
            let moving = self.mass * (ahead / 100.0).powi(2) + self.moment * turn * turn;
            return shaft(0) + shaft(1) + moving / 2.0 + slipping;
        }
        let m = self.inertia(loads);
        let pull = |i: usize| m[i][0] * omega[0] + m[i][1] * omega[1];
        f64::midpoint(omega[0] * pull(0), omega[1] * pull(1)) + slipping
    }

    /// One tick: the new speeds of the shafts and the new pose. Items that the robot has run
    /// into just now are reported. Near obstacles a fast robot takes the tick in parts.
    pub(crate) fn advance(
        &mut self,
        omega: &mut [f64; 2],
        loads: &[Load; 2],
        hull: Hull,
        scene: &Scene,
        mut hit: impl FnMut(ItemId),
    ) {
        let way = self.way_in_a_tick(*omega, hull);
        let is_near = way > STRIDE && self.free_way < 2.0 * way;
        let parts = if is_near { (way / STRIDE).ceil() } else { 1.0 };
        let mut part = 0.0;
        while part < parts {
            self.advance_part(TICK_SECONDS / parts, omega, loads, hull, scene, &mut hit);
            part += 1.0;
        }
    }

    fn advance_part(
        &mut self,
        seconds: f64,
        omega: &mut [f64; 2],
        loads: &[Load; 2],
        hull: Hull,
        scene: &Scene,
        hit: &mut impl FnMut(ItemId),
    ) {
        let mut step = self.begin(seconds, *omega, loads, hull, scene);
        step.limits.solve(&mut step.speeds, &step.answer);
        *omega = self.finish(step, seconds, loads, hull, scene, hit);
    }

    /// The speeds that the motors alone would give, and what limits them.
    fn begin(
        &mut self,
        seconds: f64,
        omega: [f64; 2],
        loads: &[Load; 2],
        hull: Hull,
        scene: &Scene,
    ) -> Step {
        let (speeds, answer) = match self.spins {
            None => self.rolling(seconds, omega, loads),
            Some(spins) => self.spinning(seconds, omega, spins, loads),
        };
        let way = way_bound(speeds, hull, seconds).max(0.01);
        if self.free_way <= way {
            let frame = self.pose.frame();
            let free = scene.contacts(hull, &frame, MARGIN, &mut self.contacts);
            self.free_way = free - MARGIN;
        } else {
            self.contacts.clear();
        }
        let limits = self.limits(&speeds, loads, seconds);
        Step { speeds, answer, limits }
    }

    fn rolling(&self, seconds: f64, omega: [f64; 2], loads: &[Load; 2]) -> (Speeds, Answer) {
        let mut m = self.inertia(loads);
        let momentum =
            |i: usize| m[i][0] * omega[0] + m[i][1] * omega[1] + loads[i].torque * seconds;
        let push = [momentum(0), momentum(1)];
        m[0][0] += loads[0].damping * seconds;
        m[1][1] += loads[1].damping * seconds;
        let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let shafts = [
            [m[1][1] / determinant, -m[0][1] / determinant],
            [-m[1][0] / determinant, m[0][0] / determinant],
        ];
        let [left, right] = apply(&shafts, push);
        let answer = Answer { shafts, body: [self.lightness(), 0.0, 0.0] };
        let (ahead, turn) = self.twist([left, right]);
        ([left, right, self.slip, ahead, turn], answer)
    }

    /// The same where only the tires' grip ties the shafts to the body.
    fn spinning(
        &self,
        seconds: f64,
        omega: [f64; 2],
        [ahead, turn]: [f64; 2],
        loads: &[Load; 2],
    ) -> (Speeds, Answer) {
        let shaft = |i: usize| {
            let inertia = loads[i].inertia.max(1e-6);
            let softness = 1.0 / (inertia + loads[i].damping * seconds);
            (softness * (inertia * omega[i] + loads[i].torque * seconds), softness)
        };
        let ((left, soft_left), (right, soft_right)) = (shaft(0), shaft(1));
        let answer = Answer {
            shafts: [[soft_left, 0.0], [0.0, soft_right]],
            body: [self.lightness(), self.lightness(), 1.0 / self.moment],
        };
        ([left, right, self.slip, ahead, turn], answer)
    }

    /// The impulse on a mass of 1 kg that changes its speed by 1 cm/s is 0.01 N s.
    fn lightness(&self) -> f64 {
        10_000.0 / self.mass
    }

    /// Moves on with the speeds of a step that is solved; the new speeds of the shafts.
    fn finish(
        &mut self,
        step: Step,
        seconds: f64,
        loads: &[Load; 2],
        hull: Hull,
        scene: &Scene,
        hit: &mut impl FnMut(ItemId),
    ) -> [f64; 2] {
        let Step { mut speeds, limits, .. } = step;
        for (speed, load) in speeds.iter_mut().zip(loads) {
            if load.jammed || speed.abs() < REST {
                *speed = 0.0;
            }
        }
        if speeds[2].abs() < NO_SLIP {
            speeds[2] = 0.0;
        }
        if self.spins.is_none() {
            (speeds[3], speeds[4]) = self.twist([speeds[0], speeds[1]]);
        } else if speeds[3].abs() < NO_SLIP && speeds[4].abs() < REST {
            (speeds[3], speeds[4]) = (0.0, 0.0);
        }
        self.report(&limits.touches, hit);
        self.free_way -= way_bound(speeds, hull, seconds);
        if !self.move_on(speeds, seconds, hull, scene) {
            speeds = [0.0; 5];
        }
        self.turn_rate = speeds[4].to_degrees();
        if self.floor.is_some() {
            // These speeds are in the frame of the body. What turns keeps its way over the floor.
            let (sin, cos) = libm::sincos(speeds[4] * seconds);
            let [_, _, aside, ahead, _] = speeds;
            (speeds[2], speeds[3]) = (aside * cos - ahead * sin, aside * sin + ahead * cos);
        }
        self.slip = speeds[2];
        if self.spins.is_some() {
            self.spins = Some([speeds[3], speeds[4]]);
        }
        [speeds[0], speeds[1]]
    }

    /// No point of the hull moves further than this in a tick at its present speeds, in cm.
    fn way_in_a_tick(&self, omega: [f64; 2], hull: Hull) -> f64 {
        let (ahead, turn) = self.spins.map_or_else(|| self.twist(omega), |[a, t]| (a, t));
        way_bound([0.0, 0.0, self.slip, ahead, turn], hull, TICK_SECONDS)
    }

    fn limits(&self, speeds: &Speeds, loads: &[Load; 2], seconds: f64) -> Limits {
        let shaft = |index: usize| {
            let load = &loads[index];
            let most = if load.jammed { f64::INFINITY } else { load.friction * seconds };
            let mut gain = [0.0; 5];
            gain[index] = 1.0;
            Limit::friction(gain, most)
        };
        let grip = TIRE_FRICTION * self.mass * GRAVITY * seconds / 100.0;
        let slips = self.slip != 0.0 || !self.contacts.is_empty() || self.spins.is_some();
        let tires = slips.then(|| Limit::friction([0.0, 0.0, 1.0, 0.0, 0.0], grip));
        let grips = self.spins.map(|_| {
            let half = self.axle / 2.0;
            [
                Limit::friction([self.roll[0], 0.0, 0.0, -1.0, -half], grip / 2.0),
                Limit::friction([0.0, self.roll[1], 0.0, -1.0, half], grip / 2.0),
            ]
        });
        let touch = |contact: &Contact| {
            let gain = self.gain(contact.point, contact.normal);
            let mut push = Limit::push(gain, contact.gap, seconds);
            push.bounce(dot(gain, *speeds), contact.gap, self.bounce, seconds);
            let rub = Limit::friction(self.gain(contact.point, contact.along()), 0.0);
            Touch { push, rub }
        };
        let touches = self.contacts.iter().map(touch).collect();
        let answers = [self.lightness(), 1.0 / self.moment];
        let sole = self.floor.map(|floor| Sole::new(floor, answers, seconds));
        Limits { sole, shafts: [shaft(0), shaft(1)], tires, grips, touches }
    }

    /// How fast a point of the hull moves into a direction.
    fn gain(&self, point: Vec2, into: Vec2) -> Speeds {
        let ahead = heading_vector(self.pose.heading);
        let right = Vec2::new(ahead.y, -ahead.x);
        let arm = point - self.pose.vec2();
        let turns = Vec2::new(arm.y, -arm.x).dot(&into);
        if self.spins.is_some() {
            return [0.0, 0.0, right.dot(&into), ahead.dot(&into), turns];
        }
        let rolls = ahead.dot(&into) / 2.0;
        let turns = turns / self.axle;
        [self.roll[0] * (rolls + turns), self.roll[1] * (rolls - turns), right.dot(&into), 0.0, 0.0]
    }

    /// A collision is counted when an obstacle begins to push back.
    fn report(&mut self, touches: &[Touch], hit: &mut impl FnMut(ItemId)) {
        let near = |id: ItemId| self.contacts.iter().any(|c| c.id == id && c.gap < CONTACT_OVER);
        let mut touching = std::mem::take(&mut self.touching);
        touching.retain(|id| near(*id));
        for (touch, contact) in touches.iter().zip(&self.contacts) {
            if touch.push.impulse > 0.0 && !touching.contains(&contact.id) {
                touching.push(contact.id);
                hit(contact.id);
            }
        }
        self.touching = touching;
    }

    /// Moves along the arc, unless there is no place for it; false then.
    fn move_on(&mut self, speeds: Speeds, seconds: f64, hull: Hull, scene: &Scene) -> bool {
        if speeds.iter().all(|speed| *speed == 0.0) {
            return true;
        }
        let nearest = self.contacts.iter().map(|c| c.gap).fold(f64::INFINITY, f64::min);
        let next = self.after(speeds, seconds);
        if nearest >= 2.0 * SKIN + way_bound(speeds, hull, seconds) {
            self.pose = next;
            return true;
        }
        let enough = nearest.min(SKIN / 2.0);
        // Rounding, and a contact whose direction changes on the way, may lead too near.
        let shorter = [1.0, 0.5, 0.1].map(|share| self.after(speeds, seconds * share));
        let place =
            shorter.into_iter().find_map(|next| self.pushed_away(next, enough, hull, scene));
        self.pose = place.unwrap_or(self.pose);
        place.is_some()
    }

    /// Where it is after this time.
    fn after(&self, speeds: Speeds, seconds: f64) -> Pose {
        let [_, _, aside, ahead, turn] = speeds;
        let turned = turn.to_degrees() * seconds;
        // Wheels follow an arc; a thing goes straight on while it turns.
        let bend = if self.floor.is_some() { 0.0 } else { turned / 2.0 };
        let (sin, cos) = sin_cos(self.pose.heading + bend);
        Pose {
            x: self.pose.x + sin * ahead * seconds + cos * aside * seconds,
            y: self.pose.y + cos * ahead * seconds - sin * aside * seconds,
            heading: self.pose.heading + turned,
        }
    }

    /// A place nearby that is this far from all obstacles.
    fn pushed_away(
        &mut self,
        mut place: Pose,
        enough: f64,
        hull: Hull,
        scene: &Scene,
    ) -> Option<Pose> {
        for _ in 0..PUSHES {
            let free = scene.contacts(hull, &place.frame(), MARGIN, &mut self.contacts);
            if free >= enough {
                let is_free = scene.overlap(hull, &place).is_none();
                return is_free.then_some(place);
            }
            let mut push = Vec2::zeros();
            for contact in &self.contacts {
                let missing = SKIN - (contact.gap + push.dot(&contact.normal));
                push += contact.normal * missing.max(0.0);
            }
            place = Pose { x: place.x + push.x, y: place.y + push.y, ..place };
        }
        None
    }
}

/// No point of the hull moves further than this in this time, in cm.
fn way_bound(speeds: Speeds, hull: Hull, seconds: f64) -> f64 {
    let [_, _, aside, ahead, turn] = speeds;
    (ahead.abs() + aside.abs() + turn.abs() * hull.reach()) * seconds
}
