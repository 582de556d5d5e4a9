//! The things that stand and lie in a world, as plain data. All that the simulator knows about a
//! kind of thing is in this file: its form as a fact, its variant, what is possible, and its shape.

use ev3_motion::{OUT_OF_RANGE, Point, Pose, is_in_range};
use std::fmt;

use crate::brick::port::Port;
use crate::world::color::Color;
use crate::world::form::{Form, Kind, Value};
use crate::world::{Hull, Traits};

/// Names an item of a world. Bounds are item 0, the items of the world's spec follow in order,
/// and what is added later gets the next number; numbers are not used again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ItemId(pub u32);

/// One thing in the world. Lengths in cm, headings in degrees clockwise.
#[derive(Clone, Debug, PartialEq)]
pub enum Item {
    /// A wall from a point to another.
    Wall {
        /// One end.
        from: Point,
        /// The other end.
        to: Point,
        /// How thick it is, centerd on the line between the ends.
        thickness: f64,
    },
    /// A box.
    Box {
        /// Center and direction of its depth.
        pose: Pose,
        /// Extent across its heading.
        width: f64,
        /// Extent along its heading.
        depth: f64,
        /// All else.
        traits: Traits,
    },
    /// A round thing.
    Circle {
        /// Center.
        center: Point,
        /// Radius.
        radius: f64,
        /// All else.
        traits: Traits,
    },
    /// A colored polygon on the floor. Later patches and lines cover earlier ones.
    Patch {
        /// At least three corners, in order.
        corners: Vec<Point>,
        /// Its color.
        color: Color,
    },
    /// A line on the floor, with round ends and joints.
    Line {
        /// At least two points.
        points: Vec<Point>,
        /// How wide it is.
        width: f64,
        /// Its color.
        color: Color,
    },
    /// A lamp, 30 cm above the floor.
    Lamp {
        /// Where it hangs.
        at: Point,
        /// The percentage that a color sensor in COL-AMBIENT reads when it looks at the lamp
        /// from 100 cm. It falls with the square of the distance: of 12 there is left about 100
        /// at 20 cm, 40 at 50 cm, 3 at 200 cm.
        intensity: f64,
    },
    /// A lamp like the others, but lit by an output port in the mode `dc-motor` or `led`: as bright
    /// as the duty or brightness there says.
    Bulb {
        /// Where it hangs.
        at: Point,
        /// As of a lamp, at 100 %.
        intensity: f64,
        /// The port it is plugged into.
        port: Port,
    },
    /// A remote control whose beacon is on, as high as the sensors. Seen from up to 200 cm.
    Beacon {
        /// Where it stands.
        at: Point,
        /// 1 to 4.
        channel: u8,
    },
}

/// The things that a world may have.
pub(crate) const THINGS: &[Form] = {
    use Kind::{Channel, Color, Number, Places, Port, Traits};
    const X: (&str, Kind) = ("X", Number);
    const Y: (&str, Kind) = ("Y", Number);
    const WALL: &[(&str, Kind)] =
        &[("X1", Number), ("Y1", Number), ("X2", Number), ("Y2", Number), ("Thickness", Number)];
    const OPTIONS: (&str, Kind) = ("Options", Traits);
    const BOX: &[(&str, Kind)] =
        &[X, Y, ("Width", Number), ("Depth", Number), ("Heading", Number), OPTIONS];
    &[
        Form::with_default("wall", WALL),
        Form::with_defaults("box", BOX, 2),
        Form::with_default("circle", &[X, Y, ("Radius", Number), OPTIONS]),
        Form::new("patch", &[("Color", Color), ("Corners", Places)]),
        Form::new("line", &[("Color", Color), ("Width", Number), ("Places", Places)]),
        Form::with_default("lamp", &[X, Y, ("Intensity", Number), ("Port", Port)]),
        Form::new("beacon", &[X, Y, ("Channel", Channel)]),
    ]
};

/// What a thing looks like from above. The first three are solid: they stop robots, sound and
/// light.
#[derive(Clone, Debug)]
#[expect(missing_docs, reason = "named as in `Item`")]
pub enum Shape<'a> {
    Bar { from: Point, to: Point, thickness: f64 },
    Box { pose: Pose, width: f64, depth: f64 },
    Disc { center: Point, radius: f64 },
    Area { corners: &'a [Point], color: Color },
    Band { points: &'a [Point], width: f64, color: Color },
    Mark { at: Point, class: String, radius: f64, fill: &'static str, stroke: &'static str },
}

impl Item {
    /// The thing of a fact with this name. `None` if its arguments are others than its form says.
    pub(crate) fn of(name: &str, arguments: &[Value]) -> Option<Item> {
        use Value::{Channel, Color, Number, Places, Port, Traits};
        Some(match (name, arguments) {
            ("wall", [Number(x1), Number(y1), Number(x2), Number(y2)]) => {
                Item::wall([*x1, *y1], [*x2, *y2])
            }
            ("wall", [Number(x1), Number(y1), Number(x2), Number(y2), Number(thickness)]) => {
                Item::Wall { from: [*x1, *y1], to: [*x2, *y2], thickness: *thickness }
            }
            ("box", [Number(x), Number(y), Number(width), Number(depth), others @ ..]) => {
                let (heading, traits) = match others {
                    [] => (0.0, self::Traits::default()),
                    [Number(heading)] => (*heading, self::Traits::default()),
                    [Number(heading), Traits(traits)] => (*heading, traits.clone()),
                    _ => return None,
                };
                let pose = Pose::new(*x, *y, heading);
                Item::Box { pose, width: *width, depth: *depth, traits }
            }
            ("circle", [Number(x), Number(y), Number(radius), others @ ..]) => {
                let traits = match others {
                    [] => self::Traits::default(),
                    [Traits(traits)] => traits.clone(),
                    _ => return None,
                };
                Item::Circle { center: [*x, *y], radius: *radius, traits }
            }
            ("patch", [Color(color), Places(corners)]) => {
                Item::Patch { corners: corners.clone(), color: *color }
            }
            ("line", [Color(color), Number(width), Places(points)]) => {
                Item::Line { points: points.clone(), width: *width, color: *color }
            }
            ("lamp", [Number(x), Number(y), Number(intensity)]) => {
                Item::Lamp { at: [*x, *y], intensity: *intensity }
            }
            ("lamp", [Number(x), Number(y), Number(intensity), Port(port)]) => {
                Item::Bulb { at: [*x, *y], intensity: *intensity, port: *port }
            }
            ("beacon", [Number(x), Number(y), Channel(channel)]) => {
                Item::Beacon { at: [*x, *y], channel: *channel }
            }
            _ => return None,
        })
    }

    /// The name of its fact, and the arguments under the names that pages have for them.
    pub fn members(&self) -> (&'static str, Vec<(&'static str, Value)>) {
        use Value::{Channel, Color, Number, Place, Places, Port};
        let place = |[x, y]: Point| [("x", Number(x)), ("y", Number(y))];
        let with = |at: Point, others: Vec<_>| place(at).into_iter().chain(others).collect();
        let others = |traits: &Traits| {
            let is_plain = *traits == Traits::default();
            (!is_plain).then(|| ("traits", Value::Traits(traits.clone())))
        };
        match self {
            Item::Wall { from, to, thickness } => (
                "wall",
                vec![("from", Place(*from)), ("to", Place(*to)), ("thickness", Number(*thickness))],
            ),
            Item::Box { pose: Pose { x, y, heading }, width, depth, traits } => {
                let sides = [("w", *width), ("d", *depth), ("h", *heading)];
                let sides = sides.map(|(name, number)| (name, Number(number)));
                ("box", with([*x, *y], sides.into_iter().chain(others(traits)).collect()))
            }
            Item::Circle { center, radius, traits } => {
                let radius = [("r", Number(*radius))].into_iter();
                ("circle", with(*center, radius.chain(others(traits)).collect()))
            }
            Item::Patch { corners, color } => {
                ("patch", vec![("color", Color(*color)), ("points", Places(corners.clone()))])
            }
            Item::Line { points, width, color } => (
                "line",
                vec![
                    ("color", Color(*color)),
                    ("width", Number(*width)),
                    ("points", Places(points.clone())),
                ],
            ),
            Item::Lamp { at, intensity } => {
                ("lamp", with(*at, vec![("intensity", Number(*intensity))]))
            }
            Item::Bulb { at, intensity, port } => {
                ("lamp", with(*at, vec![("intensity", Number(*intensity)), ("port", Port(*port))]))
            }
            Item::Beacon { at, channel } => {
                ("beacon", with(*at, vec![("channel", Channel(*channel))]))
            }
        }
    }

    /// What it looks like from above.
    pub fn shape(&self) -> Shape<'_> {
        match *self {
            Item::Wall { from, to, thickness } => Shape::Bar { from, to, thickness },
            Item::Box { pose, width, depth, .. } => Shape::Box { pose, width, depth },
            Item::Circle { center, radius, .. } => Shape::Disc { center, radius },
            Item::Patch { ref corners, color } => Shape::Area { corners, color },
            Item::Line { ref points, width, color } => Shape::Band { points, width, color },
            Item::Lamp { at, .. } | Item::Bulb { at, .. } => {
                let class = "lamp".to_owned();
                Shape::Mark { at, class, radius: 3.0, fill: "#fd0", stroke: "#a80" }
            }
            Item::Beacon { at, channel } => {
                let class = format!("beacon channel{channel}");
                Shape::Mark { at, class, radius: 2.0, fill: "#c3c", stroke: "#606" }
            }
        }
    }

    /// A wall of the usual thickness, 1 cm.
    pub const fn wall(from: Point, to: Point) -> Item {
        Item::Wall { from, to, thickness: 1.0 }
    }

    /// A box that does not move.
    pub fn boxed(pose: Pose, width: f64, depth: f64) -> Item {
        Item::Box { pose, width, depth, traits: Traits::default() }
    }

    /// A pillar that does not move.
    pub fn circle(center: Point, radius: f64) -> Item {
        Item::Circle { center, radius, traits: Traits::default() }
    }

    /// The properties of a box or circle.
    pub fn traits(&self) -> Option<&Traits> {
        match self {
            Item::Box { traits, .. } | Item::Circle { traits, .. } => Some(traits),
            _ => None,
        }
    }

    /// The pose and outline of a thing that robots push, and its properties.
    pub(crate) fn movable(&self) -> Option<(Pose, Hull, &Traits)> {
        let (pose, hull) = match *self {
            Item::Box { pose, width, depth, .. } => {
                (pose, Hull::Rectangle { width, length: depth, offset: 0.0 })
            }
            Item::Circle { center: [x, y], radius, .. } => {
                (Pose::new(x, y, 0.0), Hull::Circle { radius })
            }
            _ => return None,
        };
        let traits = self.traits().filter(|traits| traits.mass.is_some())?;
        Some((pose, hull, traits))
    }

    /// A colored rectangle on the floor from one corner to the opposite one.
    pub fn rectangle([x1, y1]: Point, [x2, y2]: Point, color: Color) -> Item {
        Item::Patch { corners: vec![[x1, y1], [x2, y1], [x2, y2], [x1, y2]], color }
    }

    /// The same at another place, with a heading if one is given and it has one; `None` for what
    /// has several places.
    pub(crate) fn at(&self, [x, y]: Point, heading: Option<f64>) -> Option<Item> {
        let mut item = self.clone();
        match &mut item {
            Item::Box { pose, .. } => {
                *pose = Pose::new(x, y, heading.unwrap_or(pose.heading));
            }
            Item::Circle { center, .. } => *center = [x, y],
            Item::Lamp { at, .. } | Item::Bulb { at, .. } | Item::Beacon { at, .. } => *at = [x, y],
            Item::Wall { .. } | Item::Patch { .. } | Item::Line { .. } => return None,
        }
        Some(item)
    }

    /// Checks the numbers. Errors: names the item and what is impossible about it.
    pub fn validate(&self) -> Result<(), SpecError> {
        let fault = match self {
            Item::Wall { from, to, thickness } => first_fault([
                (in_range(&[*from, *to]), OUT_OF_RANGE),
                (positive(libm::hypot(to[0] - from[0], to[1] - from[1])), "has no length"),
                (positive(*thickness), "needs a thickness above 0"),
            ]),
            Item::Box { pose, width, depth, traits } => first_fault([
                (pose.is_in_range(), OUT_OF_RANGE),
                (positive(*width) && positive(*depth), "needs a width and a depth above 0"),
            ])
            .or_else(|| traits.fault(false, width.min(*depth))),
            Item::Circle { center, radius, traits } => first_fault([
                (in_range(&[*center]), OUT_OF_RANGE),
                (positive(*radius), "needs a radius above 0"),
            ])
            .or_else(|| traits.fault(true, 2.0 * radius)),
            Item::Patch { corners, .. } => first_fault([
                (in_range(corners), OUT_OF_RANGE),
                (corners.len() >= 3, "needs at least three corners"),
            ]),
            Item::Line { points, width, .. } => first_fault([
                (in_range(points), OUT_OF_RANGE),
                (positive(*width) && points.len() >= 2, "needs two points and a width above 0"),
            ]),
            Item::Lamp { at, intensity } => first_fault([
                (in_range(&[*at]), OUT_OF_RANGE),
                (intensity.is_finite() && *intensity >= 0.0, "needs an intensity of 0 or more"),
            ]),
            Item::Bulb { at, intensity, port } => first_fault([
                (in_range(&[*at]), OUT_OF_RANGE),
                (intensity.is_finite() && *intensity >= 0.0, "needs an intensity of 0 or more"),
                (port.is_output(), "needs an output port"),
            ]),
            Item::Beacon { at, channel } => first_fault([
                (in_range(&[*at]), OUT_OF_RANGE),
                ((1..=4).contains(channel), "needs a channel from 1 to 4"),
            ]),
        };
        match fault {
            Some(reason) => Err(SpecError::new(self.to_string(), reason)),
            None => Ok(()),
        }
    }

    /// The fact, where each argument is written in a way.
    fn written(&self, way: impl Fn(&Value) -> String) -> String {
        let (name, members) = self.members();
        let arguments: Vec<_> = members.iter().map(|(_, value)| way(value)).collect();
        format!("{name}({})", arguments.join(", "))
    }

    /// The fact that can be read back.
    pub(crate) fn fact(&self) -> String {
        self.written(Value::saved)
    }
}

/// As the fact that describes it in a world file; of long lists of points only the first.
impl fmt::Display for Item {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.written(Value::to_string))
    }
}

fn first_fault<const N: usize>(checks: [(bool, &'static str); N]) -> Option<&'static str> {
    checks.into_iter().find(|(fine, _)| !fine).map(|(_, reason)| reason)
}

fn in_range(points: &[Point]) -> bool {
    points.iter().flatten().copied().all(is_in_range)
}

fn positive(number: f64) -> bool {
    is_in_range(number) && number > 0.0
}

/// A part of a world or a robot, as its file's facts name them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// An item, by its place in [`WorldSpec::items`](crate::WorldSpec::items).
    Item(usize),
    /// The bounds.
    Bounds,
    /// The light from everywhere.
    Ambient,
    /// The temperature.
    Temperature,
    /// The loudness.
    Loudness,
    /// Where the robot starts.
    Start,
    /// A row of a drawn world, counted from 0.
    MapRow(usize),
    /// The left wheel.
    LeftWheel,
    /// The right wheel.
    RightWheel,
    /// The axle.
    Axle,
    /// The outline.
    Hull,
    /// The mass.
    Mass,
    /// A motor, by its place in [`RobotSpec::motors`](crate::RobotSpec::motors).
    Motor(usize),
    /// The errors of the encoder of the motor at a port.
    EncoderNoise(Port),
    /// The errors of the device at a port.
    Noise(Port),
    /// What its ultrasonic sensor hears.
    Echo(Port),
    /// The gripper of the motor at a port.
    Gripper(Port),
    /// A sensor, by its place in [`RobotSpec::sensors`](crate::RobotSpec::sensors).
    Sensor(usize),
}

/// Something impossible in a world or a robot.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{item} {reason}")]
pub struct SpecError {
    /// The offending item, as a message names it.
    pub item: String,
    /// What is wrong with it.
    pub reason: String,
    /// The parts that may be to blame, the likeliest first.
    pub parts: Vec<Part>,
}

impl SpecError {
    pub(crate) fn new(item: impl Into<String>, reason: impl Into<String>) -> Self {
        SpecError { item: item.into(), reason: reason.into(), parts: Vec::new() }
    }

    /// The same error, with one more part that may be to blame.
    pub(crate) fn in_part(mut self, part: Part) -> Self {
        self.parts.push(part);
        self
    }
}
