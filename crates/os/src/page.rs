//! A page in the place of the operating system: its clock, and Linux's error numbers.
#![expect(unsafe_code, reason = "the page's clock is imported")]
use std::error::Error;
use std::fmt;
use std::io;
use std::ops::{Add, Sub};
use std::time::Duration;

#[link(wasm_import_module = "host")]
unsafe extern "C" {
    /// The time since some fixed moment, in milliseconds.
    safe fn now_ms() -> f64;
    /// Gives the page a text in UTF-8.
    fn say(bytes: *const u8, length: usize);
    /// How many bytes the next line of the page has; 0 if there is none.
    safe fn heard() -> usize;
    /// Takes the next line, to this place.
    fn take(bytes: *mut u8);
}

/// Gives the page a text.
pub fn say_to_page(text: &str) {
    // Safety: the page copies it.
    unsafe { say(text.as_ptr(), text.len()) }
}

/// The next line of the page, if there is one.
#[must_use]
pub fn hear() -> Option<String> {
    let mut bytes = vec![0; heard()];
    if bytes.is_empty() {
        return None;
    }
    // Safety: the line has as many bytes as there is room for.
    unsafe { take(bytes.as_mut_ptr()) };
    Some(String::from_utf8_lossy(&bytes).into_owned())
}

/// A moment of the page's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Instant(Duration);

impl Instant {
    /// This moment.
    #[must_use]
    pub fn now() -> Self {
        Self(Duration::from_secs_f64(now_ms().max(0.0) / 1000.0))
    }

    /// The time since then.
    #[must_use]
    pub fn elapsed(&self) -> Duration {
        Self::now() - *self
    }

    /// The time from an earlier moment to this one, if that is earlier.
    #[must_use]
    pub fn saturating_duration_since(&self, earlier: Self) -> Duration {
        self.0.saturating_sub(earlier.0)
    }
}

impl Add<Duration> for Instant {
    type Output = Self;

    fn add(self, time: Duration) -> Self {
        Self(self.0 + time)
    }
}

impl Sub for Instant {
    type Output = Duration;

    fn sub(self, earlier: Self) -> Duration {
        self.saturating_duration_since(earlier)
    }
}

/// Does not sleep: nobody can here.
pub fn sleep(_time: Duration) {}

/// An error number.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Errno(i32);

macro_rules! errnos {
    ($($name:ident = $number:literal, $words:literal;)*) => {
        impl Errno {
            $(#[doc = $words] pub const $name: Errno = Errno($number);)*
        }

        impl fmt::Display for Errno {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                match self.0 {
                    $($number => f.write_str($words),)*
                    number => write!(f, "Unknown error {number}"),
                }
            }
        }
    };
}

// From asm-generic/errno-base.h and errno.h; the words are glibc's.
errnos! {
    PERM = 1, "Operation not permitted";
    NOENT = 2, "No such file or directory";
    INTR = 4, "Interrupted system call";
    IO = 5, "Input/output error";
    NXIO = 6, "No such device or address";
    BADF = 9, "Bad file descriptor";
    AGAIN = 11, "Resource temporarily unavailable";
    NOMEM = 12, "Cannot allocate memory";
    ACCESS = 13, "Permission denied";
    BUSY = 16, "Device or resource busy";
    EXIST = 17, "File exists";
    NODEV = 19, "No such device";
    NOTDIR = 20, "Not a directory";
    ISDIR = 21, "Is a directory";
    INVAL = 22, "Invalid argument";
    NFILE = 23, "Too many open files in system";
    MFILE = 24, "Too many open files";
    NOTTY = 25, "Inappropriate ioctl for device";
    NOSPC = 28, "No space left on device";
    ROFS = 30, "Read-only file system";
    RANGE = 34, "Numerical result out of range";
    NOSYS = 38, "Function not implemented";
    OPNOTSUPP = 95, "Operation not supported";
    TIMEDOUT = 110, "Connection timed out";
}

impl Errno {
    /// The number of an error of input or output, if it has one.
    #[must_use]
    pub fn from_io_error(error: &io::Error) -> Option<Self> {
        error.raw_os_error().map(Self)
    }
}

impl fmt::Debug for Errno {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Error for Errno {}

impl From<Errno> for io::Error {
    fn from(errno: Errno) -> Self {
        Self::from_raw_os_error(errno.0)
    }
}
