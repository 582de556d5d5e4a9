//! `prolog/ev3dev/navigation.pl`: driving through a partly known room.
use crate::glue::call::Call;
use crate::glue::places::{place, place_term, places_term};
use crate::glue::terms::Prolog;
use crate::roadmap::{map_of, no_way, options_of};
use ev3_motion::Pose;
use ev3_roadmap::{Obstacle, Path, Step, View, Views};
use std::sync::{Arc, Mutex, MutexGuard};
use swipl::prelude::*;

/// The echoes that a robot has measured on its path.
#[arc_blob("ev3_views", defaults)]
struct SeenSoFar {
    views: Mutex<Views>,
}

/// A path that the robot follows.
#[arc_blob("ev3_way", defaults)]
struct PathBlob {
    path: Path,
}

natives! {
    /// views_new_(+Radius, -Views)
    semidet fn "views_new_"(context, radius, views) as call("navigate_to", 3) {
        let radius = call.float(radius)?;
        views.unify(Arc::new(SeenSoFar { views: Mutex::new(Views::new(radius)) }))
    }

    /// views_look_(+Views, +pose(X, Y, Heading), +sensor(X, Y, Heading), +Range, -Moved)
    semidet fn "views_look_"(context, views, pose, sensor, range, moved) as call("navigate_to", 3) {
        let number = |term: &Term| call.float(term);
        let ([x, y, heading], [aside, ahead, turned]) =
            (call.arguments(pose)?, call.arguments(sensor)?);
        let at = [number(&aside)?, number(&ahead)?];
        let mount = View { at, heading: number(&turned)?, range: number(range)? };
        let at = [number(&x)?, number(&y)?];
        moved.unify(views_in(&views.get_ex()?).look(at, number(&heading)?, mount))
    }

    /// views_forget_(+Views)
    semidet fn "views_forget_"(_context, views) {
        views_in(&views.get_ex()?).forget();
        Ok(())
    }

    /// views_block_(+Views, +Place)
    semidet fn "views_block_"(context, views, at) as call("navigate_to", 3) {
        let at = place(&call, at)?;
        views_in(&views.get_ex()?).block(at);
        Ok(())
    }

    /// views_obstacles_(+Views, +Facts, -Polygons)
    semidet fn "views_obstacles_"(context, views, facts, polygons) as call("navigate_to", 3) {
        let found = views_in(&views.get_ex()?).obstacles(&map_of(&call, facts)?);
        let corners = found.iter().filter_map(Obstacle::corners);
        let terms = corners.map(|corners| {
            let corners = places_term(&call, corners)?;
            term! {context: polygon(#&corners)}
        });
        polygons.unify(terms.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// views_step_(+Views, +Facts, +way(Start, Goal, Margin), +Options, -Step): step is
    /// step(Heading, Length, Safe, Unseen, Rest, Way) or no_way(Why).
    semidet fn "views_step_"(context, views, facts, way, options, step) as call("navigate_to", 3) {
        let (map, options) = (map_of(&call, facts)?, options_of(&call, options)?);
        let [start, goal, margin] = call.arguments(way)?;
        let (start, goal, margin) =
            (place(&call, &start)?, place(&call, &goal)?, call.float(&margin)?);
        let next = views_in(&views.get_ex()?).next_step(&map, start, goal, margin, &options);
        match next {
            Ok(next) => step.unify(&step_term(&call, next)?),
            Err(why) => no_way(&call, step, why),
        }
    }

    /// steer_(+Way, +pose(X, Y, Heading), +Before, -Gone, -DegreesPerCm)
    semidet fn "steer_"(context, way, pose, before, gone, turn) as call("navigate_to", 3) {
        let [x, y, heading] = call.arguments(pose)?;
        let pose = Pose { x: call.float(&x)?, y: call.float(&y)?, heading: call.float(&heading)? };
        let way: Arc<PathBlob> = way.get_ex()?;
        let (now, degrees) = way.path.steer(pose, call.float(before)?);
        gone.unify(now)?;
        turn.unify(degrees)
    }
}

fn views_in(seen: &Arc<SeenSoFar>) -> MutexGuard<'_, Views> {
    ev3_os::locked(&seen.views)
}

/// step(Heading, Length, Safe, Unseen, Rest, Way)
fn step_term<'a, C: Prolog>(call: &Call<'a, C>, step: Step) -> PrologResult<Term<'a>> {
    let context = call.context;
    let unseen = context.new_term_ref();
    if let Some(at) = step.unseen {
        unseen.unify(&place_term(call, at)?)?;
    }
    let Step { run, safe, rest, .. } = step;
    let (heading, length) = (run.heading(), run.length());
    let way = context.new_term_ref();
    way.unify(Arc::new(PathBlob { path: run }))?;
    term! {context: step(#heading, #length, #safe, #&unseen, #rest, #&way)}
}
