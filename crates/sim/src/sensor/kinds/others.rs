//! Sensors of `HiTechnic`, mindsensors and others on the I2C bus: `docs/ev3dev-sysfs.md`, 5.5.
//! Addresses, commands and how each mode shows the raw data are from the kernel's
//! `nxt_i2c_sensor_defs.c`. A sensor of something that this world lacks always shows the same.
use crate::sensor::format::{Format, Scale};
use crate::sensor::kind::{Mode, Parts, Sense, SensorKind};

const fn byte(name: &'static str, values: usize, sense: Sense) -> Mode {
    Mode::new(name, values, 0, "", Format::U8, sense)
}

const fn parts(name: &'static str, values: usize, format: Format, parts: Parts) -> Mode {
    Mode::new(name, values, 0, "", format, Sense::Parts(parts))
}

const fn temperature(name: &'static str, per_degree: i32, fahrenheit: bool) -> Mode {
    let (decimals, format) = if per_degree == 10 { (1, Format::S16Be) } else { (2, Format::S16) };
    let units = if fahrenheit { "F" } else { "C" };
    Mode::new(name, 1, decimals, units, format, Sense::Temperature { per_degree, fahrenheit })
}

/// The voltage of a box with motors or servos: 6 V, within the steps of its byte.
const fn supply(name: &'static str, raw: [i32; 2], shown: [i32; 2]) -> Mode {
    Mode::new(name, 1, 3, "V", Format::U8, Sense::Fixed(&[6000])).scaled(raw, shown)
}

/// The pressure of the air at sea level.
const fn pressure(
    name: &'static str,
    units: &'static str,
    format: Format,
    fixed: &'static [i32],
) -> Mode {
    Mode::new(name, 1, 0, units, format, Sense::Fixed(fixed))
}

/// A camera that sees none of its objects.
const fn camera(name: &'static str, values: usize) -> Mode {
    byte(name, values, Sense::Nothing)
}

const ROW_COMMANDS: &[&str] =
    &["CAL-WHITE", "CAL-BLACK", "SLEEP", "WAKE", "60HZ", "50HZ", "UNIVERSAL"];
const LEADER_COMMANDS: &[&str] = &[
    "CAL-WHITE",
    "CAL-BLACK",
    "SLEEP",
    "WAKE",
    "INV-COL",
    "RST-COL",
    "SNAP",
    "60HZ",
    "50HZ",
    "UNIVERSAL",
];

pub(super) static KINDS: &[SensorKind] = &[
    SensorKind::i2c(
        "ht-nxt-compass",
        1,
        &[Mode::new("COMPASS", 1, 0, "deg", Format::S16, Sense::Compass)],
    )
    .with_commands(&["BEGIN-CAL", "END-CAL"]),
    SensorKind::i2c(
        "ht-nxt-color",
        1,
        &[
            byte("COLOR", 1, Sense::ColorNumber { parts: false }),
            byte("RED", 1, Sense::Part(0)),
            byte("GREEN", 1, Sense::Part(1)),
            byte("BLUE", 1, Sense::Part(2)),
            parts("RAW", 3, Format::U16, Parts::Wide),
            parts("NORM", 4, Format::U8, Parts::Normal),
            byte("ALL", 4, Sense::ColorNumber { parts: true }),
        ],
    ),
    SensorKind::i2c(
        "ht-nxt-color-v2",
        1,
        &[
            byte("COLOR", 1, Sense::ColorNumber { parts: false }),
            parts("RGB", 4, Format::U8, Parts::Bytes),
            parts("NORM", 4, Format::U8, Parts::Normal),
            // With its lamp off it sees next to nothing of the floor.
            Mode::new("PASSIVE", 4, 0, "", Format::S16Be, Sense::Nothing),
            parts("RAW", 4, Format::S16Be, Parts::Wide),
        ],
    )
    .with_commands(&["50HZ", "60HZ"]),
    SensorKind::i2c(
        "ht-nxt-ir-seek-v2",
        8,
        &[
            byte("DC", 1, Sense::Direction { strengths: false, mean: false }),
            byte("AC", 1, Sense::Direction { strengths: false, mean: false }),
            byte("DC-ALL", 7, Sense::Direction { strengths: true, mean: true }),
            byte("AC-ALL", 6, Sense::Direction { strengths: true, mean: false }),
        ],
    ),
    SensorKind::i2c(
        "ht-nxt-angle",
        1,
        &[
            Mode::new("ANGLE", 1, 0, "deg", Format::U16, Sense::AxleAngle).shown_by(Scale::Halves),
            Mode::new("ANGLE-ACC", 1, 0, "deg", Format::S32Be, Sense::AxleTurned { times: 1 }),
            Mode::new("SPEED", 1, 0, "RPM", Format::S16Be, Sense::AxleSpeed),
        ],
    )
    .with_commands(&["RESET", "CAL"]),
    SensorKind::i2c(
        "ht-nxt-accel",
        1,
        &[byte("ACCEL", 1, Sense::GravityBytes), byte("ALL", 6, Sense::GravityBytes)],
    ),
    SensorKind::i2c(
        "ht-nxt-barometric",
        1,
        &[
            Mode::new("PRESS", 1, 3, "inHg", Format::S16Be, Sense::Fixed(&[29921])),
            temperature("TEMP", 10, false),
        ],
    ),
    SensorKind::i2c(
        "ht-nxt-pir",
        1,
        &[Mode::new("PROX", 1, 0, "pct", Format::U8, Sense::Nothing).scaled([0, 255], [-100, 100])],
    ),
    SensorKind::i2c("ht-nxt-ir-link", 1, &[byte("IRLINK", 1, Sense::Nothing)]),
    SensorKind::i2c(
        "ht-nxt-ir-receiver",
        1,
        &[
            Mode::new("1-MOTOR", 1, 0, "pct", Format::S8, Sense::Nothing),
            Mode::new("8-MOTOR", 8, 0, "pct", Format::S8, Sense::Nothing),
        ],
    ),
    SensorKind::i2c(
        "ht-super-pro",
        8,
        &[
            Mode::new("AIN", 4, 0, "", Format::U16, Sense::Nothing),
            byte("DIN", 1, Sense::Nothing),
            byte("DOUT", 1, Sense::Nothing),
            byte("DCTRL", 1, Sense::Nothing),
            byte("STROBE", 1, Sense::Nothing),
        ],
    ),
    // It runs, and has nothing on its sockets.
    SensorKind::i2c("ht-nxt-smux", 8, &[byte("MUX", 2, Sense::Fixed(&[2, 2]))])
        .with_commands(&["HALT", "DETECT", "RUN"]),
    SensorKind::i2c(
        "ms-absolute-imu",
        17,
        &[
            Mode::new("TILT", 3, 0, "deg", Format::U8, Sense::Fixed(&[0, 0, 90]))
                .shown_by(Scale::Tilt),
            Mode::new("ACCEL", 3, 3, "g", Format::S16, Sense::Gravity { per_g: 1000 }),
            Mode::new("COMPASS", 1, 0, "deg", Format::U16, Sense::Compass),
            Mode::new("MAG", 3, 0, "", Format::S16, Sense::Fixed(&[0, 300, -400])),
            Mode::new("GYRO", 3, 1, "d/s", Format::S16, Sense::AxesRate)
                .scaled([0, 10000], [0, 875]),
            byte("ALL", 23, Sense::Nothing),
        ],
    )
    .with_commands(&[
        "BEGIN-COMP-CAL",
        "END-COMP-CAL",
        "ACCEL-2G",
        "ACCEL-4G",
        "ACCEL-8G",
        "ACCEL-16G",
    ]),
    SensorKind::i2c(
        "ms-angle",
        24,
        &[
            Mode::new("ANGLE", 1, 0, "deg", Format::S32, Sense::AxleTurned { times: 1 }),
            Mode::new("ANGLE2", 1, 1, "deg", Format::S32, Sense::AxleTurned { times: 10 })
                .scaled([0, 360], [0, 1800]),
            Mode::new("SPEED", 1, 0, "rpm", Format::S16, Sense::AxleSpeed),
            Mode::new("ALL", 3, 0, "", Format::S32, Sense::AxleAll),
        ],
    )
    .with_commands(&["RESET"]),
    SensorKind::i2c(
        "ms-light-array",
        10,
        &[
            Mode::new("CAL", 8, 0, "pct", Format::U8, Sense::Row { times: 1 }),
            Mode::new("RAW", 8, 0, "", Format::S16, Sense::Row { times: 10 }),
        ],
    )
    .with_commands(ROW_COMMANDS),
    SensorKind::i2c(
        "ms-line-leader",
        1,
        &[
            Mode::new("PID", 1, 0, "pct", Format::S8, Sense::LineSteering),
            Mode::new("PID-ALL", 3, 0, "", Format::S8, Sense::LineSteering),
            Mode::new("CAL", 8, 0, "pct", Format::U8, Sense::Row { times: 1 }),
            Mode::new("RAW", 8, 0, "", Format::S16, Sense::Row { times: 10 }),
        ],
    )
    .with_commands(LEADER_COMMANDS),
    SensorKind::i2c(
        "ms-nxtmmx",
        3,
        &[supply("STATUS", [0, 255], [0, 255 * 37]), supply("STATUS-OLD", [0, 255], [0, 255 * 37])],
    ),
    SensorKind::i2c(
        "ms-8ch-servo",
        88,
        &[supply("V3", [127, 255], [4700, 9400]), supply("OLD", [127, 255], [4700, 9400])],
    ),
    SensorKind::i2c("ms-ev3-smux", 80, &[byte("MUX", 1, Sense::Nothing)]),
    SensorKind::i2c("ms-nxtcam", 1, &[camera("TRACK", 6)]).with_commands(&[
        "TRACK-ON",
        "TRACK-OFF",
        "TRACK-OBJ",
        "TRACK-LINE",
        "SORT-SIZE",
        "SORT-COL",
    ]),
    SensorKind::i2c("ms-nxtcam5", 1, &[camera("TRACK", 6)]).with_commands(&[
        "TRACK-OBJ",
        "TRACK-FACE",
        "MULTI-MOVIE",
        "MOVIE",
        "PICTURE",
        "TRACK-EYE",
        "TRACK-QR",
        "TRACK-LINE",
    ]),
    SensorKind::i2c("ms-pixy-adapter", 1, &[camera("TRACK", 6)])
        .with_commands(&["SORT-SIZE", "SORT-COL"]),
    SensorKind::i2c(
        "pixy-lego",
        1,
        &[
            camera("ALL", 6),
            camera("SIG1", 5),
            camera("SIG2", 5),
            camera("SIG3", 5),
            camera("SIG4", 5),
            camera("SIG5", 5),
            camera("SIG6", 5),
            camera("SIG7", 5),
        ],
    ),
    SensorKind::i2c(
        "ms-ir-thermometer",
        21,
        &[
            temperature("AMBIENT-C", 100, false),
            temperature("AMBIENT-F", 100, true),
            temperature("TARGET-C", 100, false),
            temperature("TARGET-F", 100, true),
        ],
    ),
    SensorKind::i2c(
        "ms-pps58-nx",
        12,
        &[
            pressure("RAW", "Pa", Format::S32, &[101_325]),
            pressure("ABS-PSI", "PSI", Format::S16, &[15]),
            pressure("ABS-MBAR", "mbar", Format::S16, &[1013]),
            pressure("ABS-KPA", "kPa", Format::S16, &[101]),
            pressure("REL-PSI", "PSI", Format::S16, &[0]),
            pressure("REL-MBAR", "mbar", Format::S16, &[0]),
            pressure("REL-KPA", "kPa", Format::S16, &[0]),
        ],
    )
    .with_commands(&["ZERO"]),
    SensorKind::i2c(
        "ms-tof",
        1,
        &[
            Mode::new("DIST", 1, 0, "mm", Format::S16, Sense::Millimeters),
            Mode::new("VOLT", 1, 0, "mV", Format::S16, Sense::Fixed(&[5000])),
        ],
    )
    .with_commands(&["OFF"]),
    SensorKind::i2c(
        "mi-xg1300l",
        1,
        &[
            Mode::new("ANGLE", 1, 2, "deg", Format::S16, Sense::Hundredths { all: false }),
            Mode::new(
                "SPEED",
                1,
                2,
                "d/s",
                Format::S16,
                Sense::RateWithin { per_degree: 100, limits: [-32768, 32767] },
            ),
            Mode::new("ACCEL", 3, 3, "g", Format::S16, Sense::Gravity { per_g: 1000 }),
            Mode::new("ALL", 5, 0, "", Format::S16, Sense::Hundredths { all: true }),
        ],
    )
    .with_commands(&["RESET", "ACCEL-2G", "ACCEL-4G", "ACCEL-8G"]),
];
