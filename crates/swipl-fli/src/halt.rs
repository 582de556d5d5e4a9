//! Functions that Prolog calls when it halts for good.
use std::ffi::{c_int, c_void};
use std::sync::OnceLock;

static ACT: OnceLock<fn()> = OnceLock::new();

/// Calls `act` when Prolog halts, after all goals of `at_halt/1`, of which none has canceled
/// that, and before the other threads are ended. The first `act` counts. It must not panic.
/// What was registered last is called first: one called in `at_halt/1` comes before the hooks of
/// other libraries, of which that of library(time) may hang.
pub fn act_at_halt(act: fn()) {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_on_halt(
            function: unsafe extern "C" fn(c_int, *mut c_void) -> c_int,
            argument: *mut c_void,
        );
    }
    ACT.get_or_init(|| act);
    // Safety: as declared in every version.
    unsafe { PL_on_halt(halts, std::ptr::null_mut()) };
}

unsafe extern "C" fn halts(_status: c_int, _argument: *mut c_void) -> c_int {
    if let Some(act) = ACT.get() {
        act();
    }
    0
}
