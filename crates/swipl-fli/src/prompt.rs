//! A hook for while Prolog waits for input at its terminal.
//!
//! There Prolog calls a hook again and again until there is input, in its main thread: while it
//! reads from a pipe, at a terminal, and with a line half typed by the libraries that edit lines.
//! The hook here waits for input for a moment, and then lets Prolog act if there is none. It
//! begins with the hook that it found.
use crate::functions::{
    PL_clear_exception, PL_cut_query, PL_discard_foreign_frame, PL_next_solution,
    PL_open_foreign_frame, PL_open_query,
};
use crate::types::{IOSTREAM, PL_Q_CATCH_EXCEPTION, predicate_t};
use crate::version::Version;
use std::ffi::{CStr, c_char, c_int};
use std::mem::transmute;
use std::ptr::null_mut;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// In versions that pass a descriptor it is an `int`, in others a stream.
type Hook = unsafe extern "C" fn(usize) -> c_int;

/// What the hook answers. Prolog looks for input itself.
const INPUT: c_int = 0;
const TIMEOUT: c_int = 1;

/// How long it waits for input, in milliseconds.
#[cfg(unix)]
const PAUSE_MS: c_int = 20;

/// What is done without input.
#[derive(Clone, Copy)]
pub struct Act {
    /// Whether it is time to act. It must not panic.
    pub is_due: fn() -> bool,
    /// A predicate without arguments, of a module.
    pub module: &'static CStr,
    pub name: &'static CStr,
}

static ACT: OnceLock<Act> = OnceLock::new();

/// The hook that was there before.
static BEFORE: AtomicUsize = AtomicUsize::new(0);

/// Whether the former hook is being called, and whether Prolog acts: both may read from the
/// terminal, and a hook that is installed later may call this one.
static IS_CHAINING: AtomicBool = AtomicBool::new(false);
static IS_ACTING: AtomicBool = AtomicBool::new(false);

/// From now on, acts while Prolog waits for input at its terminal. The first `act` counts. Another
/// call is of use if somebody has installed another hook meanwhile. To be called by Prolog's main
/// thread.
pub fn act_without_input(act: Act) {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_dispatch_hook(hook: Option<Hook>) -> Option<Hook>;
    }
    ACT.get_or_init(|| act);
    // Safety: Prolog calls the hook as described at `Hook`. It never goes away.
    let before =
        unsafe { PL_dispatch_hook(Some(hook)) }.map_or(0, |before| before as *const () as usize);
    if before != hook as *const () as usize {
        BEFORE.store(before, Ordering::Release);
    }
}

unsafe extern "C" fn hook(input: usize) -> c_int {
    let before = BEFORE.load(Ordering::Acquire);
    if before != 0 && !IS_CHAINING.swap(true, Ordering::AcqRel) {
        // Safety: a hook that Prolog had, called as Prolog does.
        unsafe { transmute::<usize, Hook>(before)(input) };
        IS_CHAINING.store(false, Ordering::Release);
    }
    // Safety: it is what Prolog has passed.
    if unsafe { has_input(descriptor(input)) } {
        return INPUT;
    }
    if let Some(act) = ACT.get().filter(|act| (act.is_due)()) {
        if !IS_ACTING.swap(true, Ordering::AcqRel) {
            // Safety: Prolog calls the hook in its main thread, where it may be called.
            unsafe { call(act) };
            IS_ACTING.store(false, Ordering::Release);
        }
    }
    TIMEOUT
}

/// The descriptor that Prolog waits for.
unsafe fn descriptor(input: usize) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn Sfileno(stream: *mut IOSTREAM) -> c_int;
    }
    if Version::running().dispatches_streams() {
        unsafe { Sfileno(input as *mut IOSTREAM) }
    } else {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "C passes an int in the low half"
        )]
        let descriptor = input as c_int;
        descriptor
    }
}

/// Waits for input, for a moment. Also if a signal has arrived there is none yet.
#[cfg(unix)]
unsafe fn has_input(descriptor: c_int) -> bool {
    let mut awaited = libc::pollfd { fd: descriptor, events: libc::POLLIN, revents: 0 };
    unsafe { libc::poll(&raw mut awaited, 1, PAUSE_MS) > 0 }
}

/// A page has no terminal.
#[cfg(not(unix))]
unsafe fn has_input(_descriptor: c_int) -> bool {
    false
}

/// Calls the predicate. An exception ends here.
unsafe fn call(act: &Act) {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_predicate(name: *const c_char, arity: c_int, module: *const c_char) -> predicate_t;
    }
    #[expect(clippy::cast_possible_wrap, reason = "a flag of few bits")]
    let flags = PL_Q_CATCH_EXCEPTION as c_int;
    unsafe {
        let frame = PL_open_foreign_frame();
        let predicate = PL_predicate(act.name.as_ptr(), 0, act.module.as_ptr());
        let query = PL_open_query(null_mut(), flags, predicate, 0);
        if query != 0 {
            PL_next_solution(query);
            PL_cut_query(query);
            PL_clear_exception();
        }
        PL_discard_foreign_frame(frame);
    }
}
