//! Noise: off by default, seeded, and the same on every machine.
//!
//! A disturbance is a function of the seed, the port and the number of the 10 ms sample, not of
//! how often a program looked: two reads in one sample agree, and an additional read somewhere
//! changes nothing elsewhere.
use rand_distr::{Distribution, StandardNormal, StandardUniform};
use rand_pcg::Pcg32;

/// Errors of a sensor (in the units of its value) or a motor (in % duty).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Noise {
    /// Standard deviation of a bell curve around the true value.
    pub sigma: f64,
    /// Always added. For a gyro this is drift, in degrees per second; for a motor, the percentage
    /// by which it is stronger than its twin.
    pub bias: f64,
}

impl Noise {
    /// No errors at all.
    pub const NONE: Noise = Noise { sigma: 0.0, bias: 0.0 };

    /// Plausible errors of a device of this driver.
    pub fn typical(driver_name: &str) -> Noise {
        let (sigma, bias) = match driver_name {
            "lego-ev3-us" => (0.2, 0.0),
            "lego-ev3-color" => (0.7, 0.0),
            "lego-ev3-gyro" => (0.3, 0.02),
            "lego-ev3-ir" | "lego-nxt-us" | "lego-nxt-light" | "ht-nxt-compass" => (1.0, 0.0),
            "lego-nxt-temp" => (0.05, 0.0),
            "ht-nxt-gyro" => (0.5, 0.0),
            name if name.ends_with("-motor") => (0.5, 0.0),
            _ => (0.0, 0.0),
        };
        Noise { sigma, bias }
    }
}

/// What an ultrasonic sensor hears of its own sound. By default it hears all in a cone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Echo {
    /// How far the cone goes to each side, in degrees.
    pub half_angle: f64,
    /// A surface sends no echo if the sound meets it at a larger angle than this, in degrees
    /// from straight on.
    pub incidence: f64,
    /// The share of samples that hear nothing.
    pub miss: f64,
    /// The share of samples that hear something nearer, where there is nothing.
    pub spurious: f64,
}

impl Default for Echo {
    fn default() -> Self {
        Echo { half_angle: 15.0, incidence: 90.0, miss: 0.0, spurious: 0.0 }
    }
}

impl Echo {
    /// Apart from all disturbances of the same port.
    const STREAM: u64 = 0xec40;

    /// Errors: what is out of range.
    pub(crate) fn validate(&self) -> Result<(), &'static str> {
        if !(0.0..=60.0).contains(&self.half_angle) {
            return Err("needs a half_angle from 0 to 60 degrees");
        }
        if !(1.0..=90.0).contains(&self.incidence) {
            return Err("needs an incidence from 1 to 90 degrees");
        }
        let shares = [self.miss, self.spurious, self.miss + self.spurious];
        if !shares.iter().all(|share| (0.0..=1.0).contains(share)) {
            return Err("needs shares miss and spurious from 0 to 1, together at most 1");
        }
        Ok(())
    }

    /// What happens in one sample.
    pub(crate) fn at(self, seed: u64, port: usize, sample: u64) -> Heard {
        let mut heard = Heard { cone: self, is_missed: false, spurious: None };
        if self.miss + self.spurious > 0.0 {
            let mut generator = sampled(seed ^ Self::STREAM, port, sample);
            let chance: f64 = StandardUniform.sample(&mut generator);
            heard.is_missed = chance < self.miss;
            if !heard.is_missed && chance < self.miss + self.spurious {
                heard.spurious = Some(StandardUniform.sample(&mut generator));
            }
        }
        heard
    }
}

/// What an ultrasonic sensor hears in one sample.
pub(crate) struct Heard {
    pub(crate) cone: Echo,
    pub(crate) is_missed: bool,
    /// Something at this share of the distance.
    pub(crate) spurious: Option<f64>,
}

/// The random numbers of a sample.
fn sampled(seed: u64, port: usize, sample: u64) -> Pcg32 {
    Pcg32::new(seed ^ sample.wrapping_mul(0x9e37_79b9_7f4a_7c15), port as u64)
}

/// Standard deviation of the errors of an encoder's teeth that is plausible, in degrees.
pub(crate) const TYPICAL_TEETH: f64 = 0.5;

/// Errors of the teeth of a motor's encoder. They sit on its disc: each tooth has its own, the
/// same at every turn, so a motor at rest shows the same always.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Teeth {
    sigma: f64,
    seed: u64,
    port: usize,
}

impl Teeth {
    /// Teeth of a disc that turns with the shaft, one for each period of both light barriers.
    const COUNT: i32 = 180;
    /// Edges of both light barriers for each of them.
    const EDGES: i32 = 4;
    /// Apart from all samples of the same port.
    const STREAM: u64 = 0x7ee7;

    pub(crate) fn new(sigma: f64, seed: u64, port: usize) -> Self {
        Teeth { sigma, seed, port }
    }

    /// How much more than the truth the disc shows at an edge, in degrees; between two teeth the
    /// error changes evenly.
    pub(crate) fn error(&self, edge: i32) -> f64 {
        if self.sigma <= 0.0 {
            return 0.0;
        }
        let tooth = edge.div_euclid(Self::EDGES);
        let share = f64::from(edge.rem_euclid(Self::EDGES)) / f64::from(Self::EDGES);
        self.of_tooth(tooth) * (1.0 - share) + self.of_tooth(tooth + 1) * share
    }

    fn of_tooth(&self, tooth: i32) -> f64 {
        let noise = Noise { sigma: self.sigma, bias: 0.0 };
        let tooth = u64::from(tooth.rem_euclid(Self::COUNT).unsigned_abs());
        Source::new(noise, self.seed ^ Self::STREAM, self.port, tooth).jitter()
    }
}

/// The disturbances of one port during one sample.
pub(crate) struct Source {
    noise: Noise,
    generator: Option<Pcg32>,
}

impl Source {
    pub(crate) fn new(noise: Noise, seed: u64, port: usize, sample: u64) -> Self {
        let generator = (noise.sigma > 0.0).then(|| sampled(seed, port, sample));
        Source { noise, generator }
    }

    /// A draw from the bell curve, without the bias.
    pub(crate) fn jitter(&mut self) -> f64 {
        match &mut self.generator {
            Some(generator) => {
                let unit: f64 = StandardNormal.sample(generator);
                unit * self.noise.sigma
            }
            None => 0.0,
        }
    }

    /// The value with all its errors.
    pub(crate) fn disturb(&mut self, value: f64) -> f64 {
        value + self.noise.bias + self.jitter()
    }
}
