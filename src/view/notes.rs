//! The data for pages beside the state: the log, values of the program, and what seldom changes.
use super::state::{Entry, Report};
use ev3_json::Json;
use ev3_os::locked;
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Mutex, MutexGuard};

/// How many lines of the log, and how many values, are kept.
const LINES: usize = 500;
const VALUES: usize = 8192;

/// How many lines a frame has at most, and how many bytes in all: the newest.
const AT_ONCE: usize = 200;
const BYTES_AT_ONCE: usize = 20_000;

/// The longest text of a line, in letters.
const LONGEST: usize = 2000;

static NOTES: Mutex<Notes> = Mutex::new(Notes {
    log: VecDeque::new(),
    logged: 0,
    values: VecDeque::new(),
    valued: 0,
    kept: BTreeMap::new(),
    stamp: 0,
});

/// All of it.
pub(super) fn notes() -> MutexGuard<'static, Notes> {
    locked(&NOTES)
}

/// What pages get beside the state.
pub(super) struct Notes {
    log: VecDeque<Entry>,
    /// How many lines there were in all.
    logged: u64,
    values: VecDeque<(String, f64, f64)>,
    valued: u64,
    /// Members of frames, each with when it changed.
    kept: BTreeMap<String, (String, u64)>,
    stamp: u64,
}

impl Notes {
    /// Adds a line to the log.
    pub(super) fn log(&mut self, mut entry: Entry) {
        for text in std::iter::once(&mut entry.text).chain(entry.causes.iter_mut().flatten()) {
            if let Some((end, _)) = text.char_indices().nth(LONGEST) {
                text.to_mut().truncate(end);
                text.to_mut().push_str(" ...");
            }
        }
        if self.log.len() == LINES {
            self.log.pop_front();
        }
        self.logged += 1;
        entry.n = self.logged;
        self.log.push_back(entry);
    }

    /// Adds a value.
    pub(super) fn value(&mut self, name: &str, time: f64, number: f64) {
        if self.values.len() == VALUES {
            self.values.pop_front();
        }
        self.values.push_back((name.to_owned(), time, number));
        self.valued += 1;
    }

    /// Sets a member that is sent when it has changed.
    pub(super) fn keep(&mut self, name: &str, json: String) {
        match self.kept.get(name) {
            Some((old, _)) if *old == json => {}
            _ => {
                self.stamp += 1;
                self.kept.insert(name.to_owned(), (json, self.stamp));
            }
        }
    }

    /// Counts of the members, lines and values so far.
    pub(super) fn counts(&self) -> [u64; 3] {
        [self.stamp, self.logged, self.valued]
    }

    /// Writes the members that have changed since a stamp; returns the present one.
    pub(super) fn report_kept(&self, json: &mut Json, since: u64) -> u64 {
        for (name, (text, stamp)) in &self.kept {
            if *stamp > since {
                json.key(name).raw(text);
            }
        }
        self.stamp
    }

    /// Writes the newest lines after a number of them; returns how many there were then.
    pub(super) fn report_log(&self, json: &mut Json, since: u64) -> u64 {
        let mut bytes = 0;
        let mut fits = |entry: &&Entry| {
            bytes += entry.text.len();
            entry.n > since && bytes <= BYTES_AT_ONCE
        };
        let new = self.log.iter().rev().take(AT_ONCE).take_while(&mut fits).count();
        if new > 0 {
            json.key("log").array(|json| {
                self.log.range(self.log.len() - new..).for_each(|entry| entry.report(json));
            });
        }
        self.logged
    }

    /// Writes the values after a number of them; returns how many there were then.
    pub(super) fn report_values(&self, json: &mut Json, since: u64) -> u64 {
        let first = self.valued - self.values.len() as u64;
        let skip = usize::try_from(since.saturating_sub(first)).unwrap_or(usize::MAX);
        let mut new = self.values.iter().skip(skip).peekable();
        if new.peek().is_some() {
            json.key("values").array(|json| {
                for (name, time, number) in new {
                    json.array(|json| {
                        json.text(name);
                        json.number(*time, 3);
                        json.number(*number, 6);
                    });
                }
            });
        }
        self.valued
    }
}
