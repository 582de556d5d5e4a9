//! A tree of real files.
use crate::class::Class;
use crate::error::{Access, Error, Result};
use crate::sysfs::{AttributeFile, Entry, Sysfs};
use ev3_os::Errno;
use ev3_signals::Kept;
use nix::time::{ClockId, clock_gettime};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::OFlags;
use std::fs::{File, Metadata, OpenOptions};
use std::io::{self, Seek, SeekFrom};
use std::os::fd::{AsFd, AsRawFd, BorrowedFd};
use std::os::unix::fs::{DirEntryExt, FileExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A tree of real files.
#[derive(Debug)]
pub struct SysfsDir {
    root: PathBuf,
}

impl SysfsDir {
    /// The tree below `root`, which need not exist.
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
        let (file, metadata) = open_file(path, access)?;
        let is_plain = is_plain(&file, &metadata)?;
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

/// Opens a file, and does not wait: a named pipe in its place would block us.
pub(crate) fn open_file(path: &Path, access: Access) -> io::Result<(File, Metadata)> {
    let file = OpenOptions::new()
        .read(access == Access::Read)
        .write(access == Access::Write)
        .custom_flags(OFlags::NONBLOCK.bits().try_into().unwrap_or_default())
        .open(path)?;
    let metadata = file.metadata()?;
    Ok((file, metadata))
}

/// Whether reads and writes of the file go to a store of bytes, rather than to a driver, as on
/// sysfs and FUSE. Devices and pipes are no stores either.
pub(super) fn is_plain(file: &File, metadata: &Metadata) -> io::Result<bool> {
    // From linux/magic.h. Both fit the word's width and sign everywhere.
    const SYSFS: u64 = 0x6265_6572;
    const FUSE: u64 = 0x6573_5546;
    if !metadata.is_file() {
        return Ok(false);
    }
    let kind = rustix::fs::fstatfs(file)?.f_type;
    Ok(!u64::try_from(kind).is_ok_and(|kind| kind == SYSFS || kind == FUSE))
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
