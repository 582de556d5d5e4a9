//! Keys, speaker and screen over plain files and pipes.
use ev3_driver::brick::buttons::{self as keys, Button, Event, Events};
use ev3_driver::brick::screen;
use ev3_driver::brick::screen::frame::{Frame, Shade, Shape, Style};
use ev3_driver::brick::screen::picture::{Picture, to_png};
use ev3_driver::brick::sound::{Sound, Tone};
use ev3_driver::devfs::{Devfs, Stream};
use ev3_driver::error::{Access, Error};
use ev3_driver::{DevfsDir, Errno, SysfsDir};
use std::fs::{self, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;
use tempfile::TempDir;

const KEYS: &str = "input/by-path/platform-gpio_keys-event";
const SOUND: &str = "input/by-path/platform-sound-event";

fn directory() -> TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::create_dir_all(directory.path().join("input/by-path")).unwrap();
    directory
}

fn record(kind: u16, code: u16, value: i32) -> Vec<u8> {
    let mut bytes = vec![0; 2 * size_of::<usize>()];
    bytes.extend(kind.to_ne_bytes());
    bytes.extend(code.to_ne_bytes());
    bytes.extend(value.to_ne_bytes());
    bytes
}

fn never() -> bool {
    false
}

#[test]
fn keys_are_what_the_events_in_a_file_left_down() {
    let directory = directory();
    let dev = DevfsDir::new(directory.path());
    assert!(keys::pressed(&dev).unwrap().is_none(), "no device");
    let file = directory.path().join(KEYS);
    let events = [record(1, 103, 1), record(1, 14, 1), record(1, 103, 0), record(1, 28, 1)];
    fs::write(&file, events.concat()).unwrap();
    assert_eq!(keys::pressed(&dev).unwrap().unwrap(), [Button::Enter, Button::Back]);
}

#[test]
fn an_event_may_come_in_pieces() {
    let directory = directory();
    let path = directory.path().join(KEYS);
    fs::write(&path, record(1, 103, 1)).unwrap();
    let dev: Arc<dyn Devfs> = Arc::new(DevfsDir::new(directory.path()));
    let events = Arc::new(Events::from_now(dev).unwrap().unwrap());
    let mut file = OpenOptions::new().append(true).open(&path).unwrap();
    let (first, second) = (record(1, 106, 1), record(1, 106, 0));
    file.write_all(&first[..5]).unwrap();
    assert_eq!(
        events.until_next(None, None, Some(Duration::ZERO)).block(&mut never).unwrap(),
        None
    );
    file.write_all(&first[5..]).unwrap();
    file.write_all(&second).unwrap();
    let next = || events.until_next(None, None, Some(Duration::ZERO)).block(&mut never).unwrap();
    assert_eq!(next(), Some(Event { button: Button::Right, is_press: true }));
    assert_eq!(next(), Some(Event { button: Button::Right, is_press: false }));
    assert_eq!(next(), None);
}

#[test]
fn a_wait_for_a_key_asks_whether_to_go_on() {
    let directory = directory();
    fs::write(directory.path().join(KEYS), "").unwrap();
    let dev: Arc<dyn Devfs> = Arc::new(DevfsDir::new(directory.path()));
    let events = Arc::new(Events::from_now(dev).unwrap().unwrap());
    let mut asked = 0;
    let ended = events.until_next(None, None, None).block(&mut || {
        asked += 1;
        asked == 3
    });
    assert!(matches!(ended, Err(Error::Interrupted)));
}

#[test]
fn a_directory_in_the_place_of_the_keys_is_an_error() {
    let directory = directory();
    fs::create_dir(directory.path().join(KEYS)).unwrap();
    let error = keys::pressed(&DevfsDir::new(directory.path())).unwrap_err();
    assert_eq!(error.errno(), Some(Errno::ISDIR), "{error}");
    assert_eq!(error.path(), Some(&*directory.path().join(KEYS)));
}

#[test]
fn a_tone_ends_however_it_is_left() {
    let directory = directory();
    let path = directory.path().join(SOUND);
    let dev: Arc<dyn Devfs> = Arc::new(DevfsDir::new(directory.path()));
    let sound = Arc::<Sound>::default();
    let tones = || vec![Tone { hertz: 440, lasts: Duration::from_secs(1000) }];
    assert!(sound.play_tones(&dev, tones()).unwrap().is_none(), "no device");
    fs::write(&path, "").unwrap();
    let mut asked = 0;
    let left = sound.play_tones(&dev, tones()).unwrap().unwrap().block(&mut || {
        asked += 1;
        asked == 2
    });
    assert!(matches!(left, Err(Error::Interrupted)));
    let written = [record(0x12, 2, 440), record(0x12, 2, 0)].concat();
    assert_eq!(fs::read(&path).unwrap(), written);
    sound.stop(&*dev).unwrap();
    assert_eq!(fs::read(&path).unwrap(), written, "nothing sounds");
}

/// A screen that is a device: it does not say how long it is.
struct Device {
    root: PathBuf,
}

struct Endless;

impl Devfs for Device {
    fn root(&self) -> &Path {
        &self.root
    }

    fn open(&self, _path: &Path, _access: Access) -> io::Result<Box<dyn Stream>> {
        Ok(Box::new(Endless))
    }

    fn now(&self) -> Duration {
        Duration::ZERO
    }

    fn pause(&self, _stream: Option<&dyn Stream>, _end: Duration) -> io::Result<bool> {
        Ok(true)
    }
}

impl Stream for Endless {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        buffer.fill(0);
        Ok(buffer.len().min(100))
    }

    fn write(&self, bytes: &[u8]) -> io::Result<usize> {
        Ok(bytes.len().min(100))
    }

    fn skip(&self) -> io::Result<()> {
        Ok(())
    }

    fn key_state(&self, _bits: &mut [u8]) -> io::Result<()> {
        Err(Errno::NOTTY.into())
    }

    fn length(&self) -> Option<u64> {
        None
    }
}

#[test]
fn a_screen_that_is_a_device_is_as_the_kernel_says() {
    let classes = tempfile::tempdir().unwrap();
    let folder = classes.path().join("graphics/fb0");
    let (tree, dev) = (SysfsDir::new(classes.path()), Device { root: "/dev".into() });
    let seen = || screen::seen(&tree, &dev).unwrap();
    assert!(seen().is_none(), "it says nothing");
    fs::create_dir_all(&folder).unwrap();
    let say = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    say("virtual_size", "178,128\n");
    say("stride", "24\n");
    say("bits_per_pixel", "1\n");
    // All bits zero is white there, and black where a pixel has four bytes.
    assert_eq!(seen().unwrap(), vec![255; 178 * 128]);
    say("stride", "712\n");
    say("bits_per_pixel", "32\n");
    assert_eq!(seen().unwrap(), vec![0; 178 * 128]);
    assert!(screen::show(&tree, &dev, &Frame::default()).unwrap().is_some());
    for (name, text) in
        [("bits_per_pixel", "16"), ("virtual_size", "1920,1080"), ("virtual_size", "wide")]
    {
        let path = folder.join(name);
        let before = fs::read_to_string(&path).unwrap();
        say(name, text);
        assert!(seen().is_none(), "{name}: {text}");
        say(name, &before);
    }
    for (name, text) in [("stride", "0"), ("stride", "23"), ("stride", "99999999999")] {
        say(name, text);
        assert!(seen().is_none(), "{name}: {text}");
    }
}

#[test]
fn a_picture_that_was_written_is_read_again() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path().join("picture.png");
    let mut frame = Frame::default();
    let style = Style { color: Shade::DarkGray, width: 3, fill: false };
    frame.draw(Shape::Circle([90, 60], 40), style);
    frame.draw(Shape::Line([0, 0], [177, 127]), Style { color: Shade::Black, ..style });
    fs::write(&path, to_png(178, 128, frame.shades())).unwrap();
    let picture = Picture::read(&path).unwrap();
    let mut again = Frame::default();
    again.place([0, 0], &picture);
    assert_eq!(again.shades(), frame.shades());
}

#[test]
fn shapes_that_are_far_larger_than_the_screen_are_cut() {
    let mut frame = Frame::default();
    let style = Style { color: Shade::Black, width: 1, fill: true };
    frame.draw(Shape::Rectangle([-10_000, -10_000], [20_000, 20_000]), style);
    assert!(frame.shades().iter().all(|shade| *shade == 0));
    frame.clear();
    frame.draw(Shape::Circle([0, 0], 10_000), style);
    assert!(frame.shades().iter().all(|shade| *shade == 0));
}
