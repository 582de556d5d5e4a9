//! The place in the world where the program believes the robot to be.
//!
//! The drive notes in which frame the odometry counts.
use super::notes::notes;
use super::state::{self, Decimal, OrNull, fine, text};
use crate::glue::state::{known_drive, watched};
use crate::glue::watch::Frame;
use ev3_driver::drive::Believed;
use ev3_motion::Pose;
use ev3_os::locked;
use std::sync::Mutex;
use std::time::Duration;

/// What the drive knows, without looking; with the way after a moment. While a thread of the
/// program is at it, what it knew last, without the way.
pub(super) fn believed(after: Duration) -> Option<Believed> {
    static LAST: Mutex<Option<(u64, Believed)>> = Mutex::new(None);
    let drive = known_drive()?;
    let mut last = locked(&LAST);
    match drive.peek(after) {
        Some(believed) => {
            *last = Some((watched().film(), Believed { way: Vec::new(), ..believed.clone() }));
            Some(believed)
        }
        None => {
            last.as_ref().filter(|(of, _)| *of == watched().film()).map(|(_, last)| last.clone())
        }
    }
}

/// From the odometry's frame to the world's.
#[derive(Clone, Copy)]
pub(super) struct ToWorld(Option<Frame>);

impl ToWorld {
    pub(super) fn now() -> Self {
        Self(*watched().frame())
    }

    pub(super) fn pose(self, pose: Pose) -> Pose {
        let Some(Frame { believed, real }) = self.0 else {
            return pose;
        };
        let turn = real.heading - believed.heading;
        let (sin, cos) = turn.to_radians().sin_cos();
        let (x, y) = (pose.x - believed.x, pose.y - believed.y);
        Pose {
            x: real.x + x * cos + y * sin,
            y: real.y - x * sin + y * cos,
            heading: pose.heading + turn,
        }
    }

    pub(super) fn point(self, [x, y]: [f64; 2]) -> [f64; 2] {
        let Pose { x, y, .. } = self.pose(Pose { x, y, heading: 0.0 });
        [x, y]
    }

    /// The turn from the odometry's frame to the world's, clockwise in degrees.
    pub(super) fn turn(self) -> f64 {
        self.0.map_or(0.0, |frame| frame.real.heading - frame.believed.heading)
    }
}

/// The ellipse of one standard deviation: its semi-axes, the longer one first, and the heading of
/// that.
pub(super) fn ellipse(covariance: [[f64; 3]; 3]) -> [f64; 3] {
    let [[xx, xy, _], [_, yy, _], _] = covariance;
    let (mean, half) = (f64::midpoint(xx, yy), (xx - yy) / 2.0);
    let root = half.hypot(xy);
    let angle = 0.5 * xy.atan2(half);
    let axis = |variance: f64| variance.max(0.0).sqrt();
    [axis(mean + root), axis(mean - root), 90.0 - angle.to_degrees()]
}

/// Where the program believes the robot to be; where it is to go is kept.
pub(super) fn believe(believed: Option<&Believed>) -> Option<state::Believed> {
    let to_world = ToWorld::now();
    let course = believed.and_then(|believed| believed.course.as_deref()).unwrap_or_default();
    let path: Vec<_> =
        course.iter().map(|point| to_world.point(*point).map(Decimal::<1>)).collect();
    notes().keep("path", text(&OrNull((!path.is_empty()).then_some(path))));
    let Believed { pose, covariance, .. } = believed?;
    let ours = to_world.pose(*pose);
    let [a, b, heading] = ellipse(*covariance);
    Some(state::Believed {
        pose: fine([ours.x, ours.y, ours.heading]),
        odometry: fine([pose.x, pose.y, pose.heading]),
        ellipse: fine([a, b, heading + to_world.turn()]),
    })
}
