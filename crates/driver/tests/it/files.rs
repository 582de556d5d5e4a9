//! Trees of plain files in temporary directories, and what is asked of them.
use ev3_driver::SysfsDir;
use ev3_driver::error::Access;
use ev3_driver::sysfs::{AttributeFile, Entry};
use ev3_driver::{Class, Registry, Sysfs};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;
use tempfile::TempDir;

/// A directory shaped like `/sys/class`.
pub(crate) struct PlainTree(TempDir);

impl PlainTree {
    pub(crate) fn new() -> Self {
        Self(TempDir::new().unwrap())
    }

    pub(crate) fn root(&self) -> &Path {
        self.0.path()
    }

    /// Makes a device with an address, a type and some attributes more.
    pub(crate) fn plug(
        &self,
        class: Class,
        name: &str,
        address: &str,
        attributes: &[(&str, &str)],
    ) -> PathBuf {
        let path = self.root().join(class.directory()).join(name);
        fs::create_dir_all(&path).unwrap();
        let driver = if class == Class::Sensor { "lego-ev3-touch" } else { "lego-ev3-l-motor" };
        let identity = [("address", address), ("driver_name", driver)];
        for (attribute, text) in identity.iter().chain(attributes) {
            fs::write(path.join(attribute), format!("{text}\n")).unwrap();
        }
        path
    }

    pub(crate) fn motor(&self, name: &str, address: &str) -> PathBuf {
        self.plug(Class::TachoMotor, name, address, &[])
    }

    /// Makes a light or a battery, which have names.
    pub(crate) fn named(&self, class: Class, name: &str, files: &[(&str, &str)]) -> PathBuf {
        let path = self.root().join(class.directory()).join(name);
        fs::create_dir_all(&path).unwrap();
        for (file, text) in files {
            fs::write(path.join(file), format!("{text}\n")).unwrap();
        }
        path
    }

    pub(crate) fn unplug(&self, class: Class, name: &str) {
        fs::remove_dir_all(self.root().join(class.directory()).join(name)).unwrap();
    }

    pub(crate) fn devices(&self) -> Arc<Registry> {
        Arc::new(Registry::new(Arc::new(SysfsDir::new(self.root()))))
    }

    /// A tree with `motor0` at outA, and the same files counted.
    pub(crate) fn with_motor(attributes: &[(&str, &str)]) -> (Self, Arc<Counted>, Arc<Registry>) {
        let tree = Self::new();
        tree.plug(Class::TachoMotor, "motor0", "outA", attributes);
        let (counted, devices) = tree.counted();
        (tree, counted, devices)
    }

    /// The same files behind something that counts what is asked of them.
    pub(crate) fn counted(&self) -> (Arc<Counted>, Arc<Registry>) {
        let counted = Arc::new(Counted {
            files: SysfsDir::new(self.root()),
            now_ms: AtomicUsize::new(0),
            lists: AtomicUsize::new(0),
            opens: AtomicUsize::new(0),
            accesses: Arc::default(),
        });
        (Arc::clone(&counted), Arc::new(Registry::new(counted)))
    }
}

/// [`SysfsDir`], counted, with a clock that the test moves.
pub(crate) struct Counted {
    files: SysfsDir,
    now_ms: AtomicUsize,
    lists: AtomicUsize,
    opens: AtomicUsize,
    accesses: Arc<[AtomicUsize; 2]>,
}

impl Counted {
    pub(crate) fn pass_ms(&self, milliseconds: usize) {
        self.now_ms.fetch_add(milliseconds, Ordering::SeqCst);
    }

    /// Listings since last asked.
    pub(crate) fn lists(&self) -> usize {
        self.lists.swap(0, Ordering::SeqCst)
    }

    /// Opened files since last asked.
    pub(crate) fn opens(&self) -> usize {
        self.opens.swap(0, Ordering::SeqCst)
    }

    /// Reads and writes since last asked.
    pub(crate) fn reads_and_writes(&self) -> (usize, usize) {
        let [reads, writes] = &*self.accesses;
        (reads.swap(0, Ordering::SeqCst), writes.swap(0, Ordering::SeqCst))
    }
}

impl Sysfs for Counted {
    fn root(&self) -> &Path {
        self.files.root()
    }

    /// All entries have the same inode number: a file system may give a new
    /// directory the number of one that was removed.
    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        self.lists.fetch_add(1, Ordering::SeqCst);
        let entries = self.files.list(directory)?;
        Ok(entries.into_iter().map(|entry| Entry { inode: 1, ..entry }).collect())
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        self.opens.fetch_add(1, Ordering::SeqCst);
        let node = self.files.open(path, access)?;
        Ok(Box::new(CountedNode { node, accesses: Arc::clone(&self.accesses) }))
    }

    fn matching(&self, pattern: &str) -> ev3_driver::Result<Vec<PathBuf>> {
        self.files.matching(pattern)
    }

    fn now(&self) -> Duration {
        Duration::from_millis(self.now_ms.load(Ordering::SeqCst) as u64)
    }

    fn pause(&self, _nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        let left = end.saturating_sub(self.now());
        self.pass_ms(usize::try_from(left.as_millis()).unwrap().max(1));
        Ok(true)
    }
}

struct CountedNode {
    node: Box<dyn AttributeFile>,
    accesses: Arc<[AtomicUsize; 2]>,
}

impl AttributeFile for CountedNode {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        self.accesses[0].fetch_add(1, Ordering::SeqCst);
        self.node.read(buffer)
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        self.accesses[1].fetch_add(1, Ordering::SeqCst);
        self.node.write(text)
    }

    fn is_plain(&self) -> bool {
        self.node.is_plain()
    }

    fn check_present(&self) -> io::Result<()> {
        self.node.check_present()
    }
}
