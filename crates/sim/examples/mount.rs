//! Mounts the simulated brick, lets it live in real time while a command runs, and says where the
//! robot ended.
//!
//! `cargo run -p ev3-sim --features fuse --example mount -- DIRECTORY COMMAND ARGUMENT...`

#[path = "../tests/it/robots.rs"]
mod robots;

use ev3_sim::{Mount, Shared};
use robots::default_machine;
use std::error::Error;
use std::path::PathBuf;
use std::process::{Command, ExitCode};
use std::sync::Arc;
use std::time::{Duration, Instant};

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(directory), Some(program)) = (arguments.next(), arguments.next()) else {
        return Err("usage: mount DIRECTORY COMMAND ARGUMENT...".into());
    };
    let directory = PathBuf::from(directory);
    let shared = Arc::new(Shared::new(default_machine()));
    let mount = Mount::new(Arc::clone(&shared), &directory)?;
    let mut command = Command::new(program);
    let mut child = command.args(arguments).env("EV3DEV_SYSFS", &directory).spawn()?;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        std::thread::sleep(Duration::from_millis(2));
        let behind = start.elapsed().saturating_sub(shared.lock().now());
        shared.step(behind);
    };
    mount.unmount()?;
    let machine = shared.lock();
    println!("{:?}, {} collisions", machine.pose(), machine.trace().collision_count());
    Ok(if status.success() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
