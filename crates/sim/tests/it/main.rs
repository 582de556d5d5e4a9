//! The simulator through its files, as a program sees it.

mod attributes;
mod avoid;
mod braitenberg;
mod dc_motors;
mod desk;
mod encoders;
mod golden;
mod linear;
mod more_sensors;
mod motion;
mod motors;
mod panel;
mod plugs;
mod properties;
mod robots;
mod sensors;
mod servos;
mod shown;
mod things;
mod walls;
mod world;
