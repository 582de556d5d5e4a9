//! A picture of the world, the way of the robot, and the robot.

use std::fmt::Write;

use crate::machine::Machine;
use crate::world::geometry::Pose;
use crate::world::{Bounds, Hull, Item, Point};

/// Room around everything, in cm.
const MARGIN: f64 = 10.0;

impl Bounds {
    /// Grows until a circle is in it.
    fn include(&mut self, [x, y]: Point, reach: f64) {
        self.low = [self.low[0].min(x - reach), self.low[1].min(y - reach)];
        self.high = [self.high[0].max(x + reach), self.high[1].max(y + reach)];
    }

    fn include_item(&mut self, item: &Item) {
        match item {
            Item::Wall { from, to, thickness } => {
                self.include(*from, *thickness);
                self.include(*to, *thickness);
            }
            Item::Box { pose, width, depth } => {
                self.include([pose.x, pose.y], libm::hypot(*width, *depth) / 2.0);
            }
            Item::Circle { center, radius } => self.include(*center, *radius),
            Item::Patch { corners: points, .. } | Item::Line { points, .. } => {
                for point in points {
                    self.include(*point, 1.0);
                }
            }
            Item::Lamp { at, .. } | Item::Bulb { at, .. } | Item::Beacon { at, .. } => {
                self.include(*at, 4.0);
            }
        }
    }
}

fn list(points: impl Iterator<Item = Point>) -> String {
    points.map(|[x, y]| format!("{x:.2},{y:.2}")).collect::<Vec<_>>().join(" ")
}

impl Machine {
    /// An SVG picture, one unit a centimeter, y up.
    #[must_use]
    pub fn svg(&self) -> String {
        let pose = self.pose();
        let Bounds { low: [left, bottom], high: [right, top] } = self.frame();
        let (width, height) = (right - left, top - bottom);
        let mut svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" \
             viewBox=\"{left:.2} {:.2} {width:.2} {height:.2}\" \
             width=\"{:.0}\" height=\"{:.0}\">\n<g transform=\"scale(1,-1)\">\n",
            -top,
            width * 4.0,
            height * 4.0
        );
        self.draw_floor(&mut svg, [left, bottom], [width, height]);
        for (id, item) in self.scene.items() {
            draw_item(&mut svg, id.0, item);
        }
        for (id, item) in self.other_robots() {
            draw_item(&mut svg, id.0, &item);
        }
        let path = list(self.trace.path().map(|(_, p)| [p.x, p.y]).chain([[pose.x, pose.y]]));
        line(
            &mut svg,
            format_args!(
                "<polyline class=\"path\" points=\"{path}\" fill=\"none\" stroke=\"#d33\" \
             stroke-width=\"0.8\" stroke-linejoin=\"round\"/>"
            ),
        );
        for hit in self.trace.collisions() {
            line(
                &mut svg,
                format_args!(
                    "<circle class=\"collision\" cx=\"{:.2}\" cy=\"{:.2}\" r=\"1.5\" fill=\"#f80\"/>",
                    hit.pose.x, hit.pose.y
                ),
            );
        }
        draw_robot(&mut svg, pose, self.robot.hull);
        svg.push_str("</g>\n</svg>\n");
        svg
    }

    /// The rectangle around everything, with a margin.
    #[must_use]
    pub fn frame(&self) -> Bounds {
        let pose = self.pose();
        let mut frame = Bounds { low: [pose.x, pose.y], high: [pose.x, pose.y] };
        frame.include([pose.x, pose.y], self.robot.hull.reach());
        self.trace.path().for_each(|(_, pose)| frame.include([pose.x, pose.y], 0.0));
        self.scene.items().iter().for_each(|(_, item)| frame.include_item(item));
        self.other_robots().for_each(|(_, item)| frame.include_item(&item));
        if let Some(bounds) = self.scene.bounds {
            frame.include(bounds.low, 0.0);
            frame.include(bounds.high, 0.0);
        }
        Bounds { low: frame.low.map(|n| n - MARGIN), high: frame.high.map(|n| n + MARGIN) }
    }

    fn draw_floor(&self, svg: &mut String, [x, y]: Point, [width, height]: Point) {
        line(
            svg,
            format_args!(
                "<rect x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\" \
             fill=\"{}\"/>",
                self.scene.floor
            ),
        );
        if let Some(bounds) = self.scene.bounds {
            let [low, high] = [bounds.low, bounds.high];
            line(
                svg,
                format_args!(
                    "<rect class=\"bounds\" x=\"{:.2}\" y=\"{:.2}\" width=\"{:.2}\" height=\"{:.2}\" \
                 fill=\"none\" stroke=\"#444\" stroke-width=\"1.5\"/>",
                    low[0],
                    low[1],
                    high[0] - low[0],
                    high[1] - low[1]
                ),
            );
        }
    }
}

fn line(svg: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = writeln!(svg, "{arguments}");
}

fn draw_item(svg: &mut String, id: u32, item: &Item) {
    match item {
        Item::Wall { from, to, thickness } => line(
            svg,
            format_args!(
                "<line id=\"item{id}\" x1=\"{:.2}\" y1=\"{:.2}\" x2=\"{:.2}\" y2=\"{:.2}\" \
             stroke=\"#444\" stroke-width=\"{thickness:.2}\"/>",
                from[0], from[1], to[0], to[1]
            ),
        ),
        Item::Box { pose, width, depth } => line(
            svg,
            format_args!(
                "<rect id=\"item{id}\" x=\"{:.2}\" y=\"{:.2}\" width=\"{width:.2}\" \
             height=\"{depth:.2}\" fill=\"#987\" \
             transform=\"translate({:.2},{:.2}) rotate({:.2})\"/>",
                -width / 2.0,
                -depth / 2.0,
                pose.x,
                pose.y,
                -pose.heading
            ),
        ),
        Item::Circle { center: [x, y], radius } => line(
            svg,
            format_args!(
                "<circle id=\"item{id}\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius:.2}\" fill=\"#987\"/>"
            ),
        ),
        Item::Patch { corners, color } => line(
            svg,
            format_args!(
                "<polygon id=\"item{id}\" points=\"{}\" fill=\"{color}\"/>",
                list(corners.iter().copied())
            ),
        ),
        Item::Line { points, width, color } => line(
            svg,
            format_args!(
                "<polyline id=\"item{id}\" points=\"{}\" fill=\"none\" stroke=\"{color}\" \
             stroke-width=\"{width:.2}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
                list(points.iter().copied())
            ),
        ),
        Item::Lamp { at: [x, y], .. } | Item::Bulb { at: [x, y], .. } => line(
            svg,
            format_args!(
                "<circle id=\"item{id}\" class=\"lamp\" cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"3\" \
             fill=\"#fd0\" stroke=\"#a80\" stroke-width=\"0.5\"/>"
            ),
        ),
        Item::Beacon { at: [x, y], channel } => line(
            svg,
            format_args!(
                "<circle id=\"item{id}\" class=\"beacon channel{channel}\" cx=\"{x:.2}\" \
             cy=\"{y:.2}\" r=\"2\" fill=\"#c3c\" stroke=\"#606\" stroke-width=\"0.5\"/>"
            ),
        ),
    }
}

fn draw_robot(svg: &mut String, pose: Pose, hull: Hull) {
    line(
        svg,
        format_args!(
            "<g class=\"robot\" transform=\"translate({:.2},{:.2}) rotate({:.2})\">",
            pose.x, pose.y, -pose.heading
        ),
    );
    let style = "fill=\"#36c\" fill-opacity=\"0.6\" stroke=\"#036\" stroke-width=\"0.5\"";
    let nose = match hull {
        Hull::Circle { radius } => {
            line(svg, format_args!("<circle r=\"{radius:.2}\" {style}/>"));
            radius
        }
        Hull::Rectangle { width, length, offset } => {
            line(
                svg,
                format_args!(
                    "<rect x=\"{:.2}\" y=\"{:.2}\" width=\"{width:.2}\" height=\"{length:.2}\" {style}/>",
                    -width / 2.0,
                    offset - length / 2.0
                ),
            );
            offset + length / 2.0
        }
    };
    line(
        svg,
        format_args!(
            "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"{nose:.2}\" stroke=\"#fff\" stroke-width=\"0.8\"/>\n</g>"
        ),
    );
}
