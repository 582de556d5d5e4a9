//! The sensors of the EV3 sets and their modes (section 5.4 of the reference sheet), as data.

/// How a sensor talks to the brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Over a serial line, by LEGO's protocol: changing the mode takes a moment.
    Uart,
    /// As a voltage, sampled every 10 ms.
    Analog,
}

/// How one value lies in `bin_data`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Format {
    S8,
    S16,
    S32,
}

impl Format {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Format::S8 => "s8",
            Format::S16 => "s16",
            Format::S32 => "s32",
        }
    }

    pub(crate) fn bytes(self) -> usize {
        match self {
            Format::S8 => 1,
            Format::S16 => 2,
            Format::S32 => 4,
        }
    }

    /// What a value becomes when it has to fit.
    pub(crate) fn fit(self, value: i32) -> i32 {
        match self {
            Format::S8 => value.clamp(-128, 127),
            Format::S16 => value.clamp(-32768, 32767),
            Format::S32 => value,
        }
    }
}

/// What a mode measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sense {
    Reflection,
    Ambient,
    Colour,
    ReflectionRaw,
    Rgb,
    Distance {
        inches: bool,
        single: bool,
    },
    Angle,
    Rate,
    FineRate,
    AngleAndRate,
    Proximity,
    Seek,
    RemoteBits,
    Touch,
    /// The touch sensor's pin as millivolts.
    Volts,
    /// Listening, remote control, calibration: nothing there to be measured.
    Nothing,
}

/// One mode of a sensor.
#[derive(Debug)]
pub(crate) struct Mode {
    pub(crate) name: &'static str,
    pub(crate) values: usize,
    pub(crate) decimals: u8,
    pub(crate) units: &'static str,
    pub(crate) format: Format,
    pub(crate) sense: Sense,
    /// In this mode the sensor answers no keep-alive: contact is lost after a while.
    pub(crate) mute: bool,
}

impl Mode {
    const fn new(
        name: &'static str,
        values: usize,
        decimals: u8,
        units: &'static str,
        format: Format,
        sense: Sense,
    ) -> Self {
        Mode { name, values, decimals, units, format, sense, mute: false }
    }

    const fn mute(mut self) -> Self {
        self.mute = true;
        self
    }
}

/// A type of sensor.
#[derive(Debug)]
pub struct SensorKind {
    /// Name of the driver, as in `driver_name`.
    pub driver_name: &'static str,
    /// How it is connected.
    pub link: Link,
    /// How long values may be unsettled after a change of mode, in ms. From LEGO's firmware:
    /// 10 for most, 1100 for infrared.
    pub settling_ms: u32,
    pub(crate) modes: &'static [Mode],
}

const fn distance(name: &'static str, inches: bool, single: bool) -> Mode {
    let units = if inches { "in" } else { "cm" };
    Mode::new(name, 1, 1, units, Format::S16, Sense::Distance { inches, single })
}

/// Every sensor type that a simulated port can have.
pub static SENSOR_KINDS: [SensorKind; 8] = [
    SensorKind {
        driver_name: "lego-ev3-color",
        link: Link::Uart,
        settling_ms: 10,
        modes: &[
            Mode::new("COL-REFLECT", 1, 0, "pct", Format::S8, Sense::Reflection),
            Mode::new("COL-AMBIENT", 1, 0, "pct", Format::S8, Sense::Ambient),
            Mode::new("COL-COLOR", 1, 0, "col", Format::S8, Sense::Colour),
            Mode::new("REF-RAW", 2, 0, "", Format::S16, Sense::ReflectionRaw),
            Mode::new("RGB-RAW", 3, 0, "", Format::S16, Sense::Rgb),
            Mode::new("COL-CAL", 4, 0, "", Format::S16, Sense::Nothing).mute(),
        ],
    },
    SensorKind {
        driver_name: "lego-ev3-us",
        link: Link::Uart,
        settling_ms: 10,
        modes: &[
            distance("US-DIST-CM", false, false),
            distance("US-DIST-IN", true, false),
            Mode::new("US-LISTEN", 1, 0, "", Format::S8, Sense::Nothing),
            distance("US-SI-CM", false, true),
            distance("US-SI-IN", true, true),
            distance("US-DC-CM", false, false),
            distance("US-DC-IN", true, false),
        ],
    },
    SensorKind {
        driver_name: "lego-ev3-gyro",
        link: Link::Uart,
        settling_ms: 10,
        modes: &[
            Mode::new("GYRO-ANG", 1, 0, "deg", Format::S16, Sense::Angle),
            Mode::new("GYRO-RATE", 1, 0, "d/s", Format::S16, Sense::Rate),
            Mode::new("GYRO-FAS", 1, 0, "", Format::S16, Sense::FineRate),
            Mode::new("GYRO-G&A", 2, 0, "", Format::S16, Sense::AngleAndRate),
            Mode::new("GYRO-CAL", 4, 0, "", Format::S16, Sense::Nothing),
            Mode::new("TILT-RATE", 1, 0, "d/s", Format::S16, Sense::Nothing),
            Mode::new("TILT-ANG", 1, 0, "deg", Format::S16, Sense::Nothing),
        ],
    },
    SensorKind {
        driver_name: "lego-ev3-ir",
        link: Link::Uart,
        settling_ms: 1100,
        modes: &[
            Mode::new("IR-PROX", 1, 0, "pct", Format::S8, Sense::Proximity),
            Mode::new("IR-SEEK", 8, 0, "pct", Format::S8, Sense::Seek),
            Mode::new("IR-REMOTE", 4, 0, "btn", Format::S8, Sense::Nothing),
            Mode::new("IR-REM-A", 1, 0, "", Format::S16, Sense::RemoteBits),
            Mode::new("IR-S-ALT", 4, 0, "pct", Format::S8, Sense::Nothing).mute(),
            Mode::new("IR-CAL", 2, 0, "", Format::S32, Sense::Nothing),
        ],
    },
    SensorKind {
        driver_name: "lego-ev3-touch",
        link: Link::Analog,
        settling_ms: 0,
        modes: &[Mode::new("TOUCH", 1, 0, "", Format::S32, Sense::Touch)],
    },
    SensorKind {
        driver_name: "ev3-analog-01",
        link: Link::Analog,
        settling_ms: 0,
        modes: &[Mode::new("ANALOG", 1, 3, "V", Format::S32, Sense::Volts)],
    },
    // Servos are behind it: see `servo`.
    SensorKind {
        driver_name: "ms-8ch-servo",
        link: Link::Analog,
        settling_ms: 0,
        modes: &[
            Mode::new("V3", 1, 3, "V", Format::S16, Sense::Nothing),
            Mode::new("OLD", 1, 3, "V", Format::S16, Sense::Nothing),
        ],
    },
    SensorKind {
        driver_name: "nxt-analog",
        link: Link::Analog,
        settling_ms: 0,
        modes: &[
            Mode::new("ANALOG-0", 1, 3, "V", Format::S32, Sense::Volts),
            Mode::new("ANALOG-1", 1, 3, "V", Format::S32, Sense::Volts),
        ],
    },
];

impl SensorKind {
    /// The sensor with this driver name.
    #[must_use]
    pub fn named(driver_name: &str) -> Option<&'static SensorKind> {
        SENSOR_KINDS.iter().find(|kind| kind.driver_name == driver_name)
    }

    /// The names of its modes, the default first.
    pub fn modes(&self) -> impl Iterator<Item = &'static str> {
        self.modes.iter().map(|mode| mode.name)
    }
}
