//! Vehicles that are drawn to a lamp, or flee it: the paper's first programs.
use crate::desk::{B, C, Desk};
use crate::robots::{default_robot, wheels};
use ev3_sim::{Bounds, Item, Pose, RobotSpec, Wheels, WorldSpec};

const LAMP: [f64; 2] = [100.0, 120.0];

/// `braitenberg2` of the paper: the eye on in2 drives outB, the one on in3 drives outC.
/// Answers how near the robot came to the lamp, and how far it was at the end.
fn vehicle_2(robot: &RobotSpec, start: Pose) -> (f64, f64) {
    let world = WorldSpec {
        items: vec![Item::Lamp { at: LAMP, intensity: 25.0 }],
        bounds: Some(Bounds { low: [0.0, 0.0], high: [200.0, 200.0] }),
        ambient: 5.0,
        start,
        ..WorldSpec::default()
    };
    let mut desk = Desk::with(&world, robot);
    for eye in ["lego-sensor/sensor1/mode", "lego-sensor/sensor2/mode"] {
        desk.put(eye, "COL-AMBIENT");
    }
    let away = |desk: &Desk| {
        let pose = desk.0.pose();
        (pose.x - LAMP[0]).hypot(pose.y - LAMP[1])
    };
    let mut nearest = f64::INFINITY;
    for _ in 0..3000 {
        for (eye, motor) in [("sensor1", B), ("sensor2", C)] {
            let light = desk.number(&format!("lego-sensor/{eye}/value0"));
            desk.run(motor, &[("speed_sp", light * 1050 / 100)], "run-forever");
        }
        desk.step(10);
        nearest = nearest.min(away(&desk));
    }
    (nearest, away(&desk))
}

#[test]
fn vehicle_2_flees_the_lamp_and_its_crossed_twin_reaches_it() {
    for start in [Pose::new(80.0, 40.0, 0.0), Pose::new(130.0, 50.0, -20.0)] {
        let begin = (start.x - LAMP[0]).hypot(start.y - LAMP[1]);
        let (nearest, _) = vehicle_2(&default_robot(), start);
        assert!(nearest > 30.0, "shy: {nearest} from {begin}");
        let mut crossed = default_robot();
        let Wheels { left, right, .. } = wheels(&mut crossed);
        std::mem::swap(&mut left.port, &mut right.port);
        let (nearest, _) = vehicle_2(&crossed, start);
        assert!(nearest < 10.0, "crossed: {nearest} from {begin}");
    }
}
