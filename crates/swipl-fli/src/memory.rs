//! Memory in WebAssembly. It is one for SWI-Prolog and this library, so it is taken by
//! SWI-Prolog's own `malloc`: Rust's allocator would grow it behind the back of that.
use std::alloc::{GlobalAlloc, Layout};
use std::ffi::c_void;

#[link(wasm_import_module = "swipl")]
unsafe extern "C" {
    fn malloc(size: usize) -> *mut c_void;
    fn free(address: *mut c_void);
}

/// What `malloc` aligns everything to. No type here asks for more.
const ALIGNED: usize = 8;

struct Memory;

#[global_allocator]
static MEMORY: Memory = Memory;

// Safety: `malloc` keeps its promises; what it does not promise is refused.
unsafe impl GlobalAlloc for Memory {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        if layout.align() > ALIGNED {
            return std::ptr::null_mut();
        }
        unsafe { malloc(layout.size()).cast() }
    }

    unsafe fn dealloc(&self, address: *mut u8, _layout: Layout) {
        unsafe { free(address.cast()) }
    }
}
