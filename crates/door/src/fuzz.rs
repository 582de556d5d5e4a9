//! The readers of what strangers send, for the targets of fuzz/.
use crate::page::{Message, Reading};
use crate::site::{Reply, Site};

/// The answer to the head of a request.
pub fn reply(site: &Site, text: &[u8]) -> Vec<u8> {
    match site.reply(text) {
        Reply::Refused(answer)
        | Reply::Answer(answer)
        | Reply::File(answer, _)
        | Reply::Stopped(answer)
        | Reply::Page(answer) => answer,
    }
}

/// The messages that come in these parts, up to the first fault, which is a code.
pub fn messages(parts: &[&[u8]]) -> Vec<Result<String, u16>> {
    let mut reading = Reading::new();
    let mut all = Vec::new();
    for part in parts {
        reading.take(part);
        while let Some(message) = reading.message() {
            all.push(message.map(|message| match message {
                Message::Line(line) => line,
                Message::Ping(data) => format!("ping {data:?}"),
                Message::Pong => "pong".into(),
            }));
            if all.last().is_some_and(Result::is_err) {
                return all;
            }
        }
    }
    all
}
