//! Keys, speaker and screen, through the device files.
use crate::desk::furnished;
use crate::robots::{default_machine, default_robot};
use ev3_sim::{Action, Button, Depth, DevDescriptor, Errno, Machine, Options};
use std::time::Duration;

const KEYS: &str = "input/by-path/platform-gpio_keys-event";
const SOUND: &str = "input/by-path/platform-sound-event";

const WORD: usize = size_of::<usize>();
const EVENT: usize = 2 * WORD + 8;

fn event(kind: u16, code: u16, value: i32) -> Vec<u8> {
    let mut record = vec![0; 2 * WORD];
    record.extend(kind.to_ne_bytes());
    record.extend(code.to_ne_bytes());
    record.extend(value.to_ne_bytes());
    record
}

/// Kind, code and value of each event that there is to read.
fn events(file: &mut DevDescriptor, machine: &Machine) -> Vec<(u16, u16, i32)> {
    let mut buffer = [0; 8 * EVENT];
    let length = match file.read(machine, 0, &mut buffer) {
        Ok(length) => length,
        Err(errno) => {
            assert_eq!(errno, Errno::EAGAIN);
            0
        }
    };
    let parts = |record: &[u8]| {
        let two = |at: usize| u16::from_ne_bytes(record[at..at + 2].try_into().unwrap());
        let value = i32::from_ne_bytes(record[2 * WORD + 4..].try_into().unwrap());
        (two(2 * WORD), two(2 * WORD + 2), value)
    };
    buffer[..length].chunks_exact(EVENT).map(parts).collect()
}

fn read_number(size: u32, number: u32) -> u32 {
    2 << 30 | size << 16 | u32::from(b'E') << 8 | number
}

#[test]
fn a_reader_gets_what_happens_after_it_opened_the_device() {
    let mut machine = default_machine();
    machine.press(Button::Up);
    let mut file = DevDescriptor::open(&machine, KEYS).unwrap();
    assert!(!file.is_ready(&machine));
    assert_eq!(events(&mut file, &machine), []);
    machine.press(Button::Up);
    assert_eq!(events(&mut file, &machine), [], "it was down already");
    machine.release(Button::Up);
    machine.press(Button::Back);
    assert!(file.is_ready(&machine));
    assert_eq!(events(&mut file, &machine), [(1, 103, 0), (0, 0, 0), (1, 14, 1), (0, 0, 0)]);
    assert!(!file.is_ready(&machine));
}

#[test]
fn readers_have_queues_of_their_own_which_are_no_longer_than_the_kernels() {
    let mut machine = default_machine();
    let mut slow = DevDescriptor::open(&machine, "input/event1").unwrap();
    for _ in 0..100 {
        machine.press(Button::Enter);
        machine.release(Button::Enter);
    }
    let mut late = DevDescriptor::open(&machine, "input/event1").unwrap();
    assert_eq!(events(&mut late, &machine), []);
    let mut count = 0;
    loop {
        match events(&mut slow, &machine) {
            read if read.is_empty() => break,
            read => count += read.iter().filter(|(kind, ..)| *kind == 1).count(),
        }
    }
    assert_eq!(count, 64);
}

#[test]
fn a_record_holds_its_time_and_does_not_fit_less_room() {
    let mut machine = default_machine();
    let mut file = DevDescriptor::open(&machine, KEYS).unwrap();
    machine.step(Duration::from_millis(3250));
    machine.press(Button::Left);
    assert_eq!(file.read(&machine, 0, &mut [0; EVENT - 1]), Err(Errno::EINVAL));
    let mut record = [0; EVENT];
    assert_eq!(file.read(&machine, 0, &mut record), Ok(EVENT));
    let word = |at: usize| usize::from_ne_bytes(record[at..at + WORD].try_into().unwrap());
    assert_eq!((word(0), word(WORD)), (3, 250_000));
}

#[test]
fn planned_keys_come_at_their_time_however_time_is_sliced() {
    for slice in [1, 7, 1000] {
        let mut machine = default_machine();
        machine.plan_button(Button::Down, true, Duration::from_millis(301));
        machine.plan_button(Button::Down, false, Duration::from_millis(500));
        assert_eq!(machine.next_button(), Some(Duration::from_millis(301)));
        while machine.now() < Duration::from_secs(1) {
            let is_down = machine.is_pressed(Button::Down);
            let ms = machine.now().as_millis();
            assert!(!is_down || (301..=501).contains(&ms), "{ms}");
            machine.step(Duration::from_millis(slice));
        }
        let trace = machine.trace().events();
        let seen: Vec<_> = trace.iter().map(|e| (e.at.as_millis(), e.action, &*e.text)).collect();
        assert_eq!(seen, [(301, Action::Pressed, "down"), (500, Action::Released, "down")]);
        assert_eq!(machine.next_button(), None);
    }
}

#[test]
fn a_virtual_clock_finds_a_planned_key() {
    let mut machine = default_machine();
    machine.plan_button(Button::Enter, true, Duration::from_millis(13));
    assert_eq!(machine.next_event(), Duration::from_millis(14), "on the grid of ticks");
}

#[test]
fn the_state_of_keys_is_asked_as_the_kernel_is() {
    let mut machine = default_machine();
    let file = DevDescriptor::open(&machine, KEYS).unwrap();
    let state = |machine: &Machine, room| file.ioctl(machine, read_number(room, 0x18)).unwrap();
    assert_eq!(state(&machine, 96), (96, vec![0; 96]));
    machine.press(Button::Right);
    machine.press(Button::Enter);
    let (length, bits) = state(&machine, 95);
    assert_eq!((length, bits.len()), (95, 95));
    let set: Vec<_> = (0..95 * 8).filter(|bit| bits[bit / 8] >> (bit % 8) & 1 == 1).collect();
    assert_eq!(set, [28, 106]);
    let name = file.ioctl(&machine, read_number(256, 6)).unwrap();
    assert_eq!(name, (18, b"EV3 Brick Buttons\0".to_vec()), "no more than there is");
    let (length, bits) = state(&machine, 767);
    assert_eq!((length, bits.len()), (96, 96), "never as much as the caller has room for");
    let unique = file.ioctl(&machine, read_number(256, 8));
    assert_eq!(unique, Err(Errno::ENOENT));
    let (_, properties) = file.ioctl(&machine, read_number(32, 9)).unwrap();
    assert_eq!(properties, [0; size_of::<usize>()]);
    assert_eq!(file.ioctl(&machine, 0x4004_45a0), Ok((0, vec![])), "the clock of events");
    let unknown = file.ioctl(&machine, 0x4004_5480);
    assert_eq!(unknown, Err(Errno::EINVAL));
    let screen = DevDescriptor::open(&machine, "fb0").unwrap();
    assert_eq!(screen.ioctl(&machine, read_number(96, 0x18)), Err(Errno::ENOTTY));
}

#[test]
fn tones_fit_the_speaker_and_are_recorded() {
    let mut machine = default_machine();
    let file = DevDescriptor::open(&machine, SOUND).unwrap();
    for (asked, heard) in [(440, 440), (50, 100), (20_000, 10_000), (0, 0)] {
        assert_eq!(file.write(&mut machine, 0, &event(0x12, 2, asked)), Ok(EVENT));
        assert_eq!(machine.tone(), heard);
    }
    file.write(&mut machine, 0, &event(0x12, 1, 1)).unwrap();
    assert_eq!(machine.tone(), 1000);
    assert_eq!(file.write(&mut machine, 0, &[0; EVENT - 1]), Err(Errno::EINVAL));
    let trace: Vec<_> = machine.trace().events().into_iter().map(|e| e.text).collect();
    assert_eq!(trace, ["440", "100", "10000", "0", "1000"]);
}

#[test]
fn speech_takes_its_time_and_is_recorded() {
    let mut machine = default_machine();
    assert!(machine.say("hello") > Duration::from_millis(200));
    machine.play("bark.wav");
    machine.set_volume(150);
    assert_eq!(machine.volume(), 100);
    let events = machine.trace().events();
    let trace: Vec<_> = events.iter().map(|e| (e.action, &*e.text)).collect();
    assert_eq!(trace, [(Action::Said, "hello"), (Action::Played, "bark.wav")]);
}

#[test]
fn the_screen_is_so_many_bytes() {
    for (depth, bits, stride, length) in
        [(Depth::One, "1\n", "24\n", 3072), (Depth::ThirtyTwo, "32\n", "712\n", 91136)]
    {
        let options = Options { depth, ..Options::default() };
        let mut machine = Machine::new(&furnished(), &default_robot(), options).unwrap();
        assert_eq!(machine.read_path("graphics/fb0/bits_per_pixel").unwrap(), bits);
        assert_eq!(machine.read_path("graphics/fb0/stride").unwrap(), stride);
        assert_eq!(machine.read_path("graphics/fb0/virtual_size").unwrap(), "178,128\n");
        let mut screen = DevDescriptor::open(&machine, "fb0").unwrap();
        assert_eq!(screen.length(&machine), Some(length));
        let before = machine.clone();
        assert_eq!(screen.write(&mut machine, length - 2, &[7, 8, 9]), Ok(2));
        assert_eq!(screen.write(&mut machine, length, &[7]), Err(Errno::ENOSPC));
        assert_eq!(screen.write(&mut machine, length + 1, &[7]), Err(Errno::EFBIG));
        let mut end = [0; 4];
        assert_eq!(screen.read(&machine, length - 2, &mut end), Ok(2));
        assert_eq!(end[..2], [7, 8]);
        screen.read(&before, length - 2, &mut end).unwrap();
        assert_ne!(end[..2], [7, 8], "a snapshot stays as it was");
    }
}

#[test]
fn the_directory_is_the_bricks() {
    let machine = default_machine();
    let names = |node| -> Vec<String> {
        machine.dev_read_dir(node).unwrap().into_iter().map(|entry| entry.name).collect()
    };
    let root = ev3_sim::NodeId::ROOT;
    assert_eq!(names(root), ["fb0", "input"]);
    let input = machine.dev_lookup(root, "input").unwrap();
    assert_eq!(names(input), ["by-path", "event0", "event1"]);
    let open = |path| DevDescriptor::open(&machine, path).map(drop);
    assert_eq!(open("input/event2"), Err(Errno::ENOENT));
    assert_eq!(open("fb0/x"), Err(Errno::ENOTDIR));
    assert_eq!(open("input"), Err(Errno::EISDIR));
}
