//! Trying again while a device is getting ready.
//!
//! The kernel makes a device's files for root alone; udev opens them to the users of the robot,
//! asynchronously, up to a second later (docs/ev3dev-sysfs.md, 0.1). Until then an open for writing
//! answers EACCES, as it always does for a file that can only be read. A file that any device of
//! the class lets be written distinguishes the two.
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::error::{Error, Interrupted, Result};
use crate::sysfs::{Sysfs, sleep};
use ev3_os::Errno;
use std::sync::Arc;
use std::time::Duration;

/// How long udev may take to open a new device's files to us.
const PERMISSIONS_WITHIN: Duration = Duration::from_secs(1);

/// The pause between two tries.
const RETRY_EVERY: Duration = Duration::from_millis(20);

/// How often to retry when a device that udev has opened refuses: udev opens the
/// files one after the other.
const LAST_TRIES: u32 = 1;

/// Calls `attempt` every 20 ms until it answers something. `None` means "not yet": the attempt
/// decides which errors and states are worth another try, and for how long.
/// Errors: as `attempt`; [`Error::Interrupted`].
pub(crate) fn until_some<T>(
    tree: &dyn Sysfs,
    interrupted: Interrupted,
    mut attempt: impl FnMut(Interrupted) -> Result<Option<T>>,
) -> Result<T> {
    loop {
        if let Some(result) = attempt(&mut *interrupted)? {
            return Ok(result);
        }
        sleep(tree, RETRY_EVERY, &mut *interrupted)?;
    }
}

/// Does something with devices, and repeats it while one of them is so new that udev has not opened
/// its files yet. It must be harmless to repeat what `act` does before it opens the last of its
/// files. Errors: as `act`; [`Error::Interrupted`].
pub(crate) fn while_permissions_settle<T>(
    registry: &Registry,
    interrupted: Interrupted,
    mut act: impl FnMut() -> Result<T>,
) -> Result<T> {
    let mut retry = Retry::default();
    until_some(registry.tree(), interrupted, |_| match registry.retry_after_relisting(&mut act) {
        Err(error) if retry.is_worthwhile(registry, &error) => Ok(None),
        result => result.map(Some),
    })
}

/// Does something with the device at a port, as [`Registry::with`] does, and
/// waits while udev has not opened the device's files yet.
/// Errors: as `act`, or as [`Registry::all`]; [`Error::Interrupted`].
pub fn with<T>(
    registry: &Registry,
    class: Class,
    port: &str,
    interrupted: Interrupted,
    mut act: impl FnMut(&Arc<Device>) -> Result<T>,
) -> Result<Option<T>> {
    while_permissions_settle(registry, interrupted, || registry.with(class, port, &mut act))
}

/// Decides how often to retry with a device that refuses access.
#[derive(Default)]
pub(crate) struct Retry {
    tries: u32,
}

impl Retry {
    /// Whether to retry after this error, in a moment.
    pub(crate) fn is_worthwhile(&mut self, registry: &Registry, error: &Error) -> bool {
        if error.errno() != Some(Errno::ACCESS) {
            return false;
        }
        let Some(device) = error.path().and_then(|path| registry.owner(path)) else {
            return false;
        };
        if registry.tree().now() >= device.first_seen().saturating_add(PERMISSIONS_WITHIN) {
            return false;
        }
        if device.is_writable() {
            self.tries += 1;
        }
        self.tries <= LAST_TRIES
    }
}
