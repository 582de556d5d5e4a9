//! The files of a sensor: `docs/ev3dev-sysfs.md`, 5.1.
use super::Sensor;
use crate::files::attr::{Attr, Table, text, uevent, write_uevent};
use crate::files::text::word;
use ev3_os::linux::Errno;

macro_rules! value {
    ($name:literal, $index:literal) => {
        Attr::ro($name, |s: &Sensor| text(s.value($index)?)).measured()
    };
}

impl Table for Sensor {
    const ATTRS: &'static [Attr<Sensor>] = &[
        Attr::ro("address", |s| text(s.address())),
        Attr::ro("bin_data", |s: &Sensor| Ok(s.bin_data())).size(32).measured(),
        Attr::ro("bin_data_format", |s| text(s.mode().format.name())),
        // A sensor that has none, as those of the EV3 sets, lists a lone newline.
        Attr::wo("command", |s, bytes| s.command(word(bytes, s.kind.commands.iter().copied())?)),
        Attr::ro("commands", |s| text(s.kind.commands.join(" "))),
        Attr::ro("decimals", |s| text(s.mode().decimals)),
        Attr::rw("direct", |s: &Sensor| s.direct_read(0, 255), |s, bytes| s.direct_write(0, bytes))
            .size(255),
        Attr::ro("driver_name", |s| text(s.kind.driver_name)),
        Attr::ro("fw_version", |s| text(s.version())),
        Attr::rw("mode", |s| text(s.mode().name), |s, bytes| s.select(word(bytes, s.modes())?)),
        Attr::ro("modes", |s| text(s.modes().collect::<Vec<_>>().join(" "))),
        Attr::ro("num_values", |s| text(s.mode().values)),
        Attr::rw("poll_ms", |s| text(s.poll_ms()?), Sensor::set_poll_ms),
        Attr::ro("text_value", |_| Err(Errno::EOPNOTSUPP)),
        Attr::rw(
            "uevent",
            |s| uevent(s.kind.driver_name, &s.address()),
            |_, bytes| write_uevent(bytes),
        ),
        Attr::ro("units", |s| text(s.mode().units)),
        value!("value0", 0),
        value!("value1", 1),
        value!("value2", 2),
        value!("value3", 3),
        value!("value4", 4),
        value!("value5", 5),
        value!("value6", 6),
        value!("value7", 7),
    ];
}
