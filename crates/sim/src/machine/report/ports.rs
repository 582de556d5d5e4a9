//! The eight ports, each with what is plugged in.

use ev3_json::Json;

use super::{Beside, FINE};
use crate::brick::port::Port;
use crate::machine::Machine;
use crate::machine::socket::Plug;
use crate::machine::tree::Hardware;
use crate::motor::{COUNT_PER_M, Tacho};
use crate::sensor::Sensor;

/// As they stand on the brick.
const ORDER: [Port; 8] =
    [Port::OutA, Port::OutB, Port::OutC, Port::OutD, Port::In1, Port::In2, Port::In3, Port::In4];

/// What people call the devices of the sets.
const NAMES: [(&str, &str); 14] = [
    ("lego-ev3-l-motor", "large motor"),
    ("lego-ev3-m-motor", "medium motor"),
    ("lego-nxt-motor", "NXT motor"),
    ("act-l12-ev3-50", "linear actuator"),
    ("act-l12-ev3-100", "linear actuator"),
    ("lego-ev3-us", "ultrasonic sensor"),
    ("lego-ev3-color", "color sensor"),
    ("lego-ev3-gyro", "gyro"),
    ("lego-ev3-ir", "infrared sensor"),
    ("lego-ev3-touch", "touch sensor"),
    ("lego-nxt-us", "NXT ultrasonic sensor"),
    ("lego-nxt-touch", "NXT touch sensor"),
    ("lego-nxt-light", "NXT light sensor"),
    ("lego-nxt-sound", "NXT sound sensor"),
];

/// What people call a device; its driver if it has no better name.
#[must_use]
pub fn name_of(driver: &str) -> &str {
    NAMES.iter().find(|(known, _)| *known == driver).map_or(driver, |(_, name)| name)
}

impl Machine {
    pub(super) fn report_ports(&self, json: &mut Json, beside: &Beside) {
        for port in ORDER {
            json.object(|json| {
                json.key("port").text(port.name());
                self.report_port(json, port, beside);
            });
        }
    }

    fn report_port(&self, json: &mut Json, port: Port, beside: &Beside) {
        let socket = &self.sockets[port as usize];
        let device = socket.device.and_then(|serial| self.tree.hardware(serial));
        match (device, socket.plug) {
            (Some(Hardware::Tacho(motor)), Some(_)) => {
                report_motor(json, motor, self.shafts[port.slot()].jammed);
            }
            (Some(Hardware::DcMotor(motor)), _) => {
                json.key("kind").text("dc");
                named(json, "rcx-motor", "DC motor");
                json.key("duty").integer(motor.shown_duty().into());
                words(json, &motor.state());
            }
            (Some(Hardware::Led(led)), _) => {
                json.key("kind").text("light");
                json.key("name").text("lamp");
                json.key("duty").integer(led.brightness().into());
            }
            (Some(Hardware::Sensor(sensor)), Some(_)) => self.report_sensor(json, sensor),
            (_, Some(plug)) => {
                json.key("kind").text("coming");
                let driver = plug.driver();
                named(json, driver, name_of(driver));
            }
            (_, None) => match beside.pulled[port as usize] {
                Some(driver) => {
                    json.key("kind").text("gone");
                    named(json, driver, name_of(driver));
                }
                None => json.key("kind").text("empty"),
            },
        }
    }

    fn report_sensor(&self, json: &mut Json, sensor: &Sensor) {
        let mode = sensor.mode();
        json.key("kind").text("sensor");
        named(json, sensor.kind.driver_name, name_of(sensor.kind.driver_name));
        json.key("mode").text(mode.name);
        json.key("values");
        json.numbers(self.shown_values(sensor), mode.decimals.into());
        json.key("units").text(mode.units);
        if let Some(label) = mode.label() {
            json.key("label").text(label);
        }
    }

    /// The values that a program would read now, with their decimals.
    pub(super) fn shown_values(&self, sensor: &Sensor) -> impl Iterator<Item = f64> {
        let fresh = sensor.wants_reading().then(|| self.measure(sensor));
        let scale = 10_f64.powi(sensor.mode().decimals.into());
        sensor.shown(fresh).into_iter().flatten().map(move |value| f64::from(value) / scale)
    }

    /// What is plugged into a port, by the name of its driver.
    #[must_use]
    pub fn plugged(&self, port: Port) -> Option<&'static str> {
        self.sockets[port as usize].plug.map(Plug::driver)
    }
}

fn report_motor(json: &mut Json, motor: &Tacho, is_held: bool) {
    let shown = motor.shown();
    let is_linear = motor.kind.travel.is_some();
    // A linear actuator is read in millimeters.
    let unit = if is_linear { 1000.0 / f64::from(COUNT_PER_M) } else { 1.0 };
    json.key("kind").text("motor");
    named(json, motor.kind.driver_name, name_of(motor.kind.driver_name));
    json.key("position").number(f64::from(shown.position) * unit, FINE);
    json.key("speed").number(f64::from(shown.speed) * unit, FINE);
    json.key("duty").integer(shown.duty.into());
    words(json, &motor.state());
    json.key("stop").text(shown.stop_action);
    json.key("held").bool(is_held);
    json.key("max").number(f64::from(motor.kind.max_speed) * unit, FINE);
    json.key("unit").text(if is_linear { "mm" } else { "deg" });
}

fn named(json: &mut Json, driver: &str, name: &str) {
    json.key("driver").text(driver);
    json.key("name").text(name);
}

/// The words of `state`.
fn words(json: &mut Json, state: &str) {
    json.key("state").array(|json| state.split_whitespace().for_each(|word| json.text(word)));
}
