//! The brick's panel: its buttons, its speaker and its screen.
use crate::brick::screen::{Depth, HEIGHT};
use crate::ticks::TICK_US;
use std::collections::VecDeque;
use std::fmt;
use std::str::FromStr;
use std::sync::Arc;
use std::time::Duration;

/// How many events a reader may be behind; evdev keeps about as many.
const EVENTS: usize = 64;

/// The range of the kernel's tone generator, in Hz. It clamps what is written to it.
const TONES: (i32, i32) = (100, 10_000);

/// A button of the brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[expect(missing_docs, reason = "the names say it")]
pub enum Button {
    Up,
    Down,
    Left,
    Right,
    Enter,
    Back,
}

/// Names of the buttons, and the codes of the keys that the device tree gives them
/// (linux/input-event-codes.h: `KEY_UP` and its like, `KEY_BACKSPACE` for back).
const BUTTONS: [(Button, &str, u16); 6] = [
    (Button::Up, "up", 103),
    (Button::Down, "down", 108),
    (Button::Left, "left", 105),
    (Button::Right, "right", 106),
    (Button::Enter, "enter", 28),
    (Button::Back, "back", 14),
];

impl Button {
    pub(crate) const fn code(self) -> u16 {
        BUTTONS[self as usize].2
    }

    /// The codes of all buttons.
    pub(crate) fn codes() -> impl Iterator<Item = u16> {
        BUTTONS.iter().map(|(_, _, code)| *code)
    }
}

impl fmt::Display for Button {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(BUTTONS[*self as usize].1)
    }
}

/// A word that names no button.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("no such button: {0}")]
pub struct UnknownButton(pub String);

impl FromStr for Button {
    type Err = UnknownButton;

    fn from_str(word: &str) -> Result<Button, UnknownButton> {
        let found = BUTTONS.iter().find(|(_, name, _)| *name == word);
        found.map(|(button, ..)| *button).ok_or_else(|| UnknownButton(word.to_owned()))
    }
}

/// A press or a release of a button.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ButtonEvent {
    pub(crate) at: Duration,
    pub(crate) button: Button,
    pub(crate) is_press: bool,
}

/// The state of buttons, speaker and screen.
#[derive(Clone, Debug)]
pub(crate) struct Panel {
    down: Vec<Button>,
    /// The newest events.
    events: VecDeque<ButtonEvent>,
    /// How many events there were in all.
    pub(crate) event_count: u64,
    /// Presses and releases to come, in the order of time.
    planned: VecDeque<ButtonEvent>,
    /// What the tone generator plays, in Hz; 0 is silence.
    tone: u32,
    /// In percent.
    pub(crate) volume: u8,
    /// The content of the screen. Snapshots share it until it changes.
    pub(crate) screen: Arc<Vec<u8>>,
    /// How often that was written.
    pub(crate) drawn: u64,
}

impl Panel {
    pub(crate) fn new(depth: Depth) -> Panel {
        let white = match depth {
            Depth::One => 0,
            Depth::ThirtyTwo => 0xff,
        };
        Panel {
            down: Vec::new(),
            events: VecDeque::new(),
            event_count: 0,
            planned: VecDeque::new(),
            tone: 0,
            volume: 100,
            screen: Arc::new(vec![white; depth.stride() * HEIGHT]),
            drawn: 0,
        }
    }

    pub(crate) fn is_down(&self, button: Button) -> bool {
        self.down.contains(&button)
    }

    /// Presses or releases a button; false if that changes nothing.
    pub(crate) fn set(&mut self, event: ButtonEvent) -> bool {
        let ButtonEvent { button, is_press, .. } = event;
        if self.is_down(button) == is_press {
            return false;
        }
        if is_press {
            self.down.push(button);
        } else {
            self.down.retain(|other| *other != button);
        }
        if self.events.len() == EVENTS {
            self.events.pop_front();
        }
        self.events.push_back(event);
        self.event_count += 1;
        true
    }

    /// The event with a number, counted from 0. If that is gone, the oldest one left.
    pub(crate) fn event(&self, number: u64) -> Option<(u64, ButtonEvent)> {
        let oldest = self.event_count - self.events.len() as u64;
        let number = number.max(oldest);
        let index = usize::try_from(number - oldest).ok()?;
        self.events.get(index).map(|event| (number, *event))
    }

    /// Plans a press or a release, after those that are planned for the same time.
    pub(crate) fn plan(&mut self, event: ButtonEvent) {
        let place = self.planned.partition_point(|other| other.at <= event.at);
        self.planned.insert(place, event);
    }

    /// When the next planned event is due.
    pub(crate) fn next_planned(&self) -> Option<Duration> {
        self.planned.front().map(|event| event.at)
    }

    /// When the next planned event is due, in ticks.
    pub(crate) fn next_tick(&self) -> Option<u64> {
        let at = self.next_planned()?;
        u64::try_from(at.as_micros()).ok().map(|at| at.div_ceil(TICK_US))
    }

    /// Removes the next planned event, if it is due.
    pub(crate) fn take_planned(&mut self, now: Duration) -> Option<ButtonEvent> {
        if self.next_planned()? <= now { self.planned.pop_front() } else { None }
    }

    /// What the tone generator plays, in Hz; 0 is silence.
    pub(crate) fn tone(&self) -> u32 {
        self.tone
    }

    pub(crate) fn set_tone(&mut self, hertz: i32) {
        let clamped = if hertz <= 0 { 0 } else { hertz.clamp(TONES.0, TONES.1) };
        self.tone = clamped.unsigned_abs();
    }
}
