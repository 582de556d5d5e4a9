//! What pages are told beside the state: the log, values of the program, and what seldom changes.
use ev3_driver::lock::locked;
use ev3_json::Json;
use std::collections::{BTreeMap, VecDeque};
use std::sync::{Mutex, MutexGuard};

/// How many lines of the log, and how many values, are kept.
const LINES: usize = 500;
const VALUES: usize = 8192;

/// How many lines a frame has at most.
const AT_ONCE: usize = 200;

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

/// A line of the log.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub(super) time: f64,
    pub(super) kind: String,
    pub(super) text: String,
    pub(super) causes: Vec<String>,
    pub(super) thread: String,
}

/// What pages are told beside the state.
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
        for text in std::iter::once(&mut entry.text).chain(&mut entry.causes) {
            if let Some((end, _)) = text.char_indices().nth(LONGEST) {
                text.truncate(end);
                text.push_str(" ...");
            }
        }
        if self.log.len() == LINES {
            self.log.pop_front();
        }
        self.log.push_back(entry);
        self.logged += 1;
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
    pub(super) fn keep(&mut self, name: &str, json: &str) {
        match self.kept.get(name) {
            Some((old, _)) if old == json => {}
            _ => {
                self.stamp += 1;
                self.kept.insert(name.to_owned(), (json.to_owned(), self.stamp));
            }
        }
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

    /// Writes the lines after a number of them; returns how many there were then.
    pub(super) fn report_log(&self, json: &mut Json, since: u64) -> u64 {
        let first = self.logged - self.log.len() as u64;
        let skip = usize::try_from(since.saturating_sub(first)).unwrap_or(usize::MAX);
        let new = self.log.iter().skip(skip).take(AT_ONCE);
        let (mut number, count) = (since.max(first), new.len() as u64);
        if count == 0 {
            return self.logged;
        }
        json.key("log").array(|json| {
            for entry in new {
                number += 1;
                json.object(|json| entry.report(json, number));
            }
        });
        number
    }

    /// Writes the values after a number of them; returns how many there were then.
    pub(super) fn report_values(&self, json: &mut Json, since: u64) -> u64 {
        let first = self.valued - self.values.len() as u64;
        let skip = usize::try_from(since.saturating_sub(first)).unwrap_or(usize::MAX);
        let new = self.values.iter().skip(skip);
        if new.len() > 0 {
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

impl Entry {
    fn report(&self, json: &mut Json, number: u64) {
        json.key("n").integer(number.try_into().unwrap_or(i64::MAX));
        json.key("time").number(self.time, 3);
        json.key("kind").text(&self.kind);
        json.key("text").text(&self.text);
        if !self.causes.is_empty() {
            json.key("causes").array(|json| self.causes.iter().for_each(|cause| json.text(cause)));
        }
        if !self.thread.is_empty() {
            json.key("thread").text(&self.thread);
        }
    }
}
