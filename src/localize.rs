//! `prolog/ev3dev/localize.pl`: where the robot is on a map.
use crate::drive::{counts_in_world, drive_of};
use crate::glue::call::Call;
use crate::glue::error::wrong_because;
use crate::glue::places::place_term;
use crate::glue::terms::{Prolog, unify_atom};
use crate::roadmap::map_of;
use ev3_localize::{Cluster, Count, Field, Localizer, Mapper, Model, Options, Step, Unfit, Wander};
use ev3_motion::{Pose, wrapped};
use ev3_os::locked;
use std::sync::{Arc, Mutex};
use swipl::prelude::*;

/// What a robot knows of where it is.
#[arc_blob("ev3_localizer", defaults)]
struct LocalizerBlob {
    localizer: Mutex<Localizer>,
}

/// What a robot has seen for a map.
#[arc_blob("ev3_mapper", defaults)]
struct MapperBlob {
    mapper: Mutex<Mapper>,
}

natives! {
    /// map_new_(+sensor(X, Y, Heading), -Mapper)
    semidet fn "map_new_"(context, sensor, mapper) as call("map_start", 1) {
        let made = Mutex::new(Mapper::new(pose_of(&call, sensor)?));
        mapper.unify(Arc::new(MapperBlob { mapper: made }))
    }

    /// map_look_(+Mapper, +pose(X, Y, Heading), +Distance)
    semidet fn "map_look_"(context, mapper, at, distance) as call("map_start", 1) {
        let (at, heard) = (pose_of(&call, at)?, call.float(distance)?);
        mapping(mapper, |mapper| { mapper.look(at, heard); Ok(()) })
    }

    /// map_occupancy_(+Mapper, +X, +Y, -Probability)
    semidet fn "map_occupancy_"(context, mapper, x, y, probability) as call("map_occupancy", 3) {
        let at = [call.float(x)?, call.float(y)?];
        probability.unify(mapping(mapper, |mapper| Ok(mapper.occupancy(at)))?)
    }

    /// map_cells_(+Mapper, -Side, -Cells): cells is a list of cell(X, Y, Probability).
    semidet fn "map_cells_"(context, mapper, side, list) {
        side.unify(Mapper::cell_side())?;
        let cells = mapping(mapper, |mapper| Ok(mapper.cells()))?;
        let terms = cells.iter().map(|([x, y], probability)| {
            let (x, y, probability) = (*x, *y, *probability);
            term! {context: cell(#x, #y, #probability)}
        });
        list.unify(terms.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// map_walls_(+Mapper, -Extent, -Walls): extent is bounds(X1, Y1, X2, Y2), and walls is a
    /// list of wall(X1, Y1, X2, Y2). Fails if nothing is known.
    semidet fn "map_walls_"(context, mapper, extent, list) {
        let (around, walls) =
            mapping(mapper, |mapper| Ok((mapper.extent(), mapper.walls())))?;
        let Some([[x1, y1], [x2, y2]]) = around else {
            return Err(PrologError::Failure);
        };
        extent.unify(&term! {context: bounds(#x1, #y1, #x2, #y2)}?)?;
        let terms = walls.iter().map(|[[x1, y1], [x2, y2]]| {
            let (x1, y1, x2, y2) = (*x1, *y1, *x2, *y2);
            term! {context: wall(#x1, #y1, #x2, #y2)}
        });
        list.unify(terms.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// map_frontier_(+Mapper, +X, +Y, +Hull, -Place): fails if all is explored.
    semidet fn "map_frontier_"(context, mapper, x, y, hull, at) as call("explore", 1) {
        let (from, hull) = ([call.float(x)?, call.float(y)?], call.float(hull)?);
        match mapping(mapper, |mapper| Ok(mapper.frontier(from, hull)))? {
            Some(place) => at.unify(&place_term(&call, place)?),
            None => Err(PrologError::Failure),
        }
    }

    /// localize_new_(+Facts, +Options, -Localizer): options is `options(Hull, Sensor, Model,
    /// Wander, Count, Update, Seed, Search, Table)`.
    semidet fn "localize_new_"(context, facts, options, localizer) as call("localize_start", 2) {
        let [hull, _, _, _, _, _, _, _, table] = call.arguments(options)?;
        let options = options_of(&call, options)?;
        let field = Field::new(&map_of(&call, facts)?, call.float(&hull)?, options.model.half_angle);
        let field = field.or_else(|unfit| impossible(&call, facts, unfit))?;
        let field = if has_table(&call, &table)? { field.with_table() } else { field };
        let made = Mutex::new(Localizer::new(field, options));
        localizer.unify(Arc::new(LocalizerBlob { localizer: made }))
    }

    /// localize_at_(+Localizer, +pose(X, Y, Heading), +Deviation)
    semidet fn "localize_at_"(context, localizer, at, deviation) as call("localize_start", 2) {
        let at = pose_of(&call, at)?;
        let deviation = call.float(deviation)?;
        with(localizer, |localizer| { localizer.start_at(at, deviation); Ok(()) })
    }

    /// localize_reset_(+Localizer)
    semidet fn "localize_reset_"(_context, localizer) {
        with(localizer, |localizer| { localizer.reset(); Ok(()) })
    }

    /// localize_step_(+Localizer, +Robot, +UseGyro, +Distance, -Step, -Turned): turned is the
    /// heading by wheels and gyro, in degrees.
    semidet fn "localize_step_"(context, localizer, robot, use_gyro, distance, step, turned) as call("localize_step", 2) {
        let drive = drive_of(&call, robot, use_gyro)?;
        let odometry = call.or_fail(drive.rolled())?;
        let heard = call.float(distance)?;
        turned.unify(odometry.heading)?;
        let word = match with(localizer, |localizer| Ok(localizer.step(odometry, heard)))? {
            Step::Nothing => "nothing",
            Step::Tracked => "tracked",
            Step::Found => "found",
            Step::Lost => "lost",
        };
        unify_atom(step, word)
    }

    /// localize_correct_(+Localizer, +Robot, +UseGyro): the odometry goes on from where the
    /// robot is on the map, if that is sure enough.
    semidet fn "localize_correct_"(context, localizer, robot, use_gyro) as call("localize_step", 2) {
        let drive = drive_of(&call, robot, use_gyro)?;
        let believed = call.or_fail(drive.pose())?;
        let odometry = call.or_fail(drive.rolled())?;
        let best = with(localizer, |localizer| Ok(localizer.sure(odometry)))?;
        let best = best.ok_or(PrologError::Failure)?;
        let turn = wrapped(best.pose.heading - believed.heading);
        let corrected = Pose { heading: believed.heading + turn, ..best.pose };
        if call.or_throw(drive.correct_pose(corrected))? {
            counts_in_world();
        }
        Ok(())
    }

    /// localize_best_(+Localizer, +Robot, +UseGyro, -pose(X, Y, Heading), -Covariance)
    semidet fn "localize_best_"(context, localizer, robot, use_gyro, pose, rows) as call("localized_pose", 4) {
        let odometry = call.or_fail(drive_of(&call, robot, use_gyro)?.rolled())?;
        let Some(best) = with(localizer, |localizer| Ok(localizer.best_now(odometry)))? else {
            return Err(PrologError::Failure);
        };
        let Pose { x, y, heading } = best.pose;
        pose.unify(&term! {context: pose(#x, #y, #heading)}?)?;
        let lists = best.covariance.map(|row| call.floats(&row)).into_iter();
        rows.unify(lists.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// localize_sure_(+Localizer, -Confidence, -Fit, -MustLook)
    semidet fn "localize_sure_"(_context, localizer, confidence, fit, must_look) {
        let (sure, fits, looks) = with(localizer, |localizer| {
            Ok((localizer.confidence(), localizer.fit(), localizer.must_look()))
        })?;
        confidence.unify(sure)?;
        fit.unify(fits)?;
        must_look.unify(looks)
    }

    /// localize_clusters_(+Localizer, -Clusters)
    semidet fn "localize_clusters_"(context, localizer, list) {
        let all = with(localizer, |localizer| Ok(localizer.clusters()))?;
        let cluster = |cluster: &Cluster| {
            let (Pose { x, y, heading }, weight) = (cluster.pose, cluster.weight);
            let deviation = cluster.deviation();
            term! {context: cluster(#weight, #x, #y, #heading, #deviation)}
        };
        let terms = all.iter().map(cluster).collect::<PrologResult<Vec<_>>>()?;
        list.unify(terms.as_slice())
    }

    /// localize_particles_(+Localizer, -Particles)
    semidet fn "localize_particles_"(context, localizer, list) {
        let all = with(localizer, |localizer| Ok(localizer.particles().to_vec()))?;
        let terms = all.iter().map(|particle| {
            let (Pose { x, y, heading }, weight) = (particle.pose, particle.weight);
            term! {context: particle(#weight, #x, #y, #heading)}
        });
        list.unify(terms.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }
}

/// Does something with a map that is made.
pub(crate) fn mapping<T>(
    term: &Term,
    act: impl FnOnce(&mut Mapper) -> PrologResult<T>,
) -> PrologResult<T> {
    let blob: Arc<MapperBlob> = term.get_ex()?;
    act(&mut locked(&blob.mapper))
}

/// The three numbers of `pose(X, Y, Heading)` or `sensor(X, Y, Heading)`.
fn pose_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Pose> {
    let [x, y, heading] = call.arguments(term)?;
    Ok(Pose { x: call.float(&x)?, y: call.float(&y)?, heading: call.float(&heading)? })
}

/// Does something with a localizer.
pub(crate) fn with<T>(
    term: &Term,
    act: impl FnOnce(&mut Localizer) -> PrologResult<T>,
) -> PrologResult<T> {
    let blob: Arc<LocalizerBlob> = term.get_ex()?;
    act(&mut locked(&blob.localizer))
}

fn impossible<T, C: Prolog>(call: &Call<C>, facts: &Term, unfit: Unfit) -> PrologResult<T> {
    wrong_because(call, "possible_geometry", facts, &unfit.to_string())
}

/// `options(Hull, Sensor, Model, Wander, Count, Update, Seed, Search, Table)`
fn options_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Options> {
    let [_, sensor, model, wander, count, update, seed, search, _] = call.arguments(term)?;
    let [way, turn] = call.arguments(&update)?;
    Ok(Options {
        model: model_of(call, &model)?,
        wander: wander_of(call, &wander)?,
        sensor: pose_of(call, &sensor)?,
        count: count_of(call, &count)?,
        update: [call.float(&way)?, call.float(&turn)?],
        seed: u64::from_ne_bytes(call.integer(&seed)?.to_ne_bytes()),
        search: search.get_ex()?,
    })
}

/// Whether a localizer is to have a table of distances; `auto` on processors without floats.
fn has_table<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<bool> {
    if term.is_atom() && &*call.text(term)? == "auto" {
        return Ok(cfg!(all(target_arch = "arm", not(target_feature = "vfp2"))));
    }
    term.get_ex()
}

/// `model(HalfAngle, Sigma, SigmaShare, Hit, Short, Missing, Random, Exponent)`
fn model_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Model> {
    let [half_angle, sigma, share, hit, short, missing, random, exponent] = call.arguments(term)?;
    Ok(Model {
        half_angle: call.float(&half_angle)?,
        sigma: [call.float(&sigma)?, call.float(&share)?],
        hit: call.float(&hit)?,
        short: call.float(&short)?,
        missing: call.float(&missing)?,
        random: call.float(&random)?,
        exponent: call.float(&exponent)?,
    })
}

/// `wander(Way, Turn, Drift)`
fn wander_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Wander> {
    let [way, turn, drift] = call.arguments(term)?;
    Ok(Wander { way: call.float(&way)?, turn: call.float(&turn)?, drift: call.float(&drift)? })
}

/// `Least-Most`, or a number
fn count_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Count> {
    let whole =
        |term: &Term| call.integer(term).map(|count| usize::try_from(count).unwrap_or(usize::MAX));
    if term.is_integer() {
        return Ok(Count::Fixed(whole(term)?));
    }
    let [least, most] = call.arguments(term)?;
    Ok(Count::Adaptive(whole(&least)?, whole(&most)?))
}
