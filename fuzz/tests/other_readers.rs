//! Pictures, JSON, tasks of the planner, and what a fenced program asks the machine.
use bolero::{TypeGenerator, check};
use ev3_driver::brick::screen::picture::Picture;
use ev3_json::Json;
use ev3_planner::{Action, Effect, Formula, Limits, Planner, Progress, Rule, Task};
use ev3_sim::far::{Host, Kind, Question};
use ev3_sim::{Hull, Machine, MotorMount, Options, RobotSpec, WorldSpec};
use std::time::Duration;

/// A PNG and a PBM of one pixel.
const SEEDS: [&[u8]; 2] = [
    b"\x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x00\x00\x00\x00:~\x9bU\x00\x00\x00\x0aIDATx\x9cc\xf8\x0f\x00\x01\x01\x01\x00\xb18\xf6\x14\x00\x00\x00\x00IEND\xaeB`\x82",
    b"P4\n9 2\n\xff\x80\x00\x80",
];

#[test]
fn a_picture_is_read_or_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.png");
    for seed in SEEDS {
        std::fs::write(&path, seed).unwrap();
        Picture::read(&path).unwrap();
    }
    check!().with_type::<(bool, Vec<(u8, u8)>, Vec<u8>)>().for_each(|(png, edits, more)| {
        let mut bytes = SEEDS[usize::from(!png)].to_vec();
        bytes.extend(more);
        for (at, byte) in edits {
            let at = usize::from(*at) % bytes.len();
            bytes[at] = *byte;
        }
        std::fs::write(&path, bytes).unwrap();
        let _ = Picture::read(&path);
    });
}

#[test]
fn any_text_and_number_is_json() {
    check!().with_type::<(String, f64, i64, u8, Vec<u8>)>().for_each(
        |(text, number, integer, places, bytes)| {
            let mut json = Json::new();
            json.object(|json| {
                json.key("key").array(|json| {
                    json.text(text);
                    json.number(*number, u32::from(*places));
                    json.integer(*integer);
                    json.base64(bytes);
                });
            });
            let read: serde_json::Value = serde_json::from_str(json.as_text()).unwrap();
            let values = &read["key"];
            assert_eq!(values[0], text.as_str());
            assert_eq!(values[2], *integer);
        },
    );
}

#[derive(Clone, Debug, TypeGenerator)]
enum Part {
    Fact(u8),
    Not,
    And(u8),
    Or(u8),
}

/// A formula from its parts, in the order of a stack.
fn formula(parts: &[Part], facts: usize) -> Formula {
    let mut stack = vec![];
    for part in parts {
        let next = match part {
            // One in a hundred is of no fact.
            Part::Fact(fact) if *fact > 252 => Formula::Fact(usize::from(*fact)),
            Part::Fact(fact) => Formula::Fact(usize::from(*fact) % facts),
            Part::Not => Formula::Not(Box::new(stack.pop().unwrap_or(Formula::TRUE))),
            Part::And(count) => {
                Formula::And(stack.split_off(stack.len().saturating_sub(usize::from(count % 4))))
            }
            Part::Or(count) => {
                Formula::Or(stack.split_off(stack.len().saturating_sub(usize::from(count % 4))))
            }
        };
        stack.push(next);
    }
    stack.pop().unwrap_or(Formula::TRUE)
}

/// A condition, the fact, and whether it becomes true.
type AnyEffect = (Vec<Part>, u8, bool);

#[derive(Debug, TypeGenerator)]
struct AnyTask {
    facts: u8,
    initial: Vec<u8>,
    actions: Vec<(Vec<Part>, Vec<AnyEffect>, u32)>,
    rules: Vec<(u8, Vec<Part>)>,
    goal: Vec<Part>,
    is_cheapest: bool,
}

#[test]
fn a_plan_has_the_actions_of_its_task() {
    check!().with_type::<AnyTask>().for_each(|any| {
        let facts = usize::from(any.facts % 16) + 1;
        let fact = |number: u8| if number > 252 { 999 } else { usize::from(number) % facts };
        let effect = |(condition, at, value): &AnyEffect| Effect {
            condition: formula(condition, facts),
            fact: fact(*at),
            value: *value,
        };
        let task = Task {
            facts,
            initial: any.initial.iter().map(|at| fact(*at)).collect(),
            actions: (any.actions.iter())
                .map(|(condition, effects, cost)| Action {
                    condition: formula(condition, facts),
                    effects: effects.iter().map(effect).collect(),
                    cost: *cost,
                })
                .collect(),
            rules: (any.rules.iter())
                .map(|(at, condition)| Rule {
                    fact: fact(*at),
                    condition: formula(condition, facts),
                })
                .collect(),
            goal: formula(&any.goal, facts),
            concurrent: None,
        };
        let limits = Limits { cheapest: any.is_cheapest, bytes: 1 << 20 };
        let Ok(mut planner) = Planner::new(&task, &limits) else { return };
        for _ in 0..20 {
            match planner.work(500) {
                Progress::Working => {}
                Progress::Plan(plan) => {
                    return assert!(plan.iter().all(|action| *action < task.actions.len()));
                }
                _ => return,
            }
        }
    });
}

#[derive(Debug, TypeGenerator)]
struct Asked {
    kind: u8,
    later: u32,
    flags: u8,
    number: u64,
    offset: u32,
    count: u32,
    path: u8,
    bytes: Vec<u8>,
}

const PATHS: [&str; 8] = [
    "/",
    "tacho-motor/motor0/command",
    "tacho-motor/motor0/speed_sp",
    "lego-port/port0/mode",
    "fb0",
    "input/event1",
    "run-forever",
    "reset",
];

#[test]
fn a_fenced_program_may_ask_anything() {
    let mount = |port: &str| MotorMount {
        port: port.parse().unwrap(),
        driver: "lego-ev3-l-motor".into(),
        noise: None,
        encoder_noise: None,
        stops: None,
    };
    let robot = RobotSpec {
        wheels: None,
        hull: Hull::Circle { radius: 9.0 },
        mass: 1.0,
        motors: vec![mount("outB"), mount("outC")],
        sensors: vec![],
        grippers: vec![],
    };
    let machine = Machine::new(&WorldSpec::default(), &robot, Options::default()).unwrap();
    for path in &PATHS[1..4] {
        machine.resolve(path).unwrap();
    }
    check!().with_type::<Vec<Asked>>().for_each(|all| {
        let (mut machine, mut host) = (machine.clone(), Host::default());
        let mut now = Duration::ZERO;
        for asked in all {
            now += Duration::from_micros(u64::from(asked.later % 5000));
            let at = if asked.flags & 4 == 0 { now } else { Duration::from_nanos(asked.number) };
            let Some(kind) = Kind::of(asked.kind % 17) else { continue };
            let path = PATHS[usize::from(asked.path) % PATHS.len()].as_bytes();
            let question = Question {
                kind,
                at,
                is_free: asked.flags & 1 != 0,
                is_known: asked.flags & 2 != 0,
                number: if asked.flags & 8 == 0 { asked.number % 200 } else { asked.number },
                offset: if asked.flags & 16 == 0 { 0 } else { asked.offset },
                // As the wire has it
                count: asked.count % (1 << 18),
                bytes: if asked.flags & 32 == 0 { path } else { &asked.bytes },
            };
            if host.admit(&question).is_ok() {
                host.answer(&mut machine, &question, now + Duration::from_millis(5));
                machine.step(Duration::from_micros(u64::from(asked.later % 5000)));
            }
        }
    });
}
