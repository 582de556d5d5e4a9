//! Having patience with a device that has just been plugged in.
//!
//! The kernel makes a device's files for root alone; udev opens them to the
//! users of the robot, asynchronously, up to a second later. Until then an open
//! for writing answers EACCES, as one of a file that can only be read always
//! does. The two are told apart by a file that can certainly be written.
use crate::device::registry::Devices;
use crate::error::{Error, Interrupted, Result};
use crate::motor::wait::sleep;
use rustix::io::Errno;
use std::time::Duration;

/// How long udev may take to open a new device's files to us.
const PERMISSIONS_WITHIN: Duration = Duration::from_secs(1);

/// The pause between two tries.
pub(crate) const RETRY_EVERY: Duration = Duration::from_millis(20);

/// How often to try again what is refused by a device that udev has opened: it
/// opens the files one after the other.
const LAST_TRIES: u32 = 1;

/// Does something with devices, again and again while one of them is so new
/// that its files are not yet open to us. What `act` does before it opens the
/// last of its files must bear repeating.
///
/// # Errors
/// As `act`; [`Error::Interrupted`].
pub(crate) fn patiently<T>(
    devices: &Devices,
    interrupted: Interrupted,
    mut act: impl FnMut() -> Result<T>,
) -> Result<T> {
    let mut patience = Patience::default();
    loop {
        match devices.afresh(&mut act) {
            Err(error) if patience.lasts(devices, &error) => {
                sleep(devices, RETRY_EVERY, interrupted)?;
            }
            result => return result,
        }
    }
}

/// What is left of the patience with a new device.
#[derive(Default)]
pub(crate) struct Patience {
    tries: u32,
}

impl Patience {
    /// Whether to try again after this error, in a moment.
    pub(crate) fn lasts(&mut self, devices: &Devices, error: &Error) -> bool {
        if error.errno() != Some(Errno::ACCESS) {
            return false;
        }
        let Some(device) = error.path().and_then(|path| devices.owner(path)) else {
            return false;
        };
        if devices.tree().now() >= device.first_seen().saturating_add(PERMISSIONS_WITHIN) {
            return false;
        }
        if device.is_open_to_us() {
            self.tries += 1;
        }
        self.tries <= LAST_TRIES
    }
}
