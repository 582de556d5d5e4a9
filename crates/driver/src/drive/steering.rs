//! Steering along a motion: from where the robot is to how fast it should go and turn.
//!
//! Pure arithmetic, called once each period. The controlled quantities are the
//! distance and the heading of the middle of the axle: a wheel that lags turns
//! the robot, and correcting the heading brings the wheels back together.
//!
//! | gain | value | what it does |
//! |---|---|---|
//! | [`HEADING_GAIN`] | 6 /s | turns back for each radian off the heading |
//! | [`LOOKAHEAD`] | 0.5 s | aims at the path that far ahead when beside it |
//! | [`PLACE_GAIN`] | 4 /s | goes back for each cm that a turn on the spot strays |
//! | [`BRAKING`] | 0.7 | share of the acceleration that slowing down counts on |
//!
//! The motors' own regulator takes some 50 ms to follow; with these gains the
//! loop around it has no overshoot worth mentioning.
pub use crate::course::Leg;
use crate::drive::odometry::Wheels;
use ev3_motion::{Path, Pose, Segment, direction, distance, rounded, wrapped};
use std::collections::VecDeque;
use std::f64::consts::FRAC_PI_2;

/// Rate of turn for each radian off the heading, per second.
const HEADING_GAIN: f64 = 6.0;

/// How far ahead on the path to aim at, as a time.
const LOOKAHEAD: f64 = 0.5;

/// The same at least, in cm.
const NEAREST_AIM: f64 = 3.0;

/// Speed for each cm that a turn on the spot strays, per second.
const PLACE_GAIN: f64 = 4.0;

/// Share of the acceleration that slowing down counts on.
const BRAKING: f64 = 0.7;

/// How far ahead of the robot the motors' speeds are, in seconds.
const LAG: f64 = 0.03;

/// From this far before the end on, in cm, the wheels go to positions.
const LANDING: f64 = 0.4;

/// The same for a turn, in degrees.
const LANDING_TURN: f64 = 2.0;

/// Nearer than this, in cm, is there.
const THERE: f64 = 0.2;

/// Closer than this, in degrees, is in that direction.
const ALIGNED: f64 = 0.3;

/// How often the end of a turn is corrected.
const CORRECTIONS: u32 = 3;

/// How often a turn may swing past its heading. Then the wheels go to positions, however far away:
/// a robot that its motors cannot slow down in time would swing for ever.
const SWINGS: u32 = 6;

/// The end of a turn may stay this far off, in degrees.
const TURN_TOLERANCE: f64 = 0.5;

/// How far off a goal the next move may start and still count from it.
const GOAL_WITHIN: f64 = 1.0;

/// The same in degrees.
const GOAL_ALIGNED: f64 = 1.5;

impl Leg {
    /// How far a wheel rolls at most, in cm, from a pose that is not far away;
    /// infinite if that is not a number.
    pub fn wheels_roll(&self, wheels: &Wheels, from: Pose) -> f64 {
        let turn = |degrees: f64| degrees.to_radians().abs() * wheels.axle() / 2.0;
        let way = |place| distance(from.point(), place);
        let roll = match self {
            Self::Turn(degrees) => turn(*degrees),
            Self::Heading(heading) => turn(heading - from.heading),
            Self::Face(heading) => turn(wrapped(*heading)),
            Self::Towards(place) | Self::To(place) | Self::Reach(place) => way(*place),
            Self::Arc(length, curvature) => length.abs() + turn((length * curvature).to_degrees()),
            Self::Through(places, _) => places.iter().map(|place| way(*place)).sum(),
            Self::Pieces(path) => path.iter().map(Segment::length).sum(),
        };
        if roll.is_nan() { f64::INFINITY } else { roll }
    }
}

/// How fast.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Speed of the faster wheel, in cm/s.
    pub speed: f64,
    /// Of the robot, in cm/s².
    pub acceleration: f64,
}

/// The order to the wheels until the next period.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Order {
    /// Roll at these speeds, in cm/s.
    Roll([f64; 2]),
    /// Roll by these ways, in cm, and hold.
    Land([f64; 2]),
    /// Nothing more.
    Arrived,
}

/// The control of a motion under way.
#[derive(Clone, Debug)]
pub struct Steering {
    wheels: Wheels,
    limits: Limits,
    is_backwards: bool,
    task: Task,
    /// Speed in the robot's own direction, in cm/s.
    speed: f64,
    /// Rate of turn, in radians a second.
    rate: f64,
    /// Where the motion is to end, as far as it has got.
    goal: Pose,
}

#[derive(Clone, Debug)]
enum Task {
    Legs { legs: VecDeque<Leg>, phase: Phase },
    Cruise { speed: f64, rate: f64, heading: Option<f64> },
}

#[derive(Clone, Debug)]
enum Phase {
    /// The next leg is to be begun.
    Next,
    Turning(Turn),
    Following(Way),
}

/// A turn on the spot to a heading.
#[derive(Clone, Copy, Debug)]
struct Turn {
    heading: f64,
    place: [f64; 2],
    corrections: u32,
    /// On which side of the heading the robot is, and how often it came to the other.
    side: f64,
    swings: u32,
}

/// A way along a path.
#[derive(Clone, Debug)]
struct Way {
    path: Vec<Segment>,
    /// The segment on which the robot is, and how far along.
    index: usize,
    along: f64,
    /// The length of what comes after that segment.
    rest: f64,
    /// How fast the robot may be on it, and on the next one, in cm/s.
    fastest: f64,
    fastest_next: Option<f64>,
}

impl Way {
    fn part(&self) -> &Segment {
        &self.path[self.index]
    }
}

/// How far apart points of a course are, in cm.
const COURSE_STEP: f64 = 4.0;

impl Steering {
    /// Points of the way ahead; none on a cruise.
    pub(super) fn course(&self) -> Vec<[f64; 2]> {
        let Task::Legs { legs, phase } = &self.task else {
            return Vec::new();
        };
        let sampled = |segments: &[Segment]| {
            let path = Path::new(segments.to_vec());
            let mut points: Vec<_> =
                path.samples(COURSE_STEP).map(|(_, pose)| pose.point()).collect();
            points.extend(path.segments().last().map(Segment::to));
            points
        };
        let mut points = match phase {
            Phase::Following(way) => sampled(&way.path[way.index..]),
            Phase::Next | Phase::Turning(_) => Vec::new(),
        };
        for leg in legs {
            match leg {
                Leg::To(place) | Leg::Reach(place) => points.push(*place),
                Leg::Through(places, _) => points.extend(places),
                Leg::Pieces(segments) => points.extend(sampled(segments)),
                Leg::Turn(_) | Leg::Heading(_) | Leg::Face(_) | Leg::Towards(_) | Leg::Arc(..) => {}
            }
        }
        points
    }

    /// A motion of several parts, from a robot at rest at `pose`. It counts
    /// from `goal`, where the motion before was to end, if that is near.
    pub fn along(
        wheels: Wheels,
        limits: Limits,
        is_backwards: bool,
        legs: Vec<Leg>,
        (pose, goal): (Pose, Option<Pose>),
    ) -> Self {
        let is_near = |goal: &Pose| {
            distance(goal.point(), pose.point()) < GOAL_WITHIN
                && (goal.heading - pose.heading).abs() < GOAL_ALIGNED
        };
        let goal = goal.filter(is_near).unwrap_or(pose);
        let task = Task::Legs { legs: legs.into(), phase: Phase::Next };
        Self { wheels, limits, is_backwards, task, speed: 0.0, rate: 0.0, goal }
    }

    /// A motion without end: speed in cm/s, rate of turn in degrees a second.
    pub fn cruise(wheels: Wheels, limits: Limits, speed: f64, rate: f64) -> Self {
        let task = Task::Cruise { speed, rate: rate.to_radians(), heading: None };
        let goal = Pose::default();
        Self { wheels, limits, is_backwards: false, task, speed: 0.0, rate: 0.0, goal }
    }

    /// Takes over from another motion that is under way.
    pub fn take_over(&mut self, before: &Self) {
        self.speed = before.speed;
        self.rate = before.rate;
    }

    /// Whether it goes on until it is stopped.
    pub fn is_endless(&self) -> bool {
        matches!(self.task, Task::Cruise { .. })
    }

    /// Where the motion is to end, once it has.
    pub fn goal(&self) -> Option<Pose> {
        (!self.is_endless()).then_some(self.goal)
    }

    /// One period of `seconds`, with the robot at `pose`.
    pub fn step(&mut self, pose: Pose, seconds: f64) -> Order {
        if let Task::Cruise { speed, rate, heading } = self.task {
            return self.cruise_on(pose, seconds, (speed, rate), heading);
        }
        // Each round begins a leg that is not done yet, or finds that it is.
        loop {
            let Task::Legs { legs, phase } = &mut self.task else {
                return Order::Arrived;
            };
            match std::mem::replace(phase, Phase::Next) {
                Phase::Next => match legs.pop_front() {
                    Some(leg) => self.begin(&leg, pose),
                    None => return Order::Arrived,
                },
                Phase::Turning(turn) => return self.turn_on(pose, seconds, turn),
                Phase::Following(way) => return self.follow_on(pose, seconds, way),
            }
        }
    }

    /// The wheels have landed, with the robot at `pose`. The next step begins
    /// the next part; or the order corrects this one.
    pub fn landed(&mut self, pose: Pose) -> Option<Order> {
        self.speed = 0.0;
        self.rate = 0.0;
        let Task::Legs { phase, .. } = &mut self.task else {
            return None;
        };
        if let Phase::Turning(turn) = phase {
            if (turn.heading - pose.heading).abs() > TURN_TOLERANCE
                && turn.corrections < CORRECTIONS
            {
                turn.corrections += 1;
                let turn = *turn;
                return Some(self.land_turn(pose, turn));
            }
        }
        *phase = Phase::Next;
        None
    }

    fn set_phase(&mut self, next: Phase) {
        if let Task::Legs { phase, .. } = &mut self.task {
            *phase = next;
        }
    }

    /// How far the axle is ahead of the robot's reference point, in the direction of travel.
    fn lead(&self) -> f64 {
        if self.is_backwards { -self.wheels.offset } else { self.wheels.offset }
    }

    /// The robot's heading as a direction of travel.
    fn travel(&self, heading: f64) -> f64 {
        if self.is_backwards { heading + 180.0 } else { heading }
    }

    fn begin(&mut self, leg: &Leg, pose: Pose) {
        let phase = match leg.clone() {
            Leg::Turn(degrees) => self.turn_to(self.goal.heading + degrees),
            Leg::Heading(heading) => self.turn_to(heading),
            Leg::Face(heading) => {
                self.turn_to(self.goal.heading + wrapped(heading - self.goal.heading))
            }
            Leg::Towards([x, y]) => {
                if distance(pose.point(), [x, y]) < THERE {
                    return;
                }
                self.goal = pose;
                let aim = self.travel(direction([pose.x, pose.y], [x, y]));
                let turn = wrapped(aim - pose.heading);
                if turn.abs() < ALIGNED {
                    return;
                }
                self.turn_to(pose.heading + turn)
            }
            Leg::To([x, y]) | Leg::Reach([x, y]) => {
                let mut line = Segment::line([pose.x, pose.y], [x, y]);
                if matches!(leg, Leg::Reach(_)) {
                    line = line.with_length((line.length() + self.lead()).max(0.0));
                }
                let turn = wrapped(self.travel(line.start().heading) - pose.heading);
                self.follow(vec![line], pose.heading + turn)
            }
            Leg::Arc(length, curvature) => {
                let start = Pose { heading: self.travel(self.goal.heading), ..self.goal };
                let arc = Segment::arc(start, length, curvature);
                self.follow(vec![arc], self.goal.heading + arc.turn())
            }
            Leg::Through(mut points, radius) => {
                points.insert(0, [pose.x, pose.y]);
                if let [.., before, last] = points.as_mut_slice() {
                    let heading = direction(*before, *last);
                    let end = Pose { x: last[0], y: last[1], heading }.ahead(self.lead());
                    *last = [end.x, end.y];
                }
                let mut pieces = rounded(&points, radius);
                let Some(last) = pieces.pop() else {
                    return;
                };
                // Pieces but the last end in corners that are turned on the spot.
                let mut first = Vec::new();
                for piece in pieces.into_iter().chain([last]) {
                    if let Some(start) = piece.first() {
                        first.push(self.turn_before(start));
                    }
                    first.push(Leg::Pieces(piece));
                }
                let Task::Legs { legs, .. } = &mut self.task else {
                    return;
                };
                for leg in first.into_iter().rev() {
                    legs.push_front(leg);
                }
                return;
            }
            Leg::Pieces(path) => {
                let Some(first) = path.first() else {
                    return;
                };
                let turn = wrapped(self.travel(first.start().heading) - pose.heading);
                let turns = path.iter().map(Segment::turn);
                let heading = pose.heading + turn + turns.sum::<f64>();
                self.follow(path, heading)
            }
        };
        self.set_phase(phase);
    }

    /// The turn on the spot before a segment: towards the end of a line; the end of
    /// an arc, or of a line that is hardly one, says nothing of where it begins.
    fn turn_before(&self, segment: &Segment) -> Leg {
        let end = segment.end();
        if segment.curvature() == 0.0 && segment.length() >= THERE {
            Leg::Towards([end.x, end.y])
        } else {
            Leg::Face(self.travel(segment.start().heading))
        }
    }

    fn turn_to(&mut self, heading: f64) -> Phase {
        self.goal.heading = heading;
        let place = [self.goal.x, self.goal.y];
        Phase::Turning(Turn { heading, place, corrections: 0, side: 0.0, swings: 0 })
    }

    /// A path that ends with that heading of the robot.
    fn follow(&mut self, path: Vec<Segment>, heading: f64) -> Phase {
        if let Some(last) = path.last() {
            self.goal = Pose { heading, ..last.end() };
        }
        Phase::Following(self.way_from(path, 0))
    }

    fn turn_on(&mut self, pose: Pose, seconds: f64, mut turn: Turn) -> Order {
        let off = turn.heading - pose.heading;
        let side = off.signum();
        turn.swings += u32::from(side * turn.side < 0.0);
        turn.side = side;
        self.set_phase(Phase::Turning(turn));
        let is_slow = self.speed.abs() < 2.0;
        if off.abs() < LANDING_TURN && is_slow && self.rate.abs() < 2.0 || turn.swings > SWINGS {
            return self.land_turn(pose, turn);
        }
        let half_axle = self.wheels.axle() / 2.0;
        let acceleration = self.limits.acceleration / half_axle;
        let left = (off.to_radians() - self.rate * LAG).abs();
        let most = libm::sqrt(2.0 * BRAKING * acceleration * left);
        let wanted = off.signum() * most.min(self.limits.speed / half_axle);
        self.rate = approach(self.rate, wanted, 1.5 * acceleration * seconds);
        let back = (-PLACE_GAIN * strayed(pose, turn.place)).clamp(-5.0, 5.0);
        self.speed = approach(self.speed, back, self.limits.acceleration * seconds);
        Order::Roll(self.ways())
    }

    fn land_turn(&self, pose: Pose, turn: Turn) -> Order {
        let off = (turn.heading - pose.heading).to_radians();
        let back = -strayed(pose, turn.place);
        let back = if back.abs() < GOAL_WITHIN { back } else { 0.0 };
        Order::Land(self.wheels.ways(back, off))
    }

    fn follow_on(&mut self, pose: Pose, seconds: f64, mut way: Way) -> Order {
        let sign = if self.is_backwards { -1.0 } else { 1.0 };
        // Where the robot is when the motors have followed. What they are commanded now counts from
        // there.
        let soon = pose.along_arc(self.speed * LAG, (self.rate * LAG).to_degrees());
        let mut place = way.part().locate(soon.point(), way.along);
        while place.along > way.part().length() && way.index + 1 < way.path.len() {
            let beyond = place.along - way.part().length();
            way = self.way_from(way.path, way.index + 1);
            place = way.part().locate(soon.point(), beyond);
        }
        way.along = place.along;
        let part = *way.part();
        let left = way.rest + part.length() - way.along;
        if left < LANDING && way.index + 1 == way.path.len() {
            let left = part.length() - part.locate(pose.point(), way.along).along;
            let turn = (self.goal.heading - pose.heading).to_radians();
            self.set_phase(Phase::Following(way));
            return Order::Land(self.wheels.ways(left * sign, turn));
        }
        let braking = 2.0 * BRAKING * self.limits.acceleration;
        let to_the_end = braked(way.fastest, braking * left.max(0.0));
        let mut most = way.fastest.min(to_the_end.max(2.0));
        if let Some(limit) = way.fastest_next {
            // Slow down for a tighter part before it comes.
            let room = (part.length() - way.along).max(0.0);
            most = braked(most, limit * limit + braking * room);
        }
        let step = self.limits.acceleration * seconds;
        let speed = self.speed * sign;
        let speed = approach(speed, most, step).min(most.max(speed - 1.5 * step));
        let ahead = place.along.clamp(0.0, part.length());
        let radius = part.radius().map_or(f64::INFINITY, f64::abs);
        let aim = (speed * LOOKAHEAD).max(NEAREST_AIM).min(radius);
        let back = (place.aside / aim).clamp(-FRAC_PI_2, FRAC_PI_2);
        let tangent = self.travel(part.heading_at(ahead));
        let off = wrapped(tangent - back.to_degrees() - soon.heading).to_radians();
        self.speed = speed * sign;
        self.rate = speed * part.curvature() + HEADING_GAIN * off;
        self.set_phase(Phase::Following(way));
        Order::Roll(self.ways())
    }

    /// The way along a path from the start of one of its segments.
    fn way_from(&self, path: Vec<Segment>, index: usize) -> Way {
        let fastest = self.fastest_on(&path[index]);
        let fastest_next = path.get(index + 1).map(|next| self.fastest_on(next));
        let rest = path.iter().skip(index + 1).map(Segment::length).sum();
        Way { path, index, along: 0.0, rest, fastest, fastest_next }
    }

    /// The speed on a segment, where the outer wheel is to be no faster than it may.
    fn fastest_on(&self, part: &Segment) -> f64 {
        if part.curvature() == 0.0 {
            return self.limits.speed;
        }
        self.limits.speed / (1.0 + part.curvature().abs() * self.wheels.axle() / 2.0)
    }

    fn cruise_on(
        &mut self,
        pose: Pose,
        seconds: f64,
        (speed, rate): (f64, f64),
        held: Option<f64>,
    ) -> Order {
        let half_axle = self.wheels.axle() / 2.0;
        let acceleration = self.limits.acceleration;
        self.speed = approach(self.speed, speed, acceleration * seconds);
        self.rate = approach(self.rate, rate, 2.0 * acceleration / half_axle * seconds);
        // The heading that the robot should have by now; not farther away than can be made up for.
        let held = held.unwrap_or(pose.heading) + (self.rate * seconds).to_degrees();
        let held = pose.heading + (held - pose.heading).clamp(-15.0, 15.0);
        self.task = Task::Cruise { speed, rate, heading: Some(held) };
        let off = (held - pose.heading).to_radians() - self.rate * 2.0 * LAG;
        let turning = self.rate + HEADING_GAIN / 2.0 * off;
        Order::Roll(self.wheels.ways(self.speed, turning))
    }

    fn ways(&self) -> [f64; 2] {
        self.wheels.ways(self.speed, self.rate)
    }
}

/// How far ahead of a place the robot is.
fn strayed(pose: Pose, [x, y]: [f64; 2]) -> f64 {
    let (sin, cos) = libm::sincos(pose.heading.to_radians());
    (pose.x - x) * sin + (pose.y - y) * cos
}

/// A speed, or that of the given square if it is less. The compiler would take the
/// standard library's root in either case; the brick has to work it out.
fn braked(speed: f64, square: f64) -> f64 {
    if square < speed * speed { libm::sqrt(square) } else { speed }
}

/// A value on its way to another one, by at most `step`.
fn approach(value: f64, wanted: f64, step: f64) -> f64 {
    value + (wanted - value).clamp(-step, step)
}
