//! Maps that are drawn with characters: worlds, and grids of cells.
//!
//! ```text
//! #########
//! #...#...#     # wall      . or space  floor      O  a round obstacle
//! #.^.#.L.#     S or ^ > v < the start and its heading      L  lamp
//! #.......#     k b g y r w n  black blue green yellow red white brown floor
//! #########
//! ```

use crate::world::color::Color;
use crate::world::{Item, Part, SpecError, WorldSpec};
use ev3_motion::{Point, Pose, is_in_range};

const FLOORS: [(char, &str); 7] = [
    ('k', "black"),
    ('b', "blue"),
    ('g', "green"),
    ('y', "yellow"),
    ('r', "red"),
    ('w', "white"),
    ('n', "brown"),
];
/// How bright an `L` is: see [`Item::Lamp`].
const LAMP_INTENSITY: f64 = 12.0;

/// A cell by its column and its row, both counted from 0, the row from below.
pub type Cell = [usize; 2];

/// A map whose characters are all known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Drawing {
    /// From above.
    rows: Vec<Vec<char>>,
    start: Option<(Cell, u16)>,
}

impl Drawing {
    /// Reads a drawing, a character for each cell, from above.
    /// Errors: an unknown character or a second start, by row and column from 1.
    pub fn read<S: AsRef<str>>(rows: &[S]) -> Result<Drawing, SpecError> {
        let rows: Vec<Vec<char>> = rows.iter().map(|row| row.as_ref().chars().collect()).collect();
        let mut start = None;
        for (row, line) in rows.iter().enumerate() {
            for (column, &character) in line.iter().enumerate() {
                let wrong = |reason: String| {
                    let place = format!("map row {} column {}", row + 1, column + 1);
                    Err(SpecError::new(place, reason).in_part(Part::MapRow(row)))
                };
                if let Some(heading) = start_heading(character) {
                    if start.replace(([column, rows.len() - 1 - row], heading)).is_some() {
                        return wrong("is a second start".to_owned());
                    }
                } else if !is_known(character) {
                    let shown = character.escape_default();
                    let shown = if character.is_control() {
                        shown.collect()
                    } else {
                        character.to_string()
                    };
                    return wrong(format!("has an unknown character: {shown}"));
                }
            }
        }
        Ok(Drawing { rows, start })
    }

    /// How many cells it is wide, at its widest row, and how many high.
    pub fn size(&self) -> Cell {
        [self.rows.iter().map(Vec::len).max().unwrap_or_default(), self.rows.len()]
    }

    /// Where a robot starts, and its heading in degrees clockwise from above.
    pub fn start(&self) -> Option<(Cell, u16)> {
        self.start
    }

    /// The cells that a robot cannot enter.
    pub fn obstructed(&self) -> impl Iterator<Item = Cell> {
        self.cells().filter(|(character, _)| matches!(character, '#' | 'O')).map(|(_, cell)| cell)
    }

    /// The same as a part of a world, with cells of `size` cm; the lower left corner of the last
    /// row is the origin. Errors: Cells without size.
    pub fn drawn(&self, size: f64) -> Result<Drawn, SpecError> {
        if !(is_in_range(size) && size > 0.0) {
            return Err(SpecError::new("cell", "needs a size above 0"));
        }
        let mut items: Vec<Item> =
            self.cells().filter_map(|(character, cell)| item(character, cell, size)).collect();
        add_walls(&mut items, self.rows.clone(), size);
        let start = self.start.map(|(cell, heading)| {
            let [x, y] = corner(cell, 0.5, size);
            Pose::new(x, y, f64::from(heading))
        });
        Ok(Drawn { items, start })
    }

    /// The characters with their cells, row by row from above.
    fn cells(&self) -> impl Iterator<Item = (char, Cell)> {
        let height = self.rows.len();
        self.rows.iter().enumerate().flat_map(move |(row, line)| {
            let from_below = height - 1 - row;
            line.iter()
                .enumerate()
                .map(move |(column, character)| (*character, [column, from_below]))
        })
    }
}

/// What a drawing adds to a world.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// What stands and lies there.
    pub items: Vec<Item>,
    /// Where the robot starts, if the drawing says so.
    pub start: Option<Pose>,
}

impl WorldSpec {
    /// The world that a text draws, a line for each row.
    /// Errors: as [`Drawing::read`] and [`Drawing::drawn`].
    pub fn from_map(map: &str, cell: f64) -> Result<WorldSpec, SpecError> {
        let rows: Vec<&str> = map.trim_matches('\n').lines().collect();
        let Drawn { items, start } = Drawing::read(&rows)?.drawn(cell)?;
        Ok(WorldSpec { items, start: start.unwrap_or_default(), ..WorldSpec::default() })
    }
}

fn is_known(character: char) -> bool {
    matches!(character, '#' | '.' | ' ' | 'O' | 'L') || floor_color(character).is_some()
}

/// What a cell holds, but for walls.
fn item(character: char, cell: Cell, size: f64) -> Option<Item> {
    let center = corner(cell, 0.5, size);
    match character {
        'O' => Some(Item::circle(center, size * 0.4)),
        'L' => Some(Item::Lamp { at: center, intensity: LAMP_INTENSITY }),
        other => {
            let color = floor_color(other)?;
            Some(Item::rectangle(corner(cell, 0.0, size), corner(cell, 1.0, size), color))
        }
    }
}

fn start_heading(character: char) -> Option<u16> {
    match character {
        'S' | '^' => Some(0),
        '>' => Some(90),
        'v' => Some(180),
        '<' => Some(270),
        _ => None,
    }
}

fn floor_color(character: char) -> Option<Color> {
    let (_, name) = FLOORS.iter().find(|(letter, _)| *letter == character)?;
    name.parse().ok()
}

/// A point of a cell, `share` of the way from its lower left to its upper right corner.
#[expect(clippy::cast_precision_loss, reason = "rows and columns of a drawing")]
fn corner([column, row]: Cell, share: f64, size: f64) -> Point {
    [(column as f64 + share) * size, (row as f64 + share) * size]
}

/// Joins wall cells to rectangles: first as wide, then as high as they go.
fn add_walls(items: &mut Vec<Item>, mut rows: Vec<Vec<char>>, size: f64) {
    let height = rows.len();
    let is_wall = |rows: &[Vec<char>], row: usize, columns: std::ops::Range<usize>| {
        rows.get(row)
            .and_then(|line| line.get(columns))
            .is_some_and(|c| c.iter().all(|c| *c == '#'))
    };
    for row in 0..height {
        for column in 0..rows[row].len() {
            if rows[row][column] != '#' {
                continue;
            }
            let mut end = column + 1;
            while is_wall(&rows, row, end..end + 1) {
                end += 1;
            }
            let mut below = row + 1;
            while is_wall(&rows, below, column..end) {
                below += 1;
            }
            for line in &mut rows[row..below] {
                line[column..end].fill('.');
            }
            let low = corner([column, height - below], 0.0, size);
            let high = corner([end, height - row], 0.0, size);
            items.push(Item::boxed(
                Pose::new(f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1]), 0.0),
                high[0] - low[0],
                high[1] - low[1],
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_are_joined_and_the_start_is_found() {
        let world = WorldSpec::from_map("#####\n#.>.#\n#.L.#\n#####\n", 20.0).unwrap();
        let boxes = world.items.iter().filter(|item| matches!(item, Item::Box { .. })).count();
        assert_eq!(boxes, 4);
        assert_eq!(world.start, Pose::new(50.0, 50.0, 90.0));
        assert!(world.items.contains(&Item::Lamp { at: [50.0, 30.0], intensity: LAMP_INTENSITY }));
        let left = Item::boxed(Pose::new(10.0, 40.0, 0.0), 20.0, 40.0);
        let top = Item::boxed(Pose::new(50.0, 70.0, 0.0), 100.0, 20.0);
        assert!(world.items.contains(&top), "{:?}", world.items);
        assert!(!world.items.contains(&left), "the left column goes down to the floor");
    }

    #[test]
    fn each_row_is_a_row_of_cells() {
        let drawing = Drawing::read(&["O", "#.<", ""]).unwrap();
        assert_eq!(drawing.size(), [3, 3]);
        assert_eq!(drawing.start(), Some(([2, 1], 270)));
        assert_eq!(drawing.obstructed().collect::<Vec<_>>(), [[0, 2], [0, 1]]);
        assert_eq!(drawing.drawn(10.0).unwrap().start, Some(Pose::new(25.0, 15.0, 270.0)));
        assert_eq!(Drawing::read(&[""; 0]).unwrap().size(), [0, 0]);
    }

    #[test]
    fn errors_name_row_and_column() {
        let error = WorldSpec::from_map("###\n#X#", 20.0).unwrap_err();
        assert_eq!(error.to_string(), "map row 2 column 2 has an unknown character: X");
        let error = Drawing::read(&["#\t"]).unwrap_err();
        assert_eq!(error.to_string(), "map row 1 column 2 has an unknown character: \\t");
        let error = Drawing::read(&["", "S.", ".>"]).unwrap_err();
        assert_eq!(error.to_string(), "map row 3 column 2 is a second start");
        assert_eq!(error.parts, [Part::MapRow(2)]);
        assert!(WorldSpec::from_map("S", 0.0).is_err());
    }
}
