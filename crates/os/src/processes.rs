//! The kernel's report on other processes: how much processor time they have used, whether all of
//! them sleep, and how many they are.
//!
//! A thread that can run is awake, also while other programs have the processors. So nothing
//! here depends on what else the machine has to do.
#[cfg(unix)]
use rustix::param::page_size;
use std::fs::{self, File};
use std::io::Read as _;
use std::path::Path;
use std::str::FromStr;
use std::time::Duration;

/// The bytes of a page of WebAssembly's memory.
#[cfg(not(unix))]
fn page_size() -> usize {
    1 << 16
}

/// What a process and all that descend from it have used.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Usage {
    /// Processor time, also of children that have ended.
    pub time: Duration,
    /// If all their threads sleep: how often these have left a processor. As long as that stays
    /// the same, none of them has run.
    pub rest: Option<u64>,
    /// The number of their threads.
    pub threads: usize,
    /// The bytes that they have in memory. What several of them share counts several times.
    pub memory: u64,
}

/// A kernel can be built without the first of these files.
const CHILDREN: &str = "/proc/thread-self/children";
const PROCESSES: &str = "/proc";

/// How this process and all that descend from it are at this moment; `None` if it is not there.
pub fn usage(process: u32) -> Option<Usage> {
    let mut text = [0; 4096];
    let parents = if Path::new(CHILDREN).exists() { Vec::new() } else { parents(&mut text) };
    let mut members = vec![process];
    let (mut ticks, mut switches) = (None, Some(0));
    let (mut threads, mut pages) = (0, 0);
    let mut next = 0;
    while let Some(member) = members.get(next).copied() {
        next += 1;
        let folder = Path::new(PROCESSES).join(member.to_string());
        let Some(stat) = read(&folder.join("stat"), &mut text) else { continue };
        // Its own time, and that of its children, each in user and in kernel mode.
        let used: u64 = (11..15).filter_map(|index| field::<u64>(stat, index)).sum();
        ticks = Some(ticks.unwrap_or(0) + used);
        pages += field::<u64>(stat, 21).unwrap_or(0);
        for task in names(&folder.join("task")) {
            let task = folder.join("task").join(task.to_string());
            threads += 1;
            if let Some(status) = read(&task.join("status"), &mut text) {
                let (state, count) = state_and_switches(status);
                let is_awake = matches!(state, b'R' | b'D');
                switches = switches.filter(|_| !is_awake).map(|all| all + count);
            }
            let children = read(&task.join("children"), &mut text).unwrap_or_default();
            let numbers = children.split_whitespace();
            members.extend(numbers.filter_map(|child| child.parse::<u32>().ok()));
        }
        members.extend(parents.iter().filter(|one| one.1 == member).map(|one| one.0));
    }
    // The kernel shows hundredths of a second, whatever its own clock has.
    let time = |ticks| Duration::from_millis(10 * ticks);
    let memory = pages * page_size() as u64;
    ticks.map(|ticks| Usage { time: time(ticks), rest: switches, threads, memory })
}

/// The state of a thread, a letter such as `S`, and how often it has left its processor, from
/// the text of its file `status`.
pub fn state_and_switches(status: &str) -> (u8, u64) {
    let value = |name| status.lines().find_map(|line| line.strip_prefix(name)).map(str::trim);
    let count = |name| value(name).and_then(|count| count.parse::<u64>().ok()).unwrap_or(0);
    let state = value("State:").and_then(|state| state.bytes().next()).unwrap_or(b'?');
    (state, count("voluntary_ctxt_switches:") + count("nonvoluntary_ctxt_switches:"))
}

/// A field of a file `stat`, counted from the state. The name before it may have any letters.
fn field<T: FromStr>(stat: &str, index: usize) -> Option<T> {
    let (_, fields) = stat.rsplit_once(") ")?;
    fields.split_whitespace().nth(index)?.parse().ok()
}

/// All processes with their parents.
fn parents(text: &mut [u8]) -> Vec<(u32, u32)> {
    let parent = |process: u32| {
        let file = Path::new(PROCESSES).join(process.to_string()).join("stat");
        Some((process, field(read(&file, text)?, 1)?))
    };
    names(Path::new(PROCESSES)).filter_map(parent).collect()
}

/// The numbers in a directory.
fn names(directory: &Path) -> impl Iterator<Item = u32> {
    let entries = fs::read_dir(directory).into_iter().flatten().flatten();
    entries.filter_map(|entry| entry.file_name().to_str()?.parse().ok())
}

/// A file, as far as there is room for it.
fn read<'a>(file: &Path, text: &'a mut [u8]) -> Option<&'a str> {
    let length = File::open(file).and_then(|mut file| file.read(text)).ok()?;
    Some(text[..length].utf8_chunks().next().map_or("", |chunk| chunk.valid()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::os::unix::process::CommandExt as _;
    use std::process::{Child, Command};
    use std::thread::yield_now;

    /// A shell in a group of its own, which is ended with all its children.
    struct Shell(Child);

    impl Shell {
        fn runs(script: &str) -> Shell {
            Shell(Command::new("sh").args(["-c", script]).process_group(0).spawn().unwrap())
        }

        fn usage(&self) -> Usage {
            usage(self.0.id()).unwrap()
        }

        /// Waits for such a usage; if there is none, the test does not end.
        fn until(&self, is: impl Fn(&Usage) -> bool) -> Usage {
            loop {
                let usage = self.usage();
                if is(&usage) {
                    return usage;
                }
                yield_now();
            }
        }
    }

    impl Drop for Shell {
        fn drop(&mut self) {
            let kill = format!("kill -KILL -{}", self.0.id());
            let _ = Command::new("sh").args(["-c", &kill]).status();
            let _ = self.0.wait();
        }
    }

    const TENTH: Duration = Duration::from_millis(100);

    #[test]
    fn one_that_sleeps_rests() {
        let shell = Shell::runs("sleep 1000; true");
        let before = shell.until(|usage| {
            // The shell may still be about to fall asleep.
            usage.rest.is_some() && (0..100).all(|_| shell.usage() == *usage)
        });
        assert_eq!(shell.usage(), before);
    }

    #[test]
    fn a_child_that_computes_is_awake() {
        let shell = Shell::runs("sh -c 'while :; do :; done' & wait");
        shell.until(|usage| usage.rest.is_none() && usage.time >= TENTH);
    }

    #[test]
    fn the_time_of_a_child_that_has_ended() {
        let counts = "i=0; while [ $i -lt 300000 ]; do i=$((i+1)); done";
        let shell = Shell::runs(&format!("sh -c '{counts}'; sleep 1000; true"));
        shell.until(|usage| usage.rest.is_some() && usage.time > TENTH / 5);
    }

    #[test]
    fn one_that_is_halted_rests() {
        let shell = Shell::runs("kill -STOP $$");
        shell.until(|usage| usage.rest.is_some());
    }

    #[test]
    fn no_such_process() {
        assert_eq!(usage(u32::MAX), None);
    }

    #[test]
    fn without_lists_of_children() {
        let shell = Shell::runs("sleep 1000; true");
        let children = || {
            let all = parents(&mut [0; 4096]).into_iter();
            all.filter(|one| one.1 == shell.0.id()).count()
        };
        while children() == 0 {
            yield_now();
        }
    }

    #[test]
    fn a_name_with_all_that_follows_it() {
        let stat = "12 (a) R 1 (b\n) S 7 8 9";
        assert_eq!(field::<u32>(stat, 1), Some(7));
        assert_eq!(field::<u32>(stat, 9), None);
        assert_eq!(field::<u32>("", 0), None);
    }

    #[test]
    fn a_status() {
        let text = "Name:\tx\nState:\tS (sleeping)\nvoluntary_ctxt_switches:\t3\n\
                    nonvoluntary_ctxt_switches:\t4\n";
        assert_eq!(state_and_switches(text), (b'S', 7));
        assert_eq!(state_and_switches(""), (b'?', 0));
    }
}
