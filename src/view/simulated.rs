//! The state of the simulator, for pages. No time passes, and nothing changes by it.
use super::believed::{ToWorld, believe, believed};
use super::hand::pulled;
use super::notes::notes;
use super::state::{
    Beam, Brick, Clock, Decimal, Devices, Fine, Hull, Item, Jaws, Lights, OrNull, Placed, Plugs,
    Port, Robot, Row, Samples, Screen, Sensor, Sight, Spec, Surroundings, Text, Wheel, Words,
    World, fine, points, text,
};
use crate::glue::state::watched;
use crate::sim::robot_name;
use ev3_json::Json;
use ev3_os::locked;
use ev3_sim::{
    Bounds, Button, ItemId, MOTOR_KINDS, Machine, Pose, Sample, SensorKind, Shown, Simulation,
    Thing,
};
use std::sync::Mutex;
use std::time::Duration;

/// The ports, as they stand on the brick.
const PORTS: [ev3_sim::Port; 8] = {
    use ev3_sim::Port::{In1, In2, In3, In4, OutA, OutB, OutC, OutD};
    [OutA, OutB, OutC, OutD, In1, In2, In3, In4]
};

/// The time, and the members of a frame that change all the time.
pub(super) fn state(simulation: &Simulation) -> (Duration, String) {
    let believed = believed(Duration::MAX);
    let machine = simulation.machine();
    keep_versions(&machine);
    let robot = Robot {
        r#true: OrNull(Some(parts(machine.pose()))),
        believed: OrNull(believe(believed.as_ref())),
        hits: Some(machine.trace().collision_count().into()),
        moving: Some(machine.is_moving()),
    };
    let see = machine
        .sights()
        .map(|(port, pose, sight)| Sight { port: port.name(), ..seen(pose, sight) });
    let beams = machine.bulbs().map(|(id, power)| Beam { id: id.0.into(), power: Decimal(power) });
    let [left, right] = machine.lights();
    let is_down = |name: &&str| name.parse().is_ok_and(|key: Button| machine.is_pressed(key));
    let keys = ["up", "down", "left", "right", "enter", "back"].into_iter().filter(is_down);
    let [volts, amps] = machine.battery().map_or([None; 2], |both| fine(both).map(Some));
    let mut json = Json::new();
    let other = |(id, item)| Item { name: robot_name(id).map(Text::from), ..item_of(id, &item) };
    let others: Vec<_> = machine.other_robots().map(other).collect();
    let others = (!others.is_empty()).then_some(others);
    let place = |thing: &Thing| Placed {
        id: thing.id().0.into(),
        pose: parts(thing.pose()),
        held: machine.held().any(|held| held == thing.id()).then_some(true),
    };
    let things: Vec<_> = machine.things().iter().map(place).collect();
    let things = (!things.is_empty()).then_some(things);
    let (see, beams) = (see.collect(), beams.collect());
    Surroundings { robot, see, beams, others, things }.members(&mut json);
    let ports = PORTS.iter().map(|port| shown(&machine, *port)).collect();
    let (lights, tone) = (Lights { left, right }, machine.tone().into());
    let brick = Brick { lights, keys: keys.collect(), volts, amps, tone };
    Devices { ports, brick }.members(&mut json);
    (machine.now(), json.into_text())
}

/// The clock at a time; `stands` if no time has passed since the last frame.
pub(super) fn clock(simulation: &Simulation, time: Duration, stands: bool) -> Clock {
    let clock = simulation.clock();
    let pace = match (simulation.pace(), clock) {
        (None, ev3_sim::Clock::Wall(_)) => "x1".into(),
        (Some(factor), _) if factor.is_finite() => format!("x{factor}").into(),
        _ => "max".into(),
    };
    Clock {
        time: Decimal(time.as_secs_f64()),
        kind: match clock {
            ev3_sim::Clock::Virtual => "virtual",
            ev3_sim::Clock::Wall(1.0) => "realtime",
            ev3_sim::Clock::Wall(_) => "scaled",
        },
        pace: Some(pace),
        paused: Some(simulation.is_paused()),
        stands: Some(stands),
    }
}

fn parts(Pose { x, y, heading }: Pose) -> [Fine; 3] {
    fine([x, y, heading])
}

fn shown(machine: &Machine, of: ev3_sim::Port) -> Port {
    let mut port = Port { port: of.name(), kind: "empty", ..Port::default() };
    match machine.shown(of) {
        Shown::Motor(motor) => {
            port.have("motor", motor.driver.into());
            port.position = Some(Decimal(motor.position));
            port.speed = Some(Decimal(motor.speed));
            port.duty = Some(Decimal(motor.duty.into()));
            port.opening = motor.opening.map(Decimal);
            port.state = Some(Words(motor.state));
            port.stop = Some(motor.stop_action.into());
            port.held = Some(motor.is_held);
            port.max = Some(Decimal(motor.max_speed));
            port.unit = Some(if motor.is_linear { "mm" } else { "deg" });
        }
        Shown::DcMotor { duty, state } => {
            port.have("dc", "rcx-motor".into());
            port.name = Some("DC motor".into());
            port.duty = Some(Decimal(duty.into()));
            port.state = Some(Words(state));
        }
        Shown::Lamp { brightness } => {
            port.kind = "light";
            port.name = Some("lamp".into());
            port.duty = Some(Decimal(brightness.into()));
        }
        Shown::Sensor(sensor) => {
            port.have("sensor", sensor.driver.into());
            port.mode = Some(sensor.mode.into());
            port.values = Some(sensor.values.into_iter().map(Decimal).collect());
            port.units = Some(sensor.units.into());
            port.label = sensor.label;
        }
        Shown::Coming(driver) => port.have("coming", driver.into()),
        Shown::Nothing => {
            if let Some(driver) = pulled()[of as usize] {
                port.have("gone", driver.into());
            }
        }
    }
    port
}

fn seen(pose: Pose, sight: ev3_sim::Sight) -> Sight {
    let mut seen = Sight::default();
    let [x, y, h] = parts(pose).map(Some);
    (seen.x, seen.y) = (x, y);
    match sight {
        ev3_sim::Sight::Cone { fan, hit } => {
            (seen.kind, seen.h) = ("cone", h);
            seen.fan = Some(points(&fan));
            seen.hit = Some(OrNull(hit.map(fine)));
        }
        ev3_sim::Sight::Spot(color) => {
            (seen.kind, seen.color) = ("spot", Some(color.to_string().into()));
        }
        ev3_sim::Sight::Bumper { from, to, is_on } => {
            (seen.kind, seen.x, seen.y) = ("touch", None, None);
            (seen.from, seen.to) = (Some(fine(from)), Some(fine(to)));
            seen.on = Some(is_on);
        }
        ev3_sim::Sight::Beacon(beacon) => {
            (seen.kind, seen.h) = ("beacon", h);
            seen.channel = beacon.map(|(_, channel)| channel.into());
            seen.at = Some(OrNull(beacon.map(|(at, _)| fine(at))));
        }
    }
    seen
}

/// Renews what is only sent when it has changed.
fn keep_versions(machine: &Machine) {
    static VERSIONS: Mutex<Option<[u64; 3]>> = Mutex::new(None);
    let mut versions = locked(&VERSIONS);
    let now = [watched().film(), machine.world_version(), machine.screen_version()];
    let before = versions.replace(now);
    let [film, world, screen] = before.unwrap_or_default();
    let is_new = before.is_none() || film != now[0];
    let mut notes = notes();
    if is_new {
        notes.keep("spec", text(&spec(machine)));
        let plugs = Plugs {
            out: MOTOR_KINDS.iter().map(|kind| kind.driver_name).collect(),
            r#in: SensorKind::all().map(|kind| kind.driver_name).collect(),
        };
        notes.keep("plugs", text(&plugs));
    }
    if is_new || world != now[1] {
        notes.keep("world", text(&world_of(machine)));
    }
    if is_new || screen != now[2] {
        notes.keep("screen", text(&Screen::of_colors(&machine.pixels())));
    }
}

fn spec(machine: &Machine) -> Spec {
    let robot = machine.robot();
    let wheel =
        |wheel: ev3_sim::Wheel| Wheel { port: wheel.port.name(), d: Decimal(wheel.diameter) };
    let sensor = |mount: &ev3_sim::SensorMount| {
        let [x, y, h] = parts(mount.pose);
        Sensor { port: mount.port.name(), driver: mount.driver.clone().into(), x, y, h }
    };
    let jaws = |gripper: &ev3_sim::Gripper| {
        let [x, y] = fine(gripper.at);
        Jaws { port: gripper.port.name(), x, y }
    };
    Spec {
        hull: match robot.hull {
            ev3_sim::Hull::Circle { radius } => {
                Hull { kind: "circle", r: Some(Decimal(radius)), ..Hull::default() }
            }
            ev3_sim::Hull::Rectangle { width, length, offset } => {
                let [w, l, offset] = fine([width, length, offset]).map(Some);
                Hull { kind: "rectangle", r: None, w, l, offset }
            }
        },
        left: robot.wheels.map(|wheels| wheel(wheels.left)),
        right: robot.wheels.map(|wheels| wheel(wheels.right)),
        axle: robot.wheels.map(|wheels| Decimal(wheels.axle)),
        sensors: robot.sensors.iter().map(sensor).collect(),
        grippers: (!robot.grippers.is_empty()).then(|| robot.grippers.iter().map(jaws).collect()),
    }
}

fn world_of(machine: &Machine) -> World {
    let corners = |Bounds { low: [x1, y1], high: [x2, y2] }| [x1, y1, x2, y2];
    let [ambient, temperature, loudness] = fine(machine.surroundings());
    World {
        bounds: OrNull(machine.bounds().map(|bounds| fine(corners(bounds)))),
        view: corners(machine.frame()).map(Decimal),
        floor: machine.floor().to_string().into(),
        ambient,
        temperature,
        loudness,
        start: parts(machine.start()),
        items: machine.items().map(|(id, item)| item_of(id, &item)).collect(),
    }
}

fn item_of(id: ItemId, item: &ev3_sim::Item) -> Item {
    let (kind, members) = item.members();
    Item { id: id.0.into(), kind, members, name: None }
}

/// The samples after a moment, or all, and the time of the last one; `None` if there are none.
pub(super) fn samples(
    simulation: &Simulation,
    after: Option<Duration>,
) -> Option<(Samples, Duration)> {
    let way = believed(after.unwrap_or_default()).map(|believed| believed.way).unwrap_or_default();
    let (to_world, mut next) = (ToWorld::now(), 0);
    let mut belief = |at: Duration| {
        while way.get(next).is_some_and(|(noted, _)| *noted <= at) {
            next += 1;
        }
        let (_, pose) = way.get(next.checked_sub(1)?)?;
        let pose = to_world.pose(*pose);
        Some([pose.x, pose.y, pose.heading])
    };
    let machine = simulation.machine();
    let samples = machine.samples(after);
    let rows = samples.iter().map(|sample| row(&machine, sample, &[belief(sample.at)]));
    let rows: Vec<_> = rows.collect();
    let unit = |port: usize, index: usize| match port {
        ..4 => ["deg", "deg/s", "%", "cm"][index],
        _ => machine.units(PORTS[port]),
    };
    let names = names(&machine, &[["x", "y", "heading"], ["bx", "by", "bh"]]);
    Some((Samples::of(&rows, &names, &unit), rows.last()?.time))
}

/// All samples as a table for a spreadsheet; `None` if there are none.
#[cfg(unix)]
pub(super) fn csv(machine: &Machine) -> Option<String> {
    let samples = machine.samples(None);
    let rows: Vec<_> = samples.iter().map(|sample| row(machine, sample, &[])).collect();
    let names = names(machine, &[["x", "y", "heading"]]);
    (!rows.is_empty()).then(|| Samples::of(&rows, &names, &|_, _| "").csv())
}

/// The names of the parts of these poses, and of those of the things.
fn names(machine: &Machine, of_robot: &[[&'static str; 3]]) -> Vec<[Text; 3]> {
    let of_robot = of_robot.iter().map(|names| names.map(Text::from));
    let of_thing = |thing: &Thing| {
        ["x", "y", "heading"].map(|part| format!("thing{}.{part}", thing.id().0).into())
    };
    of_robot.chain(machine.things().iter().map(of_thing)).collect()
}

fn row<'a>(machine: &Machine, sample: &'a Sample, belief: &[Option<[f64; 3]>]) -> Row<'a> {
    let numbers = |Pose { x, y, heading }: Pose| [x, y, heading];
    let thing = |thing: &Thing| {
        let (_, pose) = sample.things.iter().find(|(id, _)| *id == thing.id())?;
        Some(numbers(*pose))
    };
    let robot = [Some(numbers(sample.pose))].into_iter().chain(belief.iter().copied());
    Row {
        time: sample.at,
        poses: robot.chain(machine.things().iter().map(thing)).collect(),
        values: PORTS.iter().map(|port| sample.values(*port)).collect(),
    }
}
