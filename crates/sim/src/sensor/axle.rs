//! The counts of an angle sensor.

/// An axle that an angle sensor sits on, in degrees and degrees per second.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Axle {
    angle: f64,
    zero: f64,
    counted_from: f64,
    pub(crate) rate: f64,
}

impl Axle {
    /// Since the sensor was plugged in, or calibrated.
    pub(crate) fn angle(&self) -> f64 {
        self.angle - self.zero
    }

    /// Since the last reset.
    pub(crate) fn turned(&self) -> f64 {
        self.angle - self.counted_from
    }

    pub(super) fn turn(&mut self, rate: f64, seconds: f64) {
        self.rate = rate;
        self.angle += rate * seconds;
    }

    /// Counts turns from here.
    pub(super) fn reset(&mut self) {
        self.counted_from = self.angle;
    }

    /// Counts turns and the angle from here.
    pub(super) fn calibrate(&mut self) {
        self.reset();
        self.zero = self.angle;
    }
}
