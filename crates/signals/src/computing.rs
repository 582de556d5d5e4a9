//! The dead man's switch: threads that compute, and whose motors run on meanwhile.
//!
//! A thread has a slot from the first motor that it starts. Each use of the robot is a sign of
//! life: one store. The watchdog looks at the time for which the thread has had a processor since,
//! so a busy machine does no harm. A thread that has waited for something has lived, too.
use nix::libc::{self, c_int};
use std::cell::{Cell, RefCell};
use std::fs::File;
use std::io::{Read as _, Write as _};
#[cfg(target_has_atomic = "64")]
use std::sync::atomic::AtomicU64;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::time::Duration;

/// As many threads as start motors at the same time.
const MOST: usize = 64;

/// A slot without a thread, and one that a thread is about to take. The clocks of threads are
/// below 0.
const FREE: c_int = 0;
const TAKEN: c_int = 1;

/// It is not known how often the thread has waited.
const UNKNOWN: u64 = u64::MAX;

/// For a processor without such numbers, as the brick's.
#[cfg(not(target_has_atomic = "64"))]
struct AtomicU64(std::sync::Mutex<u64>);

#[cfg(not(target_has_atomic = "64"))]
impl AtomicU64 {
    const fn new(number: u64) -> Self {
        Self(std::sync::Mutex::new(number))
    }

    fn load(&self, order: Ordering) -> u64 {
        let number = self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let _ = order;
        *number
    }

    fn store(&self, number: u64, order: Ordering) {
        self.swap(number, order);
    }

    fn swap(&self, number: u64, order: Ordering) -> u64 {
        let mut kept = self.0.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let _ = order;
        std::mem::replace(&mut *kept, number)
    }
}

struct Slot {
    /// The clock of the thread's processor time.
    clock: AtomicI32,
    /// The kernel's number of the thread.
    thread: AtomicU64,
    /// What the asker is to know it by.
    name: AtomicU64,
    /// For how many nanoseconds it may compute; 0 is forever.
    limit: AtomicU64,
    lives: AtomicBool,
    // The watchdog's: its processor time at the last sign of life, how often it had waited then,
    // and whether it has not been stopped since.
    since: AtomicU64,
    waits: AtomicU64,
    is_watched: AtomicBool,
}

static SLOTS: [Slot; MOST] = [const {
    Slot {
        clock: AtomicI32::new(FREE),
        thread: AtomicU64::new(0),
        name: AtomicU64::new(0),
        limit: AtomicU64::new(0),
        lives: AtomicBool::new(false),
        since: AtomicU64::new(0),
        waits: AtomicU64::new(UNKNOWN),
        is_watched: AtomicBool::new(false),
    }
}; MOST];

/// The slot of a thread, until it ends.
struct Mine(&'static Slot);

impl Drop for Mine {
    fn drop(&mut self) {
        self.0.clock.store(FREE, Ordering::Release);
    }
}

thread_local! {
    static LIVES: Cell<Option<&'static AtomicBool>> = const { Cell::new(None) };
    static MINE: RefCell<Option<Mine>> = const { RefCell::new(None) };
}

/// This thread uses the robot.
#[inline]
pub fn lives() {
    if let Some(lives) = LIVES.get() {
        lives.store(true, Ordering::Relaxed);
    }
}

/// This thread, which the asker knows by that name, is about to start a motor, and may compute for
/// so long while it runs; zero is forever.
pub fn guard(name: u64, limit: Duration) {
    let guarded = MINE.try_with(|mine| {
        let mut mine = mine.borrow_mut();
        if mine.is_none() {
            *mine = Slot::take().map(Mine);
        }
        if let Some(Mine(slot)) = &*mine {
            slot.name.store(name, Ordering::Relaxed);
            let limit = u64::try_from(limit.as_nanos()).unwrap_or(0);
            slot.limit.store(limit, Ordering::Relaxed);
            LIVES.set(Some(&slot.lives));
        }
    });
    if guarded.is_ok() {
        lives();
    }
}

/// Calls `computes` with the number of each thread that has computed for too long.
pub(crate) fn look(mut computes: impl FnMut(c_int)) {
    for (slot, number) in SLOTS.iter().zip(0..) {
        if slot.computes() {
            computes(number);
        }
    }
}

/// The name of a thread, and for how long it may compute; `None` if it has lived meanwhile.
pub(crate) fn still_computes(number: c_int) -> Option<(u64, Duration)> {
    let slot = SLOTS.get(usize::try_from(number).ok()?)?;
    let is_there = slot.clock.load(Ordering::Acquire) < FREE;
    (is_there && !slot.lives.load(Ordering::Relaxed)).then(|| {
        let limit = Duration::from_nanos(slot.limit.load(Ordering::Relaxed));
        (slot.name.load(Ordering::Relaxed), limit)
    })
}

impl Slot {
    /// A slot for this thread.
    fn take() -> Option<&'static Self> {
        let taken = |slot: &&Self| {
            let clock = &slot.clock;
            clock.compare_exchange(FREE, TAKEN, Ordering::Acquire, Ordering::Relaxed).is_ok()
        };
        let slot = SLOTS.iter().find(taken)?;
        let mut clock = FREE;
        // Safety: asks only.
        let (thread, errno) = unsafe {
            let thread = libc::syscall(libc::SYS_gettid);
            (thread, libc::pthread_getcpuclockid(libc::pthread_self(), &raw mut clock))
        };
        slot.thread.store(u64::try_from(thread).unwrap_or(0), Ordering::Relaxed);
        slot.is_watched.store(false, Ordering::Relaxed);
        slot.clock.store(if errno == 0 { clock } else { FREE }, Ordering::Release);
        (errno == 0).then_some(slot)
    }

    /// Whether its thread has computed for too long. It is said once.
    fn computes(&self) -> bool {
        let clock = self.clock.load(Ordering::Acquire);
        if clock >= FREE {
            return false;
        }
        let lives = self.lives.swap(false, Ordering::Relaxed);
        if !lives && !self.is_watched.load(Ordering::Relaxed) {
            return false;
        }
        let Some(used) = processor_time(clock) else { return false };
        let limit = self.limit.load(Ordering::Relaxed);
        self.is_watched.store(limit != 0, Ordering::Relaxed);
        let waits = if lives || limit == 0 { UNKNOWN } else { self.count_waits() };
        let before = self.waits.swap(waits, Ordering::Relaxed);
        if lives || before != UNKNOWN && before != waits {
            self.since.store(used, Ordering::Relaxed);
            return false;
        }
        let is_late = limit != 0 && used - self.since.load(Ordering::Relaxed) >= limit;
        if is_late {
            self.is_watched.store(false, Ordering::Relaxed);
        }
        is_late
    }

    /// How often the thread has left its processor by itself; 0 if the kernel does not say.
    fn count_waits(&self) -> u64 {
        // The watchdog asks for no memory.
        let mut path = [0; 64];
        let mut rest = &mut path[..];
        let _ = write!(rest, "/proc/self/task/{}/status", self.thread.load(Ordering::Relaxed));
        let length = 64 - rest.len();
        let mut text = [0; 4096];
        let read = std::str::from_utf8(&path[..length]).ok().and_then(|path| {
            let length = File::open(path).ok()?.read(&mut text).ok()?;
            std::str::from_utf8(&text[..length]).ok()
        });
        let count = |line: &str| line.strip_prefix("voluntary_ctxt_switches:")?.trim().parse().ok();
        read.and_then(|text| text.lines().find_map(count)).unwrap_or(0)
    }
}

/// The time of a clock in nanoseconds; `None` if its thread has ended.
fn processor_time(clock: c_int) -> Option<u64> {
    let mut time = libc::timespec { tv_sec: 0, tv_nsec: 0 };
    // Safety: asks only.
    let is_known = unsafe { libc::clock_gettime(clock, &raw mut time) } == 0;
    let [seconds, rest] = [u64::try_from(time.tv_sec), u64::try_from(time.tv_nsec)];
    let time = seconds.ok()? * 1_000_000_000 + rest.ok()?;
    is_known.then_some(time)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::Mutex;
    use std::sync::atomic::AtomicU32;
    use std::thread::{JoinHandle, sleep, spawn};

    static ALONE: Mutex<()> = Mutex::new(());
    const LIMIT: Duration = Duration::from_millis(40);

    fn mine() -> u64 {
        MINE.with_borrow(|mine| {
            let clock = mine.as_ref().unwrap().0.clock.load(Ordering::Relaxed);
            processor_time(clock).unwrap()
        })
    }

    /// Computes for this time of a processor, in nanoseconds.
    fn compute(nanoseconds: u64) {
        let end = mine() + nanoseconds;
        while mine() < end {}
    }

    /// Looks until the thread has ended; how often it was said to compute.
    fn looks(thread: &JoinHandle<()>) -> u32 {
        let count = AtomicU32::new(0);
        while !thread.is_finished() {
            look(|number| {
                assert!(still_computes(number).is_none_or(|named| named == (7, LIMIT)));
                count.fetch_add(1, Ordering::Relaxed);
            });
        }
        count.into_inner()
    }

    fn said(body: impl FnOnce() + Send + 'static) -> u32 {
        let _alone = ALONE.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let thread = spawn(|| {
            guard(7, LIMIT);
            body();
        });
        let said = looks(&thread);
        thread.join().unwrap();
        assert!(SLOTS.iter().all(|slot| slot.clock.load(Ordering::Relaxed) == FREE));
        said
    }

    #[test]
    fn one_that_computes_is_found_once_until_it_lives_again() {
        let twice = || {
            compute(100_000_000);
            lives();
            compute(100_000_000);
        };
        assert_eq!(said(twice), 2);
    }

    #[test]
    fn one_that_lives_or_waits_is_not() {
        let lives_on = || (0..40).for_each(|_| (compute(10_000_000), lives()).1);
        assert_eq!(said(lives_on), 0);
        let waits = || {
            for _ in 0..40 {
                compute(10_000_000);
                sleep(Duration::from_millis(1));
            }
        };
        assert_eq!(said(waits), 0);
        assert_eq!(said(|| (guard(7, Duration::ZERO), compute(200_000_000)).1), 0);
    }
}
