//! The kernel's report on this process's threads: which run, and which are asleep.
//!
//! A thread that can run is not asleep, also while other programs have the processors. Nothing
//! here depends on how much wall time passes.
use ev3_os::locked;
use ev3_os::process_id;
use ev3_os::processes::state_and_switches;
use std::cell::{Cell, RefCell};
use std::fs::{self, File};
use std::io;
#[cfg(unix)]
use std::os::unix::fs::{FileExt, MetadataExt};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, Ordering};

/// The kernel's number of a thread.
pub(super) type Id = u32;

/// One directory a thread.
const TASKS: &str = "/proc/self/task";

/// The names of this crate's own threads, which use no simulation, begin so.
const OURS: &str = "ev3-";

/// The number of this thread. If the kernel does not say, it is one that no other thread has.
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

/// A thread that is not a part of the program, until it ends.
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

/// The threads of this process, and how they were when they last rested.
#[derive(Debug, Default)]
pub(super) struct Threads {
    /// In the order of their creation, as the kernel lists them.
    seen: Vec<Seen>,
    tasks: Tasks,
}

/// What was seen of a thread: its number, and how often it had left its processor, unless it was
/// not looked at.
type Seen = (Id, Option<u64>);

/// The kernel's files about the threads. They stay open, as a look is taken at each hand-over.
#[derive(Debug, Default)]
struct Tasks {
    process: u32,
    directory: Option<File>,
    /// A directory has two more links than threads in it.
    links: u64,
    files: Vec<(Id, Option<File>)>,
}

impl Threads {
    /// Whether there was a moment at which all threads but this one were asleep. Those that stand
    /// in line may have been awake since.
    ///
    /// Two looks are enough: a thread that was asleep in both, and has left its processor equally
    /// often, did not run in between. A thread that is awake in line may hold a lock that a sleeper
    /// waits for, so these have to be asleep between the looks. One look shows that nobody has run
    /// since the last time, but those in line.
    pub(super) fn rest(&mut self, stands: impl Fn(Id) -> bool) -> bool {
        let elsewhere = |id| !stands(id);
        let Some(seen) = self.tasks.look(elsewhere) else {
            return false;
        };
        let is_as_before = seen.iter().all(|one| one.1.is_none() || self.seen.contains(one));
        let rest = is_as_before
            || self.tasks.look(&stands).is_some()
                && self.tasks.look(elsewhere).is_some_and(|again| again == seen);
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

impl Tasks {
    /// The threads; `None` if one of those that are looked at is awake. This one is not looked at.
    fn look(&mut self, is_looked_at: impl Fn(Id) -> bool) -> Option<Vec<Seen>> {
        let outside = locked(&OUTSIDE).clone();
        'again: loop {
            self.list();
            let mut seen = Vec::with_capacity(self.files.len());
            for (id, file) in self.files.iter().filter(|(id, _)| !outside.contains(id)) {
                let is_looked_at = *id != me() && is_looked_at(*id);
                let Some(file) = file.as_ref().filter(|_| is_looked_at) else {
                    seen.push((*id, is_looked_at.then_some(u64::MAX)));
                    continue;
                };
                let Ok(switches) = switches(file) else {
                    // It has ended, maybe in the place of a new one.
                    self.links = 0;
                    continue 'again;
                };
                seen.push((*id, Some(switches?)));
            }
            return Some(seen);
        }
    }

    /// Lists the threads again, if there are more or less of them.
    fn list(&mut self) {
        if self.process != process_id() {
            let directory = File::open(TASKS).ok();
            *self = Tasks { process: process_id(), directory, ..Tasks::default() };
        }
        let links = self.directory.as_ref().map_or(0, links);
        if links != 0 && links == self.links {
            return;
        }
        self.links = links;
        self.files.clear();
        for task in fs::read_dir(TASKS).into_iter().flatten().flatten() {
            let id = task.file_name().to_str().and_then(|name| name.parse().ok());
            if let Some(id) = id {
                // Our own threads count as asleep forever.
                let name = fs::read_to_string(task.path().join("comm")).unwrap_or_default();
                let is_ours = name.starts_with(OURS);
                let file = File::open(task.path().join("status")).ok().filter(|_| !is_ours);
                self.files.push((id, file));
            }
        }
    }
}

/// How often a thread has left its processor; `None` if it is awake.
fn switches(status: &File) -> io::Result<Option<u64>> {
    let mut buffer = [0; 4096];
    let length = read(status, &mut buffer)?;
    let text = std::str::from_utf8(&buffer[..length]).unwrap_or_default();
    let (state, switches) = state_and_switches(text);
    Ok(match state {
        // One that is about to fall asleep is said to be asleep, and may lose its processor just
        // then, before that sleep counts.
        b'S' => Some(switches),
        b'X' | b'Z' => Some(u64::MAX),
        // It can run, waits for a disk or its memory, or was halted by a debugger.
        _ => None,
    })
}

#[cfg(unix)]
fn links(directory: &File) -> u64 {
    directory.metadata().map_or(0, |metadata| metadata.nlink())
}

#[cfg(unix)]
fn read(file: &File, buffer: &mut [u8]) -> io::Result<usize> {
    file.read_at(buffer, 0)
}

/// In a browser there are no threads.
#[cfg(not(unix))]
fn links(_directory: &File) -> u64 {
    0
}

#[cfg(not(unix))]
fn read(_file: &File, _buffer: &mut [u8]) -> io::Result<usize> {
    Ok(0)
}
