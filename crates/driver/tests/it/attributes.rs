//! Attribute files: texts, numbers, and what else is found in their place.
use crate::files::PlainTree;
use ev3_driver::attributes::Short;
use ev3_driver::device::{read_file, read_value, write_file};
use ev3_driver::error::Access;
use ev3_driver::{Class, Device, Errno, Error, Registry, Sysfs, SysfsDir, Value, attributes};
use std::error::Error as _;
use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

fn motor_with(attributes: &[(&str, &str)]) -> (PlainTree, Arc<Registry>, Arc<Device>) {
    let tree = PlainTree::new();
    tree.plug(Class::TachoMotor, "motor0", "outA", attributes);
    let devices = tree.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    (tree, devices, motor)
}

fn never() -> bool {
    false
}

#[test]
fn an_attribute_is_read_and_written_by_one_access_to_a_kept_descriptor() {
    let (_tree, counted, devices) = PlainTree::with_motor(&[("speed_sp", "0")]);
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    counted.opens();
    counted.reads_and_writes();
    for speed in 0..10 {
        motor.write_number("speed_sp", speed).unwrap();
        assert_eq!(motor.number("speed_sp").unwrap(), speed);
    }
    assert_eq!(counted.opens(), 2, "one to read, one to write");
    assert_eq!(counted.reads_and_writes(), (10, 10));
}

#[test]
fn a_constant_is_read_once() {
    let (_tree, counted, devices) = PlainTree::with_motor(&[("max_speed", "1050")]);
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    counted.reads_and_writes();
    for _ in 0..10 {
        assert_eq!(motor.constant("max_speed").unwrap(), 1050);
    }
    assert_eq!(counted.reads_and_writes(), (1, 0));
}

#[test]
fn a_shorter_text_leaves_nothing_of_a_longer_one() {
    let (_tree, _, motor) = motor_with(&[("command", "")]);
    for word in ["run-forever", "stop", "", "reset"] {
        motor.write("command", word).unwrap();
        let text = fs::read_to_string(motor.path().join("command")).unwrap();
        assert_eq!(text, format!("{word}\n"));
        assert_eq!(motor.text("command").unwrap(), word);
    }
}

#[test]
fn a_text_of_any_length_is_written_whole() {
    let (_tree, _, motor) = motor_with(&[("text", "")]);
    for length in [1, 62, 63, 64, 65, 4095, 4096, 10_000] {
        let text = "x".repeat(length);
        motor.write("text", &text).unwrap();
        assert_eq!(fs::read_to_string(motor.path().join("text")).unwrap(), text + "\n");
    }
}

#[test]
fn an_attribute_that_does_not_exist_is_not_created() {
    let (_tree, _, motor) = motor_with(&[]);
    let error = motor.write("speed_sp", "5").unwrap_err();
    assert!(matches!(error, Error::Open { access: Access::Write, .. }));
    assert_eq!(error.errno(), Some(Errno::NOENT));
    assert!(!motor.path().join("speed_sp").exists());
}

#[test]
fn no_reader_sees_half_of_a_write() {
    let (_tree, _, motor) = motor_with(&[("speed_sp", "1")]);
    let numbers = [1, 22, 333, 4_444, 55_555, 666_666, -7_777_777, 88_888_888];
    let texts = numbers.map(|number| number.to_string());
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        for reader in 0..8 {
            let (motor, done, texts) = (&motor, &done, &texts);
            scope.spawn(move || {
                while !done.load(Ordering::Relaxed) {
                    if reader % 2 == 0 {
                        let number = motor.number("speed_sp").unwrap();
                        assert!(numbers.contains(&number), "read {number}");
                    } else {
                        let text = motor.text("speed_sp").unwrap();
                        assert!(texts.contains(&text), "read {text:?}");
                    }
                }
            });
        }
        let writers = [0, 1].map(|writer| {
            let motor = &motor;
            scope.spawn(move || {
                let end = Instant::now() + Duration::from_millis(300);
                for number in numbers.iter().cycle().skip(writer * 3) {
                    motor.write_number("speed_sp", *number).unwrap();
                    if Instant::now() >= end {
                        break;
                    }
                }
            })
        });
        for writer in writers {
            writer.join().unwrap();
        }
        done.store(true, Ordering::Relaxed);
    });
}

#[test]
fn numbers_are_decimal_and_whole_and_nothing_else() {
    let (_tree, _, motor) = motor_with(&[("position", "0")]);
    let path = motor.path().join("position");
    for (bytes, expected) in [
        (&b"12\n"[..], Some(12)),
        (b"-12\n", Some(-12)),
        (b"12", Some(12)),
        (b"2147483648\n", Some(2_147_483_648)),
        (b"9223372036854775808\n", None),
        (b"", None),
        (b"\n", None),
        (b" 12\n", None),
        (b"12 \n", None),
        (b"1.5\n", None),
        (b"0x10\n", None),
        (b"\xff\x00\xfe\n", None),
        (&[b'1'; 63], None),
        (&[b'1'; 64], None),
        (&[b'1'; 4096], None),
        (&[b'1'; 5000], None),
    ] {
        fs::write(&path, bytes).unwrap();
        match (motor.number("position"), expected) {
            (Ok(number), Some(expected)) => assert_eq!(number, expected),
            (Err(Error::Malformed { path: at, text, .. }), None) => {
                assert_eq!(at, path);
                assert!(text.chars().count() <= 64);
            }
            (other, _) => panic!("{bytes:?} is read as {other:?}"),
        }
    }
}

#[test]
fn texts_are_utf8_of_at_most_a_page() {
    let (_tree, _, motor) = motor_with(&[("text", "")]);
    let path = motor.path().join("text");
    let long = "y".repeat(4096);
    for text in ["", "a", "running ramping", "zwei\nZeilen", "grün", &long[..64], &long] {
        fs::write(&path, text).unwrap();
        assert_eq!(motor.text("text").unwrap(), text);
        assert_eq!(read_file(motor.tree(), &path).unwrap(), text);
    }
    for bytes in [&[b'y'; 4097][..], &[b'y'; 5000], b"\xff\n", b"gr\xc3"] {
        fs::write(&path, bytes).unwrap();
        assert!(matches!(motor.text("text"), Err(Error::Malformed { .. })));
        assert!(matches!(read_file(motor.tree(), &path), Err(Error::Malformed { .. })));
    }
}

#[test]
fn words_are_short() {
    let (_tree, _, motor) = motor_with(&[("state", "running stalled")]);
    let state = || motor.with_word("state", str::to_owned);
    assert_eq!(state().unwrap(), "running stalled");
    for bytes in [&[b's'; 64][..], b"\xff\n"] {
        fs::write(motor.path().join("state"), bytes).unwrap();
        assert!(matches!(state(), Err(Error::Malformed { .. })));
    }
    fs::write(motor.path().join("state"), "\n").unwrap();
    assert_eq!(state().unwrap(), "");
}

#[test]
fn a_directory_or_a_pipe_in_the_place_of_an_attribute_is_an_error_and_does_not_block() {
    let (_tree, _, motor) = motor_with(&[]);
    fs::create_dir(motor.path().join("directory")).unwrap();
    let pipe = motor.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    assert_eq!(motor.number("directory").unwrap_err().errno(), Some(Errno::ISDIR));
    assert_eq!(motor.write("directory", "1").unwrap_err().errno(), Some(Errno::ISDIR));
    assert_eq!(motor.number("pipe").unwrap_err().errno(), Some(Errno::SPIPE));
    assert_eq!(motor.write("pipe", "1").unwrap_err().errno(), Some(Errno::SPIPE));
}

#[test]
fn a_plain_file_announces_nothing() {
    let (tree, _, _) = motor_with(&[("state", "running")]);
    let files = SysfsDir::new(tree.root());
    let state = files.open(&tree.root().join("tacho-motor/motor0/state"), Access::Read).unwrap();
    let started = Instant::now();
    files.pause(&[&*state], files.now() + Duration::from_millis(5)).unwrap();
    assert!(started.elapsed() >= Duration::from_millis(5));
}

#[test]
fn an_error_names_the_file_and_leaves_the_reason_to_its_source() {
    let (_tree, _, motor) = motor_with(&[]);
    let error = motor.number("speed").unwrap_err();
    let path = motor.path().join("speed");
    assert_eq!((error.path(), error.errno()), (Some(&*path), Some(Errno::NOENT)));
    assert_eq!(error.to_string(), format!("cannot open {}", path.display()));
    let source = error.source().unwrap().to_string();
    assert!(source.starts_with("No such file"), "{source}");
    assert!(!error.to_string().contains(&source));
}

#[test]
fn a_malformed_file_is_an_error_that_shows_its_text_and_has_no_errno() {
    let (_tree, _, motor) = motor_with(&[("position", "here")]);
    let error = motor.number("position").unwrap_err();
    let path = motor.path().join("position");
    let expected = format!("{} holds \"here\", which is not an integer", path.display());
    assert_eq!(error.to_string(), expected);
    assert_eq!((error.path(), error.errno()), (Some(&*path), None));
    assert!(!error.is_stale() && !error.is_unplugged() && error.source().is_none());
}

#[test]
fn a_refused_access_says_which() {
    let (_tree, _, motor) = motor_with(&[("state", ""), ("command", "")]);
    let state = motor.path().join("state");
    fs::set_permissions(&state, fs::Permissions::from_mode(0o444)).unwrap();
    if fs::OpenOptions::new().write(true).open(&state).is_ok() {
        return; // The superuser may write anything.
    }
    let error = motor.write("state", "running").unwrap_err();
    assert!(matches!(error, Error::Open { access: Access::Write, .. }));
    assert_eq!(error.errno(), Some(Errno::ACCESS));
}

#[test]
fn a_refused_write_says_what_was_written() {
    let tree = crate::brick::Brick::new(&["outA"]);
    let devices = tree.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    let error = motor.write("speed_sp", "1051").unwrap_err();
    assert!(matches!(&error, Error::Write { text, .. } if text == "1051"));
    assert_eq!(error.errno(), Some(Errno::INVAL));
    let path = motor.path().join("speed_sp");
    assert_eq!(error.to_string(), format!("cannot write \"1051\" to {}", path.display()));
}

#[test]
fn any_file_can_be_read_and_written_but_none_created() {
    let tree = PlainTree::new();
    let devices = tree.devices();
    let path = tree.root().join("file");
    let missing = write_file(devices.tree(), &path, "5").unwrap_err();
    assert_eq!((missing.errno(), path.exists()), (Some(Errno::NOENT), false));
    fs::write(&path, "something longer\n").unwrap();
    write_file(devices.tree(), &path, "7.5").unwrap();
    assert_eq!(fs::read_to_string(&path).unwrap(), "7.5\n");
    assert_eq!(read_value(devices.tree(), &path).unwrap(), Value::Float(7.5));
    write_file(devices.tree(), std::path::Path::new("/dev/null"), "7.5").unwrap();
}

#[test]
fn an_attribute_by_name_is_a_number_a_fraction_or_a_text() {
    let attributes = [("position", "-5"), ("polarity", "normal"), ("commands", "stop reset")];
    let (tree, devices, motor) = motor_with(&attributes);
    let read = |name| attributes::read(&devices, &motor, name);
    assert_eq!(read("position").unwrap(), Some(Value::Integer(-5)));
    assert_eq!(read("polarity").unwrap(), Some(Value::Text("normal".into())));
    assert_eq!(read("commands").unwrap(), Some(Value::Text("stop reset".into())));
    assert_eq!(read("stop_action").unwrap_err().errno(), Some(Errno::NOENT));
    tree.unplug(Class::TachoMotor, "motor0");
    std::thread::sleep(Duration::from_millis(1));
    assert_eq!(read("position").unwrap(), None);
}

#[test]
fn an_attribute_that_is_a_number_must_hold_one() {
    let names = ["position", "speed_sp", "max_speed", "time_sp", "speed_pid/Kp", "value0"];
    for name in names {
        let tree = PlainTree::new();
        let class = if name == "value0" { Class::Sensor } else { Class::TachoMotor };
        let path = tree.plug(class, "device0", "port1", &[]);
        fs::create_dir(path.join("speed_pid")).unwrap();
        fs::write(path.join(name), "many\n").unwrap();
        let devices = tree.devices();
        let device = devices.find(class, "port1").unwrap().unwrap();
        let error = attributes::read(&devices, &device, name).unwrap_err();
        assert!(matches!(error, Error::Malformed { .. }), "{name}: {error}");
    }
}

#[test]
fn value_files_have_one_spelling_each() {
    let tree = PlainTree::new();
    tree.plug(Class::Sensor, "sensor0", "in1", &[("value1", "7"), ("num_values", "2")]);
    let devices = tree.devices();
    let sensor = devices.find(Class::Sensor, "in1").unwrap().unwrap();
    let read = |name| attributes::read(&devices, &sensor, name);
    assert_eq!(read("value1").unwrap(), Some(Value::Integer(7)));
    for name in ["value+1", "value01", "value8", "value"] {
        assert_eq!(read(name).unwrap_err().errno(), Some(Errno::NOENT), "{name}");
    }
}

#[test]
fn writing_an_attribute_of_an_absent_device_writes_nothing() {
    let (_tree, devices, motor) = motor_with(&[("speed_sp", "0")]);
    let write = |port, name, text| {
        attributes::write(&devices, Class::TachoMotor, port, name, text, &mut never)
    };
    assert_eq!(write("outB", "speed_sp", "5").unwrap(), None);
    assert_eq!(motor.number("speed_sp").unwrap(), 0);
    assert_eq!(write("outA", "speed_sp", "5").unwrap(), Some(()));
    assert_eq!(motor.number("speed_sp").unwrap(), 5);
    let absent = attributes::write(&devices, Class::Sensor, "in1", "mode", "TOUCH", &mut never);
    assert_eq!(absent.unwrap(), None);
}

#[test]
fn a_look_shows_numbers_and_short_texts_and_leaves_the_rest() {
    let tree = PlainTree::new();
    let path = tree.motor("motor0", "outA");
    let devices = tree.devices();
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    let looked = |name: &str| {
        attributes::look(&motor, name, |shown| {
            Some(match shown {
                Short::Integer(integer) => integer.to_string(),
                Short::Text(text) => format!("'{text}'"),
            })
        })
    };
    fs::write(path.join("position"), "-12\n").unwrap();
    fs::write(path.join("state"), "running\n").unwrap();
    fs::write(path.join("stop_actions"), "7\n").unwrap();
    fs::write(path.join("commands"), "x".repeat(100)).unwrap();
    fs::write(path.join("driver_name"), b"\xff\n").unwrap();
    assert_eq!(looked("position").as_deref(), Some("-12"));
    assert_eq!(looked("state").as_deref(), Some("'running'"));
    assert_eq!(looked("stop_actions").as_deref(), Some("7"));
    for other in ["commands", "driver_name", "missing"] {
        assert_eq!(looked(other), None, "{other}");
    }
    // What belongs there is a number: it may be about to be written.
    fs::write(path.join("position"), "").unwrap();
    assert_eq!(looked("position"), None);
}
