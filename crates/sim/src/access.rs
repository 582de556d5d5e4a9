//! A program's access to the files of a simulation. Its machine is here, or far ([`crate::far`]).
use crate::clock::Simulation;
use crate::far::{self, Answer, Kind, Question, READ_TAKES, WRITE_TAKES};
use crate::files::attr::Access;
use crate::machine::Written;
use crate::machine::dev::DevDescriptor;
use crate::machine::tree::NodeId;
use ev3_os::linux::Errno;
use std::time::Duration;

/// An open device file.
#[derive(Debug)]
pub struct OpenDevice {
    place: Place,
    length: Option<u64>,
    /// Of the next read or write.
    offset: usize,
}

#[derive(Debug)]
enum Place {
    Here(DevDescriptor),
    /// The number under which the far machine knows it.
    Far(u64),
}

fn small(number: usize) -> u32 {
    u32::try_from(number).unwrap_or(u32::MAX)
}

fn copied(bytes: &[u8], buffer: &mut [u8]) -> usize {
    let length = bytes.len().min(buffer.len());
    buffer[..length].copy_from_slice(&bytes[..length]);
    length
}

impl Simulation {
    /// The answer of the machine, wherever it is, in no time.
    fn ask(&self, question: Question) -> Result<Answer, Errno> {
        match self.elsewhere(question, Duration::ZERO) {
            Some(answer) => answer.ok(),
            None => far::answer(&mut self.machine(), &question),
        }
    }

    /// The names in the directory of a path, with their inodes.
    pub fn list(&self, path: &str) -> Result<Vec<(String, NodeId)>, Errno> {
        let Some(answer) =
            self.elsewhere(Question::of(Kind::List, path.as_bytes()), Duration::ZERO)
        else {
            return self.machine().list(path);
        };
        let text = String::from_utf8(answer.ok()?.bytes).unwrap_or_default();
        let entry = |line: &str| {
            let (node, name) = line.split_once(' ')?;
            Some((name.to_owned(), NodeId(node.parse().ok()?)))
        };
        Ok(text.lines().filter_map(entry).collect())
    }

    /// Opens an attribute file.
    pub fn open(&self, path: &str, access: Access) -> Result<NodeId, Errno> {
        let kind = match access {
            Access::WriteOnly => Kind::OpenToWrite,
            _ => Kind::OpenToRead,
        };
        Ok(NodeId(self.ask(Question::of(kind, path.as_bytes()))?.number))
    }

    /// Reads an attribute file from an offset on. On the virtual clock it takes some time.
    pub fn read(&self, node: NodeId, offset: usize, buffer: &mut [u8]) -> Result<usize, Errno> {
        let question = Question {
            number: node.0,
            offset: small(offset),
            count: small(buffer.len()),
            ..Question::of(Kind::Read, &[])
        };
        let bytes = match self.elsewhere(question, READ_TAKES) {
            Some(answer) => answer.ok()?.bytes,
            None => self.access(READ_TAKES).read_at(node, offset, buffer.len())?,
        };
        Ok(copied(&bytes, buffer))
    }

    /// Writes to an attribute file from an offset on; also the moment of it. On the virtual clock
    /// it takes some time, and what blocks longer than that is for the caller to wait.
    pub fn write(
        &self,
        node: NodeId,
        offset: usize,
        bytes: &[u8],
    ) -> Result<(Written, Duration), Errno> {
        let question =
            Question { number: node.0, offset: small(offset), ..Question::of(Kind::Write, bytes) };
        let Some(answer) = self.elsewhere(question, WRITE_TAKES) else {
            let mut machine = self.access(WRITE_TAKES);
            let now = machine.now();
            return machine.write_at(node, offset, bytes).map(|written| (written, now));
        };
        let blocks = Duration::from_nanos(answer.number);
        let outcome = answer.ok().map(|_| bytes.len());
        Ok((Written { outcome, blocks }, self.machine().now()))
    }

    /// Opens a device file.
    pub fn open_device(&self, path: &str) -> Result<OpenDevice, Errno> {
        let far = self.elsewhere(Question::of(Kind::OpenDevice, path.as_bytes()), Duration::ZERO);
        let (place, length) = if let Some(answer) = far {
            let answer = answer.ok()?;
            (Place::Far(answer.number), answer.number_in_bytes())
        } else {
            let machine = self.machine();
            let device = DevDescriptor::open(&machine, path)?;
            let length = device.length(&machine).map(|length| length as u64);
            (Place::Here(device), length)
        };
        Ok(OpenDevice { place, length, offset: 0 })
    }

    /// Reads what comes next. On the virtual clock it takes some time.
    pub fn read_device(&self, open: &mut OpenDevice, buffer: &mut [u8]) -> Result<usize, Errno> {
        let length = match &mut open.place {
            Place::Here(device) => device.read(&self.access(READ_TAKES), open.offset, buffer)?,
            Place::Far(number) => {
                let question = Question {
                    number: *number,
                    offset: small(open.offset),
                    count: small(buffer.len()),
                    ..Question::of(Kind::ReadDevice, &[])
                };
                copied(&self.answer(question, READ_TAKES)?.bytes, buffer)
            }
        };
        open.offset += length;
        Ok(length)
    }

    /// Writes behind what was written before; how many bytes were taken. On the virtual clock it
    /// takes some time.
    pub fn write_device(&self, open: &mut OpenDevice, bytes: &[u8]) -> Result<usize, Errno> {
        let length = match &open.place {
            Place::Here(device) => {
                device.write(&mut self.access(WRITE_TAKES), open.offset, bytes)?
            }
            Place::Far(number) => {
                let question = Question {
                    number: *number,
                    offset: small(open.offset),
                    ..Question::of(Kind::WriteDevice, bytes)
                };
                let taken = self.answer(question, WRITE_TAKES)?.number;
                usize::try_from(taken).unwrap_or(0).min(bytes.len())
            }
        };
        open.offset += length;
        Ok(length)
    }

    /// The state that an ioctl reads. On the virtual clock it takes some time.
    pub fn ioctl(&self, open: &OpenDevice, command: u32) -> Result<Vec<u8>, Errno> {
        match &open.place {
            Place::Here(device) => {
                device.ioctl(&self.access(READ_TAKES), command).map(|(_, state)| state)
            }
            Place::Far(number) => {
                let question =
                    Question { number: *number, count: command, ..Question::of(Kind::Ioctl, &[]) };
                Ok(self.answer(question, READ_TAKES)?.bytes)
            }
        }
    }

    /// The answer of a far machine, which there is.
    fn answer(&self, question: Question, takes: Duration) -> Result<Answer, Errno> {
        self.elsewhere(question, takes).unwrap_or_default().ok()
    }

    /// Says a text; how long that takes.
    pub fn say(&self, text: &str) -> Duration {
        let answer = self.ask(Question::of(Kind::Say, text.as_bytes())).unwrap_or_default();
        Duration::from_nanos(answer.number)
    }

    /// Plays a recording.
    pub fn play(&self, file: &str) {
        self.sound(Question::of(Kind::Play, file.as_bytes()));
    }

    /// Ends what is said or played.
    pub fn silence(&self) {
        self.sound(Question::of(Kind::Silence, &[]));
    }

    /// The volume, in percent.
    pub fn volume(&self) -> u8 {
        u8::try_from(self.sound(Question::of(Kind::Volume, &[]))).unwrap_or(0)
    }

    /// Sets the volume, in percent.
    pub fn set_volume(&self, percent: u8) {
        self.sound(Question { number: percent.into(), ..Question::of(Kind::SetVolume, &[]) });
    }

    fn sound(&self, question: Question) -> u64 {
        self.ask(question).unwrap_or_default().number
    }
}

impl OpenDevice {
    /// How many bytes there are; event devices have no end.
    pub fn length(&self) -> Option<u64> {
        self.length
    }
}
