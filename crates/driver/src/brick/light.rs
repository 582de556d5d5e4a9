//! Lights: class `leds`.
//!
//! The brick has a light on its left and one on its right, each made of a red and a green LED,
//! which the kernel shows as two devices. They are called `led0:red:brick-status` or, on jessie,
//! `ev3:left:red:ev3dev`. Other boards have other LEDs, or none; and an output port in the mode
//! `led` is one without a color, `ev3-ports:outA::brick-status`.
//!
//! The *trigger* of an LED switches it: nothing (`none`), `heartbeat`, which brickrun sets while a
//! program runs, or a timer, whose files `delay_on` and `delay_off` exist only as long as it is the
//! trigger. A brightness stays only without a trigger (docs/ev3dev-sysfs.md, 8.1).
use crate::class::{Class, Hue, led_name};
use crate::device::registry::Registry;
use crate::device::retry::{until_some, while_permissions_settle};
use crate::device::{Device, read_file, write_file};
use crate::error::{Error, Interrupted, Result};
use crate::journal::{Act, LightChange, Name};
use crate::port_name;
use crate::value::integer;
use ev3_os::Errno;
use std::sync::Arc;
use std::time::Duration;

/// How long the timer's files may take to be there and to be open to us, on a busy machine, too.
const DELAYS_WITHIN: Duration = Duration::from_secs(5);

/// No trigger.
const NONE: &str = "none";

/// The trigger that blinks.
const TIMER: &str = "timer";

/// The color a light shows.
#[derive(Clone, Debug, PartialEq)]
pub enum Color {
    /// `off`, `on`, `red`, `green`, `blue`, `amber`, `orange`, `yellow`.
    Named(&'static str),
    /// A light with one LED, in percent.
    Level(i64),
    /// The red, the green and perhaps the blue LED, each in percent.
    Levels(Vec<i64>),
}

/// The mixture of each color, in percent. If there are several, a light uses the
/// first one that its LEDs allow.
const COLORS: [(&str, &[(Hue, i64)]); 9] = [
    ("off", &[]),
    ("red", &[(Hue::Red, 100)]),
    ("green", &[(Hue::Green, 100)]),
    ("blue", &[(Hue::Blue, 100)]),
    ("amber", &[(Hue::Amber, 100)]),
    ("amber", &[(Hue::Red, 100), (Hue::Green, 100)]),
    ("orange", &[(Hue::Red, 100), (Hue::Green, 50)]),
    ("yellow", &[(Hue::Red, 10), (Hue::Green, 100)]),
    ("on", &[(Hue::Any, 100)]),
];

impl Color {
    /// The color in the journal.
    fn change(&self) -> LightChange {
        match self {
            Self::Named(name) => LightChange::Named(name),
            Self::Level(level) => LightChange::levels([*level]),
            Self::Levels(levels) => LightChange::levels(levels.iter().copied()),
        }
    }

    /// The color of that name.
    pub fn named(name: &str) -> Option<Self> {
        COLORS.iter().find(|(word, _)| *word == name).map(|(word, _)| Self::Named(word))
    }
}

/// A light: the left or the right one of the brick, or one on a port.
#[derive(Clone)]
pub struct Light {
    name: String,
    leds: Vec<(Hue, Arc<Device>)>,
}

/// The LED on a port.
pub(crate) fn on_port(registry: &Registry, port: &str) -> Result<Option<Arc<Device>>> {
    let port = port_name::short(port);
    let is_it = |led: &&Arc<Device>| {
        led_name(led.port())
            .is_some_and(|(owner, hue)| hue == Hue::Any && port_name::short(owner) == port)
    };
    Ok(registry.all(Class::Led)?.iter().find(is_it).cloned())
}

/// All lights: left, right, then those on ports in the order of ports.
pub fn lights(registry: &Registry) -> Result<Vec<Light>> {
    registry.retry_after_relisting(|| present_lights(registry))
}

fn present_lights(registry: &Registry) -> Result<Vec<Light>> {
    let mut owners: Vec<(String, Light)> = Vec::new();
    for led in registry.all(Class::Led)?.iter() {
        let Some((owner, hue)) = led_name(led.port()) else { continue };
        led.check_present()?;
        let led = (hue, Arc::clone(led));
        if let Some((_, light)) = owners.iter_mut().find(|(known, _)| known == owner) {
            light.leds.push(led);
        } else {
            let name = port_name::short(owner).to_owned();
            owners.push((owner.to_owned(), Light { name, leds: vec![led] }));
        }
    }
    let (mut sides, mut lights): (Vec<_>, Vec<_>) =
        owners.into_iter().partition(|(_, light)| light.leds.iter().any(|led| led.0 != Hue::Any));
    // The PiStorms has its bank B on the left.
    let is_b_first = |owner: &str| owner.ends_with(":BB");
    sides.sort_unstable_by(|(a, _), (b, _)| {
        is_b_first(b).cmp(&is_b_first(a)).then_with(|| port_name::order(a, b))
    });
    lights.sort_unstable_by(|(_, a), (_, b)| port_name::order(&a.name, &b.name));
    let sides = sides.into_iter().zip(["left", "right"]);
    let sides = sides.map(|((_, light), side)| Light { name: side.to_owned(), ..light });
    Ok(sides.chain(lights.into_iter().map(|(_, light)| light)).collect())
}

/// The light of that name, `left`, `right` or a port; `None` if there is no such light.
pub fn find(registry: &Registry, name: &str) -> Result<Option<Light>> {
    Ok(lights(registry)?.into_iter().find(|light| light.is_called(name)))
}

impl Light {
    /// `left`, `right`, or the port by its short name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether that is its name, a port in either spelling.
    pub fn is_called(&self, name: &str) -> bool {
        self.name == port_name::short(name)
    }

    /// The color it shows now. Of one that blinks that may be any moment's.
    pub fn color(&self) -> Result<Color> {
        let mut levels = Vec::new();
        for (hue, led) in &self.leds {
            levels.push((*hue, level(led)?));
        }
        levels.sort_unstable();
        let shining: Vec<_> = levels.iter().copied().filter(|(_, level)| *level > 0).collect();
        let named = COLORS.iter().find(|(_, mix)| *mix == shining);
        Ok(match (named, &*levels) {
            (Some((name, _)), _) => Color::Named(name),
            (None, [(_, level)]) => Color::Level(*level),
            _ => Color::Levels(levels.into_iter().map(|(_, level)| level).collect()),
        })
    }

    /// The brightness of each LED for a color, or `None` where the light cannot show it.
    fn mix(&self, color: &Color) -> Option<Vec<(&Arc<Device>, i64)>> {
        let hues = [Hue::Red, Hue::Green, Hue::Blue];
        let with = |mix: &[(Hue, i64)]| {
            let has = |hue| self.leds.iter().any(|led| led.0 == hue);
            let is_possible = mix.iter().all(|(hue, level)| *level == 0 || has(*hue));
            let level = |hue| mix.iter().find(|part| part.0 == hue).map_or(0, |part| part.1);
            is_possible.then(|| self.leds.iter().map(|(hue, led)| (led, level(*hue))).collect())
        };
        match color {
            Color::Named("on") => self.mix(&Color::Level(100)),
            Color::Named(name) => {
                COLORS.iter().filter(|(word, _)| word == name).find_map(|(_, mix)| with(mix))
            }
            Color::Level(level) => match &*self.leds {
                [(hue, _)] => with(&[(*hue, *level)]),
                _ => None,
            },
            Color::Levels(levels) => {
                let mix: Vec<_> = hues.into_iter().zip(levels.iter().copied()).collect();
                with(&mix)
            }
        }
    }

    /// Its trigger, `none` if nothing switches it.
    pub fn trigger(&self) -> Result<String> {
        for (_, led) in &self.leds {
            let trigger = trigger(led)?;
            if trigger != NONE {
                return Ok(trigger);
            }
        }
        Ok(NONE.to_owned())
    }

    /// The triggers it may have.
    pub fn triggers(&self) -> Result<Vec<String>> {
        let Some((_, led)) = self.leds.first() else { return Ok(Vec::new()) };
        let text = led.text("trigger")?;
        Ok(text.split_ascii_whitespace().map(|word| bare(word).to_owned()).collect())
    }

    /// The LEDs that make its color: those that shine or are switched; all of a light that is off.
    fn shining(&self) -> Result<Vec<Arc<Device>>> {
        let mut shining = Vec::new();
        for (_, led) in &self.leds {
            if led.number("brightness")? > 0 || trigger(led)? != NONE {
                shining.push(Arc::clone(led));
            }
        }
        if shining.is_empty() {
            shining.extend(self.leds.iter().map(|(_, led)| Arc::clone(led)));
        }
        Ok(shining)
    }

    /// How long it is on and off while it blinks, in milliseconds; `None` if it does not.
    pub fn delays(&self) -> Result<Option<(i64, i64)>> {
        for (_, led) in &self.leds {
            if trigger(led)? == TIMER {
                return Ok(Some((delay(led, "delay_on")?, delay(led, "delay_off")?)));
            }
        }
        Ok(None)
    }
}

/// Makes a light show a color, and removes its trigger. `None` if there is no such light, `false`
/// if it cannot show that. Errors: the kernel's; [`Error::Interrupted`].
pub fn set_color(
    registry: &Registry,
    name: &str,
    color: &Color,
    interrupted: Interrupted,
) -> Result<Option<bool>> {
    while_permissions_settle(registry, interrupted, || {
        let Some(light) = find(registry, name)? else { return Ok(None) };
        let Some(mix) = light.mix(color) else { return Ok(Some(false)) };
        for (led, _) in &mix {
            if trigger(led)? != NONE {
                led.write("trigger", NONE)?;
            }
        }
        for (led, percent) in mix {
            let full = led.constant("max_brightness")?;
            led.write_number("brightness", (percent * full + 50) / 100)?;
        }
        note(registry, name, color.change());
        Ok(Some(true))
    })
}

/// Lets something else switch a light, in the color it shows. `None` where there is no such light.
/// Errors: the kernel's, as EINVAL for a trigger it does not know; [`Error::Interrupted`].
pub fn set_trigger(
    registry: &Registry,
    name: &str,
    word: &str,
    interrupted: Interrupted,
) -> Result<Option<()>> {
    while_permissions_settle(registry, interrupted, || match find(registry, name)? {
        Some(light) => {
            light.shining()?.iter().try_for_each(|led| led.write("trigger", word))?;
            note(registry, name, LightChange::Trigger(Name::from(word)));
            Ok(Some(()))
        }
        None => Ok(None),
    })
}

/// Makes a light blink, in the color it shows: `on` and `off` are in
/// milliseconds. `None` if there is no such light.
pub fn blink(
    registry: &Registry,
    name: &str,
    [on, off]: [i64; 2],
    interrupted: Interrupted,
) -> Result<Option<()>> {
    let blinking =
        while_permissions_settle(registry, &mut *interrupted, || match find(registry, name)? {
            Some(light) => {
                let leds = light.shining()?;
                for led in &leds {
                    // Writing the same trigger again would reset the color and
                    // recreate the timer's files.
                    if trigger(led)? != TIMER {
                        led.write("trigger", TIMER)?;
                    }
                }
                Ok(Some(leds))
            }
            None => Ok(None),
        })?;
    let Some(leds) = blinking else { return Ok(None) };
    for (file, milliseconds) in [("delay_on", on), ("delay_off", off)] {
        for led in &leds {
            set_delay(registry, led, file, milliseconds, &mut *interrupted)?;
        }
    }
    let [on, off] = [on, off].map(|time| i32::try_from(time).unwrap_or(i32::MAX));
    note(registry, name, LightChange::Blink(on, off));
    Ok(Some(()))
}

fn note(registry: &Registry, name: &str, change: LightChange) {
    let act = Act::Light(Name::from(name), change);
    registry.journal().note(registry.tree().now(), act);
}

/// Writes a file of the timer's, which appears in its own time. It is another
/// file each time that the timer becomes the trigger, so it is not kept open.
fn set_delay(
    registry: &Registry,
    led: &Device,
    file: &str,
    milliseconds: i64,
    interrupted: Interrupted,
) -> Result<()> {
    let latest = registry.tree().now().saturating_add(DELAYS_WITHIN);
    let path = led.path().join(file);
    until_some(registry.tree(), interrupted, |_| {
        match write_file(registry.tree(), &path, &milliseconds.to_string()) {
            Err(error) if is_early(&error) && registry.tree().now() < latest => Ok(None),
            written => written.map(Some),
        }
    })
}

/// Whether the timer's files may not be there yet, or not open to us.
fn is_early(error: &Error) -> bool {
    matches!(error.errno(), Some(Errno::NOENT | Errno::ACCESS))
}

fn delay(led: &Device, file: &'static str) -> Result<i64> {
    let path = led.path().join(file);
    let text = read_file(led.tree(), &path)?;
    integer(text.as_bytes()).ok_or(Error::Malformed { path, text, expected: "an integer" })
}

/// How bright an LED is, in percent.
fn level(led: &Device) -> Result<i64> {
    let full = led.constant("max_brightness")?.max(1);
    Ok((led.number("brightness")? * 100 + full / 2) / full)
}

/// An LED's trigger: that in brackets, of all there are.
fn trigger(led: &Device) -> Result<String> {
    let text = led.text("trigger")?;
    let mut words = text.split_ascii_whitespace();
    let chosen = words.clone().find(|word| bare(word).len() < word.len());
    Ok(chosen.or_else(|| words.next()).map_or(NONE, bare).to_owned())
}

/// A word without brackets around it.
fn bare(word: &str) -> &str {
    word.strip_prefix('[').and_then(|word| word.strip_suffix(']')).unwrap_or(word)
}
