//! The attribute files, and the clock that belongs to them.
//!
//! [`SysfsDir`] is a tree of real files: the kernel's `/sys/class`, a FUSE mount,
//! or any directory shaped like it. A simulator may stand in for it within
//! the process by implementing [`Sysfs`] and [`AttributeFile`].
use crate::class::Class;
use crate::error::{Access, Error, Interrupted, Result};
use ev3_signals::Kept;
use nix::sys::signal::{SigSet, SigmaskHow};
use nix::time::{ClockId, clock_gettime};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use rustix::io::Errno;
use std::fs::{File, OpenOptions};
use std::io::{self, Seek, SeekFrom};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd};
use std::os::unix::fs::{DirEntryExt, FileExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The longest sleep before asking the caller whether to go on.
pub(crate) const SLICE: Duration = Duration::from_millis(20);

/// An entry of a class directory.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// The file name: `motor0`.
    pub name: String,
    /// The inode number. A device that is plugged in again has another one,
    /// even where it has the same name.
    pub inode: u64,
}

/// A tree of attribute files.
pub trait Sysfs: Send + Sync {
    /// The path under which programs see the tree: `/sys/class`.
    fn root(&self) -> &Path;

    /// The entries of a directory, in any order.
    ///
    /// # Errors
    /// The kernel's, as ENOENT where there is no such directory.
    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>>;

    /// Opens an attribute for one kind of access. Never blocks.
    ///
    /// # Errors
    /// The kernel's, as EACCES where the attribute cannot be accessed so.
    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>>;

    /// The paths that match a shell pattern (`*`, `?`, `[...]`, `**`), sorted.
    /// A pattern below `/sys/class` matches in this tree.
    ///
    /// # Errors
    /// [`Error::Pattern`].
    fn matching(&self, pattern: &str) -> Result<Vec<PathBuf>>;

    /// The time since some fixed moment.
    fn now(&self) -> Duration;

    /// Whether time passes also while the program does nothing.
    fn goes_on(&self) -> bool {
        true
    }

    /// Lets time pass: returns when one of `nodes` announces a change (as the
    /// kernel does by POLLPRI), when a signal arrives, or at `end`. May return early.
    /// `false` if no time has passed for this thread: it is to handle signals, and to
    /// go on with the same pause.
    ///
    /// # Errors
    /// The kernel's, as ENOMEM.
    fn pause(&self, nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool>;

    /// Whether threads wait for their turns, see [`turn`](Self::turn).
    fn takes_turns(&self) -> bool {
        false
    }

    /// A call of the program begins, and this thread holds no lock. A simulation waits
    /// for the thread's turn here; `false` as for [`pause`](Self::pause). `about` says
    /// what is called, and with what.
    fn turn(&self, _about: &mut dyn FnMut() -> String) -> bool {
        true
    }

    /// Calls `act` after `period`, by the tree's clock, and from then on each
    /// time after what it answers, until that is `None`. By default a thread
    /// does so, by the wall.
    ///
    /// # Errors
    /// The kernel's, where that takes a thread and none can be had.
    fn every(&self, period: Duration, mut act: Repeated) -> io::Result<()> {
        let run = move || {
            let mut next = Some(period);
            while let Some(period) = next {
                std::thread::sleep(period);
                next = act();
            }
        };
        // Signals are for the program's own threads: a new one takes over what
        // is blocked in this one.
        let before = SigSet::all().thread_swap_mask(SigmaskHow::SIG_BLOCK)?;
        let spawned = std::thread::Builder::new().name("ev3-drive".to_owned()).spawn(run);
        before.thread_set_mask()?;
        spawned.map(drop)
    }
}

/// A periodic callback; returns the time to its next call.
pub type Repeated = Box<dyn FnMut() -> Option<Duration> + Send>;

/// Sleeps by the tree's clock, interruptibly.
///
/// # Errors
/// [`Error::Interrupted`].
pub fn sleep(tree: &dyn Sysfs, time: Duration, interrupted: Interrupted) -> Result<()> {
    let end = tree.now().saturating_add(time);
    loop {
        let left = end.saturating_sub(tree.now());
        if left.is_zero() {
            return Ok(());
        }
        if interrupted() {
            return Err(Error::Interrupted);
        }
        pause(tree, &[], left.min(SLICE), interrupted)?;
    }
}

/// Lets time pass as [`Sysfs::pause`] does, once, and handles signals meanwhile. A pause
/// that failed is over, too: the caller asks the clock, or looks again.
///
/// # Errors
/// [`Error::Interrupted`].
pub(crate) fn pause(
    tree: &dyn Sysfs,
    nodes: &[&dyn AttributeFile],
    time: Duration,
    interrupted: Interrupted,
) -> Result<()> {
    let end = tree.now().saturating_add(time);
    while matches!(tree.pause(nodes, end), Ok(false)) {
        if interrupted() {
            return Err(Error::Interrupted);
        }
    }
    Ok(())
}

/// An open attribute file.
pub trait AttributeFile: Send + Sync {
    /// Reads the whole text, as the driver generates it now.
    ///
    /// # Errors
    /// The driver's, as ENODEV once the device is unplugged.
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize>;

    /// Writes one value.
    ///
    /// # Errors
    /// The driver's, as EINVAL for a value it does not accept.
    fn write(&self, text: &[u8]) -> io::Result<()>;

    /// Reads a file that is no text, from an offset on.
    ///
    /// # Errors
    /// The driver's.
    fn read_at(&self, _buffer: &mut [u8], _offset: u8) -> io::Result<usize> {
        Err(Errno::OPNOTSUPP.into())
    }

    /// Writes a file that is no text, from an offset on.
    ///
    /// # Errors
    /// The driver's.
    fn write_at(&self, _bytes: &[u8], _offset: u8) -> io::Result<()> {
        Err(Errno::OPNOTSUPP.into())
    }

    /// The descriptor that poll(2) can wait on.
    fn descriptor(&self) -> Option<BorrowedFd<'_>> {
        None
    }

    /// Whether writes are seen piecemeal by readers, as in a plain file.
    fn is_plain(&self) -> bool {
        false
    }

    /// ENODEV if the file was deleted under a descriptor that goes on working
    /// all the same, as that of a plain file does.
    ///
    /// # Errors
    /// ENODEV.
    fn check_present(&self) -> io::Result<()> {
        Ok(())
    }
}

/// A tree of real files.
#[derive(Debug)]
pub struct SysfsDir {
    root: PathBuf,
}

impl SysfsDir {
    /// The tree below `root`, which need not exist.
    #[must_use]
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into() }
    }
}

impl Sysfs for SysfsDir {
    fn root(&self) -> &Path {
        &self.root
    }

    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        directory
            .read_dir()?
            .map(|entry| {
                let entry = entry?;
                Ok(Entry {
                    name: entry.file_name().to_string_lossy().into_owned(),
                    inode: entry.ino(),
                })
            })
            .collect()
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        let file = OpenOptions::new()
            .read(access == Access::Read)
            .write(access == Access::Write)
            // A named pipe in the place of an attribute must not block us.
            .custom_flags(OFlags::NONBLOCK.bits().try_into().unwrap_or_default())
            .open(path)?;
        // Devices and pipes are no stores of bytes either.
        let is_plain = file.metadata()?.is_file() && !is_generated(&file)?;
        let kept = if access == Access::Write && path.ends_with("command") {
            let is_servos = path.starts_with(self.root.join(Class::ServoMotor.directory()));
            Kept::new(file.as_raw_fd(), path, if is_servos { "float" } else { "stop" })?
        } else {
            None
        };
        Ok(Box::new(OpenFile { kept, file, is_plain }))
    }

    fn matching(&self, pattern: &str) -> Result<Vec<PathBuf>> {
        let pattern = match pattern.strip_prefix("/sys/class/") {
            Some(rest) => {
                let root = glob::Pattern::escape(&self.root.to_string_lossy());
                &format!("{root}/{rest}")
            }
            None => pattern,
        };
        let paths = glob::glob(pattern)
            .map_err(|source| Error::Pattern { pattern: pattern.to_owned(), source })?;
        // Directories that cannot be listed hold no devices of ours.
        Ok(paths.filter_map(std::result::Result::ok).collect())
    }

    fn now(&self) -> Duration {
        // Several times a call: an `Instant` and its difference take thrice as long.
        clock_gettime(ClockId::CLOCK_MONOTONIC).map(Duration::from).unwrap_or_default()
    }

    fn pause(&self, nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        let mut descriptors: Vec<PollFd> = nodes
            .iter()
            .filter_map(|node| node.descriptor())
            .map(|descriptor| PollFd::from_borrowed_fd(descriptor, PollFlags::PRI))
            .collect();
        let timeout = Timespec::try_from(end.saturating_sub(self.now()));
        match poll(&mut descriptors, Some(&timeout.map_err(io::Error::other)?)) {
            // A signal: the caller handles it.
            Ok(_) | Err(Errno::INTR) => Ok(true),
            Err(errno) => Err(errno.into()),
        }
    }
}

/// Whether reads and writes of the file go to a driver, as on sysfs and FUSE,
/// rather than to a store of bytes.
pub(crate) fn is_generated(file: &File) -> io::Result<bool> {
    // From linux/magic.h. Both fit the word's width and sign everywhere.
    const SYSFS: u64 = 0x6265_6572;
    const FUSE: u64 = 0x6573_5546;
    let kind = rustix::fs::fstatfs(file)?.f_type;
    Ok(u64::try_from(kind).is_ok_and(|kind| kind == SYSFS || kind == FUSE))
}

/// An attribute as an open file, read and written at offset 0.
struct OpenFile {
    /// For a motor's commands. It goes before the file.
    kept: Option<Kept>,
    file: File,
    is_plain: bool,
}

impl OpenFile {
    fn write_text(&self, text: &[u8]) -> io::Result<()> {
        // By seeking: a stat before each write makes the write twice as dear,
        // as file systems then give it a time-stamp of its own.
        let length = if self.is_plain { (&self.file).seek(SeekFrom::End(0))? } else { 0 };
        let written = self.file.write_at(text, 0)?;
        if written < text.len() {
            return Err(io::ErrorKind::WriteZero.into());
        }
        if length > text.len() as u64 {
            // Afterwards: a reader in between finds the new text on the first
            // line, and never an empty file.
            self.file.set_len(text.len() as u64)?;
        }
        Ok(())
    }
}

impl AttributeFile for OpenFile {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        self.file.read_at(buffer, 0)
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        match &self.kept {
            Some(kept) => kept.tell(text, || self.write_text(text)),
            None => self.write_text(text),
        }
    }

    fn read_at(&self, buffer: &mut [u8], offset: u8) -> io::Result<usize> {
        self.file.read_at(buffer, offset.into())
    }

    fn write_at(&self, bytes: &[u8], offset: u8) -> io::Result<()> {
        match self.file.write_at(bytes, offset.into())? {
            written if written == bytes.len() => Ok(()),
            _ => Err(io::ErrorKind::WriteZero.into()),
        }
    }

    fn descriptor(&self) -> Option<BorrowedFd<'_>> {
        Some(self.file.as_fd())
    }

    fn is_plain(&self) -> bool {
        self.is_plain
    }

    fn check_present(&self) -> io::Result<()> {
        if self.is_plain && rustix::fs::fstat(&self.file)?.st_nlink == 0 {
            return Err(Errno::NODEV.into());
        }
        Ok(())
    }
}
