//! Wires that are pulled and put in, modes of ports, and other things that go wrong.
use crate::brick::Led;
use crate::brick::output::{Output, Pins};
use crate::brick::port::{LegoPort, Port};
use crate::machine::Machine;
use crate::machine::socket::Plug;
use crate::machine::tree::Hardware;
use crate::motor::Tacho;
use crate::motor::dc::DcMotor;
use crate::motor::servo::{self, Servo};
use crate::robot::{motors_alike, sensors_alike};
use crate::sensor::{Sense, Sensor};
use crate::ticks::{TICK_US, ticks_from_ms};
use crate::trace::Action;
use crate::world::SpecError;
use ev3_os::linux::Errno;
use std::time::Duration;

/// udev needs about half a second to open the files of a new device to the group.
const UDEV_MS: i32 = 500;
/// Writing `nxt-i2c` to a port's mode waits for sensors to boot.
const I2C_PROBE: Duration = Duration::from_secs(1);
const NXT_TOUCH: &str = "lego-nxt-touch";

impl Machine {
    /// Plugs a motor or sensor in, by its driver's name. A motor on the port of a wheel drives that
    /// wheel. The device gets a new number. Errors: if no such thing fits the port.
    pub fn plug(&mut self, port: Port, driver: &str) -> Result<(), SpecError> {
        let plug = Plug::named(driver, port).ok_or_else(|| {
            let alike = if port.is_output() { motors_alike(driver) } else { sensors_alike(driver) };
            let reason = format!("does not fit this port; there are: {alike}");
            SpecError::new(format!("{driver} on {port}"), reason)
        })?;
        if let Plug::Motor(kind) = plug {
            self.shafts[port.slot()].connect(kind);
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

    /// Presses the touch sensor that is plugged in, and holds it, or lets go of it; false if
    /// another device is there.
    pub fn press_touch(&mut self, port: Port, is_press: bool) -> bool {
        let is_touch = match self.sockets[port as usize].plug {
            Some(Plug::Sensor(kind)) => kind.modes.iter().any(|mode| mode.sense == Sense::Touch),
            _ => false,
        };
        if is_touch && self.held[port as usize] != is_press {
            self.held[port as usize] = is_press;
            let action = if is_press { Action::Pressed } else { Action::Released };
            self.trace.event(self.now, action, None, port.name().as_bytes());
            self.hand_is_done();
        }
        is_touch
    }

    /// Whether the kernel has yet to show what was plugged in, or that it was pulled out.
    pub fn is_detecting(&self, port: Port) -> bool {
        let socket = &self.sockets[port as usize];
        socket.noticed.is_some() || socket.due.is_some()
    }

    fn change_plug(&mut self, port: Port, plug: Option<Plug>) {
        self.held[port as usize] = false;
        let is_looked_for = self.lego_port(port).is_some_and(|port| port.mode_name() == "auto");
        let socket = &mut self.sockets[port as usize];
        socket.change(plug, self.tick);
        let device = socket.device.and_then(|serial| self.tree.hardware_mut(serial));
        if let (Some(Hardware::Sensor(sensor)), false) = (device, is_looked_for) {
            let is_its = plug.is_some_and(|plug| plug.is_of(sensor.kind));
            sensor.connect(is_its);
            // Another sensor on a serial line reports its type to the driver.
            if is_its || !plug.is_some_and(Plug::is_serial) {
                socket.due = None;
            }
        }
        self.if_instant(port);
    }

    /// Where nothing takes time, what is to come is there.
    fn if_instant(&mut self, port: Port) {
        if self.options.instant {
            self.look_at_plug(port, u64::MAX);
        }
    }

    /// What the kernel has noticed of a plug by that tick: first `status` changes, then the
    /// device. Only the mode `auto` acts on it, and a serial line on the sensor that it awaits.
    pub(crate) fn look_at_plug(&mut self, port: Port, now: u64) {
        let socket = &mut self.sockets[port as usize];
        let noticed = socket.noticed.take_if(|due| *due <= now).is_some();
        let due = socket.due.take_if(|due| *due <= now).is_some();
        if !noticed && !due {
            return;
        }
        let mode = self.lego_port(port).map_or("", |device| device.mode_name());
        if mode == "auto" {
            if noticed {
                self.notice(port);
            }
            if due {
                self.sockets[port as usize].forced = None;
                self.register(port, false);
            }
        } else if due && mode == "ev3-uart" {
            self.register(port, false);
        }
    }

    pub(crate) fn notice(&mut self, port: Port) {
        let detected = Plug::detected(self.sockets[port as usize].plug, port);
        if let Some(device) = self.lego_port(port) {
            device.detected = detected;
        }
    }

    fn lego_port(&mut self, port: Port) -> Option<&mut LegoPort> {
        match self.tree.hardware_mut(self.sockets[port as usize].lego_port) {
            Some(Hardware::Port(device)) => Some(device),
            _ => None,
        }
    }

    /// A port's mode was written, maybe the same one: its device goes and, where the mode implies
    /// one, another comes before the call returns. `auto` implies none, and looks again.
    pub(crate) fn port_mode(&mut self, port: Port, mode: usize) -> Duration {
        let now = self.tick;
        self.remove_device(port);
        let Some(device) = self.lego_port(port) else {
            return Duration::ZERO;
        };
        let before = device.mode_name();
        device.mode = mode;
        device.forget();
        let name = device.mode_name();
        let socket = &mut self.sockets[port as usize];
        (socket.forced, socket.noticed, socket.due) = (None, None, None);
        if before == "raw" || name == "auto" {
            socket.output.pins = Pins::Coast;
        }
        match name {
            "auto" => {
                socket.look_again(now);
                self.if_instant(port);
            }
            "ev3-uart" if socket.plug.is_some_and(Plug::is_serial) => {
                socket.await_introduction(now);
                self.if_instant(port);
            }
            _ => self.register(port, false),
        }
        if name == "nxt-i2c" { I2C_PROBE } else { Duration::ZERO }
    }

    /// Takes the device of a port away. An output port keeps what its bridge does, until the port
    /// looks for motors again; only a light goes off.
    fn remove_device(&mut self, port: Port) {
        let socket = &mut self.sockets[port as usize];
        for serial in socket.device.take().into_iter().chain(socket.servos.drain(..)) {
            if let Some(hardware) = self.tree.hardware(serial) {
                let output = hardware.output().unwrap_or_default();
                let is_light = matches!(hardware, Hardware::Led(_));
                socket.output = if is_light { Output::default() } else { output };
            }
            self.tree.remove(serial);
        }
    }

    /// Takes the device of a port away and registers the one that belongs there.
    pub(crate) fn register(&mut self, port: Port, at_boot: bool) {
        self.remove_device(port);
        let mode = self.lego_port(port).map_or("auto", |device| device.mode_name());
        let socket = &mut self.sockets[port as usize];
        if mode == "auto" && socket.forced.is_none() {
            socket.output.pins = Pins::Coast;
        }
        let output = socket.output;
        let plug = socket.driver(mode);
        let hardware = match (mode, plug) {
            ("dc-motor", _) => Some(Hardware::DcMotor(DcMotor::new(port, output, self.tick))),
            ("led", _) => Some(Hardware::Led(Led::on_port(port.address(), output))),
            (_, plug) => plug.map(|plug| self.driver(port, plug, at_boot)),
        };
        let hardware = hardware.filter(|hardware| mode != "auto" || !self.is_unknown(hardware));
        let closed = if at_boot { 0 } else { self.tick + self.udev_ticks() };
        let device = hardware.map(|hardware| self.tree.add(hardware, closed));
        self.sockets[port as usize].device = device;
        if let Some(serial) = device.filter(|_| at_boot || self.options.instant) {
            self.sample(serial);
        }
        if matches!(plug, Some(Plug::Sensor(kind)) if kind.driver_name == servo::DRIVER) {
            let add = |servo| self.tree.add(Hardware::Servo(servo), closed);
            self.sockets[port as usize].servos = Servo::all(port).map(add).collect();
        }
    }

    /// True for an NXT touch sensor that is pressed while it is looked at: the port does not know
    /// it then, and makes no device of it.
    fn is_unknown(&self, hardware: &Hardware) -> bool {
        let Hardware::Sensor(sensor) = hardware else {
            return false;
        };
        let is_told = self.sockets[sensor.port() as usize].forced.is_some();
        let is_pressed = || sensor.mode().scale.shown(self.measure(sensor)[0]) != 0;
        !is_told && sensor.kind.driver_name == NXT_TOUCH && is_pressed()
    }

    /// How long udev takes to open new files to the group.
    pub(crate) fn udev_ticks(&self) -> u64 {
        if self.options.instant { 0 } else { ticks_from_ms(UDEV_MS) }
    }

    /// A fresh driver for a tacho motor or sensor.
    fn driver(&self, port: Port, plug: Plug, at_boot: bool) -> Hardware {
        match plug {
            Plug::Motor(kind) => {
                let count = self.shafts[port.slot()].encoder.count();
                let output = self.sockets[port as usize].output;
                Hardware::Tacho(Box::new(Tacho::new(kind, port, count, at_boot, output, self.tick)))
            }
            Plug::Sensor(kind) => {
                let instant = self.options.instant;
                Hardware::Sensor(Box::new(Sensor::new(kind, port, self.tick, instant, at_boot)))
            }
        }
    }

    /// Silences a sensor for a while, a serial one or one on the I2C bus. It stays registered and
    /// shows its old values. If the silence is long, a serial one then has to introduce itself
    /// again: meanwhile it has no mode and no values (ENXIO). False if there is no such sensor.
    pub fn lose_contact(&mut self, port: Port, time: Duration) -> bool {
        let Some(serial) = self.sockets[port as usize].device else {
            return false;
        };
        self.look(serial);
        let Some(Hardware::Sensor(sensor)) = self.tree.hardware_mut(serial) else {
            return false;
        };
        if sensor.kind.link.is_analog() {
            return false;
        }
        let ticks = time.as_micros().div_ceil(TICK_US.into());
        sensor.fall_silent(u64::try_from(ticks).unwrap_or(u64::MAX / 2));
        true
    }

    /// Makes an attribute of the device at a port show a text in place of its own, until
    /// [`Machine::unshow`] or until it is unplugged. The attribute accepts writes as usual. Only
    /// that file changes: a sensor whose `value0` is shown has its own `bin_data`.
    /// Errors: ENODEV without a device, ENOENT without such an attribute, EACCES if it cannot be
    /// read, EINVAL for more text than fits a page.
    pub fn show(&mut self, port: Port, attribute: &str, text: &str) -> Result<(), Errno> {
        let serial = self.sockets[port as usize].device.ok_or(Errno::ENODEV)?;
        self.tree.show(serial, attribute, Some(text)).map(drop)
    }

    /// Ends what [`Machine::show`] began; false if it did not. Errors: ENODEV without a device,
    /// ENOENT without such an attribute, EACCES if it cannot be read.
    pub fn unshow(&mut self, port: Port, attribute: &str) -> Result<bool, Errno> {
        let serial = self.sockets[port as usize].device.ok_or(Errno::ENODEV)?;
        self.tree.show(serial, attribute, None)
    }

    /// Holds the shaft of a motor fast, or lets it go.
    pub fn jam(&mut self, port: Port, fast: bool) {
        if port.is_output() {
            self.shafts[port.slot()].jammed = fast;
        }
    }
}
