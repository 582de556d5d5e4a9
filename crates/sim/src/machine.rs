//! The whole: brick, robot, world, and the calls that a program and its test make.

use std::time::Duration;

use crate::attr::{Access, Effect};
use crate::brick::{Battery, Board, LEDS, Led};
use crate::dc::DcMotor;
use crate::descriptor::Descriptor;
use crate::drive::Body;
use crate::errno::Errno;
use crate::geometry::Pose;
use crate::motor::Tacho;
use crate::noise::{Noise, Source};
use crate::port::{LegoPort, Port};
use crate::robot::RobotSpec;
use crate::scene::{ItemId, Scene};
use crate::sense::View;
use crate::sensor::{Reading, Sensor};
use crate::shaft::Shaft;
use crate::socket::{Plug, Socket};
use crate::trace::{Action, Collision, Event, Trace};
use crate::tree::{Entry, Hardware, NodeId, Stat, Tree};
use crate::world::{Item, SpecError, WorldSpec};
use crate::{JIFFY_TICKS, TICK_US, ticks_from_ms};

/// udev needs about half a second to open the files of a new device to the group.
const UDEV_MS: i32 = 500;
/// Writing `nxt-i2c` to a port's mode waits for sensors to boot.
const I2C_PROBE: Duration = Duration::from_secs(1);
/// Where a sensor sits on a port for which the robot names none.
const SPARE_MOUNT: Pose = Pose::new(0.0, 7.0, 0.0);

/// How faithful a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// Where noise starts from.
    pub seed: u64,
    /// A plug that is moved is noticed at once, its files are open at once, and a sensor changes
    /// its mode at once and settled. Real bricks take their time: 0.4 s for a motor, 1.3 s for a
    /// serial sensor, 0.5 s more for write permission, some ms for a mode.
    pub instant: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            seed: 1,
            instant: false,
        }
    }
}

/// What a successful write did.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Bytes taken: all of them.
    pub length: usize,
    /// The real call returns only after this time. There is no clock here to wait for, so an
    /// adapter that has one lets so much time pass before it returns to its caller.
    pub blocks: Duration,
}

/// A brick with its robot in its world. `clone` is a snapshot.
#[derive(Clone, Debug)]
pub struct Machine {
    pub(crate) options: Options,
    pub(crate) now: Duration,
    pub(crate) tick: u64,
    pub(crate) tree: Tree,
    pub(crate) sockets: Vec<Socket>,
    pub(crate) shafts: [Shaft; 4],
    pub(crate) battery: u64,
    pub(crate) robot: RobotSpec,
    pub(crate) body: Body,
    pub(crate) scene: Scene,
    pub(crate) trace: Trace,
}

impl Default for Machine {
    /// The default robot in the room, without noise.
    ///
    /// # Panics
    /// Never: the shipped world and robot are valid.
    fn default() -> Self {
        Machine::new(
            &WorldSpec::room(),
            &RobotSpec::default(),
            Options::default(),
        )
        .expect("the shipped world and robot are valid")
    }
}

impl Machine {
    /// Boots a brick with everything plugged in, standing at the start of the world.
    ///
    /// # Errors
    /// Names what is impossible in the world or the robot, or that the start is inside something.
    pub fn new(
        world: &WorldSpec,
        robot: &RobotSpec,
        options: Options,
    ) -> Result<Machine, SpecError> {
        robot.validate()?;
        let scene = Scene::new(world)?;
        let mut tree = Tree::new();
        let lego_ports = Port::ALL.map(|port| tree.add(Hardware::Port(LegoPort::new(port)), 0));
        for (name, brightness) in LEDS {
            tree.add(Hardware::Led(Led::new(name, brightness)), 0);
        }
        let battery = tree.add(Hardware::Battery(Battery::new()), 0);
        tree.add(Hardware::Board(Board), 0);
        let socket = |(port, lego_port)| Socket {
            port,
            plug: None,
            due: None,
            device: None,
            lego_port,
            forced: None,
        };
        let mut machine = Machine {
            options,
            now: Duration::ZERO,
            tick: 0,
            tree,
            sockets: Port::ALL.into_iter().zip(lego_ports).map(socket).collect(),
            shafts: std::array::from_fn(|_| Shaft::new()),
            battery,
            robot: robot.clone(),
            body: Body::new(robot, world.start),
            scene,
            trace: Trace::new(),
        };
        machine.check_free(&world.start)?;
        for mount in &robot.motors {
            machine.sockets[mount.port as usize].plug = Plug::named(&mount.driver, mount.port);
        }
        for mount in &robot.sensors {
            machine.sockets[mount.port as usize].plug = Plug::named(&mount.driver, mount.port);
        }
        for port in Port::ALL {
            if let Some(Plug::Motor(kind)) = machine.sockets[port as usize].plug {
                machine.shafts[port.slot()].kind = kind;
            }
            machine.register(port, true);
        }
        machine.trace.tick(0, Duration::ZERO, world.start);
        Ok(machine)
    }

    // ---- files ----------------------------------------------------------------------------

    /// The node at a path below the class directory; the empty path is that directory.
    ///
    /// # Errors
    /// ENOENT; ENOTDIR where the path goes on behind a file.
    pub fn resolve(&self, path: &str) -> Result<NodeId, Errno> {
        self.tree.resolve(path)
    }

    /// The node with this name in a directory.
    ///
    /// # Errors
    /// ENOENT; ENOTDIR; ENODEV if the directory's device is gone.
    pub fn lookup(&self, directory: NodeId, name: &str) -> Result<NodeId, Errno> {
        self.tree.lookup(directory, name)
    }

    /// What is in a directory.
    ///
    /// # Errors
    /// ENOTDIR; ENODEV if its device is gone.
    pub fn read_dir(&self, directory: NodeId) -> Result<Vec<Entry>, Errno> {
        self.tree.list(directory)
    }

    /// Kind, permission bits and size of a node.
    ///
    /// # Errors
    /// ENODEV if its device is gone.
    pub fn stat(&self, node: NodeId) -> Result<Stat, Errno> {
        self.tree.stat(node, self.tick)
    }

    /// The path of a node below the class directory.
    ///
    /// # Errors
    /// ENODEV if its device is gone.
    pub fn path(&self, node: NodeId) -> Result<String, Errno> {
        self.tree.path(node)
    }

    /// Opens an attribute, as `open(2)` checks it.
    ///
    /// # Errors
    /// ENOENT, ENOTDIR, EISDIR; EACCES for what the attribute cannot do, and for writing while
    /// udev has not yet opened the files of a new device.
    pub fn open(&self, path: &str, access: Access) -> Result<NodeId, Errno> {
        let node = self.tree.resolve(path)?;
        self.open_node(node, access).map(|()| node)
    }

    /// The same check for a node that is known already.
    ///
    /// # Errors
    /// As [`Machine::open`].
    pub fn open_node(&self, node: NodeId, access: Access) -> Result<(), Errno> {
        self.tree.may_open(node, access, self.tick)
    }

    /// Reads an attribute: its driver is called and makes the text anew. Which part of it a
    /// `pread` gets is the business of a [`Descriptor`].
    ///
    /// # Errors
    /// ENODEV if its device is gone; EACCES if it cannot be read; what the driver answers.
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

    /// Writes an attribute: one call of its driver with these bytes.
    ///
    /// # Errors
    /// ENODEV if its device is gone; EACCES if it cannot be written; what the driver answers.
    pub fn write(&mut self, node: NodeId, bytes: &[u8]) -> Result<Written, Errno> {
        let mut written = Written {
            length: bytes.len(),
            blocks: Duration::ZERO,
        };
        if bytes.is_empty() {
            return Ok(written);
        }
        let effect = self.tree.write(node, bytes)?;
        self.record(Action::Written, node, bytes);
        let port = self
            .sockets
            .iter()
            .find(|s| s.lego_port == Tree::owner(node))
            .map(|s| s.port);
        match (effect, port) {
            (Effect::Blocks(time), _) => written.blocks = time,
            (Effect::PortMode(mode), Some(port)) => written.blocks = self.port_mode(port, mode),
            (Effect::PortDevice(name), Some(port)) => {
                self.sockets[port as usize].forced = Some(name);
                self.register(port, false);
            }
            _ => {}
        }
        Ok(written)
    }

    /// How often an attribute has notified those who poll it. Only `state` of tacho motors and
    /// `value0` of touch sensors ever do.
    ///
    /// # Errors
    /// ENODEV if its device is gone: then poll returns at once.
    pub fn event_count(&self, node: NodeId) -> Result<u32, Errno> {
        self.tree.events(node)
    }

    /// Opens, reads and closes: for tests and small tools.
    ///
    /// # Errors
    /// As [`Machine::open`] and [`Machine::read`].
    pub fn read_path(&mut self, path: &str) -> Result<String, Errno> {
        let node = self.open(path, Access::ReadOnly)?;
        self.read(node)
            .map(|text| String::from_utf8_lossy(&text).into_owned())
    }

    /// Opens, writes and closes: for tests and small tools.
    ///
    /// # Errors
    /// As [`Machine::open`] and [`Machine::write`].
    pub fn write_path(&mut self, path: &str, text: &str) -> Result<Written, Errno> {
        let node = self.open(path, Access::WriteOnly)?;
        Descriptor::new(node).write(self, text.as_bytes())
    }

    fn record(&mut self, action: Action, node: NodeId, bytes: &[u8]) {
        let Ok(path) = self.tree.path(node) else {
            return;
        };
        let text = String::from_utf8_lossy(bytes.strip_suffix(b"\n").unwrap_or(bytes)).into_owned();
        self.trace.event(Event {
            at: self.now,
            action,
            path,
            text,
        });
    }

    // ---- sensors --------------------------------------------------------------------------

    /// Lets a sensor look at the world, if its values are not fresh.
    fn look(&mut self, serial: u64) {
        let Some(Hardware::Sensor(sensor)) = self.tree.hardware(serial) else {
            return;
        };
        if !sensor.wants_reading() {
            return;
        }
        let reading = self.measure(sensor);
        if let Some(Hardware::Sensor(sensor)) = self.tree.hardware_mut(serial) {
            sensor.take(reading);
        }
    }

    pub(crate) fn measure(&self, sensor: &Sensor) -> Reading {
        let port = sensor.port();
        let (pose, noise) = self.mount(port);
        let sample = self.tick / JIFFY_TICKS;
        let mut view = View {
            scene: &self.scene,
            pose: self.body.pose.compose(&pose),
            angle: sensor.angle,
            rate: sensor.rate,
            noise: Source::new(noise, self.options.seed, port as usize, sample),
        };
        view.measure(sensor.mode().sense)
    }

    pub(crate) fn mount(&self, port: Port) -> (Pose, Noise) {
        let mount = self.robot.sensors.iter().find(|mount| mount.port == port);
        mount.map_or((SPARE_MOUNT, Noise::NONE), |mount| {
            (mount.pose, mount.noise)
        })
    }

    // ---- plugs ----------------------------------------------------------------------------

    /// Plugs a motor or sensor in, by its driver's name. A motor on the port of a wheel drives
    /// that wheel. The device gets a new number.
    ///
    /// # Errors
    /// If no such thing fits the port.
    pub fn plug(&mut self, port: Port, driver: &str) -> Result<(), SpecError> {
        let plug = Plug::named(driver, port).ok_or_else(|| {
            SpecError::new(
                format!("{driver} on {port}"),
                "is nothing that fits this port",
            )
        })?;
        if let Plug::Motor(kind) = plug {
            self.shafts[port.slot()].kind = kind;
        }
        self.change_plug(port, Some(plug));
        Ok(())
    }

    /// Pulls the wire out of a port; false if there was none. A wheel stays where it is and turns
    /// freely.
    pub fn unplug(&mut self, port: Port) -> bool {
        let was_there = self.sockets[port as usize].plug.is_some();
        if was_there {
            self.change_plug(port, None);
        }
        was_there
    }

    fn change_plug(&mut self, port: Port, plug: Option<Plug>) {
        let instant = self.options.instant;
        self.sockets[port as usize].change(plug, self.tick, instant);
        if instant {
            self.detect(port);
        }
    }

    /// The kernel notices what is plugged in now. Only the mode `auto` acts on it.
    pub(crate) fn detect(&mut self, port: Port) {
        let socket = &mut self.sockets[port as usize];
        socket.due = None;
        let detected = Plug::detected(socket.plug, port);
        let lego_port = socket.lego_port;
        if let Some(Hardware::Port(device)) = self.tree.hardware_mut(lego_port) {
            device.detected = detected;
            if device.mode_name() != "auto" {
                return;
            }
        }
        self.sockets[port as usize].forced = None;
        self.register(port, false);
    }

    /// A port's mode was written, maybe the same one: its device goes and, where the mode implies
    /// one, another comes, before the call returns.
    fn port_mode(&mut self, port: Port, mode: usize) -> Duration {
        let socket = &mut self.sockets[port as usize];
        socket.forced = None;
        socket.due = None;
        let lego_port = socket.lego_port;
        let mut blocks = Duration::ZERO;
        if let Some(Hardware::Port(device)) = self.tree.hardware_mut(lego_port) {
            device.mode = mode;
            if device.mode_name() == "nxt-i2c" {
                blocks = I2C_PROBE;
            }
        }
        self.register(port, false);
        blocks
    }

    /// Takes the device of a port away and registers the one that belongs there.
    fn register(&mut self, port: Port, at_boot: bool) {
        let socket = &mut self.sockets[port as usize];
        if let Some(serial) = socket.device.take() {
            self.tree.remove(serial);
        }
        let lego_port = socket.lego_port;
        let mode = match self.tree.hardware_mut(lego_port) {
            Some(Hardware::Port(device)) => {
                device.detected = Plug::detected(socket.plug, port);
                device.mode_name()
            }
            _ => "auto",
        };
        let plug = socket.driver(mode);
        let hardware = match (mode, plug) {
            ("dc-motor", _) => Some(Hardware::DcMotor(DcMotor::new(port, self.tick))),
            ("led", _) => Some(Hardware::Led(Led::on_port(port.address()))),
            (_, plug) => plug.map(|plug| self.driver(port, plug, at_boot)),
        };
        let instant = self.options.instant;
        let closed = if at_boot || instant {
            0
        } else {
            self.tick + ticks_from_ms(UDEV_MS)
        };
        let has_tacho = matches!(plug, Some(Plug::Motor(_))) || mode == "tacho-motor";
        let has_nxt_analog = mode == "nxt-analog"
            || matches!(plug, Some(Plug::Sensor(kind)) if kind.driver_name == "nxt-analog");
        self.sockets[port as usize].device =
            hardware.map(|hardware| self.tree.add(hardware, closed));
        if let Some(Hardware::Port(device)) = self.tree.hardware_mut(lego_port) {
            device.has_tacho = has_tacho;
            device.has_nxt_analog = has_nxt_analog;
        }
    }

    /// A fresh driver for a tacho motor or sensor.
    fn driver(&self, port: Port, plug: Plug, at_boot: bool) -> Hardware {
        match plug {
            Plug::Motor(kind) => {
                let count = self.shafts[port.slot()].encoder.count();
                Hardware::Tacho(Box::new(Tacho::new(kind, port, count, at_boot, self.tick)))
            }
            Plug::Sensor(kind) => {
                let instant = self.options.instant;
                Hardware::Sensor(Box::new(Sensor::new(
                    kind, port, self.tick, instant, at_boot,
                )))
            }
        }
    }

    /// Cuts the line to a serial sensor for a while: it stays registered, but has no values
    /// (ENXIO) and takes no mode (ENODEV) until it has introduced itself again. False if there is
    /// no such sensor.
    pub fn lose_contact(&mut self, port: Port, time: Duration) -> bool {
        let serial = self.sockets[port as usize].device;
        match serial.and_then(|serial| self.tree.hardware_mut(serial)) {
            Some(Hardware::Sensor(sensor)) => {
                sensor.lose_contact(
                    time.as_micros()
                        .div_ceil(TICK_US.into())
                        .try_into()
                        .unwrap_or(u64::MAX / 2),
                );
                true
            }
            _ => false,
        }
    }

    /// Holds the shaft of a motor fast, or lets it go.
    pub fn jam(&mut self, port: Port, fast: bool) {
        if port.is_output() {
            self.shafts[port.slot()].jammed = fast;
        }
    }

    // ---- the world ------------------------------------------------------------------------

    /// Where the robot really is. The heading is not reduced to a full turn.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.body.pose
    }

    /// Lifts the robot to another place, where it stands still. Its gyro does not notice.
    ///
    /// # Errors
    /// If something is in the way there.
    pub fn place(&mut self, pose: Pose) -> Result<(), SpecError> {
        if !pose.is_finite() {
            return Err(SpecError::new("robot", "has a number that is not finite"));
        }
        self.check_free(&pose)?;
        self.body.place(pose);
        for port in [self.robot.left.port, self.robot.right.port] {
            self.shafts[port.slot()].omega = 0.0;
        }
        Ok(())
    }

    fn check_free(&self, pose: &Pose) -> Result<(), SpecError> {
        let Some(id) = self.scene.overlap(self.robot.hull, pose) else {
            return Ok(());
        };
        let items = self.scene.items();
        let item = items.iter().find(|(other, _)| *other == id);
        let name = item.map_or_else(|| "bounds".to_owned(), |(_, item)| format!("{item:?}"));
        Err(SpecError::new(
            format!("robot at {}, {}", pose.x, pose.y),
            format!("is inside {name}"),
        ))
    }

    /// Everything in the world, with the numbers under which it can be removed.
    #[must_use]
    pub fn items(&self) -> &[(ItemId, Item)] {
        self.scene.items()
    }

    /// Puts something into the world.
    ///
    /// # Errors
    /// If the item is impossible, or the robot is where it should stand.
    pub fn add_item(&mut self, item: Item) -> Result<ItemId, SpecError> {
        let name = format!("{item:?}");
        let id = self.scene.add(item)?;
        if self.scene.overlap(self.robot.hull, &self.body.pose) == Some(id) {
            self.scene.remove(id);
            return Err(SpecError::new(name, "is where the robot stands"));
        }
        self.body.world_changed();
        Ok(id)
    }

    /// Takes something out of the world; false if there is no such item.
    pub fn remove_item(&mut self, id: ItemId) -> bool {
        self.body.world_changed();
        self.scene.remove(id)
    }

    /// The robot as it was given.
    #[must_use]
    pub fn robot(&self) -> &RobotSpec {
        &self.robot
    }

    /// What happened so far.
    #[must_use]
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    pub(crate) fn hit(&mut self, item: ItemId) {
        self.trace.collision(Collision {
            at: self.now,
            item,
            pose: self.body.pose,
        });
    }
}
