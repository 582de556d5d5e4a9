//! What a program has commanded, in the log of the pages.
use super::notes::notes;
use super::state::{Decimal, Entry, Text};
use crate::glue::state::chosen_devices;
use ev3_driver::drive::steering::Leg;
use ev3_driver::drive::{Command, DriveOptions};
use ev3_driver::journal::{Act, Course, LightChange, MotorCommand, SoundCommand};
use std::sync::{Arc, Mutex, PoisonError};
use swipl::prelude::*;

/// How far the journal is in the log: of which devices, and how many entries.
static LOGGED: Mutex<(usize, u64)> = Mutex::new((0, 0));

/// Adds what is new in the journal to the log. `causes` says why, for the number of a cause.
pub(super) fn log_new(
    mut causes: impl FnMut(u32) -> PrologResult<Vec<String>>,
) -> PrologResult<()> {
    let Some(devices) = chosen_devices() else {
        return Ok(());
    };
    let mut logged = LOGGED.lock().unwrap_or_else(PoisonError::into_inner);
    let address = Arc::as_ptr(&devices).addr();
    let after = if logged.0 == address { logged.1 } else { 0 };
    let (entries, count) = devices.journal().after(after);
    *logged = (address, count);
    drop(logged);
    let mut last = (0, Vec::new());
    for entry in entries {
        let Some(text) = words(&entry.act) else {
            continue;
        };
        let cause = entry.origin.cause;
        if cause != last.0 {
            last = (cause, if cause == 0 { Vec::new() } else { causes(cause)? });
        }
        let causes_of: Vec<Text> = last.1.iter().cloned().map(Text::Owned).collect();
        notes().log(Entry {
            n: 0,
            time: Decimal(entry.time.as_secs_f64()),
            kind: "command".into(),
            text: text.into(),
            causes: (!causes_of.is_empty()).then_some(causes_of),
            thread: None,
        });
    }
    Ok(())
}

/// What was done, in the words of the kernel's attributes and of the drive; `None` for what
/// moves nothing.
fn words(act: &Act) -> Option<String> {
    Some(match act {
        Act::Motor(port, command) => format!("{} {}", port.text(), of_motor(command)),
        Act::Course(course) => format!("{} drive {}", wheels(course), of_course(course)),
        Act::Ended(course, reason) => format!("{} rest: {reason}", wheels(course)),
        Act::Light(light, change) => format!("{} {}", light.text(), of_light(change)),
        Act::Sound(sound) => of_sound(sound),
        Act::Pose(_) => return None,
    })
}

fn of_motor(command: &MotorCommand) -> String {
    let numbers = command.numbers().map(|(name, number)| format!(" {name} {number}"));
    let action = command.stop_action().map(|action| format!(" {}", action.word()));
    std::iter::once(command.word.text().to_owned()).chain(numbers).chain(action).collect()
}

fn wheels(course: &Course) -> String {
    let [left, right] = &course.wheels;
    format!("{} and {}", left.text(), right.text())
}

fn of_course(Course { course, options, .. }: &Course) -> String {
    let DriveOptions { percent, .. } = options;
    match course {
        Command::Legs(legs, backwards) => {
            let legs: Vec<_> = legs.iter().map(of_leg).collect();
            let backwards = if *backwards { ", backwards" } else { "" };
            format!("{}{backwards}, at {percent:.0} %", legs.join(", "))
        }
        Command::Cruise(speed, rate) | Command::Change(speed, rate) => {
            format!("on at {speed:.1} cm/s, {rate:.0} degrees/s")
        }
        Command::Wheels([left, right]) => {
            format!("on, {left:.2} to {right:.2}, at {percent:.0} %")
        }
    }
}

fn of_leg(leg: &Leg) -> String {
    match leg {
        Leg::Turn(angle) => format!("by {angle:.0} degrees"),
        Leg::Heading(heading) | Leg::Face(heading) => format!("to heading {heading:.0}"),
        Leg::Towards([x, y]) => format!("towards {x:.0}-{y:.0}"),
        Leg::To([x, y]) | Leg::Reach([x, y]) => format!("to {x:.0}-{y:.0}"),
        Leg::Arc(length, curvature) if curvature.abs() < 1e-9 => format!("{length:.1} cm"),
        Leg::Arc(length, _) => format!("an arc of {length:.1} cm"),
        Leg::Through(places, _) => format!("through {} places", places.len()),
        Leg::Pieces(pieces) => format!("along {} lines and arcs", pieces.len()),
    }
}

fn of_light(change: &LightChange) -> String {
    match change {
        LightChange::Named(color) => (*color).to_owned(),
        LightChange::Levels(levels, count) => {
            let levels = levels.iter().take(usize::from(*count)).map(|level| format!("{level} %"));
            levels.collect::<Vec<_>>().join(" ")
        }
        LightChange::Trigger(name) => format!("trigger {}", name.text()),
        LightChange::Blink(on, off) => format!("blinks: {on} ms on, {off} ms off"),
    }
}

fn of_sound(sound: &SoundCommand) -> String {
    match sound {
        SoundCommand::Tones(tones) => {
            let tones = tones.iter().take(8).map(|(hertz, _)| format!("{hertz} Hz"));
            format!("sound {}", tones.collect::<Vec<_>>().join(" "))
        }
        SoundCommand::Say(text) => format!("says {text}"),
        SoundCommand::Play(file) => format!("plays {file}"),
        SoundCommand::Stop => "silence".to_owned(),
    }
}
