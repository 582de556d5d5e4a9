//! A page in the place of the operating system: its clock, and Linux's error numbers under the
//! names that they have on Unix.
#![expect(unsafe_code, reason = "the page's clock is imported")]
use crate::linux::Errno;
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
    pub fn now() -> Self {
        Self(Duration::from_secs_f64(now_ms().max(0.0) / 1000.0))
    }

    /// The time since then.
    pub fn elapsed(&self) -> Duration {
        Self::now() - *self
    }

    /// The time from an earlier moment to this one, if that is earlier.
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

/// There is one process, and it has no number.
pub fn process_id() -> u32 {
    0
}

/// Does not sleep: nobody can here.
pub fn sleep(_time: Duration) {}

macro_rules! renamed {
    ($($name:ident = $symbol:ident;)*) => {
        /// The names that rustix has.
        #[expect(missing_docs, reason = "they are those of the symbols")]
        impl Errno {
            $(pub const $name: Self = Self::$symbol;)*
        }
    };
}

renamed! {
    ACCESS = EACCES;
    AGAIN = EAGAIN;
    BUSY = EBUSY;
    INTR = EINTR;
    INVAL = EINVAL;
    MFILE = EMFILE;
    NFILE = ENFILE;
    NODEV = ENODEV;
    NOENT = ENOENT;
    NOMEM = ENOMEM;
    NOSYS = ENOSYS;
    NOTDIR = ENOTDIR;
    NOTTY = ENOTTY;
    NXIO = ENXIO;
    OPNOTSUPP = EOPNOTSUPP;
    PERM = EPERM;
    RANGE = ERANGE;
    ROFS = EROFS;
    TIMEDOUT = ETIMEDOUT;
}

impl Errno {
    /// The number of an error of input or output, if it has one.
    pub fn from_io_error(error: &io::Error) -> Option<Self> {
        error.raw_os_error().map(Self)
    }
}
