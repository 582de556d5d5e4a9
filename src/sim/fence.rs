//! `prolog/ev3dev/sim_fenced.pl`: a program in a process of its own, which sees the files of the
//! simulated robot, and nothing else of the simulation.
use super::running::{simulation, use_simulated};
use crate::glue::call::Call;
use crate::glue::error::no_such;
use crate::glue::state::brick_number;
use crate::glue::terms::{Prolog, unify_atom};
use ev3_driver::Error;
use ev3_os::locked;
use ev3_os::mailbox::readable;
use ev3_os::sockets::with_address;
use ev3_sim::far::wire::{Desk, Line, Next};
use ev3_sim::{Clock, Simulation};
use std::collections::BTreeMap;
use std::io;
use std::os::unix::net::UnixListener;
use std::path::Path;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use swipl::fli::has_other_threads;
use swipl::prelude::*;

/// By the number of the brick whose robot the program has.
static FENCES: Mutex<BTreeMap<u32, Fence>> = Mutex::new(BTreeMap::new());

/// The longest time that a program may let pass without a question.
const AHEAD: Duration = Duration::from_millis(100);

struct Fence {
    listener: UnixListener,
    /// How many inferences of the program take a second; 0 if they take no time.
    thinking: u64,
    /// Once the program has connected.
    desk: Option<Desk>,
}

/// What a program does.
enum State {
    /// It has asked much: ask again.
    Waiting,
    /// It asks nothing now.
    Silent,
    /// It has ended, or has closed its end.
    Ended,
    /// Its simulated time is over.
    Over,
    /// There is an exception.
    Interrupted,
    Refused(&'static str),
}

impl Fence {
    /// Serves for some wall time. `interrupted` handles signals, and runs what was planned for a
    /// moment of the simulation.
    fn serve(
        &mut self,
        simulation: &Simulation,
        [end, wall]: [Duration; 2],
        mut interrupted: impl FnMut() -> bool,
    ) -> io::Result<State> {
        let since = Instant::now();
        let mut was_waited_for = true;
        loop {
            let left = wall.saturating_sub(since.elapsed());
            if left.is_zero() {
                return Ok(if was_waited_for { State::Waiting } else { State::Silent });
            }
            let Some(desk) = &mut self.desk else {
                match self.listener.accept() {
                    Ok((stream, _)) => {
                        stream.set_nonblocking(false)?;
                        self.desk =
                            Some(Desk::new(stream, simulation.machine().now(), self.thinking)?);
                    }
                    Err(error) if error.kind() == io::ErrorKind::WouldBlock => {
                        ev3_os::sleep(Duration::from_millis(2));
                        if since.elapsed() >= wall {
                            return Ok(State::Silent);
                        }
                    }
                    Err(error) => return Err(error),
                }
                continue;
            };
            match desk.hear(left)? {
                Next::Idle => return Ok(State::Silent),
                Next::Gone => return Ok(State::Ended),
                Next::Refused(why) => return Ok(State::Refused(why)),
                Next::Asked(at) => {
                    let at_most = at.min(end);
                    let mut is_then = simulation.machine().now() >= at_most;
                    while !is_then {
                        is_then = simulation.pause(at_most);
                        if interrupted() {
                            return Ok(State::Interrupted);
                        }
                    }
                    if at > end {
                        return Ok(State::Over);
                    }
                    let next = simulation.next_act().unwrap_or(Duration::MAX);
                    let mut machine = simulation.machine();
                    let until = next.min(end).min(machine.now().saturating_add(AHEAD));
                    was_waited_for = desk.is_waited_for();
                    desk.answer(&mut machine, until);
                }
            }
        }
    }

    /// Whether the program waits for nothing of the machine.
    fn is_silent(&mut self) -> bool {
        let Some(desk) = &mut self.desk else {
            return !readable(&self.listener, Duration::ZERO).unwrap_or(false);
        };
        // What is lost is found by who serves.
        let _ = desk.hear(Duration::ZERO);
        !desk.owes_answer()
    }
}

natives! {
    /// sim_fence_open_(+Path, +Inferences): a program may connect to the robot of the running
    /// simulation, once, and that many inferences of it take a second, or no time if it is 0. Fails
    /// if the simulation has no virtual clock.
    semidet fn "sim_fence_open_"(context, path, inferences) as call("sim_fenced", 3) {
        let simulation = simulation(context)?;
        if simulation.clock() != Clock::Virtual {
            return Err(PrologError::Failure);
        }
        let (path, inferences) = (call.text(path)?, call.integer(inferences)?);
        let thinking = u64::try_from(inferences).unwrap_or(0);
        let listener = with_address(Path::new(&*path), |path| UnixListener::bind(path))
            .and_then(|listener| listener.set_nonblocking(true).map(|()| listener));
        match listener {
            Ok(listener) => {
                locked(&FENCES).insert(brick_number(), Fence { listener, thinking, desk: None });
                Ok(())
            }
            Err(error) => no_such(&call, "socket", &path, &error.to_string()),
        }
    }

    /// sim_fence_serve_(+Until, +Wall, -State): the machine answers for Wall seconds at most, but
    /// not after Until, a number of seconds or `inf`. State is `waiting`, `silent` if it waits for
    /// no answer at the end of them, `ended`, `over` or refused(Why).
    semidet fn "sim_fence_serve_"(context, until, wall, state) as call("sim_fenced", 3) {
        let (until, wall) = (call.seconds(until)?.unwrap_or(Duration::MAX), call.time(wall)?);
        let simulation = simulation(context)?;
        let number = brick_number();
        let mut fence = locked(&FENCES).remove(&number).ok_or(PrologError::Failure)?;
        let served = fence.serve(&simulation, [until, wall], call.interrupted());
        locked(&FENCES).insert(number, fence);
        match served {
            Ok(served) => unify_state(&call, state, &served),
            Err(error) => no_such(&call, "program", "fenced", &error.to_string()),
        }
    }

    /// sim_fence_silent_: there is no question of the program.
    semidet fn "sim_fence_silent_"(_context) {
        let mut fences = locked(&FENCES);
        into_prolog_result(fences.get_mut(&brick_number()).is_none_or(Fence::is_silent))
    }

    /// process_usage_(+Process, -Seconds, -Rest, -Threads, -Bytes): how much time of a processor
    /// that process and all that descend from it have used, how often they have left one if all of
    /// them sleep, else `awake`, and how many threads and bytes of memory they have. Fails if there
    /// is no such process.
    semidet fn "process_usage_"(_context, process, seconds, rest, threads, bytes) {
        let process = u32::try_from(process.get::<i64>()?).unwrap_or(0);
        let Some(usage) = ev3_os::processes::usage(process) else {
            return Err(PrologError::Failure);
        };
        seconds.unify(usage.time.as_secs_f64())?;
        threads.unify(i64::try_from(usage.threads).unwrap_or(i64::MAX))?;
        bytes.unify(i64::try_from(usage.memory).unwrap_or(i64::MAX))?;
        match usage.rest {
            Some(switches) => rest.unify(switches),
            None => unify_atom(rest, "awake"),
        }
    }

    /// sim_fence_close_: the program is not answered any more.
    semidet fn "sim_fence_close_"(_context) {
        drop(locked(&FENCES).remove(&brick_number()));
        into_prolog_result(true)
    }

    /// sim_fence_join_(+Path): this process is such a program.
    semidet fn "sim_fence_join_"(context, path) as call("sim_fenced", 3) {
        let path = call.text(path)?;
        let joined = Line::connect(Path::new(&*path), ev3_signals::vanish)
            .and_then(|(line, now)| Simulation::far(Box::new(line), now, has_other_threads));
        match joined {
            Ok(simulation) => use_simulated(&call, Arc::new(simulation), false),
            Err(error) => no_such(&call, "socket", &path, &error.to_string()),
        }
    }
}

/// What became of the program behind the fence.
fn unify_state<C: Prolog>(call: &Call<C>, term: &Term, state: &State) -> PrologResult<()> {
    let context = call.context;
    match state {
        State::Waiting => unify_atom(term, "waiting"),
        State::Silent => unify_atom(term, "silent"),
        State::Ended => unify_atom(term, "ended"),
        State::Over => unify_atom(term, "over"),
        State::Interrupted => call.or_throw(Err(Error::Interrupted)),
        &State::Refused(why) => term.unify(&term! {context: refused(#why)}?),
    }
}
