//! The clock sees that all threads rest. It looks at all threads of the process: this is one
//! of its own, with one test.

#[path = "../src/clock/threads.rs"]
mod threads;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::channel;
use std::thread;
use std::time::{Duration, Instant};
use threads::{Id, Threads};

/// A thread that computes until it must sleep, and sleeps until it is woken.
struct Worker {
    id: Id,
    computes: Arc<AtomicBool>,
    thread: thread::JoinHandle<()>,
}

impl Worker {
    fn start(is_outside: bool) -> Self {
        let computes = Arc::new(AtomicBool::new(true));
        let (sender, ids) = channel();
        let thread = {
            let computes = Arc::clone(&computes);
            thread::spawn(move || {
                threads::stay_outside(is_outside);
                sender.send(threads::me()).unwrap();
                while computes.load(Ordering::SeqCst) {
                    std::hint::spin_loop();
                }
                thread::park();
            })
        };
        Self { id: ids.recv().unwrap(), computes, thread }
    }

    fn sleep(&self) {
        self.computes.store(false, Ordering::SeqCst);
    }

    fn end(self) {
        self.sleep();
        self.thread.thread().unpark();
        self.thread.join().unwrap();
    }
}

/// Looks again until all rest, as the clock does, or the machine is much too busy.
fn come_to_rest(threads: &mut Threads, stands: impl Fn(Id) -> bool) -> bool {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(300) {
        if threads.rest(&stands) {
            return true;
        }
    }
    false
}

#[test]
fn all_rest_when_all_others_are_asleep_in_line_or_not() {
    let mut threads = Threads::default();
    assert!(come_to_rest(&mut threads, |_| false));

    let worker = Worker::start(false);
    let in_line = |id| id == worker.id;
    assert!(!threads.rest(|_| false), "a thread computes");
    assert!(threads.rest(in_line), "nobody has run but one in line");
    // It may hold a lock that one waits for who has just fallen asleep.
    assert!(!Threads::default().rest(in_line), "a thread in line has not fallen asleep");
    worker.sleep();
    assert!(come_to_rest(&mut Threads::default(), in_line));
    assert!(come_to_rest(&mut threads, |_| false));
    assert!(threads.rest(|_| false), "nobody has run since");
    assert!(threads.age(threads::me()) < threads.age(worker.id));

    let hand = Worker::start(true);
    assert!(come_to_rest(&mut threads, |_| false), "a hand from outside is not waited for");
    assert_eq!(threads.age(hand.id), None);

    hand.end();
    worker.end();
}
