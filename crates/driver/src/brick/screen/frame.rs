//! A picture to be drawn on: lines, circles, letters, other pictures.
//!
//! It has the size of the screen and 256 shades of gray; those that programs
//! draw with are the four that the EV3's panel has.
use crate::brick::screen::picture::Picture;
use embedded_graphics::mono_font::iso_8859_1::{FONT_5X8, FONT_6X10, FONT_7X13, FONT_10X20};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle, MonoTextStyleBuilder};
use embedded_graphics::pixelcolor::Gray8;
use embedded_graphics::prelude::*;
use embedded_graphics::primitives::{
    Arc, Circle, Line, PrimitiveStyle, PrimitiveStyleBuilder, Rectangle, StrokeAlignment,
    StyledDrawable,
};
use embedded_graphics::text::{Alignment, Baseline, Text, TextStyleBuilder};
use std::convert::Infallible;

/// Pixels in a line.
pub const WIDTH: u32 = 178;

/// Lines.
pub const HEIGHT: u32 = 128;

const WHITE: u8 = 255;

/// The shades that the panel has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shade {
    /// All dark.
    Black,
    /// A third of white.
    DarkGray,
    /// Two thirds.
    LightGray,
    /// All bright.
    White,
}

impl Shade {
    const ALL: [(Self, &str, u8); 4] = [
        (Self::Black, "black", 0),
        (Self::DarkGray, "dark_gray", 85),
        (Self::LightGray, "light_gray", 170),
        (Self::White, "white", WHITE),
    ];

    /// The shade that programs call so.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|(_, name, _)| *name == word).map(|(shade, ..)| shade)
    }

    fn color(self) -> Gray8 {
        let [(_, _, black), (_, _, dark), (_, _, light), (_, _, white)] = Self::ALL;
        Gray8::new(match self {
            Self::Black => black,
            Self::DarkGray => dark,
            Self::LightGray => light,
            Self::White => white,
        })
    }
}

/// Something to draw, in pixels from the upper left corner. Pixels outside of the
/// screen are not drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// One pixel.
    Point([i32; 2]),
    /// From one pixel to another.
    Line([i32; 2], [i32; 2]),
    /// The upper left corner, then width and height.
    Rectangle([i32; 2], [u32; 2]),
    /// The middle, and the radius.
    Circle([i32; 2], u32),
    /// A piece of a circle: from an angle, and by how much, in degrees clockwise from the top.
    Arc([i32; 2], u32, [f32; 2]),
}

/// How a shape is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// The shade of the line, and of what is filled.
    pub color: Shade,
    /// How thick the line is.
    pub width: u32,
    /// Whether the shape is filled.
    pub fill: bool,
}

/// The letters of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Font {
    /// 5 x 8 pixels.
    Tiny,
    /// 6 x 10 pixels.
    Small,
    /// 7 x 13 pixels.
    Medium,
    /// 10 x 20 pixels.
    Large,
}

impl Font {
    /// The font of that name.
    pub fn named(word: &str) -> Option<Self> {
        let fonts = [Self::Tiny, Self::Small, Self::Medium, Self::Large];
        fonts
            .into_iter()
            .zip(["tiny", "small", "medium", "large"])
            .find_map(|(font, name)| (name == word).then_some(font))
    }

    fn letters(self) -> &'static MonoFont<'static> {
        match self {
            Self::Tiny => &FONT_5X8,
            Self::Small => &FONT_6X10,
            Self::Medium => &FONT_7X13,
            Self::Large => &FONT_10X20,
        }
    }
}

/// The position of a text relative to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Align {
    /// Right of it.
    Left,
    /// On both sides of it.
    Center,
    /// Left of it.
    Right,
}

/// How a text is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Letters {
    /// Their shade.
    pub color: Shade,
    /// The shade behind them; none leaves what is there.
    pub background: Option<Shade>,
    /// The letters.
    pub font: Font,
    /// How many times as large: 1, 2, ...
    pub scale: u32,
    /// Where.
    pub align: Align,
}

/// A picture to be shown, of shades from 0 to 255.
pub struct Frame {
    pixels: Box<[u8]>,
}

impl Default for Frame {
    fn default() -> Self {
        Self { pixels: vec![WHITE; WIDTH as usize * HEIGHT as usize].into() }
    }
}

impl Frame {
    /// Its shades, line by line, 0 is black.
    pub fn shades(&self) -> &[u8] {
        &self.pixels
    }

    /// Makes all of it white.
    pub fn clear(&mut self) {
        self.pixels.fill(WHITE);
    }

    /// Draws a shape.
    pub fn draw(&mut self, shape: Shape, style: Style) {
        let color = style.color.color();
        let line = PrimitiveStyle::with_stroke(color, style.width);
        let closed = if style.fill {
            PrimitiveStyleBuilder::from(&line).fill_color(color).build()
        } else {
            line
        };
        // An infallible result each.
        let Ok(()) = match shape {
            Shape::Point(at) => Pixel(point(at), color).draw(self),
            Shape::Line(from, to) => Line::new(point(from), point(to)).draw_styled(&line, self),
            Shape::Rectangle(corner, [width, height]) => {
                let size = Size::new(width, height);
                Rectangle::new(point(corner), size).draw_styled(&inside(closed), self)
            }
            Shape::Circle(middle, radius) => {
                Circle::with_center(point(middle), diameter(radius)).draw_styled(&closed, self)
            }
            Shape::Arc(middle, radius, [start, sweep]) => {
                // Theirs start on the right.
                let (start, sweep) =
                    (Angle::from_degrees(start - 90.0), Angle::from_degrees(sweep));
                Arc::with_center(point(middle), diameter(radius), start, sweep)
                    .draw_styled(&line, self)
            }
        };
    }

    /// Writes a text; a newline in it starts another line.
    pub fn write(&mut self, [x, y]: [i32; 2], text: &str, letters: Letters) {
        let style = MonoTextStyleBuilder::new()
            .font(letters.font.letters())
            .text_color(letters.color.color());
        let style: MonoTextStyle<'_, Gray8> = match letters.background {
            Some(shade) => style.background_color(shade.color()).build(),
            None => style.build(),
        };
        let alignment = match letters.align {
            Align::Left => Alignment::Left,
            Align::Center => Alignment::Center,
            Align::Right => Alignment::Right,
        };
        let place = TextStyleBuilder::new().alignment(alignment).baseline(Baseline::Top).build();
        let mut target = Scaled { frame: self, origin: [x, y], scale: letters.scale };
        let Ok(_) = Text::with_text_style(text, Point::zero(), style, place).draw(&mut target);
    }

    /// Draws a picture with its upper left corner there.
    pub fn place(&mut self, [x, y]: [i32; 2], picture: &Picture) {
        let pixels = picture.pixels().map(|([dx, dy], shade)| {
            Pixel(Point::new(x.saturating_add(dx), y.saturating_add(dy)), Gray8::new(shade))
        });
        let Ok(()) = self.draw_iter(pixels);
    }
}

fn point([x, y]: [i32; 2]) -> Point {
    Point::new(x, y)
}

/// Of a circle that has a pixel in its middle.
fn diameter(radius: u32) -> u32 {
    radius.saturating_mul(2).saturating_add(1)
}

/// A line that is not outside of what it goes around.
fn inside(style: PrimitiveStyle<Gray8>) -> PrimitiveStyle<Gray8> {
    PrimitiveStyleBuilder::from(&style).stroke_alignment(StrokeAlignment::Inside).build()
}

impl OriginDimensions for Frame {
    fn size(&self) -> Size {
        Size::new(WIDTH, HEIGHT)
    }
}

impl DrawTarget for Frame {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(
        &mut self,
        pixels: I,
    ) -> std::result::Result<(), Infallible> {
        for Pixel(at, color) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(at.x), u32::try_from(at.y)) else {
                continue;
            };
            if x < WIDTH && y < HEIGHT {
                if let Some(pixel) = self.pixels.get_mut((y * WIDTH + x) as usize) {
                    *pixel = color.luma();
                }
            }
        }
        Ok(())
    }

    fn fill_solid(
        &mut self,
        area: &Rectangle,
        color: Gray8,
    ) -> std::result::Result<(), Infallible> {
        // Only the visible part: areas may be much larger than the screen.
        let seen = area.intersection(&self.bounding_box());
        self.draw_iter(seen.points().map(|at| Pixel(at, color)))
    }
}

/// A frame on which each pixel is a square of `scale` pixels.
struct Scaled<'a> {
    frame: &'a mut Frame,
    origin: [i32; 2],
    scale: u32,
}

impl Dimensions for Scaled<'_> {
    fn bounding_box(&self) -> Rectangle {
        self.frame.bounding_box()
    }
}

impl DrawTarget for Scaled<'_> {
    type Color = Gray8;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(
        &mut self,
        pixels: I,
    ) -> std::result::Result<(), Infallible> {
        let scale = i32::try_from(self.scale).unwrap_or(i32::MAX);
        let [x, y] = self.origin;
        pixels.into_iter().try_for_each(|Pixel(at, color)| {
            let along = |pixels: i32, from: i32| pixels.saturating_mul(scale).saturating_add(from);
            let corner = Point::new(along(at.x, x), along(at.y, y));
            self.frame.fill_solid(&Rectangle::new(corner, Size::new_equal(self.scale)), color)
        })
    }
}
