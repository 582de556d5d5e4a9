//! A machine in another process than its clock: so a program that cannot see the world still has
//! the virtual clock.
//!
//! The program's process has a [`Simulation::far`](crate::Simulation::far), whose threads take turns and let time pass as
//! ever. Each access becomes a [`Question`] with its moment, which the other process has a [`Host`]
//! answer, after it has let time pass until then. The host believes nothing: time does not go back,
//! a read and a write take their time, and what takes none, as an act of a control loop, is
//! rationed.

#[cfg(unix)]
pub mod wire;

use crate::files::attr::Access;
use crate::machine::dev::DevDescriptor;
use crate::machine::tree::{NodeId, Tree};
use crate::machine::{Machine, Written};
use ev3_os::linux::Errno;
use std::time::Duration;

/// Duration of a read on the virtual clock: that of a fast program on a brick.
pub(crate) const READ_TAKES: Duration = Duration::from_micros(500);

/// Duration of a write on the virtual clock.
pub(crate) const WRITE_TAKES: Duration = Duration::from_micros(100);

/// What a program wants. The comments say what the fields of the question are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Kind {
    /// Nothing but that time passes; the number is the time in nanoseconds until which nothing else
    /// happens, either.
    Pass,
    /// The directory of this path; the answer has lines of an inode number and a name.
    List,
    /// The file of this path, for reading; its number.
    OpenToRead,
    /// The same for writing.
    OpenToWrite,
    /// `count` bytes of file `number` from `offset` on; the answer's number is the time in
    /// nanoseconds until which this holds, unless the program changes something.
    Read,
    /// Bytes into file `number` from `offset` on; the answer's number is for how many nanoseconds
    /// the call blocks. If the same write does the same again, its bytes are as the number of
    /// [`Kind::Pass`].
    Write,
    /// The device file of this path; its number, and as bytes its length, if it has one.
    OpenDevice,
    /// As a read.
    ReadDevice,
    /// As a write; the answer's number is how many bytes were taken.
    WriteDevice,
    /// The state of an ioctl with the command `count`.
    Ioctl,
    /// The number of events of buttons; as bytes the time of the next planned one in nanoseconds.
    Buttons,
    /// Says a text; the number of nanoseconds that it takes.
    Say,
    /// Plays a file.
    Play,
    /// Ends what is said or played.
    Silence,
    /// The volume in percent.
    Volume,
    /// Sets it to `number`.
    SetVolume,
}

impl Kind {
    const ALL: [Kind; 16] = [
        Kind::Pass,
        Kind::List,
        Kind::OpenToRead,
        Kind::OpenToWrite,
        Kind::Read,
        Kind::Write,
        Kind::OpenDevice,
        Kind::ReadDevice,
        Kind::WriteDevice,
        Kind::Ioctl,
        Kind::Buttons,
        Kind::Say,
        Kind::Play,
        Kind::Silence,
        Kind::Volume,
        Kind::SetVolume,
    ];

    /// The kind with this number.
    pub fn of(number: u8) -> Option<Kind> {
        Self::ALL.get(usize::from(number)).copied()
    }

    /// For how long it keeps the processor busy.
    fn takes(self) -> Duration {
        match self {
            Kind::Read | Kind::ReadDevice | Kind::Ioctl => READ_TAKES,
            Kind::Write | Kind::WriteDevice => WRITE_TAKES,
            _ => Duration::ZERO,
        }
    }
}

/// An access by a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Question<'a> {
    /// What it wants.
    pub kind: Kind,
    /// When, by its clock.
    pub at: Duration,
    /// Whether it takes no time, as in an act.
    pub is_free: bool,
    /// Whether the program knows the answer, and wants none.
    pub is_known: bool,
    /// See [`Kind`].
    pub number: u64,
    /// See [`Kind`].
    pub offset: u32,
    /// See [`Kind`].
    pub count: u32,
    /// See [`Kind`].
    pub bytes: &'a [u8],
}

impl Question<'_> {
    /// One without numbers, whose time the clock sets.
    pub(crate) fn of(kind: Kind, bytes: &[u8]) -> Question<'_> {
        let [is_free, is_known] = [false; 2];
        let at = Duration::ZERO;
        Question { kind, at, is_free, is_known, number: 0, offset: 0, count: 0, bytes }
    }
}

/// What the machine answers.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Answer {
    /// The error's number, or 0.
    pub error: i32,
    /// See [`Kind`].
    pub number: u64,
    /// See [`Kind`].
    pub bytes: Vec<u8>,
}

impl Answer {
    fn number(number: u64) -> Answer {
        Answer { number, ..Answer::default() }
    }

    fn bytes(bytes: Vec<u8>) -> Answer {
        Answer { bytes, ..Answer::default() }
    }

    fn time(time: Duration) -> Answer {
        Answer::number(nanos(time))
    }

    /// The second number of some answers.
    pub(crate) fn number_in_bytes(&self) -> Option<u64> {
        self.bytes[..].try_into().ok().map(u64::from_le_bytes)
    }

    /// It, unless it is an error.
    pub(crate) fn ok(self) -> Result<Answer, Errno> {
        if self.error == 0 { Ok(self) } else { Err(Errno(self.error)) }
    }
}

/// The way to a machine in another process.
pub trait Far: Send + Sync {
    /// Its answer. Where it is lost, that is EIO.
    fn ask(&self, question: &Question) -> Answer;

    /// How many inferences of the program take a second there; 0 if they take no time.
    fn thinking(&self) -> u64;
}

/// What a program knows without asking. Until a moment that the host says nothing happens there but
/// ticks of the machine, so time may pass; a read shows the same until its tick is over; and what a
/// motor took, it takes again.
#[derive(Debug, Default)]
pub struct Kept {
    until: Duration,
    /// Number, offset and count; how long it holds; and the answer.
    reads: Vec<([u64; 3], Duration, Answer)>,
    /// Number, offset and bytes.
    writes: Vec<(u64, u32, Vec<u8>)>,
}

impl Kept {
    fn read(question: &Question) -> [u64; 3] {
        [question.number, question.offset.into(), question.count.into()]
    }

    /// The answer to this question, if it is known.
    pub fn answer(&mut self, question: &Question) -> Option<Answer> {
        let &Question { kind, at, number, offset, bytes, .. } = question;
        match kind {
            Kind::Read => {
                let key = Self::read(question);
                let mut reads = self.reads.iter();
                let read = reads.find(|(its, until, _)| *its == key && at < *until)?;
                Some(read.2.clone())
            }
            Kind::Pass => (at < self.until).then(Answer::default),
            Kind::Write => {
                let was = |write: &&(u64, u32, Vec<u8>)| {
                    write.0 == number && write.1 == offset && write.2 == bytes
                };
                self.writes.iter().find(was).filter(|_| at < self.until)?;
                self.forget_reads(number);
                Some(Answer::default())
            }
            _ => None,
        }
    }

    /// Forgets the reads of a file's device.
    fn forget_reads(&mut self, number: u64) {
        let owner = Tree::owner(NodeId(number));
        self.reads.retain(|(its, ..)| Tree::owner(NodeId(its[0])) != owner);
    }

    /// This was asked and answered.
    pub fn note(&mut self, question: &Question, answer: &Answer) {
        let &Question { kind, at, number, offset, bytes, .. } = question;
        match kind {
            Kind::Read => {
                self.reads.retain(|(_, until, _)| *until > at);
                if answer.error == 0 {
                    let until = Duration::from_nanos(answer.number);
                    self.reads.push((Self::read(question), until, answer.clone()));
                }
            }
            Kind::Pass => self.nothing_happens_until(at, answer.number),
            Kind::Write => match answer.number_in_bytes() {
                Some(until) => {
                    self.nothing_happens_until(at, until);
                    self.forget_reads(number);
                    self.writes.push((number, offset, bytes.to_vec()));
                }
                None => self.reads.clear(),
            },
            Kind::Buttons => {}
            _ => self.reads.clear(),
        }
    }

    /// Said by an answer at a moment.
    fn nothing_happens_until(&mut self, at: Duration, nanos: u64) {
        if at >= self.until {
            self.writes.clear();
        }
        self.until = Duration::from_nanos(nanos);
    }
}

/// How many accesses that take no time a program may have, and in each millisecond as many more.
const FREE: u64 = 2000;
const FREE_IN_A_MS: u64 = 4;

/// Answers the questions of a program.
#[derive(Debug, Default)]
pub struct Host {
    devices: Vec<DevDescriptor>,
    /// The moment of the last question, and when it began.
    last: Duration,
    begun: Option<Duration>,
    free: u64,
}

impl Host {
    /// Whether the time of a question can be right. The host then lets time pass until it, and has
    /// the question answered. Errors: why it cannot, in words.
    pub fn admit(&mut self, question: &Question) -> Result<(), &'static str> {
        let begun = *self.begun.get_or_insert(question.at);
        let takes = if question.is_free { Duration::ZERO } else { question.kind.takes() };
        if question.at < self.last.saturating_add(takes) {
            return Err("its time went back");
        }
        self.last = question.at;
        if takes.is_zero() && question.kind != Kind::Pass {
            self.free += 1;
            let passed = question.at.saturating_sub(begun).as_millis();
            let most = u64::try_from(passed).unwrap_or(u64::MAX).saturating_mul(FREE_IN_A_MS);
            if self.free > most.saturating_add(FREE) {
                return Err("too many accesses took no time");
            }
        }
        Ok(())
    }

    /// Answers. No time passes. Nothing happens here until `until` but ticks of the machine, and
    /// what the program does.
    pub fn answer(
        &mut self,
        machine: &mut Machine,
        question: &Question,
        until: Duration,
    ) -> Answer {
        let node = NodeId(question.number);
        let mut answer = self
            .answered(machine, question)
            .unwrap_or_else(|Errno(error)| Answer { error, ..Answer::default() });
        match question.kind {
            Kind::Read if !machine.is_binary(node) => {
                answer.number = nanos(until.min(machine.next_tick()));
            }
            Kind::Pass => answer.number = nanos(until),
            Kind::Write if answer == Answer::default() && machine.is_steady(node) => {
                answer.bytes = nanos(until).to_le_bytes().to_vec();
            }
            _ => {}
        }
        answer
    }

    fn answered(&mut self, machine: &mut Machine, question: &Question) -> Result<Answer, Errno> {
        let Question { kind, number, offset, count, bytes, .. } = *question;
        match kind {
            Kind::OpenDevice => self.open(machine, bytes),
            Kind::ReadDevice => {
                let mut buffer = vec![0; count as usize];
                let length = self.device(number)?.read(machine, offset as usize, &mut buffer)?;
                buffer.truncate(length);
                Ok(Answer::bytes(buffer))
            }
            Kind::WriteDevice => {
                let taken = self.device(number)?.write(machine, offset as usize, bytes)?;
                Ok(Answer::number(taken as u64))
            }
            Kind::Ioctl => Ok(Answer::bytes(self.device(number)?.ioctl(machine, count)?.1)),
            _ => answer(machine, question),
        }
    }

    fn device(&mut self, number: u64) -> Result<&mut DevDescriptor, Errno> {
        let index = usize::try_from(number).unwrap_or(usize::MAX);
        self.devices.get_mut(index).ok_or(Errno::EINVAL)
    }

    fn open(&mut self, machine: &Machine, path: &[u8]) -> Result<Answer, Errno> {
        let device = DevDescriptor::open(machine, text(path)?)?;
        let length = device.length(machine).map(|length| (length as u64).to_le_bytes().to_vec());
        self.devices.push(device);
        let number = self.devices.len() as u64 - 1;
        Ok(Answer { number, bytes: length.unwrap_or_default(), ..Answer::default() })
    }
}

/// The answer to what needs no memory.
pub(crate) fn answer(machine: &mut Machine, question: &Question) -> Result<Answer, Errno> {
    let Question { kind, number, offset, count, bytes, .. } = *question;
    let node = NodeId(number);
    Ok(match kind {
        Kind::List => {
            let line = |(name, node): (String, NodeId)| format!("{} {name}\n", node.0);
            let lines: String = machine.list(text(bytes)?)?.into_iter().map(line).collect();
            Answer::bytes(lines.into_bytes())
        }
        Kind::OpenToRead => Answer::number(machine.open(text(bytes)?, Access::ReadOnly)?.0),
        Kind::OpenToWrite => Answer::number(machine.open(text(bytes)?, Access::WriteOnly)?.0),
        Kind::Read => Answer::bytes(machine.read_at(node, offset as usize, count as usize)?),
        Kind::Write => {
            let Written { outcome, blocks } = machine.write_at(node, offset as usize, bytes)?;
            Answer { error: outcome.err().map_or(0, |Errno(error)| error), ..Answer::time(blocks) }
        }
        Kind::Buttons => {
            let next = machine.next_button().map(|at| nanos(at).to_le_bytes().to_vec());
            let number = machine.button_events();
            Answer { number, bytes: next.unwrap_or_default(), ..Answer::default() }
        }
        Kind::Say => Answer::time(machine.say(text(bytes)?)),
        Kind::Play => {
            machine.play(text(bytes)?);
            Answer::default()
        }
        Kind::Silence => {
            machine.silence();
            Answer::default()
        }
        Kind::Volume => Answer::number(machine.volume().into()),
        Kind::SetVolume => {
            machine.set_volume(u8::try_from(number).unwrap_or(100));
            Answer::default()
        }
        Kind::Pass => Answer::default(),
        // Only a host knows which devices are open.
        Kind::OpenDevice | Kind::ReadDevice | Kind::WriteDevice | Kind::Ioctl => {
            return Err(Errno::EINVAL);
        }
    })
}

fn text(bytes: &[u8]) -> Result<&str, Errno> {
    std::str::from_utf8(bytes).map_err(|_| Errno::EINVAL)
}

fn nanos(time: Duration) -> u64 {
    u64::try_from(time.as_nanos()).unwrap_or(u64::MAX)
}
