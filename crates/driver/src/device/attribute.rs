//! Attribute files: kept open, read whole, written in one go.
use crate::error::{Access, Error, Result};
use crate::sysfs::{AttributeFile, Sysfs};
use crate::value::{Value, holds_integer};
use ev3_signals::latch;
use std::path::{Path, PathBuf};
use std::sync::{OnceLock, RwLock};
use std::time::Duration;

/// The kernel's limit on an attribute's text: a page.
pub(super) const PAGE: usize = 4096;

/// Room for a number, a mode, or a motor's state.
pub(super) const SHORT: usize = 64;

/// Room for most attributes.
pub(super) const LINE: usize = 256;

/// How long another program may take from emptying a plain file to writing it.
const WRITTEN_WITHIN_MS: u32 = 20;

/// Reads the text of any file, without keeping it open.
pub fn read_file(tree: &dyn Sysfs, path: &Path) -> Result<String> {
    let node = open(tree, path, Access::Read)?;
    let mut buffer = [0; PAGE + 1];
    text_of(path, read_node(&*node, path, &mut buffer)?)
}

/// Writes any file, which must exist, without keeping it open.
pub fn write_file(tree: &dyn Sysfs, path: &Path, text: &str) -> Result<()> {
    let node = open(tree, path, Access::Write)?;
    write_line(&*node, path, text)
}

/// The value in a file: a number if it is one.
pub fn read_value(tree: &dyn Sysfs, path: &Path) -> Result<Value> {
    read_file(tree, path).map(Value::parse)
}

/// An attribute file, opened when first used.
pub(crate) struct Attribute {
    pub(super) name: Box<str>,
    pub(super) path: PathBuf,
    /// Whether it holds an integer and nothing else.
    pub(super) holds_integer: bool,
    reader: OnceLock<Box<dyn AttributeFile>>,
    writer: OnceLock<Box<dyn AttributeFile>>,
    /// Keeps readers of a plain file from seeing half of a write.
    whole: RwLock<()>,
}

impl Attribute {
    pub(super) fn new(name: &str, directory: &Path) -> Self {
        Self {
            name: name.into(),
            path: directory.join(name),
            holds_integer: holds_integer(name),
            reader: OnceLock::new(),
            writer: OnceLock::new(),
            whole: RwLock::default(),
        }
    }

    /// The descriptor for reading, opened when first asked for.
    pub(crate) fn reader(&self, tree: &dyn Sysfs) -> Result<&dyn AttributeFile> {
        kept(&self.reader, tree, &self.path, Access::Read)
    }

    /// Reads the text, which must fit into the buffer with room to spare.
    pub(super) fn read<'a>(&self, tree: &dyn Sysfs, buffer: &'a mut [u8]) -> Result<&'a [u8]> {
        let node = self.reader(tree)?;
        let whole = node.is_plain().then(|| self.whole.read());
        let bytes = read_node(node, &self.path, buffer)?;
        drop(whole);
        Ok(bytes)
    }

    /// Whether the file only stores what is written to it.
    pub(crate) fn is_plain(&self, tree: &dyn Sysfs) -> Result<bool> {
        Ok(self.reader(tree)?.is_plain())
    }

    /// Reads a plain file that is found empty: another program may be about
    /// to write it, which empties it first.
    pub(super) fn read_written<'a>(
        &self,
        tree: &dyn Sysfs,
        buffer: &'a mut [u8],
    ) -> Result<&'a [u8]> {
        for _ in 0..WRITTEN_WITHIN_MS {
            // After a pause that failed, too, the next read decides.
            let _ = tree.pause(&[], tree.now().saturating_add(Duration::from_millis(1)));
            if !self.read(tree, &mut *buffer)?.is_empty() {
                break;
            }
        }
        self.read(tree, buffer)
    }

    /// The descriptor for writing, opened when first asked for.
    pub(super) fn writer(&self, tree: &dyn Sysfs) -> Result<&dyn AttributeFile> {
        kept(&self.writer, tree, &self.path, Access::Write)
    }

    pub(super) fn write(&self, tree: &dyn Sysfs, text: &str) -> Result<()> {
        let node = self.writer(tree)?;
        let _whole = node.is_plain().then(|| self.whole.write());
        write_line(node, &self.path, text)
    }

    /// Fills a buffer with the bytes from an offset on.
    pub(super) fn read_at(&self, tree: &dyn Sysfs, buffer: &mut [u8], offset: u8) -> Result<()> {
        let read = self.reader(tree)?.read_at(buffer, offset);
        let length = read.map_err(|source| Error::Read { path: self.path.clone(), source })?;
        if length < buffer.len() {
            let read = buffer.get(..length).unwrap_or_default();
            return Err(malformed(&self.path, read, "as much as was to be read"));
        }
        Ok(())
    }

    /// Writes bytes from an offset on, in one go.
    pub(super) fn write_at(&self, tree: &dyn Sysfs, bytes: &[u8], offset: u8) -> Result<()> {
        self.writer(tree)?.write_at(bytes, offset).map_err(|source| Error::Write {
            path: self.path.clone(),
            text: format!("{bytes:?}"),
            source,
        })
    }

    pub(super) fn malformed(&self, bytes: &[u8], expected: &'static str) -> Error {
        malformed(&self.path, bytes, expected)
    }
}

/// Opens a file once, and only remembers success.
fn kept<'a>(
    cell: &'a OnceLock<Box<dyn AttributeFile>>,
    tree: &dyn Sysfs,
    path: &Path,
    access: Access,
) -> Result<&'a dyn AttributeFile> {
    if let Some(node) = cell.get() {
        return Ok(&**node);
    }
    let node = open(tree, path, access)?;
    Ok(&**cell.get_or_init(|| node))
}

pub(super) fn open(
    tree: &dyn Sysfs,
    path: &Path,
    access: Access,
) -> Result<Box<dyn AttributeFile>> {
    tree.open(path, access).map_err(|source| Error::Open { path: path.to_owned(), access, source })
}

/// Writes a text and a newline in one go: one write is one call of the driver.
fn write_line(node: &dyn AttributeFile, path: &Path, text: &str) -> Result<()> {
    let starting = text.starts_with("run").then(latch::Starting::begin);
    if latch::is_set() && starts_motor(path, text) {
        return Err(Error::Latched { path: path.to_owned() });
    }
    let mut line = [b'\n'; SHORT];
    let written = match line.split_at_mut_checked(text.len()) {
        Some((start, [_, ..])) => {
            start.copy_from_slice(text.as_bytes());
            node.write(line.get(..=text.len()).unwrap_or_default())
        }
        _ => node.write(format!("{text}\n").as_bytes()),
    };
    drop(starting);
    written.map_err(|source| Error::Write { path: path.to_owned(), text: text.to_owned(), source })
}

/// Whether that text in that file starts a motor.
#[cold]
fn starts_motor(path: &Path, text: &str) -> bool {
    path.ends_with("command") && text.trim_start().starts_with("run")
}

/// Reads all there is. More than fits cannot be an attribute's text: rather than cut it, say so.
pub(super) fn read_node<'a>(
    node: &dyn AttributeFile,
    path: &Path,
    buffer: &'a mut [u8],
) -> Result<&'a [u8]> {
    let length =
        node.read(buffer).map_err(|source| Error::Read { path: path.to_owned(), source })?;
    match buffer.get(..length) {
        Some(bytes) if length < buffer.len() => Ok(bytes),
        _ => Err(malformed(path, buffer, "a text as short as belongs there")),
    }
}

/// The text without the newline that ends it.
pub(super) fn text_of(path: &Path, bytes: &[u8]) -> Result<String> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(text.strip_suffix('\n').unwrap_or(text).to_owned()),
        Err(_) => Err(malformed(path, bytes, "text")),
    }
}

pub(super) fn malformed(path: &Path, bytes: &[u8], expected: &'static str) -> Error {
    let text = String::from_utf8_lossy(bytes.get(..SHORT).unwrap_or(bytes)).into_owned();
    Error::Malformed { path: path.to_owned(), text, expected }
}
