//! Wires that are pulled and put in, modes of ports, and other things that go wrong.

use std::time::Duration;

use crate::brick::Led;
use crate::brick::port::Port;
use crate::files::errno::Errno;
use crate::machine::Machine;
use crate::machine::socket::Plug;
use crate::machine::tree::Hardware;
use crate::motor::Tacho;
use crate::motor::dc::DcMotor;
use crate::motor::servo::{self, Servo};
use crate::sensor::Sensor;
use crate::world::SpecError;
use crate::{TICK_US, ticks_from_ms};

/// udev needs about half a second to open the files of a new device to the group.
const UDEV_MS: i32 = 500;
/// Writing `nxt-i2c` to a port's mode waits for sensors to boot.
const I2C_PROBE: Duration = Duration::from_secs(1);

impl Machine {
    /// Plugs a motor or sensor in, by its driver's name. A motor on the port of a wheel drives
    /// that wheel. The device gets a new number.
    ///
    /// # Errors
    /// If no such thing fits the port.
    pub fn plug(&mut self, port: Port, driver: &str) -> Result<(), SpecError> {
        let plug = Plug::named(driver, port).ok_or_else(|| {
            SpecError::new(format!("{driver} on {port}"), "is nothing that fits this port")
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
    pub(crate) fn port_mode(&mut self, port: Port, mode: usize) -> Duration {
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
    pub(crate) fn register(&mut self, port: Port, at_boot: bool) {
        let socket = &mut self.sockets[port as usize];
        for serial in socket.device.take().into_iter().chain(socket.servos.drain(..)) {
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
        let closed = if at_boot { 0 } else { self.tick + self.udev_ticks() };
        let has_tacho = matches!(plug, Some(Plug::Motor(_))) || mode == "tacho-motor";
        let plugged = self.sockets[port as usize].plug;
        let has_nxt_analog =
            mode == "nxt-analog" || (mode == "auto" && plugged.is_some_and(Plug::is_nxt_analog));
        self.sockets[port as usize].device =
            hardware.map(|hardware| self.tree.add(hardware, closed));
        if matches!(plug, Some(Plug::Sensor(kind)) if kind.driver_name == servo::DRIVER) {
            let add = |servo| self.tree.add(Hardware::Servo(servo), closed);
            self.sockets[port as usize].servos = Servo::all(port).map(add).collect();
        }
        if let Some(Hardware::Port(device)) = self.tree.hardware_mut(lego_port) {
            device.has_tacho = has_tacho;
            device.has_nxt_analog = has_nxt_analog;
        }
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
                Hardware::Tacho(Box::new(Tacho::new(kind, port, count, at_boot, self.tick)))
            }
            Plug::Sensor(kind) => {
                let instant = self.options.instant;
                Hardware::Sensor(Box::new(Sensor::new(kind, port, self.tick, instant, at_boot)))
            }
        }
    }

    /// Cuts the line to a serial sensor for a while: it stays registered, but has no values
    /// (ENXIO) and takes no mode (ENODEV) until it has introduced itself again. False if there is
    /// no such sensor.
    pub fn lose_contact(&mut self, port: Port, time: Duration) -> bool {
        let serial = self.sockets[port as usize].device;
        let hardware = serial.and_then(|serial| self.tree.hardware_mut(serial));
        let Some(Hardware::Sensor(sensor)) = hardware else {
            return false;
        };
        let ticks = time.as_micros().div_ceil(TICK_US.into());
        sensor.lose_contact(u64::try_from(ticks).unwrap_or(u64::MAX / 2));
        true
    }

    /// Makes an attribute of the device at a port show a text in place of its own, until
    /// [`Machine::unshow`] or until it is unplugged. The attribute accepts writes as usual. Only
    /// that file changes: a sensor whose `value0` is shown has its own `bin_data`.
    ///
    /// # Errors
    /// ENODEV without a device, ENOENT without such an attribute, EACCES if it cannot be read,
    /// EINVAL for more text than fits a page.
    pub fn show(&mut self, port: Port, attribute: &str, text: &str) -> Result<(), Errno> {
        let serial = self.sockets[port as usize].device.ok_or(Errno::ENODEV)?;
        self.tree.show(serial, attribute, Some(text)).map(drop)
    }

    /// Ends what [`Machine::show`] began; false if it did not.
    ///
    /// # Errors
    /// ENODEV without a device, ENOENT without such an attribute, EACCES if it cannot be read.
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
