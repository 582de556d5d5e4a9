//! The driver over real files in temporary directories, and over a small
//! kernel with a clock of its own.
mod attributes;
mod brick;
mod devices;
mod files;
mod laws;
mod motors;
mod odometry;
mod paths;
mod sensors;
mod turns;
mod waits;
