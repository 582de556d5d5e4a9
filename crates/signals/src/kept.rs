//! A motor that is stopped when the program ends in any way: its line in [`crate::lines`], and
//! the first that runs starts what stops it after us.
use crate::lines::{self, RESTS, RUNS, Slot};
use crate::{handlers, survivor};
use nix::libc::c_int;
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::path::Path;
use std::sync::atomic::{AtomicU8, Ordering};
use std::time::Duration;

/// Whether what stops the motors after us is there, or has been tried.
static SURVIVED: AtomicU8 = AtomicU8::new(NOT_YET);
const NOT_YET: u8 = 0;
const BEGINS: u8 = 1;
const IS: u8 = 2;

/// A motor that is stopped when the program ends in any way. Dropped before its file is closed.
pub struct Kept(&'static Slot);

impl Kept {
    /// Keeps the open `command` of a motor, which `word` stops; `None` if too many are kept
    /// already. Errors: the kernel's, if there is no descriptor left.
    pub fn new(descriptor: c_int, path: &Path, word: &str) -> io::Result<Option<Self>> {
        let path = std::path::absolute(path)?;
        let path = path.as_os_str().as_bytes();
        if path.contains(&b'\n') {
            return Ok(None);
        }
        let line = [b" ", word.as_bytes(), b" ", path].concat();
        Ok(Slot::of(descriptor, &line)?.map(Self))
    }

    /// Has `write` give the motor a command.
    /// Errors: those of `write`; no motor starts that nobody could stop after us.
    #[inline]
    pub fn tell(&self, text: &[u8], write: impl FnOnce() -> io::Result<()>) -> io::Result<()> {
        let starts = text.starts_with(b"run");
        if starts {
            if SURVIVED.load(Ordering::Acquire) != IS {
                be_survived()?;
            }
            // Before: if we are killed in between, a motor is stopped that never started.
            self.0.flag(RUNS);
        }
        let written = write();
        if !starts && written.is_ok() {
            self.0.flag(RESTS);
        }
        written
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        self.0.free();
    }
}

/// The first motor runs. Starts what stops the motors after us.
#[cold]
fn be_survived() -> io::Result<()> {
    loop {
        match SURVIVED.compare_exchange(NOT_YET, BEGINS, Ordering::Acquire, Ordering::Acquire) {
            Ok(_) => {
                handlers::take_again();
                let started = survivor::start(lines::file());
                SURVIVED.store(if started.is_ok() { IS } else { NOT_YET }, Ordering::Release);
                return started;
            }
            Err(IS) => return Ok(()),
            // Another thread starts it: in a millisecond or two.
            Err(_) => std::thread::sleep(Duration::from_micros(100)),
        }
    }
}

/// In a child of fork(2), after [`lines::forked`]: nothing stops its motors after it yet.
pub(crate) fn forked() {
    SURVIVED.store(NOT_YET, Ordering::Relaxed);
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::{File, read_to_string};
    use std::os::fd::AsRawFd;

    fn keep(path: &Path, word: &str) -> (File, Kept) {
        let file = File::create(path).unwrap();
        let kept = Kept::new(file.as_raw_fd(), path, word).unwrap().unwrap();
        (file, kept)
    }

    fn told(kept: &Kept, text: &str) {
        kept.tell(text.as_bytes(), || Ok(())).unwrap();
    }

    // One test, as there is one record.
    #[test]
    fn those_that_run_are_stopped_and_lines_are_used_again() {
        let _alone = crate::latch::ALONE.lock().unwrap();
        survivor::survive(false);
        let folder = std::env::temp_dir().join(format!("ev3-kept-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let [runs, rests, servo] = ["runs", "rests", "servo"].map(|name| folder.join(name));
        let (one, two) = (keep(&runs, "stop"), keep(&rests, "stop"));
        let three = keep(&servo, "float");
        told(&one.1, "run-forever\n");
        told(&two.1, "run-timed\n");
        told(&two.1, "stop\n");
        told(&three.1, "run\n");
        assert!(lines::stop());
        let texts = [&runs, &rests, &servo].map(|path| read_to_string(path).unwrap());
        assert_eq!(texts, ["stop\n", "", "float\n"]);

        drop((one, two));
        let before = lines::length();
        for number in 0..2000 {
            drop(keep(&folder.join(format!("m{number}")), "stop"));
        }
        // The longest of these did not fit at first.
        assert!(lines::length() < before + 200);
        lines::leave();
        assert!(!lines::stop());
        std::fs::remove_dir_all(&folder).unwrap();
    }
}
