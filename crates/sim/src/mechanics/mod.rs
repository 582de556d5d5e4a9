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
//! Along their way the wheels hold without limit. Those of a light robot on a smooth table would
//! spin before the motors stall; here a wall stalls them, as it stalls those of a heavy robot.

pub(crate) mod shaft;

use crate::ItemId;
use crate::robot::{RobotSpec, Wheel};
use crate::ticks::TICK_SECONDS;
use crate::world::geometry::{Pose, Vec2, direction, sin_cos};
use crate::world::obstacle::Contact;
use crate::world::scene::Scene;

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

/// Speeds: of the left and the right shaft in rad/s, and sideways to the right in cm/s. As a
/// `gain`, how much each of them adds to a speed that is limited.
type Speeds = [f64; 3];

/// How speeds answer an impulse. Only the two shafts act on each other.
struct Answer {
    shafts: [[f64; 2]; 2],
    sideways: f64,
}

impl Answer {
    fn of(&self, gain: Speeds) -> Speeds {
        let [left, right] = apply(&self.shafts, [gain[0], gain[1]]);
        [left, right, self.sideways * gain[2]]
    }
}

/// A limit: the impulse that keeps `gain · speeds` at (or above) `target`.
struct Limit {
    gain: Speeds,
    target: f64,
    low: f64,
    high: f64,
    impulse: f64,
}

impl Limit {
    /// The impulse that brings a speed to rest, at most this one.
    fn friction(gain: Speeds, most: f64) -> Limit {
        Limit { gain, target: 0.0, low: -most, high: most, impulse: 0.0 }
    }

    /// Gives the impulse that is missing, and answers by how much that changes the speed.
    fn apply(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let answer = answer.of(self.gain);
        let softness = dot(self.gain, answer);
        if softness < 1e-12 {
            return 0.0;
        }
        let wanted = self.impulse + (self.target - dot(self.gain, *speeds)) / softness;
        let impulse = wanted.clamp(self.low, self.high);
        let step = impulse - self.impulse;
        self.impulse = impulse;
        for (speed, answer) in speeds.iter_mut().zip(answer) {
            *speed += answer * step;
        }
        (step * softness).abs()
    }
}

/// An obstacle that pushes, and rubs while it does.
struct Touch {
    push: Limit,
    rub: Limit,
}

/// All limits of a step.
struct Limits {
    shafts: [Limit; 2],
    /// The tires against slipping sideways; `None` if nothing makes them slip.
    tires: Option<Limit>,
    touches: Vec<Touch>,
}

impl Limits {
    /// Finds the impulses by turns (projected Gauss–Seidel). Obstacles come last and win.
    fn solve(&mut self, speeds: &mut Speeds, answer: &Answer) {
        for _ in 0..ROUNDS {
            let mut change: f64 = 0.0;
            for limit in self.shafts.iter_mut().chain(&mut self.tires) {
                change = change.max(limit.apply(speeds, answer));
            }
            for Touch { push, rub } in &mut self.touches {
                rub.high = WALL_FRICTION * push.impulse;
                rub.low = -rub.high;
                change = change.max(rub.apply(speeds, answer));
                change = change.max(push.apply(speeds, answer));
            }
            if change < 1e-9 {
                break;
            }
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
    /// How far the hull may still move before contacts have to be looked for again, in cm.
    free_way: f64,
    contacts: Vec<Contact>,
    touching: Vec<ItemId>,
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
            free_way: 0.0,
            contacts: Vec::new(),
            touching: Vec::new(),
        }
    }

    /// Puts the robot somewhere else, at rest.
    pub(crate) fn place(&mut self, pose: Pose) {
        self.pose = pose;
        self.turn_rate = 0.0;
        self.slip = 0.0;
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
        let way = self.way_bound([omega[0], omega[1], self.slip], robot, TICK_SECONDS);
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
        let mut speeds = [left, right, self.slip];

        let way = self.way_bound(speeds, robot, seconds).max(0.01);
        if self.free_way <= way {
            let frame = self.pose.frame();
            let free = scene.contacts(robot.hull, &frame, MARGIN, &mut self.contacts);
            self.free_way = free - MARGIN;
        } else {
            self.contacts.clear();
        }

        let mut limits = self.limits(loads, seconds);
        // The impulse on a mass of 1 kg that changes its speed by 1 cm/s is 0.01 N s.
        let answer = Answer { shafts, sideways: 10_000.0 / self.mass };
        limits.solve(&mut speeds, &answer);
        for (speed, load) in speeds.iter_mut().zip(loads) {
            if load.jammed || speed.abs() < REST {
                *speed = 0.0;
            }
        }
        if speeds[2].abs() < NO_SLIP {
            speeds[2] = 0.0;
        }
        self.report(&limits.touches, hit);
        self.free_way -= self.way_bound(speeds, robot, seconds);
        if !self.move_on(speeds, seconds, robot, scene) {
            speeds = [0.0; 3];
        }
        *omega = [speeds[0], speeds[1]];
        self.slip = speeds[2];
        self.turn_rate = self.twist(*omega).1.to_degrees();
    }

    /// No point of the hull moves further than this in this time, in cm.
    fn way_bound(&self, speeds: Speeds, robot: &RobotSpec, seconds: f64) -> f64 {
        let (ahead, turn) = self.twist([speeds[0], speeds[1]]);
        (ahead.abs() + speeds[2].abs() + turn.abs() * robot.hull.reach()) * seconds
    }

    fn limits(&self, loads: &[Load; 2], seconds: f64) -> Limits {
        let shaft = |index: usize| {
            let load = &loads[index];
            let most = if load.jammed { f64::INFINITY } else { load.friction * seconds };
            let mut gain = [0.0; 3];
            gain[index] = 1.0;
            Limit::friction(gain, most)
        };
        let slips = self.slip != 0.0 || !self.contacts.is_empty();
        let tires = slips.then(|| {
            let most = TIRE_FRICTION * self.mass * GRAVITY * seconds / 100.0;
            Limit::friction([0.0, 0.0, 1.0], most)
        });
        let ahead = direction(self.pose.heading);
        let right = Vec2::new(ahead.y, -ahead.x);
        // How fast a point of the hull moves into a direction.
        let gain = |point: Vec2, into: Vec2| {
            let arm = point - self.pose.point();
            let rolls = ahead.dot(&into) / 2.0;
            let turns = Vec2::new(arm.y, -arm.x).dot(&into) / self.axle;
            [self.roll[0] * (rolls + turns), self.roll[1] * (rolls - turns), right.dot(&into)]
        };
        let touch = |contact: &Contact| Touch {
            push: Limit {
                gain: gain(contact.point, contact.normal),
                target: (SKIN - contact.gap).min(0.0) / seconds,
                low: 0.0,
                high: f64::INFINITY,
                impulse: 0.0,
            },
            rub: {
                let along = Vec2::new(-contact.normal.y, contact.normal.x);
                Limit::friction(gain(contact.point, along), 0.0)
            },
        };
        let touches = self.contacts.iter().map(touch).collect();
        Limits { shafts: [shaft(0), shaft(1)], tires, touches }
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
        if nearest >= 2.0 * SKIN + self.way_bound(speeds, robot, seconds) {
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
        let (ahead, turn) = self.twist([speeds[0], speeds[1]]);
        let turned = turn.to_degrees() * seconds;
        let (sin, cos) = sin_cos(self.pose.heading + turned / 2.0);
        let aside = speeds[2];
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

fn dot(a: Speeds, b: Speeds) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}
