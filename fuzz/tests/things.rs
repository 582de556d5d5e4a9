//! Things that a robot pushes and grips, anywhere in a small room: whatever it does, all stay where
//! they can be, and nothing gets into anything else.
use bolero::{TypeGenerator, check};
use ev3_sim::{
    Bounds, Gripper, Hull, Item, Machine, MotorMount, Options, Port, Pose, RobotSpec, Traits,
    Wheel, Wheels, WorldSpec,
};
use std::time::Duration;

/// Half of the room's width and depth, in cm.
const HALF: f64 = 60.0;

#[derive(Debug, TypeGenerator)]
struct Load {
    at: [i8; 2],
    size: u8,
    mass: u8,
    heading: i8,
    friction: u8,
    bounces: u8,
    is_round: bool,
    rolls: bool,
}

impl Load {
    fn item(&self) -> Item {
        let [x, y] = self.at.map(|it| f64::from(it) / 4.0);
        let radius = 0.6 + f64::from(self.size % 40) / 5.0;
        let traits = Traits {
            mass: Some(0.005 + f64::from(self.mass).powi(2) / 5000.0),
            friction: Some(f64::from(self.friction) / 128.0),
            bounces: Some(f64::from(self.bounces % 91) / 100.0),
            rolls: self.rolls && self.is_round,
            ..Traits::default()
        };
        if self.is_round {
            return Item::Circle { center: [x, y], radius, traits };
        }
        let pose = Pose { x, y, heading: f64::from(self.heading) };
        Item::Box { pose, width: 2.0 * radius, depth: 1.0 + f64::from(self.size / 16), traits }
    }
}

/// What the robot does for 0.4 s: the speeds of its wheels, and its jaws.
#[derive(Debug, TypeGenerator)]
struct Deed {
    speeds: [i8; 2],
    closes: bool,
}

fn robot() -> RobotSpec {
    let wheel = |port| Wheel { port, diameter: 5.6, inverted: false, slip: 0.0 };
    let motor = |port| MotorMount {
        port,
        driver: "lego-ev3-l-motor".into(),
        noise: None,
        encoder_noise: None,
        stops: None,
    };
    RobotSpec {
        wheels: Some(Wheels { left: wheel(Port::OutB), right: wheel(Port::OutC), axle: 10.6 }),
        hull: Hull::Circle { radius: 8.0 },
        mass: 0.85,
        motors: vec![
            MotorMount { stops: Some([0.0, 90.0]), ..motor(Port::OutA) },
            motor(Port::OutB),
            motor(Port::OutC),
        ],
        grippers: vec![Gripper { at: [0.0, 11.0], opening: 9.0, ..Gripper::default() }],
        sensors: Vec::new(),
    }
}

fn acts(machine: &mut Machine, deeds: &[Deed]) {
    for Deed { speeds, closes } in deeds {
        let jaws = if *closes { 40 } else { -40 };
        let [left, right] = speeds.map(i32::from);
        for (motor, duty) in [(0, jaws), (1, left), (2, right)] {
            let (duty, command) = ((duty * 100 / 128).to_string(), "run-direct");
            for (file, text) in [("duty_cycle_sp", duty.as_str()), ("command", command)] {
                let node = machine.resolve(&format!("tacho-motor/motor{motor}/{file}")).unwrap();
                machine.write(node, text.as_bytes()).unwrap();
            }
        }
        machine.step(Duration::from_millis(400));
    }
}

#[test]
fn things_stay_apart_and_in_the_room() {
    check!().with_type::<(Vec<Load>, Vec<Deed>)>().for_each(|(loads, deeds)| {
        let bounds = Some(Bounds { low: [-HALF; 2], high: [HALF; 2] });
        let world = WorldSpec { bounds, ..WorldSpec::default() };
        let mut machine = Machine::new(&world, &robot(), Options::default()).unwrap();
        for load in loads.iter().take(20) {
            // What does not fit is refused.
            let _ = machine.add_item(load.item());
        }
        let (first, rest) = deeds.split_at(deeds.len().min(4));
        acts(&mut machine, first);
        let mut again = machine.clone();
        for machine in [&mut machine, &mut again] {
            acts(machine, &rest[..rest.len().min(4)]);
        }
        assert_eq!(machine.world_facts(), again.world_facts());
        let gaps = machine.gaps();
        assert!(gaps.iter().all(|gap| *gap > -0.001), "{gaps:?}");
        let poses = machine.things().iter().map(ev3_sim::Thing::pose).chain([machine.pose()]);
        for pose in poses {
            assert!([pose.x, pose.y].iter().all(|it| it.abs() < HALF), "{pose:?}");
        }
    });
}
