//! A kernel in the small: motors, sensors and a robot's heading behind
//! attribute files that are nowhere but in memory.
//!
//! Its clock stands still but for [`Sysfs::pause`] and a little for each read and write, so that
//! what takes seconds on a robot takes none here, and is the same each time. What a test wants to
//! go wrong is a public field, set before or, by [`Brick::at`], at a certain time.
use ev3_driver::error::Access;
use ev3_driver::sysfs::{AttributeFile, Entry, Repeated};
use ev3_driver::{Device, Errno, Registry, Sysfs};
use std::collections::VecDeque;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// Time that a read or a write takes.
const ACCESS_TIME: Duration = Duration::from_micros(40);

/// Step of the simulation.
const STEP: Duration = Duration::from_millis(1);

/// How often the kernel looks whether a motor's state has changed.
const NOTICE: Duration = Duration::from_millis(50);

/// Far more accesses than any test needs without letting time pass by itself.
const TOO_MANY: usize = 2_000_000;

pub(crate) const fn ms(milliseconds: u64) -> Duration {
    Duration::from_millis(milliseconds)
}

pub(crate) fn errno<T>(errno: Errno) -> io::Result<T> {
    Err(errno.into())
}

/// The tree.
pub(crate) struct Brick(Arc<Mutex<World>>, Mutex<Vec<Periodic>>);

/// An act that is repeated, and when it is due.
struct Periodic {
    at: Duration,
    act: Repeated,
}

/// What is behind the tree.
#[derive(Default)]
pub(crate) struct World {
    now: Duration,
    stepped: Duration,
    pub(crate) motors: Vec<Motor>,
    pub(crate) sensors: Vec<Sensor>,
    /// Whether changes of state wake up who waits for them.
    pub(crate) notifies: bool,
    /// Whether descriptors are always ready, as those of unplugged devices.
    pub(crate) always_ready: bool,
    /// Degrees of the wheels for a degree of the robot, whose wheels are the first two motors.
    pub(crate) gearing: f64,
    /// The robot's heading, clockwise.
    pub(crate) heading: f64,
    headings: VecDeque<f64>,
    inodes: u64,
    events: Vec<(Duration, Event)>,
    written: Vec<String>,
    accesses: usize,
    pauses: usize,
}

type Event = Box<dyn FnOnce(&mut World) + Send>;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Doing {
    Nothing { brakes: bool },
    Holding(i64),
    Running { speed: i64, until: Option<Duration> },
    Moving { speed: i64, target: i64 },
}

#[expect(clippy::struct_excessive_bools, reason = "switches of one thing each")]
/// A motor, with the state machine of the kernel's `tacho_motor_class.c`.
pub(crate) struct Motor {
    pub(crate) name: String,
    pub(crate) address: String,
    pub(crate) inode: u64,
    pub(crate) is_unplugged: bool,
    pub(crate) position: f64,
    pub(crate) speed: f64,
    pub(crate) speed_sp: i64,
    pub(crate) position_sp: i64,
    pub(crate) time_sp: i64,
    pub(crate) ramp_up_sp: i64,
    pub(crate) ramp_down_sp: i64,
    pub(crate) duty_cycle_sp: i64,
    pub(crate) stop_action: String,
    doing: Doing,
    /// What the last command was, if it was a relative move: where to.
    relative_target: Option<i64>,
    since_command: Duration,
    since_moving: Duration,
    states: Vec<(Duration, String)>,
    announced: String,

    pub(crate) max_speed: i64,
    pub(crate) count_per_rot: i64,
    pub(crate) stop_actions: &'static [&'static str],
    /// How long the speed takes to follow.
    pub(crate) lag: Duration,
    /// The delay of `state`.
    pub(crate) state_lag: Duration,
    /// Whether the wheel is held fast.
    pub(crate) is_blocked: bool,
    /// How long the wheel sticks at each start.
    pub(crate) sticks_for: Duration,
    /// How long the wheel stands until `stalled` shows; never where `None`.
    pub(crate) stalls_after: Option<Duration>,
    /// Whether `running` stays while holding.
    pub(crate) runs_while_holding: bool,
    /// Whether there is a `speed` to read.
    pub(crate) tells_speed: bool,
    /// How far short of its target a move ends.
    pub(crate) ends_short: i64,
    /// Whether the base of a relative move is always the present position.
    pub(crate) is_jessie: bool,
    /// Attributes that refuse to be written.
    pub(crate) refuses: Vec<(&'static str, Errno)>,
    /// Until when udev has not opened the files to us.
    pub(crate) closed_until: Duration,
}

impl Motor {
    fn new(port: &str) -> Self {
        Self {
            name: String::new(),
            address: format!("ev3-ports:{port}"),
            inode: 0,
            is_unplugged: false,
            position: 0.0,
            speed: 0.0,
            speed_sp: 0,
            position_sp: 0,
            time_sp: 0,
            ramp_up_sp: 0,
            ramp_down_sp: 0,
            duty_cycle_sp: 0,
            stop_action: "coast".to_owned(),
            doing: Doing::Nothing { brakes: false },
            relative_target: None,
            since_command: Duration::ZERO,
            since_moving: Duration::ZERO,
            states: Vec::new(),
            announced: String::new(),
            max_speed: 1050,
            count_per_rot: 360,
            stop_actions: &["coast", "brake", "hold"],
            lag: ms(30),
            state_lag: Duration::ZERO,
            is_blocked: false,
            sticks_for: Duration::ZERO,
            stalls_after: Some(ms(100)),
            runs_while_holding: false,
            tells_speed: true,
            ends_short: 0,
            is_jessie: false,
            refuses: Vec::new(),
            closed_until: Duration::ZERO,
        }
    }

    #[expect(clippy::cast_possible_truncation, reason = "positions are small")]
    pub(crate) fn counts(&self) -> i64 {
        self.position as i64
    }

    pub(crate) fn is_powered(&self) -> bool {
        !matches!(self.doing, Doing::Nothing { .. })
    }

    pub(crate) fn is_braking(&self) -> bool {
        self.doing == Doing::Nothing { brakes: true }
    }

    #[expect(clippy::cast_precision_loss, reason = "speeds and positions are small")]
    fn step(&mut self, now: Duration) {
        let wanted = match self.doing {
            Doing::Nothing { .. } => 0.0,
            Doing::Holding(at) => {
                let limit = self.max_speed as f64;
                ((at as f64 - self.position) * 20.0).clamp(-limit, limit)
            }
            Doing::Running { speed, .. } | Doing::Moving { speed, .. } => speed as f64,
        };
        let stands = self.is_blocked || self.is_powered() && self.since_command < self.sticks_for;
        let rolls_out = self.doing == Doing::Nothing { brakes: false };
        let lag = self.lag.as_secs_f64() * if rolls_out { 5.0 } else { 1.0 };
        let dt = STEP.as_secs_f64();
        self.speed =
            if stands { 0.0 } else { self.speed + (wanted - self.speed) * (dt / lag).min(1.0) };
        if wanted == 0.0 && self.speed.abs() < 3.0 {
            self.speed = 0.0;
        }
        self.position += self.speed * dt;
        self.since_command += STEP;
        self.since_moving += STEP;
        if self.speed.abs() >= 1.0 {
            self.since_moving = Duration::ZERO;
        }
        match self.doing {
            Doing::Running { until: Some(until), .. } if now >= until => self.end(self.counts()),
            Doing::Moving { speed, target } => {
                let left = (target - self.counts()) * speed.signum();
                if left <= self.ends_short {
                    self.end(target);
                }
            }
            _ => {}
        }
        self.tell(now);
    }

    /// Somebody else stops it.
    pub(crate) fn be_stopped(&mut self) {
        self.end(self.counts());
    }

    fn end(&mut self, at: i64) {
        self.doing = match self.stop_action.as_str() {
            "hold" => Doing::Holding(at),
            action => Doing::Nothing { brakes: action == "brake" },
        };
    }

    fn state(&self) -> String {
        let running = matches!(self.doing, Doing::Running { .. } | Doing::Moving { .. });
        let holding = matches!(self.doing, Doing::Holding(_));
        let standing = self.since_moving.min(self.since_command);
        let stalled = running && self.stalls_after.is_some_and(|after| standing > after);
        let flags = [
            (running || holding && self.runs_while_holding, "running"),
            (holding, "holding"),
            (stalled, "stalled"),
        ];
        let words: Vec<_> = flags.iter().filter(|flag| flag.0).map(|flag| flag.1).collect();
        words.join(" ")
    }

    fn tell(&mut self, now: Duration) {
        let state = self.state();
        if self.states.last().is_none_or(|(_, last)| *last != state) {
            self.states.push((now, state));
        }
    }

    fn told(&self, now: Duration) -> &str {
        let told = self.states.iter().rev().find(|(since, _)| *since + self.state_lag <= now);
        told.map_or("", |(_, state)| state)
    }

    fn read(&self, attribute: &str, now: Duration) -> io::Result<String> {
        #[expect(clippy::cast_possible_truncation, reason = "speeds are small")]
        let speed = self.speed as i64;
        Ok(match attribute {
            "address" => self.address.clone(),
            "driver_name" => "lego-ev3-l-motor".to_owned(),
            "state" => self.told(now).to_owned(),
            "stop_action" => self.stop_action.clone(),
            "stop_actions" => self.stop_actions.join(" "),
            "position" => self.counts().to_string(),
            "speed" if self.tells_speed => speed.to_string(),
            "speed" => return errno(Errno::OPNOTSUPP),
            "max_speed" => self.max_speed.to_string(),
            "count_per_rot" => self.count_per_rot.to_string(),
            "speed_sp" => self.speed_sp.to_string(),
            "position_sp" => self.position_sp.to_string(),
            "time_sp" => self.time_sp.to_string(),
            "ramp_up_sp" => self.ramp_up_sp.to_string(),
            "ramp_down_sp" => self.ramp_down_sp.to_string(),
            _ => return errno(Errno::NOENT),
        })
    }

    #[expect(clippy::cast_precision_loss, reason = "positions are small")]
    fn write(&mut self, attribute: &str, text: &str, now: Duration) -> io::Result<()> {
        if let Some((_, refusal)) = self.refuses.iter().find(|refused| refused.0 == attribute) {
            return errno(*refusal);
        }
        let number = || text.parse::<i32>().map(i64::from).map_err(|_| Errno::INVAL);
        match attribute {
            "command" => return self.command(text, now),
            "stop_action" if self.stop_actions.contains(&text) => {
                text.clone_into(&mut self.stop_action);
            }
            "position" => self.position = number()? as f64,
            "speed_sp" if number()?.abs() <= self.max_speed => self.speed_sp = number()?,
            "position_sp" => self.position_sp = number()?,
            "duty_cycle_sp" if number()?.abs() <= 100 => self.duty_cycle_sp = number()?,
            "time_sp" if number()? >= 0 => self.time_sp = number()?,
            "ramp_up_sp" if (0..=60_000).contains(&number()?) => self.ramp_up_sp = number()?,
            "ramp_down_sp" if (0..=60_000).contains(&number()?) => self.ramp_down_sp = number()?,
            _ => return errno(Errno::INVAL),
        }
        Ok(())
    }

    fn command(&mut self, word: &str, now: Duration) -> io::Result<()> {
        let before = self.relative_target.take();
        let from = self.counts();
        let towards = |target: i64| Doing::Moving {
            speed: self.speed_sp.abs() * if target < from { -1 } else { 1 },
            target,
        };
        match word {
            "run-forever" => self.doing = Doing::Running { speed: self.speed_sp, until: None },
            "run-direct" => {
                let speed = self.duty_cycle_sp * self.max_speed / 100;
                self.doing = Doing::Running { speed, until: None };
            }
            "run-timed" => {
                let until = now + Duration::from_millis(self.time_sp.unsigned_abs());
                self.doing = Doing::Running { speed: self.speed_sp, until: Some(until) };
            }
            "run-to-abs-pos" => self.doing = towards(self.position_sp),
            "run-to-rel-pos" => {
                let base = before.filter(|_| !self.is_jessie).unwrap_or(from);
                self.doing = towards(base + self.position_sp);
                self.relative_target = Some(base + self.position_sp);
            }
            "stop" => self.end(from),
            "reset" => {
                "coast".clone_into(&mut self.stop_action);
                (self.speed_sp, self.position_sp, self.time_sp) = (0, 0, 0);
                (self.ramp_up_sp, self.ramp_down_sp, self.position) = (0, 0, 0.0);
                self.end(0);
            }
            _ => return errno(Errno::INVAL),
        }
        self.since_command = Duration::ZERO;
        self.tell(now);
        Ok(())
    }
}

/// A mode of a sensor: name, values, decimals.
pub(crate) type Mode = (&'static str, Vec<i64>, i64);

/// A sensor, as `ev3_uart_sensor_ld.c` makes it look.
pub(crate) struct Sensor {
    pub(crate) name: String,
    pub(crate) address: String,
    pub(crate) inode: u64,
    pub(crate) is_unplugged: bool,
    pub(crate) driver: &'static str,
    pub(crate) modes: Vec<Mode>,
    pub(crate) mode: usize,
    /// When the mode was last written.
    changed: Option<Duration>,
    /// What the values are while they settle.
    stale: Vec<i64>,
    /// How long values take to settle.
    pub(crate) settling: Duration,
    /// How long the write of a mode takes.
    pub(crate) mode_latency: Duration,
    /// Until when the sensor introduces itself again.
    pub(crate) out_of_contact_until: Duration,
    /// What is answered to the write of a mode in the meantime.
    pub(crate) refuses_mode_with: Errno,
    /// Until when udev has not opened the files to us.
    pub(crate) closed_until: Duration,
    /// A gyro shows the robot's heading, so late, times this.
    pub(crate) gyro: Option<f64>,
    pub(crate) gyro_lag: Duration,
    /// What the gyro shows for a heading of 0.
    pub(crate) gyro_zero: f64,
    /// The registers of a sensor on the I2C bus.
    pub(crate) registers: Vec<u8>,
    /// What the bus answers, and until when.
    pub(crate) bus_error: Option<(Errno, Duration)>,
    /// The format of the raw data, if there is a file of them: `u8`, or `s16_be`.
    pub(crate) raw_format: Option<&'static str>,
    frozen: Option<i64>,
}

impl Sensor {
    fn new(port: &str, driver: &'static str, modes: Vec<Mode>) -> Self {
        Self {
            name: String::new(),
            address: format!("ev3-ports:{port}"),
            inode: 0,
            is_unplugged: false,
            driver,
            stale: modes.first().map(|mode| mode.1.clone()).unwrap_or_default(),
            modes,
            mode: 0,
            changed: None,
            settling: ms(10),
            mode_latency: ms(3),
            out_of_contact_until: Duration::ZERO,
            refuses_mode_with: Errno::NODEV,
            closed_until: Duration::ZERO,
            gyro: None,
            gyro_lag: Duration::ZERO,
            gyro_zero: 0.0,
            registers: Vec::new(),
            bus_error: None,
            raw_format: None,
            frozen: None,
        }
    }

    fn value(&self, index: usize, now: Duration, headings: &VecDeque<f64>) -> io::Result<i64> {
        let (_, values, _) = &self.modes[self.mode];
        let Some(value) = values.get(index) else { return errno(Errno::NXIO) };
        if let Some(frozen) = self.frozen {
            return Ok(frozen);
        }
        if self.changed.is_some_and(|changed| now < changed + self.settling) {
            return Ok(self.stale.get(index).copied().unwrap_or(-999));
        }
        let Some(factor) = self.gyro else { return Ok(*value) };
        let steps = usize::try_from(self.gyro_lag.as_millis()).unwrap();
        let heading = headings.iter().rev().nth(steps).or(headings.front()).unwrap_or(&0.0);
        #[expect(clippy::cast_possible_truncation, reason = "headings are small")]
        Ok((self.gyro_zero + heading * factor).floor().clamp(-32_768.0, 32_767.0) as i64)
    }

    /// All values as they lie in `bin_data`, though the line is down.
    fn raw(&self, now: Duration, headings: &VecDeque<f64>) -> io::Result<Vec<u8>> {
        let count = self.modes[self.mode].1.len();
        let mut bytes = Vec::new();
        for index in 0..count {
            let value = i16::try_from(self.value(index, now, headings)?).unwrap();
            match self.raw_format {
                Some("s16_be") => bytes.extend(value.to_be_bytes()),
                Some(_) => bytes.push(value.to_le_bytes()[0]),
                None => return errno(Errno::NOENT),
            }
        }
        bytes.resize(32, 0);
        Ok(bytes)
    }

    /// What the bus has at a place in `direct`: an end, an error, or n registers.
    fn on_bus(&mut self, offset: u8, count: usize, now: Duration) -> io::Result<&mut [u8]> {
        match self.bus_error {
            _ if self.is_unplugged => errno(Errno::NODEV),
            Some((error, until)) if now < until => errno(error),
            _ => {
                let end = self.registers.len().min(usize::from(offset) + count);
                Ok(self.registers.get_mut(offset.into()..end).unwrap_or_default())
            }
        }
    }

    fn read(&self, attribute: &str, now: Duration, headings: &VecDeque<f64>) -> io::Result<String> {
        let (mode, values, decimals) = &self.modes[self.mode];
        let is_lost = now < self.out_of_contact_until;
        let names: Vec<_> = self.modes.iter().map(|mode| mode.0).collect();
        Ok(match attribute {
            "address" => self.address.clone(),
            "driver_name" => self.driver.to_owned(),
            "mode" | "units" if is_lost => String::new(),
            "num_values" | "decimals" if is_lost => "0".to_owned(),
            "modes" if is_lost => return errno(Errno::NXIO),
            "mode" => (*mode).to_owned(),
            "modes" => names.join(" "),
            "num_values" => values.len().to_string(),
            "decimals" => decimals.to_string(),
            "direct" if !self.registers.is_empty() => String::new(),
            "bin_data_format" | "bin_data" if self.raw_format.is_some() => {
                self.raw_format.unwrap().to_owned()
            }
            _ => match attribute.strip_prefix("value").map(str::parse) {
                Some(Ok(0..8)) if is_lost => return errno(Errno::NXIO),
                Some(Ok(index @ 0..8)) => self.value(index, now, headings)?.to_string(),
                _ => return errno(Errno::NOENT),
            },
        })
    }

    fn write(&mut self, attribute: &str, text: &str, now: Duration) -> io::Result<()> {
        if attribute != "mode" {
            return errno(Errno::INVAL);
        }
        if now < self.out_of_contact_until {
            return errno(self.refuses_mode_with);
        }
        let Some(mode) = self.modes.iter().position(|mode| mode.0 == text) else {
            return errno(Errno::INVAL);
        };
        self.stale.clone_from(&self.modes[self.mode].1);
        self.mode = mode;
        self.changed = Some(now);
        Ok(())
    }
}

impl World {
    pub(crate) fn motor(&mut self, port: &str) -> &mut Motor {
        let is_it = |motor: &&mut Motor| motor.address.ends_with(port) && !motor.is_unplugged;
        self.motors.iter_mut().find(is_it).unwrap()
    }

    pub(crate) fn sensor(&mut self, port: &str) -> &mut Sensor {
        let is_it = |sensor: &&mut Sensor| sensor.address.ends_with(port) && !sensor.is_unplugged;
        self.sensors.iter_mut().find(is_it).unwrap()
    }

    pub(crate) fn plug_motor(&mut self, port: &str) -> &mut Motor {
        self.inodes += 1;
        let name = format!("motor{}", self.motors.len());
        self.motors.push(Motor { name, inode: self.inodes, ..Motor::new(port) });
        self.motors.last_mut().unwrap()
    }

    pub(crate) fn plug_sensor(
        &mut self,
        port: &str,
        driver: &'static str,
        modes: &[(&'static str, &[i64], i64)],
    ) -> &mut Sensor {
        self.inodes += 1;
        let name = format!("sensor{}", self.sensors.len());
        let modes = modes.iter().map(|mode| (mode.0, mode.1.to_vec(), mode.2)).collect();
        let sensor = Sensor { name, inode: self.inodes, ..Sensor::new(port, driver, modes) };
        self.sensors.push(sensor);
        self.sensors.last_mut().unwrap()
    }

    /// Freezes the gyro at what it shows now.
    pub(crate) fn freeze_gyro(&mut self) {
        let (now, headings) = (self.now, std::mem::take(&mut self.headings));
        let gyro = self.sensors.iter_mut().find(|sensor| sensor.gyro.is_some()).unwrap();
        gyro.frozen = Some(gyro.value(0, now, &headings).unwrap());
        self.headings = headings;
    }

    /// Lets time pass; `true` if a motor's change of state was announced then.
    fn advance(&mut self, time: Duration, until_notice: bool) -> bool {
        let end = self.now + time;
        while self.stepped + STEP <= end {
            self.stepped += STEP;
            self.now = self.now.max(self.stepped);
            if self.step() && until_notice {
                return true;
            }
        }
        self.now = self.now.max(end);
        false
    }

    fn step(&mut self) -> bool {
        let now = self.stepped;
        while let Some(due) = self.events.iter().position(|(time, _)| *time <= now) {
            let (_, event) = self.events.swap_remove(due);
            event(self);
        }
        let mut noticed = false;
        let is_tick = now.as_millis() % NOTICE.as_millis() == 0;
        for motor in &mut self.motors {
            motor.step(now);
            if is_tick && self.notifies && motor.announced != motor.told(now) {
                motor.announced = motor.told(now).to_owned();
                noticed = true;
            }
        }
        if let [left, right, ..] = &self.motors[..] {
            let degrees = |motor: &Motor| {
                #[expect(clippy::cast_precision_loss, reason = "counts are few")]
                let per_rot = motor.count_per_rot as f64;
                motor.speed * 360.0 / per_rot
            };
            let rate = (degrees(left) - degrees(right)) / 2.0 / self.gearing;
            self.heading += rate * STEP.as_secs_f64();
        }
        self.headings.push_back(self.heading);
        if self.headings.len() > 500 {
            self.headings.pop_front();
        }
        noticed
    }

    fn count(&mut self) {
        self.accesses += 1;
        assert!(self.accesses < TOO_MANY, "somebody spins");
        self.advance(ACCESS_TIME, false);
    }
}

impl Brick {
    /// A brick with these motors.
    pub(crate) fn new(motors: &[&str]) -> Arc<Self> {
        let mut world = World { notifies: true, gearing: 1.0, ..World::default() };
        for port in motors {
            world.plug_motor(port);
        }
        Arc::new(Self(Arc::new(Mutex::new(world)), Mutex::default()))
    }

    /// A brick, and its devices.
    pub(crate) fn with_devices(motors: &[&str]) -> (Arc<Self>, Arc<Registry>) {
        let brick = Self::new(motors);
        let devices = brick.devices();
        (brick, devices)
    }

    pub(crate) fn devices(self: &Arc<Self>) -> Arc<Registry> {
        Arc::new(Registry::new(Arc::<Self>::clone(self)))
    }

    pub(crate) fn world(&self) -> MutexGuard<'_, World> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Makes something happen at a time.
    pub(crate) fn at(&self, time: Duration, event: impl FnOnce(&mut World) + Send + 'static) {
        self.world().events.push((time, Box::new(event)));
    }

    /// The brick's time.
    pub(crate) fn now(&self) -> Duration {
        self.world().now
    }

    /// The time that has passed since.
    pub(crate) fn since(&self, then: Duration) -> Duration {
        self.now().checked_sub(then).unwrap()
    }

    /// Lets time pass, and does what is due meanwhile.
    pub(crate) fn pass(&self, time: Duration) {
        let end = self.now() + time;
        while let Some(Periodic { at, mut act }) = self.due(end) {
            let left = at.saturating_sub(self.now());
            self.world().advance(left, false);
            if let Some(period) = act() {
                self.periodic().push(Periodic { at: at + period, act });
            }
        }
        let left = end.saturating_sub(self.now());
        self.world().advance(left, false);
    }

    fn due(&self, end: Duration) -> Option<Periodic> {
        let mut periodic = self.periodic();
        let (index, next) = periodic.iter().enumerate().min_by_key(|(_, next)| next.at)?;
        (next.at <= end).then_some(index).map(|index| periodic.swap_remove(index))
    }

    fn periodic(&self) -> MutexGuard<'_, Vec<Periodic>> {
        self.1.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// What was written so far, and not asked for yet: `outA speed_sp 500`.
    pub(crate) fn take_written(&self) -> Vec<String> {
        std::mem::take(&mut self.world().written)
    }

    pub(crate) fn pauses(&self) -> usize {
        self.world().pauses
    }

    /// Never interrupts, and sees to it that it is asked every 20 ms at least.
    pub(crate) fn attentive(self: &Arc<Self>) -> impl FnMut() -> bool + use<> {
        self.interrupting(Duration::MAX)
    }

    /// Interrupts once that much time has passed, and sees to it that it is
    /// asked every 20 ms at least.
    pub(crate) fn interrupting(self: &Arc<Self>, after: Duration) -> impl FnMut() -> bool + use<> {
        let brick = Arc::clone(self);
        let started = self.now();
        let mut asked = started;
        move || {
            let now = brick.now();
            // A mode's write may take some time in the kernel, and so may the
            // few reads between two pauses.
            assert!(brick.since(asked) <= ms(24), "asked after {:?}", brick.since(asked));
            asked = now;
            brick.since(started) >= after
        }
    }
}

impl Sysfs for Brick {
    fn root(&self) -> &Path {
        Path::new("/brick")
    }

    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        let mut world = self.world();
        world.count();
        let entry = |name: &String, inode| Entry { name: name.clone(), inode };
        Ok(match directory.strip_prefix("/brick").unwrap().to_str().unwrap() {
            "tacho-motor" => {
                let present = world.motors.iter().filter(|motor| !motor.is_unplugged);
                present.map(|motor| entry(&motor.name, motor.inode)).collect()
            }
            "lego-sensor" => {
                let present = world.sensors.iter().filter(|sensor| !sensor.is_unplugged);
                present.map(|sensor| entry(&sensor.name, sensor.inode)).collect()
            }
            _ => return errno(Errno::NOENT),
        })
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        let mut world = self.world();
        world.count();
        let parts: Vec<_> = path.strip_prefix("/brick").unwrap().iter().collect();
        let [class, name, attribute] = parts[..] else { return errno(Errno::NOENT) };
        let is_motor = class == "tacho-motor";
        let now = world.now;
        let (inode, closed_until) = if is_motor {
            let is_it = |motor: &&Motor| motor.name.as_str() == name && !motor.is_unplugged;
            world.motors.iter().find(is_it).map(|motor| (motor.inode, motor.closed_until))
        } else {
            let is_it = |sensor: &&Sensor| sensor.name.as_str() == name && !sensor.is_unplugged;
            world.sensors.iter().find(is_it).map(|sensor| (sensor.inode, sensor.closed_until))
        }
        .ok_or(Errno::NOENT)?;
        let attribute = attribute.to_str().unwrap().to_owned();
        if access == Access::Write && now < closed_until
            || access == Access::Read && attribute == "command"
            || access == Access::Write && attribute == "state"
        {
            return errno(Errno::ACCESS);
        }
        let node = BrickNode { world: Arc::clone(&self.0), is_motor, inode, attribute };
        if access == Access::Read {
            match node.text(&world) {
                Err(error) if Errno::from_io_error(&error) == Some(Errno::NOENT) => {
                    return Err(error);
                }
                _ => {}
            }
        }
        Ok(Box::new(node))
    }

    fn matching(&self, _pattern: &str) -> ev3_driver::Result<Vec<PathBuf>> {
        Ok(Vec::new())
    }

    fn now(&self) -> Duration {
        Self::now(self)
    }

    fn pause(&self, nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        let mut world = self.world();
        let timeout = end.saturating_sub(world.now);
        world.pauses += 1;
        if nodes.is_empty() {
            drop(world);
            self.pass(timeout);
        } else if !world.always_ready {
            world.advance(timeout, true);
        }
        Ok(true)
    }

    fn every(&self, period: Duration, act: Repeated) -> io::Result<()> {
        let at = self.now() + period;
        self.periodic().push(Periodic { at, act });
        Ok(())
    }
}

struct BrickNode {
    world: Arc<Mutex<World>>,
    is_motor: bool,
    inode: u64,
    attribute: String,
}

impl BrickNode {
    fn text(&self, world: &World) -> io::Result<String> {
        if self.is_motor {
            let motor = world.motors.iter().find(|motor| motor.inode == self.inode).unwrap();
            if motor.is_unplugged {
                return errno(Errno::NODEV);
            }
            motor.read(&self.attribute, world.now)
        } else {
            let sensor = world.sensors.iter().find(|sensor| sensor.inode == self.inode).unwrap();
            if sensor.is_unplugged {
                return errno(Errno::NODEV);
            }
            sensor.read(&self.attribute, world.now, &world.headings)
        }
    }
}

impl AttributeFile for BrickNode {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let mut world = self.world.lock().unwrap_or_else(PoisonError::into_inner);
        world.count();
        if self.attribute == "bin_data" {
            self.text(&world)?;
            let sensor = world.sensors.iter().find(|sensor| sensor.inode == self.inode).unwrap();
            let raw = sensor.raw(world.now, &world.headings)?;
            buffer[..raw.len()].copy_from_slice(&raw);
            return Ok(raw.len());
        }
        let text = self.text(&world)? + "\n";
        buffer[..text.len()].copy_from_slice(text.as_bytes());
        Ok(text.len())
    }

    fn read_at(&self, buffer: &mut [u8], offset: u8) -> io::Result<usize> {
        self.at_registers(offset, buffer.len(), |registers| {
            buffer[..registers.len()].copy_from_slice(registers);
            registers.len()
        })
    }

    fn write_at(&self, bytes: &[u8], offset: u8) -> io::Result<()> {
        self.at_registers(offset, bytes.len(), |registers| registers.copy_from_slice(bytes))
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        let mut world = self.world.lock().unwrap_or_else(PoisonError::into_inner);
        world.count();
        let text = std::str::from_utf8(text).unwrap().strip_suffix('\n').unwrap();
        let is_it = |inode: u64| inode == self.inode;
        let mut wait = Duration::ZERO;
        let heading = world.heading;
        let (address, written) = if self.is_motor {
            let now = world.now;
            let motor = world.motors.iter_mut().find(|motor| is_it(motor.inode)).unwrap();
            if motor.is_unplugged {
                return errno(Errno::NODEV);
            }
            (motor.address.clone(), motor.write(&self.attribute, text, now))
        } else {
            let now = world.now;
            let sensor = world.sensors.iter_mut().find(|sensor| is_it(sensor.inode)).unwrap();
            if sensor.is_unplugged {
                return errno(Errno::NODEV);
            }
            wait = sensor.mode_latency;
            let written = sensor.write(&self.attribute, text, now + wait);
            let address = sensor.address.clone();
            if let (Ok(()), Some(factor)) = (&written, sensor.gyro) {
                // The angle starts at 0 again.
                sensor.gyro_zero = -heading * factor;
            }
            (address, written)
        };
        let port = ev3_driver::port_name::short(&address);
        let line = format!("{port} {} {text}", self.attribute);
        if written.is_ok() {
            world.written.push(line);
            world.advance(wait, false);
        }
        written
    }
}

impl BrickNode {
    /// Does something with a sensor's registers.
    fn at_registers<T>(
        &self,
        offset: u8,
        count: usize,
        act: impl FnOnce(&mut [u8]) -> T,
    ) -> io::Result<T> {
        assert_eq!(self.attribute, "direct");
        let mut world = self.world.lock().unwrap_or_else(PoisonError::into_inner);
        world.count();
        let now = world.now;
        let sensor = world.sensors.iter_mut().find(|sensor| sensor.inode == self.inode).unwrap();
        sensor.on_bus(offset, count, now).map(act)
    }
}

/// The motors at these ports.
pub(crate) fn motors(devices: &Registry, ports: &[&str]) -> Vec<Arc<Device>> {
    ev3_driver::motor::find_all(devices, ports.iter().copied()).unwrap().unwrap()
}
