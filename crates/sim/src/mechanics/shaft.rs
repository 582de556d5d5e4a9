//! A motor's output shaft: where it is, how fast it turns, what its motor does to it.
use crate::brick::output::Bridge;
use crate::mechanics::Load;
use crate::motor::{Encoder, MOTOR_KINDS, MotorKind, RATED_VOLTS};
use crate::noise::Teeth;
use crate::ticks::TICK_SECONDS;

/// One of the four shafts. It is there even when no wire is plugged in.
#[derive(Clone, Debug)]
pub(crate) struct Shaft {
    pub(crate) kind: &'static MotorKind,
    /// Degrees, in the motor's own direction.
    pub(crate) angle: f64,
    /// Radians per second.
    pub(crate) omega: f64,
    pub(crate) jammed: bool,
    /// The angles that it cannot turn beyond.
    stops: Option<[f64; 2]>,
    /// What its gripper holds stops it there.
    pub(crate) blocked: Option<f64>,
    /// The brick's counter for this port.
    pub(crate) encoder: Encoder,
}

impl Shaft {
    pub(crate) fn new(teeth: Teeth, stops: Option<[f64; 2]>) -> Shaft {
        Shaft {
            kind: &MOTOR_KINDS[0],
            angle: 0.0,
            omega: 0.0,
            jammed: false,
            stops,
            blocked: None,
            encoder: Encoder::new(teeth),
        }
    }

    /// A motor is plugged in. One that turns goes on from where the shaft is; a linear actuator
    /// comes drawn in.
    pub(crate) fn connect(&mut self, kind: &'static MotorKind) {
        self.kind = kind;
        if kind.travel.is_some() {
            (self.angle, self.omega) = (0.0, 0.0);
        }
    }

    /// The effect of the bridge at the battery's voltage: torques on the shaft, and the current it
    /// draws. `strength` is the motor's own error, 1 for none; `jitter` is in % duty.
    pub(crate) fn load(
        &self,
        bridge: Bridge,
        volts: f64,
        strength: f64,
        jitter: f64,
    ) -> (Load, f64) {
        let kind = self.kind;
        let mut load = Load {
            torque: 0.0,
            damping: kind.damping(),
            friction: kind.friction,
            inertia: kind.inertia,
            jammed: self.jammed,
        };
        match bridge {
            Bridge::Float => load.damping = 0.0,
            Bridge::Short | Bridge::Driven(0) => {}
            Bridge::Driven(duty) => {
                let share = (f64::from(duty) * strength + jitter).clamp(-100.0, 100.0) / 100.0;
                load.torque = kind.stall_torque * share * volts / RATED_VOLTS;
                let used = (load.torque - load.damping * self.omega) / kind.stall_torque;
                return (load, (used * share).abs() * kind.stall_current);
            }
        }
        (load, 0.0)
    }

    /// Turns for one tick at its present speed. The counter follows while the wire is in.
    pub(crate) fn turn(&mut self, wired: bool, tick_start_us: u64) {
        let mut next = self.angle + self.omega.to_degrees() * TICK_SECONDS;
        let travel = self.kind.travel.map(|travel| [0.0, f64::from(travel)]);
        if let Some([low, high]) = travel.or(self.stops) {
            let high = self.blocked.map_or(high, |blocked| high.min(blocked));
            if !(low..=high).contains(&next) {
                next = next.clamp(low, high);
                self.omega = 0.0;
            }
        }
        if wired {
            self.encoder.turn(self.angle, next, tick_start_us);
        } else {
            self.encoder.rest(tick_start_us);
        }
        self.angle = next;
    }

    /// How far it is from its lower stop to its upper one: 0 to 1. `None` if it has no stops.
    pub(crate) fn share(&self) -> Option<f64> {
        self.stops.map(|[low, high]| (self.angle - low) / (high - low))
    }

    /// Time passes without any motion.
    pub(crate) fn rest(&mut self, tick_start_us: u64) {
        self.encoder.rest(tick_start_us);
    }
}
