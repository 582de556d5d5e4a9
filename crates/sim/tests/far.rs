//! A machine in another process than its clock, over a socket pair.
#![cfg(unix)]

#[path = "it/robots.rs"]
mod robots;

use ev3_sim::far::wire::{Desk, Line, Next};
use ev3_sim::{Access, Clock, Errno, Simulation};
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
        let mut desk = Desk::new(host, Duration::from_secs(3), 0).unwrap();
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

/// What a program reads that drives, looks where its wheel is, and does something else at times.
fn positions(simulation: &Simulation) -> Vec<Vec<u8>> {
    let open = |name: &str, access| {
        simulation.open(&format!("tacho-motor/motor0/{name}"), access).unwrap()
    };
    let position = open("position", Access::ReadOnly);
    let [speed, command] = ["speed_sp", "command"].map(|name| open(name, Access::WriteOnly));
    let turn = |turn| {
        let mut buffer = [0; 16];
        let length = simulation.read(position, 0, &mut buffer).unwrap();
        let degrees: &[u8] = if turn % 90 == 89 { b"500" } else { b"300" };
        simulation.write(speed, 0, degrees).unwrap().0.outcome.unwrap();
        simulation.write(command, 0, b"run-forever").unwrap().0.outcome.unwrap();
        if turn % 70 == 0 {
            let end = simulation.machine().now() + Duration::from_millis(3);
            while !simulation.pause(end) {}
        }
        buffer[..length].to_vec()
    };
    (0..400).map(turn).collect()
}

#[test]
fn a_loop_has_the_answers_of_a_machine_here() {
    let simulation = || Simulation::new(default_machine(), Clock::Virtual, || false).unwrap();
    let (program, host) = UnixStream::pair().unwrap();
    let there = simulation();
    let serves = thread::spawn(move || {
        let mut desk = Desk::new(host, there.machine().now(), 0).unwrap();
        while let Next::Asked(at) = desk.hear(WITHIN).unwrap() {
            while !there.pause(at) {}
            let mut machine = there.machine();
            let until = machine.now() + Duration::from_millis(100);
            desk.answer(&mut machine, until);
        }
        there.machine().trace().events()
    });
    let (line, now) = Line::new(program, || ()).unwrap();
    let far = Simulation::far(Box::new(line), now, || false).unwrap();
    let here = simulation();
    assert!(positions(&far) == positions(&here));
    drop(far);
    assert!(serves.join().unwrap() == here.machine().trace().events());
}

#[test]
fn a_line_that_is_lost_says_so() {
    use std::sync::atomic::{AtomicBool, Ordering};
    static LOST: AtomicBool = AtomicBool::new(false);
    let (program, host) = UnixStream::pair().unwrap();
    drop(Desk::new(host, Duration::ZERO, 0).unwrap());
    let (line, now) = Line::new(program, || LOST.store(true, Ordering::Relaxed)).unwrap();
    let far = Simulation::far(Box::new(line), now, || false).unwrap();
    assert_eq!(far.list(""), Err(Errno(5)));
    assert!(LOST.load(Ordering::Relaxed));
}
