//! The simulated tree as real files, through FUSE.
use crate::call::Call;
use crate::error::{no_such, wrong_because};
use crate::state::{devices, use_default_files};
use ev3_sim::{Mount, MountError, Shared};
use std::error::Error;
use std::path::Path;
use std::sync::{Arc, Mutex, PoisonError};
use swipl::prelude::*;

static MOUNTED: Mutex<Option<Mount>> = Mutex::new(None);

/// Mounts the tree of a machine on a directory. One mount at a time: another
/// one before is unmounted.
pub(crate) fn mount<C: QueryableContextType>(
    call: &Call<C>,
    machine: Arc<Shared>,
    directory: &str,
    term: &Term,
) -> PrologResult<()> {
    end();
    match Mount::new(machine, Path::new(directory)) {
        Ok(mount) => {
            *MOUNTED.lock().unwrap_or_else(PoisonError::into_inner) = Some(mount);
            Ok(())
        }
        Err(error @ MountError::NoFuse) => no_such(call, "device", "/dev/fuse", &error.to_string()),
        Err(error @ MountError::NoDirectory(_)) => {
            no_such(call, "directory", directory, &error.to_string())
        }
        Err(error) => {
            let source = error.source().map(|source| format!(": {source}")).unwrap_or_default();
            wrong_because(call, "mountable_directory", term, &format!("{error}{source}"))
        }
    }
}

/// Unmounts; fails where nothing is mounted.
pub(crate) fn unmount<C: QueryableContextType>(call: &Call<C>) -> PrologResult<()> {
    let mount = take().ok_or(PrologError::Failure)?;
    if devices().tree().root().starts_with(mount.path()) {
        // Descriptors of our own would keep it busy.
        call.check(use_default_files())?;
    }
    mount.unmount().or_else(|error| no_such(call, "mount", "mount", &error.to_string()))
}

/// Whether something is mounted.
pub(crate) fn is_mounted() -> bool {
    MOUNTED.lock().unwrap_or_else(PoisonError::into_inner).is_some()
}

/// Unmounts whatever is mounted.
pub(crate) fn end() {
    drop(take());
}

fn take() -> Option<Mount> {
    MOUNTED.lock().unwrap_or_else(PoisonError::into_inner).take()
}
