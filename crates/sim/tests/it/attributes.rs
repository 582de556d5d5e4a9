//! Every file of every class: mode bits, text after boot, what it refuses.
use crate::desk::{B, Desk};
use ev3_sim::{Access, Descriptor, Errno, FileKind, NodeId};

/// Name, mode, text after boot (None: a read fails with the errno that follows).
type Row = (&'static str, u16, Result<&'static str, Errno>);

const WRITE_ONLY: Result<&str, Errno> = Err(Errno::EACCES);

const TACHO: &[Row] = &[
    ("address", 0o444, Ok("ev3-ports:outB")),
    ("command", 0o220, WRITE_ONLY),
    (
        "commands",
        0o444,
        Ok("run-forever run-to-abs-pos run-to-rel-pos run-timed run-direct stop reset"),
    ),
    ("count_per_rot", 0o444, Ok("360")),
    ("driver_name", 0o444, Ok("lego-ev3-l-motor")),
    ("duty_cycle", 0o444, Ok("0")),
    ("duty_cycle_sp", 0o664, Ok("0")),
    ("hold_pid/Kd", 0o664, Ok("0")),
    ("hold_pid/Ki", 0o664, Ok("0")),
    ("hold_pid/Kp", 0o664, Ok("80000")),
    ("max_speed", 0o444, Ok("1050")),
    ("polarity", 0o664, Ok("normal")),
    ("position", 0o664, Ok("0")),
    ("position_sp", 0o664, Ok("0")),
    ("ramp_down_sp", 0o664, Ok("0")),
    ("ramp_up_sp", 0o664, Ok("0")),
    ("speed", 0o444, Ok("0")),
    ("speed_pid/Kd", 0o664, Ok("0")),
    ("speed_pid/Ki", 0o664, Ok("60")),
    ("speed_pid/Kp", 0o664, Ok("1000")),
    ("speed_sp", 0o664, Ok("0")),
    ("state", 0o444, Ok("")),
    ("stop_action", 0o664, Ok("coast")),
    ("stop_actions", 0o444, Ok("coast brake hold")),
    ("time_sp", 0o664, Ok("0")),
    ("uevent", 0o664, Ok("LEGO_DRIVER_NAME=lego-ev3-l-motor\nLEGO_ADDRESS=ev3-ports:outB")),
];

const COLOR: &[Row] = &[
    ("address", 0o444, Ok("ev3-ports:in2")),
    ("bin_data_format", 0o444, Ok("s8")),
    ("command", 0o220, WRITE_ONLY),
    ("commands", 0o444, Ok("")),
    ("decimals", 0o444, Ok("0")),
    ("direct", 0o664, Err(Errno::EOPNOTSUPP)),
    ("driver_name", 0o444, Ok("lego-ev3-color")),
    ("fw_version", 0o444, Ok("")),
    ("mode", 0o664, Ok("COL-REFLECT")),
    ("modes", 0o444, Ok("COL-REFLECT COL-AMBIENT COL-COLOR REF-RAW RGB-RAW COL-CAL")),
    ("num_values", 0o444, Ok("1")),
    ("poll_ms", 0o664, Err(Errno::EOPNOTSUPP)),
    ("text_value", 0o444, Err(Errno::EOPNOTSUPP)),
    ("uevent", 0o664, Ok("LEGO_DRIVER_NAME=lego-ev3-color\nLEGO_ADDRESS=ev3-ports:in2")),
    ("units", 0o444, Ok("pct")),
    ("value0", 0o444, Ok("92")),
    ("value1", 0o444, Err(Errno::ENXIO)),
    ("value7", 0o444, Err(Errno::ENXIO)),
];

const OUT_PORT: &[Row] = &[
    ("address", 0o444, Ok("ev3-ports:outB")),
    ("driver_name", 0o444, Ok("ev3-output-port")),
    ("mode", 0o664, Ok("auto")),
    ("modes", 0o444, Ok("auto tacho-motor dc-motor led raw")),
    ("set_device", 0o220, WRITE_ONLY),
    ("status", 0o444, Ok("tacho-motor")),
];

const IN_PORT: &[Row] = &[
    ("address", 0o444, Ok("ev3-ports:in1")),
    ("driver_name", 0o444, Ok("ev3-input-port")),
    ("mode", 0o664, Ok("auto")),
    (
        "modes",
        0o444,
        Ok("auto nxt-analog nxt-color nxt-i2c other-i2c ev3-analog ev3-uart other-uart raw"),
    ),
    ("set_device", 0o220, WRITE_ONLY),
    ("status", 0o444, Ok("ev3-uart")),
];

const LED: &[Row] = &[
    ("brightness", 0o664, Ok("255")),
    ("max_brightness", 0o444, Ok("255")),
    ("trigger", 0o664, Ok("[none] mmc0 timer heartbeat default-on transient rfkill0 ")),
];

const BATTERY: &[Row] = &[
    ("current_now", 0o444, Ok("170000")),
    ("scope", 0o444, Ok("System")),
    ("technology", 0o444, Ok("Li-ion")),
    ("type", 0o444, Ok("Battery")),
    ("voltage_max_design", 0o444, Ok("84000000")),
    ("voltage_min_design", 0o444, Ok("60000000")),
    ("voltage_now", 0o444, Ok("7975000")),
];

#[test]
fn modes_and_texts_after_boot() {
    let mut desk = Desk::new();
    let classes: &[(&str, &[Row])] = &[
        ("tacho-motor/motor1", TACHO),
        ("lego-sensor/sensor1", COLOR),
        ("lego-port/port5", OUT_PORT),
        ("lego-port/port0", IN_PORT),
        ("leds/led0:green:brick-status", LED),
        ("power_supply/lego-ev3-battery", BATTERY),
    ];
    for (directory, rows) in classes {
        for (name, mode, text) in *rows {
            let path = format!("{directory}/{name}");
            let node = desk.0.resolve(&path).unwrap_or_else(|error| panic!("{path}: {error:?}"));
            let stat = desk.0.stat(node).unwrap();
            assert_eq!(stat.mode, *mode, "{path}: {:o}", stat.mode);
            assert_eq!(stat.kind, FileKind::File);
            let expected = text.map(|text| format!("{text}\n"));
            assert_eq!(desk.try_get(&path), expected, "{path}");
            assert_eq!(desk.0.path(node).unwrap(), path);
        }
    }
}

#[test]
fn the_tables_above_are_complete() {
    let desk = Desk::new();
    let names = |rows: &[Row]| rows.iter().map(|row| row.0.to_owned()).collect::<Vec<_>>();
    assert_eq!(attributes(&desk, "tacho-motor/motor1"), names(TACHO));
    let mut color = names(COLOR);
    color.retain(|name| !name.starts_with("value"));
    color.insert(1, "bin_data".to_owned());
    color.extend((0..8).map(|index| format!("value{index}")));
    assert_eq!(attributes(&desk, "lego-sensor/sensor1"), color);
}

/// The attributes below a directory, with their directories.
fn attributes(desk: &Desk, directory: &str) -> Vec<String> {
    let node = desk.0.resolve(directory).unwrap();
    let mut names = Vec::new();
    for entry in desk.0.read_dir(node).unwrap() {
        if entry.kind == FileKind::Directory {
            let inner = desk.0.read_dir(entry.node).unwrap();
            names.extend(inner.iter().map(|file| format!("{}/{}", entry.name, file.name)));
        } else {
            names.push(entry.name);
        }
    }
    names
}

#[test]
fn writes_that_are_refused_change_nothing() {
    let mut desk = Desk::new();
    let einval = Errno::EINVAL;
    let cases: &[(&str, &str, Errno)] = &[
        ("command", "fly", einval),
        ("command", "Stop", einval),
        ("command", " stop", einval),
        ("command", "stop\n\n", einval),
        ("duty_cycle_sp", "101", einval),
        ("duty_cycle_sp", "-101", einval),
        ("duty_cycle_sp", "99999999999", Errno::ERANGE),
        ("hold_pid/Kp", "-1", einval),
        ("speed_pid/Ki", "-1", einval),
        ("polarity", "inverted", einval),
        ("position", "", einval),
        ("position", "1.5", einval),
        ("position", "2147483648", Errno::ERANGE),
        ("position_sp", "0x10", einval),
        ("ramp_up_sp", "-1", einval),
        ("ramp_up_sp", "60001", einval),
        ("ramp_down_sp", "60001", einval),
        ("speed_sp", "1051", einval),
        ("speed_sp", "-1051", einval),
        ("speed_sp", "4294967296", Errno::ERANGE),
        ("stop_action", "float", einval),
        ("time_sp", "-1", einval),
        ("time_sp", "5 ", einval),
        ("state", "running", Errno::EACCES),
        ("speed", "1", Errno::EACCES),
    ];
    for (name, text, errno) in cases {
        let path = format!("{B}{name}");
        let before = desk.try_get(&path);
        if text.is_empty() {
            assert_eq!(desk.try_put(&path, "\n"), Err(*errno), "{name} <- newline");
        } else {
            assert_eq!(desk.try_put(&path, text), Err(*errno), "{name} <- {text:?}");
        }
        assert_eq!(desk.try_get(&path), before, "{name} is as it was");
    }
    let others = [
        ("lego-sensor/sensor1/mode", "COL-COLOUR", einval),
        ("lego-sensor/sensor1/command", "RESET", einval),
        ("lego-sensor/sensor1/poll_ms", "100", Errno::EOPNOTSUPP),
        ("lego-sensor/sensor1/value0", "1", Errno::EACCES),
        ("lego-port/port5/mode", "ev3-uart", einval),
        ("lego-port/port0/set_device", "lego-ev3-us", Errno::EOPNOTSUPP),
        ("leds/led0:red:brick-status/brightness", "-1", einval),
        ("leds/led0:red:brick-status/brightness", "red", einval),
        ("leds/led0:red:brick-status/trigger", "disco", einval),
        ("power_supply/lego-ev3-battery/voltage_now", "9000000", Errno::EACCES),
    ];
    for (path, text, errno) in others {
        assert_eq!(desk.try_put(path, text), Err(errno), "{path} <- {text}");
    }
}

#[test]
fn writes_that_are_taken_read_back() {
    let mut desk = Desk::new();
    let cases = [
        ("speed_sp", "-1050"),
        ("position_sp", "-2147483648"),
        ("duty_cycle_sp", "-100"),
        ("time_sp", "2147483647"),
        ("ramp_up_sp", "60000"),
        ("ramp_down_sp", "1"),
        ("stop_action", "hold"),
        ("position", "12345"),
        ("speed_pid/Kp", "7"),
        ("hold_pid/Kd", "9"),
        ("polarity", "inversed"),
    ];
    for (name, text) in cases {
        desk.put(&format!("{B}{name}"), format!("{text}\n"));
        assert_eq!(desk.get(&format!("{B}{name}")), text);
    }
    desk.put(&format!("{B}command"), "reset");
    for (name, _, text) in TACHO {
        if *name != "command" {
            assert_eq!(desk.get(&format!("{B}{name}")), text.unwrap(), "{name} after reset");
        }
    }
}

#[test]
fn the_tree_answers_as_a_file_system() {
    let desk = Desk::new();
    let names = |path: &str| {
        let node = desk.0.resolve(path).unwrap();
        desk.0.read_dir(node).unwrap().into_iter().map(|entry| entry.name).collect::<Vec<_>>()
    };
    assert_eq!(
        names("/"),
        [
            "board-info",
            "dc-motor",
            "graphics",
            "lego-port",
            "lego-sensor",
            "leds",
            "power_supply",
            "servo-motor",
            "tacho-motor"
        ]
    );
    assert_eq!(names("tacho-motor"), ["motor0", "motor1", "motor2"]);
    assert_eq!(names("lego-port").len(), 8);
    assert_eq!(names("dc-motor"), [""; 0]);
    let open = |path: &str, access| desk.0.open(path, access).unwrap_err();
    assert_eq!(open("tacho-motor/motor9/state", Access::ReadOnly), Errno::ENOENT);
    assert_eq!(open("tacho-motor/motor0/state/x", Access::ReadOnly), Errno::ENOTDIR);
    assert_eq!(open("tacho-motor/motor0", Access::ReadOnly), Errno::EISDIR);
    assert_eq!(open("tacho-motor/motor0/state", Access::ReadWrite), Errno::EACCES);
    assert_eq!(open("tacho-motor/motor0/command", Access::ReadOnly), Errno::EACCES);
    assert!(desk.0.open("tacho-motor/motor0/speed_sp", Access::ReadWrite).is_ok());
    assert_eq!(desk.0.stat(NodeId::ROOT).unwrap().kind, FileKind::Directory);
    let size = |path: &str| desk.0.stat(desk.0.resolve(path).unwrap()).unwrap().size;
    assert_eq!(size("lego-sensor/sensor0/bin_data"), 32);
    assert_eq!(size("lego-sensor/sensor0/direct"), 255);
    assert_eq!(size("lego-sensor/sensor0/value0"), 4096);
}

#[test]
fn a_descriptor_reads_anew_but_where_it_stopped() {
    let mut desk = Desk::new();
    let mut file =
        Descriptor::open(&desk.0, "tacho-motor/motor1/driver_name", Access::ReadOnly).unwrap();
    let mut buffer = [0; 5];
    assert_eq!(file.pread(&mut desk.0, 0, &mut buffer), Ok(5));
    assert_eq!(&buffer, b"lego-");
    assert_eq!(file.pread(&mut desk.0, 5, &mut buffer), Ok(5));
    assert_eq!(&buffer, b"ev3-l");
    assert_eq!(file.pread(&mut desk.0, 17, &mut buffer), Ok(0));
    assert_eq!(file.pread(&mut desk.0, 99, &mut buffer), Ok(0));
    desk.put("tacho-motor/motor1/speed_sp", 123);
    let mut file =
        Descriptor::open(&desk.0, "tacho-motor/motor1/speed_sp", Access::ReadOnly).unwrap();
    assert_eq!(file.pread(&mut desk.0, 0, &mut buffer[..2]), Ok(2));
    desk.put("tacho-motor/motor1/speed_sp", 987);
    assert_eq!(file.pread(&mut desk.0, 2, &mut buffer), Ok(2), "the rest of the text");
    assert_eq!(&buffer[..2], b"3\n");
    assert_eq!(file.pread(&mut desk.0, 1, &mut buffer), Ok(3), "a new one");
    assert_eq!(&buffer[..3], b"87\n");
}

#[test]
fn a_write_takes_a_page_at_a_time() {
    let mut desk = Desk::new();
    let mut file =
        Descriptor::open(&desk.0, "tacho-motor/motor1/time_sp", Access::WriteOnly).unwrap();
    let written = file.write(&mut desk.0, &[b'0'; 5000]).unwrap();
    assert_eq!(written.outcome, Ok(4096));
}

#[test]
fn lights_blink_and_shine() {
    let mut desk = Desk::new();
    let led = "leds/led0:red:brick-status/";
    let file = |name: &str| format!("{led}{name}");
    desk.put(&file("brightness"), "1000");
    assert_eq!(desk.get(&file("brightness")), "255");
    assert_eq!(desk.try_get(&file("delay_on")), Err(Errno::ENOENT));
    desk.put(&file("trigger"), "timer\n");
    assert_eq!(desk.get(&file("delay_on")), "500");
    assert_eq!(desk.try_put(&file("delay_off"), "100"), Err(Errno::EACCES), "udev comes later");
    desk.put(&file("brightness"), "200");
    desk.step(500);
    desk.put(&file("delay_off"), "100");
    assert_eq!(desk.get(&file("delay_off")), "100");
    assert!(desk.get(&file("trigger")).contains("[timer]"));
    desk.put(&file("brightness"), "0");
    assert!(desk.get(&file("trigger")).starts_with("[none]"));
    assert_eq!(desk.try_get(&file("delay_off")), Err(Errno::ENOENT));
    desk.put(&file("trigger"), "timer");
    assert_eq!(desk.get(&file("brightness")), "200", "as bright as it blinked before");
    let file = |name: &str| format!("leds/led1:red:brick-status/{name}");
    desk.put(&file("trigger"), "timer");
    assert_eq!(
        desk.get(&file("brightness")),
        "255",
        "a light that was off blinks at its brightest"
    );
}

#[test]
fn the_end_of_a_trigger_switches_a_light_off_and_no_trigger_has_no_end() {
    let mut desk = Desk::new();
    let file = |name: &str| format!("leds/led0:green:brick-status/{name}");
    desk.put(&file("trigger"), "none");
    assert_eq!(desk.get(&file("brightness")), "255");
    for (trigger, brightness) in
        [("default-on", "255"), ("transient", "0"), ("default-on", "255"), ("none", "0")]
    {
        desk.put(&file("trigger"), trigger);
        assert_eq!(desk.get(&file("brightness")), brightness, "{trigger}");
    }
}

#[test]
fn a_light_that_blinks_anew_forgets_its_times() {
    let mut desk = Desk::new();
    let file = |name: &str| format!("leds/led0:green:brick-status/{name}");
    let mut times = |on: &str, off: &str| {
        desk.put(&file("trigger"), "timer");
        desk.step(500);
        desk.put(&file("delay_on"), on);
        desk.put(&file("delay_off"), off);
        ["delay_on", "delay_off", "brightness"].map(|name| desk.get(&file(name)))
    };
    assert_eq!(times("100", "200"), ["100", "200", "255"]);
    assert_eq!(times("0", "0"), ["500", "500", "255"], "both at 0 are half a second each");
    assert_eq!(times("0", "7"), ["0", "7", "0"], "never on");
    desk.put(&file("trigger"), "timer");
    assert_eq!(desk.get(&file("delay_off")), "500");
}
