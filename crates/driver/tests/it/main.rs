//! The driver over real files in temporary directories, and over a small
//! kernel with a clock of its own.
mod attributes;
mod boards;
mod brick;
mod dev;
mod devices;
mod drives;
mod files;
mod journal;
mod laws;
mod motors;
mod moves;
mod odometry;
mod paths;
mod registers;
mod sensors;
mod several;
mod waits;
