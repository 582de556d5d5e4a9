//! The tacho counter and the speed made from it.
//!
//! On the EV3 a co-processor counts and time-stamps the edges of two light barriers: 720 edges a
//! turn, which the driver halves to counts (1 count = 1 degree). A stamp is also written every
//! 50 ms without an edge, from boot on. Speed is distance over time across the newest stamps,
//! going back four at a time until 20 ms are covered, at most 64; it is zero as soon as the count
//! so far back is the same. So it lags, is coarse when slow, reads too little just after a start,
//! and takes about 200 ms to reach zero after the wheel has stopped. Teeth that are not quite where they
//! should be shift the counts; in the speed that cancels out, as four edges are a whole tooth.
use crate::noise::Teeth;
use crate::ticks::TICK_US;

/// Room for the 64 steps back; a power of two.
const RING: usize = 128;
const STEP_BACK: usize = 4;
const MOST_BACK: usize = 64;
const WINDOW_US: i64 = 20_000;
const IDLE_STAMP_US: i64 = 50_000;

#[derive(Clone, Copy, Debug, Default)]
struct Stamp {
    edges: i32,
    /// Since boot, as the program sees it. The co-processor was on before.
    at_us: i64,
}

/// The number of edges below an angle in degrees: two for each. A motor starts in the middle
/// between two of them.
#[expect(clippy::cast_possible_truncation, reason = "a shaft does not turn 10^15 times")]
fn edge(angle: f64) -> i64 {
    libm::floor(angle * 2.0 + 0.5) as i64
}

/// A time since boot, among which there are those before.
fn signed(us: u64) -> i64 {
    i64::try_from(us).unwrap_or(i64::MAX)
}

/// A counter of edges with its newest time stamps.
#[derive(Clone, Debug)]
pub(crate) struct Encoder {
    edges: i32,
    teeth: Teeth,
    stamps: Box<[Stamp; RING]>,
    written: usize,
    speed: i32,
}

impl Encoder {
    pub(crate) fn new(teeth: Teeth) -> Self {
        let mut stamps = Box::new([Stamp::default(); RING]);
        for (stamp, back) in stamps.iter_mut().rev().zip(0..) {
            stamp.at_us = -IDLE_STAMP_US * back;
        }
        Encoder { edges: 0, teeth, stamps, written: RING, speed: 0 }
    }

    /// Counts since boot, truncated toward zero as the driver's integer division does. All that
    /// looks at a position gets it from here, with the errors of the teeth.
    #[expect(clippy::cast_possible_truncation, reason = "an angle of 32 bits and a small error")]
    pub(crate) fn count(&self) -> i32 {
        (f64::from(self.edges) / 2.0 + self.teeth.error(self.edges)) as i32
    }

    /// Counts per second.
    pub(crate) fn speed(&self) -> i32 {
        self.speed
    }

    /// Follows the shaft through one tick, from and to an angle in degrees.
    pub(crate) fn turn(&mut self, from: f64, to: f64, tick_start_us: u64) {
        let crossed = edge(to).wrapping_sub(edge(from));
        if crossed == 0 {
            self.rest(tick_start_us);
        } else {
            self.stamp_edges(from, to, crossed, tick_start_us);
            self.speed = self.measure();
        }
    }

    /// One tick without an edge.
    pub(crate) fn rest(&mut self, tick_start_us: u64) {
        if self.stamp_idle(signed(tick_start_us + TICK_US)) {
            self.speed = self.measure();
        }
    }

    /// Stamps that nothing happened until then; false if that is not long.
    fn stamp_idle(&mut self, until_us: i64) -> bool {
        let at_us = self.newest(0).at_us + IDLE_STAMP_US;
        if at_us <= until_us {
            self.push(at_us);
        }
        at_us <= until_us
    }

    /// Stamps each edge at the moment at which a shaft of even speed crosses it.
    fn stamp_edges(&mut self, from: f64, to: f64, crossed: i64, start_us: u64) {
        let upwards = crossed > 0;
        for nth in 0..crossed.abs() {
            let line = if upwards { edge(from) + 1 + nth } else { edge(from) - nth };
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_precision_loss,
                reason = "a share of 2000 microseconds"
            )]
            let after_us = {
                let share = ((line as f64 - 0.5) / 2.0 - from) / (to - from);
                (share.clamp(0.0, 1.0) * TICK_US as f64) as i64
            };
            let at_us = signed(start_us) + after_us;
            self.stamp_idle(at_us);
            self.edges = self.edges.wrapping_add(if upwards { 1 } else { -1 });
            self.push(at_us);
        }
    }

    fn push(&mut self, at_us: i64) {
        self.stamps[self.written % RING] = Stamp { edges: self.edges, at_us };
        self.written += 1;
    }

    fn newest(&self, back: usize) -> Stamp {
        self.stamps[(self.written - 1 - back) % RING]
    }

    fn measure(&self) -> i32 {
        let newest = self.newest(0);
        let (mut edges, mut span) = (0, 0);
        for back in (STEP_BACK..=MOST_BACK).step_by(STEP_BACK) {
            let oldest = self.newest(back);
            edges = newest.edges.wrapping_sub(oldest.edges);
            span = newest.at_us - oldest.at_us;
            if edges == 0 {
                return 0;
            }
            if span >= WINDOW_US {
                break;
            }
        }
        i32::try_from(i64::from(edges) * 500_000 / span.max(1)).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(
        encoder: &mut Encoder,
        ticks: std::ops::Range<u64>,
        mut from: f64,
        per_tick: f64,
    ) -> f64 {
        for tick in ticks {
            encoder.turn(from, from + per_tick, tick * TICK_US);
            from += per_tick;
        }
        from
    }

    #[test]
    fn counts_are_degrees_and_speed_is_degrees_per_second() {
        let mut encoder = Encoder::new(Teeth::new(0.0, 1, 0));
        run(&mut encoder, 0..500, 0.0, 1.0);
        assert_eq!(encoder.count(), 500);
        assert!((499..=501).contains(&encoder.speed()), "{}", encoder.speed());
        run(&mut encoder, 500..1000, 500.0, -2.0);
        assert_eq!(encoder.count(), -500);
        assert!((-1001..=-999).contains(&encoder.speed()), "{}", encoder.speed());
    }

    #[test]
    fn speed_freezes_then_falls_and_is_zero_200_ms_after_the_last_edge() {
        let mut encoder = Encoder::new(Teeth::new(0.0, 1, 0));
        let end = run(&mut encoder, 0..500, 0.0, 1.0);
        run(&mut encoder, 500..523, end, 0.0);
        assert!(encoder.speed() > 490, "frozen for 50 ms: {}", encoder.speed());
        run(&mut encoder, 523..530, end, 0.0);
        assert!((1..100).contains(&encoder.speed()), "falling: {}", encoder.speed());
        run(&mut encoder, 530..590, end, 0.0);
        assert!(encoder.speed() > 0, "still not zero at 180 ms");
        run(&mut encoder, 590..605, end, 0.0);
        assert_eq!(encoder.speed(), 0);
    }
}
