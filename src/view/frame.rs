//! Frames: what a page is sent, beginning with what it has not got yet.
use super::believed::{ToWorld, believed, report_believed};
use super::brick;
use super::hand::pulled;
use super::notes::notes;
use super::reach::running_simulation;
use crate::glue::state::{chosen_devices, devices};
use crate::glue::watch::film;
use ev3_driver::lock::locked;
use ev3_json::Json;
use ev3_signals::latch;
use ev3_sim::{Beside, Clock, MOTOR_KINDS, Machine, Pose, SensorKind, Simulation};
use std::fmt;
use std::str::FromStr;
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// What a page has: counts of what was sent, in the order of the fields.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Have {
    film: u64,
    stamp: u64,
    sampled_us: u64,
    logged: u64,
    valued: u64,
    time_us: u64,
}

impl FromStr for Have {
    type Err = ();

    fn from_str(text: &str) -> Result<Self, ()> {
        let numbers: Vec<u64> = text.split('.').filter_map(|part| part.parse().ok()).collect();
        let [film, stamp, sampled_us, logged, valued, time_us] = *numbers else {
            return Err(());
        };
        Ok(Self { film, stamp, sampled_us, logged, valued, time_us })
    }
}

impl fmt::Display for Have {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { film, stamp, sampled_us, logged, valued, time_us } = self;
        write!(f, "{film}.{stamp}.{sampled_us}.{logged}.{valued}.{time_us}")
    }
}

/// What all pages are sent alike, for a short while.
struct Shared {
    made: Instant,
    film: u64,
    time: Duration,
    text: Arc<str>,
}

/// For how long.
const SHARED_FOR: Duration = Duration::from_millis(15);

static SHARED: Mutex<Option<Shared>> = Mutex::new(None);

/// What is watched.
enum Source {
    Simulation(Arc<Simulation>),
    Brick,
    None,
}

impl Source {
    fn now() -> Self {
        match running_simulation() {
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

/// The name of what is watched.
pub(super) fn source() -> &'static str {
    Source::now().name()
}

/// The next frame for a page. `state` is that of the program, and `settings` are members that
/// never change.
pub(super) fn next(have: &str, state: &str, settings: &str) -> String {
    let had = have.parse::<Have>().ok();
    let (film, source) = (film(), Source::now());
    let is_new = had.is_none_or(|had| had.film != film);
    let mut have = had.filter(|_| !is_new).unwrap_or_default();
    // The log goes on from film to film.
    have.logged = had.map_or(0, |had| had.logged);
    have.film = film;
    let (time, shared) = shared(&source, film);
    let mut json = Json::new();
    json.object(|json| {
        json.key("type").text("frame");
        if is_new {
            json.key("new").bool(true);
        }
        json.raw(settings);
        json.key("source").text(source.name());
        if !matches!(source, Source::None) {
            json.key("tree").text(&devices().tree().root().to_string_lossy());
        }
        json.key("clock").object(|json| report_clock(json, &source, time, have.time_us));
        json.key("program").object(|json| {
            json.key("state").text(state);
            json.key("latched").bool(latch::is_set());
        });
        json.raw(&shared);
        if let Source::Simulation(simulation) = &source {
            let after = (!is_new).then(|| Duration::from_micros(have.sampled_us));
            let way = believed(after.unwrap_or_default()).map(|believed| believed.way);
            let way = way.unwrap_or_default();
            if let Some(last) = report_samples(json, &simulation.machine(), after, &way) {
                have.sampled_us = micros(last);
            }
        } else if let Some(last) = brick::report_samples(json, have.sampled_us) {
            have.sampled_us = last;
        }
        let notes = notes();
        have.stamp = notes.report_kept(json, have.stamp);
        have.logged = notes.report_log(json, have.logged);
        have.valued = notes.report_values(json, have.valued);
        drop(notes);
        have.time_us = micros(time);
        json.key("have").text(&have.to_string());
    });
    json.into_text()
}

fn micros(time: Duration) -> u64 {
    u64::try_from(time.as_micros()).unwrap_or(u64::MAX)
}

/// The time, and what all pages are sent alike.
fn shared(source: &Source, film: u64) -> (Duration, Arc<str>) {
    let mut shared = locked(&SHARED);
    if let Some(old) = &*shared {
        if old.film == film && old.made.elapsed() < SHARED_FOR {
            return (old.time, Arc::clone(&old.text));
        }
    }
    let mut json = Json::new();
    let time = match source {
        Source::Simulation(simulation) => report_simulation(&mut json, simulation),
        Source::Brick => brick::report(&mut json),
        Source::None => Duration::ZERO,
    };
    let text: Arc<str> = json.into_text().into();
    *shared = Some(Shared { made: Instant::now(), film, time, text: Arc::clone(&text) });
    (time, text)
}

fn report_simulation(json: &mut Json, simulation: &Simulation) -> Duration {
    let believed = believed(Duration::MAX);
    let machine = simulation.machine();
    keep_versions(&machine);
    json.key("robot").object(|json| {
        let Pose { x, y, heading } = machine.pose();
        json.key("true").numbers([x, y, heading], 2);
        report_believed(json, believed.as_ref());
        json.key("hits").integer(machine.trace().collision_count().into());
        json.key("moving").bool(machine.moves());
    });
    machine.report_state(json, &Beside { pulled: pulled() });
    machine.now()
}

/// Renews what is only sent when it has changed.
fn keep_versions(machine: &Machine) {
    static VERSIONS: Mutex<Option<[u64; 3]>> = Mutex::new(None);
    let mut versions = locked(&VERSIONS);
    let now = [film(), machine.world_version(), machine.screen_version()];
    let before = versions.replace(now);
    let [film, world, screen] = before.unwrap_or_default();
    let kept = |name: &str, write: &dyn Fn(&mut Json)| {
        let mut json = Json::new();
        write(&mut json);
        notes().keep(name, json.as_text());
    };
    if before.is_none() || film != now[0] {
        kept("spec", &|json| machine.report_robot(json));
        kept("plugs", &report_plugs);
    }
    if before.is_none() || [film, world] != now[..2] {
        kept("world", &|json| json.object(|json| machine.report_world(json)));
    }
    if before.is_none() || film != now[0] || screen != now[2] {
        kept("screen", &|json| machine.report_screen(json));
    }
}

/// What can be plugged into outputs and inputs.
fn report_plugs(json: &mut Json) {
    json.object(|json| {
        json.key("out").array(|json| {
            for kind in &MOTOR_KINDS {
                json.text(kind.driver_name);
            }
        });
        json.key("in").array(|json| {
            SensorKind::all().for_each(|kind| json.text(kind.driver_name));
        });
    });
}

fn report_clock(json: &mut Json, source: &Source, time: Duration, before_us: u64) {
    json.key("time").number(time.as_secs_f64(), 3);
    let Source::Simulation(simulation) = source else {
        json.key("kind").text("real");
        return;
    };
    json.key("kind").text(match simulation.clock() {
        Clock::Virtual => "virtual",
        Clock::Wall(1.0) => "realtime",
        Clock::Wall(_) => "scaled",
    });
    let pace = match (simulation.pace(), simulation.clock()) {
        (None, Clock::Virtual) => "max".to_owned(),
        (None, Clock::Wall(_)) => "x1".to_owned(),
        (Some(factor), _) if factor.is_infinite() => "max".to_owned(),
        (Some(factor), _) => format!("x{factor}"),
    };
    json.key("pace").text(&pace);
    json.key("paused").bool(simulation.is_paused());
    json.key("stands").bool(micros(time) == before_us);
}

fn report_samples(
    json: &mut Json,
    machine: &Machine,
    after: Option<Duration>,
    way: &[(Duration, ev3_motion::Pose)],
) -> Option<Duration> {
    let (to_world, mut next) = (ToWorld::now(), 0);
    let mut belief = |at: Duration| {
        while way.get(next).is_some_and(|(noted, _)| *noted <= at) {
            next += 1;
        }
        let (_, pose) = way.get(next.checked_sub(1)?)?;
        let ev3_motion::Pose { x, y, heading } = to_world.pose(*pose);
        Some(Pose { x, y, heading })
    };
    machine.report_samples(json, after, &mut belief)
}

/// All samples as a table; `None` if there are none.
pub(super) fn csv() -> Option<String> {
    running_simulation()?.machine().samples_csv()
}
