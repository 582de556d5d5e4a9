//! Functions that every version from 7.2 to 10 has.
//!
//! Three kinds, as the headers declare them: [`truth!`] declares those that answer `int` in old
//! versions and `bool` in new ones; [`translated!`] those that take or answer numbers which changed
//! ([`crate::version`]); the plain `extern` block those that are the same everywhere.
use crate::types::{
    BUF_DISCARDABLE, CVT_ATOM, IOSTREAM, PL_FLOAT, PL_INTEGER, PL_blob_t, PL_engine_t, PL_fid_t,
    REP_UTF8, atom_t, control_t, functor_t, module_t, predicate_t, qid_t, record_t, term_t,
};
use crate::version::Version;
use std::cell::Cell;
use std::ffi::{CStr, c_char, c_int, c_uchar, c_void};
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicU32, Ordering};

/// Declares functions whose result is a truth value: `int` in old headers, `bool` in new ones. A
/// `bool` leaves all but the low byte of the result register undefined, and an `int` that is 0 or 1
/// has its value there, so the low byte is right for both.
macro_rules! truth {
    ($($name:ident($($arg:ident: $type:ty),*);)*) => {$(
        #[inline]
        pub unsafe fn $name($($arg: $type),*) -> c_int {
            #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
            unsafe extern "C" {
                #[allow(clashing_extern_declarations, reason = "wrapped under its own name")]
                fn $name($($arg: $type),*) -> u8;
            }
            c_int::from(unsafe { $name($($arg),*) })
        }
    )*};
}

truth! {
    PL_current_prolog_flag(name: atom_t, kind: u32, value: *mut c_void);
    PL_get_arg(index: c_int, t: term_t, a: term_t);
    PL_get_atom(t: term_t, a: *mut atom_t);
    PL_get_blob(t: term_t, blob: *mut *mut c_void, len: *mut usize, kind: *mut *mut PL_blob_t);
    PL_get_bool(t: term_t, value: *mut c_int);
    PL_get_float(t: term_t, f: *mut f64);
    PL_get_int64(t: term_t, i: *mut i64);
    PL_get_list(l: term_t, h: term_t, t: term_t);
    PL_get_nil(l: term_t);
    PL_get_stream(t: term_t, s: *mut *mut IOSTREAM, flags: c_int);
    PL_get_string(t: term_t, s: *mut *mut c_char, len: *mut usize);
    PL_initialise(argc: c_int, argv: *mut *mut c_char);
    PL_is_atom(t: term_t);
    PL_is_blob(t: term_t, kind: *mut *mut PL_blob_t);
    PL_is_integer(t: term_t);
    PL_is_string(t: term_t);
    PL_is_variable(t: term_t);
    PL_predicate_info(p: predicate_t, name: *mut atom_t, arity: *mut usize, m: *mut module_t);
    PL_put_atom(t: term_t, a: atom_t);
    PL_put_blob(t: term_t, blob: *mut c_void, len: usize, kind: *mut PL_blob_t);
    PL_put_bool(t: term_t, value: c_int);
    PL_put_float(t: term_t, f: f64);
    PL_put_functor(t: term_t, f: functor_t);
    PL_put_int64(t: term_t, i: i64);
    PL_put_nil(l: term_t);
    PL_put_string_nchars(t: term_t, len: usize, chars: *const c_char);
    PL_put_term(t1: term_t, t2: term_t);
    PL_put_variable(t: term_t);
    PL_raise_exception(exception: term_t);
    PL_recorded(record: record_t, t: term_t);
    PL_release_stream(s: *mut IOSTREAM);
    PL_thread_destroy_engine();
    PL_unify(t1: term_t, t2: term_t);
    PL_unify_arg(index: usize, t: term_t, a: term_t);
    PL_unify_atom(t: term_t, a: atom_t);
    PL_unify_blob(t: term_t, blob: *mut c_void, len: usize, kind: *mut PL_blob_t);
    PL_unify_bool(t: term_t, n: c_int);
    PL_unify_compound(t: term_t, f: functor_t);
    PL_unify_float(t: term_t, f: f64);
    PL_unify_int64(t: term_t, i: i64);
    PL_unify_list(l: term_t, h: term_t, t: term_t);
    PL_unify_nil(l: term_t);
    PL_unify_string_nchars(t: term_t, len: usize, chars: *const c_char);
}

/// Whether there is a running Prolog to talk to. `swipl` asks before it touches anything, several
/// times a call; in a library that Prolog has loaded, once yes is always yes.
pub unsafe fn PL_is_initialised(count: *mut c_int, args: *mut *mut *mut c_char) -> c_int {
    static IS_INITIALISED: AtomicBool = AtomicBool::new(false);
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_is_initialised(argc: *mut c_int, argv: *mut *mut *mut c_char) -> u8;
    }
    if count.is_null() && args.is_null() && IS_INITIALISED.load(Ordering::Relaxed) {
        return 1;
    }
    let answer = unsafe { PL_is_initialised(count, args) };
    IS_INITIALISED.store(answer != 0, Ordering::Relaxed);
    c_int::from(answer)
}

/// Declares functions that take or answer numbers which not all versions share.
/// After `=>` comes the call, in which `version` is the running one.
macro_rules! translated {
    ($(fn $name:ident($($arg:ident: $type:ty),*) -> $c:ty
       => |$version:ident| ($($passed:expr),*) |$answer:ident| $result:expr;)*) => {$(
        #[inline]
        pub unsafe fn $name($($arg: $type),*) -> c_int {
            #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
            unsafe extern "C" {
                #[allow(clashing_extern_declarations, reason = "wrapped under its own name")]
                fn $name($($arg: $type),*) -> $c;
            }
            let $version = Version::running();
            let $answer = c_int::from(unsafe { $name($($passed),*) });
            $result
        }
    )*};
}

translated! {
    fn PL_unify_chars(t: term_t, flags: c_int, len: usize, s: *const c_char) -> u8
        => |version| (t, version.typed_text_flags(flags), len, s) |answer| answer;
    fn PL_term_type(t: term_t) -> c_int
        => |version| (t) |answer| version.type_from(answer);
}

/// The text of a term, if it is one for Rust: an atom may have half of a surrogate pair, and
/// `swipl` panics at that.
pub unsafe fn PL_get_nchars(t: term_t, len: *mut usize, s: *mut *mut c_char, flags: u32) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_get_nchars(t: term_t, len: *mut usize, s: *mut *mut c_char, flags: u32) -> u8;
    }
    unsafe {
        let has_text = PL_get_nchars(t, len, s, Version::running().text_flags(flags)) != 0;
        let is_text = |bytes| std::str::from_utf8(bytes).is_ok();
        c_int::from(has_text && is_text(std::slice::from_raw_parts((*s).cast(), *len)))
    }
}

/// Whether an atom has a text. The name of a dict has none, nor a blob.
unsafe fn is_text(atom: atom_t) -> bool {
    let (mut len, mut s) = (0, std::ptr::null_mut());
    unsafe {
        let t = PL_new_term_ref();
        PL_put_atom(t, atom);
        let flags = CVT_ATOM | REP_UTF8 | BUF_DISCARDABLE;
        let is_text = PL_get_nchars(t, &raw mut len, &raw mut s, flags) != 0;
        PL_reset_term_refs(t);
        is_text
    }
}

/// The name and arity of a compound term. If the name is asked for, it must be a text: `swipl` panics
/// at any other. Prolog keeps each text until a native call ends, and at most a million of them.
pub unsafe fn PL_get_compound_name_arity(t: term_t, name: *mut atom_t, arity: *mut usize) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_get_compound_name_arity(t: term_t, name: *mut atom_t, arity: *mut usize) -> u8;
    }
    let mut its_name = 0;
    unsafe {
        let is_compound = PL_get_compound_name_arity(t, &raw mut its_name, arity) != 0;
        if !name.is_null() {
            *name = its_name;
        }
        c_int::from(is_compound && (name.is_null() || is_text(its_name)))
    }
}

/// The functor of a term, if its name is a text, as above.
pub unsafe fn PL_get_functor(t: term_t, f: *mut functor_t) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_get_functor(t: term_t, f: *mut functor_t) -> u8;
    }
    unsafe { c_int::from(PL_get_functor(t, f) != 0 && is_text(PL_functor_name(*f))) }
}

/// Puts into `end` what follows the elements of a list: `[]`, if it is one.
pub unsafe fn list_end(list: term_t, end: term_t) {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_skip_list(list: term_t, end: term_t, len: *mut usize) -> c_int;
    }
    unsafe { PL_skip_list(list, end, std::ptr::null_mut()) };
}

/// Puts text into a term. Version 7.2 has no such function; what it does is this.
pub unsafe fn PL_put_chars(t: term_t, flags: c_int, len: usize, s: *const c_char) -> c_int {
    unsafe {
        PL_put_variable(t);
        PL_unify_chars(t, flags, len, s)
    }
}

/// The atom that a term is, if it is one.
pub unsafe fn atom_in(t: term_t) -> Option<atom_t> {
    let mut atom = 0;
    unsafe { (PL_get_atom(t, &raw mut atom) != 0).then_some(atom) }
}

/// The integer that a term is, if it is one of at most 64 bits; no float.
pub unsafe fn integer_in(t: term_t) -> Option<i64> {
    let mut integer = 0;
    unsafe { (PL_is_integer(t) != 0 && PL_get_int64(t, &raw mut integer) != 0).then_some(integer) }
}

/// The atom that a term is, if it is one. None of the functions raises an exception, so
/// that it need not be asked for, as `swipl` does.
#[macro_export]
macro_rules! atom_in {
    ($term:expr) => {{
        let term = $term;
        term.assert_term_handling_possible();
        // Safety: the term is one of the engine that runs, as was just made sure.
        unsafe { $crate::functions::atom_in(term.term_ptr()) }
    }};
}

/// The integer that a term is, if it is one of at most 64 bits. Makes sure of the engine once.
#[macro_export]
macro_rules! integer_in {
    ($term:expr) => {{
        let term = $term;
        term.assert_term_handling_possible();
        // Safety: the term is one of the engine that runs, as was just made sure.
        unsafe { $crate::functions::integer_in(term.term_ptr()) }
    }};
}

/// Puts into a term what follows the elements of a list, see [`list_end`](fn@list_end).
#[macro_export]
macro_rules! list_end {
    ($list:expr, $end:expr) => {{
        let (list, end) = ($list, $end);
        list.assert_term_handling_possible();
        end.assert_term_handling_possible();
        // Safety: the terms are of the engine that runs, as was just made sure.
        unsafe { $crate::functions::list_end(list.term_ptr(), end.term_ptr()) }
    }};
}

#[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
unsafe extern "C" {
    // Atoms, functors, modules, predicates
    pub fn PL_register_atom(a: atom_t);
    pub fn PL_unregister_atom(a: atom_t);
    pub fn PL_new_atom(s: *const c_char) -> atom_t;
    pub fn PL_new_functor(name: atom_t, arity: usize) -> functor_t;
    pub fn PL_functor_name(f: functor_t) -> atom_t;
    pub fn PL_functor_arity(f: functor_t) -> c_int;
    pub fn PL_new_module(name: atom_t) -> module_t;
    pub fn PL_module_name(m: module_t) -> atom_t;
    pub fn PL_pred(f: functor_t, m: module_t) -> predicate_t;
    pub fn PL_blob_data(a: atom_t, len: *mut usize, kind: *mut *mut PL_blob_t) -> *mut c_void;

    // Terms
    pub fn PL_copy_term_ref(from: term_t) -> term_t;
    pub fn PL_new_term_ref() -> term_t;
    pub fn PL_new_term_refs(n: usize) -> term_t;
    pub fn PL_reset_term_refs(t: term_t);
    pub fn PL_compare(t1: term_t, t2: term_t) -> c_int;
    pub fn PL_record(t: term_t) -> record_t;
    pub fn PL_erase(record: record_t);

    // Frames, exceptions, signals
    pub fn PL_open_foreign_frame() -> PL_fid_t;
    pub fn PL_close_foreign_frame(frame: PL_fid_t);
    pub fn PL_discard_foreign_frame(frame: PL_fid_t);
    pub fn PL_rewind_foreign_frame(frame: PL_fid_t);
    pub fn PL_clear_exception();
    pub fn PL_handle_signals() -> c_int;

    // Foreign predicates
    pub fn PL_foreign_control(control: control_t) -> c_int;
    pub fn PL_foreign_context_address(control: control_t) -> *mut c_void;

    // Threads
    pub fn PL_thread_attach_engine(attributes: *mut c_void) -> c_int;
    pub fn PL_thread_self() -> c_int;
    pub fn PL_unify_thread_id(t: term_t, thread: c_int) -> c_int;

    // Streams
    pub fn _PL_streams() -> *mut *mut IOSTREAM;
    pub fn Sclearerr(s: *mut IOSTREAM);
    pub fn Sferror(s: *mut IOSTREAM) -> c_int;
    pub fn Sflush(s: *mut IOSTREAM) -> c_int;
    pub fn Sfputs(q: *const c_char, s: *mut IOSTREAM) -> c_int;
    pub fn Sfread(data: *mut c_void, size: usize, elems: usize, s: *mut IOSTREAM) -> usize;
    pub fn Sfwrite(data: *const c_void, size: usize, elems: usize, s: *mut IOSTREAM) -> usize;
}

/// Stands for whichever engine the thread has that asks.
const CURRENT: PL_engine_t = 2 as PL_engine_t;

/// How many engines of this library there are, each for the thread that has made it.
static ENGINES: AtomicU32 = AtomicU32::new(0);

thread_local! {
    /// Whether this thread has made one.
    static HAS_MADE_ENGINE: Cell<bool> = const { Cell::new(false) };
}

pub unsafe fn PL_create_engine(attributes: *mut c_void) -> PL_engine_t {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_create_engine(attributes: *mut c_void) -> PL_engine_t;
    }
    ENGINES.fetch_add(1, Ordering::Relaxed);
    HAS_MADE_ENGINE.set(true);
    unsafe { PL_create_engine(attributes) }
}

pub unsafe fn PL_destroy_engine(engine: PL_engine_t) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_destroy_engine(engine: PL_engine_t) -> u8;
    }
    // None was made: Prolog halts.
    let is_destroyed = engine.is_null() || unsafe { PL_destroy_engine(engine) != 0 };
    HAS_MADE_ENGINE.set(false);
    ENGINES.fetch_sub(1, Ordering::Relaxed);
    c_int::from(is_destroyed)
}

/// Makes an engine that of this thread, or asks for it. `swipl` asks at each step, to make
/// sure that a term is of the engine that runs. In a thread of Prolog's it always is, as no
/// term goes to another thread: such a thread gets a name for its engine, the same in all.
pub unsafe fn PL_set_engine(engine: PL_engine_t, old: *mut PL_engine_t) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_set_engine(engine: PL_engine_t, old: *mut PL_engine_t) -> c_int;
    }
    let is_prologs = || ENGINES.load(Ordering::Relaxed) == 0 || !HAS_MADE_ENGINE.get();
    if engine == CURRENT && !old.is_null() && is_prologs() {
        unsafe { *old = CURRENT };
        return 0; // PL_ENGINE_SET
    }
    unsafe { PL_set_engine(engine, old) }
}

/// The threads that [`has_other_threads`] passes over, by their numbers, as bits. Those with
/// higher numbers are never passed over.
static PASSED_OVER: [AtomicU32; 32] = [const { AtomicU32::new(0) }; 32];

/// Makes [`has_other_threads`] pass over a thread of Prolog, or count it again.
pub fn pass_over_thread(thread: i32, passes: bool) {
    let Ok(number) = usize::try_from(thread) else {
        return;
    };
    if let Some(bits) = PASSED_OVER.get(number / 32) {
        let bit = 1 << (number % 32);
        if passes {
            bits.fetch_or(bit, Ordering::Relaxed);
        } else {
            bits.fetch_and(!bit, Ordering::Relaxed);
        }
    }
}

/// Whether [`has_other_threads`] passes over a thread.
fn is_passed_over(thread: i32) -> bool {
    let number = usize::try_from(thread).unwrap_or(usize::MAX);
    let bits = PASSED_OVER.get(number / 32).map_or(0, |bits| bits.load(Ordering::Relaxed));
    bits >> (number % 32) & 1 == 1
}

/// Whether this is the thread that collects Prolog's garbage since version 7.7, by its alias.
///
/// # Safety
/// The term must be valid.
unsafe fn is_collector(id: term_t) -> bool {
    const ALIAS: &[u8] = b"gc";
    let mut length = 0;
    // Safety: an atom has its bytes for as long as a term has it.
    unsafe {
        atom_in(id).is_some_and(|alias| {
            let bytes = PL_blob_data(alias, &raw mut length, std::ptr::null_mut()).cast::<u8>();
            !bytes.is_null() && std::slice::from_raw_parts(bytes, length) == ALIAS
        })
    }
}

/// The value of a flag of Prolog, as this thread of Prolog has it, if it is an integer.
pub fn integer_flag(name: &CStr) -> Option<i64> {
    let mut value = 0_i64;
    // Safety: an integer flag is written as 64 bits. The atom has a reference for that long.
    unsafe {
        let atom = PL_new_atom(name.as_ptr());
        let is_integer = PL_current_prolog_flag(atom, PL_INTEGER, (&raw mut value).cast());
        PL_unregister_atom(atom);
        (is_integer != 0).then_some(value)
    }
}

/// The value of a flag of Prolog that is a number.
pub fn number_flag(name: &CStr) -> Option<f64> {
    let kind = Version::running().kind(PL_FLOAT);
    let mut value = 0_f64;
    // Safety: a float is written as 64 bits. The atom has a reference for that long.
    let is_float = unsafe {
        let atom = PL_new_atom(name.as_ptr());
        let is_float = PL_current_prolog_flag(atom, kind, (&raw mut value).cast());
        PL_unregister_atom(atom);
        is_float != 0
    };
    #[expect(clippy::cast_precision_loss, reason = "a flag is no such number")]
    if is_float { Some(value) } else { integer_flag(name).map(|integer| integer as f64) }
}

/// The number of this thread of Prolog.
pub fn this_thread() -> i32 {
    // Safety: asks only.
    unsafe { PL_thread_self() }
}

/// Whether Prolog has threads besides the one that asks, which is one of Prolog's, and the one
/// that collects its garbage.
pub fn has_other_threads() -> bool {
    /// The highest number of a thread so far. Prolog gives a new thread a free one, or the next.
    static HIGHEST: AtomicI32 = AtomicI32::new(1);
    /// How many numbers above the highest are asked for: a thread that has one, and is not a
    /// thread of Prolog yet, hides those behind it. That which collects garbage begins so.
    const AHEAD: i32 = 8;
    // Safety: the frame gives back the references. If there is no thread, `id` stays unbound.
    unsafe {
        if PL_thread_self() != 1 {
            return true;
        }
        let frame = PL_open_foreign_frame();
        let mut id = PL_new_term_ref();
        let (mut others, mut thread) = (false, 2);
        let mut last = HIGHEST.load(Ordering::Relaxed).saturating_add(AHEAD);
        while thread <= last {
            if PL_unify_thread_id(id, thread) != -1 {
                others |= !is_passed_over(thread) && !is_collector(id);
                HIGHEST.fetch_max(thread, Ordering::Relaxed);
                last = last.max(thread.saturating_add(AHEAD));
                id = PL_new_term_ref();
            }
            thread += 1;
        }
        PL_discard_foreign_frame(frame);
        others
    }
}

/// Declares functions that take a query, narrowing it to what C expects. (Before version 8,
/// `PL_close_query` and `PL_cut_query` answer nothing: `swipl` does not look at their results.)
macro_rules! of_query {
    ($($name:ident -> $result:ty;)*) => {$(
        #[inline]
        pub unsafe fn $name(query: qid_t) -> $result {
            #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
            unsafe extern "C" {
                fn $name(query: usize) -> $result;
            }
            unsafe { $name(narrow(query)) }
        }
    )*};
}

of_query! {
    PL_close_query -> c_int;
    PL_cut_query -> c_int;
    PL_exception -> term_t;
}

/// The next solution: -1 for an exception, 0 for failure, 1 if there may be more,
/// 2 if not. Versions without `PL_Q_EXT_STATUS` answer 0 and 1 only.
pub unsafe fn PL_next_solution(query: qid_t) -> c_int {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_next_solution(query: usize) -> c_int;
    }
    let status = unsafe { PL_next_solution(narrow(query)) };
    if Version::running().has_extended_status() || status != 0 {
        return status;
    }
    if unsafe { PL_exception(query) } == 0 { 0 } else { -1 }
}

pub unsafe fn PL_open_query(m: module_t, flags: c_int, pred: predicate_t, t0: term_t) -> qid_t {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_open_query(m: module_t, flags: c_int, pred: predicate_t, t0: term_t) -> usize;
    }
    let flags = Version::running().query_flags(flags);
    unsafe { PL_open_query(m, flags, pred, t0) as qid_t }
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "a query is as wide as a pointer; it was widened by PL_open_query"
)]
fn narrow(query: qid_t) -> usize {
    query as usize
}

/// Bytes of a saved state, as `PL_set_resource_db_mem` takes them.
pub(crate) type ResourceData = *const c_uchar;
