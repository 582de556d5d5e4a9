//! The processor of a brick that is one of several in a world, on the virtual clock. What its
//! program does takes no time of the others.
use crate::shared::Crowd;
use ev3_os::locked;
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// How far it may be behind with its accesses before the next call waits for it: a tick of the
/// kernel's motor loop.
const BEHIND: Duration = Duration::from_millis(2);

/// How many calls begin at one moment before other threads are looked at.
const CALLS: u32 = 32;

#[derive(Debug)]
pub(super) struct Processor {
    /// The robots in its world, whose time passes together.
    pub(super) crowd: Arc<Crowd>,
    /// Up to when it is busy.
    busy: Mutex<Duration>,
    /// How many calls began at this moment without a look at other threads.
    begun: Mutex<(Duration, u32)>,
}

impl Processor {
    pub(super) fn new(crowd: Arc<Crowd>) -> Self {
        Self { crowd, busy: Mutex::default(), begun: Mutex::default() }
    }

    /// Up to when it is busy.
    pub(super) fn busy(&self) -> Duration {
        *locked(&self.busy)
    }

    /// It is busy for this much longer.
    pub(super) fn work(&self, now: Duration, takes: Duration) {
        let mut busy = locked(&self.busy);
        *busy = busy.max(now) + takes;
    }

    /// Up to when the next call waits for it, if it does.
    pub(super) fn far_behind(&self, now: Duration) -> Option<Duration> {
        Some(self.busy()).filter(|busy| *busy >= now + BEHIND)
    }

    /// Whether another call may begin at this moment without a look at other threads.
    pub(super) fn may_begin(&self, now: Duration) -> bool {
        let mut begun = locked(&self.begun);
        if begun.0 != now {
            *begun = (now, 0);
        }
        begun.1 += 1;
        begun.1 < CALLS
    }
}
