//! Readings of the floor by sensors that are not LEGO's.
use super::{View, whole};
use crate::sensor::{Parts, Reading};
use ev3_motion::Pose;

/// Below these a color is black, or without color, or pale; each from 0 to 1.
const DARK: f64 = 0.2;
const GRAY: f64 = 0.15;
const PALE: f64 = 0.5;
/// `HiTechnic`'s numbers: the first hue, in degrees, that is not any more that color.
const HUES: [(f64, i32); 11] = [
    (15.0, 8),
    (45.0, 7),
    (75.0, 6),
    (105.0, 5),
    (180.0, 4),
    (255.0, 3),
    (270.0, 2),
    (300.0, 1),
    (330.0, 10),
    (345.0, 9),
    (360.0, 8),
];
const WHITE_NUMBER: i32 = 17;
/// The first of six pale colors.
const PALE_NUMBER: f64 = 11.0;
/// A light sensor of the row from the next, in cm.
const ROW_STEP: f64 = 0.9;
/// How the line leader sees a row: the line is below this percentage, and its average may be this
/// far from the middle.
const LINE_BELOW: f64 = 50.0;
const ROW_MIDDLE: f64 = 45.0;
const ROW_HALF: f64 = 35.0;

impl View<'_> {
    /// Red, green, blue of the floor, with the sensor's errors, 0 to 255.
    fn seen(&mut self) -> [f64; 3] {
        self.spot().map(|part| self.noise.disturb(part).clamp(0.0, 255.0))
    }

    /// `HiTechnic`'s number, and perhaps the parts.
    pub(super) fn color_number(&mut self, parts: bool) -> Reading {
        let seen = self.seen();
        let mut reading = [0; 8];
        reading[0] = number(seen.map(|part| part / 255.0));
        if parts {
            reading[1..4].copy_from_slice(&seen.map(whole));
        }
        reading
    }

    pub(super) fn part(&mut self, index: usize) -> i32 {
        whole(self.seen()[index])
    }

    /// Three parts, and white as their mean.
    pub(super) fn parts(&mut self, kind: Parts) -> Reading {
        let seen = self.seen();
        let strongest = seen.into_iter().fold(1.0, f64::max);
        let scale = match kind {
            Parts::Bytes => 1.0,
            Parts::Normal => 255.0 / strongest,
            Parts::Wide => 100.0,
        };
        let [red, green, blue] = seen.map(|part| whole(part * scale));
        [red, green, blue, (red + green + blue) / 3, 0, 0, 0, 0]
    }

    /// Per cent of white below each of the eight, from left to right.
    fn row_percent(&mut self) -> [f64; 8] {
        let mut place = -3.5 * ROW_STEP;
        std::array::from_fn(|_| {
            let below = self.pose.compose(&Pose::new(place, 0.0, 0.0)).vec2();
            place += ROW_STEP;
            let color = self.scene.color_at(below);
            let sum = [color.red, color.green, color.blue].map(f64::from).iter().sum::<f64>();
            self.noise.disturb(sum / 7.05).clamp(0.0, 100.0)
        })
    }

    pub(super) fn row(&mut self, times: i32) -> Reading {
        self.row_percent().map(|percent| whole(percent * f64::from(times)))
    }

    /// Steering from -100 to 100 (positive: the line is to the right), the average place of the
    /// line (the leftmost sensor is 10, the rightmost 80; 0 without line), and a bit for each
    /// sensor that sees it, the lowest for the leftmost, in a signed byte.
    pub(super) fn line_steering(&mut self) -> Reading {
        let (mut sum, mut count, mut bits) = (0.0, 0.0, 0);
        for (percent, index) in self.row_percent().into_iter().zip(0..) {
            if percent < LINE_BELOW {
                sum += f64::from(10 * (index + 1));
                count += 1.0;
                bits |= 1 << index;
            }
        }
        let average = if count > 0.0 { sum / count } else { 0.0 };
        let aside = if count > 0.0 { average - ROW_MIDDLE } else { 0.0 };
        let signed = if bits > 127 { bits - 256 } else { bits };
        [whole(aside / ROW_HALF * 100.0), whole(average), signed, 0, 0, 0, 0, 0]
    }
}

/// From black, 0, round the hues to white, 17.
fn number([red, green, blue]: [f64; 3]) -> i32 {
    let (high, low) = (red.max(green).max(blue), red.min(green).min(blue));
    let span = high - low;
    if high < DARK {
        return 0;
    }
    if span < GRAY * high {
        return if high < PALE { 0 } else { WHITE_NUMBER };
    }
    let sixth = if high <= red {
        (green - blue) / span
    } else if high <= green {
        (blue - red) / span + 2.0
    } else {
        (red - green) / span + 4.0
    };
    let hue = if sixth < 0.0 { (sixth + 6.0) * 60.0 } else { sixth * 60.0 };
    if span < PALE * high {
        return whole(libm::floor(hue / 60.0) + PALE_NUMBER);
    }
    HUES.iter().find(|(end, _)| hue < *end).map_or(8, |(_, number)| *number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colors_have_hitechnics_numbers() {
        let of = |red, green, blue| number([red, green, blue]);
        assert_eq!(of(0.05, 0.05, 0.05), 0);
        assert_eq!(of(0.9, 0.9, 0.9), 17);
        assert_eq!(of(0.8, 0.1, 0.1), 8);
        assert_eq!(of(0.9, 0.8, 0.1), 6);
        assert_eq!(of(0.1, 0.6, 0.2), 4);
        assert_eq!(of(0.1, 0.2, 0.8), 3);
        assert_eq!(of(0.9, 0.7, 0.7), 11);
        assert_eq!(of(0.7, 0.1, 0.65), 10);
    }
}
