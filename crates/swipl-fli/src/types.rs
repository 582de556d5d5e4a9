//! Types and constants of `SWI-Prolog.h` and `SWI-Stream.h`, in the numbers
//! since 8.1.22. `version.rs` translates those that were others before.
use std::ffi::{c_char, c_int, c_void};

pub type atom_t = usize;
pub type functor_t = usize;
pub type term_t = usize;
pub type PL_fid_t = usize;
pub type foreign_t = usize;
/// A query. Pointer-sized in C, see the crate's documentation.
pub type qid_t = u64;
pub type module_t = *mut c_void;
pub type predicate_t = *mut c_void;
pub type record_t = *mut c_void;
pub type control_t = *mut c_void;
pub type PL_engine_t = *mut c_void;
pub type pl_function_t = Option<unsafe extern "C" fn() -> foreign_t>;

pub const TRUE: u32 = 1;
pub const FALSE: u32 = 0;
pub const EOF: c_int = -1;

// Results of PL_term_type()
pub const PL_VARIABLE: u32 = 1;
pub const PL_ATOM: u32 = 2;
pub const PL_INTEGER: u32 = 3;
pub const PL_RATIONAL: u32 = 4;
pub const PL_FLOAT: u32 = 5;
pub const PL_STRING: u32 = 6;
pub const PL_TERM: u32 = 7;
pub const PL_NIL: u32 = 8;
pub const PL_BLOB: u32 = 9;
pub const PL_LIST_PAIR: u32 = 10;
pub const PL_DICT: u32 = 44;

pub const PL_FA_NONDETERMINISTIC: u32 = 0x04;
pub const PL_FA_VARARGS: u32 = 0x08;

pub const PL_Q_NORMAL: u32 = 0x02;
pub const PL_Q_CATCH_EXCEPTION: u32 = 0x08;
pub const PL_Q_EXT_STATUS: u32 = 0x40;

pub const CVT_ATOM: u32 = 0x01;
pub const CVT_STRING: u32 = 0x02;
pub const BUF_DISCARDABLE: u32 = 0;
pub const REP_UTF8: u32 = 0x0010_0000;

pub const PL_ENGINE_SET: u32 = 0;
pub const PL_ENGINE_INVAL: u32 = 2;
pub const PL_ENGINE_INUSE: u32 = 3;

pub const PL_BLOB_MAGIC: u32 = 0x7529_3a01;
pub const PL_BLOB_UNIQUE: u32 = 0x01;
pub const PL_BLOB_TEXT: u32 = 0x02;
pub const PL_BLOB_NOCOPY: u32 = 0x04;

/// Type of a blob: what SWI-Prolog calls when it meets one.
#[repr(C)]
pub struct PL_blob_t {
    pub magic: usize,
    pub flags: usize,
    pub name: *const c_char,
    pub release: Option<unsafe extern "C" fn(a: atom_t) -> c_int>,
    pub compare: Option<unsafe extern "C" fn(a: atom_t, b: atom_t) -> c_int>,
    pub write: Option<unsafe extern "C" fn(s: *mut IOSTREAM, a: atom_t, flags: c_int) -> c_int>,
    pub acquire: Option<unsafe extern "C" fn(a: atom_t)>,
    pub save: Option<unsafe extern "C" fn(a: atom_t, s: *mut IOSTREAM) -> c_int>,
    pub load: Option<unsafe extern "C" fn(s: *mut IOSTREAM) -> atom_t>,
    pub padding: usize,
    pub reserved: [*mut c_void; 9],
    pub registered: c_int,
    pub rank: c_int,
    pub next: *mut PL_blob_t,
    pub atom_name: atom_t,
}

pub type IOENC = u32;
pub const IOENC_ENC_OCTET: IOENC = 1;
pub const IOENC_ENC_ANSI: IOENC = 4;
pub const IOENC_ENC_UTF8: IOENC = 5;

pub const SH_UNLOCKED: c_int = 0x04;
pub const SH_OUTPUT: c_int = 0x08;
pub const SH_INPUT: c_int = 0x10;
pub const SH_NOPAIR: c_int = 0x20;

pub const SIO_INPUT: u32 = 1 << 6;
pub const SIO_OUTPUT: u32 = 1 << 7;

/// A position in a stream.
#[repr(C)]
pub struct IOPOS {
    byteno: i64,
    charno: i64,
    lineno: c_int,
    linepos: c_int,
    reserved: [isize; 2],
}

/// A stream, up to the last field that `swipl` reads.
///
/// In 7.2 other fields come before `encoding`, and what is read in its place is
/// padding that is 0 (64 bit) or half of a pointer (32 bit). `swipl` then writes
/// text character by character, which is right for every encoding.
#[repr(C)]
pub struct IOSTREAM {
    bufp: *mut c_char,
    limitp: *mut c_char,
    buffer: *mut c_char,
    unbuffer: *mut c_char,
    lastc: c_int,
    magic: c_int,
    bufsize: c_int,
    pub flags: u32,
    posbuf: IOPOS,
    position: *mut IOPOS,
    handle: *mut c_void,
    functions: *mut c_void,
    timeout: c_int,
    pub encoding: IOENC,
}
