//! A machine in another process than its clock, over a socket pair.
#![cfg(unix)]

#[path = "it/robots.rs"]
mod robots;

use ev3_sim::far::wire::{Desk, Line, Next};
use ev3_sim::{Clock, Errno, Simulation};
use robots::default_machine;
use std::os::unix::net::UnixStream;
use std::thread;
use std::time::Duration;

/// Until then the other thread has had a processor.
const WITHIN: Duration = Duration::from_secs(300);

#[test]
fn an_answer_comes_back_through_the_socket() {
    let (program, host) = UnixStream::pair().unwrap();
    let simulation = Simulation::new(default_machine(), Clock::Virtual, || false).unwrap();
    let serves = thread::spawn(move || {
        let mut desk = Desk::new(host, Duration::from_secs(3)).unwrap();
        while let Next::Asked(at) = desk.hear(WITHIN).unwrap() {
            simulation.pause(at);
            desk.answer(&mut simulation.machine(), Duration::ZERO);
        }
    });
    let (line, now) = Line::new(program, || ()).unwrap();
    assert_eq!(now, Duration::from_secs(3));
    let far = Simulation::far(Box::new(line), now, || false).unwrap();
    let names: Vec<_> = far.list("").unwrap().into_iter().map(|(name, _)| name).collect();
    assert!(names.iter().any(|name| name == "power_supply"), "{names:?}");
    assert_eq!(far.list("tacho-motor/motor9"), Err(Errno::ENOENT));
    drop(far);
    serves.join().unwrap();
}

#[test]
fn a_line_that_is_lost_says_so() {
    use std::sync::atomic::{AtomicBool, Ordering};
    static LOST: AtomicBool = AtomicBool::new(false);
    let (program, host) = UnixStream::pair().unwrap();
    drop(Desk::new(host, Duration::ZERO).unwrap());
    let (line, now) = Line::new(program, || LOST.store(true, Ordering::Relaxed)).unwrap();
    let far = Simulation::far(Box::new(line), now, || false).unwrap();
    assert_eq!(far.list(""), Err(Errno(5)));
    assert!(LOST.load(Ordering::Relaxed));
}
