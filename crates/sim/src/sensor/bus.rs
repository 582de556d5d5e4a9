//! Sensors on the I2C bus.
//!
//! The kernel polls them: between two polls their values stay what they
//! are. A write of the mode makes it be read at once, and from then on; each mode keeps what it
//! was last read as. Without polling that one reading is done before the write returns, and it is
//! still that of the mode before.
use super::{Link, Reading, Sensor};
use crate::files::attr::Effect;
use crate::files::text::{lenient_unsigned, signed};
use crate::ticks::{TICK_MS, milliseconds, ticks_from_ms};
use ev3_os::linux::Errno;

/// The time of one message on the I2C bus, and the time until the next answer.
const BUS_MS: i32 = 4;
/// What the sensors on the I2C bus say of their version, and where it, who made them, what they
/// are, the first register that can be written, and their data lie.
const VERSION: &str = "V1.0";
const VERSION_REGISTER: usize = 0x00;
const VENDOR_REGISTER: usize = 0x08;
const PRODUCT_REGISTER: usize = 0x10;
const SETTINGS_REGISTER: usize = 0x18;
const DATA_REGISTER: usize = 0x42;
/// Numbers of errors are at most this.
const LAST_ERRNO: i32 = 4095;
/// How many registers there are, of which the file `direct` shows all but the last.
const REGISTERS: usize = 256;
/// As many bytes go over the bus in one message, by `I2C_SMBUS_BLOCK_MAX`.
const BLOCK: usize = 32;

impl Sensor {
    /// The address that the files show: on the I2C bus, with that of the sensor.
    pub(super) fn address(&self) -> String {
        match self.kind.link {
            Link::I2c(address) => format!("{}:i2c{address}", self.port.address()),
            _ => self.port.address().to_owned(),
        }
    }

    pub(super) fn is_on_bus(&self) -> bool {
        matches!(self.kind.link, Link::I2c(_))
    }

    /// What a sensor on the bus says of its version. LEGO's thermometer says nothing.
    pub(super) fn version(&self) -> &'static str {
        let has_one = self.is_on_bus() && self.kind.driver_name != "lego-nxt-temp";
        if has_one { VERSION } else { "" }
    }

    /// True at the times when the kernel reads it. What measures once shows the same at the next
    /// ones.
    pub(super) fn is_polled_now(&self) -> bool {
        let is_polled = self.poll_ms > 0 && self.now >= self.poll_at && !self.measures_once();
        (is_polled || self.wanted) && self.now >= self.settled_at
    }

    /// It has been read: the next time is a period later.
    pub(super) fn polled(&mut self) {
        let period = u64::from(self.poll_ms).div_ceil(TICK_MS);
        if period > 0 && self.poll_at <= self.now {
            self.poll_at += ((self.now - self.poll_at) / period + 1) * period;
        }
    }

    /// ENXIO while nobody answers messages on the bus.
    fn answers(&self) -> Result<(), Errno> {
        if self.is_silent() { Err(Errno::ENXIO) } else { Ok(()) }
    }

    /// How long a message takes, in ms.
    fn message_ms(&self) -> i32 {
        if self.instant { 0 } else { BUS_MS }
    }

    /// The mode of a sensor on the I2C bus: a message where it has a register for that, and a
    /// reading, for which the write waits if there will be no other. Where nobody answers the
    /// message there is no reading, and polling has ended; a reading that fails is not an error.
    pub(super) fn select_on_bus(&mut self, mode: usize) -> Result<Effect, Errno> {
        let message = self.message_ms();
        let mut blocks = 0;
        if self.kind.has_mode_register(mode) {
            blocks += message;
            self.answers().inspect_err(|_| self.poll_at = u64::MAX)?;
        }
        let before = self.mode;
        self.show(mode);
        let read_at = self.now + ticks_from_ms(blocks + message);
        let is_polled = self.poll_ms > 0;
        if is_polled {
            self.read_first(read_at);
        } else {
            blocks += message;
        }
        let time = milliseconds(blocks);
        let is_read = !is_polled && !self.is_silent();
        Ok(if is_read { Effect::Reads(before, time) } else { Effect::Blocks(time) })
    }

    /// Polling begins with a reading that is there at a tick.
    fn read_first(&mut self, at: u64) {
        self.wanted = true;
        (self.settled_at, self.poll_at) = (at, at);
    }

    /// Takes raw data over that were read in a mode.
    pub(crate) fn take_in(&mut self, mode: usize, reading: Reading) {
        if mode == self.mode {
            self.take(reading);
        } else {
            self.left_over[mode] = Some(reading);
        }
    }

    /// One of the kind's commands. Those that set zeros do; the others change nothing that could
    /// be measured here.
    pub(super) fn command(&mut self, index: usize) -> Result<Effect, Errno> {
        self.answers()?;
        match self.kind.commands[index] {
            "RESET" => {
                self.axle.reset();
                self.angle = 0.0;
            }
            "CAL" => {
                self.axle.calibrate();
            }
            _ => {}
        }
        Ok(Effect::Done)
    }

    /// A period that is negative as a number with a sign is taken for an error.
    pub(super) fn poll_ms(&self) -> Result<u32, Errno> {
        if !self.is_on_bus() {
            return Err(Errno::EOPNOTSUPP);
        }
        match signed(self.poll_ms) {
            0.. => Ok(self.poll_ms),
            error if error >= -LAST_ERRNO => Err(Errno(-error)),
            _ => Err(Errno::EINVAL),
        }
    }

    /// The first reading is done at once, as the period begins; another period begins with the
    /// next reading.
    pub(super) fn set_poll_ms(&mut self, bytes: &[u8]) -> Result<Effect, Errno> {
        if !self.is_on_bus() {
            return Err(Errno::EOPNOTSUPP);
        }
        let poll_ms = lenient_unsigned(bytes)?;
        if self.poll_ms == 0 && poll_ms > 0 {
            self.read_first(self.now + ticks_from_ms(self.message_ms()));
        }
        self.poll_ms = poll_ms;
        Ok(Effect::Done)
    }

    /// Reads registers. The driver answers as many bytes as it was asked for, also where it did
    /// not read them.
    pub(crate) fn direct_read(&self, register: usize, count: usize) -> Result<Vec<u8>, Errno> {
        if !self.is_on_bus() {
            return Err(Errno::EOPNOTSUPP);
        }
        self.answers()?;
        let mut bytes: Vec<u8> = self.registers().into_iter().skip(register).take(BLOCK).collect();
        bytes.resize(count, 0);
        Ok(bytes)
    }

    /// Writes registers: what is beyond a message is dropped. What a sensor says of itself and
    /// what it measures stays; all else is kept, and does nothing.
    pub(super) fn write_registers(
        &mut self,
        register: usize,
        bytes: &[u8],
    ) -> Result<Effect, Errno> {
        self.answers()?;
        for (at, byte) in (register..REGISTERS).zip(bytes.iter().take(BLOCK)) {
            if (DATA_REGISTER..DATA_REGISTER + BLOCK).contains(&at) || at < SETTINGS_REGISTER {
                continue;
            }
            self.settings.retain(|(other, _)| *other != at);
            self.settings.push((at, *byte));
        }
        Ok(Effect::Blocks(milliseconds(self.message_ms())))
    }

    /// The registers of a sensor on the I2C bus, as far as there is something in them.
    fn registers(&self) -> Vec<u8> {
        let mut registers = vec![0; REGISTERS];
        let [vendor, product] = self.kind.identity();
        for (at, text) in [
            (VERSION_REGISTER, self.version()),
            (VENDOR_REGISTER, vendor),
            (PRODUCT_REGISTER, product),
        ] {
            registers[at..at + text.len()].copy_from_slice(text.as_bytes());
        }
        let data = self.bin_data();
        registers[DATA_REGISTER..DATA_REGISTER + data.len()].copy_from_slice(&data);
        for (at, byte) in &self.settings {
            registers[*at] = *byte;
        }
        registers
    }
}
