//! `prolog/ev3dev/localize.pl`: where the robot is on a map.
use crate::drive::drive_of;
use crate::facts::pose;
use crate::glue::call::Call;
use crate::glue::error::wrong_because;
use crate::glue::terms::unify_atom;
use crate::roadmap::map_of;
use crate::view;
use ev3_driver::lock::locked;
use ev3_localize::{Cluster, Count, Field, Localizer, Model, Options, Step, Unfit, Wander};
use ev3_motion::{Pose, wrapped};
use std::sync::{Arc, Mutex};
use swipl::prelude::*;

/// What a robot knows of where it is.
#[arc_blob("ev3_localizer", defaults)]
struct LocalizerBlob {
    localizer: Mutex<Localizer>,
}

natives! {
    /// localize_new_(+Facts, +Options, -Localizer): options is `options(Hull, Sensor, Model,
    /// Wander, Count, Update, Seed, Search, Table)`.
    semidet fn "localize_new_"(context, facts, options, localizer) {
        let call = Call::of(context, "localize_start", 2);
        let map = map_of(&call, facts)?;
        let [hull, sensor, model, wander, count, update, seed, search, table] =
            call.arguments(options)?;
        let model = model_of(&call, &model)?;
        let [x, y, heading] = call.arguments(&sensor)?;
        let [way, turn] = call.arguments(&update)?;
        let options = Options {
            model,
            wander: wander_of(&call, &wander)?,
            sensor: Pose { x: call.float(&x)?, y: call.float(&y)?, heading: call.float(&heading)? },
            count: count_of(&call, &count)?,
            update: [call.float(&way)?, call.float(&turn)?],
            seed: u64::from_ne_bytes(call.integer(&seed)?.to_ne_bytes()),
            search: search.get_ex()?,
        };
        let field = match Field::new(&map, call.float(&hull)?, model.half_angle) {
            Ok(field) => field,
            Err(unfit) => return impossible(&call, facts, unfit),
        };
        let has_table = if table.is_atom() && &*call.text(&table)? == "auto" {
            cfg!(all(target_arch = "arm", not(target_feature = "vfp2")))
        } else {
            table.get_ex()?
        };
        let field = if has_table { field.with_table() } else { field };
        let localizer_ = Mutex::new(Localizer::new(field, options));
        localizer.unify(Arc::new(LocalizerBlob { localizer: localizer_ }))
    }

    /// localize_at_(+Localizer, +pose(X, Y, Heading), +Deviation)
    semidet fn "localize_at_"(context, localizer, at, deviation) {
        let call = Call::of(context, "localize_start", 2);
        let [x, y, heading] = call.arguments(at)?;
        let at = pose(&call, [&x, &y, &heading])?;
        let at = Pose { x: at.x, y: at.y, heading: at.heading };
        let deviation = call.float(deviation)?;
        with(localizer, |localizer| { localizer.start_at(at, deviation); Ok(()) })
    }

    /// localize_reset_(+Localizer)
    semidet fn "localize_reset_"(_context, localizer) {
        with(localizer, |localizer| { localizer.reset(); Ok(()) })
    }

    /// localize_step_(+Localizer, +Robot, +UseGyro, +Distance, -Step, -Turned): turned is the
    /// heading by wheels and gyro, in degrees.
    semidet fn "localize_step_"(context, localizer, robot, use_gyro, distance, step, turned) {
        let call = Call::of(context, "localize_step", 2);
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
    semidet fn "localize_correct_"(context, localizer, robot, use_gyro) {
        let call = Call::of(context, "localize_step", 2);
        let drive = drive_of(&call, robot, use_gyro)?;
        let believed = call.or_fail(drive.pose())?;
        let Some(best) = with(localizer, |localizer| Ok(localizer.sure()))? else {
            return Err(PrologError::Failure);
        };
        let turn = wrapped(best.pose.heading - believed.heading);
        let corrected = Pose { heading: believed.heading + turn, ..best.pose };
        if call.or_throw(drive.correct_pose(corrected))? {
            view::pose_is_of_world();
        }
        Ok(())
    }

    /// localize_best_(+Localizer, -X, -Y, -Heading, -Covariance)
    semidet fn "localize_best_"(context, localizer, x, y, heading, rows) {
        let call = Call::of(context, "localized_pose", 4);
        let Some(best) = with(localizer, |localizer| Ok(localizer.best()))? else {
            return Err(PrologError::Failure);
        };
        x.unify(best.pose.x)?;
        y.unify(best.pose.y)?;
        heading.unify(best.pose.heading)?;
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

fn with<T>(
    term: &Term,
    act: impl FnOnce(&mut Localizer) -> PrologResult<T>,
) -> PrologResult<T> {
    let blob: Arc<LocalizerBlob> = term.get_ex()?;
    act(&mut locked(&blob.localizer))
}

fn impossible<T, C: QueryableContextType>(
    call: &Call<C>,
    facts: &Term,
    unfit: Unfit,
) -> PrologResult<T> {
    wrong_because(call, "possible_geometry", facts, &unfit.to_string())
}

/// `model(HalfAngle, Sigma, SigmaShare, Hit, Short, Missing, Random, Exponent)`
fn model_of<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<Model> {
    let [half_angle, sigma, share, hit, short, missing, random, exponent] =
        call.arguments(term)?;
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
fn wander_of<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<Wander> {
    let [way, turn, drift] = call.arguments(term)?;
    Ok(Wander { way: call.float(&way)?, turn: call.float(&turn)?, drift: call.float(&drift)? })
}

/// `Least-Most`, or a number
fn count_of<C: QueryableContextType>(call: &Call<C>, term: &Term) -> PrologResult<Count> {
    let whole = |term: &Term| {
        call.integer(term).map(|count| usize::try_from(count).unwrap_or(usize::MAX))
    };
    if term.is_integer() {
        return Ok(Count::Fixed(whole(term)?));
    }
    let [least, most] = call.arguments(term)?;
    Ok(Count::Adaptive(whole(&least)?, whole(&most)?))
}
