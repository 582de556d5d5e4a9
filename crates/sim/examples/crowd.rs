//! The speed of a simulation of several robots in one world: each drives, and reads its ultrasonic
//! sensor 50 times a second. Prints the number of robots, simulated seconds in a second of the
//! processor, and microseconds for a tick of one robot.
//!
//! ```sh
//! cargo run --release -p ev3-sim --example crowd
//! ```
use ev3_sim::{Bounds, Clock, Machine, Options, Pose, Simulation, WorldSpec};
use std::fs;
use std::time::Duration;

#[path = "../tests/it/robots.rs"]
mod robots;

/// Ticks of 2 ms in a second.
const TICKS: f64 = 500.0;

/// What this thread has used of a processor.
fn used() -> Duration {
    let text = fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|first| first.parse().ok());
    Duration::from_nanos(nanoseconds.unwrap_or_default())
}

/// Robots on a square of this many a side, 60 cm apart.
fn crowd(count: u32) -> Vec<Simulation> {
    let side = f64::from(count).sqrt().ceil();
    let half = side * 30.0 + 20.0;
    let bounds = Some(Bounds { low: [-half, -half], high: [half, half] });
    let machine = |index: u32| {
        let (row, column) = ((f64::from(index) / side).floor(), f64::from(index) % side);
        let place = |at: f64| (at - (side - 1.0) / 2.0) * 60.0;
        let start = Pose::new(place(column), place(row), f64::from(index) * 37.0);
        let world = WorldSpec { bounds, start, ..WorldSpec::default() };
        Machine::new(&world, &robots::default_robot(), Options::default())
    };
    let machines: Result<Vec<_>, _> = (0..count).map(machine).collect();
    let simulations =
        machines.map(|machines| Simulation::crowd(machines, Clock::Virtual, || false));
    simulations.ok().and_then(Result::ok).and_then(Result::ok).unwrap_or_default()
}

fn main() {
    for count in [1, 2, 10, 50, 200] {
        let crowd = crowd(count);
        for (simulation, index) in crowd.iter().zip(0..) {
            let mut machine = simulation.machine();
            for (motor, speed) in [("motor1", 300), ("motor2", 300 - index % 5 * 20)] {
                let file = |name: &str| format!("tacho-motor/{motor}/{name}");
                let _ = machine.write_path(&file("speed_sp"), &speed.to_string());
                let _ = machine.write_path(&file("command"), "run-forever");
            }
        }
        let seconds = (200 / count).clamp(4, 60);
        let begin = used();
        for _ in 0..seconds * 50 {
            for simulation in &crowd {
                let _ = simulation.machine().read_path("lego-sensor/sensor0/value0");
            }
            if let Some(first) = crowd.first() {
                first.step(Duration::from_millis(20));
            }
        }
        let took = used().saturating_sub(begin).as_secs_f64();
        let rate = f64::from(seconds) / took;
        let tick = 1e6 / (rate * TICKS * f64::from(count));
        println!("{count} {rate:.1} {tick:.2}");
    }
}
