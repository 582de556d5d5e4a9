//! Where a robot on two wheels is, from what its wheels and its gyro tell.
//!
//! Pure arithmetic: no devices, no clock. Between two looks both wheels are
//! taken to turn evenly, so that the robot moves along an arc, and that arc is
//! integrated exactly. An extended Kalman filter fuses this with the gyro. Its
//! state is the pose, by what shares the wheels and the axle differ from what
//! they are said to be, and zero and drift of the gyro; what the gyro finds out
//! late about the heading so corrects the place, too.
//!
//! The errors of wheels and axle persist: a wheel that slips or a tyre that is
//! wide makes each turn wrong by the same share. So over long turns it is the
//! gyro that is right, and what it says is no drift.
//!
//! A gyro tells whole degrees. A reading is therefore not taken as a value with
//! a bell-shaped error, but as an interval that the true value and a
//! bell-shaped error lie in together: mean and variance of what is left of the
//! expectation within that interval are the measurement. Readings that follow
//! each other at rest show the same error; so one counts each 100 ms.

/// Half of a gyro's resolution, in radians.
const HALF_STEP: f64 = 0.5 * DEGREE;

/// Standard deviation of a gyro's reading beside its resolution, in radians; with
/// that of the encoders, with which it is compared.
const GYRO_ERROR: f64 = 0.35 * DEGREE;

/// How far in time readings of gyro and wheels may lie apart, in seconds.
const LAG: f64 = 0.01;

/// The time from a reading that counts to the next, in seconds, at rest.
const READ_EVERY: f64 = 0.1;

/// The same as a way in cm and a turn in radians.
const READ_AFTER: f64 = 0.25;

/// Variance of a wheel's way for each cm, in cm²: 2 mm after a metre.
const WHEEL_VARIANCE: f64 = 0.0004;

/// Variance of the heading for each cm, in radians²: 0.15 degrees after a metre,
/// from wheels that slip now and then.
const HEADING_VARIANCE: f64 = 2e-4 * DEGREE * DEGREE;

/// The same for each radian of a turn: 0.13 degrees after a quarter turn.
const TURN_VARIANCE: f64 = 0.01 * DEGREE * DEGREE;

/// Standard deviation of a wheel's way when it starts to roll, in cm, from teeth
/// of the encoder and play of the gears: a third of a degree of the motor.
const START: f64 = 0.0175;

/// The time after which a wheel that rolls does so anew, in seconds.
const STILL: f64 = 0.1;

/// Standard deviation of the share that a wheel rolls more than its diameter
/// says: one rolls 1 % more than the other.
const WHEEL: f64 = 0.0075;

/// The same of the share that the robot turns more than the axle says: nobody
/// knows where wide tyres touch the floor.
const AXLE_LENGTH: f64 = 0.03;

/// How that may change, with the floor for one: variance for each radian.
const AXLE_CHANGE: f64 = 0.0005 * 0.0005;

/// Standard deviation of a gyro's drift, in radians a second: that of one that
/// stood still when it was plugged in.
const DRIFT: f64 = 0.03 * DEGREE;

/// The same of one that did not, and shows so while the robot rests.
const WILD_DRIFT: f64 = 2.0 * DEGREE;

/// Readings at rest that are off by so many standard deviations in sum, for the
/// root of their number, show so. Fewer come about by chance at some moment of a
/// long run.
const SUSPICIOUS: f64 = 4.0;

/// How fast the drift may change: variance of the drift for each second.
const DRIFT_CHANGE: f64 = (0.001 * DEGREE) * (0.001 * DEGREE);

/// A reading that is farther off than this, in radians, comes from a gyro that
/// started anew at another zero.
const JUMP: f64 = 12.0 * DEGREE;

/// A degree in radians.
const DEGREE: f64 = std::f64::consts::PI / 180.0;

// The state.
const X: usize = 0;
const Y: usize = 1;
const HEADING: usize = 2;
/// The share that each wheel rolls more than it is said to.
const LEFT: usize = 3;
const RIGHT: usize = 4;
/// The share that the robot turns more than the ways of the wheels tell.
const AXLE: usize = 5;
/// What the gyro shows at heading 0.
const ZERO: usize = 6;
const RATE: usize = 7;
const STATES: usize = 8;

/// A place in cm and a heading in degrees: 0 looks along y, clockwise is
/// positive, and full turns count.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// To the right.
    pub x: f64,
    /// Ahead at heading 0.
    pub y: f64,
    /// Degrees.
    pub heading: f64,
}

impl Pose {
    /// The pose `ahead` cm further on.
    #[must_use]
    pub fn ahead(self, ahead: f64) -> Self {
        let (sin, cos) = self.heading.to_radians().sin_cos();
        Self { x: self.x + ahead * sin, y: self.y + ahead * cos, ..self }
    }

    /// The pose after an arc: `way` cm long, turning by `turn` degrees.
    #[must_use]
    pub fn along_arc(self, way: f64, turn: f64) -> Self {
        let half = turn.to_radians() / 2.0;
        let chord = way * sinc(half);
        let (sin, cos) = (self.heading.to_radians() + half).sin_cos();
        Self { x: self.x + chord * sin, y: self.y + chord * cos, heading: self.heading + turn }
    }
}

/// What the robot is built like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheels {
    /// Diameter of the left and the right wheel, in cm.
    pub diameters: [f64; 2],
    /// Whether the left and the right motor are mounted the other way round.
    pub inverted: [bool; 2],
    /// Distance between the middles of their treads, in cm.
    pub axle: f64,
    /// How far the axle is ahead of the point whose pose is told, in cm.
    pub offset: f64,
}

impl Wheels {
    /// Cm that a wheel rolls for each count of its motor, with its sign.
    #[must_use]
    pub fn cm_per_count(&self, side: usize, counts_per_rotation: f64) -> f64 {
        let way = std::f64::consts::PI * self.diameters[side] / counts_per_rotation;
        if self.inverted[side] { -way } else { way }
    }

    /// Way in cm and turn in radians from the ways of both wheels.
    #[must_use]
    pub fn twist(&self, [left, right]: [f64; 2]) -> (f64, f64) {
        (f64::midpoint(left, right), (left - right) / self.axle)
    }

    /// The ways of both wheels from way in cm and turn in radians.
    #[must_use]
    pub fn ways(&self, way: f64, turn: f64) -> [f64; 2] {
        let half = turn * self.axle / 2.0;
        [way + half, way - half]
    }
}

/// What the gyro has shown since the robot came to rest.
#[derive(Clone, Copy, Debug, Default)]
struct Rest {
    /// How far its readings were off in sum, in standard deviations, and how many
    /// these were.
    off: f64,
    count: f64,
    /// The drift, and its variance, as they were before.
    drift: f64,
    variance: f64,
}

/// The estimate.
#[derive(Clone, Debug)]
pub struct Estimate {
    state: [f64; STATES],
    covariance: [[f64; STATES]; STATES],
    has_zero: bool,
    rest: Rest,
    /// For how long the wheels have not rolled, in seconds.
    still: f64,
    /// Time, way and turn since the last reading of the gyro that counted.
    unread: [f64; 3],
}

impl Default for Estimate {
    fn default() -> Self {
        Self::at(Pose::default())
    }
}

impl Estimate {
    /// A robot that is known to be at a pose, that of the middle of its axle.
    #[must_use]
    pub fn at(pose: Pose) -> Self {
        let mut estimate = Self {
            state: [0.0; STATES],
            covariance: [[0.0; STATES]; STATES],
            has_zero: false,
            rest: Rest::default(),
            still: STILL,
            unread: [0.0; 3],
        };
        estimate.covariance[RATE][RATE] = DRIFT * DRIFT;
        estimate.begin_rest();
        estimate.forget_wheels();
        estimate.set_pose(pose);
        estimate
    }

    /// The robot is there now. What is known of wheels and gyro stays.
    pub fn set_pose(&mut self, pose: Pose) {
        let turned = pose.heading.to_radians() - self.state[HEADING];
        self.state[X] = pose.x;
        self.state[Y] = pose.y;
        self.state[HEADING] = pose.heading.to_radians();
        self.state[ZERO] -= turned;
        self.reset_certainty([X, Y, HEADING]);
    }

    /// What the gyro has told of wheels and axle holds no longer: these are
    /// others, or shall do without it.
    pub fn forget_wheels(&mut self) {
        let errors = [LEFT, RIGHT, AXLE];
        self.reset_certainty(errors);
        for (error, deviation) in errors.into_iter().zip([WHEEL, WHEEL, AXLE_LENGTH]) {
            self.state[error] = 0.0;
            self.covariance[error][error] = deviation * deviation;
        }
    }

    fn reset_certainty(&mut self, states: [usize; 3]) {
        for known in states {
            for other in 0..STATES {
                self.covariance[known][other] = 0.0;
                self.covariance[other][known] = 0.0;
            }
        }
    }

    /// The pose of the middle of the axle.
    #[must_use]
    pub fn pose(&self) -> Pose {
        let [x, y, heading, ..] = self.state;
        Pose { x, y, heading: heading.to_degrees() }
    }

    /// Covariance of x, y and heading, in cm and degrees.
    #[must_use]
    pub fn uncertainty(&self) -> [[f64; 3]; 3] {
        let unit = [1.0, 1.0, 1.0 / DEGREE];
        std::array::from_fn(|i| std::array::from_fn(|j| self.covariance[i][j] * unit[i] * unit[j]))
    }

    /// The gyro's drift, in degrees a second.
    #[must_use]
    pub fn drift(&self) -> f64 {
        self.state[RATE].to_degrees()
    }

    /// The wheels have rolled `ways` cm within `seconds`.
    pub fn predict(&mut self, wheels: &Wheels, ways: [f64; 2], seconds: f64) {
        self.state[ZERO] += self.state[RATE] * seconds;
        self.drift_on(seconds);
        self.unread[0] += seconds;
        if ways == [0.0, 0.0] {
            self.still += seconds;
            return;
        }
        let starts = std::mem::replace(&mut self.still, 0.0) >= STILL;
        let [left, right] = ways;
        let [.., left_error, right_error, axle_error, _, _] = self.state;
        let (way, by_wheels) =
            wheels.twist([left * (1.0 + left_error), right * (1.0 + right_error)]);
        let stretch = 1.0 + axle_error;
        let turn = by_wheels * stretch;
        let middle = self.state[HEADING] + turn / 2.0;
        let chord = way * sinc(turn / 2.0);
        let (sin, cos) = middle.sin_cos();
        self.state[X] += chord * sin;
        self.state[Y] += chord * cos;
        self.state[HEADING] += turn;
        self.unread[1] += way.abs();
        self.unread[2] += turn.abs();
        // How the new place depends on the old heading, and on each error by
        // how much way and turn depend on it.
        let (dx, dy) = (chord * cos, -chord * sin);
        self.propagate(&[(X, HEADING, dx), (Y, HEADING, dy)]);
        let per_axle = stretch / wheels.axle;
        for (error, of_way, of_turn) in [
            (LEFT, left / 2.0, left * per_axle),
            (RIGHT, right / 2.0, -right * per_axle),
            (AXLE, 0.0, by_wheels),
        ] {
            let of_x = of_way * sin + of_turn * dx / 2.0;
            let of_y = of_way * cos + of_turn * dy / 2.0;
            self.propagate(&[(X, error, of_x), (Y, error, of_y), (HEADING, error, of_turn)]);
        }
        // What a step adds: along the way, and to the turn, which shifts the
        // place by half of it.
        let rolled = left.abs() + right.abs();
        let start = if starts { START * START } else { 0.0 };
        let along = WHEEL_VARIANCE * rolled / 4.0 + start / 2.0;
        let turned = HEADING_VARIANCE * rolled / 2.0
            + TURN_VARIANCE * turn.abs()
            + 2.0 * start / (wheels.axle * wheels.axle);
        self.inflate([sin, cos, 0.0], along);
        self.inflate([dx / 2.0, dy / 2.0, 1.0], turned);
        self.covariance[AXLE][AXLE] += AXLE_CHANGE * turn.abs();
    }

    /// The gyro shows `angle` degrees.
    pub fn observe_gyro(&mut self, angle: f64) {
        let angle = angle * DEGREE;
        let off = angle - self.state[HEADING] - self.state[ZERO];
        if !self.has_zero || off.abs() > JUMP + WILD_DRIFT * self.unread[0] {
            self.zero_at(angle);
            return;
        }
        let [seconds, way, turn] = self.unread;
        if seconds < READ_EVERY && way < READ_AFTER && turn < HALF_STEP {
            return;
        }
        self.unread = [0.0; 3];
        let row: [f64; STATES] =
            std::array::from_fn(|i| self.covariance[i][HEADING] + self.covariance[i][ZERO]);
        let late = LAG * turn / seconds.max(LAG);
        let error = GYRO_ERROR * GYRO_ERROR + late * late;
        let total = row[HEADING] + row[ZERO] + error;
        let (shift, narrowed) = within(off, total.sqrt());
        self.update(row, shift / total, (1.0 - narrowed) / total);
        self.suspect_drift(way == 0.0 && turn == 0.0, shift / total.sqrt());
    }

    /// Something is measured that depends on the states by `row` of the
    /// covariance: it shifts them and makes them more certain by so much for
    /// each of it.
    fn update(&mut self, row: [f64; STATES], shift: f64, certainty: f64) {
        for (state, weight) in self.state.iter_mut().zip(row) {
            *state += weight * shift;
        }
        for (i, line) in self.covariance.iter_mut().enumerate() {
            for (j, value) in line.iter_mut().enumerate() {
                *value -= row[i] * row[j] * certainty;
            }
        }
    }

    /// The gyro is not to be relied on until it is seen again: it is in another
    /// mode, or gone.
    pub fn gyro_lost(&mut self) {
        self.has_zero = false;
    }

    /// From now on the gyro's zero is what makes this angle right.
    fn zero_at(&mut self, angle: f64) {
        self.has_zero = true;
        self.state[ZERO] = angle - self.state[HEADING];
        for other in 0..STATES {
            let shared = -self.covariance[HEADING][other];
            self.covariance[ZERO][other] = shared;
            self.covariance[other][ZERO] = shared;
        }
        self.covariance[ZERO][ZERO] = self.covariance[HEADING][HEADING]
            + HALF_STEP * HALF_STEP / 3.0
            + GYRO_ERROR * GYRO_ERROR;
    }

    fn begin_rest(&mut self) {
        let (drift, variance) = (self.state[RATE], self.covariance[RATE][RATE]);
        self.rest = Rest { drift, variance, ..Rest::default() };
    }

    /// A robot that stands does not turn. If the gyro's readings all are off to
    /// one side meanwhile, it drifts more than was thought possible.
    fn suspect_drift(&mut self, is_at_rest: bool, off: f64) {
        if !is_at_rest {
            self.begin_rest();
        }
        self.rest.off += off;
        self.rest.count += 1.0;
        if self.rest.off.abs() > SUSPICIOUS * self.rest.count.sqrt().max(2.0) {
            self.doubt_drift();
            self.begin_rest();
        }
    }

    /// What was thought of the drift before the rest is taken back, as if it had
    /// been measured with a negative variance. What is left is what the rest has
    /// shown.
    fn doubt_drift(&mut self) {
        let Rest { drift, variance, .. } = self.rest;
        let certainty = 1.0 / variance - 1.0 / (WILD_DRIFT * WILD_DRIFT);
        let total = self.covariance[RATE][RATE] - 1.0 / certainty;
        if certainty > 0.0 && total < 0.0 {
            let row = std::array::from_fn(|i| self.covariance[i][RATE]);
            self.update(row, (drift - self.state[RATE]) / total, 1.0 / total);
        }
    }

    fn drift_on(&mut self, seconds: f64) {
        self.propagate(&[(ZERO, RATE, seconds)]);
        let drift = &mut self.covariance[RATE][RATE];
        *drift += DRIFT_CHANGE * seconds;
    }

    /// Covariance after `to += factor * from` in the state; no `from` may be a
    /// `to`.
    fn propagate(&mut self, changes: &[(usize, usize, f64)]) {
        for &(to, from, factor) in changes {
            for other in 0..STATES {
                self.covariance[to][other] += factor * self.covariance[from][other];
            }
        }
        for &(to, from, factor) in changes {
            for line in &mut self.covariance {
                line[to] += factor * line[from];
            }
        }
    }

    /// Adds an error of that variance in a direction of the pose.
    fn inflate(&mut self, direction: [f64; 3], variance: f64) {
        for (line, a) in self.covariance.iter_mut().zip(direction) {
            for (value, b) in line.iter_mut().zip(direction) {
                *value += a * b * variance;
            }
        }
    }
}

/// An angle between -180 and 180 degrees, the latter included.
#[must_use]
pub fn wrapped(degrees: f64) -> f64 {
    let wrapped = degrees.rem_euclid(360.0);
    if wrapped > 180.0 { wrapped - 360.0 } else { wrapped }
}

/// sin(x) / x.
fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-4 { 1.0 - x * x / 6.0 } else { x.sin() / x }
}

/// What is left of a bell curve around 0 within a gyro's step around `off`: the
/// mean, and the variance as a share of that of the whole.
fn within(off: f64, deviation: f64) -> (f64, f64) {
    let (low, high) = ((off - HALF_STEP) / deviation, (off + HALF_STEP) / deviation);
    // Farther out the step holds too little to tell; its nearer end is it.
    if low > 3.0 {
        return (low * deviation, 0.0);
    }
    if high < -3.0 {
        return (high * deviation, 0.0);
    }
    let share = normal_below(high) - normal_below(low);
    let (at_low, at_high) = (normal_at(low), normal_at(high));
    let mean = (at_low - at_high) / share;
    let variance = 1.0 + (low * at_low - high * at_high) / share - mean * mean;
    (mean * deviation, variance.clamp(0.0, 1.0))
}

/// The density of the standard normal distribution.
fn normal_at(x: f64) -> f64 {
    (-x * x / 2.0).exp() / std::f64::consts::TAU.sqrt()
}

/// The standard normal distribution; off by less than 1e-7 (Abramowitz and
/// Stegun, Handbook of Mathematical Functions, 26.2.17).
fn normal_below(x: f64) -> f64 {
    const TERMS: [f64; 5] =
        [1.330_274_429, -1.821_255_978, 1.781_477_937, -0.356_563_782, 0.319_381_530];
    let t = 1.0 / (1.0 + 0.231_641_9 * x.abs());
    let tail = normal_at(x) * t * TERMS.iter().fold(0.0, |sum, term| sum * t + term);
    if x < 0.0 { tail } else { 1.0 - tail }
}
