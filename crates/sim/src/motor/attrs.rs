//! The files of a tacho motor: `docs/ev3dev-sysfs.md`, 2.
use super::kind::COUNT_PER_M;
use super::{Command, StopAction, Tacho};
use crate::files::attr::{Attr, Effect, Table, text, uevent, write_uevent};
use crate::files::text::{strict_int, strict_int_in, strict_int_to, word};
use ev3_os::linux::Errno;

const POLARITIES: [&str; 2] = ["normal", "inversed"];
const LONGEST_RAMP_MS: i32 = 60_000;

impl Tacho {
    /// Physical numbers to the numbers in the files, and back.
    pub(super) fn sign(&self, value: i32) -> i32 {
        if self.inversed { value.wrapping_neg() } else { value }
    }
}

fn joined<T>(words: &[(&str, T)]) -> String {
    words.iter().map(|(word, _)| *word).collect::<Vec<_>>().join(" ")
}

fn chosen<T: Copy>(bytes: &[u8], words: &[(&str, T)]) -> Result<T, Errno> {
    word(bytes, words.iter().map(|(word, _)| *word)).map(|index| words[index].1)
}

/// Stores a parsed number in a field.
macro_rules! store {
    ($motor:ident . $($field:ident).+ = $value:expr) => {{
        $motor.$($field).+ = $value;
        Ok(Effect::Done)
    }};
}

/// An attribute that is a number of the motor, from a least to a most.
macro_rules! within {
    ($name:literal, $($field:ident).+, $least:expr, $most:expr) => {
        Attr::rw(
            $name,
            |m| text(m.$($field).+),
            |m, b| store!(m.$($field).+ = strict_int_in(b, $least, $most)?),
        )
    };
}

impl Table for Tacho {
    const ATTRS: &'static [Attr<Tacho>] = &[
        Attr::ro("address", |m| text(m.port.address())),
        Attr::wo("command", |m, bytes| {
            m.command(chosen(bytes, &Command::WORDS)?);
            Ok(Effect::Done)
        }),
        Attr::ro("commands", |_| text(joined(&Command::WORDS))),
        Attr::ro("count_per_m", |_| text(COUNT_PER_M)).only_while(|m| m.kind.travel.is_some()),
        Attr::ro("count_per_rot", |_| text(360)).only_while(|m| m.kind.travel.is_none()),
        Attr::ro("driver_name", |m| text(m.kind.driver_name)),
        Attr::ro("duty_cycle", |m| text(m.sign(m.duty))),
        Attr::rw(
            "duty_cycle_sp",
            |m| text(m.sign(m.set.duty)),
            |m, bytes| {
                m.set.duty = m.sign(strict_int_in(bytes, -100, 100)?);
                if m.command == Command::RunDirect {
                    m.active.duty = m.set.duty;
                    m.run_direct(m.set.duty);
                }
                Ok(Effect::Done)
            },
        ),
        Attr::ro("full_travel_count", |m: &Tacho| text(m.kind.travel.unwrap_or(0)))
            .only_while(|m| m.kind.travel.is_some()),
        within!("hold_pid/Kd", hold_pid.kd, 0, i32::MAX),
        within!("hold_pid/Ki", hold_pid.ki, 0, i32::MAX),
        within!("hold_pid/Kp", hold_pid.kp, 0, i32::MAX),
        Attr::ro("max_speed", |m| text(m.kind.max_speed)),
        Attr::rw(
            "polarity",
            |m| text(POLARITIES[usize::from(m.inversed)]),
            |m, b| store!(m.inversed = word(b, POLARITIES.into_iter())? == 1),
        ),
        Attr::rw(
            "position",
            |m| text(m.sign(m.position())),
            |m, bytes| {
                let position = strict_int(bytes)?;
                m.redefine_position(m.sign(position));
                Ok(Effect::Done)
            },
        ),
        Attr::rw(
            "position_sp",
            |m| text(m.sign(m.set.position)),
            |m, b| store!(m.set.position = m.sign(strict_int(b)?)),
        ),
        within!("ramp_down_sp", set.ramp_down_ms, 0, LONGEST_RAMP_MS),
        within!("ramp_up_sp", set.ramp_up_ms, 0, LONGEST_RAMP_MS),
        Attr::ro("speed", |m| text(m.sign(m.speed))),
        within!("speed_pid/Kd", speed_pid.kd, 0, i32::MAX),
        within!("speed_pid/Ki", speed_pid.ki, 0, i32::MAX),
        within!("speed_pid/Kp", speed_pid.kp, 0, i32::MAX),
        Attr::rw(
            "speed_sp",
            |m| text(m.sign(m.set.speed)),
            |m, bytes| {
                let speed = strict_int_to(bytes, m.kind.max_speed)?;
                store!(m.set.speed = m.sign(speed))
            },
        ),
        Attr::ro("state", |m| text(m.state())),
        Attr::rw(
            "stop_action",
            |m| {
                let index = StopAction::WORDS.iter().position(|(_, a)| *a == m.set.stop_action);
                text(StopAction::WORDS[index.unwrap_or(0)].0)
            },
            |m, b| store!(m.set.stop_action = chosen(b, &StopAction::WORDS)?),
        ),
        Attr::ro("stop_actions", |_| text(joined(&StopAction::WORDS))),
        within!("time_sp", set.time_ms, 0, i32::MAX),
        Attr::rw(
            "uevent",
            |m| uevent(m.kind.driver_name, m.port.address()),
            |_, b| write_uevent(b),
        ),
    ];
}
