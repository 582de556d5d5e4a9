//! The parsers that ev3dev's drivers put between a written text and a number. They differ:
//! `docs/ev3dev-sysfs.md`, 0.3. Here are A (strict), B (lenient), C (the same without a sign) and
//! W (words).

use crate::files::errno::Errno;

/// Takes away the one newline that `echo` adds.
fn line(bytes: &[u8]) -> &[u8] {
    bytes.strip_suffix(b"\n").unwrap_or(bytes)
}

/// Parser A: an optional sign and digits, nothing else. Too large for 32 bits is ERANGE, anything
/// else that is not a number EINVAL.
pub(crate) fn strict_int(bytes: &[u8]) -> Result<i32, Errno> {
    let text = line(bytes);
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        _ => (false, text),
    };
    if digits.is_empty() || !digits.iter().all(u8::is_ascii_digit) {
        return Err(Errno::EINVAL);
    }
    let mut value: i64 = 0;
    for digit in digits {
        value = value * 10 + i64::from(digit - b'0');
        if value > i64::from(u32::MAX) {
            return Err(Errno::ERANGE);
        }
    }
    i32::try_from(if negative { -value } else { value }).map_err(|_| Errno::ERANGE)
}

/// Parser A with limits: outside them is EINVAL.
pub(crate) fn strict_int_in(bytes: &[u8], low: i32, high: i32) -> Result<i32, Errno> {
    let value = strict_int(bytes)?;
    if (low..=high).contains(&value) { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser B: white space, an optional sign, digits, then any junk.
pub(crate) fn lenient_int(bytes: &[u8]) -> Result<i32, Errno> {
    let start = bytes.iter().position(|b| !b.is_ascii_whitespace()).ok_or(Errno::EINVAL)?;
    let negative = bytes[start] == b'-';
    let signed = negative || bytes[start] == b'+';
    let digits = &bytes[start + usize::from(signed)..];
    if !digits.first().is_some_and(u8::is_ascii_digit) {
        return Err(Errno::EINVAL);
    }
    let value = lenient_unsigned(digits)?;
    let value = i32::try_from(value).map_err(|_| Errno::EINVAL)?;
    Ok(if negative { -value } else { value })
}

/// Parser B with limits: outside them is EINVAL.
pub(crate) fn lenient_int_in(bytes: &[u8], low: i32, high: i32) -> Result<i32, Errno> {
    let value = lenient_int(bytes)?;
    if (low..=high).contains(&value) { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser C: white space, digits, then any junk. No minus sign.
pub(crate) fn lenient_unsigned(bytes: &[u8]) -> Result<u32, Errno> {
    let start = bytes.iter().position(|b| !b.is_ascii_whitespace()).ok_or(Errno::EINVAL)?;
    let digits = bytes[start..].iter().take_while(|b| b.is_ascii_digit());
    let mut value = None;
    for digit in digits {
        let so_far = value.unwrap_or(0u32);
        value = Some(so_far.saturating_mul(10).saturating_add(u32::from(digit - b'0')));
    }
    value.ok_or(Errno::EINVAL)
}

/// Parser W: which of the words it is. Exact, with at most one newline behind it.
pub(crate) fn word<'a>(
    bytes: &[u8],
    mut words: impl Iterator<Item = &'a str>,
) -> Result<usize, Errno> {
    let text = line(bytes);
    words.position(|word| word.as_bytes() == text).ok_or(Errno::EINVAL)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strict_numbers_are_strict() {
        let cases: &[(&str, Result<i32, Errno>)] = &[
            ("0", Ok(0)),
            ("-12\n", Ok(-12)),
            ("+7", Ok(7)),
            ("007", Ok(7)),
            ("2147483647", Ok(i32::MAX)),
            ("-2147483648", Ok(i32::MIN)),
            ("2147483648", Err(Errno::ERANGE)),
            ("99999999999999999999", Err(Errno::ERANGE)),
            ("", Err(Errno::EINVAL)),
            ("\n", Err(Errno::EINVAL)),
            (" 5", Err(Errno::EINVAL)),
            ("5 ", Err(Errno::EINVAL)),
            ("5\n\n", Err(Errno::EINVAL)),
            ("1.0", Err(Errno::EINVAL)),
            ("0x10", Err(Errno::EINVAL)),
            ("-", Err(Errno::EINVAL)),
        ];
        for (text, expected) in cases {
            assert_eq!(strict_int(text.as_bytes()), *expected, "{text:?}");
        }
        assert_eq!(strict_int_in(b"101", -100, 100), Err(Errno::EINVAL));
    }

    #[test]
    fn lenient_numbers_take_junk_but_no_minus() {
        assert_eq!(lenient_unsigned(b"  12 apples"), Ok(12));
        assert_eq!(lenient_unsigned(b"-1"), Err(Errno::EINVAL));
        assert_eq!(lenient_unsigned(b""), Err(Errno::EINVAL));
    }

    #[test]
    fn lenient_signed_numbers_take_a_sign_and_junk() {
        for (text, expected) in [
            ("  -12 apples", Ok(-12)),
            ("+7", Ok(7)),
            ("50\n", Ok(50)),
            ("- 5", Err(Errno::EINVAL)),
            ("x", Err(Errno::EINVAL)),
            ("", Err(Errno::EINVAL)),
            ("3000000000", Err(Errno::EINVAL)),
        ] {
            assert_eq!(lenient_int(text.as_bytes()), expected, "{text:?}");
        }
        assert_eq!(lenient_int_in(b"-101", -100, 100), Err(Errno::EINVAL));
    }

    #[test]
    fn words_are_exact() {
        let words = || ["coast", "brake"].into_iter();
        assert_eq!(word(b"brake\n", words()), Ok(1));
        for bad in ["Brake", "brake\n\n", " brake", "", "brak"] {
            assert_eq!(word(bad.as_bytes(), words()), Err(Errno::EINVAL), "{bad:?}");
        }
    }
}
