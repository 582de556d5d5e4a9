//! The world as the physics and the sensors need it: shapes to bump into, to see, to stand on.

use ev3_motion::{Bounds, Frame, Pose, Vec2, length};
use parry2d_f64::math::Point;
use parry2d_f64::query::{PointQuery, Ray};
use parry2d_f64::shape::Segment;
use parry2d_f64::utils::point_in_poly2d;

use crate::brick::remote::{CHANNELS, Remote};
use crate::world::Hull;
use crate::world::color::Color;
use crate::world::obstacle::{Contact, Obstacle};
use crate::world::{Item, ItemId, SpecError, WorldSpec};

const BOUNDS: ItemId = ItemId(0);
/// Two boxes may touch at the corners of both.
const MOST_CORNERS: usize = 8;

/// The other robots of a world, and the things that move, as obstacles.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Others<'a> {
    pub(crate) before: &'a [Obstacle],
    pub(crate) after: &'a [Obstacle],
    pub(crate) things: &'a [Obstacle],
}

impl<'a> Others<'a> {
    pub(crate) fn iter(self) -> impl Iterator<Item = &'a Obstacle> {
        self.robots().chain(self.things)
    }

    pub(crate) fn robots(self) -> impl Iterator<Item = &'a Obstacle> {
        self.before.iter().chain(self.after)
    }
}

/// A world in working order.
#[derive(Clone, Debug)]
pub(crate) struct Scene {
    items: Vec<(ItemId, Item)>,
    obstacles: Vec<Obstacle>,
    pub(crate) bounds: Option<Bounds>,
    pub(crate) floor: Color,
    pub(crate) ambient: f64,
    pub(crate) temperature: f64,
    pub(crate) loudness: f64,
    /// Where the robot starts.
    pub(crate) start: Pose,
    /// And those of several robots.
    pub(crate) starts: Vec<(String, Pose)>,
    /// What is held down on each channel of remote controls.
    pub(crate) remotes: [Remote; CHANNELS],
    next_id: u32,
}

/// The obstacle that an item is, if it does not move. The scene has no obstacles that move.
fn fixed(id: ItemId, item: &Item) -> Option<Obstacle> {
    if item.movable().is_some() { None } else { Obstacle::new(id, item) }
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
            temperature: spec.temperature,
            loudness: spec.loudness,
            start: spec.start,
            starts: spec.starts.clone(),
            remotes: [Remote::NONE; CHANNELS],
            next_id: 1,
        };
        if let Some(bounds) = spec.bounds {
            scene.obstacles.extend(Obstacle::around(BOUNDS, bounds));
        }
        for item in &spec.items {
            scene.add(item.clone())?;
        }
        Ok(scene)
    }

    pub(crate) fn add(&mut self, item: Item) -> Result<ItemId, SpecError> {
        item.validate()?;
        let id = ItemId(self.next_id);
        self.next_id += 1;
        self.obstacles.extend(fixed(id, &item));
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

    /// Puts an item in the place of another, whose number it gets; the other one, if there is one.
    pub(crate) fn replace(&mut self, id: ItemId, item: Item) -> Result<Option<Item>, SpecError> {
        item.validate()?;
        let Some((_, old)) = self.items.iter_mut().find(|(other, _)| *other == id) else {
            return Ok(None);
        };
        let place = self.obstacles.iter().position(|obstacle| obstacle.id == id);
        self.obstacles.retain(|obstacle| obstacle.id != id);
        let place = place.unwrap_or(self.obstacles.len());
        let obstacles: Vec<_> = fixed(id, &item).into_iter().collect();
        self.obstacles.splice(place..place, obstacles);
        // The world is another one.
        self.next_id += 1;
        Ok(Some(std::mem::replace(old, item)))
    }

    /// A number that changes with each item that comes or goes.
    pub(crate) fn version(&self) -> u64 {
        // Each one that comes has a new number, and those that go leave fewer.
        u64::from(self.next_id) << 32 | self.items.len() as u64
    }

    pub(crate) fn items(&self) -> &[(ItemId, Item)] {
        &self.items
    }

    /// How far a ray goes before it meets something, at most `max`.
    pub(crate) fn cast(
        &self,
        others: Others,
        from: Vec2,
        direction: Vec2,
        max: f64,
    ) -> Option<f64> {
        self.first(others, from, direction, max).map(|(distance, _)| distance)
    }

    fn first(
        &self,
        others: Others,
        from: Vec2,
        direction: Vec2,
        max: f64,
    ) -> Option<(f64, ItemId)> {
        let ray = Ray::new(Point::from(from), direction);
        let mut nearest = None;
        let mut limit = max;
        for obstacle in self.obstacles.iter().chain(others.iter()) {
            if let Some(distance) = obstacle.cast(&ray, limit) {
                limit = distance;
                nearest = Some((distance, obstacle.id));
            }
        }
        nearest
    }

    /// How far a ray goes before it meets something, at most `max`, and the color that a fact gives
    /// it.
    pub(crate) fn painted(
        &self,
        others: Others,
        from: Vec2,
        direction: Vec2,
        max: f64,
    ) -> Option<(f64, Option<Color>)> {
        let (distance, met) = self.first(others, from, direction, max)?;
        let item = self.items.iter().find(|(id, _)| *id == met);
        Some((distance, item.and_then(|(_, item)| item.traits()?.color)))
    }

    /// What a ray meets first, at most `max` away: how far it is, and the surface's normal.
    pub(crate) fn surface(
        &self,
        others: Others,
        from: Vec2,
        direction: Vec2,
        max: f64,
    ) -> Option<(f64, Vec2)> {
        let ray = Ray::new(Point::from(from), direction);
        let obstacles = self.obstacles.iter().chain(others.iter());
        let hits = obstacles.filter_map(|obstacle| obstacle.surface(&ray, max));
        hits.min_by(|(a, _), (b, _)| a.total_cmp(b))
    }

    /// How far the first of some rays goes to meet something, at most `max`. What the middle one
    /// meets leaves few obstacles that the others could meet before.
    pub(crate) fn cast_all(
        &self,
        others: Others,
        from: Vec2,
        directions: &[Vec2],
        max: f64,
    ) -> Option<f64> {
        let middle = directions.get(directions.len() / 2)?;
        let mut nearest = self.cast(others, from, *middle, max);
        let mut limit = nearest.unwrap_or(max);
        for obstacle in self.obstacles.iter().chain(others.iter()) {
            if obstacle.is_beyond(from, limit) {
                continue;
            }
            for direction in directions {
                let ray = Ray::new(Point::from(from), *direction);
                if let Some(distance) = obstacle.cast(&ray, limit) {
                    limit = distance;
                    nearest = Some(distance);
                }
            }
        }
        nearest
    }

    /// True if nothing stands between two points.
    pub(crate) fn clear_between(&self, others: Others, from: Vec2, to: Vec2) -> bool {
        let way = to - from;
        let far = length(way);
        far < 1e-9 || self.cast(others, from, way / far, far).is_none()
    }

    /// The lamps: where they hang and how bright they are, those on output ports by the share of
    /// the voltage that each port gives.
    pub(crate) fn lamps(&self, power: [f64; 4]) -> impl Iterator<Item = (Vec2, f64)> {
        self.items.iter().filter_map(move |(_, item)| match item {
            Item::Lamp { at: [x, y], intensity } => Some((Vec2::new(*x, *y), *intensity)),
            Item::Bulb { at: [x, y], intensity, port } => {
                Some((Vec2::new(*x, *y), *intensity * power[port.slot()]))
            }
            _ => None,
        })
    }

    /// Whether there are lamps on output ports.
    pub(crate) fn has_bulbs(&self) -> bool {
        self.items.iter().any(|(_, item)| matches!(item, Item::Bulb { .. }))
    }

    /// The beacons: where they stand and on which channels.
    pub(crate) fn beacons(&self) -> impl Iterator<Item = (Vec2, u8)> {
        self.items.iter().filter_map(|(_, item)| match item {
            Item::Beacon { at: [x, y], channel } => Some((Vec2::new(*x, *y), *channel)),
            _ => None,
        })
    }

    /// The color of the floor at a point.
    pub(crate) fn color_at(&self, point: Vec2) -> Color {
        let on_top = self.items.iter().rev().find_map(|(_, item)| match item {
            Item::Patch { corners, color } => {
                let corners: Vec<_> = corners.iter().copied().map(Point::from).collect();
                point_in_poly2d(&Point::from(point), &corners).then_some(*color)
            }
            Item::Line { points, width, color } => {
                let near = |pair: &[[f64; 2]]| {
                    let part = Segment::new(Point::from(pair[0]), Point::from(pair[1]));
                    part.distance_to_local_point(&Point::from(point), true) <= width / 2.0
                };
                points.windows(2).any(near).then_some(*color)
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
        for (corners, obstacle) in (0..).step_by(MOST_CORNERS).zip(&self.obstacles) {
            let rough = obstacle.at_least(frame.translation.vector, reach);
            if rough > free.min(20.0).max(margin) {
                free = free.min(rough);
                continue;
            }
            obstacle.touch_points(hull, frame, corners, |contact| {
                free = free.min(contact.gap);
                if contact.gap < margin {
                    contacts.push(contact);
                }
            });
        }
        free
    }

    /// True if a hull in this place overlaps an obstacle, and which one.
    pub(crate) fn overlap(&self, hull: Hull, pose: &Pose) -> Option<ItemId> {
        let mut obstacles = self.obstacles.iter();
        obstacles.find(|obstacle| obstacle.overlaps(hull, pose)).map(|obstacle| obstacle.id)
    }

    /// True if an obstacle is within `distance` of a straight bumper.
    pub(crate) fn near_bumper(&self, others: Others, from: Vec2, to: Vec2, distance: f64) -> bool {
        let mut obstacles = self.obstacles.iter().chain(others.iter());
        obstacles.any(|obstacle| obstacle.near_line(from, to, distance))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rays_meet_walls_boxes_and_circles() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let up = Vec2::new(0.0, 1.0);
        assert_eq!(scene.cast(Others::default(), Vec2::zeros(), up, 255.0), None);
        let wall = scene.add(Item::wall([-50.0, 100.0], [50.0, 100.0])).unwrap();
        let near = |expected: f64, scene: &Scene| {
            let distance = scene.cast(Others::default(), Vec2::zeros(), up, 255.0).unwrap();
            assert!((distance - expected).abs() < 1e-9, "{distance}");
        };
        near(99.5, &scene);
        scene.add(Item::circle([0.0, 80.0], 5.0)).unwrap();
        near(75.0, &scene);
        let pose = Pose::new(0.0, 50.0, 45.0);
        let diamond = scene.add(Item::boxed(pose, 10.0, 10.0)).unwrap();
        near(50.0 - 50.0_f64.sqrt(), &scene);
        assert!(!scene.clear_between(Others::default(), Vec2::zeros(), Vec2::new(0.0, 60.0)));
        assert!(scene.remove(diamond) && scene.remove(wall) && !scene.remove(wall));
        near(75.0, &scene);
    }

    #[test]
    fn floors_cover_each_other_in_order() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let red = "red".parse().unwrap();
        scene.add(Item::rectangle([0.0, 0.0], [10.0, 10.0], red)).unwrap();
        let points = vec![[0.0, 5.0], [20.0, 5.0], [20.0, 20.0]];
        scene.add(Item::Line { points, width: 2.0, color: Color::BLACK }).unwrap();
        let at = |x, y| scene.color_at(Vec2::new(x, y));
        assert_eq!(at(-1.0, 1.0), Color::WHITE);
        assert_eq!(at(5.0, 8.0), red);
        assert_eq!(at(5.0, 5.9), Color::BLACK);
        assert_eq!(at(19.5, 15.0), Color::BLACK);
    }

    #[test]
    fn impossible_items_are_named() {
        let mut scene = Scene::new(&WorldSpec::default()).unwrap();
        let error = scene.add(Item::circle([0.0, 0.0], -1.0)).unwrap_err();
        assert!(error.to_string().starts_with("circle"), "{error}");
        assert!(scene.add(Item::wall([1.0, 1.0], [1.0, 1.0])).is_err());
        assert!(scene.add(Item::Lamp { at: [f64::NAN, 0.0], intensity: 1.0 }).is_err());
    }
}
