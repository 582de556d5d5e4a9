//! The whole: brick, robot and world, and their state.
//!
//! `files` has the accesses of a program, `plugs` connects and disconnects devices, `time` lets
//! time pass, `shown` says how everything is, `crowd` puts several into one world.

pub(crate) mod crowd;
pub(crate) mod descriptor;
pub(crate) mod dev;
mod facts;
mod files;
pub(crate) mod film;
mod grip;
mod panel;
mod plugs;
mod room;
mod samples;
pub(crate) mod shown;
mod socket;
mod svg;
mod things;
mod time;
pub(crate) mod tree;

use crate::brick::output::Output;
use crate::brick::panel::Panel;
use crate::brick::port::{LegoPort, Port};
use crate::brick::remote::{Remote, RemoteButton};
use crate::brick::screen::Depth;
use crate::brick::{Battery, Board, Framebuffer, LEDS, Led};
use crate::machine::film::Film;
use crate::machine::grip::Grip;
use crate::machine::room::Room;
use crate::machine::socket::{Plug, Socket};
use crate::machine::tree::{Hardware, Tree};
use crate::mechanics::Body;
use crate::mechanics::shaft::Shaft;
use crate::mechanics::thing::Thing;
use crate::noise::Teeth;
use crate::robot::{RobotSpec, Wheels};
use crate::sensor::Sensor;
use crate::ticks::TICK_US;
use crate::trace::{Collision, Trace};
use crate::world::obstacle::Obstacle;
use crate::world::scene::{Others, Scene};
use crate::world::{ItemId, Part, SpecError, WorldSpec};
use ev3_motion::{OUT_OF_RANGE, Pose};
use ev3_os::linux::Errno;
use std::sync::Arc;
use std::time::Duration;

/// What is wrong with what stands beyond the walls of the bounds.
const OUTSIDE: &str = "is outside of the world";

/// How faithful a run is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The seed of the noise.
    pub seed: u64,
    /// A plug that is moved is noticed at once, its files are open at once, and a sensor changes
    /// its mode at once and settled. Real bricks take their time: 0.4 s for a motor, 1.3 s for a
    /// serial sensor, 0.5 s more for write permission, some ms for a mode.
    pub instant: bool,
    /// How many bits the screen has for a pixel.
    pub depth: Depth,
    /// How many inferences the program makes in a second; 0 if they take no time.
    pub thinking: u64,
}

impl Default for Options {
    fn default() -> Self {
        Options { seed: 1, instant: false, depth: Depth::default(), thinking: 0 }
    }
}

/// The effect of a write that a driver did not refuse at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Written {
    /// Bytes taken, all of them; or the error with which the call ends.
    pub outcome: Result<usize, Errno>,
    /// The real call returns only after this time. There is no clock here to wait for, so an
    /// adapter that has one lets this time pass before it returns to its caller.
    pub blocks: Duration,
}

/// A brick with its robot in its world. `clone` is a snapshot: 20 kB, as it shares the world and
/// what has happened.
#[derive(Clone, Debug)]
pub struct Machine {
    options: Options,
    now: Duration,
    tick: u64,
    tree: Tree,
    sockets: Vec<Socket>,
    shafts: [Shaft; 4],
    battery: u64,
    robot: Arc<RobotSpec>,
    body: Body,
    scene: Arc<Scene>,
    /// The robots of this world as obstacles, if there are several, and which of them is this one.
    robots: Arc<Vec<Obstacle>>,
    number: usize,
    /// The things that robots push, those of all robots of this world, and how they are seen.
    things: Arc<Vec<Thing>>,
    thing_obstacles: Arc<Vec<Obstacle>>,
    room: Room,
    grips: Vec<Grip>,
    panel: Panel,
    /// The touch sensors that a hand holds down, by port.
    held: [bool; Port::ALL.len()],
    trace: Trace,
    /// A film of the run, if somebody wants it.
    film: Option<Film>,
}

impl Machine {
    /// A brick with nothing plugged in, in an empty world.
    pub(crate) fn bare() -> Result<Machine, SpecError> {
        let robot = RobotSpec {
            wheels: None,
            hull: crate::world::Hull::Circle { radius: 1.0 },
            mass: 1.0,
            motors: Vec::new(),
            sensors: Vec::new(),
            grippers: Vec::new(),
        };
        Machine::new(&WorldSpec::default(), &robot, Options::default())
    }

    /// Boots a brick with everything plugged in, standing at the start of the world. Errors: names
    /// what is impossible in the world or the robot, or that the start is inside something.
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
        tree.add(Hardware::Framebuffer(Framebuffer(options.depth)), 0);
        let socket = |(port, lego_port)| Socket {
            port,
            plug: None,
            noticed: None,
            due: None,
            device: None,
            servos: Vec::new(),
            lego_port,
            forced: None,
            output: Output::default(),
        };
        let shafts = std::array::from_fn(|slot| {
            let mount = robot.motors.iter().find(|mount| mount.port.slot() == slot);
            let sigma = mount.and_then(|mount| mount.encoder_noise).unwrap_or_default();
            let stops = mount.and_then(|mount| mount.stops);
            Shaft::new(Teeth::new(sigma, options.seed, slot), stops)
        });
        let mut machine = Machine {
            options,
            now: Duration::ZERO,
            tick: 0,
            tree,
            sockets: Port::ALL.into_iter().zip(lego_ports).map(socket).collect(),
            shafts,
            battery,
            robot: Arc::new(robot.clone()),
            body: Body::new(robot, world.start),
            scene: Arc::new(scene),
            robots: Arc::default(),
            number: 0,
            things: Arc::default(),
            thing_obstacles: Arc::default(),
            room: Room::ENDLESS,
            grips: vec![Grip::default(); robot.grippers.len()],
            panel: Panel::new(options.depth),
            held: Default::default(),
            trace: Trace::new(),
            film: None,
        };
        machine.check_free(&world.start)?;
        machine.take_things()?;
        for mount in &robot.motors {
            machine.sockets[mount.port as usize].plug = Plug::named(&mount.driver, mount.port);
        }
        for mount in &robot.sensors {
            machine.sockets[mount.port as usize].plug = Plug::named(&mount.driver, mount.port);
        }
        for port in Port::ALL {
            if let Some(Plug::Motor(kind)) = machine.sockets[port as usize].plug {
                machine.shafts[port.slot()].connect(kind);
            }
            machine.notice(port);
            machine.register(port, true);
        }
        machine.trace.tick(0, world.start);
        Ok(machine)
    }

    // ---- ground truth ---------------------------------------------------------------------

    /// The true pose of the robot. The heading is not reduced to a full turn.
    pub fn pose(&self) -> Pose {
        self.body.pose
    }

    /// Lifts the robot to another place, where it stands still. Its gyro does not notice.
    /// Errors: if something is in the way there, or the world ends before.
    pub fn place(&mut self, pose: Pose) -> Result<(), SpecError> {
        if !pose.is_in_range() {
            return Err(SpecError::new("robot", OUT_OF_RANGE));
        }
        self.check_free(&pose)?;
        self.body.place(pose);
        self.let_go(|_| true);
        self.look_for_room();
        for port in self.robot.wheels.iter().flat_map(Wheels::ports) {
            self.shafts[port.slot()].omega = 0.0;
        }
        self.hand_is_done();
        Ok(())
    }

    /// What a hand does takes its time: when it is done, the voltages have been sampled.
    fn hand_is_done(&mut self) {
        self.sample_where(|sensor| sensor.kind.link.is_analog());
    }

    fn sample_where(&mut self, is_meant: impl Fn(&Sensor) -> bool) {
        for index in 0..self.sockets.len() {
            let device = self.sockets[index].device;
            let serial = device.filter(|serial| match self.tree.hardware(*serial) {
                Some(Hardware::Sensor(sensor)) => is_meant(sensor),
                _ => false,
            });
            if let Some(serial) = serial {
                self.sample(serial);
            }
        }
    }

    /// True if no other robot is in its world.
    #[cfg(unix)]
    pub(crate) fn is_alone(&self) -> bool {
        self.robots.len() < 2
    }

    /// The other robots.
    fn others(&self) -> Others<'_> {
        let things = &self.thing_obstacles;
        match self.robots.split_at_checked(self.number) {
            Some((before, [_, after @ ..])) => Others { before, after, things },
            _ => Others { things, ..Others::default() },
        }
    }

    fn check_free(&self, pose: &Pose) -> Result<(), SpecError> {
        let robot = |is: String| SpecError::new(format!("robot at {}, {}", pose.x, pose.y), is);
        let mut robots = self.others().robots();
        if robots.any(|other| other.overlaps(self.robot.hull, pose)) {
            return Err(robot("is inside another robot".to_owned()).in_part(Part::Start));
        }
        if self.is_outside(pose) {
            let error = robot(OUTSIDE.to_owned());
            return Err(error.in_part(Part::Start).in_part(Part::Bounds));
        }
        let mut things = self.thing_obstacles.iter();
        let thing = things.find(|thing| thing.overlaps(self.robot.hull, pose));
        let fixed = self.scene.overlap(self.robot.hull, pose);
        if let Some(id) = fixed.or(thing.map(|thing| thing.id)) {
            let index = self.scene.items().iter().position(|(other, _)| *other == id);
            let part = index.map_or(Part::Bounds, Part::Item);
            let error = robot(format!("is inside {}", self.name_of(id)));
            return Err(error.in_part(Part::Start).in_part(part));
        }
        Ok(())
    }

    /// Whether a place is not between the walls of the world.
    fn is_outside(&self, pose: &Pose) -> bool {
        self.scene.bounds.is_some_and(|bounds| !bounds.contain([pose.x, pose.y]))
    }

    /// Holds down these buttons of a remote control on a channel from 1 to 4, and no others, until
    /// the next call. Wherever the robot is, its infrared sensors hear it.
    /// Errors: if there is no such channel, or these look like others: any single one is clear, and
    /// any two but the beacon's.
    pub fn hold_buttons(&mut self, channel: u8, buttons: &[RemoteButton]) -> Result<(), SpecError> {
        let item = || format!("remote control on channel {channel}");
        let index = usize::from(channel).wrapping_sub(1);
        let Some(remote) = Arc::make_mut(&mut self.scene).remotes.get_mut(index) else {
            return Err(SpecError::new(item(), "needs a channel from 1 to 4"));
        };
        let held = Remote::holding(buttons);
        *remote = held.ok_or_else(|| SpecError::new(item(), "has no such buttons at once"))?;
        Ok(())
    }

    /// The robot as it was given.
    pub fn robot(&self) -> &RobotSpec {
        &self.robot
    }

    /// Goes back to a snapshot. A device that is plugged in later gets a number that no device has
    /// had in the meantime, so that a program does not mistake it for a device that it still knows.
    pub fn restore(&mut self, snapshot: Machine) {
        let before = std::mem::replace(self, snapshot);
        self.tree.count_on_from(&before.tree);
    }

    /// The events so far.
    pub fn trace(&self) -> &Trace {
        &self.trace
    }

    fn hit(&mut self, item: ItemId) {
        self.trace.collision(Collision {
            at: Duration::from_micros(self.tick * TICK_US),
            item,
            pose: self.body.pose,
        });
    }
}
