//! Other programs: those that speak and play.
use crate::devfs::{Devfs, Finds, UntilFound};
use crate::error::{Error, Result};
use crate::wait::Slices;
use ev3_os::locked;
use std::ffi::OsStr;
use std::io::{self, Read};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex};

/// How a program ends that could not be started, where that is only found out
/// later: in shells, and on an emulated processor.
const NOT_FOUND: i32 = 127;

/// A program, and the Debian package that brings it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Program {
    name: &'static str,
    package: &'static str,
}

impl Program {
    pub(crate) const APLAY: Self = Self { name: "aplay", package: "alsa-utils" };
    pub(crate) const AMIXER: Self = Self { name: "amixer", package: "alsa-utils" };
    pub(crate) const ESPEAK: Self = Self { name: "espeak", package: "espeak" };

    /// Starts it. Its messages can be read later.
    pub(crate) fn start(
        self,
        arguments: &[&OsStr],
        input: Stdio,
        output: Stdio,
    ) -> Result<Started> {
        let mut command = Command::new(self.name);
        command.args(arguments).stdin(input).stdout(output).stderr(Stdio::piped());
        let child = command.spawn().map_err(|source| self.cannot_start(&source))?;
        Ok(Started { program: self, child })
    }

    /// Runs it to its end; returns its output.
    pub(crate) fn output(self, arguments: &[&str]) -> Result<String> {
        let arguments: Vec<&OsStr> = arguments.iter().map(OsStr::new).collect();
        let mut started = self.start(&arguments, Stdio::null(), Stdio::piped())?;
        let mut printed = String::new();
        if let Some(output) = &mut started.child.stdout {
            let read = output.read_to_string(&mut printed);
            read.map_err(|source| self.failed(&source.to_string()))?;
        }
        let status = started.child.wait().map_err(|source| self.failed(&source.to_string()))?;
        if status.success() { Ok(printed) } else { Err(started.complaint(status)) }
    }

    fn cannot_start(self, source: &io::Error) -> Error {
        match source.kind() {
            io::ErrorKind::NotFound => self.missing(),
            _ => self.failed(&source.to_string()),
        }
    }

    fn missing(self) -> Error {
        Error::NoProgram { program: self.name, package: self.package }
    }

    fn failed(self, message: &str) -> Error {
        Error::Program { program: self.name, message: message.trim().to_owned() }
    }
}

/// A program that runs, and ends when this is dropped.
#[derive(Debug)]
pub(crate) struct Started {
    program: Program,
    child: Child,
}

impl Started {
    /// Its output, as the input of another program.
    pub(crate) fn printed(&mut self) -> Stdio {
        self.child.stdout.take().map_or_else(Stdio::null, Stdio::from)
    }

    /// Its error message.
    fn complaint(&mut self, status: ExitStatus) -> Error {
        if status.code() == Some(NOT_FOUND) {
            return self.program.missing();
        }
        let mut message = String::new();
        if let Some(errors) = &mut self.child.stderr {
            // A part of the message is better than nothing.
            let _ = errors.read_to_string(&mut message);
        }
        self.program.failed(&message)
    }
}

impl Drop for Started {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// Programs that somebody waits for.
pub(crate) struct Running {
    programs: Arc<Programs>,
    number: u32,
}

impl Finds for Running {
    fn find(&mut self) -> Result<bool> {
        Ok(self.programs.are_over(self.number)?.is_some())
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        locked(&self.programs.running).retain(|(other, _)| *other != self.number);
    }
}

/// Programs that run, by a number for those that run together.
#[derive(Debug, Default)]
pub(crate) struct Programs {
    running: Mutex<Vec<(u32, Started)>>,
    next: AtomicU32,
}

impl Programs {
    /// Starts programs, in the order of the pipe between them, and waits until all have ended, by
    /// themselves or by [`end`](Self::end). However it is left, they have.
    pub(crate) fn run<const N: usize>(
        self: &Arc<Self>,
        dev: &Arc<dyn Devfs>,
        start: impl FnOnce() -> Result<[Started; N]>,
    ) -> Result<Slices<UntilFound<Running>>> {
        let running = Running { programs: Arc::clone(self), number: self.begin(start)? };
        Ok(UntilFound::new(dev, running))
    }

    /// Starts programs, in the order of the pipe between them, and does not
    /// wait. Returns their number.
    pub(crate) fn begin<const N: usize>(
        &self,
        start: impl FnOnce() -> Result<[Started; N]>,
    ) -> Result<u32> {
        let number = self.next.fetch_add(1, Ordering::SeqCst);
        let mut running = locked(&self.running);
        running.extend(start()?.map(|program| (number, program)));
        Ok(number)
    }

    /// Whether all that run have ended; `None` if not. An error is reported once.
    pub(crate) fn are_all_over(&self) -> Result<Option<()>> {
        let Some(number) = locked(&self.running).first().map(|(number, _)| *number) else {
            return Ok(Some(()));
        };
        let over = self.are_over(number);
        if !matches!(over, Ok(None)) {
            locked(&self.running).retain(|(other, _)| *other != number);
        }
        over.map(|_| None)
    }

    /// Whether all have ended. If several failed, the error is that of the first one
    /// that did not just lose the reader of its output.
    fn are_over(&self, number: u32) -> Result<Option<()>> {
        let mut running = locked(&self.running);
        let mut failed = Vec::new();
        for (_, started) in running.iter_mut().filter(|(other, _)| *other == number) {
            let status = started.child.try_wait();
            match status.map_err(|source| started.program.failed(&source.to_string()))? {
                None => return Ok(None),
                Some(status) if status.success() => (),
                Some(status) => failed.push((started, status)),
            }
        }
        let first = failed.into_iter().min_by_key(|(_, status)| lost_its_reader(*status));
        first.map_or(Ok(Some(())), |(started, why)| Err(started.complaint(why)))
    }

    /// Ends all that run, and those that are just being started.
    pub(crate) fn end(&self) {
        locked(&self.running).clear();
    }
}

/// Whether a program was ended because nobody read its output any more.
#[cfg(unix)]
fn lost_its_reader(status: ExitStatus) -> bool {
    use std::os::unix::process::ExitStatusExt as _;
    status.signal() == Some(nix::sys::signal::Signal::SIGPIPE as i32)
}

/// No program runs there.
#[cfg(not(unix))]
fn lost_its_reader(_status: ExitStatus) -> bool {
    false
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::DevfsDir;
    use std::sync::mpsc::channel;
    use std::time::{Duration, Instant};

    const SLEEP: Program = Program { name: "sleep", package: "coreutils" };

    #[test]
    fn what_is_just_being_started_is_ended() {
        let programs = &Arc::<Programs>::default();
        let begun = Instant::now();
        std::thread::scope(|scope| {
            let (starting, has_started) = channel();
            let (ending, is_ended) = channel();
            scope.spawn(move || {
                has_started.recv().unwrap();
                ending.send(()).unwrap();
                programs.end();
            });
            let start = || {
                let started = SLEEP.start(&[OsStr::new("1000")], Stdio::null(), Stdio::null())?;
                starting.send(()).unwrap();
                is_ended.recv().unwrap();
                Ok([started])
            };
            let dev: Arc<dyn Devfs> = Arc::new(DevfsDir::new("/dev"));
            programs.run(&dev, start).unwrap().block(&mut || false).unwrap();
        });
        assert!(begun.elapsed() < Duration::from_secs(900), "it ran to its end");
    }
}
