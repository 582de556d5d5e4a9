//! The devices that are connected.
use crate::files::PlainTree;
use ev3_driver::device::registry::LISTING_AGE;
use ev3_driver::{Class, Errno, Error, Registry, SysfsDir};
use std::fs;
use std::sync::Arc;

fn ports(devices: &Arc<Registry>, class: Class) -> Vec<String> {
    devices.all(class).unwrap().iter().map(|device| device.port().to_owned()).collect()
}

fn name_at(devices: &Arc<Registry>, port: &str) -> Option<String> {
    let device = devices.find(Class::TachoMotor, port).unwrap()?;
    Some(device.path().file_name().unwrap().to_str().unwrap().to_owned())
}

#[test]
fn both_spellings_of_a_port_name_the_same_device() {
    let tree = PlainTree::new();
    tree.motor("motor0", "ev3-ports:outA");
    tree.motor("motor1", "outB");
    let devices = tree.devices();
    for (port, name) in [("outA", "motor0"), ("outB", "motor1")] {
        assert_eq!(name_at(&devices, port).as_deref(), Some(name));
        assert_eq!(name_at(&devices, &format!("ev3-ports:{port}")).as_deref(), Some(name));
    }
    assert_eq!(ports(&devices, Class::TachoMotor), ["outA", "outB"]);
}

#[test]
fn devices_are_listed_in_the_order_of_their_ports_whatever_their_numbers() {
    let tree = PlainTree::new();
    tree.motor("motor0", "spi0.1:S10");
    tree.motor("motor1", "ev3-ports:outB");
    tree.motor("motor2", "spi0.1:S2");
    tree.motor("motor10", "ev3-ports:outA");
    let sorted = ["outA", "outB", "spi0.1:S2", "spi0.1:S10"];
    assert_eq!(ports(&tree.devices(), Class::TachoMotor), sorted);
}

#[test]
fn a_device_knows_its_port_driver_class_and_path() {
    let tree = PlainTree::new();
    let path = tree.plug(Class::Sensor, "sensor3", "ev3-ports:in1:i2c1", &[]);
    let devices = tree.devices();
    let sensor = devices.find(Class::Sensor, "in1:i2c1").unwrap().unwrap();
    assert_eq!((sensor.port(), sensor.driver()), ("in1:i2c1", "lego-ev3-touch"));
    assert_eq!((sensor.class(), sensor.path()), (Class::Sensor, &*path));
    let detected = sensor.detected();
    assert_eq!((detected.port, detected.driver), ("in1:i2c1".into(), "lego-ev3-touch".into()));
    assert_eq!(detected.path, path);
}

#[test]
fn what_is_no_device_is_passed_over() {
    let tree = PlainTree::new();
    tree.motor("motor0", "outA");
    let class = tree.root().join("tacho-motor");
    fs::write(class.join("README"), "a file\n").unwrap();
    fs::create_dir(class.join("empty")).unwrap();
    fs::create_dir_all(class.join("odd/address")).unwrap();
    tree.motor("nowhere", "");
    fs::write(tree.motor("binary", "outC").join("address"), b"\xff\xfe\n").unwrap();
    fs::write(tree.motor("long", "outD").join("address"), [b'a'; 5000]).unwrap();
    std::os::unix::fs::symlink("nothing", class.join("dangling")).unwrap();
    assert_eq!(ports(&tree.devices(), Class::TachoMotor), ["outA"]);
}

#[test]
fn a_half_made_device_is_found_once_it_is_whole() {
    let tree = PlainTree::new();
    let path = tree.motor("motor0", "outA");
    fs::remove_file(path.join("driver_name")).unwrap();
    let devices = tree.devices();
    assert_eq!(name_at(&devices, "outA"), None);
    fs::write(path.join("driver_name"), "lego-ev3-l-motor\n").unwrap();
    assert_eq!(name_at(&devices, "outA").as_deref(), Some("motor0"));
}

#[test]
fn of_two_devices_at_one_port_the_later_one_is_meant() {
    let tree = PlainTree::new();
    tree.motor("motor10", "outA");
    tree.motor("motor9", "outA");
    let devices = tree.devices();
    assert_eq!(name_at(&devices, "outA").as_deref(), Some("motor10"));
    tree.unplug(Class::TachoMotor, "motor10");
    std::thread::sleep(LISTING_AGE);
    assert_eq!(name_at(&devices, "outA").as_deref(), Some("motor9"));
}

#[test]
fn there_are_no_devices_without_class_directory_or_root() {
    let tree = PlainTree::new();
    let nowhere = SysfsDir::new(tree.root().join("no/such"));
    let nowhere = Arc::new(Registry::new(Arc::new(nowhere)));
    for devices in [tree.devices(), nowhere] {
        for class in Class::ALL {
            assert!(devices.all(class).unwrap().is_empty());
            assert!(devices.find(class, "outA").unwrap().is_none());
        }
    }
}

#[test]
fn a_class_that_cannot_be_listed_is_an_error_with_its_path() {
    let tree = PlainTree::new();
    let path = tree.root().join("tacho-motor");
    fs::write(&path, "not a directory").unwrap();
    let Err(error) = tree.devices().all(Class::TachoMotor) else { panic!("listed a file") };
    assert_eq!((error.errno(), error.path()), (Some(Errno::NOTDIR), Some(&*path)));
}

#[test]
fn a_listing_is_believed_for_100_ms() {
    let tree = PlainTree::new();
    tree.motor("motor0", "outA");
    let (counted, devices) = tree.counted();
    for _ in 0..50 {
        devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
        devices.all(Class::TachoMotor).unwrap();
    }
    assert_eq!(counted.lists(), 1);
    counted.pass_ms(99);
    devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert_eq!(counted.lists(), 0);
    counted.pass_ms(1);
    devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert_eq!(counted.lists(), 1);
}

#[test]
fn a_missing_port_is_looked_for_at_once_each_time() {
    let tree = PlainTree::new();
    tree.motor("motor0", "outA");
    let (counted, devices) = tree.counted();
    assert_eq!(name_at(&devices, "outB"), None);
    assert_eq!(name_at(&devices, "outB"), None);
    assert_eq!(counted.lists(), 2);
    tree.motor("motor1", "outB");
    assert_eq!(name_at(&devices, "outB").as_deref(), Some("motor1"));
}

#[test]
fn each_class_has_a_listing_of_its_own() {
    let tree = PlainTree::new();
    tree.plug(Class::Sensor, "sensor0", "in1", &[]);
    tree.motor("motor0", "outA");
    let (counted, devices) = tree.counted();
    devices.all(Class::Sensor).unwrap();
    devices.all(Class::TachoMotor).unwrap();
    devices.all(Class::Sensor).unwrap();
    assert_eq!(counted.lists(), 2);
}

#[test]
fn descriptors_are_kept_from_one_listing_to_the_next() {
    let (tree, counted, devices) = PlainTree::with_motor(&[("position", "5")]);
    let read = || devices.with(Class::TachoMotor, "outA", |motor| motor.number("position"));
    assert_eq!(read().unwrap(), Some(5));
    // The two that say who it is, and the position.
    assert_eq!(counted.opens(), 3);
    for _ in 0..10 {
        counted.pass_ms(100);
        assert_eq!(read().unwrap(), Some(5));
    }
    tree.motor("motor1", "outB");
    counted.pass_ms(100);
    assert_eq!(read().unwrap(), Some(5));
    assert_eq!((counted.lists(), counted.opens()), (12, 2), "only the new motor was opened");
}

#[test]
fn a_removed_device_is_gone_within_100_ms() {
    let (tree, counted, devices) = PlainTree::with_motor(&[("position", "5")]);
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert_eq!(motor.number("position").unwrap(), 5);
    assert!(devices.has(&motor).unwrap());
    tree.unplug(Class::TachoMotor, "motor0");
    counted.pass_ms(100);
    assert_eq!(name_at(&devices, "outA"), None);
    assert!(!devices.has(&motor).unwrap());
}

#[test]
fn a_removed_device_that_is_used_before_is_gone_at_once() {
    let (tree, counted, devices) = PlainTree::with_motor(&[("position", "5")]);
    let read = || devices.with(Class::TachoMotor, "outA", |motor| motor.number("position"));
    assert_eq!(read().unwrap(), Some(5));
    tree.unplug(Class::TachoMotor, "motor0");
    counted.pass_ms(1);
    assert_eq!(read().unwrap(), None);
}

#[test]
fn a_kept_device_answers_enodev_once_it_is_removed() {
    let (tree, counted, devices) = PlainTree::with_motor(&[("position", "5")]);
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    motor.number("position").unwrap();
    motor.check_present().unwrap();
    tree.unplug(Class::TachoMotor, "motor0");
    counted.pass_ms(1);
    let error = motor.check_present().unwrap_err();
    assert!(matches!(error, Error::Read { .. }));
    assert_eq!((error.errno(), error.is_stale()), (Some(Errno::NODEV), true));
    let error = motor.number("speed").unwrap_err();
    assert_eq!((error.errno(), error.is_unplugged()), (Some(Errno::NOENT), true));
}

#[test]
fn a_device_replugged_under_another_number_is_found_at_its_next_use() {
    let (tree, counted, devices) = PlainTree::with_motor(&[("position", "5")]);
    let read = || devices.with(Class::TachoMotor, "outA", |motor| motor.number("position"));
    assert_eq!(read().unwrap(), Some(5));
    tree.unplug(Class::TachoMotor, "motor0");
    counted.pass_ms(1);
    tree.plug(Class::TachoMotor, "motor1", "outA", &[("position", "7")]);
    assert_eq!(read().unwrap(), Some(7));
}

#[test]
fn a_device_replugged_under_the_same_name_and_inode_is_found_at_its_next_use() {
    let (tree, counted, devices) =
        PlainTree::with_motor(&[("position", "5"), ("max_speed", "900")]);
    let read = |name| devices.with(Class::TachoMotor, "outA", |motor| motor.constant(name));
    let motor = devices.find(Class::TachoMotor, "outA").unwrap().unwrap();
    assert_eq!(read("max_speed").unwrap(), Some(900));
    motor.number("position").unwrap();
    tree.unplug(Class::TachoMotor, "motor0");
    counted.pass_ms(1);
    tree.plug(Class::TachoMotor, "motor0", "outA", &[("position", "7"), ("max_speed", "800")]);
    let position = devices.with(Class::TachoMotor, "outA", |motor| motor.number("position"));
    assert_eq!(position.unwrap(), Some(7));
    assert_eq!(read("max_speed").unwrap(), Some(800), "nor is anything remembered of the old one");
    assert!(!devices.has(&motor).unwrap());
}

#[test]
fn patterns_find_devices_of_any_class_in_the_order_of_their_paths() {
    let tree = PlainTree::new();
    let motor = tree.motor("motor0", "ev3-ports:outB");
    let sensor = tree.plug(Class::Sensor, "sensor0", "in1", &[]);
    fs::create_dir(tree.root().join("tacho-motor/empty")).unwrap();
    let devices = tree.devices();
    let found = devices.detect(&format!("{}/*/*", tree.root().display())).unwrap();
    let paths: Vec<_> = found.iter().map(|device| device.path.clone()).collect();
    assert_eq!(paths, [sensor, motor]);
    assert_eq!((&*found[1].port, &*found[1].driver), ("outB", "lego-ev3-l-motor"));
    assert!(devices.detect("/no/such/*").unwrap().is_empty());
    let error = devices.detect("[").unwrap_err();
    assert!(matches!(&error, Error::Pattern { pattern, .. } if pattern == "["));
}

#[test]
fn many_threads_share_the_devices() {
    let tree = PlainTree::new();
    for number in 0..4 {
        let port = format!("out{number}");
        tree.plug(Class::TachoMotor, &format!("motor{number}"), &port, &[("position", "5")]);
    }
    let devices = tree.devices();
    std::thread::scope(|scope| {
        for thread in 0..8 {
            let devices = &devices;
            scope.spawn(move || {
                for round in 0..200 {
                    let port = format!("out{}", (thread + round) % 4);
                    let read = |motor: &Arc<ev3_driver::Device>| motor.number("position");
                    assert_eq!(devices.with(Class::TachoMotor, &port, read).unwrap(), Some(5));
                    assert_eq!(devices.all(Class::TachoMotor).unwrap().len(), 4);
                }
            });
        }
    });
}

#[test]
fn a_listing_holds_until_it_is_old_or_finds_other_devices_or_is_forgotten() {
    let tree = PlainTree::new();
    tree.motor("motor0", "outA");
    let devices = tree.devices();
    let now = || devices.tree().now();
    let never = devices.listed(Class::TachoMotor);
    assert!(!devices.holds(never, now()), "nothing was listed");

    assert!(name_at(&devices, "outA").is_some());
    let listed = devices.listed(Class::TachoMotor);
    let made = now();
    assert!(devices.holds(listed, made));
    assert!(!devices.holds(listed, made + LISTING_AGE));

    tree.motor("motor1", "outB");
    assert!(name_at(&devices, "outB").is_some());
    assert!(!devices.holds(listed, made), "there are other devices");

    let listed = devices.listed(Class::TachoMotor);
    assert!(devices.holds(listed, made));
    devices.forget_listings();
    assert!(!devices.holds(listed, made));
}

#[test]
fn ports_that_end_alike_are_told_apart() {
    let tree = PlainTree::new();
    let ports = ["in1:i2c80:mux1", "in2:i2c80:mux1", "mux1", "1", "in1:i2c80:mux11"];
    for (number, port) in ports.into_iter().enumerate() {
        tree.plug(Class::Sensor, &format!("sensor{number}"), port, &[]);
    }
    let devices = tree.devices();
    for port in ports {
        let found = devices.find(Class::Sensor, port).unwrap();
        assert_eq!(found.map(|found| found.port().to_owned()).as_deref(), Some(port));
    }
    assert!(devices.find(Class::Sensor, "in3:i2c80:mux1").unwrap().is_none());
}
