//! A picture of a map, a roadmap and the way along it.
use crate::map::{Map, Shape};
use crate::plan::Solution;
use ev3_motion::{Svg, points};
use std::fmt::Write;

/// Room around everything, in cm.
const MARGIN: f64 = 10.0;

/// An SVG picture, one unit a centimeter, y up: the obstacles, each with what must be kept free
/// around it, the lines of the roadmap that were looked at, and the way.
pub fn svg(map: &Map, found: &Solution, keep: f64) -> String {
    let ends = [found.raw[0], found.raw[found.raw.len() - 1]];
    let frame = map.extent(ends, 0.0).with_room(MARGIN);
    let mut svg = Svg::new(&frame, " stroke-linejoin=\"round\" stroke-linecap=\"round\"");
    svg.fill(&frame, "#fff");
    // First what is kept free, so that no obstacle is covered by it.
    draw_obstacles(&mut svg, map, "fill=\"#eee\"", keep);
    draw_obstacles(&mut svg, map, "class=\"obstacle\" fill=\"#987\"", 0.0);
    if let Some(bounds) = &map.bounds {
        svg.bounds(bounds);
    }
    for line in &found.roadmap {
        let style = "stroke=\"#9bd\" stroke-width=\"0.3\"";
        svg.line(" class=\"roadmap\"", *line, style);
    }
    draw_way(&mut svg, found);
    for (end, color) in ends.into_iter().zip(["#2a2", "#d33"]) {
        svg.circle("", end, "2", &format!("fill=\"{color}\""));
    }
    svg.into_text()
}

/// The obstacles, and all that is nearer to one than a distance. (A stroke that is wider than a
/// circle would leave a ring within it.)
fn draw_obstacles(svg: &mut Svg, map: &Map, style: &str, keep: f64) {
    for obstacle in map.obstacles() {
        match &obstacle.0 {
            Shape::Polygon(corners) => {
                let (corners, width) = (points(corners), 2.0 * keep);
                svg.add(format_args!(
                    "<polygon points=\"{corners}\" {style} stroke=\"#eee\" stroke-width=\"{width:.2}\"/>"
                ));
            }
            Shape::Circle { center, radius } => {
                svg.circle("", *center, &format!("{:.2}", radius + keep), style);
            }
        }
    }
}

fn draw_way(svg: &mut Svg, found: &Solution) {
    let mut d = format!("M {}", points(&found.raw[..1]));
    for segment in found.path.segments() {
        let to = points(&[segment.to()]);
        // Writing to a string cannot fail.
        let _ = match segment.radius() {
            Some(signed) => {
                let (left, radius) = (u8::from(signed < 0.0), signed.abs());
                write!(d, " A {radius:.2} {radius:.2} 0 0 {left} {to}")
            }
            None => write!(d, " L {to}"),
        };
    }
    svg.add(format_args!(
        "<path class=\"path\" d=\"{d}\" fill=\"none\" stroke=\"#d33\" stroke-width=\"0.8\"/>"
    ));
}
