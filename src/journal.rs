//! `prolog/ev3dev/journal.pl`, `private/journal/causes.pl`: what was done, and why.
use crate::glue::call::Call;
use crate::glue::places::places_term;
use crate::glue::state::chosen_devices;
use crate::glue::terms::{Prolog, unify_atom};
use ev3_driver::Registry;
use ev3_driver::course::{Command, DriveOptions, Leg};
use ev3_driver::journal::{Act, Course, Entry, LightChange, MotorCommand, Name};
use ev3_driver::journal::{SoundCommand, origin, set_cause};
use ev3_os::locked;
use std::collections::BTreeSet;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, Weak};
use std::time::Duration;
use swipl::prelude::*;

natives! {
    /// cause_(-Cause, -Former): from now on this thread acts for a new cause. The former
    /// one is back as soon as the choice point of this call is gone.
    nondet fn "cause_"<Cause>(_context, cause, former) {
        setup => {
            Cause::begin().map(Some).ok_or(PrologError::Failure)
        },
        call(begun) => {
            if begun.is_over {
                return Err(PrologError::Failure);
            }
            begun.is_over = true;
            cause.unify(u64::from(begun.number))?;
            former.unify(u64::from(begun.former))?;
            Ok(true)
        }
    }

    /// cause_now_(-Cause): 0 if there is none.
    semidet fn "cause_now_"(_context, cause) {
        cause.unify(u64::from(origin().cause))
    }

    /// cause_set_(+Cause)
    semidet fn "cause_set_"(context, cause) as call("because", 2) {
        set_cause(number(&call, cause)?);
        Ok(())
    }

    /// cause_active_(+Cause): some thread or engine still acts for it.
    semidet fn "cause_active_"(context, cause) as call("because", 2) {
        let cause = number(&call, cause)?;
        into_prolog_result(locked(&ACTIVE).contains(&cause))
    }

    /// journal_entry_(-Time, -Act, -Cause, -Called): the last first. Called is
    /// `Name/Arity`, or `none`.
    nondet fn "journal_entry_"<std::vec::IntoIter<Entry>>(context, time, act, cause, called) as call("journal", 1) {
        setup => {
            Ok(Some(call.devices()?.journal().entries().into_iter()))
        },
        call(entries) => {
            let terms = |entry: &Entry| {
                Ok((Maker(&call).act(&entry.act)?, Maker(&call).called(entry)?))
            };
            call.next(entries, terms, |entry, (done, by)| {
                time.unify(seconds(entry.time))?;
                act.unify(done)?;
                cause.unify(u64::from(entry.origin.cause))?;
                called.unify(by)
            })
        }
    }

    /// journal_new_(-Done): terms `done(span(Time, Until, Times), Act, Cause)`, what was done since
    /// the last call, in its order; what a motor got again and again is one.
    semidet fn "journal_new_"(context, done) as call("view", 1) {
        let term = |Again { entry, until, times }: &Again| {
            let maker = Maker(&call);
            let [from, until] = [entry.time, *until].map(seconds);
            let span = [maker.number(from)?, maker.number(until)?, maker.number(*times)?];
            let cause = maker.number(u64::from(entry.origin.cause))?;
            maker.compound("done", &[maker.compound("span", &span)?, maker.act(&entry.act)?, cause])
        };
        let terms = merged(new_entries()).iter().map(term).collect::<PrologResult<Vec<_>>>()?;
        done.unify(terms.as_slice())
    }
}

/// How far `journal_new_` has come: in the journal of which devices, and how many entries.
static SEEN: Mutex<(Weak<Registry>, u64)> = Mutex::new((Weak::new(), 0));

/// The entries since the last call. Asks no device.
fn new_entries() -> Vec<Entry> {
    let Some(devices) = chosen_devices() else { return Vec::new() };
    let mut seen = locked(&SEEN);
    let these = Arc::downgrade(&devices);
    let after = if these.ptr_eq(&seen.0) { seen.1 } else { 0 };
    let (entries, count) = devices.journal().after(after);
    *seen = (these, count);
    entries
}

/// A command that was given so often, from its own time on until another one.
struct Again {
    entry: Entry,
    until: Duration,
    times: u64,
}

/// The same command to a motor is one if it comes so soon after that, and after so few others.
const SOON: Duration = Duration::from_millis(500);
const LOOK_BACK: usize = 4;

fn merged(entries: Vec<Entry>) -> Vec<Again> {
    let mut merged: Vec<Again> = Vec::new();
    for entry in entries {
        let is_same = |again: &&mut Again| match (&again.entry.act, &entry.act) {
            (Act::Motor(port, command), Act::Motor(other, same)) => {
                (port, command, again.entry.origin.cause) == (other, same, entry.origin.cause)
                    && entry.time < again.until + SOON
            }
            _ => false,
        };
        if let Some(again) = merged.iter_mut().rev().take(LOOK_BACK).find(is_same) {
            again.until = entry.time;
            again.times += 1;
        } else {
            merged.push(Again { until: entry.time, times: 1, entry });
        }
    }
    merged
}

/// A whole number of nanoseconds, divided once: so it is written with no more digits than it has.
#[expect(clippy::cast_precision_loss, reason = "exact for a hundred days")]
fn seconds(time: Duration) -> f64 {
    time.as_nanos() as f64 / 1e9
}

/// The last number that was given to a cause.
static LAST: AtomicU32 = AtomicU32::new(0);

/// The causes for which somebody acts.
static ACTIVE: Mutex<BTreeSet<u32>> = Mutex::new(BTreeSet::new());

/// A cause of what this thread does, until it is dropped.
struct Cause {
    number: u32,
    former: u32,
    /// Whether the call has succeeded.
    is_over: bool,
}

impl Cause {
    /// `None` if the number, after all others, is still in use.
    fn begin() -> Option<Self> {
        let number = LAST.fetch_add(1, Ordering::Relaxed).wrapping_add(1);
        let former = origin().cause;
        locked(&ACTIVE).insert(number).then(|| {
            set_cause(number);
            Self { number, former, is_over: false }
        })
    }
}

impl Drop for Cause {
    fn drop(&mut self) {
        locked(&ACTIVE).remove(&self.number);
        // Not in an engine that is destroyed while another one runs.
        if origin().cause == self.number {
            set_cause(self.former);
        }
    }
}

fn number<'a, C: Prolog>(call: &Call<'a, C>, term: &Term<'a>) -> PrologResult<u32> {
    u32::try_from(call.integer(term)?).map_err(|_| PrologError::Failure)
}

/// Makes the terms of entries.
struct Maker<'m, 'a, C: Prolog>(&'m Call<'a, C>);

impl<'a, C: Prolog> Maker<'_, 'a, C> {
    fn compound(&self, name: &str, arguments: &[Term<'a>]) -> PrologResult<Term<'a>> {
        let term = self.0.context.new_term_ref();
        let arity = u16::try_from(arguments.len()).map_err(|_| PrologError::Failure)?;
        term.unify(Functor::new(name, arity))?;
        arguments.iter().zip(1..).try_for_each(|(argument, nth)| term.unify_arg(nth, argument))?;
        Ok(term)
    }

    fn atom(&self, text: &str) -> PrologResult<Term<'a>> {
        let term = self.0.context.new_term_ref();
        unify_atom(&term, text)?;
        Ok(term)
    }

    fn number(&self, number: impl Unifiable) -> PrologResult<Term<'a>> {
        let term = self.0.context.new_term_ref();
        term.unify(number)?;
        Ok(term)
    }

    fn list(&self, terms: &[Term<'a>]) -> PrologResult<Term<'a>> {
        self.number(terms)
    }

    /// A compound of numbers.
    fn numbers(&self, name: &str, numbers: &[f64]) -> PrologResult<Term<'a>> {
        let numbers = numbers.iter().map(|number| self.number(*number));
        self.compound(name, &numbers.collect::<PrologResult<Vec<_>>>()?)
    }

    /// A compound of integers.
    fn integers(&self, name: &str, integers: &[i64]) -> PrologResult<Term<'a>> {
        let integers = integers.iter().map(|integer| self.number(*integer));
        self.compound(name, &integers.collect::<PrologResult<Vec<_>>>()?)
    }

    fn wheels(&self, [left, right]: &[Name; 2]) -> PrologResult<Term<'a>> {
        self.compound("robot", &[self.atom(left.text())?, self.atom(right.text())?])
    }

    /// `Name/Arity`, or `none`.
    fn called(&self, entry: &Entry) -> PrologResult<Term<'a>> {
        match entry.origin.called {
            Some((name, arity)) => {
                self.compound("/", &[self.atom(name)?, self.number(u64::from(arity))?])
            }
            None => self.atom("none"),
        }
    }

    /// `What-Command`
    fn act(&self, act: &Act) -> PrologResult<Term<'a>> {
        let (what, command) = match act {
            Act::Motor(port, command) => (self.atom(port.text())?, self.motor(command)?),
            Act::Course(course) => (self.wheels(&course.wheels)?, self.course(course)?),
            Act::Ended(course, reason) => {
                let ended = [self.atom(reason)?, self.course(course)?];
                (self.wheels(&course.wheels)?, self.compound("ended", &ended)?)
            }
            Act::Pose(place) => {
                let pose = place.pose;
                let pose = self.numbers("pose", &[pose.x, pose.y, pose.heading])?;
                (self.wheels(&place.wheels)?, pose)
            }
            Act::Light(light, change) => (self.atom(light.text())?, self.light(change)?),
            Act::Sound(sound) => (self.atom("sound")?, self.sound(sound)?),
        };
        self.compound("-", &[what, command])
    }

    /// `tacho_motor(Word, SetPoints)` and the like.
    fn motor(&self, command: &MotorCommand) -> PrologResult<Term<'a>> {
        let number = |(name, number): (&str, i32)| self.integers(name, &[number.into()]);
        let mut set_points = command.numbers().map(number).collect::<PrologResult<Vec<_>>>()?;
        if let Some(action) = command.stop_action() {
            set_points.push(self.compound("stop_action", &[self.atom(action.word())?])?);
        }
        let class = command.class.directory().replace('-', "_");
        self.compound(&class, &[self.atom(command.word.text())?, self.list(&set_points)?])
    }

    /// `course(Course, options(Percent, Acceleration, StopAction, UseGyro))`
    fn course(&self, course: &Course) -> PrologResult<Term<'a>> {
        let command = match &course.course {
            Command::Legs(legs, backwards) => {
                let legs =
                    legs.iter().map(|leg| self.leg(leg)).collect::<PrologResult<Vec<_>>>()?;
                self.compound("legs", &[self.list(&legs)?, self.number(*backwards)?])?
            }
            Command::Cruise(speed, turn) => self.numbers("cruise", &[*speed, *turn])?,
            Command::Change(speed, turn) => self.numbers("change", &[*speed, *turn])?,
            Command::Wheels(shares) => self.numbers("wheels", shares)?,
        };
        let DriveOptions { percent, acceleration, stop_action, use_gyro } = course.options;
        let options = [
            self.number(percent)?,
            self.number(acceleration)?,
            self.atom(stop_action.word())?,
            self.number(use_gyro)?,
        ];
        self.compound("course", &[command, self.compound("options", &options)?])
    }

    fn leg(&self, leg: &Leg) -> PrologResult<Term<'a>> {
        match leg {
            Leg::Turn(degrees) => self.numbers("turn", &[*degrees]),
            Leg::Heading(heading) => self.numbers("heading", &[*heading]),
            Leg::Face(heading) => self.numbers("face", &[*heading]),
            Leg::Towards(place) => self.numbers("towards", place),
            Leg::To(place) => self.numbers("to", place),
            Leg::Reach(place) => self.numbers("reach", place),
            Leg::Arc(length, curvature) => self.numbers("arc", &[*length, *curvature]),
            Leg::Through(places, radius) => {
                let places = places_term(self.0, places)?;
                self.compound("through", &[places, self.number(*radius)?])
            }
            Leg::Pieces(path) => self.integers("pieces", &[i64::try_from(path.len()).unwrap_or(0)]),
        }
    }

    fn light(&self, change: &LightChange) -> PrologResult<Term<'a>> {
        match change {
            LightChange::Named(color) => self.compound("led", &[self.atom(color)?]),
            LightChange::Levels(levels, count) => {
                let levels: Vec<_> = levels.iter().map(|level| i64::from(*level)).collect();
                let color = match (&*levels, count) {
                    ([level, ..], 1) => self.number(*level)?,
                    ([red, green, ..], 2) => self.integers("levels", &[*red, *green])?,
                    _ => self.integers("levels", &levels)?,
                };
                self.compound("led", &[color])
            }
            LightChange::Trigger(word) => self.compound("led_trigger", &[self.atom(word.text())?]),
            LightChange::Blink(on, off) => self.integers("led_blink", &[*on, *off].map(i64::from)),
        }
    }

    fn sound(&self, sound: &SoundCommand) -> PrologResult<Term<'a>> {
        match sound {
            SoundCommand::Tones(tones) => {
                let tone = |(hertz, lasts): &(u32, Duration)| {
                    let milliseconds = i64::try_from(lasts.as_millis()).unwrap_or(i64::MAX);
                    self.integers("tone", &[i64::from(*hertz), milliseconds])
                };
                let tones = tones.iter().map(tone).collect::<PrologResult<Vec<_>>>()?;
                self.compound("tones", &[self.list(&tones)?])
            }
            SoundCommand::Say(text) => self.compound("say", &[self.atom(text)?]),
            SoundCommand::Play(file) => self.compound("play", &[self.atom(file)?]),
            SoundCommand::Stop => self.atom("stop"),
        }
    }
}
