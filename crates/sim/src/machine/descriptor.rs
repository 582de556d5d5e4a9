//! An open file, as the kernel sees it: what a `pread` and a `poll` on it do.
use crate::files::attr::Access;
use crate::machine::tree::NodeId;
use crate::machine::{Machine, Written};
use ev3_os::linux::Errno;

/// An open attribute. It stays with its device: once that is unplugged, reads and writes answer
/// ENODEV forever.
#[derive(Clone, Debug)]
pub struct Descriptor {
    node: NodeId,
    text: Vec<u8>,
    /// Where the last read ended.
    at: usize,
    seen: Option<u32>,
}

impl Descriptor {
    /// Opens an attribute by its path below the class directory.
    /// Errors: ENOENT, ENOTDIR, EISDIR; EACCES for what the attribute cannot do.
    pub fn open(machine: &Machine, path: &str, access: Access) -> Result<Descriptor, Errno> {
        machine.open(path, access).map(Descriptor::new)
    }

    /// Wraps a node that was opened already.
    pub const fn new(node: NodeId) -> Descriptor {
        Descriptor { node, text: Vec::new(), at: 0, seen: None }
    }

    /// The node behind it.
    pub const fn node(&self) -> NodeId {
        self.node
    }

    /// Reads from an offset. Where the last read ended this gives the rest of its text, 0 bytes at
    /// its end. At any other offset, and at 0, the driver makes a new text. A binary attribute is
    /// read again at each offset. Errors: ENODEV after an unplug; what the driver answers.
    pub fn pread(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        buffer: &mut [u8],
    ) -> Result<usize, Errno> {
        if machine.is_binary(self.node) {
            let bytes = machine.read_at(self.node, offset, buffer.len())?;
            buffer[..bytes.len()].copy_from_slice(&bytes);
            return Ok(bytes.len());
        }
        if offset == 0 || offset != self.at {
            self.seen = Some(machine.event_count(self.node)?);
            self.text = machine.read(self.node)?;
        }
        let rest = self.text.get(offset..).unwrap_or(&[]);
        let length = rest.len().min(buffer.len());
        buffer[..length].copy_from_slice(&rest[..length]);
        self.at = offset + length;
        Ok(length)
    }

    /// Writes: one call of the driver with these bytes.
    /// Errors: ENODEV after an unplug; what the driver answers.
    pub fn write(&mut self, machine: &mut Machine, bytes: &[u8]) -> Result<Written, Errno> {
        self.pwrite(machine, 0, bytes)
    }

    /// Writes at an offset, which only a binary attribute looks at.
    /// Errors: as [`Descriptor::write`]; EFBIG behind the end of a binary attribute.
    pub fn pwrite(
        &mut self,
        machine: &mut Machine,
        offset: usize,
        bytes: &[u8],
    ) -> Result<Written, Errno> {
        machine.write_at(self.node, offset, bytes)
    }

    /// True if poll(2) would report POLLPRI and POLLERR: the attribute has notified since this
    /// descriptor's last read, was never read on it, or its device is gone.
    pub fn poll(&self, machine: &Machine) -> bool {
        match machine.event_count(self.node) {
            Ok(count) => self.seen != Some(count),
            Err(_) => true,
        }
    }
}
