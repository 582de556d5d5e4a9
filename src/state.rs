//! The tree in use, one for the whole process.
use ev3_driver::{Devices, Files, Tree, motor};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, PoisonError, RwLock};

/// The devices of the tree in use.
pub(crate) fn devices() -> Arc<Devices> {
    Arc::clone(&DEVICES.read().unwrap_or_else(PoisonError::into_inner))
}

/// Whether it is settled which tree is in use.
pub(crate) fn is_chosen() -> bool {
    CHOSEN.load(Ordering::Acquire)
}

/// The tree in use now is the one to use.
pub(crate) fn chosen() {
    CHOSEN.store(true, Ordering::Release);
}

/// Uses another tree from now on. Motors that were started in the tree in use
/// so far are stopped: nobody would find them there any more.
pub(crate) fn use_tree(tree: Arc<dyn Tree>) -> ev3_driver::Result<()> {
    let devices = Arc::new(Devices::new(tree));
    let before = {
        let mut current = DEVICES.write().unwrap_or_else(PoisonError::into_inner);
        std::mem::replace(&mut *current, devices)
    };
    chosen();
    motor::stop_started(&before)
}

/// Uses the tree of files below a directory from now on.
pub(crate) fn use_files(root: impl Into<PathBuf>) -> ev3_driver::Result<()> {
    use_tree(Arc::new(Files::new(root)))
}

/// Uses the kernel's own tree from now on.
#[cfg(feature = "fuse")]
pub(crate) fn use_default_files() -> ev3_driver::Result<()> {
    use_files(KERNEL)
}

static CHOSEN: AtomicBool = AtomicBool::new(false);

/// Where the kernel's own tree is.
const KERNEL: &str = "/sys/class";

static DEVICES: LazyLock<RwLock<Arc<Devices>>> =
    LazyLock::new(|| RwLock::new(Arc::new(Devices::new(Arc::new(Files::new(KERNEL))))));
