//! The H-bridge of an output port. It belongs to the port and not to the motor's driver: pins and
//! PWM stay as they are when one driver goes and another comes, and a driver writes only one of
//! them when it has nothing to say about the other.

/// The state of the H-bridge at a motor's two wires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Bridge {
    /// Both pins low: the motor coasts.
    Float,
    /// Both pins high: the winding is shorted and brakes.
    Short,
    /// PWM, −100…100 %. 0 % brakes like a short here; what the real bridge does is not known.
    Driven(i32),
}

/// The two pins that give the direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Pins {
    /// Both low.
    #[default]
    Coast,
    /// Both high.
    Brake,
    Forward,
    Reverse,
}

/// What a port gives to its wires.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Output {
    pub(crate) pins: Pins,
    /// The PWM, 0 to 100 %. Without a direction it has no effect.
    pub(crate) percent: i32,
}

impl Output {
    /// Sets the pins, and the PWM to a duty whose sign is theirs. The PWM does not take a duty
    /// beyond 100 %.
    pub(crate) fn drive(&mut self, pins: Pins, duty: i32) {
        self.pins = pins;
        if (-100..=100).contains(&duty) {
            self.percent = duty.abs();
        }
    }

    pub(crate) fn is_driving(self) -> bool {
        matches!(self.pins, Pins::Forward | Pins::Reverse)
    }

    /// The PWM with the sign of the direction.
    pub(crate) fn duty(self) -> i32 {
        if self.pins == Pins::Reverse { -self.percent } else { self.percent }
    }

    pub(crate) fn bridge(self) -> Bridge {
        match self.pins {
            Pins::Coast => Bridge::Float,
            Pins::Brake => Bridge::Short,
            Pins::Forward | Pins::Reverse => Bridge::Driven(self.duty()),
        }
    }
}
