//! A test whether the thread that has crashed is still in the handler.
//!
//! The handler of a crash returns, or Prolog leaves it by longjmp and goes on, or it waits for
//! ever, as one that writes the stack down while another thread has the allocator's lock. The
//! thread itself knows: it is asked by a signal that is handled on the stack where it is.
use crate::stack::SIZE;
use nix::errno::Errno;
use nix::libc::{self, c_int};
use std::mem::zeroed;
use std::ptr::{null, null_mut};
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicPtr, AtomicU8, AtomicU32, Ordering};

/// A signal that does nothing by itself.
const QUESTION: c_int = libc::SIGURG;

// The last crash: its number, its signal, its thread, the mark in the frame of the handler,
// which has that number, and whether that is on a stack for handlers only.
static NUMBER: AtomicU32 = AtomicU32::new(0);
static SIGNAL: AtomicI32 = AtomicI32::new(0);
static THREAD: AtomicI32 = AtomicI32::new(0);
static MARK: AtomicPtr<AtomicU32> = AtomicPtr::new(null_mut());
static IS_APART: AtomicBool = AtomicBool::new(false);

/// What the thread said.
static ANSWER: AtomicU8 = AtomicU8::new(NONE);
const NONE: u8 = 0;
const IS_IN: u8 = 1;
const IS_OUT: u8 = 2;

/// A handler on a stack of its own is not deeper than that; another stack is further away. It may
/// be deeper than that of another thread, for which SWI-Prolog 9.2 takes 8 kB.
const NEAR: usize = SIZE;

/// How long to wait for it, in steps.
const STEP_NS: libc::c_long = 200_000;
const STEPS: usize = 50;

/// A crash begins in this thread; `mark` lies in the frame of its handler.
pub(crate) fn begins(signal: c_int, mark: &AtomicU32) {
    let number = NUMBER.fetch_add(1, Ordering::AcqRel).wrapping_add(1);
    mark.store(number, Ordering::Relaxed);
    MARK.store(std::ptr::from_ref(mark).cast_mut(), Ordering::Relaxed);
    IS_APART.store(is_apart(), Ordering::Relaxed);
    SIGNAL.store(signal, Ordering::Relaxed);
    // Safety: asks only.
    let thread = unsafe { libc::syscall(libc::SYS_gettid) };
    THREAD.store(c_int::try_from(thread).unwrap_or_default(), Ordering::Release);
}

/// Its number, and its signal.
pub(crate) fn last() -> (u32, c_int) {
    (NUMBER.load(Ordering::Acquire), SIGNAL.load(Ordering::Relaxed))
}

/// Asks the thread of the last crash whether it is in its handler; `None` if it does not say so
/// within 10 ms, as one that takes no signal.
pub(crate) fn is_in_handler() -> Option<bool> {
    ANSWER.store(NONE, Ordering::Release);
    // Safety: the handler does only what may be done in one. Without SA_ONSTACK it runs where
    // the thread is.
    unsafe {
        let mut before: libc::sigaction = zeroed();
        let mut ours: libc::sigaction = zeroed();
        ours.sa_sigaction = say as *const () as usize;
        ours.sa_flags = libc::SA_RESTART;
        libc::sigaction(QUESTION, &raw const ours, &raw mut before);
        let thread = THREAD.load(Ordering::Acquire);
        let is_there = libc::syscall(libc::SYS_tgkill, libc::getpid(), thread, QUESTION) == 0;
        let step = libc::timespec { tv_sec: 0, tv_nsec: STEP_NS };
        let is_silent = || is_there && ANSWER.load(Ordering::Acquire) == NONE;
        for _ in (0..STEPS).take_while(|_| is_silent()) {
            libc::nanosleep(&raw const step, null_mut());
        }
        libc::sigaction(QUESTION, &raw const before, null_mut());
        (!is_silent()).then(|| ANSWER.load(Ordering::Acquire) == IS_IN)
    }
}

extern "C" fn say(_: c_int) {
    let errno = Errno::last();
    let here = AtomicU32::new(0);
    let mark = MARK.load(Ordering::Relaxed);
    let depth = mark.addr().checked_sub((&raw const here).addr());
    let is_deeper = |depth: usize| {
        if IS_APART.load(Ordering::Relaxed) { depth < NEAR } else { !is_apart() }
    };
    let is_in = depth.is_some_and(is_deeper)
        // Safety: it is further up on the stack where this is, whatever is there now.
        && unsafe { &*mark }.load(Ordering::Relaxed) == NUMBER.load(Ordering::Relaxed);
    ANSWER.store(if is_in { IS_IN } else { IS_OUT }, Ordering::Release);
    errno.set();
}

/// Whether this runs on a stack for handlers only.
fn is_apart() -> bool {
    // Safety: asks only.
    unsafe {
        let mut stack: libc::stack_t = zeroed();
        libc::sigaltstack(null(), &raw mut stack);
        stack.ss_flags & libc::SS_ONSTACK != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::hint::black_box;
    use std::sync::mpsc::{Receiver, Sender, channel};
    use std::time::{Duration, Instant};

    #[test]
    fn a_thread_says_whether_it_is_in_the_handler() {
        static ELSEWHERE: AtomicU32 = AtomicU32::new(0);
        let (at, is_at) = channel();
        let (go_on, goes_on) = channel();
        let thread = std::thread::spawn(move || {
            handler(&at, &goes_on);
            deeper::<8>(&at, &goes_on);
            begins(libc::SIGBUS, &ELSEWHERE);
            deeper::<8>(&at, &goes_on);
        });
        let says = |expected| {
            let end = Instant::now() + Duration::from_secs(300);
            let answers = std::iter::repeat_with(is_in_handler);
            let mut answers = answers.take_while(|_| Instant::now() < end);
            assert_eq!(answers.find_map(|answer| answer), Some(expected));
        };
        is_at.recv().unwrap();
        assert_eq!(last().1, libc::SIGSEGV);
        says(true);
        IS_APART.store(true, Ordering::Relaxed);
        says(true); // deeper than the stack apart, but near
        go_on.send(()).unwrap();
        is_at.recv().unwrap();
        says(false); // on another stack
        IS_APART.store(false, Ordering::Relaxed);
        says(true);
        for _ in 0..2 {
            go_on.send(()).unwrap();
            is_at.recv().unwrap();
            says(false);
        }
        go_on.send(()).unwrap();
        thread.join().unwrap();
        says(false); // the thread has gone
    }

    fn handler(at: &Sender<()>, goes_on: &Receiver<()>) {
        let mark = AtomicU32::new(0);
        begins(libc::SIGSEGV, black_box(&mark));
        at.send(()).unwrap();
        goes_on.recv().unwrap();
        deeper::<256>(at, goes_on);
        // As the frames of others would.
        mark.store(0, Ordering::Relaxed);
    }

    /// Deeper in the stack than the handler was, by a number of kB.
    fn deeper<const KB: usize>(at: &Sender<()>, goes_on: &Receiver<()>) {
        let room = black_box([[0_u8; 1024]; KB]);
        at.send(()).unwrap();
        goes_on.recv().unwrap();
        black_box(room);
    }
}
