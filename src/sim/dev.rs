//! The simulated brick's buttons, speaker and screen as a [`Dev`].
use ev3_driver::devfs::{Speaker, Stream};
use ev3_driver::error::Access;
use ev3_driver::{Devfs, Errno};
use ev3_os::locked;
use ev3_sim::{OpenDevice, Simulation};
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
        let device = Mutex::new(self.simulation.open_device(below).map_err(io::Error::from)?);
        Ok(Box::new(SimulatedStream { simulation: Arc::clone(&self.simulation), device }))
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
        self.simulation.say(text)
    }

    fn play(&self, file: &str) {
        self.simulation.play(file);
    }

    fn silence(&self) {
        self.simulation.silence();
    }

    fn volume(&self) -> u8 {
        self.simulation.volume()
    }

    fn set_volume(&self, percent: u8) {
        self.simulation.set_volume(percent);
    }
}

/// An open device of a simulation.
struct SimulatedStream {
    simulation: Arc<Simulation>,
    device: Mutex<OpenDevice>,
}

impl Stream for SimulatedStream {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.simulation.read_device(&mut locked(&self.device), buffer);
        read.map_err(io::Error::from)
    }

    fn write(&self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.simulation.write_device(&mut locked(&self.device), bytes);
        written.map_err(io::Error::from)
    }

    fn skip(&self) -> io::Result<()> {
        Ok(())
    }

    fn key_state(&self, bits: &mut [u8]) -> io::Result<()> {
        let state = self.simulation.ioctl(&locked(&self.device), eviocgkey(bits.len()));
        let state = state.map_err(io::Error::from)?;
        let (known, rest) = bits.split_at_mut(state.len().min(bits.len()));
        known.copy_from_slice(&state[..known.len()]);
        rest.fill(0);
        Ok(())
    }

    fn length(&self) -> Option<u64> {
        locked(&self.device).length()
    }
}
