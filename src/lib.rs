//! Foreign library of the pack `ev3dev`.
