//! One device: its attributes as kept descriptors, and its constants.
mod attribute;
mod gears;
mod list;
pub(crate) mod motion;
mod observer;
pub mod registry;
pub mod retry;
pub mod sleep;

use crate::class::{Class, Detected};
use crate::device::attribute::{Attribute, LINE, PAGE, SHORT, malformed, open, read_node, text_of};
pub use crate::device::attribute::{read_file, read_value, write_file};
pub(crate) use crate::device::gears::Gears;
use crate::device::list::List;
use crate::device::motion::MotorRun;
pub(crate) use crate::device::observer::{MotionObserver, Observer};
use crate::error::{Access, Error, Result};
use crate::journal::{Act, Journal, MotorCommand, Name, Written};
use crate::sysfs::{AttributeFile, Entry, Sysfs};
use crate::value::{first_line, integer};
use ev3_os::Errno;
use ev3_os::locked;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard};
use std::thread::{self, ThreadId};
use std::time::Duration;

/// How long a device in a plain tree is believed to be there, in microseconds:
/// less than it takes to delete one.
const PRESENT_FOR_US: u32 = 100;

/// A motor, a sensor, a port, a light or the battery.
pub struct Device {
    class: Class,
    port: Box<str>,
    driver: Box<str>,
    path: PathBuf,
    entry: Entry,
    /// A file that exists as long as the device does.
    presence: Box<dyn AttributeFile>,
    /// When it was last found to be there, in microseconds, wrapping around.
    present_at_us: AtomicU32,
    first_seen: Duration,
    tree: Arc<dyn Sysfs>,
    attributes: List<Attribute>,
    constants: List<Constant>,
    /// The last command to a motor.
    run: Mutex<Option<MotorRun>>,
    /// The set-points that the next command copies.
    written: Written,
    /// Whether the files are open that start and stop it.
    is_prepared: AtomicBool,
    /// The number of the last command, among those of the whole program.
    commanded: AtomicU32,
    /// The thread that gave it.
    commander: AtomicU32,
    /// Learns of commands that start it.
    observer: Arc<Observer>,
    /// Where commands are noted.
    journal: Arc<Journal>,
    /// The gears of all motors.
    gears: Arc<Gears>,
    /// The thread that is putting a sensor into a mode and reading it there.
    user: Mutex<Option<ThreadId>>,
    /// When its values will have settled in that mode; zero once they have.
    settled_at: Mutex<Duration>,
    /// What a gyro had turned by before its mode changed.
    turned: Mutex<Turned>,
}

/// What a gyro had turned by before its mode changed.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Turned {
    /// To be added to the angle.
    pub(crate) offset: i64,
    /// The angle before a change of mode, until the angle after it is known.
    pub(crate) before: Option<i64>,
}

/// A number that cannot change while the device is plugged in.
struct Constant {
    attribute: &'static str,
    /// The sensor's mode that it belongs to; empty if to any.
    mode: Box<str>,
    value: i64,
}

impl Device {
    /// Reads which device an entry of a class directory is.
    pub(crate) fn detect(
        tree: &Arc<dyn Sysfs>,
        observer: &Arc<Observer>,
        journal: &Arc<Journal>,
        gears: &Arc<Gears>,
        class: Class,
        entry: Entry,
    ) -> Result<Self> {
        let path = tree.root().join(class.directory()).join(&entry.name);
        let (presence, address, driver) = match class {
            // These have no address: their directories are named after them.
            Class::Led => named(&**tree, &path.join("brightness"), &entry.name)?,
            Class::Battery => named(&**tree, &path.join("voltage_now"), &entry.name)?,
            _ => {
                let (presence, address) = address_of(&**tree, &path)?;
                (presence, address, read_file(&**tree, &path.join("driver_name"))?)
            }
        };
        Ok(Self {
            class,
            port: crate::port_name::short(&address).into(),
            driver: driver.into(),
            path,
            entry,
            presence,
            present_at_us: AtomicU32::default(),
            first_seen: tree.now(),
            tree: Arc::clone(tree),
            attributes: List::default(),
            constants: List::default(),
            commanded: AtomicU32::new(u32::MAX),
            commander: AtomicU32::new(u32::MAX),
            run: Mutex::default(),
            written: Written::default(),
            is_prepared: AtomicBool::default(),
            observer: Arc::clone(observer),
            journal: Arc::clone(journal),
            gears: Arc::clone(gears),
            user: Mutex::default(),
            settled_at: Mutex::default(),
            turned: Mutex::default(),
        })
    }

    /// The kind of device.
    pub fn class(&self) -> Class {
        self.class
    }

    /// The port it is plugged into, by its short name: `outA`. Of a light or a
    /// battery, the name of its directory.
    pub fn port(&self) -> &str {
        &self.port
    }

    /// Its type: `lego-ev3-l-motor`.
    pub fn driver(&self) -> &str {
        &self.driver
    }

    /// Its directory.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The tree it is in, whose clock it lives by.
    pub fn tree(&self) -> &dyn Sysfs {
        &*self.tree
    }

    /// Its description for programs.
    pub fn detected(&self) -> Detected {
        Detected {
            port: self.port().to_owned(),
            driver: self.driver().to_owned(),
            path: self.path.clone(),
        }
    }

    /// The error that says that it was unplugged.
    pub(crate) fn unplugged(&self) -> Error {
        Error::Unplugged { class: self.class, port: self.port().to_owned() }
    }

    pub(crate) fn entry(&self) -> &Entry {
        &self.entry
    }

    /// Whether it is what an entry of its class directory stands for. A file system may give a new
    /// directory the inode number of one that was removed; the kernel's devices have each its own.
    pub(crate) fn is_at(&self, entry: &Entry) -> bool {
        self.entry == *entry && self.check_present().is_ok()
    }

    /// When it was first seen, by the tree's clock.
    pub(crate) fn first_seen(&self) -> Duration {
        self.first_seen
    }

    /// Fails as a read of an unplugged device does, where the reads themselves do not notice (see
    /// [`AttributeFile::check_present`]). The result is trusted for [`PRESENT_FOR_US`].
    pub fn check_present(&self) -> Result<()> {
        if self.presence.is_plain() { self.check_present_at(self.tree.now()) } else { Ok(()) }
    }

    /// The same, when it is that time.
    pub fn check_present_at(&self, now: Duration) -> Result<()> {
        if !self.presence.is_plain() {
            return Ok(());
        }
        #[expect(clippy::cast_possible_truncation, reason = "only differences count")]
        let now = now.as_micros() as u32;
        let checked = self.present_at_us.load(Ordering::Relaxed);
        if now.wrapping_sub(checked) < PRESENT_FOR_US {
            return Ok(());
        }
        self.presence
            .check_present()
            .map_err(|source| Error::Read { path: self.path.join("address"), source })?;
        self.present_at_us.store(now, Ordering::Relaxed);
        Ok(())
    }

    /// The last command to the motor.
    pub(crate) fn run(&self) -> MutexGuard<'_, Option<MotorRun>> {
        locked(&self.run)
    }

    /// The journal of the tree.
    pub(crate) fn journal(&self) -> &Journal {
        &self.journal
    }

    /// Notes in the journal that the motor got a command.
    pub(crate) fn note_command(&self, now: Duration, word: &str) {
        if let Some(command) = MotorCommand::of(self.class, word, &self.written) {
            self.journal.note(now, Act::Motor(Name::from(self.port()), command));
        }
        if word == "reset" {
            self.written.forget();
        }
    }

    /// Whether the files are open that start and stop a motor. They stay open.
    pub(crate) fn is_prepared(&self) -> bool {
        self.is_prepared.load(Ordering::Relaxed)
    }

    /// The files are open that start and stop a motor.
    pub(crate) fn note_prepared(&self) {
        self.is_prepared.store(true, Ordering::Relaxed);
    }

    /// The program has given the motor a command.
    pub(crate) fn was_commanded(&self) {
        self.commanded.store(motion::next_command(), Ordering::Relaxed);
        self.commander.store(motion::commander(), Ordering::Relaxed);
    }

    /// Whether the last command of the program to the motor was one of these, of this thread.
    pub(crate) fn is_commanded_in(&self, commands: &Range<u32>) -> bool {
        commands.contains(&self.commanded.load(Ordering::Relaxed))
            && self.is_commanded_by(motion::commander())
    }

    /// Whether a thread, by its number, gave the last command.
    pub(crate) fn is_commanded_by(&self, commander: u32) -> bool {
        self.commander.load(Ordering::Relaxed) == commander
    }

    /// Reports that the motor was started.
    pub(crate) fn started(&self) {
        if let Some(observer) = self.observer.get() {
            observer.motor_started();
        }
    }

    /// Does a write that changes the motor's count without turning the motor:
    /// the odometry must not take it for a movement.
    pub(crate) fn without_counting(&self, write: &mut dyn FnMut() -> Result<()>) -> Result<()> {
        match self.observer.get() {
            Some(observer) => observer.without_counting(self.port(), write),
            None => write(),
        }
    }

    /// The right to change the sensor's mode, if no other thread has it. A thread that has it gets
    /// it again: a signal that it handles while it waits may ask for the same sensor.
    pub(crate) fn try_use(&self) -> Option<Use<'_>> {
        let me = thread::current().id();
        let mut user = locked(&self.user);
        match *user {
            None => {
                *user = Some(me);
                Some(Use { device: self, is_outermost: true })
            }
            Some(holder) if holder == me => Some(Use { device: self, is_outermost: false }),
            Some(_) => None,
        }
    }

    /// When the sensor's values will have settled; zero once they have.
    pub(crate) fn settled_at(&self) -> MutexGuard<'_, Duration> {
        locked(&self.settled_at)
    }

    /// What a gyro had turned by before its mode changed.
    pub(crate) fn turned(&self) -> MutexGuard<'_, Turned> {
        locked(&self.turned)
    }

    /// An integer attribute.
    /// Errors: [`Error::Malformed`] where the file holds none, else the kernel's.
    pub fn number(&self, attribute: &str) -> Result<i64> {
        let attribute = self.attribute(attribute);
        let mut buffer = [0; SHORT];
        let mut text = first_line(attribute.read(self.tree(), &mut buffer)?);
        if text.is_empty() && attribute.is_plain(self.tree())? {
            text = first_line(attribute.read_written(self.tree(), &mut buffer)?);
        }
        integer(text).ok_or_else(|| attribute.malformed(text, "an integer"))
    }

    /// An integer that cannot change while the device is plugged in: read once.
    pub fn constant(&self, attribute: &'static str) -> Result<i64> {
        self.constant_in(attribute, "")
    }

    /// An integer that depends on nothing but the sensor's mode: read once for each.
    pub fn constant_in(&self, attribute: &'static str, mode: &str) -> Result<i64> {
        if let Some(value) = self.known_in(attribute, mode) {
            return Ok(value);
        }
        let value = self.number(attribute)?;
        self.know_in(attribute, mode, value);
        Ok(value)
    }

    /// A number that [`know_in`](Self::know_in) remembered for a mode.
    pub(crate) fn known_in(&self, name: &str, mode: &str) -> Option<i64> {
        let is_it = |constant: &Constant| constant.attribute == name && *constant.mode == *mode;
        self.constants.find(is_it).map(|constant| constant.value)
    }

    /// Remembers a number that depends on nothing but the sensor's mode. A number
    /// that is known already stays.
    pub(crate) fn know_in(&self, name: &'static str, mode: &str, value: i64) {
        let is_it = |constant: &Constant| constant.attribute == name && *constant.mode == *mode;
        let make = || Constant { attribute: name, mode: mode.into(), value };
        self.constants.find_or_push(is_it, make);
    }

    /// Whether an attribute only stores what is written to it.
    pub(crate) fn is_plain(&self, attribute: &str) -> Result<bool> {
        self.attribute(attribute).is_plain(self.tree())
    }

    /// The bytes of an attribute that is not a text; how many there are.
    /// Errors: [`Error::Malformed`] where they fill the buffer, else the kernel's.
    pub(crate) fn bytes(&self, attribute: &str, buffer: &mut [u8]) -> Result<usize> {
        Ok(self.attribute(attribute).read(self.tree(), buffer)?.len())
    }

    /// Fills a buffer with what an attribute that is not a text has from an offset on.
    /// Errors: [`Error::Malformed`] where it is shorter, else the kernel's.
    pub(crate) fn read_at(&self, attribute: &str, buffer: &mut [u8], offset: u8) -> Result<()> {
        self.attribute(attribute).read_at(self.tree(), buffer, offset)
    }

    /// Writes an attribute that is not a text, from an offset on.
    pub(crate) fn write_at(&self, attribute: &str, bytes: &[u8], offset: u8) -> Result<()> {
        self.attribute(attribute).write_at(self.tree(), bytes, offset)
    }

    /// Calls `look` with the text of a short attribute, such as `mode` or `state`.
    /// Errors: [`Error::Malformed`] where the text is not UTF-8, else the kernel's.
    pub fn with_word<T>(&self, attribute: &str, look: impl FnOnce(&str) -> T) -> Result<T> {
        let attribute = self.attribute(attribute);
        let mut buffer = [0; SHORT];
        let text = first_line(attribute.read(self.tree(), &mut buffer)?);
        let word = std::str::from_utf8(text).map_err(|_| attribute.malformed(text, "a word"))?;
        Ok(look(word))
    }

    /// Whether a short attribute, such as `mode`, is that word.
    /// Errors: [`Error::Malformed`] where the text is not UTF-8, else the kernel's.
    pub(crate) fn is_word(&self, attribute: &str, word: &str) -> Result<bool> {
        let attribute = self.attribute(attribute);
        let mut buffer = [0; SHORT];
        let text = attribute.read(self.tree(), &mut buffer)?;
        let rest = text.strip_prefix(word.as_bytes());
        if rest.is_some_and(|rest| matches!(rest, [] | [b'\n', ..])) {
            return Ok(true);
        }
        let other = first_line(text);
        std::str::from_utf8(other).map_err(|_| attribute.malformed(other, "a word"))?;
        Ok(false)
    }

    /// The text of an attribute. Errors: [`Error::Malformed`] where it is not UTF-8 or is longer
    /// than a page, else the kernel's.
    pub fn text(&self, attribute: &str) -> Result<String> {
        let attribute = self.attribute(attribute);
        let mut line = [0; LINE];
        match attribute.read(self.tree(), &mut line) {
            // More than fits: once more, with all the room there may be.
            Err(Error::Malformed { .. }) => {}
            read => return text_of(&attribute.path, read?),
        }
        let mut page = [0; PAGE + 1];
        text_of(&attribute.path, attribute.read(self.tree(), &mut page)?)
    }

    /// Calls `look` with the text of an attribute, and whether an integer belongs there.
    /// `None` where it cannot be read, or is not short.
    pub(crate) fn with_short<T>(
        &self,
        attribute: &str,
        look: impl FnOnce(&[u8], bool) -> Option<T>,
    ) -> Option<T> {
        let attribute = self.attribute(attribute);
        let mut buffer = [0; SHORT];
        let text = attribute.read(self.tree(), &mut buffer).ok()?;
        look(text.strip_suffix(b"\n").unwrap_or(text), attribute.holds_integer)
    }

    /// Writes an attribute. Errors: the kernel's, as EINVAL for a value that is not accepted.
    pub fn write(&self, attribute: &str, text: &str) -> Result<()> {
        self.attribute(attribute).write(self.tree(), text)?;
        self.written.note(attribute, text);
        Ok(())
    }

    /// Opens an attribute for writing, so that a later write cannot fail for want of permission.
    pub(crate) fn prepare(&self, attribute: &str) -> Result<()> {
        self.attribute(attribute).writer(self.tree()).map(drop)
    }

    /// Writes an integer.
    pub fn write_number(&self, attribute: &str, number: i64) -> Result<()> {
        let mut buffer = itoa::Buffer::new();
        self.attribute(attribute).write(self.tree(), buffer.format(number))?;
        self.written.note_number(attribute, number);
        Ok(())
    }

    /// How many times a motor turns while what it drives turns once.
    pub fn gear(&self) -> f64 {
        self.gears.of(&self.port)
    }

    /// Sets that for the motor's port.
    pub(crate) fn set_gear(&self, ratio: f64) {
        self.gears.set(&self.port, ratio);
    }

    /// Whether it is a linear actuator: it counts in lengths, not in turns.
    pub(crate) fn is_linear(&self) -> bool {
        self.entry.name.starts_with("linear")
    }

    /// Whether udev has made its files writable for this user, which takes up to a
    /// second after a device appears (docs/ev3dev-sysfs.md, 0.1). This tries a file
    /// that is writable on every device of the class.
    pub(crate) fn is_writable(&self) -> bool {
        let file = match self.class {
            Class::TachoMotor | Class::DcMotor | Class::ServoMotor => "command",
            Class::Sensor | Class::Port => "mode",
            Class::Led => "brightness",
            Class::Battery => return true,
        };
        let opened = self.tree.open(&self.path.join(file), Access::Write);
        opened.err().and_then(|error| Errno::from_io_error(&error)) != Some(Errno::ACCESS)
    }

    /// The attribute of that name, whether or not there is such a file.
    pub(crate) fn attribute(&self, name: &str) -> &Attribute {
        let is_it = |attribute: &Attribute| *attribute.name == *name;
        self.attributes.find_or_push(is_it, || Attribute::new(name, &self.path))
    }
}

/// The right to change a sensor's mode; given back when dropped.
pub(crate) struct Use<'a> {
    device: &'a Device,
    is_outermost: bool,
}

impl Drop for Use<'_> {
    fn drop(&mut self) {
        if self.is_outermost {
            *locked(&self.device.user) = None;
        }
    }
}

/// A device that is known by its name, if it has a certain file.
fn named(
    tree: &dyn Sysfs,
    path: &Path,
    name: &str,
) -> Result<(Box<dyn AttributeFile>, String, String)> {
    Ok((open(tree, path, Access::Read)?, name.to_owned(), name.to_owned()))
}

/// Reads the `address` and `driver_name` of the device at a path.
/// Errors: the kernel's; [`Error::Malformed`] if there is no address.
pub fn identity(tree: &dyn Sysfs, path: &Path) -> Result<(String, String)> {
    let (_, address) = address_of(tree, path)?;
    Ok((address, read_file(tree, &path.join("driver_name"))?))
}

/// Reads the `address` of the device at a path; also the open file.
fn address_of(tree: &dyn Sysfs, path: &Path) -> Result<(Box<dyn AttributeFile>, String)> {
    let path = path.join("address");
    let node = open(tree, &path, Access::Read)?;
    let mut buffer = [0; SHORT];
    let address = text_of(&path, read_node(&*node, &path, &mut buffer)?)?;
    if address.is_empty() {
        return Err(malformed(&path, b"", "an address"));
    }
    Ok((node, address))
}
