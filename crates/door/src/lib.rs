//! Serves one page: its files, what is made on request, STOP, and a websocket to talk. Or it serves
//! a folder, to everybody.
//!
//! One thread takes connections and reads the heads of requests, many at a time. What comes from
//! those who lack the token is bounded: how many connections there are, how long and how large a
//! head is. A connection of the page is passed on when its request is complete and allowed.
#![forbid(unsafe_code)]
mod head;
mod page;
mod site;

#[cfg(feature = "fuzz")]
#[doc(hidden)]
pub mod fuzz;

pub use self::page::{Heard, Page};
pub use self::site::{Made, Site};

use self::page::{READING, timespec};
use self::site::Reply;
use ev3_os::locked;
use nix::sys::signal::{SigSet, SigmaskHow};
use rustix::event::{PollFd, PollFlags, poll};
use std::fs::File;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{Ipv4Addr, TcpListener, TcpStream};
use std::os::unix::net::UnixStream;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// The most connections whose requests are not complete: if one more comes, the oldest is dropped.
const MOST_WAITING: usize = 128;

/// The most pages at once.
const MOST_PAGES: usize = 16;

/// How long a request may take to come.
const PATIENCE: Duration = Duration::from_secs(2);

/// How many bytes of a file are read at once.
const PART: u64 = 64 << 10;

/// The largest head of a request.
const LARGEST_HEAD: usize = 16 << 10;

/// How many pages there have been: the server that comes next numbers its own differently.
static PAGES: AtomicU32 = AtomicU32::new(1);

/// What somebody with the token wants.
#[derive(Clone, Copy, Debug)]
pub enum Visit {
    /// STOP was pressed; what stops at once has been done.
    Stop,
    /// A page that talks, by its number.
    Page(u32),
}

/// What the thread and those who use the door share.
#[derive(Debug, Default)]
struct Shared {
    /// The pages that talk, with their numbers.
    pages: Mutex<Vec<(u32, Arc<Page>)>>,
    /// The visits that nobody has taken; `None` when no more will come.
    visits: Mutex<Option<Vec<Visit>>>,
    visited: Condvar,
}

/// The server of one page.
#[derive(Debug)]
pub struct Door {
    port: u16,
    shared: Arc<Shared>,
    /// The thread, and what ends it when it is dropped.
    thread: Mutex<Option<(UnixStream, JoinHandle<()>)>>,
}

impl Door {
    /// Serves a site from now on. Errors: the kernel's, if the port cannot be had.
    pub fn open(mut site: Site) -> io::Result<Self> {
        let address = if site.any { Ipv4Addr::UNSPECIFIED } else { Ipv4Addr::LOCALHOST };
        let listener = TcpListener::bind((address, site.port))?;
        rustix::net::listen(&listener, 4096)?;
        listener.set_nonblocking(true)?;
        site.port = listener.local_addr()?.port();
        let port = site.port;
        let (end, ended) = UnixStream::pair()?;
        let visits = Mutex::new(Some(Vec::new()));
        let shared = Arc::new(Shared { visits, ..Shared::default() });
        let server = Server { site, listener, ended, shared: shared.clone() };
        // The signals are for the program's own threads.
        let before = SigSet::all().thread_swap_mask(SigmaskHow::SIG_BLOCK)?;
        let name = thread::Builder::new().name("ev3-view".to_owned());
        let spawned = name.spawn(move || server.serve());
        before.thread_set_mask()?;
        let thread = Mutex::new(Some((end, spawned?)));
        Ok(Self { port, shared, thread })
    }

    /// The port that is served.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// Waits for the next visit; `None` if the door is closed.
    pub fn visit(&self) -> Option<Visit> {
        let has_none = |visits: &mut Option<Vec<_>>| visits.as_ref().is_some_and(Vec::is_empty);
        let visits = locked(&self.shared.visits);
        let visits = self.shared.visited.wait_while(visits, has_none);
        visits.unwrap_or_else(PoisonError::into_inner).as_mut().map(|visits| visits.remove(0))
    }

    /// A page that talks.
    pub fn page(&self, number: u32) -> Option<Arc<Page>> {
        let pages = locked(&self.shared.pages);
        pages.iter().find(|page| page.0 == number).map(|page| page.1.clone())
    }

    /// Forgets a page. Its connection ends when nobody uses it any more.
    pub fn leave(&self, number: u32) {
        locked(&self.shared.pages).retain(|page| page.0 != number);
    }

    /// Ends all connections; says `bye` to the pages, and waits a moment until they are left.
    pub fn close(&self, bye: &str) {
        if let Some((end, thread)) = locked(&self.thread).take() {
            drop(end);
            let _ = thread.join();
        }
        locked(&self.shared.pages).iter().for_each(|page| page.1.dismiss(bye));
        for visit in locked(&self.shared.visits).take().unwrap_or_default() {
            if let Visit::Page(number) = visit {
                self.leave(number);
            }
        }
        self.shared.visited.notify_all();
        let until = Instant::now() + Duration::from_secs(2);
        while !locked(&self.shared.pages).is_empty() && Instant::now() < until {
            thread::sleep(Duration::from_millis(5));
        }
    }
}

/// What the thread has.
struct Server {
    site: Site,
    listener: TcpListener,
    /// Readable when the door is closed.
    ended: UnixStream,
    shared: Arc<Shared>,
}

/// A connection whose request, or whose answer, is not complete.
struct Connection {
    stream: TcpStream,
    until: Instant,
    head: Vec<u8>,
    /// What is still to be sent; empty as long as the request is not complete.
    answer: Vec<u8>,
    /// The file whose rest is sent after that.
    rest: Option<File>,
}

impl Shared {
    fn announce(&self, visit: Visit) {
        locked(&self.visits).iter_mut().for_each(|visits| visits.push(visit));
        self.visited.notify_one();
    }
}

impl Server {
    fn serve(self) {
        let mut all = Vec::new();
        while let Some((is_asked, ready)) = self.ready(&all) {
            let mut ready = ready.into_iter();
            let act = |connection| match ready.next() {
                Some(true) => self.advance(connection),
                _ => Some(connection),
            };
            all = all.into_iter().filter_map(act).collect();
            if is_asked {
                self.accept(&mut all);
            }
            let now = Instant::now();
            all.retain(|connection| connection.until > now);
        }
    }

    /// Waits until something can be done: whether somebody wants a connection, and which of these
    /// can go on. `None` if the door is closed.
    fn ready(&self, all: &[Connection]) -> Option<(bool, Vec<bool>)> {
        let first = all.iter().map(|connection| connection.until).min();
        let left = first.map(|until| timespec(until.saturating_duration_since(Instant::now())));
        let fixed =
            [PollFd::new(&self.ended, PollFlags::IN), PollFd::new(&self.listener, PollFlags::IN)];
        let others = all.iter().map(|one| PollFd::new(&one.stream, one.awaits()));
        let mut polled: Vec<_> = fixed.into_iter().chain(others).collect();
        // If poll is interrupted, or lacks memory, nothing is ready.
        let _ = poll(&mut polled, left.as_ref());
        let mut ready = polled.iter().map(|one| !one.revents().is_empty());
        let (is_over, is_asked) = (ready.next()?, ready.next()?);
        (!is_over).then(|| (is_asked, ready.collect()))
    }

    /// Takes the connections that there are. A request that has come with one is answered at once.
    fn accept(&self, all: &mut Vec<Connection>) {
        for _ in 0..MOST_WAITING {
            match self.listener.accept() {
                Ok((stream, _)) => {
                    if stream.set_nonblocking(true).is_ok() {
                        all.extend(self.advance(Connection::new(stream)));
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => return,
                // No descriptor is left, above all: the program needs some, too.
                Err(_) if all.iter().any(Connection::is_waiting) => drop_oldest(all),
                Err(_) => return thread::sleep(Duration::from_millis(20)),
            }
            if all.iter().filter(|one| one.is_waiting()).count() > MOST_WAITING {
                drop_oldest(all);
            }
        }
    }

    /// Reads or writes what can be; `None` if the connection is over, or is a page's.
    fn advance(&self, mut connection: Connection) -> Option<Connection> {
        if connection.is_waiting() {
            if !connection.read_head()? {
                return Some(connection);
            }
            match self.site.reply(&connection.head) {
                // It fits into what the kernel keeps; nobody waits for a stranger.
                Reply::Refused(answer) => {
                    let _ = connection.stream.write(&answer);
                    return None;
                }
                Reply::Page(answer) => return self.admit(connection, &answer),
                Reply::Stopped(answer) => {
                    self.shared.announce(Visit::Stop);
                    connection.answer = answer;
                }
                Reply::Answer(answer) => connection.answer = answer,
                Reply::File(head, file) => {
                    (connection.answer, connection.rest) = (head, Some(file));
                }
            }
        }
        connection.write_answer()
    }

    /// A connection becomes a page's, unless there are enough.
    fn admit(&self, mut connection: Connection, answer: &[u8]) -> Option<Connection> {
        if locked(&self.shared.pages).len() >= MOST_PAGES {
            connection.answer = site::enough_pages();
            return connection.write_answer();
        }
        if let Ok(page) = Page::new(connection.stream, answer) {
            let number = PAGES.fetch_add(1, Ordering::Relaxed);
            locked(&self.shared.pages).push((number, Arc::new(page)));
            self.shared.announce(Visit::Page(number));
        }
        None
    }
}

impl Connection {
    fn new(stream: TcpStream) -> Self {
        let until = Instant::now() + PATIENCE;
        Self { stream, until, head: Vec::new(), answer: Vec::new(), rest: None }
    }

    /// Its request is not complete.
    fn is_waiting(&self) -> bool {
        self.answer.is_empty()
    }

    fn awaits(&self) -> PollFlags {
        if self.is_waiting() { PollFlags::IN } else { PollFlags::OUT }
    }

    /// Reads what has come: whether the head is complete. `None` if the connection is over.
    fn read_head(&mut self) -> Option<bool> {
        let mut part = [0; 2048];
        while self.head.len() < LARGEST_HEAD {
            match self.stream.read(&mut part) {
                Ok(0) => return None,
                Ok(count) => {
                    let seen = self.head.len().saturating_sub(3);
                    self.head.extend_from_slice(&part[..count]);
                    if self.head[seen..].windows(4).any(|four| four == b"\r\n\r\n") {
                        return Some(true);
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => return Some(false),
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return None,
            }
        }
        None
    }

    /// Writes what the other side takes; `None` if that was all.
    fn write_answer(mut self) -> Option<Self> {
        loop {
            match self.stream.write(&self.answer) {
                Ok(count) => {
                    self.answer.drain(..count);
                    self.until = Instant::now() + READING;
                    if self.answer.is_empty() {
                        let file = self.rest.as_mut()?;
                        file.take(PART)
                            .read_to_end(&mut self.answer)
                            .ok()
                            .filter(|read| *read > 0)?;
                    }
                }
                Err(error) if error.kind() == ErrorKind::WouldBlock => {
                    return Some(self);
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(_) => return None,
            }
        }
    }
}

/// Drops the oldest connection whose request is not complete.
fn drop_oldest(all: &mut Vec<Connection>) {
    if let Some(oldest) = all.iter().position(Connection::is_waiting) {
        all.remove(oldest);
    }
}
