//! Things that robots push: boxes, discs and balls with a mass.

use crate::mechanics::pair::Rider;
use crate::mechanics::sole::Floor;
use crate::mechanics::{Body, GRAVITY, Load};
use crate::world::obstacle::Obstacle;
use crate::world::scene::Scene;
use crate::world::{Hull, Item, ItemId, Traits};
use ev3_motion::Pose;

/// What rolls has to turn, too: a solid ball has two fifths of its mass in that.
const ROLLING: f64 = 1.4;

/// A thing in its place, with its speeds.
#[derive(Clone, Debug)]
pub struct Thing {
    pub(crate) id: ItemId,
    item: Item,
    pub(crate) hull: Hull,
    pub(crate) body: Body,
    floor: Floor,
}

impl Thing {
    /// `None` for an item that does not move.
    pub(crate) fn new(id: ItemId, item: &Item) -> Option<Thing> {
        let (pose, hull, traits) = item.movable()?;
        let mass = traits.mass?;
        let spread = match hull {
            Hull::Circle { radius } => radius * radius / 2.0,
            Hull::Rectangle { width, length, .. } => (width * width + length * length) / 12.0,
        };
        let force = traits.friction() * mass * GRAVITY;
        let floor = Floor { force, radius: Floor::radius_of(hull) };
        let inertia = if traits.rolls { ROLLING * mass } else { mass };
        let body = Body::thing(pose, inertia, mass * spread / 1e4, floor, traits.bounces());
        Some(Thing { id, item: item.clone(), hull, body, floor })
    }

    /// The number of its item.
    pub fn id(&self) -> ItemId {
        self.id
    }

    /// Where it is. The heading is not reduced to a full turn.
    pub fn pose(&self) -> Pose {
        self.body.pose
    }

    /// The item, where it is now.
    pub fn item(&self) -> Item {
        let Pose { heading, .. } = self.pose();
        self.item.at(self.pose().point(), Some(heading)).unwrap_or_else(|| self.item.clone())
    }

    /// Its speeds to the east and to the north in cm/s, and clockwise in degrees per second.
    pub fn speeds(&self) -> [f64; 3] {
        let [ahead, turn] = self.body.spins.unwrap_or_default();
        let (sin, cos) = ev3_motion::sin_cos(self.pose().heading);
        let aside = self.body.slip;
        [sin * ahead + cos * aside, cos * ahead - sin * aside, turn.to_degrees()]
    }

    /// Gives it speeds, as [`speeds`](Self::speeds) has them.
    pub(crate) fn set_speeds(&mut self, [east, north, turn]: [f64; 3]) {
        let (sin, cos) = ev3_motion::sin_cos(self.pose().heading);
        self.body.slip = cos * east - sin * north;
        self.body.spins = Some([sin * east + cos * north, turn.to_radians()]);
    }

    /// How often it was stopped, since no place was free where it went.
    pub fn halts(&self) -> u32 {
        self.body.halts
    }

    /// Whether it moves.
    pub fn is_moving(&self) -> bool {
        self.body.slip != 0.0 || self.body.spins.into_iter().flatten().any(|speed| speed != 0.0)
    }

    /// A gripper holds it above the floor, or none does.
    pub(crate) fn lift(&mut self, is_lifted: bool) {
        let force = if is_lifted { 0.0 } else { self.floor.force };
        self.body.floor = Some(Floor { force, ..self.floor });
    }

    /// Energy of motion, in joules.
    pub(crate) fn energy(&self) -> f64 {
        self.body.energy([0.0; 2], &[Load::default(); 2])
    }

    pub(crate) fn obstacle(&self) -> Obstacle {
        let is_low = self.item.traits().is_some_and(Traits::is_low);
        Obstacle::robot(self.id, self.hull, &self.body.pose).that_is_low(is_low)
    }

    pub(crate) fn rider<'a>(&'a mut self, scene: &'a Scene) -> Rider<'a> {
        let Thing { id, hull, body, .. } = self;
        let (omega, loads) = ([0.0; 2], [Load::default(); 2]);
        Rider { id: *id, body, omega, loads, hull: *hull, scene, hits: Vec::new() }
    }
}
