//! The poses of the robot by its odometry, over time.
//!
//! Somebody who looks now and then sees the whole way. Memory stays bounded: on long runs the
//! points are farther apart.
use ev3_motion::Pose;
use std::time::Duration;

/// How many points are kept.
const MOST: usize = 2048;

/// How far apart they are at first.
const SPACING: Duration = Duration::from_millis(50);

/// The way so far, oldest first.
pub(super) struct Track {
    points: Vec<(Duration, Pose)>,
    spacing: Duration,
}

impl Default for Track {
    fn default() -> Self {
        Self { points: Vec::new(), spacing: SPACING }
    }
}

impl Track {
    /// Whether a point is due.
    pub(super) fn is_due(&self, now: Duration) -> bool {
        // A simulation may have been put back to an earlier moment.
        self.points.last().is_none_or(|(at, _)| *at > now || now >= *at + self.spacing)
    }

    /// The robot is there now.
    pub(super) fn note(&mut self, now: Duration, pose: Pose) {
        let earlier = self.points.partition_point(|(at, _)| *at < now);
        self.points.truncate(earlier);
        self.points.push((now, pose));
        if self.points.len() >= MOST {
            let mut index = 0;
            self.points.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing *= 2;
        }
    }

    /// The points after a moment, and the last one before it.
    pub(super) fn since(&self, after: Duration) -> &[(Duration, Pose)] {
        let later = self.points.partition_point(|(at, _)| *at <= after);
        self.points.get(later.saturating_sub(1)..).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const fn ms(count: u64) -> Duration {
        Duration::from_millis(count)
    }

    fn times(track: &Track, after: Duration) -> Vec<u128> {
        track.since(after).iter().map(|(at, _)| at.as_millis()).collect()
    }

    #[test]
    fn points_are_50_ms_apart() {
        let mut track = Track::default();
        for at in (0..=200).step_by(20).map(ms) {
            if track.is_due(at) {
                track.note(at, Pose::default());
            }
        }
        assert_eq!(times(&track, Duration::ZERO), [0, 60, 120, 180]);
        assert_eq!(times(&track, ms(100)), [60, 120, 180]);
        assert_eq!(times(&track, ms(500)), [180]);
    }

    #[test]
    fn time_may_go_back() {
        let mut track = Track::default();
        for at in [0, 60, 120, 60] {
            track.note(ms(at), Pose::default());
        }
        assert_eq!(times(&track, Duration::ZERO), [0, 60]);
    }

    #[test]
    fn memory_is_bounded() {
        let mut track = Track::default();
        for at in (0..3_600_000).step_by(50).map(ms) {
            if track.is_due(at) {
                track.note(at, Pose::default());
            }
        }
        assert!(track.points.len() < MOST);
        assert_eq!(times(&track, Duration::ZERO).first(), Some(&0));
    }
}
