//! The items of the world, and the things among them that robots push.
use crate::brick::port::Port;
use crate::machine::grip::Grip;
use crate::machine::room::Room;
use crate::machine::{Machine, OUTSIDE, crowd};
use crate::mechanics::thing::Thing;
use crate::world::obstacle::Obstacle;
use crate::world::{Hull, Item, ItemId, Part, SpecError};
use ev3_motion::{Pose, length, outside};
use std::borrow::Cow;
use std::sync::Arc;

/// The most things of a world that move.
const MOST: usize = 64;

impl Machine {
    /// Everything in the world, where it is now, with the numbers under which it can be removed.
    pub fn items(&self) -> impl Iterator<Item = (ItemId, Cow<'_, Item>)> {
        self.scene.items().iter().map(|(id, item)| {
            let thing = self.things.iter().find(|thing| thing.id == *id);
            (*id, thing.map_or(Cow::Borrowed(item), |thing| Cow::Owned(thing.item())))
        })
    }

    /// The things that robots push.
    pub fn things(&self) -> &[Thing] {
        &self.things
    }

    /// Takes the things of the scene in. Errors: names the first one that is inside something.
    pub(super) fn take_things(&mut self) -> Result<(), SpecError> {
        let items = self.scene.items().to_vec();
        for (index, (id, item)) in items.iter().enumerate() {
            let blame = |error: SpecError| error.in_part(Part::Item(index));
            self.take_thing(*id, item).map_err(blame)?;
        }
        crowd::share_world(&mut [self], 0);
        Ok(())
    }

    /// Puts something into the world.
    /// Errors: if the item is impossible, or something is where it should stand.
    pub fn add_item(&mut self, item: Item) -> Result<ItemId, SpecError> {
        let id = Arc::make_mut(&mut self.scene).add(item)?;
        if let Err(error) = self.settle(id) {
            Arc::make_mut(&mut self.scene).remove(id);
            return Err(error);
        }
        self.world_is_changed();
        Ok(id)
    }

    /// Takes something out of the world; false if there is no such item.
    pub fn remove_item(&mut self, id: ItemId) -> bool {
        let was_there = Arc::make_mut(&mut self.scene).remove(id);
        self.drop_thing(id);
        self.let_go(|held| held == id);
        self.world_is_changed();
        was_there
    }

    /// Moves an item to another place, where it rests, and turns it to a heading if one is given;
    /// `false` if there is no such item, or it has no single place.
    /// Errors: if the place is impossible, or something is there. Then nothing moves.
    pub fn move_item(
        &mut self,
        id: ItemId,
        to: [f64; 2],
        heading: Option<f64>,
    ) -> Result<bool, SpecError> {
        let item = self.items().find(|(other, _)| *other == id);
        let Some(moved) = item.and_then(|(_, item)| item.at(to, heading)) else {
            return Ok(false);
        };
        let before = Arc::make_mut(&mut self.scene).replace(id, moved)?;
        let things = Arc::clone(&self.things);
        self.drop_thing(id);
        if let Err(error) = self.settle(id) {
            self.things = things;
            self.see_things();
            if let Some(before) = before {
                Arc::make_mut(&mut self.scene).replace(id, before)?;
            }
            return Err(error);
        }
        self.let_go(|held| held == id);
        self.world_is_changed();
        Ok(true)
    }

    /// Gives a thing speeds to the east and to the north, in cm/s, and clockwise, in degrees per
    /// second, as a hand does that throws it; `false` if no such thing moves.
    pub fn throw(&mut self, id: ItemId, speeds: [f64; 3]) -> bool {
        let things = Arc::make_mut(&mut self.things);
        let Some(thing) = things.iter_mut().find(|thing| thing.id == id) else { return false };
        thing.set_speeds(speeds);
        self.world_is_changed();
        true
    }

    /// The numbers of the things that its grippers hold.
    pub fn held(&self) -> impl Iterator<Item = ItemId> {
        self.grips.iter().filter_map(Grip::held)
    }

    /// How far apart the jaws are that the motor at a port moves, in cm.
    pub(super) fn opening(&self, port: Port) -> Option<f64> {
        let gripper = self.robot.grippers.iter().find(|gripper| gripper.port == port)?;
        Some(gripper.opening * (1.0 - self.shafts[port.slot()].share()?))
    }

    /// Whether a gripper holds a thing above the floor.
    pub(super) fn lifts(&self, id: ItemId) -> bool {
        let all = self.robot.grippers.iter().zip(&self.grips);
        let mut lifting = all.filter(|(gripper, _)| gripper.lifts);
        lifting.any(|(_, grip)| grip.held() == Some(id))
    }

    /// What was held lies there now.
    pub(super) fn let_go(&mut self, is_meant: impl Fn(ItemId) -> bool + Copy) {
        self.grips.iter_mut().for_each(|grip| grip.let_go(is_meant));
    }

    /// The grippers have turned among these things.
    pub(super) fn turn_grippers(&mut self, things: &[Thing]) {
        for (gripper, grip) in self.robot.grippers.iter().zip(&mut self.grips) {
            let shaft = &mut self.shafts[gripper.port.slot()];
            grip.turn(gripper, shaft, &self.body.pose, things);
        }
    }

    /// How far robot, things and obstacles are from each other, in cm, where they are nearer than
    /// 1 cm; below 0 where they overlap.
    pub fn gaps(&self) -> Vec<f64> {
        let mut gaps = Vec::new();
        let mut contacts = Vec::new();
        let robot = (self.robot.hull, self.body.pose);
        let hulls = self.things.iter().map(|thing| (thing.hull, thing.body.pose)).chain([robot]);
        for (index, (hull, pose)) in hulls.enumerate() {
            self.scene.contacts(hull, &pose.frame(), crowd::THING_NEAR, &mut contacts);
            gaps.extend(contacts.iter().map(|contact| contact.gap));
            gaps.extend(self.things[..index].iter().map(|other| other.obstacle().gap(hull, &pose)));
        }
        gaps.retain(|gap| *gap < crowd::THING_NEAR);
        gaps
    }

    fn drop_thing(&mut self, id: ItemId) {
        if self.things.iter().any(|thing| thing.id == id) {
            Arc::make_mut(&mut self.things).retain(|thing| thing.id != id);
            self.see_things();
        }
    }

    /// An item of the scene has come to its place. Errors: if something is there.
    fn settle(&mut self, id: ItemId) -> Result<(), SpecError> {
        let Some((_, item)) = self.scene.items().iter().rev().find(|(other, _)| *other == id)
        else {
            return Ok(());
        };
        if item.movable().is_some() {
            let item = item.clone();
            return self.take_thing(id, &item);
        }
        match Obstacle::new(id, item).and_then(|obstacle| self.stands_at(&obstacle)) {
            Some(other) => {
                Err(SpecError::new(item.to_string(), format!("is where {other} stands")))
            }
            None => Ok(()),
        }
    }

    /// Takes a thing in, if it is one. Errors: if something is where it should stand, or there
    /// are too many.
    fn take_thing(&mut self, id: ItemId, item: &Item) -> Result<(), SpecError> {
        let Some(thing) = Thing::new(id, item) else { return Ok(()) };
        let fault = |reason| Err(SpecError::new(item.to_string(), reason));
        if self.things.len() >= MOST {
            return fault(format!("is one too many: at most {MOST} things of a world move"));
        }
        let obstacle = thing.obstacle();
        if let Some(other) = self.stands_at(&obstacle) {
            return fault(format!("is where {other} stands"));
        }
        if self.is_outside(&thing.pose()) {
            return fault(OUTSIDE.to_owned());
        }
        if let Some(other) = self.scene.overlap(thing.hull, &thing.pose()) {
            return fault(format!("is inside {}", self.name_of(other)));
        }
        Arc::make_mut(&mut self.things).push(thing);
        self.see_things();
        Ok(())
    }

    /// The words for a robot, or a thing that moves, where an obstacle should stand.
    fn stands_at(&self, obstacle: &Obstacle) -> Option<String> {
        let robots = self.others().robots();
        if obstacle.overlaps(self.robot.hull, &self.body.pose)
            || robots.into_iter().any(|other| obstacle.meets(other))
        {
            return Some("the robot".to_owned());
        }
        let other = self.others().things.iter().find(|other| obstacle.meets(other))?;
        Some(self.name_of(other.id))
    }

    /// An obstacle of the world as a message names it.
    pub(super) fn name_of(&self, id: ItemId) -> String {
        let item = self.items().find(|(other, _)| *other == id);
        item.map_or_else(|| "the walls of the bounds".to_owned(), |(_, item)| item.to_string())
    }

    /// Something was added, moved or taken away.
    fn world_is_changed(&mut self) {
        self.see_things();
        self.body.world_changed();
        for thing in Arc::make_mut(&mut self.things) {
            thing.body.world_changed();
        }
        self.look_for_room();
        self.hand_is_done();
    }

    /// The things as obstacles, where they are now.
    pub(super) fn see_things(&mut self) {
        if !(self.things.is_empty() && self.thing_obstacles.is_empty()) {
            self.thing_obstacles = Arc::new(self.things.iter().map(Thing::obstacle).collect());
        }
    }

    /// True if no thing moves, and none may be near to the robot.
    pub(super) fn has_room(&self) -> bool {
        let Room { from, way } = self.room;
        way == f64::INFINITY || {
            let Pose { x, y, heading } = self.body.pose;
            let turned = (heading - from.heading).to_radians() * self.reach();
            libm::hypot(x - from.x, y - from.y) + turned.abs() < way
        }
    }

    /// Looks how far the robot may go until a thing may be near.
    pub(super) fn look_for_room(&mut self) {
        self.room = Room { from: self.body.pose, way: f64::INFINITY };
        let frame = self.body.pose.frame();
        let jaws = self.robot.grippers.iter().map(|gripper| {
            let at = outside(&frame, gripper.at.into());
            (Hull::Circle { radius: crowd::THING_NEAR }, Pose::new(at.x, at.y, 0.0))
        });
        let hulls: Vec<_> = jaws.chain([(self.robot.hull, self.body.pose)]).collect();
        for thing in &*self.things {
            let obstacle = thing.obstacle();
            let gaps = hulls.iter().map(|(hull, pose)| obstacle.gap(*hull, pose));
            let gap = gaps.fold(f64::INFINITY, f64::min);
            let way = if thing.is_moving() { 0.0 } else { gap - crowd::THING_NEAR };
            self.room.way = self.room.way.min(way);
        }
    }

    /// The largest distance of a point of hull and grippers from the middle of the axle, in cm.
    fn reach(&self) -> f64 {
        let jaws = self.robot.grippers.iter().map(|gripper| length(gripper.at.into()));
        jaws.fold(self.robot.hull.reach(), f64::max)
    }
}
