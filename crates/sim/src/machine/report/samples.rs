//! A film of the run: where the robot was, and what motors and sensors showed, every 50 ms of
//! simulated time. On long runs the samples are farther apart.
//!
//! A virtual clock jumps, so somebody who only looked now and then would miss what lies between.
//! Samples are kept only where a machine is told so, as a sample costs as much as some ticks.

use std::time::Duration;

use ev3_json::Json;

use super::seconds;
use crate::brick::port::Port;
use crate::log::Log;
use crate::machine::Machine;
use crate::machine::tree::Hardware;
use crate::ticks::TICK_US;
use crate::world::geometry::Pose;

/// How many samples are kept.
const MOST: usize = 2048;
/// At first one is taken every 50 ms.
const FIRST_SPACING_TICKS: u64 = 25;
/// How many values of a sensor are kept.
const VALUES: usize = 4;

const OUTPUTS: [Port; 4] = [Port::OutA, Port::OutB, Port::OutC, Port::OutD];
const INPUTS: [Port; 4] = [Port::In1, Port::In2, Port::In3, Port::In4];

/// The samples so far.
#[derive(Clone, Debug)]
pub(crate) struct Samples {
    kept: Log<Sample>,
    spacing: u64,
}

/// What there was at a moment.
#[derive(Clone, Debug)]
struct Sample {
    at: Duration,
    state: State,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct State {
    pose: Pose,
    /// Position, speed and duty.
    motors: [Option<[i32; 3]>; 4],
    sensors: [Values; 4],
}

/// The first values of a sensor, with their decimals.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Values {
    count: usize,
    values: [f64; VALUES],
}

/// A column of the film.
#[derive(Clone, Copy)]
enum Column {
    Motor(usize, usize),
    Sensor(usize, usize),
}

/// What the program believed its pose to be at a moment, in the world.
pub type Belief<'a> = &'a mut dyn FnMut(Duration) -> Option<Pose>;

impl Samples {
    fn new() -> Self {
        Self { kept: Log::new(MOST), spacing: FIRST_SPACING_TICKS }
    }

    fn take(&mut self, at: Duration, state: State) {
        // Of a time at which nothing changes, the first and the last are enough.
        if self.kept.newest().take(2).filter(|old| old.state == state).count() == 2 {
            self.kept.pop();
        }
        self.kept.push(|_| Sample { at, state });
        if self.kept.len() >= MOST {
            self.kept.thin_out();
            self.spacing *= 2;
        }
    }
}

impl Machine {
    /// Keeps samples from now on, or none.
    pub fn keep_samples(&mut self, keep: bool) {
        if !keep {
            self.samples = None;
        } else if self.samples.is_none() {
            self.samples = Some(Samples::new());
            self.take_sample();
        }
    }

    /// A tick has passed.
    pub(crate) fn sample_at_tick(&mut self) {
        if self.samples.as_ref().is_some_and(|samples| self.tick % samples.spacing == 0) {
            self.take_sample();
        }
    }

    fn take_sample(&mut self) {
        let state = self.sampled();
        let at = Duration::from_micros(self.tick * TICK_US);
        if let Some(samples) = &mut self.samples {
            samples.take(at, state);
        }
    }

    fn sampled(&self) -> State {
        let device = |port: Port| {
            self.sockets[port as usize].device.and_then(|serial| self.tree.hardware(serial))
        };
        let motors = OUTPUTS.map(|port| match device(port) {
            Some(Hardware::Tacho(motor)) => {
                let shown = motor.shown();
                Some([shown.position, shown.speed, shown.duty])
            }
            _ => None,
        });
        let sensors = INPUTS.map(|port| {
            let mut kept = Values::default();
            if let Some(Hardware::Sensor(sensor)) = device(port) {
                for (place, value) in kept.values.iter_mut().zip(self.shown_values(sensor)) {
                    *place = value;
                    kept.count += 1;
                }
            }
            kept
        });
        State { pose: self.body.pose, motors, sensors }
    }

    /// Writes the samples after a moment, oldest first, as an object; returns the time of the
    /// last one. Writes nothing and returns `None` if there are none.
    pub fn report_samples(
        &self,
        json: &mut Json,
        after: Option<Duration>,
        belief: Belief,
    ) -> Option<Duration> {
        let samples = self.samples.as_ref()?;
        let is_new = |sample: &&Sample| after.is_none_or(|after| sample.at > after);
        let mut rows: Vec<_> = samples.kept.newest().take_while(is_new).collect();
        rows.reverse();
        let last = rows.last()?.at;
        let columns = columns(&rows);
        json.key("samples").object(|json| {
            json.key("columns").array(|json| {
                let first = ["time", "x", "y", "heading", "bx", "by", "bh"];
                first.into_iter().for_each(|name| json.text(name));
                columns.iter().for_each(|column| json.text(&column.name()));
            });
            json.key("units").array(|json| {
                let first = ["s", "cm", "cm", "deg", "cm", "cm", "deg"];
                first.into_iter().for_each(|unit| json.text(unit));
                columns.iter().for_each(|column| json.text(self.unit(*column)));
            });
            json.key("rows").array(|json| {
                for row in rows {
                    let believed = belief(row.at);
                    json.array(|json| row.report(json, believed, &columns));
                }
            });
        });
        Some(last)
    }

    /// All samples as a table: a line with the names of the columns, then a line for each moment.
    /// `None` if there are none.
    #[must_use]
    pub fn samples_csv(&self) -> Option<String> {
        let rows: Vec<_> = self.samples.as_ref()?.kept.iter().collect();
        let columns = columns(&rows);
        let mut lines = vec!["time,x,y,heading".to_owned()];
        lines[0].extend(columns.iter().map(|column| format!(",{}", column.name())));
        for row in rows {
            let mut json = Json::new();
            let Sample { at, state: State { pose, .. } } = row;
            json.number(at.as_secs_f64(), 3);
            [pose.x, pose.y, pose.heading].into_iter().for_each(|part| json.number(part, 2));
            columns.iter().for_each(|column| row.report_column(&mut json, *column));
            lines.push(json.into_text().replace("null", ""));
        }
        lines.push(String::new());
        Some(lines.join("\n"))
    }

    fn unit(&self, column: Column) -> &'static str {
        match column {
            Column::Motor(_, which) => ["deg", "deg/s", "%"][which],
            Column::Sensor(slot, _) => {
                let device = self.sockets[INPUTS[slot] as usize].device;
                match device.and_then(|serial| self.tree.hardware(serial)) {
                    Some(Hardware::Sensor(sensor)) => sensor.mode().units,
                    _ => "",
                }
            }
        }
    }
}

/// The columns that one of these rows has something in.
fn columns(rows: &[&Sample]) -> Vec<Column> {
    let mut columns = Vec::new();
    for slot in 0..4 {
        if rows.iter().any(|row| row.state.motors[slot].is_some()) {
            columns.extend((0..3).map(|which| Column::Motor(slot, which)));
        }
    }
    for slot in 0..4 {
        let most = rows.iter().map(|row| row.state.sensors[slot].count).max().unwrap_or(0);
        columns.extend((0..most).map(|index| Column::Sensor(slot, index)));
    }
    columns
}

impl Column {
    fn name(self) -> String {
        match self {
            Column::Motor(slot, which) => {
                format!("{}.{}", OUTPUTS[slot], ["position", "speed", "duty"][which])
            }
            Column::Sensor(slot, index) => format!("{}.value{index}", INPUTS[slot]),
        }
    }
}

impl Sample {
    fn report(&self, json: &mut Json, believed: Option<Pose>, columns: &[Column]) {
        seconds(json, self.at);
        for pose in [Some(self.state.pose), believed] {
            for part in pose.map_or([f64::NAN; 3], |pose| [pose.x, pose.y, pose.heading]) {
                json.number(part, 2);
            }
        }
        columns.iter().for_each(|column| self.report_column(json, *column));
    }

    fn report_column(&self, json: &mut Json, column: Column) {
        match column {
            Column::Motor(slot, which) => match self.state.motors[slot] {
                Some(values) => json.integer(values[which].into()),
                None => json.null(),
            },
            Column::Sensor(slot, index) => {
                let values = &self.state.sensors[slot];
                let is_there = index < values.count;
                json.number(if is_there { values.values[index] } else { f64::NAN }, 3);
            }
        }
    }
}
