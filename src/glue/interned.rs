//! Frequent words, found by atom handle.
//!
//! Fetching the text of an atom is slow compared with reading a sensor's file. So the
//! atoms of the words below are made once and never released, and their handles stay
//! valid. The text of any other atom is fetched.
use std::borrow::Cow;
use std::sync::OnceLock;
use swipl::prelude::*;

/// Ports, attributes, modes and types of the EV3's own devices, and of a few others.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "outA", "outB", "outC", "outD", "in1", "in2", "in3", "in4",
    "ev3-ports:outA", "ev3-ports:outB", "ev3-ports:outC", "ev3-ports:outD",
    "ev3-ports:in1", "ev3-ports:in2", "ev3-ports:in3", "ev3-ports:in4",
    "tacho-motor", "lego-sensor",
    "command", "max_speed", "position", "position_sp", "speed", "speed_sp", "state",
    "stop_action", "decimals", "mode", "num_values",
    "value0", "value1", "value2", "value3", "value4", "value5", "value6", "value7",
    "run-forever", "run-to-rel-pos", "stop", "coast", "brake", "hold",
    "lego-ev3-l-motor", "lego-ev3-m-motor", "lego-nxt-motor",
    "lego-ev3-color", "lego-ev3-us", "lego-ev3-gyro", "lego-ev3-touch", "lego-ev3-ir",
    "lego-nxt-us", "lego-nxt-touch", "lego-nxt-light", "lego-nxt-temp", "ht-nxt-compass",
    "ms-absolute-imu", "IR-SEEK", "IR-REMOTE", "REFLECT", "AMBIENT", "NXT-TEMP-C", "COMPASS",
    "COL-REFLECT", "COL-AMBIENT", "COL-COLOR", "RGB-RAW", "US-DIST-CM", "US-DIST-IN",
    "US-LISTEN", "GYRO-ANG", "GYRO-RATE", "TOUCH", "IR-PROX",
];

/// Handles and words, in the order of the handles.
static BY_HANDLE: OnceLock<Box<[(usize, &str)]>> = OnceLock::new();

/// Makes the atoms. Called once, when the library is loaded.
pub(crate) fn register() {
    BY_HANDLE.get_or_init(|| {
        let handle = |word: &&'static str| {
            let atom = Atom::new(word);
            let handle = atom.atom_ptr();
            // The process never releases them.
            std::mem::forget(atom);
            (handle, *word)
        };
        let mut words: Box<[_]> = WORDS.iter().map(handle).collect();
        words.sort_unstable();
        words
    });
}

/// The text of an atom; `None` if the term is no atom.
pub(crate) fn atom_text(term: &Term) -> PrologResult<Option<Cow<'static, str>>> {
    let known = term.get_atom(|atom| atom.and_then(|atom| word(atom.atom_ptr())))?;
    match known {
        Some(word) => Ok(Some(Cow::Borrowed(word))),
        None => term.get_atom_name(|name| name.map(|name| Cow::Owned(name.to_owned()))),
    }
}

fn word(handle: usize) -> Option<&'static str> {
    let words = BY_HANDLE.get()?;
    let index = words.binary_search_by_key(&handle, |(handle, _)| *handle).ok()?;
    words.get(index).map(|(_, word)| *word)
}
