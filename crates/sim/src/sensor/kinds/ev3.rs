//! The sensors of the EV3 sets: `docs/ev3dev-sysfs.md`, 5.4.
use crate::sensor::format::{Format, Scale};
use crate::sensor::kind::{Mode, Sense, SensorKind};

const ANALOG: &[Mode] = &[Mode::new("ANALOG", 1, 3, "V", Format::S32, Sense::Volts)];

const fn distance(name: &'static str, inches: bool, single: bool) -> Mode {
    let units = if inches { "in" } else { "cm" };
    Mode::new(name, 1, 1, units, Format::S16, Sense::Distance { inches, single })
}

pub(super) static KINDS: &[SensorKind] = &[
    SensorKind::uart(
        "lego-ev3-color",
        10,
        &[
            Mode::new("COL-REFLECT", 1, 0, "pct", Format::S8, Sense::Reflection),
            Mode::new("COL-AMBIENT", 1, 0, "pct", Format::S8, Sense::Ambient),
            Mode::new("COL-COLOR", 1, 0, "col", Format::S8, Sense::Color),
            Mode::new("REF-RAW", 2, 0, "", Format::S16, Sense::ReflectionRaw),
            Mode::new("RGB-RAW", 3, 0, "", Format::S16, Sense::Rgb),
            Mode::new("COL-CAL", 4, 0, "", Format::S16, Sense::Nothing).mute(),
        ],
    ),
    SensorKind::uart(
        "lego-ev3-us",
        10,
        &[
            distance("US-DIST-CM", false, false),
            distance("US-DIST-IN", true, false),
            Mode::new("US-LISTEN", 1, 0, "", Format::S8, Sense::Nothing),
            distance("US-SI-CM", false, true),
            distance("US-SI-IN", true, true),
            distance("US-DC-CM", false, false),
            distance("US-DC-IN", true, false),
        ],
    ),
    SensorKind::uart(
        "lego-ev3-gyro",
        10,
        &[
            Mode::new("GYRO-ANG", 1, 0, "deg", Format::S16, Sense::Angle),
            Mode::new("GYRO-RATE", 1, 0, "d/s", Format::S16, Sense::Rate),
            Mode::new("GYRO-FAS", 1, 0, "", Format::S16, Sense::FineRate),
            Mode::new("GYRO-G&A", 2, 0, "", Format::S16, Sense::AngleAndRate),
            Mode::new("GYRO-CAL", 4, 0, "", Format::S16, Sense::Nothing),
            Mode::new("TILT-RATE", 1, 0, "d/s", Format::S16, Sense::Nothing),
            Mode::new("TILT-ANG", 1, 0, "deg", Format::S16, Sense::Nothing),
        ],
    ),
    SensorKind::uart(
        "lego-ev3-ir",
        1100,
        &[
            Mode::new("IR-PROX", 1, 0, "pct", Format::S8, Sense::Proximity),
            Mode::new("IR-SEEK", 8, 0, "pct", Format::S8, Sense::Seek),
            Mode::new("IR-REMOTE", 4, 0, "btn", Format::S8, Sense::Remote),
            Mode::new("IR-REM-A", 1, 0, "", Format::S16, Sense::RemoteBits),
            Mode::new("IR-S-ALT", 4, 0, "pct", Format::S8, Sense::Nothing).mute(),
            Mode::new("IR-CAL", 2, 0, "", Format::S32, Sense::Nothing),
        ],
    ),
    SensorKind::analog(
        "lego-ev3-touch",
        &[Mode::new("TOUCH", 1, 0, "", Format::S32, Sense::Touch).shown_by(Scale::Above(250))],
    ),
    SensorKind::analog("ev3-analog-01", ANALOG),
    SensorKind::analog("ev3-analog-03", ANALOG),
    SensorKind::analog("ev3-analog-04", ANALOG),
    SensorKind::analog("ev3-analog-05", ANALOG),
    SensorKind::analog("ev3-analog-06", ANALOG),
    SensorKind::analog("ev3-analog-07", ANALOG),
    SensorKind::analog("ev3-analog-08", ANALOG),
    SensorKind::analog("ev3-analog-09", ANALOG),
    SensorKind::analog("ev3-analog-10", ANALOG),
    SensorKind::analog("ev3-analog-11", ANALOG),
    SensorKind::analog("ev3-analog-12", ANALOG),
    SensorKind::analog("ev3-analog-13", ANALOG),
    SensorKind::analog("ev3-analog-14", ANALOG),
];
