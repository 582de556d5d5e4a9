//! The kernel's questions, one by one.
use super::open::{Open, fuse_errno, written};
use super::served::Served;
use crate::files::attr::Access;
use crate::machine::tree::{FileKind, NodeId, Stat};
use crate::machine::{Machine, Written};
use crate::shared::Shared;
use ev3_os::linux::Errno;
use ev3_os::locked;
use fuser::{
    BsdFileFlags, FileAttr, FileHandle, FileType, Filesystem, FopenFlags, Generation, INodeNo,
    IoctlFlags, LockOwner, OpenAccMode, OpenFlags, PollEvents, PollFlags, PollNotifier,
    RenameFlags, ReplyAttr, ReplyCreate, ReplyData, ReplyDirectory, ReplyEmpty, ReplyEntry,
    ReplyIoctl, ReplyOpen, ReplyPoll, ReplyWrite, Request, TimeOrNow, WriteFlags,
};
use std::ffi::OsStr;
use std::sync::{Arc, Mutex};
use std::time::{Duration, SystemTime, UNIX_EPOCH};

/// Nothing may be remembered by the kernel: devices come and go.
const NO_CACHE: Duration = Duration::ZERO;

/// From asm-generic/fcntl.h, which ARM and x86 use.
const O_NONBLOCK: i32 = 0o4000;

/// The file system that the kernel talks to.
#[derive(Debug)]
pub(super) struct Files<F> {
    pub(super) shared: Arc<Shared>,
    pub(super) open: Arc<Mutex<Open<F>>>,
}

fn file_type(kind: FileKind) -> FileType {
    match kind {
        FileKind::Directory => FileType::Directory,
        FileKind::File => FileType::RegularFile,
    }
}

/// The caller is shown as the owner. On the brick the group `ev3dev` gives it access.
fn attributes(stat: Stat, machine: &Machine, request: &Request) -> FileAttr {
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

impl<F: Served> Files<F> {
    fn stat(&self, node: NodeId, request: &Request) -> Result<FileAttr, Errno> {
        let machine = self.shared.lock();
        F::stat(&machine, node).map(|stat| attributes(stat, &machine, request))
    }

    fn find(&self, parent: NodeId, name: &OsStr, request: &Request) -> Result<FileAttr, Errno> {
        let name = name.to_str().ok_or(Errno::ENOENT)?;
        let node = F::lookup(&self.shared.lock(), parent, name)?;
        self.stat(node, request)
    }

    fn open_file(&self, node: NodeId, flags: OpenFlags, is_root: bool) -> Result<u64, Errno> {
        let access = match flags.acc_mode() {
            OpenAccMode::O_RDONLY => Access::ReadOnly,
            OpenAccMode::O_WRONLY => Access::WriteOnly,
            OpenAccMode::O_RDWR => Access::ReadWrite,
        };
        let file = F::open(&self.shared.lock(), node, access, is_root)?;
        Ok(locked(&self.open).insert(file))
    }

    fn list(&self, ino: INodeNo) -> Result<Vec<(INodeNo, FileType, String)>, Errno> {
        let entries = F::read_dir(&self.shared.lock(), NodeId(ino.0))?;
        let dots = [".", ".."].map(|name| (ino, FileType::Directory, name.to_owned()));
        let entries = entries
            .into_iter()
            .map(|entry| (INodeNo(entry.node.0), file_type(entry.kind), entry.name));
        Ok(dots.into_iter().chain(entries).collect())
    }
}

impl<F: Served> Filesystem for Files<F> {
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

    // Neither tree allows these: only drivers make files. Creating one is always EACCES.

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
        reply.error(fuse_errno(F::REFUSAL));
    }

    fn unlink(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(F::REFUSAL));
    }

    fn rmdir(&self, _: &Request, _parent: INodeNo, _name: &OsStr, reply: ReplyEmpty) {
        reply.error(fuse_errno(F::REFUSAL));
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
        reply.error(fuse_errno(F::REFUSAL));
    }

    fn open(&self, request: &Request, ino: INodeNo, flags: OpenFlags, reply: ReplyOpen) {
        match self.open_file(NodeId(ino.0), flags, request.uid() == 0) {
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
        let mut machine = self.shared.lock();
        let mut open = locked(&self.open);
        match open.read(&mut machine, fh.0, offset, size) {
            Ok(bytes) => reply.data(&bytes),
            Err(Errno::EAGAIN) if flags.0 & O_NONBLOCK == 0 => open.read_later(fh.0, size, reply),
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
        let mut open = locked(&self.open);
        let offset = usize::try_from(offset).unwrap_or(usize::MAX);
        match open.file(fh.0).and_then(|file| file.write(&mut machine, offset, data)) {
            Ok(Written { outcome, blocks }) if !blocks.is_zero() => {
                open.written_at(machine.now() + blocks, outcome, reply);
            }
            result => written(result.and_then(|result| result.outcome), reply),
        }
        drop((machine, open));
        self.shared.wake();
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
        match locked(&self.open).file(fh.0).and_then(|file| file.ioctl(&machine, command)) {
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
        locked(&self.open).remove(fh.0);
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
        let entries = match self.list(ino) {
            Ok(entries) => entries,
            Err(errno) => return reply.error(fuse_errno(errno)),
        };
        for (next, (ino, kind, name)) in (1..).zip(entries) {
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
        let mut events = F::ALWAYS;
        if open.is_ready(fh.0, &machine) {
            events |= F::READY;
        } else if flags.contains(PollFlags::FUSE_POLL_SCHEDULE_NOTIFY) {
            open.poll_later(fh.0, notifier.handle());
        }
        reply.poll(events);
    }
}
