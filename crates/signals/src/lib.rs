//! Signals that end a program.
//!
//! Prolog handles a signal at its next safe moment, and while it loads a file, or waits
//! in `shell/1`, there is none. So the handlers here come before Prolog's:
//!
//! * A signal that asks the program to end is passed to a thread ([`watch`]). That stops
//!   the motors, then lets Prolog have the signal, and ends the process if Prolog has not
//!   done so within [`PATIENCE`].
//! * A crash stops the motors within the handler itself: it writes `stop` to the files
//!   that are kept for that ([`Kept`]), and nothing else.
//!
//! Nothing can be done about SIGKILL.
#![expect(unsafe_code, reason = "handlers of signals are C's")]
use nix::errno::Errno;
use nix::libc::{self, c_int, c_void, siginfo_t};
use nix::sys::signal::{
    SaFlags, SigAction, SigHandler, SigSet, SigmaskHow, Signal, kill, raise, sigaction,
};
use nix::unistd::Pid;
use std::io::{self, Read, Write};
use std::os::unix::net::UnixStream;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicI32, AtomicU32, Ordering};
use std::time::Duration;

/// How long Prolog may take to end the process.
pub const PATIENCE: Duration = Duration::from_secs(2);

/// The signals that ask a program to end.
const ENDING: [Signal; 3] = [Signal::SIGTERM, Signal::SIGHUP, Signal::SIGINT];

/// Those that end it, unless the program has its own handler.
const CRASHES: [Signal; 6] = [
    Signal::SIGQUIT,
    Signal::SIGABRT,
    Signal::SIGSEGV,
    Signal::SIGBUS,
    Signal::SIGILL,
    Signal::SIGFPE,
];

/// What each signal did before, by its number.
static BEFORE: [OnceLock<SigAction>; 32] = [const { OnceLock::new() }; 32];

/// The signals that the thread has and Prolog has not yet, a bit each.
static WITHHELD: AtomicU32 = AtomicU32::new(0);

/// The way to the thread.
static THREAD: OnceLock<UnixStream> = OnceLock::new();

/// No descriptor.
const NONE: i32 = -1;

/// The descriptors of files that take `stop`.
static KEPT: [AtomicI32; 64] = [const { AtomicI32::new(NONE) }; 64];

/// A file that is told `stop` in a crash. Dropped before the file is closed.
#[derive(Debug)]
pub struct Kept(&'static AtomicI32);

impl Kept {
    /// Keeps a descriptor; `None` if too many are kept already.
    #[must_use]
    pub fn new(descriptor: i32) -> Option<Self> {
        let order = Ordering::AcqRel;
        let is_free = |slot: &&AtomicI32| {
            slot.compare_exchange(NONE, descriptor, order, Ordering::Relaxed).is_ok()
        };
        KEPT.iter().find(is_free).map(Self)
    }
}

impl Drop for Kept {
    fn drop(&mut self) {
        self.0.store(NONE, Ordering::Release);
    }
}

/// Takes the signals that end a program, from now on. A thread calls `ask` with the
/// name of one that asks for it, as `term`. It is to stop the motors if the signal will
/// end the program, and to answer whether it will.
///
/// # Errors
/// The kernel's, where no thread can be had.
pub fn watch(ask: impl Fn(&'static str) -> bool + Send + 'static) -> io::Result<()> {
    let (read, write) = UnixStream::pair()?;
    if THREAD.set(write).is_err() {
        return Ok(());
    }
    // The signals are for the program's own threads.
    let before = SigSet::all().thread_swap_mask(SigmaskHow::SIG_BLOCK)?;
    let serve = move || serve(&read, &ask);
    let spawned = std::thread::Builder::new().name("ev3-signals".to_owned()).spawn(serve);
    before.thread_set_mask()?;
    spawned?;
    for signal in ENDING.into_iter().chain(CRASHES) {
        take(signal)?;
    }
    Ok(())
}

/// Puts the handler before the one that there is.
fn take(signal: Signal) -> nix::Result<()> {
    let ours = |flags, mask| SigAction::new(SigHandler::SigAction(handle), flags, mask);
    let replace = |action: &SigAction| {
        // Safety: the handler calls only what may be called in one.
        unsafe { sigaction(signal, action) }
    };
    let before = replace(&ours(SaFlags::SA_SIGINFO | SaFlags::SA_ONSTACK, SigSet::empty()))?;
    let _ = BEFORE[signal as usize].set(before);
    let lasting = match before.handler() {
        SigHandler::SigIgn => before,
        // As it was for system calls that are interrupted, above all.
        _ => ours(before.flags() | SaFlags::SA_SIGINFO, before.mask()),
    };
    replace(&lasting).map(drop)
}

/// Puts back what the kernel does by itself.
fn give_up(signal: Signal) {
    let default = SigAction::new(SigHandler::SigDfl, SaFlags::empty(), SigSet::empty());
    // Safety: there is no handler any more.
    let _ = unsafe { sigaction(signal, &default) };
}

extern "C" fn handle(number: c_int, info: *mut siginfo_t, context: *mut c_void) {
    let errno = Errno::last();
    if let Ok(signal) = Signal::try_from(number) {
        if !ENDING.contains(&signal) {
            stop_kept();
            pass_on(signal, info, context);
        } else if !withhold(signal) {
            pass_on(signal, info, context);
        }
    }
    errno.set();
}

/// Gives a signal to the thread; `false` if the thread has given it back.
fn withhold(signal: Signal) -> bool {
    let bit = 1 << signal as u32;
    let is_new = WITHHELD.fetch_xor(bit, Ordering::AcqRel) & bit == 0;
    is_new && THREAD.get().is_some_and(|mut thread| thread.write(&[signal as u8]).is_ok())
}

/// Does what the signal did before.
fn pass_on(signal: Signal, info: *mut siginfo_t, context: *mut c_void) {
    match BEFORE[signal as usize].get().map(SigAction::handler) {
        Some(SigHandler::Handler(handler)) => handler(signal as c_int),
        Some(SigHandler::SigAction(handler)) => handler(signal as c_int, info, context),
        Some(SigHandler::SigDfl) => {
            give_up(signal);
            let _ = raise(signal);
        }
        Some(SigHandler::SigIgn) | None => {}
    }
}

/// Writes `stop` to the files that are kept for that.
fn stop_kept() {
    const STOP: &[u8] = b"stop\n";
    for descriptor in KEPT.iter().map(|slot| slot.load(Ordering::Acquire)) {
        if descriptor != NONE {
            // Safety: the buffer is as long as that; a closed descriptor is an error.
            unsafe { libc::pwrite(descriptor, STOP.as_ptr().cast(), STOP.len(), 0) };
        }
    }
}

/// What the thread does.
fn serve(mut signals: &UnixStream, ask: &impl Fn(&'static str) -> bool) {
    let mut number = [0];
    while signals.read_exact(&mut number).is_ok() {
        let Ok(signal) = Signal::try_from(c_int::from(number[0])) else {
            continue;
        };
        let ends = ask(match signal {
            Signal::SIGHUP => "hup",
            Signal::SIGINT => "int",
            _ => "term",
        });
        let _ = kill(Pid::this(), signal);
        if ends {
            std::thread::sleep(PATIENCE);
            // Prolog cannot. It may have started a motor meanwhile.
            stop_kept();
            give_up(signal);
            let _ = kill(Pid::this(), signal);
        }
    }
}
