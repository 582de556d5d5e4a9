//! `prolog/ev3dev/screen.pl`: the screen.
use crate::glue::call::Call;
use crate::glue::error::wrong_value;
use crate::glue::state::{devices, with_frame};
use crate::glue::terms::Prolog;
use ev3_driver::brick::screen::frame::{Align, Font, Frame, Letters, Shade, Shape, Style};
use ev3_driver::brick::screen::picture::Picture;
use ev3_driver::brick::screen::{self, frame, picture};
use std::path::Path;
use swipl::prelude::*;

natives! {
    /// screen_clear_
    semidet fn "screen_clear_"(_context) {
        with_frame(Frame::clear);
        into_prolog_result(true)
    }

    /// screen_draw_(+Shape, +style(Color, Width, Fill))
    semidet fn "screen_draw_"(context, shape, style) as call("screen_draw", 2) {
        let shape = shape_of(&call, shape)?;
        let [color, width, fill] = call.arguments(style)?;
        let style = Style {
            color: shade_of(&call, &color)?,
            width: size(&call, &width)?,
            fill: fill.get_ex()?,
        };
        with_frame(|frame| frame.draw(shape, style));
        Ok(())
    }

    /// screen_write_(+X, +Y, +Text, +letters(Color, Background, Font, Scale, Align))
    semidet fn "screen_write_"(context, x, y, text, letters) as call("screen_text", 4) {
        let (at, text) = (point(&call, [x, y])?, call.text(text)?);
        let letters = letters_of(&call, letters)?;
        with_frame(|frame| frame.write(at, &text, letters));
        Ok(())
    }

    /// screen_image_(+X, +Y, +File)
    semidet fn "screen_image_"(context, x, y, file) as call("screen_image", 3) {
        let at = point(&call, [x, y])?;
        let picture = call.or_throw(Picture::read(Path::new(&*call.text(file)?)))?;
        with_frame(|frame| frame.place(at, &picture));
        Ok(())
    }

    /// screen_show_
    semidet fn "screen_show_"(context) as call("screen_show", 0) {
        let dev = call.dev()?;
        call.or_fail(with_frame(|frame| screen::show(devices().tree(), &*dev, frame)))
    }

    /// screen_png_(+File)
    semidet fn "screen_png_"(context, file) as call("screen_png", 1) {
        let (file, dev) = (call.text(file)?, call.dev()?);
        let seen = call.or_fail(screen::seen(devices().tree(), &*dev))?;
        call.or_throw(picture::write_png(Path::new(&*file), frame::WIDTH, frame::HEIGHT, &seen))
    }
}

/// `point(X, Y)`, `line(X1, Y1, X2, Y2)`, `rectangle(X, Y, Width, Height)`,
/// `circle(X, Y, Radius)` or `arc(X, Y, Radius, Start, Sweep)`.
fn shape_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Shape> {
    let arguments = call.context.compound_terms_vec(term)?;
    let name = term.get::<Functor>()?.name_string();
    Ok(match (&*name, &*arguments) {
        ("point", [x, y]) => Shape::Point(point(call, [x, y])?),
        ("line", [x1, y1, x2, y2]) => Shape::Line(point(call, [x1, y1])?, point(call, [x2, y2])?),
        ("rectangle", [x, y, width, height]) => {
            Shape::Rectangle(point(call, [x, y])?, [size(call, width)?, size(call, height)?])
        }
        ("circle", [x, y, radius]) => Shape::Circle(point(call, [x, y])?, size(call, radius)?),
        ("arc", [x, y, radius, start, sweep]) => {
            let angles = [angle(call, start)?, angle(call, sweep)?];
            Shape::Arc(point(call, [x, y])?, size(call, radius)?, angles)
        }
        _ => return wrong_value(call, "shape", term),
    })
}

fn letters_of<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<Letters> {
    let [color, background, font, scale, align] = call.arguments(term)?;
    let background_is_none = &*call.text(&background)? == "none";
    let font_named = Font::named(&call.text(&font)?);
    let align_named = match &*call.text(&align)? {
        "left" => Align::Left,
        "center" => Align::Center,
        "right" => Align::Right,
        _ => return wrong_value(call, "text_align", &align),
    };
    Ok(Letters {
        color: shade_of(call, &color)?,
        background: if background_is_none { None } else { Some(shade_of(call, &background)?) },
        font: font_named.map_or_else(|| wrong_value(call, "font", &font), Ok)?,
        scale: size(call, &scale)?,
        align: align_named,
    })
}

fn shade_of<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<Shade> {
    Shade::named(&call.text(term)?).map_or_else(|| wrong_value(call, "screen_color", term), Ok)
}

/// Pixels from the upper left corner.
fn point<C: Prolog>(call: &Call<C>, [x, y]: [&Term; 2]) -> PrologResult<[i32; 2]> {
    Ok([pixels(call, x)?, pixels(call, y)?])
}

fn pixels<T: TryFrom<i64>, C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<T> {
    T::try_from(call.integer(term)?).or_else(|_| wrong_value(call, "pixels", term))
}

fn size<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<u32> {
    pixels(call, term)
}

/// Degrees. `f32` has enough digits for drawing.
#[expect(clippy::cast_possible_truncation, reason = "a circle has few pixels")]
fn angle<C: Prolog>(call: &Call<C>, term: &Term) -> PrologResult<f32> {
    Ok(call.float(term)? as f32)
}
