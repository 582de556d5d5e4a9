//! The driver over real files in temporary directories, and over a small
//! kernel with a clock of its own.
mod attributes;
mod brick;
mod dev;
mod devices;
mod files;
mod laws;
mod motors;
mod sensors;
mod turns;
mod waits;
