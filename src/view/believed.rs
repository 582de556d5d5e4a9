//! Where the program believes the robot to be, in the world.
//!
//! Odometry counts from where the robot was when it was set, or from a pose that the program
//! gives. If that pose is near the true one, then the program counts in the world's frame. Else
//! its frame is laid on the robot as it truly was at that moment.
use super::notes::notes;
use super::reach::running_simulation;
use super::state::{self, Decimal, OrNull, fine, text};
use crate::glue::state::{known_drive, watched};
use crate::glue::watch::Frame;
use ev3_driver::drive::Believed;
use ev3_driver::lock::locked;
use ev3_motion::{Pose, wrapped};
use std::sync::Mutex;
use std::time::Duration;

/// How far a pose may be from the true one to be one in the world, in cm and degrees.
const NEAR: f64 = 25.0;
const ABOUT: f64 = 30.0;

/// A robot was set, whose odometry begins at the origin.
pub(crate) fn counting_begins() {
    pose_is_set(Pose { x: 0.0, y: 0.0, heading: 0.0 });
}

/// The program has said where the robot is.
pub(crate) fn pose_is_set(believed: Pose) {
    let Some(simulation) = running_simulation() else {
        *watched().frame() = None;
        return;
    };
    let ev3_sim::Pose { x, y, heading } = simulation.machine().pose();
    let real = Pose { x, y, heading };
    let is_near = (believed.x - x).hypot(believed.y - y) <= NEAR
        && wrapped(believed.heading - heading).abs() <= ABOUT;
    *watched().frame() = (!is_near).then_some(Frame { believed, real });
}

/// The program knows where the robot is in the world.
pub(crate) fn pose_is_of_world() {
    *watched().frame() = None;
}

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
