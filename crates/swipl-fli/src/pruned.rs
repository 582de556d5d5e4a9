//! Nondeterministic predicates before SWI-Prolog 8.1.30.
//!
//! There a predicate that throws, or fails, when it is called for another solution
//! is called once more, to give up the context that it has given up already: a
//! double free. So in those versions the contexts that Prolog has are known here, and
//! a predicate is called through a function that leaves out the call for any other.
use crate::functions::{PL_foreign_context_address, PL_foreign_control};
use crate::types::{PL_FA_NONDETERMINISTIC, control_t, foreign_t, pl_function_t, term_t};
use crate::version::{Version, bits};
use std::ffi::{c_char, c_int, c_void};
use std::mem::transmute;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The ways to call a predicate, in the numbers of every version.
const FIRST_CALL: c_int = 0;
const PRUNED: c_int = 1;

type Predicate = unsafe extern "C" fn(term_t, c_int, control_t) -> foreign_t;

/// The addresses of the contexts that Prolog has.
static CONTEXTS: Mutex<Vec<usize>> = Mutex::new(Vec::new());

/// How many predicates are called through [`THROUGH`], and which.
static COUNT: AtomicUsize = AtomicUsize::new(0);
static PREDICATES: [AtomicUsize; THROUGH.len()] = [const { AtomicUsize::new(0) }; THROUGH.len()];

macro_rules! functions {
    ($($number:literal)*) => { [$(through::<$number>),*] };
}

/// A function for each predicate.
static THROUGH: [Predicate; 64] = functions! {
    0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15
    16 17 18 19 20 21 22 23 24 25 26 27 28 29 30 31
    32 33 34 35 36 37 38 39 40 41 42 43 44 45 46 47
    48 49 50 51 52 53 54 55 56 57 58 59 60 61 62 63
};

unsafe extern "C" fn through<const NUMBER: usize>(
    terms: term_t,
    arity: c_int,
    control: control_t,
) -> foreign_t {
    // Safety: Prolog passes what the predicate takes; its address was stored before.
    unsafe {
        let kind = PL_foreign_control(control);
        if kind != FIRST_CALL {
            let is_known = take(PL_foreign_context_address(control) as usize);
            if kind == PRUNED && !is_known {
                return 1;
            }
        }
        let address = PREDICATES[NUMBER].load(Ordering::Acquire);
        transmute::<usize, Predicate>(address)(terms, arity, control)
    }
}

/// Registers a predicate; `meta` is its meta-predicate specification, or null.
pub unsafe fn PL_register_foreign_in_module(
    module: *const c_char,
    name: *const c_char,
    arity: c_int,
    function: pl_function_t,
    flags: c_int,
    meta: *const c_char,
) -> c_int {
    unsafe extern "C" {
        fn PL_register_foreign_in_module(
            module: *const c_char,
            name: *const c_char,
            arity: c_int,
            function: pl_function_t,
            flags: c_int,
            ...
        ) -> u8;
    }
    let is_nondeterministic = bits(flags) & PL_FA_NONDETERMINISTIC != 0;
    let function = if is_nondeterministic { guarded(function) } else { function };
    c_int::from(unsafe {
        PL_register_foreign_in_module(module, name, arity, function, flags, meta)
    })
}

/// What to register for a nondeterministic predicate of variable arity.
fn guarded(function: pl_function_t) -> pl_function_t {
    if !Version::running().prunes_twice() {
        return function;
    }
    let address = function? as usize;
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let Some((slot, through)) = PREDICATES.get(number).zip(THROUGH.get(number)) else {
        return function;
    };
    slot.store(address, Ordering::Release);
    // Safety: Prolog calls it as the flags say that it is registered with.
    Some(unsafe { transmute::<Predicate, unsafe extern "C" fn() -> foreign_t>(*through) })
}

/// Prolog is to have this context, until it calls the predicate again.
pub unsafe fn _PL_retry_address(address: *mut c_void) -> foreign_t {
    unsafe extern "C" {
        fn _PL_retry_address(address: *mut c_void) -> foreign_t;
    }
    if Version::running().prunes_twice() {
        contexts().push(address as usize);
    }
    unsafe { _PL_retry_address(address) }
}

/// Whether Prolog has this context. It has it no more.
fn take(address: usize) -> bool {
    let mut contexts = contexts();
    let place = contexts.iter().rposition(|context| *context == address);
    place.map(|place| contexts.swap_remove(place)).is_some()
}

fn contexts() -> MutexGuard<'static, Vec<usize>> {
    CONTEXTS.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_context_is_given_up_once() {
        contexts().extend([8, 16, 24]);
        assert!(take(16));
        assert!(!take(16));
        assert!(take(24) && take(8));
    }
}
