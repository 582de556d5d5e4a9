//! The mounted tree through the kernel: real files, real descriptors, a clock in real time.
//!
//! `cargo test -p ev3-sim --features fuse --test fuse`. If there is no FUSE, these tests say
//! so and check nothing.

#[path = "it/robots.rs"]
mod robots;

use ev3_sim::{Button, Errno, Machine, Mount, MountError, Port, Shared, WorldSpec};
use robots::{default_machine, default_robot};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::os::unix::fs::{FileExt, MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

/// A test that waits longer waits for what never comes, or the machine is much too busy.
const GUARD: Duration = Duration::from_secs(300);

/// A mounted brick with a clock.
struct Bench {
    mount: Option<Mount>,
    shared: Arc<Shared>,
    stop: Arc<AtomicBool>,
    clock: Option<JoinHandle<()>>,
    root: PathBuf,
}

impl Bench {
    /// None where the machine has no FUSE.
    fn new(name: &str) -> Option<Bench> {
        let root = std::env::temp_dir().join(format!("ev3-sim-{}-{name}", std::process::id()));
        fs::create_dir_all(&root).unwrap();
        let machine =
            Machine::new(&WorldSpec::default(), &default_robot(), ev3_sim::Options::default());
        let shared = Arc::new(Shared::new(machine.unwrap()));
        let mount = match Mount::new(Arc::clone(&shared), &root) {
            Ok(mount) => mount,
            Err(error) => {
                fs::remove_dir(&root).unwrap();
                eprintln!("skipped: {error}");
                return None;
            }
        };
        let stop = Arc::new(AtomicBool::new(false));
        let clock = std::thread::spawn({
            let (shared, stop) = (Arc::clone(&shared), Arc::clone(&stop));
            move || {
                let start = Instant::now();
                while !stop.load(Ordering::SeqCst) {
                    std::thread::sleep(Duration::from_millis(2));
                    let behind = start.elapsed().saturating_sub(shared.lock().now());
                    shared.step(behind);
                }
            }
        });
        Some(Bench { mount: Some(mount), shared, stop, clock: Some(clock), root })
    }

    fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }

    fn get(&self, name: &str) -> io::Result<String> {
        fs::read_to_string(self.path(name))
    }

    fn put(&self, name: &str, text: &str) -> io::Result<()> {
        fs::write(self.path(name), text)
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        let unmounted = self.mount.take().map(Mount::unmount);
        self.stop.store(true, Ordering::SeqCst);
        self.clock.take().map(JoinHandle::join);
        fs::remove_dir(&self.root).unwrap();
        if !std::thread::panicking() {
            unmounted.unwrap().unwrap();
        }
    }
}

fn errno<T>(result: io::Result<T>) -> Option<Errno> {
    result.err().and_then(|error| error.raw_os_error()).map(Errno)
}

/// Waits for POLLPRI or POLLERR.
fn wait(file: &File, at_most: Duration) -> PollFlags {
    let mut fds = [PollFd::new(file, PollFlags::PRI | PollFlags::ERR)];
    poll(&mut fds, Some(&Timespec::try_from(at_most).unwrap())).unwrap();
    fds[0].revents()
}

fn read_again(file: &File) -> io::Result<String> {
    let mut buffer = [0; 64];
    let length = file.read_at(&mut buffer, 0)?;
    Ok(String::from_utf8_lossy(&buffer[..length]).into_owned())
}

#[test]
fn programs_of_the_shell_work() {
    let Some(bench) = Bench::new("shell") else {
        return;
    };
    let shell = |line: &str| {
        let output = Command::new("sh").arg("-c").arg(line).current_dir(&bench.root).output();
        let output = output.unwrap();
        (output.status.success(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    assert_eq!(shell("ls tacho-motor"), (true, "motor0\nmotor1\nmotor2\n".to_owned()));
    let text = (true, "lego-ev3-l-motor\n".to_owned());
    assert_eq!(shell("cat tacho-motor/motor1/driver_name"), text);
    assert!(shell("echo 300 > tacho-motor/motor1/speed_sp").0);
    assert!(shell("echo run-forever >> tacho-motor/motor1/command").0);
    assert_eq!(shell("cat tacho-motor/motor1/state"), (true, "running\n".to_owned()));
    assert!(!shell("echo 5000 > tacho-motor/motor1/speed_sp").0);
    assert_eq!(shell("cat tacho-motor/motor1/speed_sp"), (true, "300\n".to_owned()));
    assert_eq!(shell("stat -c %a tacho-motor/motor1/command").1, "220\n");
    assert!(shell("find . -name Kp | wc -l").1.trim() == "6");
}

#[test]
fn errors_are_the_kernels() {
    let Some(bench) = Bench::new("errors") else {
        return;
    };
    let motor = |name: &str| format!("tacho-motor/motor1/{name}");
    assert_eq!(errno(bench.put(&motor("speed_sp"), "1051")), Some(Errno::EINVAL));
    assert_eq!(errno(bench.put(&motor("speed_sp"), "99999999999")), Some(Errno::ERANGE));
    assert_eq!(errno(bench.put(&motor("state"), "running")), Some(Errno::EACCES));
    assert_eq!(errno(bench.get(&motor("command"))), Some(Errno::EACCES));
    assert_eq!(errno(bench.get(&motor("color"))), Some(Errno::ENOENT));
    assert_eq!(errno(bench.get("lego-sensor/sensor0/value1")), Some(Errno::ENXIO));
    assert_eq!(errno(bench.get("lego-sensor/sensor0/poll_ms")), Some(Errno::EOPNOTSUPP));
    assert_eq!(errno(fs::remove_file(bench.path(&motor("state")))), Some(Errno::EPERM));
    assert_eq!(errno(bench.put(&motor("color"), "red")), Some(Errno::EACCES));
    assert_eq!(fs::metadata(bench.path(&motor("state"))).unwrap().mode() & 0o777, 0o444);
    let truncated =
        OpenOptions::new().write(true).truncate(true).open(bench.path(&motor("position")));
    truncated.unwrap().write_all(b"7\n").unwrap();
    assert_eq!(bench.get(&motor("position")).unwrap(), "7\n");
}

#[test]
fn poll_wakes_when_a_move_is_over() {
    let Some(bench) = Bench::new("poll") else {
        return;
    };
    let state = File::open(bench.path("tacho-motor/motor1/state")).unwrap();
    assert!(wait(&state, Duration::ZERO).contains(PollFlags::PRI | PollFlags::ERR), "never read");
    assert_eq!(read_again(&state).unwrap(), "\n");
    assert!(wait(&state, Duration::from_millis(120)).is_empty(), "nothing happens");
    bench.put("tacho-motor/motor1/speed_sp", "400").unwrap();
    bench.put("tacho-motor/motor1/time_sp", "400").unwrap();
    bench.put("tacho-motor/motor1/command", "run-timed").unwrap();
    let start = Instant::now();
    let mut wakes = 0;
    while read_again(&state).unwrap().contains("running") {
        assert!(wait(&state, GUARD).contains(PollFlags::PRI));
        wakes += 1;
    }
    let took = start.elapsed();
    assert!(took > Duration::from_millis(380), "{took:?}");
    assert!(wakes <= 4, "woken {wakes} times");
}

#[test]
fn an_unplugged_device_says_so_on_old_descriptors() {
    let Some(bench) = Bench::new("unplug") else {
        return;
    };
    let mut state = File::open(bench.path("tacho-motor/motor1/state")).unwrap();
    let mut text = String::new();
    state.read_to_string(&mut text).unwrap();
    bench.shared.lock().unplug(Port::OutB);
    assert!(wait(&state, GUARD).contains(PollFlags::PRI | PollFlags::ERR));
    assert_eq!(errno(read_again(&state)), Some(Errno::ENODEV));
    assert_eq!(errno(bench.get("tacho-motor/motor1/state")), Some(Errno::ENOENT));
}

#[test]
fn before_udev_only_root_opens_the_files_of_a_new_device() {
    let Some(bench) = Bench::new("root") else {
        return;
    };
    {
        let mut machine = bench.shared.lock();
        machine.plug(Port::OutD, "lego-ev3-l-motor").unwrap();
        machine.step(Duration::from_millis(410));
    }
    let motor = bench.root.join("tacho-motor/motor3");
    let speed = OpenOptions::new().write(true).open(motor.join("speed_sp"));
    let is_root = fs::metadata(&motor).unwrap().uid() == 0;
    assert_eq!(errno(speed), if is_root { None } else { Some(Errno::EACCES) });
    let state = OpenOptions::new().write(true).open(motor.join("state"));
    assert_eq!(errno(state), Some(Errno::EACCES), "not even root writes this");
}

#[test]
fn a_mode_write_blocks_for_its_time() {
    let Some(bench) = Bench::new("mode") else {
        return;
    };
    bench.put("lego-sensor/sensor1/mode", "COL-COLOR").unwrap();
    assert_eq!(bench.get("lego-sensor/sensor1/mode").unwrap(), "COL-COLOR\n");
    let settled = bench.shared.lock().now() + Duration::from_millis(30);
    while bench.shared.lock().now() < settled {
        std::thread::sleep(Duration::from_millis(2));
    }
    assert_eq!(bench.get("lego-sensor/sensor1/value0").unwrap(), "6\n");
}

/// The devices of a brick, mounted; None where the machine has no FUSE.
fn mounted_devices(name: &str) -> Option<(Mount, Arc<Shared>, PathBuf)> {
    let root = std::env::temp_dir().join(format!("ev3-sim-{}-{name}", std::process::id()));
    fs::create_dir_all(&root).unwrap();
    let shared = Arc::new(Shared::new(default_machine()));
    match Mount::dev(Arc::clone(&shared), &root) {
        Ok(mount) => Some((mount, shared, root)),
        Err(error) => {
            fs::remove_dir(&root).unwrap();
            eprintln!("skipped: {error}");
            None
        }
    }
}

#[test]
fn a_reader_of_keys_waits_for_one() {
    let Some((mount, shared, root)) = mounted_devices("keys") else {
        return;
    };
    let path = root.join("input/by-path/platform-gpio_keys-event");
    let mut keys = File::open(&path).unwrap();
    let ready = |file: &File, at_most: Duration| {
        let mut fds = [PollFd::new(file, PollFlags::IN)];
        poll(&mut fds, Some(&Timespec::try_from(at_most).unwrap())).unwrap() > 0
    };
    assert!(!ready(&keys, Duration::from_millis(50)));
    let presser = std::thread::spawn({
        let shared = Arc::clone(&shared);
        move || {
            // Longer than a reader waits before it is sent back once.
            std::thread::sleep(Duration::from_millis(300));
            shared.lock().press(Button::Left);
            shared.wake();
        }
    });
    let mut record = [0; 2 * size_of::<usize>() + 8];
    keys.read_exact(&mut record).unwrap();
    presser.join().unwrap();
    let payload = &record[2 * size_of::<usize>()..];
    assert_eq!(
        payload,
        [&1_u16.to_ne_bytes()[..], &105_u16.to_ne_bytes(), &1_i32.to_ne_bytes()].concat()
    );
    assert!(ready(&keys, Duration::ZERO), "the end of the report");
    keys.read_exact(&mut record).unwrap();
    let polled = std::thread::spawn({
        let shared = Arc::clone(&shared);
        move || {
            std::thread::sleep(Duration::from_millis(50));
            shared.lock().release(Button::Left);
            shared.wake();
        }
    });
    assert!(ready(&keys, GUARD));
    polled.join().unwrap();
    let mut now = OpenOptions::new();
    let mut now = now.read(true).custom_flags(0o4000).open(&path).unwrap();
    assert_eq!(now.read(&mut record).unwrap_err().kind(), io::ErrorKind::WouldBlock);
    drop((keys, now));
    mount.unmount().unwrap();
    fs::remove_dir(&root).unwrap();
}

#[test]
fn the_screen_is_a_file_of_fixed_length() {
    let Some((mount, _, root)) = mounted_devices("screen") else {
        return;
    };
    let path = root.join("fb0");
    assert_eq!(fs::metadata(&path).unwrap().len(), 91136);
    let screen = OpenOptions::new().read(true).write(true).open(&path).unwrap();
    screen.write_all_at(&vec![1; 70_000], 20_000).unwrap();
    assert_eq!(errno(screen.write_all_at(&[1; 2], 91135)), Some(Errno::ENOSPC));
    let shown = fs::read(&path).unwrap();
    assert_eq!(shown.len(), 91136);
    assert_eq!(shown[19_999..20_001], [255, 1]);
    assert_eq!(errno(fs::remove_file(&path)), Some(Errno::EACCES));
    drop(screen);
    mount.unmount().unwrap();
    fs::remove_dir(&root).unwrap();
}

#[test]
fn a_missing_directory_is_named() {
    let shared = Arc::new(Shared::new(default_machine()));
    let error = Mount::new(shared, Path::new("/no/such/place")).unwrap_err();
    let named = matches!(error, MountError::NoDirectory(_) | MountError::NoFuse);
    assert!(named, "{error}");
}
