//! The paths of the site, and the content of each.
use crate::head::{Head, MOST_FIELDS};
use httparse::EMPTY_HEADER;
use sha1_smol::Sha1;
use std::fs::{self, File};
use std::path::PathBuf;

/// What is served, and to whom.
#[derive(Debug)]
pub struct Site {
    /// Whether other machines may come, or this one only.
    pub any: bool,
    /// The port; 0 is any.
    pub port: u16,
    /// Those who have it may enter. If it is empty, everybody may read the files of the folder and
    /// of those within it, and nothing else.
    pub token: String,
    /// The folder of the page's files.
    pub files: PathBuf,
    /// What is made on request.
    pub made: &'static [Made],
    /// Stops at once what can be stopped.
    pub stop: fn(),
}

/// A text that is made on request.
#[derive(Debug)]
pub struct Made {
    /// Where: a slash and the name that it is saved by.
    pub path: &'static str,
    /// Its type.
    pub kind: &'static str,
    /// Makes it.
    pub make: fn() -> Option<String>,
    /// The message if it cannot be made.
    pub lacking: &'static str,
}

/// What becomes of a request.
pub(crate) enum Reply {
    /// It comes from a stranger.
    Refused(Vec<u8>),
    /// An answer.
    Answer(Vec<u8>),
    /// What comes before a file, and the file.
    File(Vec<u8>, File),
    /// The answer to STOP.
    Stopped(Vec<u8>),
    /// The connection is a page's from now on.
    Page(Vec<u8>),
}

const TEXT: &str = "text/plain; charset=utf-8";

/// The types of files.
const TYPES: [(&str, &str); 8] = [
    ("html", "text/html; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("svg", "image/svg+xml"),
    ("png", "image/png"),
    ("woff2", "font/woff2"),
    ("json", "application/json"),
    ("wasm", "application/wasm"),
];

impl Site {
    /// The reply to a complete head.
    pub(crate) fn reply(&self, text: &[u8]) -> Reply {
        let mut fields = [EMPTY_HEADER; MOST_FIELDS];
        let Some(head) = Head::read(text, &mut fields) else {
            return Reply::Refused(refusal("400 Bad Request", "This is no request."));
        };
        if self.token.is_empty() {
            return self.public(&head);
        }
        match head.refusal(self.any, self.port, &self.token) {
            Some(why) => Reply::Refused(refusal("403 Forbidden", why)),
            None => self.allowed(&head),
        }
    }

    /// A file that everybody may read.
    fn public(&self, head: &Head) -> Reply {
        let is_part = |part: &str| {
            !part.is_empty() && !part.starts_with('.') && !part.contains(['%', '\0', '\\'])
        };
        let path =
            format!("{}{}", head.path, if head.path.ends_with('/') { "index.html" } else { "" });
        let name = path.strip_prefix('/').filter(|name| name.split('/').all(is_part));
        let opened = name.and_then(|name| {
            let file = File::open(self.files.join(name)).ok()?;
            let known = file.metadata().ok().filter(fs::Metadata::is_file)?;
            let ending = name.rsplit_once('.').map_or("", |(_, ending)| ending);
            Some((file, known.len(), type_of(ending).unwrap_or("application/octet-stream")))
        });
        match opened {
            _ if head.method != "GET" => {
                Reply::Answer(refusal("405 Method Not Allowed", "Not this way."))
            }
            Some((file, length, kind)) => Reply::File(head_of("200 OK", kind, "", length), file),
            None => Reply::Answer(refusal("404 Not Found", "There is no such file.")),
        }
    }

    fn allowed(&self, head: &Head) -> Reply {
        let host = head.value("host").unwrap_or_default();
        let found =
            |kind, more: &str, body: &[u8]| Reply::Answer(answer("200 OK", host, kind, more, body));
        let missing = |why| Reply::Answer(refusal("404 Not Found", why));
        let made = self.made.iter().find(|made| made.path == head.path);
        let file = self.file(if head.path == "/" { "/index.html" } else { head.path });
        match (head.method, head.path) {
            ("POST", "/stop") => {
                (self.stop)();
                Reply::Stopped(answer("200 OK", host, TEXT, "", b"stopped\n"))
            }
            ("GET", "/ws") => match accept_key(head) {
                Some(key) => Reply::Page(switched(&key)),
                None => Reply::Answer(refusal("400 Bad Request", "This is for a websocket.")),
            },
            (_, path) if file.is_none() && made.is_none() && !["/stop", "/ws"].contains(&path) => {
                missing("There is no such page.")
            }
            ("GET", path) if path != "/stop" => match (made, file) {
                (Some(made), _) => match (made.make)() {
                    Some(body) => found(made.kind, &attachment(&path[1..]), body.as_bytes()),
                    None => missing(made.lacking),
                },
                (_, Some((kind, file))) => match fs::read(file) {
                    Ok(body) if path == "/" => found(kind, &self.cookie(), &body),
                    Ok(body) => found(kind, "", &body),
                    Err(_) => missing("The page is not installed."),
                },
                _ => missing("There is no such page."),
            },
            _ => Reply::Answer(refusal("405 Method Not Allowed", "Not this way.")),
        }
    }

    /// The type and the place of a file: of the folder itself, and of a type that is served.
    fn file(&self, path: &str) -> Option<(&'static str, PathBuf)> {
        let name = path.strip_prefix('/').filter(|name| !name.contains(['/', '%', '\0']))?;
        let (base, ending) = name.rsplit_once('.')?;
        let kind = type_of(ending)?;
        let file = self.files.join(name);
        (!base.is_empty() && (path == "/index.html" || file.is_file())).then_some((kind, file))
    }

    fn cookie(&self) -> String {
        let (port, token) = (self.port, &self.token);
        format!("Set-Cookie: ev3view_{port}={token}; HttpOnly; SameSite=Strict; Path=/\r\n")
    }
}

fn type_of(ending: &str) -> Option<&'static str> {
    TYPES.iter().find(|(known, _)| *known == ending).map(|(_, kind)| *kind)
}

fn attachment(name: &str) -> String {
    format!("Content-Disposition: attachment; filename=\"{name}\"\r\n")
}

/// There are as many pages as there may be.
pub(crate) fn enough_pages() -> Vec<u8> {
    refusal("503 Service Unavailable", "There are enough pages.")
}

fn refusal(status: &str, why: &str) -> Vec<u8> {
    answer(status, "", TEXT, "", format!("{why}\n").as_bytes())
}

/// An answer. Nothing that a page loads or sends may be elsewhere.
fn answer(status: &str, host: &str, kind: &str, more: &str, body: &[u8]) -> Vec<u8> {
    let sockets = if host.is_empty() { String::new() } else { format!(" ws://{host}") };
    let more = format!(
        "Content-Security-Policy: default-src 'self'; connect-src 'self'{sockets}; \
         img-src 'self' blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'\r\n{more}"
    );
    [&head_of(status, kind, &more, body.len() as u64), body].concat()
}

fn head_of(status: &str, kind: &str, more: &str, length: u64) -> Vec<u8> {
    format!(
        "HTTP/1.1 {status}\r\n\
         X-Content-Type-Options: nosniff\r\nReferrer-Policy: no-referrer\r\n\
         Cache-Control: no-store\r\nConnection: close\r\n{more}\
         Content-Type: {kind}\r\nContent-Length: {length}\r\n\r\n"
    )
    .into_bytes()
}

/// The answer to the key of a handshake (RFC 6455, 4.2.2); `None` if that is not a handshake.
fn accept_key(head: &Head) -> Option<String> {
    let is_one = head.value("upgrade")?.eq_ignore_ascii_case("websocket")
        && head.value("sec-websocket-version")? == "13";
    let key = head.value("sec-websocket-key").filter(|key| is_one && key.len() == 24)?;
    let hash = Sha1::from(format!("{key}258EAFA5-E914-47DA-95CA-C5AB0DC85B11"));
    Some(base64(&hash.digest().bytes()))
}

/// The answer after which the connection is no HTTP any more.
fn switched(key: &str) -> Vec<u8> {
    format!(
        "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\
         Sec-WebSocket-Accept: {key}\r\n\r\n"
    )
    .into_bytes()
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let letters = |three: &[u8]| {
        let bits = (0..3)
            .fold(0, |all, at| all << 8 | usize::from(three.get(at).copied().unwrap_or_default()));
        let (letter, count) = (move |at| LETTERS[bits >> (18 - 6 * at) & 63], three.len());
        (0..4).map(move |at| char::from(if at > count { b'=' } else { letter(at) }))
    };
    bytes.chunks(3).flat_map(letters).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_key_of_the_standard() {
        let mut fields = [EMPTY_HEADER; MOST_FIELDS];
        let text = b"GET /ws HTTP/1.1\r\nUpgrade: WebSocket\r\nSec-WebSocket-Version: 13\r\n\
                     Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
        let head = Head::read(text, &mut fields).expect("a head");
        assert_eq!(accept_key(&head).as_deref(), Some("s3pPLMBiTxaQ9kYGzzhZRbK+xOo="));
    }
}
