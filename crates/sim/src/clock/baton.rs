//! Whose turn it is on the virtual clock.
//!
//! Of the threads that use a simulation one runs, and has the baton. The others stand in line:
//! each waits for a moment of simulated time. A thread passes the baton on when it stands in line
//! again, when it ends, or when it sleeps elsewhere, until another thread or a person wakes it.
//! Then the first in line gets it.
//!
//! The baton is passed on only at a moment at which all other threads are asleep
//! ([`Threads::rest`]). So a thread that was just created, or woken, comes to its place in line
//! before time goes on, however slow this machine is. That is why a program with several threads
//! does the same in each run.
use super::threads::{self, Id, Threads};
use ev3_os::Instant;
use ev3_os::locked;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard};
use std::thread::{self, Thread};
use std::time::Duration;

/// How long the first in line sleeps, by the wall clock, before it looks whether the others rest.
/// It sleeps twice as long each time.
const NAPS: [Duration; 2] = [Duration::from_micros(100), Duration::from_millis(1)];

/// The baton, and the line for it.
#[derive(Debug)]
pub(super) struct Baton {
    /// Whose turn it is. A thread to which this was passed, and that still stands in line, has not
    /// woken up yet.
    holder: AtomicU32,
    /// How many threads are about to lock the line, or busy. They may sleep, but do not rest.
    arriving: AtomicUsize,
    /// Whether a thread has the turn for a wish that it has to make again.
    is_kept: AtomicBool,
    line: Mutex<Line>,
}

#[derive(Debug, Default)]
struct Line {
    /// Those that stand in line, and those that keep their place, as the holder.
    clients: Vec<Client>,
    /// How many turns newcomers have had.
    turns: u64,
    threads: Threads,
}

#[derive(Debug)]
struct Client {
    id: Id,
    thread: Thread,
    place: Place,
    /// Since when it has waited for its turn, if that is what it did last.
    begun: Option<Duration>,
    stands: Option<Stand>,
    /// It got the turn for this after it had slept in line, and was sent to handle signals first.
    granted: Option<Wish>,
}

/// When a thread in line goes on.
#[derive(Debug)]
struct Stand {
    /// The moment of simulated time. A newcomer waits for none.
    moment: Option<Duration>,
    /// Not before this, by the wall clock.
    wall: Option<Instant>,
}

/// Orders the threads that wait for the same moment.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Place {
    /// Those that had a turn, and did not sleep elsewhere since: in the order of their first.
    Since(u64),
    /// Then the newcomers: in the order of what they are about to do. The threads of a pool take
    /// their work in any order.
    New(String),
}

/// What a thread in line waits for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wish {
    /// Its turn, since this moment of simulated time. A newcomer goes before the others.
    Turn(Duration),
    /// A moment of simulated time.
    Moment(Duration),
    /// The same, but not before this by the wall clock.
    NotBefore(Duration, Instant),
}

impl Baton {
    pub(super) fn new() -> Self {
        Self {
            holder: AtomicU32::new(0),
            arriving: AtomicUsize::new(0),
            is_kept: AtomicBool::new(false),
            line: Mutex::default(),
        }
    }

    /// Has something done for which this thread may sleep, while it goes on as if awake.
    pub(super) fn busy<T>(&self, act: impl FnOnce() -> T) -> T {
        self.arriving.fetch_add(1, Ordering::SeqCst);
        let done = act();
        self.arriving.fetch_sub(1, Ordering::SeqCst);
        done
    }

    /// Whether it is this thread's turn.
    pub(super) fn is_mine(&self) -> bool {
        self.holder.load(Ordering::SeqCst) == threads::me()
    }

    /// Whether it is this thread's turn, and not only for a wish that it has to make again. Then
    /// the only thread need not stand in line.
    pub(super) fn is_freely_mine(&self) -> bool {
        self.is_mine() && !self.is_kept.load(Ordering::SeqCst)
    }

    /// Whether those in line that have had a turn all wait for a later moment. A newcomer may be
    /// there or not yet.
    pub(super) fn is_before_others(&self, now: Duration) -> bool {
        let line = self.line();
        let mut standing = line.clients.iter().filter_map(|client| client.stands.as_ref());
        standing.all(|stand| stand.moment.is_none_or(|moment| moment > now))
    }

    /// Stands in line for the next turn; `false` if the caller has to handle signals, and to stand
    /// in line again. If the turn does not come within this wall time, the thread keeps its place
    /// meanwhile. If the turn came after a sleep in line, the thread has it already: so a signal
    /// that was sent before is handled before, however short the sleep was by the wall clock.
    ///
    /// `about` says what the thread is about to do; a newcomer is asked.
    pub(super) fn stand(
        &self,
        wish: Wish,
        about: &mut dyn FnMut() -> String,
        patience: Duration,
    ) -> bool {
        let (me, latest, [mut nap, longest]) = (threads::me(), Instant::now() + patience, NAPS);
        let about = if self.is_mine() { String::new() } else { about() };
        let mut line = self.line();
        if self.is_mine() {
            if line.is_granted(me, wish) {
                self.take(&mut line);
                return true;
            }
            self.holder.store(0, Ordering::SeqCst);
        }
        line.join(me, about, wish);
        let mut has_slept = false;
        let mut watches = false;
        loop {
            watches |= self.pass(&mut line);
            if self.is_mine() {
                self.take(&mut line);
                if has_slept {
                    self.grant(&mut line, wish);
                }
                return !has_slept;
            }
            let left = latest.saturating_duration_since(Instant::now());
            if left.is_zero() {
                line.leave(me);
                return false;
            }
            // One thread looks at the others, that is enough: the one that has passed the baton
            // on is awake.
            watches |= line.first().is_some_and(|first| first.id == me);
            drop(line);
            thread::park_timeout(if watches { nap.min(left) } else { left });
            has_slept = true;
            nap = longest.min(nap * 2);
            line = self.line();
        }
    }

    /// Keeps the turn of this thread for its wish, which it makes again after it has handled
    /// signals.
    pub(super) fn keep(&self, wish: Wish) {
        self.grant(&mut self.line(), wish);
    }

    fn take(&self, line: &mut Line) {
        line.take(threads::me());
        self.is_kept.store(false, Ordering::SeqCst);
    }

    /// The turn of this thread is for this wish, once signals have been handled.
    fn grant(&self, line: &mut Line, wish: Wish) {
        if let Some(client) = line.client(threads::me()) {
            client.granted = Some(wish);
            self.is_kept.store(true, Ordering::SeqCst);
        }
    }

    /// Whether another thread stands in line, now that it is this thread's turn.
    pub(super) fn is_wanted(&self) -> bool {
        // One that handles signals just now keeps its place.
        self.line().clients.len() > 1
    }

    /// Passes the baton on to the first in line, if everyone else rests; whether that is another
    /// thread than this one.
    fn pass(&self, line: &mut Line) -> bool {
        let holder = self.holder.load(Ordering::SeqCst);
        if line.stands(holder) || !self.is_rest(line) {
            return false;
        }
        let Some(first) = line.first() else {
            return false;
        };
        if first
            .stands
            .as_ref()
            .and_then(|stand| stand.wall)
            .is_some_and(|wall| Instant::now() < wall)
        {
            return false;
        }
        let (id, thread) = (first.id, first.thread.clone());
        self.holder.store(id, Ordering::SeqCst);
        // Those that sleep elsewhere lose their places.
        line.clients.retain(|client| client.stands.is_some());
        if id == threads::me() {
            return false;
        }
        thread.unpark();
        true
    }

    /// Whether all other threads are asleep.
    fn is_rest(&self, line: &mut Line) -> bool {
        let Line { clients, threads, .. } = line;
        let stands = |id| clients.iter().any(|one| one.id == id && one.stands.is_some());
        threads.rest(stands) && self.arriving.load(Ordering::SeqCst) == 0
    }

    fn line(&self) -> MutexGuard<'_, Line> {
        self.busy(|| locked(&self.line))
    }
}

impl Line {
    fn join(&mut self, id: Id, about: String, wish: Wish) {
        if self.client(id).is_none() {
            let (thread, place) = (thread::current(), Place::New(about));
            self.clients.push(Client {
                id,
                thread,
                place,
                begun: None,
                stands: None,
                granted: None,
            });
        }
        let Some(client) = self.client(id) else {
            return;
        };
        let (moment, wall) = match wish {
            Wish::Turn(_) if matches!(client.place, Place::New(_)) => (None, None),
            Wish::Turn(now) => (Some(*client.begun.get_or_insert(now)), None),
            Wish::Moment(moment) => (Some(moment), None),
            Wish::NotBefore(moment, wall) => (Some(moment), Some(wall)),
        };
        if !matches!(wish, Wish::Turn(_)) {
            client.begun = None;
        }
        client.stands = Some(Stand { moment, wall });
    }

    fn take(&mut self, id: Id) {
        let turn = self.turns;
        self.turns += 1;
        if let Some(client) = self.client(id) {
            client.stands = None;
            client.begun = None;
            client.granted = None;
            if matches!(client.place, Place::New(_)) {
                client.place = Place::Since(turn);
            }
        }
    }

    /// Whether the turn that this thread has is for this wish, made again: maybe later, by the
    /// simulated or the wall clock.
    fn is_granted(&mut self, id: Id, wish: Wish) -> bool {
        let is_same = |granted| match (granted, wish) {
            (Wish::Turn(_), Wish::Turn(_)) => true,
            (Wish::Moment(moment), Wish::Moment(again))
            | (Wish::NotBefore(moment, _), Wish::NotBefore(again, _)) => moment == again,
            _ => false,
        };
        self.client(id).and_then(|client| client.granted).is_some_and(is_same)
    }

    fn leave(&mut self, id: Id) {
        if let Some(client) = self.client(id) {
            client.stands = None;
        }
    }

    fn stands(&self, id: Id) -> bool {
        self.clients.iter().any(|client| client.id == id && client.stands.is_some())
    }

    fn first(&self) -> Option<&Client> {
        let standing = self.clients.iter().filter(|client| client.stands.is_some());
        standing.min_by(|a, b| self.order(a).cmp(&self.order(b)))
    }

    /// By the moment, then the place, then the age.
    fn order<'a>(&self, client: &'a Client) -> impl Ord + use<'a> {
        let moment = client.stands.as_ref().and_then(|stand| stand.moment);
        (moment, &client.place, self.threads.age(client.id))
    }

    fn client(&mut self, id: Id) -> Option<&mut Client> {
        self.clients.iter_mut().find(|client| client.id == id)
    }
}
