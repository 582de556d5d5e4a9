//! The size of the screen, and how its pixels lie in memory.

/// Width and height of the screen, in pixels.
pub(crate) const WIDTH: usize = 178;
pub(crate) const HEIGHT: usize = 128;

/// How many bits the screen has for a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// One, 1 is black, the least significant on the left; a line has 24 bytes. The screen of
    /// ev3dev-jessie.
    One,
    /// 32: blue, green, red and nothing; a line has 712 bytes. The screen of ev3dev-stretch.
    #[default]
    ThirtyTwo,
}

impl Depth {
    /// Bits for a pixel.
    pub(crate) const fn bits(self) -> usize {
        match self {
            Depth::One => 1,
            Depth::ThirtyTwo => 32,
        }
    }

    /// Bytes for a line.
    pub(crate) const fn stride(self) -> usize {
        match self {
            Depth::One => 24,
            Depth::ThirtyTwo => WIDTH * 4,
        }
    }
}
