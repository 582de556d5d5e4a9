//! The measurement of each sensor at this place and time.

mod floor;
mod infrared;
pub(crate) mod sight;

use crate::noise::{Heard, Source};
use crate::sensor::{Axle, Reading, SUPPLY_MV, SWITCHED_MV, Sense};
use crate::world::color::Color;
use crate::world::scene::{Others, Scene};
use ev3_motion::{Pose, Vec2, heading_vector, length};

/// The number of rays of the ultrasonic cone.
const SONAR_RAYS: u32 = 13;
/// Nearer than this the sensor cannot measure, farther it hears nothing, in cm.
const SONAR_NEAR: f64 = 3.0;
const SONAR_FAR: f64 = 255.0;
/// Infrared proximity: a narrower cone, 100 % at 70 cm.
const INFRARED_HALF_ANGLE: f64 = 8.0;
const INFRARED_RAYS: u32 = 5;
const INFRARED_FAR: f64 = 70.0;
/// The color sensor's spot on the floor has this radius, in cm.
const SPOT: f64 = 0.4;
/// What looks ahead sees this far, in cm; the light that comes back decreases evenly up to there.
const AHEAD_FAR: f64 = 4.0;
/// The color of a surface to which no fact gives a color.
const UNPAINTED: Color = Color::rgb(128, 128, 128);
/// How high lamps hang, in cm, and the distance at which their intensity is stated.
const LAMP_HEIGHT: f64 = 30.0;
const LAMP_DISTANCE: f64 = 100.0;
/// A raw RGB part of white paper; the sensor is not calibrated.
const RAW_WHITE: f64 = 420.0;
/// The value of REF-RAW in the dark with its LED off.
const RAW_DARK: f64 = 560.0;
/// A bumper: half its width, and how far it gives way, in cm.
const BUMPER_HALF: f64 = 4.0;
const BUMPER_TRAVEL: f64 = 0.5;

/// The NXT's sonar: nothing there is 255 cm.
const NXT_SONAR_NOTHING: f64 = 255.0;
/// The range of the sensor that measures how long light takes: two meters in a narrow beam.
const TIME_OF_FLIGHT_FAR: f64 = 200.0;
/// How far `HiTechnic`'s proximity detector sees its own light come back, in cm.
const REFLECTOR_FAR: f64 = 25.0;
/// `HiTechnic`'s accelerometer counts this many to the g, by its data sheet.
const COUNTS_PER_G: i32 = 200;

/// The world as one sensor sees it.
pub(crate) struct View<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) others: Others<'a>,
    /// The place of the sensor in the world, and its heading.
    pub(crate) pose: Pose,
    /// Degrees since the last reset, for a gyro.
    pub(crate) angle: f64,
    /// Degrees per second, for a gyro.
    pub(crate) rate: f64,
    /// The share of the voltage that each output port gives a lamp.
    pub(crate) power: [f64; 4],
    /// The state of the axle that an angle sensor measures.
    pub(crate) axle: Axle,
    /// Whether a color sensor sees what stands ahead of it, not the floor.
    pub(crate) looks_ahead: bool,
    /// Whether a hand presses the sensor.
    pub(crate) is_held: bool,
    pub(crate) noise: Source,
    pub(crate) echo: Heard,
}

impl View<'_> {
    /// The values of a mode.
    pub(crate) fn measure(&mut self, sense: Sense) -> Reading {
        let mut reading = [0; 8];
        match sense {
            Sense::Reflection => reading[0] = self.percent(View::reflection),
            Sense::Ambient => reading[0] = self.percent(View::light),
            Sense::Color => reading[0] = self.color_code(),
            Sense::ReflectionRaw => {
                let dark = RAW_DARK - 3.0 * self.light();
                let lit = dark - self.reflection() * 4.0;
                reading[0] = whole(self.noise.disturb(lit).clamp(0.0, 1023.0));
                reading[1] = whole(dark.clamp(0.0, 1023.0));
            }
            Sense::Rgb => {
                for (value, part) in reading.iter_mut().zip(self.spot()) {
                    let raw = self.noise.disturb(part / 235.0 * RAW_WHITE);
                    *value = whole(raw.clamp(0.0, 1023.0));
                }
            }
            Sense::Distance { inches, .. } => reading[0] = self.distance(inches),
            Sense::Angle => reading[0] = self.gyro_angle(),
            Sense::Rate => reading[0] = self.gyro_rate(1.0, 440.0),
            Sense::FineRate => reading[0] = self.gyro_rate(10.0 / 3.0, 1464.0),
            Sense::AngleAndRate => {
                reading[0] = self.gyro_angle();
                reading[1] = self.gyro_rate(1.0, 440.0);
            }
            Sense::Proximity => reading[0] = self.percent(View::proximity),
            Sense::Seek => reading = self.seek(),
            Sense::Remote => reading = self.remotes(),
            Sense::RemoteBits => reading[0] = self.scene.remotes[0].bits(),
            Sense::Touch => reading[0] = i32::from(self.pressed()),
            Sense::Volts => reading[0] = if self.pressed() { SUPPLY_MV } else { 0 },
            Sense::Pin => reading[0] = if self.pressed() { SWITCHED_MV } else { SUPPLY_MV },
            Sense::FineReflection => reading[0] = self.fine_percent(View::reflection),
            Sense::FineAmbient => reading[0] = self.fine_percent(View::light),
            Sense::Silence => reading[0] = 1000 - self.fine_percent(|view| view.scene.loudness),
            Sense::NxtDistance { inches, .. } => reading[0] = self.nxt_distance(inches),
            Sense::Temperature { per_degree, fahrenheit } => {
                let celsius = self.noise.disturb(self.scene.temperature);
                let degrees = if fahrenheit { celsius * 1.8 + 32.0 } else { celsius };
                reading[0] = whole(degrees * f64::from(per_degree));
            }
            Sense::Compass => {
                let heading = self.noise.disturb(self.pose.heading);
                reading[0] = whole(heading).rem_euclid(360);
            }
            Sense::ColorNumber { parts } => reading = self.color_number(parts),
            Sense::Part(index) => reading[0] = self.part(index),
            Sense::Parts(kind) => reading = self.parts(kind),
            Sense::Direction { strengths, mean } => reading = self.directions(strengths, mean),
            Sense::RateWithin { per_degree, limits: [low, high] } => {
                let rate = (self.rate + self.noise.jitter()) * f64::from(per_degree);
                reading[0] = whole(rate).clamp(low, high);
            }
            Sense::Hundredths { all } => {
                let angle = self.angle + self.noise.jitter();
                reading[0] = whole(angle * 100.0);
                if all {
                    reading[1] = whole(self.rate * 100.0);
                    reading[4] = 1000;
                }
            }
            Sense::Gravity { per_g } => reading[2] = per_g,
            // The ten bits of each axis: the upper eight, and further on the lower two.
            Sense::GravityBytes => {
                reading[2] = COUNTS_PER_G >> 2;
                reading[5] = COUNTS_PER_G & 3;
            }
            Sense::AxesRate => reading[2] = whole(self.rate * 10.0),
            Sense::Millimeters => {
                let distance = self.cone(INFRARED_HALF_ANGLE, INFRARED_RAYS, TIME_OF_FLIGHT_FAR);
                let seen = self.noise.disturb(distance.unwrap_or(TIME_OF_FLIGHT_FAR));
                reading[0] = whole(seen.clamp(SONAR_NEAR, TIME_OF_FLIGHT_FAR) * 10.0);
            }
            Sense::Reflector { reach } => {
                let near = self.cone(INFRARED_HALF_ANGLE, INFRARED_RAYS, REFLECTOR_FAR);
                let seen = near.map_or(0.0, |distance| f64::from(reach) / distance.max(0.1));
                reading[0] = whole(self.noise.disturb(seen).clamp(0.0, 100.0));
            }
            Sense::AxleAngle => reading[0] = whole(self.axle.angle()).rem_euclid(360),
            Sense::AxleTurned { times } => {
                reading[0] = whole(self.axle.turned() * f64::from(times));
            }
            Sense::AxleSpeed => reading[0] = whole(self.axle.rate / 6.0),
            Sense::AxleAll => {
                reading[0] = whole(self.axle.turned());
                reading[1] = whole(self.axle.turned() * 2.0);
                reading[2] = whole(self.axle.rate / 6.0);
            }
            Sense::Row { times } => reading = self.row(times),
            Sense::LineSteering => reading = self.line_steering(),
            Sense::Fixed(values) => reading[..values.len()].copy_from_slice(values),
            Sense::Nothing => {}
        }
        reading
    }

    /// In tenths.
    fn fine_percent(&mut self, measure: impl Fn(&Self) -> f64) -> i32 {
        let value = measure(self);
        whole(self.noise.disturb(value).clamp(0.0, 100.0) * 10.0)
    }

    fn nxt_distance(&mut self, inches: bool) -> i32 {
        let distance = self.echo();
        let heard = self.noise.disturb(distance.unwrap_or(NXT_SONAR_NOTHING));
        let centimeters = whole(heard.clamp(SONAR_NEAR, NXT_SONAR_NOTHING));
        if inches { centimeters * 1000 / 255 } else { centimeters }
    }

    fn percent(&mut self, measure: impl Fn(&Self) -> f64) -> i32 {
        let value = measure(self);
        whole(self.noise.disturb(value).clamp(0.0, 100.0))
    }

    /// What stands ahead: the share of the light that comes back, and the color that a fact gives.
    fn ahead(&self) -> Option<(f64, Option<Color>)> {
        let (here, towards) = (self.pose.vec2(), heading_vector(self.pose.heading));
        let (distance, color) = self.scene.painted(self.others, here, towards, AHEAD_FAR)?;
        Some((1.0 - distance / AHEAD_FAR, color))
    }

    /// Red, green and blue, 0–255: of the floor, averaged over the sensor's spot, or of what stands
    /// ahead, as bright as it looks.
    fn spot(&self) -> [f64; 3] {
        if self.looks_ahead {
            let (share, color) = self.ahead().unwrap_or_default();
            return parts(color.unwrap_or(UNPAINTED)).map(|part| part * share);
        }
        let mut sum = [0.0; 3];
        let ring = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)];
        let diagonal = [(0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)];
        for (x, y) in ring.into_iter().chain(diagonal) {
            let color = self.scene.color_at(self.pose.vec2() + Vec2::new(x, y) * SPOT);
            sum = std::array::from_fn(|index| sum[index] + parts(color)[index]);
        }
        sum.map(|part| part / 9.0)
    }

    /// Per cent of the red LED's light that comes back.
    fn reflection(&self) -> f64 {
        self.spot()[0] / 2.55
    }

    /// Nothing near, or nothing with a color, is 0.
    fn color_code(&mut self) -> i32 {
        let seen = if self.looks_ahead {
            self.ahead().and_then(|(_, color)| color).map(parts)
        } else {
            Some(self.spot())
        };
        let Some(seen) = seen else { return 0 };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to a byte"
        )]
        let [red, green, blue] =
            seen.map(|part| libm::round(self.noise.disturb(part)).clamp(0.0, 255.0) as u8);
        Color { red, green, blue }.code()
    }

    /// Light from all around, and from each lamp that is not in a shadow: it falls with the
    /// square of the distance and with the cosine of the angle at which it comes in.
    fn light(&self) -> f64 {
        let here = self.pose.vec2();
        let ahead = heading_vector(self.pose.heading);
        let full = LAMP_DISTANCE * LAMP_DISTANCE + LAMP_HEIGHT * LAMP_HEIGHT;
        let mut light = self.scene.ambient;
        for (lamp, intensity) in self.scene.lamps(self.power) {
            let way = lamp - here;
            let distance = length(way);
            let facing = if distance < 1e-9 { 1.0 } else { way.dot(&ahead) / distance };
            if facing > 0.0 && self.scene.clear_between(self.others, here, lamp) {
                let square = distance * distance + LAMP_HEIGHT * LAMP_HEIGHT;
                light += intensity * facing * full / square;
            }
        }
        light
    }

    /// What the sonar hears, before the noise.
    fn echo(&self) -> Option<f64> {
        let Heard { cone, is_missed, spurious } = &self.echo;
        if *is_missed {
            return None;
        }
        let distance = if cone.incidence < 90.0 {
            self.facing(cone.half_angle, libm::cos(cone.incidence.to_radians()))
        } else {
            self.cone(cone.half_angle, SONAR_RAYS, SONAR_FAR)
        };
        match spurious {
            Some(share) => {
                Some(SONAR_NEAR + share * (distance.unwrap_or(SONAR_FAR) - SONAR_NEAR).max(0.0))
            }
            None => distance,
        }
    }

    /// The nearest surface in the sonar's cone that a ray meets with at least this cosine of its
    /// incidence.
    fn facing(&self, half_angle: f64, least: f64) -> Option<f64> {
        let here = self.pose.vec2();
        let hits = fan(self.pose.heading, half_angle, SONAR_RAYS).filter_map(|ray| {
            let (distance, normal) = self.scene.surface(self.others, here, ray, SONAR_FAR)?;
            (-normal.dot(&ray) >= least).then_some(distance)
        });
        hits.min_by(f64::total_cmp)
    }

    /// The nearest thing in a cone, if there is one.
    fn cone(&self, half_angle: f64, rays: u32, far: f64) -> Option<f64> {
        let here = self.pose.vec2();
        let mut directions = [Vec2::zeros(); SONAR_RAYS as usize];
        let directions = &mut directions[..rays as usize];
        for (towards, ray) in directions.iter_mut().zip(fan(self.pose.heading, half_angle, rays)) {
            *towards = ray;
        }
        self.scene.cast_all(self.others, here, directions, far)
    }

    fn distance(&mut self, inches: bool) -> i32 {
        let (unit, out_of_range) = if inches { (2.54, 1003) } else { (1.0, 2550) };
        let Some(distance) = self.echo() else {
            return out_of_range;
        };
        let heard = self.noise.disturb(distance).clamp(SONAR_NEAR, SONAR_FAR);
        whole(heard / unit * 10.0).min(out_of_range)
    }

    fn proximity(&self) -> f64 {
        let distance = self.cone(INFRARED_HALF_ANGLE, INFRARED_RAYS, INFRARED_FAR);
        distance.unwrap_or(INFRARED_FAR) / INFRARED_FAR * 100.0
    }

    fn gyro_angle(&mut self) -> i32 {
        // The bias of a gyro is its drift and already in the angle.
        let jitter = self.noise.jitter();
        whole(self.angle + jitter)
    }

    fn gyro_rate(&mut self, per_degree: f64, most: f64) -> i32 {
        let jitter = self.noise.jitter();
        whole(((self.rate + jitter) * per_degree).clamp(-most, most))
    }

    fn pressed(&self) -> bool {
        let end = |x: f64| self.pose.compose(&Pose::new(x, 0.0, 0.0)).vec2();
        self.is_held
            || self.scene.near_bumper(
                self.others,
                end(-BUMPER_HALF),
                end(BUMPER_HALF),
                BUMPER_TRAVEL,
            )
    }
}

fn parts(color: Color) -> [f64; 3] {
    [color.red, color.green, color.blue].map(f64::from)
}

/// The directions of rays, from left to right.
fn fan(heading: f64, half_angle: f64, rays: u32) -> impl Iterator<Item = Vec2> {
    let step = 2.0 * half_angle / f64::from(rays - 1);
    (0..rays).map(move |ray| heading_vector(heading - half_angle + step * f64::from(ray)))
}

#[expect(clippy::cast_possible_truncation, reason = "saturates; sensors' numbers are small")]
fn whole(value: f64) -> i32 {
    libm::round(value) as i32
}
