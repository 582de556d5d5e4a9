//! The tree of files: classes, devices, attributes.
//!
//! A node's number is its inode number. It is made of the device's serial number, which is never
//! used again, and the row of the attribute in its class's table; so nothing has to be stored, and
//! a node of a device that is gone stays gone when another comes to the same port.
use crate::brick::output::Output;
use crate::brick::port::LegoPort;
use crate::brick::{Battery, Board, Framebuffer, Led};
use crate::files::attr::{Access, Effect, Files};
use crate::motor::Tacho;
use crate::motor::dc::DcMotor;
use crate::motor::servo::Servo;
use crate::sensor::Sensor;
use crate::trace::File;
use ev3_os::linux::Errno;
use std::sync::Arc;

/// A file or directory: its inode number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct NodeId(pub u64);

impl NodeId {
    /// The class directory itself, what `/sys/class` is.
    pub const ROOT: NodeId = NodeId(1);
}

/// The kind of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A directory.
    Directory,
    /// An attribute.
    File,
}

/// The result of `stat(2)`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stat {
    /// Inode number.
    pub node: NodeId,
    /// Directory or attribute.
    pub kind: FileKind,
    /// Permission bits, such as 0o664. The group is `ev3dev`.
    pub mode: u16,
    /// 4096 for texts, 32 for `bin_data`, 255 for `direct`, 0 for directories.
    pub size: u32,
}

/// One line of a directory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its name.
    pub name: String,
    /// Its inode number.
    pub node: NodeId,
    /// Directory or attribute.
    pub kind: FileKind,
}

/// The class directories, in alphabetical order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Class {
    BoardInfo,
    DcMotor,
    Graphics,
    LegoPort,
    LegoSensor,
    Leds,
    PowerSupply,
    ServoMotor,
    TachoMotor,
}

/// Name of the class, what its devices are called before their number, and whether udev opens
/// their files to the group.
const CLASSES: [(Class, &str, &str, bool); 9] = [
    (Class::BoardInfo, "board-info", "board", false),
    (Class::DcMotor, "dc-motor", "motor", true),
    (Class::Graphics, "graphics", "fb", false),
    (Class::LegoPort, "lego-port", "port", true),
    (Class::LegoSensor, "lego-sensor", "sensor", true),
    (Class::Leds, "leds", "", true),
    (Class::PowerSupply, "power_supply", "", false),
    (Class::ServoMotor, "servo-motor", "motor", true),
    (Class::TachoMotor, "tacho-motor", "motor", true),
];

/// A device of any class.
#[derive(Clone, Debug)]
pub(crate) enum Hardware {
    Tacho(Box<Tacho>),
    Sensor(Box<Sensor>),
    DcMotor(DcMotor),
    Servo(Servo),
    Port(LegoPort),
    Led(Led),
    Battery(Battery),
    Board(Board),
    Framebuffer(Framebuffer),
}

impl Hardware {
    fn class(&self) -> Class {
        match self {
            Hardware::Tacho(_) => Class::TachoMotor,
            Hardware::Sensor(_) => Class::LegoSensor,
            Hardware::DcMotor(_) => Class::DcMotor,
            Hardware::Servo(_) => Class::ServoMotor,
            Hardware::Port(_) => Class::LegoPort,
            Hardware::Led(_) => Class::Leds,
            Hardware::Battery(_) => Class::PowerSupply,
            Hardware::Board(_) => Class::BoardInfo,
            Hardware::Framebuffer(_) => Class::Graphics,
        }
    }

    fn files(&self) -> &dyn Files {
        match self {
            Hardware::Tacho(device) => device.as_ref(),
            Hardware::Sensor(device) => device.as_ref(),
            Hardware::DcMotor(device) => device,
            Hardware::Servo(device) => device,
            Hardware::Port(device) => device,
            Hardware::Led(device) => device,
            Hardware::Battery(device) => device,
            Hardware::Board(device) => device,
            Hardware::Framebuffer(device) => device,
        }
    }

    fn files_mut(&mut self) -> &mut dyn Files {
        match self {
            Hardware::Tacho(device) => device.as_mut(),
            Hardware::Sensor(device) => device.as_mut(),
            Hardware::DcMotor(device) => device,
            Hardware::Servo(device) => device,
            Hardware::Port(device) => device,
            Hardware::Led(device) => device,
            Hardware::Battery(device) => device,
            Hardware::Board(device) => device,
            Hardware::Framebuffer(device) => device,
        }
    }

    /// The bridge of the output port that this drives.
    pub(crate) fn output(&self) -> Option<Output> {
        match self {
            Hardware::Tacho(motor) => Some(motor.output),
            Hardware::DcMotor(motor) => Some(motor.output),
            Hardware::Led(led) => led.output,
            _ => None,
        }
    }

    fn events(&self, attribute: &str) -> u32 {
        match self {
            Hardware::Tacho(motor) if attribute == "state" => motor.events,
            Hardware::Sensor(sensor) if attribute == "value0" => sensor.events,
            _ => 0,
        }
    }

    /// An attribute shows another text: those that notify do.
    fn changed(&mut self, attribute: &str) {
        let events = match self {
            Hardware::Tacho(motor) if attribute == "state" => &mut motor.events,
            Hardware::Sensor(sensor) if attribute == "value0" && sensor.notifies() => {
                &mut sensor.events
            }
            _ => return,
        };
        *events = events.wrapping_add(1);
    }
}

#[derive(Clone, Debug)]
pub(crate) struct Device {
    serial: u64,
    name: Arc<str>,
    class: Class,
    /// Tick until which udev has not yet changed the modes of the files.
    closed_until: u64,
    /// The same for files that appeared later.
    late_until: u64,
    /// Texts that attributes show instead of their own, by row.
    shown: Vec<(usize, Vec<u8>)>,
    pub(crate) hardware: Hardware,
}

/// The meaning of a node number.
enum Place<'a> {
    Root,
    Class(Class),
    Device(&'a Device),
    /// A directory in a device's, by the first attribute that is in it.
    Group(&'a Device, usize),
    Attribute(&'a Device, usize),
}

const FIRST_SERIAL: u64 = 16;
const SERIAL_SHIFT: u32 = 8;
const GROUP_BIT: u64 = 0x80;
pub(super) const PAGE: usize = 4096;
/// The binary file of a sensor.
const DIRECT: &str = "direct";

/// All devices, in the order of their registration.
#[derive(Clone, Debug)]
pub(crate) struct Tree {
    devices: Vec<Device>,
    next_serial: u64,
    numbers: [u32; CLASSES.len()],
}

impl Tree {
    pub(crate) fn new() -> Tree {
        Tree { devices: Vec::new(), next_serial: FIRST_SERIAL, numbers: [0; CLASSES.len()] }
    }

    // ---- devices --------------------------------------------------------------------------

    /// Registers a device under the next number of its class, or under a name of its own.
    pub(crate) fn add(&mut self, hardware: Hardware, closed_until: u64) -> u64 {
        let class = hardware.class();
        let number = &mut self.numbers[class as usize];
        let name = match &hardware {
            Hardware::Led(led) => led.name.clone(),
            Hardware::Battery(_) => Battery::NAME.to_owned(),
            Hardware::Tacho(motor) if motor.kind.travel.is_some() => format!("linear{number}"),
            _ => format!("{}{number}", CLASSES[class as usize].2),
        };
        *number += 1;
        let serial = self.next_serial;
        self.next_serial += 1;
        let (late_until, shown) = (0, Vec::new());
        self.devices.push(Device {
            serial,
            name: name.into(),
            class,
            closed_until,
            late_until,
            shown,
            hardware,
        });
        serial
    }

    /// Gives no number again that another tree has given already.
    pub(crate) fn count_on_from(&mut self, other: &Tree) {
        self.next_serial = self.next_serial.max(other.next_serial);
        for (number, other) in self.numbers.iter_mut().zip(other.numbers) {
            *number = (*number).max(other);
        }
    }

    pub(crate) fn remove(&mut self, serial: u64) {
        self.devices.retain(|device| device.serial != serial);
    }

    /// Files of a device appeared, which udev opens at that tick.
    pub(crate) fn appeared(&mut self, serial: u64, open_at: u64) {
        if let Some(device) = self.device_mut(serial) {
            device.late_until = open_at;
        }
    }

    /// Where a device stands: at its serial number, as long as none before it was removed.
    fn index(&self, serial: u64) -> Option<usize> {
        let first = usize::try_from(serial.wrapping_sub(FIRST_SERIAL)).unwrap_or(usize::MAX);
        if self.devices.get(first).is_some_and(|device| device.serial == serial) {
            return Some(first);
        }
        self.devices.binary_search_by_key(&serial, |device| device.serial).ok()
    }

    fn device(&self, serial: u64) -> Option<&Device> {
        self.devices.get(self.index(serial)?)
    }

    fn device_mut(&mut self, serial: u64) -> Option<&mut Device> {
        let index = self.index(serial)?;
        self.devices.get_mut(index)
    }

    pub(crate) fn hardware(&self, serial: u64) -> Option<&Hardware> {
        self.device(serial).map(|device| &device.hardware)
    }

    pub(crate) fn hardware_mut(&mut self, serial: u64) -> Option<&mut Hardware> {
        self.device_mut(serial).map(|device| &mut device.hardware)
    }

    pub(crate) fn all(&self) -> impl Iterator<Item = &Hardware> {
        self.devices.iter().map(|device| &device.hardware)
    }

    /// The device that a node belongs to.
    pub(crate) fn owner(node: NodeId) -> u64 {
        node.0 >> SERIAL_SHIFT
    }

    // ---- nodes ----------------------------------------------------------------------------

    fn place(&self, node: NodeId) -> Result<Place<'_>, Errno> {
        if node == NodeId::ROOT {
            return Ok(Place::Root);
        }
        let class = usize::try_from(node.0.wrapping_sub(NodeId::ROOT.0 + 1)).unwrap_or(usize::MAX);
        if let Some((class, ..)) = CLASSES.get(class) {
            return Ok(Place::Class(*class));
        }
        let device = self.device(node.0 >> SERIAL_SHIFT).ok_or(Errno::ENODEV)?;
        let below = node.0 & ((1 << SERIAL_SHIFT) - 1);
        let row = usize::try_from(below & !GROUP_BIT).unwrap_or(0);
        Ok(match below {
            0 => Place::Device(device),
            below if below & GROUP_BIT != 0 => Place::Group(device, row),
            _ => Place::Attribute(device, row - 1),
        })
    }

    fn attribute(&self, node: NodeId) -> Result<(&Device, usize), Errno> {
        match self.place(node)? {
            Place::Attribute(device, row) => Ok((device, row)),
            _ => Err(Errno::EISDIR),
        }
    }

    /// The node with this name in a directory.
    pub(crate) fn lookup(&self, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        let entries = self.entries(directory)?;
        let found = entries.into_iter().find(|(entry, ..)| *entry == name);
        found.map(|(_, node, _)| node).ok_or(Errno::ENOENT)
    }

    /// The node at a path below the root.
    pub(crate) fn resolve(&self, path: &str) -> Result<NodeId, Errno> {
        let mut parts = path.split('/').filter(|part| !part.is_empty() && *part != ".");
        parts.try_fold(NodeId::ROOT, |node, part| self.lookup(node, part))
    }

    pub(crate) fn list(&self, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        let entries = self.entries(directory)?;
        let own = |(name, node, kind): (&str, _, _)| Entry { name: name.to_owned(), node, kind };
        Ok(entries.into_iter().map(own).collect())
    }

    fn entries(&self, directory: NodeId) -> Result<Vec<(&str, NodeId, FileKind)>, Errno> {
        Ok(match self.place(directory)? {
            Place::Root => (0..)
                .zip(CLASSES)
                .map(|(index, (_, name, ..))| {
                    (name, NodeId(NodeId::ROOT.0 + 1 + index), FileKind::Directory)
                })
                .collect(),
            Place::Class(class) => self
                .devices
                .iter()
                .filter(|device| device.class == class)
                .map(|device| {
                    (&*device.name, NodeId(device.serial << SERIAL_SHIFT), FileKind::Directory)
                })
                .collect(),
            Place::Device(device) => device.entries(),
            Place::Group(device, first) => device.group_entries(first),
            Place::Attribute(..) => return Err(Errno::ENOTDIR),
        })
    }

    pub(crate) fn stat(&self, node: NodeId, now: u64) -> Result<Stat, Errno> {
        let Place::Attribute(device, row) = self.place(node)? else {
            return Ok(Stat { node, kind: FileKind::Directory, mode: 0o755, size: 0 });
        };
        let files = device.hardware.files();
        let open = device.open_to_group(row, now);
        let mode = match (files.access(row), open) {
            (Access::ReadOnly, _) => 0o444,
            (Access::ReadWrite, true) => 0o664,
            (Access::ReadWrite, false) => 0o644,
            (Access::WriteOnly, true) => 0o220,
            (Access::WriteOnly, false) => 0o200,
        };
        Ok(Stat { node, kind: FileKind::File, mode, size: files.size(row) })
    }

    /// The check of `open(2)`.
    pub(crate) fn may_open(&self, node: NodeId, access: Access, now: u64) -> Result<(), Errno> {
        let (device, row) = self.attribute(node)?;
        let allowed = device.hardware.files().access(row).allows(access);
        let early = access.writes() && now < device.closed_until(row);
        if allowed && !early { Ok(()) } else { Err(Errno::EACCES) }
    }

    pub(crate) fn measured(&self, node: NodeId) -> bool {
        self.attribute(node).is_ok_and(|(device, row)| device.hardware.files().measured(row))
    }

    /// True if reads and writes have offsets, as those of a sensor's `direct` have.
    pub(crate) fn is_binary(&self, node: NodeId) -> bool {
        self.attribute(node).is_ok_and(|(device, row)| device.direct(row).is_some())
    }

    pub(crate) fn read(&self, node: NodeId) -> Result<Vec<u8>, Errno> {
        let (device, row) = self.attribute(node)?;
        let shown = device.shown.iter().find(|(other, _)| *other == row);
        shown.map_or_else(|| device.hardware.files().read(row), |(_, text)| Ok(text.clone()))
    }

    /// Reads a binary file: nothing behind its size (`sysfs_kf_bin_read` in the kernel's
    /// `fs/sysfs/file.c`). `None` if it is a text.
    pub(crate) fn read_at(
        &self,
        node: NodeId,
        offset: usize,
        count: usize,
    ) -> Result<Option<Vec<u8>>, Errno> {
        let (device, row) = self.attribute(node)?;
        let Some(sensor) = device.direct(row) else {
            return Ok(None);
        };
        let count = count.min(device.room(row, offset));
        if count == 0 {
            return Ok(Some(Vec::new()));
        }
        match device.shown.iter().find(|(other, _)| *other == row) {
            Some((_, text)) => Ok(Some(text.iter().copied().skip(offset).take(count).collect())),
            None => sensor.direct_read(offset, count).map(Some),
        }
    }

    /// Makes an attribute show a text from now on, or its own one again; false if it does so
    /// already.
    pub(crate) fn show(
        &mut self,
        serial: u64,
        attribute: &str,
        text: Option<&str>,
    ) -> Result<bool, Errno> {
        let device = self.device_mut(serial).ok_or(Errno::ENODEV)?;
        let row = device.rows().find(|(_, _, name)| *name == attribute);
        let (row, ..) = row.ok_or(Errno::ENOENT)?;
        if device.hardware.files().access(row) == Access::WriteOnly {
            return Err(Errno::EACCES);
        }
        if text.is_some_and(|text| text.len() >= PAGE) {
            return Err(Errno::EINVAL);
        }
        let before = device.shown.iter().position(|(other, _)| *other == row);
        let before = before.map(|index| device.shown.swap_remove(index).1);
        let line = text.map(|text| format!("{text}\n").into_bytes());
        let is_new = before != line;
        device.shown.extend(line.map(|line| (row, line)));
        if is_new {
            device.hardware.changed(attribute);
        }
        Ok(is_new)
    }

    /// Writes a file. What is behind the size of a binary file is cut off, or refused where
    /// nothing is left (`sysfs_kf_bin_write`); how many bytes it took is answered, too.
    pub(crate) fn write(
        &mut self,
        node: NodeId,
        offset: usize,
        bytes: &[u8],
    ) -> Result<(Effect, Option<usize>), Errno> {
        let (device, row) = self.attribute(node)?;
        let serial = device.serial;
        let device = self.device_mut(serial).ok_or(Errno::ENODEV)?;
        let room = device.room(row, offset);
        let Some(sensor) = device.direct_mut(row) else {
            return device.hardware.files_mut().write(row, bytes).map(|effect| (effect, None));
        };
        if room == 0 {
            return Err(Errno::EFBIG);
        }
        let taken = &bytes[..bytes.len().min(room)];
        sensor.direct_write(offset, taken).map(|effect| (effect, Some(taken.len())))
    }

    pub(crate) fn events(&self, node: NodeId) -> Result<u32, Errno> {
        let (device, row) = self.attribute(node)?;
        Ok(device.hardware.events(device.hardware.files().name(row)))
    }

    /// Class, device and name of an attribute.
    pub(crate) fn file(&self, node: NodeId) -> Result<File, Errno> {
        let (device, row) = self.attribute(node)?;
        let class = CLASSES[device.class as usize].1;
        let attribute = device.hardware.files().name(row);
        Ok(File { class, device: Arc::clone(&device.name), attribute })
    }

    /// The path of a node, for messages and the trace.
    pub(crate) fn path(&self, node: NodeId) -> Result<String, Errno> {
        let class = |device: &Device| CLASSES[device.class as usize].1;
        Ok(match self.place(node)? {
            Place::Root => String::new(),
            Place::Class(class) => CLASSES[class as usize].1.to_owned(),
            Place::Device(device) => format!("{}/{}", class(device), device.name),
            Place::Group(device, first) => {
                let name = device.hardware.files().name(first);
                let group = name.split('/').next().unwrap_or(name);
                format!("{}/{}/{group}", class(device), device.name)
            }
            Place::Attribute(device, row) => {
                let name = device.hardware.files().name(row);
                format!("{}/{}/{name}", class(device), device.name)
            }
        })
    }
}

impl Device {
    /// The sensor, if that row is its `direct`.
    fn direct(&self, row: usize) -> Option<&Sensor> {
        match &self.hardware {
            Hardware::Sensor(sensor) if sensor.name(row) == DIRECT => Some(sensor),
            _ => None,
        }
    }

    fn direct_mut(&mut self, row: usize) -> Option<&mut Sensor> {
        match &mut self.hardware {
            Hardware::Sensor(sensor) if sensor.name(row) == DIRECT => Some(sensor),
            _ => None,
        }
    }

    /// How many bytes there are from an offset to the end of a file.
    fn room(&self, row: usize, offset: usize) -> usize {
        let size = usize::try_from(self.hardware.files().size(row)).unwrap_or(PAGE);
        size.saturating_sub(offset)
    }

    fn open_to_group(&self, row: usize, now: u64) -> bool {
        CLASSES[self.class as usize].3 && now >= self.closed_until(row)
    }

    fn closed_until(&self, row: usize) -> u64 {
        if self.hardware.files().late(row) {
            self.closed_until.max(self.late_until)
        } else {
            self.closed_until
        }
    }

    fn node(&self, below: u64) -> NodeId {
        NodeId((self.serial << SERIAL_SHIFT) | below)
    }

    /// The rows that exist at present, with their numbers.
    fn rows(&self) -> impl Iterator<Item = (usize, u64, &'static str)> {
        let files = self.hardware.files();
        (0..files.len())
            .zip(0u64..)
            .filter(move |(row, _)| files.exists(*row))
            .map(move |(row, number)| (row, number, files.name(row)))
    }

    /// Attributes by their names, and each directory of attributes once.
    fn entries(&self) -> Vec<(&str, NodeId, FileKind)> {
        let mut entries: Vec<(&str, NodeId, FileKind)> = Vec::new();
        for (_, number, name) in self.rows() {
            match name.split_once('/') {
                None => entries.push((name, self.node(number + 1), FileKind::File)),
                Some((group, _)) if entries.iter().all(|(name, ..)| *name != group) => {
                    entries.push((group, self.node(GROUP_BIT | number), FileKind::Directory));
                }
                Some(_) => {}
            }
        }
        entries
    }

    fn group_entries(&self, first: usize) -> Vec<(&str, NodeId, FileKind)> {
        let files = self.hardware.files();
        let group = files.name(first).split('/').next().unwrap_or("");
        self.rows()
            .filter_map(|(_, number, name)| {
                let (inside, name) = name.split_once('/')?;
                (inside == group).then(|| (name, self.node(number + 1), FileKind::File))
            })
            .collect()
    }
}
