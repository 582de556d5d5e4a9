//! The driver's PID regulator, used for speed and, with other constants, for holding.

/// A regulator in 32-bit integers: constants are in units of 1/10000 % duty.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pid {
    pub(crate) kp: i32,
    pub(crate) ki: i32,
    pub(crate) kd: i32,
    integral: i32,
    previous: i32,
}

/// The output of a regulator for an error.
pub(crate) struct Output {
    /// −100…100 %.
    pub(crate) duty: i32,
    /// The result was beyond ±100 % before it was clamped.
    pub(crate) overloaded: bool,
}

impl Pid {
    pub(crate) const fn new(kp: i32, ki: i32, kd: i32) -> Self {
        Pid { kp, ki, kd, integral: 0, previous: 0 }
    }

    /// Forgets the past.
    pub(crate) fn clear(&mut self) {
        self.integral = 0;
        self.previous = 0;
    }

    /// One sample. The difference term has the sign opposite to the usual one, and a result
    /// beyond ±100 % takes its error out of the integral again: both as the kernel does.
    pub(crate) fn update(&mut self, error: i32) -> Output {
        self.integral = self.integral.wrapping_add(error);
        let difference = self.previous.wrapping_sub(error);
        self.previous = error;
        let sum = self
            .kp
            .wrapping_mul(error)
            .wrapping_add(self.ki.wrapping_mul(self.integral))
            .wrapping_add(self.kd.wrapping_mul(difference));
        let duty = sum / 10_000;
        let overloaded = !(-100..=100).contains(&duty);
        if overloaded {
            self.integral = self.integral.wrapping_sub(error);
        }
        Output { duty: duty.clamp(-100, 100), overloaded }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_of_1000_alone_is_full_duty_and_does_not_wind_up() {
        let mut pid = Pid::new(1000, 60, 0);
        let output = pid.update(1000);
        assert_eq!((output.duty, output.overloaded), (100, true));
        assert_eq!(pid.integral, 0);
        let output = pid.update(100);
        assert_eq!((output.duty, output.overloaded), (10, false));
        assert_eq!(pid.integral, 100);
    }
}
