//! Somebody watches the program: `prolog/ev3dev/view.pl`.
use ev3_motion::Pose;
use ev3_os::{Instant, locked};
use ev3_sim::is_outside;
use std::cell::RefCell;
use std::sync::atomic::{AtomicBool, AtomicU8, AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard};
use std::time::Duration;
use swipl::fli::this_thread;

static IS_WATCHED: AtomicBool = AtomicBool::new(false);

/// Counts the films: each tree, and each return to a snapshot, begins one.
static FILMS: AtomicU32 = AtomicU32::new(1);

/// When a page asked for a frame last, for how long that counts, and the film that it had drawn.
static LOOK: Mutex<Option<(Instant, Duration, u64)>> = Mutex::new(None);

/// A page that has not asked for so long shows nothing.
pub(crate) const LOOKS: Duration = Duration::from_secs(3);

/// A page that has drawn a frame of this film asks for the next one, or will within a time.
pub(crate) fn look(film: u64, time: Duration) {
    *locked(&LOOK) = Some((Instant::now(), time, film));
}

/// The film that a page draws, if there is one.
pub(crate) fn drawn_film() -> Option<u64> {
    let look = *locked(&LOOK);
    look.filter(|(at, time, _)| at.elapsed() < *time).map(|(_, _, film)| film)
}

/// What is seen of a brick.
pub(crate) struct Watched {
    /// Whether its tree is that of a simulation within this process.
    is_simulated: AtomicBool,
    film: AtomicU32,
    /// The inputs whose sensors the program has read during the film, as bits.
    read: AtomicU8,
    /// The frame in which the robot's odometry counts, in the world.
    frame: Mutex<Option<Frame>>,
}

impl Default for Watched {
    fn default() -> Self {
        Self {
            is_simulated: AtomicBool::new(false),
            film: AtomicU32::new(FILMS.fetch_add(1, Ordering::Relaxed)),
            read: AtomicU8::new(0),
            frame: Mutex::default(),
        }
    }
}

impl Watched {
    /// Whether the tree in use is that of the simulation within this process, and not files.
    #[cfg(feature = "sim")]
    pub(crate) fn is_simulated(&self) -> bool {
        self.is_simulated.load(Ordering::Relaxed)
    }

    /// Another tree is used from now on.
    pub(crate) fn set_simulated(&self, is_simulated: bool) {
        self.is_simulated.store(is_simulated, Ordering::Relaxed);
    }

    /// The number of the film.
    pub(crate) fn film(&self) -> u64 {
        self.film.load(Ordering::Relaxed).into()
    }

    /// What was seen so far is void.
    pub(crate) fn begin_film(&self) {
        self.read.store(0, Ordering::Relaxed);
        self.film.store(FILMS.fetch_add(1, Ordering::Relaxed), Ordering::Relaxed);
    }

    /// The program reads the sensor at a port.
    pub(crate) fn note_read(&self, port: &str) {
        self.read.fetch_or(bit_of(port), Ordering::Relaxed);
    }

    /// Whether it has done so during the film.
    pub(crate) fn is_read(&self, port: &str) -> bool {
        self.read.load(Ordering::Relaxed) & bit_of(port) != 0
    }

    /// The frame in which the odometry counts; `None` if it is the world's.
    pub(crate) fn frame(&self) -> MutexGuard<'_, Option<Frame>> {
        locked(&self.frame)
    }
}

/// A pose in the odometry's frame, and the same in the world.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub(crate) believed: Pose,
    pub(crate) real: Pose,
}

/// The threads of Prolog that have used devices, by their numbers, as bits.
static USERS: [AtomicU32; 32] = [const { AtomicU32::new(0) }; 32];

thread_local! {
    static USER: RefCell<Option<User>> = const { RefCell::new(None) };
}

/// A thread that has used devices, until it ends.
struct User(usize);

impl User {
    fn set(&self, uses: bool) {
        if let Some(bits) = USERS.get(self.0 / 32) {
            let bit = 1 << (self.0 % 32);
            if uses {
                bits.fetch_or(bit, Ordering::Relaxed);
            } else {
                bits.fetch_and(!bit, Ordering::Relaxed);
            }
        }
    }
}

impl Drop for User {
    fn drop(&mut self) {
        self.set(false);
    }
}

/// This thread of Prolog uses devices.
pub(crate) fn note_user() {
    USER.with_borrow_mut(|user| {
        if user.is_none() && !is_outside() {
            let this = User(usize::try_from(this_thread()).unwrap_or(usize::MAX));
            this.set(true);
            *user = Some(this);
        }
    });
}

/// The numbers of the threads that have used devices.
pub(crate) fn users() -> impl Iterator<Item = usize> {
    let has = |thread: &usize| USERS[thread / 32].load(Ordering::Relaxed) >> (thread % 32) & 1 == 1;
    (0..USERS.len() * 32).filter(has)
}

/// Whether somebody watches.
#[cfg(feature = "sim")]
pub(crate) fn is_watched() -> bool {
    IS_WATCHED.load(Ordering::Relaxed)
}

/// Somebody watches from now on, or nobody.
pub(crate) fn set_watched(is_watched: bool) {
    IS_WATCHED.store(is_watched, Ordering::Relaxed);
}

/// The bit of an input; a port of another name has none.
fn bit_of(port: &str) -> u8 {
    match port.strip_prefix("in").and_then(|number| number.bytes().next()) {
        Some(number @ b'1'..=b'4') => 1 << (number - b'1'),
        _ => 0,
    }
}
