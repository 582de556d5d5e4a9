//! The loudspeaker.
//!
//! Tones are made by the kernel: an event written to the sound device starts one, and another ends
//! it. Speech and recordings are played by programs, `espeak`, `aplay`, and the volume is set by
//! `amixer`; a simulated speaker does without them.
//!
//! The kernel's driver (`legoev3_sound.c`) makes tones of 100 to 10000 Hz, and
//! none while a recording plays.
use crate::brick::buttons::EVENT_BYTES;
use crate::brick::programs::{Program, Programs, Started};
use crate::brick::recorded::open_file;
use crate::devfs::{Devfs, Finds, SLICE, Stream, UntilFound, open, open_first, pause};
use crate::error::{Access, Error, Result};
use crate::sysfs::{Repeated, Sysfs};
use crate::wait::{AnyWait, Look, Slices, Wait};
use ev3_os::locked;
use std::ffi::OsStr;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Stdio;
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Mutex};
use std::time::Duration;

/// The paths of the tone generator: ev3dev-stretch, jessie.
const DEVICES: [&str; 2] =
    ["input/by-path/platform-sound-event", "input/by-path/platform-snd-legoev3-event"];

/// From linux/input-event-codes.h.
const EV_SND: u16 = 0x12;
const SND_TONE: u16 = 2;

/// Controls of a mixer that make things loud: PCM and beeps on stretch, both on jessie, a PC's.
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
    programs: Arc<Programs>,
    /// A sound that plays while nobody waits for it holds this, too.
    in_background: Mutex<Arc<()>>,
    /// Whether the simulated speaker speaks in the background.
    speaks: AtomicBool,
}

impl Sound {
    /// Plays tones one after the other, and waits until they are over; `None` if there is no
    /// speaker. The speaker is silent afterwards, also when the wait is left.
    /// Errors: the kernel's, as EACCES for a user who is not in the group `input`.
    pub fn play_tones(
        self: &Arc<Self>,
        dev: &Arc<dyn Devfs>,
        tones: Vec<Tone>,
    ) -> Result<Option<AnyWait<'static, ()>>> {
        let Some((stream, path)) = open_first(&**dev, &DEVICES, Access::Write)? else {
            return Ok(None);
        };
        append(&*stream, &path)?;
        let generator = Generator { sound: Arc::clone(self), stream, path };
        let (dev, end, tones) = (Arc::clone(dev), dev.now(), tones.into_iter());
        let playing = Playing { generator, dev, tones, end, stops: self.stops() };
        Ok(Some(Slices::new(playing).boxed()))
    }

    /// Starts to play tones one after the other, in the place of all other sounds;
    /// `None` if there is no speaker.
    pub fn begin_tones(
        self: &Arc<Self>,
        tree: &dyn Sysfs,
        dev: &dyn Devfs,
        tones: Vec<Tone>,
    ) -> Result<Option<()>> {
        let Some((stream, path)) = open_first(dev, &DEVICES, Access::Write)? else {
            return Ok(None);
        };
        append(&*stream, &path)?;
        self.stop(dev)?;
        let (stops, playing) = (self.stops(), Arc::clone(&locked(&self.in_background)));
        let mut tones = tones.into_iter();
        let sound = Arc::clone(self);
        let mut next = move || {
            let _ = &playing;
            if sound.stops() != stops {
                return Ok(None);
            }
            let tone = tones.next();
            sound.set_tone(&*stream, &path, tone.map_or(0, |tone| tone.hertz))?;
            Ok(tone.map(|tone| tone.lasts))
        };
        if let Some(lasts) = next()? {
            // Nobody is there to report a later error to.
            begin(tree, lasts, Box::new(move || next().unwrap_or_default()))?;
        }
        Ok(Some(()))
    }

    fn stops(&self) -> u32 {
        self.stops.load(Ordering::SeqCst)
    }

    fn set_tone(&self, stream: &dyn Stream, path: &Path, hertz: u32) -> Result<()> {
        let mut on = locked(&self.on);
        if hertz == 0 && on.iter().all(|other| other != path) {
            return Ok(());
        }
        write_tone(stream, path, hertz)?;
        on.retain(|other| other != path);
        if hertz > 0 {
            on.push(path.to_owned());
        }
        Ok(())
    }

    /// Says a text, and waits until it is said.
    /// Errors: [`Error::NoProgram`] without espeak or aplay, [`Error::Program`].
    pub fn say(self: &Arc<Self>, dev: &Arc<dyn Devfs>, text: &str) -> Result<AnyWait<'static, ()>> {
        match dev.speaker() {
            Some(speaker) => Ok(self.let_speak(dev, || speaker.say(text))),
            None => Ok(self.programs.run(dev, || speaking(text))?.boxed()),
        }
    }

    /// Starts to say a text, in the place of all other sounds.
    /// Errors: as [`say`](Self::say), if a program cannot be started.
    pub fn begin_saying(
        self: &Arc<Self>,
        tree: &dyn Sysfs,
        dev: &dyn Devfs,
        text: &str,
    ) -> Result<()> {
        self.stop(dev)?;
        match dev.speaker() {
            Some(speaker) => self.begin_speaking(tree, speaker.say(text)),
            None => self.programs.begin(|| speaking(text)).map(drop),
        }
    }

    /// Plays a recording, a WAV file, and waits until it is over.
    /// Errors: as [`say`](Self::say); [`Error::Open`], [`Error::Format`] for what is no WAV file.
    pub fn play(
        self: &Arc<Self>,
        dev: &Arc<dyn Devfs>,
        path: &Path,
    ) -> Result<AnyWait<'static, ()>> {
        let lasts = length_of(path)?;
        let Some(speaker) = dev.speaker() else {
            return Ok(self.programs.run(dev, || playing(path))?.boxed());
        };
        let start = || {
            speaker.play(&path.to_string_lossy());
            lasts
        };
        Ok(self.let_speak(dev, start))
    }

    /// Starts to play a recording, in the place of all other sounds.
    /// Errors: as [`play`](Self::play), if the program cannot be started.
    pub fn begin_playing(
        self: &Arc<Self>,
        tree: &dyn Sysfs,
        dev: &dyn Devfs,
        path: &Path,
    ) -> Result<()> {
        let lasts = length_of(path)?;
        self.stop(dev)?;
        match dev.speaker() {
            Some(speaker) => {
                speaker.play(&path.to_string_lossy());
                self.begin_speaking(tree, lasts)
            }
            None => self.programs.begin(|| playing(path)).map(drop),
        }
    }

    fn begin_speaking(self: &Arc<Self>, tree: &dyn Sysfs, lasts: Duration) -> Result<()> {
        let (stops, playing) = (self.stops(), Arc::clone(&locked(&self.in_background)));
        self.speaks.store(true, Ordering::SeqCst);
        let sound = Arc::clone(self);
        let end = move || {
            let _ = &playing;
            if sound.stops() == stops {
                sound.speaks.store(false, Ordering::SeqCst);
            }
            None
        };
        begin(tree, lasts, Box::new(end))
    }

    /// Waits until no sound plays in the background.
    ///
    /// The errors are those of a program that played.
    pub fn until_silent(self: &Arc<Self>, dev: &Arc<dyn Devfs>) -> AnyWait<'static, ()> {
        UntilFound::new(dev, Background(Arc::clone(self))).boxed()
    }

    /// `start` returns how long it speaks.
    fn let_speak(
        self: &Arc<Self>,
        dev: &Arc<dyn Devfs>,
        start: impl FnOnce() -> Duration,
    ) -> AnyWait<'static, ()> {
        // Before it starts: a stop from then on is one of it.
        let stops = self.stops();
        let end = start().saturating_add(dev.now());
        let (sound, dev) = (Arc::clone(self), Arc::clone(dev));
        let speaking = Speaking { sound, dev, stops, end, is_over: false };
        Slices::new(speaking).boxed()
    }

    /// Ends every sound that this program makes.
    pub fn stop(&self, dev: &dyn Devfs) -> Result<()> {
        self.stops.fetch_add(1, Ordering::SeqCst);
        *locked(&self.in_background) = Arc::default();
        self.programs.end();
        if self.speaks.swap(false, Ordering::SeqCst) {
            if let Some(speaker) = dev.speaker() {
                speaker.silence();
            }
        }
        // The thread that made the tone goes on only once the tone is over.
        let mut on = locked(&self.on);
        while let Some(path) = on.pop() {
            if let Some(stream) = open(dev, &path, Access::Write)? {
                append(&*stream, &path)?;
                write_tone(&*stream, &path, 0)?;
            }
        }
        Ok(())
    }
}

/// Does something after some time, and from then on after what it answers.
fn begin(tree: &dyn Sysfs, after: Duration, act: Repeated) -> Result<()> {
    tree.every(after, act).map_err(|source| Error::Read { path: tree.root().to_owned(), source })
}

fn speaking(text: &str) -> Result<[Started; 2]> {
    let arguments = ["--stdout", "--", text].map(OsStr::new);
    let mut voice = Program::ESPEAK.start(&arguments, Stdio::null(), Stdio::piped())?;
    let quietly = ["-q"].map(OsStr::new);
    let player = Program::APLAY.start(&quietly, voice.printed(), Stdio::null())?;
    Ok([voice, player])
}

fn playing(path: &Path) -> Result<[Started; 1]> {
    let arguments = [OsStr::new("-q"), OsStr::new("--"), path.as_os_str()];
    Ok([Program::APLAY.start(&arguments, Stdio::null(), Stdio::null())?])
}

/// The volume in percent; `None` if there is no mixer for it.
/// Errors: [`Error::NoProgram`] without amixer.
pub fn volume(dev: &dyn Devfs) -> Result<Option<u8>> {
    if let Some(speaker) = dev.speaker() {
        return Ok(Some(speaker.volume()));
    }
    Ok(controls()?.first().map(|(_, percent)| *percent))
}

/// Sets the volume in percent; `None` if there is no mixer for it.
/// Errors: [`Error::NoProgram`] without amixer, [`Error::Program`].
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
    // A line for each control, then lines of what is known of it: Simple mixer control 'PCM',0
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

/// Tones that play one after the other.
struct Playing {
    generator: Generator,
    dev: Arc<dyn Devfs>,
    tones: std::vec::IntoIter<Tone>,
    /// When the tone that plays ends.
    end: Duration,
    stops: u32,
}

impl Wait for Playing {
    type End = ();

    fn look(&mut self) -> Result<Look<()>> {
        if self.generator.sound.stops() != self.stops {
            return Ok(Look::Over(()));
        }
        let now = self.dev.now();
        while now >= self.end {
            let Some(tone) = self.tones.next() else {
                return self.generator.set(0).map(Look::Over);
            };
            self.end = self.end.saturating_add(tone.lasts);
            self.generator.set(tone.hertz)?;
        }
        Ok(Look::Again(self.end.min(now + SLICE)))
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        pause(&*self.dev, end)
    }
}

/// The simulated speaker speaks.
struct Speaking {
    sound: Arc<Sound>,
    dev: Arc<dyn Devfs>,
    stops: u32,
    end: Duration,
    is_over: bool,
}

impl Wait for Speaking {
    type End = ();

    fn look(&mut self) -> Result<Look<()>> {
        if self.sound.stops() != self.stops {
            return Ok(Look::Over(()));
        }
        let now = self.dev.now();
        self.is_over = now >= self.end;
        Ok(if self.is_over { Look::Over(()) } else { Look::Again(self.end.min(now + SLICE)) })
    }

    fn pause(&mut self, end: Duration) -> Result<bool> {
        pause(&*self.dev, end)
    }
}

impl Drop for Speaking {
    fn drop(&mut self) {
        if let Some(speaker) = self.dev.speaker().filter(|_| !self.is_over) {
            speaker.silence();
        }
    }
}

/// Sounds that nobody waited for.
struct Background(Arc<Sound>);

impl Finds for Background {
    fn find(&mut self) -> Result<bool> {
        let is_over = Arc::strong_count(&locked(&self.0.in_background)) == 1;
        Ok(is_over && self.0.programs.are_all_over()?.is_some())
    }
}

/// A tone generator, which is off at the end.
struct Generator {
    sound: Arc<Sound>,
    stream: Box<dyn Stream>,
    path: PathBuf,
}

impl Generator {
    fn set(&self, hertz: u32) -> Result<()> {
        self.sound.set_tone(&*self.stream, &self.path, hertz)
    }
}

impl Drop for Generator {
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
    let (mut file, length) = open_file(path, "wav")?;
    let mut header = [0; 44];
    let is_read = file.read_exact(&mut header).is_ok();
    let bytes = length.saturating_sub(44);
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
