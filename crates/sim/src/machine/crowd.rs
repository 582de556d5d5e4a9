//! Several robots in one world: their machines take each tick together.
//!
//! A robot that is alone takes it as if it had the world for itself. Those near each other take it
//! as pairs (`mechanics::pair`). All see the others where they were after the last tick.
use crate::machine::Machine;
use crate::mechanics::pair::{self, Rider};
use crate::world::obstacle::Obstacle;
use crate::world::{ItemId, SpecError};
use std::sync::Arc;
use std::time::Duration;

/// Robots whose hulls may come nearer than this in a tick may touch, in cm. The fastest ones move
/// by 0.4 cm.
const NEAR: f64 = 2.0;

/// A robot's number among the obstacles: the last ones.
fn id_of(index: usize) -> ItemId {
    ItemId(u32::MAX - u32::try_from(index).unwrap_or_default())
}

/// The robot of several that a collision was with, if it was with one.
pub fn robot_of(id: ItemId) -> Option<usize> {
    let index = u32::MAX - id.0;
    (index < 1 << 16).then_some(index as usize)
}

/// A robot, by its index, and what is wrong with its place.
pub type Misplaced = (usize, SpecError);

/// Puts robots, each in a machine of its own at the same moment, into the world of the first one.
/// Errors: names the robot, by its index, that stands where another one does, or something else.
pub(crate) fn join(machines: &mut [Machine]) -> Result<(), Misplaced> {
    let mut machines: Vec<_> = machines.iter_mut().collect();
    for (index, machine) in machines.iter_mut().enumerate() {
        machine.number = index;
    }
    share_world(&mut machines, 0);
    for (index, machine) in machines.iter_mut().enumerate() {
        machine.check_free(&machine.pose()).map_err(|error| (index, error))?;
        machine.sample_where(|_| true);
    }
    Ok(())
}

/// Lets this time pass for all of them.
pub(crate) fn step(machines: &mut [&mut Machine], dt: Duration) {
    for machine in &mut *machines {
        machine.pass(dt);
    }
    while machines.first().is_some_and(|first| first.is_behind()) {
        advance(machines);
    }
}

/// The world of one of them has changed.
pub(crate) fn share_world(machines: &mut [&mut Machine], changed: usize) {
    let Some(scene) = machines.get(changed).map(|machine| Arc::clone(&machine.scene)) else {
        return;
    };
    for machine in machines.iter_mut() {
        if !Arc::ptr_eq(&machine.scene, &scene) {
            machine.scene = Arc::clone(&scene);
            machine.body.world_changed();
        }
    }
    see_each_other(machines);
}

/// Where they are now.
fn see_each_other(machines: &mut [&mut Machine]) {
    let robot = |machine: &&mut Machine| {
        Obstacle::robot(id_of(machine.number), machine.robot.hull, &machine.body.pose)
    };
    let robots: Arc<Vec<_>> = Arc::new(machines.iter().map(robot).collect());
    for machine in machines {
        machine.robots = Arc::clone(&robots);
    }
}

fn advance(machines: &mut [&mut Machine]) {
    let groups = groups(machines);
    let mut has_moved = false;
    for group in 0..machines.len() {
        let mut members: Vec<_> = (machines.iter_mut().zip(&groups))
            .filter(|(_, of)| **of == group)
            .map(|(machine, _)| &mut **machine)
            .collect();
        has_moved |= turn(&mut members);
    }
    if has_moved {
        see_each_other(machines);
    }
    for machine in machines {
        machine.end_tick();
    }
}

/// The shafts of a group take their tick; whether something may have moved.
fn turn(machines: &mut [&mut Machine]) -> bool {
    let starts: Vec<_> = machines.iter_mut().map(|machine| machine.begin_tick()).collect();
    let may_spin = machines.len() == 1 && machines[0].body.spins.is_some();
    if !may_spin && machines.iter().all(|machine| machine.is_at_rest()) {
        for (machine, start_us) in machines.iter_mut().zip(starts) {
            machine.rest(start_us);
        }
        return false;
    }
    match machines {
        [alone] if !may_spin => alone.turn_shafts(starts[0]),
        _ => ride(machines, &starts),
    }
    true
}

/// A tick of robots that are near each other, or whose wheels still spin.
fn ride(machines: &mut [&mut Machine], starts: &[u64]) {
    let loads: Vec<_> = machines.iter_mut().map(|machine| machine.loaded()).collect();
    let mut riders: Vec<_> = (machines.iter_mut().zip(&loads))
        .map(|(machine, loads)| machine.rider(id_of(machine.number), loads))
        .collect();
    pair::advance(&mut riders);
    let after: Vec<_> = riders.into_iter().map(|Rider { omega, hits, .. }| (omega, hits)).collect();
    for ((machine, (omega, hits)), (loads, start_us)) in
        machines.iter_mut().zip(after).zip(loads.iter().zip(starts))
    {
        machine.wheels_turned(omega, hits);
        machine.turn_others(loads, *start_us);
    }
}

/// The group of each robot: the lowest number of those that it is near to, directly or through
/// others.
fn groups(machines: &[&mut Machine]) -> Vec<usize> {
    let mut groups: Vec<usize> = (0..machines.len()).collect();
    let reach = |index: usize| machines[index].robot.hull.reach() + NEAR / 2.0;
    let widest = (0..machines.len()).map(reach).fold(0.0, f64::max);
    let mut by_x = groups.clone();
    let x = |index: usize| machines[index].body.pose.x;
    by_x.sort_by(|a, b| x(*a).total_cmp(&x(*b)).then(a.cmp(b)));
    for (place, &first) in by_x.iter().enumerate() {
        for &second in &by_x[place + 1..] {
            if x(second) - x(first) > reach(first) + widest {
                break;
            }
            let way = machines[second].body.pose.vec2() - machines[first].body.pose.vec2();
            let near = reach(first) + reach(second);
            if way.dot(&way) <= near * near {
                let (low, high) =
                    (groups[first].min(groups[second]), groups[first].max(groups[second]));
                groups.iter_mut().filter(|group| **group == high).for_each(|group| *group = low);
            }
        }
    }
    groups
}
