//! A picture of the world, the way of the robot, and the robot.
use crate::machine::Machine;
use crate::world::{Hull, Item, Shape};
use ev3_motion::{Bounds, Pose, Svg, points};

/// Room around everything, in cm.
const MARGIN: f64 = 10.0;

fn include_item(frame: &mut Bounds, item: &Item) {
    match item.shape() {
        Shape::Bar { from, to, thickness } => {
            frame.include(from, thickness);
            frame.include(to, thickness);
        }
        Shape::Box { pose, width, depth } => {
            frame.include(pose.point(), libm::hypot(width, depth) / 2.0);
        }
        Shape::Disc { center, radius } => frame.include(center, radius),
        Shape::Area { corners: points, .. } | Shape::Band { points, .. } => {
            for point in points {
                frame.include(*point, 1.0);
            }
        }
        Shape::Mark { at, .. } => frame.include(at, 4.0),
    }
}

impl Machine {
    /// An SVG picture, one unit a centimeter, y up.
    pub fn svg(&self) -> String {
        let (pose, frame) = (self.pose(), self.frame());
        let mut svg = Svg::new(&frame, "");
        svg.fill(&frame, &format!("{}", self.scene.floor));
        if let Some(bounds) = &self.scene.bounds {
            svg.bounds(bounds);
        }
        // What moves comes to lie on what the floor has.
        let (things, fixed): (Vec<_>, Vec<_>) =
            self.items().partition(|(_, item)| item.movable().is_some());
        for (id, item) in fixed.into_iter().chain(things) {
            draw_item(&mut svg, id.0, &item);
        }
        for (id, item) in self.other_robots() {
            draw_item(&mut svg, id.0, &item);
        }
        let path = self.trace.path().map(|(_, pose)| pose.point()).chain([pose.point()]);
        let path: Vec<_> = path.collect();
        svg.add(format_args!(
            "<polyline class=\"path\" points=\"{}\" fill=\"none\" stroke=\"#d33\" \
             stroke-width=\"0.8\" stroke-linejoin=\"round\"/>",
            points(&path)
        ));
        for hit in self.trace.collisions() {
            let style = "fill=\"#f80\"";
            svg.circle(" class=\"collision\"", hit.pose.point(), "1.5", style);
        }
        let jaws = self.robot.grippers.iter();
        let jaws: Vec<_> = jaws.filter_map(|it| Some((it.at, self.opening(it.port)?))).collect();
        draw_robot(&mut svg, pose, self.robot.hull, &jaws);
        svg.into_text()
    }

    /// The rectangle around everything, with a margin.
    pub fn frame(&self) -> Bounds {
        let at = self.pose().point();
        let mut frame = Bounds { low: at, high: at };
        frame.include(at, self.robot.hull.reach());
        self.trace.path().for_each(|(_, pose)| frame.include(pose.point(), 0.0));
        self.items().for_each(|(_, item)| include_item(&mut frame, &item));
        self.other_robots().for_each(|(_, item)| include_item(&mut frame, &item));
        if let Some(bounds) = self.scene.bounds {
            frame.include(bounds.low, 0.0);
            frame.include(bounds.high, 0.0);
        }
        frame.with_room(MARGIN)
    }
}

fn draw_item(svg: &mut Svg, id: u32, item: &Item) {
    let moves = item.movable().map(|(pose, ..)| pose);
    // With an outline, as it may lie on a floor of its color.
    let class = match moves {
        Some(_) => " class=\"thing\" stroke=\"#111\" stroke-width=\"0.7\"",
        None => "",
    };
    let name = &format!(" id=\"item{id}\"{class}");
    let color = item.traits().and_then(|traits| traits.color);
    let fill = color.map_or_else(|| "#987".to_owned(), |color| color.to_string());
    match item.shape() {
        Shape::Bar { from, to, thickness } => {
            let style = &format!("stroke=\"#444\" stroke-width=\"{thickness:.2}\"");
            svg.line(name, [from, to], style);
        }
        Shape::Box { pose, width, depth } => {
            let style = &format!("fill=\"{fill}\" {}", placed(pose));
            svg.rectangle(name, [-width / 2.0, -depth / 2.0], [width, depth], style);
        }
        Shape::Disc { center, radius } => {
            // What moves has its place in one attribute, so that a script can move it.
            let (center, place) = match moves {
                Some(pose) => ([0.0; 2], format!(" {}", placed(pose))),
                None => (center, String::new()),
            };
            let style = &format!("fill=\"{fill}\"{place}");
            svg.circle(name, center, &format!("{radius:.2}"), style);
        }
        Shape::Area { corners, color } => {
            let corners = points(corners);
            svg.add(format_args!("<polygon{name} points=\"{corners}\" fill=\"{color}\"/>"));
        }
        Shape::Band { points: line, width, color } => svg.add(format_args!(
            "<polyline{name} points=\"{}\" fill=\"none\" stroke=\"{color}\" \
             stroke-width=\"{width:.2}\" stroke-linejoin=\"round\" stroke-linecap=\"round\"/>",
            points(line)
        )),
        Shape::Mark { at, class, radius, fill, stroke } => {
            let name = format!("{name} class=\"{class}\"");
            let style = &format!("fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"0.5\"");
            svg.circle(&name, at, &radius.to_string(), style);
        }
    }
}

/// The attribute that puts something at a pose.
fn placed(Pose { x, y, heading }: Pose) -> String {
    format!("transform=\"translate({x:.2},{y:.2}) rotate({:.2})\"", -heading)
}

/// Jaws are the points between them and how far they are apart.
fn draw_robot(svg: &mut Svg, pose: Pose, hull: Hull, jaws: &[([f64; 2], f64)]) {
    svg.add(format_args!("<g class=\"robot\" {}>", placed(pose)));
    let style = "fill=\"#36c\" fill-opacity=\"0.6\" stroke=\"#036\" stroke-width=\"0.5\"";
    let nose = match hull {
        Hull::Circle { radius } => {
            svg.add(format_args!("<circle r=\"{radius:.2}\" {style}/>"));
            radius
        }
        Hull::Rectangle { width, length, offset } => {
            svg.rectangle("", [-width / 2.0, offset - length / 2.0], [width, length], style);
            offset + length / 2.0
        }
    };
    svg.add(format_args!(
        "<line x1=\"0\" y1=\"0\" x2=\"0\" y2=\"{nose:.2}\" stroke=\"#fff\" stroke-width=\"0.8\"/>"
    ));
    // As the page draws them: two arms, whose ends are as far apart as the jaws.
    for ([x, y], opening) in jaws {
        for side in [-1.0, 1.0] {
            let end = x + side * (opening / 2.0 + 0.5);
            let arm = [[x + 2.5 * side, (y - 7.0).max(0.0)], [end, y - 2.5], [end, y + 2.5]];
            svg.add(format_args!(
                "<polyline class=\"jaw\" points=\"{}\" fill=\"none\" stroke=\"#036\"/>",
                points(&arm)
            ));
        }
    }
    svg.add(format_args!("</g>"));
}
