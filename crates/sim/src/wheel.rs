//! The precision of the kernel's timers: `docs/ev3dev-sysfs.md`, 0.5.
//!
//! A jiffy is 10 ms. The kernel keeps timers in a wheel of levels, each eight times as coarse as
//! the one before, and rounds up: a timer fires in the jiffy after the one that was asked for, a
//! long one up to an eighth of its length later.
use crate::ticks::JIFFY_TICKS;
use std::cmp::Reverse;

const JIFFY_MS: u32 = 10;
/// A level has 64 slots and begins where 63 slots of the level before end.
const SLOTS: u64 = 63;
const LEVEL_BITS: u32 = 3;
const LEVELS: u32 = 8;

/// The jiffy that a tick of the motor loop belongs to.
pub(crate) const fn jiffy(tick: u64) -> u64 {
    tick / JIFFY_TICKS
}

/// The number of jiffies that take at least this long. No time is negative here.
pub(crate) fn jiffies_from_ms(ms: i32) -> u64 {
    u64::from(ms.unsigned_abs().div_ceil(JIFFY_MS))
}

/// A timer that was set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Timer {
    set: u64,
    due: u64,
    level: u32,
}

impl Timer {
    /// Sets a timer of at least one jiffy.
    pub(crate) fn new(now: u64, length: u64) -> Timer {
        let starts = |level: &u32| (length.saturating_sub(1) >> (LEVEL_BITS * (level - 1))) < SLOTS;
        let level = (1..LEVELS).find(starts).unwrap_or(LEVELS) - 1;
        let shift = LEVEL_BITS * level;
        Timer { set: now, due: (((now + length) >> shift) + 1) << shift, level }
    }

    pub(crate) fn is_due(self, now: u64) -> bool {
        self.due <= now
    }

    /// Of timers that are due in the same jiffy the coarser one fires first, then the one that was
    /// set later: the least of this.
    pub(crate) fn turn(self) -> Reverse<(u32, u64)> {
        Reverse((self.level, self.set))
    }

    /// The tick of the motor loop in which it fires.
    pub(crate) fn tick(self) -> u64 {
        self.due * JIFFY_TICKS
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timers_fire_late_and_longer_ones_more_so() {
        for (length, now, due) in [
            (1, 0, 2),
            (5, 7, 13),
            (63, 3, 67),
            (64, 0, 72),
            (64, 7, 72),
            (504, 0, 512),
            (505, 0, 512),
        ] {
            assert_eq!(Timer::new(now, length).due, due, "{length} from {now}");
        }
        let latest = |length| {
            let late = |now| Timer::new(now, length).due - now - length;
            (0..5000).map(late).max().unwrap_or(0)
        };
        assert_eq!([10, 63, 64, 504, 505, 4032, 4033].map(latest), [1, 1, 8, 8, 64, 64, 512]);
    }

    #[test]
    fn of_timers_that_fire_together_the_coarser_is_first_then_the_later() {
        let (coarse, fine) = (Timer::new(0, 71), Timer::new(68, 3));
        assert_eq!(coarse.due, fine.due);
        assert!(coarse.turn() < fine.turn());
        assert!(Timer::new(6, 4).turn() < Timer::new(0, 10).turn());
    }
}
