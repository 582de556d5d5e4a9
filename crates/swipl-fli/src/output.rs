//! Texts on their way to Prolog's standard output.
//!
//! A stream has a table of the functions that read and write. The one here is a copy with another
//! function that writes: it calls the former, and then shows what was written. All else of the
//! stream, as whether it is a terminal, stays as it was.
use crate::functions::_PL_streams;
use std::ffi::{c_char, c_int, c_void};
use std::sync::OnceLock;

type Write = unsafe extern "C" fn(handle: *mut c_void, buffer: *mut c_char, size: usize) -> isize;

/// `IOFUNCTIONS` of `SWI-Stream.h`, the same from 7.2 to 10.
#[repr(C)]
#[derive(Clone, Copy)]
struct Functions {
    read: *const c_void,
    write: Write,
    others: [*const c_void; 4],
}

/// The beginning of `IOSTREAM`, the same from 7.2 to 10.
#[repr(C)]
struct Stream {
    buffers: [*mut c_char; 4],
    lastc: c_int,
    magic: c_int,
    bufsize: c_int,
    flags: c_int,
    posbuf: Position,
    position: *mut Position,
    handle: *mut c_void,
    functions: *const Functions,
}

/// `IOPOS`
#[repr(C)]
struct Position {
    counts: [i64; 2],
    places: [c_int; 2],
    reserved: [isize; 2],
}

/// `SIO_MAGIC`, of a stream that is open: before version 8, and since.
const OPEN: [c_int; 2] = [7_212_676, 7_212_677];

static ACT: OnceLock<fn(&[u8])> = OnceLock::new();
static FORMER: OnceLock<Functions> = OnceLock::new();
static OURS: OnceLock<Functions> = OnceLock::new();

// Safety: pointers to functions of Prolog, which any thread may call.
unsafe impl Send for Functions {}
unsafe impl Sync for Functions {}

/// From now on, `act` gets the bytes that are written to the standard output that the calling
/// thread has. The first `act` and the first kind of stream count. It must not panic.
pub fn see_output(act: fn(&[u8])) {
    ACT.get_or_init(|| act);
    // Safety: an open stream has a table of functions.
    unsafe {
        let Some(stream) = output() else { return };
        let former = *FORMER.get_or_init(|| *(*stream).functions);
        let ours = OURS.get_or_init(|| Functions { write, ..former });
        if (*(*stream).functions).write as usize == former.write as usize {
            (*stream).functions = ours;
        }
    }
}

/// The standard output of the calling thread is as it was.
pub fn see_output_no_more() {
    // Safety: as above.
    unsafe {
        let Some(stream) = output() else { return };
        if let (Some(former), Some(ours)) = (FORMER.get(), OURS.get()) {
            if std::ptr::eq((*stream).functions, ours) {
                (*stream).functions = former;
            }
        }
    }
}

/// The standard output of the calling thread, if it is open.
unsafe fn output() -> Option<*mut Stream> {
    unsafe {
        let stream = (*_PL_streams().add(1)).cast::<Stream>();
        (!stream.is_null() && OPEN.contains(&(*stream).magic)).then_some(stream)
    }
}

unsafe extern "C" fn write(handle: *mut c_void, buffer: *mut c_char, size: usize) -> isize {
    let Some(former) = FORMER.get() else { return -1 };
    // Safety: the arguments are those of the former function.
    let written = unsafe { (former.write)(handle, buffer, size) };
    if let (Ok(written), Some(act)) = (usize::try_from(written), ACT.get()) {
        act(unsafe { std::slice::from_raw_parts(buffer.cast(), written) });
    }
    written
}
