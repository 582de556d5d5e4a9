//! The devices that are connected, by class and port.
//!
//! The kernel lists each class in a directory of its own, one entry a device, under numbers that
//! follow the order of plugging in. Programs name ports. The listing is cached. It is renewed when
//! it is older than [`LISTING_AGE`], when a port is asked for that it does not have, and when a
//! device answers as an unplugged one does. Devices that are still there keep their descriptors.
use crate::class::{Class, Detected};
use crate::device::{Device, Gears, MotionObserver, Observer, identity};
use crate::error::{Access, Error, Result};
use crate::journal::Journal;
use crate::port_name;
use crate::sysfs::{Entry, Sysfs};
use ev3_os::Errno;
use ev3_os::locked;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, Weak};
use std::time::Duration;

/// How long a listing of a class directory is believed.
pub const LISTING_AGE: Duration = Duration::from_millis(100);

/// The devices in a tree.
pub struct Registry {
    tree: Arc<dyn Sysfs>,
    listings: [Mutex<Listing>; Class::ALL.len()],
    /// How often a listing got other devices, or was forgotten.
    changes: AtomicU32,
    observer: Arc<Observer>,
    journal: Arc<Journal>,
    gears: Arc<Gears>,
}

/// When a class was last listed; see [`Registry::holds`].
#[derive(Clone, Copy, Debug)]
pub struct Listed {
    made: Option<Duration>,
    changes: u32,
}

/// The devices in a class directory when it was last listed.
#[derive(Default)]
struct Listing {
    made: Option<Duration>,
    /// In the order of ports.
    devices: Arc<[Arc<Device>]>,
    by_port: ByPort,
}

/// Devices by their ports. These differ at their ends: so the last eight bytes are compared
/// first, as a number.
#[derive(Default)]
struct ByPort(Box<[Port]>);

/// The end of a port's name, its name, and the device there.
type Port = (u64, Box<str>, Arc<Device>);

impl ByPort {
    fn new(devices: BTreeMap<&str, &Arc<Device>>) -> Self {
        let owned =
            |(port, it): (&str, &Arc<Device>)| -> Port { (end(port), port.into(), Arc::clone(it)) };
        let mut devices: Box<[Port]> = devices.into_iter().map(owned).collect();
        devices.sort_unstable_by(|a, b| (a.0, &a.1).cmp(&(b.0, &b.1)));
        Self(devices)
    }

    fn get(&self, port: &str) -> Option<&Arc<Device>> {
        let end = end(port);
        let order =
            |(other_end, other, _): &Port| other_end.cmp(&end).then_with(|| (**other).cmp(port));
        let at = self.0.binary_search_by(order).ok()?;
        self.0.get(at).map(|(_, _, device)| device)
    }
}

/// The last eight bytes of a port's name, or all, as a number.
fn end(port: &str) -> u64 {
    let bytes = port.as_bytes();
    let from = bytes.len().saturating_sub(8);
    bytes.iter().skip(from).fold(0, |number, byte| number << 8 | u64::from(*byte))
}

impl Registry {
    /// The devices in a tree. Nothing is read yet.
    pub fn new(tree: Arc<dyn Sysfs>) -> Self {
        Self {
            tree,
            listings: Default::default(),
            changes: AtomicU32::default(),
            observer: Arc::default(),
            journal: Arc::default(),
            gears: Arc::default(),
        }
    }

    /// The tree they are in.
    pub fn tree(&self) -> &dyn Sysfs {
        &*self.tree
    }

    /// What the program has done in the tree.
    pub fn journal(&self) -> &Journal {
        &self.journal
    }

    /// All devices of a class, in the order of their ports.
    /// Errors: the kernel's. A class that does not exist has no devices.
    pub fn all(&self, class: Class) -> Result<Arc<[Arc<Device>]>> {
        let mut listing = self.listing(class);
        if !self.is_fresh(&listing) {
            self.list(class, &mut listing)?;
        }
        Ok(Arc::clone(&listing.devices))
    }

    /// When a class was last listed.
    pub fn listed(&self, class: Class) -> Listed {
        let changes = self.changes.load(Ordering::Acquire);
        Listed { made: self.listing(class).made, changes }
    }

    /// Whether a listing is still believed at this time: then whatever was found by it is
    /// found again.
    pub fn holds(&self, listed: Listed, now: Duration) -> bool {
        listed.changes == self.changes.load(Ordering::Acquire) && is_fresh(listed.made, now)
    }

    /// The devices of a class at the last listing.
    pub(crate) fn known(&self, class: Class) -> Arc<[Arc<Device>]> {
        Arc::clone(&self.listing(class).devices)
    }

    /// The device at a port, which may be spelled either way. A sensor on the
    /// I2C bus is found by its socket, too.
    pub fn find(&self, class: Class, port: &str) -> Result<Option<Arc<Device>>> {
        let port = port_name::short(port);
        let mut listing = self.listing(class);
        if self.is_fresh(&listing) {
            if let Some(device) = listing.by_port.get(port) {
                return Ok(Some(Arc::clone(device)));
            }
        }
        match self.list(class, &mut listing) {
            // If the class cannot be listed, trust the last listing: a robot can still be stopped.
            Err(error) if is_exhaustion(&error) && listing.by_port.get(port).is_some() => {}
            listed => listed?,
        }
        Ok(listing.by_port.get(port).cloned())
    }

    /// Whether that very device is still plugged in.
    pub fn has(&self, device: &Device) -> Result<bool> {
        let present = self.find(device.class(), device.port())?;
        Ok(present.is_some_and(|present| std::ptr::eq(Arc::as_ptr(&present), device)))
    }

    /// Calls a closure with the device at a port; `None` if there is no device.
    /// Errors: as `act`, or as [`all`](Self::all).
    pub fn with<T>(
        &self,
        class: Class,
        port: &str,
        mut act: impl FnMut(&Arc<Device>) -> Result<T>,
    ) -> Result<Option<T>> {
        self.retry_after_relisting(|| match self.find(class, port)? {
            Some(device) => {
                device.check_present()?;
                act(&device).map(Some)
            }
            None => Ok(None),
        })
    }

    /// Reads from a device, or from the one that has replaced it; `None` if the port is empty now.
    /// Errors: as `read`, or as [`all`](Self::all).
    pub fn read<T>(
        &self,
        device: &Device,
        read: impl Fn(&Device) -> Result<T>,
    ) -> Result<Option<T>> {
        match device.check_present().and_then(|()| read(device)) {
            Err(error) if error.is_stale() => {
                self.forget_listings();
                self.with(device.class(), device.port(), |device| read(device))
            }
            result => result.map(Some),
        }
    }

    /// Calls `act`, and once more with a new listing if it met a device that answers as an
    /// unplugged one does: a device that was plugged in again has another number. Errors: as `act`.
    pub(crate) fn retry_after_relisting<T>(&self, mut act: impl FnMut() -> Result<T>) -> Result<T> {
        match act() {
            Err(error) if error.is_stale() => {
                self.forget_listings();
                act()
            }
            result => result,
        }
    }

    /// The device that a file belongs to, among those listed.
    pub(crate) fn owner(&self, path: &Path) -> Option<Arc<Device>> {
        Class::ALL.into_iter().find_map(|class| {
            let listing = self.listing(class);
            listing.devices.iter().find(|device| path.starts_with(device.path())).cloned()
        })
    }

    /// Makes each class be listed again when it is next asked for.
    pub fn forget_listings(&self) {
        self.changes.fetch_add(1, Ordering::AcqRel);
        for class in Class::ALL {
            self.listing(class).made = None;
        }
    }

    /// The devices whose directories match a shell pattern, in the order of
    /// their ports. Directories that hold no device are passed over.
    /// Errors: [`Error::Pattern`]; the kernel's, as EMFILE.
    pub fn detect(&self, pattern: &str) -> Result<Vec<Detected>> {
        let paths = self.tree.matching(pattern)?;
        let mut detected = Vec::new();
        for path in paths {
            match identity(&*self.tree, &path) {
                Ok((address, driver)) => {
                    let port = port_name::short(&address).to_owned();
                    detected.push(Detected { port, driver, path });
                }
                Err(error) if is_exhaustion(&error) => return Err(error),
                Err(_) => {}
            }
        }
        detected.sort_unstable_by(|a, b| {
            port_name::order(&a.port, &b.port).then_with(|| a.path.cmp(&b.path))
        });
        Ok(detected)
    }

    /// Makes the motors report to an observer. A registry has one.
    pub(crate) fn observe(&self, observer: Weak<dyn MotionObserver>) {
        self.observer.set(observer);
    }

    fn listing(&self, class: Class) -> MutexGuard<'_, Listing> {
        // Class::ALL is in the order of the enum.
        let [tacho_motor, sensor, servo_motor, dc_motor, port, led, battery] = &self.listings;
        let listing = match class {
            Class::TachoMotor => tacho_motor,
            Class::Sensor => sensor,
            Class::ServoMotor => servo_motor,
            Class::DcMotor => dc_motor,
            Class::Port => port,
            Class::Led => led,
            Class::Battery => battery,
        };
        locked(listing)
    }

    fn detected(&self, class: Class, entry: Entry) -> Result<Device> {
        Device::detect(&self.tree, &self.observer, &self.journal, &self.gears, class, entry)
    }

    fn is_fresh(&self, listing: &Listing) -> bool {
        is_fresh(listing.made, self.tree.now())
    }

    /// Lists the class directory, keeping the devices that are still there.
    fn list(&self, class: Class, listing: &mut Listing) -> Result<()> {
        let directory = self.tree.root().join(class.directory());
        let mut entries = match self.tree.list(&directory) {
            Ok(entries) => entries,
            Err(error) if Errno::from_io_error(&error) == Some(Errno::NOENT) => Vec::new(),
            Err(source) => {
                return Err(Error::Open { path: directory, access: Access::Read, source });
            }
        };
        listing.made = Some(self.tree.now());
        entries.retain(|entry| class.admits(&entry.name));
        let is_same = entries.len() == listing.devices.len()
            && entries.iter().all(|entry| listing.devices.iter().any(|d| d.is_at(entry)));
        if is_same {
            return Ok(());
        }
        self.changes.fetch_add(1, Ordering::AcqRel);
        let mut devices = Vec::with_capacity(entries.len());
        for entry in entries {
            match listing.devices.iter().find(|device| device.is_at(&entry)) {
                Some(known) => devices.push(Arc::clone(known)),
                None => match self.detected(class, entry) {
                    Ok(device) => devices.push(Arc::new(device)),
                    Err(error) if is_exhaustion(&error) => return Err(error),
                    // Unplugged again, or not a device: the next listing tries again.
                    Err(_) => {}
                },
            }
        }
        let key = |device: &Device| (device.port().to_owned(), device.entry().name.clone());
        devices.sort_unstable_by(|a, b| {
            let ((a_port, a_name), (b_port, b_name)) = (key(a), key(b));
            port_name::order(&a_port, &b_port).then_with(|| port_name::order(&a_name, &b_name))
        });
        // A port has one device of a class. If two directories name the same port, the
        // one with the lower number is about to vanish.
        devices.reverse();
        devices.dedup_by(|earlier, later| earlier.port() == later.port());
        devices.reverse();
        // By its socket, too, if nothing else is there; of two, the first.
        let in_socket = devices.iter().rev();
        let in_socket = in_socket.map(|device| (port_name::socket(device.port()), device));
        let at_port = devices.iter().map(|device| (device.port(), device));
        let all = in_socket.chain(at_port);
        listing.by_port = ByPort::new(all.collect());
        listing.devices = devices.into();
        Ok(())
    }
}

fn is_fresh(made: Option<Duration>, now: Duration) -> bool {
    made.is_some_and(|made| now.saturating_sub(made) < LISTING_AGE)
}

/// Whether this process has run out of descriptors or memory.
fn is_exhaustion(error: &Error) -> bool {
    matches!(error.errno(), Some(Errno::MFILE | Errno::NFILE | Errno::NOMEM))
}
