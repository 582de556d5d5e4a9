//! A whole world, as plain data.

use crate::world::color::Color;
use crate::world::item::{Item, Part, SpecError};
use ev3_motion::{Bounds, OUT_OF_RANGE, Pose};

/// Temperatures that there can be, in degrees Celsius.
const ABSOLUTE_ZERO: f64 = -273.15;
const HOTTEST: f64 = 1000.0;

/// Checks the corners of the walls around a world. Errors: if they are too far, or have no inside.
pub fn check_bounds(bounds: &Bounds) -> Result<(), SpecError> {
    let wrong = match (bounds.is_in_range(), bounds.has_inside()) {
        (true, true) => return Ok(()),
        (false, _) => OUT_OF_RANGE,
        (true, false) => "must have an inside",
    };
    Err(SpecError::new("bounds", wrong).in_part(Part::Bounds))
}

/// A world.
#[derive(Clone, Debug, PartialEq)]
pub struct WorldSpec {
    /// Everything in it.
    pub items: Vec<Item>,
    /// Walls all around, if it ends anywhere.
    pub bounds: Option<Bounds>,
    /// Color of the floor where nothing lies on it.
    pub floor: Color,
    /// Light that comes from everywhere, in the per cent of COL-AMBIENT.
    pub ambient: f64,
    /// Of the air and everything else, in degrees Celsius.
    pub temperature: f64,
    /// How loud it is, in percent of what an NXT sound sensor can measure.
    pub loudness: f64,
    /// Where the robot starts.
    pub start: Pose,
    /// Where robots of these names start, if there are several.
    pub starts: Vec<(String, Pose)>,
}

impl Default for WorldSpec {
    /// An endless white floor, a little light, a silent room's 21.5 degrees, and nothing else.
    fn default() -> Self {
        WorldSpec {
            items: Vec::new(),
            bounds: None,
            floor: Color::WHITE,
            ambient: 2.0,
            temperature: 21.5,
            loudness: 0.0,
            start: Pose::default(),
            starts: Vec::new(),
        }
    }
}

impl WorldSpec {
    /// The same for the robot of this name, which starts at its own place. Errors: if it has none.
    pub fn seen_by(&self, name: &str) -> Result<WorldSpec, SpecError> {
        let Some((_, start)) = self.starts.iter().rev().find(|(other, _)| other == name) else {
            return Err(SpecError::new(format!("start({name}, X, Y, Heading)"), "is missing"));
        };
        Ok(WorldSpec { start: *start, ..self.clone() })
    }

    /// Checks everything in it, and that the bounds have an inside with the start in it.
    /// Errors: names the first offending item.
    pub fn validate(&self) -> Result<(), SpecError> {
        for (index, item) in self.items.iter().enumerate() {
            item.validate().map_err(|error| error.in_part(Part::Item(index)))?;
        }
        if !(self.ambient.is_finite() && self.ambient >= 0.0) {
            return Err(SpecError::new("ambient", "must be 0 or more").in_part(Part::Ambient));
        }
        if !(ABSOLUTE_ZERO..=HOTTEST).contains(&self.temperature) {
            return Err(SpecError::new("temperature", "must be from -273.15 to 1000")
                .in_part(Part::Temperature));
        }
        if !(0.0..=100.0).contains(&self.loudness) {
            return Err(SpecError::new("loudness", "must be from 0 to 100").in_part(Part::Loudness));
        }
        let starts = self.starts.iter().map(|(_, start)| start);
        if !starts.chain([&self.start]).all(Pose::is_in_range) {
            return Err(SpecError::new("start", OUT_OF_RANGE).in_part(Part::Start));
        }
        if let Some(bounds) = self.bounds {
            check_bounds(&bounds)?;
        }
        Ok(())
    }
}
