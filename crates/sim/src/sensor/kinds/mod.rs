//! All types of sensors that a simulated port can have.
mod ev3;
mod nxt;
mod others;

use super::kind::SensorKind;

impl SensorKind {
    /// The sensor with this driver name.
    pub fn named(driver_name: &str) -> Option<&'static SensorKind> {
        SensorKind::all().find(|kind| kind.driver_name == driver_name)
    }

    /// Every sensor type that a simulated port can have.
    pub fn all() -> impl Iterator<Item = &'static SensorKind> + Clone {
        ev3::KINDS.iter().chain(nxt::KINDS).chain(others::KINDS)
    }
}
