//! The passage of time for threads: turns, waits and periodic acts. On the virtual clock every
//! number is exact. Nothing depends on how fast the tests run.
//!
//! The clock looks at all threads of the process, so these tests run one after the other, and in a
//! process of their own.

#[path = "it/access.rs"]
mod access;
#[path = "it/robots.rs"]
mod robots;

use ev3_sim::{Act, Button, Clock, Machine, Options, Shared, Simulation, WorldSpec};
use robots::default_robot;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

const fn ms(count: u64) -> Duration {
    Duration::from_millis(count)
}

/// A simulation, and the right to be the only test.
struct Alone {
    simulation: Arc<Simulation>,
    _alone: MutexGuard<'static, ()>,
}

impl std::ops::Deref for Alone {
    type Target = Arc<Simulation>;

    fn deref(&self) -> &Arc<Simulation> {
        &self.simulation
    }
}

fn simulation(clock: Clock) -> Alone {
    simulation_with(clock, || true)
}

/// One whose program says whether it has threads but the one that asks.
fn simulation_with(clock: Clock, has_others: fn() -> bool) -> Alone {
    static ALONE: Mutex<()> = Mutex::new(());
    let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let machine = Machine::new(&WorldSpec::default(), &default_robot(), Options::default());
    let simulation = Simulation::new(machine.unwrap(), clock, has_others).unwrap();
    Alone { simulation: Arc::new(simulation), _alone: alone }
}

fn now(simulation: &Simulation) -> Duration {
    simulation.machine().now()
}

/// A call that is about something begins.
fn call(simulation: &Simulation, about: &str) {
    while !simulation.turn(&mut || about.to_owned()) {}
}

/// A call that waits.
fn wait(simulation: &Simulation, time: Duration) {
    call(simulation, "wait");
    let end = now(simulation) + time;
    while now(simulation) < end {
        simulation.pause(end);
    }
}

/// Computes for this wall time.
fn compute(time: Duration) {
    let start = Instant::now();
    while start.elapsed() < time {
        std::hint::spin_loop();
    }
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

/// What threads did, in order, and when.
#[derive(Clone, Default)]
struct Diary(Arc<Mutex<Vec<(&'static str, Duration)>>>);

impl Diary {
    fn note(&self, simulation: &Simulation, what: &'static str) {
        self.0.lock().unwrap().push((what, now(simulation)));
    }

    fn words(&self) -> Vec<&'static str> {
        self.0.lock().unwrap().iter().map(|(what, _)| *what).collect()
    }
}

/// Does something in a thread of its own.
fn aside<T: Send + 'static>(
    simulation: &Arc<Simulation>,
    act: impl FnOnce(&Arc<Simulation>) -> T + Send + 'static,
) -> thread::JoinHandle<T> {
    let simulation = Arc::clone(simulation);
    thread::spawn(move || act(&simulation))
}

#[test]
fn a_virtual_pause_jumps_to_its_end() {
    let simulation = simulation(Clock::Virtual);
    wait(&simulation, ms(3000));
    assert_eq!(now(&simulation), ms(3000));
    wait(&simulation, Duration::ZERO);
    assert_eq!(now(&simulation), ms(3000));
}

#[test]
fn virtual_reads_and_writes_take_a_little_time_and_a_call_takes_none() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    access::read(&simulation, access::SOME);
    assert_eq!(now(&simulation), Duration::from_micros(500));
    access::write(&simulation, "tacho-motor/motor1/speed_sp", "0");
    call(&simulation, "");
    assert_eq!(now(&simulation), Duration::from_micros(600));
}

#[test]
fn waits_end_in_the_order_of_their_moments() {
    let simulation = simulation(Clock::Virtual);
    let diary = Diary::default();
    thread::scope(|scope| {
        for (what, time) in [("last", 500), ("first", 200), ("second", 300)] {
            let (simulation, diary) = (Arc::clone(&simulation), diary.clone());
            scope.spawn(move || {
                wait(&simulation, ms(time));
                diary.note(&simulation, what);
            });
        }
    });
    assert_eq!(diary.words(), ["first", "second", "last"]);
}

#[test]
fn threads_that_wait_in_turn_do_the_same_each_time() {
    let simulation = simulation(Clock::Virtual);
    let run = || {
        simulation.machine().restore(
            Machine::new(&WorldSpec::default(), &default_robot(), Options::default()).unwrap(),
        );
        let diary = Diary::default();
        thread::scope(|scope| {
            for (what, period) in [("a", 7), ("b", 3), ("c", 5)] {
                let (simulation, diary) = (Arc::clone(&simulation), diary.clone());
                scope.spawn(move || {
                    for _ in 0..20 {
                        call(&simulation, what);
                        access::read(&simulation, access::SOME);
                        diary.note(&simulation, what);
                        wait(&simulation, ms(period));
                    }
                });
            }
        });
        Arc::into_inner(diary.0).unwrap().into_inner().unwrap()
    };
    let first = run();
    for _ in 0..5 {
        assert_eq!(run(), first);
    }
}

#[test]
fn a_thread_that_ends_or_is_joined_passes_the_turn_on() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let child = aside(&simulation, move |simulation| wait(simulation, ms(100)));
    child.join().unwrap();
    assert_eq!(now(&simulation), ms(100));
    wait(&simulation, ms(50));
    assert_eq!(now(&simulation), ms(150));
}

#[test]
fn a_thread_that_waits_for_a_message_passes_the_turn_on_and_comes_back() {
    let simulation = simulation(Clock::Virtual);
    let (sender, messages) = channel();
    let diary = Diary::default();
    let child = {
        let (simulation, diary) = (Arc::clone(&simulation), diary.clone());
        thread::spawn(move || {
            for _ in 0..3 {
                wait(&simulation, ms(30));
                diary.note(&simulation, "sends");
                sender.send(()).unwrap();
            }
        })
    };
    call(&simulation, "");
    while messages.recv().is_ok() {
        call(&simulation, "");
        diary.note(&simulation, "gets");
    }
    child.join().unwrap();
    assert_eq!(diary.words(), ["sends", "gets", "sends", "gets", "sends", "gets"]);
    assert!(now(&simulation) < ms(91), "{:?}", now(&simulation));
}

#[test]
fn time_stands_while_a_thread_computes() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let child = aside(&simulation, move |simulation| wait(simulation, ms(10)));
    compute(ms(1000));
    assert_eq!(now(&simulation), Duration::ZERO);
    child.join().unwrap();
}

#[test]
fn time_waits_for_a_new_thread_however_late_it_comes() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let child = aside(&simulation, move |simulation| {
        compute(ms(100));
        call(simulation, "");
        now(simulation)
    });
    wait(&simulation, ms(1000));
    assert!(child.join().unwrap() < ms(1));
}

#[test]
fn a_turn_that_was_kept_for_one_call_is_not_kept_for_later_ones() {
    static HAS_OTHERS: AtomicBool = AtomicBool::new(false);
    let simulation = simulation_with(Clock::Virtual, || HAS_OTHERS.load(Ordering::SeqCst));
    // No thread of the program, but one that the clock waits for: the turn comes after a sleep.
    let stranger = thread::spawn(|| compute(ms(50)));
    call(&simulation, "");
    stranger.join().unwrap();
    HAS_OTHERS.store(true, Ordering::SeqCst);
    let child = aside(&simulation, move |simulation| {
        compute(ms(50));
        call(simulation, "");
        now(simulation)
    });
    call(&simulation, "");
    access::read(&simulation, access::SOME);
    wait(&simulation, ms(1000));
    assert_eq!(child.join().unwrap(), Duration::from_micros(10));
}

#[test]
fn newcomers_go_in_the_order_of_what_they_are_about_to_do() {
    let simulation = simulation(Clock::Virtual);
    for names in [["a", "b", "c"], ["c", "b", "a"], ["b", "c", "a"]] {
        let diary = Diary::default();
        call(&simulation, "");
        thread::scope(|scope| {
            for what in names {
                let (simulation, diary) = (Arc::clone(&simulation), diary.clone());
                scope.spawn(move || {
                    call(&simulation, what);
                    diary.note(&simulation, what);
                });
            }
        });
        assert_eq!(diary.words(), ["a", "b", "c"]);
    }
}

#[test]
fn newcomers_that_are_about_to_do_the_same_go_in_the_order_of_age() {
    let simulation = simulation(Clock::Virtual);
    let diary = Diary::default();
    call(&simulation, "");
    thread::scope(|scope| {
        for what in ["first", "second", "third"] {
            let (simulation, diary) = (Arc::clone(&simulation), diary.clone());
            scope.spawn(move || {
                call(&simulation, "the same");
                diary.note(&simulation, what);
            });
        }
    });
    assert_eq!(diary.words(), ["first", "second", "third"]);
}

#[test]
fn a_thread_that_only_asks_for_the_time_lets_others_go_on() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let child = aside(&simulation, move |simulation| wait(simulation, ms(2)));
    while now(&simulation) < ms(2) {
        call(&simulation, "");
    }
    child.join().unwrap();
}

#[test]
fn a_thread_that_polls_sees_each_moment_beside_one_that_waits_for_long() {
    let simulation = simulation(Clock::Virtual);
    let (sender, is_over) = channel();
    let child = aside(&simulation, move |simulation| {
        call(simulation, "");
        let end = now(simulation) + ms(3_600_000);
        while !simulation.pause(end) && is_over.try_recv().is_err() {}
    });
    let mut last = now(&simulation);
    for _ in 0..100 {
        call(&simulation, "");
        access::read(&simulation, access::SOME);
        assert!(now(&simulation) < last + ms(1));
        last = now(&simulation);
    }
    sender.send(()).unwrap();
    compute(ms(50));
    child.join().unwrap();
}

#[test]
fn who_waits_can_handle_signals_and_keeps_its_place() {
    let simulation = simulation(Clock::Virtual);
    let diary = Diary::default();
    let (sender, returns) = channel();
    call(&simulation, "");
    thread::scope(|scope| {
        for what in ["older", "younger"] {
            let (simulation, diary, sender) =
                (Arc::clone(&simulation), diary.clone(), sender.clone());
            scope.spawn(move || {
                call(&simulation, what);
                let end = ms(100);
                while !simulation.pause(end) {
                    sender.send(what).unwrap();
                }
                diary.note(&simulation, what);
            });
        }
        // Both wait for the same moment, and come back for signals while this computes.
        wait(&simulation, ms(50));
        let mut left = vec!["older", "younger"];
        while !left.is_empty() {
            left.retain(|what| !returns.try_iter().any(|other| other == *what));
        }
    });
    assert_eq!(diary.words(), ["older", "younger"]);
    assert_eq!(now(&simulation), ms(100));
}

#[test]
fn who_gets_the_turn_after_a_wait_first_handles_the_signals_sent_before() {
    let simulation = simulation(Clock::Virtual);
    let is_signaled = AtomicBool::new(false);
    thread::scope(|scope| {
        let sleeper = scope.spawn(|| {
            let end = ms(1000);
            while now(&simulation) < end && !is_signaled.load(Ordering::SeqCst) {
                simulation.pause(end);
            }
            now(&simulation)
        });
        wait(&simulation, ms(100));
        let signaled_at = now(&simulation);
        is_signaled.store(true, Ordering::SeqCst);
        assert_eq!(sleeper.join().unwrap(), signaled_at);
    });
}

#[test]
fn a_turn_that_does_not_come_can_be_given_up() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let (sender, given_up) = channel();
    let child = aside(&simulation, move |simulation| {
        let turned = simulation.turn(&mut String::new);
        sender.send(()).unwrap();
        turned
    });
    while given_up.try_recv().is_err() {}
    assert!(!child.join().unwrap());
    wait(&simulation, ms(10));
    assert_eq!(now(&simulation), ms(10));
}

#[test]
fn an_access_without_a_turn_does_not_wait_for_ever() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "");
    let child = aside(&simulation, move |simulation| {
        access::write(simulation, "tacho-motor/motor1/speed_sp", "0");
    });
    while !child.is_finished() {}
    child.join().unwrap();
    assert_eq!(now(&simulation), Duration::from_micros(100));
}

#[test]
fn an_act_runs_at_exactly_its_times() {
    let simulation = simulation(Clock::Virtual);
    let (act, times) = reporter(&simulation, ms(20));
    simulation.repeat(ms(20), act);
    wait(&simulation, ms(70));
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
    wait(&simulation, ms(100));
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
        access::read(&simulation, access::SOME);
        access::write(&simulation, "tacho-motor/motor1/speed_sp", "0");
        let after = simulation.machine().now();
        sender.send((simulation.is_acting(), before == after)).ok().map(|()| ms(10))
    };
    simulation.repeat(ms(10), Box::new(act));
    wait(&simulation, ms(25));
    assert_eq!(receiver.try_iter().collect::<Vec<_>>(), [(true, true); 2]);
    assert!(!simulation.is_acting());
}

#[test]
fn accesses_run_no_act_and_the_next_call_does() {
    let simulation = simulation(Clock::Virtual);
    let (act, times) = reporter(&simulation, ms(1));
    simulation.repeat(Duration::from_micros(50), act);
    call(&simulation, "");
    access::write(&simulation, "tacho-motor/motor1/speed_sp", "0");
    access::read(&simulation, access::SOME);
    assert_eq!(times.try_iter().count(), 0);
    call(&simulation, "");
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [Duration::from_micros(600)]);
    wait(&simulation, ms(1));
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [Duration::from_micros(1050)]);
}

#[test]
fn an_act_goes_on_after_the_machine_is_restored() {
    let simulation = simulation(Clock::Virtual);
    let snapshot = simulation.machine().clone();
    let (act, times) = reporter(&simulation, ms(10));
    simulation.repeat(ms(10), act);
    wait(&simulation, ms(1000));
    assert_eq!(times.try_iter().count(), 100);
    simulation.machine().restore(snapshot);
    assert_eq!(now(&simulation), Duration::ZERO);
    wait(&simulation, ms(25));
    assert_eq!(times.try_iter().collect::<Vec<_>>(), [ms(10), ms(20)]);
}

#[test]
fn waiting_for_a_button_jumps_to_the_planned_press() {
    let simulation = simulation(Clock::Virtual);
    simulation.machine().plan_button(Button::Up, true, ms(400));
    call(&simulation, "");
    while !simulation.pause_for_button(ms(10_000)) {}
    assert!(simulation.machine().is_pressed(Button::Up));
    assert!((ms(400)..=ms(404)).contains(&now(&simulation)), "{:?}", now(&simulation));
}

#[test]
fn who_waits_for_a_button_lets_others_press_it_at_their_time() {
    let simulation = simulation(Clock::Virtual);
    let finger = aside(&simulation, move |simulation| {
        wait(simulation, ms(50));
        simulation.machine().press(Button::Up);
    });
    call(&simulation, "");
    while !simulation.machine().is_pressed(Button::Up) {
        let end = now(&simulation) + ms(20);
        while !simulation.pause_for_button(end) {}
    }
    finger.join().unwrap();
    assert!((ms(50)..ms(71)).contains(&now(&simulation)), "{:?}", now(&simulation));
}

#[test]
fn the_wall_clock_runs_by_itself_and_returns_early_from_long_waits() {
    let simulation = simulation(Clock::Wall(10.0));
    let (act, times) = reporter(&simulation, ms(100));
    simulation.repeat(ms(100), act);
    assert!(simulation.pause(ms(3_600_000)));
    assert!(now(&simulation) < ms(3_600_000));
    times.recv_timeout(Duration::from_secs(300)).unwrap();
    // Reading takes no time of its own, and dropping ends the thread.
    drop(simulation);
    while times.recv().is_ok() {}
}

#[test]
fn a_machine_whose_clock_is_late_is_on_time_when_it_is_used() {
    let machine = Machine::new(&WorldSpec::default(), &default_robot(), Options::default());
    let shared = Shared::new(machine.unwrap());
    shared.follow(10.0);
    compute(ms(20));
    assert!(shared.lock().now() >= ms(200));
}

#[test]
fn a_short_wait_by_the_wall_is_no_shorter_for_the_machine() {
    let machine = Machine::new(&WorldSpec::default(), &default_robot(), Options::default());
    let shared = Shared::new(machine.unwrap());
    shared.follow(1.0);
    let before = shared.lock().now();
    compute(ms(3));
    assert!(shared.lock().now() >= before + ms(3));
}

/// What a program does that drives, waits and reads, with the time at each step.
fn drives(simulation: &Simulation) -> Vec<(Duration, String)> {
    let mut seen = Vec::new();
    let write = |path, text| access::write(simulation, path, text);
    write("tacho-motor/motor1/speed_sp", "300");
    write("tacho-motor/motor1/command", "run-forever");
    for _ in 0..3 {
        wait(simulation, ms(70));
        call(simulation, "read");
        let text = access::read(simulation, "tacho-motor/motor1/position");
        seen.push((now(simulation), text));
    }
    seen
}

#[test]
fn a_run_is_the_same_at_any_pace() {
    let free = drives(&simulation(Clock::Virtual));
    let paced = simulation(Clock::Virtual);
    paced.set_pace(Some(2.0));
    let begun = Instant::now();
    assert_eq!(drives(&paced), free);
    assert!(begun.elapsed() >= ms(60), "{:?}", begun.elapsed());
}

#[test]
fn a_paused_run_goes_on_as_far_as_it_may() {
    let free = drives(&simulation(Clock::Virtual));
    let paused = simulation(Clock::Virtual);
    paused.set_paused(true);
    let driver = {
        let paused = Arc::clone(&paused);
        thread::spawn(move || drives(&paused))
    };
    paused.allow(ms(100));
    // The driver has its turn only when all others rest, or are outside.
    ev3_sim::stay_outside(true);
    while now(&paused) < ms(100) {
        thread::yield_now();
    }
    // It asks again and again, and time stands.
    thread::sleep(ms(50));
    assert!(now(&paused) < ms(110), "{:?}", now(&paused));
    assert!(paused.is_held());
    ev3_sim::stay_outside(false);
    paused.set_paused(false);
    assert!(!paused.is_held());
    assert_eq!(driver.join().unwrap(), free);
}

#[test]
fn a_hand_from_outside_needs_no_turn_and_takes_no_time() {
    let simulation = simulation(Clock::Virtual);
    call(&simulation, "hold the turn");
    let before = now(&simulation);
    let hand = aside(&simulation, move |simulation| {
        ev3_sim::stay_outside(true);
        call(simulation, "reach in");
        access::write(simulation, "tacho-motor/motor1/command", "stop");
    });
    hand.join().unwrap();
    assert_eq!(now(&simulation), before);
}
