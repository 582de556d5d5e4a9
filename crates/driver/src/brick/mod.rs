//! The brick's own devices: lights, battery, buttons, sound, screen, ports.
pub mod battery;
pub mod buttons;
pub mod light;
pub mod port;
mod programs;
mod recorded;
pub mod screen;
pub mod sound;
