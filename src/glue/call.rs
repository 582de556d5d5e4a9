//! One call of a native predicate: its arguments, its answers.
use crate::glue::due::{has_guards, has_rung, is_any_due};
use crate::glue::error::{Origin, raise, wrong_because};
use crate::glue::interned::atom_text;
use crate::glue::signals;
use crate::glue::state;
use crate::glue::terms::{Ask as _, Prolog, unify_value};
use crate::glue::watch;
use ev3_driver::error::Access;
use ev3_driver::journal::{self, Act, SoundCommand};
use ev3_driver::{Class, Devfs, Device, Error, Registry, Value};
use std::borrow::Cow;
use std::ops::Deref;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;
use swipl::fli::{integer_in, list_end, number_flag};
use swipl::prelude::*;

/// The text of an atom or a string.
pub(crate) type Text = Cow<'static, str>;

/// What a call has not returned yet: most have one, and no memory is asked for.
pub(crate) struct Left<T> {
    one: Option<T>,
    others: std::vec::IntoIter<T>,
}

impl<T> FromIterator<T> for Left<T> {
    fn from_iter<I: IntoIterator<Item = T>>(all: I) -> Self {
        let mut all = all.into_iter();
        let (one, others) = (all.next(), all.collect::<Vec<_>>());
        Self { one, others: others.into_iter() }
    }
}

impl<T> Iterator for Left<T> {
    type Item = T;

    fn next(&mut self) -> Option<T> {
        self.one.take().or_else(|| self.others.next())
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let count = usize::from(self.one.is_some()) + self.others.len();
        (count, Some(count))
    }
}

impl<T> ExactSizeIterator for Left<T> {}

impl<T> Left<T> {
    /// What comes next.
    pub(crate) fn first(&self) -> Option<&T> {
        self.one.as_ref()
    }
}

/// The state of a nondeterministic predicate that has these items left, for its setup. If
/// there is one, `next` solves the call at once: then no state is needed.
#[inline]
pub(crate) fn start<S, T>(
    mut state: S,
    items: impl Fn(&S) -> &Left<T>,
    next: impl FnOnce(&mut S) -> PrologResult<bool>,
) -> PrologResult<Option<S>> {
    if items(&state).len() > 1 {
        return Ok(Some(state));
    }
    next(&mut state).map(|_| None)
}

/// The devices that the call has not returned yet.
pub(crate) type ListedDevices = Left<Arc<Device>>;

/// Whether signals stop motors, and Prolog has said whether a kill does.
static IS_PREPARED: AtomicBool = AtomicBool::new(false);

/// Whether motors may start, see [`Call::before_motors`].
pub(crate) fn has_prepared_motors() -> bool {
    IS_PREPARED.load(Ordering::Relaxed)
}

/// A call of a public predicate: the origin of errors, and access to the devices.
pub(crate) struct Call<'a, C: Prolog>(Origin<'a, C>);

impl<'a, C: Prolog> Deref for Call<'a, C> {
    type Target = Origin<'a, C>;

    fn deref(&self) -> &Self::Target {
        &self.0
    }
}

impl<'a, C: Prolog> Call<'a, C> {
    pub(crate) fn of(context: &'a Context<'a, C>, name: &'static str, arity: u64) -> Self {
        Self(Origin { context, name, arity })
    }

    /// The devices of the tree in use. If no tree is chosen yet, asks Prolog to choose
    /// one. Runs planned goals that are due.
    pub(crate) fn devices(&self) -> PrologResult<Arc<Registry>> {
        let Some(devices) = state::chosen_devices() else {
            self.context.ask(pred!("ev3dev_files:choose_tree/0"), [])?;
            state::chosen();
            return self.devices();
        };
        watch::note_user();
        ev3_signals::lives();
        if !devices.tree().takes_turns() && !is_any_due() {
            return Ok(devices);
        }
        self.think(&devices)?;
        self.wait_for(|about| devices.tree().turn(about))?;
        run_due_goals(self.context)?;
        // Another thread, or a goal, may have changed the tree.
        Ok(state::devices())
    }

    /// The devices, for a call that commands something: the journal names it.
    pub(crate) fn devices_to_command(&self) -> PrologResult<Arc<Registry>> {
        let devices = self.devices()?;
        journal::set_called(self.name, u8::try_from(self.arity).unwrap_or(u8::MAX));
        Ok(devices)
    }

    /// The devices, for a call that starts a motor.
    pub(crate) fn devices_to_move(&self) -> PrologResult<Arc<Registry>> {
        self.may_move()?;
        self.devices_to_command()
    }

    /// This thread is about to start a motor, a `far` one or one of its own: the watchdog stops it
    /// if the program computes for too long.
    pub(crate) fn guard(&self, far: bool) -> PrologResult<()> {
        signals::guard(far, self.limit()?);
        Ok(())
    }

    /// For how long this thread may compute while a motor runs; zero is forever.
    pub(crate) fn limit(&self) -> PrologResult<Duration> {
        let seconds = number_flag(c"ev3dev_watchdog").unwrap_or(0.0);
        if seconds.is_nan() || seconds < 0.0 {
            let [flag] = self.context.new_term_refs();
            flag.unify(seconds)?;
            let text = "the flag ev3dev_watchdog is 0, or a number of seconds";
            return wrong_because(self, "seconds", &flag, text);
        }
        Ok(Duration::try_from_secs_f64(seconds).unwrap_or_default())
    }

    /// A motor may be started: throws in a guard, and where nothing could stop the motor.
    pub(crate) fn may_move(&self) -> PrologResult<()> {
        self.before_motors()?;
        if has_guards() {
            self.context.ask(pred!("ev3dev_waits:no_guard/0"), [])?;
        }
        Ok(())
    }

    /// Motors may start from now on, which signals can stop. The first time, Prolog says
    /// whether they are to be stopped when the process is killed.
    #[inline]
    pub(crate) fn before_motors(&self) -> PrologResult<()> {
        self.guard(false)?;
        if has_prepared_motors() {
            return Ok(());
        }
        self.or_throw(state::watch_signals().map_err(|source| Error::Open {
            path: "a pipe for signals".into(),
            access: Access::Write,
            source,
        }))?;
        let survives = self.context.ask(pred!("ev3dev_halt:before_motors/0"), []);
        ev3_signals::survive(attempt(survives)?);
        IS_PREPARED.store(true, Ordering::Relaxed);
        Ok(())
    }

    /// Notes a sound in the journal.
    pub(crate) fn note_sound(&self, sound: SoundCommand) {
        let devices = state::devices();
        journal::set_called(self.name, u8::try_from(self.arity).unwrap_or(u8::MAX));
        devices.journal().note(devices.tree().now(), Act::Sound(sound));
    }

    /// Waits until `is_turn`, which says so within 20 ms, and handles signals meanwhile.
    pub(crate) fn wait_for(
        &self,
        mut is_turn: impl FnMut(&mut dyn FnMut() -> String) -> bool,
    ) -> PrologResult<()> {
        let mut interrupted = self.interrupted();
        loop {
            let mut asked = Ok(());
            // It may ask more than once, and Prolog answers nothing after an exception.
            let is_over = is_turn(&mut || {
                if asked.is_err() {
                    return String::new();
                }
                self.about().unwrap_or_else(|error| {
                    asked = Err(error);
                    String::new()
                })
            });
            asked?;
            if is_over {
                return Ok(());
            }
            if interrupted() {
                return self.or_throw(Err(Error::Interrupted));
            }
        }
    }

    /// What this thread is about to do. Whether that is asked depends on how busy the machine is, so
    /// it takes no time.
    fn about(&self) -> PrologResult<String> {
        self.thinks_nothing(|| {
            let text = self.context.new_term_ref();
            self.context.ask(pred!("ev3dev_turn_order:about/1"), [&text])?;
            text.get()
        })
    }

    /// The device files in use. If neither these nor a tree is chosen yet, asks Prolog to choose.
    pub(crate) fn dev(&self) -> PrologResult<Arc<dyn Devfs>> {
        if state::is_dev_chosen() {
            let devices = state::devices();
            self.wait_for(|about| devices.tree().turn(about))?;
        } else {
            self.devices()?;
        }
        Ok(state::dev())
    }

    /// The text of an atom or a string.
    pub(crate) fn text(&self, term: &Term) -> PrologResult<Text> {
        let text = match atom_text(term)? {
            None => term.get_str(|text| text.map(|text| Text::Owned(text.to_owned())))?,
            atom => atom,
        };
        match text {
            Some(text) => Ok(text),
            None if term.is_atom() || term.is_string() => crate::glue::error::no_text(self),
            None => self.wrong_type("atom", term),
        }
    }

    /// The text of an atom or a string, or `None` for a variable.
    pub(crate) fn text_if_bound(&self, term: &Term) -> PrologResult<Option<Text>> {
        if term.is_var() { Ok(None) } else { self.text(term).map(Some) }
    }

    /// The text of an atom, a string or a number, as it is written to a file.
    pub(crate) fn value(&self, term: &Term) -> PrologResult<Text> {
        if let Some(integer) = integer_in!(term) {
            return Ok(Text::Owned(integer.to_string()));
        }
        if term.is_integer() {
            return crate::glue::error::too_long(self);
        }
        if term.term_type() == TermType::Float {
            return Ok(Text::Owned(term.get::<f64>()?.to_string()));
        }
        self.text(term)
    }

    /// A number, integer or float. An integer beyond all floats becomes infinite, which
    /// is an impossible speed, angle or time, too.
    pub(crate) fn float(&self, term: &Term) -> PrologResult<f64> {
        match attempt_opt(term.get::<f64>())? {
            Some(float) => Ok(float),
            None if term.is_integer() => Ok(f64::INFINITY),
            None => self.wrong_type("number", term),
        }
    }

    /// An integer of at most 64 bits.
    pub(crate) fn integer(&self, term: &Term) -> PrologResult<i64> {
        match integer_in!(term) {
            Some(integer) => Ok(integer),
            None if term.is_integer() => crate::glue::error::too_long(self),
            None => self.wrong_type("integer", term),
        }
    }

    /// A time in seconds, or `None` for an infinite time: an atom, or a number beyond
    /// the range of `Duration`.
    pub(crate) fn seconds(&self, term: &Term) -> PrologResult<Option<Duration>> {
        if term.is_atom() {
            return Ok(None);
        }
        Ok(Duration::try_from_secs_f64(self.float(term)?).ok())
    }

    /// A finite time in seconds.
    pub(crate) fn time(&self, term: &Term) -> PrologResult<Duration> {
        match Duration::try_from_secs_f64(self.float(term)?) {
            Ok(time) => Ok(time),
            Err(_) => crate::glue::error::wrong_value(self, "seconds", term),
        }
    }

    /// The devices of a class, for a nondeterministic predicate's setup: all, or
    /// the one at a port that is bound. Fails if there are none.
    pub(crate) fn listed(
        &self,
        devices: &Registry,
        class: Class,
        port: &Term,
    ) -> PrologResult<ListedDevices> {
        let name = self.text_if_bound(port)?;
        let found: ListedDevices = self.or_throw(match name {
            Some(name) => devices.find(class, &name).map(|device| device.into_iter().collect()),
            None => devices.all(class).map(|all| all.iter().cloned().collect()),
        })?;
        if found.len() == 0 { self.absent(class, port) } else { Ok(found) }
    }

    /// A list of floats.
    pub(crate) fn floats(&self, values: &[f64]) -> PrologResult<Term<'a>> {
        let list = self.context.new_term_ref();
        list.unify(values)?;
        Ok(list)
    }

    /// The elements of a list.
    pub(crate) fn list(&self, term: &Term<'a>) -> PrologResult<Vec<Term<'a>>> {
        self.must_be_list(term)?;
        Ok(self.context.term_list_vec(term))
    }

    /// Converts each element of a list, in one pass and without a vector of terms.
    pub(crate) fn map_list<T>(
        &self,
        term: &Term<'a>,
        of: impl FnMut(Term<'a>) -> PrologResult<T>,
    ) -> PrologResult<Vec<T>> {
        self.must_be_list(term)?;
        self.context.term_list_iter(term).map(of).collect()
    }

    /// Raises an error for what is not a list: a partial list, one that has no end.
    fn must_be_list(&self, term: &Term) -> PrologResult<()> {
        let end = self.context.new_term_ref();
        list_end!(term, &end);
        match end.term_type() {
            TermType::Nil => Ok(()),
            TermType::Variable => self.wrong_type("list", &end),
            _ => self.wrong_type("list", term),
        }
    }

    /// The arguments of a compound term.
    pub(crate) fn arguments<const N: usize>(&self, term: &Term) -> PrologResult<[Term<'a>; N]> {
        match attempt_opt(self.context.compound_terms(term))? {
            Some(arguments) => Ok(arguments),
            None => self.wrong_type("compound", term),
        }
    }

    /// Name and arguments of a compound term; `None` if the term is not compound.
    pub(crate) fn compound(&self, term: &Term) -> PrologResult<Option<(String, Vec<Term<'a>>)>> {
        let Some(arguments) = attempt_opt(self.context.compound_terms_vec(term))? else {
            return Ok(None);
        };
        let functor = attempt_opt(term.get::<Functor>())?;
        Ok(functor.map(|functor| (functor.name_string(), arguments)))
    }

    /// Fails, and has Prolog explain why.
    pub(crate) fn fail_because<T>(&self, cause: &Term) -> PrologResult<T> {
        self.context.ask(pred!("ev3dev_hints:fail_because/1"), [cause])?;
        Err(PrologError::Failure)
    }

    /// Fails because there is no such device at a port, or at any if it is unbound.
    pub(crate) fn absent<T>(&self, class: Class, port: &Term) -> PrologResult<T> {
        let (context, class) = (self.context, atomable(class.directory()));
        self.fail_because(&term! {context: absent(#class, #port)}?)
    }

    /// Fails because the brick does not have it.
    pub(crate) fn lacking<T>(&self, what: &str) -> PrologResult<T> {
        let context = self.context;
        self.fail_because(&term! {context: lacking(#atomable(what))}?)
    }

    /// The driver's result; fails if it is `None`: the device at the port is absent.
    pub(crate) fn or_absent<T>(
        &self,
        class: Class,
        port: &Term,
        result: ev3_driver::Result<Option<T>>,
    ) -> PrologResult<T> {
        self.or_throw(result)?.map_or_else(|| self.absent(class, port), Ok)
    }

    /// The driver's result; raises its error as an exception.
    pub(crate) fn or_throw<T>(&self, result: ev3_driver::Result<T>) -> PrologResult<T> {
        result.or_else(|error| raise(self, &error, &state::devices()))
    }

    /// The driver's result; fails if it is `None`.
    pub(crate) fn or_fail<T>(&self, result: ev3_driver::Result<Option<T>>) -> PrologResult<T> {
        self.or_throw(result)?.ok_or(PrologError::Failure)
    }

    /// Handles signals and runs planned goals that are due; `true` if that raised an exception.
    pub(crate) fn interrupted(&self) -> impl FnMut() -> bool + use<'a, C> {
        let context = self.context;
        move || context.handle_signals().is_err() || run_due_goals(context).is_err()
    }

    /// The next solution: reads the items one after the other until `unify` succeeds
    /// with the value. `true` if there may be more.
    pub(crate) fn next<T, V>(
        &self,
        items: &mut impl ExactSizeIterator<Item = T>,
        read: impl Fn(&T) -> PrologResult<V>,
        unify: impl Fn(&T, &V) -> PrologResult<()>,
    ) -> PrologResult<bool> {
        while let Some(item) = items.next() {
            let Some(value) = attempt_opt(read(&item))? else {
                continue;
            };
            if items.len() == 0 {
                return unify(&item, &value).map(|()| false);
            }
            let frame = self.context.open_frame();
            if attempt(unify(&item, &value))? {
                frame.close();
                return Ok(true);
            }
            frame.discard();
        }
        Err(PrologError::Failure)
    }

    /// Terms of numbers and atoms, as elements of a list.
    pub(crate) fn terms(&self, values: &[Value]) -> PrologResult<Vec<Term<'a>>> {
        let term = |value| {
            let term = self.context.new_term_ref();
            unify_value(&term, value).map(|()| term)
        };
        values.iter().map(term).collect()
    }

    fn wrong_type<T>(&self, expected: &str, term: &Term) -> PrologResult<T> {
        crate::glue::error::wrong_type(self, expected, term)
    }
}

/// Runs the goals that this thread has planned and that are due.
fn run_due_goals<'a, C: Prolog>(context: &'a Context<'a, C>) -> PrologResult<()> {
    if has_rung() {
        context.ask(pred!("ev3dev_schedule:run_due_goals/0"), [])?;
    }
    Ok(())
}
