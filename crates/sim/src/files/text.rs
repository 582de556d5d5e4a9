//! The parsers that ev3dev's drivers put between a written text and a number. They differ:
//! `docs/ev3dev-sysfs.md`, 0.3. Here are A (strict), B (lenient), C (the same without a sign) and
//! W (words).
use ev3_os::linux::Errno;

/// What a driver sees of what was written: a text of C, which a NUL ends.
fn c_text(bytes: &[u8]) -> &[u8] {
    bytes.split(|byte| *byte == 0).next().unwrap_or(bytes)
}

/// Takes away the one newline that `echo` adds.
fn line(bytes: &[u8]) -> &[u8] {
    let text = c_text(bytes);
    text.strip_suffix(b"\n").unwrap_or(text)
}

/// The kernel's own parser of decimal numbers: all of the text, of at most 64 bits.
fn strict_digits(text: &[u8]) -> Result<u64, Errno> {
    let length = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if length == 0 {
        return Err(Errno::EINVAL);
    }
    let add = |value: u64, digit: &u8| {
        value.checked_mul(10).and_then(|value| value.checked_add(u64::from(digit - b'0')))
    };
    let value = text[..length].iter().try_fold(0, add).ok_or(Errno::ERANGE)?;
    if length == text.len() { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser A: an optional sign and digits, nothing else. Too large for 32 bits is ERANGE, anything
/// else that is not a number EINVAL.
pub(crate) fn strict_int(bytes: &[u8]) -> Result<i32, Errno> {
    let (sign, digits) = match line(bytes) {
        [b'-', rest @ ..] => (-1, rest),
        [b'+', rest @ ..] => (1, rest),
        text => (1, text),
    };
    let value = i64::try_from(strict_digits(digits)?).map_err(|_| Errno::ERANGE)?;
    i32::try_from(sign * value).map_err(|_| Errno::ERANGE)
}

/// Parser A with limits: outside them is EINVAL.
pub(crate) fn strict_int_in(bytes: &[u8], low: i32, high: i32) -> Result<i32, Errno> {
    let value = strict_int(bytes)?;
    if (low..=high).contains(&value) { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser A with a limit for the absolute value, which the kernel takes in 32 bits: so the lowest
/// of all numbers is inside.
pub(crate) fn strict_int_to(bytes: &[u8], limit: i32) -> Result<i32, Errno> {
    let value = strict_int(bytes)?;
    if value.wrapping_abs() <= limit { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser A without a minus sign.
pub(crate) fn strict_unsigned(bytes: &[u8]) -> Result<u32, Errno> {
    let text = line(bytes);
    let digits = strict_digits(text.strip_prefix(b"+").unwrap_or(text))?;
    u32::try_from(digits).map_err(|_| Errno::ERANGE)
}

/// The kernel's white space, which has the vertical tab of C, too.
fn is_space(byte: u8) -> bool {
    byte.is_ascii_whitespace() || byte == 0x0b
}

fn without_space(bytes: &[u8]) -> &[u8] {
    let text = c_text(bytes);
    let start = text.iter().position(|byte| !is_space(*byte)).unwrap_or(text.len());
    &text[start..]
}

/// The lowest 32 bits of the number at the beginning of a text.
fn wrapped_digits(text: &[u8]) -> Result<u32, Errno> {
    let digits = text.iter().take_while(|byte| byte.is_ascii_digit());
    let add = |value: Option<u32>, digit: &u8| {
        let value = value.unwrap_or(0).wrapping_mul(10);
        Some(value.wrapping_add(u32::from(digit - b'0')))
    };
    digits.fold(None, add).ok_or(Errno::EINVAL)
}

/// The same bits as a number with a sign.
pub(crate) fn signed(bits: u32) -> i32 {
    i32::from_ne_bytes(bits.to_ne_bytes())
}

/// Parser B: white space, perhaps a minus sign, digits, then any junk. It wraps at 32 bits.
pub(crate) fn lenient_int(bytes: &[u8]) -> Result<i32, Errno> {
    match without_space(bytes) {
        [b'-', rest @ ..] => Ok(signed(wrapped_digits(rest)?).wrapping_neg()),
        text => Ok(signed(wrapped_digits(text)?)),
    }
}

/// Parser B with limits: outside them is EINVAL.
pub(crate) fn lenient_int_in(bytes: &[u8], low: i32, high: i32) -> Result<i32, Errno> {
    let value = lenient_int(bytes)?;
    if (low..=high).contains(&value) { Ok(value) } else { Err(Errno::EINVAL) }
}

/// Parser C: the same without a sign.
pub(crate) fn lenient_unsigned(bytes: &[u8]) -> Result<u32, Errno> {
    wrapped_digits(without_space(bytes))
}

/// A name as `set_device` takes it: at most 50 bytes, without white space around it.
pub(crate) fn name(bytes: &[u8]) -> String {
    const LONGEST: usize = 50;
    let text = without_space(&c_text(bytes)[..c_text(bytes).len().min(LONGEST)]);
    let end = text.iter().rposition(|byte| !is_space(*byte)).map_or(0, |last| last + 1);
    String::from_utf8_lossy(&text[..end]).into_owned()
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
            ("5\0 and more", Ok(5)),
            ("5\n\0", Ok(5)),
            ("\0", Err(Errno::EINVAL)),
            ("+-5", Err(Errno::EINVAL)),
            ("5000000000x", Err(Errno::EINVAL)),
            ("99999999999999999999x", Err(Errno::ERANGE)),
            ("-99999999999999999999", Err(Errno::ERANGE)),
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
    fn a_range_of_absolute_values_has_the_lowest_number_of_all() {
        assert_eq!(strict_int_to(b"-2147483648", 100), Ok(i32::MIN));
        assert_eq!(strict_int_to(b"-2147483647", 100), Err(Errno::EINVAL));
        assert_eq!(strict_int_to(b"-100", 100), Ok(-100));
    }

    #[test]
    fn strict_unsigned_numbers_have_no_minus() {
        assert_eq!(strict_unsigned(b"+255\n"), Ok(255));
        assert_eq!(strict_unsigned(b"-0"), Err(Errno::EINVAL));
        assert_eq!(strict_unsigned(b"4294967296"), Err(Errno::ERANGE));
        assert_eq!(strict_unsigned(b"12 "), Err(Errno::EINVAL));
    }

    #[test]
    fn names_lose_the_space_around_them() {
        assert_eq!(name(b" \tlego-ev3-m-motor \n\n"), "lego-ev3-m-motor");
        assert_eq!(name(b"lego-ev3-m-motor\0rest"), "lego-ev3-m-motor");
        assert_eq!(name(b"\n"), "");
        assert_eq!(name(&[b'a'; 60]).len(), 50);
    }

    #[test]
    fn lenient_numbers_take_junk_but_no_minus() {
        assert_eq!(lenient_unsigned(b"  12 apples"), Ok(12));
        assert_eq!(lenient_unsigned(b"-1"), Err(Errno::EINVAL));
        assert_eq!(lenient_unsigned(b"+1"), Err(Errno::EINVAL));
        assert_eq!(lenient_unsigned(b"4294967297"), Ok(1), "wraps");
        assert_eq!(lenient_unsigned(b"1\x002"), Ok(1));
        assert_eq!(lenient_unsigned(b""), Err(Errno::EINVAL));
    }

    #[test]
    fn lenient_signed_numbers_take_a_sign_and_junk() {
        for (text, expected) in [
            ("  -12 apples", Ok(-12)),
            ("+7", Err(Errno::EINVAL)),
            ("\x0b50\n", Ok(50)),
            ("- 5", Err(Errno::EINVAL)),
            ("x", Err(Errno::EINVAL)),
            ("", Err(Errno::EINVAL)),
            ("4294967346", Ok(50)),
            ("-4294967297", Ok(-1)),
        ] {
            assert_eq!(lenient_int(text.as_bytes()), expected, "{text:?}");
        }
        assert_eq!(lenient_int_in(b"-101", -100, 100), Err(Errno::EINVAL));
    }

    #[test]
    fn words_are_exact() {
        let words = || ["coast", "brake"].into_iter();
        assert_eq!(word(b"brake\n", words()), Ok(1));
        assert_eq!(word(b"brake\n\0s", words()), Ok(1), "a NUL ends it");
        for bad in ["Brake", "brake\n\n", " brake", "", "brak"] {
            assert_eq!(word(bad.as_bytes(), words()), Err(Errno::EINVAL), "{bad:?}");
        }
    }
}
