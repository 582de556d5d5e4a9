//! Attribute files as data: one table per device class, one row per file.
//!
//! A row says what the file is called, what may be done with it, and which two small functions
//! stand behind it. Everything else (mode bits, open, stat, directory listings, the errors of an
//! operation the attribute does not offer) follows from the row.
use ev3_os::linux::Errno;
use std::fmt::{Display, Write};
use std::time::Duration;

/// The allowed access to an attribute. Sysfs refuses anything else at `open`, even for root.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// 0444
    ReadOnly,
    /// 0664 after udev, 0644 before
    ReadWrite,
    /// 0220 after udev, 0200 before
    WriteOnly,
}

impl Access {
    /// True if an attribute of this kind can be opened as `wanted`.
    pub fn allows(self, wanted: Access) -> bool {
        self == Access::ReadWrite || self == wanted
    }

    /// True if it includes writing.
    pub fn writes(self) -> bool {
        self != Access::ReadOnly
    }
}

/// The request of a successful write to the machine around the device.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Effect {
    /// Nothing more.
    Done,
    /// The write call returns to its caller only after this time.
    Blocks(Duration),
    /// A sensor is read once in a mode, and the write call returns after this time.
    Reads(usize, Duration),
    /// The write call returns only after this time, with the error ETIMEDOUT.
    TimesOut(Duration),
    /// A port's mode was written (perhaps the same one): its device goes, another may come.
    PortMode(usize),
    /// A program set the device of a port.
    PortDevice(String),
    /// Files appeared that udev has yet to open to the group.
    Appeared,
}

pub(crate) type Reader<D> = fn(&D) -> Result<Vec<u8>, Errno>;
pub(crate) type Writer<D> = fn(&mut D, &[u8]) -> Result<Effect, Errno>;

/// One attribute file of a device of type `D`.
pub(crate) struct Attr<D> {
    name: &'static str,
    access: Access,
    size: u32,
    read: Reader<D>,
    write: Writer<D>,
    exists: fn(&D) -> bool,
    measured: bool,
    late: bool,
}

impl<D> Attr<D> {
    pub(crate) const fn ro(name: &'static str, read: Reader<D>) -> Self {
        Self::new(name, Access::ReadOnly, read, |_, _| Err(Errno::EACCES))
    }

    pub(crate) const fn rw(name: &'static str, read: Reader<D>, write: Writer<D>) -> Self {
        Self::new(name, Access::ReadWrite, read, write)
    }

    pub(crate) const fn wo(name: &'static str, write: Writer<D>) -> Self {
        Self::new(name, Access::WriteOnly, |_| Err(Errno::EACCES), write)
    }

    const fn new(name: &'static str, access: Access, read: Reader<D>, write: Writer<D>) -> Self {
        Attr {
            name,
            access,
            size: 4096,
            read,
            write,
            exists: |_| true,
            measured: false,
            late: false,
        }
    }

    /// The size that `stat` reports; 4096 is for texts.
    pub(crate) const fn size(mut self, size: u32) -> Self {
        self.size = size;
        self
    }

    /// The file exists only while this holds.
    pub(crate) const fn only_while(mut self, exists: fn(&D) -> bool) -> Self {
        self.exists = exists;
        self
    }

    /// It appears after the device, and udev opens it then.
    pub(crate) const fn late(mut self) -> Self {
        self.late = true;
        self
    }

    /// The text depends on the world: the device must look at it before the reader is called.
    pub(crate) const fn measured(mut self) -> Self {
        self.measured = true;
        self
    }
}

/// A device whose files are the rows of a table.
pub(crate) trait Table: Sized + 'static {
    const ATTRS: &'static [Attr<Self>];
}

/// The same, for any device: what the tree needs to know.
pub(crate) trait Files {
    fn len(&self) -> usize;
    fn name(&self, index: usize) -> &'static str;
    fn access(&self, index: usize) -> Access;
    fn size(&self, index: usize) -> u32;
    fn exists(&self, index: usize) -> bool;
    fn measured(&self, index: usize) -> bool;
    fn late(&self, index: usize) -> bool;
    fn read(&self, index: usize) -> Result<Vec<u8>, Errno>;
    fn write(&mut self, index: usize, bytes: &[u8]) -> Result<Effect, Errno>;
}

impl<D: Table> Files for D {
    fn len(&self) -> usize {
        D::ATTRS.len()
    }

    fn name(&self, index: usize) -> &'static str {
        D::ATTRS[index].name
    }

    fn access(&self, index: usize) -> Access {
        D::ATTRS[index].access
    }

    fn size(&self, index: usize) -> u32 {
        D::ATTRS[index].size
    }

    fn exists(&self, index: usize) -> bool {
        (D::ATTRS[index].exists)(self)
    }

    fn measured(&self, index: usize) -> bool {
        D::ATTRS[index].measured
    }

    fn late(&self, index: usize) -> bool {
        D::ATTRS[index].late
    }

    fn read(&self, index: usize) -> Result<Vec<u8>, Errno> {
        (D::ATTRS[index].read)(self)
    }

    fn write(&mut self, index: usize, bytes: &[u8]) -> Result<Effect, Errno> {
        (D::ATTRS[index].write)(self, bytes)
    }
}

/// A value and the one newline that ends every text attribute.
#[expect(clippy::unnecessary_wraps, reason = "a reader is fallible")]
pub(crate) fn text(value: impl Display) -> Result<Vec<u8>, Errno> {
    // Most are short, and room for them at once is faster than room that grows.
    let mut text = String::with_capacity(16);
    let _ = writeln!(text, "{value}");
    Ok(text.into_bytes())
}

/// The text of a device's `uevent`, which has driver and address in one file. Writing an action
/// word makes udev read the device again; here it has no effect.
pub(crate) fn uevent(driver: &str, address: &str) -> Result<Vec<u8>, Errno> {
    text(format_args!("LEGO_DRIVER_NAME={driver}\nLEGO_ADDRESS={address}"))
}

/// The action words of `uevent`.
pub(crate) fn write_uevent(bytes: &[u8]) -> Result<Effect, Errno> {
    let actions = ["add", "remove", "change", "move", "online", "offline", "bind", "unbind"];
    crate::files::text::word(bytes, actions.into_iter()).map(|_| Effect::Done)
}
