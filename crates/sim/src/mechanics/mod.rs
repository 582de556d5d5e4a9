//! The mechanics: two wheels, the body they carry, and what stops them.
//!
//! The speeds of the two motor shafts are the only coordinates; wheels roll and do not slide
//! sideways. Motors push through their back-EMF, which is taken implicitly so that no step is too
//! long. Friction, a jammed wheel and an obstacle are limits: each gives the impulse that it needs
//! and not more (friction at most its torque, an obstacle only pushes). So a robot at a wall
//! stops its own motors, and a motor too weak for its friction does not creep.

pub(crate) mod shaft;

use crate::robot::{RobotSpec, Wheel};
use crate::world::geometry::{Pose, Vec2, sin_cos};
use crate::world::obstacle::Contact;
use crate::world::scene::Scene;
use crate::{ItemId, TICK_SECONDS};

/// The hull keeps this far from obstacles, in cm, so that it never quite touches them.
const SKIN: f64 = 0.02;
/// Contacts nearer than this take part in the mechanics, in cm.
const MARGIN: f64 = 1.0;
/// A contact is over when the hull is this far off again, in cm.
const CONTACT_OVER: f64 = 0.5;
/// Slower than this is standing still, in rad/s: what the solver leaves of a wheel at rest.
const REST: f64 = 1e-7;
const ROUNDS: usize = 16;

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

/// A limit: the impulse that keeps `gain · omega` at (or above) `target`.
struct Limit {
    gain: [f64; 2],
    target: f64,
    low: f64,
    high: f64,
    impulse: f64,
}

/// The body on its wheels.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) pose: Pose,
    /// Way of a wheel's contact point per rad of its motor, in cm.
    roll: [f64; 2],
    axle: f64,
    mass: f64,
    /// Moment of inertia around the middle of the axle, kg m².
    moment: f64,
    /// Degrees per second, clockwise.
    pub(crate) turn_rate: f64,
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
        Body {
            pose,
            roll: [roll(robot.left), roll(robot.right)],
            axle: robot.axle,
            mass: robot.mass,
            moment: robot.mass * reach_m * reach_m / 2.0,
            turn_rate: 0.0,
            free_way: 0.0,
            contacts: Vec::new(),
            touching: Vec::new(),
        }
    }

    /// Puts the robot somewhere else, at rest.
    pub(crate) fn place(&mut self, pose: Pose) {
        self.pose = pose;
        self.turn_rate = 0.0;
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
        f64::midpoint(omega[0] * pull(0), omega[1] * pull(1))
    }

    /// One tick: the new speeds of the shafts and the new pose. Items that the robot has run
    /// into just now are reported.
    pub(crate) fn advance(
        &mut self,
        omega: &mut [f64; 2],
        loads: &[Load; 2],
        robot: &RobotSpec,
        scene: &Scene,
        mut hit: impl FnMut(ItemId),
    ) {
        let mut m = self.inertia(loads);
        let momentum =
            |i: usize| m[i][0] * omega[0] + m[i][1] * omega[1] + loads[i].torque * TICK_SECONDS;
        let push = [momentum(0), momentum(1)];
        m[0][0] += loads[0].damping * TICK_SECONDS;
        m[1][1] += loads[1].damping * TICK_SECONDS;
        let determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
        let inverse = [
            [m[1][1] / determinant, -m[0][1] / determinant],
            [-m[1][0] / determinant, m[0][0] / determinant],
        ];
        *omega = apply(&inverse, push);

        let frame = self.pose.frame();
        let reach = robot.hull.reach();
        let way = self.way_bound(*omega, reach).max(0.01);
        if self.free_way <= way {
            let free = scene.contacts(robot.hull, &frame, MARGIN, &mut self.contacts);
            self.free_way = free - MARGIN;
        } else {
            self.contacts.clear();
        }

        let mut limits = self.limits(loads);
        solve(omega, &inverse, &mut limits);
        for (omega, load) in omega.iter_mut().zip(loads) {
            if load.jammed || omega.abs() < REST {
                *omega = 0.0;
            }
        }
        self.report(&limits[2..], &mut hit);
        self.free_way -= self.way_bound(*omega, reach);
        self.roll_on(omega, robot, scene);
    }

    /// No point of the hull moves further than this in a tick, in cm.
    fn way_bound(&self, omega: [f64; 2], reach: f64) -> f64 {
        let (ahead, turn) = self.twist(omega);
        (ahead.abs() + turn.abs() * reach) * TICK_SECONDS
    }

    /// The limits of this tick: two for the shafts, then one for each contact.
    fn limits(&self, loads: &[Load; 2]) -> Vec<Limit> {
        let shaft = |index: usize| {
            let load = &loads[index];
            let most = if load.jammed { f64::INFINITY } else { load.friction * TICK_SECONDS };
            let mut gain = [0.0; 2];
            gain[index] = 1.0;
            Limit { gain, target: 0.0, low: -most, high: most, impulse: 0.0 }
        };
        let (sin, cos) = sin_cos(self.pose.heading);
        let contact = |contact: &Contact| {
            let arm = contact.point - self.pose.point();
            let ahead = Vec2::new(sin, cos).dot(&contact.normal) / 2.0;
            let turn = Vec2::new(arm.y, -arm.x).dot(&contact.normal) / self.axle;
            Limit {
                gain: [self.roll[0] * (ahead + turn), self.roll[1] * (ahead - turn)],
                target: (SKIN - contact.gap).min(0.0) / TICK_SECONDS,
                low: 0.0,
                high: f64::INFINITY,
                impulse: 0.0,
            }
        };
        let mut limits = Vec::with_capacity(2 + self.contacts.len());
        limits.extend([shaft(0), shaft(1)]);
        limits.extend(self.contacts.iter().map(contact));
        limits
    }

    /// A collision is counted when an obstacle begins to push back.
    fn report(&mut self, limits: &[Limit], hit: &mut impl FnMut(ItemId)) {
        let near = |id: ItemId| self.contacts.iter().any(|c| c.id == id && c.gap < CONTACT_OVER);
        let mut touching = std::mem::take(&mut self.touching);
        touching.retain(|id| near(*id));
        for (limit, contact) in limits.iter().zip(&self.contacts) {
            if limit.impulse > 0.0 && !touching.contains(&contact.id) {
                touching.push(contact.id);
                hit(contact.id);
            }
        }
        self.touching = touching;
    }

    /// Moves along the arc. Should rounding lead deeper into an obstacle, it does not move.
    fn roll_on(&mut self, omega: &mut [f64; 2], robot: &RobotSpec, scene: &Scene) {
        let (ahead, turn) = self.twist(*omega);
        self.turn_rate = turn.to_degrees();
        if ahead == 0.0 && turn == 0.0 {
            return;
        }
        let turned = self.turn_rate * TICK_SECONDS;
        let (sin, cos) = sin_cos(self.pose.heading + turned / 2.0);
        let next = Pose {
            x: self.pose.x + sin * ahead * TICK_SECONDS,
            y: self.pose.y + cos * ahead * TICK_SECONDS,
            heading: self.pose.heading + turned,
        };
        let nearest = self.contacts.iter().map(|c| c.gap).fold(f64::INFINITY, f64::min);
        if nearest < 2.0 * SKIN {
            let free = scene.contacts(robot.hull, &next.frame(), MARGIN, &mut self.contacts);
            if free < nearest && free < SKIN / 2.0 {
                *omega = [0.0; 2];
                self.turn_rate = 0.0;
                return;
            }
        }
        self.pose = next;
    }
}

fn apply(matrix: &[[f64; 2]; 2], vector: [f64; 2]) -> [f64; 2] {
    [
        matrix[0][0] * vector[0] + matrix[0][1] * vector[1],
        matrix[1][0] * vector[0] + matrix[1][1] * vector[1],
    ]
}

/// Finds the impulses by turns (projected Gauss–Seidel); contacts come last and win.
fn solve(omega: &mut [f64; 2], inverse: &[[f64; 2]; 2], limits: &mut [Limit]) {
    for _ in 0..ROUNDS {
        let mut change: f64 = 0.0;
        for limit in &mut *limits {
            let answer = apply(inverse, limit.gain);
            let softness = limit.gain[0] * answer[0] + limit.gain[1] * answer[1];
            if softness < 1e-12 {
                continue;
            }
            let speed = limit.gain[0] * omega[0] + limit.gain[1] * omega[1];
            let wanted = limit.impulse + (limit.target - speed) / softness;
            let impulse = wanted.clamp(limit.low, limit.high);
            let step = impulse - limit.impulse;
            limit.impulse = impulse;
            omega[0] += answer[0] * step;
            omega[1] += answer[1] * step;
            change = change.max((step * softness).abs());
        }
        if change < 1e-12 {
            break;
        }
    }
}
