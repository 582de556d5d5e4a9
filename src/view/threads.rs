//! The threads that serve pages, and their sockets.
use crate::glue::watch;
use ev3_signals::{hang_up, keep_from_children};
use ev3_sim::stay_outside;
use std::cell::Cell;
use std::fs;
use swipl::fli::{pass_over_thread, this_thread};

/// The clock of the simulation takes threads with such names for no part of the program.
const NAME: &str = "ev3-view";

thread_local! {
    static SERVES: Cell<bool> = const { Cell::new(false) };
}

/// This thread serves a page from now on, or ends.
pub(super) fn serve(serves: bool) {
    if serves != SERVES.replace(serves) {
        // Where the kernel has no such file, the clock takes the thread for one of the program's.
        let _ = fs::write("/proc/thread-self/comm", NAME);
        stay_outside(serves);
    }
    pass_over_thread(this_thread(), serves);
}

/// The program's threads that have used devices, by their numbers.
pub(super) fn users() -> impl Iterator<Item = u64> {
    watch::users().filter_map(|thread| u64::try_from(thread).ok())
}

/// Whether this thread serves a page.
pub(super) fn serves() -> bool {
    SERVES.get()
}

/// Keeps the sockets of a port from programs that are started: else one that outlives the server,
/// as a browser, would keep the port busy.
pub(super) fn keep_sockets(port: u16) {
    sockets(port, |_| true).for_each(keep_from_children);
}

/// Ends the connections to a port, so that nobody waits for them.
pub(super) fn hang_up_all(port: u16) {
    sockets(port, |state| state != LISTENS).for_each(hang_up);
}

/// The state of a socket that takes connections, in the kernel's table.
const LISTENS: &str = "0A";

/// The descriptors of the sockets with a local port, in some state.
fn sockets(port: u16, is_meant: impl Fn(&str) -> bool) -> impl Iterator<Item = i32> {
    let inodes: Vec<_> =
        ["tcp", "tcp6"].iter().flat_map(|table| inodes(table, port, &is_meant)).collect();
    let entries = fs::read_dir("/proc/self/fd").into_iter().flatten().flatten();
    entries.filter_map(move |entry| {
        let target = fs::read_link(entry.path()).ok()?;
        let target = target.to_string_lossy();
        let inode = target.strip_prefix("socket:[")?.strip_suffix(']')?;
        let is_ours = inodes.iter().any(|ours| ours == inode);
        is_ours.then(|| entry.file_name().to_str()?.parse().ok())?
    })
}

/// The sockets with a local port, by a table of the kernel: a line each, with the address in the
/// second column, the state in the fourth, and the inode in the tenth.
fn inodes(table: &str, port: u16, is_meant: &impl Fn(&str) -> bool) -> Vec<String> {
    let text = fs::read_to_string(format!("/proc/self/net/{table}")).unwrap_or_default();
    let ending = format!(":{port:04X}");
    let inode = |line: &str| {
        let columns: Vec<_> = line.split_whitespace().collect();
        let is_ours = columns.get(1)?.ends_with(&ending) && is_meant(columns.get(3)?);
        is_ours.then(|| columns.get(9).map(|inode| (*inode).to_owned()))?
    };
    text.lines().filter_map(inode).collect()
}
