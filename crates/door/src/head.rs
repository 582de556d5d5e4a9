//! The head of a request, and whether it comes from the page or from one who has its address.
use httparse::{EMPTY_HEADER, Header};
use std::{fs, str};

/// The most fields of a head.
pub(crate) const MOST_FIELDS: usize = 64;

/// The head of a request.
pub(crate) struct Head<'a> {
    pub(crate) method: &'a str,
    pub(crate) path: &'a str,
    query: &'a str,
    fields: &'a [Header<'a>],
}

impl<'a> Head<'a> {
    /// Reads a head; `None` if it is malformed.
    pub(crate) fn read(text: &'a [u8], fields: &'a mut [Header<'a>; MOST_FIELDS]) -> Option<Self> {
        *fields = [EMPTY_HEADER; MOST_FIELDS];
        let mut request = httparse::Request::new(fields);
        request.parse(text).ok()?;
        let (method, target, fields) = (request.method?, request.path?, request.headers);
        let (path, query) = target.split_once('?').unwrap_or((target, ""));
        Some(Self { method, path, query, fields })
    }

    /// The values of a field; one that is not a text is empty.
    pub(crate) fn values(&self, name: &str) -> impl Iterator<Item = &'a str> {
        let is_meant = move |field: &&Header| field.name.eq_ignore_ascii_case(name);
        self.fields.iter().filter(is_meant).map(|field| str::from_utf8(field.value).unwrap_or(""))
    }

    /// The value of a field that is there.
    pub(crate) fn value(&self, name: &str) -> Option<&'a str> {
        self.values(name).next()
    }

    /// Why this request may not enter, if it may not.
    pub(crate) fn refusal(&self, any: bool, port: u16, token: &str) -> Option<&'static str> {
        if !self.host_is_ours(any, port) {
            Some("This name is not the one of this server.")
        } else if !self.origin_is_ours() {
            Some("This request comes from another page.")
        } else if !self.has_token(port, token) {
            Some("Start from the address that view/0 has printed.")
        } else {
            None
        }
    }

    /// All names that a request has for this server must be ours.
    fn host_is_ours(&self, any: bool, ours: u16) -> bool {
        let is_ours = |host: &str| {
            let (name, port) = match host.rsplit_once(':') {
                Some((name, port)) if !port.ends_with(']') => (name, port),
                _ => (host, "80"),
            };
            port == ours.to_string() && is_our_name(&name.to_ascii_lowercase(), any)
        };
        self.value("host").is_some() && self.values("host").all(is_ours)
    }

    /// A page of another server has another origin. Only a request that changes nothing may come
    /// without one.
    fn origin_is_ours(&self) -> bool {
        let ours = self.value("host");
        let is_ours = |origin: &str| origin.strip_prefix("http://") == ours;
        let needs_none = self.method == "GET" && self.path != "/ws";
        (needs_none || self.value("origin").is_some()) && self.values("origin").all(is_ours)
    }

    /// The token is in the address of the page, or in the cookie that came with the page.
    fn has_token(&self, port: u16, token: &str) -> bool {
        let name = format!("ev3view_{port}=");
        let mut query = self.query.split('&').filter(|_| self.path == "/");
        let mut cookies = self.values("cookie").flat_map(|cookies| cookies.split(';'));
        let is_right = |given: Option<&str>| given.is_some_and(|given| same(given, token));
        query.any(|part| is_right(part.strip_prefix("t=")))
            || cookies.any(|cookie| is_right(cookie.trim().strip_prefix(&name)))
    }
}

fn is_our_name(name: &str, any: bool) -> bool {
    let is_numeric =
        || name.split('.').count() == 4 && name.split('.').all(|part| part.parse::<u8>().is_ok());
    let is_machine = || {
        let ours = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
        let ours = ours.trim().to_ascii_lowercase();
        !ours.is_empty() && name.strip_suffix(".local").unwrap_or(name) == ours
    };
    ["localhost", "127.0.0.1", "[::1]"].contains(&name) || any && (is_numeric() || is_machine())
}

/// Takes as long for any text of that length.
fn same(given: &str, token: &str) -> bool {
    let differences = given.bytes().zip(token.bytes()).fold(0, |all, (a, b)| all | (a ^ b));
    given.len() == token.len() && differences == 0
}
