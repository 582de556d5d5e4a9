//! `prolog/ev3dev/sim.pl`, `sim_hand.pl`, `sim_time.pl`, `sim_views.pl`: the simulator.
pub(crate) mod buttons;
mod dev;
#[cfg(unix)]
pub(crate) mod fence;
mod files;
pub(crate) mod limit;
#[cfg(feature = "fuse")]
mod mount;
#[cfg(not(feature = "fuse"))]
#[path = "no_mount.rs"]
mod mount;
mod running;

use self::files::SimulatedFiles;
pub(crate) use self::running::{
    end_of, end_unless_mounted, has_virtual_clock, robot_name, running_simulations,
    watched_simulation,
};
use self::running::{is_running, running_simulation, simulation, start, start_crowd};
use crate::facts::{self, channel_of, named, remote_buttons};
use crate::glue::call::Call;
use crate::glue::due::Bell;
use crate::glue::error::{no_such, wrong_because, wrong_value};
use crate::glue::state::{devices, shown_film, watched};
use crate::glue::terms::{Prolog, unify_atom};
use crate::glue::watch;
use ev3_driver::Registry;
use ev3_driver::device::sleep::Sleep;
use ev3_driver::wait::Slices;
use ev3_os::locked;
use ev3_sim::facts::{Fact, Subject, culprit};
use ev3_sim::{
    Action, Clock, Depth, Errno, Event, ItemId, Machine, Options, Pose, RobotSpec, Simulation,
    SpecError, Thing, WorldSpec,
};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;
use swipl::prelude::*;

/// How much simulated time passes between two checks for signals. A slow machine
/// takes some ms for it.
const STEP_SLICE: Duration = Duration::from_millis(100);

/// The saved state of a machine.
#[arc_blob("ev3_snapshot", defaults)]
struct Snapshot {
    machine: Mutex<Machine>,
}

/// How many snapshots there are.
static SNAPSHOTS: AtomicUsize = AtomicUsize::new(0);

impl Snapshot {
    fn of(machine: Machine) -> Snapshot {
        SNAPSHOTS.fetch_add(1, Ordering::Relaxed);
        Snapshot { machine: Mutex::new(machine) }
    }
}

impl Drop for Snapshot {
    fn drop(&mut self) {
        SNAPSHOTS.fetch_sub(1, Ordering::Relaxed);
    }
}

natives! {
    /// sim_check_(+Subject, +Fact): subject is `world` or `robot`.
    semidet fn "sim_check_"(context, subject, term) as call("sim_start", 2) {
        known_fact(&call, subject_of(&call, subject)?, term).map(drop)
    }

    /// sim_forms_(-Forms): what facts look like, each `thing(Form)`, `world(Form)` or `robot(Form)`.
    /// A form has an argument `Name:Kind` for each of the fact.
    semidet fn "sim_forms_"(context, forms) {
        let call = Call::of(context, "sim_start", 2);
        let terms = [Subject::World, Subject::Robot].into_iter().flat_map(|subject| {
            subject.forms().flat_map(move |(form, is_thing)| {
                (form.least..=form.arguments.len()).map(move |count| (subject, is_thing, form, count))
            })
        });
        let terms = terms.map(|(subject, is_thing, form, count)| {
            facts::form_term(&call, if is_thing { "thing" } else { subject.name() }, form, count)
        });
        forms.unify(terms.collect::<PrologResult<Vec<_>>>()?.as_slice())
    }

    /// sim_start_(+WorldFacts, +RobotFacts, +options(Clock, Seed, Noise, ScreenBits, Thinking), -Fault):
    /// fault is `none`, or fault(Subject, Index, Why) for the faulty fact. Index counts from
    /// 1; 0 means that a fact is missing.
    semidet fn "sim_start_"(context, world, robot, options, fault) as call("sim_start", 2) {
        let (world, robot) = (facts_of(&call, Subject::World, world)?, facts_of(&call, Subject::Robot, robot)?);
        let (clock, noise, options) = options_of(&call, options)?;
        match built(&world, None, &robot, noise, options) {
            Ok(machine) => {
                start(&call, machine, clock)?;
                unify_atom(fault, "none")
            }
            Err(error) => unify_fault(&call, fault, None, error),
        }
    }

    /// sim_crowd_(+WorldFacts, +Robots, +Options, -Fault): robots is a list of
    /// `robot(Brick, Name, RobotFacts)`; options and fault are those of sim_start_/4, but a fault in
    /// a robot has the subject robot(Number), which counts from 1.
    semidet fn "sim_crowd_"(context, world, robots, options, fault) as call("sim_start", 2) {
        let world = facts_of(&call, Subject::World, world)?;
        let options = options_of(&call, options)?;
        let robots = call.map_list(robots, |term| self::robot(&call, &term))?;
        match start_robots(&call, &world, robots, options)? {
            Ok(()) => unify_atom(fault, "none"),
            Err((index, error)) => unify_fault(&call, fault, index, error),
        }
    }

    /// sim_fault_(+WorldFacts, +RobotFacts, -Fault): the fault with which they cannot start.
    semidet fn "sim_fault_"(context, world, robot, fault) as call("sim_start", 2) {
        let (world, robot) = (facts_of(&call, Subject::World, world)?, facts_of(&call, Subject::Robot, robot)?);
        match built(&world, None, &robot, false, Options::default()) {
            Ok(_) => unify_atom(fault, "none"),
            Err(error) => unify_fault(&call, fault, None, error),
        }
    }

    /// sim_stop_
    semidet fn "sim_stop_"(context) as call("sim_stop", 0) {
        running::stop(&call)
    }

    /// sim_active_
    semidet fn "sim_active_"(_context) {
        into_prolog_result(is_running())
    }

    /// sim_pose_(-X, -Y, -Heading)
    semidet fn "sim_pose_"(context, x, y, heading) {
        let pose = simulation(context)?.machine().pose();
        x.unify(pose.x)?;
        y.unify(pose.y)?;
        heading.unify(pose.heading)
    }

    /// sim_place_(+X, +Y, +Heading)
    semidet fn "sim_place_"(context, x, y, heading) as call("sim_place", 3) {
        let pose = facts::pose(&call, [x, y, heading])?;
        let placed = simulation(context)?.change_world(|machine| machine.place(pose));
        possible(&call, placed)
    }

    /// sim_add_(+Fact, -Id)
    semidet fn "sim_add_"(context, term, id) as call("sim_add", 1) {
        let item = match facts::fact(&call, Subject::World, term)? {
            Some(Fact::Item(item)) => item,
            other => {
                let domain = if other.is_some() { "world_item" } else { "world_or_robot_fact" };
                let (name, _) = call.compound(term)?.unwrap_or_default();
                return wrong_because(&call, domain, term, &Subject::World.expected_thing(&name));
            }
        };
        let added = simulation(context)?.change_world(|machine| machine.add_item(item));
        id.unify(i64::from(possible(&call, added)?.0))
    }

    /// sim_remove_(+Id)
    semidet fn "sim_remove_"(context, id) as call("sim_remove", 1) {
        let id = call.integer(id)?;
        let id = u32::try_from(id).map_err(|_| PrologError::Failure)?;
        let act = |machine: &mut Machine| machine.remove_item(ItemId(id));
        into_prolog_result(simulation(context)?.change_world(act))
    }

    /// sim_plug_(+Port, +Type)
    semidet fn "sim_plug_"(context, port, kind) as call("sim_plug", 2) {
        let (port, kind) = (port_of(&call, port)?, call.text(kind)?);
        let plugged = simulation(context)?.machine().plug(port, &kind);
        possible(&call, plugged)
    }

    /// sim_unplug_(+Port)
    semidet fn "sim_unplug_"(context, port) as call("sim_unplug", 1) {
        let port = port_of(&call, port)?;
        into_prolog_result(simulation(context)?.machine().unplug(port))
    }

    /// sim_detecting_(+Port): the brick has not found out yet what was plugged in.
    semidet fn "sim_detecting_"(context, port) as call("sim_plug", 2) {
        let port = port_of(&call, port)?;
        into_prolog_result(simulation(context)?.machine().is_detecting(port))
    }

    /// sim_jam_(+Port, +Bool)
    semidet fn "sim_jam_"(context, port, fast) as call("sim_jam", 2) {
        let (at, fast) = (port_of(&call, port)?, fast.get_ex()?);
        if !at.is_output() {
            return wrong_value(&call, "motor_port", port);
        }
        simulation(context)?.machine().jam(at, fast);
        Ok(())
    }

    /// sim_show_(+Port, +Attribute, +Text)
    semidet fn "sim_show_"(context, port, attribute, text) as call("sim_show", 3) {
        let (port, name, line) = (port_of(&call, port)?, call.text(attribute)?, call.value(text)?);
        let simulation = simulation(context)?;
        let shown = simulation.machine().show(port, &name, &line);
        simulation.shared().wake();
        shown.or_else(|errno| cannot_show(&call, errno, attribute, text))
    }

    /// sim_unshow_(+Port, +Attribute)
    semidet fn "sim_unshow_"(context, port, attribute) as call("sim_unshow", 2) {
        let (port, name) = (port_of(&call, port)?, call.text(attribute)?);
        let simulation = simulation(context)?;
        let was_shown = simulation.machine().unshow(port, &name);
        simulation.shared().wake();
        match was_shown {
            Ok(was_shown) => into_prolog_result(was_shown),
            Err(errno) => cannot_show(&call, errno, attribute, attribute),
        }
    }

    /// sim_wait_(+Seconds, -Reason): `over` at the end.
    nondet fn "sim_wait_"<Slices<Sleep>>(context, seconds, reason) as call("sim_wait", 1) {
        setup => {
            let Ok(time) = Duration::try_from_secs_f64(call.float(seconds)?) else {
                return wrong_value(&call, "seconds", seconds);
            };
            let files = Registry::new(Arc::new(SimulatedFiles::new(simulation(context)?)));
            Ok(Some(Sleep::new(Arc::new(files), time)))
        },
        call(sleep) => {
            call.slice(sleep, reason, |()| unify_atom(reason, "over"))
        }
    }

    /// sim_plan_(+Seconds): runs the due goals of this thread after some time.
    semidet fn "sim_plan_"(context, after) as call("sim_at", 2) {
        let after = call.time(after)?;
        let bell = Bell::of_this_thread();
        let ring = move || {
            bell.ring();
            None
        };
        simulation(context)?.repeat(after, Box::new(ring));
        Ok(())
    }

    /// sim_remote_(+Channel, +Buttons)
    semidet fn "sim_remote_"(context, channel, list) as call("sim_remote", 2) {
        let (channel, held) = (channel_of(&call, channel)?, remote_buttons(&call, list)?);
        match simulation(context)?.change_world(|machine| machine.hold_buttons(channel, &held)) {
            Ok(()) => Ok(()),
            Err(error) => wrong_because(&call, "ir_buttons", list, &error.reason),
        }
    }

    /// sim_step_(+Seconds)
    semidet fn "sim_step_"(context, seconds) as call("sim_step", 1) {
        let Ok(mut left) = Duration::try_from_secs_f64(call.float(seconds)?) else {
            return wrong_value(&call, "seconds", seconds);
        };
        let (simulation, mut interrupted) = (simulation(context)?, call.interrupted());
        while !left.is_zero() {
            let slice = left.min(STEP_SLICE);
            simulation.step(slice);
            left -= slice;
            if interrupted() {
                return call.or_throw(Err(ev3_driver::Error::Interrupted));
            }
        }
        Ok(())
    }

    /// sim_time_(-Seconds)
    semidet fn "sim_time_"(context, seconds) {
        seconds.unify(simulation(context)?.machine().now().as_secs_f64())
    }

    /// sim_unseen_: a page looks, but has not drawn the robot that it is to show.
    semidet fn "sim_unseen_"(_context) {
        into_prolog_result(watch::drawn_film().is_some_and(|film| film != shown_film()))
    }

    /// sim_clock_(-Seconds): the same, without a turn, nor a reason to fail.
    semidet fn "sim_clock_"(_context, seconds) {
        let simulation = running_simulation().ok_or(PrologError::Failure)?;
        seconds.unify(simulation.machine().now().as_secs_f64())
    }

    /// sim_snapshot_(-Snapshot)
    semidet fn "sim_snapshot_"(context, snapshot) as call("sim_snapshot", 1) {
        let machine = alone(&call)?.machine().clone();
        snapshot.unify(Arc::new(Snapshot::of(machine)))
    }

    /// sim_snapshots_(-Count): how many there are, those that are garbage included.
    semidet fn "sim_snapshots_"(_context, count) {
        count.unify(SNAPSHOTS.load(Ordering::Relaxed) as u64)
    }

    /// sim_restore_(+Snapshot)
    semidet fn "sim_restore_"(context, snapshot) as call("sim_restore", 1) {
        let snapshot: Arc<Snapshot> = snapshot.get_ex()?;
        let machine = locked(&snapshot.machine).clone();
        let simulation = alone(&call)?;
        simulation.machine().restore(machine);
        simulation.machine().keep_samples(watch::is_watched());
        watched().begin_film();
        devices().forget_listings();
        Ok(())
    }

    /// sim_collisions_(-Collisions): a list of collision(Time, X, Y, Heading).
    semidet fn "sim_collisions_"(context, collisions) {
        let seen: Vec<_> = simulation(context)?.machine().trace().collisions().copied().collect();
        let terms = seen.iter().map(|collision| {
            let (at, pose) = (collision.at.as_secs_f64(), collision.pose);
            term! {context: collision(#at, #pose.x, #pose.y, #pose.heading)}
        });
        let terms = terms.collect::<PrologResult<Vec<_>>>()?;
        collisions.unify(terms.as_slice())
    }

    /// sim_things_(-Things): a list of thing(Name, X, Y, Heading).
    semidet fn "sim_things_"(context, things) as call("sim_things", 1) {
        let simulation = simulation(context)?;
        let machine = simulation.machine();
        let terms = machine.things().iter().map(|thing| {
            let (pose, name) = (thing.pose(), thing_name(&call, thing)?);
            term! {context: thing(#&name, #pose.x, #pose.y, #pose.heading)}
        });
        let terms = terms.collect::<PrologResult<Vec<_>>>()?;
        things.unify(terms.as_slice())
    }

    /// sim_held_(-Names): the names of the things that the robot's grippers hold.
    semidet fn "sim_held_"(context, names) as call("sim_held", 1) {
        let simulation = simulation(context)?;
        let machine = simulation.machine();
        let things = machine.things().iter();
        let held = things.filter(|thing| machine.held().any(|held| held == thing.id()));
        let terms = held.map(|thing| thing_name(&call, thing)).collect::<PrologResult<Vec<_>>>()?;
        names.unify(terms.as_slice())
    }

    /// sim_trace_(-Trace): a list of at(Time, Event).
    semidet fn "sim_trace_"(context, trace) {
        let seen = simulation(context)?.machine().trace().clone();
        let poses = seen.path().map(|(at, pose)| Ok((*at, pose_entry(context, *at, *pose)?)));
        let events = seen.events().into_iter();
        let events = events.map(|event| Ok((event.at, event_entry(context, &event)?)));
        let mut entries = poses.chain(events).collect::<PrologResult<Vec<_>>>()?;
        entries.sort_by_key(|(at, _)| *at);
        let entries: Vec<_> = entries.into_iter().map(|(_, entry)| entry).collect();
        trace.unify(entries.as_slice())
    }

    /// sim_svg_(-Text)
    semidet fn "sim_svg_"(context, text) {
        let picture = simulation(context)?.machine().svg();
        unify_atom(text, &picture)
    }

    /// sim_mount_(+Directory, ?DevDirectory)
    semidet fn "sim_mount_"(context, classes, dev) as call("sim_mount", 1) {
        let dev = (!dev.is_var()).then_some(dev);
        mount::mount(&call, &simulation(context)?.shared(), classes, dev)
    }

    /// sim_unmount_
    semidet fn "sim_unmount_"(context) as call("sim_unmount", 0) {
        mount::unmount(&call)
    }
}

/// An entry of a trace: where the robot was.
fn pose_entry<'a, C: Prolog>(
    context: &'a Context<'a, C>,
    at: Duration,
    pose: Pose,
) -> PrologResult<Term<'a>> {
    let seconds = at.as_secs_f64();
    term! {context: at(#seconds, pose(#pose.x, #pose.y, #pose.heading))}
}

/// An entry of a trace: what happened.
fn event_entry<'a, C: Prolog>(
    context: &'a Context<'a, C>,
    event: &Event,
) -> PrologResult<Term<'a>> {
    let seconds = event.at.as_secs_f64();
    let (path, text) = (atomable(event.path.as_str()), atomable(event.text.as_str()));
    match event.action {
        Action::Written => term! {context: at(#seconds, written(#path, #text))},
        Action::Read => term! {context: at(#seconds, read(#path, #text))},
        Action::Tone => {
            term! {context: at(#seconds, tone(#event.text.parse::<i64>().unwrap_or(0)))}
        }
        Action::Said => term! {context: at(#seconds, said(#text))},
        Action::Played => term! {context: at(#seconds, played(#text))},
        Action::Silenced => term! {context: at(#seconds, silenced)},
        Action::Pressed => term! {context: at(#seconds, pressed(#text))},
        Action::Released => term! {context: at(#seconds, released(#text))},
    }
}

/// The running simulation, if it has one robot: several have one time.
fn alone<C: Prolog>(call: &Call<C>) -> PrologResult<Arc<Simulation>> {
    let simulation = simulation(call.context)?;
    if simulation.robots() > 1 {
        let reason = "several robots have one time, which goes back for none of them";
        return no_such(call, "feature", "snapshot_of_several_robots", reason);
    }
    Ok(simulation)
}

/// `world` or `robot`.
fn subject_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Subject> {
    match &*call.text(term)? {
        "world" => Ok(Subject::World),
        "robot" => Ok(Subject::Robot),
        _ => wrong_value(call, "subject", term),
    }
}

/// The name of a thing, or its number.
fn thing_name<'a, C: Prolog>(call: &Call<'a, C>, thing: &Thing) -> PrologResult<Term<'a>> {
    let (name, item) = (call.context.new_term_ref(), thing.item());
    match item.traits().and_then(|traits| traits.name.as_deref()) {
        Some(given) => unify_atom(&name, given)?,
        None => name.unify(i64::from(thing.id().0))?,
    }
    Ok(name)
}

/// A fact of the vocabulary, checked alone.
fn known_fact<'a, C: Prolog>(
    call: &Call<'a, C>,
    subject: Subject,
    term: &Term<'a>,
) -> PrologResult<Fact> {
    if let Some(fact) = facts::fact(call, subject, term)? {
        return Ok(fact);
    }
    let domain = match subject {
        Subject::World => "world_fact",
        Subject::Robot => "robot_fact",
    };
    facts::unknown(call, domain, subject, term)
}

fn facts_of<'a, C: Prolog>(
    call: &Call<'a, C>,
    subject: Subject,
    list: &Term<'a>,
) -> PrologResult<Vec<Fact>> {
    call.map_list(list, |term| known_fact(call, subject, &term))
}

/// An error: the list of facts, and the index of the faulty fact if there is one.
type Fault = (&'static str, Option<usize>, SpecError);

/// One of several robots has a name.
fn built(
    world: &[Fact],
    name: Option<&str>,
    robot: &[Fact],
    noise: bool,
    options: Options,
) -> Result<Machine, Fault> {
    let in_robot = |error: SpecError| ("robot", culprit(robot, &error), error);
    let spec = RobotSpec::from_facts(robot).map_err(in_robot)?;
    let spec = if noise { spec.with_typical_noise() } else { spec };
    let in_world = |error: SpecError| ("world", culprit(world, &error), error);
    let mut seen = WorldSpec::from_facts(world);
    if let Some(name) = name {
        seen = seen.seen_by(name).map_err(in_world)?;
    }
    Machine::new(&seen, &spec, options).map_err(in_world)
}

/// The clock, whether there is noise, and the rest.
fn options_of<'a, C: Prolog>(
    call: &Call<'a, C>,
    options: &Term<'a>,
) -> PrologResult<(Clock, bool, Options)> {
    let [clock, seed, noise, screen, thinking] = call.arguments(options)?;
    let thinking = u64::try_from(call.integer(&thinking)?).unwrap_or(0);
    let seed = u64::from_ne_bytes(call.integer(&seed)?.to_ne_bytes());
    let depth = if call.integer(&screen)? == 1 { Depth::One } else { Depth::ThirtyTwo };
    Ok((
        clock_of(call, &clock)?,
        noise.get_ex()?,
        Options { seed, depth, thinking, ..Options::default() },
    ))
}

/// A robot of several: its brick, its name, its facts.
type Robot = (u32, String, Vec<Fact>);

/// `robot(Brick, Name, RobotFacts)`
fn robot<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Robot> {
    let [brick, name, facts] = call.arguments(term)?;
    let brick = u32::try_from(call.integer(&brick)?).unwrap_or(u32::MAX);
    Ok((brick, call.text(&name)?.into_owned(), facts_of(call, Subject::Robot, &facts)?))
}

/// Starts several robots in a world; the inner error is that of a robot by its index, or of the
/// world.
fn start_robots<C: Prolog>(
    call: &Call<C>,
    world: &[Fact],
    robots: Vec<Robot>,
    (clock, noise, options): (Clock, bool, Options),
) -> PrologResult<Result<(), (Option<usize>, Fault)>> {
    let mut machines = Vec::new();
    for (index, (_, name, facts)) in robots.iter().enumerate() {
        let seed = options.seed.wrapping_add(index as u64);
        match built(world, Some(name), facts, noise, Options { seed, ..options }) {
            Ok(machine) => machines.push(machine),
            Err(error) => return Ok(Err((Some(index), error))),
        }
    }
    let robots: Vec<_> = robots.into_iter().map(|(brick, name, _)| (brick, name)).collect();
    let started = start_crowd(call, &robots, machines, clock)?;
    Ok(started.map_err(|(_, error)| (None, ("world", culprit(world, &error), error))))
}

/// fault(Subject, Index, Why); the subject is one of several robots if it has a place among them.
fn unify_fault<C: Prolog>(
    call: &Call<C>,
    fault: &Term,
    robot: Option<usize>,
    (subject, index, error): Fault,
) -> PrologResult<()> {
    let context = call.context;
    let index = index.map_or(0, |index| index as u64 + 1);
    let why = atomable(error.to_string());
    if let (Some(robot), "robot") = (robot, subject) {
        let robot = robot as u64 + 1;
        return fault.unify(&term! {context: fault(robot(#robot), #index, #why)}?);
    }
    let subject = atomable(subject);
    fault.unify(&term! {context: fault(#subject, #index, #why)}?)
}

/// `realtime`, `scaled(Factor)` or `virtual`.
fn clock_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Clock> {
    let factor = match attempt_opt(call.context.compound_terms::<1>(term))? {
        Some([factor]) => Some(call.float(&factor)?),
        None => match &*call.text(term)? {
            "realtime" => Some(1.0),
            "virtual" => return Ok(Clock::Virtual),
            _ => None,
        },
    };
    match factor {
        Some(factor) if factor > 0.0 && factor <= 1000.0 => Ok(Clock::Wall(factor)),
        _ => wrong_value(call, "clock", term),
    }
}

/// A port, in either spelling.
fn port_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<ev3_sim::Port> {
    let text = call.text(term)?;
    match ev3_driver::port_name::socket(&text).parse() {
        Ok(port) => Ok(port),
        Err(_) => named(call, "port", term),
    }
}

/// Why an attribute cannot be made to show a text.
fn cannot_show<T, C: Prolog>(
    call: &Call<C>,
    errno: Errno,
    attribute: &Term,
    text: &Term,
) -> PrologResult<T> {
    match errno {
        Errno::ENODEV => Err(PrologError::Failure),
        Errno::ENOENT => {
            let name = call.text(attribute)?;
            no_such(call, "attribute", &name, &format!("that device has no attribute {name}"))
        }
        Errno::EACCES => wrong_because(call, "readable_attribute", attribute, "is only written"),
        _ => wrong_because(call, "attribute_text", text, "is longer than a page"),
    }
}

/// The simulator's result; raises an impossible request as an exception.
fn possible<T, C: Prolog>(call: &Call<C>, result: Result<T, SpecError>) -> PrologResult<T> {
    result.or_else(|error| {
        let item = call.context.new_term_ref();
        unify_atom(&item, &error.item)?;
        wrong_because(call, "possible_geometry", &item, &error.reason)
    })
}
