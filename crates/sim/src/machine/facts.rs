//! The world as a file of facts.
use crate::machine::Machine;
use ev3_motion::{Bounds, Pose};

impl Machine {
    /// The world as a file of facts. It starts where the robot is now.
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
        for (name, Pose { x, y, heading }) in &scene.starts {
            let name = name.replace('\\', "\\\\").replace('\'', "\\'");
            facts.push(format!("start('{name}', {x}, {y}, {heading})"));
        }
        facts.extend(self.items().map(|(_, item)| item.fact()));
        facts.join(".\n") + ".\n"
    }
}
