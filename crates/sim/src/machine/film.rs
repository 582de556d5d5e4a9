//! A film of the run: where the robot was, and what motors and sensors showed, every 50 ms of
//! simulated time. On long runs the samples are farther apart.
//!
//! A virtual clock jumps, so somebody who only looked now and then would miss what lies between.

use std::time::Duration;

use crate::log::Log;
use crate::world::geometry::Pose;

/// How many samples are kept.
const MOST: usize = 2048;
/// At first one is taken every 50 ms.
const FIRST_SPACING_TICKS: u64 = 25;
/// How many values of a sensor are kept.
pub(super) const VALUES: usize = 4;

/// The samples so far.
#[derive(Clone, Debug)]
pub(crate) struct Film {
    pub(super) kept: Log<Sample>,
    pub(super) spacing: u64,
}

/// What there was at a moment.
#[derive(Clone, Debug)]
pub(crate) struct Sample {
    pub(super) at: Duration,
    pub(super) state: State,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct State {
    pub(super) pose: Pose,
    /// Position, speed and duty.
    pub(super) motors: [Option<[i32; 3]>; 4],
    pub(super) sensors: [Values; 4],
}

/// The first values of a sensor, with their decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Values {
    pub(super) count: usize,
    pub(super) values: [f64; VALUES],
}

impl Film {
    pub(super) fn new() -> Self {
        Self { kept: Log::new(MOST), spacing: FIRST_SPACING_TICKS }
    }

    /// Adds what there is at a moment.
    pub(super) fn take(&mut self, at: Duration, state: State) {
        // Of a time at which nothing changes, the first and the last are enough.
        if self.kept.newest().take(2).filter(|old| old.state == state).count() == 2 {
            self.kept.pop();
        }
        self.kept.push(|_| Sample { at, state });
        if self.kept.len() >= MOST {
            self.kept.thin_out();
            self.spacing *= 2;
        }
    }
}
