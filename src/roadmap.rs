//! `prolog/ev3dev/roadmap.pl`: paths between obstacles.
use crate::facts;
use crate::glue::call::Call;
use crate::glue::error::{wrong_because, wrong_value};
use crate::glue::places::{place, place_term, places, places_term};
use crate::glue::terms::{Prolog, unify_atom};
use ev3_motion::{OUT_OF_RANGE, is_in_range};
use ev3_roadmap::{Fault, Map, Method, NoWay, Obstacle, Options, Segment, Solution, plan, svg};
use ev3_sim::facts::{Fact, Subject};
use ev3_sim::{Item, Shape};
use swipl::prelude::*;

natives! {
    /// roadmap_(+Facts, +Start, +Goal, +Options, -Way): way is
    /// way(Length, Points, Legs, Lines) or no_way(Why).
    semidet fn "roadmap_"(context, facts, start, goal, options, way) as call("roadmap_path", 5) {
        match solve(&call, [facts, start, goal, options])?.1 {
            Ok(found) => way.unify(&way_term(&call, &found)?),
            Err(why) => no_way(&call, way, why),
        }
    }

    /// roadmap_svg_(+Facts, +Start, +Goal, +Options, -Text)
    semidet fn "roadmap_svg_"(context, facts, start, goal, options, text) as call("roadmap_svg", 5) {
        let keep = options_of(&call, options)?.keep;
        let (map, found) = solve(&call, [facts, start, goal, options])?;
        let Ok(found) = found else { return Err(PrologError::Failure) };
        unify_atom(text, &svg(&map, &found, keep))
    }
}

/// The map, and the path through it.
fn solve<'a, C: Prolog>(
    call: &Call<'a, C>,
    [facts, start, goal, options]: [&Term<'a>; 4],
) -> PrologResult<(Map, Result<Solution, NoWay>)> {
    let (map, options) = (map_of(call, facts)?, options_of(call, options)?);
    let (from, to) = (place(call, start)?, place(call, goal)?);
    for (at, term) in [(from, start), (to, goal)] {
        if !at.into_iter().all(is_in_range) {
            return wrong_because(call, "place", term, OUT_OF_RANGE);
        }
    }
    let found = plan(&map, from, to, &options);
    Ok((map, found))
}

/// `options(Keep, ArcRadius, Method, Samples, Seed)`, checked in Prolog.
pub(crate) fn options_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Options> {
    let [keep, arc_radius, method, samples, seed] = call.arguments(term)?;
    Ok(Options {
        keep: call.float(&keep)?,
        arc_radius: call.float(&arc_radius)?,
        method: match &*call.text(&method)? {
            "visibility" => Method::Visibility,
            "prm" => Method::Prm,
            "rrt" => Method::Rrt,
            "rrt_bidirectional" => Method::RrtFromBoth,
            "rrt_star" => Method::RrtStar,
            _ => return wrong_value(call, "roadmap_method", &method),
        },
        samples: u32::try_from(call.integer(&samples)?).unwrap_or(u32::MAX),
        seed: u64::from_ne_bytes(call.integer(&seed)?.to_ne_bytes()),
    })
}

/// The map of a list of facts: those of a world, of which only obstacles matter, and polygons.
pub(crate) fn map_of<'a, C: Prolog>(call: &Call<'a, C>, facts: &Term<'a>) -> PrologResult<Map> {
    let mut map = Map::default();
    for term in call.list(facts)? {
        let added = if let Some(polygon) = polygon(call, &term)? {
            polygon.map(|obstacle| map.add(obstacle))
        } else if let Some(fact) = facts::fact(call, Subject::World, &term)? {
            add(&mut map, fact)
        } else {
            return facts::unknown(call, "roadmap_fact", Subject::World, &term);
        };
        added
            .or_else(|fault| wrong_because(call, "possible_geometry", &term, &fault.to_string()))?;
    }
    Ok(map)
}

/// `polygon(Corners)`, which only a roadmap has.
fn polygon<'a, C: Prolog>(
    call: &Call<'a, C>,
    term: &Term<'a>,
) -> PrologResult<Option<Result<Obstacle, Fault>>> {
    let Some((name, arguments)) = call.compound(term)? else {
        return Ok(None);
    };
    let ("polygon", [corners]) = (&*name, &*arguments) else {
        return Ok(None);
    };
    let corners = places(call, corners)?;
    facts::must_be_ground(call, term)?;
    Ok(Some(Obstacle::polygon(corners)))
}

fn add(map: &mut Map, fact: Fact) -> Result<(), Fault> {
    let items = match fact {
        Fact::Bounds(bounds) => {
            *map = Map::new(map.obstacles().to_vec(), Some(bounds))?;
            return Ok(());
        }
        Fact::Item(item) => vec![item],
        Fact::Map(drawn) => drawn.items,
        _ => return Ok(()),
    };
    for obstacle in items.iter().filter_map(obstacle) {
        map.add(obstacle?);
    }
    Ok(())
}

/// The solid form of an item, if it has one.
fn obstacle(item: &Item) -> Option<Result<Obstacle, Fault>> {
    match item.shape() {
        Shape::Bar { from, to, thickness } => Some(Obstacle::wall(from, to, thickness)),
        Shape::Box { pose, width, depth } => {
            Some(Obstacle::rectangle([pose.x, pose.y], width, depth, pose.heading))
        }
        Shape::Disc { center, radius } => Some(Obstacle::circle(center, radius)),
        Shape::Area { .. } | Shape::Band { .. } | Shape::Mark { .. } => None,
    }
}

pub(crate) fn no_way<C: Prolog>(call: &Call<C>, term: &Term, why: NoWay) -> PrologResult<()> {
    let context = call.context;
    let no_way = term! {context: no_way(#atomable(why.to_string()))}?;
    term.unify(&no_way)
}

/// way(Length, Points, Legs, Lines): Lines are how many the roadmap has.
fn way_term<'a, C: Prolog>(call: &Call<'a, C>, found: &Solution) -> PrologResult<Term<'a>> {
    let (context, path) = (call.context, &found.path);
    let lines = i64::try_from(found.roadmap.len()).unwrap_or(i64::MAX);
    let legs = path.segments().iter().map(|leg| leg_term(call, leg));
    let legs = legs.collect::<PrologResult<Vec<_>>>()?;
    let list = context.new_term_ref();
    list.unify(legs.as_slice())?;
    let (length, points) = (path.length(), places_term(call, &path.points())?);
    term! {context: way(#length, #&points, #&list, #lines)}
}

/// `line(From, To)` or `arc(From, To, Radius, Angle)`, as `arc_cm/3` takes them: the
/// radius is positive to the right, and the angle always.
fn leg_term<'a, C: Prolog>(call: &Call<'a, C>, leg: &Segment) -> PrologResult<Term<'a>> {
    let context = call.context;
    let (from, to) = (place_term(call, leg.from())?, place_term(call, leg.to())?);
    let Some(radius) = leg.radius() else {
        return term! {context: line(#&from, #&to)};
    };
    let angle = leg.turn().abs();
    term! {context: arc(#&from, #&to, #radius, #angle)}
}
