//! The tree in use, one for the whole process.
use ev3_driver::{Devices, Files, motor};
use std::path::PathBuf;
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

static DEVICES: LazyLock<RwLock<Arc<Devices>>> =
    LazyLock::new(|| RwLock::new(Arc::new(in_files("/sys/class"))));

/// The devices of the tree in use.
pub(crate) fn devices() -> Arc<Devices> {
    Arc::clone(&DEVICES.read().unwrap_or_else(PoisonError::into_inner))
}

/// Uses the tree of files below a directory from now on. Motors that were
/// started in the tree in use so far are stopped: nobody would find them there
/// any more.
pub(crate) fn use_files(root: impl Into<PathBuf>) -> ev3_driver::Result<()> {
    let devices = Arc::new(in_files(root));
    let before = {
        let mut current = DEVICES.write().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *current, devices)
    };
    motor::stop_started(&before)
}

fn in_files(root: impl Into<PathBuf>) -> Devices {
    Devices::new(Arc::new(Files::new(root)))
}
