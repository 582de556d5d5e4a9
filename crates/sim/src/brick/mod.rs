//! The parts of the brick: status LEDs, battery, the file that names the board, and the files that
//! describe the screen.

pub(crate) mod output;
pub(crate) mod panel;
pub(crate) mod port;
pub(crate) mod remote;
pub(crate) mod screen;

use crate::brick::output::{Output, Pins};
use crate::files::attr::{Attr, Effect, Table, text, write_uevent};
use crate::files::text::{strict_unsigned, word};
use ev3_os::linux::Errno;
use screen::{Depth, HEIGHT, WIDTH};

/// The EV3's four status lights; a left and a right pair of red and green.
pub(crate) const LEDS: [(&str, u32); 4] = [
    ("led0:green:brick-status", 255),
    ("led0:red:brick-status", 0),
    ("led1:green:brick-status", 255),
    ("led1:red:brick-status", 0),
];
const TRIGGERS: [&str; 7] =
    ["none", "mmc0", "timer", "heartbeat", "default-on", "transient", "rfkill0"];
const NONE: usize = 0;
const TIMER: usize = 2;
const DEFAULT_ON: usize = 4;
/// `max_brightness` of the lights in the brick, and of one on an output port.
const FULL: u32 = 255;
const FULL_ON_PORT: u32 = 100;

/// A status light.
#[derive(Clone, Debug)]
pub(crate) struct Led {
    pub(crate) name: String,
    brightness: u32,
    /// How bright it was when it blinked last.
    blinked: u32,
    full: u32,
    trigger: usize,
    delay_on: u32,
    delay_off: u32,
    /// Of a light on an output port: the bridge, whose PWM is its brightness.
    pub(crate) output: Option<Output>,
}

impl Led {
    /// A status light of the brick.
    pub(crate) fn new(name: &str, brightness: u32) -> Self {
        Led {
            name: name.to_owned(),
            brightness,
            blinked: 0,
            full: FULL,
            trigger: NONE,
            delay_on: 500,
            delay_off: 500,
            output: None,
        }
    }

    /// A light on an output port in the mode `led`. It is lit with the PWM that it finds there.
    pub(crate) fn on_port(address: &str, output: Output) -> Self {
        let name = format!("{address}::brick-status");
        let output = Some(Output { pins: Pins::Forward, ..output });
        Led { full: FULL_ON_PORT, output, ..Led::new(&name, 0) }
    }

    pub(crate) fn brightness(&self) -> u32 {
        self.output.map_or(self.brightness, |output| output.percent.unsigned_abs())
    }

    fn shine(&mut self, brightness: u32) {
        self.brightness = brightness;
        if let Some(output) = &mut self.output {
            output.percent = i32::try_from(brightness).unwrap_or(0);
        }
    }

    fn set_brightness(&mut self, bytes: &[u8]) -> Result<Effect, Errno> {
        let brightness = strict_unsigned(bytes)?.min(self.full);
        self.shine(brightness);
        if brightness == 0 {
            self.trigger = NONE;
        }
        Ok(Effect::Done)
    }

    fn set_trigger(&mut self, bytes: &[u8]) -> Result<Effect, Errno> {
        let before = std::mem::replace(&mut self.trigger, word(bytes, TRIGGERS.into_iter())?);
        // The end of a trigger switches the light off.
        if before != NONE {
            self.shine(0);
        }
        match self.trigger {
            DEFAULT_ON => self.shine(self.full),
            TIMER => {
                self.blink(0, 0);
                return Ok(Effect::Appeared);
            }
            _ => {}
        }
        Ok(Effect::Done)
    }

    /// The light is on and off for these times, in ms; twice 0 is half a second each. While it
    /// blinks the files show how bright it is when it is on.
    fn blink(&mut self, delay_on: u32, delay_off: u32) {
        let delays =
            if delay_on == 0 && delay_off == 0 { (500, 500) } else { (delay_on, delay_off) };
        (self.delay_on, self.delay_off) = delays;
        match (self.brightness(), self.blinked) {
            (0, 0) => self.blinked = self.full,
            (0, _) => {}
            (brightness, _) => self.blinked = brightness,
        }
        self.shine(if self.delay_on == 0 { 0 } else { self.blinked });
    }

    /// Each name with a blank behind it.
    fn triggers(&self) -> String {
        let shown = TRIGGERS.iter().enumerate().map(|(index, name)| {
            if index == self.trigger { format!("[{name}] ") } else { format!("{name} ") }
        });
        shown.collect()
    }
}

impl Table for Led {
    const ATTRS: &'static [Attr<Led>] = &[
        Attr::rw("brightness", |l| text(l.brightness()), Led::set_brightness),
        Attr::rw(
            "delay_off",
            |l: &Led| text(l.delay_off),
            |l, bytes| {
                l.blink(l.delay_on, strict_unsigned(bytes)?);
                Ok(Effect::Done)
            },
        )
        .only_while(|l| l.trigger == TIMER)
        .late(),
        Attr::rw(
            "delay_on",
            |l: &Led| text(l.delay_on),
            |l, bytes| {
                l.blink(strict_unsigned(bytes)?, l.delay_off);
                Ok(Effect::Done)
            },
        )
        .only_while(|l| l.trigger == TIMER)
        .late(),
        Attr::ro("max_brightness", |l| text(l.full)),
        Attr::rw("trigger", |l| text(l.triggers()), Led::set_trigger),
        Attr::rw("uevent", |_| Ok(Vec::new()), |_, bytes| write_uevent(bytes)),
    ];
}

/// The rechargeable pack. Its voltage falls with the load.
#[derive(Clone, Debug)]
pub(crate) struct Battery {
    /// Volts at the terminals.
    pub(crate) volts: f64,
    /// Amperes drawn.
    pub(crate) amperes: f64,
}

impl Battery {
    /// Terminal voltage without load: a well-charged lithium-ion pack of two cells.
    const OPEN_VOLTS: f64 = 8.0;
    /// Inner resistance with its wiring, in ohms.
    const OHMS: f64 = 0.15;
    /// The current that the brick itself draws, in A.
    const IDLE_AMPERES: f64 = 0.17;
    pub(crate) const NAME: &'static str = "lego-ev3-battery";

    pub(crate) fn new() -> Self {
        let mut battery = Battery { volts: 0.0, amperes: 0.0 };
        battery.load(0.0);
        battery
    }

    /// The motors together draw this much now.
    pub(crate) fn load(&mut self, motor_amperes: f64) {
        self.amperes = Self::IDLE_AMPERES + motor_amperes;
        self.volts = Self::OPEN_VOLTS - self.amperes * Self::OHMS;
    }
}

/// Millis of a unit as the micros of the files: the converter is not finer than that.
#[expect(clippy::cast_possible_truncation, reason = "a few volts or amperes")]
fn micros(value: f64) -> i64 {
    libm::round(value * 1000.0) as i64 * 1000
}

impl Table for Battery {
    const ATTRS: &'static [Attr<Battery>] = &[
        Attr::ro("current_now", |b| text(micros(b.amperes))),
        Attr::ro("scope", |_| text("System")),
        Attr::ro("technology", |_| text("Li-ion")),
        Attr::ro("type", |_| text("Battery")),
        Attr::rw(
            "uevent",
            |b| {
                text(format_args!(
                    "POWER_SUPPLY_NAME={}\nPOWER_SUPPLY_TECHNOLOGY=Li-ion\n\
                     POWER_SUPPLY_VOLTAGE_MAX_DESIGN=84000000\n\
                     POWER_SUPPLY_VOLTAGE_MIN_DESIGN=60000000\nPOWER_SUPPLY_VOLTAGE_NOW={}\n\
                     POWER_SUPPLY_CURRENT_NOW={}\nPOWER_SUPPLY_SCOPE=System",
                    Battery::NAME,
                    micros(b.volts),
                    micros(b.amperes)
                ))
            },
            |_, bytes| write_uevent(bytes),
        ),
        // Ten times too large, as the kernel's driver has it.
        Attr::ro("voltage_max_design", |_| text(84_000_000)),
        Attr::ro("voltage_min_design", |_| text(60_000_000)),
        Attr::ro("voltage_now", |b| text(micros(b.volts))),
    ];
}

/// The kind of this brick.
#[derive(Clone, Debug)]
pub(crate) struct Board;

impl Table for Board {
    const ATTRS: &'static [Attr<Board>] = &[Attr::rw(
        "uevent",
        |_| {
            text(
                "BOARD_INFO_HW_REV=7\nBOARD_INFO_MODEL=LEGO MINDSTORMS EV3\n\
                 BOARD_INFO_ROM_REV=6\nBOARD_INFO_SERIAL_NUM=001653000000\nBOARD_INFO_TYPE=main",
            )
        },
        |_, bytes| write_uevent(bytes),
    )];
}

/// How the screen in `/dev/fb0` is laid out.
#[derive(Clone, Debug)]
pub(crate) struct Framebuffer(pub(crate) Depth);

impl Table for Framebuffer {
    const ATTRS: &'static [Attr<Framebuffer>] = &[
        Attr::ro("bits_per_pixel", |f| text(f.0.bits())),
        Attr::ro("stride", |f| text(f.0.stride())),
        Attr::ro("virtual_size", |_| text(format_args!("{WIDTH},{HEIGHT}"))),
    ];
}
