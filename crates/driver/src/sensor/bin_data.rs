//! Several values of a sensor in one read.
//!
//! `bin_data` holds what the sensor sent, 32 bytes in the format that `bin_data_format` names. The
//! files `value<N>` show the same numbers, or numbers that the kernel scales, to a range that no
//! file shows. So this reads only the modes that the drivers' tables do not scale, and only if they
//! have more than one value.
use crate::device::Device;
use crate::error::Result;
use ev3_os::Errno;

/// The bytes in `bin_data`, in every mode.
const LENGTH: usize = 32;

/// Modes with several values that are shown as they are: `ev3_uart_sensor_defs.c`
/// and `nxt_i2c_sensor_defs.c`.
const UNSCALED: [(&str, &[&str]); 18] = [
    ("lego-ev3-color", &["REF-RAW", "RGB-RAW"]),
    ("lego-ev3-gyro", &["GYRO-G&A"]),
    ("lego-ev3-ir", &["IR-SEEK", "IR-REMOTE"]),
    ("lego-power-storage", &["ALL"]),
    ("ht-nxt-accel", &["ALL"]),
    ("ht-nxt-color", &["RAW", "NORM", "ALL"]),
    ("ht-nxt-color-v2", &["RGB", "NORM", "PASSIVE", "RAW"]),
    ("ht-nxt-ir-receiver", &["8-MOTOR"]),
    ("ht-nxt-ir-seek-v2", &["DC-ALL", "AC-ALL"]),
    ("ht-nxt-smux", &["MUX"]),
    ("ht-super-pro", &["AIN", "AOUT-0", "AOUT-1"]),
    ("ms-absolute-imu", &["ACCEL", "MAG"]),
    ("ms-angle", &["ALL"]),
    ("ms-light-array", &["CAL", "RAW"]),
    ("ms-line-leader", &["PID-ALL", "CAL", "RAW"]),
    ("ms-nxtcam", &["TRACK"]),
    ("ms-nxtcam5", &["TRACK"]),
    ("ms-pixy-adapter", &["TRACK"]),
];

/// How a value lies in `bin_data`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Format {
    U8,
    S8,
    U16,
    S16,
    S16Be,
    S32,
    S32Be,
    Float,
}

impl Format {
    const ALL: [(&'static str, Self); 8] = [
        ("u8", Self::U8),
        ("s8", Self::S8),
        ("u16", Self::U16),
        ("s16", Self::S16),
        ("s16_be", Self::S16Be),
        ("s32", Self::S32),
        ("s32be", Self::S32Be),
        ("float", Self::Float),
    ];

    fn width(self) -> usize {
        match self {
            Self::U8 | Self::S8 => 1,
            Self::U16 | Self::S16 | Self::S16Be => 2,
            Self::S32 | Self::S32Be | Self::Float => 4,
        }
    }

    /// Value `index`, as its file `value<N>` has it. `None` where it does not fit into the data.
    fn value(self, data: &[u8], index: usize, decimals: i64) -> Option<i64> {
        let (start, width) = (index.checked_mul(self.width())?, self.width());
        let bytes = data.get(start..start.checked_add(width)?)?;
        Some(match (self, bytes) {
            (Self::U8, [a]) => i64::from(*a),
            (Self::S8, [a]) => i64::from(i8::from_le_bytes([*a])),
            (Self::U16, [a, b]) => i64::from(u16::from_le_bytes([*a, *b])),
            (Self::S16, [a, b]) => i64::from(i16::from_le_bytes([*a, *b])),
            (Self::S16Be, [a, b]) => i64::from(i16::from_be_bytes([*a, *b])),
            (Self::S32, [a, b, c, d]) => i64::from(i32::from_le_bytes([*a, *b, *c, *d])),
            (Self::S32Be, [a, b, c, d]) => i64::from(i32::from_be_bytes([*a, *b, *c, *d])),
            (Self::Float, [a, b, c, d]) => {
                fixed_point(f32::from_le_bytes([*a, *b, *c, *d]), decimals)?
            }
            _ => return None,
        })
    }
}

/// The integer that the kernel makes of a float with `decimals` decimals: rounded
/// up from two thirds of the last digit on, else down. `None` beyond 32 bits.
fn fixed_point(float: f32, decimals: i64) -> Option<i64> {
    let scaled = f64::from(float.abs()) * 10f64.powi(i32::try_from(decimals).ok()?);
    let (whole, rest) = (scaled.trunc(), scaled.fract());
    let magnitude = if rest * 1.5 >= 1.0 { whole + 1.0 } else { whole };
    if magnitude.is_nan() || magnitude > f64::from(i32::MAX) {
        return None;
    }
    #[expect(clippy::cast_possible_truncation, reason = "in the range of 32 bits")]
    let magnitude = magnitude as i64;
    Some(if float < 0.0 { -magnitude } else { magnitude })
}

/// The first `count` values of a sensor that is in that mode, as the files
/// `value<N>` show them. `None` where those files must be read.
pub(crate) fn values<const N: usize>(
    sensor: &Device,
    mode: &str,
    decimals: i64,
    count: usize,
) -> Result<Option<[i64; N]>> {
    let has = |known: i64| usize::try_from(known).is_ok_and(|known| count <= known);
    let are_there = sensor.known_in("num_values", mode).is_some_and(has);
    if count < 2 || count > N || !are_there || !is_unscaled(sensor, mode) {
        return Ok(None);
    }
    let Some(format) = sensor.known_in("bin_data_format", mode).and_then(format_of) else {
        return Ok(None);
    };
    let mut data = [0; 2 * LENGTH];
    let length = sensor.bytes("bin_data", &mut data)?;
    if length != LENGTH {
        return Ok(None);
    }
    let mut values = [0; N];
    for (index, value) in values.iter_mut().take(count).enumerate() {
        match format.value(&data[..LENGTH], index, decimals) {
            Some(read) => *value = read,
            None => return Ok(None),
        }
    }
    Ok(Some(values))
}

/// Remembers the number of values and their format in a mode whose values have
/// just been read one by one. In a tree of plain files nothing keeps `bin_data` in
/// step with the values, so it is not used there.
pub(crate) fn learn(sensor: &Device, mode: &str) -> Result<()> {
    if !is_unscaled(sensor, mode) || sensor.is_plain("mode")? {
        return Ok(());
    }
    if sensor.known_in("bin_data_format", mode).is_some() {
        return Ok(());
    }
    let read = |text: &str| Format::ALL.iter().position(|(name, _)| *name == text);
    let code = match sensor.with_word("bin_data_format", read) {
        Ok(code) => code.and_then(|code| i64::try_from(code).ok()).unwrap_or(-1),
        Err(error) if error.errno() == Some(Errno::NOENT) => -1,
        Err(error) => return Err(error),
    };
    sensor.know_in("bin_data_format", mode, code);
    let count = sensor.number("num_values")?;
    if count > 0 {
        sensor.know_in("num_values", mode, count);
    }
    Ok(())
}

fn format_of(code: i64) -> Option<Format> {
    Format::ALL.get(usize::try_from(code).ok()?).map(|(_, format)| *format)
}

fn is_unscaled(sensor: &Device, mode: &str) -> bool {
    let of_driver = UNSCALED.iter().find(|(driver, _)| *driver == sensor.driver());
    of_driver.is_some_and(|(_, modes)| modes.contains(&mode))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_format_is_read_at_its_place() {
        let data: Vec<u8> = (0xf0..=0xff).chain(0x00..0x10).collect();
        let value = |format: Format, index| format.value(&data, index, 0);
        assert_eq!(value(Format::U8, 2), Some(0xf2));
        assert_eq!(value(Format::S8, 2), Some(-14));
        assert_eq!(value(Format::U16, 1), Some(0xf3f2));
        assert_eq!(value(Format::S16, 1), Some(0xf3f2 - 0x1_0000));
        assert_eq!(value(Format::S16Be, 1), Some(0xf2f3 - 0x1_0000));
        assert_eq!(value(Format::S32, 4), Some(0x0302_0100));
        assert_eq!(value(Format::S32Be, 4), Some(0x0001_0203));
        assert_eq!(value(Format::S32, 7), Some(0x0f0e_0d0c));
        assert_eq!(value(Format::S32, 8), None);
        assert_eq!(value(Format::U8, usize::MAX), None);
    }

    #[test]
    fn floats_become_integers_with_their_decimals() {
        for (float, decimals, expected) in [
            (0.0, 2, Some(0)),
            (12.5, 1, Some(125)),
            (-12.5, 1, Some(-125)),
            (1.55, 1, Some(15)),
            (1.57, 1, Some(16)),
            (2e9, 0, Some(2_000_000_000)),
            (2e9, 1, None),
            (f32::NAN, 0, None),
            (f32::INFINITY, 0, None),
        ] {
            assert_eq!(fixed_point(float, decimals), expected, "{float}");
        }
    }
}
