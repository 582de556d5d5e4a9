//! Without an operating system: trees without devices.
use crate::devfs::{Devfs, Stream};
use crate::error::{Access, Result};
use crate::sysfs::{AttributeFile, Entry, Sysfs};
use ev3_os::{Errno, Instant, sleep};
use std::fs::{File, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::Duration;

/// A tree without devices, of attributes or of device files.
#[derive(Debug)]
pub struct NoFiles {
    root: PathBuf,
    started: Instant,
}

impl NoFiles {
    /// A tree that is said to be at `root`.
    pub fn new(root: impl Into<PathBuf>) -> Self {
        Self { root: root.into(), started: Instant::now() }
    }
}

impl Sysfs for NoFiles {
    fn root(&self) -> &Path {
        &self.root
    }

    fn list(&self, _directory: &Path) -> io::Result<Vec<Entry>> {
        Err(Errno::NOENT.into())
    }

    fn open(&self, _path: &Path, _access: Access) -> io::Result<Box<dyn AttributeFile>> {
        Err(Errno::NOENT.into())
    }

    fn matching(&self, _pattern: &str) -> Result<Vec<PathBuf>> {
        Ok(Vec::new())
    }

    fn now(&self) -> Duration {
        self.started.elapsed()
    }

    fn pause(&self, _nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        sleep(end.saturating_sub(self.started.elapsed()));
        Ok(true)
    }
}

impl Devfs for NoFiles {
    fn root(&self) -> &Path {
        &self.root
    }

    fn open(&self, _path: &Path, _access: Access) -> io::Result<Box<dyn Stream>> {
        Err(Errno::NOENT.into())
    }

    fn now(&self) -> Duration {
        Sysfs::now(self)
    }

    fn pause(&self, _stream: Option<&dyn Stream>, end: Duration) -> io::Result<bool> {
        Sysfs::pause(self, &[], end)
    }
}

/// Opens a file to read it.
pub(crate) fn open_file(path: &Path, _access: Access) -> io::Result<(File, Metadata)> {
    let file = File::open(path)?;
    let metadata = file.metadata()?;
    Ok((file, metadata))
}
