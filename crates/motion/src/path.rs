//! Paths of straight lines and arcs.
use crate::plane::{Point, direction, distance};
use crate::pose::Pose;
use crate::segment::Segment;

/// How far ahead on a path to aim at, in cm.
const AHEAD: f64 = 4.0;

/// A path: segments, each of which begins where the one before ends.
///
/// Arcs begin and end in the direction of the lines next to them. Where two
/// lines meet is a corner, at which the robot turns on the spot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Path {
    segments: Vec<Segment>,
}

impl Path {
    /// A path of these segments; those without a length are left out.
    pub fn new(mut segments: Vec<Segment>) -> Self {
        segments.retain(|segment| segment.length() > 1e-9);
        Self { segments }
    }

    /// The lines through these points.
    pub fn straight(corners: &[Point]) -> Self {
        Self::new(corners.windows(2).map(|pair| Segment::line(pair[0], pair[1])).collect())
    }

    /// Its segments.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Where segments begin and end.
    pub fn points(&self) -> Vec<Point> {
        let first = self.segments.first().map(Segment::from);
        first.into_iter().chain(self.segments.iter().map(Segment::to)).collect()
    }

    /// In cm.
    pub fn length(&self) -> f64 {
        self.segments.iter().map(Segment::length).sum()
    }

    /// Its beginning, up to a distance in cm.
    pub fn until(&self, mut way: f64) -> Self {
        let mut segments = Vec::new();
        for segment in &self.segments {
            let length = segment.length();
            segments.push(if length > way { segment.with_length(way) } else { *segment });
            way -= length;
            if way <= 0.0 {
                break;
            }
        }
        Self::new(segments)
    }

    /// Poses along it, at most a step apart, each with the distance from its start.
    pub fn samples(&self, step: f64) -> impl Iterator<Item = (f64, Pose)> + '_ {
        let mut before = 0.0;
        self.segments.iter().flat_map(move |segment| {
            let start = before;
            before += segment.length();
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small")]
            let count = libm::ceil(segment.length() / step) as u32;
            (0..=count).map(move |index| {
                let way = segment.length() * f64::from(index) / f64::from(count.max(1));
                (start + way, segment.at(way))
            })
        })
    }

    /// The heading at its start, in degrees.
    pub fn heading(&self) -> f64 {
        let start = self.segments.first().map_or([0.0; 2], Segment::from);
        direction(start, self.beyond(AHEAD))
    }

    /// How a robot at a pose stays on its way: how much of the way it has behind it, in cm, given
    /// how much it had before; and by how much to turn on each cm, in degrees, clockwise positive.
    pub fn steer(&self, at: Pose, before: f64) -> (f64, f64) {
        let window = before..=before + 2.0 * AHEAD;
        let near = self.samples(0.5).filter(|(way, _)| window.contains(way));
        let from = |pose: Pose| distance(pose.point(), at.point());
        let nearest = near.min_by(|a, b| from(a.1).total_cmp(&from(b.1)));
        let way = nearest.map_or(before, |(way, _)| way);
        let aim = self.beyond(way + AHEAD);
        let far = distance(at.point(), aim).max(1.0);
        // The arc through the pose that meets the point aimed at
        let aside = Segment::arc(at, 0.0, 0.0).locate(aim, 0.0).aside;
        (way, (2.0 * aside / (far * far)).to_degrees())
    }

    /// The point after a distance in cm; past the end straight on.
    fn beyond(&self, way: f64) -> Point {
        let mut left = way;
        for segment in &self.segments {
            if left <= segment.length() {
                return segment.at(left).point();
            }
            left -= segment.length();
        }
        self.segments.last().map_or([0.0; 2], |segment| segment.end().ahead(left).point())
    }
}
