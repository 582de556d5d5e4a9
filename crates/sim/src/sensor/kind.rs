//! The types of sensors, as data: how each is connected, and what it shows in each of
//! its modes. `kinds` has the tables.
use super::format::{Format, Reading, Scale};

/// How a sensor talks to the brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Link {
    /// Over a serial line, by LEGO's protocol: changing the mode takes a moment.
    Uart,
    /// As a voltage on pin 6, sampled every 10 ms; a resistor identifies the type.
    Analog,
    /// As a voltage on pin 1, sampled every 10 ms. Of these the brick recognizes only the light and
    /// the touch sensor from the others: `recognized`. The others come up as `nxt-analog` until a
    /// program sets their type.
    NxtAnalog {
        /// Whether the brick knows it when it is plugged in.
        recognized: bool,
    },
    /// On the I2C bus at this address, polled by the kernel.
    I2c(u8),
}

impl Link {
    /// True if it is a voltage.
    pub fn is_analog(self) -> bool {
        matches!(self, Link::Analog | Link::NxtAnalog { .. })
    }
}

/// The colors of the floor that a sensor distinguishes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parts {
    /// 0 to 255 each.
    Bytes,
    /// The strongest is 255.
    Normal,
    /// 16 bits each.
    Wide,
}

/// The quantity that a mode measures, in the numbers that `value<N>` shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sense {
    Reflection,
    Ambient,
    Color,
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
    Remote,
    RemoteBits,
    Touch,
    /// Pin 6 in millivolts, to which a touch sensor of the EV3 gives the supply.
    Volts,
    /// Pin 1 in millivolts, to which another thing than this driver's sensor may be connected.
    Pin,
    /// In tenths of a per cent.
    FineReflection,
    FineAmbient,
    /// The voltage of a microphone in tenths of a per cent: high in silence.
    Silence,
    /// In centimeters, or tenths of an inch; far less exact than the EV3's.
    NxtDistance {
        inches: bool,
        single: bool,
    },
    /// Counts per degree Celsius or Fahrenheit.
    Temperature {
        per_degree: i32,
        fahrenheit: bool,
    },
    /// Degrees from north, which is +y, clockwise.
    Compass,
    /// `HiTechnic`'s number from 0 (black) to 17 (white), and perhaps the parts behind it.
    ColorNumber {
        parts: bool,
    },
    /// One part: 0 red, 1 green, 2 blue.
    Part(usize),
    /// Red, green and blue, and what follows them.
    Parts(Parts),
    /// The direction of the nearest beacon in nine steps, and perhaps strengths.
    Direction {
        strengths: bool,
        mean: bool,
    },
    /// Degrees per second between these limits.
    RateWithin {
        per_degree: i32,
        limits: [i32; 2],
    },
    /// In hundredths of a degree, and perhaps rate and accelerations.
    Hundredths {
        all: bool,
    },
    /// Three axes; the sensor lies flat and is not jolted.
    Gravity {
        per_g: i32,
    },
    /// The same in `HiTechnic`'s bytes: high ones, low ones.
    GravityBytes,
    /// Tenths of a degree per second about x, y and z.
    AxesRate,
    /// The nearest thing ahead, by the time that light takes.
    Millimeters,
    /// Light that comes back from something ahead: this over its distance in cm.
    Reflector {
        reach: i32,
    },
    /// The angle of the left wheel's axle: degrees from 0 to 359.
    AxleAngle,
    /// Degrees since the last reset, times this.
    AxleTurned {
        times: i32,
    },
    /// Revolutions per minute.
    AxleSpeed,
    /// Three of the above.
    AxleAll,
    /// Eight light sensors in a row, in per cent of white, times this.
    Row {
        times: i32,
    },
    /// The place of a dark line below the row: steering, and perhaps more.
    LineSteering,
    /// Always these.
    Fixed(&'static [i32]),
    /// Listening, calibration: nothing there to be measured.
    Nothing,
}

impl Sense {
    /// Whether it is of the spot that a color or light sensor sees.
    pub(crate) fn is_of_spot(self) -> bool {
        matches!(
            self,
            Sense::Reflection
                | Sense::Color
                | Sense::ReflectionRaw
                | Sense::Rgb
                | Sense::FineReflection
                | Sense::ColorNumber { .. }
                | Sense::Part(_)
                | Sense::Parts(_)
        )
    }
}

/// One mode of a sensor.
#[derive(Debug)]
pub(crate) struct Mode {
    pub(crate) name: &'static str,
    pub(crate) values: usize,
    pub(crate) decimals: u8,
    pub(crate) units: &'static str,
    pub(crate) format: Format,
    pub(crate) scale: Scale,
    pub(crate) sense: Sense,
    /// In this mode the sensor answers no keep-alive: contact is lost after a while.
    pub(crate) mute: bool,
}

impl Mode {
    pub(super) const fn new(
        name: &'static str,
        values: usize,
        decimals: u8,
        units: &'static str,
        format: Format,
        sense: Sense,
    ) -> Self {
        Mode { name, values, decimals, units, format, scale: Scale::None, sense, mute: false }
    }

    pub(super) const fn mute(mut self) -> Self {
        self.mute = true;
        self
    }

    /// The raw data from one number to another are shown as from one to another.
    pub(super) const fn scaled(mut self, raw: [i32; 2], shown: [i32; 2]) -> Self {
        self.scale = Scale::Linear { raw, shown };
        self
    }

    pub(super) const fn shown_by(mut self, scale: Scale) -> Self {
        self.scale = scale;
        self
    }

    /// The raw data for values.
    pub(crate) fn raw(&self, values: Reading) -> Reading {
        values.map(|value| self.format.fit(self.scale.raw(value)))
    }

    /// The word for what it measures, if there is a common one.
    pub(crate) fn label(&self) -> Option<&'static str> {
        Some(match self.sense {
            Sense::Distance { .. } | Sense::NxtDistance { .. } | Sense::Millimeters => "distance",
            Sense::Reflection | Sense::ReflectionRaw | Sense::FineReflection => "reflected light",
            Sense::Ambient | Sense::FineAmbient => "ambient light",
            Sense::Color | Sense::ColorNumber { .. } => "color",
            Sense::Rgb | Sense::Parts(_) => "red, green, blue",
            Sense::Angle | Sense::AxleAngle | Sense::Hundredths { .. } => "angle",
            Sense::Rate | Sense::FineRate | Sense::RateWithin { .. } => "rate",
            Sense::AngleAndRate => "angle, rate",
            Sense::Proximity | Sense::Reflector { .. } => "proximity",
            Sense::Seek | Sense::Direction { .. } => "beacon",
            Sense::Remote | Sense::RemoteBits => "remote control",
            Sense::Touch => "touch",
            Sense::Silence => "sound",
            Sense::Temperature { .. } => "temperature",
            Sense::Compass => "compass",
            _ => return None,
        })
    }

    /// True if it measures only when the mode is written.
    pub(crate) fn is_single(&self) -> bool {
        let (Sense::Distance { single, .. } | Sense::NxtDistance { single, .. }) = self.sense
        else {
            return false;
        };
        single
    }
}

/// What the driver knows of the mode of a sensor that introduces itself.
pub(super) static BLANK: Mode = Mode::new("", 0, 0, "", Format::U8, Sense::Nothing);

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
    /// The words that it takes as `command`.
    pub commands: &'static [&'static str],
    pub(crate) modes: &'static [Mode],
}

impl SensorKind {
    pub(super) const fn uart(
        driver_name: &'static str,
        settling_ms: u32,
        modes: &'static [Mode],
    ) -> Self {
        SensorKind { driver_name, link: Link::Uart, settling_ms, commands: &[], modes }
    }

    pub(super) const fn analog(driver_name: &'static str, modes: &'static [Mode]) -> Self {
        SensorKind { driver_name, link: Link::Analog, settling_ms: 0, commands: &[], modes }
    }

    pub(super) const fn nxt_analog(driver_name: &'static str, modes: &'static [Mode]) -> Self {
        let link = Link::NxtAnalog { recognized: false };
        SensorKind { driver_name, link, settling_ms: 0, commands: &[], modes }
    }

    pub(super) const fn i2c(
        driver_name: &'static str,
        address: u8,
        modes: &'static [Mode],
    ) -> Self {
        SensorKind { driver_name, link: Link::I2c(address), settling_ms: 0, commands: &[], modes }
    }

    pub(super) const fn with_commands(mut self, commands: &'static [&'static str]) -> Self {
        self.commands = commands;
        self
    }
}

/// How often the kernel polls sensors on the I2C bus, and the servo controller.
const POLL_MS: u32 = 100;
const SERVO_POLL_MS: u32 = 1000;

impl SensorKind {
    /// How often a sensor is polled at first. Motors and servos behind it need no values.
    pub(super) fn poll_ms(&self) -> u32 {
        if matches!(self.driver_name, "ms-8ch-servo" | "ms-nxtmmx") {
            SERVO_POLL_MS
        } else {
            POLL_MS
        }
    }

    /// Whether a mode of a sensor on the I2C bus is set by a register, and not only by what is
    /// read, by the same table (`set_mode_reg`).
    pub(super) fn has_mode_register(&self, mode: usize) -> bool {
        match self.driver_name {
            "lego-nxt-us" | "lego-nxt-temp" | "ht-nxt-color-v2" | "ht-nxt-smux" => true,
            "ms-pps58-nx" => mode > 0,
            _ => false,
        }
    }

    /// What a sensor on the I2C bus says of who made it and what it is, by the kernel's
    /// `nxt_i2c_sensor_defs.c`. LEGO's thermometer and energy meter say nothing, and the
    /// XG1300L neither.
    pub(crate) fn identity(&self) -> [&'static str; 2] {
        match self.driver_name {
            "lego-nxt-us" => ["LEGO", "Sonar"],
            "ht-nxt-pir" => ["HITECHNC", "PIR"],
            "ht-nxt-barometric" => ["HiTechnc", "Barometr"],
            "ht-nxt-ir-seek-v2" => ["HiTechnc", "NewIRDir"],
            "ht-nxt-color" => ["HiTechnc", "Color"],
            "ht-nxt-color-v2" => ["HiTechnc", "ColorPD"],
            "ht-nxt-angle" => ["HITECHNC", "AnglSnsr"],
            "ht-nxt-compass" => ["HITECHNC", "Compass"],
            "ht-nxt-ir-receiver" => ["HiTechnc", "IRRecv"],
            "ht-nxt-accel" => ["HITECHNC", "Accel."],
            "ht-nxt-ir-link" => ["HiTechnc", "IRLink"],
            "ht-super-pro" => ["HiTechnc", "SuperPro"],
            "ht-nxt-smux" => ["HiTechnc", "SensrMUX"],
            "ms-8ch-servo" => ["mndsnsrs", "NXTServo"],
            "ms-absolute-imu" => ["mndsnsrs", "AbsIMU"],
            "ms-angle" => ["mndsnsrs", "AngSens"],
            "ms-ir-thermometer" => ["mndsnsrs", "IRThermo"],
            "ms-ev3-smux" => ["mndsnsrs", "Ev3SMux"],
            "ms-light-array" => ["mndsnsrs", "LSArray"],
            "ms-line-leader" => ["mndsnsrs", "LineLdr"],
            "ms-nxtmmx" => ["mndsnsrs", "NxTMMX"],
            "ms-nxtcam" => ["mndsnsrs", "NXTCAM"],
            "ms-nxtcam5" => ["mndsnsrs", "NXTcam5"],
            "ms-pixy-adapter" => ["mndsnsrs", "PixyAdpt"],
            "ms-pps58-nx" => ["mndsnsrs", "PPS58"],
            "ms-tof" => ["mndsnsrs", "DIST-ToF"],
            "pixy-lego" => ["Pixy", "Pixy"],
            _ => ["", ""],
        }
    }

    /// True if it shows angles that drift.
    pub(crate) fn is_gyro(&self) -> bool {
        matches!(self.driver_name, "lego-ev3-gyro" | "ht-nxt-gyro" | "mi-xg1300l")
    }

    /// The names of its modes, the default first.
    pub fn modes(&self) -> impl Iterator<Item = &'static str> {
        self.modes.iter().map(|mode| mode.name)
    }
}
