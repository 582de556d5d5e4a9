//! The brick's library has no simulator: none runs.
use ev3_sim::{ItemId, Simulation};
use std::sync::Arc;

pub(crate) fn watched_simulation() -> Option<Arc<Simulation>> {
    None
}

pub(crate) fn running_simulations() -> Vec<Arc<Simulation>> {
    Vec::new()
}

pub(crate) fn robot_name(_id: ItemId) -> Option<String> {
    None
}

pub(crate) fn has_virtual_clock(_brick: u32) -> bool {
    false
}

pub(crate) fn end_unless_mounted() {}

pub(crate) fn end_of(_brick: u32) {}
