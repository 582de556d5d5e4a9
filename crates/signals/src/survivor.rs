//! A process that outlives this one, and stops its motors then: after SIGKILL, the memory
//! killer, or a crash, too.
//!
//! It is a shell that waits for the end of a pipe whose other end is this process's, and then goes
//! through the lines of [`crate::kept`], of which it has the file. It begins with the first motor
//! that runs, takes some 100 kB, and shares neither signals, nor session, nor descriptors with this
//! process: Ctrl-C, Ctrl-Z, and SIGKILL to a group of processes do not reach it. It is nobody's
//! child, so that a program that waits for any child does not find it.
//!
//! A pipe, and no PDEATHSIG or pidfd: the former ends with the thread that asked for it,
//! the latter needs Linux 5.3. The pipe ends when the last thread has gone, so that nobody
//! starts a motor thereafter.
use nix::libc::{self, c_char, c_int, c_void};
use std::io;
use std::ptr::null;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};

/// What the shell does, all by itself, without another program.
const SCRIPT: &std::ffi::CStr = c"read -r end <&3; while read -r runs word file; do \
    case $runs in 1) echo \"$word\" >\"$file\";; esac; done <&4";

/// The last of the descriptors that it has: three of /dev/null, the pipe, the lines.
const LINES: c_int = 4;

/// No descriptor.
const NONE: c_int = -1;

/// Whether there is to be such a process.
static IS_WANTED: AtomicBool = AtomicBool::new(true);

/// This process's end of the pipe.
static OUR_END: AtomicI32 = AtomicI32::new(NONE);

/// Whether such a process is to be started with the next motor that is the first to run.
pub fn survive(is_wanted: bool) {
    IS_WANTED.store(is_wanted, Ordering::Relaxed);
}

/// What the new process needs to know.
struct Plan {
    pipe: c_int,
    lines: c_int,
    /// All descriptors are below.
    descriptors: c_int,
    arguments: [*const c_char; 5],
    environment: [*const c_char; 1],
    /// The end of its stack, until it is another program.
    stack: *mut c_void,
}

impl Plan {
    /// Closes all descriptors from `first` on, below `end`.
    unsafe fn close(&self, first: c_int, end: c_int) {
        // Safety: closes only. Linux has that since version 5.9.
        unsafe {
            if first < end && libc::syscall(libc::SYS_close_range, first, end - 1, 0) != 0 {
                for descriptor in first..end.min(self.descriptors) {
                    libc::close(descriptor);
                }
            }
        }
    }
}

/// Starts it, with the file of the lines. Where there can be no process, nothing is lost but this.
/// Errors: the kernel's, where no descriptor is left.
pub(crate) fn start(lines: c_int) -> io::Result<()> {
    if lines == NONE || !IS_WANTED.load(Ordering::Relaxed) {
        return Ok(());
    }
    let mut ends = [NONE; 2];
    // Safety: two descriptors come back.
    if unsafe { libc::pipe2(ends.as_mut_ptr(), libc::O_CLOEXEC) } != 0 {
        return Err(io::Error::last_os_error());
    }
    let [pipe, ours] = ends;
    OUR_END.store(ours, Ordering::Relaxed);
    let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    let (mut first, mut second) = (Stack::new(), Stack::new());
    // Safety: as said at each. All signals wait meanwhile, here and there.
    unsafe {
        libc::getrlimit(libc::RLIMIT_NOFILE, &raw mut limit);
        let plan = Plan {
            pipe,
            lines,
            descriptors: limit.rlim_cur.min(65536).try_into().unwrap_or(1024),
            arguments: [
                c"sh".as_ptr(),
                c"-c".as_ptr(),
                SCRIPT.as_ptr(),
                // What it is called in a list of processes
                c"ev3dev-stops-motors".as_ptr(),
                null(),
            ],
            environment: [null()],
            stack: second.end(),
        };
        let plan = (&raw const plan).cast_mut().cast();
        let mut all = std::mem::zeroed();
        let mut before = std::mem::zeroed();
        libc::sigfillset(&raw mut all);
        libc::pthread_sigmask(libc::SIG_SETMASK, &raw const all, &raw mut before);
        let child = process(between, first.end(), plan);
        if child > 0 {
            while libc::waitpid(child, std::ptr::null_mut(), libc::__WALL) == -1
                && nix::errno::Errno::last() == nix::errno::Errno::EINTR
            {}
        }
        libc::pthread_sigmask(libc::SIG_SETMASK, &raw const before, std::ptr::null_mut());
        libc::close(pipe);
    }
    Ok(())
}

/// In a child of fork(2): it does not keep its parent's process waiting.
pub(crate) fn forked() {
    let ours = OUR_END.swap(NONE, Ordering::Relaxed);
    if ours != NONE {
        // Safety: a descriptor of our own.
        unsafe { libc::close(ours) };
    }
}

/// A new process that has this one's memory, which waits until the new one has another program or
/// has ended: copying the tables of a process of 30 MB takes longer. Without a signal at its end,
/// `wait` for any child does not find it; an emulator of a processor wants one.
unsafe fn process(
    run: extern "C" fn(*mut c_void) -> c_int,
    stack: *mut c_void,
    plan: *mut c_void,
) -> c_int {
    const WAITING: c_int = libc::CLONE_VM | libc::CLONE_VFORK;
    // Safety: stack and plan are there until it ends.
    unsafe {
        match libc::clone(run, stack, WAITING, plan) {
            -1 => libc::clone(run, stack, WAITING | libc::SIGCHLD, plan),
            child => child,
        }
    }
}

/// A stack of 16 kB, aligned as one has to be.
struct Stack(Vec<u128>);

impl Stack {
    fn new() -> Self {
        Self(vec![0; 1024])
    }

    fn end(&mut self) -> *mut c_void {
        self.0.as_mut_ptr_range().end.cast()
    }
}

/// The child between: when it has ended, its own child is nobody's.
extern "C" fn between(plan: *mut c_void) -> c_int {
    // Safety: the plan outlives this process, and so does the stack.
    unsafe { process(become_shell, (*plan.cast::<Plan>()).stack, plan) };
    0
}

/// Does only what may be done in such a process.
extern "C" fn become_shell(plan: *mut c_void) -> c_int {
    /// Descriptors from here on are out of the way.
    const ASIDE: c_int = 10;
    // Safety: the plan outlives this. What fails leaves a shell that ends at once.
    unsafe {
        let plan = &*plan.cast::<Plan>();
        libc::setsid();
        libc::chdir(c"/".as_ptr());
        // This process may have no descriptor to spare.
        let (one, other) = (plan.pipe.min(plan.lines), plan.pipe.max(plan.lines));
        plan.close(0, one);
        plan.close(one + 1, other);
        plan.close(other + 1, c_int::MAX);
        let aside = |file| libc::fcntl(file, libc::F_DUPFD, ASIDE);
        let null_device = aside(libc::open(c"/dev/null".as_ptr(), libc::O_RDWR));
        let files = [null_device; 3].into_iter().chain([aside(plan.pipe), aside(plan.lines)]);
        for (file, number) in files.zip(0..) {
            libc::dup2(file, number);
        }
        plan.close(LINES + 1, c_int::MAX);
        libc::execve(c"/bin/sh".as_ptr(), plan.arguments.as_ptr(), plan.environment.as_ptr());
        libc::_exit(127)
    }
}
