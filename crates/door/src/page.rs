//! The messages of a websocket (RFC 6455).
use ev3_os::locked;
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use std::io::{self, ErrorKind, Read, Write};
use std::net::{Shutdown, TcpStream};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// How long the other side may take to read a part of an answer.
pub(crate) const READING: Duration = Duration::from_secs(5);

/// The most bytes that a message may have.
const LONGEST: usize = 64 << 10;

/// A page that says nothing for so long is asked whether it is still there, and is left when it
/// does not answer for as long again.
const SILENCE: Duration = Duration::from_secs(30);

const TEXT: u8 = 1;
const CLOSE: u8 = 8;
const PING: u8 = 9;
const PONG: u8 = 10;

/// The bytes that have come of a message.
#[derive(Debug, Eq, PartialEq)]
pub enum Heard {
    /// A line.
    Line(String),
    /// Nothing in this time.
    Nothing,
    /// The connection is over.
    End,
}

/// The connection of a page.
#[derive(Debug)]
pub struct Page {
    stream: TcpStream,
    writing: Mutex<()>,
    reading: Mutex<Reading>,
}

/// A message that has come.
#[derive(Debug)]
pub(crate) struct Reading {
    bytes: Vec<u8>,
    /// The beginning of a message that comes in parts.
    begun: Option<Vec<u8>>,
    heard: Instant,
    is_asked: bool,
}

/// A message; its fault is the code for the other side.
pub(crate) enum Message {
    Line(String),
    Ping(Vec<u8>),
    Pong,
}

/// Whether it is the last one of its message, its kind and its data.
type Frame = (bool, u8, Vec<u8>);

impl Page {
    /// Answers the handshake.
    pub(crate) fn new(stream: TcpStream, answer: &[u8]) -> io::Result<Self> {
        stream.set_nonblocking(false)?;
        stream.set_nodelay(true)?;
        stream.set_write_timeout(Some(READING))?;
        (&stream).write_all(answer)?;
        Ok(Self { stream, writing: Mutex::new(()), reading: Mutex::new(Reading::new()) })
    }

    /// Sends a text. If the other side does not take it, the connection is over.
    pub fn say(&self, text: &str) {
        self.send(TEXT, text.as_bytes());
    }

    /// Ends the connection with the reason for that.
    pub fn end(&self, code: u16) {
        self.send(CLOSE, &code.to_be_bytes());
        let _ = self.stream.shutdown(Shutdown::Write);
        // What is not read when a socket is closed would make the other side lose this.
        let until = Instant::now() + Duration::from_secs(1);
        while self.has_come(until) && (&self.stream).read(&mut [0; 2048]).is_ok_and(|n| n > 0) {}
    }

    /// Says good-bye, unless that takes time.
    pub(crate) fn dismiss(&self, bye: &str) {
        // A writer is done in a moment, if the page reads.
        for _ in 0..100 {
            if let Ok(_turn) = self.writing.try_lock() {
                let _ = self.stream.set_nonblocking(true);
                let end = frame(CLOSE, &1001_u16.to_be_bytes());
                let _ = (&self.stream).write(&[frame(TEXT, bye.as_bytes()), end].concat());
                break;
            }
            std::thread::sleep(Duration::from_millis(1));
        }
        let _ = self.stream.shutdown(Shutdown::Both);
    }

    /// Waits for the next line.
    pub fn hear(&self, wait: Duration) -> Heard {
        let mut reading = locked(&self.reading);
        let until = Instant::now() + wait;
        loop {
            match reading.message() {
                Some(Ok(Message::Line(line))) => return Heard::Line(line),
                Some(Ok(Message::Ping(data))) => self.send(PONG, &data),
                Some(Ok(Message::Pong)) => {}
                Some(Err(code)) => {
                    self.end(code);
                    return Heard::End;
                }
                None if !self.has_come(until) => return self.silence(&mut reading),
                None => {
                    let mut part = [0; 4096];
                    match (&self.stream).read(&mut part) {
                        Ok(count) if count > 0 => reading.take(&part[..count]),
                        Err(error) if error.kind() == ErrorKind::Interrupted => {}
                        _ => return Heard::End,
                    }
                }
            }
        }
    }

    /// Nothing has come: the page may be gone.
    fn silence(&self, reading: &mut Reading) -> Heard {
        let silent = reading.heard.elapsed();
        if silent >= 2 * SILENCE {
            return Heard::End;
        }
        if silent >= SILENCE && !reading.is_asked {
            reading.is_asked = true;
            self.send(PING, &[]);
        }
        Heard::Nothing
    }

    /// Whether something has come, or the end, before this moment.
    fn has_come(&self, until: Instant) -> bool {
        let left = timespec(until.saturating_duration_since(Instant::now()));
        let mut polled = [PollFd::new(&self.stream, PollFlags::IN)];
        poll(&mut polled, Some(&left)).is_ok_and(|count| count > 0)
    }

    fn send(&self, kind: u8, data: &[u8]) {
        let _turn = locked(&self.writing);
        if (&self.stream).write_all(&frame(kind, data)).is_err() {
            let _ = self.stream.shutdown(Shutdown::Both);
        }
    }
}

/// A message in one frame.
fn frame(kind: u8, data: &[u8]) -> Vec<u8> {
    let mut frame = Vec::with_capacity(data.len() + 10);
    frame.push(0x80 | kind);
    match (u8::try_from(data.len()), u16::try_from(data.len())) {
        (Ok(length @ ..126), _) => frame.push(length),
        (_, Ok(length)) => {
            frame.push(126);
            frame.extend(length.to_be_bytes());
        }
        _ => {
            frame.push(127);
            frame.extend((data.len() as u64).to_be_bytes());
        }
    }
    frame.extend(data);
    frame
}

impl Reading {
    pub(crate) fn new() -> Self {
        Reading { bytes: Vec::new(), begun: None, heard: Instant::now(), is_asked: false }
    }

    pub(crate) fn take(&mut self, bytes: &[u8]) {
        self.bytes.extend(bytes);
        self.heard = Instant::now();
        self.is_asked = false;
    }

    /// The next message, if all of it has come.
    pub(crate) fn message(&mut self) -> Option<Result<Message, u16>> {
        loop {
            let (is_last, kind, data) = match self.frame()? {
                Ok(frame) => frame,
                Err(code) => return Some(Err(code)),
            };
            let all = match (kind, self.begun.take()) {
                (CLOSE, _) => return Some(Err(closing(&data))),
                (PING | PONG, begun) => {
                    self.begun = begun;
                    return Some(Ok(if kind == PING {
                        Message::Ping(data)
                    } else {
                        Message::Pong
                    }));
                }
                (0, Some(begun)) => [begun, data].concat(),
                (TEXT, None) => data,
                (2, None) => return Some(Err(1003)),
                _ => return Some(Err(1002)),
            };
            if all.len() > LONGEST {
                return Some(Err(1009));
            }
            if is_last {
                return Some(String::from_utf8(all).map(Message::Line).map_err(|_| 1007));
            }
            self.begun = Some(all);
        }
    }

    /// The next frame: two bytes, perhaps a longer length, the mask, the data (5.2). What a
    /// browser sends is masked.
    fn frame(&mut self) -> Option<Result<Frame, u16>> {
        let &[first, second, ref rest @ ..] = &self.bytes[..] else {
            return None;
        };
        let (is_last, kind, short) = (first & 0x80 != 0, first & 15, second & 127);
        let is_known = matches!(kind, 0..=2 | CLOSE..=PONG);
        if first & 0x70 != 0 || second & 0x80 == 0 || !is_known {
            return Some(Err(1002));
        }
        if kind >= CLOSE && (!is_last || short > 125) {
            return Some(Err(1002));
        }
        let more = [0, 2, 8][usize::from(short.saturating_sub(125))];
        let (long, rest) = rest.split_at_checked(more)?;
        let long = long.iter().fold(0_u64, |all, byte| all << 8 | u64::from(*byte));
        let length = if more == 0 { u64::from(short) } else { long };
        let Some(length) = usize::try_from(length).ok().filter(|length| *length <= LONGEST) else {
            return Some(Err(1009));
        };
        let (mask, rest) = rest.split_at_checked(4)?;
        let data = rest.get(..length)?.iter().zip(mask.iter().cycle()).map(|(a, b)| a ^ b);
        let data = data.collect();
        self.bytes.drain(..2 + more + 4 + length);
        Some(Ok((is_last, kind, data)))
    }
}

/// The answer to a frame that closes the connection: it holds nothing, or a code that
/// may be sent, and a reason (RFC 6455, 5.5.1 and 7.4).
fn closing(data: &[u8]) -> u16 {
    match data {
        [] => 1000,
        [high, low, reason @ ..] => match u16::from_be_bytes([*high, *low]) {
            1000..=1003 | 1007..=1014 | 3000..=4999 if std::str::from_utf8(reason).is_ok() => 1000,
            1000..=1003 | 1007..=1014 | 3000..=4999 => 1007,
            _ => 1002,
        },
        [_] => 1002,
    }
}

pub(crate) fn timespec(time: Duration) -> Timespec {
    // A time that is too long is forever.
    Timespec::try_from(time).unwrap_or(Timespec { tv_sec: 1 << 30, tv_nsec: 0 })
}
