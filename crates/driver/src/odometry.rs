//! Where a robot on two wheels is, from what its wheels and its gyro tell.
//!
//! Pure arithmetic: no devices, no clock. Between two looks both wheels are
//! taken to turn evenly, so that the robot moves along an arc, and that arc is
//! integrated exactly. An extended Kalman filter fuses this with the gyro. Its
//! state is the pose, how much more one wheel rolls than the other, and zero
//! and drift of the gyro; what the gyro finds out late about the heading so
//! corrects the place, too.
//!
//! A gyro tells whole degrees. A reading is therefore not taken as a value with
//! a bell-shaped error, but as an interval that the true value and a
//! bell-shaped error lie in together: mean and variance of what is left of the
//! expectation within that interval are the measurement. Readings that follow
//! each other at rest show the same error; so one counts each 100 ms.

/// Half of a gyro's resolution, in radians.
const HALF_STEP: f64 = 0.5 * DEGREE;

/// Standard deviation of a gyro's reading beside its resolution, in radians.
const GYRO_ERROR: f64 = 0.25 * DEGREE;

/// The time from a reading that counts to the next, in seconds, at rest.
const READ_EVERY: f64 = 0.1;

/// The same as a way in cm and a turn in radians.
const READ_AFTER: f64 = 0.25;

/// Variance of a wheel's way for each cm, in cm²: 2 mm after a metre.
const WHEEL_VARIANCE: f64 = 0.0004;

/// Variance of the heading for each cm, in radians²: 0.2 degrees after a metre.
const HEADING_VARIANCE: f64 = 4e-4 * DEGREE * DEGREE;

/// Variance of a turn for each radian of it, in radians²: 0.2 degrees after a
/// quarter turn, from wheels that are wide and an axle that is not quite known.
const TURN_VARIANCE: f64 = 0.02 * DEGREE * DEGREE;

/// Standard deviation of what one wheel rolls more than the other, as a share.
const MISMATCH: f64 = 0.01;

/// Standard deviation of a gyro's drift, in radians a second: that of one that
/// stood still when it was plugged in.
const DRIFT: f64 = 0.03 * DEGREE;

/// The same of one that did not, and shows so while the robot rests.
const WILD_DRIFT: f64 = 2.0 * DEGREE;

/// Readings at rest that are off by so many standard deviations in sum, for the
/// root of their number, show so.
const SUSPICIOUS: f64 = 2.5;

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
/// Radians by which the robot turns more than the wheels tell, for each cm.
const BIAS: usize = 3;
/// What the gyro shows at heading 0.
const ZERO: usize = 4;
const RATE: usize = 5;
const STATES: usize = 6;

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

/// The estimate.
#[derive(Clone, Debug)]
pub struct Estimate {
    state: [f64; STATES],
    covariance: [[f64; STATES]; STATES],
    has_zero: bool,
    /// How far readings at rest were off in sum, in standard deviations, and how
    /// many these were.
    rest: (f64, f64),
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
            rest: (0.0, 0.0),
            unread: [0.0; 3],
        };
        estimate.covariance[BIAS][BIAS] = (MISMATCH / 10.0).powi(2);
        estimate.covariance[RATE][RATE] = DRIFT * DRIFT;
        estimate.place(pose);
        estimate
    }

    /// The robot is there now. What is known of wheels and gyro stays.
    pub fn place(&mut self, pose: Pose) {
        let turned = pose.heading.to_radians() - self.state[HEADING];
        self.state[X] = pose.x;
        self.state[Y] = pose.y;
        self.state[HEADING] = pose.heading.to_radians();
        self.state[ZERO] -= turned;
        for other in 0..STATES {
            for known in [X, Y, HEADING] {
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
    pub fn roll(&mut self, wheels: &Wheels, ways: [f64; 2], seconds: f64) {
        self.state[ZERO] += self.state[RATE] * seconds;
        self.drift_on(seconds);
        self.unread[0] += seconds;
        if ways == [0.0, 0.0] {
            return;
        }
        let (way, by_wheels) = wheels.twist(ways);
        let turn = by_wheels + self.state[BIAS] * way;
        let middle = self.state[HEADING] + turn / 2.0;
        let chord = way * sinc(turn / 2.0);
        let (sin, cos) = middle.sin_cos();
        self.state[X] += chord * sin;
        self.state[Y] += chord * cos;
        self.state[HEADING] += turn;
        self.unread[1] += way.abs();
        self.unread[2] += turn.abs();
        // How the new place depends on the old heading, and on the bias.
        let (dx, dy) = (chord * cos, -chord * sin);
        self.mix(&[(X, HEADING, dx), (Y, HEADING, dy)]);
        self.mix(&[(X, BIAS, dx * way / 2.0), (Y, BIAS, dy * way / 2.0), (HEADING, BIAS, way)]);
        // What a step adds: along the way, and to the turn, which shifts the
        // place by half of it.
        let rolled = ways[0].abs() + ways[1].abs();
        let along = WHEEL_VARIANCE * rolled / 4.0;
        let turned = HEADING_VARIANCE * rolled / 2.0 + TURN_VARIANCE * by_wheels.abs();
        self.add([sin, cos, 0.0], along);
        self.add([dx / 2.0, dy / 2.0, 1.0], turned);
    }

    /// The gyro shows `angle` degrees.
    pub fn see(&mut self, angle: f64) {
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
        let total = row[HEADING] + row[ZERO] + GYRO_ERROR * GYRO_ERROR;
        let (shift, narrowed) = within(off, total.sqrt());
        self.suspect_drift(way == 0.0 && turn == 0.0, shift / total.sqrt());
        for (state, weight) in self.state.iter_mut().zip(row) {
            *state += weight / total * shift;
        }
        let share = (1.0 - narrowed) / total;
        for (i, line) in self.covariance.iter_mut().enumerate() {
            for (j, value) in line.iter_mut().enumerate() {
                *value -= row[i] * row[j] * share;
            }
        }
    }

    /// The gyro is not to be relied on until it is seen again: it is in another
    /// mode, or gone.
    pub fn lose_gyro(&mut self) {
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
        self.covariance[ZERO][ZERO] =
            self.covariance[HEADING][HEADING] + HALF_STEP * HALF_STEP / 3.0;
    }

    /// A robot that stands does not turn. If the gyro's readings all are off to
    /// one side meanwhile, it drifts more than was thought possible.
    fn suspect_drift(&mut self, is_at_rest: bool, off: f64) {
        let (sum, count) = if is_at_rest { self.rest } else { (0.0, 0.0) };
        self.rest = (sum + off, count + 1.0);
        if self.rest.0.abs() > SUSPICIOUS * self.rest.1.sqrt().max(2.0) {
            self.rest = (0.0, 0.0);
            self.covariance[RATE][RATE] = WILD_DRIFT * WILD_DRIFT;
        }
    }

    fn drift_on(&mut self, seconds: f64) {
        self.mix(&[(ZERO, RATE, seconds)]);
        let drift = &mut self.covariance[RATE][RATE];
        *drift += DRIFT_CHANGE * seconds;
    }

    /// Covariance after `to += factor * from` in the state; no `from` may be a
    /// `to`.
    fn mix(&mut self, changes: &[(usize, usize, f64)]) {
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
    fn add(&mut self, direction: [f64; 3], variance: f64) {
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
