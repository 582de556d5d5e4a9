//! The two trees that can be mounted, by what is open in them.
use crate::files::attr::Access;
use crate::machine::descriptor::Descriptor;
use crate::machine::dev::DevDescriptor;
use crate::machine::tree::{Entry, NodeId, Stat};
use crate::machine::{Machine, Written};
use ev3_os::linux::Errno;
use fuser::PollEvents;
use std::fmt::Debug;
use std::time::Duration;

/// An open file, and the tree that it is in.
pub(super) trait Served: Debug + Send + Sized + 'static {
    /// The events that poll(2) always reports.
    const ALWAYS: PollEvents;

    /// The events that it reports in addition when there is news.
    const READY: PollEvents;

    /// The error of making a directory, removing and renaming.
    const REFUSAL: Errno;

    /// Kind, permission bits and size of a node.
    fn stat(machine: &Machine, node: NodeId) -> Result<Stat, Errno>;

    /// The node with this name in a directory.
    fn lookup(machine: &Machine, directory: NodeId, name: &str) -> Result<NodeId, Errno>;

    /// The entries of a directory.
    fn read_dir(machine: &Machine, directory: NodeId) -> Result<Vec<Entry>, Errno>;

    /// Opens a node, for a program of root or another one.
    fn open(machine: &Machine, node: NodeId, access: Access, is_root: bool) -> Result<Self, Errno>;

    /// Reads into a buffer. EAGAIN if there will be something only later.
    fn read(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        buffer: &mut [u8],
    ) -> Result<usize, Errno>;

    /// Writes.
    fn write(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        data: &[u8],
    ) -> Result<Written, Errno>;

    /// Whether poll(2) has an event to report.
    fn is_ready(&self, machine: &Machine) -> bool;

    /// The answer to an ioctl: its result, and the bytes for the caller.
    fn ioctl(&self, machine: &Machine, command: u32) -> Result<(i32, Vec<u8>), Errno>;
}

/// An attribute below `/sys/class`: always ready for reading, as in sysfs, with an event when it
/// has changed.
impl Served for Descriptor {
    const ALWAYS: PollEvents = PollEvents::POLLIN.union(PollEvents::POLLOUT);
    const READY: PollEvents = PollEvents::POLLPRI.union(PollEvents::POLLERR);
    const REFUSAL: Errno = Errno::EPERM;

    fn stat(machine: &Machine, node: NodeId) -> Result<Stat, Errno> {
        machine.stat(node)
    }

    fn lookup(machine: &Machine, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        machine.lookup(directory, name)
    }

    fn read_dir(machine: &Machine, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        machine.read_dir(directory)
    }

    fn open(
        machine: &Machine,
        node: NodeId,
        access: Access,
        is_root: bool,
    ) -> Result<Descriptor, Errno> {
        let opened = if is_root {
            machine.open_node_as_root(node, access)
        } else {
            machine.open_node(node, access)
        };
        opened.map(|()| Descriptor::new(node))
    }

    fn read(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        buffer: &mut [u8],
    ) -> Result<usize, Errno> {
        self.pread(machine, offset, buffer)
    }

    fn write(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        data: &[u8],
    ) -> Result<Written, Errno> {
        self.pwrite(machine, offset, data)
    }

    fn is_ready(&self, machine: &Machine) -> bool {
        self.poll(machine)
    }

    fn ioctl(&self, _: &Machine, _command: u32) -> Result<(i32, Vec<u8>), Errno> {
        Err(Errno::ENOTTY)
    }
}

/// A device below `/dev`. Nobody but root makes or removes one.
impl Served for DevDescriptor {
    const ALWAYS: PollEvents = PollEvents::POLLOUT;
    const READY: PollEvents = PollEvents::POLLIN;
    const REFUSAL: Errno = Errno::EACCES;

    fn stat(machine: &Machine, node: NodeId) -> Result<Stat, Errno> {
        machine.dev_stat(node)
    }

    fn lookup(machine: &Machine, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        machine.dev_lookup(directory, name)
    }

    fn read_dir(machine: &Machine, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        machine.dev_read_dir(directory)
    }

    fn open(
        machine: &Machine,
        node: NodeId,
        _: Access,
        _is_root: bool,
    ) -> Result<DevDescriptor, Errno> {
        DevDescriptor::open_node(machine, node)
    }

    fn read(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        buffer: &mut [u8],
    ) -> Result<usize, Errno> {
        DevDescriptor::read(self, machine, offset, buffer)
    }

    fn write(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        data: &[u8],
    ) -> Result<Written, Errno> {
        let length = DevDescriptor::write(self, machine, offset, data)?;
        Ok(Written { outcome: Ok(length), blocks: Duration::ZERO })
    }

    fn is_ready(&self, machine: &Machine) -> bool {
        DevDescriptor::is_ready(self, machine)
    }

    fn ioctl(&self, machine: &Machine, command: u32) -> Result<(i32, Vec<u8>), Errno> {
        DevDescriptor::ioctl(self, machine, command)
    }
}
