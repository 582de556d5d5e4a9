//! The steps before a predicate is called.
//!
//! *Nondeterministic predicates before SWI-Prolog 8.1.30.* There a predicate that throws, or fails,
//! when it is called for another solution is called once more, to give up the context that it has
//! given up already: a double free. So in those versions the contexts that Prolog has are known
//! here, and a predicate is called through a function that leaves out the call for any other.
//!
//! *Answers at once.* The few predicates that a robot calls thousands of times a second may
//! have a [`Quick`] function, which answers the common calls. It does without the care of
//! `swipl`, which costs more than reading a sensor.
use crate::functions::{
    PL_foreign_context_address, PL_foreign_control, PL_get_float, PL_is_variable, PL_unify_atom,
    PL_unify_float, PL_unify_int64, atom_in,
};
use crate::types::{PL_FA_NONDETERMINISTIC, atom_t, control_t, foreign_t, pl_function_t, term_t};
use crate::version::{Version, bits};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::mem::transmute;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

/// The ways to call a predicate, in the numbers of every version.
const FIRST_CALL: c_int = 0;
const PRUNED: c_int = 1;

type Predicate = unsafe extern "C" fn(term_t, c_int, control_t) -> foreign_t;

/// The addresses of the contexts that Prolog has.
static CONTEXTS: Mutex<Vec<usize>> = Mutex::new(Vec::new());

/// A predicate that is called through one of [`THROUGH`].
struct Called {
    predicate: Predicate,
    quick: Option<Quick>,
    /// Whether it is nondeterministic, and Prolog's version one that prunes twice.
    is_nondeterministic: bool,
    prunes_twice: bool,
}

static COUNT: AtomicUsize = AtomicUsize::new(0);
static CALLED: [OnceLock<Called>; THROUGH.len()] = [const { OnceLock::new() }; THROUGH.len()];

/// Answers a call, whether it succeeds; `None` where the predicate itself is to be called.
pub type Quick = fn(&Arguments) -> Option<bool>;

/// The quick functions, by name and arity.
static QUICK: Mutex<Vec<(&str, usize, Quick)>> = Mutex::new(Vec::new());

/// Has a function answer the calls of a predicate that is registered later.
pub fn answer_quickly(name: &'static str, arity: usize, quick: Quick) {
    QUICK.lock().unwrap_or_else(PoisonError::into_inner).push((name, arity, quick));
}

/// The arguments of a call, by their numbers from 0 on.
pub struct Arguments {
    first: term_t,
    count: usize,
}

impl Arguments {
    fn term(&self, number: usize) -> term_t {
        assert!(number < self.count, "no such argument");
        self.first + number
    }

    /// The atom that it is, by its handle.
    #[inline]
    pub fn atom(&self, number: usize) -> Option<atom_t> {
        // Safety: Prolog has passed that term to this thread.
        unsafe { atom_in(self.term(number)) }
    }

    /// Whether it is unbound.
    #[inline]
    pub fn is_variable(&self, number: usize) -> bool {
        // Safety: as above.
        unsafe { PL_is_variable(self.term(number)) != 0 }
    }

    /// The number that it is, if a float has it.
    #[inline]
    pub fn float(&self, number: usize) -> Option<f64> {
        let mut float = 0.0;
        // Safety: as above.
        (unsafe { PL_get_float(self.term(number), &raw mut float) } != 0).then_some(float)
    }

    /// Unifies it with an integer.
    #[inline]
    pub fn unify_integer(&self, number: usize, integer: i64) -> bool {
        // Safety: as above.
        unsafe { PL_unify_int64(self.term(number), integer) != 0 }
    }

    /// Unifies it with a float.
    #[inline]
    pub fn unify_float(&self, number: usize, float: f64) -> bool {
        // Safety: as above.
        unsafe { PL_unify_float(self.term(number), float) != 0 }
    }

    /// Unifies it with an atom that is there for good.
    #[inline]
    pub fn unify_atom(&self, number: usize, atom: atom_t) -> bool {
        // Safety: as above.
        unsafe { PL_unify_atom(self.term(number), atom) != 0 }
    }
}

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
    // Safety: Prolog passes what the predicate takes.
    CALLED[NUMBER].get().map_or(0, |called| unsafe { called.call(terms, arity, control) })
}

impl Called {
    // Once, and not in each function of `THROUGH`
    #[inline(never)]
    unsafe fn call(&self, terms: term_t, arity: c_int, control: control_t) -> foreign_t {
        // Safety: as in `through`.
        unsafe {
            let kind =
                if self.is_nondeterministic { PL_foreign_control(control) } else { FIRST_CALL };
            if kind != FIRST_CALL {
                let is_known =
                    !self.prunes_twice || take(PL_foreign_context_address(control) as usize);
                if kind == PRUNED && !is_known {
                    return 1;
                }
            } else if let Some(quick) = self.quick {
                let arguments = Arguments { first: terms, count: arity.try_into().unwrap_or(0) };
                // After a panic the predicate itself is called, which reports its own to Prolog.
                let answer = catch_unwind(AssertUnwindSafe(|| quick(&arguments)));
                if let Ok(Some(is_true)) = answer {
                    return is_true.into();
                }
            }
            (self.predicate)(terms, arity, control)
        }
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
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
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
    let quick = unsafe { quick_of(name, arity) };
    let function = guarded(function, is_nondeterministic, quick);
    c_int::from(unsafe {
        PL_register_foreign_in_module(module, name, arity, function, flags, meta)
    })
}

/// The quick function of a predicate.
unsafe fn quick_of(name: *const c_char, arity: c_int) -> Option<Quick> {
    // Safety: a name as Prolog takes it.
    let name = unsafe { CStr::from_ptr(name) }.to_str().ok()?;
    let arity = usize::try_from(arity).ok()?;
    let known = QUICK.lock().unwrap_or_else(PoisonError::into_inner);
    known.iter().find(|quick| (quick.0, quick.1) == (name, arity)).map(|quick| quick.2)
}

/// What to register for a predicate of variable arity.
fn guarded(
    function: pl_function_t,
    is_nondeterministic: bool,
    quick: Option<Quick>,
) -> pl_function_t {
    let prunes_twice = is_nondeterministic && Version::running().prunes_twice();
    if !prunes_twice && quick.is_none() {
        return function;
    }
    // Safety: all predicates of `swipl` are called so.
    let predicate =
        unsafe { transmute::<unsafe extern "C" fn() -> foreign_t, Predicate>(function?) };
    let number = COUNT.fetch_add(1, Ordering::Relaxed);
    let Some((slot, through)) = CALLED.get(number).zip(THROUGH.get(number)) else {
        return function;
    };
    let _ = slot.set(Called { predicate, quick, is_nondeterministic, prunes_twice });
    // Safety: Prolog calls it as the flags say that it is registered with.
    Some(unsafe { transmute::<Predicate, unsafe extern "C" fn() -> foreign_t>(*through) })
}

/// Prolog is to have this context, until it calls the predicate again.
pub unsafe fn _PL_retry_address(address: *mut c_void) -> foreign_t {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
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
