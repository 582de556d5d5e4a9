//! A directory of real files.
use super::sysfs::{is_plain, open_file};
use crate::devfs::{Devfs, Stream};
use crate::error::Access;
use ev3_os::{Errno, Instant};
use input_linux::EvdevHandle;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::os::fd::AsFd;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A directory of real files.
#[derive(Debug)]
pub struct DevfsDir {
    root: PathBuf,
    started: Instant,
}

impl DevfsDir {
    /// The devices below `root`, which need not exist.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into(), started: Instant::now() }
    }
}

impl Devfs for DevfsDir {
    fn root(&self) -> &Path {
        &self.root
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn Stream>> {
        let (file, metadata) = open_file(path, access)?;
        let is_plain = is_plain(&file, &metadata)?;
        let length = (metadata.is_file() && metadata.len() > 0).then_some(metadata.len());
        Ok(Box::new(DevFile { file, is_plain, length }))
    }

    fn now(&self) -> Duration {
        self.started.elapsed()
    }

    fn pause(&self, stream: Option<&dyn Stream>, end: Duration) -> io::Result<bool> {
        if let Some(file) = stream.and_then(Stream::pollable) {
            let mut descriptors = [PollFd::new(file, PollFlags::IN)];
            let at_most =
                Timespec::try_from(end.saturating_sub(self.now())).map_err(io::Error::other)?;
            match poll(&mut descriptors, Some(&at_most)) {
                Ok(0) | Err(Errno::INTR) => return Ok(true),
                Ok(_)
                    if descriptors.iter().any(|found| found.revents().contains(PollFlags::IN)) =>
                {
                    return Ok(true);
                }
                // A pipe whose writers have gone, which is ready for nothing.
                Ok(_) => {}
                Err(errno) => return Err(errno.into()),
            }
        }
        std::thread::sleep(end.saturating_sub(self.now()));
        Ok(true)
    }
}

/// A device as an open file.
struct DevFile {
    file: File,
    is_plain: bool,
    length: Option<u64>,
}

impl Stream for DevFile {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        (&self.file).read(buffer)
    }

    fn write(&self, bytes: &[u8]) -> io::Result<usize> {
        (&self.file).write(bytes)
    }

    fn skip(&self) -> io::Result<()> {
        // A device delivers the events after it was opened; a plain file holds the
        // earlier ones, too.
        if self.is_plain {
            (&self.file).seek(SeekFrom::End(0))?;
        }
        Ok(())
    }

    fn key_state(&self, bits: &mut [u8]) -> io::Result<()> {
        EvdevHandle::new(self.file.as_fd()).key_state(bits).map(drop)
    }

    fn length(&self) -> Option<u64> {
        self.length
    }

    fn pollable(&self) -> Option<&File> {
        // A plain file is always ready.
        (!self.is_plain).then_some(&self.file)
    }
}
