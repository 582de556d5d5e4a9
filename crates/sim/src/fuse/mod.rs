//! The tree as real files: any program in any language can use the simulated brick.
//!
//! The kernel asks; this module answers from a [`Shared`] machine, whose clock belongs to its
//! caller. Reads go straight to the drivers (direct I/O), a write is one call, truncation is
//! harmless, as in sysfs. A second thread wakes whenever time passes. It reports a changed `state`
//! to poll(2), and answers blocking calls when their time is over. Entries of class directories are
//! plain directories here, not symbolic links.

mod files;
mod open;
mod served;

use crate::machine::descriptor::Descriptor;
use crate::machine::dev::DevDescriptor;
use crate::shared::Shared;
use files::Files;
use fuser::{BackgroundSession, Config, MountOption, Session};
use open::Open;
use rustix::io::Errno;
use rustix::mount::{UnmountFlags, unmount};
use served::Served;
use std::io;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::sync::{Arc, Mutex};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

const DEVICE: &str = "/dev/fuse";

/// How long files may be busy that were closed: seconds, where three times as many threads want to
/// run as there are processors.
const FREE_WITHIN: Duration = Duration::from_secs(5);

/// How long unmounting may take.
const UNMOUNTED_WITHIN: Duration = Duration::from_secs(10);

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
    /// Mounts the tree of a machine on an existing directory, which then is what `/sys/class` is on
    /// a brick. Errors: [`MountError`] says what is missing.
    pub fn new(shared: Arc<Shared>, path: &Path) -> Result<Mount, MountError> {
        Mount::start::<Descriptor>(shared, path)
    }

    /// Mounts the devices of a machine on an existing directory, which then is what `/dev` is on a
    /// brick. Errors: [`MountError`] says what is missing.
    pub fn dev(shared: Arc<Shared>, path: &Path) -> Result<Mount, MountError> {
        Mount::start::<DevDescriptor>(shared, path)
    }

    fn start<F: Served>(shared: Arc<Shared>, path: &Path) -> Result<Mount, MountError> {
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
        let open = Arc::new(Mutex::new(Open::<F>::default()));
        let files = Files { shared: Arc::clone(&shared), open: Arc::clone(&open) };
        let session = Session::new(files, path, &config).map_err(refused)?;
        // Its threads get their name from the one that starts them.
        let start = std::thread::Builder::new().name("ev3-sim-files".to_owned());
        let start = start.spawn(move || session.spawn()).map_err(refused)?.join();
        let session = start.unwrap_or_else(|panic| resume_unwind(panic)).map_err(refused)?;
        let stop = Arc::new(AtomicBool::new(false));
        let watcher = std::thread::Builder::new().name("ev3-sim-fuse".to_owned()).spawn({
            let (shared, stop) = (Arc::clone(&shared), Arc::clone(&stop));
            let notifier = session.notifier();
            move || open::watch(&shared, &open, &notifier, &stop)
        });
        let watcher = Some(watcher.map_err(refused)?);
        Ok(Mount { session: Some(session), watcher, shared, stop, path: path.to_owned() })
    }

    /// The directory of the mount.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Unmounts, and says whether that went well. Errors: the error of the kernel, such as EBUSY;
    /// also [`ResourceBusy`](io::ErrorKind::ResourceBusy) if the unmount happens only when the last
    /// open file is closed.
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
        let Some(session) = self.session.take() else {
            return Ok(());
        };
        // Without root the kernel lets it go only with the last open file: by then there may be
        // nobody to wait for it.
        let (sender, ended) = channel();
        let path = self.path.clone();
        std::thread::Builder::new().name("ev3-sim-unmount".to_owned()).spawn(move || {
            let is_unmounted = unmount_when_free(&path);
            let ended = session.umount_and_join().or_else(|error| match error.raw_os_error() {
                // Not mounted, says the kernel before the session has noticed.
                Some(number) if is_unmounted && number == Errno::INVAL.raw_os_error() => Ok(()),
                _ => Err(error),
            });
            // If the receiver is gone, the caller knows that this may take long.
            let _ = sender.send(ended);
        })?;
        match ended.recv_timeout(UNMOUNTED_WITHIN) {
            // Unmounted, while the kernel was about to ask something.
            Ok(Err(error)) if error.kind() == io::ErrorKind::ConnectionAborted => Ok(()),
            Ok(ended) => ended,
            Err(_) => Err(io::ErrorKind::ResourceBusy.into()),
        }
    }
}

/// Unmounts as root. A file that was just closed is busy a little longer, on a machine with much to
/// do for a long time. Other errors are left to the session: it tries again, and without root asks
/// `fusermount3`.
fn unmount_when_free(path: &Path) -> bool {
    let start = Instant::now();
    loop {
        match unmount(path, UnmountFlags::empty()) {
            Err(Errno::BUSY) if start.elapsed() < FREE_WITHIN => {
                std::thread::sleep(Duration::from_millis(5));
            }
            result => return result.is_ok(),
        }
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = self.end();
    }
}
