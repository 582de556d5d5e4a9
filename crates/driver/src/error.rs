//! Errors, each with the file or the device that it is about.
use crate::class::Class;
use ev3_os::Errno;
use std::io;
use std::path::{Path, PathBuf};

/// Result of this crate's functions. An error that their comments do not name is the kernel's.
pub type Result<T> = std::result::Result<T, Error>;

/// Asked at least every 20 ms while something waits; `true` abandons the wait
/// with [`Error::Interrupted`]. Ctrl-C, time limits and signals come in here.
pub type Interrupted<'a> = &'a mut dyn FnMut() -> bool;

/// The kind of access to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access {
    /// Read it, or list it.
    Read,
    /// Write it.
    Write,
}

/// An operation that could not be carried out.
///
/// A missing device is not an error: the result is `None`.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file could not be opened, or a directory not listed.
    #[error("cannot open {}", .path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// The access that was asked for.
        access: Access,
        /// The kernel's answer.
        source: io::Error,
    },
    /// A file could not be read.
    #[error("cannot read {}", .path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The kernel's answer.
        source: io::Error,
    },
    /// A file could not be written.
    #[error("cannot write {text:?} to {}", .path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The text that was to be written.
        text: String,
        /// The kernel's answer.
        source: io::Error,
    },
    /// The content of a file is malformed.
    #[error("{} holds {text:?}, which is not {expected}", .path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Its content, shortened.
        text: String,
        /// The expected content.
        expected: &'static str,
    },
    /// A device was unplugged while it was in use.
    #[error("the {class} at {port} was unplugged")]
    Unplugged {
        /// The kind of device.
        class: Class,
        /// Where it was.
        port: String,
    },
    /// A sensor has no value of that number in its present mode.
    #[error("the sensor at {port} has no value {index} in mode {mode}")]
    NoValue {
        /// The port of the sensor.
        port: String,
        /// Its present mode.
        mode: String,
        /// The index that was asked for.
        index: usize,
    },
    /// The sensor has no registers: it is not on the I2C bus.
    #[error("the {driver} at {port} is not on the I2C bus")]
    NotOnBus {
        /// The port of the sensor.
        port: String,
        /// Its type.
        driver: String,
    },
    /// Two moves that start together name the same port.
    #[error("{port} is named twice")]
    DuplicatePort {
        /// The port that is named twice.
        port: String,
    },
    /// The port cannot have a motor of that type.
    #[error("no port for motors has a {name:?}")]
    UnknownMotorType {
        /// The name of the device.
        name: String,
    },
    /// The pattern is malformed.
    #[error("{pattern:?} is not a file name pattern")]
    Pattern {
        /// The pattern.
        pattern: String,
        /// Why not.
        source: glob::PatternError,
    },
    /// The file is not a picture or a recording of that format.
    #[error("{} cannot be read as {format}: {reason}", .path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The expected format: `png`.
        format: &'static str,
        /// The reason.
        reason: String,
    },
    /// A program that is needed is not installed.
    #[error("{program} is not installed; its package is {package}: sudo apt-get install {package}")]
    NoProgram {
        /// The program.
        program: &'static str,
        /// The Debian package that brings it.
        package: &'static str,
    },
    /// A program could not do its work.
    #[error("{program}: {message}")]
    Program {
        /// The program.
        program: &'static str,
        /// Its message.
        message: String,
    },
    /// A motor was to start after an emergency stop.
    #[error("the motors were stopped, and cannot start before the program has been interrupted")]
    Latched {
        /// Its `command`.
        path: PathBuf,
    },
    /// The caller abandoned a wait.
    #[error("interrupted")]
    Interrupted,
}

impl Error {
    /// The kernel's error number, if it was the kernel that refused.
    pub fn errno(&self) -> Option<Errno> {
        match self {
            Self::Open { source, .. } | Self::Read { source, .. } | Self::Write { source, .. } => {
                Errno::from_io_error(source)
            }
            _ => None,
        }
    }

    /// Whether this is how an unplugged device answers: ENODEV on a kept
    /// descriptor, ENOENT on a path that has vanished.
    pub fn is_stale(&self) -> bool {
        matches!(self.errno(), Some(Errno::NODEV | Errno::NOENT))
    }

    /// Whether a device was unplugged: it answers so, or was found to be missing.
    pub fn is_unplugged(&self) -> bool {
        self.is_stale() || matches!(self, Self::Unplugged { .. })
    }

    /// The file it went wrong at.
    pub fn path(&self) -> Option<&Path> {
        match self {
            Self::Open { path, .. }
            | Self::Read { path, .. }
            | Self::Write { path, .. }
            | Self::Malformed { path, .. }
            | Self::Latched { path }
            | Self::Format { path, .. } => Some(path),
            _ => None,
        }
    }
}
