//! The motors that the program has started, where they can be stopped without a lock.
//!
//! A line of text describes each: whether it runs, the command that stops it, its file.
//!
//! ```text
//! 1 stop /sys/class/tacho-motor/motor0/command
//! 0 float /sys/class/servo-motor/motor4/command
//! ```
//!
//! The lines are in a file in memory, mapped, so that they outlive this process for one
//! that has the same file open ([`crate::survivor`]). Handlers of signals stop the motors
//! by the descriptors that this process has anyway, see [`stop`].
use nix::errno::Errno;
use nix::libc::{self, c_int};
use std::io;
use std::sync::atomic::{AtomicI32, AtomicPtr, AtomicU8, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// As many as 32 bricks have.
const MOST: usize = 128;

/// Room for their lines.
const ROOM: usize = MOST * 128;

/// No descriptor.
const NONE: c_int = -1;

/// What a line begins with.
pub(crate) const RUNS: u8 = b'1';
pub(crate) const RESTS: u8 = b'0';

/// A motor: the descriptor of its file, where its line begins, and how long that is without
/// its newline.
pub(crate) struct Slot {
    descriptor: AtomicI32,
    start: AtomicUsize,
    length: AtomicUsize,
}

static SLOTS: [Slot; MOST] = [const {
    Slot {
        descriptor: AtomicI32::new(NONE),
        start: AtomicUsize::new(0),
        length: AtomicUsize::new(0),
    }
}; MOST];

/// The lines; null until there is one.
static LINES: AtomicPtr<u8> = AtomicPtr::new(std::ptr::null_mut());

/// The file that they are in, or [`NONE`].
static FILE: AtomicI32 = AtomicI32::new(NONE);

/// How long all lines are. The lock is for those who add one.
static LENGTH: AtomicUsize = AtomicUsize::new(0);
static ADDING: Mutex<()> = Mutex::new(());

impl Slot {
    /// The slot of an open file, with this line after its first byte; `None` if there is no room.
    /// Errors: the kernel's, if there is no descriptor left.
    pub(crate) fn of(descriptor: c_int, rest: &[u8]) -> io::Result<Option<&'static Self>> {
        let line = [&[RESTS], rest].concat();
        let _adding = ADDING.lock().unwrap_or_else(PoisonError::into_inner);
        if LINES.load(Ordering::Relaxed).is_null() {
            LINES.store(map(file_in_memory()?, std::ptr::null_mut())?, Ordering::Release);
        }
        Ok(Self::with_room(&line).inspect(|slot| {
            slot.write(&line);
            slot.descriptor.store(descriptor, Ordering::Release);
        }))
    }

    /// A free slot with room for a line. The caller has the lock.
    fn with_room(line: &[u8]) -> Option<&'static Self> {
        let is_free = |slot: &&Slot| slot.descriptor.load(Ordering::Acquire) == NONE;
        let has_room = |slot: &&Slot| slot.length.load(Ordering::Relaxed) >= line.len();
        SLOTS.iter().filter(is_free).find(has_room).or_else(|| {
            let slot = SLOTS.iter().filter(is_free).find(|slot| !slot.is_used())?;
            slot.start.store(append(line.len())?, Ordering::Relaxed);
            slot.length.store(line.len(), Ordering::Relaxed);
            Some(slot)
        })
    }

    /// Its file is closed soon.
    pub(crate) fn free(&self) {
        self.flag(RESTS);
        self.descriptor.store(NONE, Ordering::Release);
    }

    pub(crate) fn flag(&self, flag: u8) {
        self.first_byte().store(flag, Ordering::Release);
    }

    fn runs(&self) -> bool {
        self.first_byte().load(Ordering::Acquire) == RUNS
    }

    fn first_byte(&self) -> &AtomicU8 {
        // Safety: nobody has another reference to it while the slot is in use.
        unsafe { AtomicU8::from_ptr(self.first()) }
    }

    /// Whether there is a line of it.
    fn is_used(&self) -> bool {
        self.length.load(Ordering::Relaxed) != 0
    }

    fn first(&self) -> *mut u8 {
        // Safety: where a slot has a line, there are lines, and it begins within them.
        unsafe { LINES.load(Ordering::Relaxed).add(self.start.load(Ordering::Relaxed)) }
    }

    /// Writes the line into its place; spaces at its end do not count.
    fn write(&self, line: &[u8]) {
        let (first, length) = (self.first(), self.length.load(Ordering::Relaxed));
        // Safety: so long is the place, and a newline; nobody else has a slot that is free.
        unsafe {
            first.write_bytes(b' ', length);
            first.copy_from_nonoverlapping(line.as_ptr(), line.len());
            first.add(length).write(b'\n');
        }
    }
}

/// Makes a place for a line of that length; its start, or `None` if there is no room.
fn append(line: usize) -> Option<usize> {
    let start = LENGTH.load(Ordering::Relaxed);
    let end = start + line + 1;
    if end > ROOM {
        return None;
    }
    lengthen(end)?;
    LENGTH.store(end, Ordering::Relaxed);
    Some(start)
}

/// Lets the file be so long: it has no page that may be written before.
fn lengthen(length: usize) -> Option<()> {
    let file = FILE.load(Ordering::Relaxed);
    let length = libc::off_t::try_from(length).ok()?;
    // Safety: asks the kernel only.
    (file == NONE || unsafe { libc::ftruncate(file, length) } == 0).then_some(())
}

/// A new file in memory, or [`NONE`] if there are none, as before Linux 3.17.
fn file_in_memory() -> io::Result<c_int> {
    // Safety: asks the kernel only, not by a function of the C library, which the brick's lacks.
    let file = unsafe {
        let name = c"ev3dev-motors".as_ptr();
        libc::syscall(libc::SYS_memfd_create, name, libc::MFD_CLOEXEC)
    };
    match c_int::try_from(file).unwrap_or(NONE) {
        NONE if Errno::last() != Errno::ENOSYS => Err(io::Error::last_os_error()),
        file => Ok(file),
    }
}

/// Maps that file at an address, or anywhere if that is null. Without one it is just memory.
fn map(file: c_int, address: *mut u8) -> io::Result<*mut u8> {
    FILE.store(file, Ordering::Relaxed);
    // Safety: asks the kernel only. What is at the address is the former lines.
    unsafe {
        let kind = if file == NONE { libc::MAP_ANONYMOUS } else { 0 };
        let place = if address.is_null() { 0 } else { libc::MAP_FIXED };
        let access = libc::PROT_READ | libc::PROT_WRITE;
        let flags = libc::MAP_SHARED | kind | place;
        let mapped = libc::mmap(address.cast(), ROOM, access, flags, file, 0);
        if mapped == libc::MAP_FAILED {
            return Err(io::Error::last_os_error());
        }
        Ok(mapped.cast())
    }
}

/// How long all lines are.
#[cfg(test)]
pub(crate) fn length() -> usize {
    LENGTH.load(Ordering::Relaxed)
}

/// The file of the lines, or -1.
pub(crate) fn file() -> c_int {
    FILE.load(Ordering::Relaxed)
}

/// Writes the command that stops it to each motor that runs; whether there is one.
pub(crate) fn stop() -> bool {
    let mut any = false;
    for slot in &SLOTS {
        let descriptor = slot.descriptor.load(Ordering::Acquire);
        if descriptor != NONE && slot.runs() {
            any = true;
            // Safety: within the line, which is longer.
            let is_servo = unsafe { slot.first().add(2).read() } == b'f';
            let word: &[u8] = if is_servo { b"float\n" } else { b"stop\n" };
            // Safety: the buffer is as long as that; a closed descriptor is an error.
            unsafe { libc::pwrite(descriptor, word.as_ptr().cast(), word.len(), 0) };
        }
    }
    any
}

/// Leaves all motors as they are when the program has ended.
pub fn leave() {
    SLOTS.iter().filter(|slot| slot.is_used()).for_each(|slot| slot.flag(RESTS));
}

/// In a child of fork(2), which may go on: what its parent started is its parent's. Does
/// only what may be done there.
pub(crate) fn forked() {
    let lines = LINES.load(Ordering::Relaxed);
    if lines.is_null() {
        return;
    }
    let mut text = [0; ROOM];
    let length = LENGTH.load(Ordering::Relaxed);
    // Safety: so long are the lines, and no other thread goes on.
    unsafe { std::ptr::copy_nonoverlapping(lines, text.as_mut_ptr(), length) };
    let parents = FILE.load(Ordering::Relaxed);
    // Never the parent's file, even where no descriptor is left.
    let file = file_in_memory().unwrap_or(NONE);
    if map(file, lines).is_ok() && lengthen(length).is_some() {
        // Safety: as above; the file is as long.
        unsafe { std::ptr::copy_nonoverlapping(text.as_ptr(), lines, length) };
    }
    // Safety: a descriptor of our own.
    unsafe { libc::close(parents) };
    leave();
}
