//! Things that stop robots, sound and light: boxes and circles, and where a hull touches them.

use ev3_motion::{Bounds, Frame, Pose, Vec2, frame, length, outside};
use parry2d_f64::math::Point;
use parry2d_f64::query::{self, PointQuery, Ray, RayCast};
use parry2d_f64::shape::{Ball, Cuboid, Segment, Shape};

use crate::world::Hull;
use crate::world::{Item, ItemId, Shape as Outline, Traits};

/// How thick the walls of the bounds are.
const BOUND_THICKNESS: f64 = 10.0;

/// Farther than this, in cm, a rough distance will do.
const FAR: f64 = 10.0;

#[derive(Clone, Copy, Debug)]
enum Solid {
    Box(Cuboid),
    Ball(Ball),
}

/// A solid thing in its place.
#[derive(Clone, Debug)]
pub(crate) struct Obstacle {
    pub(crate) id: ItemId,
    solid: Solid,
    frame: Frame,
    /// The largest distance of a point of it from its center.
    reach: f64,
    /// Sound and light go over it.
    is_low: bool,
}

/// A place where a hull is at, or near, an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    pub(crate) id: ItemId,
    /// Distance left, in cm.
    pub(crate) gap: f64,
    /// Away from the obstacle.
    pub(crate) normal: Vec2,
    /// The point of the hull.
    pub(crate) point: Vec2,
    /// The number of this point among those at which they may touch; it stays the same.
    pub(crate) corner: u32,
}

impl Contact {
    /// The direction in which the hull may rub.
    pub(crate) fn along(&self) -> Vec2 {
        Vec2::new(-self.normal.y, self.normal.x)
    }
}

impl Obstacle {
    /// The solid form of an item, if it has one.
    pub(crate) fn new(id: ItemId, item: &Item) -> Option<Obstacle> {
        let is_low = item.traits().is_some_and(Traits::is_low);
        Obstacle::of_shape(id, item).map(|obstacle| obstacle.that_is_low(is_low))
    }

    fn of_shape(id: ItemId, item: &Item) -> Option<Obstacle> {
        match item.shape() {
            Outline::Bar { from: [x1, y1], to: [x2, y2], thickness } => {
                let way = Vec2::new(x2 - x1, y2 - y1);
                let long = length(way);
                let middle = Vec2::new(f64::midpoint(x1, x2), f64::midpoint(y1, y2));
                let frame = frame(middle, way.x / long, way.y / long);
                Some(Obstacle::cuboid(id, frame, long / 2.0, thickness / 2.0))
            }
            Outline::Box { pose, width, depth } => {
                Some(Obstacle::cuboid(id, pose.frame(), width / 2.0, depth / 2.0))
            }
            Outline::Disc { center: [x, y], radius } => Some(Obstacle {
                id,
                solid: Solid::Ball(Ball::new(radius)),
                frame: frame(Vec2::new(x, y), 1.0, 0.0),
                reach: radius,
                is_low: false,
            }),
            Outline::Area { .. } | Outline::Band { .. } | Outline::Mark { .. } => None,
        }
    }

    /// A robot in its place.
    pub(crate) fn robot(id: ItemId, hull: Hull, pose: &Pose) -> Obstacle {
        match hull_box(hull, &pose.frame()) {
            Some((outline, frame)) => {
                let half = outline.half_extents;
                Obstacle::cuboid(id, frame, half.x, half.y)
            }
            None => Obstacle {
                id,
                solid: Solid::Ball(Ball::new(hull.reach())),
                frame: pose.frame(),
                reach: hull.reach(),
                is_low: false,
            },
        }
    }

    fn cuboid(id: ItemId, frame: Frame, half_x: f64, half_y: f64) -> Obstacle {
        let half = Vec2::new(half_x, half_y);
        Obstacle {
            id,
            solid: Solid::Box(Cuboid::new(half)),
            frame,
            reach: length(half),
            is_low: false,
        }
    }

    /// The same where sound and light go over it, or do not.
    pub(crate) fn that_is_low(self, is_low: bool) -> Obstacle {
        Obstacle { is_low, ..self }
    }

    /// The four walls around the bounds: left, right, below, above.
    pub(crate) fn around(id: ItemId, bounds: Bounds) -> [Obstacle; 4] {
        let Bounds { low: [left, low], high: [right, high] } = bounds;
        let half = BOUND_THICKNESS / 2.0;
        let (x, y) = (f64::midpoint(left, right), f64::midpoint(low, high));
        let (half_x, half_y) = ((right - left) / 2.0, (high - low) / 2.0);
        let wall = |x: f64, y: f64, half_x: f64, half_y: f64| {
            Obstacle::cuboid(id, frame(Vec2::new(x, y), 1.0, 0.0), half_x, half_y)
        };
        [
            wall(left - half, y, half, half_y + BOUND_THICKNESS),
            wall(right + half, y, half, half_y + BOUND_THICKNESS),
            wall(x, low - half, half_x + BOUND_THICKNESS, half),
            wall(x, high + half, half_x + BOUND_THICKNESS, half),
        ]
    }

    fn shape(&self) -> &dyn Shape {
        match &self.solid {
            Solid::Box(cuboid) => cuboid,
            Solid::Ball(ball) => ball,
        }
    }

    /// How far a ray goes before it meets this, at most `max`. Its direction has length 1.
    pub(crate) fn cast(&self, ray: &Ray, max: f64) -> Option<f64> {
        let offset = self.frame.translation.vector - ray.origin.coords;
        let aside = ray.dir.x * offset.y - ray.dir.y * offset.x;
        if aside.abs() > self.reach || self.is_low {
            return None;
        }
        match &self.solid {
            Solid::Box(cuboid) => cuboid.cast_ray(&self.frame, ray, max, true),
            Solid::Ball(ball) => ball.cast_ray(&self.frame, ray, max, true),
        }
    }

    /// As [`cast`](Self::cast), with the surface's normal.
    pub(crate) fn surface(&self, ray: &Ray, max: f64) -> Option<(f64, Vec2)> {
        if self.is_low {
            return None;
        }
        let hit = self.shape().cast_ray_and_get_normal(&self.frame, ray, max, true)?;
        Some((hit.time_of_impact, hit.normal))
    }

    /// True only if this is certainly farther from a point than `limit`: by the larger of the
    /// distances along two axes, and by more than what rounding may do.
    pub(crate) fn is_beyond(&self, point: Vec2, limit: f64) -> bool {
        let offset = point - self.frame.translation.vector;
        let (aside, half) = match &self.solid {
            Solid::Box(cuboid) => {
                (self.frame.rotation.inverse_transform_vector(&offset), cuboid.half_extents)
            }
            Solid::Ball(ball) => (offset, Vec2::repeat(ball.radius)),
        };
        (aside.abs() - half).max() > limit + 1e-6
    }

    /// The item that it would be, a circle or a box.
    pub(crate) fn outline(&self) -> Item {
        let place = self.frame.translation.vector;
        match &self.solid {
            Solid::Ball(ball) => Item::circle([place.x, place.y], ball.radius),
            Solid::Box(Cuboid { half_extents: half }) => {
                let heading = -self.frame.rotation.angle().to_degrees();
                Item::boxed(Pose::new(place.x, place.y, heading), 2.0 * half.x, 2.0 * half.y)
            }
        }
    }

    /// Not farther than this obstacle is from a circle: cheap.
    pub(crate) fn at_least(&self, center: Vec2, radius: f64) -> f64 {
        length(self.frame.translation.vector - center) - self.reach - radius
    }

    /// How wide it is along a direction of length 1 through a point; `None` if the point is not in it.
    pub(crate) fn chord(&self, point: Vec2, direction: Vec2) -> Option<f64> {
        let point = Point::from(point);
        if !self.shape().contains_point(&self.frame, &point) {
            return None;
        }
        let ends = [direction, -direction].map(|direction| {
            let ray = Ray::new(point, direction);
            self.shape().cast_ray(&self.frame, &ray, 2.0 * self.reach, false)
        });
        Some(ends.into_iter().flatten().sum())
    }

    /// False only if another one is farther away than this, in cm: cheap.
    pub(crate) fn may_be_within(&self, other: &Obstacle, distance: f64) -> bool {
        let way = self.frame.translation.vector - other.frame.translation.vector;
        let most = self.reach + other.reach + distance;
        way.dot(&way) <= most * most
    }

    /// Whether a hull is nearer than this, in cm.
    pub(crate) fn is_nearer(&self, hull: Hull, pose: &Pose, distance: f64) -> bool {
        let mut is_nearer = false;
        self.touch_points(hull, &pose.frame(), 0, |contact| is_nearer |= contact.gap < distance);
        is_nearer
    }

    /// How far a hull is from it, in cm; below 0 where they overlap. It may be less than that if it
    /// is far.
    pub(crate) fn gap(&self, hull: Hull, pose: &Pose) -> f64 {
        let rough = self.at_least(pose.vec2(), hull.reach());
        if rough > FAR {
            return rough;
        }
        let mut gap = f64::INFINITY;
        self.touch_points(hull, &pose.frame(), 0, |contact| gap = gap.min(contact.gap));
        gap
    }

    /// True if it overlaps a hull.
    pub(crate) fn overlaps(&self, hull: Hull, pose: &Pose) -> bool {
        let frame = pose.frame();
        let test = if let Some((outline, center)) = hull_box(hull, &frame) {
            query::intersection_test(&center, &outline, &self.frame, self.shape())
        } else {
            let outline = Ball::new(hull.reach());
            query::intersection_test(&frame, &outline, &self.frame, self.shape())
        };
        test.unwrap_or(false)
    }

    /// True if it overlaps another one.
    pub(crate) fn meets(&self, other: &Obstacle) -> bool {
        let test = query::intersection_test(&self.frame, self.shape(), &other.frame, other.shape());
        test.unwrap_or(false)
    }

    /// True if it is within `distance` of a straight line between two points.
    pub(crate) fn near_line(&self, from: Vec2, to: Vec2, distance: f64) -> bool {
        let line = Segment::new(Point::from(from), Point::from(to));
        self.at_least((from + to) / 2.0, length(to - from) / 2.0) <= distance
            && query::distance(&Frame::identity(), &line, &self.frame, self.shape())
                .is_ok_and(|gap| gap <= distance)
    }

    /// The points at which a hull may touch this; the first one is that corner. The nearest points
    /// of two convex outlines always include a corner of one of them, so it is enough to look at
    /// the corners.
    pub(crate) fn touch_points(
        &self,
        hull: Hull,
        frame: &Frame,
        mut corner: u32,
        mut each: impl FnMut(Contact),
    ) {
        let mut found = |gap, normal, point| {
            each(Contact { id: self.id, gap, normal, point, corner });
            corner += 1;
        };
        let middle = frame.translation.vector;
        let center = self.frame.translation.vector;
        match (hull_box(hull, frame), &self.solid) {
            (None, Solid::Box(cuboid)) => {
                let (distance, normal) = away_from(cuboid, &self.frame, middle);
                let radius = hull.reach();
                found(distance - radius, normal, middle - normal * radius);
            }
            (None, Solid::Ball(ball)) => {
                let offset = middle - center;
                let distance = length(offset).max(1e-9);
                let normal = offset / distance;
                let radius = hull.reach();
                found(distance - radius - ball.radius, normal, middle - normal * radius);
            }
            (Some((outline, place)), Solid::Ball(ball)) => {
                let (distance, normal) = away_from(&outline, &place, center);
                found(distance - ball.radius, -normal, center - normal * distance);
            }
            (Some((outline, place)), Solid::Box(cuboid)) => {
                for corner in corners(&outline, &place) {
                    let (distance, normal) = away_from(cuboid, &self.frame, corner);
                    found(distance, normal, corner);
                }
                for corner in corners(cuboid, &self.frame) {
                    let (distance, normal) = away_from(&outline, &place, corner);
                    found(distance, -normal, corner);
                }
            }
        }
    }
}

/// A rectangular hull and the frame of its center.
fn hull_box(hull: Hull, frame: &Frame) -> Option<(Cuboid, Frame)> {
    let Hull::Rectangle { width, length, offset } = hull else {
        return None;
    };
    let center = outside(frame, Vec2::new(0.0, offset));
    let outline = Cuboid::new(Vec2::new(width / 2.0, length / 2.0));
    Some((outline, Frame::from_parts(center.into(), frame.rotation)))
}

/// The corners of a box around its center.
fn corners(cuboid: &Cuboid, frame: &Frame) -> [Vec2; 4] {
    let (x, y) = (cuboid.half_extents.x, cuboid.half_extents.y);
    [(x, y), (x, -y), (-x, -y), (-x, y)].map(|(x, y)| outside(frame, Vec2::new(x, y)))
}

/// Signed distance of a point from a box, and the direction away from the box.
fn away_from(cuboid: &Cuboid, frame: &Frame, point: Vec2) -> (f64, Vec2) {
    let projection = cuboid.project_point(frame, &Point::from(point), false);
    let offset = point - projection.point.coords;
    let distance = length(offset);
    if distance < 1e-9 {
        let outwards = point - frame.translation.vector;
        return (0.0, outwards / length(outwards).max(1e-9));
    }
    let signed = if projection.is_inside { -distance } else { distance };
    (signed, offset / signed)
}
