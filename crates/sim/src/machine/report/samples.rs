//! The film of a run, as a table. It is kept only where a machine is told so, as a sample costs as
//! much as some ticks.

use std::time::Duration;

use ev3_json::Json;

use super::seconds;
use crate::brick::port::Port;
use crate::machine::Machine;
use crate::machine::film::{Film, Sample, State, Values};
use crate::machine::tree::Hardware;
use crate::ticks::TICK_US;
use crate::world::geometry::Pose;

const OUTPUTS: [Port; 4] = [Port::OutA, Port::OutB, Port::OutC, Port::OutD];
const INPUTS: [Port; 4] = [Port::In1, Port::In2, Port::In3, Port::In4];

/// A column of the film.
#[derive(Clone, Copy)]
enum Column {
    Motor(usize, usize),
    Sensor(usize, usize),
}

/// What the program believed its pose to be at a moment, in the world.
pub type Belief<'a> = &'a mut dyn FnMut(Duration) -> Option<Pose>;

impl Machine {
    /// Keeps samples from now on, or none.
    pub fn keep_samples(&mut self, keep: bool) {
        if !keep {
            self.film = None;
        } else if self.film.is_none() {
            self.film = Some(Film::new());
            self.take_sample();
        }
    }

    /// A tick has passed.
    pub(crate) fn sample_at_tick(&mut self) {
        if self.film.as_ref().is_some_and(|samples| self.tick % samples.spacing == 0) {
            self.take_sample();
        }
    }

    fn take_sample(&mut self) {
        let state = self.sampled();
        let at = Duration::from_micros(self.tick * TICK_US);
        if let Some(samples) = &mut self.film {
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
        let samples = self.film.as_ref()?;
        let is_new = |sample: &&Sample| after.is_none_or(|after| sample.at > after);
        let mut rows: Vec<_> = samples.kept.newest().take_while(is_new).collect();
        rows.reverse();
        let last = rows.last()?.at;
        let columns = columns(&rows);
        json.key("samples").object(|json| {
            json.key("columns").array(|json| {
                let first = ["time", "x", "y", "heading", "bx", "by", "bh"];
                for name in first {
                    json.text(name);
                }
                for column in &columns {
                    json.text(&column.name());
                }
            });
            json.key("units").array(|json| {
                let first = ["s", "cm", "cm", "deg", "cm", "cm", "deg"];
                for unit in first {
                    json.text(unit);
                }
                for column in &columns {
                    json.text(self.unit(*column));
                }
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
        let rows: Vec<_> = self.film.as_ref()?.kept.iter().collect();
        let columns = columns(&rows);
        let mut lines = vec!["time,x,y,heading".to_owned()];
        lines[0].extend(columns.iter().map(|column| format!(",{}", column.name())));
        for row in rows {
            let mut json = Json::new();
            let Sample { at, state: State { pose, .. } } = row;
            json.number(at.as_secs_f64(), 3);
            for part in [pose.x, pose.y, pose.heading] {
                json.number(part, 2);
            }
            for column in &columns {
                row.report_column(&mut json, *column);
            }
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
        for column in columns {
            self.report_column(json, *column);
        }
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
