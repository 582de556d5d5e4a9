//! The passage of time: ticks of 2 ms, each the same however a caller slices his steps.
use crate::brick::output::{Bridge, Output};
use crate::brick::port::Port;
use crate::machine::socket::Plug;
use crate::machine::tree::Hardware;
use crate::machine::{Machine, crowd};
use crate::mechanics::Load;
use crate::mechanics::pair::Rider;
use crate::mechanics::thing::Thing;
use crate::noise::Source;
use crate::robot::Wheels;
use crate::ticks::{JIFFY_TICKS, TICK_US};
use crate::world::ItemId;
use std::time::Duration;

const OUTPUTS: [Port; 4] = [Port::OutA, Port::OutB, Port::OutC, Port::OutD];
/// A clock that jumps is not asked to jump farther than this.
const FARTHEST_TICKS: u64 = 25;

impl Machine {
    /// How many inferences of the program take a second; 0 if they take no time.
    pub fn thinking(&self) -> u64 {
        self.options.thinking
    }

    /// Virtual time since boot.
    pub fn now(&self) -> Duration {
        self.now
    }

    /// Lets exactly this much time pass.
    pub fn step(&mut self, dt: Duration) {
        self.pass(dt);
        while self.is_behind() {
            if self.has_room() {
                self.advance();
            } else {
                crowd::advance(&mut [self]);
            }
        }
    }

    /// A time, after now, before which nothing happens that a waiting program could be woken by:
    /// the next look of the class at a motor's flags, the end of a sensor's mode change, a plug being
    /// noticed, the 10 ms sample of a touch sensor on a moving robot, a planned key. A virtual clock
    /// may jump there with `step(next_event() - now())` and look again.
    pub fn next_event(&self) -> Duration {
        let next_on_grid = |grid: u64| (self.tick / grid + 1) * grid;
        let mut next = next_on_grid(FARTHEST_TICKS);
        let moving = self.is_moving();
        for hardware in self.tree.all() {
            let due = match hardware {
                Hardware::Tacho(motor) => Some(motor.next_timer()),
                Hardware::DcMotor(motor) => motor.next_timer(),
                Hardware::Sensor(sensor) if sensor.kind.link.is_analog() && moving => {
                    Some(next_on_grid(JIFFY_TICKS))
                }
                Hardware::Sensor(sensor) => sensor.next_event(),
                _ => None,
            };
            next = next.min(due.unwrap_or(next).max(self.tick + 1));
        }
        next = next.min(self.panel.next_tick().unwrap_or(next).max(self.tick + 1));
        for due in self.sockets.iter().flat_map(|s| s.noticed.into_iter().chain(s.due)) {
            next = next.min(due.max(self.tick + 1));
        }
        Duration::from_micros(next * TICK_US)
    }

    /// One tick.
    fn advance(&mut self) {
        let start_us = self.begin_tick();
        if self.is_at_rest() {
            self.rest(start_us);
        } else {
            self.turn_shafts(start_us);
        }
        self.end_tick();
    }

    /// When the tick is over that passes now.
    pub(crate) fn next_tick(&self) -> Duration {
        Duration::from_micros((self.tick + 1) * TICK_US)
    }

    /// Whether another tick is over by now.
    pub(crate) fn is_behind(&self) -> bool {
        let micros = u64::from(self.now.subsec_micros());
        let now_us = self.now.as_secs().saturating_mul(1_000_000).saturating_add(micros);
        (self.tick + 1) * TICK_US <= now_us
    }

    /// Lets time pass, and does not step yet.
    pub(crate) fn pass(&mut self, dt: Duration) {
        self.now += dt;
    }

    pub(crate) fn begin_tick(&mut self) -> u64 {
        self.tick += 1;
        (self.tick - 1) * TICK_US
    }

    pub(crate) fn end_tick(&mut self) {
        self.run_drivers();
        for port in Port::ALL {
            self.look_at_plug(port, self.tick);
        }
        self.apply_planned_buttons();
        self.trace.tick(self.tick, self.body.pose);
        self.sample_at_tick();
    }

    /// True if a motor's wire is in its socket.
    fn wired(&self, port: Port) -> bool {
        matches!(self.sockets[port as usize].plug, Some(Plug::Motor(_)))
    }

    /// The bridge of an output port: with its driver, or left by the last one.
    fn output(&self, port: Port) -> Output {
        let socket = &self.sockets[port as usize];
        let hardware = socket.device.and_then(|serial| self.tree.hardware(serial));
        hardware.and_then(Hardware::output).unwrap_or(socket.output)
    }

    fn bridge(&self, port: Port) -> Bridge {
        if self.wired(port) { self.output(port).bridge() } else { Bridge::Float }
    }

    /// The share of the battery's voltage that each output port gives the bulbs that the world
    /// has there.
    pub(crate) fn power(&self) -> [f64; 4] {
        if !self.scene.has_bulbs() {
            return [0.0; 4];
        }
        OUTPUTS.map(|port| match self.output(port).bridge() {
            Bridge::Driven(duty) => f64::from(duty.abs()) / 100.0,
            Bridge::Float | Bridge::Short => 0.0,
        })
    }

    fn battery_volts(&self) -> f64 {
        match self.tree.hardware(self.battery) {
            Some(Hardware::Battery(battery)) => battery.volts,
            _ => 0.0,
        }
    }

    /// Loads on the four shafts, and the current that their motors draw.
    fn loads(&self) -> ([Load; 4], f64) {
        let volts = self.battery_volts();
        let mut amperes = 0.0;
        let loads = OUTPUTS.map(|port| {
            let mount = self.robot.motors.iter().find(|mount| mount.port == port);
            let noise = mount.and_then(|mount| mount.noise).unwrap_or_default();
            let sample = self.tick / JIFFY_TICKS;
            let mut source = Source::new(noise, self.options.seed, port as usize, sample);
            let strength = 1.0 + noise.bias / 100.0;
            let shaft = &self.shafts[port.slot()];
            let (load, drawn) = shaft.load(self.bridge(port), volts, strength, source.jitter());
            amperes += drawn;
            load
        });
        (loads, amperes)
    }

    /// Whether nothing moves, and no motor is driven.
    pub(crate) fn is_at_rest(&self) -> bool {
        let undriven =
            |port| matches!(self.bridge(port), Bridge::Float | Bridge::Short | Bridge::Driven(0));
        !self.robot_moves() && OUTPUTS.into_iter().all(undriven)
    }

    pub(crate) fn rest(&mut self, start_us: u64) {
        self.set_current(0.0);
        self.body.turn_rate = 0.0;
        for shaft in &mut self.shafts {
            shaft.rest(start_us);
        }
    }

    pub(crate) fn turn_shafts(&mut self, start_us: u64) {
        let loads = self.loaded();
        if let Some(wheels) = self.wheels() {
            self.turn_wheels(&loads, wheels);
        }
        self.turn_others(&loads, start_us);
    }

    fn wheels(&self) -> Option<[Port; 2]> {
        self.robot.wheels.map(|wheels| wheels.ports())
    }

    /// The loads on the four shafts, whose motors draw their current.
    pub(crate) fn loaded(&mut self) -> [Load; 4] {
        let (loads, amperes) = self.loads();
        self.set_current(amperes);
        loads
    }

    /// The shafts that drive no wheel, and what all have turned.
    pub(crate) fn turn_others(&mut self, loads: &[Load; 4], start_us: u64) {
        let wheels = self.wheels();
        for port in OUTPUTS {
            let wired = self.wired(port);
            let shaft = &mut self.shafts[port.slot()];
            if !wheels.is_some_and(|wheels| wheels.contains(&port)) {
                shaft.omega = loads[port.slot()].turn_free(shaft.omega);
            }
            shaft.turn(wired, start_us);
        }
    }

    fn turn_wheels(&mut self, loads: &[Load; 4], wheels: [Port; 2]) {
        let [left, right] = wheels.map(Port::slot);
        let mut omega = [self.shafts[left].omega, self.shafts[right].omega];
        let mut hits = Vec::new();
        let wheel_loads = [loads[left], loads[right]];
        let hit = |item| hits.push(item);
        self.body.advance(&mut omega, &wheel_loads, self.robot.hull, &self.scene, hit);
        self.wheels_turned(omega, hits);
    }

    /// The robot as one near another one.
    pub(crate) fn rider(&mut self, id: ItemId, loads: &[Load; 4]) -> Rider<'_> {
        let slots = self.wheels().map(|wheels| wheels.map(Port::slot));
        let omega = slots.map_or([0.0; 2], |slots| slots.map(|slot| self.shafts[slot].omega));
        let loads = slots.map_or([Load::default(); 2], |slots| slots.map(|slot| loads[slot]));
        let Machine { body, robot, scene, .. } = self;
        Rider { id, body, omega, loads, hull: robot.hull, scene, hits: Vec::new() }
    }

    /// The new speeds of the wheels' shafts, and what the robot has run into.
    pub(crate) fn wheels_turned(&mut self, omega: [f64; 2], hits: Vec<ItemId>) {
        for (port, omega) in self.wheels().into_iter().flatten().zip(omega) {
            self.shafts[port.slot()].omega = omega;
        }
        for item in hits {
            self.hit(item);
        }
    }

    fn set_current(&mut self, amperes: f64) {
        if let Some(Hardware::Battery(battery)) = self.tree.hardware_mut(self.battery) {
            battery.load(amperes);
        }
    }

    /// The kernel's share of a tick: motor loops, sensors' clocks, samples, notifications.
    fn run_drivers(&mut self) {
        let tick = self.tick;
        for port in OUTPUTS {
            let encoder = &self.shafts[port.slot()].encoder;
            let (count, speed) = (encoder.count(), encoder.speed());
            let device = self.sockets[port as usize].device;
            let hardware = device.and_then(|serial| self.tree.hardware_mut(serial));
            match hardware {
                Some(Hardware::Tacho(motor)) => motor.sample(tick, count, speed),
                Some(Hardware::DcMotor(motor)) => motor.sample(tick),
                _ => {}
            }
        }
        for index in 0..4 {
            let Some(serial) = self.sockets[index].device else {
                continue;
            };
            let noise = self.mount(self.sockets[index].port).1;
            let (rate, axle_rate) = (self.body.turn_rate, self.axle_rate());
            let Some(Hardware::Sensor(sensor)) = self.tree.hardware_mut(serial) else {
                continue;
            };
            // Only a gyro knows a rate; its bias is drift.
            let drift = if sensor.kind.is_gyro() { noise.bias } else { 0.0 };
            sensor.tick(tick, rate + drift, axle_rate);
            if sensor.samples_now() {
                self.sample(serial);
            }
        }
    }

    /// How fast the left wheel's axle turns, in degrees per second, positive where it drives ahead;
    /// 0 without wheels.
    fn axle_rate(&self) -> f64 {
        let Some(Wheels { left: wheel, .. }) = self.robot.wheels else {
            return 0.0;
        };
        let rate = self.shafts[wheel.port.slot()].omega.to_degrees();
        if wheel.inverted { -rate } else { rate }
    }

    pub(super) fn sample(&mut self, serial: u64) {
        let Some(Hardware::Sensor(sensor)) = self.tree.hardware(serial) else {
            return;
        };
        let reading = self.measure(sensor);
        if let Some(Hardware::Sensor(sensor)) = self.tree.hardware_mut(serial) {
            sensor.take(reading);
        }
    }

    // ---- ground truth ---------------------------------------------------------------------

    /// The angle that a motor's shaft has turned since boot, in degrees.
    pub fn shaft_angle(&self, port: Port) -> f64 {
        if port.is_output() { self.shafts[port.slot()].angle } else { 0.0 }
    }

    /// Energy of motion of robot, motors, and the things in its world, in joules.
    pub fn kinetic_energy(&self) -> f64 {
        let (loads, _) = self.loads();
        let wheels = self.robot.wheels.map(|wheels| wheels.ports().map(Port::slot));
        let driving = wheels.map_or(0.0, |[left, right]| {
            let omega = [self.shafts[left].omega, self.shafts[right].omega];
            self.body.energy(omega, &[loads[left], loads[right]])
        });
        let free = (0..4).filter(|slot| !wheels.is_some_and(|wheels| wheels.contains(slot)));
        let pushed: f64 = self.things.iter().map(Thing::energy).sum();
        driving
            + pushed
            + free
                .map(|slot| loads[slot].inertia * self.shafts[slot].omega.powi(2) / 2.0)
                .sum::<f64>()
    }
}
