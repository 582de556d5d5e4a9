//! Wires pulled and put in, and the modes of ports.
use crate::desk::{B, C, Desk};
use crate::robots::default_robot;
use ev3_sim::{Access, Descriptor, Errno, Machine, Options, Port, WorldSpec};

fn instant() -> Desk {
    let options = Options { instant: true, ..Options::default() };
    Desk(Machine::new(&WorldSpec::default(), &default_robot(), options).unwrap())
}

#[test]
fn an_unplugged_device_dies_and_comes_back_under_a_new_number() {
    let mut desk = instant();
    let mut old = Descriptor::open(&desk.0, &format!("{B}state"), Access::ReadOnly).unwrap();
    let mut buffer = [0; 16];
    old.pread(&mut desk.0, 0, &mut buffer).unwrap();
    let inode = old.node();
    assert!(desk.0.unplug(Port::OutB));
    assert!(!desk.0.unplug(Port::OutB), "there is nothing more to pull");
    assert_eq!(old.pread(&mut desk.0, 0, &mut buffer), Err(Errno::ENODEV));
    assert_eq!(desk.0.write(inode, b"x"), Err(Errno::ENODEV));
    assert!(old.poll(&desk.0), "poll returns at once");
    assert_eq!(desk.try_get(&format!("{B}state")), Err(Errno::ENOENT));
    assert_eq!(desk.get("lego-port/port5/status"), "no-motor");
    desk.0.plug(Port::OutB, "lego-ev3-l-motor").unwrap();
    assert_eq!(desk.get("tacho-motor/motor3/address"), "ev3-ports:outB");
    let new = desk.0.resolve("tacho-motor/motor3/state").unwrap();
    assert!(new > inode, "inode numbers are not used again");
    assert_eq!(old.pread(&mut desk.0, 0, &mut buffer), Err(Errno::ENODEV));
}

#[test]
fn a_pulled_wire_lets_the_motor_coast_and_a_new_one_knows_nothing() {
    let mut desk = instant();
    for motor in [B, C] {
        desk.run(motor, &[("speed_sp", 500)], "run-forever");
    }
    desk.step(1000);
    let counted = desk.position(B);
    for port in [Port::OutB, Port::OutC] {
        desk.0.unplug(port);
    }
    desk.step(3000);
    let rest = desk.0.pose().y;
    desk.step(1000);
    assert!((desk.0.pose().y - rest).abs() < 1e-9, "stands still");
    desk.0.plug(Port::OutB, "lego-ev3-l-motor").unwrap();
    let motor = "tacho-motor/motor3/";
    assert_eq!(desk.number(&format!("{motor}speed_sp")), 0);
    assert_eq!(desk.state(motor), "");
    let position = desk.position(motor);
    assert!((counted - 1..counted + 5).contains(&position), "what had accumulated: {position}");
}

#[test]
fn an_attribute_shows_what_it_is_told_to_and_the_device_goes_on() {
    let mut desk = instant();
    let value = "lego-sensor/sensor0/value0";
    let own = desk.get(value);
    desk.0.show(Port::In1, "value0", "123").unwrap();
    desk.0.show(Port::In1, "value5", "not a number").unwrap();
    desk.0.show(Port::OutB, "state", "running stalled").unwrap();
    assert_eq!(desk.get(value), "123");
    assert_eq!(desk.get("lego-sensor/sensor0/value5"), "not a number", "though it is ENXIO");
    assert_eq!(desk.try_get("lego-sensor/sensor0/value1"), Err(Errno::ENXIO));
    desk.run(B, &[("speed_sp", 500)], "run-forever");
    desk.step(500);
    assert_eq!(desk.get(&format!("{B}state")), "running stalled");
    assert!(desk.position(B) > 100, "it turns all the same");
    assert_eq!(desk.0.unshow(Port::In1, "value0"), Ok(true));
    assert_eq!(desk.0.unshow(Port::In1, "value0"), Ok(false));
    assert_eq!(desk.get(value), own);
    assert_eq!(desk.0.unshow(Port::OutB, "state"), Ok(true));
    assert_eq!(desk.get(&format!("{B}state")), "running");
}

#[test]
fn what_is_shown_takes_writes_as_ever_and_ends_with_the_device() {
    let mut desk = instant();
    desk.0.show(Port::OutB, "speed_sp", "777").unwrap();
    desk.put(&format!("{B}speed_sp"), 300);
    assert_eq!(desk.get(&format!("{B}speed_sp")), "777");
    assert_eq!(desk.try_put(&format!("{B}speed_sp"), "2000"), Err(Errno::EINVAL));
    let snapshot = desk.0.clone();
    desk.0.unshow(Port::OutB, "speed_sp").unwrap();
    assert_eq!(desk.number(&format!("{B}speed_sp")), 300);
    desk.0 = snapshot;
    assert_eq!(desk.number(&format!("{B}speed_sp")), 777, "a snapshot has it");
    desk.0.unplug(Port::OutB);
    desk.0.plug(Port::OutB, "lego-ev3-l-motor").unwrap();
    assert_eq!(desk.number("tacho-motor/motor3/speed_sp"), 0);
}

#[test]
fn a_shown_state_wakes_who_polls_once() {
    let mut desk = instant();
    let mut state = Descriptor::open(&desk.0, &format!("{B}state"), Access::ReadOnly).unwrap();
    let mut buffer = [0; 16];
    state.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert!(!state.poll(&desk.0));
    desk.0.show(Port::OutB, "state", "holding").unwrap();
    assert!(state.poll(&desk.0));
    let length = state.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert_eq!(&buffer[..length], b"holding\n");
    desk.0.show(Port::OutB, "state", "holding").unwrap();
    assert!(!state.poll(&desk.0), "nothing new");
    desk.0.show(Port::OutB, "speed", "5").unwrap();
    assert!(!state.poll(&desk.0));
}

#[test]
fn what_cannot_be_shown_is_refused() {
    let mut desk = instant();
    assert_eq!(desk.0.show(Port::OutD, "state", ""), Err(Errno::ENODEV));
    assert_eq!(desk.0.show(Port::OutB, "color", "red"), Err(Errno::ENOENT));
    assert_eq!(desk.0.show(Port::OutB, "command", "stop"), Err(Errno::EACCES));
    assert_eq!(desk.0.show(Port::OutB, "state", &"x".repeat(4096)), Err(Errno::EINVAL));
    desk.0.show(Port::OutB, "state", &"x".repeat(4095)).unwrap();
    assert_eq!(desk.0.unshow(Port::OutB, "color"), Err(Errno::ENOENT));
    assert_eq!(desk.0.unshow(Port::OutD, "state"), Err(Errno::ENODEV));
}

#[test]
fn plugging_takes_the_time_it_takes() {
    let mut desk = Desk::new();
    desk.0.unplug(Port::OutB);
    desk.step(90);
    assert!(desk.try_get(&format!("{B}state")).is_ok(), "not noticed yet");
    desk.step(20);
    assert_eq!(desk.try_get(&format!("{B}state")), Err(Errno::ENOENT));
    desk.0.plug(Port::OutB, "lego-ev3-l-motor").unwrap();
    desk.step(380);
    assert_eq!(desk.get("lego-port/port5/status"), "no-motor");
    desk.step(14);
    assert_eq!(desk.get("lego-port/port5/status"), "tacho-motor");
    assert!(desk.try_get("tacho-motor/motor3/state").is_err());
    desk.step(10);
    assert_eq!(desk.state("tacho-motor/motor3/"), "");
    // udev has not come by yet.
    let speed = "tacho-motor/motor3/speed_sp";
    let mode = |desk: &Desk| desk.0.stat(desk.0.resolve(speed).unwrap()).unwrap().mode;
    assert_eq!(mode(&desk), 0o644);
    assert_eq!(desk.try_put(speed, "100"), Err(Errno::EACCES));
    desk.step(500);
    assert_eq!(mode(&desk), 0o664);
    desk.put(speed, 100);

    desk.0.unplug(Port::In2);
    desk.step(200);
    desk.0.plug(Port::In2, "lego-ev3-us").unwrap();
    desk.step(1350);
    assert_eq!(desk.get("lego-port/port1/status"), "ev3-uart");
    assert!(desk.try_get("lego-sensor/sensor4/mode").is_err());
    desk.step(12);
    assert_eq!(desk.get("lego-sensor/sensor4/driver_name"), "lego-ev3-us");
    assert_eq!(desk.try_get("lego-sensor/sensor4/value0"), Err(Errno::ENXIO), "no data yet");
    desk.step(600);
    assert_eq!(desk.number("lego-sensor/sensor4/value0"), 2550);
}

#[test]
fn what_does_not_fit_is_refused_by_name() {
    let mut desk = instant();
    let error = desk.0.plug(Port::OutB, "lego-ev3-us").unwrap_err();
    assert!(error.to_string().contains("lego-ev3-us on outB"), "{error}");
    assert!(desk.0.plug(Port::In1, "lego-ev3-lidar").is_err());
}

#[test]
fn a_written_port_mode_makes_the_device_anew() {
    let mut desk = instant();
    desk.put("lego-port/port5/mode", "auto");
    assert_eq!(desk.try_get(&format!("{B}state")), Err(Errno::ENOENT));
    assert_eq!(desk.get("tacho-motor/motor3/address"), "ev3-ports:outB");
    desk.put("lego-port/port5/mode", "raw");
    assert_eq!(desk.try_get("tacho-motor/motor3/state"), Err(Errno::ENOENT));
    assert_eq!(desk.get("lego-port/port5/status"), "raw");
    assert_eq!(
        desk.try_put("lego-port/port5/set_device", "lego-nxt-motor"),
        Err(Errno::EOPNOTSUPP)
    );
    desk.put("lego-port/port7/mode", "tacho-motor");
    assert_eq!(desk.get("tacho-motor/motor4/address"), "ev3-ports:outD", "with nothing plugged in");
    desk.put("lego-port/port7/set_device", "lego-ev3-m-motor");
    assert_eq!(desk.get("tacho-motor/motor5/driver_name"), "lego-ev3-m-motor");
    desk.put("lego-port/port7/set_device", "rocket");
    assert_eq!(desk.try_get("tacho-motor/motor6/state"), Err(Errno::ENOENT), "no driver, no motor");
    desk.put("lego-port/port3/mode", "other-uart");
    assert_eq!(desk.try_get("lego-sensor/sensor3/mode"), Err(Errno::ENOENT));
    desk.put("lego-port/port3/mode", "auto");
    assert_eq!(desk.get("lego-sensor/sensor4/driver_name"), "lego-ev3-gyro");
    let blocks = desk.try_put("lego-port/port2/mode", "nxt-i2c").unwrap();
    assert_eq!(blocks.as_secs(), 1);
}

#[test]
fn an_nxt_motor_is_taken_for_a_large_one() {
    let mut desk = instant();
    desk.0.plug(Port::OutD, "lego-nxt-motor").unwrap();
    assert_eq!(desk.get("tacho-motor/motor3/driver_name"), "lego-ev3-l-motor");
}

#[test]
fn auto_looks_for_what_is_there_again() {
    let mut desk = Desk::new();
    desk.run(B, &[("speed_sp", 300)], "run-forever");
    desk.step(500);
    desk.put("lego-port/port5/mode", "auto");
    assert_eq!(desk.try_get(&format!("{B}state")), Err(Errno::ENOENT));
    assert_eq!(desk.get("lego-port/port5/status"), "no-motor");
    let set_device = "lego-port/port5/set_device";
    assert_eq!(desk.try_put(set_device, "lego-nxt-motor"), Err(Errno::EOPNOTSUPP));
    desk.step(380);
    assert!(desk.try_get("tacho-motor/motor3/state").is_err());
    desk.step(60);
    assert_eq!(desk.state("tacho-motor/motor3/"), "");
    desk.put(set_device, " lego-nxt-motor\t\n");
    assert_eq!(desk.get("tacho-motor/motor4/driver_name"), "lego-nxt-motor");
    desk.put("lego-port/port3/mode", "auto");
    assert_eq!(desk.get("lego-port/port3/status"), "no-sensor");
    desk.step(400);
    assert_eq!(desk.get("lego-port/port3/status"), "ev3-uart");
    desk.step(600);
    assert!(desk.try_get("lego-sensor/sensor4/mode").is_err(), "it introduces itself");
    desk.step(500);
    assert_eq!(desk.get("lego-sensor/sensor4/driver_name"), "lego-ev3-gyro");
    desk.put("lego-port/port3/mode", "ev3-uart");
    assert_eq!(desk.try_get("lego-sensor/sensor4/mode"), Err(Errno::ENOENT));
    desk.step(900);
    assert!(desk.try_get("lego-sensor/sensor5/mode").is_err());
    desk.step(200);
    assert_eq!(desk.get("lego-sensor/sensor5/driver_name"), "lego-ev3-gyro");
}

#[test]
fn the_status_in_a_forced_mode_is_that_mode() {
    let mut desk = Desk::new();
    for (mode, status) in [
        ("nxt-analog", "nxt-analog"),
        ("nxt-color", "nxt-color"),
        ("nxt-i2c", "nxt-i2c"),
        ("other-i2c", "no-sensor"),
        ("ev3-analog", "ev3-analog"),
        ("ev3-uart", "ev3-uart"),
        ("other-uart", "no-sensor"),
        ("raw", "no-sensor"),
    ] {
        desk.put("lego-port/port3/mode", mode);
        assert_eq!(desk.get("lego-port/port3/status"), status, "{mode}");
    }
}

#[test]
fn what_the_kernel_cannot_load_leaves_no_sensor() {
    let mut desk = instant();
    desk.put("lego-port/port3/mode", "nxt-analog");
    assert_eq!(desk.get("lego-sensor/sensor4/driver_name"), "nxt-analog");
    desk.put("lego-port/port3/set_device", "di-dflex");
    assert_eq!(desk.try_get("lego-sensor/sensor5/mode"), Err(Errno::ENOENT));
}
