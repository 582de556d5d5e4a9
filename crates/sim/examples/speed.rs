//! The simulated seconds that pass in a second of wall time, with a program that polls.
//!
//! `cargo run --release -p ev3-sim --example speed [-- SECONDS]`

#[path = "../tests/it/robots.rs"]
mod robots;

use ev3_sim::{Access, Bounds, Descriptor, Item, Machine, NodeId, Options, Pose, WorldSpec};
use robots::default_robot;
use std::time::{Duration, Instant};

const POLL: Duration = Duration::from_millis(10);

fn number(machine: &mut Machine, file: &mut Descriptor) -> i32 {
    let mut buffer = [0; 32];
    let length = file.pread(machine, 0, &mut buffer).expect("the device stays plugged in");
    let text = std::str::from_utf8(&buffer[..length]).unwrap_or("0");
    text.trim().parse().unwrap_or(0)
}

fn drive(
    machine: &mut Machine,
    commands: [NodeId; 2],
    speeds: [NodeId; 2],
    left: &str,
    right: &str,
) {
    for (node, speed) in speeds.into_iter().zip([left, right]) {
        machine.write(node, speed.as_bytes()).expect("a legal speed");
    }
    for node in commands {
        machine.write(node, b"run-forever").expect("a legal command");
    }
}

fn main() {
    let seconds = std::env::args().nth(1).and_then(|text| text.parse().ok());
    let simulated = Duration::from_secs(seconds.unwrap_or(600));
    let world = WorldSpec {
        items: vec![Item::boxed(Pose::new(110.0, 110.0, 20.0), 40.0, 30.0)],
        bounds: Some(Bounds { low: [0.0, 0.0], high: [300.0, 240.0] }),
        start: Pose::new(60.0, 50.0, 0.0),
        ..WorldSpec::default()
    };
    let mut machine =
        Machine::new(&world, &default_robot(), Options::default()).expect("a possible world");
    let open = |machine: &Machine, path: &str, access| machine.open(path, access).expect(path);
    let file = |machine: &Machine, path| Descriptor::new(open(machine, path, Access::ReadOnly));
    let mut eyes = file(&machine, "lego-sensor/sensor0/value0");
    let mut color = file(&machine, "lego-sensor/sensor1/value0");
    let mut gyro = file(&machine, "lego-sensor/sensor3/value0");
    let mut state = file(&machine, "tacho-motor/motor1/state");
    let node = |machine: &Machine, path: &str| open(machine, path, Access::WriteOnly);
    let commands = ["tacho-motor/motor1/command", "tacho-motor/motor2/command"]
        .map(|path| node(&machine, path));
    let speeds = ["tacho-motor/motor1/speed_sp", "tacho-motor/motor2/speed_sp"]
        .map(|path| node(&machine, path));

    let start = Instant::now();
    let mut turning = true;
    while machine.now() < simulated {
        let near = number(&mut machine, &mut eyes) < 500;
        number(&mut machine, &mut color);
        number(&mut machine, &mut gyro);
        let mut text = [0; 64];
        state.pread(&mut machine, 0, &mut text).expect("the motor stays plugged in");
        if near != turning {
            turning = near;
            let (left, right) = if near { ("200", "-200") } else { ("500", "500") };
            drive(&mut machine, commands, speeds, left, right);
        }
        machine.step(POLL);
    }
    let wall = start.elapsed().as_secs_f64();
    println!(
        "{:.0} simulated seconds per wall second; {} collisions; ends at {:?}",
        simulated.as_secs_f64() / wall,
        machine.trace().collision_count(),
        machine.pose()
    );
}
