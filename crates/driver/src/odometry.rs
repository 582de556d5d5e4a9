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
//! a bell-shaped error, but as an interval: as long as the estimate agrees with
//! it, it says nothing.

/// Half of a gyro's resolution, in radians.
const HALF_STEP: f64 = 0.5 * DEGREE;

/// Standard deviation of a gyro's reading beside its resolution, in radians.
const GYRO_ERROR: f64 = 0.4 * DEGREE;

/// Variance of a wheel's way for each cm, in cm²: 2 mm after a metre.
const WHEEL_VARIANCE: f64 = 0.0004;

/// Variance of a turn for each radian of it, in radians²: 1 degree after half a
/// turn, from wheels that are wide and an axle that is not quite known.
const TURN_VARIANCE: f64 = 1e-4;

/// Standard deviation of what one wheel rolls more than the other, as a share.
const MISMATCH: f64 = 0.003;

/// Standard deviation of a gyro's drift, in radians a second.
const DRIFT: f64 = 0.1 * DEGREE;

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
        let mut estimate =
            Self { state: [0.0; STATES], covariance: [[0.0; STATES]; STATES], has_zero: false };
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
        // How the new place depends on the old heading, and on the bias.
        let (dx, dy) = (chord * cos, -chord * sin);
        self.mix(&[(X, HEADING, dx), (Y, HEADING, dy)]);
        self.mix(&[(X, BIAS, dx * way / 2.0), (Y, BIAS, dy * way / 2.0), (HEADING, BIAS, way)]);
        // What a step adds: along the way, and to the turn, which shifts the
        // place by half of it.
        let rolled = ways[0].abs() + ways[1].abs();
        let along = WHEEL_VARIANCE * rolled / 4.0;
        let turned =
            WHEEL_VARIANCE * rolled / (wheels.axle * wheels.axle) + TURN_VARIANCE * by_wheels.abs();
        self.add([sin, cos, 0.0], along);
        self.add([dx / 2.0, dy / 2.0, 1.0], turned);
    }

    /// The gyro shows `angle` degrees.
    pub fn see(&mut self, angle: f64) {
        let angle = angle * DEGREE;
        let off = angle - self.state[HEADING] - self.state[ZERO];
        if !self.has_zero || off.abs() > JUMP {
            self.zero_at(angle);
            return;
        }
        let within = off.clamp(-HALF_STEP, HALF_STEP);
        let surprise = off - within;
        let row: [f64; STATES] =
            std::array::from_fn(|i| self.covariance[i][HEADING] + self.covariance[i][ZERO]);
        let variance = row[HEADING] + row[ZERO];
        if surprise == 0.0 && variance < HALF_STEP * HALF_STEP {
            return;
        }
        let total = variance + GYRO_ERROR * GYRO_ERROR;
        for (state, weight) in self.state.iter_mut().zip(row) {
            *state += weight / total * surprise;
        }
        for (i, line) in self.covariance.iter_mut().enumerate() {
            for (j, value) in line.iter_mut().enumerate() {
                *value -= row[i] * row[j] / total;
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

    fn drift_on(&mut self, seconds: f64) {
        self.mix(&[(ZERO, RATE, seconds)]);
        let drift = &mut self.covariance[RATE][RATE];
        *drift = (*drift + DRIFT_CHANGE * seconds).min(DRIFT * DRIFT);
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
