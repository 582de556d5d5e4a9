//! The whole state as JSON, for a page that shows it.
//!
//! Nothing here changes the machine: no file is read, no time passes, and nothing is noted in the
//! trace. So a run is the same whether somebody looks or not. Lengths are in centimeters, angles
//! in degrees, times in seconds.

pub(crate) mod ports;
pub(crate) mod samples;
mod world;

use std::time::Duration;

use ev3_json::Json;

use crate::brick::panel::Button;
use crate::brick::screen::{Depth, HEIGHT, WIDTH};
use crate::machine::Machine;
use crate::machine::tree::Hardware;
use crate::robot::{Wheel, Wheels};
use crate::sense::sight::Sight;
use crate::world::Hull;
use crate::world::geometry::{Pose, Vec2};

/// Decimals of lengths, and of angles.
const FINE: u32 = 2;

/// What a page needs to know beside the machine itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct Beside<'a> {
    /// The driver of what a hand pulled out of each port.
    pub pulled: [Option<&'a str>; 8],
}

impl Machine {
    /// A number that changes whenever something comes into the world or leaves it.
    #[must_use]
    pub fn world_version(&self) -> u64 {
        self.scene.version()
    }

    /// A number that changes whenever something is drawn.
    #[must_use]
    pub fn screen_version(&self) -> u64 {
        self.panel.drawn
    }

    /// What the robot is made of.
    pub fn report_robot(&self, json: &mut Json) {
        let robot = &self.robot;
        json.object(|json| {
            json.key("hull");
            report_hull(json, robot.hull);
            if let Some(Wheels { left, right, axle }) = robot.wheels {
                for (name, Wheel { port, diameter, .. }) in [("left", left), ("right", right)] {
                    json.key(name).object(|json| {
                        json.key("port").text(port.name());
                        json.key("d").number(diameter, FINE);
                    });
                }
                json.key("axle").number(axle, FINE);
            }
            json.key("sensors").array(|json| {
                for mount in &robot.sensors {
                    json.object(|json| {
                        json.key("port").text(mount.port.name());
                        json.key("driver").text(&mount.driver);
                        place(json, &mount.pose);
                        json.key("h").number(mount.pose.heading, FINE);
                    });
                }
            });
        });
    }

    /// The members of an object that change all the time: what the sensors see, the lamps, the
    /// ports, and the brick.
    pub fn report_state(&self, json: &mut Json, beside: &Beside) {
        json.key("see").array(|json| self.report_sights(json));
        json.key("beams").array(|json| self.report_lamps(json));
        json.key("ports").array(|json| self.report_ports(json, beside));
        json.key("brick").object(|json| self.report_brick(json));
    }

    /// Whether the robot or one of its motors moves.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.is_moving()
    }

    /// The screen: one bit for a pixel, or a byte if it has shades, or three if it has colors.
    pub fn report_screen(&self, json: &mut Json) {
        let pixels = self.pixels();
        let is_gray = pixels.iter().all(|[red, green, blue]| red == green && green == blue);
        if is_gray {
            let shades: Vec<_> = pixels.iter().map(|pixel| pixel[0]).collect();
            report_shades(json, &shades);
        } else {
            report_pixels(json, |json| json.key("rgb").base64(pixels.as_flattened()));
        }
    }

    /// Red, green and blue of each pixel.
    fn pixels(&self) -> Vec<[u8; 3]> {
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

    fn report_brick(&self, json: &mut Json) {
        json.key("lights").object(|json| {
            for (side, name) in ["left", "right"].into_iter().enumerate() {
                json.key(name).array(|json| {
                    for color in ["red", "green"] {
                        json.integer(self.light(&format!("led{side}:{color}:brick-status")));
                    }
                });
            }
        });
        json.key("keys").array(|json| {
            let all = ["up", "down", "left", "right", "enter", "back"];
            let is_down =
                |name: &&str| name.parse().is_ok_and(|button: Button| self.is_pressed(button));
            all.iter().filter(|name| is_down(name)).for_each(|name| json.text(name));
        });
        if let Some(Hardware::Battery(battery)) = self.tree.hardware(self.battery) {
            json.key("volts").number(battery.volts, FINE);
            json.key("amps").number(battery.amperes, FINE);
        }
        json.key("tone").integer(self.tone().into());
    }

    fn light(&self, name: &str) -> i64 {
        let lit = self.tree.all().find_map(|hardware| match hardware {
            Hardware::Led(led) if led.name == name => Some(led.brightness()),
            _ => None,
        });
        lit.unwrap_or(0).into()
    }

    fn report_sights(&self, json: &mut Json) {
        for socket in &self.sockets {
            let device = socket.device.and_then(|serial| self.tree.hardware(serial));
            let Some(Hardware::Sensor(sensor)) = device else { continue };
            let view = self.view(sensor);
            let Some(sight) = view.sight(sensor.mode().sense) else { continue };
            json.object(|json| {
                json.key("port").text(socket.port.name());
                report_sight(json, &view.pose, &sight);
            });
        }
    }

    fn report_lamps(&self, json: &mut Json) {
        let power = self.power();
        for (id, item) in self.scene.items() {
            if let crate::world::Item::Bulb { port, .. } = item {
                json.object(|json| {
                    json.key("id").integer(id.0.into());
                    json.key("power").number(power[port.slot()], FINE);
                });
            }
        }
    }
}

fn report_hull(json: &mut Json, hull: Hull) {
    json.object(|json| match hull {
        Hull::Circle { radius } => {
            json.key("kind").text("circle");
            json.key("r").number(radius, FINE);
        }
        Hull::Rectangle { width, length, offset } => {
            json.key("kind").text("rectangle");
            json.key("w").number(width, FINE);
            json.key("l").number(length, FINE);
            json.key("offset").number(offset, FINE);
        }
    });
}

fn report_sight(json: &mut Json, pose: &Pose, sight: &Sight) {
    let point = |json: &mut Json, at: &Vec2| json.numbers([at.x, at.y], FINE);
    match sight {
        Sight::Cone { fan, hit } => {
            json.key("kind").text("cone");
            place(json, pose);
            json.key("h").number(pose.heading, FINE);
            json.key("fan").array(|json| fan.iter().for_each(|end| point(json, end)));
            json.key("hit");
            match hit {
                Some(hit) => point(json, hit),
                None => json.null(),
            }
        }
        Sight::Spot(color) => {
            json.key("kind").text("spot");
            place(json, pose);
            json.key("color").text(&color.to_string());
        }
        Sight::Bumper { from, to, is_on } => {
            json.key("kind").text("touch");
            point(json.key("from"), from);
            point(json.key("to"), to);
            json.key("on").bool(*is_on);
        }
        Sight::Beacon(beacon) => {
            json.key("kind").text("beacon");
            place(json, pose);
            json.key("h").number(pose.heading, FINE);
            match beacon {
                Some((at, channel)) => {
                    json.key("channel").integer((*channel).into());
                    point(json.key("at"), at);
                }
                None => json.key("at").null(),
            }
        }
    }
}

/// The members `x` and `y`.
fn place(json: &mut Json, pose: &Pose) {
    json.key("x").number(pose.x, FINE);
    json.key("y").number(pose.y, FINE);
}

/// A time in seconds.
pub(super) fn seconds(json: &mut Json, time: Duration) {
    json.number(time.as_secs_f64(), 3);
}

/// A screen of shades of gray, line by line: one bit for a pixel, or a byte if not all are black
/// or white.
pub fn report_shades(json: &mut Json, shades: &[u8]) {
    report_pixels(json, |json| {
        if shades.iter().all(|shade| [0, 255].contains(shade)) {
            let byte = |eight: &[u8]| {
                let bit = |(index, shade): (usize, &u8)| u8::from(*shade == 0) << (7 - index);
                eight.iter().enumerate().map(bit).fold(0, |byte, bit| byte | bit)
            };
            json.key("bits").base64(&shades.chunks(8).map(byte).collect::<Vec<_>>());
        } else {
            json.key("gray").base64(shades);
        }
    });
}

fn report_pixels(json: &mut Json, pixels: impl FnOnce(&mut Json)) {
    json.object(|json| {
        json.key("w").integer(WIDTH.try_into().unwrap_or(0));
        json.key("h").integer(HEIGHT.try_into().unwrap_or(0));
        pixels(json);
    });
}
