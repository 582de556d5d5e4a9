//! The pose of a robot on two wheels, from its encoders and its gyro.
//!
//! Pure arithmetic: no devices, no clock. Between two samples both wheels are assumed to turn
//! evenly, so that the robot moves along an arc, and that arc is integrated exactly. An extended
//! Kalman filter fuses this with the gyro. Its state is the pose, the relative errors of the given
//! wheel diameters and axle length, and the gyro's zero and drift. A late gyro reading corrects the
//! heading and, through the covariance, the position too.
//!
//! The errors of wheels and axle persist: a wheel that slips or a wide tire makes each turn wrong
//! by the same share. So over long turns the gyro is right, and the difference is not drift.
//!
//! A gyro reports whole degrees. A reading is therefore not treated as a value with a Gaussian
//! error, but as an interval that contains the true value plus a Gaussian error: the measurement is
//! the mean and variance of the predicted distribution truncated to that interval. Consecutive
//! readings at rest share their error, so only one every 100 ms counts.
use ev3_motion::{Pose, sinc};

/// Half of a gyro's resolution, in radians.
const HALF_STEP: f64 = 0.5 * DEGREE;

/// Standard deviation of a gyro's reading beside its resolution, in radians; with
/// that of the encoders, with which it is compared.
const GYRO_ERROR: f64 = 0.28 * DEGREE;

/// How far in time readings of gyro and wheels may lie apart, in seconds.
const LAG: f64 = 0.01;

/// The time from a reading that counts to the next, in seconds, at rest.
const READ_EVERY: f64 = 0.1;

/// The same as a way in cm and a turn in radians.
const READ_AFTER: f64 = 0.25;

/// The time, in seconds, for which the covariance may lag behind the pose. Its
/// arithmetic is most of the filter's, and the brick's processor does it in software.
const SETTLE_EVERY: f64 = 0.03;

/// Variance of a wheel's way for each cm, in cm²: 2 mm after a meter.
const WHEEL_VARIANCE: f64 = 0.0004;

/// Variance of the heading for each cm, in radians²: 0.15 degrees after a meter,
/// from wheels that slip now and then.
const HEADING_VARIANCE: f64 = 2e-4 * DEGREE * DEGREE;

/// The same for each radian of a turn: 0.13 degrees after a quarter turn.
const TURN_VARIANCE: f64 = 0.01 * DEGREE * DEGREE;

/// Standard deviation of a wheel's way when it starts to roll, in cm, from teeth
/// of the encoder and play of the gears: a third of a degree of the motor.
const START: f64 = 0.0175;

/// The standstill, in seconds, after which a wheel counts as starting again.
const STILL: f64 = 0.1;

/// Standard deviation of the relative error of a wheel's diameter: one rolls 1 %
/// more than the other.
const WHEEL: f64 = 0.0075;

/// The same for the axle length: where a wide tire touches the floor is unknown.
const AXLE_LENGTH: f64 = 0.03;

/// How that may change, with the floor for one: variance for each radian.
const AXLE_CHANGE: f64 = 0.0005 * 0.0005;

/// Standard deviation of a gyro's drift, in radians a second: that of one that
/// stood still when it was plugged in.
const DRIFT: f64 = 0.03 * DEGREE;

/// The same of one that did not, and shows so while the robot rests.
const WILD_DRIFT: f64 = 2.0 * DEGREE;

/// The gyro drifts wildly if the sum of its errors at rest exceeds this, in
/// standard deviations for the square root of the number of readings. A smaller
/// limit would be exceeded by chance during a long run.
const SUSPICIOUS: f64 = 4.0;

/// How fast the drift may change: variance of the drift for each second.
const DRIFT_CHANGE: f64 = (0.001 * DEGREE) * (0.001 * DEGREE);

/// A reading that is farther off than this, in radians, comes from a gyro that
/// restarted with another zero.
const JUMP: f64 = 12.0 * DEGREE;

/// A degree in radians.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

// The state.
const X: usize = 0;
const Y: usize = 1;
const HEADING: usize = 2;
/// The relative error of each wheel's diameter.
const LEFT: usize = 3;
const RIGHT: usize = 4;
/// The relative error of turns, from the axle length.
const AXLE: usize = 5;
/// The gyro's reading at heading 0.
const ZERO: usize = 6;
const RATE: usize = 7;
const STATES: usize = 8;

/// The geometry of the robot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels {
    /// Diameter of the left and the right wheel, in cm.
    pub diameters: [f64; 2],
    /// Whether the left and the right motor are mounted the other way round.
    pub inverted: [bool; 2],
    /// Distance between the middles of their treads, in cm.
    axle: f64,
    /// 1 / axle, kept because a division is dear.
    per_axle: f64,
    /// The distance of the axle ahead of the robot's reference point, in cm.
    pub offset: f64,
}

impl Wheels {
    /// Wheels, each value as its field has it.
    pub const fn new(diameters: [f64; 2], inverted: [bool; 2], axle: f64, offset: f64) -> Self {
        Self { diameters, inverted, axle, per_axle: 1.0 / axle, offset }
    }

    /// Distance between the middles of their treads, in cm.
    pub fn axle(&self) -> f64 {
        self.axle
    }

    /// Cm that a wheel rolls for each count of its motor, with its sign.
    pub fn cm_per_count(&self, side: usize, counts_per_rotation: f64) -> f64 {
        let way = std::f64::consts::PI * self.diameters[side] / counts_per_rotation;
        if self.inverted[side] { -way } else { way }
    }

    /// Way in cm and turn in radians from the ways of both wheels.
    pub fn twist(&self, [left, right]: [f64; 2]) -> (f64, f64) {
        (f64::midpoint(left, right), (left - right) * self.per_axle)
    }

    /// The ways of both wheels from way in cm and turn in radians.
    pub fn ways(&self, way: f64, turn: f64) -> [f64; 2] {
        let half = turn * self.axle * 0.5;
        [way + half, way - half]
    }
}

/// The gyro's readings since the robot came to rest.
#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    /// The sum of the errors, in standard deviations, and the number of readings.
    off: f64,
    count: f64,
    /// The drift and its variance before the rest.
    drift: f64,
    variance: f64,
}

/// The estimate.
#[derive(Clone, Debug)]
pub struct Estimate {
    state: [f64; STATES],
    covariance: [[f32; STATES]; STATES],
    has_zero: bool,
    rest: Rest,
    /// For how long the wheels have not rolled, in seconds.
    still: f64,
    /// Time, way and turn since the last reading of the gyro that counted.
    unread: [f64; 3],
    unsettled: Unsettled,
}

/// What is in the state, but not in the covariance yet: time, the ways of the wheels
/// and the turn by them, where they took the robot and in which direction at last, how
/// far they rolled and the robot turned in all, and whether they started to.
#[derive(Clone, Copy, Debug, Default)]
struct Unsettled {
    seconds: f64,
    ways: [f64; 2],
    by_wheels: f64,
    place: [f64; 2],
    direction: [f64; 2],
    rolled: f64,
    turned: f64,
    starts: bool,
}

impl Default for Estimate {
    fn default() -> Self {
        Self::at(Pose::default())
    }
}

impl Estimate {
    /// A robot that is known to be at a pose, that of the middle of its axle.
    pub fn at(pose: Pose) -> Self {
        let mut estimate = Self {
            state: [0.0; STATES],
            covariance: [[0.0; STATES]; STATES],
            has_zero: false,
            rest: Rest::default(),
            still: STILL,
            unread: [0.0; 3],
            unsettled: Unsettled::default(),
        };
        estimate.covariance[RATE][RATE] = short(DRIFT * DRIFT);
        estimate.begin_rest();
        estimate.forget_wheels();
        estimate.set_pose(pose);
        estimate
    }

    /// Sets the pose. The estimates for wheels and gyro stay.
    pub fn set_pose(&mut self, pose: Pose) {
        let turned = pose.heading.to_radians() - self.state[HEADING];
        self.state[X] = pose.x;
        self.state[Y] = pose.y;
        self.state[HEADING] = pose.heading.to_radians();
        self.state[ZERO] -= turned;
        self.unsettled = Unsettled::default();
        self.reset_certainty([X, Y, HEADING]);
    }

    /// Resets the estimated errors of wheels and axle: the wheels are others, or
    /// the gyro is no longer used.
    pub fn forget_wheels(&mut self) {
        let errors = [LEFT, RIGHT, AXLE];
        self.reset_certainty(errors);
        for (error, deviation) in errors.into_iter().zip([WHEEL, WHEEL, AXLE_LENGTH]) {
            self.state[error] = 0.0;
            self.covariance[error][error] = short(deviation * deviation);
        }
    }

    fn reset_certainty<const N: usize>(&mut self, states: [usize; N]) {
        for known in states {
            for other in 0..STATES {
                self.covariance[known][other] = 0.0;
                self.covariance[other][known] = 0.0;
            }
        }
    }

    /// The pose of the middle of the axle.
    pub fn pose(&self) -> Pose {
        let [x, y, heading, ..] = self.state;
        Pose { x, y, heading: heading.to_degrees() }
    }

    /// Covariance of x, y and heading, in cm and degrees.
    pub fn uncertainty(&self) -> [[f64; 3]; 3] {
        let unit = [1.0, 1.0, 1.0 / DEGREE];
        std::array::from_fn(|i| {
            std::array::from_fn(|j| f64::from(self.covariance[i][j]) * unit[i] * unit[j])
        })
    }

    /// The gyro's drift, in degrees a second.
    pub fn drift(&self) -> f64 {
        self.state[RATE].to_degrees()
    }

    /// The prediction step: the wheels have rolled `ways` cm within `seconds`.
    pub fn predict(&mut self, wheels: &Wheels, ways: [f64; 2], seconds: f64) {
        self.state[ZERO] += self.state[RATE] * seconds;
        self.unread[0] += seconds;
        self.unsettled.seconds += seconds;
        if ways == [0.0, 0.0] {
            self.still += seconds;
        } else {
            self.roll(wheels, ways);
        }
        if self.unsettled.seconds >= SETTLE_EVERY {
            self.settle(wheels);
        }
    }

    /// The robot goes along an arc.
    fn roll(&mut self, wheels: &Wheels, ways: [f64; 2]) {
        let [left, right] = ways;
        let stretched = [left + left * self.state[LEFT], right + right * self.state[RIGHT]];
        let (way, by_wheels) = wheels.twist(stretched);
        let turn = by_wheels + by_wheels * self.state[AXLE];
        let half = turn * 0.5;
        let (sin, cos) = libm::sincos(self.state[HEADING] + half);
        let chord = way * sinc(half);
        let (x, y) = (chord * sin, chord * cos);
        self.state[X] += x;
        self.state[Y] += y;
        self.state[HEADING] += turn;
        let (rolled, turned) = (left.abs() + right.abs(), turn.abs());
        self.unread[1] += rolled * 0.5;
        self.unread[2] += turned;
        let unsettled = &mut self.unsettled;
        unsettled.starts |= std::mem::replace(&mut self.still, 0.0) >= STILL;
        unsettled.rolled += rolled;
        unsettled.turned += turned;
        unsettled.ways[0] += left;
        unsettled.ways[1] += right;
        unsettled.by_wheels += by_wheels;
        unsettled.place[0] += x;
        unsettled.place[1] += y;
        unsettled.direction = [sin, cos];
    }

    /// Brings the covariance up to date with the state, as if what was rolled since
    /// the last time was one arc.
    fn settle(&mut self, wheels: &Wheels) {
        let unsettled = std::mem::take(&mut self.unsettled);
        self.settle_zero(short(unsettled.seconds));
        if unsettled.rolled == 0.0 {
            return;
        }
        // How the turn, half of which shifts the place, and the way depend on the
        // errors of the wheels and the axle; and the place on the heading.
        let per_axle = (1.0 + self.state[AXLE]) * wheels.per_axle;
        let [left, right] = unsettled.ways;
        let of_turn = [left * per_axle, -right * per_axle, unsettled.by_wheels].map(short);
        let of_way = [left * 0.5, right * 0.5].map(short);
        let [x, y] = unsettled.place;
        let place = [short(y), short(-x)];
        let direction = unsettled.direction.map(short);
        self.propagate(of_turn, of_way, place, direction);
        // The noise of a step: along the path, and of the turn.
        let mut along = WHEEL_VARIANCE / 4.0 * unsettled.rolled;
        let mut turning =
            HEADING_VARIANCE / 2.0 * unsettled.rolled + TURN_VARIANCE * unsettled.turned;
        if unsettled.starts {
            along += START * START / 2.0;
            turning += 2.0 * START * START * (wheels.per_axle * wheels.per_axle);
        }
        self.inflate(direction, place, short(along), short(turning));
        self.covariance[AXLE][AXLE] += short(AXLE_CHANGE * unsettled.turned);
    }

    /// The gyro's zero follows its drift.
    fn settle_zero(&mut self, seconds: f32) {
        let rate = self.covariance[RATE];
        let row = &mut self.covariance[ZERO];
        for i in 0..STATES {
            row[i] += seconds * rate[i];
        }
        row[ZERO] += seconds * row[RATE];
        self.mirror(ZERO);
        self.covariance[RATE][RATE] += short(DRIFT_CHANGE) * seconds;
    }

    /// The covariance after a step: the turn by its factors of the errors of the
    /// left wheel, the right one and the axle, the way by those of the wheels, the
    /// place by that of the heading, and the direction in which the robot went.
    #[expect(clippy::needless_range_loop, reason = "the index is that of a column")]
    fn propagate(
        &mut self,
        of_turn: [f32; 3],
        of_way: [f32; 2],
        place: [f32; 2],
        [sin, cos]: [f32; 2],
    ) {
        // What a row or a column adds to those of x, y and heading.
        let added = |left: f32, right: f32, axle: f32, heading: f32| {
            let turn = of_turn[0] * left + of_turn[1] * right + of_turn[2] * axle;
            let way = of_way[0] * left + of_way[1] * right;
            let middle = heading + 0.5 * turn;
            [place[0] * middle + sin * way, place[1] * middle + cos * way, turn]
        };
        let p = &mut self.covariance;
        for i in 0..STATES {
            let [x, y, heading] = added(p[LEFT][i], p[RIGHT][i], p[AXLE][i], p[HEADING][i]);
            p[X][i] += x;
            p[Y][i] += y;
            p[HEADING][i] += heading;
        }
        for row in [X, Y, HEADING] {
            let p = &mut self.covariance[row];
            let [x, y, heading] = added(p[LEFT], p[RIGHT], p[AXLE], p[HEADING]);
            p[X] += x;
            p[Y] += y;
            p[HEADING] += heading;
        }
        for row in [X, Y, HEADING] {
            self.mirror(row);
        }
    }

    /// The column of a state becomes its row.
    fn mirror(&mut self, state: usize) {
        for other in 0..STATES {
            self.covariance[other][state] = self.covariance[state][other];
        }
    }

    /// Adds an error along a direction, and one of the heading, half of which shifts the place.
    fn inflate(&mut self, direction: [f32; 2], place: [f32; 2], along: f32, turning: f32) {
        let p = &mut self.covariance;
        let half = [place[0] * 0.5, place[1] * 0.5];
        for i in [X, Y] {
            let (ahead, aside) = (direction[i] * along, half[i] * turning);
            for j in i..=Y {
                p[i][j] += ahead * direction[j] + aside * half[j];
            }
            p[i][HEADING] += aside;
            p[HEADING][i] = p[i][HEADING];
        }
        p[Y][X] = p[X][Y];
        p[HEADING][HEADING] += turning;
    }

    /// The measurement step: the gyro shows `angle` degrees.
    pub fn observe_gyro(&mut self, angle: f64) {
        let angle = angle * DEGREE;
        let off = angle - self.state[HEADING] - self.state[ZERO];
        if !self.has_zero || off.abs() > JUMP + WILD_DRIFT * self.unread[0] {
            self.zero_at(angle);
            return;
        }
        let [seconds, way, turn] = self.unread;
        if self.unsettled.seconds > 0.0 {
            return;
        }
        if seconds < READ_EVERY && way < READ_AFTER && turn < HALF_STEP {
            return;
        }
        self.unread = [0.0; 3];
        let row = self.sum_of([HEADING, ZERO]);
        let late = if seconds > LAG { LAG * turn / seconds } else { turn };
        let error = short(GYRO_ERROR * GYRO_ERROR + late * late);
        let total = row[HEADING] + row[ZERO] + error;
        let deviation = libm::sqrtf(total);
        let (shift, narrowed) = within(short(off), deviation);
        let certainty = 1.0 / total;
        self.update(row, shift * certainty, (1.0 - narrowed) * certainty);
        self.suspect_drift(way == 0.0 && turn == 0.0, f64::from(shift * certainty * deviation));
    }

    /// The covariance of a sum of two states with each state.
    fn sum_of(&self, [one, other]: [usize; 2]) -> [f32; STATES] {
        std::array::from_fn(|i| self.covariance[one][i] + self.covariance[other][i])
    }

    /// Updates the state by a measurement whose covariance with the states is `row`: each state
    /// shifts by `shift`, and the covariance shrinks by `certainty`, for each unit of `row`.
    #[expect(clippy::needless_range_loop, reason = "the index is that of two states")]
    fn update(&mut self, row: [f32; STATES], shift: f32, certainty: f32) {
        for i in 0..STATES {
            self.state[i] += f64::from(row[i] * shift);
            let weight = row[i] * certainty;
            for j in i..STATES {
                let value = self.covariance[i][j] - weight * row[j];
                self.covariance[i][j] = value;
                self.covariance[j][i] = value;
            }
        }
    }

    /// The gyro is in another mode or unplugged: its next reading sets a new zero.
    pub fn gyro_lost(&mut self) {
        self.has_zero = false;
    }

    /// The gyro contradicts the wheels: forgets all that it has taught, but for the pose.
    pub fn forget_gyro(&mut self) {
        self.gyro_lost();
        self.forget_wheels();
        self.state[RATE] = 0.0;
        self.reset_certainty([ZERO, RATE]);
        self.covariance[RATE][RATE] = short(DRIFT * DRIFT);
        self.begin_rest();
    }

    /// Sets the gyro's zero so that this angle agrees with the heading.
    fn zero_at(&mut self, angle: f64) {
        self.has_zero = true;
        self.state[ZERO] = angle - self.state[HEADING];
        for other in 0..STATES {
            let shared = -self.covariance[HEADING][other];
            self.covariance[ZERO][other] = shared;
            self.covariance[other][ZERO] = shared;
        }
        self.covariance[ZERO][ZERO] = self.covariance[HEADING][HEADING]
            + short(HALF_STEP * HALF_STEP / 3.0 + GYRO_ERROR * GYRO_ERROR);
    }

    fn begin_rest(&mut self) {
        let (drift, variance) = (self.state[RATE], f64::from(self.covariance[RATE][RATE]));
        self.rest = Rest { drift, variance, ..Rest::default() };
    }

    /// A robot at rest does not turn. If the gyro's errors all have the same sign
    /// meanwhile, it drifts more than assumed.
    fn suspect_drift(&mut self, is_at_rest: bool, off: f64) {
        if !is_at_rest {
            self.begin_rest();
        }
        self.rest.off += off;
        self.rest.count += 1.0;
        let Rest { off, count, .. } = self.rest;
        if off * off > SUSPICIOUS * SUSPICIOUS * count.max(4.0) {
            self.doubt_drift();
            self.begin_rest();
        }
    }

    /// Removes the drift that was estimated before the rest, by an update with a
    /// negative variance. The drift measured during the rest remains.
    fn doubt_drift(&mut self) {
        let Rest { drift, variance, .. } = self.rest;
        let certainty = 1.0 / variance - 1.0 / (WILD_DRIFT * WILD_DRIFT);
        let total = f64::from(self.covariance[RATE][RATE]) - 1.0 / certainty;
        if certainty > 0.0 && total < 0.0 {
            let row = self.covariance[RATE];
            self.update(row, short((drift - self.state[RATE]) / total), short(1.0 / total));
        }
    }
}

/// A number of the covariance.
#[expect(clippy::cast_possible_truncation, reason = "a variance needs no more digits")]
fn short(value: f64) -> f32 {
    value as f32
}

/// A Gaussian around 0, truncated to a gyro's step around `off`: its mean, and its
/// variance as a share of the untruncated one.
fn within(off: f32, deviation: f32) -> (f32, f32) {
    let scale = 1.0 / deviation;
    let half = short(HALF_STEP);
    let (low, high) = ((off - half) * scale, (off + half) * scale);
    // Farther out the step contains too little probability: take its nearer end.
    if low > 3.0 {
        return (low * deviation, 0.0);
    }
    if high < -3.0 {
        return (high * deviation, 0.0);
    }
    let (at_low, at_high) = (normal_at(low), normal_at(high));
    let share = normal_below(high, at_high) - normal_below(low, at_low);
    let share = 1.0 / share;
    let mean = (at_low - at_high) * share;
    let variance = 1.0 + (low * at_low - high * at_high) * share - mean * mean;
    (mean * deviation, variance.clamp(0.0, 1.0))
}

/// The density of the standard normal distribution.
fn normal_at(x: f32) -> f32 {
    /// 1 / √(2π)
    const PEAK: f32 = std::f32::consts::FRAC_2_SQRT_PI * std::f32::consts::FRAC_1_SQRT_2 / 2.0;
    PEAK * libm::expf(-x * x * 0.5)
}

/// The standard normal distribution, given its density; off by less than 1e-6
/// (Abramowitz and Stegun, Handbook of Mathematical Functions, 26.2.17).
fn normal_below(x: f32, density: f32) -> f32 {
    const TERMS: [f32; 5] = [1.330_274_5, -1.821_255_9, 1.781_477_9, -0.356_563_78, 0.319_381_54];
    let t = 1.0 / (1.0 + 0.231_641_9 * x.abs());
    let tail = density * t * TERMS.iter().fold(0.0, |sum, term| sum * t + term);
    if x < 0.0 { tail } else { 1.0 - tail }
}
