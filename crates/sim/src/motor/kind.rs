//! The motors of the EV3 set and their figures.

/// A type of tacho motor. Torques and speeds are at the output hub, behind the gears. Of a linear
/// actuator they are those of a hub that turns by a degree for each count.
#[derive(Debug, PartialEq)]
pub struct MotorKind {
    /// Name of the driver, as in `driver_name`.
    pub driver_name: &'static str,
    /// `max_speed`: the no-load speed at 9 V in counts (degrees) per second. From the kernel's
    /// motor table.
    pub max_speed: i32,
    /// `hold_pid/Kp` after a reset. From the kernel's motor table.
    pub hold_kp: i32,
    /// Torque at standstill and 9 V, in N m. LEGO publishes 0.42 (large: "stall torque 40 N cm"
    /// and up), 0.12 (medium) and 0.50 (NXT).
    pub stall_torque: f64,
    /// Dry friction of gears and bearings, in N m. Chosen so that a large motor starts to turn
    /// at about 5 % duty, as the sets do.
    pub friction: f64,
    /// Rotor inertia seen through the gears, in kg m². Chosen so that a free large motor reaches
    /// its speed with a time constant of about 60 ms, a medium one faster.
    pub inertia: f64,
    /// Current at standstill and 9 V, in A. About 1.8 (large), 0.8 (medium), 2.0 (NXT), as
    /// measured and published by builders.
    pub stall_current: f64,
    /// `full_travel_count` of a linear actuator: it moves between 0 and that. From the kernel's
    /// motor table.
    pub travel: Option<i32>,
}

/// `count_per_m` of the linear actuators.
pub(crate) const COUNT_PER_M: i32 = 2000;

/// An Actuonix L12 with a stroke of `travel` counts. By its data sheet, its screw holds it without
/// voltage, and it takes 0.46 A when it is blocked.
const fn linear(driver_name: &'static str, travel: i32) -> MotorKind {
    MotorKind {
        driver_name,
        max_speed: 24,
        hold_kp: 40_000,
        stall_torque: 0.5,
        friction: 0.05,
        inertia: 0.054,
        stall_current: 0.46,
        travel: Some(travel),
    }
}

/// The voltage at which the motor figures hold.
pub(crate) const RATED_VOLTS: f64 = 9.0;

/// Every motor type that a simulated port can have.
pub static MOTOR_KINDS: [MotorKind; 5] = [
    MotorKind {
        driver_name: "lego-ev3-l-motor",
        max_speed: 1050,
        hold_kp: 80_000,
        stall_torque: 0.42,
        friction: 0.020,
        inertia: 0.0014,
        stall_current: 1.8,
        travel: None,
    },
    MotorKind {
        driver_name: "lego-ev3-m-motor",
        max_speed: 1560,
        hold_kp: 160_000,
        stall_torque: 0.12,
        friction: 0.008,
        inertia: 0.000_18,
        stall_current: 0.8,
        travel: None,
    },
    MotorKind {
        driver_name: "lego-nxt-motor",
        max_speed: 1020,
        hold_kp: 80_000,
        stall_torque: 0.50,
        friction: 0.022,
        inertia: 0.0016,
        stall_current: 2.0,
        travel: None,
    },
    linear("act-l12-ev3-50", 100),
    linear("act-l12-ev3-100", 200),
];

impl MotorKind {
    /// The motor with this driver name.
    pub fn named(driver_name: &str) -> Option<&'static MotorKind> {
        MOTOR_KINDS.iter().find(|kind| kind.driver_name == driver_name)
    }

    /// Back-EMF and copper losses together: how much torque a rad/s costs, in N m s.
    pub(crate) fn damping(&self) -> f64 {
        (self.stall_torque - self.friction) / f64::from(self.max_speed).to_radians()
    }
}
