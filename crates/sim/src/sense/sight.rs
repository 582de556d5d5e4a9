//! The shapes in which a sensor sees the world.
use super::infrared::BEACON_FAR;
use super::{
    AHEAD_FAR, BUMPER_HALF, INFRARED_FAR, INFRARED_HALF_ANGLE, INFRARED_RAYS, REFLECTOR_FAR,
    SONAR_FAR, SONAR_RAYS, TIME_OF_FLIGHT_FAR, View,
};
use crate::sensor::Sense;
use crate::world::color::Color;
use ev3_motion::{Point, Pose, Vec2, length};

/// Half of the angle in which pages show what a color sensor sees ahead, in degrees.
const AHEAD_SHOWN: f64 = 4.0;

/// The part of the world that a sensor sees in a mode.
#[derive(Clone, Debug, PartialEq)]
pub enum Sight {
    /// A fan of rays, each of which ends at an obstacle, or as far as the sensor sees.
    Cone {
        /// The ends, from left to right.
        fan: Vec<Point>,
        /// The nearest obstacle.
        hit: Option<Point>,
    },
    /// A spot of the floor.
    Spot(Color),
    /// A bumper.
    Bumper {
        /// The left end.
        from: Point,
        /// The right end.
        to: Point,
        /// It is pressed.
        is_on: bool,
    },
    /// The nearest beacon in sight, and its channel.
    Beacon(Option<(Point, u8)>),
}

impl View<'_> {
    /// What is seen in a mode; `None` for a sensor that sees nothing of the world.
    pub(crate) fn sight(&self, sense: Sense) -> Option<Sight> {
        let narrow = |far| self.fan(INFRARED_HALF_ANGLE, INFRARED_RAYS, far);
        Some(match sense {
            Sense::Distance { .. } | Sense::NxtDistance { .. } => {
                self.fan(self.echo.cone.half_angle, SONAR_RAYS, SONAR_FAR)
            }
            Sense::Proximity => narrow(INFRARED_FAR),
            Sense::Millimeters => narrow(TIME_OF_FLIGHT_FAR),
            Sense::Reflector { .. } => narrow(REFLECTOR_FAR),
            _ if self.looks_ahead && sense.is_of_spot() => self.fan(AHEAD_SHOWN, 3, AHEAD_FAR),
            Sense::Ambient | Sense::FineAmbient | Sense::Row { .. } | Sense::LineSteering => {
                Sight::Spot(self.scene.color_at(self.pose.vec2()))
            }
            _ if sense.is_of_spot() => Sight::Spot(self.scene.color_at(self.pose.vec2())),
            Sense::Touch | Sense::Volts => {
                let end = |x| point(self.pose.compose(&Pose::new(x, 0.0, 0.0)).vec2());
                let (from, to) = (end(-BUMPER_HALF), end(BUMPER_HALF));
                Sight::Bumper { from, to, is_on: self.pressed() }
            }
            Sense::Seek | Sense::Direction { .. } => {
                Sight::Beacon(self.nearest_beacon().map(|(at, channel)| (point(at), channel)))
            }
            _ => return None,
        })
    }

    fn fan(&self, half_angle: f64, rays: u32, far: f64) -> Sight {
        let here = self.pose.vec2();
        let mut nearest: Option<(f64, Point)> = None;
        let mut end = |way: Vec2| {
            let hit = self.scene.cast(self.others, here, way, far);
            let end = point(here + way * hit.unwrap_or(far));
            if let Some(distance) = hit.filter(|hit| nearest.is_none_or(|(near, _)| *hit < near)) {
                nearest = Some((distance, end));
            }
            end
        };
        let fan = super::fan(self.pose.heading, half_angle, rays).map(&mut end).collect();
        Sight::Cone { fan, hit: nearest.map(|(_, end)| end) }
    }

    fn nearest_beacon(&self) -> Option<(Vec2, u8)> {
        let here = self.pose.vec2();
        let away = |(at, _): &(Vec2, u8)| length(*at - here);
        let seen = self.scene.beacons().filter(|beacon| {
            away(beacon) <= BEACON_FAR && self.scene.clear_between(self.others, here, beacon.0)
        });
        seen.min_by(|a, b| away(a).total_cmp(&away(b)))
    }
}

fn point(at: Vec2) -> Point {
    [at.x, at.y]
}
