//! Sensors: from a measurement to the files of `lego-sensor`.
//!
//! A serial (UART) sensor takes a moment to change its mode. Until the first data of the new mode
//! arrive, everything shows the old one; for the settling time after that the numbers are still
//! those that the new mode showed last, if it was ever read. An analog sensor has none of this:
//! until the next sample it shows what the new mode showed last, at first the raw data 0.
//! This module does not measure: [`crate::sense`] samples the world, and what comes here is a
//! [`Reading`] of raw data.

mod attrs;
mod axle;
mod bus;
mod format;
mod kind;
mod kinds;

pub(crate) use axle::Axle;
pub(crate) use format::{Reading, SUPPLY_MV, SWITCHED_MV};
pub use kind::{Link, SensorKind};
pub(crate) use kind::{Mode, Parts, Sense};

use crate::brick::port::Port;
use crate::files::attr::Effect;
use crate::ticks::{JIFFY_TICKS, TICK_MS, milliseconds, ticks_from_ms};
use crate::wheel::jiffy;
use ev3_os::linux::Errno;
use std::time::Duration;

/// From a mode message to the first data of the new mode.
const MODE_LATENCY_MS: i32 = 4;
/// From the registration of a serial sensor to its first data, when plugging takes its time.
const FIRST_DATA_MS: i32 = 20;
/// Ultrasonic single shots must be this far apart, else the sensor locks up.
const SINGLE_SHOT_MS: i32 = 250;
/// More than six keep-alive intervals without data: the driver gives the contact up.
const MUTE_MS: i32 = 700;
/// Going back to 2400 baud and introducing oneself again.
const RESYNC_MS: i32 = 500;
/// The first introduction of a serial sensor, at 2400 baud.
pub(crate) const INTRODUCTION_MS: i32 = 1000;
/// How often the driver sends the message that selects a mode, and how many jiffies pass between.
const SELECT_TRIES: u64 = 10;
const SELECT_JIFFIES: u64 = 6;

/// A sensor as the driver sees it.
#[derive(Clone, Debug)]
pub(crate) struct Sensor {
    pub(crate) kind: &'static SensorKind,
    port: Port,
    mode: usize,
    pending: Option<(usize, u64)>,
    instant: bool,
    settled_at: u64,
    first_data_at: u64,
    mode_since: u64,
    /// The sensor sends nothing from one tick to before the other.
    silent: [u64; 2],
    /// It introduces itself again from the one tick to before the other, if the driver gave it up.
    introduction: [u64; 2],
    /// A write of the mode is waiting in vain.
    selecting_until: u64,
    locked: bool,
    last_single_shot: Option<u64>,
    /// A measurement that a write of the mode asked for is still to be taken.
    wanted: bool,
    /// How often it is polled, in ms, and the tick of the next time; 0 is never.
    poll_ms: u32,
    poll_at: u64,
    /// The registers that a program has written, of a sensor on the I2C bus.
    settings: Vec<(usize, u8)>,
    /// The raw data, as they lie in `bin_data`.
    reading: Reading,
    /// The last measurement of each mode: the files show it until the mode has settled.
    left_over: Vec<Option<Reading>>,
    /// Tick of the reading; the world need not be looked at twice in one tick.
    read_at: Option<u64>,
    now: u64,
    /// Degrees since the last reset, clockwise.
    pub(crate) angle: f64,
    /// Degrees per second, clockwise.
    pub(crate) rate: f64,
    pub(crate) axle: Axle,
    pub(crate) events: u32,
}

impl Sensor {
    /// A sensor just registered. `instant` leaves every waiting time out.
    pub(crate) fn new(
        kind: &'static SensorKind,
        port: Port,
        now: u64,
        instant: bool,
        at_boot: bool,
    ) -> Self {
        let warm = instant || at_boot || kind.link != Link::Uart;
        let first_data_at = if warm { now } else { now + ticks_from_ms(FIRST_DATA_MS) };
        Sensor {
            kind,
            port,
            mode: 0,
            pending: None,
            instant,
            settled_at: first_data_at,
            first_data_at,
            mode_since: now,
            silent: [0; 2],
            introduction: [0; 2],
            selecting_until: 0,
            locked: false,
            last_single_shot: None,
            wanted: matches!(kind.link, Link::I2c(_)),
            poll_ms: kind.poll_ms(),
            poll_at: now,
            settings: Vec::new(),
            reading: [0; 8],
            left_over: vec![None; kind.modes.len()],
            read_at: None,
            now,
            angle: 0.0,
            rate: 0.0,
            axle: Axle::default(),
            events: 0,
        }
    }

    pub(crate) fn port(&self) -> Port {
        self.port
    }

    /// True if a change wakes a program that polls `value0`: only a touch sensor's does.
    pub(crate) fn notifies(&self) -> bool {
        self.mode().sense == Sense::Touch
    }

    pub(crate) fn mode(&self) -> &'static Mode {
        if self.is_introducing_itself() { &kind::BLANK } else { &self.kind.modes[self.mode] }
    }

    /// The names of its modes as far as the driver knows them, the default first.
    fn modes(&self) -> impl Iterator<Item = &'static str> {
        let blank = self.is_introducing_itself().then_some(kind::BLANK.name);
        let known = blank.is_none().then(|| self.kind.modes());
        blank.into_iter().chain(known.into_iter().flatten())
    }

    fn is_silent(&self) -> bool {
        (self.silent[0]..self.silent[1]).contains(&self.now)
    }

    /// The wire was pulled, or put in again, and the port does not look for that: the sensor is
    /// silent meanwhile. A voltage there is at any rate.
    pub(crate) fn connect(&mut self, is_connected: bool) {
        if self.kind.link.is_analog() {
            return;
        }
        if is_connected {
            // Without power it has forgotten its settings.
            (self.angle, self.axle) = (0.0, Axle::default());
            (self.locked, self.last_single_shot, self.selecting_until) = (false, None, 0);
            self.settings.clear();
            self.silent[1] = self.now;
            self.introduce(INTRODUCTION_MS);
        } else {
            self.fall_silent(u64::MAX / 2);
        }
    }

    /// After its silence a sensor on a serial line has no mode and no values for a while; before
    /// that, too, if it was introducing itself when it fell silent.
    fn introduce(&mut self, ms: i32) {
        let is_at_once = self.instant || self.kind.link != Link::Uart;
        let from = if self.is_introducing_itself() { self.introduction[0] } else { self.silent[1] };
        let until = self.silent[1] + if is_at_once { 0 } else { ticks_from_ms(ms) };
        self.introduction = [from, until];
        self.settled_at = until;
        self.mode_since = until;
    }

    /// True once it was silent for so long that the driver awaits an introduction.
    fn is_given_up(&self) -> bool {
        self.is_silent() && self.now >= self.silent[0] + ticks_from_ms(MUTE_MS)
    }

    fn is_introducing_itself(&self) -> bool {
        (self.introduction[0]..self.introduction[1]).contains(&self.now)
    }

    fn has_data(&self) -> bool {
        !self.is_introducing_itself() && self.now >= self.first_data_at
    }

    /// Silences the sensor for a number of ticks. Nothing shows that its values are old. It has to
    /// introduce itself again if the driver gave it up meanwhile.
    pub(crate) fn fall_silent(&mut self, ticks: u64) {
        self.pending = None;
        let [from, until] = if self.is_silent() { self.silent } else { [self.now; 2] };
        self.silent = [from, until.max(self.now + ticks)];
        let is_given_up = self.silent[1] - from >= ticks_from_ms(MUTE_MS);
        self.introduce(if is_given_up { RESYNC_MS } else { 0 });
    }

    /// The next tick at which something happens by itself.
    pub(crate) fn next_event(&self) -> Option<u64> {
        let pending = self.pending.map_or(0, |(_, due)| due);
        let due = [pending, self.settled_at, self.silent[1], self.introduction[1]];
        due.into_iter().filter(|tick| *tick > self.now).min()
    }

    // ---- time -----------------------------------------------------------------------------

    /// One tick. `rate` is how fast the robot turns, `axle_rate` its left wheel's axle, in degrees
    /// per second.
    pub(crate) fn tick(&mut self, now: u64, rate: f64, axle_rate: f64) {
        self.now = now;
        self.rate = rate.clamp(-440.0, 440.0);
        #[expect(clippy::cast_precision_loss, reason = "two milliseconds")]
        let seconds = TICK_MS as f64 / 1000.0;
        self.angle = (self.angle + self.rate * seconds).clamp(-32768.0, 32767.0);
        self.axle.turn(axle_rate, seconds);
        if let Some((mode, due)) = self.pending {
            if due <= now {
                self.enter(mode);
            }
        }
        if self.mode().mute && !self.is_silent() && now >= self.mode_since + ticks_from_ms(MUTE_MS)
        {
            self.silent = [now; 2];
            self.introduce(RESYNC_MS);
        }
    }

    /// The first data of a mode have come. They may be stale. A gyro starts again from 0.
    fn enter(&mut self, mode: usize) {
        self.pending = None;
        if self.read_at.take().is_some() && !self.kind.is_gyro() {
            self.left_over[self.mode] = Some(self.reading);
        }
        self.mode = mode;
        self.mode_since = self.now;
        self.angle = 0.0;
        self.wanted = self.measures_once();
        self.settled_at = self.now;
        if let Some(stale) = self.left_over[mode].filter(|_| !self.instant && !self.measures_once())
        {
            self.reading = stale;
            self.settled_at += u64::from(self.kind.settling_ms).div_ceil(TICK_MS);
        }
    }

    // ---- values ---------------------------------------------------------------------------

    /// True if the world should be looked at before the values are read: they are not fresh, and
    /// not still left over from the last time in this mode.
    pub(crate) fn wants_reading(&self) -> bool {
        let stale = self.read_at != Some(self.now) && self.now >= self.settled_at;
        let is_sampled = self.is_on_bus() || self.kind.link.is_analog() && !self.instant;
        let at_will = !is_sampled && !self.measures_once();
        stale && self.has_data() && !self.is_silent() && (at_will || self.wanted)
    }

    fn measures_once(&self) -> bool {
        self.mode().is_single()
    }

    /// Takes raw data over. A changed touch sensor wakes those who poll `value0`.
    pub(crate) fn take(&mut self, reading: Reading) {
        let old = std::mem::replace(&mut self.reading, reading);
        self.read_at = Some(self.now);
        self.wanted = false;
        if self.is_on_bus() {
            self.polled();
        }
        let shown = |reading: Reading| self.mode().scale.shown(reading[0]);
        if self.notifies() && shown(old) != shown(reading) {
            self.events = self.events.wrapping_add(1);
        }
    }

    /// True at the sampling times of a sensor that is sampled rather than looked at when it is
    /// read: voltages on the 10 ms grid, what is on the I2C bus when it is polled.
    pub(crate) fn samples_now(&self) -> bool {
        if self.kind.link.is_analog() {
            return self.now % JIFFY_TICKS == 0;
        }
        self.is_on_bus() && self.is_polled_now() && !self.is_silent()
    }

    /// The values that the files show now, where the raw data are `fresh` if the sensor would
    /// take some; `None` while it has no data.
    pub(crate) fn shown(&self, fresh: Option<Reading>) -> Option<impl Iterator<Item = i32>> {
        let (mode, raw) = (self.mode(), fresh.unwrap_or(self.reading));
        self.has_data()
            .then(|| (0..mode.values.min(8)).map(move |index| mode.scale.shown(raw[index])))
    }

    fn value(&self, index: usize) -> Result<i32, Errno> {
        if self.has_data() && index < self.mode().values {
            Ok(self.mode().scale.shown(self.reading[index]))
        } else {
            Err(Errno::ENXIO)
        }
    }

    /// 32 bytes whatever the mode.
    fn bin_data(&self) -> Vec<u8> {
        let mut data = vec![0; 32];
        for (index, value) in self.reading.iter().take(self.mode().values).enumerate() {
            self.mode().format.put(*value, index, &mut data);
        }
        data
    }

    // ---- writes ---------------------------------------------------------------------------

    /// A write to `mode`, also of the present mode: a select message goes out.
    fn select(&mut self, mode: usize) -> Result<Effect, Errno> {
        if self.kind.link.is_analog() {
            self.show(mode);
            return Ok(Effect::Done);
        }
        if self.is_on_bus() {
            return self.select_on_bus(mode);
        }
        if self.is_given_up() {
            return Err(Errno::ENODEV);
        }
        if self.pending.is_some() || self.now < self.selecting_until.max(self.first_data_at) {
            return Err(Errno::EBUSY);
        }
        if self.kind.modes[mode].is_single() && !self.locked && !self.is_silent() {
            let ready = self.last_single_shot.map(|at| at + ticks_from_ms(SINGLE_SHOT_MS));
            self.locked = !self.instant && ready.is_some_and(|ready| self.now < ready);
            self.last_single_shot = Some(self.now);
        }
        if self.locked || self.is_silent() {
            return Ok(self.select_in_vain());
        }
        if self.instant {
            self.enter(mode);
            return Ok(Effect::Done);
        }
        self.pending = Some((mode, self.now + ticks_from_ms(MODE_LATENCY_MS)));
        Ok(Effect::Blocks(milliseconds(MODE_LATENCY_MS)))
    }

    /// The files show a mode, with what it showed last.
    fn show(&mut self, mode: usize) {
        if mode != self.mode {
            self.left_over[self.mode] = Some(self.reading);
            self.reading = self.left_over[mode].unwrap_or_default();
            self.mode = mode;
        }
        self.read_at = None;
    }

    /// The driver sends its message again and again, and nothing comes.
    fn select_in_vain(&mut self) -> Effect {
        let jiffies = jiffy(self.now) + SELECT_TRIES * SELECT_JIFFIES;
        self.selecting_until = jiffies * JIFFY_TICKS;
        let ticks = self.selecting_until - self.now;
        Effect::TimesOut(Duration::from_millis(ticks * TICK_MS))
    }

    /// A message to the sensor itself; on the I2C bus it goes to its registers. Of those to a
    /// serial sensor one does something: 0x11 zeroes the gyro's angle.
    pub(crate) fn direct_write(&mut self, offset: usize, bytes: &[u8]) -> Result<Effect, Errno> {
        if self.kind.link.is_analog() {
            return Err(Errno::EOPNOTSUPP);
        }
        if self.is_on_bus() {
            return self.write_registers(offset, bytes);
        }
        if offset > 0 || bytes.len() > 32 {
            return Err(Errno::EINVAL);
        }
        if self.mode().sense == Sense::Angle && bytes.first() == Some(&0x11) {
            self.angle = 0.0;
            self.read_at = None;
        }
        Ok(Effect::Done)
    }
}
