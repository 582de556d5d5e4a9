//! A first map, from what an ultrasonic sensor hears where odometry says that it is.
//!
//! An echo comes from somewhere on an arc. Each echo is one thing, which is shared among the
//! cells of its arc in proportion to how probable it is that something stands there; that
//! depends on the shares, so it is done several times (expectation maximization). Where a cone
//! was free, that counts against a thing. Source: Thrun: Learning occupancy grid maps with
//! forward sensor models (2003).
use crate::field::float;
use crate::model::FAR;
use ev3_motion::{Point, Pose, distance, wrapped};
use std::collections::VecDeque;

/// Side of a cell, in cm.
const CELL: f64 = 5.0;
/// Half of the cone that an echo may come from, and of that which is surely free, in degrees.
const ECHO: f64 = 15.0;
const FREE: f64 = 12.0;
/// The distance before an echo at which the cone may no longer be free, in cm.
const BEFORE: f64 = 3.0;
/// Echoes from farther are too vague, in cm.
const VAGUE: f64 = 150.0;
/// A look counts after a way in cm or a turn in degrees.
const APART: [f64; 2] = [2.0, 2.0];
/// Looks that are kept.
const MOST_LOOKS: usize = 20_000;
const ROUNDS: usize = 10;
/// The odds of something where nothing was heard, and what each free look takes off.
const PRIOR: f64 = 0.02;
const AGAINST: f64 = 0.3;
/// Nothing stands where the robot was: so far around its middle, in cm, which counts as some looks.
const HULL: f64 = 7.5;
const WAS_THERE: f64 = 10.0;
/// Odds that are as probable as not.
const EVEN: f64 = 0.15;
/// A wall takes cells so near to its line, in cm, and has no wider gap.
const BESIDE: f64 = 4.0;
const GAP: f64 = 11.0;
/// Directions of walls that are tried.
const DIRECTIONS: u32 = 72;
/// The most walls.
const MOST_WALLS: usize = 500;
/// A place to explore is as far from one that was tried, in cm.
const ELSEWHERE: f64 = 15.0;
/// What was seen only from farther is worth a look, in cm.
const SPACING: f64 = 60.0;
/// The most cells on a side.
const MOST_SIDE: f64 = 2000.0;

#[derive(Clone, Copy, Debug)]
struct Look {
    /// Of the sensor.
    pose: Pose,
    heard: f64,
}

/// What is known of a cell.
#[derive(Clone, Copy, Debug, Default)]
struct Cell {
    free: f64,
    share: f64,
}

impl Cell {
    fn odds(self) -> f64 {
        (self.share + PRIOR) / (1.0 + AGAINST * self.free)
    }

    fn is_known(self) -> bool {
        self.free > 0.0 || self.share > 0.0
    }

    fn probability(self) -> f64 {
        let odds = self.odds() / EVEN;
        if self.is_known() { odds / (1.0 + odds) } else { 0.5 }
    }

    fn is_occupied(self) -> bool {
        self.is_known() && self.odds() > EVEN
    }
}

#[derive(Clone, Debug, Default)]
struct Grid {
    low: Point,
    columns: usize,
    rows: usize,
    cells: Vec<Cell>,
}

/// A wall of a map, by its ends, in cm.
pub type Wall = [Point; 2];

/// All looks of a drive, and the map that they make.
#[derive(Clone, Debug)]
pub struct Mapper {
    sensor: Pose,
    looks: Vec<Look>,
    last: Option<Pose>,
    trail: Vec<Point>,
    tried: Vec<Point>,
    /// The grid of all looks, if none came since.
    grid: Option<Grid>,
}

impl Mapper {
    /// Nothing is known; the sensor is there on the robot.
    pub fn new(sensor: Pose) -> Mapper {
        let (looks, trail, tried) = (Vec::new(), Vec::new(), Vec::new());
        Mapper { sensor, looks, last: None, trail, tried, grid: None }
    }

    /// Adds what is heard, in cm, where odometry says that the robot is.
    pub fn look(&mut self, robot: Pose, heard: f64) {
        let is_near = |last: Pose| {
            distance(last.point(), robot.point()) < APART[0]
                && wrapped(last.heading - robot.heading).abs() < APART[1]
        };
        if self.last.is_some_and(is_near) || self.looks.len() >= MOST_LOOKS {
            return;
        }
        self.last = Some(robot);
        self.trail.push(robot.point());
        let pose = robot.moved(Pose::default(), self.sensor);
        self.looks.push(Look { pose, heard });
        self.grid = None;
    }

    /// How probable it is that something stands at a place; 0.5 where nothing is known.
    pub fn occupancy(&mut self, at: Point) -> f64 {
        let grid = self.grid();
        grid.index(at).map_or(0.5, |cell| grid.cells[cell].probability())
    }

    /// The cells of which something is known: their middles, and how probable something is there.
    pub fn cells(&mut self) -> Vec<(Point, f64)> {
        let grid = self.grid();
        let known = grid.cells.iter().enumerate().filter(|(_, cell)| cell.is_known());
        known.map(|(index, cell)| (grid.middle(index), cell.probability())).collect()
    }

    /// The side of a cell, in cm.
    pub fn cell_side() -> f64 {
        CELL
    }

    /// The rectangle around all that is known: lower left and upper right corner.
    pub fn extent(&mut self) -> Option<[Point; 2]> {
        let known: Vec<Point> = self.cells().into_iter().map(|(at, _)| at).collect();
        let first = *known.first()?;
        let (low, high) = known.iter().fold((first, first), |(low, high), [x, y]| {
            ([low[0].min(*x), low[1].min(*y)], [high[0].max(*x), high[1].max(*y)])
        });
        let half = CELL / 2.0;
        Some([low.map(|side| side - half), high.map(|side| side + half)])
    }

    /// What stands there, as walls: lines through cells in a row, the longest first.
    pub fn walls(&mut self) -> Vec<Wall> {
        let grid = self.grid();
        let occupied = grid.cells.iter().enumerate().filter(|(_, cell)| cell.is_occupied());
        let mut left: Vec<Point> = occupied.map(|(index, _)| grid.middle(index)).collect();
        let mut walls = Vec::new();
        while walls.len() < MOST_WALLS && !left.is_empty() {
            let Some((wall, taken)) = longest(&left) else {
                break;
            };
            let mut index = 0;
            left.retain(|_| {
                index += 1;
                !taken.contains(&(index - 1))
            });
            walls.push(wall);
        }
        walls
    }

    /// The nearest place that a robot with a round hull can reach over what was seen free, and that
    /// borders on what was not seen, or is far from all those before; it is not reported again.
    /// `None` if all is explored.
    pub fn frontier(&mut self, from: Point, hull: f64) -> Option<Point> {
        if self.tried.is_empty() {
            self.tried.push(from);
        }
        let tried = self.tried.clone();
        let (keep, grid) = (hull + CELL / 2.0, self.grid());
        let occupied: Vec<Point> = grid.occupied().collect();
        let is_clear = |at: Point| occupied.iter().all(|other| distance(*other, at) >= keep);
        let start = grid.index(from)?;
        let mut came = vec![false; grid.cells.len()];
        let mut queue = VecDeque::from([start]);
        came[start] = true;
        let mut found = None;
        while let Some(cell) = queue.pop_front() {
            let at = grid.middle(cell);
            let near = grid.beside(cell);
            let borders = near.iter().filter(|other| !grid.cells[**other].is_known()).count();
            let is_far = distance(at, from) > ELSEWHERE
                && tried.iter().all(|other| distance(*other, at) > ELSEWHERE);
            let is_lonely = tried.iter().all(|other| distance(*other, at) > SPACING);
            if is_far && (borders >= 1 || is_lonely) {
                found = Some(at);
                break;
            }
            for other in near {
                let is_free = grid.cells[other].is_known() && !grid.cells[other].is_occupied();
                if !came[other] && is_free && is_clear(grid.middle(other)) {
                    came[other] = true;
                    queue.push_back(other);
                }
            }
        }
        self.tried.extend(found);
        found
    }

    fn grid(&mut self) -> &Grid {
        let (looks, trail) = (&self.looks, &self.trail);
        self.grid.get_or_insert_with(|| Grid::of(looks, trail))
    }
}

impl Grid {
    fn of(looks: &[Look], trail: &[Point]) -> Grid {
        let reached = looks.iter().flat_map(|look| {
            let far = if look.heard < VAGUE { look.heard } else { 0.0 };
            let ends = [-ECHO, 0.0, ECHO].map(|turn| {
                Pose { heading: look.pose.heading + turn, ..look.pose }.ahead(far).point()
            });
            ends.into_iter().chain([look.pose.point()])
        });
        let mut low = [f64::INFINITY; 2];
        let mut high = [f64::NEG_INFINITY; 2];
        for at in reached.chain(trail.iter().copied()) {
            for axis in 0..2 {
                low[axis] = low[axis].min(at[axis]);
                high[axis] = high[axis].max(at[axis]);
            }
        }
        if low[0] > high[0] {
            return Grid::default();
        }
        let low = low.map(|side| (side / CELL).floor() * CELL - CELL);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "limited")]
        let count =
            |axis: usize| ((high[axis] - low[axis]) / CELL + 2.0).clamp(1.0, MOST_SIDE) as usize;
        let (columns, rows) = (count(0), count(1));
        let mut grid = Grid { low, columns, rows, cells: vec![Cell::default(); columns * rows] };
        grid.count_free(looks, trail);
        grid.share_echoes(looks);
        grid
    }

    fn count_free(&mut self, looks: &[Look], trail: &[Point]) {
        for look in looks.iter().filter(|look| look.heard < FAR) {
            let far = look.heard.min(VAGUE) - BEFORE;
            for cell in self.sector(look.pose, FREE, [0.0, far]) {
                self.cells[cell].free += 1.0;
            }
        }
        for [x, y] in trail {
            let around = Pose { x: *x, y: *y, heading: 0.0 };
            for cell in self.sector(around, 180.0, [0.0, HULL]) {
                self.cells[cell].free += WAS_THERE;
            }
        }
    }

    fn share_echoes(&mut self, looks: &[Look]) {
        let heard = looks.iter().filter(|look| look.heard < VAGUE);
        let half = CELL / 2.0;
        let ring =
            |look: &Look| self.sector(look.pose, ECHO, [look.heard - half, look.heard + half]);
        let arcs: Vec<Vec<usize>> = heard.map(ring).collect();
        for _ in 0..ROUNDS {
            let odds: Vec<f64> = self.cells.iter().map(|cell| cell.odds()).collect();
            self.cells.iter_mut().for_each(|cell| cell.share = 0.0);
            for arc in &arcs {
                let sum: f64 = arc.iter().map(|cell| odds[*cell]).sum();
                for cell in arc {
                    self.cells[*cell].share += odds[*cell] / sum;
                }
            }
        }
    }

    /// The cells whose middles are in a part of a cone.
    fn sector(&self, sensor: Pose, half_angle: f64, [near, far]: [f64; 2]) -> Vec<usize> {
        let mut cells = Vec::new();
        let corner = |side: f64| [sensor.x + side, sensor.y + side];
        let (Some(first), Some(last)) = (self.clamped(corner(-far)), self.clamped(corner(far)))
        else {
            return cells;
        };
        let ahead = Pose { x: 0.0, y: 0.0, ..sensor }.ahead(1.0).point();
        let cos = libm::cos(half_angle.to_radians());
        for row in first[1]..=last[1] {
            for column in first[0]..=last[0] {
                let cell = row * self.columns + column;
                let [x, y] = self.middle(cell);
                let way = [x - sensor.x, y - sensor.y];
                let square = way[0] * way[0] + way[1] * way[1];
                let along = way[0] * ahead[0] + way[1] * ahead[1];
                let is_far_enough = near <= 0.0 || square >= near * near;
                let is_inside =
                    half_angle >= 180.0 || along >= 0.0 && along * along >= cos * cos * square;
                if is_far_enough && square < far * far && is_inside {
                    cells.push(cell);
                }
            }
        }
        cells
    }

    /// Column and row of the cell next to a place.
    fn clamped(&self, at: Point) -> Option<[usize; 2]> {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let step = |axis: usize| ((at[axis] - self.low[axis]) / CELL).max(0.0) as usize;
        let last = [self.columns.checked_sub(1)?, self.rows.checked_sub(1)?];
        Some([step(0).min(last[0]), step(1).min(last[1])])
    }

    fn index(&self, at: Point) -> Option<usize> {
        let is_left = at[0] < self.low[0] || at[1] < self.low[1];
        let [column, row] = self.clamped(at)?;
        let cell = row * self.columns + column;
        let [x, y] = self.middle(cell);
        let is_inside = (at[0] - x).abs() <= CELL && (at[1] - y).abs() <= CELL;
        (!is_left && is_inside).then_some(cell)
    }

    fn middle(&self, cell: usize) -> Point {
        let (column, row) = (float(cell % self.columns), float(cell / self.columns));
        [self.low[0] + (column + 0.5) * CELL, self.low[1] + (row + 0.5) * CELL]
    }

    fn occupied(&self) -> impl Iterator<Item = Point> + '_ {
        let occupied = self.cells.iter().enumerate().filter(|(_, cell)| cell.is_occupied());
        occupied.map(|(index, _)| self.middle(index))
    }

    /// The up to four cells at the sides of one.
    fn beside(&self, cell: usize) -> Vec<usize> {
        let (column, row) = (cell % self.columns, cell / self.columns);
        let mut near = Vec::new();
        if column > 0 {
            near.push(cell - 1);
        }
        if column + 1 < self.columns {
            near.push(cell + 1);
        }
        if row > 0 {
            near.push(cell - self.columns);
        }
        if row + 1 < self.rows {
            near.push(cell + self.columns);
        }
        near
    }
}

/// The line through the most places without a wide gap, and which places these are.
fn longest(places: &[Point]) -> Option<(Wall, Vec<usize>)> {
    let mut best: Option<(Wall, Vec<usize>)> = None;
    for direction in 0..DIRECTIONS {
        let (sin, cos) = libm::sincos(f64::from(direction) / f64::from(DIRECTIONS) * LINE);
        let along = |at: Point| at[0] * sin + at[1] * cos;
        let aside = |at: Point| at[0] * cos - at[1] * sin;
        let mut order: Vec<usize> = (0..places.len()).collect();
        let offset = |index: &usize| aside(places[*index]);
        order.sort_by(|a, b| offset(a).total_cmp(&offset(b)));
        let mut first = 0;
        for last in 0..order.len() {
            while offset(&order[last]) - offset(&order[first]) > BESIDE {
                first += 1;
            }
            let is_whole = last + 1 == order.len()
                || offset(&order[last + 1]) - offset(&order[first]) > BESIDE;
            let most = best.as_ref().map_or(0, |(_, taken)| taken.len());
            if !is_whole || last + 1 - first <= most {
                continue;
            }
            let mut band = order[first..=last].to_vec();
            let position = |index: &usize| along(places[*index]);
            band.sort_by(|a, b| position(a).total_cmp(&position(b)));
            let runs = band.chunk_by(|a, b| position(b) - position(a) <= GAP);
            let Some(run) = runs.max_by_key(|run| run.len()).filter(|run| run.len() > most) else {
                continue;
            };
            let off = run.iter().map(offset).sum::<f64>() / float(run.len());
            let end = |index: &usize, more: f64| {
                let way = position(index) + more;
                [way * sin + off * cos, way * cos - off * sin]
            };
            let (start, stop) = (run.first()?, run.last()?);
            let wall = [end(start, -CELL / 2.0), end(stop, CELL / 2.0)];
            best = Some((wall, run.to_vec()));
        }
    }
    best
}

/// Half a turn.
const LINE: f64 = std::f64::consts::PI;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Field;
    use ev3_roadmap::{Bounds, Map, Obstacle};

    /// Looks around at some places of a room of 3 m by 2 m with a box.
    fn looked_around(places: &[Point]) -> Mapper {
        let thing = Obstacle::rectangle([200.0, 100.0], 40.0, 40.0, 0.0).unwrap();
        let bounds = Bounds { low: [0.0, 0.0], high: [300.0, 200.0] };
        let field = Field::new(&Map::new(vec![thing], Some(bounds)).unwrap(), 8.0, 15.0).unwrap();
        let mut mapper = Mapper::new(Pose { x: 0.0, y: 7.0, heading: 0.0 });
        for [x, y] in places {
            for turn in 0..120 {
                let robot = Pose { x: *x, y: *y, heading: f64::from(turn) * 3.0 };
                mapper.look(robot, field.heard(robot.ahead(7.0)).unwrap_or(FAR));
            }
        }
        mapper
    }

    const PLACES: [Point; 6] =
        [[60.0, 60.0], [60.0, 140.0], [150.0, 40.0], [150.0, 160.0], [260.0, 50.0], [260.0, 150.0]];

    #[test]
    fn what_was_seen_from_many_sides_is_where_it_is() {
        let mut mapper = looked_around(&PLACES);
        for free in [[60.0, 60.0], [100.0, 100.0], [150.0, 100.0], [200.0, 50.0]] {
            assert!(mapper.occupancy(free) < 0.2, "{free:?} {}", mapper.occupancy(free));
        }
        for wall in [[181.0, 100.0], [200.0, 119.0], [219.0, 100.0], [0.5, 60.0]] {
            let near = [-5.0, -2.5, 0.0, 2.5, 5.0];
            let most = near.into_iter().flat_map(|dx| near.map(|dy| [wall[0] + dx, wall[1] + dy]));
            let most = most.map(|at| mapper.occupancy(at)).fold(0.0, f64::max);
            assert!(most > 0.5, "{wall:?} {most}");
        }
        let unknown = mapper.occupancy([-500.0, 0.0]);
        assert!((unknown - 0.5).abs() < 1e-12, "{unknown}");
    }

    #[test]
    fn cells_in_a_row_become_walls() {
        let walls = looked_around(&PLACES).walls();
        assert!((8..60).contains(&walls.len()), "{}", walls.len());
        let longest = walls.iter().map(|[a, b]| distance(*a, *b)).fold(0.0, f64::max);
        assert!((120.0..320.0).contains(&longest), "{longest}");
        assert!(looked_around(&[]).walls().is_empty());
        assert!(looked_around(&[]).extent().is_none());
    }

    #[test]
    fn the_next_place_is_free_and_told_once() {
        let mut mapper = looked_around(&PLACES[..1]);
        let mut places = Vec::new();
        while let Some(place) = mapper.frontier(PLACES[0], 8.0) {
            assert!(mapper.occupancy(place) < 0.5, "{place:?}");
            assert!(places.iter().all(|other| distance(*other, place) > ELSEWHERE));
            places.push(place);
            assert!(places.len() < 200);
        }
        assert!(!places.is_empty());
    }
}
