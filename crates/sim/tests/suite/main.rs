//! The simulator through its files, as a program sees it.

mod attributes;
mod desk;
mod motors;
