//! Sources of button events, which end together with the file system that they are read from.
use ev3_driver::brick::buttons::Events;
use ev3_os::locked;
use std::sync::{Arc, Mutex, Weak};
use swipl::prelude::*;

/// The button events from the opening of the source to its close.
#[arc_blob("ev3_buttons", defaults)]
pub(crate) struct Source {
    events: Mutex<Option<Arc<Events>>>,
}

/// The sources that somebody may still read.
static SOURCES: Mutex<Vec<Weak<Source>>> = Mutex::new(Vec::new());

impl Source {
    /// A source of events, until it is closed.
    pub(crate) fn open(events: Events) -> Arc<Self> {
        let opened = Arc::new(Self { events: Mutex::new(Some(Arc::new(events))) });
        locked(&SOURCES).retain(|source| source.strong_count() > 0);
        locked(&SOURCES).push(Arc::downgrade(&opened));
        opened
    }

    /// The events; `None` if the source was closed.
    pub(crate) fn events(&self) -> Option<Arc<Events>> {
        locked(&self.events).clone()
    }
}

/// Closes all sources, because their file system is going away. Later reads fail.
#[cfg(feature = "fuse")]
pub(crate) fn close_sources() {
    for source in locked(&SOURCES).drain(..).filter_map(|source| source.upgrade()) {
        *locked(&source.events) = None;
    }
}
