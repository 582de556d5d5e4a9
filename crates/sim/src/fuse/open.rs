//! The open files of a mount, and the programs that wait for them.
//!
//! A process that waits for an answer cannot even be killed. So a reader is sent back every now and
//! then as if by a signal (EINTR); programs and libraries then ask again. A writer is answered after
//! some time even if on the machine's clock, which may stand still, it is not yet.
use super::served::Served;
use crate::machine::Machine;
use crate::shared::Shared;
use ev3_os::linux::Errno;
use ev3_os::locked;
use fuser::{Notifier, PollHandle, ReplyData, ReplyWrite};
use std::collections::HashMap;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// [`watch`] samples this often, in wall time, even if nothing wakes it.
const LOOK: Duration = Duration::from_millis(100);

/// How long a reader waits, in wall time, before it is sent back.
const PATIENCE: Duration = Duration::from_millis(100);

/// The same for a writer. Drivers take less: a second for the mode of a port.
const WRITERS_PATIENCE: Duration = Duration::from_secs(2);

/// The open files of a mount.
#[derive(Debug)]
pub(super) struct Open<F> {
    next: u64,
    files: HashMap<u64, F>,
    /// The programs that wait in poll(2), by file handle.
    polls: HashMap<u64, PollHandle>,
    blocked: Vec<Blocked>,
}

/// A call that is answered later.
#[derive(Debug)]
enum Blocked {
    /// Until there is something to read, or this wall time.
    Read { handle: u64, size: u32, until: Instant, reply: ReplyData },
    /// Until this virtual time, or that wall time.
    Write { until: Duration, latest: Instant, outcome: Result<usize, Errno>, reply: ReplyWrite },
}

impl<F> Default for Open<F> {
    fn default() -> Open<F> {
        let (files, polls) = (HashMap::new(), HashMap::new());
        Open { next: 0, files, polls, blocked: Vec::new() }
    }
}

impl<F: Served> Open<F> {
    /// Takes an open file in; its handle.
    pub(super) fn insert(&mut self, file: F) -> u64 {
        self.next += 1;
        self.files.insert(self.next, file);
        self.next
    }

    pub(super) fn remove(&mut self, handle: u64) {
        self.files.remove(&handle);
        self.polls.remove(&handle);
    }

    pub(super) fn file(&mut self, handle: u64) -> Result<&mut F, Errno> {
        self.files.get_mut(&handle).ok_or(Errno::ENODEV)
    }

    pub(super) fn is_ready(&self, handle: u64, machine: &Machine) -> bool {
        self.files.get(&handle).is_none_or(|file| file.is_ready(machine))
    }

    pub(super) fn read(
        &mut self,
        machine: &mut Machine,
        handle: u64,
        offset: u64,
        size: u32,
    ) -> Result<Vec<u8>, Errno> {
        let file = self.file(handle)?;
        let mut buffer = vec![0; usize::try_from(size).unwrap_or(0)];
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let length = file.read(machine, offset, &mut buffer)?;
        buffer.truncate(length);
        Ok(buffer)
    }

    /// Answers a read from the start as soon as there is something.
    pub(super) fn read_later(&mut self, handle: u64, size: u32, reply: ReplyData) {
        let until = Instant::now() + PATIENCE;
        self.blocked.push(Blocked::Read { handle, size, until, reply });
    }

    /// Answers a write at a virtual time.
    pub(super) fn written_at(
        &mut self,
        until: Duration,
        outcome: Result<usize, Errno>,
        reply: ReplyWrite,
    ) {
        let latest = Instant::now() + WRITERS_PATIENCE;
        self.blocked.push(Blocked::Write { until, latest, outcome, reply });
    }

    /// Reports by its handle when there is something to read.
    pub(super) fn poll_later(&mut self, handle: u64, poll: PollHandle) {
        self.polls.insert(handle, poll);
    }

    /// Answers the calls that need to wait no longer.
    fn answer(&mut self, machine: &mut Machine) {
        let now = Instant::now();
        for call in std::mem::take(&mut self.blocked) {
            match call {
                Blocked::Read { handle, size, until, reply }
                    if self.is_ready(handle, machine) || until <= now =>
                {
                    match self.read(machine, handle, 0, size) {
                        Ok(bytes) => reply.data(&bytes),
                        Err(Errno::EAGAIN) => reply.error(fuse_errno(Errno::EINTR)),
                        Err(errno) => reply.error(fuse_errno(errno)),
                    }
                }
                Blocked::Write { until, latest, outcome, reply }
                    if until <= machine.now() || latest <= now =>
                {
                    written(outcome, reply);
                }
                waiting => self.blocked.push(waiting),
            }
        }
    }

    /// Answers all calls, as there is nobody to do so later.
    fn answer_all(&mut self) {
        for call in std::mem::take(&mut self.blocked) {
            match call {
                Blocked::Read { reply, .. } => reply.error(fuse_errno(Errno::ENODEV)),
                Blocked::Write { outcome, reply, .. } => written(outcome, reply),
            }
        }
    }

    /// Takes out who needs to wait in poll(2) no longer.
    fn take_ready(&mut self, machine: &Machine) -> Vec<PollHandle> {
        let handles: Vec<u64> = self.polls.keys().copied().collect();
        let ready = handles.into_iter().filter(|handle| self.is_ready(*handle, machine));
        let ready: Vec<u64> = ready.collect();
        ready.iter().filter_map(|handle| self.polls.remove(handle)).collect()
    }
}

pub(super) fn fuse_errno(errno: Errno) -> fuser::Errno {
    fuser::Errno::from_i32(errno.0)
}

/// Answers a write.
pub(super) fn written(outcome: Result<usize, Errno>, reply: ReplyWrite) {
    match outcome {
        Ok(length) => reply.written(u32::try_from(length).unwrap_or(u32::MAX)),
        Err(errno) => reply.error(fuse_errno(errno)),
    }
}

/// Answers waiting calls whenever time has passed.
pub(super) fn watch<F: Served>(
    shared: &Shared,
    open: &Mutex<Open<F>>,
    notifier: &Notifier,
    stop: &AtomicBool,
) {
    let mut machine = shared.lock();
    while !stop.load(Ordering::SeqCst) {
        let polls = {
            let mut open = locked(open);
            open.answer(&mut machine);
            open.take_ready(&machine)
        };
        if polls.is_empty() {
            machine = shared.wait(machine, LOOK);
            continue;
        }
        // The kernel may ask again at once, so the report is made without the lock.
        drop(machine);
        for handle in polls {
            // The program may have ended: ignore the error.
            let _ = notifier.poll(handle);
        }
        machine = shared.lock();
    }
    drop(machine);
    locked(open).answer_all();
}
