//! Accesses of a program to the files of a simulation.
#![allow(dead_code)]

use ev3_sim::{Access, Simulation};

/// A file whose text does not matter.
pub(crate) const SOME: &str = "power_supply/lego-ev3-battery/voltage_now";

/// The text of a file, without its end of line.
pub(crate) fn read(simulation: &Simulation, path: &str) -> String {
    let node = simulation.open(path, Access::ReadOnly).unwrap();
    let mut buffer = [0; 256];
    let length = simulation.read(node, 0, &mut buffer).unwrap();
    String::from_utf8(buffer[..length].trim_ascii_end().to_vec()).unwrap()
}

/// Writes a text.
pub(crate) fn write(simulation: &Simulation, path: &str, text: &str) {
    let node = simulation.open(path, Access::WriteOnly).unwrap();
    simulation.write(node, 0, text.as_bytes()).unwrap().0.outcome.unwrap();
}
