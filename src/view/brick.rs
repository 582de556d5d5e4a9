//! The state of a real tree: what the driver knows, and a few reads a second.
use super::believed::{believed, report_believed};
use super::notes::notes;
use crate::glue::state::{dev, devices};
use ev3_driver::brick::{buttons, screen};
use ev3_driver::lock::locked;
use ev3_driver::{Class, Device, Registry, motor};
use ev3_json::Json;
use std::collections::VecDeque;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How often the files are read at most.
const EVERY: Duration = Duration::from_millis(200);

/// How many samples are kept.
const SAMPLES: usize = 1024;

/// The ports, as they stand on the brick.
const PORTS: [&str; 8] = ["outA", "outB", "outC", "outD", "in1", "in2", "in3", "in4"];

static READ: Mutex<Option<Read>> = Mutex::new(None);

/// What was read last.
struct Read {
    at: Instant,
    tree: String,
    text: String,
    samples: VecDeque<Sample>,
}

/// A moment, in microseconds of the tree's clock, and what there was.
struct Sample {
    at: u64,
    pose: Option<[f64; 3]>,
    values: Vec<(String, &'static str, Option<f64>)>,
}

/// Writes the state; returns the time.
pub(super) fn report(json: &mut Json) -> Duration {
    let devices = devices();
    let now = devices.tree().now();
    let believed = believed(Duration::MAX);
    json.key("robot").object(|json| {
        json.key("true").null();
        report_believed(json, believed.as_ref());
    });
    json.key("see").array(|_| {});
    json.key("beams").array(|_| {});
    let mut read = locked(&READ);
    let tree = devices.tree().root().to_string_lossy().into_owned();
    let is_fresh = |read: &Read| read.tree == tree && read.at.elapsed() < EVERY;
    if !read.as_ref().is_some_and(is_fresh) {
        let pose =
            believed.map(|believed| [believed.pose.x, believed.pose.y, believed.pose.heading]);
        let (text, values) = look(&devices);
        let mut samples = read.take().filter(|read| read.tree == tree).map(|read| read.samples);
        let samples = samples.get_or_insert_default();
        if samples.len() == SAMPLES {
            samples.pop_front();
        }
        let at = u64::try_from(now.as_micros()).unwrap_or(u64::MAX);
        samples.push_back(Sample { at, pose, values });
        let samples = std::mem::take(samples);
        *read = Some(Read { at: Instant::now(), tree, text, samples });
    }
    if let Some(read) = &*read {
        json.raw(&read.text);
    }
    now
}

/// Writes the samples after a moment, in microseconds; returns the time of the last one.
pub(super) fn report_samples(json: &mut Json, after: u64) -> Option<u64> {
    let read = locked(&READ);
    let rows: Vec<_> = read.as_ref()?.samples.iter().filter(|row| row.at > after).collect();
    let last = rows.last()?.at;
    let mut columns: Vec<(&str, &str)> = Vec::new();
    for (name, unit, _) in rows.iter().flat_map(|row| &row.values) {
        if !columns.iter().any(|(known, _)| known == name) {
            columns.push((name, unit));
        }
    }
    json.key("samples").object(|json| {
        json.key("columns").array(|json| {
            for name in ["time", "bx", "by", "bh"] {
                json.text(name);
            }
            for (name, _) in &columns {
                json.text(name);
            }
        });
        json.key("units").array(|json| {
            for unit in ["s", "cm", "cm", "deg"] {
                json.text(unit);
            }
            for (_, unit) in &columns {
                json.text(unit);
            }
        });
        json.key("rows").array(|json| {
            for row in rows {
                json.array(|json| {
                    json.number(Duration::from_micros(row.at).as_secs_f64(), 3);
                    let pose = row.pose.unwrap_or([f64::NAN; 3]);
                    for part in pose {
                        json.number(part, 2);
                    }
                    for (name, _) in &columns {
                        let value = row.values.iter().find(|(other, ..)| other == name);
                        let number = value.and_then(|(.., number)| *number);
                        json.number(number.unwrap_or(f64::NAN), 3);
                    }
                });
            }
        });
    });
    Some(last)
}

type Values = Vec<(String, &'static str, Option<f64>)>;

/// Reads what motors, sensors, lights and battery show, and changes no mode.
fn look(devices: &Registry) -> (String, Values) {
    let mut json = Json::new();
    let mut values = Vec::new();
    json.key("ports").array(|json| {
        for port in PORTS {
            json.object(|json| {
                json.key("port").text(port);
                report_port(json, devices, port, &mut values);
            });
        }
    });
    json.key("brick").object(|json| {
        json.key("lights").object(|json| {
            for (side, name) in ["left", "right"].into_iter().enumerate() {
                json.key(name).array(|json| {
                    for color in ["red", "green"] {
                        json.integer(light(devices, side, name, color));
                    }
                });
            }
        });
        let keys = buttons::pressed(&*dev()).ok().flatten().unwrap_or_default();
        json.key("keys").array(|json| keys.into_iter().for_each(|key| json.text(key.word())));
        let battery = devices.all(Class::Battery).ok().and_then(|all| all.first().cloned());
        if let Some(battery) = battery {
            for (name, attribute) in [("volts", "voltage_now"), ("amps", "current_now")] {
                if let Some(micros) = number(&battery, attribute) {
                    json.key(name).number(micros / 1e6, 2);
                }
            }
        }
        json.key("tone").integer(0);
    });
    notes().keep("screen", &screen_text(devices));
    (json.into_text(), values)
}

/// The screen; `null` where there is none.
fn screen_text(devices: &Registry) -> String {
    let mut json = Json::new();
    let Some(shades) = screen::seen(devices.tree(), &*dev()).ok().flatten() else {
        json.null();
        return json.into_text();
    };
    ev3_sim::report_shades(&mut json, &shades);
    json.into_text()
}

fn report_port(json: &mut Json, devices: &Registry, port: &str, values: &mut Values) {
    let find = |class| devices.find(class, port).ok().flatten();
    if let Some(motor) = find(Class::TachoMotor) {
        report_motor(json, &motor, values);
    } else if let Some(motor) = find(Class::DcMotor) {
        named(json, "dc", motor.driver());
        if let Some(duty) = number(&motor, "duty_cycle") {
            json.key("duty").number(duty, 0);
        }
        report_state(json, &motor);
    } else if let Some(servo) = find(Class::ServoMotor).filter(|_| find(Class::Sensor).is_none()) {
        named(json, "servo", servo.driver());
        if let Some(position) = number(&servo, "position_sp") {
            json.key("position").number(position, 0);
        }
    } else if let Some(sensor) = find(Class::Sensor) {
        report_sensor(json, &sensor, values);
    } else {
        json.key("kind").text("empty");
    }
}

fn report_motor(json: &mut Json, motor: &Device, values: &mut Values) {
    named(json, "motor", motor.driver());
    let per_unit = motor::counts_per_unit(motor).ok().filter(|counts| *counts > 0.0);
    let unit = per_unit.map_or(1.0, f64::recip);
    let names =
        [("position", "position", unit), ("speed", "speed", unit), ("duty", "duty_cycle", 1.0)];
    let turns = motor.constant("count_per_rot").is_ok();
    let units = if turns { ["deg", "deg/s", "%"] } else { ["mm", "mm/s", "%"] };
    for ((name, attribute, unit), words) in names.into_iter().zip(units) {
        let value = number(motor, attribute).map(|value| value * unit);
        if let Some(value) = value {
            json.key(name).number(value, 2);
        }
        values.push((format!("{}.{name}", motor.port()), words, value));
    }
    report_state(json, motor);
    let _ = motor.with_word("stop_action", |word| json.key("stop").text(word));
    json.key("held").bool(false);
    if let Ok(fastest) = motor.constant("max_speed") {
        #[expect(clippy::cast_precision_loss, reason = "some thousands")]
        json.key("max").number(fastest as f64 * unit, 2);
    }
    json.key("unit").text(units[0]);
}

/// The words of `state`. A motor that the program has just started runs.
fn report_state(json: &mut Json, motor: &Device) {
    let words = motor.with_word("state", str::to_owned).unwrap_or_default();
    json.key("state").array(|json| words.split_whitespace().for_each(|word| json.text(word)));
}

fn report_sensor(json: &mut Json, sensor: &Device, values: &mut Values) {
    named(json, "sensor", sensor.driver());
    let _ = sensor.with_word("mode", |mode| json.key("mode").text(mode));
    let decimals = number(sensor, "decimals").unwrap_or(0.0).clamp(0.0, 9.0);
    let count = number(sensor, "num_values").unwrap_or(1.0).clamp(0.0, 8.0);
    let shown: Vec<_> = (0..8)
        .take_while(|index| f64::from(*index) < count)
        .map(|index| {
            let raw = number(sensor, &format!("value{index}"));
            raw.map(|raw| raw / 10_f64.powf(decimals))
        })
        .collect();
    for (index, value) in shown.iter().take(4).enumerate() {
        values.push((format!("{}.value{index}", sensor.port()), "", *value));
    }
    json.key("values").numbers(shown.into_iter().map(|value| value.unwrap_or(f64::NAN)), 3);
    let _ = sensor.with_word("units", |units| json.key("units").text(units));
}

fn named(json: &mut Json, kind: &str, driver: &str) {
    json.key("kind").text(kind);
    json.key("driver").text(driver);
    json.key("name").text(ev3_sim::name_of(driver));
}

#[expect(clippy::cast_precision_loss, reason = "a page shows fewer digits")]
fn number(device: &Device, attribute: &str) -> Option<f64> {
    device.number(attribute).ok().map(|number| number as f64)
}

/// The brightness of a light, by its names since stretch and on jessie.
fn light(devices: &Registry, side: usize, name: &str, color: &str) -> i64 {
    let all = devices.all(Class::Led).unwrap_or_default();
    let names = [format!("led{side}:{color}:brick-status"), format!("ev3:{name}:{color}:ev3dev")];
    let led = all.iter().find(|led| names.iter().any(|name| name == led.port()));
    led.and_then(|led| led.number("brightness").ok()).unwrap_or(0)
}
