//! Memory that two processes have in common, in which they hand each other letters in turn.
//!
//! One asks, the other one answers. Who waits gives the processor away for a while, which takes
//! a microsecond where the other one has something to say, and then sleeps; the caller wakes it by
//! other means. Neither believes the other one: a letter is copied before it is read.
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{MemfdFlags, SealFlags, fcntl_add_seals, ftruncate, memfd_create};
use rustix::mm::{MapFlags, ProtFlags, mmap, munmap};
use rustix::net::{
    RecvAncillaryBuffer, RecvAncillaryMessage, RecvFlags, SendAncillaryBuffer,
    SendAncillaryMessage, SendFlags, recvmsg, sendmsg,
};
use std::io::{self, IoSlice, IoSliceMut};
use std::mem::MaybeUninit;
use std::os::fd::{AsFd, OwnedFd};
use std::os::unix::net::UnixStream;
use std::ptr::NonNull;
use std::sync::atomic::{AtomicU32, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// The words before a letter: whose it is, who sleeps, its length in bytes, and how much of the
/// program's next letter is written.
const HEAD: usize = 16;
const WHOSE: usize = 0;
const SLEEPS: usize = 1;
const LENGTH: usize = 3;
const DRAFT: usize = 4;

/// Room for a letter, in words: a screen, and more.
const ROOM: usize = (1 << 16) + 64;

const BYTES: usize = 4 * (HEAD + ROOM);

/// The most bytes of a draft. A screen comes behind it.
const MOST_DRAFTED: u32 = 1 << 16;

/// How often who waits looks again before it sleeps: a tenth of a millisecond or two.
const LOOKS: u32 = 100;

/// A side that yields for longer than this, and finds no letter then, has yielded to other programs
/// and not to the other side. It sleeps at once then, and the next [`SHY`] times, as the kernel
/// lets a sleeper go on sooner.
const GONE: Duration = Duration::from_micros(50);
const SHY: u32 = 100;

/// The side that writes: the numbers of the words that say so.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u8)]
pub enum Side {
    /// Asks.
    Program = 0,
    /// Answers.
    Host = 1,
}

impl Side {
    fn other(self) -> Side {
        match self {
            Side::Program => Side::Host,
            Side::Host => Side::Program,
        }
    }

    /// The word in [`WHOSE`] for a letter of this side.
    fn sign(self) -> u32 {
        self as u32 + 1
    }
}

/// A letter and who has written it.
#[derive(Debug)]
pub struct Mailbox {
    file: OwnedFd,
    words: NonNull<AtomicU32>,
    /// How often this side does not give the processor away any more.
    shy: AtomicU32,
    /// How many bytes of the program's next letter this side has written, or has read.
    drafted: AtomicU32,
}

// Safety: all access is by atomic words.
unsafe impl Send for Mailbox {}
// Safety: the same.
unsafe impl Sync for Mailbox {}

/// Waits until there is something to read, or somebody who connects, for so long at the most;
/// whether there is.
pub fn readable(stream: &impl AsFd, within: Duration) -> io::Result<bool> {
    let within = Timespec::try_from(within).map_err(io::Error::other)?;
    match poll(&mut [PollFd::new(stream, PollFlags::IN)], Some(&within)) {
        Ok(count) => Ok(count > 0),
        Err(rustix::io::Errno::INTR) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

impl Mailbox {
    /// An empty one, whose size nobody can change.
    /// Errors: the system's, for example if there are no files in memory.
    pub fn new() -> io::Result<Mailbox> {
        let file = memfd_create("ev3dev-mailbox", MemfdFlags::CLOEXEC | MemfdFlags::ALLOW_SEALING)?;
        ftruncate(&file, BYTES as u64)?;
        fcntl_add_seals(&file, SealFlags::SHRINK | SealFlags::GROW | SealFlags::SEAL)?;
        Mailbox::of(file)
    }

    fn of(file: OwnedFd) -> io::Result<Mailbox> {
        // Safety: a new mapping, of a file that has this length and keeps it.
        let words = unsafe {
            let access = ProtFlags::READ | ProtFlags::WRITE;
            mmap(std::ptr::null_mut(), BYTES, access, MapFlags::SHARED, &file, 0)?
        };
        let words = NonNull::new(words.cast()).ok_or(io::ErrorKind::OutOfMemory)?;
        let [shy, drafted] = [const { AtomicU32::new(0) }; 2];
        Ok(Mailbox { file, words, shy, drafted })
    }

    /// Sends some bytes, and with them this mailbox.
    pub fn send(&self, stream: &UnixStream, bytes: &[u8]) -> io::Result<()> {
        let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(1))];
        let mut with = SendAncillaryBuffer::new(&mut space);
        let files = [self.file.as_fd()];
        with.push(SendAncillaryMessage::ScmRights(&files));
        let sent = sendmsg(stream, &[IoSlice::new(bytes)], &mut with, SendFlags::NOSIGNAL)?;
        if sent == bytes.len() { Ok(()) } else { Err(io::ErrorKind::WriteZero.into()) }
    }

    /// Receives exactly as many bytes as there is room for, and the mailbox that came with them.
    /// Errors: the system's; `UnexpectedEof` if there are less.
    pub fn receive(stream: &UnixStream, bytes: &mut [u8]) -> io::Result<Option<Mailbox>> {
        let mut space = [MaybeUninit::uninit(); rustix::cmsg_space!(ScmRights(1))];
        let mut with = RecvAncillaryBuffer::new(&mut space);
        let mut file = None;
        let mut got = 0;
        while got < bytes.len() {
            let parts = &mut [IoSliceMut::new(&mut bytes[got..])];
            let flags = RecvFlags::CMSG_CLOEXEC;
            match recvmsg(stream, parts, &mut with, flags) {
                Ok(received) if received.bytes == 0 => {
                    return Err(io::ErrorKind::UnexpectedEof.into());
                }
                Ok(received) => got += received.bytes,
                Err(rustix::io::Errno::INTR) => {}
                Err(error) => return Err(error.into()),
            }
            for message in with.drain() {
                if let RecvAncillaryMessage::ScmRights(mut files) = message {
                    file = files.next();
                }
            }
        }
        file.map(Mailbox::of).transpose()
    }

    fn word(&self, index: usize) -> &AtomicU32 {
        assert!(index < HEAD + ROOM);
        // Safety: within the mapping, which lives as long as this.
        unsafe { self.words.add(index).as_ref() }
    }

    /// Writes bytes into the mailbox from this one on, a multiple of 4; where they end.
    /// `None` if there is no room.
    fn put(&self, behind: u32, bytes: &[u8]) -> Option<u32> {
        let length = behind.checked_add(u32::try_from(bytes.len()).ok()?)?;
        if length as usize > 4 * ROOM {
            return None;
        }
        for (index, part) in bytes.chunks(4).enumerate() {
            let mut word = [0; 4];
            word[..part.len()].copy_from_slice(part);
            let place = HEAD + behind as usize / 4 + index;
            self.word(place).store(u32::from_le_bytes(word), Ordering::Relaxed);
        }
        Some(length)
    }

    /// Writes the program's next letter up to here, a multiple of 4 bytes, and does not send it
    /// yet: the host may read it by [`Mailbox::draft`]. `false` if there is no room.
    pub fn write_draft(&self, part: &[u8]) -> bool {
        let length = self.put(self.drafted.load(Ordering::Relaxed), part);
        let length = length.filter(|length| *length <= MOST_DRAFTED);
        if let Some(length) = length {
            self.drafted.store(length, Ordering::Relaxed);
            self.word(DRAFT).store(length, Ordering::SeqCst);
        }
        length.is_some()
    }

    /// What the host has not read yet of the program's next letter.
    pub fn draft(&self) -> Vec<u8> {
        let part = self.part_until(self.word(DRAFT).load(Ordering::SeqCst));
        let read = u32::try_from(part.len()).unwrap_or(0) / 4 * 4;
        self.drafted.fetch_add(read, Ordering::Relaxed);
        part
    }

    /// Leaves a letter for the other side; whether that sleeps, and is to be woken. `None` if the
    /// letter is too long.
    pub fn post(&self, from: Side, letter: &[u8]) -> Option<bool> {
        let drafted = self.drafted.swap(0, Ordering::Relaxed);
        let behind = match from {
            Side::Program => drafted,
            Side::Host => 0,
        };
        let length = self.put(behind, letter)?;
        self.word(LENGTH).store(length, Ordering::Relaxed);
        self.word(DRAFT).store(0, Ordering::SeqCst);
        self.word(WHOSE).store(from.sign(), Ordering::SeqCst);
        let sleeps = self.word(SLEEPS + from.other() as usize);
        Some(sleeps.swap(0, Ordering::SeqCst) != 0)
    }

    /// Whether there is a letter for this side that it has not answered.
    pub fn has_come(&self, to: Side) -> bool {
        self.word(WHOSE).load(Ordering::SeqCst) == to.other().sign()
    }

    /// Looks for a letter of the other side for a short while. If there is none, this side sleeps
    /// from now on, and the other one will know.
    pub fn wait(&self, to: Side) -> bool {
        let shy = self.shy.load(Ordering::Relaxed);
        self.shy.store(shy.saturating_sub(1), Ordering::Relaxed);
        for _ in 0..if shy == 0 { LOOKS } else { 0 } {
            if self.has_come(to) {
                return true;
            }
            let since = Instant::now();
            thread::yield_now();
            if since.elapsed() > GONE && !self.has_come(to) {
                self.shy.store(SHY, Ordering::Relaxed);
                break;
            }
        }
        let sleeps = self.word(SLEEPS + to as usize);
        sleeps.store(1, Ordering::SeqCst);
        // If the other side has seen that already, it wakes this one.
        self.has_come(to) && sleeps.swap(0, Ordering::SeqCst) != 0
    }

    /// A copy of the letter that is there, or of as much as there is room for; without what was
    /// read of it as a draft.
    pub fn letter(&self) -> Vec<u8> {
        self.part_until(self.word(LENGTH).load(Ordering::Relaxed))
    }

    fn part_until(&self, end: u32) -> Vec<u8> {
        let end = (end as usize).min(4 * ROOM);
        let from = self.drafted.load(Ordering::Relaxed) as usize;
        let mut part = Vec::with_capacity(end.saturating_sub(from) + 4);
        for index in from / 4..end.div_ceil(4) {
            part.extend(self.word(HEAD + index).load(Ordering::Relaxed).to_le_bytes());
        }
        part.truncate(end.saturating_sub(from));
        part
    }
}

impl Drop for Mailbox {
    fn drop(&mut self) {
        // Safety: the mapping of `of`, which nobody uses any more.
        let _ = unsafe { munmap(self.words.as_ptr().cast(), BYTES) };
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pair() -> (Mailbox, Mailbox) {
        let (here, there) = UnixStream::pair().unwrap();
        let host = Mailbox::new().unwrap();
        host.send(&there, b"hello").unwrap();
        let mut bytes = [0; 5];
        let program = Mailbox::receive(&here, &mut bytes).unwrap().unwrap();
        assert_eq!(&bytes, b"hello");
        (program, host)
    }

    #[test]
    fn letters_go_to_and_fro() {
        let (program, host) = pair();
        let answers = thread::spawn(move || {
            for number in 0..2000_u32 {
                while !host.wait(Side::Host) {}
                assert_eq!(host.letter(), number.to_le_bytes());
                let _ = host.post(Side::Host, &[7; 10][..number as usize % 10]);
            }
        });
        for number in 0..2000_u32 {
            let _ = program.post(Side::Program, &number.to_le_bytes());
            while !program.wait(Side::Program) {}
            assert_eq!(program.letter(), vec![7; number as usize % 10]);
        }
        answers.join().unwrap();
    }

    #[test]
    fn who_sleeps_is_to_be_woken() {
        let (program, host) = pair();
        assert!(!host.wait(Side::Host));
        assert_eq!(program.post(Side::Program, b"?"), Some(true));
        assert_eq!(program.post(Side::Program, b"?"), Some(false));
        assert!(host.wait(Side::Host));
    }

    #[test]
    fn a_draft_is_read_once() {
        let (program, host) = pair();
        assert!(program.write_draft(b"1234"));
        assert_eq!(host.draft(), b"1234");
        assert!(program.write_draft(b"5678"));
        assert_eq!(host.draft(), b"5678");
        assert!(host.draft().is_empty());
        assert!(program.write_draft(b"abcd"));
        let _ = program.post(Side::Program, b"!");
        assert!(host.draft().is_empty());
        assert_eq!(host.letter(), b"abcd!");
        let _ = host.post(Side::Host, b"?");
        assert_eq!(program.letter(), b"?");
        assert!(program.write_draft(b"next"));
        assert_eq!(host.draft(), b"next");
    }

    #[test]
    fn a_draft_without_an_end() {
        let (program, host) = pair();
        while program.write_draft(&[0; 32]) {}
        program.word(DRAFT).store(u32::MAX, Ordering::Relaxed);
        assert_eq!(host.draft().len(), 4 * ROOM);
        assert!(host.draft().is_empty());
        assert!(host.letter().is_empty());
    }

    #[test]
    fn a_length_that_is_a_lie_is_cut() {
        let (program, host) = pair();
        let _ = program.post(Side::Program, b"abc");
        program.word(LENGTH).store(u32::MAX, Ordering::Relaxed);
        assert_eq!(host.letter().len(), 4 * ROOM);
        assert_eq!(program.post(Side::Program, &vec![0; 4 * ROOM + 1]), None);
    }

    #[test]
    fn its_size_cannot_be_changed() {
        let (program, _host) = pair();
        assert!(ftruncate(&program.file, 0).is_err());
    }

    #[test]
    fn bytes_without_a_mailbox() {
        let (here, there) = UnixStream::pair().unwrap();
        std::io::Write::write_all(&mut &there, b"hello").unwrap();
        assert!(Mailbox::receive(&here, &mut [0; 5]).unwrap().is_none());
        drop(there);
        assert!(Mailbox::receive(&here, &mut [0; 5]).is_err());
    }
}
