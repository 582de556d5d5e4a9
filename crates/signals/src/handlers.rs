//! The handlers of signals themselves.
use crate::events::{self, is_child};
use crate::latch::{self, Reason};
use crate::stack::own_handlers_stack;
use crate::{crash, lines};
use nix::errno::Errno;
use nix::libc::{self, c_int, c_void, siginfo_t};
use std::mem::zeroed;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, AtomicPtr, AtomicU32, Ordering};

/// The highest number of a signal.
const LAST: c_int = 64;

/// Those that ask a program to end.
const ASKING: [c_int; 3] = [libc::SIGTERM, libc::SIGHUP, libc::SIGINT];

/// Those after which it stands until it is continued.
const STANDING: [c_int; 3] = [libc::SIGTSTP, libc::SIGTTIN, libc::SIGTTOU];

/// Those that end it, unless the program has its own handler. Prolog has handlers.
const CRASHES: [c_int; 7] = [
    libc::SIGQUIT,
    libc::SIGABRT,
    libc::SIGSEGV,
    libc::SIGBUS,
    libc::SIGILL,
    libc::SIGFPE,
    libc::SIGSYS,
];

/// The signals of which Prolog makes an exception. Older versions do so in the handler, which hangs
/// if the thread has a lock that it needs.
const THROWN: [c_int; 4] = [libc::SIGALRM, libc::SIGXCPU, libc::SIGXFSZ, libc::SIGVTALRM];

/// Those that end nothing by themselves, and those that nobody can take. The C library has
/// 32 and 33 for itself.
const LEFT: [c_int; 8] = [
    libc::SIGKILL,
    libc::SIGSTOP,
    libc::SIGCONT,
    libc::SIGCHLD,
    libc::SIGURG,
    libc::SIGWINCH,
    32,
    33,
];

/// How often, a millisecond apart, it is asked whether a thread is still starting a motor. Where
/// the handler has interrupted that thread itself it will be.
const WAITS: u32 = 100;

/// What each signal did before, by its number; null for what the kernel does by itself.
static BEFORE: [AtomicPtr<libc::sigaction>; LAST as usize + 1] =
    [const { AtomicPtr::new(null_mut()) }; LAST as usize + 1];

/// The signals that the watchdog has not looked at yet, a bit each.
static WITHHELD: AtomicU32 = AtomicU32::new(0);

/// Those that it has sent on.
static LOOKED_AT: AtomicU32 = AtomicU32::new(0);

/// Whether a thread makes the process stand.
static STANDS: AtomicBool = AtomicBool::new(false);

/// Takes all signals that end a process, or make it stand. Those that are ignored stay so.
pub(crate) fn take_all() {
    own_handlers_stack();
    let prologs = action(libc::SIGTERM).sa_sigaction;
    for signal in (1..=LAST).filter(|signal| !LEFT.contains(signal)) {
        let before = action(signal);
        let is_taken = before.sa_sigaction == libc::SIG_DFL
            || ASKING.contains(&signal)
            || CRASHES.contains(&signal)
            || THROWN.contains(&signal) && before.sa_sigaction == prologs;
        if is_taken {
            take(signal, &before);
        }
    }
}

/// Takes signals again that Prolog has taken since, as its toplevel does when it begins,
/// `on_signal/3`, and shell/1 with Ctrl-Z. Prolog has one handler for all.
pub(crate) fn take_again() {
    if let Some(prologs) = before(libc::SIGTERM) {
        for signal in ASKING.into_iter().chain(CRASHES).chain(THROWN) {
            let now = action(signal);
            if now.sa_sigaction == prologs.sa_sigaction {
                // The same, so that nothing has to be kept: the watchdog allocates nothing.
                slot(signal).store(std::ptr::from_ref(prologs).cast_mut(), Ordering::Release);
                take(signal, &now);
            }
        }
    }
    for signal in STANDING {
        let now = action(signal);
        if now.sa_sigaction == libc::SIG_DFL && !STANDS.load(Ordering::Acquire) {
            take(signal, &now);
        }
    }
}

/// What a signal does now.
fn action(signal: c_int) -> libc::sigaction {
    // Safety: asks only.
    unsafe {
        let mut action = zeroed();
        libc::sigaction(signal, null(), &raw mut action);
        action
    }
}

fn take(signal: c_int, before: &libc::sigaction) {
    if [libc::SIG_IGN, handle as *const () as usize].contains(&before.sa_sigaction) {
        return;
    }
    if before.sa_sigaction != libc::SIG_DFL
        && self::before(signal).map(|known| known.sa_sigaction) != Some(before.sa_sigaction)
    {
        // For good: a handler may be looking at the one before.
        let kept = Box::into_raw(Box::new(*before));
        slot(signal).store(kept, Ordering::Release);
    }
    let mut ours = *before;
    ours.sa_sigaction = handle as *const () as usize;
    ours.sa_flags |= libc::SA_SIGINFO | libc::SA_ONSTACK;
    if STANDING.contains(&signal) {
        ours.sa_flags |= libc::SA_RESTART;
    }
    // Safety: the handler calls only what may be called in one.
    unsafe { libc::sigaction(signal, &raw const ours, null_mut()) };
}

fn slot(signal: c_int) -> &'static AtomicPtr<libc::sigaction> {
    static NONE: AtomicPtr<libc::sigaction> = AtomicPtr::new(null_mut());
    usize::try_from(signal).ok().and_then(|number| BEFORE.get(number)).unwrap_or(&NONE)
}

fn before(signal: c_int) -> Option<&'static libc::sigaction> {
    // Safety: it is kept for good.
    unsafe { slot(signal).load(Ordering::Acquire).as_ref() }
}

/// Has the kernel do what it does by itself, at once.
pub(crate) fn do_default(signal: c_int) {
    // Safety: there is no handler any more.
    unsafe {
        libc::signal(signal, libc::SIG_DFL);
        libc::raise(signal);
        unblock(signal);
    }
}

/// Lets a signal come to this thread; what was blocked before.
unsafe fn unblock(signal: c_int) -> libc::sigset_t {
    // Safety: changes the mask of this thread.
    unsafe {
        let mut set = zeroed();
        let mut before = zeroed();
        libc::sigemptyset(&raw mut set);
        libc::sigaddset(&raw mut set, signal);
        libc::pthread_sigmask(libc::SIG_UNBLOCK, &raw const set, &raw mut before);
        before
    }
}

/// Lets the signals that ask for the end come to this thread.
pub(crate) fn listen() {
    for signal in ASKING {
        // Safety: the handlers are there.
        unsafe { unblock(signal) };
    }
}

extern "C" fn handle(signal: c_int, info: *mut siginfo_t, context: *mut c_void) {
    let errno = Errno::last();
    if ASKING.contains(&signal) {
        let is_for_prolog = was_looked_at(signal) || !withhold(signal);
        if is_for_prolog && latch::is_set_as(Reason::Halting) {
            // Prolog has begun to take itself down.
            do_default(signal);
        } else if is_for_prolog {
            pass_on(signal, info, context);
        }
    } else if STANDING.contains(&signal) {
        stand(signal);
    } else if is_child() && is_sent(info) {
        // Prolog's handler would make a copy of the program of what is to be another one.
        do_default(signal);
    } else {
        let mark = AtomicU32::new(0);
        crash::begins(signal, &mark);
        stop_for(Reason::Crashed);
        pass_on(signal, info, context);
        // The program goes on. Where Prolog does not come back to here, the watchdog lifts it.
        latch::lift(Reason::Crashed);
        mark.store(0, Ordering::Relaxed);
    }
    errno.set();
}

/// Whether a process has sent a signal, and not the processor. The kernel has called the handler.
fn is_sent(info: *const siginfo_t) -> bool {
    // Safety: it is the kernel's then.
    unsafe { info.as_ref() }.is_some_and(|info| info.si_code <= 0)
}

/// Stops the motors, whatever other threads are doing.
pub(crate) fn stop_for(reason: Reason) -> bool {
    latch::set(reason);
    // Before the first stop: who is done then is stopped by it.
    let is_any_starting = latch::is_any_starting();
    let mut any = lines::stop();
    if is_any_starting {
        for _ in (0..WAITS).take_while(|_| latch::is_any_starting()) {
            let time = libc::timespec { tv_sec: 0, tv_nsec: 1_000_000 };
            // Safety: waits only.
            unsafe { libc::nanosleep(&raw const time, null_mut()) };
        }
        any |= lines::stop();
    }
    any
}

/// Gives a signal to the watchdog; `false` if there is none.
fn withhold(signal: c_int) -> bool {
    let is_new = WITHHELD.fetch_or(bit(signal), Ordering::AcqRel) & bit(signal) == 0;
    let is_sent = !is_new || events::send(events::SIGNAL, signal);
    if !is_sent {
        look_at(signal);
    }
    is_sent
}

/// The watchdog looks at a signal: another one is for it, too.
pub(crate) fn look_at(signal: c_int) {
    WITHHELD.fetch_and(!bit(signal), Ordering::AcqRel);
}

fn bit(signal: c_int) -> u32 {
    1 << signal
}

/// Sends a signal that the handler passes on. What the signal itself carries does not say that: a
/// library that edits lines calls the handler as one without such an argument.
pub(crate) fn send_on(signal: c_int) {
    LOOKED_AT.fetch_or(bit(signal), Ordering::AcqRel);
    // Safety: to this process.
    unsafe { libc::kill(libc::getpid(), signal) };
}

/// Whether the watchdog has looked at a signal; then the next one is another.
fn was_looked_at(signal: c_int) -> bool {
    LOOKED_AT.fetch_and(!bit(signal), Ordering::AcqRel) & bit(signal) != 0
}

/// Does what the signal did before.
fn pass_on(signal: c_int, info: *mut siginfo_t, context: *mut c_void) {
    let Some(before) = before(signal) else {
        do_default(signal);
        return;
    };
    // Safety: the kernel would call it so.
    unsafe {
        if before.sa_flags & libc::SA_SIGINFO == 0 {
            let handler: extern "C" fn(c_int) = std::mem::transmute(before.sa_sigaction);
            handler(signal);
        } else {
            let handler: extern "C" fn(c_int, *mut siginfo_t, *mut c_void) =
                std::mem::transmute(before.sa_sigaction);
            handler(signal, info, context);
        }
    }
}

/// Stops the motors and stands until the process is continued. Another such signal meanwhile,
/// in another thread, would make it stand again thereafter.
fn stand(signal: c_int) {
    if !STANDS.swap(true, Ordering::AcqRel) {
        stand_alone(signal);
        STANDS.store(false, Ordering::Release);
    }
}

fn stand_alone(signal: c_int) {
    const SAID: &[u8] = b"% ev3dev: the motors were stopped while the program was suspended\n";
    let stopped = stop_for(Reason::Standing);
    let ours = action(signal);
    // Safety: what a handler may do. It is put back when the process has been continued.
    unsafe {
        let mask = {
            libc::signal(signal, libc::SIG_DFL);
            libc::raise(signal);
            unblock(signal)
        };
        libc::pthread_sigmask(libc::SIG_SETMASK, &raw const mask, null_mut());
        libc::sigaction(signal, &raw const ours, null_mut());
        if stopped {
            libc::write(libc::STDERR_FILENO, SAID.as_ptr().cast(), SAID.len());
        }
    }
    // What the driver knows of the motors has to follow.
    if !stopped || !events::send(events::CONTINUED, signal) {
        latch::lift(Reason::Standing);
    }
}
