//! The device files: the brick's buttons, its speaker and its screen.
//!
//! They are no attributes of text: events are read and written in the kernel's
//! binary layout, the screen is an array of bytes. [`DevfsDir`](crate::DevfsDir) is a directory of
//! real files: `/dev`, a FUSE mount, or any directory shaped like it, in which
//! a named pipe or a file stands for each device. A simulator may stand in for
//! it within the process by implementing [`Devfs`] and [`Stream`].
use crate::error::{Access, Error, Result};
use crate::wait::{Look, Slices, Wait};
use ev3_os::Errno;
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The longest pause before the caller can do something else.
pub(crate) const SLICE: Duration = Duration::from_millis(20);

/// A directory of device files.
pub trait Devfs: Send + Sync {
    /// The path under which programs see it: `/dev`.
    fn root(&self) -> &Path;

    /// Opens a device below the root. Never blocks.
    /// Errors: the kernel's, as ENOENT if there is no such device.
    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn Stream>>;

    /// The time since some fixed moment.
    fn now(&self) -> Duration;

    /// Lets time pass: returns when there may be something to read, when a signal arrives, or at
    /// `end`. May return early. `false` as for [`Sysfs::pause`](crate::sysfs::Sysfs::pause).
    /// Errors: the kernel's, as ENOMEM.
    fn pause(&self, stream: Option<&dyn Stream>, end: Duration) -> io::Result<bool>;

    /// A speaker that speaks by itself, as a simulated one does. With a real
    /// one, programs have to do it.
    fn speaker(&self) -> Option<&dyn Speaker> {
        None
    }
}

/// An open device.
pub trait Stream: Send + Sync {
    /// Reads what comes next. Errors: EAGAIN if there is nothing yet, else the kernel's.
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize>;

    /// Writes behind what was written before.
    fn write(&self, bytes: &[u8]) -> io::Result<usize>;

    /// Passes over what could be read so far.
    fn skip(&self) -> io::Result<()>;

    /// The keys that are down, a bit for each code, as EVIOCGKEY reports.
    /// Errors: ENOTTY where the file is no such device.
    fn key_state(&self, bits: &mut [u8]) -> io::Result<()>;

    /// How many bytes there are, if it is a store of bytes.
    fn length(&self) -> Option<u64>;

    /// The file that poll(2) can wait on.
    fn pollable(&self) -> Option<&File> {
        None
    }
}

/// A speaker that needs no programs to speak and to play.
pub trait Speaker: Send + Sync {
    /// Says a text; how long that takes.
    fn say(&self, text: &str) -> Duration;

    /// Plays a recording.
    fn play(&self, file: &str);

    /// Ends what is said or played.
    fn silence(&self);

    /// The volume, in percent.
    fn volume(&self) -> u8;

    /// Sets the volume, in percent.
    fn set_volume(&self, percent: u8);
}

/// Opens a device by its path below the root; `None` if there is none.
pub(crate) fn open(
    dev: &dyn Devfs,
    path: &Path,
    access: Access,
) -> Result<Option<Box<dyn Stream>>> {
    match dev.open(path, access) {
        Ok(stream) => Ok(Some(stream)),
        Err(error)
            if matches!(
                Errno::from_io_error(&error),
                Some(Errno::NOENT | Errno::NOTDIR | Errno::NODEV | Errno::NXIO)
            ) =>
        {
            Ok(None)
        }
        Err(source) => Err(Error::Open { path: path.to_owned(), access, source }),
    }
}

/// Opens the first of these devices that exists; also its path.
pub(crate) fn open_first(
    dev: &dyn Devfs,
    names: &[&str],
    access: Access,
) -> Result<Option<(Box<dyn Stream>, PathBuf)>> {
    for name in names {
        let path = dev.root().join(name);
        if let Some(stream) = open(dev, &path, access)? {
            return Ok(Some((stream, path)));
        }
    }
    Ok(None)
}

/// Lets time pass, whether or not there is something to read.
pub(crate) fn pause(dev: &dyn Devfs, end: Duration) -> Result<bool> {
    pause_for(dev, None, end)
}

/// Lets time pass until there may be something to read.
pub(crate) fn pause_for(
    dev: &dyn Devfs,
    stream: Option<&dyn Stream>,
    end: Duration,
) -> Result<bool> {
    let paused = dev.pause(stream, end);
    paused.map_err(|source| Error::Read { path: dev.root().to_owned(), source })
}

/// What is found some time.
pub(crate) trait Finds {
    /// Whether it is.
    fn find(&mut self) -> Result<bool>;
}

/// Until something is found.
pub(crate) struct UntilFound<L> {
    dev: Arc<dyn Devfs>,
    look: L,
}

impl<L: Finds> UntilFound<L> {
    pub(crate) fn new(dev: &Arc<dyn Devfs>, look: L) -> Slices<Self> {
        Slices::new(Self { dev: Arc::clone(dev), look })
    }
}

impl<L: Finds> Wait for UntilFound<L> {
    type End = ();

    fn look(&mut self) -> Result<Look<()>> {
        let is_found = self.look.find()?;
        Ok(if is_found { Look::Over(()) } else { Look::Again(self.dev.now() + SLICE) })
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        pause(&*self.dev, end)
    }
}
