//! A film of the run: where the robot was, and what motors and sensors showed, every 50 ms of
//! simulated time. On long runs the samples are farther apart. It is kept only where somebody
//! wants it, as a sample costs as much as some ticks.
//!
//! A virtual clock jumps, so somebody who only looked now and then would miss what lies between.
use crate::brick::port::Port;
use crate::log::Log;
use crate::world::ItemId;
use ev3_motion::Pose;
use std::sync::Arc;
use std::time::Duration;

/// How many samples are kept.
const MOST: usize = 2048;
/// At first one is taken every 50 ms.
const FIRST_SPACING_TICKS: u64 = 25;
/// How many values of a sensor are kept.
const VALUES: usize = 4;

/// The samples so far.
#[derive(Clone, Debug)]
pub(crate) struct Film {
    pub(super) kept: Log<Sample>,
    pub(super) spacing: u64,
}

/// What there was at a moment.
#[derive(Clone, Debug)]
pub struct Sample {
    /// The time since the start.
    pub at: Duration,
    /// The true pose of the robot.
    pub pose: Pose,
    /// Where the things are that robots push.
    pub things: Arc<[(ItemId, Pose)]>,
    /// The values of the devices, in the order of [`Port::ALL`].
    pub(super) ports: [Values; Port::ALL.len()],
}

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Values {
    count: usize,
    values: [f64; VALUES],
}

impl Sample {
    /// Position, speed and duty of a motor as its files show them, and how far apart the jaws are
    /// that it moves, in cm; or the first four values of a sensor; empty for all else.
    pub fn values(&self, port: Port) -> &[f64] {
        let Values { count, values } = &self.ports[port as usize];
        &values[..*count]
    }
}

impl FromIterator<f64> for Values {
    fn from_iter<T: IntoIterator<Item = f64>>(all: T) -> Self {
        let mut kept = Values::default();
        for (place, value) in kept.values.iter_mut().zip(all) {
            *place = value;
            kept.count += 1;
        }
        kept
    }
}

impl Film {
    pub(super) fn new() -> Self {
        Self { kept: Log::new(MOST), spacing: FIRST_SPACING_TICKS }
    }

    /// Adds what there is at a moment.
    pub(super) fn take(&mut self, mut sample: Sample) {
        if let Some(old) = self.kept.newest().next().filter(|old| old.things == sample.things) {
            sample.things = Arc::clone(&old.things);
        }
        // Of a time at which nothing changes, the first and the last are enough.
        let is_same = |old: &&Sample| {
            old.pose == sample.pose && old.ports == sample.ports && old.things == sample.things
        };
        if self.kept.newest().take(2).filter(is_same).count() == 2 {
            self.kept.pop();
        }
        self.kept.push(sample);
        if self.kept.len() >= MOST {
            self.kept.thin_out();
            self.spacing *= 2;
        }
    }
}
