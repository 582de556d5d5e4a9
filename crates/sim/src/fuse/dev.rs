//! The devices, asked by the kernel.
//!
//! A reader of events that has to wait is answered when there is one. A process that waits for an
//! answer cannot even be killed, so it is sent back every now and then as if by a signal (EINTR);
//! programs and libraries then ask again.

use std::collections::HashMap;
use std::ffi::OsStr;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant, SystemTime};

use fuser::{
    BsdFileFlags, FileAttr, FileHandle, FileType, Filesystem, FopenFlags, Generation, INodeNo,
    IoctlFlags, LockOwner, Notifier, OpenFlags, PollEvents, PollFlags, PollHandle, PollNotifier,
    RenameFlags, ReplyAttr, ReplyCreate, ReplyData, ReplyDirectory, ReplyEmpty, ReplyEntry,
    ReplyIoctl, ReplyOpen, ReplyPoll, ReplyWrite, Request, TimeOrNow, WriteFlags,
};

use super::LOOK;
use super::files::{attributes, file_type, fuse_errno};
use crate::dev::DevDescriptor;
use crate::errno::Errno;
use crate::machine::Machine;
use crate::shared::Shared;
use crate::tree::NodeId;

/// Sizes and modes do not change.
const NO_CACHE: Duration = Duration::ZERO;

/// How long a reader waits, in wall time, before it is sent back.
const PATIENCE: Duration = Duration::from_millis(100);

/// From asm-generic/fcntl.h, which ARM and x86 use.
const O_NONBLOCK: i32 = 0o4000;

/// The file system that the kernel talks to.
#[derive(Debug)]
pub(super) struct DevFiles {
    pub(super) shared: Arc<Shared>,
    pub(super) open: Arc<Mutex<DevOpen>>,
}

/// The open devices of a mount.
#[derive(Debug, Default)]
pub(super) struct DevOpen {
    next: u64,
    files: HashMap<u64, DevDescriptor>,
    /// Who waits in poll(2), by file handle.
    polls: HashMap<u64, PollHandle>,
    /// Who waits in read(2).
    reads: Vec<BlockedRead>,
}

#[derive(Debug)]
struct BlockedRead {
    handle: u64,
    size: u32,
    until: Instant,
    reply: ReplyData,
}

impl DevOpen {
    fn is_ready(&self, handle: u64, machine: &Machine) -> bool {
        self.files.get(&handle).is_none_or(|file| file.is_ready(machine))
    }

    fn read(
        &mut self,
        machine: &Machine,
        handle: u64,
        offset: u64,
        size: u32,
    ) -> Result<Vec<u8>, Errno> {
        let file = self.files.get_mut(&handle).ok_or(Errno::ENODEV)?;
        let mut buffer = vec![0; usize::try_from(size).unwrap_or(0)];
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let length = file.read(machine, offset, &mut buffer)?;
        buffer.truncate(length);
        Ok(buffer)
    }

    /// Answers who waits in read(2) no longer.
    fn answer_reads(&mut self, machine: &Machine) {
        let now = Instant::now();
        for read in std::mem::take(&mut self.reads) {
            let ready = self.is_ready(read.handle, machine);
            if !ready && now < read.until {
                self.reads.push(read);
                continue;
            }
            match self.read(machine, read.handle, 0, read.size) {
                Ok(bytes) => read.reply.data(&bytes),
                Err(Errno::EAGAIN) => read.reply.error(fuse_errno(Errno::EINTR)),
                Err(errno) => read.reply.error(fuse_errno(errno)),
            }
        }
    }

    fn take_ready(&mut self, machine: &Machine) -> Vec<PollHandle> {
        let handles: Vec<u64> = self.polls.keys().copied().collect();
        let ready = handles.into_iter().filter(|handle| self.is_ready(*handle, machine));
        let ready: Vec<u64> = ready.collect();
        ready.iter().filter_map(|handle| self.polls.remove(handle)).collect()
    }
}

fn locked(open: &Mutex<DevOpen>) -> MutexGuard<'_, DevOpen> {
    open.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Answers those who wait, whenever time has passed.
pub(super) fn watch(
    shared: &Shared,
    open: &Mutex<DevOpen>,
    notifier: &Notifier,
    stop: &AtomicBool,
) {
    let mut machine = shared.lock();
    while !stop.load(Ordering::SeqCst) {
        let polls = {
            let mut open = locked(open);
            open.answer_reads(&machine);
            open.take_ready(&machine)
        };
        if polls.is_empty() {
            machine = shared.wait(machine, LOOK);
            continue;
        }
        // The kernel may ask again at once, so it is told without the lock.
        drop(machine);
        for handle in polls {
            // A program that has gone away need not be told.
            let _ = notifier.poll(handle);
        }
        machine = shared.lock();
    }
    drop(machine);
    for read in std::mem::take(&mut locked(open).reads) {
        read.reply.error(fuse_errno(Errno::ENODEV));
    }
}

impl DevFiles {
    fn stat(&self, node: NodeId, request: &Request) -> Result<FileAttr, Errno> {
        let machine = self.shared.lock();
        machine.dev_stat(node).map(|stat| attributes(stat, &machine, request))
    }

    fn find(&self, parent: NodeId, name: &OsStr, request: &Request) -> Result<FileAttr, Errno> {
        let name = name.to_str().ok_or(Errno::ENOENT)?;
        let node = self.shared.lock().dev_lookup(parent, name)?;
        self.stat(node, request)
    }

    fn open_file(&self, node: NodeId) -> Result<u64, Errno> {
        let file = DevDescriptor::open_node(&self.shared.lock(), node)?;
        let mut open = locked(&self.open);
        open.next += 1;
        let handle = open.next;
        open.files.insert(handle, file);
        Ok(handle)
    }
}

impl Filesystem for DevFiles {
    fn lookup(&self, request: &Request, parent: INodeNo, name: &OsStr, reply: ReplyEntry) {
        match self.find(NodeId(parent.0), name, request) {
            Ok(attr) => reply.entry(&NO_CACHE, &attr, Generation(0)),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn getattr(&self, request: &Request, ino: INodeNo, _: Option<FileHandle>, reply: ReplyAttr) {
        match self.stat(NodeId(ino.0), request) {
            Ok(attr) => reply.attr(&NO_CACHE, &attr),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    /// Truncation and new times are taken and do nothing; modes and owners are udev's business.
    fn setattr(
        &self,
        request: &Request,
        ino: INodeNo,
        mode: Option<u32>,
        uid: Option<u32>,
        gid: Option<u32>,
        _size: Option<u64>,
        _atime: Option<TimeOrNow>,
        _mtime: Option<TimeOrNow>,
        _ctime: Option<SystemTime>,
        fh: Option<FileHandle>,
        _crtime: Option<SystemTime>,
        _chgtime: Option<SystemTime>,
        _bkuptime: Option<SystemTime>,
        _flags: Option<BsdFileFlags>,
        reply: ReplyAttr,
    ) {
        if mode.is_some() || uid.is_some() || gid.is_some() {
            reply.error(fuse_errno(Errno::EPERM));
        } else {
            self.getattr(request, ino, fh, reply);
        }
    }

    // Nobody but root makes or removes devices.

    fn create(
        &self,
        _: &Request,
        _parent: INodeNo,
        _name: &OsStr,
        _mode: u32,
        _umask: u32,
        _flags: i32,
        reply: ReplyCreate,
    ) {
        reply.error(fuse_errno(Errno::EACCES));
    }

    fn mkdir(
        &self,
        _: &Request,
        _parent: INodeNo,
        _name: &OsStr,
        _mode: u32,
        _umask: u32,
        reply: ReplyEntry,
    ) {
        reply.error(fuse_errno(Errno::EACCES));
    }

    fn unlink(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(Errno::EACCES));
    }

    fn rmdir(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(Errno::EACCES));
    }

    fn rename(
        &self,
        _: &Request,
        _parent: INodeNo,
        _name: &OsStr,
        _newparent: INodeNo,
        _newname: &OsStr,
        _flags: RenameFlags,
        reply: ReplyEmpty,
    ) {
        reply.error(fuse_errno(Errno::EACCES));
    }

    fn open(&self, _: &Request, ino: INodeNo, _flags: OpenFlags, reply: ReplyOpen) {
        match self.open_file(NodeId(ino.0)) {
            Ok(handle) => reply.opened(FileHandle(handle), FopenFlags::FOPEN_DIRECT_IO),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn read(
        &self,
        _: &Request,
        _ino: INodeNo,
        fh: FileHandle,
        offset: u64,
        size: u32,
        flags: OpenFlags,
        _lock_owner: Option<LockOwner>,
        reply: ReplyData,
    ) {
        let machine = self.shared.lock();
        let mut open = locked(&self.open);
        match open.read(&machine, fh.0, offset, size) {
            Ok(bytes) => reply.data(&bytes),
            Err(Errno::EAGAIN) if flags.0 & O_NONBLOCK == 0 => {
                let until = Instant::now() + PATIENCE;
                open.reads.push(BlockedRead { handle: fh.0, size, until, reply });
            }
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn write(
        &self,
        _: &Request,
        _ino: INodeNo,
        fh: FileHandle,
        offset: u64,
        data: &[u8],
        _write_flags: WriteFlags,
        _flags: OpenFlags,
        _lock_owner: Option<LockOwner>,
        reply: ReplyWrite,
    ) {
        let mut machine = self.shared.lock();
        let open = locked(&self.open);
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let file = open.files.get(&fh.0).ok_or(Errno::ENODEV);
        match file.and_then(|file| file.write(&mut machine, offset, data)) {
            Ok(length) => reply.written(u32::try_from(length).unwrap_or(u32::MAX)),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn ioctl(
        &self,
        _: &Request,
        _ino: INodeNo,
        fh: FileHandle,
        _flags: IoctlFlags,
        command: u32,
        _in_data: &[u8],
        _out_size: u32,
        reply: ReplyIoctl,
    ) {
        let machine = self.shared.lock();
        let open = locked(&self.open);
        let file = open.files.get(&fh.0).ok_or(Errno::ENODEV);
        match file.and_then(|file| file.ioctl(&machine, command)) {
            Ok((result, bytes)) => reply.ioctl(result, &bytes),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn flush(&self, _: &Request, _: INodeNo, _: FileHandle, _: LockOwner, reply: ReplyEmpty) {
        reply.ok();
    }

    fn release(
        &self,
        _: &Request,
        _ino: INodeNo,
        fh: FileHandle,
        _flags: OpenFlags,
        _lock_owner: Option<LockOwner>,
        _flush: bool,
        reply: ReplyEmpty,
    ) {
        let mut open = locked(&self.open);
        open.files.remove(&fh.0);
        open.polls.remove(&fh.0);
        reply.ok();
    }

    fn readdir(
        &self,
        _: &Request,
        ino: INodeNo,
        _fh: FileHandle,
        offset: u64,
        mut reply: ReplyDirectory,
    ) {
        let entries = match self.shared.lock().dev_read_dir(NodeId(ino.0)) {
            Ok(entries) => entries,
            Err(errno) => return reply.error(fuse_errno(errno)),
        };
        let dots = [".", ".."].map(|name| (ino, FileType::Directory, name.to_owned()));
        let entries = entries
            .into_iter()
            .map(|entry| (INodeNo(entry.node.0), file_type(entry.kind), entry.name));
        for (next, (ino, kind, name)) in (1..).zip(dots.into_iter().chain(entries)) {
            if next > offset && reply.add(ino, next, kind, name) {
                break;
            }
        }
        reply.ok();
    }

    fn poll(
        &self,
        _: &Request,
        _ino: INodeNo,
        fh: FileHandle,
        notifier: PollNotifier,
        _events: PollEvents,
        flags: PollFlags,
        reply: ReplyPoll,
    ) {
        let machine = self.shared.lock();
        let mut open = locked(&self.open);
        let mut events = PollEvents::POLLOUT;
        if open.is_ready(fh.0, &machine) {
            events |= PollEvents::POLLIN;
        } else if flags.contains(PollFlags::FUSE_POLL_SCHEDULE_NOTIFY) {
            open.polls.insert(fh.0, notifier.handle());
        }
        reply.poll(events);
    }
}
