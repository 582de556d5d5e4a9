//! Names of ports.
//!
//! The kernel calls the EV3's ports `ev3-ports:outA` on ev3dev-stretch and later, `outA` on jessie.
//! Programs may use either, everywhere; devices are listed under the short name. Other boards'
//! names (`spi0.1:MA`) have no short form.
use std::cmp::Ordering;

/// Prefixes that name the board, on boards with LEGO's own port names.
const BOARDS: [&str; 2] = ["ev3-ports:", "evb-ports:"];

/// The short name of a port: `outA` for `ev3-ports:outA`.
pub fn short(address: &str) -> &str {
    BOARDS.iter().find_map(|board| address.strip_prefix(board)).unwrap_or(address)
}

/// The socket that a port is in: `in1` for the sensor at address 1 of the I2C bus there,
/// `in1:i2c1`. A sensor on a multiplexer, such as `in1:i2c80:mux1`, is in no socket.
pub fn socket(port: &str) -> &str {
    let is_address = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    match short(port).rsplit_once(":i2c") {
        Some((socket, address)) if is_address(address) => socket,
        _ => short(port),
    }
}

/// Whether `port` names the device at `address`: by its address in either
/// spelling, or by the socket it is in.
pub fn names(port: &str, address: &str) -> bool {
    let (port, address) = (short(port), short(address));
    port == address || port == socket(address)
}

/// The order in which ports are listed: alphabetical, with numbers in their
/// own order, so that `S2` comes before `S10`.
pub fn order(a: &str, b: &str) -> Ordering {
    let mut chunks = (chunks(a), chunks(b));
    loop {
        match (chunks.0.next(), chunks.1.next()) {
            (None, None) => return Ordering::Equal,
            (a, b) if a == b => {}
            (a, b) => return a.cmp(&b),
        }
    }
}

/// The parts of a name: numbers (as length of their digits, digits), and what is between them.
fn chunks(name: &str) -> impl Iterator<Item = (usize, &str)> {
    name.as_bytes().chunk_by(|a, b| a.is_ascii_digit() == b.is_ascii_digit()).scan(
        0,
        move |start, chunk| {
            let text = name.get(*start..*start + chunk.len()).unwrap_or_default();
            *start += chunk.len();
            let is_number = text.starts_with(|c: char| c.is_ascii_digit());
            Some((if is_number { text.len() } else { 0 }, text))
        },
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_spellings_have_one_short_form() {
        assert_eq!(short("ev3-ports:outA"), "outA");
        assert_eq!(short("outA"), "outA");
        assert_eq!(short("ev3-ports:in1:i2c1"), "in1:i2c1");
        assert_eq!(short("spi0.1:MA"), "spi0.1:MA");
    }

    #[test]
    fn a_socket_names_what_is_on_its_bus() {
        assert_eq!(socket("ev3-ports:in1:i2c1"), "in1");
        assert_eq!(socket("spi0.1:S1:i2c76"), "spi0.1:S1");
        assert_eq!(socket("in1:i2c80:mux1"), "in1:i2c80:mux1");
        assert_eq!(socket("in1:i2c"), "in1:i2c");
        assert!(names("in1", "in1:i2c1") && names("ev3-ports:in1", "in1:i2c1"));
        assert!(names("in1:i2c1", "ev3-ports:in1:i2c1"));
        assert!(!names("in1:i2c1", "in1") && !names("in2", "in1:i2c1"));
    }

    #[test]
    fn ports_are_listed_in_their_natural_order() {
        let mut ports = ["spi0.1:S10", "outB", "in1:i2c80:mux1", "spi0.1:S2", "outA", "in1"];
        ports.sort_unstable_by(|a, b| order(a, b));
        let sorted = ["in1", "in1:i2c80:mux1", "outA", "outB", "spi0.1:S2", "spi0.1:S10"];
        assert_eq!(ports, sorted);
        assert_eq!(order("ä1", "ä1"), Ordering::Equal);
    }
}
