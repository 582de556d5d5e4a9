//! The limits of a step, and how speeds answer their impulses.

/// The hull keeps this far from obstacles, in cm, so that it never quite touches them.
pub(super) const SKIN: f64 = 0.02;
/// What runs into something slower than this is not thrown back, in cm/s.
pub(super) const BOUNCES: f64 = 1.0;
/// Friction between hull and obstacle, as a share of the force between them: plastic on wood or
/// laminate has 0.2 to 0.4.
pub(super) const WALL_FRICTION: f64 = 0.3;

/// Speeds: of the left and the right shaft in rad/s; sideways to the right and ahead in cm/s, and
/// clockwise in rad/s. As a `gain`, how much each of them adds to a speed that is limited. Where
/// the wheels roll, the last two follow from the first, and have no gain.
pub(super) type Speeds = [f64; 5];

/// How speeds answer an impulse. Only the two shafts act on each other.
pub(super) struct Answer {
    pub(super) shafts: [[f64; 2]; 2],
    pub(super) body: [f64; 3],
}

impl Answer {
    pub(super) fn of(&self, gain: Speeds) -> Speeds {
        let [left, right] = apply(&self.shafts, [gain[0], gain[1]]);
        let [aside, ahead, turn] = self.body;
        [left, right, aside * gain[2], ahead * gain[3], turn * gain[4]]
    }
}

/// A limit: the impulse that keeps `gain · speeds` at (or above) `target`.
pub(super) struct Limit {
    pub(super) gain: Speeds,
    pub(super) target: f64,
    pub(super) low: f64,
    pub(super) high: f64,
    /// Of a friction, the most that it ever gives.
    pub(super) whole: f64,
    pub(super) impulse: f64,
}

impl Limit {
    /// The impulse that brings a speed to rest, at most this one.
    pub(super) fn friction(gain: Speeds, most: f64) -> Limit {
        Limit { gain, target: 0.0, low: -most, high: most, whole: most, impulse: 0.0 }
    }

    /// An obstacle at this distance, in cm, which only pushes.
    pub(super) fn push(gain: Speeds, gap: f64, seconds: f64) -> Limit {
        let target = (SKIN - gap).min(0.0) / seconds;
        Limit { gain, target, low: 0.0, high: f64::INFINITY, whole: f64::INFINITY, impulse: 0.0 }
    }

    /// What would run into the obstacle at this speed within this time is thrown back.
    pub(super) fn bounce(&mut self, speed: f64, gap: f64, bounce: f64, seconds: f64) {
        if bounce > 0.0 && speed < -BOUNCES && speed * seconds < SKIN - gap {
            self.target = -bounce * speed;
        }
    }

    /// Gives the impulse that is missing, and answers by how much that changes the speed.
    pub(super) fn apply(&mut self, speeds: &mut Speeds, answer: &Answer) -> f64 {
        let answer = answer.of(self.gain);
        let softness = dot(self.gain, answer);
        let step = self.step(dot(self.gain, *speeds), softness);
        add(speeds, answer, step);
        (step * softness).abs()
    }

    /// The impulse that is missing where the limited speed is this one.
    pub(super) fn step(&mut self, speed: f64, softness: f64) -> f64 {
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
pub(super) struct Touch {
    pub(super) push: Limit,
    pub(super) rub: Limit,
}

impl Touch {
    pub(super) fn round(&mut self, mut apply: impl FnMut(&mut Limit) -> f64) -> f64 {
        self.rub.high = WALL_FRICTION * self.push.impulse;
        self.rub.low = -self.rub.high;
        let change = apply(&mut self.rub);
        change.max(apply(&mut self.push))
    }
}

pub(super) fn apply(matrix: &[[f64; 2]; 2], vector: [f64; 2]) -> [f64; 2] {
    [
        matrix[0][0] * vector[0] + matrix[0][1] * vector[1],
        matrix[1][0] * vector[0] + matrix[1][1] * vector[1],
    ]
}

pub(super) fn dot(a: Speeds, b: Speeds) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] + a[4] * b[4]
}

pub(super) fn add(speeds: &mut Speeds, answer: Speeds, step: f64) {
    for (speed, answer) in speeds.iter_mut().zip(answer) {
        *speed += answer * step;
    }
}
