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
//! shafts as far as they hold.

pub(crate) mod pair;
pub(crate) mod shaft;

use crate::ItemId;
use crate::robot::{RobotSpec, Wheel};
use crate::ticks::TICK_SECONDS;
use crate::world::obstacle::Contact;
use crate::world::scene::Scene;
use ev3_motion::{Pose, Vec2, heading_vector, sin_cos};

/// The hull keeps this far from obstacles, in cm, so that it never quite touches them.
const SKIN: f64 = 0.02;
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
/// Friction between hull and obstacle, as a share of the force between them: plastic on wood or
/// laminate has 0.2 to 0.4.
const WALL_FRICTION: f64 = 0.3;
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

/// Speeds: of the left and the right shaft in rad/s; sideways to the right and ahead in cm/s, and
/// clockwise in rad/s. As a `gain`, how much each of them adds to a speed that is limited. Where
/// the wheels roll, the last two follow from the first, and have no gain.
type Speeds = [f64; 5];

/// How speeds answer an impulse. Only the two shafts act on each other.
struct Answer {
    shafts: [[f64; 2]; 2],
    body: [f64; 3],
}

impl Answer {
    fn of(&self, gain: Speeds) -> Speeds {
        let [left, right] = apply(&self.shafts, [gain[0], gain[1]]);
        let [aside, ahead, turn] = self.body;
        [left, right, aside * gain[2], ahead * gain[3], turn * gain[4]]
    }
}

/// A limit: the impulse that keeps `gain · speeds` at (or above) `target`.
struct Limit {
    gain: Speeds,
    target: f64,
    low: f64,
    high: f64,
    /// Of a friction, the most that it ever gives.
    whole: f64,
    impulse: f64,
}

impl Limit {
    /// The impulse that brings a speed to rest, at most this one.
    fn friction(gain: Speeds, most: f64) -> Limit {
        Limit { gain, target: 0.0, low: -most, high: most, whole: most, impulse: 0.0 }
    }

    /// An obstacle at this distance, in cm, which only pushes.
    fn push(gain: Speeds, gap: f64, seconds: f64) -> Limit {
        let target = (SKIN - gap).min(0.0) / seconds;
        Limit { gain, target, low: 0.0, high: f64::INFINITY, whole: f64::INFINITY, impulse: 0.0 }
    }

    /// Gives the impulse that is missing, and answers by how much that changes the speed.
    fn apply(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let answer = answer.of(self.gain);
        let softness = dot(self.gain, answer);
        let step = self.step(dot(self.gain, *speeds), softness);
        add(speeds, answer, step);
        (step * softness).abs()
    }

    /// The impulse that is missing where the limited speed is this one.
    fn step(&mut self, speed: f64, softness: f64) -> f64 {
        if softness < 1e-12 {
            return 0.0;
        }
        let wanted = self.impulse + (self.target - speed) / softness;
        let impulse = wanted.clamp(self.low, self.high);
        let step = impulse - self.impulse;
        self.impulse = impulse;
        step
    }
}

/// An obstacle that pushes, and rubs while it does.
struct Touch {
    push: Limit,
    rub: Limit,
}

/// A part of a tick: the speeds so far, how they answer, and what limits them.
struct Step {
    speeds: Speeds,
    answer: Answer,
    limits: Limits,
}

/// All limits of a step.
struct Limits {
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
        for touch in &mut self.touches {
            change = change.max(touch.round(|limit| limit.apply(speeds, answer)));
        }
        change
    }
}

impl Touch {
    fn round(&mut self, mut apply: impl FnMut(&mut Limit) -> f64) -> f64 {
        self.rub.high = WALL_FRICTION * self.push.impulse;
        self.rub.low = -self.rub.high;
        let change = apply(&mut self.rub);
        change.max(apply(&mut self.push))
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
        Body {
            pose,
            roll: wheels.map_or([0.0; 2], |wheels| [roll(wheels.left), roll(wheels.right)]),
            axle: wheels.map_or(1.0, |wheels| wheels.axle),
            mass: robot.mass,
            moment: robot.mass * reach_m * reach_m / 2.0,
            turn_rate: 0.0,
            slip: 0.0,
            spins: None,
            free_way: 0.0,
            contacts: Vec::new(),
            touching: Vec::new(),
            bumps: Vec::new(),
        }
    }

    /// Puts the robot somewhere else, at rest.
    pub(crate) fn place(&mut self, pose: Pose) {
        self.pose = pose;
        self.turn_rate = 0.0;
        self.slip = 0.0;
        self.spins = None;
        self.world_changed();
        self.touching.clear();
    }

    /// Something was added or taken away.
    pub(crate) fn world_changed(&mut self) {
        self.free_way = 0.0;
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
        let m = self.inertia(loads);
        let pull = |i: usize| m[i][0] * omega[0] + m[i][1] * omega[1];
        let slipping = self.mass * (self.slip / 100.0).powi(2) / 2.0;
        f64::midpoint(omega[0] * pull(0), omega[1] * pull(1)) + slipping
    }

    /// One tick: the new speeds of the shafts and the new pose. Items that the robot has run
    /// into just now are reported. Near obstacles a fast robot takes the tick in parts.
    pub(crate) fn advance(
        &mut self,
        omega: &mut [f64; 2],
        loads: &[Load; 2],
        robot: &RobotSpec,
        scene: &Scene,
        mut hit: impl FnMut(ItemId),
    ) {
        let way = self.way_in_a_tick(*omega, robot);
        let is_near = way > STRIDE && self.free_way < 2.0 * way;
        let parts = if is_near { (way / STRIDE).ceil() } else { 1.0 };
        let mut part = 0.0;
        while part < parts {
            self.advance_part(TICK_SECONDS / parts, omega, loads, robot, scene, &mut hit);
            part += 1.0;
        }
    }

    fn advance_part(
        &mut self,
        seconds: f64,
        omega: &mut [f64; 2],
        loads: &[Load; 2],
        robot: &RobotSpec,
        scene: &Scene,
        hit: &mut impl FnMut(ItemId),
    ) {
        let mut step = self.begin(seconds, *omega, loads, robot, scene);
        step.limits.solve(&mut step.speeds, &step.answer);
        *omega = self.finish(step, seconds, loads, robot, scene, hit);
    }

    /// The speeds that the motors alone would give, and what limits them.
    fn begin(
        &mut self,
        seconds: f64,
        omega: [f64; 2],
        loads: &[Load; 2],
        robot: &RobotSpec,
        scene: &Scene,
    ) -> Step {
        let (speeds, answer) = match self.spins {
            None => self.rolling(seconds, omega, loads),
            Some(spins) => self.spinning(seconds, omega, spins, loads),
        };
        let way = way_bound(speeds, robot, seconds).max(0.01);
        if self.free_way <= way {
            let frame = self.pose.frame();
            let free = scene.contacts(robot.hull, &frame, MARGIN, &mut self.contacts);
            self.free_way = free - MARGIN;
        } else {
            self.contacts.clear();
        }
        let limits = self.limits(loads, seconds);
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
        robot: &RobotSpec,
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
        self.free_way -= way_bound(speeds, robot, seconds);
        if !self.move_on(speeds, seconds, robot, scene) {
            speeds = [0.0; 5];
        }
        self.slip = speeds[2];
        if self.spins.is_some() {
            self.spins = Some([speeds[3], speeds[4]]);
        }
        self.turn_rate = speeds[4].to_degrees();
        [speeds[0], speeds[1]]
    }

    /// No point of the hull moves further than this in a tick at its present speeds, in cm.
    fn way_in_a_tick(&self, omega: [f64; 2], robot: &RobotSpec) -> f64 {
        let (ahead, turn) = self.spins.map_or_else(|| self.twist(omega), |[a, t]| (a, t));
        way_bound([0.0, 0.0, self.slip, ahead, turn], robot, TICK_SECONDS)
    }

    fn limits(&self, loads: &[Load; 2], seconds: f64) -> Limits {
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
        let touch = |contact: &Contact| Touch {
            push: Limit::push(self.gain(contact.point, contact.normal), contact.gap, seconds),
            rub: Limit::friction(self.gain(contact.point, contact.along()), 0.0),
        };
        let touches = self.contacts.iter().map(touch).collect();
        Limits { shafts: [shaft(0), shaft(1)], tires, grips, touches }
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
    fn move_on(&mut self, speeds: Speeds, seconds: f64, robot: &RobotSpec, scene: &Scene) -> bool {
        if speeds.iter().all(|speed| *speed == 0.0) {
            return true;
        }
        let nearest = self.contacts.iter().map(|c| c.gap).fold(f64::INFINITY, f64::min);
        let next = self.after(speeds, seconds);
        if nearest >= 2.0 * SKIN + way_bound(speeds, robot, seconds) {
            self.pose = next;
            return true;
        }
        let enough = nearest.min(SKIN / 2.0);
        // Rounding, and a contact whose direction changes on the way, may lead too near.
        let shorter = [1.0, 0.5, 0.1].map(|share| self.after(speeds, seconds * share));
        let place =
            shorter.into_iter().find_map(|next| self.pushed_away(next, enough, robot, scene));
        self.pose = place.unwrap_or(self.pose);
        place.is_some()
    }

    /// Where it is after this time.
    fn after(&self, speeds: Speeds, seconds: f64) -> Pose {
        let [_, _, aside, ahead, turn] = speeds;
        let turned = turn.to_degrees() * seconds;
        let (sin, cos) = sin_cos(self.pose.heading + turned / 2.0);
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
        robot: &RobotSpec,
        scene: &Scene,
    ) -> Option<Pose> {
        for _ in 0..PUSHES {
            let free = scene.contacts(robot.hull, &place.frame(), MARGIN, &mut self.contacts);
            if free >= enough {
                let is_free = scene.overlap(robot.hull, &place).is_none();
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

fn apply(matrix: &[[f64; 2]; 2], vector: [f64; 2]) -> [f64; 2] {
    [
        matrix[0][0] * vector[0] + matrix[0][1] * vector[1],
        matrix[1][0] * vector[0] + matrix[1][1] * vector[1],
    ]
}

/// No point of the hull moves further than this in this time, in cm.
fn way_bound(speeds: Speeds, robot: &RobotSpec, seconds: f64) -> f64 {
    let [_, _, aside, ahead, turn] = speeds;
    (ahead.abs() + aside.abs() + turn.abs() * robot.hull.reach()) * seconds
}

fn dot(a: Speeds, b: Speeds) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4]
}

fn add(speeds: &mut Speeds, answer: Speeds, step: f64) {
    for (speed, answer) in speeds.iter_mut().zip(answer) {
        *speed += answer * step;
    }
}
