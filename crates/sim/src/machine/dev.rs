//! The device files, which are below `/dev` on a brick.
//!
//! ```text
//! fb0
//! input/event0    input/by-path/platform-sound-event
//! input/event1    input/by-path/platform-gpio_keys-event
//! ```
//! The paths by which programs find an event device are links on a brick; here they are names of
//! the same file. The calls behave like the kernel's evdev and fbmem (known in general,
//! not read in their source).
use crate::brick::panel::{Button, ButtonEvent};
use crate::machine::Machine;
use crate::machine::tree::{Entry, FileKind, NodeId, Stat};
use ev3_os::linux::Errno;
use std::sync::Arc;
use std::time::Duration;

/// A device below `/dev`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Device {
    Keys,
    Sound,
    Screen,
}

const ROOT: u64 = NodeId::ROOT.0;
const INPUT: u64 = 2;
const BY_PATH: u64 = 3;
const KEYS: u64 = 4;
const SOUND: u64 = 5;
const SCREEN: u64 = 6;

/// A directory, a name in it, and what that is.
const ENTRIES: [(u64, &str, u64); 7] = [
    (ROOT, "fb0", SCREEN),
    (ROOT, "input", INPUT),
    (INPUT, "by-path", BY_PATH),
    (INPUT, "event0", SOUND),
    (INPUT, "event1", KEYS),
    (BY_PATH, "platform-gpio_keys-event", KEYS),
    (BY_PATH, "platform-sound-event", SOUND),
];

/// A word of this machine's kernel, of which the time in an event has two.
const WORD: usize = size_of::<usize>();
const EVENT_BYTES: usize = 2 * WORD + 8;

// From linux/input-event-codes.h
const EV_SYN: u16 = 0;
const EV_KEY: u16 = 1;
const EV_SND: u16 = 0x12;
const SND_BELL: u16 = 1;
const SND_TONE: u16 = 2;
const BELL_HERTZ: i32 = 1000;
/// Codes of keys are below 768.
const KEY_BYTES: usize = 96;

fn kind(node: NodeId) -> Result<FileKind, Errno> {
    match node.0 {
        ROOT | INPUT | BY_PATH => Ok(FileKind::Directory),
        KEYS | SOUND | SCREEN => Ok(FileKind::File),
        _ => Err(Errno::ENOENT),
    }
}

fn entries(directory: NodeId) -> Result<impl Iterator<Item = (&'static str, NodeId)>, Errno> {
    if kind(directory)? == FileKind::File {
        return Err(Errno::ENOTDIR);
    }
    let inside = ENTRIES.iter().filter(move |(parent, ..)| *parent == directory.0);
    Ok(inside.map(|(_, name, node)| (*name, NodeId(*node))))
}

impl Machine {
    /// The node with this name in a directory below `/dev`, whose root is [`NodeId::ROOT`].
    /// Errors: ENOENT; ENOTDIR.
    pub fn dev_lookup(&self, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        let found = entries(directory)?.find(|(entry, _)| *entry == name);
        found.map(|(_, node)| node).ok_or(Errno::ENOENT)
    }

    /// The entries of a directory below `/dev`. Errors: ENOTDIR.
    pub fn dev_read_dir(&self, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        let entry = |(name, node): (&str, NodeId)| {
            kind(node).map(|kind| Entry { name: name.to_owned(), node, kind })
        };
        entries(directory)?.map(entry).collect()
    }

    /// Kind, permission bits and size of a node below `/dev`. Only the screen has a size.
    /// Errors: ENOENT if there is no such node.
    pub fn dev_stat(&self, node: NodeId) -> Result<Stat, Errno> {
        let kind = kind(node)?;
        let (mode, size) = match (kind, node.0) {
            (FileKind::Directory, _) => (0o755, 0),
            (_, SCREEN) => (0o660, self.panel.screen.len()),
            _ => (0o660, 0),
        };
        Ok(Stat { node, kind, mode, size: u32::try_from(size).unwrap_or(u32::MAX) })
    }
}

/// An open device: a reader of events has a queue of its own.
#[derive(Clone, Debug)]
pub struct DevDescriptor {
    device: Device,
    /// How many events of keys were read, or were before it was opened.
    read: u64,
    /// Of the two records of an event the first was read.
    is_half: bool,
}

impl DevDescriptor {
    /// Opens a device by its path below `/dev`. Errors: ENOENT, ENOTDIR, EISDIR.
    pub fn open(machine: &Machine, path: &str) -> Result<DevDescriptor, Errno> {
        let mut parts = path.split('/').filter(|part| !part.is_empty());
        let node = parts.try_fold(NodeId::ROOT, |node, part| machine.dev_lookup(node, part))?;
        DevDescriptor::open_node(machine, node)
    }

    /// Opens a node. Errors: EISDIR.
    pub fn open_node(machine: &Machine, node: NodeId) -> Result<DevDescriptor, Errno> {
        let device = match node.0 {
            KEYS => Device::Keys,
            SOUND => Device::Sound,
            SCREEN => Device::Screen,
            _ => return Err(Errno::EISDIR),
        };
        Ok(DevDescriptor { device, read: machine.panel.event_count, is_half: false })
    }

    /// How many bytes there are; event devices have no end.
    pub fn length(&self, machine: &Machine) -> Option<usize> {
        (self.device == Device::Screen).then(|| machine.panel.screen.len())
    }

    /// Reads: the next events, or the screen from an offset on.
    /// Errors: EAGAIN if there is no event, EINVAL if the buffer has no room for one.
    pub fn read(
        &mut self,
        machine: &Machine,
        offset: usize,
        buffer: &mut [u8],
    ) -> Result<usize, Errno> {
        if self.device == Device::Screen {
            let rest = machine.panel.screen.get(offset..).unwrap_or(&[]);
            let length = rest.len().min(buffer.len());
            buffer[..length].copy_from_slice(&rest[..length]);
            return Ok(length);
        }
        if buffer.len() < EVENT_BYTES {
            return Err(Errno::EINVAL);
        }
        let mut length = 0;
        for record in buffer.chunks_exact_mut(EVENT_BYTES) {
            let Some(next) = self.next(machine) else {
                break;
            };
            record.copy_from_slice(&next);
            length += EVENT_BYTES;
        }
        if length == 0 { Err(Errno::EAGAIN) } else { Ok(length) }
    }

    /// The next record: each event of a key is followed by one that ends the report.
    fn next(&mut self, machine: &Machine) -> Option<[u8; EVENT_BYTES]> {
        if self.device != Device::Keys {
            return None;
        }
        let (number, ButtonEvent { at, button, is_press }) = machine.panel.event(self.read)?;
        self.is_half = !self.is_half;
        if self.is_half {
            self.read = number;
            return Some(record(at, EV_KEY, button.code(), i32::from(is_press)));
        }
        self.read = number + 1;
        Some(record(at, EV_SYN, 0, 0))
    }

    /// True if poll(2) would report that there is something to read.
    pub fn is_ready(&self, machine: &Machine) -> bool {
        match self.device {
            Device::Keys => machine.panel.event(self.read).is_some(),
            Device::Sound => false,
            Device::Screen => true,
        }
    }

    /// Writes: events, or the screen from an offset on; how many bytes were taken.
    /// Errors: EINVAL for less than one event, ENOSPC and EFBIG beyond the end of the screen.
    pub fn write(
        &self,
        machine: &mut Machine,
        offset: usize,
        bytes: &[u8],
    ) -> Result<usize, Errno> {
        if self.device == Device::Screen {
            machine.panel.drawn += 1;
            let screen = Arc::make_mut(&mut machine.panel.screen);
            let room = screen.get_mut(offset..).ok_or(Errno::EFBIG)?;
            let length = room.len().min(bytes.len());
            room[..length].copy_from_slice(&bytes[..length]);
            return if length == 0 && !bytes.is_empty() { Err(Errno::ENOSPC) } else { Ok(length) };
        }
        let records = bytes.chunks_exact(EVENT_BYTES);
        let taken = bytes.len() - records.remainder().len();
        if taken == 0 && !bytes.is_empty() {
            return Err(Errno::EINVAL);
        }
        for record in records {
            match (self.device, parts(record)) {
                (Device::Sound, Some((EV_SND, SND_TONE, hertz))) => machine.set_tone(hertz),
                (Device::Sound, Some((EV_SND, SND_BELL, on))) => {
                    machine.set_tone(if on == 0 { 0 } else { BELL_HERTZ });
                }
                // The device ignores what it does not have.
                _ => {}
            }
        }
        Ok(taken)
    }

    /// The answer to an ioctl: its result, and the bytes for the caller. This serves the ioctls
    /// that describe an event device; their numbers hold their size.
    /// Errors: ENOTTY for a device that has none, EINVAL for one that is not served.
    pub fn ioctl(&self, machine: &Machine, command: u32) -> Result<(i32, Vec<u8>), Errno> {
        /// The clock of events.
        const EVIOCSCLOCKID: u32 = 1 << 30 | 4 << 16 | (b'E' as u32) << 8 | 0xa0;
        /// For reading, of the group `E`.
        const READ_E: u32 = 2 << 30 | (b'E' as u32) << 8;
        if self.device == Device::Screen {
            return Err(Errno::ENOTTY);
        }
        let room = (command >> 16 & 0x3fff) as usize;
        if command == EVIOCSCLOCKID {
            // Events have the time of the brick, whichever clock that is.
            return Ok((0, Vec::new()));
        }
        if command & 0xc000_ff00 != READ_E {
            return Err(Errno::EINVAL);
        }
        let is_keys = self.device == Device::Keys;
        let (name, place) = if is_keys {
            ("EV3 Brick Buttons\0", "gpio-keys/input0\0")
        } else {
            ("LEGO MINDSTORMS EV3 Speaker\0", "sound/input0\0")
        };
        let down = |code: u16| is_keys && down(machine, code);
        let answer = match command & 0xff {
            // EVIOCGVERSION, EVIOCGID: the version of evdev; bus, vendor, product, version.
            0x01 => 0x0001_0001_i32.to_ne_bytes().to_vec(),
            0x02 => [0x19_u16, 1, 1, 0x100].map(u16::to_ne_bytes).concat(),
            // EVIOCGEFFECTS: the device has no force feedback.
            0x84 => 0_i32.to_ne_bytes().to_vec(),
            // EVIOCGUNIQ, EVIOCGPROP: it has no serial number, and no properties.
            0x08 => return Err(Errno::ENOENT),
            0x09 => vec![0; WORD],
            // EVIOCGNAME, EVIOCGPHYS, EVIOCGKEY
            0x06 => name.into(),
            0x07 => place.into(),
            0x18 => bits(Button::codes().filter(|code| down(*code)), KEY_BYTES),
            // EVIOCGBIT: kinds of events, then codes of each kind.
            0x20 => bits([EV_SYN, if is_keys { EV_KEY } else { EV_SND }].into_iter(), 4),
            0x21 if is_keys => bits(Button::codes(), KEY_BYTES),
            0x32 if !is_keys => bits([SND_BELL, SND_TONE].into_iter(), 1),
            0x21..=0x3f => vec![0],
            _ => return Err(Errno::EINVAL),
        };
        let fixed = matches!(command & 0xff, 0x01 | 0x02 | 0x84);
        let answer = &answer[..answer.len().min(room)];
        let result = if fixed { 0 } else { i32::try_from(answer.len()).unwrap_or(i32::MAX) };
        Ok((result, answer.to_vec()))
    }
}

fn down(machine: &Machine, code: u16) -> bool {
    let buttons =
        [Button::Up, Button::Down, Button::Left, Button::Right, Button::Enter, Button::Back];
    buttons.into_iter().any(|button| button.code() == code && machine.is_pressed(button))
}

fn bits(numbers: impl Iterator<Item = u16>, bytes: usize) -> Vec<u8> {
    let mut set = vec![0; bytes];
    for number in numbers {
        set[usize::from(number / 8)] |= 1 << (number % 8);
    }
    set
}

/// An event as the kernel of this machine lays it out.
fn record(at: Duration, kind: u16, code: u16, value: i32) -> [u8; EVENT_BYTES] {
    let mut record = [0; EVENT_BYTES];
    let seconds = usize::try_from(at.as_secs()).unwrap_or(usize::MAX);
    let micros = at.subsec_micros() as usize;
    record[..WORD].copy_from_slice(&seconds.to_ne_bytes());
    record[WORD..2 * WORD].copy_from_slice(&micros.to_ne_bytes());
    record[2 * WORD..2 * WORD + 2].copy_from_slice(&kind.to_ne_bytes());
    record[2 * WORD + 2..2 * WORD + 4].copy_from_slice(&code.to_ne_bytes());
    record[2 * WORD + 4..].copy_from_slice(&value.to_ne_bytes());
    record
}

/// Kind, code and value of an event.
fn parts(record: &[u8]) -> Option<(u16, u16, i32)> {
    let number = |from: usize| record.get(from..from + 2)?.try_into().ok().map(u16::from_ne_bytes);
    let value = record.get(2 * WORD + 4..)?.try_into().ok().map(i32::from_ne_bytes)?;
    Some((number(2 * WORD)?, number(2 * WORD + 2)?, value))
}
