//! Functions that SWI-Prolog 7.2 lacks, looked up when first used.
//!
//! A library that names a missing function does not load at all, so these are found by
//! name at run time. If a function is missing, another one replaces it if possible;
//! else the call returns 0, "failed".
use crate::functions::{
    PL_get_int64, PL_new_term_ref, PL_put_int64, PL_record, PL_recorded, PL_reset_term_refs,
    PL_unify_int64, ResourceData,
};
use crate::types::{atom_t, record_t, term_t};
use std::ffi::{CStr, c_char, c_int, c_void};
use std::mem::transmute;
use std::ptr::null_mut;
use std::sync::OnceLock;

/// Address of the function, or 0 in a version that lacks it.
#[cfg(unix)]
fn look_up(name: &CStr) -> usize {
    // Safety: a null-terminated name, and a handle that is always valid.
    unsafe { libc::dlsym(libc::RTLD_DEFAULT, name.as_ptr()) as usize }
}

/// The same: the place that the loader gives it in the table of functions.
#[cfg(not(unix))]
fn look_up(name: &CStr) -> usize {
    #[link(wasm_import_module = "host")]
    unsafe extern "C" {
        fn look_up(name: *const c_char) -> usize;
    }
    // Safety: a null-terminated name.
    unsafe { look_up(name.as_ptr()) }
}

/// C's wide character.
#[cfg(unix)]
type Wide = libc::wchar_t;
#[cfg(not(unix))]
type Wide = c_int;

/// Declares a function that is looked up at its first call. After `=>`
/// comes what is done in versions without it.
macro_rules! late {
    ($($symbol:literal fn $name:ident($($arg:ident: $type:ty),*) -> $result:ty as $c:ty
       => $fallback:expr;)*) => {$(
        pub unsafe fn $name($($arg: $type),*) -> $result {
            static ADDRESS: OnceLock<usize> = OnceLock::new();
            match *ADDRESS.get_or_init(|| look_up($symbol)) {
                0 => $fallback,
                address => {
                    // Safety: SWI-Prolog's function of that name has this type.
                    let function: unsafe extern "C" fn($($type),*) -> $c =
                        unsafe { transmute(address) };
                    unsafe { function($($arg),*) }.into()
                }
            }
        }
    )*};
}

late! {
    c"PL_new_atom_mbchars" fn PL_new_atom_mbchars(rep: c_int, len: usize, s: *const c_char)
        -> atom_t as atom_t
        => unsafe { atom_from_utf8(len, s) };
    c"PL_cvt_i_uint64" fn PL_cvt_i_uint64(t: term_t, c: *mut u64) -> c_int as u8
        => unsafe { unsigned_from_signed(t, c) };
    c"PL_unify_uint64" fn PL_unify_uint64(t: term_t, value: u64) -> c_int as u8
        => i64::try_from(value).map_or(0, |value| unsafe { PL_unify_int64(t, value) });
    c"PL_put_uint64" fn PL_put_uint64(t: term_t, value: u64) -> c_int as u8
        => i64::try_from(value).map_or(0, |value| unsafe { PL_put_int64(t, value) });
    c"PL_is_dict" fn PL_is_dict(t: term_t) -> c_int as u8
        => { let _ = t; 0 };
    c"PL_put_dict" fn PL_put_dict(t: term_t, tag: atom_t, len: usize, keys: *const atom_t,
                                  values: term_t) -> c_int as u8
        => { let _ = (t, tag, len, keys, values); 0 };
    c"PL_get_dict_key" fn PL_get_dict_key(key: atom_t, dict: term_t, value: term_t) -> c_int as u8
        => { let _ = (key, dict, value); 0 };
    c"PL_duplicate_record" fn PL_duplicate_record(r: record_t) -> record_t as record_t
        => unsafe { record_again(r) };
    c"PL_set_resource_db_mem" fn PL_set_resource_db_mem(data: ResourceData, size: usize)
        -> c_int as u8
        => { let _ = (data, size); 0 };
}

/// An atom from UTF-8 text by the wide-character function, which 7.2 has.
unsafe fn atom_from_utf8(len: usize, s: *const c_char) -> atom_t {
    #[cfg_attr(target_family = "wasm", link(wasm_import_module = "swipl"))]
    unsafe extern "C" {
        fn PL_new_atom_wchars(len: usize, s: *const Wide) -> atom_t;
    }
    // Safety: `swipl` passes `len` bytes of a `&str`.
    let bytes = unsafe { std::slice::from_raw_parts(s.cast::<u8>(), len) };
    let wide: Vec<Wide> = String::from_utf8_lossy(bytes)
        .chars()
        .map(|c| Wide::from_ne_bytes(u32::from(c).to_ne_bytes()))
        .collect();
    unsafe { PL_new_atom_wchars(wide.len(), wide.as_ptr()) }
}

unsafe fn unsigned_from_signed(t: term_t, c: *mut u64) -> c_int {
    let mut signed = 0;
    if unsafe { PL_get_int64(t, &raw mut signed) } == 0 {
        return 0;
    }
    u64::try_from(signed).map_or(0, |value| {
        unsafe { *c = value };
        1
    })
}

unsafe fn record_again(r: record_t) -> record_t {
    unsafe {
        let t = PL_new_term_ref();
        let copy = if PL_recorded(r, t) == 0 { null_mut::<c_void>() } else { PL_record(t) };
        PL_reset_term_refs(t);
        copy
    }
}
