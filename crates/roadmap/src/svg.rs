//! A picture of a map, a roadmap and the way along it.
use crate::geometry::Point;
use crate::map::{Map, Shape};
use crate::plan::Solution;
use std::fmt::Write;

/// Room around everything, in cm.
const MARGIN: f64 = 10.0;

/// An SVG picture, one unit a centimeter, y up: the obstacles, each with what
/// must be kept free around it, the lines of the roadmap that were looked at,
/// and the way.
#[must_use]
pub fn svg(map: &Map, found: &Solution, keep: f64) -> String {
    let ends = [found.raw[0], found.raw[found.raw.len() - 1]];
    let extent = map.extent(ends, 0.0);
    let [left, bottom] = extent.low.map(|n| n - MARGIN);
    let [right, top] = extent.high.map(|n| n + MARGIN);
    let (width, height) = (right - left, top - bottom);
    let mut svg = Svg(format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" \
         viewBox=\"{left:.2} {:.2} {width:.2} {height:.2}\" width=\"{:.0}\" height=\"{:.0}\">\n\
         <g transform=\"scale(1,-1)\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n",
        -top,
        width * 4.0,
        height * 4.0
    ));
    svg.line(format_args!(
        "<rect x=\"{left:.2}\" y=\"{bottom:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
         fill=\"#fff\"/>"
    ));
    // First what is kept free, so that no obstacle is covered by it.
    let kept = format!("fill=\"#eee\" stroke=\"#eee\" stroke-width=\"{:.2}\"", 2.0 * keep);
    svg.obstacles(map, &kept);
    svg.obstacles(map, "class=\"obstacle\" fill=\"#987\"");
    if let Some(bounds) = map.bounds {
        let ([x, y], [right, top]) = (bounds.low, bounds.high);
        svg.line(format_args!(
            "<rect class=\"bounds\" x=\"{x:.2}\" y=\"{y:.2}\" width=\"{:.2}\" height=\"{:.2}\" \
             fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"/>",
            right - x,
            top - y
        ));
    }
    for [[x1, y1], [x2, y2]] in &found.roadmap {
        svg.line(format_args!(
            "<line class=\"roadmap\" x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" \
             stroke=\"#9bd\" stroke-width=\"0.3\"/>"
        ));
    }
    svg.way(found);
    for ([x, y], color) in ends.into_iter().zip(["#2a2", "#d33"]) {
        svg.line(format_args!("<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"2\" fill=\"{color}\"/>"));
    }
    svg.0.push_str("</g>\n</svg>\n");
    svg.0
}

struct Svg(String);

impl Svg {
    fn line(&mut self, arguments: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = writeln!(self.0, "{arguments}");
    }

    fn obstacles(&mut self, map: &Map, style: &str) {
        for obstacle in map.obstacles() {
            match &obstacle.0 {
                Shape::Polygon(corners) => {
                    self.line(format_args!("<polygon points=\"{}\" {style}/>", list(corners)));
                }
                Shape::Circle { center: [x, y], radius } => self.line(format_args!(
                    "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" {style}/>"
                )),
            }
        }
    }

    fn way(&mut self, found: &Solution) {
        let mut d = format!("M {}", list(&found.raw[..1]));
        for segment in found.path.segments() {
            let to = list(&[segment.to()]);
            // Writing to a string cannot fail.
            let _ = match segment.radius() {
                Some(signed) => {
                    let (left, radius) = (u8::from(signed < 0.0), signed.abs());
                    write!(d, " A {radius:.2} {radius:.2} 0 0 {left} {to}")
                }
                None => write!(d, " L {to}"),
            };
        }
        self.line(format_args!(
            "<path class=\"path\" d=\"{d}\" fill=\"none\" stroke=\"#d33\" stroke-width=\"0.8\"/>"
        ));
    }
}

fn list(points: &[Point]) -> String {
    points.iter().map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}
