//! A brick on a desk, in the words of a shell.
use crate::robots::default_robot;
use ev3_sim::{Bounds, Errno, Item, Machine, Options, Pose, RobotSpec, WorldSpec, Written};
use std::fmt::Display;
use std::time::Duration;

/// outA, outB (left), outC (right) of the default robot.
pub(crate) const A: &str = "tacho-motor/motor0/";
pub(crate) const B: &str = "tacho-motor/motor1/";
pub(crate) const C: &str = "tacho-motor/motor2/";

/// A room of 300 by 240 cm with two boxes and a pillar, for these tests only: worlds for programs
/// are files of facts. The robot starts in a free corner.
pub(crate) fn furnished() -> WorldSpec {
    let boxed = |x, y, heading, width, depth| Item::boxed(Pose::new(x, y, heading), width, depth);
    WorldSpec {
        items: vec![
            boxed(70.0, 155.0, 20.0, 40.0, 30.0),
            boxed(215.0, 80.0, -15.0, 30.0, 45.0),
            Item::circle([190.0, 185.0], 10.0),
        ],
        bounds: Some(Bounds { low: [0.0, 0.0], high: [300.0, 240.0] }),
        start: Pose::new(60.0, 50.0, 0.0),
        ..WorldSpec::default()
    }
}

pub(crate) struct Desk(pub(crate) Machine);

impl Desk {
    /// The default robot on an endless floor.
    pub(crate) fn new() -> Desk {
        Desk::with(&WorldSpec::default(), &default_robot())
    }

    pub(crate) fn with(world: &WorldSpec, robot: &RobotSpec) -> Desk {
        Desk(Machine::new(world, robot, Options::default()).unwrap())
    }

    pub(crate) fn try_get(&mut self, path: &str) -> Result<String, Errno> {
        self.0.read_path(path)
    }

    pub(crate) fn get(&mut self, path: &str) -> String {
        let text = self.try_get(path).unwrap_or_else(|error| panic!("read {path}: {error:?}"));
        assert!(text.ends_with('\n'), "{path} ends in a newline: {text:?}");
        text.trim_end_matches('\n').to_owned()
    }

    pub(crate) fn number(&mut self, path: &str) -> i32 {
        let text = self.get(path);
        text.parse().unwrap_or_else(|_| panic!("{path}: {text:?} is no number"))
    }

    /// Writes. A call that fails after some time is waited for.
    pub(crate) fn try_put(&mut self, path: &str, text: &str) -> Result<Duration, Errno> {
        let Written { outcome, blocks } = self.0.write_path(path, text)?;
        outcome.map(|_| blocks).inspect_err(|_| self.0.step(blocks))
    }

    /// Writes, and waits as long as the call blocks.
    pub(crate) fn put(&mut self, path: &str, text: impl Display) {
        let text = format!("{text}");
        match self.try_put(path, &text) {
            Ok(blocks) => self.0.step(blocks),
            Err(error) => panic!("write {text:?} to {path}: {error:?}"),
        }
    }

    pub(crate) fn step(&mut self, ms: u64) {
        self.0.step(Duration::from_millis(ms));
    }

    /// Sets and commands: `run(B, &[("speed_sp", 300)], "run-forever")`.
    pub(crate) fn run(&mut self, motor: &str, set: &[(&str, i32)], command: &str) {
        for (name, value) in set {
            self.put(&format!("{motor}{name}"), value);
        }
        self.put(&format!("{motor}command"), command);
    }

    pub(crate) fn state(&mut self, motor: &str) -> String {
        self.get(&format!("{motor}state"))
    }

    pub(crate) fn position(&mut self, motor: &str) -> i32 {
        self.number(&format!("{motor}position"))
    }

    pub(crate) fn speed(&mut self, motor: &str) -> i32 {
        self.number(&format!("{motor}speed"))
    }

    fn ms_since(&self, start: Duration) -> u64 {
        u64::try_from(self.0.now().saturating_sub(start).as_millis()).unwrap()
    }

    /// Steps 2 ms at a time until the state is this; answers how long it took.
    pub(crate) fn until(&mut self, motor: &str, state: &str, within_ms: u64) -> u64 {
        let start = self.0.now();
        while self.state(motor) != state {
            let passed = self.ms_since(start);
            assert!(passed < within_ms, "{:?} after {passed} ms, not {state:?}", self.state(motor));
            self.step(2);
        }
        self.ms_since(start)
    }
}
