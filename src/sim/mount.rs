//! The simulated tree as real files, through FUSE.
use crate::glue::call::Call;
use crate::glue::error::{no_such, wrong_because};
use crate::glue::sources::close_sources;
use crate::glue::state::{brick_number, dev, devices, use_default_dev, use_default_files};
use crate::glue::terms::Prolog;
use ev3_driver::Registry;
use ev3_os::locked;
use ev3_sim::{Mount, MountError, Shared};
use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::sync::{Arc, Mutex, Weak};
use std::time::{Duration, Instant};
use swipl::prelude::*;

/// By the number of the brick.
static MOUNTED: Mutex<BTreeMap<u32, Mounted>> = Mutex::new(BTreeMap::new());

/// The mounts: the classes of devices, and perhaps the device files.
struct Mounted {
    classes: Mount,
    dev: Option<Mount>,
}

/// Mounts the tree of a machine on a directory, and its device files on
/// another one if it is given. A brick has one mount: this unmounts an earlier one.
pub(crate) fn mount<C: Prolog>(
    call: &Call<C>,
    machine: &Arc<Shared>,
    classes: &Term,
    dev: Option<&Term>,
) -> PrologResult<()> {
    end();
    let classes = mounted(call, classes, Mount::new, machine)?;
    let dev = dev.map(|term| mounted(call, term, Mount::dev, machine)).transpose()?;
    locked(&MOUNTED).insert(brick_number(), Mounted { classes, dev });
    Ok(())
}

fn mounted<C: Prolog>(
    call: &Call<C>,
    term: &Term,
    mount: fn(Arc<Shared>, &Path) -> Result<Mount, MountError>,
    machine: &Arc<Shared>,
) -> PrologResult<Mount> {
    let directory = call.text(term)?;
    match mount(Arc::clone(machine), Path::new(&*directory)) {
        Ok(mount) => Ok(mount),
        Err(error @ MountError::NoFuse) => no_such(call, "device", "/dev/fuse", &error.to_string()),
        Err(error @ MountError::NoDirectory(_)) => {
            no_such(call, "directory", &directory, &error.to_string())
        }
        Err(error) => {
            let source = error.source().map(|source| format!(": {source}")).unwrap_or_default();
            wrong_because(call, "mountable_directory", term, &format!("{error}{source}"))
        }
    }
}

/// Unmounts; fails if nothing is mounted.
pub(crate) fn unmount<C: Prolog>(call: &Call<C>) -> PrologResult<()> {
    let mounted = take().ok_or(PrologError::Failure)?;
    call.or_throw(let_go(&mounted))?;
    if let Some(mount) = mounted.dev {
        gone(call, mount)?;
    }
    gone(call, mounted.classes)
}

/// Closes this process's files in the mount: open descriptors would keep it busy.
fn let_go(mounted: &Mounted) -> ev3_driver::Result<()> {
    let used = Arc::downgrade(&devices());
    if devices().tree().root().starts_with(mounted.classes.path()) {
        use_default_files()?;
        wait_until_unused(&used);
    }
    if mounted.dev.as_ref().is_some_and(|mount| dev().root().starts_with(mount.path())) {
        use_default_dev();
        close_sources();
    }
    Ok(())
}

/// Another thread, for example the loop of a drive, may be using these devices. Wait
/// for it; a thread that uses them for long keeps the mount busy.
fn wait_until_unused(devices: &Weak<Registry>) {
    let patience = Instant::now() + Duration::from_secs(1);
    while devices.strong_count() > 0 && Instant::now() < patience {
        std::thread::sleep(Duration::from_millis(1));
    }
}

fn gone<C: Prolog>(call: &Call<C>, mount: Mount) -> PrologResult<()> {
    mount.unmount().or_else(|error| no_such(call, "mount", "mount", &error.to_string()))
}

/// Whether something is mounted.
pub(crate) fn is_mounted() -> bool {
    locked(&MOUNTED).contains_key(&brick_number())
}

/// Unmounts what shows the simulation of the brick in use.
pub(crate) fn end() {
    if let Some(mounted) = take() {
        // Unmount even if the motors cannot be stopped.
        let _ = let_go(&mounted);
    }
}

fn take() -> Option<Mounted> {
    locked(&MOUNTED).remove(&brick_number())
}

/// Unmounts what shows the simulation of a brick that nobody uses.
pub(crate) fn end_of(brick: u32) {
    let mounted = locked(&MOUNTED).remove(&brick);
    drop(mounted);
}
