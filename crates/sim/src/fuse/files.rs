//! The kernel's questions, one by one.

use std::ffi::OsStr;
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

use fuser::{
    FileAttr, FileHandle, FileType, Filesystem, FopenFlags, Generation, INodeNo, LockOwner,
    OpenAccMode, OpenFlags, PollEvents, PollFlags, PollNotifier, RenameFlags, ReplyAttr,
    ReplyCreate, ReplyData, ReplyDirectory, ReplyEmpty, ReplyEntry, ReplyOpen, ReplyPoll,
    ReplyWrite, Request, TimeOrNow, WriteFlags,
};

use super::{Open, locked};
use crate::attr::Access;
use crate::descriptor::Descriptor;
use crate::errno::Errno;
use crate::machine::Machine;
use crate::shared::Shared;
use crate::tree::{FileKind, NodeId, Stat};

/// Nothing may be remembered by the kernel: devices come and go.
const NO_CACHE: Duration = Duration::ZERO;

/// The file system that the kernel talks to.
#[derive(Debug)]
pub(super) struct Files {
    pub(super) shared: Arc<Shared>,
    pub(super) open: Arc<Mutex<Open>>,
}

pub(super) fn fuse_errno(errno: Errno) -> fuser::Errno {
    fuser::Errno::from_i32(errno.0)
}

pub(super) fn file_type(kind: FileKind) -> FileType {
    match kind {
        FileKind::Directory => FileType::Directory,
        FileKind::File => FileType::RegularFile,
    }
}

/// Whoever asks is shown as the owner: on the brick the group `ev3dev` does that.
pub(super) fn attributes(stat: Stat, machine: &Machine, request: &Request) -> FileAttr {
    let time: SystemTime = UNIX_EPOCH + machine.now();
    FileAttr {
        ino: INodeNo(stat.node.0),
        size: stat.size.into(),
        blocks: 0,
        atime: time,
        mtime: time,
        ctime: time,
        crtime: UNIX_EPOCH,
        kind: file_type(stat.kind),
        perm: stat.mode,
        nlink: if stat.kind == FileKind::Directory { 2 } else { 1 },
        uid: request.uid(),
        gid: request.gid(),
        rdev: 0,
        blksize: 4096,
        flags: 0,
    }
}

impl Files {
    fn stat(&self, node: NodeId, request: &Request) -> Result<FileAttr, Errno> {
        let machine = self.shared.lock();
        machine.stat(node).map(|stat| attributes(stat, &machine, request))
    }

    fn find(&self, parent: NodeId, name: &OsStr, request: &Request) -> Result<FileAttr, Errno> {
        let node = self.shared.lock().lookup(parent, name.to_str().ok_or(Errno::ENOENT)?)?;
        self.stat(node, request)
    }

    fn open_file(&self, node: NodeId, flags: OpenFlags) -> Result<u64, Errno> {
        let access = match flags.acc_mode() {
            OpenAccMode::O_RDONLY => Access::ReadOnly,
            OpenAccMode::O_WRONLY => Access::WriteOnly,
            OpenAccMode::O_RDWR => Access::ReadWrite,
        };
        self.shared.lock().open_node(node, access)?;
        let mut open = locked(&self.open);
        open.next += 1;
        let handle = open.next;
        open.files.insert(handle, Descriptor::new(node));
        Ok(handle)
    }

    fn read_file(&self, handle: u64, offset: u64, size: u32) -> Result<Vec<u8>, Errno> {
        let mut machine = self.shared.lock();
        let mut open = locked(&self.open);
        let file = open.files.get_mut(&handle).ok_or(Errno::ENODEV)?;
        let mut buffer = vec![0; usize::try_from(size).unwrap_or(0).min(4096)];
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        let length = file.pread(&mut machine, offset, &mut buffer)?;
        buffer.truncate(length);
        Ok(buffer)
    }

    fn write_file(&self, node: NodeId, data: &[u8], reply: ReplyWrite) {
        let mut machine = self.shared.lock();
        let length = u32::try_from(data.len()).unwrap_or(u32::MAX);
        match machine.write(node, data) {
            Ok(written) if written.blocks.is_zero() => reply.written(length),
            Ok(written) => {
                let due = machine.now() + written.blocks;
                locked(&self.open).writes.push((due, length, reply));
            }
            Err(errno) => reply.error(fuse_errno(errno)),
        }
        drop(machine);
        self.shared.wake();
    }
}

impl Filesystem for Files {
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
        _flags: Option<fuser::BsdFileFlags>,
        reply: ReplyAttr,
    ) {
        if mode.is_some() || uid.is_some() || gid.is_some() {
            reply.error(fuse_errno(Errno::EPERM));
        } else {
            self.getattr(request, ino, fh, reply);
        }
    }

    // What sysfs does not have: its tree is the drivers'. A new file is EACCES, the rest EPERM.

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
        reply.error(fuse_errno(Errno::EPERM));
    }

    fn unlink(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(Errno::EPERM));
    }

    fn rmdir(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(Errno::EPERM));
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
        reply.error(fuse_errno(Errno::EPERM));
    }

    fn open(&self, _: &Request, ino: INodeNo, flags: OpenFlags, reply: ReplyOpen) {
        match self.open_file(NodeId(ino.0), flags) {
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
        _flags: OpenFlags,
        _lock_owner: Option<LockOwner>,
        reply: ReplyData,
    ) {
        match self.read_file(fh.0, offset, size) {
            Ok(bytes) => reply.data(&bytes),
            Err(errno) => reply.error(fuse_errno(errno)),
        }
    }

    fn write(
        &self,
        _: &Request,
        ino: INodeNo,
        _fh: FileHandle,
        _offset: u64,
        data: &[u8],
        _write_flags: WriteFlags,
        _flags: OpenFlags,
        _lock_owner: Option<LockOwner>,
        reply: ReplyWrite,
    ) {
        self.write_file(NodeId(ino.0), data, reply);
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
        let entries = match self.shared.lock().read_dir(NodeId(ino.0)) {
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
        let ready = open.files.get(&fh.0).is_none_or(|file| file.poll(&machine));
        let mut events = PollEvents::POLLIN | PollEvents::POLLOUT;
        if ready {
            events |= PollEvents::POLLPRI | PollEvents::POLLERR;
        } else if flags.contains(PollFlags::FUSE_POLL_SCHEDULE_NOTIFY) {
            open.polls.insert(fh.0, notifier.handle());
        }
        reply.poll(events);
    }
}
