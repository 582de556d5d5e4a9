//! The driver's PID regulator, used for speed and, with other constants, for holding.

/// A regulator in 32-bit integers: constants are in units of 1/10000 % duty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pid {
    pub(crate) kp: i32,
    pub(crate) ki: i32,
    pub(crate) kd: i32,
    pub(crate) setpoint: i32,
    /// The last result was beyond ±100 % before it was clamped.
    pub(crate) overloaded: bool,
    integral: i32,
    previous: i32,
}

impl Pid {
    pub(crate) const fn new(kp: i32, ki: i32, kd: i32) -> Self {
        Pid { kp, ki, kd, setpoint: 0, overloaded: false, integral: 0, previous: 0 }
    }

    /// Forgets all but its constants.
    pub(crate) fn clear(&mut self) {
        *self = Pid::new(self.kp, self.ki, self.kd);
    }

    /// The duty for what was measured, −100…100 %. The difference term has the sign opposite to
    /// the usual one, and a result beyond ±100 % takes its error out of the integral again: both
    /// as the kernel does.
    pub(crate) fn update(&mut self, measured: i32) -> i32 {
        let error = self.setpoint.wrapping_sub(measured);
        self.integral = self.integral.wrapping_add(error);
        let difference = self.previous.wrapping_sub(error);
        self.previous = error;
        let sum = self
            .kp
            .wrapping_mul(error)
            .wrapping_add(self.ki.wrapping_mul(self.integral))
            .wrapping_add(self.kd.wrapping_mul(difference));
        let duty = sum / 10_000;
        self.overloaded = !(-100..=100).contains(&duty);
        if self.overloaded {
            self.integral = self.integral.wrapping_sub(error);
        }
        duty.clamp(-100, 100)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_1000_alone_is_full_duty_and_does_not_wind_up() {
        let mut pid = Pid { setpoint: 1000, ..Pid::new(1000, 60, 0) };
        assert_eq!((pid.update(0), pid.overloaded), (100, true));
        assert_eq!(pid.integral, 0);
        assert_eq!((pid.update(900), pid.overloaded), (10, false));
        assert_eq!(pid.integral, 100);
    }
}
