//! The simulated brick's buttons, speaker and screen as a [`Dev`].
use ev3_driver::devfs::{Speaker, Stream};
use ev3_driver::error::Access;
use ev3_driver::lock::locked;
use ev3_driver::{Devfs, Errno};
use ev3_sim::{DevDescriptor, Simulation};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The directory that programs see.
const ROOT: &str = "/dev";

/// The number of the ioctl that reads the pressed buttons into a buffer of this number
/// of bytes (linux/input.h).
fn eviocgkey(bytes: usize) -> u32 {
    let bytes = u32::try_from(bytes).unwrap_or(0) & 0x3fff;
    2 << 30 | bytes << 16 | u32::from(b'E') << 8 | 0x18
}

/// The device files of a simulation.
pub(crate) struct SimulatedDev {
    simulation: Arc<Simulation>,
    root: PathBuf,
}

impl SimulatedDev {
    pub(crate) fn new(simulation: Arc<Simulation>) -> Self {
        Self { simulation, root: ROOT.into() }
    }
}

impl Devfs for SimulatedDev {
    fn root(&self) -> &Path {
        &self.root
    }

    fn open(&self, path: &Path, _access: Access) -> io::Result<Box<dyn Stream>> {
        let below = path.strip_prefix(&self.root).ok().and_then(Path::to_str);
        let below = below.ok_or(Errno::NOENT)?;
        let descriptor =
            DevDescriptor::open(&self.simulation.machine(), below).map_err(io::Error::from)?;
        let place = Mutex::new(Place { descriptor, offset: 0 });
        Ok(Box::new(SimulatedStream { simulation: Arc::clone(&self.simulation), place }))
    }

    fn now(&self) -> Duration {
        self.simulation.machine().now()
    }

    fn pause(&self, stream: Option<&dyn Stream>, end: Duration) -> io::Result<bool> {
        Ok(match stream {
            Some(_) => self.simulation.pause_for_button(end),
            None => self.simulation.pause(end),
        })
    }

    fn speaker(&self) -> Option<&dyn Speaker> {
        Some(self)
    }
}

impl Speaker for SimulatedDev {
    fn say(&self, text: &str) -> Duration {
        self.simulation.machine().say(text)
    }

    fn play(&self, file: &str) {
        self.simulation.machine().play(file);
    }

    fn silence(&self) {
        self.simulation.machine().silence();
    }

    fn volume(&self) -> u8 {
        self.simulation.machine().volume()
    }

    fn set_volume(&self, percent: u8) {
        self.simulation.machine().set_volume(percent);
    }
}

/// An open device of a simulation.
struct SimulatedStream {
    simulation: Arc<Simulation>,
    place: Mutex<Place>,
}

/// The offset of the next read or write.
struct Place {
    descriptor: DevDescriptor,
    offset: usize,
}

impl SimulatedStream {}

impl Stream for SimulatedStream {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        self.simulation.read(|machine| {
            let Place { descriptor, offset } = &mut *locked(&self.place);
            let length = descriptor.read(machine, *offset, buffer).map_err(io::Error::from)?;
            *offset += length;
            Ok(length)
        })
    }

    fn write(&self, bytes: &[u8]) -> io::Result<usize> {
        self.simulation.write(|machine| {
            let Place { descriptor, offset } = &mut *locked(&self.place);
            let length = descriptor.write(machine, *offset, bytes).map_err(io::Error::from)?;
            *offset += length;
            Ok(length)
        })
    }

    fn skip(&self) -> io::Result<()> {
        Ok(())
    }

    fn key_state(&self, bits: &mut [u8]) -> io::Result<()> {
        let command = eviocgkey(bits.len());
        let state =
            self.simulation.read(|machine| locked(&self.place).descriptor.ioctl(machine, command));
        let (_, state) = state.map_err(io::Error::from)?;
        let (known, rest) = bits.split_at_mut(state.len());
        known.copy_from_slice(&state);
        rest.fill(0);
        Ok(())
    }

    fn length(&self) -> Option<u64> {
        let machine = self.simulation.machine();
        let length = locked(&self.place).descriptor.length(&machine);
        length.map(|length| length as u64)
    }
}
