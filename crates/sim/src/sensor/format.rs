//! The values in `bin_data`, and the `value<N>` that the class makes of them:
//! `docs/ev3dev-sysfs.md`, 5.1.

/// A measurement of a sensor in whole numbers: as the files show them, or the raw data.
pub(crate) type Reading = [i32; 8];

/// How one value lies in `bin_data`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    U8,
    S8,
    U16,
    S16,
    S16Be,
    S32,
    S32Be,
}

impl Format {
    /// As `bin_data_format` has it.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Format::U8 => "u8",
            Format::S8 => "s8",
            Format::U16 => "u16",
            Format::S16 => "s16",
            Format::S16Be => "s16_be",
            Format::S32 => "s32",
            Format::S32Be => "s32be",
        }
    }

    pub(crate) fn bytes(self) -> usize {
        match self {
            Format::U8 | Format::S8 => 1,
            Format::U16 | Format::S16 | Format::S16Be => 2,
            Format::S32 | Format::S32Be => 4,
        }
    }

    /// Limits a value to the range of its format.
    pub(crate) fn fit(self, value: i32) -> i32 {
        match self {
            Format::U8 => value.clamp(0, 255),
            Format::S8 => value.clamp(-128, 127),
            Format::U16 => value.clamp(0, 65535),
            Format::S16 | Format::S16Be => value.clamp(-32768, 32767),
            Format::S32 | Format::S32Be => value,
        }
    }

    /// Writes a value that fits, where it belongs.
    pub(crate) fn put(self, value: i32, index: usize, data: &mut [u8]) {
        let width = self.bytes();
        let place = &mut data[index * width..(index + 1) * width];
        match self {
            Format::S16Be | Format::S32Be => {
                place.copy_from_slice(&value.to_be_bytes()[4 - width..]);
            }
            _ => place.copy_from_slice(&value.to_le_bytes()[..width]),
        }
    }
}

/// The number that `value<N>` shows for the raw data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scale {
    /// The raw data.
    None,
    /// Raw data from one number to another stand for values from one to another, in whole numbers
    /// and without a limit.
    Linear { raw: [i32; 2], shown: [i32; 2] },
    /// The first byte counts double, the second single: an angle in `HiTechnic`'s registers.
    Halves,
    /// 1 for more millivolts than this: a switch that gives a voltage.
    Above(i32),
    /// 1 for less millivolts than this: a switch that draws a voltage down.
    Below(i32),
    /// 1 between two voltages, in millivolts: one of several switches.
    Within(i32, i32),
    /// The root of twice the millivolts.
    Root,
    /// A tilt: degrees from 0 to 180, whose sine goes from 0 to 128 and back.
    Tilt,
}

/// An input's supply, to which pin 1 is pulled up, in millivolts.
pub(crate) const SUPPLY_MV: i32 = 5000;
/// What a switch leaves of it.
pub(crate) const SWITCHED_MV: i32 = 900;

impl Scale {
    /// From raw data to what is shown.
    pub(crate) fn shown(self, raw: i32) -> i32 {
        match self {
            Scale::None => raw,
            Scale::Linear { raw: [low, high], shown: [first, last] } => {
                let shown = i64::from(raw - low) * i64::from(last - first) / i64::from(high - low);
                narrow(shown + i64::from(first))
            }
            Scale::Halves => (raw & 0xff) * 2 + (raw >> 8),
            Scale::Above(limit) => i32::from(raw > limit),
            Scale::Below(limit) => i32::from(raw < limit),
            Scale::Within(low, high) => i32::from((low..high).contains(&raw)),
            // A byte.
            Scale::Root => (raw.max(0) * 2).isqrt() & 0xff,
            Scale::Tilt if raw > 128 => 180 - Scale::Tilt.shown(256 - raw),
            Scale::Tilt => whole(libm::asin(f64::from(raw) / 128.0).to_degrees()),
        }
    }

    /// The raw data that come nearest to being shown so.
    pub(crate) fn raw(self, shown: i32) -> i32 {
        match self {
            Scale::None => shown,
            Scale::Linear { raw: [low, high], shown: [first, last] } => {
                let (up, span) = (i64::from(shown - first) * i64::from(high - low), last - first);
                // What is shown is cut and not rounded: rather a little more than less.
                let away = i64::from(span.abs() - 1) * up.signum() * i64::from(span.signum());
                narrow((up + away) / i64::from(span) + i64::from(low))
            }
            Scale::Halves => (shown / 2) | ((shown % 2) << 8),
            Scale::Above(_) => shown * SUPPLY_MV,
            Scale::Below(_) if shown != 0 => SWITCHED_MV,
            Scale::Within(low, high) if shown != 0 => (low + high) / 2,
            Scale::Below(_) | Scale::Within(..) => SUPPLY_MV,
            Scale::Root => (shown * shown + 1) / 2,
            Scale::Tilt if shown > 90 => 256 - Scale::Tilt.raw(180 - shown),
            Scale::Tilt => whole(libm::sin(f64::from(shown).to_radians()) * 128.0),
        }
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a byte or an angle")]
fn whole(value: f64) -> i32 {
    libm::round(value) as i32
}

#[expect(clippy::cast_possible_truncation, reason = "clamped")]
fn narrow(value: i64) -> i32 {
    value.clamp(i32::MIN.into(), i32::MAX.into()) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_scaled_is_shown_again() {
        let scales: [(Scale, std::ops::RangeInclusive<i32>); 11] = [
            (Scale::None, -5..=5),
            (Scale::Linear { raw: [4116, 543], shown: [0, 1000] }, 0..=1000),
            (Scale::Linear { raw: [0, 5000], shown: [0, 1000] }, 0..=1000),
            (Scale::Linear { raw: [-14080, 32767], shown: [-550, 1280] }, -550..=1280),
            (Scale::Linear { raw: [0, 4880], shown: [-540, 400] }, -540..=400),
            (Scale::Halves, 0..=359),
            (Scale::Above(250), 0..=1),
            (Scale::Below(4800), 0..=1),
            (Scale::Within(3859, 4194), 0..=1),
            (Scale::Root, 0..=100),
            (Scale::Tilt, 0..=68),
        ];
        for (scale, shown) in scales {
            for value in shown {
                assert_eq!(scale.shown(scale.raw(value)), value, "{scale:?}");
            }
        }
    }

    #[test]
    fn raw_data_stand_for_values_beyond_the_range() {
        let light = Scale::Linear { raw: [4116, 543], shown: [0, 1000] };
        assert_eq!(light.shown(4116), 0);
        assert_eq!(light.shown(543), 1000);
        assert!(light.shown(4500) < 0);
    }

    #[test]
    fn bytes_lie_as_the_format_says() {
        let put = |format: Format, value| {
            let mut data = [0; 8];
            format.put(value, 1, &mut data);
            data
        };
        assert_eq!(put(Format::S8, -2), [0, 0xfe, 0, 0, 0, 0, 0, 0]);
        assert_eq!(put(Format::U16, 0x1234), [0, 0, 0x34, 0x12, 0, 0, 0, 0]);
        assert_eq!(put(Format::S16Be, -2), [0, 0, 0xff, 0xfe, 0, 0, 0, 0]);
        assert_eq!(put(Format::S32Be, 0x0102), [0, 0, 0, 0, 0, 0, 1, 2]);
    }
}
