//! What a person sees, hears and presses: keys, speaker and screen of the brick.

use std::collections::VecDeque;
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

use crate::TICK_US;
use crate::machine::Machine;
use crate::trace::Action;

/// As many events as a reader may be behind; evdev keeps about so many, too.
const EVENTS: usize = 64;

/// The screen is so wide and so high, in pixels.
pub(crate) const WIDTH: usize = 178;
pub(crate) const HEIGHT: usize = 128;

/// The kernel's tone generator makes what is asked of it fit this range, in Hz.
const TONES: (i32, i32) = (100, 10_000);

/// How long speech takes, a letter; espeak says some 15 of them a second.
const LETTER: Duration = Duration::from_millis(65);

/// A key of the brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "they are called so")]
pub enum Key {
    Up,
    Down,
    Left,
    Right,
    Enter,
    Back,
}

/// Names of the keys, and the codes that the device tree gives them
/// (linux/input-event-codes.h: `KEY_UP` and so on, `KEY_BACKSPACE` for back).
const KEYS: [(Key, &str, u16); 6] = [
    (Key::Up, "up", 103),
    (Key::Down, "down", 108),
    (Key::Left, "left", 105),
    (Key::Right, "right", 106),
    (Key::Enter, "enter", 28),
    (Key::Back, "back", 14),
];

impl Key {
    pub(crate) const fn code(self) -> u16 {
        KEYS[self as usize].2
    }

    /// The codes of all keys.
    pub(crate) fn codes() -> impl Iterator<Item = u16> {
        KEYS.iter().map(|(_, _, code)| *code)
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(KEYS[*self as usize].1)
    }
}

/// A word that is no key's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such key: {0}")]
pub struct UnknownKey(pub String);

impl FromStr for Key {
    type Err = UnknownKey;

    fn from_str(word: &str) -> Result<Key, UnknownKey> {
        let found = KEYS.iter().find(|(_, name, _)| *name == word);
        found.map(|(key, ..)| *key).ok_or_else(|| UnknownKey(word.to_owned()))
    }
}

/// How many bits the screen has for a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Depth {
    /// One, 1 is black, the least significant on the left; a line has 24 bytes. The screen of
    /// ev3dev-jessie.
    One,
    /// 32: blue, green, red and nothing; a line has 712 bytes. The screen of ev3dev-stretch.
    #[default]
    ThirtyTwo,
}

impl Depth {
    /// Bits for a pixel.
    pub(crate) const fn bits(self) -> usize {
        match self {
            Depth::One => 1,
            Depth::ThirtyTwo => 32,
        }
    }

    /// Bytes for a line.
    pub(crate) const fn stride(self) -> usize {
        match self {
            Depth::One => 24,
            Depth::ThirtyTwo => WIDTH * 4,
        }
    }
}

/// A key that is pressed or released.
#[derive(Clone, Copy, Debug)]
pub(crate) struct KeyEvent {
    pub(crate) at: Duration,
    pub(crate) key: Key,
    pub(crate) is_press: bool,
}

#[derive(Clone, Debug)]
pub(crate) struct Front {
    down: Vec<Key>,
    /// The newest events, and how many there were in all.
    events: VecDeque<KeyEvent>,
    pub(crate) event_count: u64,
    /// What will be done to the keys, in the order of time.
    planned: VecDeque<KeyEvent>,
    /// What the tone generator plays, in Hz; 0 is silence.
    tone: u32,
    /// In percent.
    volume: u8,
    /// What the screen shows. Shared between snapshots until it changes.
    pub(crate) screen: Arc<Vec<u8>>,
}

impl Front {
    pub(crate) fn new(depth: Depth) -> Front {
        let white = match depth {
            Depth::One => 0,
            Depth::ThirtyTwo => 0xff,
        };
        Front {
            down: Vec::new(),
            events: VecDeque::new(),
            event_count: 0,
            planned: VecDeque::new(),
            tone: 0,
            volume: 100,
            screen: Arc::new(vec![white; depth.stride() * HEIGHT]),
        }
    }

    pub(crate) fn is_down(&self, key: Key) -> bool {
        self.down.contains(&key)
    }

    /// Event number so and so, counted from 0; the oldest that is left, where that is gone.
    pub(crate) fn event(&self, number: u64) -> Option<(u64, KeyEvent)> {
        let oldest = self.event_count - self.events.len() as u64;
        let number = number.max(oldest);
        let index = usize::try_from(number - oldest).ok()?;
        self.events.get(index).map(|event| (number, *event))
    }

    /// When the next planned thing happens, in ticks.
    pub(crate) fn next_tick(&self) -> Option<u64> {
        let at = self.planned.front()?.at;
        u64::try_from(at.as_micros()).ok().map(|at| at.div_ceil(TICK_US))
    }
}

impl Machine {
    /// Presses a key, and holds it. The kernel tells of a key that is down already once only.
    pub fn press(&mut self, key: Key) {
        self.set_key(KeyEvent { at: self.now, key, is_press: true });
    }

    /// Lets go of a key.
    pub fn release(&mut self, key: Key) {
        self.set_key(KeyEvent { at: self.now, key, is_press: false });
    }

    /// A key is pressed, or let go of, when so much virtual time has passed.
    pub fn plan_key(&mut self, key: Key, is_press: bool, after: Duration) {
        let at = self.now.saturating_add(after);
        let place = self.front.planned.partition_point(|event| event.at <= at);
        self.front.planned.insert(place, KeyEvent { at, key, is_press });
    }

    /// True while somebody holds the key.
    #[must_use]
    pub fn is_pressed(&self, key: Key) -> bool {
        self.front.is_down(key)
    }

    /// How often a key was pressed or let go of.
    #[must_use]
    pub fn key_events(&self) -> u64 {
        self.front.event_count
    }

    /// When a key that is planned is next pressed or let go of.
    #[must_use]
    pub fn next_key(&self) -> Option<Duration> {
        self.front.planned.front().map(|event| event.at)
    }

    fn set_key(&mut self, event: KeyEvent) {
        let KeyEvent { at, key, is_press } = event;
        if self.front.is_down(key) == is_press {
            return;
        }
        if is_press {
            self.front.down.push(key);
        } else {
            self.front.down.retain(|other| *other != key);
        }
        if self.front.events.len() == EVENTS {
            self.front.events.pop_front();
        }
        self.front.events.push_back(event);
        self.front.event_count += 1;
        let action = if is_press { Action::Pressed } else { Action::Released };
        self.trace.event(at, action, &[], &key.to_string());
    }

    /// Does to the keys what is planned until this tick.
    pub(crate) fn use_keys(&mut self) {
        let now = Duration::from_micros(self.tick * TICK_US);
        while let Some(event) = self.front.planned.front().copied().filter(|next| next.at <= now) {
            self.front.planned.pop_front();
            self.set_key(event);
        }
    }

    /// What the tone generator plays now, in Hz; 0 is silence.
    #[must_use]
    pub fn tone(&self) -> u32 {
        self.front.tone
    }

    pub(crate) fn set_tone(&mut self, hertz: i32) {
        let clamped = if hertz <= 0 { 0 } else { hertz.clamp(TONES.0, TONES.1) };
        self.front.tone = clamped.unsigned_abs();
        self.heard(Action::Tone, &self.front.tone.to_string());
    }

    /// A program says something; how long that takes.
    pub fn say(&mut self, text: &str) -> Duration {
        self.heard(Action::Said, text);
        LETTER * u32::try_from(text.chars().count()).unwrap_or(u32::MAX)
    }

    /// A program plays a recording.
    pub fn play(&mut self, file: &str) {
        self.heard(Action::Played, file);
    }

    /// A program ends what it says or plays.
    pub fn silence(&mut self) {
        self.heard(Action::Silenced, "");
    }

    /// The volume of speech and recordings, in percent.
    #[must_use]
    pub fn volume(&self) -> u8 {
        self.front.volume
    }

    /// Sets the volume, to 100 percent at most.
    pub fn set_volume(&mut self, percent: u8) {
        self.front.volume = percent.min(100);
    }

    fn heard(&mut self, action: Action, text: &str) {
        self.trace.event(self.now, action, &[], text);
    }
}
