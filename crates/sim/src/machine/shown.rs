//! The state of everything, for those who look on.
//!
//! Nothing here changes the machine: no file is read, no time passes, and nothing is noted in the
//! trace. So a run is the same whether somebody looks or not.
use crate::brick::port::Port;
use crate::brick::screen::{Depth, HEIGHT, WIDTH};
use crate::machine::Machine;
use crate::machine::socket::Plug;
use crate::machine::tree::Hardware;
use crate::mechanics::thing::Thing;
use crate::motor::{COUNT_PER_M, Tacho};
use crate::sense::sight::Sight;
use crate::sensor::Sensor;
use crate::world::color::Color;
use crate::world::{Item, ItemId};
use ev3_motion::{Bounds, Pose};

/// The device at a port.
#[derive(Clone, Debug, PartialEq)]
pub enum Shown {
    /// A tacho motor.
    Motor(ShownMotor),
    /// A DC motor.
    DcMotor {
        /// The duty of its bridge, in percent.
        duty: i32,
        /// The words of `state`.
        state: String,
    },
    /// A lamp.
    Lamp {
        /// Up to 100.
        brightness: u32,
    },
    /// A sensor.
    Sensor(ShownSensor),
    /// A device, by its driver, that the brick has not found out yet.
    Coming(&'static str),
    /// Nothing.
    Nothing,
}

/// A tacho motor. Lengths and speeds are in degrees, or in millimeters if it is linear.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownMotor {
    /// The driver's name.
    pub driver: &'static str,
    /// Where it is.
    pub position: f64,
    /// How fast it turns or goes.
    pub speed: f64,
    /// Its full speed.
    pub max_speed: f64,
    /// A linear actuator.
    pub is_linear: bool,
    /// The duty of its bridge, in percent.
    pub duty: i32,
    /// The words of `state`.
    pub state: String,
    /// Its stop action.
    pub stop_action: &'static str,
    /// A hand holds its shaft fast.
    pub is_held: bool,
    /// How far apart the jaws are that it moves, in cm.
    pub opening: Option<f64>,
}

/// A sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct ShownSensor {
    /// The driver's name.
    pub driver: &'static str,
    /// The mode.
    pub mode: &'static str,
    /// The values that a program would read now, with their decimals.
    pub values: Vec<f64>,
    /// Their units.
    pub units: &'static str,
    /// The word for what it measures, if there is a common one.
    pub label: Option<&'static str>,
}

impl Machine {
    /// A number that changes whenever something comes into the world or leaves it.
    pub fn world_version(&self) -> u64 {
        self.scene.version()
    }

    /// A number that changes whenever something is drawn.
    pub fn screen_version(&self) -> u64 {
        self.panel.drawn
    }

    /// Whether the robot, one of its motors or a thing in its world moves.
    pub fn is_moving(&self) -> bool {
        self.robot_moves() || self.things.iter().any(Thing::is_moving)
    }

    pub(super) fn robot_moves(&self) -> bool {
        self.body.slip != 0.0
            || self.body.spins.into_iter().flatten().any(|speed| speed != 0.0)
            || self.shafts.iter().any(|shaft| shaft.omega != 0.0)
    }

    /// The walls around the world.
    pub fn bounds(&self) -> Option<Bounds> {
        self.scene.bounds
    }

    /// The color of the floor where nothing lies on it.
    pub fn floor(&self) -> Color {
        self.scene.floor
    }

    /// Light from everywhere, temperature and loudness, as in the facts of a world.
    pub fn surroundings(&self) -> [f64; 3] {
        let scene = &self.scene;
        [scene.ambient, scene.temperature, scene.loudness]
    }

    /// The other robots in this world, as things of the same outline.
    pub fn other_robots(&self) -> impl Iterator<Item = (ItemId, Item)> {
        self.others().robots().map(|robot| (robot.id, robot.outline()))
    }

    /// Where the robot starts in this world.
    pub fn start(&self) -> Pose {
        self.scene.start
    }

    /// The device at a port.
    pub fn shown(&self, port: Port) -> Shown {
        let socket = &self.sockets[port as usize];
        match (self.device(port), socket.plug) {
            (Some(Hardware::Tacho(motor)), Some(_)) => {
                let is_held = self.shafts[port.slot()].jammed;
                Shown::Motor(ShownMotor {
                    opening: self.opening(port),
                    ..shown_motor(motor, is_held)
                })
            }
            (Some(Hardware::DcMotor(motor)), _) => {
                Shown::DcMotor { duty: motor.shown_duty(), state: motor.state() }
            }
            (Some(Hardware::Led(led)), _) => Shown::Lamp { brightness: led.brightness() },
            (Some(Hardware::Sensor(sensor)), Some(_)) => {
                let mode = sensor.mode();
                Shown::Sensor(ShownSensor {
                    driver: sensor.kind.driver_name,
                    mode: mode.name,
                    values: self.shown_values(sensor).collect(),
                    units: mode.units,
                    label: mode.label(),
                })
            }
            (_, plug) => plug.map_or(Shown::Nothing, |plug| Shown::Coming(plug.driver())),
        }
    }

    /// The units of the values of the sensor at a port; empty if there is none.
    pub fn units(&self, port: Port) -> &'static str {
        match self.device(port) {
            Some(Hardware::Sensor(sensor)) => sensor.mode().units,
            _ => "",
        }
    }

    /// The name of the driver of the device at a port.
    pub fn plugged(&self, port: Port) -> Option<&'static str> {
        self.sockets[port as usize].plug.map(Plug::driver)
    }

    /// What the sensors see of the world, each from its port and its place.
    pub fn sights(&self) -> impl Iterator<Item = (Port, Pose, Sight)> {
        self.sockets.iter().filter_map(|socket| {
            let Some(Hardware::Sensor(sensor)) = self.device(socket.port) else { return None };
            let view = self.view(sensor);
            Some((socket.port, view.pose, view.sight(sensor.mode().sense)?))
        })
    }

    /// The lamps that a port lights, and how brightly: 0 to 1.
    pub fn bulbs(&self) -> impl Iterator<Item = (ItemId, f64)> {
        let power = self.power();
        self.scene.items().iter().filter_map(move |(id, item)| match item {
            Item::Bulb { port, .. } => Some((*id, power[port.slot()])),
            _ => None,
        })
    }

    /// Red and green of the left and of the right light of the brick: 0 to 255.
    pub fn lights(&self) -> [[u64; 2]; 2] {
        let light = |side, color| {
            let name = format!("led{side}:{color}:brick-status");
            let lit = self.tree.all().find_map(|hardware| match hardware {
                Hardware::Led(led) if led.name == name => Some(led.brightness()),
                _ => None,
            });
            lit.unwrap_or(0).into()
        };
        [0, 1].map(|side| ["red", "green"].map(|color| light(side, color)))
    }

    /// Volts and amperes of the battery.
    pub fn battery(&self) -> Option<[f64; 2]> {
        match self.tree.hardware(self.battery) {
            Some(Hardware::Battery(battery)) => Some([battery.volts, battery.amperes]),
            _ => None,
        }
    }

    /// Red, green and blue of each pixel of the screen, line by line.
    pub fn pixels(&self) -> Vec<[u8; 3]> {
        let (screen, stride) = (&self.panel.screen, self.options.depth.stride());
        let pixel = |index: usize| {
            let (line, column) = (index / WIDTH * stride, index % WIDTH);
            match self.options.depth {
                Depth::One => {
                    let byte = screen.get(line + column / 8).copied().unwrap_or(0);
                    [if byte >> (column % 8) & 1 == 1 { 0 } else { 255 }; 3]
                }
                Depth::ThirtyTwo => {
                    let at = line + column * 4;
                    let part = |offset| screen.get(at + offset).copied().unwrap_or(0);
                    [part(2), part(1), part(0)]
                }
            }
        };
        (0..WIDTH * HEIGHT).map(pixel).collect()
    }

    pub(super) fn device(&self, port: Port) -> Option<&Hardware> {
        self.sockets[port as usize].device.and_then(|serial| self.tree.hardware(serial))
    }

    pub(super) fn shown_values(&self, sensor: &Sensor) -> impl Iterator<Item = f64> {
        let fresh = sensor.wants_reading().then(|| self.measure(sensor));
        let scale = 10_f64.powi(sensor.mode().decimals.into());
        sensor.shown(fresh).into_iter().flatten().map(move |value| f64::from(value) / scale)
    }
}

fn shown_motor(motor: &Tacho, is_held: bool) -> ShownMotor {
    let shown = motor.shown();
    let is_linear = motor.kind.travel.is_some();
    let unit = if is_linear { 1000.0 / f64::from(COUNT_PER_M) } else { 1.0 };
    ShownMotor {
        driver: motor.kind.driver_name,
        position: f64::from(shown.position) * unit,
        speed: f64::from(shown.speed) * unit,
        max_speed: f64::from(motor.kind.max_speed) * unit,
        is_linear,
        duty: shown.duty,
        state: motor.state(),
        stop_action: shown.stop_action,
        is_held,
        opening: None,
    }
}
