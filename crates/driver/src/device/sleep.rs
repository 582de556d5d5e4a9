//! Sleeping.
use crate::device::registry::Registry;
use crate::error::Result;
use crate::sysfs::SLICE;
use crate::wait::{Look, Slices, Wait};
use std::sync::Arc;
use std::time::Duration;

/// The longest sleep where nothing else ends it but a signal, which is sometimes sent just before
/// it begins. Shorter ones cost more.
const NAP: Duration = Duration::from_millis(100);

/// Sleeping, by the clock of the tree.
pub struct Sleep {
    registry: Arc<Registry>,
    end: Duration,
}

impl Sleep {
    /// For some time from now on.
    pub fn new(registry: Arc<Registry>, time: Duration) -> Slices<Self> {
        let end = registry.tree().now().saturating_add(time);
        Slices::new(Self { registry, end })
    }
}

impl Wait for Sleep {
    type End = ();

    fn look(&mut self) -> Result<Look<()>> {
        let tree = self.registry.tree();
        let slice = if tree.goes_on() { NAP } else { SLICE };
        Ok(Look::again(tree.now(), slice, Some(self.end), ()))
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        Ok(self.registry.tree().pause(&[], end).unwrap_or(true))
    }
}
