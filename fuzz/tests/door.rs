//! What comes through the door before anybody has shown a token, and what a page sends.
use bolero::{TypeGenerator, check};
use ev3_door::Site;
use ev3_door::fuzz::{messages, reply};

/// A part of a request.
#[derive(Debug, TypeGenerator)]
enum Part {
    Word(u8),
    Bytes(Vec<u8>),
}

const WORDS: [&str; 32] = [
    "GET ",
    "POST ",
    "/",
    "/stop",
    "/samples.csv",
    "/index.html",
    "/../Cargo.toml",
    "/%2e%2e/",
    "?t=",
    "?",
    " HTTP/1.1",
    "\r\n",
    "\r\n\r\n",
    "\n",
    "Host: ",
    "127.0.0.1:8000",
    "localhost:8000",
    "[::1]:8000",
    "evil.example",
    "Origin: ",
    "http://localhost:8000",
    "null",
    "Cookie: ",
    "ev3view_8000=",
    "t=",
    "; ",
    "Upgrade: websocket",
    "Connection: Upgrade",
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==",
    "Sec-WebSocket-Version: 13",
    "Sec-Fetch-Site: cross-site",
    "toke",
];

fn text(parts: &[Part]) -> Vec<u8> {
    let part = |part: &Part| match part {
        Part::Word(number) => WORDS[usize::from(*number) % WORDS.len()].as_bytes().to_vec(),
        Part::Bytes(bytes) => bytes.clone(),
    };
    parts.iter().flat_map(part).collect()
}

#[test]
fn nobody_enters_without_the_token() {
    let site = Site {
        any: false,
        port: 8000,
        token: "token-that-nobody-guesses".into(),
        files: "../prolog/ev3dev/view".into(),
        made: &[],
        stop: || panic!("STOP without a token"),
    };
    check!().with_type::<(u8, Vec<Part>)>().for_each(|(start, parts)| {
        // Random parts seldom make a whole line and a host, so most requests begin with these.
        let starts = [
            "",
            "GET /?t=",
            "GET / HTTP/1.1\r\nHost: localhost:8000\r\nCookie: ",
            "POST /stop HTTP/1.1\r\nHost: localhost:8000\r\nOrigin: http://localhost:8000\r\n",
        ];
        let mut request = starts[usize::from(*start) % starts.len()].as_bytes().to_vec();
        request.extend(text(parts));
        request.extend(b"\r\n\r\n");
        let answer = reply(&site, &request);
        assert!(answer.starts_with(b"HTTP/1.1 4"), "{}", String::from_utf8_lossy(&answer));
    });
}

/// A frame of a websocket, more or less.
#[derive(Debug, TypeGenerator)]
struct Frame {
    first: u8,
    second: u8,
    is_short: bool,
    data: Vec<u8>,
}

#[test]
fn messages_do_not_depend_on_how_they_are_cut() {
    check!().with_type::<(Vec<Frame>, Vec<u8>)>().for_each(|(frames, cuts)| {
        let mut bytes = Vec::new();
        for Frame { first, second, is_short, data } in frames {
            let length = u8::try_from(data.len()).unwrap_or(125).min(125);
            let second = if *is_short { 0x80 | length } else { *second };
            let first = if *is_short { first & 0x8f } else { *first };
            bytes.extend([first, second, 0, 0, 0, 0]);
            bytes.extend(&data[..usize::from(length).min(data.len())]);
        }
        let whole = messages(&[&bytes]);
        let mut parts = Vec::new();
        let mut rest = &bytes[..];
        for cut in cuts {
            let (part, others) = rest.split_at(usize::from(*cut).min(rest.len()));
            parts.push(part);
            rest = others;
        }
        parts.push(rest);
        assert_eq!(whole, messages(&parts));
    });
}
