//! The accesses of a program to the tree: look up, open, read, write, poll.
use crate::brick::port::Port;
use crate::files::attr::{Access, Effect};
use crate::machine::descriptor::Descriptor;
use crate::machine::socket::Plug;
use crate::machine::tree::{Entry, Hardware, NodeId, PAGE, Stat, Tree};
use crate::machine::{Machine, Written};
use crate::noise::{Echo, Noise, Source};
use crate::sense::View;
use crate::sensor::{Link, Mode, Reading, SUPPLY_MV, Sensor};
use crate::ticks::JIFFY_TICKS;
use crate::trace::Action;
use ev3_motion::Pose;
use ev3_os::linux::Errno;
use std::time::Duration;

/// The place of a sensor at a port without a place in the robot's facts.
const SPARE_MOUNT: Pose = Pose::new(0.0, 7.0, 0.0);

impl Machine {
    /// The node at a path below the class directory; the empty path is that directory.
    /// Errors: ENOENT; ENOTDIR where the path goes on behind a file.
    pub fn resolve(&self, path: &str) -> Result<NodeId, Errno> {
        self.tree.resolve(path)
    }

    /// The node with this name in a directory.
    /// Errors: ENOENT; ENOTDIR; ENODEV if the directory's device is gone.
    pub fn lookup(&self, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        self.tree.lookup(directory, name)
    }

    /// The entries of a directory. Errors: ENOTDIR; ENODEV if its device is gone.
    pub fn read_dir(&self, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        self.tree.list(directory)
    }

    /// The names in the directory of a path, with their nodes.
    /// Errors: as [`Machine::resolve`] and [`Machine::read_dir`].
    pub(crate) fn list(&self, path: &str) -> Result<Vec<(String, NodeId)>, Errno> {
        let entries = self.read_dir(self.resolve(path)?)?;
        Ok(entries.into_iter().map(|entry| (entry.name, entry.node)).collect())
    }

    /// Kind, permission bits and size of a node.
    pub fn stat(&self, node: NodeId) -> Result<Stat, Errno> {
        self.tree.stat(node, self.tick)
    }

    /// The path of a node below the class directory.
    pub fn path(&self, node: NodeId) -> Result<String, Errno> {
        self.tree.path(node)
    }

    /// Opens an attribute, as `open(2)` checks it.
    /// Errors: ENOENT, ENOTDIR, EISDIR; EACCES for what the attribute cannot do, and for writing
    /// while udev has not yet opened the files of a new device.
    pub fn open(&self, path: &str, access: Access) -> Result<NodeId, Errno> {
        let node = self.tree.resolve(path)?;
        self.open_node(node, access).map(|()| node)
    }

    /// The same check for a node that is known already.
    pub fn open_node(&self, node: NodeId, access: Access) -> Result<(), Errno> {
        self.tree.may_open(node, access, self.tick)
    }

    /// The same for a program of root, which does not wait for udev.
    pub fn open_node_as_root(&self, node: NodeId, access: Access) -> Result<(), Errno> {
        self.tree.may_open(node, access, u64::MAX)
    }

    /// Reads an attribute: its driver is called and makes a new text. A [`Descriptor`] decides
    /// which part of it a `pread` gets.
    /// Errors: ENODEV if its device is gone; EACCES if it cannot be read; what the driver answers.
    pub fn read(&mut self, node: NodeId) -> Result<Vec<u8>, Errno> {
        let measured = self.tree.measured(node);
        if measured {
            self.look(Tree::owner(node));
        }
        let text = self.tree.read(node)?;
        if measured {
            self.record(Action::Read, node, &text);
        }
        Ok(text)
    }

    /// True if a write there has the same outcome whenever the same bytes are written, at once: all
    /// those of a tacho motor, as long as it is plugged in.
    pub(crate) fn is_steady(&self, node: NodeId) -> bool {
        matches!(self.tree.hardware(Tree::owner(node)), Some(Hardware::Tacho(_)))
    }

    /// True if reads and writes go to the driver with their offset, as those of `direct` do.
    pub fn is_binary(&self, node: NodeId) -> bool {
        self.tree.is_binary(node)
    }

    /// Reads from an offset on, of a binary attribute. Of another one, its text from there.
    pub fn read_at(&mut self, node: NodeId, offset: usize, count: usize) -> Result<Vec<u8>, Errno> {
        if let Some(bytes) = self.tree.read_at(node, offset, count)? {
            return Ok(bytes);
        }
        let text = self.read(node)?;
        if offset == 0 && text.len() <= count {
            return Ok(text);
        }
        Ok(text.into_iter().skip(offset).take(count).collect())
    }

    /// Writes an attribute: one call of its driver with these bytes. Errors: ENODEV if its device
    /// is gone; EACCES if it cannot be written; what the driver answers.
    pub fn write(&mut self, node: NodeId, bytes: &[u8]) -> Result<Written, Errno> {
        self.write_at(node, 0, bytes)
    }

    /// Writes from an offset on, which only a binary attribute looks at.
    /// Errors: as [`Machine::write`]; EFBIG behind the end of a binary attribute.
    pub fn write_at(
        &mut self,
        node: NodeId,
        offset: usize,
        bytes: &[u8],
    ) -> Result<Written, Errno> {
        // The kernel takes a page at a time (`kernfs_fop_write`).
        let bytes = &bytes[..bytes.len().min(PAGE)];
        let mut written = Written { outcome: Ok(bytes.len()), blocks: Duration::ZERO };
        if bytes.is_empty() {
            return Ok(written);
        }
        let (effect, taken) = self.tree.write(node, offset, bytes)?;
        match taken {
            Some(count) => {
                let taken = &bytes[..count];
                written.outcome = Ok(count);
                self.record(Action::Written, node, format!("{offset}: {taken:?}").as_bytes());
            }
            None => self.record(Action::Written, node, bytes),
        }
        match effect {
            Effect::Done => {}
            Effect::Blocks(time) => written.blocks = time,
            Effect::Reads(mode, time) => {
                written.blocks = time;
                self.read_in(Tree::owner(node), mode);
            }
            Effect::TimesOut(time) => {
                (written.blocks, written.outcome) = (time, Err(Errno::ETIMEDOUT));
            }
            Effect::Appeared => {
                let open_at = self.tick + self.udev_ticks();
                self.tree.appeared(Tree::owner(node), open_at);
            }
            Effect::PortMode(mode) => {
                if let Some(port) = self.port_of(node) {
                    written.blocks = self.port_mode(port, mode);
                }
            }
            Effect::PortDevice(name) => {
                if let Some(port) = self.port_of(node) {
                    self.sockets[port as usize].forced = Some(name);
                    self.register(port, false);
                }
            }
        }
        Ok(written)
    }

    /// The port whose file a node is.
    fn port_of(&self, node: NodeId) -> Option<Port> {
        let owner = Tree::owner(node);
        self.sockets.iter().find(|socket| socket.lego_port == owner).map(|socket| socket.port)
    }

    /// How often an attribute has notified those who poll it. Only `state` of tacho motors and
    /// `value0` of touch sensors ever do.
    /// Errors: ENODEV if its device is gone: then poll returns at once.
    pub fn event_count(&self, node: NodeId) -> Result<u32, Errno> {
        self.tree.events(node)
    }

    /// Opens, reads and closes: for tests and small tools.
    /// Errors: as [`Machine::open`] and [`Machine::read`].
    pub fn read_path(&mut self, path: &str) -> Result<String, Errno> {
        let node = self.open(path, Access::ReadOnly)?;
        self.read(node).map(|text| String::from_utf8_lossy(&text).into_owned())
    }

    /// Opens, writes and closes: for tests and small tools.
    /// Errors: as [`Machine::open`] and [`Machine::write`].
    pub fn write_path(&mut self, path: &str, text: &str) -> Result<Written, Errno> {
        let node = self.open(path, Access::WriteOnly)?;
        Descriptor::new(node).write(self, text.as_bytes())
    }

    fn record(&mut self, action: Action, node: NodeId, bytes: &[u8]) {
        if let Ok(file) = self.tree.file(node) {
            let text = bytes.strip_suffix(b"\n").unwrap_or(bytes);
            self.trace.event(self.now, action, Some(file), text);
        }
    }

    // ---- sensors --------------------------------------------------------------------------

    /// Lets a sensor sample the world, if its values are not fresh.
    pub(super) fn look(&mut self, serial: u64) {
        let hardware = self.tree.hardware(serial);
        if matches!(hardware, Some(Hardware::Sensor(sensor)) if sensor.wants_reading()) {
            self.sample(serial);
        }
    }

    /// A sensor on the bus is read once, in a mode.
    fn read_in(&mut self, serial: u64, mode: usize) {
        let Some(Hardware::Sensor(sensor)) = self.tree.hardware(serial) else {
            return;
        };
        let reading = self.measure_in(sensor, &sensor.kind.modes[mode]);
        if let Some(Hardware::Sensor(sensor)) = self.tree.hardware_mut(serial) {
            sensor.take_in(mode, reading);
        }
    }

    /// The raw data that a sensor would send now.
    pub(crate) fn measure(&self, sensor: &Sensor) -> Reading {
        self.measure_in(sensor, sensor.mode())
    }

    fn measure_in(&self, sensor: &Sensor, mode: &Mode) -> Reading {
        let (link, plug) = (sensor.kind.link, self.sockets[sensor.port() as usize].plug);
        let is_its = plug.is_some_and(|plug| plug.is_of(sensor.kind));
        let raw = |mode: &Mode| mode.raw(self.view(sensor).measure(mode.sense));
        let reading = match link {
            Link::NxtAnalog { .. } if !is_its => {
                [plug.map_or(SUPPLY_MV, |plug| plug.pin1(mode, raw)); 8]
            }
            // Pin 6 is pulled down.
            Link::Analog if !plug.is_some_and(Plug::is_analog) => [0; 8],
            _ => raw(mode),
        };
        // A voltage is one number.
        let numbers = if link.is_analog() { 1 } else { reading.len() };
        std::array::from_fn(|index| if index < numbers { reading[index] } else { 0 })
    }

    /// The world as a sensor sees it now.
    pub(crate) fn view(&self, sensor: &Sensor) -> View<'_> {
        let port = sensor.port();
        let (pose, noise, echo, looks_ahead) = self.mount(port);
        let sample = self.tick / JIFFY_TICKS;
        View {
            scene: &self.scene,
            others: self.others(),
            pose: self.body.pose.compose(&pose),
            angle: sensor.angle,
            rate: sensor.rate,
            power: self.power(),
            axle: sensor.axle,
            is_held: self.held[port as usize],
            looks_ahead,
            noise: Source::new(noise, self.options.seed, port as usize, sample),
            echo: echo.at(self.options.seed, port as usize, sample),
        }
    }

    pub(crate) fn mount(&self, port: Port) -> (Pose, Noise, Echo, bool) {
        let mount = self.robot.sensors.iter().find(|mount| mount.port == port);
        mount.map_or((SPARE_MOUNT, Noise::NONE, Echo::default(), false), |mount| {
            (mount.pose, mount.noise.unwrap_or_default(), mount.echo, mount.looks_ahead)
        })
    }
}
