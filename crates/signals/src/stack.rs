//! The stack on which the handlers of a thread's signals run.
//!
//! Prolog gives a thread that of the engine which begins to run in it, and frees it together
//! with the engine, but does not take it from the thread. From then on the handler of a
//! stack that overflows would write where others have their data.
use nix::libc::{self, stack_t};
use std::cell::RefCell;

/// Prolog takes 8 kB, and may run a program's handler within its own: 9.2 crashes by that.
pub(crate) const SIZE: usize = 256 * 1024;

thread_local! {
    static STACK: RefCell<Option<Stack>> = const { RefCell::new(None) };
}

struct Stack(Box<[u8]>);

impl Stack {
    fn set(&mut self, flags: i32) {
        let stack =
            stack_t { ss_sp: self.0.as_mut_ptr().cast(), ss_flags: flags, ss_size: self.0.len() };
        // Safety: it is there until it is dropped, which takes it from the thread. While a
        // handler runs on the former one this changes nothing.
        unsafe { libc::sigaltstack(&raw const stack, std::ptr::null_mut()) };
    }
}

impl Drop for Stack {
    fn drop(&mut self) {
        self.set(libc::SS_DISABLE);
    }
}

/// Gives this thread a stack of its own for handlers. To be called where handlers of programs
/// may run, and when an engine that has run in a thread is gone.
pub fn own_handlers_stack() {
    // A thread that ends needs none.
    let _ = STACK.try_with(|stack| {
        let mut stack = stack.borrow_mut();
        stack.get_or_insert_with(|| Stack(vec![0; SIZE].into_boxed_slice())).set(0);
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    fn used() -> stack_t {
        // Safety: asks only.
        unsafe {
            let mut stack = std::mem::zeroed();
            libc::sigaltstack(std::ptr::null(), &raw mut stack);
            stack
        }
    }

    #[test]
    fn a_thread_gets_its_own_again_after_that_of_an_engine() {
        std::thread::spawn(|| {
            own_handlers_stack();
            let own = used();
            assert_eq!((own.ss_size, own.ss_flags), (SIZE, 0));
            let mut engines = Stack(vec![0; SIZE].into_boxed_slice());
            engines.set(0);
            assert_ne!(used().ss_sp, own.ss_sp);
            own_handlers_stack();
            assert_eq!((used().ss_sp, used().ss_flags), (own.ss_sp, 0));
            std::mem::forget(engines); // as Prolog does
        })
        .join()
        .unwrap();
    }
}
