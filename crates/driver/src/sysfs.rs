//! The attribute files, and the clock that belongs to them.
//!
//! [`SysfsDir`](crate::SysfsDir) is a tree of real files: the kernel's `/sys/class`, a FUSE mount,
//! or any directory shaped like it. A simulator may stand in for it within
//! the process by implementing [`Sysfs`] and [`AttributeFile`].
use crate::error::{Access, Error, Interrupted, Result};
use ev3_os::Errno;
#[cfg(unix)]
use nix::sys::signal::{SigSet, SigmaskHow};
use std::io;
#[cfg(unix)]
use std::os::fd::BorrowedFd;
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
    /// Errors: the kernel's, as ENOENT if there is no such directory.
    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>>;

    /// Opens an attribute for one kind of access. Never blocks.
    /// Errors: the kernel's, as EACCES where the attribute cannot be accessed so.
    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>>;

    /// The paths that match a shell pattern (`*`, `?`, `[...]`, `**`), sorted. A pattern below
    /// `/sys/class` matches in this tree. Errors: [`Error::Pattern`].
    fn matching(&self, pattern: &str) -> Result<Vec<PathBuf>>;

    /// The time since some fixed moment.
    fn now(&self) -> Duration;

    /// Whether time passes also while the program does nothing.
    fn goes_on(&self) -> bool {
        true
    }

    /// Lets time pass: returns when one of `nodes` announces a change (as the kernel does by
    /// POLLPRI), when a signal arrives, or at `end`. May return early. `false` if no time has
    /// passed for this thread: it is to handle signals, and to go on with the same pause.
    /// Errors: the kernel's, as ENOMEM.
    fn pause(&self, nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool>;

    /// How many inferences of the program take a second of this tree's time; 0 if thinking takes
    /// none of it.
    fn thinking(&self) -> u64 {
        0
    }

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

    /// Calls `act` after `period`, by the tree's clock, and from then on each time after what it
    /// answers, until that is `None`. By default a thread does so, by the wall.
    /// Errors: the kernel's, where that takes a thread and none can be had.
    #[cfg(unix)]
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

    /// The same, if there are no threads: only a simulated tree can do so. Errors: ENOSYS
    #[cfg(not(unix))]
    fn every(&self, _period: Duration, _act: Repeated) -> io::Result<()> {
        Err(Errno::NOSYS.into())
    }
}

/// A periodic callback; returns the time to its next call.
pub type Repeated = Box<dyn FnMut() -> Option<Duration> + Send>;

/// Sleeps by the tree's clock, interruptibly.
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
    /// Errors: the driver's, as ENODEV once the device is unplugged.
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize>;

    /// Writes one value. Errors: the driver's, as EINVAL for a value it does not accept.
    fn write(&self, text: &[u8]) -> io::Result<()>;

    /// Reads a file that is not a text, from an offset on.
    fn read_at(&self, _buffer: &mut [u8], _offset: u8) -> io::Result<usize> {
        Err(Errno::OPNOTSUPP.into())
    }

    /// Writes a file that is not a text, from an offset on.
    fn write_at(&self, _bytes: &[u8], _offset: u8) -> io::Result<()> {
        Err(Errno::OPNOTSUPP.into())
    }

    /// The descriptor that poll(2) can wait on.
    #[cfg(unix)]
    fn descriptor(&self) -> Option<BorrowedFd<'_>> {
        None
    }

    /// Whether writes are seen piecemeal by readers, as in a plain file.
    fn is_plain(&self) -> bool {
        false
    }

    /// ENODEV if the file was deleted under a descriptor that goes on working
    /// all the same, as that of a plain file does.
    fn check_present(&self) -> io::Result<()> {
        Ok(())
    }
}
