//! The buttons on the brick.
//!
//! The kernel's gpio-keys driver shows them as an event device below `/dev/input`. A reader may ask
//! which buttons are down, and gets an event for each button that is pressed or released after it
//! opened the device. Each reader has a queue of its own.
//!
//! A plain file may stand in for the device: it holds the earlier events, and a
//! reader that waits gets those that are appended.
use crate::devfs::{Devfs, SLICE, Stream, open_first, pause_for};
use crate::error::{Access, Error, Result};
use crate::wait::{AnyWait, Look, Slices, Wait};
use ev3_os::Errno;
use ev3_os::locked;
use std::collections::VecDeque;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The paths of the buttons of each board: EV3 with ev3dev-stretch and with jessie,
/// EVB, `PiStorms`, whose only button is enter.
const DEVICES: [&str; 4] = [
    "input/by-path/platform-gpio_keys-event",
    "input/by-path/platform-gpio-keys.0-event",
    "input/by-path/platform-evb-buttons-event",
    "input/by-path/platform-3f804000.i2c-event",
];

/// From linux/input-event-codes.h.
const EV_KEY: u16 = 1;

/// Codes of buttons are below 768.
const STATE_BYTES: usize = 96;

/// An event of the kernel: a time of two words, then type, code and value.
#[cfg(unix)]
pub(crate) const EVENT_BYTES: usize = size_of::<input_linux::sys::input_event>();
/// The length of an event of the simulated brick.
#[cfg(not(unix))]
pub(crate) const EVENT_BYTES: usize = 2 * size_of::<usize>() + 8;

/// A button of the brick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Button {
    /// The upper one.
    Up,
    /// The lower one.
    Down,
    /// The left one.
    Left,
    /// The right one.
    Right,
    /// The one in the middle.
    Enter,
    /// The one below the screen's left corner; brickrun ends programs by it.
    Back,
}

impl Button {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Up, Self::Down, Self::Left, Self::Right, Self::Enter, Self::Back];

    /// The word programs see.
    pub fn word(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
            Self::Left => "left",
            Self::Right => "right",
            Self::Enter => "enter",
            Self::Back => "back",
        }
    }

    /// The button of that name.
    pub fn named(word: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|button| button.word() == word)
    }

    /// The kernel's code, from linux/input-event-codes.h.
    pub fn code(self) -> u16 {
        match self {
            Self::Up => 103,
            Self::Down => 108,
            Self::Left => 105,
            Self::Right => 106,
            Self::Enter => 28,
            // KEY_BACKSPACE
            Self::Back => 14,
        }
    }

    fn coded(code: u16) -> Option<Self> {
        Self::ALL.into_iter().find(|button| button.code() == code)
    }
}

/// A button was pressed or released.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Event {
    /// The button.
    pub button: Button,
    /// Pressed, else released.
    pub is_press: bool,
}

/// The buttons that are down now; `None` if there are no buttons.
/// Errors: the kernel's, as EACCES for a user who is not in the group `input`.
pub fn pressed(dev: &dyn Devfs) -> Result<Option<Vec<Button>>> {
    let Some((stream, path)) = open_first(dev, &DEVICES, Access::Read)? else {
        return Ok(None);
    };
    let mut bits = [0; STATE_BYTES];
    match stream.key_state(&mut bits) {
        Ok(()) => {
            Ok(Some(Button::ALL.into_iter().filter(|button| is_set(&bits, *button)).collect()))
        }
        // An emulated processor has no words for what the file does not know.
        Err(error) if matches!(Errno::from_io_error(&error), Some(Errno::NOTTY | Errno::NOSYS)) => {
            pressed_in(&*stream, &path).map(Some)
        }
        Err(source) => Err(Error::Read { path, source }),
    }
}

fn is_set(bits: &[u8], button: Button) -> bool {
    let (byte, bit) = (usize::from(button.code() / 8), button.code() % 8);
    bits.get(byte).is_some_and(|byte| byte & (1 << bit) != 0)
}

/// The buttons that are down after all events in a file.
fn pressed_in(stream: &dyn Stream, path: &Path) -> Result<Vec<Button>> {
    let mut queue = Queue::default();
    while queue.fill(stream, path)? {}
    let mut down = Vec::new();
    for event in queue.events {
        down.retain(|button| *button != event.button);
        if event.is_press {
            down.push(event.button);
        }
    }
    Ok(Button::ALL.into_iter().filter(|button| down.contains(button)).collect())
}

/// The events of the buttons from a moment on.
pub struct Events {
    dev: Arc<dyn Devfs>,
    stream: Box<dyn Stream>,
    path: PathBuf,
    queue: Mutex<Queue>,
}

impl Events {
    /// Those from now on; `None` if there are no buttons.
    pub fn from_now(dev: Arc<dyn Devfs>) -> Result<Option<Self>> {
        let Some((stream, path)) = open_first(&*dev, &DEVICES, Access::Read)? else {
            return Ok(None);
        };
        stream.skip().map_err(|source| Error::Read { path: path.clone(), source })?;
        Ok(Some(Self { dev, stream, path, queue: Mutex::default() }))
    }

    /// Waits for the next event of that button, or any, and of that kind, or any; `None`
    /// if there was none in that time.
    ///
    /// The errors are the kernel's.
    pub fn until_next(
        self: &Arc<Self>,
        button: Option<Button>,
        is_press: Option<bool>,
        timeout: Option<Duration>,
    ) -> AnyWait<'static, Option<Event>> {
        let is_it = move |event: &Event| {
            button.is_none_or(|button| button == event.button)
                && is_press.is_none_or(|is_press| is_press == event.is_press)
        };
        self.until(timeout, move |queue| {
            std::iter::from_fn(|| queue.events.pop_front()).find(is_it)
        })
    }

    /// Waits for event number `index` since the beginning. The same number is
    /// the same event each time: what was read is kept.
    ///
    /// The errors are the kernel's.
    pub fn until_nth(self: &Arc<Self>, index: usize) -> AnyWait<'static, Option<Event>> {
        self.until(None, move |queue| queue.events.get(index).copied())
    }

    fn until(
        self: &Arc<Self>,
        timeout: Option<Duration>,
        take: impl FnMut(&mut Queue) -> Option<Event> + Send + 'static,
    ) -> AnyWait<'static, Option<Event>> {
        let end = timeout.map(|timeout| self.dev.now().saturating_add(timeout));
        Slices::new(UntilTaken { events: Arc::clone(self), end, take }).boxed()
    }
}

/// Until an event can be taken from the queue.
struct UntilTaken<T> {
    events: Arc<Events>,
    /// `None` to wait forever.
    end: Option<Duration>,
    take: T,
}

impl<T: FnMut(&mut Queue) -> Option<Event>> Wait for UntilTaken<T> {
    type End = Option<Event>;

    fn look(&mut self) -> Result<Look<Option<Event>>> {
        let Events { dev, stream, path, .. } = &*self.events;
        let mut queue = locked(&self.events.queue);
        while queue.fill(&**stream, path)? {}
        if let Some(event) = (self.take)(&mut queue) {
            return Ok(Look::Over(Some(event)));
        }
        Ok(Look::again(dev.now(), SLICE, self.end, None))
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        pause_for(&*self.events.dev, Some(&*self.events.stream), end)
    }
}

/// Events that were read.
#[derive(Default)]
struct Queue {
    events: VecDeque<Event>,
    /// The beginning of one that is not read wholly.
    rest: Vec<u8>,
}

impl Queue {
    /// Reads more; `false` if there is nothing at present.
    fn fill(&mut self, stream: &dyn Stream, path: &Path) -> Result<bool> {
        let mut buffer = [0; 64 * EVENT_BYTES];
        let length = match stream.read(&mut buffer) {
            Ok(length) => length,
            Err(error) if Errno::from_io_error(&error) == Some(Errno::AGAIN) => 0,
            Err(source) => return Err(Error::Read { path: path.to_owned(), source }),
        };
        self.rest.extend_from_slice(buffer.get(..length).unwrap_or_default());
        let records = self.rest.chunks_exact(EVENT_BYTES);
        let over = records.remainder().to_vec();
        self.events.extend(records.filter_map(event));
        self.rest = over;
        Ok(length > 0)
    }
}

/// The event in a record; `None` if it is not one of our buttons' pressed or
/// released, as one that repeats is not.
fn event(record: &[u8]) -> Option<Event> {
    let (_, payload) = record.split_last_chunk::<8>()?;
    let [t0, t1, c0, c1, value @ ..] = *payload;
    let is_press = match i32::from_ne_bytes(value) {
        0 => false,
        1 => true,
        _ => return None,
    };
    let button = Button::coded(u16::from_ne_bytes([c0, c1]))?;
    (u16::from_ne_bytes([t0, t1]) == EV_KEY).then_some(Event { button, is_press })
}
