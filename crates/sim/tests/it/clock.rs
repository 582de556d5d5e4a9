//! How time passes for threads: waits, holds and periodic acts. On the virtual clock every number
//! is exact. Nothing depends on how fast the tests run.

use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Barrier, Mutex};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use ev3_sim::{Act, Button, Clock, Machine, Simulation};

use crate::desk::Desk;

const fn ms(count: u64) -> Duration {
    Duration::from_millis(count)
}

fn machine() -> Machine {
    Desk::new().0
}

fn simulation(clock: Clock) -> Arc<Simulation> {
    Arc::new(Simulation::new(machine(), clock).unwrap())
}

fn now(simulation: &Simulation) -> Duration {
    simulation.machine().now()
}

/// An act that reports the time of each of its runs.
fn reporter(simulation: &Arc<Simulation>, period: Duration) -> (Act, Receiver<Duration>) {
    let (sender, receiver) = channel();
    let simulation = Arc::downgrade(simulation);
    let act = move || {
        let at = simulation.upgrade()?.machine().now();
        sender.send(at).ok().map(|()| period)
    };
    (Box::new(act), receiver)
}

#[test]
fn a_virtual_pause_jumps_to_its_end() {
    let simulation = simulation(Clock::Virtual);
    simulation.pause(ms(3000));
    assert_eq!(now(&simulation), ms(3000));
    simulation.pause(Duration::ZERO);
    assert_eq!(now(&simulation), ms(3000));
}

#[test]
fn virtual_reads_and_writes_take_a_little_time() {
    let simulation = simulation(Clock::Virtual);
    simulation.read(|_| ());
    assert_eq!(now(&simulation), Duration::from_micros(500));
    simulation.write(|_| ());
    assert_eq!(now(&simulation), Duration::from_micros(600));
}

/// Starts a thread that pauses, and answers when its pause ended. Holding the clock from the start,
/// it misses no time before its pause.
fn sleeper(simulation: &Arc<Simulation>, time: Duration) -> JoinHandle<Duration> {
    let (simulation, ready) = (Arc::clone(simulation), Arc::new(Barrier::new(2)));
    let held = Arc::clone(&ready);
    let thread = thread::spawn(move || {
        simulation.hold();
        held.wait();
        while now(&simulation) < time {
            simulation.pause(time.saturating_sub(now(&simulation)));
        }
        let end = now(&simulation);
        simulation.release();
        end
    });
    ready.wait();
    thread
}

#[test]
fn of_two_pauses_the_shorter_ends_first() {
    let simulation = simulation(Clock::Virtual);
    // Time stands still until this thread releases it.
    simulation.hold();
    let sleepers = [ms(500), ms(200)].map(|time| sleeper(&simulation, time));
    thread::sleep(ms(20));
    assert_eq!(now(&simulation), Duration::ZERO);
    simulation.release();
    assert_eq!(sleepers.map(|sleeper| sleeper.join().unwrap()), [ms(500), ms(200)]);
}

#[test]
fn a_held_clock_passes_only_while_its_holder_waits() {
    let simulation = simulation(Clock::Virtual);
    simulation.hold();
    let sleeper = sleeper(&simulation, ms(100));
    thread::sleep(ms(20));
    assert_eq!(now(&simulation), Duration::ZERO);
    simulation.pause(ms(40));
    assert_eq!(now(&simulation), ms(40));
    simulation.release();
    assert_eq!(sleeper.join().unwrap(), ms(100));
}

#[test]
fn a_pause_returns_for_signals_while_another_thread_holds_the_clock() {
    let simulation = simulation(Clock::Virtual);
    simulation.hold();
    let waiter = Arc::clone(&simulation);
    let end = thread::spawn(move || {
        waiter.pause(ms(100));
        now(&waiter)
    });
    assert_eq!(end.join().unwrap(), Duration::ZERO);
    simulation.release();
}

#[test]
fn an_act_runs_at_exactly_its_times() {
    let simulation = simulation(Clock::Virtual);
    let (act, times) = reporter(&simulation, ms(20));
    simulation.repeat(ms(20), act);
    simulation.pause(ms(70));
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [ms(20), ms(40), ms(60)]);
    assert_eq!(now(&simulation), ms(70));
    simulation.step(ms(10));
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [ms(80)]);
}

#[test]
fn acts_run_in_the_order_of_their_times_and_choose_their_next_period() {
    let simulation = simulation(Clock::Virtual);
    let runs = Arc::new(Mutex::new(Vec::new()));
    for (name, periods) in [("slow", vec![30]), ("fast", vec![10, 15]), ("once", vec![])] {
        let (runs, mut left) = (Arc::clone(&runs), periods.into_iter());
        let act = move || {
            runs.lock().unwrap().push(name);
            left.next().map(ms)
        };
        let first = if name == "slow" { 30 } else { 12 };
        simulation.repeat(ms(first), Box::new(act));
    }
    simulation.pause(ms(100));
    // fast at 12, 22, 37; once at 12; slow at 30, 60
    let runs = runs.lock().unwrap();
    let mut first: Vec<_> = runs[..2].to_vec();
    first.sort_unstable();
    assert_eq!(first, ["fast", "once"]);
    assert_eq!(runs[2..], ["fast", "slow", "fast", "slow"]);
}

#[test]
fn reads_and_waits_within_an_act_take_no_turn_of_their_own() {
    let simulation = simulation(Clock::Virtual);
    let (sender, receiver) = channel();
    let inner = Arc::downgrade(&simulation);
    let act = move || {
        let simulation = inner.upgrade()?;
        let before = simulation.machine().now();
        simulation.read(|_| ());
        simulation.write(|_| ());
        let after = simulation.machine().now();
        sender.send((simulation.is_acting(), before == after)).ok().map(|()| ms(10))
    };
    simulation.repeat(ms(10), Box::new(act));
    simulation.pause(ms(25));
    assert_eq!(receiver.try_iter().collect::<Vec<_>>(), [(true, true); 2]);
    assert!(!simulation.is_acting());
}

#[test]
fn a_write_runs_no_act() {
    let simulation = simulation(Clock::Virtual);
    let (act, times) = reporter(&simulation, ms(1));
    simulation.repeat(Duration::from_micros(50), act);
    simulation.write(|_| ());
    assert_eq!(times.try_iter().count(), 0);
    simulation.read(|_| ());
    assert!(times.try_iter().count() > 0, "it is overdue by then");
}

#[test]
fn an_act_goes_on_after_the_machine_is_restored() {
    let simulation = simulation(Clock::Virtual);
    let snapshot = simulation.machine().clone();
    let (act, times) = reporter(&simulation, ms(10));
    simulation.repeat(ms(10), act);
    simulation.pause(ms(1000));
    assert_eq!(times.try_iter().count(), 100);
    simulation.machine().restore(snapshot);
    assert_eq!(now(&simulation), Duration::ZERO);
    simulation.pause(ms(25));
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [ms(10), ms(20)]);
}

#[test]
fn waiting_for_a_button_jumps_to_the_planned_press() {
    let simulation = simulation(Clock::Virtual);
    simulation.machine().plan_button(Button::Up, true, ms(400));
    while !simulation.machine().is_pressed(Button::Up) {
        simulation.pause_until(ms(10_000), |machine| machine.is_pressed(Button::Up));
    }
    assert!((ms(400)..=ms(404)).contains(&now(&simulation)), "{:?}", now(&simulation));
    // What holds already needs no time.
    let before = now(&simulation);
    simulation.pause_until(ms(10_000), |machine| machine.is_pressed(Button::Up));
    assert_eq!(now(&simulation), before);
}

#[test]
fn the_wall_clock_runs_by_itself_and_returns_early_from_long_waits() {
    let simulation = simulation(Clock::Wall(10.0));
    let (act, times) = reporter(&simulation, ms(100));
    simulation.repeat(ms(100), act);
    simulation.pause(ms(3_600_000));
    assert!(now(&simulation) < ms(3_600_000));
    times.recv_timeout(Duration::from_secs(20)).unwrap();
    // Reading takes no time of its own, and dropping ends the thread.
    drop(simulation);
    while times.recv().is_ok() {}
}
