//! Worker of `benches/run.py`: reads `IMPLEMENTATION CASE COUNT` lines, answers
//! each with the seconds one call took.
#[path = "../../../crates/sim/tests/it/robots.rs"]
mod robots;

use ev3_driver::error::Access;
use ev3_driver::motor::wait::Reason;
use ev3_driver::motor::{Extent, Move, MoveOptions, Run, Speed, run_forever, run_to};
use ev3_driver::sysfs::{AttributeFile, Entry, Sysfs};
use ev3_driver::{Error, Registry, SysfsDir};
use ev3_sim::{Mount, Shared};
use ev3dev_lang_rust::motors::{LargeMotor, MotorPort, TachoMotor};
use ev3dev_lang_rust::sensors::{ColorSensor, GyroSensor, Sensor, SensorPort, UltrasonicSensor};
use robots::default_machine;
use std::fs::File;
use std::io::{self, BufRead, Write};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

type Case = Box<dyn FnMut()>;

fn main() {
    let root = PathBuf::from(std::env::var_os("EV3DEV_SYSFS").expect("EV3DEV_SYSFS is set"));
    for line in io::stdin().lock().lines() {
        let line = line.expect("a line");
        let words: Vec<&str> = line.split_whitespace().collect();
        let [implementation, case, count] = words[..] else { continue };
        let count: u32 = count.parse().expect("a count");
        let seconds = match case {
            "gap" => vec![gap(&root, count)],
            "latency" => latency(count).to_vec(),
            "journal" => vec![journal(&root, count)],
            _ => vec![per_call(prepare(implementation, case, &root), count)],
        };
        println!("{}", seconds.iter().map(|s| format!("{s:e}")).collect::<Vec<_>>().join(" "));
        io::stdout().flush().expect("a reader");
    }
}

fn per_call(mut case: Case, count: u32) -> f64 {
    case();
    let start = Instant::now();
    for _ in 0..count {
        case();
    }
    start.elapsed().as_secs_f64() / f64::from(count)
}

fn prepare(implementation: &str, case: &str, root: &Path) -> Case {
    match implementation {
        "floor" => floor(case, root),
        "rust" => others(case),
        _ => panic!("no implementation {implementation}"),
    }
}

/// The bare system calls on kept descriptors: nothing is checked, looked up or
/// parsed.
fn floor(case: &str, root: &Path) -> Case {
    let opened =
        |path: &str, file: io::Result<File>| file.unwrap_or_else(|error| panic!("{path}: {error}"));
    let readable = |path: &str| opened(path, File::open(root.join(path)));
    let writable = |path: &str| opened(path, File::options().write(true).open(root.join(path)));
    let read = |file: &File| {
        let mut buffer = [0; 64];
        let length = file.read_at(&mut buffer, 0).expect("a read");
        std::hint::black_box(&buffer[..length]);
    };
    let reads = |paths: &[&str]| -> Case {
        let files: Vec<File> = paths.iter().map(|path| readable(path)).collect();
        Box::new(move || files.iter().for_each(read))
    };
    let write = |file: &File, text: &[u8]| {
        file.write_at(text, 0).expect("a write");
    };
    match case {
        "us_dist_cm" => reads(&["lego-sensor/sensor0/mode", "lego-sensor/sensor0/value0"]),
        "col_ambient" => reads(&["lego-sensor/sensor1/mode", "lego-sensor/sensor1/value0"]),
        "gyro_ang" => reads(&["lego-sensor/sensor3/mode", "lego-sensor/sensor3/value0"]),
        "position" => reads(&["tacho-motor/motor1/position"]),
        "state" => reads(&["tacho-motor/motor1/state"]),
        "motor_run" => {
            let speed = writable("tacho-motor/motor3/speed_sp");
            let command = writable("tacho-motor/motor3/command");
            Box::new(move || {
                write(&speed, b"525\n");
                write(&command, b"run-forever\n");
            })
        }
        "vehicle2" => {
            let side = |sensor: &str, motor: &str| {
                [
                    readable(&format!("lego-sensor/{sensor}/mode")),
                    readable(&format!("lego-sensor/{sensor}/value0")),
                    writable(&format!("tacho-motor/{motor}/speed_sp")),
                    writable(&format!("tacho-motor/{motor}/command")),
                ]
            };
            let sides = [side("sensor1", "motor1"), side("sensor2", "motor2")];
            Box::new(move || {
                for [mode, value, speed, command] in &sides {
                    read(mode);
                    read(value);
                    write(speed, b"441\n");
                    write(command, b"run-forever\n");
                }
            })
        }
        _ => panic!("no case {case}"),
    }
}

/// Puts a sensor into a mode if it is in another: what the pack does, too.
fn ensure(sensor: &impl Sensor, mode: &str) {
    if sensor.get_mode().expect("a mode") != mode {
        sensor.set_mode(mode).expect("a mode of its own");
    }
}

/// The same by ev3dev-lang-rust. Registry are found once.
fn others(case: &str) -> Case {
    let motor = |port| LargeMotor::get(port).expect("a motor");
    match case {
        "us_dist_cm" => {
            let sensor = UltrasonicSensor::get(SensorPort::In1).expect("a sensor");
            Box::new(move || {
                ensure(&sensor, UltrasonicSensor::MODE_US_DIST_CM);
                std::hint::black_box(sensor.get_distance_centimeters().expect("a distance"));
            })
        }
        "col_ambient" => {
            let sensor = ColorSensor::get(SensorPort::In2).expect("a sensor");
            Box::new(move || {
                ensure(&sensor, ColorSensor::MODE_COL_AMBIENT);
                std::hint::black_box(sensor.get_value0().expect("a value"));
            })
        }
        "gyro_ang" => {
            let sensor = GyroSensor::get(SensorPort::In4).expect("a sensor");
            Box::new(move || {
                ensure(&sensor, GyroSensor::MODE_GYRO_ANG);
                std::hint::black_box(sensor.get_value0().expect("a value"));
            })
        }
        "position" => {
            let motor = motor(MotorPort::OutB);
            Box::new(move || {
                std::hint::black_box(motor.get_position().expect("a position"));
            })
        }
        "state" => {
            let motor = motor(MotorPort::OutB);
            Box::new(move || drop(motor.get_state().expect("a state")))
        }
        "motor_run" => {
            let motor = motor(MotorPort::OutD);
            Box::new(move || {
                motor.set_speed_sp(525).expect("a speed");
                motor.run_forever().expect("a command");
            })
        }
        "vehicle2" => {
            let eyes = [SensorPort::In2, SensorPort::In3]
                .map(|port| ColorSensor::get(port).expect("a sensor"));
            let wheels = [MotorPort::OutB, MotorPort::OutC].map(motor);
            Box::new(move || {
                for (eye, wheel) in eyes.iter().zip(&wheels) {
                    ensure(eye, ColorSensor::MODE_COL_AMBIENT);
                    let light = eye.get_value0().expect("a value");
                    wheel.set_speed_sp(light * 1050 / 100).expect("a speed");
                    wheel.run_forever().expect("a command");
                }
            })
        }
        "enumerate" => Box::new(move || {
            std::hint::black_box(TachoMotor::list().expect("motors"));
        }),
        _ => panic!("no case {case}"),
    }
}

/// Seconds between the two `command` writes of a start of two wheels: the
/// median of `count` starts.
fn gap(root: &Path, count: u32) -> f64 {
    let commands = Arc::new(Mutex::new(Vec::new()));
    let tree = Stamping { files: SysfsDir::new(root), commands: Arc::clone(&commands) };
    let devices = Arc::new(Registry::new(Arc::new(tree)));
    let runs = [("outB", 20.0), ("outC", 20.0)]
        .map(|(port, percent)| Run { port, speed: Speed::Percent(percent) });
    let mut gaps: Vec<f64> = (0..=count)
        .map(|_| {
            commands.lock().expect("one thread").clear();
            assert!(run_forever(&devices, &runs, &mut || false).expect("two motors").is_some());
            let stamps = commands.lock().expect("one thread");
            stamps[1].duration_since(stamps[0]).as_secs_f64()
        })
        .skip(1)
        .collect();
    gaps.sort_by(f64::total_cmp);
    gaps[gaps.len() / 2]
}

/// Seconds that it takes to note the command of a motor in the journal, with its time.
fn journal(root: &Path, count: u32) -> f64 {
    let devices = Registry::new(Arc::new(SysfsDir::new(root)));
    let run = Run { port: "outB", speed: Speed::Percent(20.0) };
    assert!(run_forever(&devices, &[run], &mut || false).expect("a motor").is_some());
    let act = devices.journal().entries().pop().expect("an entry").act;
    per_call(Box::new(move || devices.journal().note(devices.tree().now(), act.clone())), count)
}

/// Seconds from the moment a simulated motor stops to the return of the wait
/// for it, through FUSE and with the real clock: median and worst of `count`.
fn latency(count: u32) -> [f64; 2] {
    let directory = tempfile::tempdir().expect("a directory");
    let shared = Arc::new(Shared::new(default_machine()));
    let mount = Mount::new(Arc::clone(&shared), directory.path()).expect("FUSE");
    let stopped = Arc::new(Mutex::new(Instant::now()));
    let is_over = Arc::new(AtomicBool::new(false));
    let stepper = std::thread::spawn({
        let (shared, stopped, is_over) = (shared, Arc::clone(&stopped), Arc::clone(&is_over));
        move || step(&shared, &stopped, &is_over)
    });
    let devices = Arc::new(Registry::new(Arc::new(SysfsDir::new(directory.path()))));
    let mut seconds: Vec<f64> = (0..count)
        .map(|number| {
            let degrees = 60.0 + f64::from(number % 10) * 10.0;
            let turn =
                Move { port: "outA", speed: Speed::Percent(40.0), extent: Extent::By(degrees) };
            let ended = run_to(&devices, &[turn], &MoveOptions::default(), &mut || false);
            assert_eq!(ended.expect("a motor"), Some(Reason::Reached));
            stopped.lock().expect("no panic").elapsed().as_secs_f64()
        })
        .collect();
    is_over.store(true, Ordering::Relaxed);
    stepper.join().expect("no panic");
    // Its descriptors would keep the mount busy.
    drop(devices);
    mount.unmount().expect("a mount");
    seconds.sort_by(f64::total_cmp);
    [seconds[seconds.len() / 2], seconds[seconds.len() - 1]]
}

/// Steps a machine by the wall clock, and notes when its motor stops.
fn step(shared: &Shared, stopped: &Mutex<Instant>, is_over: &AtomicBool) {
    let (mut last, mut was_running) = (Instant::now(), false);
    while !is_over.load(Ordering::Relaxed) {
        std::thread::sleep(Duration::from_millis(1));
        let mut machine = shared.lock();
        machine.step(last.elapsed());
        last = Instant::now();
        let state = machine.read_path("tacho-motor/motor0/state").expect("a motor");
        let is_running = state.contains("running");
        if was_running && !is_running {
            *stopped.lock().expect("no panic") = last;
        }
        was_running = is_running;
        drop(machine);
        shared.wake();
    }
}

/// A `SysfsDir` that notes when a command is about to be written.
struct Stamping {
    files: SysfsDir,
    commands: Arc<Mutex<Vec<Instant>>>,
}

impl Sysfs for Stamping {
    fn root(&self) -> &Path {
        self.files.root()
    }

    fn list(&self, directory: &Path) -> io::Result<Vec<Entry>> {
        self.files.list(directory)
    }

    fn open(&self, path: &Path, access: Access) -> io::Result<Box<dyn AttributeFile>> {
        let node = self.files.open(path, access)?;
        if !path.ends_with("command") {
            return Ok(node);
        }
        Ok(Box::new(StampingNode { node, commands: Arc::clone(&self.commands) }))
    }

    fn matching(&self, pattern: &str) -> Result<Vec<PathBuf>, Error> {
        self.files.matching(pattern)
    }

    fn now(&self) -> Duration {
        self.files.now()
    }

    fn pause(&self, nodes: &[&dyn AttributeFile], end: Duration) -> io::Result<bool> {
        self.files.pause(nodes, end)
    }
}

struct StampingNode {
    node: Box<dyn AttributeFile>,
    commands: Arc<Mutex<Vec<Instant>>>,
}

impl AttributeFile for StampingNode {
    fn read(&self, buffer: &mut [u8]) -> io::Result<usize> {
        self.node.read(buffer)
    }

    fn write(&self, text: &[u8]) -> io::Result<()> {
        self.commands.lock().expect("one thread").push(Instant::now());
        self.node.write(text)
    }
}
