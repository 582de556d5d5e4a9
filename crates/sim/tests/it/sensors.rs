//! Sensors against the geometry of a world, and the ways of their drivers.
use crate::desk::{B, C, Desk};
use crate::robots::{default_robot, touch_robot};
use ev3_sim::{Access, Descriptor, Errno, Item, Machine, Noise, Options, Port, Pose, WorldSpec};
use std::time::Duration;

const SONAR: &str = "lego-sensor/sensor0/";
const LEFT: &str = "lego-sensor/sensor1/";
const RIGHT: &str = "lego-sensor/sensor2/";
const GYRO: &str = "lego-sensor/sensor3/";

fn world(items: Vec<Item>) -> WorldSpec {
    WorldSpec { items, ..WorldSpec::default() }
}

/// A desk with one sensor of a kind on in4.
fn with_in4(driver: &str, items: Vec<Item>) -> Desk {
    let mut robot = touch_robot();
    driver.clone_into(&mut robot.sensors[3].driver);
    Desk::with(&world(items), &robot)
}

/// Writes a mode and waits until its values have settled.
fn mode(desk: &mut Desk, sensor: &str, name: &str) {
    desk.put(&format!("{sensor}mode"), name);
    desk.step(1200);
    assert_eq!(desk.get(&format!("{sensor}mode")), name);
}

fn value(desk: &mut Desk, sensor: &str, index: usize) -> i32 {
    desk.number(&format!("{sensor}value{index}"))
}

#[test]
fn the_sonar_measures_the_nearest_thing_in_its_cone() {
    let mut desk =
        Desk::with(&world(vec![Item::wall([-100.0, 100.0], [100.0, 100.0])]), &default_robot());
    // The sensor sits 7 cm ahead of the axle; the wall's near face is at 99.5 cm.
    assert_eq!(value(&mut desk, SONAR, 0), 925);
    let pillar = desk.0.add_item(Item::circle([5.0, 60.0], 3.0)).unwrap();
    desk.step(2);
    let pillar_at = value(&mut desk, SONAR, 0);
    assert!((498..=506).contains(&pillar_at), "{pillar_at}");
    desk.0.remove_item(pillar);
    desk.0.place(Pose::new(0.0, 91.0, 0.0)).unwrap();
    desk.step(2);
    assert_eq!(value(&mut desk, SONAR, 0), 30, "not less than 3 cm");
    desk.0.place(Pose::new(0.0, 50.0, 180.0)).unwrap();
    desk.step(2);
    assert_eq!(value(&mut desk, SONAR, 0), 2550, "nothing there");
    mode(&mut desk, SONAR, "US-DIST-IN");
    assert_eq!(value(&mut desk, SONAR, 0), 1003);
    desk.0.place(Pose::new(0.0, 0.0, 0.0)).unwrap();
    desk.step(2);
    assert_eq!(value(&mut desk, SONAR, 0), 364);
}

#[test]
fn single_shots_are_taken_once_and_not_too_often() {
    let mut desk =
        Desk::with(&world(vec![Item::wall([-100.0, 100.0], [100.0, 100.0])]), &default_robot());
    mode(&mut desk, SONAR, "US-SI-CM");
    assert_eq!(value(&mut desk, SONAR, 0), 925);
    desk.0.place(Pose::new(0.0, 20.0, 0.0)).unwrap();
    desk.step(500);
    assert_eq!(value(&mut desk, SONAR, 0), 925, "still the old shot");
    mode(&mut desk, SONAR, "US-SI-CM");
    assert_eq!(value(&mut desk, SONAR, 0), 725);
    desk.put(&format!("{SONAR}mode"), "US-SI-CM");
    desk.step(100);
    assert_eq!(desk.try_put(&format!("{SONAR}mode"), "US-SI-CM"), Err(Errno::ETIMEDOUT));
    desk.step(1000);
    let before = desk.0.now();
    assert_eq!(
        desk.try_put(&format!("{SONAR}mode"), "US-DIST-CM"),
        Err(Errno::ETIMEDOUT),
        "locked up"
    );
    let took = desk.0.now().abs_diff(before).as_millis();
    assert!((500..=600).contains(&took), "it tries ten times: {took} ms");
}

#[test]
fn the_floor_has_colors() {
    let color = |name: &str| name.parse().unwrap();
    for (code, name) in (1..).zip(["black", "blue", "green", "yellow", "red", "white", "brown"]) {
        let floor = WorldSpec { floor: color(name), ..WorldSpec::default() };
        let mut desk = Desk::with(&floor, &default_robot());
        mode(&mut desk, RIGHT, "COL-COLOR");
        assert_eq!(value(&mut desk, RIGHT, 0), code, "{name}");
    }
    let line =
        Item::Line { points: vec![[3.0, -50.0], [3.0, 50.0]], width: 2.0, color: color("black") };
    let mut desk = Desk::with(&world(vec![line]), &default_robot());
    assert_eq!(value(&mut desk, RIGHT, 0), 6);
    assert_eq!(value(&mut desk, LEFT, 0), 92);
    desk.0.place(Pose::new(-1.0, 0.0, 0.0)).unwrap();
    desk.step(2);
    let edge = value(&mut desk, RIGHT, 0);
    assert!((20..80).contains(&edge), "half on the line: {edge}");
    mode(&mut desk, LEFT, "RGB-RAW");
    let white: Vec<i32> = (0..3).map(|index| value(&mut desk, LEFT, index)).collect();
    assert_eq!(white, [420, 420, 420]);
    mode(&mut desk, LEFT, "REF-RAW");
    assert!(value(&mut desk, LEFT, 0) < value(&mut desk, LEFT, 1), "more light is lower");
}

#[test]
fn lamps_fall_off_with_the_square_and_throw_shadows() {
    let mut robot = default_robot();
    robot.sensors[1].pose = Pose::new(0.0, 0.0, 0.0);
    let dark = WorldSpec { ambient: 0.0, ..WorldSpec::default() };
    let read = |distance: f64, heading: f64, box_at: Option<f64>| {
        let mut items = vec![Item::Lamp { at: [0.0, distance], intensity: 12.0 }];
        items.extend(box_at.map(|y| Item::circle([0.0, y], 3.0)));
        let mut desk = Desk::with(&WorldSpec { items, ..dark.clone() }, &robot);
        desk.0.place(Pose::new(0.0, 0.0, heading)).unwrap();
        mode(&mut desk, LEFT, "COL-AMBIENT");
        value(&mut desk, LEFT, 0)
    };
    let table = [(20.0, 100), (50.0, 38), (100.0, 12), (200.0, 3)];
    for (distance, expected) in table {
        assert_eq!(read(distance, 0.0, None), expected, "at {distance} cm");
    }
    assert_eq!(read(100.0, 60.0, None), 6, "aslant");
    assert_eq!(read(100.0, 120.0, None), 0, "from behind");
    assert_eq!(read(100.0, 0.0, Some(50.0)), 0, "in a shadow");
    assert_eq!(read(100.0, 0.0, Some(150.0)), 12, "behind the lamp");
}

#[test]
fn the_gyro_turns_with_the_robot_and_restarts_with_its_mode() {
    let mut desk = Desk::new();
    for (motor, speed) in [(B, 200), (C, -200)] {
        desk.run(motor, &[("speed_sp", speed)], "run-forever");
    }
    desk.step(2000);
    let heading = desk.0.pose().heading;
    let angle = f64::from(value(&mut desk, GYRO, 0));
    assert!(heading > 100.0 && (angle - heading).abs() < 1.0, "{angle} {heading}");
    mode(&mut desk, GYRO, "GYRO-G&A");
    // 200 counts/s on 5.6 cm wheels, 10.6 cm apart.
    let rate = value(&mut desk, GYRO, 1);
    assert!((102..=109).contains(&rate), "{rate}");
    let angle = value(&mut desk, GYRO, 0);
    assert!((120..=130).contains(&angle), "since the mode came up, 1.2 s ago: {angle}");
    mode(&mut desk, GYRO, "GYRO-FAS");
    let fine = value(&mut desk, GYRO, 0);
    assert!((345..=360).contains(&fine), "{fine}");
    mode(&mut desk, GYRO, "GYRO-ANG");
    desk.put(&format!("{GYRO}direct"), "\u{11}");
    desk.step(2);
    assert!(value(&mut desk, GYRO, 0).abs() < 2);
}

#[test]
fn gyro_drift_and_noise_are_off_until_asked_for() {
    let mut robot = default_robot();
    robot.sensors[3].noise = Some(Noise { sigma: 0.0, bias: 0.5 });
    robot.sensors[0].noise = Some(Noise { sigma: 1.0, bias: 0.0 });
    let wall = world(vec![Item::wall([-100.0, 100.0], [100.0, 100.0])]);
    let readings = |seed| {
        let mut desk =
            Desk(Machine::new(&wall, &robot, Options { seed, ..Options::default() }).unwrap());
        let mut sonar = Vec::new();
        for _ in 0..1000 {
            desk.step(10);
            sonar.push(value(&mut desk, SONAR, 0));
        }
        assert_eq!(value(&mut desk, GYRO, 0), 5, "half a degree a second");
        sonar
    };
    let first = readings(7);
    assert_eq!(first, readings(7), "same seed, same numbers");
    assert_ne!(first, readings(8));
    let mean = f64::from(first.iter().sum::<i32>()) / 1000.0;
    let spread = first.iter().map(|v| (f64::from(*v) - mean).powi(2)).sum::<f64>() / 1000.0;
    assert!((mean - 925.0).abs() < 1.5 && (spread.sqrt() - 10.0).abs() < 1.0, "{mean} {spread}");
}

#[test]
fn infrared_says_per_cent_of_70_cm() {
    let mut desk = with_in4("lego-ev3-ir", vec![Item::wall([-100.0, 43.5], [100.0, 43.5])]);
    assert_eq!(value(&mut desk, GYRO, 0), 50);
    desk.0.place(Pose::new(0.0, 0.0, 90.0)).unwrap();
    desk.step(2);
    assert_eq!(value(&mut desk, GYRO, 0), 100);
    mode(&mut desk, GYRO, "IR-SEEK");
    assert_eq!(value(&mut desk, GYRO, 1), -128, "no beacon");
}

#[test]
fn a_bumper_is_pressed_by_a_wall_and_wakes_who_waits() {
    let mut desk = with_in4("lego-ev3-touch", vec![Item::wall([-100.0, 30.0], [100.0, 30.0])]);
    let mut file = Descriptor::open(&desk.0, &format!("{GYRO}value0"), Access::ReadOnly).unwrap();
    let mut buffer = [0; 8];
    file.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert_eq!(&buffer[..2], b"0\n");
    assert!(!file.poll(&desk.0));
    for motor in [B, C] {
        desk.run(motor, &[("speed_sp", 400)], "run-forever");
    }
    let mut waited = Duration::ZERO;
    while !file.poll(&desk.0) {
        let next = desk.0.next_event();
        assert!(next > desk.0.now());
        let jump = next.saturating_sub(desk.0.now());
        waited += jump;
        desk.0.step(jump);
        assert!(waited < Duration::from_secs(3));
    }
    file.pread(&mut desk.0, 0, &mut buffer).unwrap();
    assert_eq!(&buffer[..2], b"1\n");
    assert!(waited > Duration::from_millis(500));
}

#[test]
fn a_mode_change_takes_a_moment_and_leaves_stale_values() {
    let mut desk = Desk::new();
    assert_eq!(value(&mut desk, LEFT, 0), 92);
    let blocks = desk.try_put(&format!("{LEFT}mode"), "COL-COLOR").unwrap();
    assert!(blocks > Duration::ZERO && blocks < Duration::from_millis(20));
    assert_eq!(desk.get(&format!("{LEFT}mode")), "COL-REFLECT", "until data come");
    assert_eq!(desk.try_put(&format!("{LEFT}mode"), "REF-RAW"), Err(Errno::EBUSY));
    desk.0.step(blocks);
    assert_eq!(desk.get(&format!("{LEFT}mode")), "COL-COLOR");
    assert_eq!(value(&mut desk, LEFT, 0), 6, "nothing that could be left over");
    let black = Item::rectangle([-50.0, -50.0], [50.0, 50.0], ev3_sim::Color::BLACK);
    desk.0.add_item(black).unwrap();
    desk.put(&format!("{LEFT}mode"), "COL-REFLECT");
    assert_eq!(value(&mut desk, LEFT, 0), 92, "left over from the last time");
    desk.step(10);
    assert_eq!(value(&mut desk, LEFT, 0), 6);
}

#[test]
fn a_lost_contact_comes_back() {
    let mut desk = Desk::new();
    mode(&mut desk, LEFT, "COL-COLOR");
    assert!(desk.0.lose_contact(Port::In2, Duration::from_secs(1)));
    let black = Item::rectangle([-50.0, -50.0], [50.0, 50.0], ev3_sim::Color::BLACK);
    let id = desk.0.add_item(black).unwrap();
    assert_eq!(value(&mut desk, LEFT, 0), 6, "the old value, and no error");
    let before = desk.0.now();
    assert_eq!(desk.try_put(&format!("{LEFT}mode"), "COL-AMBIENT"), Err(Errno::ETIMEDOUT));
    let took = desk.0.now().abs_diff(before).as_millis();
    assert!((500..=600).contains(&took), "it tries ten times: {took} ms");
    desk.step(300);
    assert_eq!(desk.try_put(&format!("{LEFT}mode"), "COL-AMBIENT"), Err(Errno::ENODEV));
    assert_eq!(desk.get(&format!("{LEFT}mode")), "COL-COLOR");
    assert_eq!(value(&mut desk, LEFT, 0), 6);
    desk.step(120);
    assert_eq!(desk.try_get(&format!("{LEFT}value0")), Err(Errno::ENXIO), "introduces itself");
    assert_eq!(desk.number(&format!("{LEFT}num_values")), 0);
    assert_eq!(desk.get(&format!("{LEFT}mode")), "");
    assert_eq!(desk.try_put(&format!("{LEFT}mode"), "COL-COLOR"), Err(Errno::EINVAL));
    assert!(desk.0.remove_item(id));
    desk.step(600);
    assert_eq!(desk.get(&format!("{LEFT}mode")), "COL-COLOR", "the last mode is restored");
    assert_eq!(value(&mut desk, LEFT, 0), 6);
    assert!(!desk.0.lose_contact(Port::OutB, Duration::from_millis(500)));
}

#[test]
fn the_calibration_mode_loses_contact_by_itself() {
    let mut desk = Desk::new();
    desk.put(&format!("{LEFT}mode"), "COL-CAL");
    desk.step(800);
    assert_eq!(desk.try_get(&format!("{LEFT}value0")), Err(Errno::ENXIO));
}

#[test]
fn a_short_silence_needs_no_introduction() {
    let mut desk = Desk::new();
    assert!(desk.0.lose_contact(Port::In2, Duration::from_millis(300)));
    for _ in 0..200 {
        desk.step(2);
        assert_eq!(value(&mut desk, LEFT, 0), 92);
    }
    desk.put(&format!("{LEFT}mode"), "COL-COLOR");
    assert_eq!(desk.get(&format!("{LEFT}mode")), "COL-COLOR");
}
