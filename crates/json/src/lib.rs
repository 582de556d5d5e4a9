//! JSON, written as text in one pass and without a tree of values.
//!
//! The live view sends the state of a robot twenty times a second, so numbers are written in as
//! few digits as they need, and commas by themselves. In the place of this file, `serde_json` needs a
//! formatter for decimals and ASCII, raw values for what is kept as text, an attribute on each of the
//! fifty fields that may be absent, and 24 kB.
//!
//! ```
//! use ev3_json::Json;
//!
//! let mut json = Json::new();
//! json.object(|json| {
//!     json.key("pose").array(|json| {
//!         json.number(12.5, 2);
//!         json.number(-0.004, 2);
//!     });
//!     json.key("name").text("a \"wall\"");
//! });
//! assert_eq!(json.into_text(), r#"{"pose":[12.5,0],"name":"a \"wall\""}"#);
//! ```
#![forbid(unsafe_code)]

use std::fmt::Write;

/// The largest whole number that every reader of JSON takes as it is.
const LARGEST: f64 = 9_007_199_254_740_991.0;

/// A text of JSON that grows.
#[derive(Clone, Debug, Default)]
pub struct Json {
    text: String,
    /// A comma belongs before the next element.
    comma: bool,
}

impl Json {
    /// An empty text.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The text so far.
    #[must_use]
    pub fn as_text(&self) -> &str {
        &self.text
    }

    /// The text.
    #[must_use]
    pub fn into_text(self) -> String {
        self.text
    }

    /// An object, filled by a closure that writes keys and values.
    pub fn object(&mut self, fill: impl FnOnce(&mut Self)) {
        self.open('{');
        fill(self);
        self.close('}');
    }

    /// An array, filled by a closure that writes its elements.
    pub fn array(&mut self, fill: impl FnOnce(&mut Self)) {
        self.open('[');
        fill(self);
        self.close(']');
    }

    /// The name of the next value. It must need no escapes.
    pub fn key(&mut self, name: &str) -> &mut Self {
        self.next();
        self.text.push('"');
        self.text.push_str(name);
        self.text.push_str("\":");
        self.comma = false;
        self
    }

    /// A number with at most `places` decimals; what is not a number, or too large, is `null`.
    pub fn number(&mut self, value: f64, places: u32) {
        let scale = 10_i64.pow(places.min(6));
        #[expect(clippy::cast_precision_loss, reason = "a small power of ten")]
        let scaled = (value * scale as f64).round();
        if !(-LARGEST..=LARGEST).contains(&scaled) {
            self.null();
            return;
        }
        #[expect(clippy::cast_possible_truncation, reason = "within the range, and whole")]
        let scaled = scaled as i64;
        let (whole, mut part) = (scaled / scale, (scaled % scale).abs());
        self.next();
        if scaled < 0 && whole == 0 {
            self.text.push('-');
        }
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{whole}");
        if part != 0 {
            let mut digits = places.min(6) as usize;
            while part % 10 == 0 {
                part /= 10;
                digits -= 1;
            }
            let _ = write!(self.text, ".{part:0digits$}");
        }
    }

    /// A whole number.
    pub fn integer(&mut self, value: i64) {
        self.next();
        let _ = write!(self.text, "{value}");
    }

    /// `true` or `false`.
    pub fn bool(&mut self, value: bool) {
        self.raw(if value { "true" } else { "false" });
    }

    /// `null`.
    pub fn null(&mut self) {
        self.raw("null");
    }

    /// A text, with the escapes that it needs. All that is not ASCII is escaped, so that a text
    /// has as many bytes as letters, and `<`, so that no reader of HTML finds a tag in it.
    pub fn text(&mut self, text: &str) {
        self.next();
        self.text.push('"');
        for letter in text.chars() {
            match letter {
                '"' => self.text.push_str("\\\""),
                '\\' => self.text.push_str("\\\\"),
                '\n' => self.text.push_str("\\n"),
                '\t' => self.text.push_str("\\t"),
                ' '..='~' if letter != '<' => self.text.push(letter),
                _ => {
                    for unit in letter.encode_utf16(&mut [0; 2]) {
                        let _ = write!(self.text, "\\u{unit:04x}");
                    }
                }
            }
        }
        self.text.push('"');
    }

    /// Several numbers as an array.
    pub fn numbers(&mut self, values: impl IntoIterator<Item = f64>, places: u32) {
        self.array(|json| values.into_iter().for_each(|value| json.number(value, places)));
    }

    /// A value, or several keys and values, that is JSON already.
    pub fn raw(&mut self, text: &str) {
        if !text.is_empty() {
            self.next();
            self.text.push_str(text);
        }
    }

    /// Bytes as a text in base 64.
    pub fn base64(&mut self, bytes: &[u8]) {
        const DIGITS: &[u8; 64] =
            b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        self.next();
        self.text.push('"');
        for three in bytes.chunks(3) {
            let at = |index: usize| u32::from(three.get(index).copied().unwrap_or(0));
            let bits = at(0) << 16 | at(1) << 8 | at(2);
            for digit in 0..4 {
                let index = bits >> (18 - 6 * digit) & 63;
                let is_there = digit <= three.len();
                self.text.push(if is_there { char::from(DIGITS[index as usize]) } else { '=' });
            }
        }
        self.text.push('"');
    }

    fn open(&mut self, bracket: char) {
        self.next();
        self.text.push(bracket);
        self.comma = false;
    }

    fn close(&mut self, bracket: char) {
        self.text.push(bracket);
        self.comma = true;
    }

    fn next(&mut self) {
        if self.comma {
            self.text.push(',');
        }
        self.comma = true;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64, places: u32) -> String {
        let mut json = Json::new();
        json.number(value, places);
        json.into_text()
    }

    #[test]
    fn numbers_are_as_short_as_they_can_be() {
        assert_eq!(number(0.0, 2), "0");
        assert_eq!(number(-0.001, 2), "0");
        assert_eq!(number(-0.05, 2), "-0.05");
        assert_eq!(number(-0.5, 2), "-0.5");
        assert_eq!(number(1.005, 1), "1");
        assert_eq!(number(10.0, 1), "10");
        assert_eq!(number(99.999, 2), "100");
        assert_eq!(number(0.07, 3), "0.07");
        assert_eq!(number(123.456, 3), "123.456");
        assert_eq!(number(-1234.5, 0), "-1235");
    }

    #[test]
    fn what_is_no_number_is_null() {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
            assert_eq!(number(value, 2), "null");
        }
    }

    #[test]
    fn texts_are_escaped() {
        let mut json = Json::new();
        json.text("a\"b\\c\nd\u{1}</script>é\u{2028}\u{1f916}");
        assert_eq!(
            json.into_text(),
            "\"a\\\"b\\\\c\\nd\\u0001\\u003c/script>\\u00e9\\u2028\\ud83e\\udd16\""
        );
    }

    #[test]
    fn commas_come_by_themselves() {
        let mut json = Json::new();
        json.object(|json| {
            json.key("a").array(|json| {
                json.object(|_| {});
                json.null();
                json.array(|json| json.integer(-1));
            });
            json.raw("\"b\":1");
            json.raw("");
            json.key("c").bool(true);
        });
        assert_eq!(json.as_text(), r#"{"a":[{},null,[-1]],"b":1,"c":true}"#);
    }

    #[test]
    fn base_64_is_that_of_the_standard() {
        // The examples of RFC 4648, section 10.
        let of = |bytes: &[u8]| {
            let mut json = Json::new();
            json.base64(bytes);
            json.into_text().trim_matches('"').to_owned()
        };
        assert_eq!(of(b""), "");
        assert_eq!(of(b"f"), "Zg==");
        assert_eq!(of(b"fo"), "Zm8=");
        assert_eq!(of(b"foo"), "Zm9v");
        assert_eq!(of(b"foob"), "Zm9vYg==");
        assert_eq!(of(b"foobar"), "Zm9vYmFy");
    }
}
