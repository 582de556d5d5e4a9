//! The gears between motors and what they drive.
use ev3_os::locked;
use std::sync::Mutex;

/// How many times a motor turns while what it drives turns once, by the motor's port: the
/// robot is built so, whichever motor is plugged in.
#[derive(Default)]
pub(crate) struct Gears(Mutex<Vec<(Box<str>, f64)>>);

impl Gears {
    /// The ratio at a port: 1 until it is set.
    pub(crate) fn of(&self, port: &str) -> f64 {
        let all = locked(&self.0);
        all.iter().find(|(at, _)| **at == *port).map_or(1.0, |(_, ratio)| *ratio)
    }

    pub(crate) fn set(&self, port: &str, ratio: f64) {
        let mut all = locked(&self.0);
        all.retain(|(at, _)| **at != *port);
        all.push((port.into(), ratio));
    }
}
