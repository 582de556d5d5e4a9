//! The state for pages: each struct is an object of docs/view-protocol.md. `simulated.rs` fills
//! them from the simulator, `brick.rs` from the driver, and only here they are written as JSON.
use crate::glue::state::watched;
use ev3_json::Json;
use ev3_sim::facts::Value;
use std::borrow::Cow;
use std::time::Duration;

/// A value that is written as JSON.
pub(super) trait Report {
    fn report(&self, json: &mut Json);

    /// Then it is not a member of an object.
    fn is_absent(&self) -> bool {
        false
    }
}

/// A value as JSON.
pub(super) fn text(value: &dyn Report) -> String {
    let mut json = Json::new();
    value.report(&mut json);
    json.into_text()
}

/// A number with at most `PLACES` decimals; what is not a number is `null`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Decimal<const PLACES: u32>(pub(super) f64);

/// A length, or an angle.
pub(super) type Fine = Decimal<2>;
pub(super) type Point = [Fine; 2];
pub(super) type Text = Cow<'static, str>;

pub(super) fn fine<const N: usize>(numbers: [f64; N]) -> [Fine; N] {
    numbers.map(Decimal)
}

pub(super) fn points(points: &[[f64; 2]]) -> Vec<Point> {
    points.iter().copied().map(fine).collect()
}

/// `null` if there is none, whereas a member that is an `Option` is absent then.
#[derive(Default)]
pub(super) struct OrNull<T>(pub(super) Option<T>);

/// A text that is reported as the list of its words.
pub(super) struct Words(pub(super) String);

/// Bytes in base 64.
pub(super) struct Base64(pub(super) Vec<u8>);

/// Implements [`Report`] for some types.
macro_rules! report {
    ($([$($of:tt)*] $type:ty: |$value:ident, $json:ident| $report:expr;)*) => {$(
        impl<$($of)*> Report for $type {
            fn report(&self, $json: &mut Json) {
                let $value = self;
                $report;
            }
        }
    )*};
}

report! {
    [const PLACES: u32] Decimal<PLACES>: |number, json| json.number(number.0, PLACES);
    [] u64: |number, json| json.integer(i64::try_from(*number).unwrap_or(i64::MAX));
    [] bool: |value, json| json.bool(*value);
    [] &'static str: |text, json| json.text(text);
    [] Text: |text, json| json.text(text);
    [] Words: |words, json| {
        json.array(|json| words.0.split_whitespace().for_each(|word| json.text(word)));
    };
    [] Base64: |bytes, json| json.base64(&bytes.0);
    [T: Report, const N: usize] [T; N]: |all, json| {
        json.array(|json| all.iter().for_each(|part| part.report(json)));
    };
    [T: Report] Vec<T>: |all, json| json.array(|json| all.iter().for_each(|part| part.report(json)));
    [T: Report] OrNull<T>: |value, json| match &value.0 {
        Some(value) => value.report(json),
        None => json.null(),
    };
}

impl<T: Report> Report for Option<T> {
    fn report(&self, json: &mut Json) {
        if let Some(value) = self {
            value.report(json);
        }
    }

    fn is_absent(&self) -> bool {
        self.is_none()
    }
}

/// A member of an object.
fn member(json: &mut Json, name: &str, value: &dyn Report) {
    if !value.is_absent() {
        value.report(json.key(name.trim_start_matches("r#")));
    }
}

/// Structs that are objects of JSON, with their fields as members.
macro_rules! objects {
    ($($(#[$meta:meta])* $name:ident { $($field:ident: $type:ty,)* })*) => {$(
        $(#[$meta])*
        #[derive(Default)]
        pub(super) struct $name {
            $(pub(super) $field: $type,)*
        }

        impl $name {
            /// Its members, within an object.
            pub(super) fn members(&self, json: &mut Json) {
                $(member(json, stringify!($field), &self.$field);)*
            }
        }

        impl Report for $name {
            fn report(&self, json: &mut Json) {
                json.object(|json| self.members(json));
            }
        }
    )*};
}

objects! {
    Clock {
        time: Decimal<3>,
        kind: &'static str,
        pace: Option<Text>,
        paused: Option<bool>,
        stands: Option<bool>,
    }

    /// The robot in the world.
    Surroundings {
        robot: Robot,
        see: Vec<Sight>,
        beams: Vec<Beam>,
        others: Option<Vec<Item>>,
        things: Option<Vec<Placed>>,
    }

    /// A thing that moves.
    Placed {
        id: u64,
        pose: [Fine; 3],
        held: Option<bool>,
    }

    /// The brick and what is plugged in.
    Devices {
        ports: Vec<Port>,
        brick: Brick,
    }

    Robot {
        r#true: OrNull<[Fine; 3]>,
        believed: OrNull<Believed>,
        hits: Option<u64>,
        moving: Option<bool>,
    }

    Believed {
        pose: [Fine; 3],
        odometry: [Fine; 3],
        ellipse: [Fine; 3],
    }

    /// What a localizer believes.
    Localized {
        particles: Vec<[Fine; 3]>,
        clusters: Vec<Cluster>,
        confidence: Fine,
    }

    Cluster {
        weight: Fine,
        pose: [Fine; 3],
        ellipse: [Fine; 3],
    }

    /// Cells by column and row, each with a probability.
    Raster {
        cell: Fine,
        origin: Point,
        h: Fine,
        cells: Vec<[Fine; 3]>,
    }

    /// What a sensor sees: a cone, a spot, a bumper or a beacon.
    Sight {
        port: &'static str,
        kind: &'static str,
        x: Option<Fine>,
        y: Option<Fine>,
        h: Option<Fine>,
        fan: Option<Vec<Point>>,
        hit: Option<OrNull<Point>>,
        color: Option<Text>,
        from: Option<Point>,
        to: Option<Point>,
        on: Option<bool>,
        channel: Option<u64>,
        at: Option<OrNull<Point>>,
    }

    /// A lamp that a port lights.
    Beam {
        id: u64,
        power: Fine,
    }

    /// A port with its device.
    #[expect(clippy::struct_field_names, reason = "the page's names")]
    Port {
        port: &'static str,
        kind: &'static str,
        driver: Option<Text>,
        name: Option<Text>,
        read: Option<bool>,
        position: Option<Fine>,
        speed: Option<Fine>,
        duty: Option<Fine>,
        opening: Option<Fine>,
        state: Option<Words>,
        stop: Option<Text>,
        held: Option<bool>,
        max: Option<Fine>,
        unit: Option<&'static str>,
        mode: Option<Text>,
        values: Option<Vec<Decimal<6>>>,
        units: Option<Text>,
        label: Option<&'static str>,
    }

    Brick {
        lights: Lights,
        keys: Vec<&'static str>,
        volts: Option<Fine>,
        amps: Option<Fine>,
        tone: u64,
    }

    /// Red and green of each side.
    Lights {
        left: [u64; 2],
        right: [u64; 2],
    }

    /// A table of what there was at some moments.
    Samples {
        columns: Vec<Text>,
        units: Vec<&'static str>,
        rows: Vec<Vec<Decimal<3>>>,
    }

    /// A line of the log. The log gives it its number.
    Entry {
        n: u64,
        time: Decimal<3>,
        until: Option<Decimal<3>>,
        times: Option<u64>,
        kind: Text,
        text: Text,
        causes: Option<Vec<Text>>,
        about: Option<Vec<Text>>,
        thread: Option<Text>,
    }

    /// The parts of the robot.
    Spec {
        hull: Hull,
        left: Option<Wheel>,
        right: Option<Wheel>,
        axle: Option<Fine>,
        sensors: Vec<Sensor>,
        grippers: Option<Vec<Jaws>>,
    }

    /// The middle between the jaws that a motor moves.
    Jaws {
        port: &'static str,
        x: Fine,
        y: Fine,
    }

    /// A circle or a rectangle.
    Hull {
        kind: &'static str,
        r: Option<Fine>,
        w: Option<Fine>,
        l: Option<Fine>,
        offset: Option<Fine>,
    }

    Wheel {
        port: &'static str,
        d: Fine,
    }

    Sensor {
        port: &'static str,
        driver: Text,
        x: Fine,
        y: Fine,
        h: Fine,
    }

    /// What can be plugged in.
    Plugs {
        out: Vec<&'static str>,
        r#in: Vec<&'static str>,
    }

    World {
        bounds: OrNull<[Fine; 4]>,
        view: [Decimal<1>; 4],
        floor: Text,
        ambient: Fine,
        temperature: Fine,
        loudness: Fine,
        start: [Fine; 3],
        items: Vec<Item>,
    }

    /// Its pixels line by line: one bit each, where 1 is black, a shade of gray, or a color.
    Screen {
        w: u64,
        h: u64,
        bits: Option<Base64>,
        gray: Option<Base64>,
        rgb: Option<Base64>,
    }
}

/// A thing in the world: the arguments of its fact under the names that pages have for them.
pub(super) struct Item {
    pub(super) id: u64,
    pub(super) kind: &'static str,
    pub(super) members: Vec<(&'static str, Value)>,
    pub(super) name: Option<Text>,
}

impl Report for Item {
    fn report(&self, json: &mut Json) {
        json.object(|json| {
            member(json, "id", &self.id);
            member(json, "kind", &self.kind);
            self.members.iter().for_each(|(name, value)| member(json, name, value));
            member(json, "name", &self.name);
        });
    }
}

impl Report for Value {
    fn report(&self, json: &mut Json) {
        match self {
            Value::Number(number) => json.number(*number, 2),
            Value::Channel(channel) => json.integer((*channel).into()),
            Value::Place(place) => fine(*place).report(json),
            Value::Places(places) => points(places).report(json),
            Value::Traits(traits) => json.object(|json| {
                let number = |number: Option<f64>| number.map(Decimal::<6>);
                member(json, "mass", &number(traits.mass));
                member(json, "friction", &number(traits.friction));
                member(json, "height", &number(traits.height));
                member(json, "rolls", &traits.rolls.then_some(true));
                member(json, "bounces", &number(traits.bounces));
                member(json, "color", &traits.color.map(|color| Text::from(color.to_string())));
                member(json, "name", &traits.name.clone().map(Text::from));
            }),
            other => json.text(&other.to_string()),
        }
    }
}

/// What people call the devices of the sets.
const NAMES: [(&str, &str); 14] = [
    ("lego-ev3-l-motor", "large motor"),
    ("lego-ev3-m-motor", "medium motor"),
    ("lego-nxt-motor", "NXT motor"),
    ("act-l12-ev3-50", "linear actuator"),
    ("act-l12-ev3-100", "linear actuator"),
    ("lego-ev3-us", "ultrasonic sensor"),
    ("lego-ev3-color", "color sensor"),
    ("lego-ev3-gyro", "gyro"),
    ("lego-ev3-ir", "infrared sensor"),
    ("lego-ev3-touch", "touch sensor"),
    ("lego-nxt-us", "NXT ultrasonic sensor"),
    ("lego-nxt-touch", "NXT touch sensor"),
    ("lego-nxt-light", "NXT light sensor"),
    ("lego-nxt-sound", "NXT sound sensor"),
];

impl Port {
    /// A device of a kind, with the name that people have for it, else its driver's; and
    /// whether the program has read it.
    pub(super) fn have(&mut self, kind: &'static str, driver: Text) {
        let known = NAMES.iter().find(|(known, _)| *known == driver);
        self.name = Some(known.map_or_else(|| driver.clone(), |(_, name)| (*name).into()));
        self.read = watched().is_read(self.port).then_some(true);
        (self.kind, self.driver) = (kind, Some(driver));
    }
}

/// The ports, as they stand on the brick.
pub(super) const PORTS: [&str; 8] = ["outA", "outB", "outC", "outD", "in1", "in2", "in3", "in4"];

/// What there was at a moment: the poses that a table names, and the values of each port.
pub(super) struct Row<'a> {
    pub(super) time: Duration,
    pub(super) poses: Vec<Option<[f64; 3]>>,
    pub(super) values: Vec<&'a [f64]>,
}

impl Samples {
    /// A table with poses whose parts have these names. A port has as many columns as values in
    /// some row.
    pub(super) fn of(
        rows: &[Row],
        names: &[[Text; 3]],
        unit: &dyn Fn(usize, usize) -> &'static str,
    ) -> Self {
        let mut columns = vec![Text::Borrowed("time")];
        let mut units = vec!["s"];
        for names in names {
            columns.extend_from_slice(names);
            units.extend(["cm", "cm", "deg"]);
        }
        let mut of_ports = Vec::new();
        for (port, name) in PORTS.into_iter().enumerate() {
            let count = rows.iter().map(|row| row.values[port].len()).max();
            for index in 0..count.unwrap_or(0) {
                of_ports.push((port, index));
                columns.push(match name.strip_prefix("out") {
                    Some(_) => {
                        format!("{name}.{}", ["position", "speed", "duty", "opening"][index]).into()
                    }
                    None => format!("{name}.value{index}").into(),
                });
                units.push(unit(port, index));
            }
        }
        let row = |row: &Row| {
            let mut cells = vec![Decimal(row.time.as_secs_f64())];
            for (pose, _) in row.poses.iter().zip(names) {
                let hundredths = |part: f64| Decimal((part * 100.0).round() / 100.0);
                cells.extend(pose.unwrap_or([f64::NAN; 3]).map(hundredths));
            }
            for (port, index) in &of_ports {
                cells.push(Decimal(row.values[*port].get(*index).copied().unwrap_or(f64::NAN)));
            }
            cells
        };
        Self { rows: rows.iter().map(row).collect(), columns, units }
    }

    /// The same as a table for a spreadsheet, without units.
    #[cfg(unix)]
    pub(super) fn csv(&self) -> String {
        let mut lines = vec![self.columns.join(",")];
        for row in &self.rows {
            let cells = row.iter().map(|cell| text(cell).replace("null", ""));
            lines.push(cells.collect::<Vec<_>>().join(","));
        }
        lines.push(String::new());
        lines.join("\n")
    }
}

impl Screen {
    /// A screen of shades of gray.
    pub(super) fn of_shades(shades: Vec<u8>) -> Self {
        if !shades.iter().all(|shade| [0, 255].contains(shade)) {
            return Self { gray: Some(Base64(shades)), ..Self::sized() };
        }
        let byte = |eight: &[u8]| {
            let bit = |(index, shade): (usize, &u8)| u8::from(*shade == 0) << (7 - index);
            eight.iter().enumerate().map(bit).fold(0, |byte, bit| byte | bit)
        };
        Self { bits: Some(Base64(shades.chunks(8).map(byte).collect())), ..Self::sized() }
    }

    /// A screen of colors: red, green and blue of each pixel.
    pub(super) fn of_colors(pixels: &[[u8; 3]]) -> Self {
        if pixels.iter().all(|[red, green, blue]| red == green && green == blue) {
            Self::of_shades(pixels.iter().map(|pixel| pixel[0]).collect())
        } else {
            Self { rgb: Some(Base64(pixels.as_flattened().to_vec())), ..Self::sized() }
        }
    }

    fn sized() -> Self {
        Self { w: 178, h: 128, ..Self::default() }
    }
}
