//! The tree as real files: any program in any language can use the simulated brick.
//!
//! The kernel asks, this answers from a [`Shared`] machine whose clock belongs to somebody else.
//! Reads go straight to the drivers (direct I/O), a write is one call, truncation is harmless, as
//! in sysfs. Two things need a second thread that wakes whenever time passes: poll(2), which
//! wants to be told of a changed `state`, and writes that block, which are answered when their
//! time is over. Entries of class directories are plain directories here, not symbolic links.

mod dev;
mod files;

use std::collections::HashMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::JoinHandle;
use std::time::Duration;

use fuser::{
    BackgroundSession, Config, Filesystem, MountOption, Notifier, PollHandle, ReplyWrite, Session,
};

use crate::descriptor::Descriptor;
use crate::machine::Machine;
use crate::shared::Shared;
use dev::{DevFiles, DevOpen};
use files::Files;

const DEVICE: &str = "/dev/fuse";
/// The second thread looks this often, even if nobody wakes it, in wall time.
const LOOK: Duration = Duration::from_millis(100);

/// Why a tree could not be mounted.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MountError {
    /// The kernel has no FUSE, or this container does not show it.
    #[error("{DEVICE} is missing: the kernel has no FUSE, or this container does not pass it on")]
    NoFuse,
    /// There is no such directory to mount on.
    #[error("{}: no such directory to mount on", .0.display())]
    NoDirectory(PathBuf),
    /// The kernel, or the helper `fusermount3`, refused.
    #[error("{}: cannot mount here; without root this needs fusermount3", .path.display())]
    Refused {
        /// Where.
        path: PathBuf,
        /// What it said.
        source: io::Error,
    },
}

/// A mounted tree. Dropping it unmounts.
#[derive(Debug)]
pub struct Mount {
    session: Option<BackgroundSession>,
    watcher: Option<JoinHandle<()>>,
    shared: Arc<Shared>,
    stop: Arc<AtomicBool>,
    path: PathBuf,
}

impl Mount {
    /// Mounts the tree of a machine on an existing directory, which then is what `/sys/class` is
    /// on a brick.
    ///
    /// # Errors
    /// [`MountError`] says what is missing.
    pub fn new(shared: Arc<Shared>, path: &Path) -> Result<Mount, MountError> {
        let open = Arc::new(Mutex::new(Open::default()));
        let files = Files { shared: Arc::clone(&shared), open: Arc::clone(&open) };
        Mount::start(shared, path, files, move |shared, notifier, stop| {
            watch(shared, &open, notifier, stop);
        })
    }

    /// Mounts the devices of a machine on an existing directory, which then is what `/dev` is on a
    /// brick.
    ///
    /// # Errors
    /// [`MountError`] says what is missing.
    pub fn dev(shared: Arc<Shared>, path: &Path) -> Result<Mount, MountError> {
        let open = Arc::new(Mutex::new(DevOpen::default()));
        let files = DevFiles { shared: Arc::clone(&shared), open: Arc::clone(&open) };
        Mount::start(shared, path, files, move |shared, notifier, stop| {
            dev::watch(shared, &open, notifier, stop);
        })
    }

    fn start(
        shared: Arc<Shared>,
        path: &Path,
        files: impl Filesystem,
        watch: impl FnOnce(&Shared, &Notifier, &AtomicBool) + Send + 'static,
    ) -> Result<Mount, MountError> {
        if !Path::new(DEVICE).exists() {
            return Err(MountError::NoFuse);
        }
        if !path.is_dir() {
            return Err(MountError::NoDirectory(path.to_owned()));
        }
        let refused = |source| MountError::Refused { path: path.to_owned(), source };
        let mut config = Config::default();
        config.mount_options = vec![
            MountOption::FSName("ev3-sim".to_owned()),
            MountOption::NoExec,
            MountOption::NoSuid,
            MountOption::NoDev,
        ];
        let session = Session::new(files, path, &config).map_err(refused)?;
        let session = session.spawn().map_err(refused)?;
        let stop = Arc::new(AtomicBool::new(false));
        let watcher = std::thread::Builder::new().name("ev3-sim-fuse".to_owned()).spawn({
            let (shared, stop) = (Arc::clone(&shared), Arc::clone(&stop));
            let notifier = session.notifier();
            move || watch(&shared, &notifier, &stop)
        });
        let watcher = Some(watcher.map_err(refused)?);
        Ok(Mount { session: Some(session), watcher, shared, stop, path: path.to_owned() })
    }

    /// Where it is mounted.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Unmounts, and says whether that went well.
    ///
    /// # Errors
    /// What the kernel answers.
    pub fn unmount(mut self) -> io::Result<()> {
        self.end()
    }

    fn end(&mut self) -> io::Result<()> {
        self.stop.store(true, Ordering::SeqCst);
        self.shared.wake();
        if let Some(watcher) = self.watcher.take() {
            // It only panics if the machine did; unmounting matters more.
            let _ = watcher.join();
        }
        self.session.take().map_or(Ok(()), BackgroundSession::umount_and_join)
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = self.end();
    }
}

/// The open files of a mount.
#[derive(Debug, Default)]
struct Open {
    next: u64,
    files: HashMap<u64, Descriptor>,
    /// Who waits in poll(2), by file handle.
    polls: HashMap<u64, PollHandle>,
    /// Writes that are answered at a virtual time.
    writes: Vec<BlockedWrite>,
}

/// Until when, how many bytes were taken, and whom to tell.
type BlockedWrite = (Duration, u32, ReplyWrite);

impl Open {
    /// Takes out who waits no longer.
    fn take_due(&mut self, machine: &Machine) -> (Vec<PollHandle>, Vec<BlockedWrite>) {
        let ready = |handle: &u64| self.files.get(handle).is_none_or(|file| file.poll(machine));
        let woken: Vec<u64> = self.polls.keys().copied().filter(ready).collect();
        let polls = woken.iter().filter_map(|handle| self.polls.remove(handle)).collect();
        let writes = std::mem::take(&mut self.writes);
        let (due, waiting) = writes.into_iter().partition(|(until, ..)| *until <= machine.now());
        self.writes = waiting;
        (polls, due)
    }
}

fn locked(open: &Mutex<Open>) -> MutexGuard<'_, Open> {
    open.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Answers those who wait, whenever time has passed.
fn watch(shared: &Shared, open: &Mutex<Open>, notifier: &Notifier, stop: &AtomicBool) {
    let mut machine = shared.lock();
    while !stop.load(Ordering::SeqCst) {
        let (polls, writes) = locked(open).take_due(&machine);
        if polls.is_empty() && writes.is_empty() {
            machine = shared.wait(machine, LOOK);
            continue;
        }
        // The kernel may ask again at once, so it is told without the lock.
        drop(machine);
        for handle in polls {
            // A program that has gone away need not be told.
            let _ = notifier.poll(handle);
        }
        answer(writes);
        machine = shared.lock();
    }
    drop(machine);
    answer(std::mem::take(&mut locked(open).writes));
}

fn answer(writes: Vec<BlockedWrite>) {
    for (_, length, reply) in writes {
        reply.written(length);
    }
}
