//! Laws that hold for every program, every world and every slicing of time.
use crate::desk::{A, B, C, Desk, furnished};
use crate::robots::default_robot;
use ev3_sim::{Bounds, Hull, Item, Machine, Options, Port, Pose, RobotSpec, WorldSpec};
use proptest::prelude::*;
use std::fmt::Write;
use std::time::Duration;

const FLAGS: [&str; 5] = ["running", "ramping", "holding", "overloaded", "stalled"];

/// One thing that a program does, and how long it waits then.
#[derive(Clone, Debug)]
struct Deed {
    motor: &'static str,
    file: &'static str,
    text: String,
    wait_us: u64,
}

fn deeds(most: usize) -> impl Strategy<Value = Vec<Deed>> {
    let word = |file: &'static str, words: &'static [&'static str]| {
        prop::sample::select(words).prop_map(move |word| (file, word.to_owned()))
    };
    let number = |file: &'static str, range: std::ops::RangeInclusive<i32>| {
        range.prop_map(move |number| (file, number.to_string()))
    };
    let commands = &[
        "run-forever",
        "run-to-abs-pos",
        "run-to-rel-pos",
        "run-timed",
        "run-direct",
        "stop",
        "reset",
    ];
    let write = prop_oneof![
        6 => word("command", commands),
        2 => word("stop_action", &["coast", "brake", "hold"]),
        1 => word("polarity", &["normal", "inversed"]),
        3 => number("speed_sp", -1050..=1050),
        2 => number("position_sp", -1000..=1000),
        1 => number("time_sp", 0..=800),
        2 => number("duty_cycle_sp", -100..=100),
        1 => number("ramp_up_sp", 0..=1500),
        1 => number("ramp_down_sp", 0..=1500),
        1 => number("position", -500..=500),
    ];
    let motor = prop::sample::select(&[A, B, B, C, C][..]);
    let deed = (motor, write, 0u64..400_000).prop_map(|(motor, (file, text), wait_us)| Deed {
        motor,
        file,
        text,
        wait_us,
    });
    prop::collection::vec(deed, 1..most)
}

fn noisy_room(seed: u64) -> Desk {
    let robot = default_robot().with_typical_noise();
    let options = Options { seed, ..Options::default() };
    Desk(Machine::new(&furnished(), &robot, options).unwrap())
}

fn act(desk: &mut Desk, deed: &Deed) {
    desk.put(&format!("{}{}", deed.motor, deed.file), &deed.text);
}

/// Every readable byte of motors and sensors, and the pose.
fn everything(desk: &mut Desk) -> String {
    let mut all = format!("{:?} {:?}\n", desk.0.now(), desk.0.pose());
    for class in ["tacho-motor", "lego-sensor", "power_supply"] {
        let class_node = desk.0.resolve(class).unwrap();
        for device in desk.0.read_dir(class_node).unwrap() {
            for file in desk.0.read_dir(device.node).unwrap() {
                let text = desk.0.read(file.node);
                writeln!(all, "{class} {} {} {text:?}", device.name, file.name).unwrap();
            }
        }
    }
    all
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn slicing_time_changes_nothing(program in deeds(12), slices in prop::collection::vec(1u64..9000, 1..20)) {
        let mut whole = noisy_room(3);
        let mut sliced = noisy_room(3);
        for deed in &program {
            act(&mut whole, deed);
            act(&mut sliced, deed);
            whole.0.step(Duration::from_micros(deed.wait_us));
            let mut left = deed.wait_us;
            for slice in slices.iter().cycle() {
                let slice = (*slice).min(left);
                sliced.0.step(Duration::from_micros(slice));
                left -= slice;
                if left == 0 {
                    break;
                }
            }
        }
        prop_assert_eq!(everything(&mut whole), everything(&mut sliced));
    }

    #[test]
    fn states_are_legal_and_change_only_along_the_machine(program in deeds(12)) {
        let mut desk = noisy_room(1);
        for deed in &program {
            act(&mut desk, deed);
            let mut before = desk.state(deed.motor);
            for _ in 0..deed.wait_us / 2000 {
                let now = desk.state(deed.motor);
                let flags: Vec<&str> = now.split_whitespace().collect();
                let places: Vec<_> = flags.iter().map(|f| FLAGS.iter().position(|g| f == g)).collect();
                prop_assert!(places.iter().all(Option::is_some) && places.is_sorted(), "{}", now);
                let has = |text: &str, flag: &str| text.split_whitespace().any(|word| word == flag);
                prop_assert!(!(has(&now, "running") && has(&now, "holding")), "{}", now);
                prop_assert!(!has(&now, "stalled") || has(&now, "running"), "{}", now);
                // Without a command, holding is never left, and running comes only out of a ramp
                // that a timed run's end left behind.
                if has(&before, "holding") {
                    prop_assert!(has(&now, "holding") || has(&before, "ramping"), "{} -> {}", before, now);
                }
                if has(&now, "running") && !has(&before, "running") {
                    prop_assert!(has(&before, "ramping"), "{} -> {}", before, now);
                }
                before = now;
                desk.step(2);
            }
        }
    }

    #[test]
    fn positions_are_continuous(program in deeds(12)) {
        let mut desk = noisy_room(2);
        for deed in &program {
            act(&mut desk, deed);
            for _ in 0..deed.wait_us / 2000 {
                let before = (desk.0.pose(), [Port::OutA, Port::OutB, Port::OutC].map(|p| desk.0.shaft_angle(p)));
                desk.step(2);
                let pose = desk.0.pose();
                let way = (pose.x - before.0.x).hypot(pose.y - before.0.y);
                prop_assert!(way < 0.15 && (pose.heading - before.0.heading).abs() < 1.5, "{way}");
                for (port, old) in [Port::OutA, Port::OutB, Port::OutC].into_iter().zip(before.1) {
                    prop_assert!((desk.0.shaft_angle(port) - old).abs() < 4.0);
                }
            }
        }
    }

    #[test]
    fn no_hull_is_ever_inside_anything(
        program in deeds(16),
        boxes in prop::collection::vec((-60.0..60.0f64, -60.0..60.0f64, 0.0..180.0f64, 3.0..30.0f64), 1..6),
        rectangle in any::<bool>(),
    ) {
        let items = boxes.into_iter().map(|(x, y, heading, size)| {
            Item::boxed(Pose::new(x, y, heading), size, size / 2.0)
        });
        let rectangular = Hull::Rectangle { width: 13.0, length: 19.0, offset: 2.0 };
        let hull = if rectangle { rectangular } else { Hull::Circle { radius: 8.0 } };
        let robot = RobotSpec { hull, ..default_robot() };
        let bounds = Some(Bounds { low: [-70.0, -70.0], high: [70.0, 70.0] });
        let mut desk = Desk::with(&WorldSpec { bounds, ..WorldSpec::default() }, &robot);
        for item in items {
            // What would stand on the robot is left out.
            let _ = desk.0.add_item(item);
        }
        for deed in &program {
            act(&mut desk, deed);
            for _ in 0..deed.wait_us / 10_000 {
                desk.step(10);
                let mut copy = desk.0.clone();
                prop_assert!(copy.place(desk.0.pose()).is_ok(), "inside something: {:?}", desk.0.pose());
            }
        }
    }

    #[test]
    fn odometry_tells_the_truth_where_nothing_slips(program in deeds(12)) {
        let mut desk = Desk::new();
        let mut x = 0.0;
        let mut y = 0.0;
        let mut heading: f64 = 0.0;
        let mut old = [0.0; 2];
        for deed in &program {
            act(&mut desk, deed);
            for _ in 0..deed.wait_us / 2000 {
                desk.step(2);
                let angles = [Port::OutB, Port::OutC].map(|port| desk.0.shaft_angle(port));
                let [left, right] = [0, 1].map(|wheel: usize| (angles[wheel] - old[wheel]).to_radians() * 2.8);
                let turned = ((left - right) / 10.6_f64).to_degrees();
                let middle = (heading + turned / 2.0).to_radians();
                x += middle.sin() * f64::midpoint(left, right);
                y += middle.cos() * f64::midpoint(left, right);
                heading += turned;
                old = angles;
            }
        }
        let pose = desk.0.pose();
        prop_assert!((pose.x - x).hypot(pose.y - y) < 1e-6, "{:?} {} {}", pose, x, y);
        prop_assert!((pose.heading - heading).abs() < 1e-6);
    }

    #[test]
    fn energy_never_appears_from_nothing(program in deeds(8), action in prop::sample::select(&["coast", "brake"][..])) {
        let mut desk = noisy_room(4);
        for deed in &program {
            act(&mut desk, deed);
            desk.0.step(Duration::from_micros(deed.wait_us));
        }
        for motor in [A, B, C] {
            desk.put(&format!("{motor}ramp_up_sp"), 0);
            desk.put(&format!("{motor}ramp_down_sp"), 0);
            desk.put(&format!("{motor}stop_action"), action);
            desk.put(&format!("{motor}command"), "stop");
        }
        let mut energy = desk.0.kinetic_energy();
        for _ in 0..2000 {
            desk.step(2);
            let now = desk.0.kinetic_energy();
            prop_assert!(now <= energy + 1e-12, "{} -> {}", energy, now);
            energy = now;
        }
        prop_assert!(energy < 1e-9, "comes to rest: {}", energy);
    }
}
