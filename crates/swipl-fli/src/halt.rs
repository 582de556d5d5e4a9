//! What is done when Prolog halts for good.
use std::ffi::{c_int, c_void};
use std::sync::OnceLock;

static ACT: OnceLock<fn()> = OnceLock::new();

/// Calls `act` when Prolog halts, after all goals of `at_halt/1`, of which none has cancelled
/// that, and before the other threads are ended. The first `act` counts. It must not panic.
pub fn act_at_halt(act: fn()) {
    unsafe extern "C" {
        fn PL_on_halt(
            function: unsafe extern "C" fn(c_int, *mut c_void) -> c_int,
            argument: *mut c_void,
        );
    }
    if ACT.set(act).is_ok() {
        // Safety: as declared in every version.
        unsafe { PL_on_halt(halts, std::ptr::null_mut()) };
    }
}

unsafe extern "C" fn halts(_status: c_int, _argument: *mut c_void) -> c_int {
    if let Some(act) = ACT.get() {
        act();
    }
    0
}
