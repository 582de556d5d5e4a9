//! The record of events: the path of the robot, collisions, commands and readings. Memory stays
//! bounded
//! however long a run is.

use std::collections::VecDeque;
use std::time::Duration;

use crate::world::ItemId;
use crate::world::geometry::Pose;

const PATH_POINTS: usize = 2048;
const EVENTS: usize = 4096;
const COLLISIONS: usize = 256;
/// At first a point of the path is kept every 100 ms.
const FIRST_SPACING_TICKS: u64 = 50;

/// The robot ran into something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Collision {
    /// Virtual time.
    pub at: Duration,
    /// The obstacle.
    pub item: ItemId,
    /// The pose of the robot.
    pub pose: Pose,
}

/// An action of a program on a file or the speaker, or of a person on a button.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// It wrote the text.
    Written,
    /// It read the text: recorded for the values of sensors.
    Read,
    /// It made a tone. The text is its pitch in Hz; 0 is silence.
    Tone,
    /// It said the text.
    Said,
    /// It played a file.
    Played,
    /// It ended what it said or played.
    Silenced,
    /// Somebody pressed a key.
    Pressed,
    /// Somebody let go of a key.
    Released,
}

/// One access to a file, or one thing heard or pressed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Event {
    /// Virtual time.
    pub at: Duration,
    /// The action.
    pub action: Action,
    /// Path below the class directory; empty if there is no file.
    pub path: String,
    /// The text, without the newline at its end.
    pub text: String,
}

/// The record of a run.
#[derive(Clone, Debug)]
pub struct Trace {
    path: Vec<(Duration, Pose)>,
    spacing: u64,
    /// Apart, so that a program that polls does not push its own commands out; with their order.
    written: VecDeque<(u64, Event)>,
    read: VecDeque<(u64, Event)>,
    event_count: u64,
    collisions: VecDeque<Collision>,
    collision_count: u32,
}

impl Trace {
    pub(crate) fn new() -> Trace {
        Trace {
            path: Vec::new(),
            spacing: FIRST_SPACING_TICKS,
            written: VecDeque::new(),
            read: VecDeque::new(),
            event_count: 0,
            collisions: VecDeque::new(),
            collision_count: 0,
        }
    }

    /// The way of the robot from the start, oldest first. On long runs points are farther apart.
    #[must_use]
    pub fn path(&self) -> &[(Duration, Pose)] {
        &self.path
    }

    /// The newest accesses to files, oldest first: 4096 writes and 4096 reads.
    #[must_use]
    pub fn events(&self) -> Vec<&Event> {
        let mut events: Vec<_> = self.written.iter().chain(&self.read).collect();
        events.sort_unstable_by_key(|(order, _)| *order);
        events.into_iter().map(|(_, event)| event).collect()
    }

    /// The newest collisions, oldest first.
    pub fn collisions(&self) -> impl Iterator<Item = &Collision> {
        self.collisions.iter()
    }

    /// How many collisions there were in all.
    #[must_use]
    pub fn collision_count(&self) -> u32 {
        self.collision_count
    }

    pub(crate) fn tick(&mut self, tick: u64, at: Duration, pose: Pose) {
        if tick % self.spacing != 0 {
            return;
        }
        let still = |(_, old): &(Duration, Pose)| *old == pose;
        if self.path.len() >= 2 && self.path[self.path.len() - 2..].iter().all(still) {
            self.path.pop();
        }
        self.path.push((at, pose));
        if self.path.len() >= PATH_POINTS {
            let mut index = 0;
            self.path.retain(|_| {
                index += 1;
                index % 2 == 1
            });
            self.spacing *= 2;
        }
    }

    /// Notes an event. The path is given in its parts.
    pub(crate) fn event(&mut self, at: Duration, action: Action, path: &[&str], text: &str) {
        let ring = match action {
            Action::Read => &mut self.read,
            _ => &mut self.written,
        };
        // The strings of the one that is forgotten serve again.
        let forgotten = if ring.len() == EVENTS { ring.pop_front() } else { None };
        let (mut old_path, mut old_text) =
            forgotten.map_or_else(Default::default, |(_, event)| (event.path, event.text));
        old_path.clear();
        for (index, part) in path.iter().enumerate() {
            if index > 0 {
                old_path.push('/');
            }
            old_path.push_str(part);
        }
        old_text.clear();
        old_text.push_str(text);
        ring.push_back((self.event_count, Event { at, action, path: old_path, text: old_text }));
        self.event_count += 1;
    }

    pub(crate) fn collision(&mut self, collision: Collision) {
        self.collision_count = self.collision_count.saturating_add(1);
        if self.collisions.len() == COLLISIONS {
            self.collisions.pop_front();
        }
        self.collisions.push_back(collision);
    }
}
