//! One long run whose every byte is fixed: the same on each machine, build and day.
use crate::desk::{B, C, Desk, furnished};
use crate::robots::default_robot;
use ev3_sim::{Machine, Options};
use std::fmt::Write;

/// FNV-1a: small, and the same everywhere.
pub(crate) fn digest(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// Drives about the noisy room for a minute, turning away from what is near.
fn run() -> Vec<u8> {
    let robot = default_robot().with_typical_noise();
    let options = Options { seed: 42, ..Options::default() };
    let mut desk = Desk(Machine::new(&furnished(), &robot, options).unwrap());
    let mut bytes = String::new();
    for step in 0..1200 {
        let distance = desk.number("lego-sensor/sensor0/value0");
        let (left, right) = if distance < 300 { (200, -150) } else { (420, 400) };
        desk.run(B, &[("speed_sp", left)], "run-forever");
        desk.run(C, &[("speed_sp", right)], "run-forever");
        desk.step(50);
        if step % 10 == 0 {
            for class in ["tacho-motor", "lego-sensor", "lego-port", "leds", "power_supply"] {
                let class = desk.0.resolve(class).unwrap();
                for device in desk.0.read_dir(class).unwrap() {
                    for file in desk.0.read_dir(device.node).unwrap() {
                        let text = desk.0.read(file.node);
                        writeln!(bytes, "{} {} {text:?}", device.name, file.name).unwrap();
                    }
                }
            }
        }
    }
    let pose = desk.0.pose();
    let bits = [pose.x, pose.y, pose.heading].map(f64::to_bits);
    writeln!(bytes, "{bits:?}").unwrap();
    bytes.into_bytes()
}

#[test]
fn a_golden_run() {
    let bytes = run();
    assert_eq!(bytes, run(), "twice the same");
    assert_eq!(format!("{:016x}", digest(&bytes)), "4bc9d0bec50cfdda");
}
