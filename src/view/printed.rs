//! The output of the program, for the page's log.
use super::reach::seconds;
use ev3_os::Instant;
use ev3_os::locked;
use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// How much is kept until somebody looks: texts, the bytes of all, and those after which one is
/// full. Of what a program prints without a pause nobody could read more, but its first
/// [`AT_FIRST`] bytes are there in any case: a listing, a plan.
const TEXTS: usize = 200;
const BYTES: usize = 4 * FULL;
const FULL: usize = 1500;
const AT_FIRST: usize = 20_000;

/// What is written within such a time is one text.
const TOGETHER: f64 = 0.02;

/// For how long the rest of a line is waited for.
const PATIENCE: Duration = Duration::from_millis(500);

/// Whether it is the program that writes, not the toplevel.
static KEEPS: AtomicBool = AtomicBool::new(false);

static PRINTED: Mutex<VecDeque<Printed>> = Mutex::new(VecDeque::new());

/// How many of the first bytes are still to come.
static FIRST: AtomicUsize = AtomicUsize::new(AT_FIRST);

/// How many letters were left out since somebody looked.
static LEFT_OUT: AtomicUsize = AtomicUsize::new(0);

struct Printed {
    time: f64,
    since: Instant,
    bytes: Vec<u8>,
}

impl Printed {
    fn is_complete(&self) -> bool {
        self.bytes.ends_with(b"\n") || self.is_full() || self.since.elapsed() > PATIENCE
    }

    fn is_full(&self) -> bool {
        self.bytes.len() >= FULL
    }

    /// Whether a line that is written now belongs to it.
    fn takes(&self, line: usize, time: f64) -> bool {
        if self.bytes.ends_with(b"\n") {
            self.bytes.len() + line <= FULL && (self.time - time).abs() < TOGETHER
        } else {
            !self.is_full()
        }
    }
}

/// Whether what is written from now on is kept. The toplevel ends a line that is not complete.
pub(super) fn keep(keeps: bool) {
    KEEPS.store(keeps, Ordering::Relaxed);
    if keeps {
        FIRST.store(AT_FIRST, Ordering::Relaxed);
    } else {
        let mut printed = locked(&PRINTED);
        if let Some(last) = printed.back_mut().filter(|last| !last.bytes.ends_with(b"\n")) {
            last.bytes.push(b'\n');
        }
    }
}

/// These bytes were written.
pub(super) fn written(bytes: &[u8]) {
    if bytes.is_empty() || !KEEPS.load(Ordering::Relaxed) {
        return;
    }
    let time = seconds();
    let mut printed = locked(&PRINTED);
    for line in bytes.split_inclusive(|byte| *byte == b'\n') {
        let mut rest = line;
        while !rest.is_empty() {
            if !printed.back().is_some_and(|last| last.takes(rest.len(), time)) {
                let room = BYTES.max(FIRST.load(Ordering::Relaxed));
                while printed.len() == TEXTS || bytes_of(&printed) > room {
                    let oldest = printed.pop_front().map_or(0, |text| letters(&text.bytes));
                    LEFT_OUT.fetch_add(oldest, Ordering::Relaxed);
                }
                printed.push_back(Printed { time, since: Instant::now(), bytes: Vec::new() });
            }
            let Some(last) = printed.back_mut() else { return };
            let room = FULL.saturating_sub(last.bytes.len()).max(4);
            // Not within a letter
            let at = (1..=room.min(rest.len())).rev();
            let end = at
                .into_iter()
                .find(|end| rest.get(*end).is_none_or(|byte| begins(*byte)))
                .unwrap_or(rest.len());
            last.bytes.extend_from_slice(&rest[..end]);
            rest = &rest[end..];
        }
    }
}

/// Whether this byte of UTF-8 begins a letter.
const fn begins(byte: u8) -> bool {
    byte & 0xc0 != 0x80
}

fn bytes_of(printed: &VecDeque<Printed>) -> usize {
    printed.iter().map(|text| text.bytes.len()).sum()
}

fn letters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|byte| begins(**byte)).count()
}

/// Takes what was written, with the times; the beginning of a line only if there `is_all`.
pub(super) fn take(is_all: bool) -> (Vec<f64>, Vec<String>) {
    let mut printed = locked(&PRINTED);
    let ready = printed.iter().take_while(|each| is_all || each.is_complete()).count();
    let bytes: usize = printed.iter().take(ready).map(|each| each.bytes.len()).sum();
    let first = FIRST.load(Ordering::Relaxed);
    FIRST.store(first.saturating_sub(bytes), Ordering::Relaxed);
    let taken = printed.drain(..ready).map(|each| (each.time, plain(&each.bytes)));
    let (mut times, mut texts): (Vec<_>, Vec<_>) =
        taken.filter(|(_, text)| !text.is_empty()).unzip();
    if let Some(time) = times.first().copied() {
        let left_out = LEFT_OUT.swap(0, Ordering::Relaxed);
        if left_out > 0 {
            times.insert(0, time);
            texts.insert(0, format!("({left_out} letters of output are left out here: the program prints faster than anybody can read)"));
        }
    }
    (times, texts)
}

/// The text without the terminal's colors, and without blanks at its end.
fn plain(bytes: &[u8]) -> String {
    let text = String::from_utf8_lossy(bytes);
    let mut plain = String::with_capacity(text.len());
    let mut rest = text.chars();
    while let Some(letter) = rest.next() {
        if letter == '\u{1b}' {
            // ESC [ 1 ; 3 1 m
            rest.by_ref().find(char::is_ascii_alphabetic);
        } else if letter == '\n' || letter == '\t' || !letter.is_control() {
            plain.push(letter);
        }
    }
    plain.truncate(plain.trim_end().len());
    plain
}
