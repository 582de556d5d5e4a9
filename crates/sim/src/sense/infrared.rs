//! Readings of beacons and remote controls by infrared sensors.
use super::{View, whole};
use crate::brick::remote::{CHANNELS, Remote};
use crate::sensor::Reading;
use ev3_motion::length;

/// A beacon is seen from this far, in cm: there an EV3 sensor says 100 %.
pub(super) const BEACON_FAR: f64 = 200.0;
/// This far to the side, in degrees, an EV3 sensor says 25.
const SEEK_HALF_ANGLE: f64 = 60.0;
const SEEK_HEADING: f64 = 25.0;
/// No beacon.
const SEEK_NOTHING: i32 = -128;
/// `HiTechnic`'s sensor reports directions in steps of this many degrees; 5 is ahead.
const DIRECTION_STEP: f64 = 30.0;
const DIRECTION_AHEAD: f64 = 5.0;
const DIRECTIONS: std::ops::RangeInclusive<f64> = 1.0..=9.0;
/// The directions of its five eyes; each sees half the room.
const EYES: [f64; 5] = [-120.0, -60.0, 0.0, 60.0, 120.0];

/// A beacon as it is seen: degrees to the right, and cm.
#[derive(Clone, Copy)]
struct Seen {
    bearing: f64,
    distance: f64,
}

impl View<'_> {
    /// The nearest beacon in sight, on one channel or on any.
    fn beacon(&self, channel: Option<u8>) -> Option<Seen> {
        let here = self.pose.vec2();
        let mut nearest: Option<Seen> = None;
        for (at, on) in self.scene.beacons() {
            let way = at - here;
            let distance = length(way);
            let is_meant = channel.is_none_or(|channel| channel == on);
            let limit = nearest.map_or(BEACON_FAR, |seen| seen.distance);
            if is_meant && distance <= limit && self.scene.clear_between(self.others, here, at) {
                let heading = libm::atan2(way.x, way.y).to_degrees();
                let bearing = turn_of(heading - self.pose.heading);
                nearest = Some(Seen { bearing, distance });
            }
        }
        nearest
    }

    /// Heading and distance on each of the four channels, as the EV3's sensor says.
    pub(super) fn seek(&mut self) -> Reading {
        let mut reading = [0; 8];
        for (channel, values) in (1..).zip(reading.chunks_exact_mut(2)) {
            let seen = self.beacon(Some(channel)).filter(|s| s.bearing.abs() <= SEEK_HALF_ANGLE);
            values[1] = SEEK_NOTHING;
            if let Some(Seen { bearing, distance }) = seen {
                values[0] = whole(bearing / SEEK_HALF_ANGLE * SEEK_HEADING);
                let percent = self.noise.disturb(distance / BEACON_FAR * 100.0);
                values[1] = whole(percent.clamp(0.0, 100.0));
            }
        }
        reading
    }

    /// The pressed buttons on the four channels. A beacon in sight counts as one whose button is
    /// on.
    pub(super) fn remotes(&self) -> Reading {
        let mut reading = [0; 8];
        for (index, value) in reading.iter_mut().take(CHANNELS).enumerate() {
            let channel = u8::try_from(index + 1).unwrap_or_default();
            let pressed = self.scene.remotes[index];
            let is_beacon = pressed == Remote::NONE && self.beacon(Some(channel)).is_some();
            *value = if is_beacon { Remote::BEACON.code() } else { pressed.code() };
        }
        reading
    }

    /// The nearest beacon in `HiTechnic`'s steps, and how strongly each eye sees it.
    pub(super) fn directions(&mut self, strengths: bool, mean: bool) -> Reading {
        let mut reading = [0; 8];
        let Some(Seen { bearing, distance }) = self.beacon(None) else {
            return reading;
        };
        let direction = libm::round(bearing / DIRECTION_STEP + DIRECTION_AHEAD);
        if !DIRECTIONS.contains(&direction) {
            return reading;
        }
        reading[0] = whole(direction);
        if strengths {
            let mut sum = 0;
            for (value, eye) in reading[1..].iter_mut().zip(EYES) {
                let facing = libm::cos(turn_of(bearing - eye).to_radians()).max(0.0);
                let strength = self.noise.disturb(255.0 * facing * (1.0 - distance / BEACON_FAR));
                *value = whole(strength.clamp(0.0, 255.0));
                sum += *value;
            }
            if mean {
                reading[1 + EYES.len()] = sum / 5;
            }
        }
        reading
    }
}

/// An angle between -180 and 180 degrees.
fn turn_of(degrees: f64) -> f64 {
    let turned = libm::fmod(degrees + 180.0, 360.0);
    if turned < 0.0 { turned + 180.0 } else { turned - 180.0 }
}
