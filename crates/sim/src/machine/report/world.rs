//! What stands and lies in the world.

use ev3_json::Json;

use super::{FINE, place};
use crate::machine::Machine;
use crate::machine::svg::Frame;
use crate::world::geometry::Pose;
use crate::world::{Bounds, Item, ItemId, Point};

impl Machine {
    /// The members of an object that describe the world: bounds, floor, items, and the rectangle
    /// that has all of it in it.
    pub fn report_world(&self, json: &mut Json) {
        json.key("bounds");
        match self.scene.bounds {
            Some(bounds) => json.numbers(bounds.low.into_iter().chain(bounds.high), FINE),
            None => json.null(),
        }
        let Frame { low, high } = self.frame();
        json.key("view").numbers(low.into_iter().chain(high), 1);
        json.key("floor").text(&self.scene.floor.to_string());
        json.key("items").array(|json| {
            for (id, item) in self.scene.items() {
                json.object(|json| report_item(json, *id, item));
            }
        });
    }
}

impl Machine {
    /// The world as a file of facts. It starts where the robot is now.
    #[must_use]
    pub fn world_facts(&self) -> String {
        let scene = &self.scene;
        let mut facts = Vec::new();
        if let Some(Bounds { low: [x1, y1], high: [x2, y2] }) = scene.bounds {
            facts.push(format!("bounds({x1}, {y1}, {x2}, {y2})"));
        }
        facts.push(format!("floor('{}')", scene.floor));
        facts.push(format!("ambient({})", scene.ambient));
        facts.push(format!("temperature({})", scene.temperature));
        facts.push(format!("loudness({})", scene.loudness));
        let Pose { x, y, heading } = self.pose();
        facts.push(format!("start({x:.2}, {y:.2}, {heading:.1})"));
        facts.extend(scene.items().iter().map(|(_, item)| fact(item)));
        facts.join(".\n") + ".\n"
    }
}

/// An item as a fact that can be read back.
fn fact(item: &Item) -> String {
    let list = |points: &[Point]| {
        // A minus before a number needs a space before it.
        let place = |[x, y]: &Point| {
            if y.is_sign_negative() { format!("{x} - {y}") } else { format!("{x}-{y}") }
        };
        points.iter().map(place).collect::<Vec<_>>().join(", ")
    };
    match item {
        Item::Patch { corners, color } => format!("patch('{color}', [{}])", list(corners)),
        Item::Line { points, width, color } => {
            format!("line('{color}', {width}, [{}])", list(points))
        }
        item => item.to_string(),
    }
}

fn report_item(json: &mut Json, id: ItemId, item: &Item) {
    let point = |json: &mut Json, at: &Point| json.numbers(*at, FINE);
    json.key("id").integer(id.0.into());
    json.key("kind").text(item.kind());
    match item {
        Item::Wall { from, to, thickness } => {
            point(json.key("from"), from);
            point(json.key("to"), to);
            json.key("thickness").number(*thickness, FINE);
        }
        Item::Box { pose, width, depth } => {
            place(json, pose);
            json.key("w").number(*width, FINE);
            json.key("d").number(*depth, FINE);
            json.key("h").number(pose.heading, FINE);
        }
        Item::Circle { center: [x, y], radius } => {
            place(json, &Pose::new(*x, *y, 0.0));
            json.key("r").number(*radius, FINE);
        }
        Item::Patch { corners, color } => {
            json.key("color").text(&color.to_string());
            json.key("points").array(|json| corners.iter().for_each(|at| point(json, at)));
        }
        Item::Line { points, width, color } => {
            json.key("color").text(&color.to_string());
            json.key("width").number(*width, FINE);
            json.key("points").array(|json| points.iter().for_each(|at| point(json, at)));
        }
        Item::Lamp { at: [x, y], intensity } => {
            place(json, &Pose::new(*x, *y, 0.0));
            json.key("intensity").number(*intensity, FINE);
        }
        Item::Bulb { at: [x, y], intensity, port } => {
            place(json, &Pose::new(*x, *y, 0.0));
            json.key("intensity").number(*intensity, FINE);
            json.key("port").text(port.name());
        }
        Item::Beacon { at: [x, y], channel } => {
            place(json, &Pose::new(*x, *y, 0.0));
            json.key("channel").integer((*channel).into());
        }
    }
}
