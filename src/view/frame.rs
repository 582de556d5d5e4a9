//! Frames: what a page is sent, beginning with what it has not got yet.
use super::notes::notes;
use super::state::{Clock, Decimal, Report, Samples};
use super::{brick, door, simulated};
use crate::glue::state::{chosen_devices, devices, watched};
use crate::glue::terms::unify_atom;
use crate::glue::watch;
use crate::sim::watched_simulation;
use ev3_json::Json;
use ev3_os::Instant;
use ev3_os::locked;
use ev3_signals::latch;
use ev3_sim::Simulation;
use std::fmt;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::str::FromStr;
use std::sync::{Arc, Mutex, OnceLock};
use std::time::Duration;
use swipl::prelude::*;

natives! {
    /// view_frame_(+Page, +Have, +State, +Rate, +Goals, +Waits): sends a page that has some the
    /// next frame. State is that of the program; Rate and Goals are the page's settings. If it
    /// Waits, fails if nothing has changed, and it has that long enough.
    semidet fn "view_frame_"(context, page, have, state, rate, goals, waits) as call("view", 1) {
        let (have, state, rate) = (call.text(have)?, call.text(state)?, call.float(rate)?);
        match next(&have, &state, rate, goals.get_ex()?, waits.get_ex()?) {
            Some(frame) => door::say(&call, page, &frame),
            None => Err(PrologError::Failure),
        }
    }

    /// view_source_(-Source): `sim`, `brick` or `none`.
    semidet fn "view_source_"(_context, source) {
        unify_atom(source, Source::now().name())
    }
}

/// What a page has: counts of what was sent, the state in short, and when that was.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Have {
    film: u64,
    stamp: u64,
    sampled_us: u64,
    logged: u64,
    valued: u64,
    time_us: u64,
    state: u64,
    sent_ms: u64,
}

impl FromStr for Have {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let numbers: Vec<u64> = text.split('.').filter_map(|part| part.parse().ok()).collect();
        let [film, stamp, sampled_us, logged, valued, time_us, state, sent_ms] = *numbers else {
            return Err(());
        };
        Ok(Self { film, stamp, sampled_us, logged, valued, time_us, state, sent_ms })
    }
}

impl fmt::Display for Have {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { film, stamp, sampled_us, logged, valued, time_us, state, sent_ms } = self;
        write!(f, "{film}.{stamp}.{sampled_us}.{logged}.{valued}.{time_us}.{state}.{sent_ms}")
    }
}

/// The part of a frame that all pages get alike, for a short while.
struct Shared {
    made: Instant,
    film: u64,
    time: Duration,
    members: String,
}

/// For how long.
const SHARED_FOR: Duration = Duration::from_millis(15);

static SHARED: Mutex<Option<Arc<Shared>>> = Mutex::new(None);

/// How long, in milliseconds, a page waits for a change while time stands.
const PATIENCE: u64 = 1000;

static STARTED: OnceLock<Instant> = OnceLock::new();

/// What is watched.
enum Source {
    Simulation(Arc<Simulation>),
    Brick,
    None,
}

impl Source {
    fn now() -> Self {
        match watched_simulation() {
            Some(simulation) => Self::Simulation(simulation),
            None if chosen_devices().is_some() => Self::Brick,
            None => Self::None,
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Simulation(_) => "sim",
            Self::Brick => "brick",
            Self::None => "none",
        }
    }
}

/// The next frame for a page that has some. `program` is its state; at most `rate` frames come
/// in a second, and `goals` may be sent or not. `None` if it `waits` for a change, but not for long.
fn next(have: &str, program: &str, rate: f64, goals: bool, waits: bool) -> Option<String> {
    let had = have.parse::<Have>().ok();
    watch::look(had.map_or(0, |had| had.film), watch::LOOKS);
    let (film, source) = (watched().film(), Source::now());
    let is_new = had.is_none_or(|had| had.film != film);
    let mut have = had.filter(|_| !is_new).unwrap_or_default();
    // The log goes on from film to film.
    have.logged = had.map_or(0, |had| had.logged);
    have.film = film;
    let shared = shared(&source, film);
    let stands = micros(shared.time) == have.time_us;
    let clock = clock(&source, shared.time, stands);
    let state = {
        let mut hasher = DefaultHasher::new();
        let moving = (clock.pace.as_deref(), clock.paused, latch::is_set());
        (&shared.members, program, moving).hash(&mut hasher);
        hasher.finish()
    };
    let notes = notes();
    let counts = [have.stamp, have.logged, have.valued];
    let is_calm = !is_new && have.state == state && counts == notes.counts();
    let now = micros(STARTED.get_or_init(Instant::now).elapsed()) / 1000;
    let patience = if stands { PATIENCE } else { PATIENCE / 2 };
    if waits && is_calm && now < have.sent_ms + patience {
        return None;
    }
    (have.state, have.sent_ms) = (state, now);
    let mut json = Json::new();
    json.object(|json| {
        json.key("type").text("frame");
        if is_new {
            json.key("new").bool(true);
        }
        json.key("calm").bool(is_calm);
        json.key("rate").number(rate, 6);
        json.key("goals").bool(goals);
        json.key("source").text(source.name());
        if !matches!(source, Source::None) {
            json.key("tree").text(&devices().tree().root().to_string_lossy());
        }
        clock.report(json.key("clock"));
        json.key("program").object(|json| {
            json.key("state").text(program);
            json.key("latched").bool(latch::is_set());
        });
        json.raw(&shared.members);
        have.stamp = notes.report_kept(json, have.stamp);
        have.logged = notes.report_log(json, have.logged);
        have.valued = notes.report_values(json, have.valued);
        drop(notes);
        let after = (!is_new).then(|| Duration::from_micros(have.sampled_us));
        if let Some((samples, last)) = samples(&source, after) {
            samples.report(json.key("samples"));
            have.sampled_us = micros(last);
        }
        have.time_us = micros(shared.time);
        json.key("have").text(&have.to_string());
    });
    Some(json.into_text())
}

fn clock(source: &Source, time: Duration, stands: bool) -> Clock {
    match source {
        Source::Simulation(simulation) => simulated::clock(simulation, time, stands),
        _ => Clock { time: Decimal(time.as_secs_f64()), kind: "real", ..Clock::default() },
    }
}

fn samples(source: &Source, after: Option<Duration>) -> Option<(Samples, Duration)> {
    match source {
        Source::Simulation(simulation) => simulated::samples(simulation, after),
        _ => brick::samples(after),
    }
}

fn micros(time: Duration) -> u64 {
    u64::try_from(time.as_micros()).unwrap_or(u64::MAX)
}

/// The state, which is the same for all pages for a short while.
fn shared(source: &Source, film: u64) -> Arc<Shared> {
    let mut shared = locked(&SHARED);
    if let Some(old) = &*shared {
        if old.film == film && old.made.elapsed() < SHARED_FOR {
            return Arc::clone(old);
        }
    }
    let (time, members) = match source {
        Source::Simulation(simulation) => simulated::state(simulation),
        Source::Brick => brick::state(),
        Source::None => (Duration::ZERO, String::new()),
    };
    let new = Shared { made: Instant::now(), film, time, members };
    Arc::clone(shared.insert(Arc::new(new)))
}
