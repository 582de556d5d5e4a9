//! The loudspeaker.
//!
//! Tones are made by the kernel: an event written to the sound device starts
//! one, and another ends it. Speech and recordings are played by programs,
//! `espeak`, `aplay`, and the volume is set by `amixer`; a simulated speaker
//! does without them.
//!
//! The kernel's driver (`legoev3_sound.c`) makes tones of 100 to 10000 Hz, and
//! none while a recording plays.
use crate::brick::buttons::EVENT_BYTES;
use crate::brick::programs::{Program, Programs};
use crate::devfs::{Devfs, Speaker, Stream, open, open_first, until};
use crate::error::{Access, Error, Interrupted, Result};
use std::ffi::OsStr;
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The frequencies that the speaker can do, in Hz.
pub const FREQUENCIES: std::ops::RangeInclusive<u32> = 100..=10000;

/// The paths of the tone generator: ev3dev-stretch, jessie.
const DEVICES: [&str; 2] =
    ["input/by-path/platform-sound-event", "input/by-path/platform-snd-legoev3-event"];

/// From linux/input-event-codes.h.
const EV_SND: u16 = 0x12;
const SND_TONE: u16 = 2;

/// Controls of a mixer that make things loud: PCM and beeps on stretch, both
/// on jessie, a PC's.
const CONTROLS: [&str; 4] = ["PCM", "Beep", "Playback", "Master"];

/// A part of a song.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tone {
    /// In Hz; 0 is silence.
    pub hertz: u32,
    /// How long.
    pub lasts: Duration,
}

/// The sounds of this program.
#[derive(Debug, Default)]
pub struct Sound {
    /// The number of calls of [`stop`](Self::stop). A thread that makes sounds ends
    /// when it changes.
    stops: AtomicU32,
    /// The tone generators that are on.
    on: Mutex<Vec<PathBuf>>,
    /// The programs that play.
    programs: Programs,
}

impl Sound {
    /// Plays tones one after the other, and waits until they are over; `None`
    /// where there is no speaker. The speaker is silent afterwards, also after an
    /// error.
    ///
    /// # Errors
    /// The kernel's, as EACCES for a user who is not in the group `input`;
    /// [`Error::Interrupted`].
    pub fn play_tones(
        &self,
        dev: &dyn Devfs,
        tones: &[Tone],
        interrupted: Interrupted,
    ) -> Result<Option<()>> {
        let Some((stream, path)) = open_first(dev, &DEVICES, Access::Write)? else {
            return Ok(None);
        };
        append(&*stream, &path)?;
        let stops = self.stops.load(Ordering::SeqCst);
        let generator = Generator { sound: self, stream: &*stream, path: &path };
        let mut end = dev.now();
        for tone in tones {
            end = end.saturating_add(tone.lasts);
            generator.set(tone.hertz)?;
            let left = end.saturating_sub(dev.now());
            if self.pause(dev, left, stops, interrupted)? {
                return Ok(Some(()));
            }
        }
        generator.set(0)?;
        Ok(Some(()))
    }

    /// Waits; `true` if the sounds were stopped meanwhile.
    fn pause(
        &self,
        dev: &dyn Devfs,
        time: Duration,
        stops: u32,
        interrupted: Interrupted,
    ) -> Result<bool> {
        let stopped = until(dev, None, Some(time), interrupted, || {
            Ok((self.stops.load(Ordering::SeqCst) != stops).then_some(()))
        });
        Ok(stopped?.is_some())
    }

    /// Says a text, and waits until it is said.
    ///
    /// # Errors
    /// [`Error::NoProgram`] without espeak or aplay, [`Error::Program`];
    /// [`Error::Interrupted`].
    pub fn say(&self, dev: &dyn Devfs, text: &str, interrupted: Interrupted) -> Result<()> {
        if let Some(speaker) = dev.speaker() {
            return self.let_speak(dev, speaker, || speaker.say(text), interrupted);
        }
        let start = || {
            let arguments = ["--stdout", "--", text].map(OsStr::new);
            let mut voice = Program::ESPEAK.start(&arguments, Stdio::null(), Stdio::piped())?;
            let quietly = ["-q"].map(OsStr::new);
            let player = Program::APLAY.start(&quietly, voice.printed(), Stdio::null())?;
            Ok([voice, player])
        };
        self.programs.run(dev, start, interrupted)
    }

    /// Plays a recording, a WAV file, and waits until it is over.
    ///
    /// # Errors
    /// As [`say`](Self::say); [`Error::Open`], [`Error::Format`] for what is no
    /// WAV file.
    pub fn play(&self, dev: &dyn Devfs, path: &Path, interrupted: Interrupted) -> Result<()> {
        let lasts = length_of(path)?;
        if let Some(speaker) = dev.speaker() {
            let start = || {
                speaker.play(&path.to_string_lossy());
                lasts
            };
            return self.let_speak(dev, speaker, start, interrupted);
        }
        let start = || {
            let arguments = [OsStr::new("-q"), OsStr::new("--"), path.as_os_str()];
            Ok([Program::APLAY.start(&arguments, Stdio::null(), Stdio::null())?])
        };
        self.programs.run(dev, start, interrupted)
    }

    /// `start` returns how long it speaks.
    fn let_speak(
        &self,
        dev: &dyn Devfs,
        speaker: &dyn Speaker,
        start: impl FnOnce() -> Duration,
        interrupted: Interrupted,
    ) -> Result<()> {
        // Before it starts: a stop from then on is one of it.
        let stops = self.stops.load(Ordering::SeqCst);
        let spoken = self.pause(dev, start(), stops, interrupted);
        if !matches!(spoken, Ok(false)) {
            speaker.silence();
        }
        spoken.map(drop)
    }

    /// Ends every sound that this program makes.
    ///
    /// # Errors
    /// The kernel's.
    pub fn stop(&self, dev: &dyn Devfs) -> Result<()> {
        self.stops.fetch_add(1, Ordering::SeqCst);
        self.programs.end();
        // The thread that made the tone goes on only once the tone is over.
        let mut on = self.on();
        while let Some(path) = on.pop() {
            if let Some(stream) = open(dev, &path, Access::Write)? {
                append(&*stream, &path)?;
                write_tone(&*stream, &path, 0)?;
            }
        }
        Ok(())
    }

    fn on(&self) -> MutexGuard<'_, Vec<PathBuf>> {
        self.on.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The volume in percent; `None` where there is no mixer for it.
///
/// # Errors
/// [`Error::NoProgram`] without amixer.
pub fn volume(dev: &dyn Devfs) -> Result<Option<u8>> {
    if let Some(speaker) = dev.speaker() {
        return Ok(Some(speaker.volume()));
    }
    Ok(controls()?.first().map(|(_, percent)| *percent))
}

/// Sets the volume in percent; `None` where there is no mixer for it.
///
/// # Errors
/// [`Error::NoProgram`] without amixer, [`Error::Program`].
pub fn set_volume(dev: &dyn Devfs, percent: u8) -> Result<Option<()>> {
    if let Some(speaker) = dev.speaker() {
        speaker.set_volume(percent);
        return Ok(Some(()));
    }
    let controls = controls()?;
    for (control, _) in &controls {
        Program::AMIXER.output(&["-q", "sset", control, &format!("{percent}%")])?;
    }
    Ok((!controls.is_empty()).then_some(()))
}

/// The controls that exist, and their settings in percent.
fn controls() -> Result<Vec<(&'static str, u8)>> {
    let text = match Program::AMIXER.output(&["scontents"]) {
        Ok(text) => text,
        // No sound card: no control.
        Err(Error::Program { .. }) => return Ok(Vec::new()),
        Err(error) => return Err(error),
    };
    // A line for each control, then lines of what is known of it:
    // Simple mixer control 'PCM',0
    //   Mono: Playback 256 [100%]
    let parts: Vec<&str> = text.split("Simple mixer control '").skip(1).collect();
    let set_to = |control: &'static str| {
        let part = parts.iter().find_map(|part| part.strip_prefix(control)?.strip_prefix('\''))?;
        let (before, _) = part.split_once("%]")?;
        let (_, percent) = before.rsplit_once('[')?;
        Some((control, percent.parse().ok()?))
    };
    Ok(CONTROLS.into_iter().filter_map(set_to).collect())
}

/// A tone generator, which is off at the end.
struct Generator<'a> {
    sound: &'a Sound,
    stream: &'a dyn Stream,
    path: &'a Path,
}

impl Generator<'_> {
    fn set(&self, hertz: u32) -> Result<()> {
        let mut on = self.sound.on();
        if hertz == 0 && on.iter().all(|path| path != self.path) {
            return Ok(());
        }
        write_tone(self.stream, self.path, hertz)?;
        on.retain(|path| path != self.path);
        if hertz > 0 {
            on.push(self.path.to_owned());
        }
        Ok(())
    }
}

impl Drop for Generator<'_> {
    fn drop(&mut self) {
        // After an error: the first error is the one reported.
        let _ = self.set(0);
    }
}

/// A plain file in place of the device keeps all writes.
fn append(stream: &dyn Stream, path: &Path) -> Result<()> {
    stream.skip().map_err(|source| Error::Open {
        path: path.to_owned(),
        access: Access::Write,
        source,
    })
}

fn write_tone(stream: &dyn Stream, path: &Path, hertz: u32) -> Result<()> {
    let mut record = [0; EVENT_BYTES];
    if let Some((_, payload)) = record.split_last_chunk_mut::<8>() {
        let ([t0, t1], [c0, c1]) = (EV_SND.to_ne_bytes(), SND_TONE.to_ne_bytes());
        let [v0, v1, v2, v3] = hertz.to_ne_bytes();
        *payload = [t0, t1, c0, c1, v0, v1, v2, v3];
    }
    let written = stream.write(&record);
    written.map(drop).map_err(|source| Error::Write {
        path: path.to_owned(),
        text: hertz.to_string(),
        source,
    })
}

/// How long a WAV file lasts.
fn length_of(path: &Path) -> Result<Duration> {
    let cannot = |source| Error::Open { path: path.to_owned(), access: Access::Read, source };
    let mut file = File::open(path).map_err(cannot)?;
    let mut header = [0; 44];
    let is_read = file.read_exact(&mut header).is_ok();
    let bytes = file.metadata().map_err(cannot)?.len().saturating_sub(44);
    let rate = header.get(28..32).and_then(|rate| rate.try_into().ok()).map(u32::from_le_bytes);
    match rate {
        Some(rate) if is_read && rate > 0 && header.starts_with(b"RIFF") => {
            Ok(Duration::from_millis(bytes.saturating_mul(1000) / u64::from(rate)))
        }
        _ => Err(Error::Format {
            path: path.to_owned(),
            format: "wav",
            reason: "it has no header of a WAV file".to_owned(),
        }),
    }
}
