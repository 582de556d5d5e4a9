//! Noise: off by default, seeded, and the same on every machine.
//!
//! A disturbance is a function of the seed, the port and the number of the 10 ms sample, not of
//! how often a program looked: two reads in one sample agree, and an additional read somewhere
//! changes nothing elsewhere.

use rand_distr::{Distribution, StandardNormal};
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
    #[must_use]
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
        let generator = (noise.sigma > 0.0).then(|| {
            let state = seed ^ sample.wrapping_mul(0x9e37_79b9_7f4a_7c15);
            Pcg32::new(state, port as u64)
        });
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
