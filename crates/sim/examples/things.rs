//! What things that robots push cost: the processor's time of a driving robot among them, as a
//! ratio to the same robot alone. Other programs can make a run longer, so the shortest one of each
//! counts.
//!
//! `cargo run --release -p ev3-sim --example things`

#[path = "../tests/it/robots.rs"]
mod robots;

use ev3_sim::{Item, Machine, Options, Pose, Traits, WorldSpec};
use robots::default_robot;
use rustix::time::{ClockId, clock_gettime};
use std::time::Duration;

const RUNS: usize = 15;

fn square(x: f64, y: f64, kg: f64) -> Item {
    let traits = Traits { mass: Some(kg), ..Traits::default() };
    Item::Box { pose: Pose::new(x, y, 0.0), width: 6.0, depth: 6.0, traits }
}

fn world(name: &str) -> Vec<Item> {
    let grid = |x0: f64, y0: f64, gap: f64, kg: f64| {
        (0..20u32)
            .map(move |i| square(x0 + f64::from(i % 4) * gap, y0 + f64::from(i / 4) * gap, kg))
    };
    match name {
        "20 resting" => grid(100.0, 20.0, 12.0, 0.05).collect(),
        "one pushed" => vec![square(0.0, 20.0, 0.05)],
        "a heap of 20 pushed" => grid(-9.3, 20.0, 6.2, 0.01).collect(),
        _ => Vec::new(),
    }
}

/// How long this thread has computed so far, in seconds. A clock of the wall would count other
/// programs, too.
fn computed() -> f64 {
    let time = clock_gettime(ClockId::ThreadCPUTime);
    Duration::try_from(time).expect("a time above 0").as_secs_f64()
}

/// Seconds of the processor for 4 simulated seconds, from the second on.
fn seconds(items: Vec<Item>) -> f64 {
    let world = WorldSpec { items, ..WorldSpec::default() };
    let mut machine = Machine::new(&world, &default_robot(), Options::default()).expect("a world");
    for motor in ["tacho-motor/motor1", "tacho-motor/motor2"] {
        machine.write_path(&format!("{motor}/speed_sp"), "400").expect("a legal speed");
        machine.write_path(&format!("{motor}/command"), "run-forever").expect("a legal command");
    }
    machine.step(Duration::from_secs(1));
    let start = computed();
    machine.step(Duration::from_secs(4));
    computed() - start
}

fn main() {
    let names = ["alone", "20 resting", "one pushed", "a heap of 20 pushed"];
    let mut shortest = [f64::INFINITY; 4];
    for _ in 0..RUNS {
        for (name, shortest) in names.iter().zip(&mut shortest) {
            *shortest = shortest.min(seconds(world(name)));
        }
    }
    for (name, time) in names.iter().zip(shortest) {
        println!("{name}: {:.0} us a simulated second, {:.2}", time / 4e-6, time / shortest[0]);
    }
}
