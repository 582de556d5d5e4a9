//! Questions and answers through a socket between two processes of one machine.
//!
//! Numbers are little-endian. The host begins with [`HELLO`], its time in nanoseconds,
//! and how many inferences take a second (8 bytes each). A
//! question is 32 bytes and its text, up to a multiple of 4: the text's length (4 bytes), kind (1), whether it takes no
//! time (1), whether the answer is known (1), nothing (1), its moment in nanoseconds (8), number (8), offset (4), count (4). An
//! answer is 16 bytes and its bytes: their length (4), error (4), number (8).
//!
//! With its greeting the host sends a [`Mailbox`]. A program that takes it leaves its questions
//! there and finds the answers, which is several times as fast; then the socket is only for
//! waking: the host by [`WAKE`], the program by an empty answer.
//!
//! A question whose answer the program knows ([`Kept`]) is written into its next letter, so that the
//! machine has it at its moment, and nobody waits for it. The last question of a letter wants an
//! answer. If none comes, as the program computes or has ended, the host reads what is written.
//!
//! A program in a loop asks the same again. The host foresees that, has a copy of the machine
//! answer, and sends each such question and its answer behind the answer. They hold for a program
//! that asks just these, one after the other, at their moments: then the machine comes to the same
//! answers. So a process may see what its sensors will show within 100 ms, if it goes on so.
use super::{Answer, Far, Host, Kept, Kind, Question, nanos};
use crate::machine::Machine;
use ev3_os::locked;
use ev3_os::mailbox::{Mailbox, Side, readable};
use ev3_os::sockets::with_address;
use std::cmp::Reverse;
use std::collections::VecDeque;
use std::io::{self, ErrorKind, Read, Write};
use std::os::unix::net::UnixStream;
use std::path::Path;
use std::sync::Mutex;
use std::time::Duration;

const HELLO: &[u8; 8] = b"ev3far2\n";

/// The most bytes of a question, or wanted by one: more than a screen has.
const MOST: u32 = 1 << 18;

const HEAD: usize = 32;

/// In how many of the last questions the host looks for a loop, and for how many of the last ones.
const REMEMBERED: usize = 256;
const COMPARED: usize = 16;

/// How many questions are foreseen: twice as many as were known since the last one, within these.
const FEWEST: usize = 4;
const MOST_FORESEEN: usize = 128;

/// It says that a question is in the mailbox.
const WAKE: [u8; HEAD] = {
    let mut wake = [0; HEAD];
    wake[4] = 255;
    wake
};

/// How long a program has to make room for an answer, which it waits for: longer than a busy
/// machine lets it stand.
const PATIENCE: Duration = Duration::from_secs(if cfg!(test) { 1 } else { 60 });

/// The error of a line that is lost: EIO.
const LOST: i32 = 5;

fn part<const N: usize>(bytes: &[u8], from: usize) -> [u8; N] {
    bytes.get(from..from + N).and_then(|part| part.try_into().ok()).unwrap_or([0; N])
}

/// Questions as they are sent, in their order, and the answers.
type Foreseen = VecDeque<(Vec<u8>, Answer)>;

/// The program's end.
#[derive(Debug)]
pub struct Line {
    stream: Mutex<(UnixStream, Kept, Foreseen)>,
    mailbox: Option<Mailbox>,
    thinking: u64,
    /// Called once there are no more answers.
    lost: fn(),
}

impl Line {
    /// Connects to the socket of this path; also the time there.
    /// Errors: the system's; `InvalidData` if nobody speaks so there.
    pub fn connect(path: &Path, lost: fn()) -> io::Result<(Line, Duration)> {
        Line::new(with_address(path, |path| UnixStream::connect(path))?, lost)
    }

    /// Over a socket that is connected.
    pub fn new(stream: UnixStream, lost: fn()) -> io::Result<(Line, Duration)> {
        let mut hello = [0; 24];
        let mailbox = Mailbox::receive(&stream, &mut hello)?;
        if hello[..8] != *HELLO {
            return Err(io::Error::new(ErrorKind::InvalidData, "that is no host of a fence"));
        }
        let now = Duration::from_nanos(u64::from_le_bytes(part(&hello, 8)));
        let thinking = u64::from_le_bytes(part(&hello, 16));
        let stream = Mutex::new((stream, Kept::default(), Foreseen::new()));
        Ok((Line { stream, mailbox, thinking, lost }, now))
    }

    fn exchanged(&self, question: &Question) -> io::Result<Answer> {
        let mut guard = locked(&self.stream);
        let (stream, kept, foreseen) = &mut *guard;
        if let Some(mailbox) = &self.mailbox {
            let frame = framed(&Question { is_known: true, ..*question })?;
            let next = foreseen.pop_front().filter(|next| next.0 == frame);
            if next.is_none() {
                foreseen.clear();
            }
            let known = kept.answer(question).or_else(|| {
                let (_, answer) = next?;
                kept.note(question, &answer);
                Some(answer)
            });
            if let Some(answer) = known.filter(|_| mailbox.write_draft(&frame)) {
                return Ok(answer);
            }
        }
        let frame = framed(question)?;
        let answer = match &self.mailbox {
            Some(mailbox) => {
                let (answer, others) = by_mail(mailbox, stream, &frame)?;
                *foreseen = foreseen_in(&others);
                answer
            }
            None => by_socket(stream, &frame)?,
        };
        kept.note(question, &answer);
        Ok(answer)
    }
}

fn framed(question: &Question) -> io::Result<Vec<u8>> {
    let mut frame = Vec::with_capacity(HEAD + question.bytes.len());
    let length = u32::try_from(question.bytes.len()).map_err(io::Error::other)?;
    frame.extend(length.to_le_bytes());
    frame.extend([question.kind as u8, question.is_free.into(), question.is_known.into(), 0]);
    frame.extend(nanos(question.at).to_le_bytes());
    frame.extend(question.number.to_le_bytes());
    frame.extend(question.offset.to_le_bytes());
    frame.extend(question.count.to_le_bytes());
    frame.extend(question.bytes);
    frame.resize(frame.len().next_multiple_of(4), 0);
    Ok(frame)
}

fn by_socket(stream: &mut UnixStream, frame: &[u8]) -> io::Result<Answer> {
    stream.write_all(frame)?;
    // Most answers come whole in one read.
    let mut head = [0; 256];
    let mut got = 0;
    while got < 16 {
        match stream.read(&mut head[got..]) {
            Ok(0) => return Err(ErrorKind::UnexpectedEof.into()),
            Ok(count) => got += count,
            Err(error) if error.kind() == ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
    let length = u32::from_le_bytes(part(&head, 0)) as usize;
    let mut bytes = head[16..got].to_vec();
    let here = bytes.len().min(length);
    bytes.resize(length, 0);
    stream.read_exact(&mut bytes[here..])?;
    Ok(answer_of(&head, bytes))
}

fn answer_of(head: &[u8], bytes: Vec<u8>) -> Answer {
    let error = i32::from_le_bytes(part(head, 4));
    Answer { error, number: u64::from_le_bytes(part(head, 8)), bytes }
}

/// An answer by mail, and what comes behind it.
fn by_mail(
    mailbox: &Mailbox,
    stream: &mut UnixStream,
    frame: &[u8],
) -> io::Result<(Answer, Vec<u8>)> {
    if mailbox.post(Side::Program, frame).ok_or(ErrorKind::InvalidInput)? {
        stream.write_all(&WAKE)?;
    }
    while !mailbox.wait(Side::Program) {
        stream.read_exact(&mut [0; 16])?;
    }
    let letter = mailbox.letter();
    let (answer, others) = split_answer(&letter).ok_or(ErrorKind::InvalidData)?;
    Ok((answer, others.to_vec()))
}

/// The answer at the beginning, and the rest.
fn split_answer(letter: &[u8]) -> Option<(Answer, &[u8])> {
    let length = u32::from_le_bytes(part(letter, 0)) as usize;
    let bytes = letter.get(16..16 + length)?.to_vec();
    Some((answer_of(letter, bytes), letter.get(16 + length.next_multiple_of(4)..)?))
}

fn foreseen_in(mut letter: &[u8]) -> Foreseen {
    let mut foreseen = Foreseen::new();
    while let Ok(Some((_, length))) = parsed(letter) {
        let (frame, others) = letter.split_at(length);
        let Some((answer, others)) = split_answer(others) else { break };
        foreseen.push_back((frame.to_vec(), answer));
        letter = others;
    }
    foreseen
}

fn framed_answer(Answer { error, number, bytes }: &Answer) -> Vec<u8> {
    let count = u32::try_from(bytes.len()).unwrap_or(0);
    let mut frame = Vec::with_capacity(16 + bytes.len());
    frame.extend(count.to_le_bytes());
    frame.extend(error.to_le_bytes());
    frame.extend(number.to_le_bytes());
    frame.extend(bytes);
    frame
}

impl Far for Line {
    fn thinking(&self) -> u64 {
        self.thinking
    }

    fn ask(&self, question: &Question) -> Answer {
        self.exchanged(question).unwrap_or_else(|_| {
            (self.lost)();
            Answer { error: LOST, ..Answer::default() }
        })
    }
}

/// What a [`Desk`] has got.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Next {
    /// Nothing within that time.
    Idle,
    /// A question for this moment.
    Asked(Duration),
    /// The program has ended.
    Gone,
    /// A question that is not answered, nor any more.
    Refused(&'static str),
}

/// The last questions. Instead of its moment each has the time since the one before.
#[derive(Debug, Default)]
struct Asked {
    steps: Vec<Vec<u8>>,
    last: Duration,
    /// How many were known since one was not.
    known: usize,
}

impl Asked {
    fn note(&mut self, question: &Question) {
        let at = question.at.saturating_sub(self.last);
        self.last = question.at;
        if self.steps.len() >= 2 * REMEMBERED {
            self.steps.drain(..REMEMBERED);
        }
        self.steps.extend(framed(&Question { at, is_known: true, ..*question }));
        self.known = if question.is_known { self.known + 1 } else { 0 };
    }

    /// The loop in which the program is.
    fn again(&self) -> Option<&[Vec<u8>]> {
        let latest = || self.steps.iter().rev();
        let alike = |period: usize| {
            let pairs = latest().zip(latest().skip(period)).take(COMPARED);
            pairs.take_while(|(one, other)| one == other).count()
        };
        let periods = (1..self.steps.len()).map(|period| (alike(period), Reverse(period)));
        let (_, Reverse(period)) = periods.max().filter(|(alike, _)| *alike > 1)?;
        self.steps.get(self.steps.len() - period..)
    }
}

/// The machine's end, which reads one question after the other.
#[derive(Debug)]
pub struct Desk {
    stream: UnixStream,
    mailbox: Option<Mailbox>,
    host: Host,
    asked: Asked,
    received: Vec<u8>,
    /// Whether that came by mail.
    by_mail: bool,
    is_admitted: bool,
    is_lost: bool,
}

impl Desk {
    /// Greets a program that has connected, at this time; that many of its inferences take a
    /// second.
    pub fn new(mut stream: UnixStream, now: Duration, thinking: u64) -> io::Result<Desk> {
        let mut hello = HELLO.to_vec();
        hello.extend(nanos(now).to_le_bytes());
        hello.extend(thinking.to_le_bytes());
        // An old kernel has no files in memory.
        let mailbox = Mailbox::new().ok();
        match &mailbox {
            Some(mailbox) => mailbox.send(&stream, &hello)?,
            None => stream.write_all(&hello)?,
        }
        stream.set_write_timeout(Some(PATIENCE))?;
        let (host, asked, received) = (Host::default(), Asked::default(), Vec::new());
        let [by_mail, is_admitted, is_lost] = [false; 3];
        Ok(Desk { stream, mailbox, host, asked, received, by_mail, is_admitted, is_lost })
    }

    /// The next question, or the one that was not answered yet. Waits so long for it.
    pub fn hear(&mut self, within: Duration) -> io::Result<Next> {
        let mut buffer = [0; 4096];
        if self.is_lost {
            return Ok(Next::Gone);
        }
        loop {
            match parsed(&self.received) {
                Err(why) => return Ok(Next::Refused(why)),
                Ok(Some((question, _))) => {
                    if !self.is_admitted {
                        if let Err(why) = self.host.admit(&question) {
                            return Ok(Next::Refused(why));
                        }
                        self.is_admitted = true;
                    }
                    return Ok(Next::Asked(question.at));
                }
                Ok(None) if self.by_mail => return Ok(Next::Refused(NO_QUESTION)),
                Ok(None) => {}
            }
            if self.received.is_empty() {
                if let Some(mailbox) = self.mailbox.as_ref().filter(|box_| box_.wait(Side::Host)) {
                    self.received = mailbox.letter();
                    self.by_mail = true;
                    continue;
                }
            }
            if !readable(&self.stream, within)? {
                if self.has_draft() {
                    continue;
                }
                return Ok(Next::Idle);
            }
            match self.stream.read(&mut buffer) {
                Ok(0) if self.has_draft() => {}
                Ok(0) => return Ok(Next::Gone),
                Ok(count) => {
                    self.received.extend(&buffer[..count]);
                    while self.received.starts_with(&WAKE) {
                        self.received.drain(..HEAD);
                    }
                }
                Err(error) => match error.kind() {
                    ErrorKind::Interrupted => {}
                    ErrorKind::ConnectionReset if self.has_draft() => {}
                    ErrorKind::ConnectionReset => return Ok(Next::Gone),
                    _ => return Err(error),
                },
            }
        }
    }

    /// Whether the program waits for the answer to what was heard last: not if it knows it.
    pub fn is_waited_for(&self) -> bool {
        matches!(parsed(&self.received), Ok(Some((question, _))) if !question.is_known)
    }

    /// Whether the program waits for an answer, as far as what was received says. Questions whose
    /// answers it knows may stand before the one that it waits for.
    pub fn owes_answer(&self) -> bool {
        let mut rest = &self.received[..];
        while let Ok(Some((question, length))) = parsed(rest) {
            if !question.is_known {
                return true;
            }
            rest = &rest[length..];
        }
        self.mailbox.as_ref().is_some_and(|mailbox| mailbox.has_come(Side::Host))
    }

    /// Takes over what is written of the next letter, if there is something.
    fn has_draft(&mut self) -> bool {
        let Some(mailbox) = self.mailbox.as_ref().filter(|_| self.received.is_empty()) else {
            return false;
        };
        self.received = mailbox.draft();
        !self.received.is_empty()
    }

    /// Answers the question that was received, if one was. A program that is gone gets nothing.
    /// `until` is as for [`Host::answer`].
    pub fn answer(&mut self, machine: &mut Machine, until: Duration) {
        let Ok(Some((question, length))) = parsed(&self.received) else { return };
        let is_known = question.is_known;
        let most = (2 * self.asked.known).clamp(FEWEST, MOST_FORESEEN);
        self.asked.note(&question);
        let mut frame = framed_answer(&self.host.answer(machine, &question, until));
        self.received.drain(..length);
        self.is_admitted = false;
        if is_known {
            return;
        }
        if self.by_mail {
            for (question, answer) in self.foreseen(machine, until, most) {
                frame.resize(frame.len().next_multiple_of(4), 0);
                frame.extend(question);
                frame.extend(framed_answer(&answer));
            }
            frame.resize(frame.len().next_multiple_of(4), 0);
        }
        if let Some(mailbox) = self.mailbox.as_ref().filter(|_| self.by_mail) {
            self.received.clear();
            self.by_mail = false;
            match mailbox.post(Side::Host, &frame) {
                Some(false) => return,
                Some(true) => frame.truncate(0),
                None => self.is_lost = true,
            }
            frame.resize(16, 0);
        }
        self.is_lost |= self.stream.write_all(&frame).is_err();
    }

    /// What a program in a loop asks next, and what the machine will answer if it does.
    fn foreseen(&mut self, machine: &Machine, until: Duration, most: usize) -> Foreseen {
        let mut foreseen = Foreseen::new();
        let Some(again) = self.asked.again().filter(|_| machine.is_alone()) else {
            return foreseen;
        };
        let mut machine = machine.clone();
        for step in again.iter().cycle().take(most) {
            let Ok(Some((question, _))) = parsed(step) else { break };
            let at = machine.now().saturating_add(question.at);
            let kinds = [Kind::Pass, Kind::Read, Kind::Write, Kind::Buttons];
            if at >= until || !kinds.contains(&question.kind) {
                break;
            }
            machine.step(question.at);
            let question = Question { at, ..question };
            let answer = self.host.answer(&mut machine, &question, until);
            let Ok(frame) = framed(&question) else { break };
            foreseen.push_back((frame, answer));
        }
        foreseen
    }
}

/// The question at the beginning, and its length; `None` if not all of it has come.
fn parsed(received: &[u8]) -> Result<Option<(Question<'_>, usize)>, &'static str> {
    let Some(head) = received.get(..HEAD) else { return Ok(None) };
    let [length, offset, count] = [0, 24, 28].map(|from| u32::from_le_bytes(part(head, from)));
    let [at, number] = [8, 16].map(|from| u64::from_le_bytes(part(head, from)));
    let Some(kind) = Kind::of(head[4]) else { return Err(NO_QUESTION) };
    if length > MOST || (count > MOST && kind != Kind::Ioctl) {
        return Err(NO_QUESTION);
    }
    let end = HEAD + (length as usize).next_multiple_of(4);
    let Some(bytes) = received.get(HEAD..end) else { return Ok(None) };
    let bytes = &bytes[..length as usize];
    let at = Duration::from_nanos(at);
    let [is_free, is_known] = [head[5] != 0, head[6] != 0];
    Ok(Some((Question { kind, at, is_free, is_known, number, offset, count, bytes }, end)))
}

const NO_QUESTION: &str = "that was no question";

#[cfg(test)]
mod tests {
    use super::*;
    use std::thread;

    const SOON: Duration = Duration::from_millis(1);
    const WITHIN: Duration = Duration::from_secs(300);

    /// A desk at whose other end these bytes were written.
    fn desk(bytes: &[u8]) -> Desk {
        let (mut program, host) = UnixStream::pair().unwrap();
        let desk = Desk::new(host, Duration::ZERO, 0).unwrap();
        program.write_all(bytes).unwrap();
        desk
    }

    fn next(bytes: &[u8]) -> Next {
        desk(bytes).hear(WITHIN).unwrap()
    }

    #[test]
    fn garbage_is_refused() {
        assert_eq!(next(&[255; 64]), Next::Refused(NO_QUESTION));
        let mut long = [0; HEAD];
        long[..4].copy_from_slice(&(MOST + 1).to_le_bytes());
        assert_eq!(next(&long), Next::Refused(NO_QUESTION));
        let mut wants_much = [0; HEAD];
        wants_much[4] = Kind::Read as u8;
        wants_much[28..].copy_from_slice(&(MOST + 1).to_le_bytes());
        assert_eq!(next(&wants_much), Next::Refused(NO_QUESTION));
    }

    #[test]
    fn half_a_question_and_then_the_end() {
        assert_eq!(next(&[0; HEAD - 1]), Next::Gone);
        let (mut program, host) = UnixStream::pair().unwrap();
        let mut desk = Desk::new(host, Duration::ZERO, 0).unwrap();
        program.write_all(&[0; HEAD - 1]).unwrap();
        assert_eq!(desk.hear(SOON).unwrap(), Next::Idle);
        program.write_all(&[0]).unwrap();
        assert_eq!(desk.hear(WITHIN).unwrap(), Next::Asked(Duration::ZERO));
    }

    /// The moments of all reads that the machine has had of a program that reads at these ones, and
    /// then does that with its line.
    fn reads<T: Send + 'static>(moments: &'static [u64], end: fn(Line) -> T) -> Vec<u64> {
        let (program, host) = UnixStream::pair().unwrap();
        let mut machine = Machine::bare().unwrap();
        let mut desk = Desk::new(host, Duration::ZERO, 0).unwrap();
        let program = thread::spawn(move || {
            let (line, _) = Line::new(program, || ()).unwrap();
            let path = b"power_supply/lego-ev3-battery/voltage_now";
            let number = line.ask(&Question::of(Kind::OpenToRead, path)).number;
            for at in moments {
                let at = Duration::from_micros(*at);
                let question = Question { at, number, count: 99, ..Question::of(Kind::Read, &[]) };
                assert_eq!(line.ask(&question).error, 0);
            }
            end(line)
        });
        let mut asked = Vec::new();
        while asked.len() <= moments.len() {
            match desk.hear(SOON).unwrap() {
                Next::Asked(at) => {
                    machine.step(at.saturating_sub(machine.now()));
                    asked.push(u64::try_from(at.as_micros()).unwrap());
                    desk.answer(&mut machine, Duration::from_micros(5100));
                }
                Next::Idle => {}
                _ => break,
            }
        }
        drop(program.join().unwrap());
        asked.split_off(1)
    }

    #[test]
    fn the_machine_has_each_read_at_its_moment() {
        let moments = &[500, 1000, 1500, 2000, 2500, 4500, 5000, 5500, 6000, 6500, 7000];
        for count in 1..=moments.len() {
            assert_eq!(reads(&moments[..count], drop), moments[..count]);
            assert_eq!(reads(&moments[..count], |line| line), moments[..count]);
        }
    }

    #[test]
    fn a_loop_is_foreseen() {
        let mut asked = Asked::default();
        assert!(asked.again().is_none());
        for (number, at) in [(7, 1), (1, 2), (2, 3), (3, 9), (1, 10), (2, 11)] {
            asked.note(&question(Kind::Read, at, number));
        }
        let again = asked.again().unwrap().iter().map(|step| parsed(step).unwrap().unwrap().0);
        assert_eq!(
            again.map(|step| (step.number, step.at.as_micros())).collect::<Vec<_>>(),
            [(3, 6), (1, 1), (2, 1)]
        );
        asked.note(&question(Kind::Read, 12, 3));
        assert!(asked.again().is_none());
    }

    #[test]
    fn the_answers_to_a_loop_come_with_few_letters() {
        let mut desk = desk(&[]);
        let mut machine = Machine::bare().unwrap();
        let mut known = 0;
        let mut ahead = 0;
        for at in 1..100 {
            let read = question(Kind::Read, 500 * at, 0);
            let question = Question { is_known: ahead > 0, ..read };
            machine.step(question.at.saturating_sub(machine.now()));
            desk.received = framed(&question).unwrap();
            desk.by_mail = !question.is_known;
            desk.answer(&mut machine, Duration::MAX);
            let mailbox = desk.mailbox.as_ref().unwrap();
            if question.is_known {
                (known, ahead) = (known + 1, ahead - 1);
            } else {
                ahead = foreseen_in(split_answer(&mailbox.letter()).unwrap().1).len();
            }
        }
        assert!(known > 80, "{known}");
    }

    /// A question at a moment in microseconds.
    fn question(kind: Kind, micros: u64, number: u64) -> Question<'static> {
        Question { at: Duration::from_micros(micros), number, ..Question::of(kind, b"10") }
    }

    fn until(micros: u64) -> Answer {
        Answer { number: micros * 1000, ..Answer::default() }
    }

    #[test]
    fn an_answer_holds_for_a_tick_unless_something_changes() {
        let mut kept = Kept::default();
        let answer = Answer { bytes: vec![1], ..until(2000) };
        kept.note(&question(Kind::Read, 500, 1), &answer);
        assert_eq!(kept.answer(&question(Kind::Read, 1999, 1)), Some(answer));
        assert_eq!(kept.answer(&question(Kind::Read, 2000, 1)), None);
        assert_eq!(kept.answer(&question(Kind::Read, 1999, 2)), None);
        kept.note(&question(Kind::Pass, 600, 0), &until(0));
        assert!(kept.answer(&question(Kind::Read, 1999, 1)).is_some());
        kept.note(&question(Kind::Write, 700, 2), &Answer::default());
        assert_eq!(kept.answer(&question(Kind::Read, 1999, 1)), None);
    }

    #[test]
    fn what_a_motor_took_it_takes_again_until_something_happens() {
        let mut kept = Kept::default();
        let motor = 5 << 32;
        let [read, write] = [Kind::Read, Kind::Write].map(|kind| question(kind, 500, motor));
        assert_eq!(kept.answer(&write), None);
        let taken = Answer { bytes: 100_000_000_u64.to_le_bytes().to_vec(), ..Answer::default() };
        kept.note(&write, &taken);
        assert_eq!(kept.answer(&Question { bytes: b"11", ..write }), None);
        kept.note(&read, &until(2000));
        assert_eq!(kept.answer(&write), Some(Answer::default()));
        assert_eq!(kept.answer(&read), None);
        assert!(kept.answer(&question(Kind::Pass, 99_999, 0)).is_some());
        assert_eq!(kept.answer(&question(Kind::Pass, 100_000, 0)), None);
        assert_eq!(kept.answer(&question(Kind::Write, 100_000, motor)), None);
        kept.note(&question(Kind::Pass, 100_000, 0), &until(200_000));
        assert_eq!(kept.answer(&question(Kind::Write, 100_000, motor)), None);
    }

    #[test]
    fn a_question_behind_known_ones_is_owed_an_answer() {
        let mut desk = desk(&[]);
        let asked = question(Kind::Pass, 1, 0);
        let [known, unknown] =
            [true, false].map(|is_known| framed(&Question { is_known, ..asked }).unwrap());
        assert!(!desk.owes_answer());
        desk.received = [&*known, &*known].concat();
        assert!(!desk.owes_answer());
        desk.mailbox.as_ref().unwrap().post(Side::Program, &unknown).unwrap();
        assert!(desk.owes_answer());
        desk.mailbox.as_ref().unwrap().post(Side::Host, &[0; 16]).unwrap();
        assert!(!desk.owes_answer());
        desk.received = [&*known, &*unknown].concat();
        assert!(desk.owes_answer());
    }

    #[test]
    fn one_that_never_reads_is_gone() {
        let (mut program, host) = UnixStream::pair().unwrap();
        let mut desk = Desk::new(host, Duration::ZERO, 0).unwrap();
        let mut machine = Machine::bare().unwrap();
        let asks = thread::spawn(move || while program.write_all(&[0; HEAD]).is_ok() {});
        let mut answered = 0;
        while desk.hear(WITHIN).unwrap() != Next::Gone {
            desk.answer(&mut machine, Duration::MAX);
            answered += 1;
        }
        assert!(answered > 10);
        drop(desk);
        asks.join().unwrap();
    }
}
