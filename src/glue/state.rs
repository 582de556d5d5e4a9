//! The brick in use. This value holds the state of the process.
use crate::glue::{signals, watch};
use ev3_driver::brick::screen::frame::Frame;
use ev3_driver::brick::sound::Sound;
use ev3_driver::drive::{Drive, Robot};
use ev3_driver::lock::locked;
use ev3_driver::{Devfs, DevfsDir, Registry, Sysfs, SysfsDir, motor};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{
    Arc, LazyLock, Mutex, MutexGuard, OnceLock, PoisonError, RwLock, RwLockReadGuard,
    RwLockWriteGuard,
};

/// A brick: its attribute files, its device files, and what this process knows
/// of both.
struct Brick {
    /// The files in use. A program may select others later.
    files: RwLock<InUse>,
    /// The sounds that this program makes.
    sound: Sound,
    /// The picture that this program has drawn.
    frame: Mutex<Frame>,
    /// The pictures that it had drawn before, and sees again.
    frames_aside: Mutex<Vec<Frame>>,
}

/// The files in use.
struct InUse {
    tree: InTree,
    /// Whether it is settled which tree is in use.
    is_tree_chosen: bool,
    dev: Arc<dyn Devfs>,
    /// Whether it is settled which device files are in use.
    is_dev_chosen: bool,
}

/// The state that belongs to one tree. Another tree gets a new state.
struct InTree {
    /// The robot's drive, with its odometry. The first use makes it. It is the first
    /// field, so that it is dropped before the devices that it uses.
    drive: OnceLock<Arc<Drive>>,
    devices: Arc<Registry>,
}

impl InTree {
    fn new(tree: Arc<dyn Sysfs>) -> Self {
        Self { drive: OnceLock::new(), devices: Arc::new(Registry::new(tree)) }
    }
}

impl Brick {
    fn files(&self) -> RwLockReadGuard<'_, InUse> {
        self.files.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn change_files(&self) -> RwLockWriteGuard<'_, InUse> {
        FILES_NUMBER.fetch_add(1, Ordering::AcqRel);
        self.files.write().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The directory of the kernel's own tree.
const KERNEL: &str = "/sys/class";

/// The directory of the kernel's own device files.
const KERNEL_DEV: &str = "/dev";

static BRICK: LazyLock<Brick> = LazyLock::new(|| Brick {
    files: RwLock::new(InUse {
        tree: InTree::new(Arc::new(SysfsDir::new(KERNEL))),
        is_tree_chosen: false,
        dev: Arc::new(DevfsDir::new(KERNEL_DEV)),
        is_dev_chosen: false,
    }),
    sound: Sound::default(),
    frame: Mutex::default(),
    frames_aside: Mutex::default(),
});

/// Counts what may have changed the files in use.
static FILES_NUMBER: AtomicU32 = AtomicU32::new(0);

/// Another number than before, if other files may be in use.
pub(crate) fn files_number() -> u32 {
    FILES_NUMBER.load(Ordering::Acquire)
}

/// The devices of the tree in use.
pub(crate) fn devices() -> Arc<Registry> {
    Arc::clone(&BRICK.files().tree.devices)
}

/// The drive of a robot in the tree in use. A tree has one drive: another robot
/// continues from its pose.
pub(crate) fn drive(robot: &Robot) -> Arc<Drive> {
    let drive = {
        let files = BRICK.files();
        let InTree { drive, devices } = &files.tree;
        Arc::clone(drive.get_or_init(|| Drive::new(Arc::clone(devices), robot)))
    };
    drive.set_robot(robot);
    drive
}

/// The drive of the tree in use, if it has one.
pub(crate) fn known_drive() -> Option<Arc<Drive>> {
    BRICK.files().tree.drive.get().cloned()
}

/// The devices of the tree in use, if it is settled which one that is.
pub(crate) fn chosen_devices() -> Option<Arc<Registry>> {
    let files = BRICK.files();
    files.is_tree_chosen.then(|| Arc::clone(&files.tree.devices))
}

/// Stops the motors that the program started, where nobody is told what fails.
pub(crate) fn stop_started() {
    let _ = motor::stop_started(&devices());
}

/// Keeps the tree in use.
pub(crate) fn chosen() {
    let _ = signals::watch(stop_started); // else no motor starts
    BRICK.change_files().is_tree_chosen = true;
}

/// Uses another tree from now on. This stops the motors that were started in the old
/// tree, because no later call would find them there.
pub(crate) fn use_tree(tree: Arc<dyn Sysfs>) -> ev3_driver::Result<()> {
    let _ = signals::watch(stop_started); // else no motor starts
    let tree = InTree::new(tree);
    let before = {
        let mut files = BRICK.change_files();
        files.is_tree_chosen = true;
        std::mem::replace(&mut files.tree, tree)
    };
    watch::begin_film();
    motor::stop_started(&before.devices)
}

/// Uses the tree of files below a directory from now on.
pub(crate) fn use_files(root: impl Into<PathBuf>) -> ev3_driver::Result<()> {
    watch::set_simulated(false);
    use_tree(Arc::new(SysfsDir::new(root)))
}

/// The directories that the program has selected: of attribute files and of device files.
#[cfg(feature = "sim")]
#[derive(Clone)]
pub(crate) struct Selected {
    tree: Option<PathBuf>,
    dev: Option<PathBuf>,
}

/// The directories that the program has selected.
#[cfg(feature = "sim")]
pub(crate) fn selected() -> Selected {
    let files = BRICK.files();
    let root = |root: &Path| root.to_owned();
    Selected {
        tree: files.is_tree_chosen.then(|| root(files.tree.devices.tree().root())),
        dev: files.is_dev_chosen.then(|| root(files.dev.root())),
    }
}

/// Uses these directories again. If the program had selected none, the next use of a
/// device chooses the tree, as the first one did.
#[cfg(feature = "sim")]
pub(crate) fn select(Selected { tree, dev }: Selected) -> ev3_driver::Result<()> {
    let (is_tree_chosen, is_dev_chosen) = (tree.is_some(), dev.is_some());
    use_dev_files(dev.unwrap_or_else(|| KERNEL_DEV.into()));
    let used = use_files(tree.unwrap_or_else(|| KERNEL.into()));
    let mut files = BRICK.change_files();
    files.is_tree_chosen = is_tree_chosen;
    files.is_dev_chosen = is_dev_chosen;
    used
}

/// Uses the kernel's own tree from now on.
#[cfg(feature = "fuse")]
pub(crate) fn use_default_files() -> ev3_driver::Result<()> {
    use_files(KERNEL)
}

/// The device files in use.
pub(crate) fn dev() -> Arc<dyn Devfs> {
    Arc::clone(&BRICK.files().dev)
}

/// Whether it is settled which device files are in use.
pub(crate) fn is_dev_chosen() -> bool {
    BRICK.files().is_dev_chosen
}

/// Uses other device files from now on.
pub(crate) fn use_dev(dev: Arc<dyn Devfs>) {
    let _before = {
        let mut files = BRICK.change_files();
        files.is_dev_chosen = true;
        std::mem::replace(&mut files.dev, dev)
    };
}

/// Uses the device files below a directory from now on.
pub(crate) fn use_dev_files(root: impl Into<PathBuf>) {
    use_dev(Arc::new(DevfsDir::new(root)));
}

/// Uses the kernel's own device files from now on.
#[cfg(feature = "fuse")]
pub(crate) fn use_default_dev() {
    use_dev_files(KERNEL_DEV);
}

/// The sounds that this program makes.
pub(crate) fn sound() -> &'static Sound {
    &BRICK.sound
}

/// The picture that this program has drawn.
pub(crate) fn frame() -> MutexGuard<'static, Frame> {
    locked(&BRICK.frame)
}

/// Sets aside what this program has drawn, and begins a blank picture.
pub(crate) fn set_frame_aside() {
    let before = std::mem::take(&mut *frame());
    locked(&BRICK.frames_aside).push(before);
}

/// Has what was set aside last in the place of what was drawn since.
pub(crate) fn give_frame_back() {
    let before = locked(&BRICK.frames_aside).pop();
    *frame() = before.unwrap_or_default();
}
