//! What the kernel says of this process's threads: which run, and which are asleep.
//!
//! A thread that can run is not asleep, also while other programs have the processors. Nothing
//! here depends on how much wall time passes.

use crate::lock::locked;
use std::cell::{Cell, RefCell};
use std::fs::{self, File};
use std::io::Read;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

/// The kernel's number of a thread.
pub(super) type Id = u32;

/// One directory a thread.
const TASKS: &str = "/proc/self/task";

/// The names of this crate's own threads, which use no simulation, begin so.
const OURS: &str = "ev3-";

/// The number of this thread. Where the kernel does not tell, it is one that no other thread has.
pub(super) fn me() -> Id {
    static STRANGERS: AtomicU32 = AtomicU32::new(1 << 31);
    thread_local! {
        static ME: Cell<Id> = const { Cell::new(0) };
    }
    if ME.get() == 0 {
        let link = fs::read_link("/proc/thread-self").ok();
        let number = link.and_then(|link| link.file_name()?.to_str()?.parse().ok());
        ME.set(number.unwrap_or_else(|| STRANGERS.fetch_add(1, Ordering::Relaxed)));
    }
    ME.get()
}

/// Threads that are no part of the program.
static OUTSIDE: Mutex<Vec<Id>> = Mutex::new(Vec::new());

/// A thread that is no part of the program, until it ends.
struct Outsider(Id);

impl Drop for Outsider {
    fn drop(&mut self) {
        locked(&OUTSIDE).retain(|other| *other != self.0);
    }
}

thread_local! {
    static OUTSIDER: RefCell<Option<Outsider>> = const { RefCell::new(None) };
}

/// Makes this thread no part of the program, or a part again.
pub(super) fn stay_outside(is_outside: bool) {
    OUTSIDER.with_borrow_mut(|outsider| {
        if !is_outside {
            *outsider = None;
        } else if outsider.is_none() {
            locked(&OUTSIDE).push(me());
            *outsider = Some(Outsider(me()));
        }
    });
}

/// The threads of this process when they last rested.
#[derive(Debug, Default)]
pub(super) struct Threads {
    /// In the order of their creation, as the kernel lists them.
    seen: Vec<Seen>,
}

/// What was seen of a thread: its number, and how often it had left its processor, unless it was
/// not looked at.
type Seen = (Id, Option<u64>);

impl Threads {
    /// Whether there was a moment at which all threads but this one were asleep. Those that stand
    /// in line may have been awake since.
    ///
    /// Two looks tell: a thread that was asleep in both, and has left its processor equally often,
    /// did not run in between. A thread that is awake in line may hold a lock that a sleeper
    /// waits for, so these have to be asleep between the looks. One look tells that nobody has run
    /// since the last time, but those in line.
    pub(super) fn rest(&mut self, stands: impl Fn(Id) -> bool) -> bool {
        let elsewhere = |id| !stands(id);
        let Some(seen) = look(elsewhere) else {
            return false;
        };
        let is_as_before = seen.iter().all(|one| one.1.is_none() || self.seen.contains(one));
        let rest = is_as_before
            || look(&stands).is_some() && look(elsewhere).is_some_and(|again| again == seen);
        if rest {
            self.seen = seen;
        }
        rest
    }

    /// The place of a thread in the order of creation.
    pub(super) fn age(&self, thread: Id) -> Option<usize> {
        self.seen.iter().position(|(other, _)| *other == thread)
    }
}

/// The threads; `None` if one of those that are looked at is awake. This one is not looked at.
fn look(is_looked_at: impl Fn(Id) -> bool) -> Option<Vec<Seen>> {
    let mut seen = Vec::new();
    let outside = locked(&OUTSIDE).clone();
    for task in fs::read_dir(TASKS).into_iter().flatten().flatten() {
        let Some(id) = task.file_name().to_str().and_then(|name| name.parse().ok()) else {
            continue;
        };
        if outside.contains(&id) {
            continue;
        }
        let is_looked_at = id != me() && is_looked_at(id);
        seen.push((id, if is_looked_at { Some(switches(id)?) } else { None }));
    }
    Some(seen)
}

/// How often a thread has left its processor; `None` if it is awake. One that has ended is asleep
/// for ever, and our own threads count as asleep.
fn switches(thread: Id) -> Option<u64> {
    let mut buffer = [0; 4096];
    let file = File::open(format!("{TASKS}/{thread}/status"));
    let Ok(length) = file.and_then(|mut file| file.read(&mut buffer)) else {
        return Some(u64::MAX);
    };
    let text = String::from_utf8_lossy(&buffer[..length]);
    let value = |name| text.lines().find_map(|line| line.strip_prefix(name)).map(str::trim);
    let count = |name| value(name)?.parse::<u64>().ok();
    if value("Name:")?.starts_with(OURS) {
        return Some(u64::MAX);
    }
    match value("State:")?.as_bytes().first()? {
        // One that is about to fall asleep is said to be asleep, and may lose its processor just
        // then, before that sleep counts.
        b'S' => Some(count("voluntary_ctxt_switches:")? + count("nonvoluntary_ctxt_switches:")?),
        b'X' | b'Z' => Some(u64::MAX),
        // It can run, waits for a disk or its memory, or was halted by a debugger.
        _ => None,
    }
}
