//! The pace of simulated time by the wall clock, for somebody who watches.
//!
//! A virtual clock is held back between its steps, a wall clock gets another factor. Both can be
//! paused. What a program does, and what it sees, is the same at any pace.
use ev3_os::Instant;
use ev3_os::locked;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How long time is held back before signals are handled, by the wall clock, and between two
/// steps of a paced clock.
const SLICE: Duration = Duration::from_millis(20);

/// How far the wall clock may be ahead, as while a program computes, before that is forgotten.
const LATE: Duration = Duration::from_millis(100);

/// A wall clock goes faster by this factor at most.
const FASTEST: f64 = 10.0;

/// Less than this is not worth a sleep.
const SHORT: Duration = Duration::from_millis(2);

/// How fast time may pass at most. By default it is not held back.
#[derive(Debug, Default)]
pub(crate) struct Pace {
    /// A clock without a limit pays for one load.
    is_limited: AtomicBool,
    state: Mutex<State>,
}

#[derive(Debug, Default)]
struct State {
    /// Simulated seconds in a second; `None` is no limit.
    factor: Option<f64>,
    is_paused: bool,
    /// While paused, time may pass until then on the virtual clock.
    allowed: Duration,
    /// The same by the wall clock: so much of it.
    left: Duration,
    /// A moment of both clocks from which the limit counts.
    since: Option<(Instant, Duration)>,
}

/// Whether time may pass now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Leave {
    /// This much of it at once.
    Go(Duration),
    /// Not before a sleep of this length.
    Wait(Duration),
}

impl Pace {
    /// Sets the limit, in simulated seconds in a second; `None` is no limit.
    pub(crate) fn set_factor(&self, factor: Option<f64>) {
        let mut state = locked(&self.state);
        state.factor = factor;
        state.since = None;
        self.note(&state);
    }

    fn note(&self, state: &State) {
        self.is_limited.store(state.is_paused || state.factor.is_some(), Ordering::Release);
    }

    pub(crate) fn is_limited(&self) -> bool {
        self.is_limited.load(Ordering::Acquire)
    }

    pub(crate) fn factor(&self) -> Option<f64> {
        locked(&self.state).factor
    }

    /// Lets time stand from now on, or pass again.
    pub(crate) fn set_paused(&self, is_paused: bool) {
        let mut state = locked(&self.state);
        state.is_paused = is_paused;
        state.allowed = Duration::ZERO;
        state.left = Duration::ZERO;
        state.since = None;
        self.note(&state);
    }

    pub(crate) fn is_paused(&self) -> bool {
        locked(&self.state).is_paused
    }

    /// Lets some time pass while paused. It begins at once.
    pub(crate) fn allow(&self, now: Duration, time: Duration) {
        let mut state = locked(&self.state);
        state.allowed = state.allowed.max(now).saturating_add(time);
        state.left = state.left.saturating_add(time);
        state.since = None;
    }

    /// Whether time may pass at a moment of simulated time.
    pub(crate) fn leave(&self, now: Duration) -> Leave {
        if !self.is_limited() {
            return Leave::Go(Duration::MAX);
        }
        let mut state = locked(&self.state);
        let mut most = Duration::MAX;
        if state.is_paused {
            most = state.allowed.saturating_sub(now);
            if most.is_zero() {
                return Leave::Wait(SLICE);
            }
        }
        let Some(factor) = state.factor else {
            return Leave::Go(most);
        };
        let wall = Instant::now();
        let (wall0, sim0) = *state.since.get_or_insert((wall, now));
        let due = wall0 + now.saturating_sub(sim0).div_f64(factor);
        if due > wall + LATE * 10 || now < sim0 || wall > due + LATE {
            // Gone back to a snapshot, or the program has computed meanwhile.
            state.since = Some((wall, now));
        } else if due > wall + SHORT {
            return Leave::Wait((due - wall).min(SLICE));
        }
        Leave::Go(most.min(SLICE.mul_f64(factor)))
    }

    /// How much simulated time passes in some wall time, which passes anyway, with a factor.
    pub(crate) fn of_wall(&self, wall: Duration, factor: f64) -> Duration {
        if !self.is_limited() {
            return wall.mul_f64(factor);
        }
        let mut state = locked(&self.state);
        let passed = wall.mul_f64(factor * state.factor.unwrap_or(1.0).min(FASTEST));
        if !state.is_paused {
            return passed;
        }
        let passed = passed.min(state.left);
        state.left -= passed;
        passed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SECOND: Duration = Duration::from_secs(1);

    #[test]
    fn without_a_limit_time_passes_at_once() {
        assert_eq!(Pace::default().leave(SECOND), Leave::Go(Duration::MAX));
    }

    #[test]
    fn a_limit_makes_steps_of_20_ms_of_the_wall() {
        let pace = Pace::default();
        pace.set_factor(Some(10.0));
        assert_eq!(pace.leave(SECOND), Leave::Go(Duration::from_millis(200)));
        let next = pace.leave(SECOND + Duration::from_millis(200));
        assert!(matches!(next, Leave::Wait(sleep) if sleep <= SLICE), "{next:?}");
    }

    #[test]
    fn paused_time_passes_as_far_as_allowed() {
        let pace = Pace::default();
        pace.set_paused(true);
        assert_eq!(pace.leave(SECOND), Leave::Wait(SLICE));
        pace.allow(SECOND, SECOND);
        assert_eq!(pace.leave(SECOND), Leave::Go(SECOND));
        assert_eq!(pace.leave(SECOND * 2), Leave::Wait(SLICE));
        assert_eq!(pace.of_wall(SECOND * 2, 1.0), SECOND);
        assert_eq!(pace.of_wall(SECOND, 1.0), Duration::ZERO);
        pace.set_paused(false);
        assert_eq!(pace.leave(SECOND), Leave::Go(Duration::MAX));
    }

    #[test]
    fn what_is_allowed_begins_at_once() {
        let pace = Pace::default();
        pace.set_factor(Some(1.0));
        assert!(matches!(pace.leave(SECOND), Leave::Go(_)));
        let ahead = SECOND + Duration::from_millis(500);
        assert!(matches!(pace.leave(ahead), Leave::Wait(_)));
        pace.allow(ahead, SECOND);
        assert!(matches!(pace.leave(ahead), Leave::Go(_)));
    }

    #[test]
    fn a_wall_clock_gets_another_factor() {
        let pace = Pace::default();
        pace.set_factor(Some(2.0));
        assert_eq!(pace.of_wall(SECOND, 3.0), SECOND * 6);
    }
}
