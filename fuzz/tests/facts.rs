//! Facts of worlds and robots: files that somebody sends, with any numbers in them.
use bolero::{TypeGenerator, check};
use ev3_sim::facts::{Fact, Kind, Subject, Value};
use ev3_sim::{
    Color, Echo, Gripper, Hull, Machine, Options, Port, Pose, RobotSpec, Traits, WorldSpec,
};
use std::time::Duration;

/// A number: most are sizes that make sense.
#[derive(Debug, TypeGenerator)]
struct Number {
    kind: u8,
    tenths: u16,
    any: f64,
}

impl Number {
    fn value(&self) -> f64 {
        const EDGES: [f64; 9] = [
            0.0,
            -0.0,
            f64::MIN_POSITIVE,
            1e9,
            -1e9,
            1e308,
            f64::INFINITY,
            f64::NEG_INFINITY,
            f64::NAN,
        ];
        let size = f64::from(self.tenths % 2000) / 10.0;
        match self.kind {
            0..200 => size,
            200..246 => -size,
            246..250 => self.any,
            _ => EDGES[usize::from(self.tenths) % EDGES.len()],
        }
    }
}

#[derive(Debug, TypeGenerator)]
struct Any {
    form: u8,
    numbers: [Number; 8],
    choice: u8,
    rows: Vec<String>,
}

impl Any {
    fn value(&self, kind: Kind, index: usize) -> Value {
        let number = |more: usize| self.numbers[(index + more) % 8].value();
        let choice = usize::from(self.choice) + index;
        match kind {
            Kind::Number => Value::Number(number(0)),
            Kind::Channel => Value::Channel(self.choice % 6),
            Kind::Color => Value::Color(Color::rgb(self.choice, self.form, 7)),
            Kind::Port => Value::Port(Port::ALL[choice % Port::ALL.len()]),
            Kind::Text => {
                const NAMES: [&str; 6] = [
                    "lego-ev3-l-motor",
                    "lego-ev3-us",
                    "lego-ev3-gyro",
                    "lego-ev3-color",
                    "",
                    "\u{1F916}",
                ];
                Value::Text(NAMES[choice % NAMES.len()].into())
            }
            Kind::Places => {
                Value::Places((0..choice % 5).map(|at| [number(at), number(at + 1)]).collect())
            }
            Kind::Traits => {
                let some = |at: usize| (choice >> at & 1 == 1).then(|| number(at));
                Value::Traits(Traits {
                    mass: some(0),
                    friction: some(1).map(|number| number / 100.0),
                    height: some(2),
                    bounces: some(3).map(|number| number / 200.0),
                    rolls: choice >> 4 & 1 == 1,
                    ..Traits::default()
                })
            }
            Kind::Rows => Value::Rows(self.rows.clone()),
            Kind::Hull if choice % 2 == 0 => Value::Hull(Hull::Circle { radius: number(0) }),
            Kind::Hull => {
                let (width, length, offset) = (number(0), number(1), number(2));
                Value::Hull(Hull::Rectangle { width, length, offset })
            }
            Kind::WheelOptions => {
                Value::WheelOptions { inverted: choice % 2 == 0, slip: number(0) }
            }
            Kind::MotorOptions => {
                Value::MotorOptions((choice % 2 == 0).then(|| [number(0), number(1)]))
            }
            Kind::SensorOptions => Value::SensorOptions { looks_ahead: choice % 2 == 0 },
            Kind::GripperOptions => Value::GripperOptions(Gripper {
                opening: number(0),
                force: number(1),
                torque: number(2),
                lifts: choice % 2 == 0,
                ..Gripper::default()
            }),
            Kind::EchoOptions => Value::EchoOptions(Echo {
                half_angle: number(0),
                incidence: number(1),
                miss: number(2),
                spurious: number(3),
            }),
        }
    }

    /// Errors of a world that cannot be drawn like that are answers, too.
    fn fact(&self, subject: Subject) -> Option<Fact> {
        let forms: Vec<_> = subject.forms().map(|(form, _)| form).collect();
        let form = forms[usize::from(self.form) % forms.len()];
        let kinds = form.arguments.iter().enumerate();
        let values: Vec<_> = kinds.map(|(index, (_, kind))| self.value(*kind, index)).collect();
        Fact::of(form.name, &values).ok().flatten()
    }
}

/// A robot that drives.
fn educator() -> Vec<Fact> {
    use Value::{Number, Port as At, Text};
    let port = |name| *Port::ALL.iter().find(|port| port.name() == name).unwrap();
    let [left, right] = [port("outB"), port("outC")];
    let motor = |port| ("motor", vec![At(port), Text("lego-ev3-l-motor".into())]);
    [
        ("left_wheel", vec![At(left), Number(5.6)]),
        ("right_wheel", vec![At(right), Number(5.6)]),
        ("axle", vec![Number(11.8)]),
        ("hull", vec![Value::Hull(Hull::Circle { radius: 9.0 })]),
        ("mass", vec![Number(0.8)]),
        motor(left),
        motor(right),
    ]
    .iter()
    .map(|(name, values)| Fact::of(name, values).unwrap().unwrap())
    .collect()
}

/// Where a robot comes to that drives for two seconds, if there can be such a robot in such a world.
fn driven(world: &[Fact], robot: &[Fact]) -> Option<Pose> {
    let robot = RobotSpec::from_facts(robot).ok()?;
    let mut machine =
        Machine::new(&WorldSpec::from_facts(world), &robot, Options::default()).ok()?;
    machine.step(Duration::from_secs(1));
    for (motor, speed) in [("motor0", "700"), ("motor1", "300")] {
        for (file, text) in [("speed_sp", speed), ("command", "run-forever")] {
            // The facts may have another motor there, or none.
            if let Ok(node) = machine.resolve(&format!("tacho-motor/{motor}/{file}")) {
                machine.write(node, text.as_bytes()).unwrap();
            }
        }
    }
    for _ in 0..3 {
        machine.step(Duration::from_millis(700));
    }
    Some(machine.pose())
}

#[test]
fn a_world_is_refused_or_its_robot_is_somewhere() {
    assert!(driven(&[], &educator()).unwrap().x > 1.0);
    check!().with_type::<(Vec<Any>, Vec<Any>, u8)>().for_each(|(world, robot, few)| {
        let some = |all: &[Any], count: u8, subject| -> Vec<Fact> {
            all.iter().take(count.into()).filter_map(|any| any.fact(subject)).collect()
        };
        let world = some(world, few % 8, Subject::World);
        let robot = [educator(), some(robot, few / 64, Subject::Robot)].concat();
        if let Some(pose) = driven(&world, &robot) {
            let all = [pose.x, pose.y, pose.heading];
            assert!(all.iter().all(|number| number.abs() < 1e6), "{pose:?}");
        }
    });
}
