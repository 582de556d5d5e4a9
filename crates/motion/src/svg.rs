//! Pictures of the plane.
use crate::plane::{Bounds, Point};
use std::fmt::{Arguments, Write};

/// A picture as SVG: one unit a centimeter, y up, four pixels a centimeter.
pub struct Svg(String);

impl Svg {
    /// A picture of what is within a box; `style` are attributes of all of it.
    pub fn new(frame: &Bounds, style: &str) -> Self {
        let (Bounds { low: [left, _], high: [_, top] }, [width, height]) = (frame, frame.size());
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" \
             viewBox=\"{left:.2} {:.2} {width:.2} {height:.2}\" width=\"{:.0}\" height=\"{:.0}\">\n\
             <g transform=\"scale(1,-1)\"{style}>\n",
            -top,
            width * 4.0,
            height * 4.0
        ))
    }

    /// Adds an element, on a line of its own.
    pub fn add(&mut self, element: Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{element}");
    }

    /// Adds a rectangle: `name` are the attributes before its corner, `style` those after its size.
    #[inline(never)]
    pub fn rectangle(&mut self, name: &str, [x, y]: Point, [width, height]: [f64; 2], style: &str) {
        self.add(format_args!(
            "<rect{name} x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" {style}/>"
        ));
    }

    /// Fills a box.
    pub fn fill(&mut self, frame: &Bounds, color: &str) {
        self.rectangle("", frame.low, frame.size(), &format!("fill=\"{color}\""));
    }

    /// Adds a circle, with attributes as those of a rectangle.
    #[inline(never)]
    pub fn circle(&mut self, name: &str, [x, y]: Point, radius: &str, style: &str) {
        self.add(format_args!(
            "<circle{name} cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" {style}/>"
        ));
    }

    /// Adds a straight line, with attributes as those of a rectangle.
    #[inline(never)]
    pub fn line(&mut self, name: &str, [[x1, y1], [x2, y2]]: [Point; 2], style: &str) {
        self.add(format_args!(
            "<line{name} x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" {style}/>"
        ));
    }

    /// Adds the walls around everything.
    pub fn bounds(&mut self, bounds: &Bounds) {
        let style = "fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"";
        self.rectangle(" class=\"bounds\"", bounds.low, bounds.size(), style);
    }

    /// The whole text.
    pub fn into_text(mut self) -> String {
        self.0.push_str("</g>\n</svg>\n");
        self.0
    }
}

/// Points as SVG lists them.
pub fn points(list: &[Point]) -> String {
    let texts = list.iter().map(|[x, y]| format!("{x:.2},{y:.2}"));
    texts.collect::<Vec<_>>().join(" ")
}
