//! LEGO's sensors for the NXT, and others that only give a voltage: `docs/ev3dev-sysfs.md`, 5.5.
//! How each mode shows the raw data is from the kernel's `nxt_analog_sensor_defs.c` and
//! `nxt_i2c_sensor_defs.c`.
use crate::sensor::format::{Format, Scale};
use crate::sensor::kind::{Link, Mode, Sense, SensorKind};

/// A mode of 32 bits, as the analog drivers have them.
const fn analog(
    name: &'static str,
    values: usize,
    decimals: u8,
    units: &'static str,
    sense: Sense,
) -> Mode {
    Mode::new(name, values, decimals, units, Format::S32, sense)
}

const fn sonar(name: &'static str, inches: bool, single: bool) -> Mode {
    let sense = Sense::NxtDistance { inches, single };
    if inches {
        Mode::new(name, 1, 1, "in", Format::U8, sense).scaled([0, 255], [0, 1000])
    } else {
        Mode::new(name, 1, 0, "cm", Format::U8, sense)
    }
}

const fn temperature(
    name: &'static str,
    units: &'static str,
    fahrenheit: bool,
    shown: [i32; 2],
) -> Mode {
    let sense = Sense::Temperature { per_degree: 10, fahrenheit };
    Mode::new(name, 1, 1, units, Format::S16Be, sense).scaled([-14080, 32767], shown)
}

/// LEGO's energy meter with nothing connected: no volts, amperes or watts, and 50 J left.
const fn energy(name: &'static str, units: &'static str) -> Mode {
    Mode::new(name, 1, 3, units, Format::S16, Sense::Fixed(&[0]))
}

pub(super) static KINDS: &[SensorKind] = &[
    SensorKind::nxt_analog(
        "nxt-analog",
        &[analog("ANALOG-0", 1, 3, "V", Sense::Pin), analog("ANALOG-1", 1, 3, "V", Sense::Pin)],
    ),
    SensorKind {
        driver_name: "lego-nxt-touch",
        link: Link::NxtAnalog { recognized: true },
        settling_ms: 0,
        commands: &[],
        modes: &[analog("TOUCH", 1, 0, "", Sense::Touch).shown_by(Scale::Below(4800))],
    },
    SensorKind {
        driver_name: "lego-nxt-light",
        link: Link::NxtAnalog { recognized: true },
        settling_ms: 0,
        commands: &[],
        modes: &[
            analog("REFLECT", 1, 1, "pct", Sense::FineReflection).scaled([4116, 543], [0, 1000]),
            analog("AMBIENT", 1, 1, "pct", Sense::FineAmbient).scaled([4164, 773], [0, 1000]),
        ],
    },
    SensorKind::nxt_analog(
        "lego-nxt-sound",
        &[
            analog("DB", 1, 1, "pct", Sense::Silence).scaled([0, 5000], [0, 1000]),
            analog("DBA", 1, 1, "pct", Sense::Silence).scaled([0, 5000], [0, 1000]),
        ],
    ),
    SensorKind::nxt_analog("di-dflex", &[analog("FLEX", 1, 0, "", Sense::Fixed(&[0]))]),
    SensorKind::nxt_analog(
        "ht-nxt-eopd",
        &[
            analog("LONG", 1, 0, "", Sense::Reflector { reach: 350 }).shown_by(Scale::Root),
            analog("SHORT", 1, 0, "", Sense::Reflector { reach: 70 }).shown_by(Scale::Root),
        ],
    ),
    SensorKind::nxt_analog(
        "ht-nxt-force",
        &[analog("FORCE", 1, 0, "", Sense::Fixed(&[0])).scaled([0, 5000], [0, 1023])],
    ),
    SensorKind::nxt_analog(
        "ht-nxt-gyro",
        &[analog("GYRO", 1, 0, "d/s", Sense::RateWithin { per_degree: 1, limits: [-540, 400] })
            .scaled([0, 4880], [-540, 400])],
    ),
    SensorKind::nxt_analog(
        "ht-nxt-mag",
        &[analog("MAG", 1, 0, "", Sense::Fixed(&[512])).scaled([0, 5000], [0, 1023])],
    ),
    // The bumper is its first button; there are no others.
    SensorKind::nxt_analog(
        "ms-nxt-touch-mux",
        &[analog("TOUCH-MUX", 3, 0, "", Sense::Touch).shown_by(Scale::Within(3859, 4194))],
    ),
    SensorKind::i2c(
        "lego-nxt-us",
        1,
        &[
            sonar("US-DIST-CM", false, false),
            sonar("US-DIST-IN", true, false),
            sonar("US-SI-CM", false, true),
            sonar("US-SI-IN", true, true),
            Mode::new("US-LISTEN", 1, 0, "", Format::U8, Sense::Nothing),
        ],
    ),
    SensorKind::i2c(
        "lego-nxt-temp",
        76,
        &[
            temperature("NXT-TEMP-C", "C", false, [-550, 1280]),
            temperature("NXT-TEMP-F", "F", true, [-670, 2624]),
        ],
    ),
    SensorKind::i2c(
        "lego-power-storage",
        2,
        &[
            energy("IN-VOLT", "V"),
            energy("IN-AMP", "A"),
            energy("OUT-VOLT", "V"),
            energy("OUT-AMP", "A"),
            Mode::new("JOULE", 1, 0, "J", Format::S16, Sense::Fixed(&[50])),
            energy("IN-WATT", "W"),
            energy("OUT-WATT", "W"),
            Mode::new("ALL", 7, 3, "", Format::S16, Sense::Fixed(&[0, 0, 0, 0, 50, 0, 0])),
        ],
    ),
];
