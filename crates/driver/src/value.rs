//! From an attribute's text to a value.

/// Attributes that hold an integer and nothing else.
const INTEGERS: [&str; 33] = [
    "count_per_m",
    "count_per_rot",
    "decimals",
    "duty_cycle",
    "duty_cycle_sp",
    "full_travel_count",
    "hold_pid/Kd",
    "hold_pid/Ki",
    "hold_pid/Kp",
    "max_pulse_sp",
    "max_speed",
    "mid_pulse_sp",
    "min_pulse_sp",
    "num_values",
    "position",
    "position_sp",
    "ramp_down_sp",
    "ramp_up_sp",
    "rate_sp",
    "speed",
    "speed_pid/Kd",
    "speed_pid/Ki",
    "speed_pid/Kp",
    "speed_sp",
    "time_sp",
    "value0",
    "value1",
    "value2",
    "value3",
    "value4",
    "value5",
    "value6",
    "value7",
];

/// Whether an attribute of that name holds an integer and nothing else.
pub(crate) fn holds_integer(name: &str) -> bool {
    INTEGERS.contains(&name)
}

/// The content of an attribute file.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A decimal integer of at most 64 bits.
    Integer(i64),
    /// A decimal fraction.
    Float(f64),
    /// Anything else.
    Text(String),
}

impl Value {
    /// A number if the text is one, else the text itself.
    ///
    /// ```
    /// use ev3_driver::Value;
    /// assert_eq!(Value::parse("-12".to_owned()), Value::Integer(-12));
    /// assert_eq!(Value::parse("7.5".to_owned()), Value::Float(7.5));
    /// assert_eq!(Value::parse("inf".to_owned()), Value::Text("inf".to_owned()));
    /// ```
    pub fn parse(text: String) -> Self {
        match integer(text.as_bytes()) {
            Some(integer) => Self::Integer(integer),
            None => fraction(&text).map_or(Self::Text(text), Self::Float),
        }
    }

    /// The integer `value` divided by 10^`decimals`: an integer where there
    /// are no decimals, else a float.
    #[expect(clippy::cast_precision_loss, reason = "sensor values have 32 bits, decimals are few")]
    pub fn scaled(value: i64, decimals: i64) -> Self {
        match i32::try_from(decimals) {
            Ok(decimals @ 1..=38) => Self::Float(value as f64 / 10f64.powi(decimals)),
            // No sensor has such a number.
            _ => Self::Integer(value),
        }
    }
}

/// A decimal integer with an optional sign, and nothing else. `None` for any other
/// text, and for more than 64 bits.
pub fn integer(text: &[u8]) -> Option<i64> {
    let (negative, digits) = match text {
        [b'-', digits @ ..] => (true, digits),
        [b'+', digits @ ..] | digits => (false, digits),
    };
    if digits.is_empty() {
        return None;
    }
    let magnitude = digits.iter().try_fold(0i64, |sum, digit| {
        let digit = digit.is_ascii_digit().then(|| i64::from(digit - b'0'))?;
        // Collected below zero, where there is room for i64::MIN.
        sum.checked_mul(10)?.checked_sub(digit)
    })?;
    if negative { Some(magnitude) } else { magnitude.checked_neg() }
}

/// A decimal fraction: 15 digits at most, around a point. Neither `inf` nor `1e5`. Both numbers
/// that are divided are exact in 53 bits, so the quotient is the float next to the fraction; what
/// the standard library has for all fractions takes 15 kB on the brick.
#[expect(clippy::cast_precision_loss, reason = "15 digits have less than 53 bits")]
fn fraction(text: &str) -> Option<f64> {
    let (whole, part) = text.split_once('.')?;
    let unsigned = whole.strip_prefix(['-', '+']).unwrap_or(whole);
    if unsigned.is_empty() || part.is_empty() || unsigned.len() + part.len() > 15 {
        return None;
    }
    let digits = [unsigned, part].concat();
    if !digits.bytes().all(|byte| byte.is_ascii_digit()) {
        return None;
    }
    let magnitude =
        integer(digits.as_bytes())? as f64 / 10f64.powi(i32::try_from(part.len()).ok()?);
    Some(if whole.starts_with('-') { -magnitude } else { magnitude })
}

/// The first line of what was read, without its newline.
///
/// The kernel ends each text with one newline. A plain file that held a longer
/// text may show the rest of it on further lines for a moment.
pub fn first_line(bytes: &[u8]) -> &[u8] {
    let end = bytes.iter().position(|byte| *byte == b'\n');
    end.and_then(|end| bytes.get(..end)).unwrap_or(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_that_no_sensor_has_do_not_count() {
        assert_eq!(Value::scaled(25, 1), Value::Float(2.5));
        for decimals in [0, -1, 39, 1 << 31, i64::MAX] {
            assert_eq!(Value::scaled(25, decimals), Value::Integer(25));
        }
    }

    #[test]
    fn integers_are_decimal_and_whole() {
        for (text, expected) in [
            ("0", Some(0)),
            ("-7", Some(-7)),
            ("+7", Some(7)),
            ("9223372036854775807", Some(i64::MAX)),
            ("-9223372036854775808", Some(i64::MIN)),
            ("9223372036854775808", None),
            ("", None),
            ("-", None),
            ("1 ", None),
            ("0x10", None),
            ("1.0", None),
        ] {
            assert_eq!(integer(text.as_bytes()), expected, "{text:?}");
        }
    }

    #[test]
    fn words_that_rust_takes_for_floats_stay_words() {
        for text in ["nan", "inf", "-infinity", "1e5", ".", "e", "99999999999999999999"] {
            assert_eq!(Value::parse(text.to_owned()), Value::Text(text.to_owned()));
        }
    }

    #[test]
    fn fractions_are_the_floats_next_to_them() {
        for text in
            ["0.1", "-0.3", "+12.75", "3.14159265358979", "0.00000000000001", "99999999999999.9"]
        {
            let nearest = text.parse().unwrap();
            assert_eq!(Value::parse(text.to_owned()), Value::Float(nearest), "{text:?}");
        }
        assert!(fraction("-0.0").unwrap().is_sign_negative());
        for text in ["1.", ".5", "-.5", "1.-5", "--1.5", "1.5.2", "1.5 ", "0.1234567890123456"] {
            assert_eq!(Value::parse(text.to_owned()), Value::Text(text.to_owned()));
        }
    }

    #[test]
    fn scaling_gives_floats_only_with_decimals() {
        assert_eq!(Value::scaled(2550, 1), Value::Float(255.0));
        assert_eq!(Value::scaled(123, 1), Value::Float(12.3));
        assert_eq!(Value::scaled(-3, 0), Value::Integer(-3));
    }

    #[test]
    fn only_the_first_line_counts() {
        assert_eq!(first_line(b"stop\never\n"), b"stop");
        assert_eq!(first_line(b"\n"), b"");
        assert_eq!(first_line(b""), b"");
    }
}
