//! The measurement that a sensor would give at each place of a map.
use crate::model::FAR;
use ev3_motion::{Point, Pose};
use ev3_roadmap::{Bounds, Map, Obstacle};

/// Side of a cell of the free area, in cm.
const CELL: f64 = 5.0;
/// Steps of the table, in cm and degrees.
const STEP: f64 = 5.0;
const TURN: f64 = 5.0;
const TURNS: u16 = 72;
/// What is heard by the table may be off by so much, as a standard deviation in cm: two thirds of
/// 20 000 poses in a room of 3 m with three boxes are within it.
pub(crate) const COARSENESS: f64 = 2.1;
/// A larger table is not made, in bytes.
const LARGEST_TABLE: usize = 8 << 20;
/// The narrowest cone, in degrees.
const NARROWEST: f64 = 0.5;
/// The most cells of the free area.
const MOST_CELLS: f64 = 4e6;

/// What is impossible about a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Unfit {
    /// An endless map without anything has no place that is more probable than another.
    #[error("needs bounds, or obstacles")]
    Endless,
    /// Beyond what fits into memory.
    #[error("must not be larger than 10000 square meters")]
    TooLarge,
    /// Nowhere is the robot's hull free.
    #[error("has no place that is wide enough for the robot")]
    Full,
}

/// An edge of an obstacle.
#[derive(Clone, Copy, Debug)]
struct Edge {
    from: Point,
    along: Point,
    /// 1 / its length squared.
    per_square: f64,
}

/// A map, prepared for many questions about what is heard where.
#[derive(Clone, Debug)]
pub struct Field {
    bounds: Bounds,
    edges: Vec<Edge>,
    circles: Vec<(Point, f64)>,
    /// In degrees.
    half_angle: f64,
    columns: usize,
    rows: usize,
    /// Where the middle of the robot may be, by rows from below.
    free: Vec<bool>,
    free_cells: usize,
    table: Option<Vec<u8>>,
}

impl Field {
    /// A map for a robot with a round hull, in cm, and a sensor whose cone goes `half_angle`
    /// degrees to each side.
    ///
    /// A map without bounds ends where its obstacles end.
    /// Errors: if there is nothing on the map, or no room.
    pub fn new(map: &Map, hull: f64, half_angle: f64) -> Result<Field, Unfit> {
        let bounds = map.bounds().copied().or_else(|| around(map)).ok_or(Unfit::Endless)?;
        let Bounds { low, high } = bounds;
        let [width, height] = [high[0] - low[0], high[1] - low[1]];
        if width * height > MOST_CELLS * CELL * CELL {
            return Err(Unfit::TooLarge);
        }
        let (columns, rows) = (cells(width), cells(height));
        let mut edges = Vec::new();
        let mut circles = Vec::new();
        if map.bounds().is_some() {
            add_edges(&mut edges, &[low, [high[0], low[1]], high, [low[0], high[1]]]);
        }
        for obstacle in map.obstacles() {
            match (obstacle.corners(), obstacle.round()) {
                (Some(corners), _) => add_edges(&mut edges, corners),
                (None, Some(circle)) => circles.push(circle),
                (None, None) => {}
            }
        }
        let middle = |index: usize, low: f64| low + (float(index) + 0.5) * CELL;
        let is_free = |cell: usize| {
            let at = [middle(cell % columns, low[0]), middle(cell / columns, low[1])];
            map.clearance(at) >= hull - CELL / 4.0
        };
        let free: Vec<bool> = (0..columns * rows).map(is_free).collect();
        let free_cells = free.iter().filter(|free| **free).count();
        if free_cells == 0 {
            return Err(Unfit::Full);
        }
        let half_angle = half_angle.max(NARROWEST);
        Ok(Field {
            bounds,
            edges,
            circles,
            half_angle,
            columns,
            rows,
            free,
            free_cells,
            table: None,
        })
    }

    /// The same with a table of what is heard where: for processors that calculate slowly. It has
    /// steps of 5 cm and 5 degrees. A map that is very large gets none.
    pub fn with_table(mut self) -> Field {
        let size = self.columns * self.rows * usize::from(TURNS);
        if size > LARGEST_TABLE {
            return self;
        }
        let mut table = Vec::with_capacity(size);
        for row in 0..self.rows {
            for column in 0..self.columns {
                for turn in 0..TURNS {
                    let [x, y] = self.bounds.low;
                    let x = x + (float(column) + 0.5) * STEP;
                    let y = y + (float(row) + 0.5) * STEP;
                    let pose = Pose { x, y, heading: f64::from(turn) * TURN };
                    table.push(self.exact(pose).map_or(u8::MAX, byte));
                }
            }
        }
        self.table = Some(table);
        self
    }

    /// Whether it has a table.
    pub fn has_table(&self) -> bool {
        self.table.is_some()
    }

    /// The distance of the nearest thing in the cone of a sensor, in cm; `None` if it is farther
    /// than the sensor hears.
    pub fn heard(&self, sensor: Pose) -> Option<f64> {
        match &self.table {
            Some(table) => self.looked_up(table, sensor),
            None => self.exact(sensor),
        }
    }

    fn looked_up(&self, table: &[u8], sensor: Pose) -> Option<f64> {
        let cell = self.cell(sensor.point())?;
        #[expect(clippy::cast_possible_truncation, reason = "headings are small")]
        let turn = (sensor.heading * (1.0 / TURN) + 0.5).floor() as i64;
        let turn = usize::try_from(turn.rem_euclid(i64::from(TURNS))).unwrap_or(0);
        let distance = table[cell * usize::from(TURNS) + turn];
        (distance < u8::MAX).then(|| f64::from(distance))
    }

    fn exact(&self, sensor: Pose) -> Option<f64> {
        let at = sensor.point();
        let edge = |turn: f64| {
            let (sin, cos) = libm::sincos((sensor.heading + turn).to_radians());
            [sin, cos]
        };
        let (left, right) = (edge(-self.half_angle), edge(self.half_angle));
        let mut nearest = FAR * FAR;
        for line in &self.edges {
            if let Some(square) = line.within(at, left, right) {
                nearest = nearest.min(square);
            }
        }
        let mut nearest = nearest.sqrt();
        for (center, radius) in &self.circles {
            let away = [center[0] - at[0], center[1] - at[1]];
            if let Some(distance) = round_within(away, *radius, left, right) {
                nearest = nearest.min(distance);
            }
        }
        (nearest < FAR).then_some(nearest)
    }

    /// Whether the middle of the robot may be there.
    pub fn is_free(&self, at: Point) -> bool {
        self.cell(at).is_some_and(|cell| self.free[cell])
    }

    fn cell(&self, at: Point) -> Option<usize> {
        let index = |axis: usize, count: usize| {
            let steps = (at[axis] - self.bounds.low[axis]) * (1.0 / CELL);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "saturates, and the sign is known"
            )]
            let steps = (steps >= 0.0).then_some(steps as usize);
            steps.filter(|steps| *steps < count)
        };
        Some(index(1, self.rows)? * self.columns + index(0, self.columns)?)
    }

    /// The rectangle around it.
    pub fn bounds(&self) -> Bounds {
        self.bounds
    }

    /// Where the middle of the robot may be, in square meters.
    pub fn free_area(&self) -> f64 {
        float(self.free_cells) * CELL * CELL / 1e4
    }
}

impl Edge {
    /// The square of its distance from a place, within a cone between two directions.
    fn within(&self, at: Point, left: Point, right: Point) -> Option<f64> {
        let from = [self.from[0] - at[0], self.from[1] - at[1]];
        let mut range = [0.0, 1.0];
        let sides = [
            (cross(right, from), cross(right, self.along)),
            (-cross(left, from), -cross(left, self.along)),
        ];
        for (inside, change) in sides {
            if inside < 0.0 && inside + change < 0.0 {
                return None;
            }
            if inside < 0.0 {
                range[0] = f64::max(range[0], -inside / change);
            } else if inside + change < 0.0 {
                range[1] = f64::min(range[1], -inside / change);
            }
        }
        if range[0] > range[1] {
            return None;
        }
        let foot = -dot(from, self.along) * self.per_square;
        let part = foot.clamp(range[0], range[1]);
        let nearest = [from[0] + part * self.along[0], from[1] + part * self.along[1]];
        Some(dot(nearest, nearest))
    }
}

/// How far a disc is, within a cone between two directions of length 1.
fn round_within(away: Point, radius: f64, left: Point, right: Point) -> Option<f64> {
    let beyond = [-cross(right, away), cross(left, away)];
    let square = dot(away, away);
    let edge = match beyond {
        [aside, other] if aside <= 0.0 && other <= 0.0 => {
            return Some((square.sqrt() - radius).max(0.0));
        }
        [aside, other] if aside > other => right,
        _ => left,
    };
    // The border of the cone that is nearer to it.
    let along = dot(edge, away);
    let inside = along * along - square + radius * radius;
    (along > 0.0 && inside >= 0.0).then(|| (along - inside.sqrt()).max(0.0))
}

/// The rectangle around all obstacles.
fn around(map: &Map) -> Option<Bounds> {
    let extent = |obstacle: &Obstacle| match (obstacle.corners(), obstacle.round()) {
        (Some(corners), _) => corners.to_vec(),
        (None, Some(([x, y], radius))) => vec![[x - radius, y - radius], [x + radius, y + radius]],
        (None, None) => Vec::new(),
    };
    let points = map.obstacles().iter().flat_map(extent);
    points.fold(None, |bounds, [x, y]| {
        let Bounds { low, high } = bounds.unwrap_or(Bounds { low: [x, y], high: [x, y] });
        let (low, high) = ([low[0].min(x), low[1].min(y)], [high[0].max(x), high[1].max(y)]);
        Some(Bounds { low, high })
    })
}

fn add_edges(edges: &mut Vec<Edge>, corners: &[Point]) {
    let next = corners.iter().cycle().skip(1);
    edges.extend(corners.iter().zip(next).map(|(from, to)| {
        let along = [to[0] - from[0], to[1] - from[1]];
        Edge { from: *from, along, per_square: 1.0 / dot(along, along) }
    }));
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[expect(clippy::cast_precision_loss, reason = "far below 2^53")]
pub(crate) fn float(count: usize) -> f64 {
    count as f64
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be small")]
fn cells(length: f64) -> usize {
    libm::ceil(length / CELL - 1e-9).max(1.0) as usize
}

#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
fn byte(distance: f64) -> u8 {
    libm::round(distance).min(254.0) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use ev3_roadmap::Obstacle;
    use proptest::prelude::*;

    fn room(obstacles: Vec<Obstacle>) -> Field {
        let bounds = Bounds { low: [0.0, 0.0], high: [300.0, 250.0] };
        Field::new(&Map::new(obstacles, Some(bounds)).unwrap(), 8.0, 15.0).unwrap()
    }

    fn at(x: f64, y: f64, heading: f64) -> Pose {
        Pose { x, y, heading }
    }

    #[test]
    fn the_nearest_thing_in_the_cone_is_heard() {
        let thing = Obstacle::circle([100.0, 150.0], 10.0).unwrap();
        let field = room(vec![thing]);
        let heard = |pose: Pose| field.heard(pose).unwrap();
        assert!((heard(at(100.0, 100.0, 0.0)) - 40.0).abs() < 1e-9, "straight ahead");
        assert!((heard(at(100.0, 100.0, 12.0)) - 40.0).abs() < 1e-9, "within the cone");
        let edge = heard(at(100.0, 100.0, 24.0));
        assert!(edge > 40.0 && edge < 50.0, "its border meets it: {edge}");
        assert!(heard(at(100.0, 100.0, 40.0)) > 100.0, "beside it is the wall");
        assert!((heard(at(100.0, 100.0, 180.0)) - 100.0).abs() < 1e-9);
    }

    #[test]
    fn a_wide_room_is_silent_and_a_map_ends_with_its_obstacles() {
        let bounds = Bounds { low: [0.0, 0.0], high: [900.0, 900.0] };
        let field = Field::new(&Map::new(Vec::new(), Some(bounds)).unwrap(), 8.0, 15.0).unwrap();
        assert_eq!(field.heard(at(450.0, 450.0, 0.0)), None);
        assert!((field.free_area() - 81.0).abs() < 4.0);
        let boxes = vec![Obstacle::rectangle([0.0, 0.0], 20.0, 20.0, 0.0).unwrap()];
        let map = Map::new(boxes, None).unwrap();
        assert_eq!(Field::new(&map, 8.0, 15.0).unwrap_err(), Unfit::Full);
        assert_eq!(Field::new(&Map::default(), 8.0, 15.0).unwrap_err(), Unfit::Endless);
        let wide = Bounds { low: [0.0, 0.0], high: [1e6, 1e6] };
        let map = Map::new(Vec::new(), Some(wide)).unwrap();
        assert_eq!(Field::new(&map, 8.0, 15.0).unwrap_err(), Unfit::TooLarge);
    }

    #[test]
    fn the_robot_is_where_its_hull_is() {
        let field = room(vec![Obstacle::rectangle([100.0, 100.0], 40.0, 40.0, 0.0).unwrap()]);
        for (place, is_free) in [
            ([100.0, 100.0], false),
            ([123.0, 100.0], false),
            ([133.0, 100.0], true),
            ([3.0, 100.0], false),
            ([13.0, 100.0], true),
            ([-1.0, 100.0], false),
            ([100.0, 251.0], false),
        ] {
            assert_eq!(field.is_free(place), is_free, "{place:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        /// A dense fan of rays finds the same, but for what lies between two of them.
        #[test]
        fn the_cone_is_that_of_many_rays(x in 20.0..280.0, y in 20.0..230.0, h in 0.0..360.0) {
            let field = room(vec![
                Obstacle::rectangle([90.0, 165.0], 40.0, 25.0, 20.0).unwrap(),
                Obstacle::circle([150.0, 125.0], 8.0).unwrap(),
            ]);
            let pose = at(x, y, h);
            prop_assume!(field.is_free(pose.point()));
            let narrow = Field { half_angle: 0.01, ..field.clone() };
            let rays = (0..=1500).map(|ray| f64::from(ray) * 0.02 - 15.0);
            let heard = rays.map(|turn| narrow.heard(at(x, y, h + turn)).unwrap_or(FAR));
            let nearest = heard.fold(FAR, f64::min);
            let exact = field.heard(pose).unwrap_or(FAR);
            prop_assert!((exact - nearest).abs() < 0.5, "{exact} {nearest}");
        }

        #[test]
        fn the_table_is_about_right(x in 20.0..280.0, y in 20.0..230.0, h in -720.0..720.0) {
            let field = room(Vec::new());
            let table = field.clone().with_table();
            let [exact, about] = [&field, &table].map(|f| f.heard(at(x, y, h)).unwrap_or(FAR));
            prop_assert!((exact - about).abs() < 12.0 + 0.15 * exact, "{exact} {about}");
        }
    }
}
