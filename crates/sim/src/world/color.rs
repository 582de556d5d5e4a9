//! Colors of a floor, and how the color sensor names them.

use std::fmt;
use std::str::FromStr;

/// How much of red, green and blue light a surface throws back, 0–255 each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color {
    /// Red.
    pub red: u8,
    /// Green.
    pub green: u8,
    /// Blue.
    pub blue: u8,
}

/// Names in the order of the COL-COLOR codes 1–7. White paper and black tape reflect 92 % and
/// 6 %: figures as a sensor shows them on a desk.
const PALETTE: [(&str, Color); 7] = [
    ("black", Color::rgb(15, 15, 15)),
    ("blue", Color::rgb(20, 60, 150)),
    ("green", Color::rgb(20, 130, 50)),
    ("yellow", Color::rgb(230, 190, 30)),
    ("red", Color::rgb(200, 25, 25)),
    ("white", Color::rgb(235, 235, 235)),
    ("brown", Color::rgb(110, 60, 30)),
];

impl Color {
    /// Black tape.
    pub const BLACK: Color = PALETTE[0].1;
    /// White paper.
    pub const WHITE: Color = PALETTE[5].1;

    /// A color from its parts.
    pub const fn rgb(red: u8, green: u8, blue: u8) -> Color {
        Color { red, green, blue }
    }

    /// The number that COL-COLOR reads: 1 black … 7 brown, the nearest of them.
    pub fn code(self) -> i32 {
        let away = |other: Color| {
            let part = |a: u8, b: u8| (i32::from(a) - i32::from(b)).pow(2);
            part(self.red, other.red) + part(self.green, other.green) + part(self.blue, other.blue)
        };
        let nearest = (1..).zip(PALETTE).min_by_key(|(_, (_, color))| away(*color));
        nearest.map_or(0, |(code, _)| code)
    }
}

/// No color is called this.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such color: {0} (black blue green yellow red white brown, or #rrggbb)")]
pub struct UnknownColor(pub String);

impl FromStr for Color {
    type Err = UnknownColor;

    /// A name of the palette, or `#rrggbb`.
    fn from_str(text: &str) -> Result<Color, UnknownColor> {
        if let Some((_, color)) = PALETTE.iter().find(|(name, _)| *name == text) {
            return Ok(*color);
        }
        let unknown = || UnknownColor(text.to_owned());
        let hex = text.strip_prefix('#').filter(|hex| hex.len() == 6).ok_or_else(unknown)?;
        let [_, red, green, blue] =
            u32::from_str_radix(hex, 16).map_err(|_| unknown())?.to_be_bytes();
        Ok(Color { red, green, blue })
    }
}

impl fmt::Display for Color {
    /// As `#rrggbb`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{:02x}{:02x}{:02x}", self.red, self.green, self.blue)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_named_color_is_seen_as_itself() {
        for (code, (name, color)) in (1..).zip(PALETTE) {
            assert_eq!(name.parse(), Ok(color));
            assert_eq!(color.to_string().parse(), Ok(color));
            assert_eq!(color.code(), code, "{name}");
        }
        assert!("mauve".parse::<Color>().is_err());
        assert_eq!(Color::rgb(128, 128, 128).code(), 7, "gray looks brown to it");
    }
}
