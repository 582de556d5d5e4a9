//! The record of events: the path of the robot, collisions, commands and readings. Memory stays
//! bounded however long a run is.
use crate::log::Log;
use crate::ticks::TICK_US;
use crate::world::ItemId;
use ev3_motion::Pose;
use std::sync::Arc;
use std::time::Duration;

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

/// The name of an attribute's file, in its parts.
#[derive(Clone, Debug)]
pub(crate) struct File {
    pub(crate) class: &'static str,
    pub(crate) device: Arc<str>,
    pub(crate) attribute: &'static str,
}

/// Room for what most files hold.
const SHORT: usize = 22;

/// A text that is noted: without memory of its own if it is short.
#[derive(Clone, Debug)]
enum Text {
    Short(u8, [u8; SHORT]),
    Long(Box<[u8]>),
}

impl Text {
    fn new(text: &[u8]) -> Text {
        let mut short = [0; SHORT];
        match (short.get_mut(..text.len()), u8::try_from(text.len())) {
            (Some(room), Ok(length)) => {
                room.copy_from_slice(text);
                Text::Short(length, short)
            }
            _ => Text::Long(text.into()),
        }
    }

    fn bytes(&self) -> &[u8] {
        match self {
            Text::Short(length, bytes) => &bytes[..usize::from(*length)],
            Text::Long(bytes) => bytes,
        }
    }
}

/// An event as it is kept: a program that polls makes thousands a second.
#[derive(Clone, Debug)]
struct Noted {
    order: u64,
    at: Duration,
    action: Action,
    file: Option<File>,
    text: Text,
}

impl Noted {
    fn event(&self) -> Event {
        let path = |file: &File| format!("{}/{}/{}", file.class, file.device, file.attribute);
        Event {
            at: self.at,
            action: self.action,
            path: self.file.as_ref().map_or_else(String::new, path),
            text: String::from_utf8_lossy(self.text.bytes()).into_owned(),
        }
    }
}

/// The record of a run. Copies share what they have in common.
#[derive(Clone, Debug)]
pub struct Trace {
    path: Log<(Duration, Pose)>,
    spacing: u64,
    /// Apart, so that a program that polls does not push its own commands out, nor these what it
    /// said; with their order.
    written: Log<Noted>,
    read: Log<Noted>,
    other: Log<Noted>,
    event_count: u64,
    collisions: Log<Collision>,
    collision_count: u32,
}

impl Trace {
    pub(crate) fn new() -> Trace {
        Trace {
            path: Log::new(PATH_POINTS),
            spacing: FIRST_SPACING_TICKS,
            written: Log::new(EVENTS),
            read: Log::new(EVENTS),
            other: Log::new(EVENTS),
            event_count: 0,
            collisions: Log::new(COLLISIONS),
            collision_count: 0,
        }
    }

    /// The way of the robot from the start, oldest first. On long runs points are farther apart.
    pub fn path(&self) -> impl Iterator<Item = &(Duration, Pose)> {
        self.path.iter()
    }

    /// The newest events, oldest first: 4096 writes, 4096 reads, and 4096 others.
    pub fn events(&self) -> Vec<Event> {
        let logs = [&self.written, &self.read, &self.other];
        let mut events: Vec<_> = logs.into_iter().flat_map(Log::iter).collect();
        events.sort_unstable_by_key(|noted| noted.order);
        events.into_iter().map(Noted::event).collect()
    }

    /// The newest collisions, oldest first.
    pub fn collisions(&self) -> impl Iterator<Item = &Collision> {
        self.collisions.iter()
    }

    /// How many collisions there were in all.
    pub fn collision_count(&self) -> u32 {
        self.collision_count
    }

    pub(crate) fn tick(&mut self, tick: u64, pose: Pose) {
        if tick % self.spacing != 0 {
            return;
        }
        if self.path.newest().take(2).filter(|(_, old)| *old == pose).count() == 2 {
            self.path.pop();
        }
        self.path.push((Duration::from_micros(tick * TICK_US), pose));
        if self.path.len() >= PATH_POINTS {
            self.path.thin_out();
            self.spacing *= 2;
        }
    }

    /// Notes an event.
    pub(crate) fn event(&mut self, at: Duration, action: Action, file: Option<File>, text: &[u8]) {
        let log = match action {
            Action::Read => &mut self.read,
            Action::Written => &mut self.written,
            _ => &mut self.other,
        };
        let order = self.event_count;
        self.event_count += 1;
        log.push(Noted { order, at, action, file, text: Text::new(text) });
    }

    pub(crate) fn collision(&mut self, collision: Collision) {
        self.collision_count = self.collision_count.saturating_add(1);
        self.collisions.push(collision);
    }
}
