//! The bricks, and which one is in use. This value holds the state of the process.
use crate::glue::signals;
use crate::glue::watch::Watched;
use ev3_driver::brick::screen::frame::Frame;
use ev3_driver::brick::sound::Sound;
use ev3_driver::drive::{Drive, Robot};
use ev3_driver::{Devfs, DevfsDir, Device, Registry, Sysfs, SysfsDir, journal, motor};
use ev3_os::locked;
use std::cell::{Cell, RefCell};
use std::io;
use std::path::PathBuf;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{
    Arc, LazyLock, Mutex, OnceLock, PoisonError, RwLock, RwLockReadGuard, RwLockWriteGuard,
};
use std::time::Duration;
use swipl::fli::{integer_flag, this_thread};

/// A brick: its attribute files, its device files, and what this process knows
/// of both. A closed one is empty, and is freed when no thread has it in use.
pub(crate) struct Brick {
    /// 0 is the brick that is there from the start. No number is used twice.
    number: u32,
    /// The files in use. A program may select others later.
    files: RwLock<InUse>,
    /// The sounds that this program makes.
    sound: Arc<Sound>,
    /// The picture that this program has drawn, if it has.
    frame: Mutex<Option<Frame>>,
    watched: Arc<Watched>,
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
    fn new(number: u32) -> Arc<Self> {
        Arc::new(Self {
            number,
            files: RwLock::new(InUse::default()),
            sound: Arc::default(),
            frame: Mutex::default(),
            watched: Arc::default(),
        })
    }

    fn files(&self) -> RwLockReadGuard<'_, InUse> {
        self.files.read().unwrap_or_else(PoisonError::into_inner)
    }

    fn change_files(&self) -> RwLockWriteGuard<'_, InUse> {
        FILES.fetch_add(1, Ordering::AcqRel);
        self.files.write().unwrap_or_else(PoisonError::into_inner)
    }

    fn devices(&self) -> Arc<Registry> {
        Arc::clone(&self.files().tree.devices)
    }

    fn chosen_devices(&self) -> Option<Arc<Registry>> {
        let files = self.files();
        files.is_tree_chosen.then(|| Arc::clone(&files.tree.devices))
    }
}

/// The directory of the kernel's own tree.
const KERNEL: &str = "/sys/class";

/// The directory of the kernel's own device files.
const KERNEL_DEV: &str = "/dev";

impl Default for InUse {
    fn default() -> Self {
        Self {
            tree: InTree::new(Arc::new(SysfsDir::new(KERNEL))),
            is_tree_chosen: false,
            dev: Arc::new(DevfsDir::new(KERNEL_DEV)),
            is_dev_chosen: false,
        }
    }
}

/// Those that are open, by their numbers; the first is always.
static BRICKS: LazyLock<Mutex<Vec<Arc<Brick>>>> = LazyLock::new(|| Mutex::new(vec![Brick::new(0)]));

/// How many bricks were opened.
static OPENED: AtomicU32 = AtomicU32::new(0);

/// Counts what may have changed the files of any brick.
static FILES: AtomicU32 = AtomicU32::new(0);

/// The brick of Prolog's main thread, by its number: pages show this one.
static SHOWN: AtomicU32 = AtomicU32::new(0);

/// The brick that a person at a page has chosen instead, while it is open.
static CHOSEN: AtomicU32 = AtomicU32::new(NOBODY);

/// No brick has this number.
const NOBODY: u32 = u32::MAX;

/// The number of Prolog's main thread.
const MAIN_THREAD: i32 = 1;

/// The flag of Prolog that a new thread inherits from the one that made it.
const FLAG: &std::ffi::CStr = c"ev3dev_brick";

thread_local! {
    static CURRENT: RefCell<Option<Arc<Brick>>> = const { RefCell::new(None) };
    /// Its number, if that is known: to ask for this takes fewer instructions.
    static NUMBER: Cell<u32> = const { Cell::new(NOBODY) };
    /// Whether this thread, which serves a page, has the brick of the main thread in use.
    static FOLLOWS: Cell<bool> = const { Cell::new(false) };
}

/// Has `act` done with the brick that this thread has in use.
#[inline]
fn with_current<R>(act: impl FnOnce(&Brick) -> R) -> R {
    // A thread that ends has none any more.
    match CURRENT.try_with(|current| current.borrow().clone()) {
        Ok(Some(brick)) => act(&brick),
        _ => act(&inherited()),
    }
}

#[cold]
fn inherited() -> Arc<Brick> {
    let thread = this_thread();
    if FOLLOWS.get() || thread < 1 {
        return shown();
    }
    let number = integer_flag(FLAG).and_then(|number| u32::try_from(number).ok());
    // One that was closed meanwhile has no files, and says so.
    let brick =
        number.map_or_else(first, |number| brick(number).unwrap_or_else(|| Brick::new(number)));
    set_current(&brick);
    brick
}

fn set_current(brick: &Arc<Brick>) {
    NUMBER.set(brick.number);
    let _ = CURRENT.try_with(|current| current.replace(Some(Arc::clone(brick))));
}

/// The brick that pages show.
fn shown() -> Arc<Brick> {
    let [chosen, main] = [&CHOSEN, &SHOWN].map(|number| brick(number.load(Ordering::Acquire)));
    let is_robot = |brick: &Arc<Brick>| brick.files().is_tree_chosen;
    let any = || locked(&BRICKS).iter().find(|brick| is_robot(brick)).cloned();
    let main_robot = || main.clone().filter(is_robot);
    chosen.or_else(main_robot).or_else(any).or(main).unwrap_or_else(first)
}

/// The film that pages show.
pub(crate) fn shown_film() -> u64 {
    shown().watched.film()
}

/// Pages show this brick as if it was that of the main thread.
pub(crate) fn show_robot(number: u32) {
    SHOWN.store(number, Ordering::Release);
    CHOSEN.store(NOBODY, Ordering::Release);
}

fn first() -> Arc<Brick> {
    Arc::clone(&locked(&BRICKS)[0])
}

fn brick(number: u32) -> Option<Arc<Brick>> {
    let bricks = locked(&BRICKS);
    let at = bricks.binary_search_by_key(&number, |brick| brick.number).ok()?;
    bricks.get(at).cloned()
}

/// The devices of all bricks whose tree is settled.
pub(crate) fn all_devices() -> Vec<Arc<Registry>> {
    let bricks = locked(&BRICKS).clone();
    bricks.iter().filter_map(|brick| brick.chosen_devices()).collect()
}

/// Has `act` done with the devices of each of them, also after an error, of which the first
/// is the result.
pub(crate) fn on_all_bricks(
    act: impl Fn(&Registry) -> ev3_driver::Result<()>,
) -> ev3_driver::Result<()> {
    all_devices().iter().map(|devices| act(devices)).fold(Ok(()), Result::and)
}

/// This thread serves a page from now on, or does not.
pub(crate) fn follow_main_thread(follows: bool) {
    FOLLOWS.set(follows);
    NUMBER.set(NOBODY);
    CURRENT.set(None);
}

/// Pages show this brick from now on, whichever the main thread has in use, or that one again;
/// `false` if it is not open.
pub(crate) fn show_brick(number: Option<u32>) -> bool {
    let is_open = number.is_none_or(|number| brick(number).is_some());
    if is_open {
        CHOSEN.store(number.unwrap_or(NOBODY), Ordering::Release);
    }
    is_open
}

/// Whether it is settled which tree is that of a brick.
pub(crate) fn has_tree(number: u32) -> bool {
    brick(number).is_some_and(|brick| brick.chosen_devices().is_some())
}

/// The time of a brick, by its own clock.
pub(crate) fn now_of(number: u32) -> Duration {
    brick(number).unwrap_or_else(first).devices().tree().now()
}

/// What is seen of the brick in use.
pub(crate) fn watched() -> Arc<Watched> {
    with_current(|brick| Arc::clone(&brick.watched))
}

/// The number of the brick in use.
pub(crate) fn brick_number() -> u32 {
    with_current(|brick| brick.number)
}

/// Makes a brick; its number.
pub(crate) fn open_brick() -> u32 {
    let mut bricks = locked(&BRICKS);
    let number = OPENED.fetch_add(1, Ordering::Relaxed) + 1;
    bricks.push(Brick::new(number));
    number
}

/// Has this thread use a brick from now on; `false` if it is not open.
pub(crate) fn use_brick(number: u32) -> bool {
    if brick_number() == number {
        return true;
    }
    let Some(brick) = brick(number) else { return false };
    set_current(&brick);
    if this_thread() == MAIN_THREAD {
        SHOWN.store(number, Ordering::Release);
    }
    true
}

/// Forgets a brick, which stops its motors; `None` if it is not open, or the first.
pub(crate) fn close_brick(number: u32) -> Option<ev3_driver::Result<()>> {
    let brick = brick(number).filter(|brick| brick.number > 0)?;
    locked(&BRICKS).retain(|open| open.number != number);
    let before = std::mem::take(&mut *brick.change_files());
    *locked(&brick.frame) = None;
    Some(motor::stop_started(&before.tree.devices))
}

/// Another number than before, if other files may be in use.
#[inline]
pub(crate) fn files_number() -> u64 {
    u64::from(NUMBER.get()) << 32 | u64::from(FILES.load(Ordering::Acquire))
}

/// Whether [`files_number`] says so: a thread that serves a page has no brick of its own.
pub(crate) fn has_files_number() -> bool {
    NUMBER.get() != NOBODY
}

/// The devices of the tree in use.
pub(crate) fn devices() -> Arc<Registry> {
    with_current(Brick::devices)
}

/// The drive of a robot in the tree in use. A tree has one drive: another robot
/// continues from its pose.
pub(crate) fn drive(robot: &Robot) -> Arc<Drive> {
    let drive = with_current(|brick| {
        let files = brick.files();
        let InTree { drive, devices } = &files.tree;
        Arc::clone(drive.get_or_init(|| Drive::new(Arc::clone(devices), robot)))
    });
    drive.set_robot(robot);
    drive
}

/// The drive of the tree in use, if it has one.
pub(crate) fn known_drive() -> Option<Arc<Drive>> {
    with_current(|brick| brick.files().tree.drive.get().cloned())
}

/// The devices of the tree in use, if it is settled which one that is.
pub(crate) fn chosen_devices() -> Option<Arc<Registry>> {
    with_current(Brick::chosen_devices)
}

/// Stops the motors of all bricks that the program started, where nobody hears what fails.
pub(crate) fn stop_started() {
    let _ = on_all_bricks(motor::stop_started);
}

/// Stops the motors of all bricks that turn while a program computes, and that got their last
/// command from that thread, or from any; those that turned.
pub(crate) fn stop_turning(commander: Option<u32>) -> Vec<Arc<Device>> {
    let devices = all_devices().into_iter().filter(|devices| devices.tree().goes_on());
    devices.flat_map(|devices| motor::stop_turning(&devices, commander)).collect()
}

/// The thread of that name has computed for so long: its motors stop.
fn computes(name: u64, limit: Duration) {
    #[expect(clippy::cast_possible_truncation, reason = "the lower half")]
    let commander = name as u32;
    journal::set_called("ev3dev_watchdog", 0);
    let stopped = stop_turning(Some(commander));
    journal::forget_called();
    let ports: Vec<_> = stopped.iter().map(|motor| motor.port()).collect();
    signals::say_computed(name, limit, &ports);
}

/// Takes the signals that end the program, and looks after threads that compute, from now on.
pub(crate) fn watch_signals() -> io::Result<()> {
    signals::watch(stop_started, computes)
}

/// Keeps the tree in use.
pub(crate) fn chosen() {
    let _ = watch_signals(); // else no motor starts
    with_current(|brick| brick.change_files().is_tree_chosen = true);
}

/// Uses another tree from now on. This stops the motors that were started in the old
/// tree, because no later call would find them there.
pub(crate) fn use_tree(tree: Arc<dyn Sysfs>) -> ev3_driver::Result<()> {
    let _ = watch_signals(); // else no motor starts
    let tree = InTree::new(tree);
    let before = with_current(|brick| {
        let mut files = brick.change_files();
        files.is_tree_chosen = true;
        std::mem::replace(&mut files.tree, tree)
    });
    watched().begin_film();
    motor::stop_started(&before.devices)
}

/// Uses the tree of files below a directory from now on.
pub(crate) fn use_files(root: impl Into<PathBuf>) -> ev3_driver::Result<()> {
    watched().set_simulated(false);
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
    let root = |root: &std::path::Path| root.to_owned();
    with_current(|brick| {
        let files = brick.files();
        Selected {
            tree: files.is_tree_chosen.then(|| root(files.tree.devices.tree().root())),
            dev: files.is_dev_chosen.then(|| root(files.dev.root())),
        }
    })
}

/// Uses these directories again. If the program had selected none, the next use of a
/// device chooses the tree, as the first one did.
#[cfg(feature = "sim")]
pub(crate) fn select(Selected { tree, dev }: Selected) -> ev3_driver::Result<()> {
    let (is_tree_chosen, is_dev_chosen) = (tree.is_some(), dev.is_some());
    use_dev_files(dev.unwrap_or_else(|| KERNEL_DEV.into()));
    let used = use_files(tree.unwrap_or_else(|| KERNEL.into()));
    with_current(|brick| {
        let mut files = brick.change_files();
        files.is_tree_chosen = is_tree_chosen;
        files.is_dev_chosen = is_dev_chosen;
    });
    used
}

/// Uses the kernel's own tree from now on.
#[cfg(feature = "fuse")]
pub(crate) fn use_default_files() -> ev3_driver::Result<()> {
    use_files(KERNEL)
}

/// The device files in use.
pub(crate) fn dev() -> Arc<dyn Devfs> {
    with_current(|brick| Arc::clone(&brick.files().dev))
}

/// Whether it is settled which device files are in use.
pub(crate) fn is_dev_chosen() -> bool {
    with_current(|brick| brick.files().is_dev_chosen)
}

/// Uses other device files from now on.
pub(crate) fn use_dev(dev: Arc<dyn Devfs>) {
    let _before = with_current(|brick| {
        let mut files = brick.change_files();
        files.is_dev_chosen = true;
        std::mem::replace(&mut files.dev, dev)
    });
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
pub(crate) fn sound() -> Arc<Sound> {
    with_current(|brick| Arc::clone(&brick.sound))
}

/// The picture that this program has drawn.
pub(crate) fn with_frame<R>(act: impl FnOnce(&mut Frame) -> R) -> R {
    with_current(|brick| act(locked(&brick.frame).get_or_insert_default()))
}
