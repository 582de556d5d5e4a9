//! The acts of the program on motors, lights and the loudspeaker, with their times and causes.
//!
//! The journal is a ring of the last [`ROOM`] commands of a tree. It takes its room at the
//! first command; then a command to a motor allocates nothing. The drive notes a course
//! when it begins and when it ends, and not how it steers in between.
//!
//! A cause is a number that stands for a term in Prolog (`private/journal/causes.pl`). Each
//! thread has one at a time.
use crate::class::Class;
use crate::course::{Command, DriveOptions};
use crate::stop_action::StopAction;
use ev3_motion::Pose;
use ev3_os::locked;
use std::cell::Cell;
use std::sync::atomic::{AtomicI32, AtomicU8, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// How many commands are kept.
pub const ROOM: usize = 8192;

/// Why something is done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    /// The number of the cause; 0 if there is none.
    pub cause: u32,
    /// The predicate that the program called: name and arity.
    pub called: Option<(&'static str, u8)>,
}

thread_local! {
    static ORIGIN: Cell<Origin> = const { Cell::new(Origin { cause: 0, called: None }) };
}

/// Why this thread does what it does.
pub fn origin() -> Origin {
    ORIGIN.get()
}

/// Sets the cause of what this thread does.
pub fn set_cause(cause: u32) {
    ORIGIN.set(Origin { cause, ..ORIGIN.get() });
}

/// The program has called a predicate that commands something.
pub fn set_called(name: &'static str, arity: u8) {
    ORIGIN.set(Origin { called: Some((name, arity)), ..ORIGIN.get() });
}

/// What this thread does next has no predicate to name.
pub fn forget_called() {
    ORIGIN.set(Origin { called: None, ..ORIGIN.get() });
}

/// A short text, as of a port. A longer one loses its end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Name {
    bytes: [u8; 23],
    length: u8,
}

impl Name {
    /// The text.
    pub fn text(&self) -> &str {
        let text = self.bytes.get(..self.length.into()).unwrap_or_default();
        std::str::from_utf8(text).unwrap_or_default()
    }
}

impl From<&str> for Name {
    fn from(text: &str) -> Self {
        let mut bytes = [0; 23];
        let mut length = text.len().min(bytes.len());
        while !text.is_char_boundary(length) {
            length -= 1;
        }
        if let (Some(to), Some(from)) = (bytes.get_mut(..length), text.as_bytes().get(..length)) {
            to.copy_from_slice(from);
        }
        #[expect(clippy::cast_possible_truncation, reason = "at most 23")]
        let length = length as u8;
        Self { bytes, length }
    }
}

/// The commands that motors have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word {
    /// `run-forever`
    RunForever,
    /// `run-to-abs-pos`
    RunToAbsPos,
    /// `run-to-rel-pos`
    RunToRelPos,
    /// `run-timed`
    RunTimed,
    /// `run-direct`
    RunDirect,
    /// `stop`
    Stop,
    /// `reset`
    Reset,
    /// `run` of a servo
    Run,
    /// `float` of a servo
    Float,
}

impl Word {
    /// The command of that name.
    fn named(text: &str) -> Option<Self> {
        Some(match text {
            "run-forever" => Self::RunForever,
            "run-to-abs-pos" => Self::RunToAbsPos,
            "run-to-rel-pos" => Self::RunToRelPos,
            "run-timed" => Self::RunTimed,
            "run-direct" => Self::RunDirect,
            "stop" => Self::Stop,
            "reset" => Self::Reset,
            "run" => Self::Run,
            "float" => Self::Float,
            _ => return None,
        })
    }

    /// The kernel's word for it.
    pub fn text(self) -> &'static str {
        match self {
            Self::RunForever => "run-forever",
            Self::RunToAbsPos => "run-to-abs-pos",
            Self::RunToRelPos => "run-to-rel-pos",
            Self::RunTimed => "run-timed",
            Self::RunDirect => "run-direct",
            Self::Stop => "stop",
            Self::Reset => "reset",
            Self::Run => "run",
            Self::Float => "float",
        }
    }

    /// The set-points that it uses, as indices of [`SET_POINTS`], and whether it uses
    /// the stop action.
    fn uses(self, class: Class) -> (&'static [usize], bool) {
        match (self, class) {
            (Self::RunForever, Class::DcMotor) => (&[DUTY, UP], false),
            (Self::RunForever, _) => (&[SPEED, UP], false),
            (Self::RunTimed, Class::DcMotor) => (&[DUTY, TIME, UP, DOWN], true),
            (Self::RunTimed, _) => (&[SPEED, TIME, UP, DOWN], true),
            (Self::RunToAbsPos | Self::RunToRelPos, _) => (&[SPEED, POSITION, UP, DOWN], true),
            (Self::RunDirect, _) => (&[DUTY], false),
            (Self::Stop, _) => (&[DOWN], true),
            (Self::Run, _) => (&[POSITION], false),
            (Self::Reset | Self::Float, _) => (&[], false),
        }
    }
}

/// The set-points that a command copies.
const SET_POINTS: [&str; 6] =
    ["speed_sp", "position_sp", "time_sp", "duty_cycle_sp", "ramp_up_sp", "ramp_down_sp"];
const SPEED: usize = 0;
const POSITION: usize = 1;
const TIME: usize = 2;
const DUTY: usize = 3;
const UP: usize = 4;
const DOWN: usize = 5;

/// A set-point that the program has not written.
const UNKNOWN: i32 = i32::MIN;

/// The set-points of a motor as the program last wrote them.
pub(crate) struct Written {
    numbers: [AtomicI32; SET_POINTS.len()],
    /// One more than its index; 0 if the program has not written it.
    stop_action: AtomicU8,
}

impl Default for Written {
    fn default() -> Self {
        let numbers = std::array::from_fn(|_| AtomicI32::new(UNKNOWN));
        Self { numbers, stop_action: AtomicU8::new(0) }
    }
}

impl Written {
    /// The program has written an attribute.
    pub(crate) fn note(&self, attribute: &str, text: &str) {
        if attribute == "stop_action" {
            let is_it = |action: &StopAction| action.word() == text;
            let index = StopAction::ALL.iter().position(is_it).map_or(0, |index| index + 1);
            self.stop_action.store(u8::try_from(index).unwrap_or(0), Ordering::Relaxed);
        } else if attribute.ends_with("_sp") {
            self.note_number(attribute, text.trim().parse().unwrap_or(i64::MIN));
        }
    }

    /// The program has written a number.
    pub(crate) fn note_number(&self, attribute: &str, number: i64) {
        let index = SET_POINTS.iter().position(|name| *name == attribute);
        if let Some(known) = index.and_then(|index| self.numbers.get(index)) {
            known.store(i32::try_from(number).unwrap_or(UNKNOWN), Ordering::Relaxed);
        }
    }

    /// The motor has been reset.
    pub(crate) fn forget(&self) {
        for number in &self.numbers {
            number.store(UNKNOWN, Ordering::Relaxed);
        }
        self.stop_action.store(0, Ordering::Relaxed);
    }

    fn present(&self) -> SetPoints {
        let numbers = std::array::from_fn(|index| {
            self.numbers.get(index).map_or(UNKNOWN, |number| number.load(Ordering::Relaxed))
        });
        let action = self.stop_action.load(Ordering::Relaxed).checked_sub(1);
        let stop_action = action.and_then(|index| StopAction::ALL.get(usize::from(index)).copied());
        SetPoints { numbers, stop_action }
    }
}

/// The set-points at a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct SetPoints {
    numbers: [i32; SET_POINTS.len()],
    stop_action: Option<StopAction>,
}

/// A command to one motor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MotorCommand {
    /// The class of the motor.
    pub class: Class,
    /// The command.
    pub word: Word,
    set_points: SetPoints,
}

impl MotorCommand {
    /// A command that is known; `None` for any other.
    pub(crate) fn of(class: Class, word: &str, written: &Written) -> Option<Self> {
        Some(Self { class, word: Word::named(word)?, set_points: written.present() })
    }

    /// The set-points that the command uses, as far as the program has written them.
    pub fn numbers(&self) -> impl Iterator<Item = (&'static str, i32)> {
        let (used, _) = self.word.uses(self.class);
        let number = |index: &usize| {
            let number =
                self.set_points.numbers.get(*index).filter(|number| **number != UNKNOWN)?;
            Some((*SET_POINTS.get(*index)?, *number))
        };
        used.iter().filter_map(number)
    }

    /// The stop action, if the command uses it and the program has written it.
    pub fn stop_action(&self) -> Option<StopAction> {
        let (_, uses_action) = self.word.uses(self.class);
        self.set_points.stop_action.filter(|_| uses_action)
    }
}

/// A course of a robot.
#[derive(Clone, Debug)]
pub struct Course {
    /// The ports of the left and of the right motor.
    pub wheels: [Name; 2],
    /// The course.
    pub course: Command,
    /// How it is to be driven.
    pub options: DriveOptions,
}

/// Where the program says that a robot is.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The ports of the left and of the right motor.
    pub wheels: [Name; 2],
    /// Where it is.
    pub pose: Pose,
}

/// A light's new state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightChange {
    /// A color by its name.
    Named(&'static str),
    /// The percentages of its LEDs, the number of which is the second.
    Levels([u8; 3], u8),
    /// What switches it.
    Trigger(Name),
    /// It blinks: milliseconds on and off.
    Blink(i32, i32),
}

impl LightChange {
    /// Percentages of up to three LEDs.
    pub(crate) fn levels(percentages: impl IntoIterator<Item = i64>) -> Self {
        let (mut levels, mut count) = ([0; 3], 0);
        for (level, percent) in levels.iter_mut().zip(percentages) {
            *level = u8::try_from(percent).unwrap_or(100);
            count += 1;
        }
        Self::Levels(levels, count)
    }
}

/// A sound.
#[derive(Clone, Debug)]
pub enum SoundCommand {
    /// Tones in hertz, each with its length.
    Tones(Arc<[(u32, Duration)]>),
    /// A spoken text.
    Say(Arc<str>),
    /// A file.
    Play(Arc<str>),
    /// Silence.
    Stop,
}

/// What was done.
#[derive(Clone, Debug)]
pub enum Act {
    /// A motor got a command.
    Motor(Name, MotorCommand),
    /// The robot began a course.
    Course(Arc<Course>),
    /// The course ended; the reason.
    Ended(Arc<Course>, &'static str),
    /// The robot was given its pose.
    Pose(Box<Place>),
    /// A light changed.
    Light(Name, LightChange),
    /// A sound began.
    Sound(SoundCommand),
}

/// One command.
#[derive(Clone, Debug)]
pub struct Entry {
    /// By the tree's clock.
    pub time: Duration,
    /// What was done.
    pub act: Act,
    /// Why it was done.
    pub origin: Origin,
}

/// The last commands of a program.
#[derive(Default)]
pub struct Journal(Mutex<Ring>);

#[derive(Default)]
struct Ring {
    entries: Vec<Entry>,
    /// Where the next one goes, once the ring is full.
    next: usize,
    /// How many there were in all.
    count: u64,
}

impl Journal {
    /// Notes what is done for this thread's cause.
    pub fn note(&self, time: Duration, act: Act) {
        self.note_for(origin(), time, act);
    }

    /// Notes what is done for a cause.
    pub fn note_for(&self, origin: Origin, time: Duration, act: Act) {
        let entry = Entry { time, act, origin };
        let mut ring = locked(&self.0);
        let next = ring.next;
        ring.count += 1;
        if ring.entries.len() < ROOM {
            if ring.entries.is_empty() {
                // The memory is taken page by page, as the entries come.
                ring.entries.reserve_exact(ROOM);
            }
            ring.entries.push(entry);
        } else if let Some(oldest) = ring.entries.get_mut(next) {
            *oldest = entry;
            ring.next = (next + 1) % ROOM;
        }
    }

    /// The entries, the last first.
    pub fn entries(&self) -> Vec<Entry> {
        let ring = locked(&self.0);
        let (new, old) = ring.entries.split_at(ring.next);
        new.iter().rev().chain(old.iter().rev()).cloned().collect()
    }

    /// What was done after the first `count` commands, as far as it is kept, in its order; and
    /// how many commands there were in all.
    pub fn after(&self, count: u64) -> (Vec<Entry>, u64) {
        let ring = locked(&self.0);
        let new = usize::try_from(ring.count.saturating_sub(count)).unwrap_or(usize::MAX);
        let (late, early) = ring.entries.split_at(ring.next);
        let known = late.len() + early.len();
        let in_order = early.iter().chain(late).skip(known.saturating_sub(new));
        (in_order.cloned().collect(), ring.count)
    }
}

#[cfg(test)]
mod tests {
    #![expect(clippy::unwrap_used, reason = "a test")]
    use super::*;

    fn stop(journal: &Journal, milliseconds: u64) {
        let command = MotorCommand::of(Class::TachoMotor, "stop", &Written::default()).unwrap();
        let act = Act::Motor(Name::from("outA"), command);
        journal.note(Duration::from_millis(milliseconds), act);
    }

    fn times(journal: &Journal) -> Vec<u128> {
        journal.entries().iter().map(|entry| entry.time.as_millis()).collect()
    }

    #[test]
    fn what_is_new_comes_in_its_order() {
        let journal = Journal::default();
        let new = |count| {
            let (entries, count) = journal.after(count);
            let times: Vec<_> = entries.iter().map(|entry| entry.time.as_millis()).collect();
            (times, count)
        };
        assert_eq!(new(0), (vec![], 0));
        let all = u64::try_from(ROOM).unwrap() + 2;
        (0..all).for_each(|time| stop(&journal, time));
        assert_eq!(new(all), (vec![], all));
        assert_eq!(new(all - 2), (vec![u128::from(all) - 2, u128::from(all) - 1], all));
        assert_eq!(new(0).0.len(), ROOM);
    }

    #[test]
    fn the_last_command_is_the_first_entry() {
        let journal = Journal::default();
        assert!(times(&journal).is_empty());
        stop(&journal, 1);
        stop(&journal, 2);
        assert_eq!(times(&journal), [2, 1]);
    }

    #[test]
    fn old_commands_are_forgotten() {
        let journal = Journal::default();
        let count = u64::try_from(ROOM).unwrap() + 3;
        (0..count).for_each(|time| stop(&journal, time));
        let times = times(&journal);
        assert_eq!(times.len(), ROOM);
        assert_eq!(times.first(), Some(&u128::from(count - 1)));
        assert_eq!(times.last(), Some(&3));
        assert!(times.is_sorted_by(|later, earlier| later > earlier));
    }

    #[test]
    fn a_ring_takes_less_than_a_megabyte() {
        assert!(size_of::<Entry>() * ROOM < 1 << 20, "{}", size_of::<Entry>());
    }

    #[test]
    fn a_long_name_loses_its_end() {
        assert_eq!(Name::from("in1:i2c88:M1").text(), "in1:i2c88:M1");
        assert_eq!(
            Name::from("a name of 22 letters: ä, and more").text(),
            "a name of 22 letters: "
        );
    }

    #[test]
    fn a_cause_belongs_to_its_thread() {
        set_cause(7);
        assert_eq!(std::thread::spawn(|| origin().cause).join().unwrap(), 0);
        assert_eq!(origin().cause, 7);
    }
}
