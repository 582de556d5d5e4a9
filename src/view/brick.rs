//! The state of a real tree: what the driver knows, and a few reads a second.
use super::believed::{believe, believed};
use super::notes::notes;
use super::state::{
    Brick, Decimal, Devices, Fine, Lights, OrNull, PORTS, Port, Robot, Row, Samples, Screen,
    Surroundings, Words, text,
};
use crate::glue::state::{dev, devices};
use ev3_driver::brick::{buttons, screen};
use ev3_driver::drive::Believed;
use ev3_driver::{Class, Device, Registry, motor};
use ev3_json::Json;
use ev3_os::Instant;
use ev3_os::locked;
use std::collections::VecDeque;
use std::sync::Mutex;
use std::time::Duration;

/// How often the files are read at most.
const EVERY: Duration = Duration::from_millis(200);

/// How many samples are kept.
const SAMPLES: usize = 1024;

static READ: Mutex<Option<Read>> = Mutex::new(None);

/// What was read last.
struct Read {
    at: Instant,
    tree: String,
    /// Members of a frame.
    devices: String,
    /// The units of the motors.
    units: Vec<Option<&'static str>>,
    samples: VecDeque<Sample>,
}

/// The values at a moment of the tree's clock.
struct Sample {
    at: Duration,
    pose: Option<[f64; 3]>,
    /// Position, speed and duty of a motor, or the first values of a sensor.
    values: Vec<Vec<f64>>,
}

/// The time, and the members of a frame that change all the time.
pub(super) fn state() -> (Duration, String) {
    let devices = devices();
    let now = devices.tree().now();
    // Pages name a moment by its microseconds.
    let at = Duration::from_micros(u64::try_from(now.as_micros()).unwrap_or(u64::MAX));
    let believed = believed(Duration::MAX);
    let robot = Robot { believed: OrNull(believe(believed.as_ref())), ..Robot::default() };
    let mut read = locked(&READ);
    let tree = devices.tree().root().to_string_lossy().into_owned();
    let known = read.take().filter(|read| read.tree == tree);
    let read = read.insert(match known {
        Some(read) if read.at.elapsed() < EVERY => read,
        old => {
            let ports: Vec<_> = PORTS.iter().map(|port| port_of(&devices, port)).collect();
            let mut samples = old.map(|old| old.samples).unwrap_or_default();
            if samples.len() == SAMPLES {
                samples.pop_front();
            }
            let pose = believed.map(|Believed { pose, .. }| [pose.x, pose.y, pose.heading]);
            samples.push_back(Sample { at, pose, values: ports.iter().map(values).collect() });
            notes().keep("screen", text(&screen(&devices)));
            let units = ports.iter().map(|port| port.unit).collect();
            let mut json = Json::new();
            Devices { ports, brick: brick(&devices) }.members(&mut json);
            Read { at: Instant::now(), tree, devices: json.into_text(), units, samples }
        }
    });
    let mut json = Json::new();
    Surroundings { robot, ..Surroundings::default() }.members(&mut json);
    json.raw(&read.devices);
    (now, json.into_text())
}

/// The samples after a moment, or all, and the time of the last one; `None` if there are none.
pub(super) fn samples(after: Option<Duration>) -> Option<(Samples, Duration)> {
    let read = locked(&READ);
    let read = read.as_ref()?;
    let is_new = |sample: &&Sample| after.is_none_or(|after| sample.at > after);
    let rows: Vec<_> = read.samples.iter().filter(is_new).map(row).collect();
    let unit = |port: usize, index: usize| match read.units[port] {
        Some("mm") => ["mm", "mm/s", "%"][index],
        Some(_) => ["deg", "deg/s", "%"][index],
        None => "",
    };
    Some((Samples::of(&rows, &[["bx", "by", "bh"].map(Into::into)], &unit), rows.last()?.time))
}

fn row(sample: &Sample) -> Row<'_> {
    Row {
        time: sample.at,
        poses: vec![sample.pose],
        values: sample.values.iter().map(Vec::as_slice).collect(),
    }
}

/// What the samples have of a port.
fn values(port: &Port) -> Vec<f64> {
    let known = |part: Option<Fine>| part.map_or(f64::NAN, |Decimal(number)| number);
    match (port.unit, &port.values) {
        (Some(_), _) => [port.position, port.speed, port.duty].map(known).into(),
        (_, Some(values)) => values.iter().take(4).map(|Decimal(value)| *value).collect(),
        _ => Vec::new(),
    }
}

/// What lights, buttons and battery show.
fn brick(devices: &Registry) -> Brick {
    let light = |side, name| ["red", "green"].map(|color| light(devices, side, name, color));
    let keys = buttons::pressed(&*dev()).ok().flatten().unwrap_or_default();
    let battery = devices.all(Class::Battery).ok().and_then(|all| all.first().cloned());
    let micros =
        |attribute| number(battery.as_ref()?, attribute).map(|micros| Decimal(micros / 1e6));
    Brick {
        lights: Lights { left: light(0, "left"), right: light(1, "right") },
        keys: keys.into_iter().map(buttons::Button::word).collect(),
        volts: micros("voltage_now"),
        amps: micros("current_now"),
        tone: 0,
    }
}

/// The screen; `None` if there is none.
fn screen(devices: &Registry) -> OrNull<Screen> {
    let shades = screen::seen(devices.tree(), &*dev()).ok().flatten();
    OrNull(shades.map(Screen::of_shades))
}

/// The device at a port. Changes no mode.
fn port_of(devices: &Registry, name: &'static str) -> Port {
    let find = |class| devices.find(class, name).ok().flatten();
    let mut port = Port { port: name, kind: "empty", ..Port::default() };
    if let Some(motor) = find(Class::TachoMotor) {
        port_of_motor(&mut port, &motor);
    } else if let Some(motor) = find(Class::DcMotor) {
        port.have("dc", motor.driver().to_owned().into());
        port.duty = number(&motor, "duty_cycle").map(Decimal);
        port.state = Some(Words(word(&motor, "state").unwrap_or_default()));
    } else if let Some(servo) = find(Class::ServoMotor).filter(|_| find(Class::Sensor).is_none()) {
        port.have("servo", servo.driver().to_owned().into());
        port.position = number(&servo, "position_sp").map(Decimal);
    } else if let Some(sensor) = find(Class::Sensor) {
        port_of_sensor(&mut port, &sensor);
    }
    port
}

fn port_of_motor(port: &mut Port, motor: &Device) {
    port.have("motor", motor.driver().to_owned().into());
    let per_unit = motor::counts_per_unit(motor).ok().filter(|counts| *counts > 0.0);
    let unit = per_unit.map_or(1.0, f64::recip);
    let counts = |attribute| number(motor, attribute).map(|counts| Decimal(counts * unit));
    port.position = counts("position");
    port.speed = counts("speed");
    port.duty = number(motor, "duty_cycle").map(Decimal);
    port.state = Some(Words(word(motor, "state").unwrap_or_default()));
    port.stop = word(motor, "stop_action").map(Into::into);
    port.held = Some(false);
    #[expect(clippy::cast_precision_loss, reason = "some thousands")]
    let fastest = motor.constant("max_speed").map(|fastest| Decimal(fastest as f64 * unit));
    port.max = fastest.ok();
    port.unit = Some(if motor.constant("count_per_rot").is_ok() { "deg" } else { "mm" });
}

fn port_of_sensor(port: &mut Port, sensor: &Device) {
    port.have("sensor", sensor.driver().to_owned().into());
    let decimals = number(sensor, "decimals").unwrap_or(0.0).clamp(0.0, 9.0);
    let count = number(sensor, "num_values").unwrap_or(1.0).clamp(0.0, 8.0);
    let value = |index| {
        let raw = number(sensor, &format!("value{index}"));
        Decimal(raw.map_or(f64::NAN, |raw| raw / 10_f64.powf(decimals)))
    };
    let indices = (0..8).take_while(|index| f64::from(*index) < count);
    port.mode = word(sensor, "mode").map(Into::into);
    port.values = Some(indices.map(value).collect());
    port.units = word(sensor, "units").map(Into::into);
}

fn word(device: &Device, attribute: &str) -> Option<String> {
    device.with_word(attribute, str::to_owned).ok()
}

#[expect(clippy::cast_precision_loss, reason = "a page shows fewer digits")]
fn number(device: &Device, attribute: &str) -> Option<f64> {
    device.number(attribute).ok().map(|number| number as f64)
}

/// The brightness of a light, by its names since stretch and on jessie.
fn light(devices: &Registry, side: usize, name: &str, color: &str) -> u64 {
    let all = devices.all(Class::Led).unwrap_or_default();
    let names = [format!("led{side}:{color}:brick-status"), format!("ev3:{name}:{color}:ev3dev")];
    let led = all.iter().find(|led| names.iter().any(|name| name == led.port()));
    led.and_then(|led| led.number("brightness").ok()?.try_into().ok()).unwrap_or(0)
}
