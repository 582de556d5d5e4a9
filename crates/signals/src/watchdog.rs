//! Two threads that see to the end of a program.
//!
//! The *watchdog* waits for signals, and takes no lock that Prolog or the driver may hold, nor
//! the allocator's: a handler that leaves by longjmp, as Prolog's for SIGFPE, may keep it.
//! It has the *asker* ask Prolog whether a signal will end the program, and stop the motors
//! if it will. Then Prolog gets the signal. Whatever Prolog and the asker do: two seconds
//! after the signal the process has ended.
use crate::events::{
    self, COMPUTES, CONTINUED, ENDS, FORKED, GOES_ON, HALTS, IS_TO_HALT, MAIN_IS_OVER, SIGNAL, send,
};
use crate::latch::{self, Reason};
use crate::{computing, crash, handlers, kept, lines, survivor};
use nix::libc::{self, c_int, c_void};
use nix::sys::signal::{SigSet, SigmaskHow};
use std::io::{self, Read, Write};
use std::os::fd::AsRawFd;
use std::os::unix::net::UnixStream;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// How long Prolog may take to end the process.
pub const PATIENCE: Duration = Duration::from_secs(2);

/// How long it may take to say whether it will.
const ANSWER: Duration = Duration::from_millis(500);

/// How often the watchdog looks whether all is as it should be, and for how long more often
/// when the process has forked.
const LOOK: Duration = Duration::from_millis(100);
const SOON: Duration = Duration::from_millis(1);
const JUST: Duration = Duration::from_millis(20);

/// What the asker asks and does, without knowing Prolog.
pub struct Asked {
    /// Whether a signal, such as `term`, will end the program; the second argument is whether
    /// there is somebody at a terminal. If it will, nothing starts a motor any more when
    /// this returns, and no motor runs.
    pub ends: fn(&'static str, bool) -> bool,
    /// Stops the motors.
    pub stop: fn(),
    /// Stops those of the thread of that name, see [`computing::guard`], which has computed for
    /// so long.
    pub computes: fn(u64, Duration),
}

/// Prolog ends the program because of a signal, such as `term`: the process ends within
/// [`PATIENCE`].
pub fn halts(signal: &str) {
    send(HALTS, number(signal));
}

/// Prolog has begun to halt, or its halt was canceled. Its clean-ups may wait forever, as for
/// a stream that another thread reads from: after [`PATIENCE`] no motor starts.
pub fn is_to_halt(halts: bool) {
    send(IS_TO_HALT, halts.into());
}

/// Takes the signals that end a program, from now on, unless it does already.
/// Errors: the kernel's, where no thread or no descriptor can be had; then it may be tried again.
pub fn watch(asked: Asked) -> io::Result<()> {
    static TAKING: Mutex<()> = Mutex::new(());
    let _taking = TAKING.lock().unwrap_or_else(PoisonError::into_inner);
    if events::has_watchdog() {
        return Ok(());
    }
    let (read, write) = UnixStream::pair()?;
    // A handler must not wait.
    write.set_nonblocking(true)?;
    let (questions, answers) = UnixStream::pair()?;
    // The signals are for the program's own threads.
    let before = SigSet::all().thread_swap_mask(SigmaskHow::SIG_BLOCK)?;
    let spawn = |name: &str, run: Box<dyn FnOnce() + Send>| {
        std::thread::Builder::new().name(name.to_owned()).spawn(run).map(drop)
    };
    let spawned = spawn("ev3-asker", Box::new(move || answer(&questions, &asked)))
        .and_then(|()| spawn("ev3-signals", Box::new(move || Watchdog::new(read, answers).run())));
    before.thread_set_mask()?;
    spawned?;
    events::send_to(write);
    handlers::take_all();
    // Safety: the functions do only what may be done there.
    unsafe {
        libc::pthread_atfork(None, Some(has_forked), Some(forked));
        if libc::syscall(libc::SYS_gettid) == libc::c_long::from(libc::getpid()) {
            static IS_SET: u8 = 1;
            let mut key = 0;
            if libc::pthread_key_create(&raw mut key, Some(main_is_over)) == 0 {
                libc::pthread_setspecific(key, (&raw const IS_SET).cast());
            }
        }
    }
    Ok(())
}

/// After fork(2): shell/1 does so before it takes Ctrl-Z.
unsafe extern "C" fn has_forked() {
    send(FORKED, 0);
}

/// In a child of fork(2), which has neither thread: its signals go to Prolog.
unsafe extern "C" fn forked() {
    events::be_child();
    lines::forked();
    kept::forked();
    survivor::forked();
}

/// The main thread ends, and the process does not, as after `thread_exit/1`.
unsafe extern "C" fn main_is_over(_: *mut c_void) {
    send(MAIN_IS_OVER, 0);
}

/// The asker: the watchdog passes its own words on to it.
fn answer(mut questions: &UnixStream, asked: &Asked) {
    let mut told = [0; 2];
    while questions.read_exact(&mut told).is_ok() {
        let [what, number] = told;
        if what == CONTINUED {
            (asked.stop)();
            latch::lift(Reason::Standing);
        } else if what == COMPUTES {
            if let Some((name, limit)) = computing::still_computes(number.into()) {
                (asked.computes)(name, limit);
            }
        } else {
            let signal = c_int::from(number);
            let ends = (asked.ends)(name(signal), has_terminal());
            send(if ends { ENDS } else { GOES_ON }, signal);
        }
    }
}

/// Whether somebody can type there.
fn has_terminal() -> bool {
    // Safety: asks the kernel only.
    unsafe { libc::isatty(libc::STDIN_FILENO) == 1 }
}

const NAMES: [(c_int, &str); 3] =
    [(libc::SIGTERM, "term"), (libc::SIGHUP, "hup"), (libc::SIGINT, "int")];

fn name(signal: c_int) -> &'static str {
    NAMES.iter().find(|named| named.0 == signal).map_or("term", |named| named.1)
}

fn number(name: &str) -> c_int {
    NAMES.iter().find(|named| named.1 == name).map_or(libc::SIGTERM, |named| named.0)
}

struct Watchdog {
    events: UnixStream,
    asker: UnixStream,
    /// Since when Prolog is asked about each of [`NAMES`], and whether that took too long.
    asked: [Option<(Instant, bool)>; NAMES.len()],
    /// The signal that ends the process, and when.
    end: Option<(c_int, Instant)>,
    /// Until when no motor starts, after the process was continued.
    stands_until: Option<Instant>,
    /// The number of the last crash, and since when it is known.
    crashed: Option<(u32, Instant)>,
    /// Whether the main thread has ended.
    is_main_over: bool,
    /// When Prolog, which has begun to halt, has taken too long.
    halt: Option<Instant>,
    /// Until when it has just forked.
    forks_until: Option<Instant>,
}

impl Watchdog {
    fn new(events: UnixStream, asker: UnixStream) -> Self {
        Self {
            events,
            asker,
            asked: [None; NAMES.len()],
            end: None,
            stands_until: None,
            crashed: None,
            is_main_over: false,
            halt: None,
            forks_until: None,
        }
    }

    fn run(mut self) {
        loop {
            self.wait();
            let mut told = [0; 2];
            while self.is_told(Duration::ZERO) && self.events.read_exact(&mut told).is_ok() {
                let [what, number] = told;
                self.take(what, number);
            }
            self.look();
        }
    }

    /// Waits for something to do.
    fn wait(&self) {
        let asked =
            self.asked.iter().flatten().filter(|asked| !asked.1).map(|asked| asked.0 + ANSWER);
        let times = asked.chain(self.end.map(|end| end.1)).chain(self.stands_until);
        let now = Instant::now();
        let pause = times.map(|time| time.saturating_duration_since(now)).min();
        let look = self.forks_until.map_or(LOOK, |_| SOON);
        // A millisecond is the least that poll(2) waits.
        self.is_told(pause.map_or(look, |pause| look.min(pause + Duration::from_millis(1))));
    }

    /// Whether a word comes within that time.
    fn is_told(&self, within: Duration) -> bool {
        let descriptor = self.events.as_raw_fd();
        let mut polled = libc::pollfd { fd: descriptor, events: libc::POLLIN, revents: 0 };
        let milliseconds = c_int::try_from(within.as_millis()).unwrap_or(c_int::MAX);
        // Safety: one descriptor, ours.
        unsafe { libc::poll(&raw mut polled, 1, milliseconds) > 0 }
    }

    fn take(&mut self, what: u8, number: u8) {
        let signal = c_int::from(number);
        let now = Instant::now();
        match what {
            SIGNAL => {
                handlers::look_at(signal);
                if self.is_main_over {
                    end_by(signal);
                }
                if latch::is_set_as(Reason::Halting) {
                    self.ends_by(signal, now);
                    return;
                }
                if let Some(asked) = self.asked(signal).filter(|asked| asked.is_none()) {
                    *asked = Some((now, false));
                    let _ = self.asker.write_all(&[SIGNAL, number]);
                }
            }
            ENDS => {
                let (since, is_late) = self.answered(signal).unwrap_or((now, true));
                self.ends_by(signal, since);
                if !is_late {
                    handlers::send_on(signal);
                }
            }
            GOES_ON => match self.answered(signal) {
                Some((_, false)) => handlers::send_on(signal),
                Some((_, true)) if self.end.is_some_and(|end| end.0 == signal) => {
                    self.end = None;
                    latch::lift(Reason::Ending);
                }
                _ => {}
            },
            HALTS => self.ends_by(signal, now),
            CONTINUED => {
                self.stands_until = Some(now + ANSWER);
                let _ = self.asker.write_all(&[CONTINUED, number]);
            }
            MAIN_IS_OVER => {
                self.is_main_over = true;
                handlers::listen();
            }
            IS_TO_HALT => self.halt = (number != 0).then_some(now + PATIENCE),
            FORKED => self.forks_until = Some(now + JUST),
            _ => {}
        }
    }

    fn asked(&mut self, signal: c_int) -> Option<&mut Option<(Instant, bool)>> {
        let place = NAMES.iter().position(|named| named.0 == signal)?;
        self.asked.get_mut(place)
    }

    /// When a question was put that is answered now, and whether Prolog has got the signal.
    fn answered(&mut self, signal: c_int) -> Option<(Instant, bool)> {
        self.asked(signal)?.take()
    }

    fn ends_by(&mut self, signal: c_int, since: Instant) {
        self.end.get_or_insert((signal, since + PATIENCE));
    }

    /// Looks whether all is as it should be.
    fn look(&mut self) {
        let now = Instant::now();
        for (signal, _) in NAMES {
            let Some(Some((since, is_late))) = self.asked(signal) else {
                continue;
            };
            if *is_late || *since + ANSWER > now {
                continue;
            }
            *is_late = true;
            let since = *since;
            // At a terminal Ctrl-C is seldom an end, and can be typed again.
            if signal != libc::SIGINT || !has_terminal() {
                handlers::stop_for(Reason::Ending);
                self.ends_by(signal, since);
            }
            handlers::send_on(signal);
        }
        if let Some((signal, _)) = self.end.filter(|end| end.1 <= now) {
            end_by(signal);
        }
        if self.halt.is_some_and(|time| time <= now) {
            self.halt = None;
            handlers::stop_for(Reason::Halting);
        }
        if self.stands_until.is_some_and(|time| time <= now) {
            self.stands_until = None;
            latch::lift(Reason::Standing);
        }
        self.look_at_crash(now);
        computing::look(|number| {
            let _ = self.asker.write_all(&[COMPUTES, u8::try_from(number).unwrap_or(0)]);
        });
        handlers::take_again();
        if self.forks_until.is_some_and(|time| time <= now) {
            self.forks_until = None;
        }
        if self.is_main_over && is_alone() {
            handlers::stop_for(Reason::Ending);
            // Safety: as at the end of the last thread.
            unsafe { libc::_exit(0) };
        }
    }

    /// A crash from whose handler Prolog has not come back after [`PATIENCE`]: either it goes on
    /// elsewhere, or the handler hangs, and nothing else would end the process.
    fn look_at_crash(&mut self, now: Instant) {
        let (number, signal) = crash::last();
        if !latch::is_set_as(Reason::Crashed) {
            self.crashed = None;
            return;
        }
        let known = self.crashed.filter(|crashed| crashed.0 == number);
        let (_, since) = *self.crashed.insert(known.unwrap_or((number, now)));
        if since + PATIENCE > now {
            return;
        }
        match crash::is_in_handler() {
            Some(false) => latch::lift(Reason::Crashed),
            None if since + 2 * PATIENCE > now => {}
            _ => end_by(signal),
        }
    }
}

/// Ends the process as the signal does by itself.
fn end_by(signal: c_int) -> ! {
    handlers::stop_for(Reason::Ending);
    handlers::do_default(signal);
    // Safety: nothing is left to be done.
    unsafe { libc::_exit(128 + signal) }
}

/// Whether there are no threads but those of this library and Prolog's collector.
fn is_alone() -> bool {
    let main = std::process::id().to_string();
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else {
        return false;
    };
    threads.flatten().filter(|thread| thread.file_name() != *main).all(|thread| {
        let name = std::fs::read_to_string(thread.path().join("comm")).unwrap_or_default();
        name.starts_with("ev3-") || name == "gc\n"
    })
}
