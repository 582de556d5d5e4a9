//! The world as the physics and the sensors need it: shapes to bump into, to see, to stand on.

use parry2d_f64::math::Point;
use parry2d_f64::query::{self, PointQuery, Ray, RayCast};
use parry2d_f64::shape::{Ball, Cuboid, Segment, Shape};
use parry2d_f64::utils::point_in_poly2d;

use crate::colour::Colour;
use crate::geometry::{Frame, Pose, Vec2, frame, length, outside};
use crate::robot::Hull;
use crate::world::{Bounds, Item, SpecError, WorldSpec};

/// Names an item of a world. Bounds are item 0, the items of the world's spec follow in order,
/// and what is added later gets the next number; numbers are not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ItemId(pub u32);

const BOUNDS: ItemId = ItemId(0);
/// How thick the walls of the bounds are.
const BOUND_THICKNESS: f64 = 10.0;

#[derive(Clone, Copy, Debug)]
enum Solid {
    Box(Cuboid),
    Ball(Ball),
}

/// A thing that stops robots, sound and light.
#[derive(Clone, Debug)]
struct Obstacle {
    id: ItemId,
    solid: Solid,
    frame: Frame,
    reach: f64,
}

/// A place where the hull is at, or near, an obstacle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contact {
    pub(crate) id: ItemId,
    /// Distance left, in cm.
    pub(crate) gap: f64,
    /// Away from the obstacle.
    pub(crate) normal: Vec2,
    /// The point of the hull.
    pub(crate) point: Vec2,
}

impl Obstacle {
    fn new(id: ItemId, solid: Solid, frame: Frame) -> Self {
        let reach = match &solid {
            Solid::Box(cuboid) => libm::hypot(cuboid.half_extents.x, cuboid.half_extents.y),
            Solid::Ball(ball) => ball.radius,
        };
        Obstacle {
            id,
            solid,
            frame,
            reach,
        }
    }

    fn shape(&self) -> &dyn Shape {
        match &self.solid {
            Solid::Box(cuboid) => cuboid,
            Solid::Ball(ball) => ball,
        }
    }

    fn cast(&self, ray: &Ray, max: f64) -> Option<f64> {
        match &self.solid {
            Solid::Box(cuboid) => cuboid.cast_ray(&self.frame, ray, max, true),
            Solid::Ball(ball) => ball.cast_ray(&self.frame, ray, max, true),
        }
    }
}

/// The corners of a box around its centre.
fn corners(cuboid: &Cuboid, frame: &Frame) -> [Vec2; 4] {
    let (x, y) = (cuboid.half_extents.x, cuboid.half_extents.y);
    [(x, y), (x, -y), (-x, -y), (-x, y)].map(|(x, y)| outside(frame, Vec2::new(x, y)))
}

/// Signed distance of a point from a box, and the direction away from the box.
fn away_from(cuboid: &Cuboid, frame: &Frame, point: Vec2) -> (f64, Vec2) {
    let projection = cuboid.project_point(frame, &Point::from(point), false);
    let offset = point - projection.point.coords;
    let distance = length(offset);
    let inside = projection.is_inside;
    if distance < 1e-9 {
        let outwards = point - frame.translation.vector;
        return (0.0, outwards / length(outwards).max(1e-9));
    }
    let normal = offset / if inside { -distance } else { distance };
    (if inside { -distance } else { distance }, normal)
}

fn hull_box(hull: Hull, frame: &Frame) -> Option<(Cuboid, Frame)> {
    let Hull::Rectangle {
        width,
        length,
        offset,
    } = hull
    else {
        return None;
    };
    let cuboid = Cuboid::new(Vec2::new(width / 2.0, length / 2.0));
    let centre = outside(frame, Vec2::new(0.0, offset));
    Some((cuboid, Frame::from_parts(centre.into(), frame.rotation)))
}

/// A world in working order.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    items: Vec<(ItemId, Item)>,
    obstacles: Vec<Obstacle>,
    pub(crate) bounds: Option<Bounds>,
    pub(crate) floor: Colour,
    pub(crate) ambient: f64,
    next_id: u32,
}

impl Scene {
    pub(crate) fn new(spec: &WorldSpec) -> Result<Scene, SpecError> {
        spec.validate()?;
        let mut scene = Scene {
            items: Vec::new(),
            obstacles: Vec::new(),
            bounds: spec.bounds,
            floor: spec.floor,
            ambient: spec.ambient,
            next_id: 1,
        };
        if let Some(bounds) = spec.bounds {
            scene.add_bounds(bounds);
        }
        for item in &spec.items {
            scene.add(item.clone())?;
        }
        Ok(scene)
    }

    fn add_bounds(&mut self, Bounds { low, high }: Bounds) {
        let thick = BOUND_THICKNESS;
        let centre = [
            f64::midpoint(low[0], high[0]),
            f64::midpoint(low[1], high[1]),
        ];
        let half = [(high[0] - low[0]) / 2.0, (high[1] - low[1]) / 2.0];
        let mut add = |x: f64, y: f64, half_x: f64, half_y: f64| {
            let solid = Solid::Box(Cuboid::new(Vec2::new(half_x, half_y)));
            let frame = frame(Vec2::new(x, y), 1.0, 0.0);
            self.obstacles.push(Obstacle::new(BOUNDS, solid, frame));
        };
        add(
            low[0] - thick / 2.0,
            centre[1],
            thick / 2.0,
            half[1] + thick,
        );
        add(
            high[0] + thick / 2.0,
            centre[1],
            thick / 2.0,
            half[1] + thick,
        );
        add(
            centre[0],
            low[1] - thick / 2.0,
            half[0] + thick,
            thick / 2.0,
        );
        add(
            centre[0],
            high[1] + thick / 2.0,
            half[0] + thick,
            thick / 2.0,
        );
    }

    pub(crate) fn add(&mut self, item: Item) -> Result<ItemId, SpecError> {
        item.validate()?;
        let id = ItemId(self.next_id);
        self.next_id += 1;
        if let Some((solid, frame)) = solid(&item) {
            self.obstacles.push(Obstacle::new(id, solid, frame));
        }
        self.items.push((id, item));
        Ok(id)
    }

    pub(crate) fn remove(&mut self, id: ItemId) -> bool {
        let before = self.items.len();
        self.items.retain(|(other, _)| *other != id);
        if self.items.len() == before {
            return false;
        }
        self.obstacles.retain(|obstacle| obstacle.id != id);
        true
    }

    pub(crate) fn items(&self) -> &[(ItemId, Item)] {
        &self.items
    }

    /// How far a ray goes before it meets something, at most `max`.
    pub(crate) fn cast(&self, from: Vec2, direction: Vec2, max: f64) -> Option<f64> {
        let ray = Ray::new(Point::from(from), direction);
        let mut nearest = None;
        let mut limit = max;
        for obstacle in &self.obstacles {
            if let Some(distance) = obstacle.cast(&ray, limit) {
                limit = distance;
                nearest = Some(distance);
            }
        }
        nearest
    }

    /// True if nothing stands between two points.
    pub(crate) fn clear_between(&self, from: Vec2, to: Vec2) -> bool {
        let way = to - from;
        let far = length(way);
        far < 1e-9 || self.cast(from, way / far, far).is_none()
    }

    /// The lamps: where they hang and how bright they are.
    pub(crate) fn lamps(&self) -> impl Iterator<Item = (Vec2, f64)> {
        self.items.iter().filter_map(|(_, item)| match item {
            Item::Lamp {
                at: [x, y],
                intensity,
            } => Some((Vec2::new(*x, *y), *intensity)),
            _ => None,
        })
    }

    /// The colour of the floor at a point.
    pub(crate) fn colour_at(&self, point: Vec2) -> Colour {
        let on_top = self.items.iter().rev().find_map(|(_, item)| match item {
            Item::Patch { corners, colour } => {
                let corners: Vec<_> = corners.iter().copied().map(Point::from).collect();
                point_in_poly2d(&Point::from(point), &corners).then_some(*colour)
            }
            Item::Line {
                points,
                width,
                colour,
            } => {
                let near = |pair: &[[f64; 2]]| {
                    let part = Segment::new(Point::from(pair[0]), Point::from(pair[1]));
                    part.distance_to_local_point(&Point::from(point), true) <= width / 2.0
                };
                points.windows(2).any(near).then_some(*colour)
            }
            _ => None,
        });
        on_top.unwrap_or(self.floor)
    }

    /// Collects where a hull is within `margin` of an obstacle, and answers a distance that the
    /// hull can certainly go without coming that near anywhere else.
    pub(crate) fn contacts(
        &self,
        hull: Hull,
        frame: &Frame,
        margin: f64,
        contacts: &mut Vec<Contact>,
    ) -> f64 {
        contacts.clear();
        let reach = hull.reach();
        let mut free = f64::INFINITY;
        for obstacle in &self.obstacles {
            let offset = obstacle.frame.translation.vector - frame.translation.vector;
            let rough = length(offset) - obstacle.reach - reach;
            if rough > free.min(20.0).max(margin) {
                free = free.min(rough);
                continue;
            }
            let mut found = |gap: f64, normal: Vec2, point: Vec2| {
                free = free.min(gap);
                if gap < margin {
                    contacts.push(Contact {
                        id: obstacle.id,
                        gap,
                        normal,
                        point,
                    });
                }
            };
            touch_points(hull, frame, obstacle, &mut found);
        }
        free
    }

    /// True if a hull in this place overlaps an obstacle, and which one.
    pub(crate) fn overlap(&self, hull: Hull, pose: &Pose) -> Option<ItemId> {
        let frame = pose.frame();
        let overlaps = |obstacle: &&Obstacle| {
            let test = match hull_box(hull, &frame) {
                Some((cuboid, pose)) => {
                    query::intersection_test(&pose, &cuboid, &obstacle.frame, obstacle.shape())
                }
                None => query::intersection_test(
                    &frame,
                    &Ball::new(hull.reach()),
                    &obstacle.frame,
                    obstacle.shape(),
                ),
            };
            test.unwrap_or(false)
        };
        self.obstacles
            .iter()
            .find(overlaps)
            .map(|obstacle| obstacle.id)
    }

    /// True if an obstacle is within `distance` of a straight bumper.
    pub(crate) fn near_bumper(&self, from: Vec2, to: Vec2, distance: f64) -> bool {
        let bumper = Segment::new(Point::from(from), Point::from(to));
        let here = Frame::identity();
        let middle = (from + to) / 2.0;
        let half = length(to - from) / 2.0;
        self.obstacles.iter().any(|obstacle| {
            let offset = obstacle.frame.translation.vector - middle;
            let rough = length(offset) - obstacle.reach - half;
            rough <= distance
                && query::distance(&here, &bumper, &obstacle.frame, obstacle.shape())
                    .is_ok_and(|gap| gap <= distance)
        })
    }
}

/// The points at which a hull and an obstacle may touch. The nearest points of two convex
/// outlines always include a corner of one of them, so it is enough to look at the corners.
fn touch_points(
    hull: Hull,
    frame: &Frame,
    obstacle: &Obstacle,
    found: &mut impl FnMut(f64, Vec2, Vec2),
) {
    match (hull_box(hull, frame), &obstacle.solid) {
        (None, Solid::Box(cuboid)) => {
            let (distance, normal) = away_from(cuboid, &obstacle.frame, frame.translation.vector);
            let radius = hull.reach();
            found(
                distance - radius,
                normal,
                frame.translation.vector - normal * radius,
            );
        }
        (None, Solid::Ball(ball)) => {
            let offset = frame.translation.vector - obstacle.frame.translation.vector;
            let distance = length(offset).max(1e-9);
            let normal = offset / distance;
            let radius = hull.reach();
            found(
                distance - radius - ball.radius,
                normal,
                frame.translation.vector - normal * radius,
            );
        }
        (Some((outline, pose)), Solid::Ball(ball)) => {
            let centre = obstacle.frame.translation.vector;
            let (distance, normal) = away_from(&outline, &pose, centre);
            found(distance - ball.radius, -normal, centre - normal * distance);
        }
        (Some((outline, pose)), Solid::Box(cuboid)) => {
            for corner in corners(&outline, &pose) {
                let (distance, normal) = away_from(cuboid, &obstacle.frame, corner);
                found(distance, normal, corner);
            }
            for corner in corners(cuboid, &obstacle.frame) {
                let (distance, normal) = away_from(&outline, &pose, corner);
                found(distance, -normal, corner);
            }
        }
    }
}

/// The solid form of an item, if it has one.
fn solid(item: &Item) -> Option<(Solid, Frame)> {
    match *item {
        Item::Wall {
            from: [x1, y1],
            to: [x2, y2],
            thickness,
        } => {
            let way = Vec2::new(x2 - x1, y2 - y1);
            let long = length(way);
            let middle = Vec2::new(f64::midpoint(x1, x2), f64::midpoint(y1, y2));
            let cuboid = Cuboid::new(Vec2::new(long / 2.0, thickness / 2.0));
            Some((
                Solid::Box(cuboid),
                frame(middle, way.x / long, way.y / long),
            ))
        }
        Item::Box { pose, width, depth } => Some((
            Solid::Box(Cuboid::new(Vec2::new(width / 2.0, depth / 2.0))),
            pose.frame(),
        )),
        Item::Circle {
            centre: [x, y],
            radius,
        } => Some((
            Solid::Ball(Ball::new(radius)),
            frame(Vec2::new(x, y), 1.0, 0.0),
        )),
        Item::Patch { .. } | Item::Line { .. } | Item::Lamp { .. } => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_meet_walls_boxes_and_circles() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let up = Vec2::new(0.0, 1.0);
        assert_eq!(scene.cast(Vec2::zeros(), up, 255.0), None);
        let wall = scene
            .add(Item::wall([-50.0, 100.0], [50.0, 100.0]))
            .unwrap();
        let near = |expected: f64, scene: &Scene| {
            let distance = scene.cast(Vec2::zeros(), up, 255.0).unwrap();
            assert!((distance - expected).abs() < 1e-9, "{distance}");
        };
        near(99.5, &scene);
        scene
            .add(Item::Circle {
                centre: [0.0, 80.0],
                radius: 5.0,
            })
            .unwrap();
        near(75.0, &scene);
        let pose = Pose::new(0.0, 50.0, 45.0);
        let diamond = scene
            .add(Item::Box {
                pose,
                width: 10.0,
                depth: 10.0,
            })
            .unwrap();
        near(50.0 - 50.0_f64.sqrt(), &scene);
        assert!(!scene.clear_between(Vec2::zeros(), Vec2::new(0.0, 60.0)));
        assert!(scene.remove(diamond) && scene.remove(wall) && !scene.remove(wall));
        near(75.0, &scene);
    }

    #[test]
    fn floors_cover_each_other_in_order() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let red = "red".parse().unwrap();
        scene
            .add(Item::rectangle([0.0, 0.0], [10.0, 10.0], red))
            .unwrap();
        let points = vec![[0.0, 5.0], [20.0, 5.0], [20.0, 20.0]];
        scene
            .add(Item::Line {
                points,
                width: 2.0,
                colour: Colour::BLACK,
            })
            .unwrap();
        let at = |x, y| scene.colour_at(Vec2::new(x, y));
        assert_eq!(at(-1.0, 1.0), Colour::WHITE);
        assert_eq!(at(5.0, 8.0), red);
        assert_eq!(at(5.0, 5.9), Colour::BLACK);
        assert_eq!(at(19.5, 15.0), Colour::BLACK);
    }

    #[test]
    fn impossible_items_are_named() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let error = scene
            .add(Item::Circle {
                centre: [0.0, 0.0],
                radius: -1.0,
            })
            .unwrap_err();
        assert!(error.to_string().starts_with("circle"), "{error}");
        assert!(scene.add(Item::wall([1.0, 1.0], [1.0, 1.0])).is_err());
        assert!(
            scene
                .add(Item::Lamp {
                    at: [f64::NAN, 0.0],
                    intensity: 1.0
                })
                .is_err()
        );
    }
}
