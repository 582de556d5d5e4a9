//! Sensors of the NXT and of other makers, beacons and remote controls.
use crate::desk::{B, C, Desk};
use crate::robots::{default_robot, touch_robot};
use ev3_sim::{
    Access, Descriptor, Errno, Item, Machine, Options, Port, Pose, RemoteButton, WorldSpec,
};
use std::time::Duration;

const SENSOR: &str = "lego-sensor/sensor3/";

/// A desk with a sensor of a kind on in4 that looks ahead from the middle of the axle, in a world
/// with these things.
fn desk(driver: &str, items: Vec<Item>) -> Desk {
    desk_in(driver, &WorldSpec { items, ..WorldSpec::default() })
}

fn desk_in(driver: &str, world: &WorldSpec) -> Desk {
    let mut robot = default_robot();
    driver.clone_into(&mut robot.sensors[3].driver);
    let mut desk = Desk::with(world, &robot);
    let is_known = matches!(driver, "lego-nxt-light" | "lego-nxt-touch");
    if desk.get("lego-port/port3/status") == "nxt-analog" && !is_known {
        assert_eq!(desk.get(&format!("{SENSOR}driver_name")), "nxt-analog");
        desk.put("lego-port/port3/set_device", driver);
        assert_eq!(desk.try_get(&format!("{SENSOR}mode")), Err(Errno::ENOENT));
    }
    // Until udev has opened its files, and it was polled.
    desk.step(700);
    desk
}

/// The directory of the sensor on in4, whatever its number.
fn sensor(desk: &mut Desk) -> String {
    let found = [SENSOR, "lego-sensor/sensor4/"]
        .into_iter()
        .find(|path| desk.try_get(&format!("{path}mode")).is_ok());
    found.expect("a sensor").to_owned()
}

fn get(desk: &mut Desk, attribute: &str) -> String {
    let path = sensor(desk) + attribute;
    desk.get(&path)
}

fn values(desk: &mut Desk, mode: &str) -> Vec<i32> {
    let path = sensor(desk);
    if desk.get(&format!("{path}mode")) != mode {
        desk.put(&format!("{path}mode"), mode);
        desk.step(1200);
    }
    let count = desk.number(&format!("{path}num_values")).min(8);
    (0..count).map(|index| desk.number(&format!("{path}value{index}"))).collect()
}

fn bytes(desk: &mut Desk) -> Vec<u8> {
    let path = sensor(desk) + "bin_data";
    let node = desk.0.open(&path, ev3_sim::Access::ReadOnly).unwrap();
    desk.0.read(node).unwrap()
}

#[test]
fn every_mode_says_what_the_sheet_says() {
    let (_, section) =
        include_str!("../../../../docs/ev3dev-sysfs.md").split_once("### 5.5").unwrap();
    for row in section.split("---\n").next().unwrap().lines().filter(|row| row.starts_with("| `")) {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        let (name, modes) = (cells[1].trim_matches('`'), cells[2]);
        let (driver, bus) = name.split_once(':').map_or((name, ""), |(driver, bus)| (driver, bus));
        let mut desk = desk(driver, vec![]);
        let address = if bus.is_empty() { String::new() } else { format!(":{bus}") };
        assert_eq!(get(&mut desk, "driver_name"), driver);
        assert_eq!(get(&mut desk, "address"), format!("ev3-ports:in4{address}"));
        assert!(get(&mut desk, "uevent").ends_with(&format!("in4{address}")), "{driver}");
        let has_version = !bus.is_empty() && driver != "lego-nxt-temp";
        assert_eq!(get(&mut desk, "fw_version"), if has_version { "V1.0" } else { "" });
        let modes: Vec<Vec<&str>> =
            modes.split(';').map(|mode| mode.split_whitespace().collect()).collect();
        let names: Vec<&str> = modes.iter().map(|mode| mode[0]).collect();
        assert_eq!(get(&mut desk, "modes"), names.join(" "));
        assert_eq!(get(&mut desk, "mode"), names[0], "the first is the default");
        for mode in modes {
            let shown = values(&mut desk, mode[0]);
            let known = [
                get(&mut desk, "num_values"),
                get(&mut desk, "decimals"),
                get(&mut desk, "units").replace('\0', ""),
                get(&mut desk, "bin_data_format"),
            ];
            let expected = [mode[1], mode[2], mode[3].trim_matches('-'), mode[4]];
            assert_eq!(known, expected, "{driver} {}", mode[0]);
            assert_eq!(bytes(&mut desk).len(), 32);
            let path = sensor(&mut desk);
            let beyond = desk.try_get(&format!("{path}value{}", shown.len()));
            assert!(shown.len() == 8 || beyond == Err(Errno::ENXIO));
        }
    }
}

#[test]
fn light_is_a_voltage_that_falls() {
    let mut desk = desk("lego-nxt-light", vec![]);
    assert_eq!(get(&mut desk, "driver_name"), "lego-nxt-light", "recognized when plugged in");
    assert_eq!(values(&mut desk, "REFLECT"), [922]);
    let data = bytes(&mut desk);
    let millivolts = i32::from_le_bytes(data[..4].try_into().unwrap());
    assert_eq!((millivolts - 4116) * 1000 / (543 - 4116), 922, "{millivolts} mV");
    assert_eq!(values(&mut desk, "AMBIENT"), [20], "the light from everywhere");
    let black = Item::rectangle([-50.0, -50.0], [50.0, 50.0], ev3_sim::Color::BLACK);
    desk.0.add_item(black).unwrap();
    assert!(values(&mut desk, "REFLECT")[0] < 100);
}

#[test]
fn silence_is_a_high_voltage() {
    let world = |loudness| WorldSpec { loudness, ..WorldSpec::default() };
    assert_eq!(values(&mut desk_in("lego-nxt-sound", &world(0.0)), "DB"), [1000]);
    assert_eq!(values(&mut desk_in("lego-nxt-sound", &world(30.0)), "DBA"), [700]);
}

#[test]
fn temperature_is_that_of_the_world() {
    let world = WorldSpec { temperature: -4.5, ..WorldSpec::default() };
    assert_eq!(values(&mut desk("lego-nxt-temp", vec![]), "NXT-TEMP-C"), [215]);
    let mut cold = desk_in("lego-nxt-temp", &world);
    assert_eq!(values(&mut cold, "NXT-TEMP-C"), [-45]);
    let raw = i16::from_be_bytes(bytes(&mut cold)[..2].try_into().unwrap());
    assert_eq!((i32::from(raw) + 14080) * 1830 / 46847 - 550, -45);
    assert_eq!(values(&mut cold, "NXT-TEMP-F"), [239]);
    assert_eq!(values(&mut desk_in("ht-nxt-barometric", &world), "TEMP"), [-45]);
    assert_eq!(values(&mut desk_in("ms-ir-thermometer", &world), "TARGET-C"), [-450]);
}

#[test]
fn a_compass_points_to_where_y_grows() {
    for driver in ["ht-nxt-compass", "ms-absolute-imu"] {
        let mut desk = desk(driver, vec![]);
        for (heading, expected) in [(0.0, 0), (90.0, 90), (-90.0, 270), (359.7, 0), (725.0, 5)] {
            desk.0.place(Pose::new(0.0, 0.0, heading)).unwrap();
            desk.step(200);
            assert_eq!(values(&mut desk, "COMPASS"), [expected], "{driver} at {heading}");
        }
    }
}

#[test]
fn what_is_on_the_bus_is_polled() {
    let mut desk = desk("ht-nxt-compass", vec![]);
    assert_eq!(get(&mut desk, "poll_ms"), "100");
    desk.step(50);
    desk.0.place(Pose::new(0.0, 0.0, 45.0)).unwrap();
    assert_eq!(values(&mut desk, "COMPASS"), [0], "until the next poll");
    desk.step(100);
    assert_eq!(values(&mut desk, "COMPASS"), [45]);
    let path = sensor(&mut desk);
    desk.put(&format!("{path}poll_ms"), "0");
    desk.0.place(Pose::new(0.0, 0.0, 90.0)).unwrap();
    desk.step(5000);
    assert_eq!(values(&mut desk, "COMPASS"), [45], "never again");
    let blocks = desk.try_put(&format!("{path}mode"), "COMPASS");
    assert_eq!(blocks, Ok(Duration::from_millis(4)), "one message");
    assert_eq!(values(&mut desk, "COMPASS"), [90], "but when the mode is written");
    desk.0.place(Pose::new(0.0, 0.0, 120.0)).unwrap();
    desk.put(&format!("{path}poll_ms"), "60000");
    desk.step(10);
    assert_eq!(values(&mut desk, "COMPASS"), [120], "polling begins at once");
    desk.0.place(Pose::new(0.0, 0.0, 150.0)).unwrap();
    desk.step(1000);
    desk.put(&format!("{path}poll_ms"), "100");
    desk.step(1000);
    assert_eq!(values(&mut desk, "COMPASS"), [120], "the period under way lasts");
    desk.step(58_000);
    assert_eq!(values(&mut desk, "COMPASS"), [150]);
    desk.0.place(Pose::new(0.0, 0.0, 180.0)).unwrap();
    desk.step(50);
    desk.put(&format!("{path}mode"), "COMPASS");
    desk.step(10);
    assert_eq!(values(&mut desk, "COMPASS"), [180], "a period begins as the mode is written");
    desk.0.place(Pose::new(0.0, 0.0, 210.0)).unwrap();
    desk.step(90);
    assert_eq!(values(&mut desk, "COMPASS"), [180]);
    desk.step(10);
    assert_eq!(values(&mut desk, "COMPASS"), [210]);
    assert_eq!(desk.try_put(&format!("{path}poll_ms"), "soon"), Err(Errno::EINVAL));
    desk.put(&format!("{path}poll_ms"), "2147483648");
    assert_eq!(desk.try_get(&format!("{path}poll_ms")), Err(Errno::EINVAL), "stored as below 0");
    desk.put(&format!("{path}poll_ms"), "4294967295");
    assert_eq!(desk.try_get(&format!("{path}poll_ms")), Err(Errno::EPERM));
    desk.put(&format!("{path}poll_ms"), "100");
    assert_eq!(
        get(&mut desk, "poll_ms"),
        "100",
        "a number that looks like an error can be written over"
    );
    assert_eq!(get(&mut self::desk("ms-nxtmmx", vec![]), "poll_ms"), "1000");
    let mut serial = self::desk("lego-ev3-ir", vec![]);
    assert_eq!(serial.try_put(&format!("{SENSOR}poll_ms"), "50"), Err(Errno::EOPNOTSUPP));
}

#[test]
fn without_polling_a_new_mode_shows_what_it_showed_last() {
    let mut desk = desk("ms-ir-thermometer", vec![]);
    let path = sensor(&mut desk);
    desk.put(&format!("{path}poll_ms"), "0");
    desk.put(&format!("{path}mode"), "TARGET-F");
    desk.step(100);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "read in the mode before");
    desk.put(&format!("{path}mode"), "TARGET-F");
    desk.step(100);
    assert_eq!(desk.number(&format!("{path}value0")), 7070);
}

#[test]
fn the_nxt_sonar_counts_centimeters() {
    let mut desk = desk("lego-nxt-us", vec![Item::wall([-100.0, 80.7], [100.0, 80.7])]);
    assert_eq!(values(&mut desk, "US-DIST-CM"), [80]);
    assert_eq!(values(&mut desk, "US-DIST-IN"), [80 * 1000 / 255]);
    desk.0.place(Pose::new(0.0, 0.0, 180.0)).unwrap();
    desk.step(200);
    assert_eq!(values(&mut desk, "US-DIST-CM"), [255], "nothing there");
    assert_eq!(values(&mut desk, "US-SI-CM"), [255]);
    desk.0.place(Pose::new(0.0, 0.0, 0.0)).unwrap();
    desk.step(500);
    assert_eq!(values(&mut desk, "US-SI-CM"), [255], "a single shot");
    let path = sensor(&mut desk);
    desk.put(&format!("{path}mode"), "US-SI-CM");
    desk.step(20);
    assert_eq!(values(&mut desk, "US-SI-CM"), [80]);
}

#[test]
fn hitechnic_sees_colors_by_its_own_numbers() {
    for (name, number, rgb) in [("white", 17, None), ("black", 0, None), ("red", 8, Some(0))] {
        let floor = WorldSpec { floor: name.parse().unwrap(), ..WorldSpec::default() };
        let mut first = desk_in("ht-nxt-color", &floor);
        let all = values(&mut first, "ALL");
        assert_eq!(all[0], number, "{name}: {all:?}");
        assert_eq!(values(&mut first, "RED")[0], all[1]);
        assert_eq!(values(&mut first, "BLUE")[0], all[3]);
        let mut second = desk_in("ht-nxt-color-v2", &floor);
        assert_eq!(values(&mut second, "COLOR"), [number]);
        let parts = values(&mut second, "RGB");
        assert_eq!(parts[..3], all[1..]);
        assert_eq!(parts[3], parts[..3].iter().sum::<i32>() / 3);
        let normal = values(&mut second, "NORM");
        if let Some(strongest) = rgb {
            assert_eq!(normal[strongest], 255);
        }
        let raw = values(&mut second, "RAW");
        let data = bytes(&mut second);
        let red = i16::from_be_bytes([data[0], data[1]]);
        assert_eq!(i32::from(red), raw[0]);
    }
}

#[test]
fn a_level_accelerometer_feels_one_g_downwards() {
    let mut hitechnic = desk("ht-nxt-accel", vec![]);
    let all = values(&mut hitechnic, "ALL");
    assert_eq!(all[2] * 4 + all[5], 200);
    assert_eq!([all[0], all[1], all[3], all[4]], [0; 4]);
    assert_eq!(values(&mut desk("ms-absolute-imu", vec![]), "ACCEL"), [0, 0, 1000]);
    assert_eq!(values(&mut desk("mi-xg1300l", vec![]), "ALL"), [0, 0, 0, 0, 1000]);
}

#[test]
fn gyros_of_other_makers_turn_with_the_robot() {
    for (driver, mode, index, unit) in [
        ("ht-nxt-gyro", "GYRO", 0, 1),
        ("ms-absolute-imu", "GYRO", 2, 10),
        ("mi-xg1300l", "SPEED", 0, 100),
    ] {
        let mut desk = desk(driver, vec![]);
        for (motor, speed) in [(B, 200), (C, -200)] {
            desk.run(motor, &[("speed_sp", speed)], "run-forever");
        }
        desk.step(2000);
        // 200 counts/s on 5.6 cm wheels, 10.6 cm apart.
        let rate = values(&mut desk, mode)[index];
        assert!((102 * unit..=109 * unit).contains(&rate), "{driver} {rate}");
    }
}

#[test]
fn an_angle_sensor_sits_on_the_left_wheels_axle() {
    let mut hitechnic = desk("ht-nxt-angle", vec![]);
    let mut glider = desk("ms-angle", vec![]);
    for desk in [&mut hitechnic, &mut glider] {
        assert_eq!(values(desk, "SPEED"), [0]);
        for motor in [B, C] {
            desk.run(motor, &[("position_sp", 500), ("speed_sp", 600)], "run-to-rel-pos");
        }
        desk.step(500);
    }
    let near = |value: i32, expected: i32| {
        assert!((value - expected).abs() <= expected / 50 + 3, "{value} not {expected}");
    };
    near(values(&mut hitechnic, "SPEED")[0], 100);
    hitechnic.step(2000);
    let turned = values(&mut hitechnic, "ANGLE-ACC")[0];
    let shaft = hitechnic.0.shaft_angle(ev3_sim::Port::OutB);
    assert!(turned > 480 && (f64::from(turned) - shaft).abs() < 1.0, "{turned} {shaft}");
    let angle = turned.rem_euclid(360);
    assert_eq!(values(&mut hitechnic, "ANGLE"), [angle]);
    let data = bytes(&mut hitechnic);
    assert_eq!(i32::from(data[0]) * 2 + i32::from(data[1]), angle);
    glider.step(2000);
    near(values(&mut glider, "ANGLE2")[0], turned * 10);
    let all = values(&mut glider, "ALL");
    assert!((all[1] - all[0] * 2).abs() <= 1, "{all:?}");
    for (desk, after) in [(&mut hitechnic, "ANGLE-ACC"), (&mut glider, "ANGLE")] {
        let path = sensor(desk);
        assert!(desk.get(&format!("{path}commands")).contains("RESET"));
        desk.put(&format!("{path}command"), "RESET");
        desk.step(200);
        assert_eq!(values(desk, after), [0]);
    }
    assert_eq!(values(&mut hitechnic, "ANGLE"), [angle]);
    let path = sensor(&mut hitechnic);
    hitechnic.put(&format!("{path}command"), "CAL");
    hitechnic.step(200);
    assert_eq!(values(&mut hitechnic, "ANGLE"), [0]);
    assert_eq!(hitechnic.try_put(&format!("{path}command"), "JUMP"), Err(Errno::EINVAL));
}

#[test]
fn a_proximity_detector_sees_what_is_near() {
    for (distance, long, short) in [(10.0, 35, 7), (20.0, 17, 3), (40.0, 0, 0)] {
        let at = distance + 0.5;
        let mut desk = desk("ht-nxt-eopd", vec![Item::wall([-50.0, at], [50.0, at])]);
        let seen = [values(&mut desk, "LONG")[0], values(&mut desk, "SHORT")[0]];
        assert!((seen[0] - long).abs() <= 1 && (seen[1] - short).abs() <= 1, "{seen:?}");
    }
    let mut light = desk("ms-tof", vec![Item::wall([-50.0, 80.5], [50.0, 80.5])]);
    assert_eq!(values(&mut light, "DIST"), [800]);
}

#[test]
fn a_row_of_lights_finds_the_line() {
    let line = |x: f64| Item::Line {
        points: vec![[x, -50.0], [x, 50.0]],
        width: 1.0,
        color: ev3_sim::Color::BLACK,
    };
    let steer = |x: f64| values(&mut desk("ms-line-leader", vec![line(x)]), "PID-ALL");
    assert_eq!(steer(30.0), [0, 0, 0], "no line");
    let (left, right) = (steer(-2.2), steer(2.2));
    assert!(left[0] < -50 && right[0] > 50 && left[0] == -right[0], "{left:?} {right:?}");
    assert_eq!((left[1], right[1]), (20, 70));
    assert_eq!((left[2], right[2]), (0b10, 0b100_0000));
    let mut array = desk("ms-light-array", vec![line(-3.2)]);
    let row = values(&mut array, "CAL");
    assert!(row[0] < 20 && row[1..].iter().all(|percent| *percent > 90), "{row:?}");
}

#[test]
fn a_beacon_is_seen_where_it_is() {
    let beacon = |x: f64, y: f64, channel| Item::Beacon { at: [x, y], channel };
    let mut desk = desk("lego-ev3-ir", vec![beacon(0.0, 100.0, 1), beacon(50.0, 50.0, 3)]);
    let seen = values(&mut desk, "IR-SEEK");
    assert_eq!(seen[..2], [0, 50]);
    assert_eq!(seen[2..4], [0, -128], "nothing on channel 2");
    assert_eq!(seen[4..6], [19, 35], "45 of 60 degrees to the right");
    assert_eq!(values(&mut desk, "IR-REMOTE"), [9, 0, 9, 0], "its button is on");
    desk.0.place(Pose::new(0.0, 0.0, 180.0)).unwrap();
    assert_eq!(values(&mut desk, "IR-SEEK")[..2], [0, -128], "behind it");
    desk.0.place(Pose::new(0.0, 0.0, 0.0)).unwrap();
    desk.0.add_item(Item::circle([0.0, 70.0], 5.0)).unwrap();
    assert_eq!(values(&mut desk, "IR-SEEK")[..2], [0, -128], "hidden");
    let far = values(&mut self::desk("lego-ev3-ir", vec![beacon(0.0, 210.0, 2)]), "IR-SEEK");
    assert_eq!(far, [0, -128, 0, -128, 0, -128, 0, -128]);
    assert!(desk.0.svg().contains("class=\"beacon channel3\""));
    assert!(desk.0.add_item(beacon(0.0, 0.0, 5)).is_err());
}

#[test]
fn hitechnics_seeker_tells_nine_directions() {
    for (x, y, direction) in
        [(0.0, 80.0, 5), (80.0, 0.0, 8), (-80.0, 0.0, 2), (40.0, 69.0, 6), (0.0, -80.0, 0)]
    {
        let mut desk = desk("ht-nxt-ir-seek-v2", vec![Item::Beacon { at: [x, y], channel: 1 }]);
        assert_eq!(values(&mut desk, "AC"), [direction], "{x} {y}");
        let all = values(&mut desk, "DC-ALL");
        assert_eq!(all[0], direction);
        assert_eq!(all[6], all[1..6].iter().sum::<i32>() / 5);
        if direction == 5 {
            assert!(all[3] > all[2] && all[2] == all[4] && all[1] == 0, "{all:?}");
        }
    }
}

#[test]
fn a_remote_control_is_heard_everywhere() {
    let mut desk = desk("lego-ev3-ir", vec![]);
    desk.0.hold_buttons(2, &[RemoteButton::BlueDown, RemoteButton::RedUp]).unwrap();
    assert_eq!(values(&mut desk, "IR-REMOTE"), [0, 6, 0, 0]);
    assert_eq!(values(&mut desk, "IR-REM-A"), [384]);
    desk.0.hold_buttons(1, &[RemoteButton::RedDown]).unwrap();
    desk.step(2);
    assert_eq!(values(&mut desk, "IR-REM-A"), [256 + 32]);
    desk.0.hold_buttons(2, &[]).unwrap();
    assert_eq!(values(&mut desk, "IR-REMOTE"), [2, 0, 0, 0]);
    desk.step(2);
    let error = desk.0.hold_buttons(0, &[]).unwrap_err();
    assert!(error.to_string().contains("channel 0"), "{error}");
    assert!(desk.0.hold_buttons(5, &[]).is_err());
    let all = [RemoteButton::RedUp, RemoteButton::BlueUp, RemoteButton::BlueDown];
    assert!(desk.0.hold_buttons(1, &all).is_err());
    assert_eq!(values(&mut desk, "IR-REMOTE"), [2, 0, 0, 0], "nothing was changed");
}

#[test]
fn registers_of_the_bus_can_be_read() {
    let mut desk = desk("ht-nxt-compass", vec![]);
    let path = sensor(&mut desk) + "direct";
    let node = desk.0.open(&path, ev3_sim::Access::ReadOnly).unwrap();
    let registers = desk.0.read(node).unwrap();
    assert_eq!(&registers[..4], b"V1.0");
    assert_eq!(&registers[8..16], b"HITECHNC");
    assert_eq!(&registers[16..23], b"Compass");
    assert_eq!(registers.len(), 255);
}

#[test]
fn registers_are_read_and_written_at_their_offsets() {
    let mut desk = desk("ht-nxt-compass", vec![]);
    let path = sensor(&mut desk) + "direct";
    let mut file = Descriptor::open(&desk.0, &path, Access::ReadWrite).unwrap();
    let mut reader = file.clone();
    let mut read = |desk: &mut Desk, offset, count| {
        let mut bytes = vec![0xff; count];
        let length = reader.pread(&mut desk.0, offset, &mut bytes).unwrap();
        bytes.truncate(length);
        bytes
    };
    assert_eq!(read(&mut desk, 0x08, 8), b"HITECHNC");
    assert_eq!(read(&mut desk, 0x10, 8), b"Compass\0");
    let mut write = |desk: &mut Desk, offset, bytes: &[u8]| {
        let written = file.pwrite(&mut desk.0, offset, bytes)?;
        written.outcome
    };
    assert_eq!(write(&mut desk, 0x41, &[0x43]), Ok(1));
    assert_eq!(write(&mut desk, 0x80, &[1, 2, 3]), Ok(3));
    assert_eq!(write(&mut desk, 0x81, &[9]), Ok(1));
    assert_eq!(read(&mut desk, 0x41, 1), [0x43]);
    assert_eq!(read(&mut desk, 0x80, 4), [1, 9, 3, 0]);
    // What it is and what it measures stays.
    assert_eq!(write(&mut desk, 0x08, b"nobody's"), Ok(8));
    assert_eq!(write(&mut desk, 0x42, &[7; 4]), Ok(4));
    assert_eq!(read(&mut desk, 0x08, 8), b"HITECHNC");
    assert_eq!(read(&mut desk, 0x42, 4), [0; 4]);
    // A message has 32 bytes, whatever was asked for; the file ends before the last register.
    assert_eq!(write(&mut desk, 0x80, &[5; 40]), Ok(40));
    assert_eq!(read(&mut desk, 0x9f, 2), [5, 0]);
    assert_eq!(read(&mut desk, 0x80, 40), [vec![5; 32], vec![0; 8]].concat());
    assert_eq!(write(&mut desk, 250, &[6; 9]), Ok(5));
    assert_eq!(read(&mut desk, 250, 9), [6; 5]);
    assert_eq!(read(&mut desk, 255, 1), []);
    assert_eq!(write(&mut desk, 255, &[1]), Err(Errno::EFBIG));
    desk.0.show(ev3_sim::Port::In4, "direct", "another sensor").unwrap();
    assert_eq!(read(&mut desk, 8, 99), b"sensor\n");
    let events = desk.0.trace().events();
    assert!(events.iter().any(|event| event.text == "128: [1, 2, 3]"), "{events:?}");
}

#[test]
fn what_is_not_on_the_bus_has_no_registers() {
    for (driver, read, written) in [
        ("lego-ev3-us", Errno::EOPNOTSUPP, Errno::EINVAL),
        ("lego-nxt-light", Errno::EOPNOTSUPP, Errno::EOPNOTSUPP),
    ] {
        let mut desk = desk(driver, vec![]);
        let path = sensor(&mut desk) + "direct";
        let mut file = Descriptor::open(&desk.0, &path, Access::ReadWrite).unwrap();
        assert_eq!(file.pread(&mut desk.0, 8, &mut [0; 8]), Err(read), "{driver}");
        let at_8 = file.pwrite(&mut desk.0, 8, &[1]).unwrap_err();
        assert_eq!(at_8, written, "{driver}");
    }
}

#[test]
fn ports_tell_what_they_detect_and_wait_for_it_to_boot() {
    let mut desk = Desk::new();
    let plug = |desk: &mut Desk, driver: &str| {
        desk.0.unplug(ev3_sim::Port::In1);
        desk.step(200);
        desk.0.plug(ev3_sim::Port::In1, driver).unwrap();
    };
    plug(&mut desk, "ht-nxt-compass");
    desk.step(1350);
    assert_eq!(desk.get("lego-port/port0/status"), "nxt-i2c");
    assert_eq!(desk.try_get("lego-sensor/sensor4/mode"), Err(Errno::ENOENT), "booting");
    desk.step(50);
    assert_eq!(desk.get("lego-sensor/sensor4/address"), "ev3-ports:in1:i2c1");
    assert_eq!(desk.get("lego-port/port0/status"), "nxt-i2c");
    let set_device = "lego-port/port0/set_device";
    assert_eq!(desk.try_put(set_device, "lego-nxt-touch"), Err(Errno::EOPNOTSUPP));
    plug(&mut desk, "lego-nxt-touch");
    desk.step(400);
    assert_eq!(desk.get("lego-port/port0/status"), "nxt-analog");
    assert_eq!(desk.get("lego-sensor/sensor5/driver_name"), "lego-nxt-touch");
    desk.put(set_device, "lego-nxt-touch");
    assert_eq!(desk.get("lego-sensor/sensor6/driver_name"), "lego-nxt-touch");
    desk.put(set_device, "ht-nxt-compass");
    assert_eq!(desk.try_get("lego-sensor/sensor7/mode"), Err(Errno::ENOENT), "no driver for that");
    plug(&mut desk, "ht-nxt-compass");
    desk.put("lego-port/port0/mode", "nxt-i2c");
    assert_eq!(desk.get("lego-sensor/sensor7/driver_name"), "ht-nxt-compass");
}

#[test]
fn impossible_worlds_are_refused() {
    let impossible = [
        WorldSpec { temperature: -300.0, ..WorldSpec::default() },
        WorldSpec { temperature: f64::NAN, ..WorldSpec::default() },
        WorldSpec { loudness: 101.0, ..WorldSpec::default() },
    ];
    for world in impossible {
        assert!(Machine::new(&world, &default_robot(), Options::default()).is_err());
    }
}

#[test]
fn a_pressed_nxt_touch_sensor_wakes_who_waits() {
    let mut robot = touch_robot();
    "lego-nxt-touch".clone_into(&mut robot.sensors[3].driver);
    let world = WorldSpec {
        items: vec![Item::wall([-100.0, 30.0], [100.0, 30.0])],
        ..WorldSpec::default()
    };
    let mut desk = Desk::with(&world, &robot);
    desk.step(20);
    let path = "lego-sensor/sensor3/value0";
    assert_eq!(desk.number(path), 0);
    let node = desk.0.resolve(path).unwrap();
    let before = desk.0.event_count(node).unwrap();
    for motor in [B, C] {
        desk.run(motor, &[("speed_sp", 400)], "run-forever");
    }
    desk.0.step(Duration::from_secs(2));
    assert_eq!(desk.number(path), 1);
    assert!(desk.0.event_count(node).unwrap() > before);
    // A port that looks at it while it is pressed does not know it.
    desk.0.unplug(ev3_sim::Port::In4);
    desk.step(200);
    desk.0.plug(ev3_sim::Port::In4, "lego-nxt-touch").unwrap();
    desk.step(400);
    assert_eq!(desk.get("lego-port/port3/status"), "nxt-analog");
    assert_eq!(desk.try_get("lego-sensor/sensor4/mode"), Err(Errno::ENOENT));
    desk.put("lego-port/port3/set_device", "lego-nxt-touch");
    assert_eq!(desk.number("lego-sensor/sensor4/value0"), 1);
}

#[test]
fn sensors_of_the_nxt_have_errors_if_they_are_asked_for() {
    for (driver, mode) in [("lego-nxt-us", "US-DIST-CM"), ("ht-nxt-compass", "COMPASS")] {
        let mut robot = default_robot();
        driver.clone_into(&mut robot.sensors[3].driver);
        let wall = vec![Item::wall([-100.0, 100.5], [100.0, 100.5])];
        let world = WorldSpec { items: wall, ..WorldSpec::default() };
        let mut desk = Desk::with(&world, &robot.with_typical_noise());
        let mut seen = std::collections::BTreeSet::new();
        for _ in 0..50 {
            desk.step(100);
            seen.insert(values(&mut desk, mode)[0]);
        }
        assert!((3..12).contains(&seen.len()), "{driver}: {seen:?}");
    }
}

/// The voltage in `bin_data`.
fn millivolts(desk: &mut Desk) -> i32 {
    let data = bytes(desk);
    assert!(data[4..].iter().all(|byte| *byte == 0), "one number");
    i32::from_le_bytes([data[0], data[1], data[2], data[3]])
}

#[test]
fn a_switch_is_a_voltage() {
    for (driver, free, pressed) in [
        ("lego-ev3-touch", 0, 5000),
        ("lego-nxt-touch", 5000, 900),
        ("ms-nxt-touch-mux", 5000, 4026),
    ] {
        let mut desk = desk(driver, vec![]);
        assert_eq!((get(&mut desk, "value0").as_str(), millivolts(&mut desk)), ("0", free));
        assert!(desk.0.press_touch(Port::In4, true), "{driver}");
        assert_eq!((get(&mut desk, "value0").as_str(), millivolts(&mut desk)), ("1", pressed));
    }
}

#[test]
fn a_voltage_is_sampled_every_10_ms_and_a_new_mode_shows_the_sample_before() {
    let mut desk = desk("lego-nxt-light", vec![]);
    let path = sensor(&mut desk);
    let (value, mode) = (format!("{path}value0"), format!("{path}mode"));
    let reflected = desk.number(&value);
    desk.put(&mode, "AMBIENT");
    assert_eq!(desk.number(&value), 1227, "the raw data 0");
    assert_eq!(millivolts(&mut desk), 0);
    desk.step(10);
    let ambient = desk.number(&value);
    assert!((0..=1000).contains(&ambient), "{ambient}");
    desk.put(&mode, "REFLECT");
    assert_eq!(desk.number(&value), reflected);
    desk.put(&mode, "AMBIENT");
    assert_eq!(desk.number(&value), ambient);
}

#[test]
fn pin_1_is_what_is_plugged_in() {
    let pin1 = |driver: &str| {
        let mut desk = desk("lego-nxt-light", vec![]);
        let lit = millivolts(&mut desk);
        desk.0.unplug(Port::In4);
        if !driver.is_empty() {
            desk.0.plug(Port::In4, driver).unwrap();
        }
        desk.put("lego-port/port3/mode", "nxt-analog");
        desk.step(600);
        let shown = |desk: &mut Desk, mode: &str| {
            desk.put("lego-sensor/sensor4/mode", mode);
            desk.step(20);
            desk.number("lego-sensor/sensor4/value0")
        };
        let shown = ["ANALOG-0", "ANALOG-1"].map(|mode| shown(&mut desk, mode));
        (desk, shown, lit)
    };
    assert_eq!(pin1("").1, [5000; 2], "nothing draws it down");
    assert_eq!(pin1("lego-nxt-touch").1, [5000; 2]);
    assert_eq!(pin1("lego-ev3-touch").1, [417; 2], "the resistor that shows its type");
    assert_eq!(pin1("lego-ev3-us").1, [0; 2], "grounded");
    let (_, [dark, bright], lit) = pin1("lego-nxt-light");
    assert_eq!(bright, lit, "as its own driver has it with the lamp on");
    assert!(dark > bright, "{dark} without, {bright} with the lamp");
    let (mut desk, _, _) = pin1("");
    desk.put("lego-port/port3/set_device", "lego-nxt-light");
    desk.step(600);
    assert_eq!(desk.number("lego-sensor/sensor5/value0"), -247, "5 V is darker than dark");
}

#[test]
fn a_wire_that_is_pulled_in_a_forced_mode_is_not_noticed() {
    let wall = Item::wall([-100.0, 80.7], [100.0, 80.7]);
    let mut desk = desk("ht-nxt-compass", vec![]);
    desk.put("lego-port/port3/mode", "nxt-i2c");
    desk.step(600);
    let path = "lego-sensor/sensor4/";
    assert!(desk.0.unplug(Port::In4));
    desk.0.place(Pose::new(0.0, 0.0, 90.0)).unwrap();
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "as it was");
    for (file, text) in [("command", "BEGIN-CAL"), ("direct", "x")] {
        assert_eq!(desk.try_put(&format!("{path}{file}"), text), Err(Errno::ENXIO), "{file}");
    }
    desk.put(&format!("{path}mode"), "COMPASS");
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "it has no register for its mode");
    assert!(desk.0.plug(Port::In4, "lego-ev3-touch").is_ok());
    assert!(desk.0.press_touch(Port::In4, true));
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "nothing that is on the bus");
    desk.0.plug(Port::In4, "ht-nxt-compass").unwrap();
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 90, "the same device");

    let mut desk = self::desk("lego-ev3-us", vec![wall]);
    desk.put("lego-port/port3/mode", "ev3-uart");
    desk.step(2000);
    let before = desk.number(&format!("{path}value0"));
    assert!(desk.0.unplug(Port::In4));
    desk.0.place(Pose::new(0.0, 40.0, 0.0)).unwrap();
    desk.step(5000);
    assert_eq!(desk.number(&format!("{path}value0")), before, "silent");
    desk.0.plug(Port::In4, "lego-ev3-us").unwrap();
    desk.step(500);
    assert_eq!(desk.try_get(&format!("{path}value0")), Err(Errno::ENXIO), "it introduces itself");
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), before - 400);
}

#[test]
fn a_mode_that_nobody_answers_ends_the_polling() {
    let mut desk = desk("lego-nxt-us", vec![Item::wall([-100.0, 80.7], [100.0, 80.7])]);
    desk.put("lego-port/port3/mode", "nxt-i2c");
    desk.step(600);
    let (mode, value) = ("lego-sensor/sensor4/mode", "lego-sensor/sensor4/value0");
    assert_eq!(desk.number(value), 80);
    assert!(desk.0.unplug(Port::In4));
    assert_eq!(desk.try_put(mode, "US-DIST-CM"), Err(Errno::ENXIO));
    desk.0.plug(Port::In4, "lego-nxt-us").unwrap();
    desk.0.place(Pose::new(0.0, 40.0, 0.0)).unwrap();
    desk.step(2000);
    assert_eq!(desk.number(value), 80, "until the mode is written");
    assert_eq!(desk.try_put(mode, "US-DIST-CM"), Ok(Duration::from_millis(4)));
    desk.step(10);
    assert_eq!(desk.number(value), 40);
}

#[test]
fn a_reading_that_was_asked_for_comes_though_polling_ends() {
    let mut desk = desk("ht-nxt-compass", vec![]);
    let path = sensor(&mut desk);
    desk.put(&format!("{path}mode"), "COMPASS");
    desk.put(&format!("{path}poll_ms"), "0");
    desk.step(100);
    desk.0.place(Pose::new(0.0, 0.0, 90.0)).unwrap();
    desk.step(3000);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "and no other does");
    let mut sonar = self::desk("lego-nxt-us", vec![Item::wall([-100.0, 80.7], [100.0, 80.7])]);
    let path = sensor(&mut sonar);
    sonar.put(&format!("{path}poll_ms"), "0");
    sonar.put(&format!("{path}mode"), "US-SI-CM");
    sonar.put(&format!("{path}poll_ms"), "100");
    sonar.step(100);
    assert_eq!(sonar.number(&format!("{path}value0")), 80);
}

#[test]
fn a_sensor_without_power_forgets() {
    let mut desk = desk("lego-ev3-gyro", vec![]);
    desk.put("lego-port/port3/mode", "ev3-uart");
    desk.step(2000);
    assert!(desk.0.unplug(Port::In4));
    desk.run(B, &[("speed_sp", 200)], "run-forever");
    desk.step(1000);
    desk.run(B, &[], "stop");
    desk.step(1000);
    desk.0.plug(Port::In4, "lego-ev3-gyro").unwrap();
    desk.step(300);
    let path = "lego-sensor/sensor4/";
    assert_eq!(desk.get(&format!("{path}mode")), "", "it introduces itself");
    assert!(desk.0.unplug(Port::In4));
    desk.step(300);
    assert_eq!(desk.get(&format!("{path}mode")), "", "still");
    assert!(desk.0.lose_contact(Port::In4, Duration::from_millis(100)));
    desk.step(300);
    assert_eq!(desk.try_get(&format!("{path}value0")), Err(Errno::ENXIO), "there is no wire");
    desk.0.plug(Port::In4, "lego-ev3-gyro").unwrap();
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 0);
    assert!(desk.0.unplug(Port::In4));
    desk.0.plug(Port::In4, "lego-ev3-touch").unwrap();
    desk.step(2000);
    assert_eq!(desk.number(&format!("{path}value0")), 0, "no serial sensor");
}

#[test]
fn pin_6_is_what_is_plugged_in() {
    let mut desk = desk("lego-ev3-touch", vec![]);
    desk.put("lego-port/port3/mode", "ev3-analog");
    assert!(desk.0.press_touch(Port::In4, true));
    desk.step(600);
    let value = "lego-sensor/sensor4/value0";
    assert_eq!(desk.number(value), 5000);
    for driver in ["lego-ev3-us", "lego-nxt-touch"] {
        desk.0.plug(Port::In4, driver).unwrap();
        desk.step(20);
        assert_eq!(desk.number(value), 0, "{driver}");
    }
}
