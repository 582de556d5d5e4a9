//! The tree in use, one for the whole process.
use ev3_driver::brick::screen::frame::Frame;
use ev3_driver::brick::sound::Sound;
use ev3_driver::{Dev, DevFiles, Devices, Files, Tree, motor};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError, RwLock};

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

/// The device files in use.
pub(crate) fn dev() -> Arc<dyn Dev> {
    Arc::clone(&DEV.read().unwrap_or_else(PoisonError::into_inner))
}

/// Whether it is settled which device files are in use.
pub(crate) fn is_dev_chosen() -> bool {
    DEV_CHOSEN.load(Ordering::Acquire)
}

/// Uses other device files from now on.
pub(crate) fn use_dev(dev: Arc<dyn Dev>) {
    *DEV.write().unwrap_or_else(PoisonError::into_inner) = dev;
    DEV_CHOSEN.store(true, Ordering::Release);
}

/// Uses the device files below a directory from now on.
pub(crate) fn use_dev_files(root: impl Into<PathBuf>) {
    use_dev(Arc::new(DevFiles::new(root)));
}

/// Uses the kernel's own device files from now on.
#[cfg(feature = "fuse")]
pub(crate) fn use_default_dev() {
    use_dev_files(KERNEL_DEV);
}

/// What this program makes sound.
pub(crate) fn sound() -> &'static Sound {
    static SOUND: LazyLock<Sound> = LazyLock::new(Sound::default);
    &SOUND
}

/// What this program has drawn.
pub(crate) fn frame() -> MutexGuard<'static, Frame> {
    static FRAME: LazyLock<Mutex<Frame>> = LazyLock::new(Mutex::default);
    FRAME.lock().unwrap_or_else(PoisonError::into_inner)
}

static CHOSEN: AtomicBool = AtomicBool::new(false);

/// Where the kernel's own tree is.
const KERNEL: &str = "/sys/class";

static DEV_CHOSEN: AtomicBool = AtomicBool::new(false);

/// Where the kernel's own device files are.
const KERNEL_DEV: &str = "/dev";

static DEV: LazyLock<RwLock<Arc<dyn Dev>>> =
    LazyLock::new(|| RwLock::new(Arc::new(DevFiles::new(KERNEL_DEV))));

static DEVICES: LazyLock<RwLock<Arc<Devices>>> =
    LazyLock::new(|| RwLock::new(Arc::new(Devices::new(Arc::new(Files::new(KERNEL))))));
