//! The simulated brick's attribute files as a [`Sysfs`]: the driver uses them like real
//! files. [`ev3_sim::Simulation`] is their clock.
use ev3_driver::SysfsDir;
use ev3_driver::error::Access;
use ev3_driver::sysfs::{AttributeFile, Entry, Repeated, Sysfs};
use ev3_sim::{Clock, Errno, NodeId, Simulation};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

/// The directory that programs see.
const ROOT: &str = "/sys/class";

/// The attribute files of a simulation.
pub(crate) struct SimulatedFiles {
    simulation: Arc<Simulation>,
    root: PathBuf,
    /// Files that are not ev3dev's.
    others: SysfsDir,
}

impl SimulatedFiles {
    pub(crate) fn new(simulation: Arc<Simulation>) -> Self {
        Self { simulation, root: ROOT.into(), others: SysfsDir::new("/") }
    }

    /// The path below the root; `None` if the path is elsewhere.
    fn below<'a>(&self, path: &'a Path) -> Option<&'a str> {
        path.strip_prefix(&self.root).ok()?.to_str()
    }

    fn list_below(&self, path: &str) -> io::Result<Vec<Entry>> {
        let entries = self.simulation.list(path).map_err(io::Error::from)?;
        Ok(entries.into_iter().map(|(name, node)| Entry { name, inode: node.0 }).collect())
    }
}

impl Sysfs for SimulatedFiles {
    fn root(&self) -> &Path {
        &self.root
    }

    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        self.list_below(self.below(directory).ok_or(Errno::ENOENT)?)
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        let Some(below) = self.below(path) else {
            return self.others.open(path, access);
        };
        let wanted = match access {
            Access::Read => ev3_sim::Access::ReadOnly,
            Access::Write => ev3_sim::Access::WriteOnly,
        };
        let node = self.simulation.open(below, wanted).map_err(io::Error::from)?;
        Ok(Box::new(SimulatedFile { simulation: Arc::clone(&self.simulation), node }))
    }

    fn matching(&self, pattern: &str) -> ev3_driver::Result<Vec<PathBuf>> {
        let matcher = glob::Pattern::new(pattern.trim_end_matches('/'))
            .map_err(|source| ev3_driver::Error::Pattern { pattern: pattern.to_owned(), source })?;
        let mut paths = Vec::new();
        for class in self.list_below("").unwrap_or_default() {
            for device in self.list_below(&class.name).unwrap_or_default() {
                paths.push(self.root.join(&class.name).join(device.name));
            }
        }
        paths.retain(|path| matcher.matches_path(path));
        paths.sort_unstable();
        Ok(paths)
    }

    fn now(&self) -> Duration {
        self.simulation.machine().now()
    }

    fn goes_on(&self) -> bool {
        self.simulation.clock() != Clock::Virtual
    }

    fn pause(&self, _nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        Ok(self.simulation.pause(end))
    }

    fn thinking(&self) -> u64 {
        self.simulation.thinking()
    }

    fn takes_turns(&self) -> bool {
        true
    }

    fn turn(&self, about: &mut dyn FnMut() -> String) -> bool {
        self.simulation.turn(about)
    }

    fn every(&self, period: Duration, act: Repeated) -> io::Result<()> {
        self.simulation.repeat(period, act);
        Ok(())
    }
}

/// An open file of a simulation.
struct SimulatedFile {
    simulation: Arc<Simulation>,
    node: NodeId,
}

impl AttributeFile for SimulatedFile {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        self.read_at(buffer, 0)
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        self.write_at(text, 0)
    }

    fn read_at(&self, buffer: &mut [u8], offset: u8) -> io::Result<usize> {
        self.simulation.read(self.node, offset.into(), buffer).map_err(io::Error::from)
    }

    fn write_at(&self, bytes: &[u8], offset: u8) -> io::Result<()> {
        let written = self.simulation.write(self.node, offset.into(), bytes);
        let (written, start) = written.map_err(io::Error::from)?;
        let end = start + written.blocks;
        while self.simulation.machine().now() < end && !self.simulation.is_acting() {
            self.simulation.pause(end);
        }
        written.outcome.map(drop).map_err(io::Error::from)
    }
}
