//! Several robots in one world: their machines take each tick together.
//!
//! A robot that is alone takes it as if it had the world for itself. Those near each other take it
//! as pairs (`mechanics::pair`). All see the others where they were after the last tick.
//!
//! The things that robots push are shared by all. What moves, and what is near to it, is an
//! island, which takes the tick together; a robot that has no thing near it does not look at them.
use crate::machine::Machine;
use crate::mechanics::pair::{self, Rider};
use crate::mechanics::thing::Thing;
use crate::world::obstacle::Obstacle;
use crate::world::{ItemId, SpecError};
use std::sync::Arc;
use std::time::Duration;

/// Robots whose hulls may come nearer than this in a tick may touch, in cm. The fastest ones move
/// by 0.4 cm.
const NEAR: f64 = 2.0;
/// The same of things, between outlines.
pub(super) const THING_NEAR: f64 = 1.0;

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
    let Some(machine) = machines.get(changed) else { return };
    let (scene, things) = (Arc::clone(&machine.scene), Arc::clone(&machine.things));
    for machine in machines.iter_mut() {
        if !Arc::ptr_eq(&machine.scene, &scene) {
            machine.scene = Arc::clone(&scene);
            machine.body.world_changed();
        }
    }
    share_things(machines, &things);
    see_each_other(machines);
}

fn outline(machine: &Machine) -> Obstacle {
    Obstacle::robot(id_of(machine.number), machine.robot.hull, &machine.body.pose)
}

/// Where robots and things are now.
fn see_each_other(machines: &mut [&mut Machine]) {
    if machines.len() > 1 {
        let robots: Arc<Vec<_>> = Arc::new(machines.iter().map(|it| outline(it)).collect());
        for machine in &mut *machines {
            machine.robots = Arc::clone(&robots);
        }
    }
    let Some((first, others)) = machines.split_first_mut() else { return };
    first.see_things();
    for other in others {
        other.thing_obstacles = Arc::clone(&first.thing_obstacles);
    }
}

/// A tick.
pub(crate) fn advance(machines: &mut [&mut Machine]) {
    let has_moved = if machines.iter().all(|machine| machine.has_room()) {
        let groups = groups(machines);
        let mut has_moved = false;
        for group in 0..machines.len() {
            let mut members: Vec<_> = (machines.iter_mut().zip(&groups))
                .filter(|(_, of)| **of == group)
                .map(|(machine, _)| &mut **machine)
                .collect();
            has_moved |= turn(&mut members);
        }
        has_moved
    } else {
        advance_among_things(machines)
    };
    if has_moved {
        see_each_other(machines);
    }
    for machine in machines {
        machine.end_tick();
    }
}

/// The same where a thing moves, or a robot is near to one; whether something may have moved.
fn advance_among_things(machines: &mut [&mut Machine]) -> bool {
    let mut things = take_things(machines);
    let scene = Arc::clone(&machines[0].scene);
    let starts: Vec<_> = machines.iter_mut().map(|machine| machine.begin_tick()).collect();
    let islands = islands(machines, &things);
    let (of_robots, of_things) = islands.split_at(machines.len());
    for (machine, (island, start_us)) in machines.iter_mut().zip(of_robots.iter().zip(&starts)) {
        if island.is_none() {
            machine.rest(*start_us);
        }
    }
    let mut has_moved = false;
    for (island, _) in islands.iter().enumerate().filter(|(place, of)| **of == Some(*place)) {
        has_moved = true;
        let is_in = |of: &Option<usize>| *of == Some(island);
        let (mut members, begun): (Vec<_>, Vec<_>) = (machines.iter_mut().zip(&starts))
            .zip(of_robots)
            .filter(|(_, of)| is_in(of))
            .map(|((machine, start_us), _)| (&mut **machine, *start_us))
            .unzip();
        let pushed: Vec<_> = (things.iter_mut().zip(of_things))
            .filter(|(_, of)| is_in(of))
            .map(|(thing, _)| thing.rider(&scene))
            .collect();
        match &mut members[..] {
            [alone] if pushed.is_empty() && alone.body.spins.is_none() => {
                alone.turn_shafts(begun[0]);
            }
            members => ride(members, &begun, pushed),
        }
    }
    for machine in &mut *machines {
        machine.turn_grippers(&things);
    }
    for thing in &mut things {
        thing.lift(machines.iter().any(|machine| machine.lifts(thing.id)));
    }
    share_things(machines, &Arc::new(things));
    has_moved
}

/// The things of this world, for nobody else meanwhile.
fn take_things(machines: &mut [&mut Machine]) -> Vec<Thing> {
    let mut all = machines.iter_mut().map(|machine| std::mem::take(&mut machine.things));
    let first = all.next().unwrap_or_default();
    all.for_each(drop);
    Arc::unwrap_or_clone(first)
}

/// All have these things, and know how far they may go until they meet one.
fn share_things(machines: &mut [&mut Machine], things: &Arc<Vec<Thing>>) {
    for machine in machines {
        machine.things = Arc::clone(things);
        machine.look_for_room();
    }
}

/// The island of each robot, then of each thing: the lowest number of those that it is near to,
/// directly or through others; `None` where nothing moves.
fn islands(machines: &[&mut Machine], things: &[Thing]) -> Vec<Option<usize>> {
    let count = machines.len();
    let groups = groups(machines);
    let robots: Vec<_> = machines.iter().map(|machine| outline(machine)).collect();
    // What moved in the last tick was seen after it.
    let outlines: Vec<_> = robots.iter().chain(&*machines[0].thing_obstacles).collect();
    let hull_of = |index: usize| match index.checked_sub(count) {
        None => (machines[index].robot.hull, &machines[index].body.pose),
        Some(thing) => (things[thing].hull, &things[thing].body.pose),
    };
    let near = |here: usize, other: usize| {
        let (hull, pose) = hull_of(other);
        outlines[here].may_be_within(outlines[other], THING_NEAR)
            && outlines[here].is_nearer(hull, pose, THING_NEAR)
    };
    let mut islands = vec![None; count + things.len()];
    for start in 0..islands.len() {
        let is_awake = match start.checked_sub(count) {
            None => machines[start].body.spins.is_some() || !machines[start].is_at_rest(),
            Some(thing) => things[thing].is_moving(),
        };
        if !is_awake || islands[start].is_some() {
            continue;
        }
        islands[start] = Some(start);
        let mut open = vec![start];
        while let Some(here) = open.pop() {
            for (other, island) in islands.iter_mut().enumerate() {
                if island.is_some() {
                    continue;
                }
                let holds = |robot: usize, thing: usize| {
                    machines[robot].held().any(|held| held == things[thing].id)
                };
                let is_near = match other.checked_sub(count) {
                    None if here < count => groups[here] == groups[other],
                    None if holds(other, here - count) => true,
                    Some(thing) if here < count && holds(here, thing) => true,
                    _ => near(here, other),
                };
                if is_near {
                    *island = Some(start);
                    open.push(other);
                }
            }
        }
    }
    islands
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
        _ => ride(machines, &starts, Vec::new()),
    }
    true
}

/// A tick of robots that are near each other or near things, or whose wheels still spin.
fn ride(machines: &mut [&mut Machine], starts: &[u64], things: Vec<Rider>) {
    let robots = machines.len();
    let mut grips: Vec<_> = machines
        .iter_mut()
        .enumerate()
        .flat_map(|(index, machine)| {
            let grips = std::mem::take(&mut machine.grips);
            let grippers = machine.robot.grippers.clone();
            grippers.into_iter().zip(grips).map(move |(gripper, grip)| (index, gripper, grip))
        })
        .collect();
    let mut joints = Vec::new();
    let mut of_joints = Vec::new();
    for (place, (index, gripper, grip)) in grips.iter_mut().enumerate() {
        let thing = things.iter().position(|thing| Some(thing.id) == grip.held());
        let joint = thing.and_then(|thing| grip.joint(gripper, [*index, robots + thing]));
        of_joints.extend(joint.is_some().then_some(place));
        joints.extend(joint);
    }
    let loads: Vec<_> = machines.iter_mut().map(|machine| machine.loaded()).collect();
    let mut riders: Vec<_> = (machines.iter_mut().zip(&loads))
        .map(|(machine, loads)| machine.rider(id_of(machine.number), loads))
        .chain(things)
        .collect();
    let off = pair::advance(&mut riders, &mut joints);
    riders.truncate(robots);
    let after: Vec<_> = riders.into_iter().map(|Rider { omega, hits, .. }| (omega, hits)).collect();
    for ((machine, (omega, hits)), (loads, start_us)) in
        machines.iter_mut().zip(after).zip(loads.iter().zip(starts))
    {
        machine.wheels_turned(omega, hits);
        machine.turn_others(loads, *start_us);
    }
    for (place, off) in of_joints.into_iter().zip(off) {
        grips[place].2.is_off(off);
    }
    for (index, _, grip) in grips {
        machines[index].grips.push(grip);
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
