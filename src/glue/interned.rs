//! Frequent words, and their atoms.
//!
//! Fetching the text of an atom, or the atom of a text, is slow compared with reading a
//! sensor's file. So the atoms of the words below are made once and never released, and
//! their handles stay valid. Any other text goes the long way.
use std::borrow::Cow;
use std::sync::OnceLock;
use swipl::fli::atom_in;
use swipl::prelude::*;

/// Ports, attributes, modes and types of the EV3's own devices, and of a few others. The last five
/// come a million times in a task of the planner; Prolog keeps each other text until a call ends.
#[rustfmt::skip]
const WORDS: &[&str] = &[
    "outA", "outB", "outC", "outD", "in1", "in2", "in3", "in4",
    "ev3-ports:outA", "ev3-ports:outB", "ev3-ports:outC", "ev3-ports:outD",
    "ev3-ports:in1", "ev3-ports:in2", "ev3-ports:in3", "ev3-ports:in4",
    "tacho-motor", "lego-sensor", "dc-motor", "servo-motor", "lego-port",
    "command", "max_speed", "position", "position_sp", "speed", "speed_sp", "state",
    "stop_action", "decimals", "mode", "num_values",
    "value0", "value1", "value2", "value3", "value4", "value5", "value6", "value7",
    "run-forever", "run-to-rel-pos", "stop", "coast", "brake", "hold",
    "", "running", "holding", "reached",
    "lego-ev3-l-motor", "lego-ev3-m-motor", "lego-nxt-motor",
    "lego-ev3-color", "lego-ev3-us", "lego-ev3-gyro", "lego-ev3-touch", "lego-ev3-ir",
    "lego-nxt-us", "lego-nxt-touch", "lego-nxt-light", "lego-nxt-temp", "ht-nxt-compass",
    "ms-absolute-imu", "IR-SEEK", "IR-REMOTE", "REFLECT", "AMBIENT", "NXT-TEMP-C", "COMPASS",
    "COL-REFLECT", "COL-AMBIENT", "COL-COLOR", "RGB-RAW", "US-DIST-CM", "US-DIST-IN",
    "US-LISTEN", "GYRO-ANG", "GYRO-G&A", "TOUCH", "IR-PROX", "true", "false", "and", "or", "not",
];

/// The size of the hash tables: a power of two, at most half full.
const SLOTS: usize = 256;
const _: () = assert!(WORDS.len() < SLOTS / 2);

/// The atoms of the words, in their order, and where to find them.
struct Interned {
    atoms: Vec<Atom>,
    by_handle: Table,
    by_text: Table,
}

static INTERNED: OnceLock<Interned> = OnceLock::new();

/// Makes the atoms. Called once, when the library is loaded.
pub(crate) fn register() {
    INTERNED.get_or_init(|| {
        let atoms: Vec<Atom> = WORDS.iter().map(|word| Atom::new(word)).collect();
        let by_handle = Table::of(atoms.iter().map(|atom| slot_of_handle(atom.atom_ptr())));
        let by_text = Table::of(WORDS.iter().map(|word| slot_of_text(word)));
        Interned { atoms, by_handle, by_text }
    });
}

/// The text of an atom; `None` if the term is not an atom.
pub(crate) fn atom_text(term: &Term) -> PrologResult<Option<Cow<'static, str>>> {
    match atom_in!(term).and_then(word) {
        Some(word) => Ok(Some(Cow::Borrowed(word))),
        None => term.get_atom_name(|name| name.map(|name| Cow::Owned(name.to_owned()))),
    }
}

/// The atom that a term is, if it is that of a word, and so never released.
pub(crate) fn word_in(term: &Term) -> Option<usize> {
    atom_in!(term).filter(|handle| word(*handle).is_some())
}

/// The atom of a text, if it is a word.
pub(crate) fn handle(text: &str) -> Option<usize> {
    atom(text).map(Atom::atom_ptr)
}

/// Unifies with the atom of a text.
pub(crate) fn unify_atom(term: &Term, text: &str) -> PrologResult<()> {
    match atom(text) {
        Some(atom) => term.unify(atom),
        None => term.unify(atomable(text)),
    }
}

fn word(handle: usize) -> Option<&'static str> {
    let Interned { atoms, by_handle, .. } = INTERNED.get()?;
    let is_it = |index: usize| atoms.get(index).is_some_and(|atom| atom.atom_ptr() == handle);
    WORDS.get(by_handle.find(slot_of_handle(handle), is_it)?).copied()
}

fn atom(text: &str) -> Option<&'static Atom> {
    let Interned { atoms, by_text, .. } = INTERNED.get()?;
    let is_it = |index: usize| WORDS.get(index).is_some_and(|word| *word == text);
    atoms.get(by_text.find(slot_of_text(text), is_it)?)
}

/// A handle is the number of an atom, above seven bits of type.
fn slot_of_handle(handle: usize) -> usize {
    scattered(handle >> 7)
}

/// Words differ in their lengths, and where these agree, mostly at their ends.
fn slot_of_text(text: &str) -> usize {
    let last: [u8; 2] = text.as_bytes().last_chunk().copied().unwrap_or_default();
    scattered((text.len() << 16) | usize::from(u16::from_le_bytes(last)))
}

/// Spreads numbers that follow one another: where they do, a slot that is taken has a
/// long row of such slots behind it.
fn scattered(number: usize) -> usize {
    number.wrapping_mul(0x9E37_79B1) >> 16
}

/// An open hash table of indices, each plus one: 0 is an empty slot.
struct Table([u8; SLOTS]);

impl Table {
    /// The table of the indices from 0 on, which are to be at these slots, or
    /// at the next ones that are empty.
    fn of(slots: impl Iterator<Item = usize>) -> Self {
        let mut table = Self([0; SLOTS]);
        for (number, first) in (1..).zip(slots) {
            let mut slots = Self::from(first);
            if let Some(slot) = slots.find(|slot| table.0.get(*slot) == Some(&0)) {
                table.0[slot] = number;
            }
        }
        table
    }

    /// The index, from this slot on, for which `is` holds.
    fn find(&self, first: usize, is: impl Fn(usize) -> bool) -> Option<usize> {
        Self::from(first)
            .map_while(|slot| usize::from(*self.0.get(slot)?).checked_sub(1))
            .find(|index| is(*index))
    }

    /// All slots, from one on.
    fn from(first: usize) -> impl Iterator<Item = usize> {
        (0..SLOTS).map(move |step| first.wrapping_add(step) % SLOTS)
    }
}
