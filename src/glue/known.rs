//! The devices that a thread has found, by the atoms of its calls.
//!
//! A program asks for the same few devices thousands of times a second. What one of its
//! calls has found, the next ones have at once, for as long as the listing of the class is
//! believed (`LISTING_AGE`); then the whole way is gone again. Simulated devices are not
//! kept here: there each call waits for its turn.
use crate::glue::call::Text;
use crate::glue::due::is_any_due;
use crate::glue::interned::handle;
use crate::glue::state;
use ev3_driver::device::registry::Listed;
use ev3_driver::{Class, Device, Registry, Value};
use std::cell::RefCell;
use std::sync::{Arc, Weak};
use std::time::Duration;
use swipl::fli::Arguments;

/// The handles of the atoms of a call, which are never released; 0 for a variable.
pub(crate) type Key = [usize; 3];

/// How many are kept: a power of two.
const SLOTS: usize = 64;

thread_local! {
    static KNOWN: RefCell<Vec<Option<Entry>>> = const { RefCell::new(Vec::new()) };
}

/// A device, and what is asked of it.
struct Entry {
    key: Key,
    /// The files in use, by [`state::files_number`].
    files: u64,
    listed: Listed,
    registry: Weak<Registry>,
    device: Weak<Device>,
    name: Text,
    index: usize,
}

/// What a call has found.
pub(crate) struct Found<'a> {
    pub(crate) registry: &'a Registry,
    pub(crate) device: &'a Arc<Device>,
    /// The attribute, or the mode.
    pub(crate) name: &'a str,
    pub(crate) index: usize,
    pub(crate) now: Duration,
}

/// When the devices of a class are looked for: what is found from then on may be kept.
#[derive(Clone, Copy)]
pub(crate) struct Look {
    files: u64,
    listed: Listed,
}

impl Look {
    /// `None` where nothing is kept.
    pub(crate) fn at(registry: &Registry, class: Class) -> Option<Self> {
        let files = state::files_number();
        let keeps = state::has_files_number() && !registry.tree().takes_turns();
        keeps.then(|| Self { files, listed: registry.listed(class) })
    }

    /// Keeps what was found, if all atoms of the call stay: the others are `None`.
    pub(crate) fn keep(
        self,
        atoms: [Option<usize>; 3],
        registry: &Arc<Registry>,
        device: &Arc<Device>,
        name: Text,
        index: usize,
    ) {
        let [Some(first), Some(second), Some(third)] = atoms else {
            return;
        };
        let (key, Self { files, listed }) = ([first, second, third], self);
        let (registry, device) = (Arc::downgrade(registry), Arc::downgrade(device));
        // A thread that ends has none any more.
        let _ = KNOWN.try_with(|known| {
            let mut known = known.try_borrow_mut().ok()?;
            known.resize_with(SLOTS, || None);
            *known.get_mut(slot(key))? =
                Some(Entry { key, files, listed, registry, device, name, index });
            Some(())
        });
    }
}

/// Calls `act` with what such a call of this thread has found, if it would find it again.
#[inline]
pub(crate) fn with<T>(key: Key, act: impl FnOnce(Found) -> Option<T>) -> Option<T> {
    if is_any_due() {
        return None;
    }
    ev3_signals::lives();
    let found = KNOWN.try_with(|known| {
        let known = known.try_borrow().ok()?;
        let entry = known.get(slot(key))?.as_ref()?;
        if entry.key != key || entry.files != state::files_number() {
            return None;
        }
        let (registry, device) = (&entry.registry.upgrade()?, &entry.device.upgrade()?);
        let now = registry.tree().now();
        if !registry.holds(entry.listed, now) {
            return None;
        }
        act(Found { registry, device, name: &entry.name, index: entry.index, now })
    });
    found.ok()?
}

/// Unifies an argument with a number or a frequent word.
pub(crate) fn unify_value(arguments: &Arguments, number: usize, value: &Value) -> Option<bool> {
    match value {
        Value::Integer(integer) => Some(arguments.unify_integer(number, *integer)),
        Value::Float(float) => Some(arguments.unify_float(number, *float)),
        Value::Text(text) => Some(arguments.unify_atom(number, handle(text)?)),
    }
}

/// A handle is the number of an atom, above seven bits of type.
fn slot(key: Key) -> usize {
    let number =
        key.iter().fold(0_usize, |sum, handle| sum.wrapping_mul(31).wrapping_add(handle >> 7));
    number % SLOTS
}
