//! The output of the program, for the page's log.
use super::reach::seconds;
use ev3_os::Instant;
use ev3_os::locked;
use std::collections::VecDeque;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// How much is kept until somebody looks: texts, and the bytes after which one is full.
const TEXTS: usize = 200;
const FULL: usize = 1500;

/// What is written within such a time is one text.
const TOGETHER: f64 = 0.02;

/// For how long the rest of a line is waited for.
const PATIENCE: Duration = Duration::from_millis(500);

/// Whether it is the program that writes, not the toplevel.
static KEEPS: AtomicBool = AtomicBool::new(false);

static PRINTED: Mutex<VecDeque<Printed>> = Mutex::new(VecDeque::new());

struct Printed {
    time: f64,
    since: Instant,
    bytes: Vec<u8>,
}

impl Printed {
    fn is_complete(&self) -> bool {
        self.bytes.ends_with(b"\n") || self.since.elapsed() > PATIENCE
    }
}

/// Whether what is written from now on is kept. The toplevel ends a line that is not complete.
pub(super) fn keep(keeps: bool) {
    KEEPS.store(keeps, Ordering::Relaxed);
    if !keeps {
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
    if let Some(last) = printed.back_mut().filter(|last| last.bytes.len() < FULL) {
        if !last.bytes.ends_with(b"\n") || (last.time - time).abs() < TOGETHER {
            last.bytes.extend_from_slice(bytes);
            return;
        }
    }
    if printed.len() == TEXTS {
        printed.pop_front();
    }
    printed.push_back(Printed { time, since: Instant::now(), bytes: bytes.to_vec() });
}

/// Takes what was written, with the times; the beginning of a line only if there `is_all`.
pub(super) fn take(is_all: bool) -> (Vec<f64>, Vec<String>) {
    let mut printed = locked(&PRINTED);
    let ready = printed.iter().take_while(|each| is_all || each.is_complete()).count();
    let taken = printed.drain(..ready).map(|each| (each.time, plain(&each.bytes)));
    taken.filter(|(_, text)| !text.is_empty()).unzip()
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
