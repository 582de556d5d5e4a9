//! The properties of boxes and circles beyond their form.

use crate::world::color::Color;
use std::fmt;
use std::ops::RangeInclusive;

/// Masses of things that robots push, in kg.
const MASSES: RangeInclusive<f64> = 0.005..=100.0;
const FRICTIONS: RangeInclusive<f64> = 0.0..=2.0;
const BOUNCES: RangeInclusive<f64> = 0.0..=0.9;
const HEIGHTS: RangeInclusive<f64> = 0.1..=1000.0;
/// The least side or diameter of a thing that robots push, in cm.
const SMALLEST: f64 = 1.0;
/// Friction of a box on the floor, and of a ball that rolls, as a share of its weight: plastic on
/// laminate has 0.2 to 0.5, a rolling ball of hard rubber 0.01 to 0.03.
const SLIDES: f64 = 0.4;
const ROLLS: f64 = 0.02;
/// How much of its speed a ball keeps that hits a wall, if nothing is said.
const BALL_BOUNCES: f64 = 0.5;
/// The ultrasonic and infrared sensors of a robot are as high above the floor, in cm, and see what
/// is not lower.
const SENSOR_HEIGHT: f64 = 5.0;

/// The properties of a box or circle. With a mass it is a thing that robots push.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Traits {
    /// In kg, from 0.005 to 100; `None` for what does not move.
    pub mass: Option<f64>,
    /// Friction on the floor as a share of the weight, from 0 to 2.
    pub friction: Option<f64>,
    /// In cm, from 0.1 to 1000; `None` for what each sensor sees.
    pub height: Option<f64>,
    /// A ball, not a disc: it rolls.
    pub rolls: bool,
    /// The share of its speed that it keeps when it hits something, from 0 to 0.9.
    pub bounces: Option<f64>,
    /// Its color.
    pub color: Option<Color>,
    /// Its name, by which programs ask for it.
    pub name: Option<String>,
}

impl Traits {
    /// Friction on the floor as a share of the weight.
    pub(crate) fn friction(&self) -> f64 {
        self.friction.unwrap_or(if self.rolls { ROLLS } else { SLIDES })
    }

    /// The share of its speed that it keeps when it hits something.
    pub(crate) fn bounces(&self) -> f64 {
        self.bounces.unwrap_or(if self.rolls { BALL_BOUNCES } else { 0.0 })
    }

    /// Whether sound and light go over it.
    pub(crate) fn is_low(&self) -> bool {
        self.height.is_some_and(|height| height < SENSOR_HEIGHT)
    }

    /// What is impossible about them for something whose least side or diameter is `least` cm.
    pub(crate) fn fault(&self, is_round: bool, least: f64) -> Option<&'static str> {
        let fits = |number: Option<f64>, range: RangeInclusive<f64>| {
            number.is_none_or(|number| range.contains(&number))
        };
        let moves_only = self.rolls || self.friction.is_some() || self.bounces.is_some();
        let checks = [
            (fits(self.mass, MASSES), "needs a mass from 0.005 to 100 kg"),
            (fits(self.friction, FRICTIONS), "needs a friction from 0 to 2"),
            (fits(self.bounces, BOUNCES), "needs bounces(Share) with a share from 0 to 0.9"),
            (fits(self.height, HEIGHTS), "needs a height from 0.1 to 1000 cm"),
            (
                is_round || !self.rolls,
                "has corners, so it does not roll: rolls(true) is for circles",
            ),
            (
                self.mass.is_some() || !moves_only,
                "needs mass(Kg), too: without a mass it does not move",
            ),
            (
                self.mass.is_none() || least >= SMALLEST,
                "is too small for a thing that moves: its least side is 1 cm",
            ),
        ];
        checks.into_iter().find(|(fine, _)| !fine).map(|(_, reason)| reason)
    }

    fn written(&self, way: impl Fn(&str) -> String) -> String {
        let number = |name: &str, number: Option<f64>| number.map(|it| format!("{name}({it})"));
        let all = [
            number("mass", self.mass),
            number("friction", self.friction),
            number("height", self.height),
            self.rolls.then(|| "rolls(true)".to_owned()),
            number("bounces", self.bounces),
            self.color.map(|color| format!("color({})", way(&color.to_string()))),
            self.name.as_ref().map(|name| format!("name({})", way(name))),
        ];
        format!("[{}]", all.into_iter().flatten().collect::<Vec<_>>().join(", "))
    }

    /// As a list of Prolog that can be read back.
    pub fn saved(&self) -> String {
        self.written(|name| format!("'{}'", name.replace('\\', "\\\\").replace('\'', "\\'")))
    }
}

/// As they stand in a message.
impl fmt::Display for Traits {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(str::to_owned))
    }
}
