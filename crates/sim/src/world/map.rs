//! Worlds drawn with characters.
//!
//! ```text
//! #########
//! #...#...#     # wall      . or space  floor      O  a round obstacle
//! #.^.#.L.#     S or ^ > v < the start and its heading      L  lamp
//! #.......#     k b g y r w n  black blue green yellow red white brown floor
//! #########
//! ```

use crate::world::color::Color;
use crate::world::geometry::{Pose, is_in_range};
use crate::world::{Item, Part, Point, SpecError, WorldSpec};

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

impl WorldSpec {
    /// Reads a map. A character is a square of `cell` cm; the lower left corner of the last row
    /// is the origin.
    ///
    /// # Errors
    /// An unknown character, a second start, or a cell without size, by row and column from 1.
    pub fn from_map(map: &str, cell: f64) -> Result<WorldSpec, SpecError> {
        if !(is_in_range(cell) && cell > 0.0) {
            return Err(SpecError::new("cell", "needs a size above 0"));
        }
        let rows: Vec<Vec<char>> =
            map.trim_matches('\n').lines().map(|line| line.trim_end().chars().collect()).collect();
        let mut world = WorldSpec::default();
        let mut started = false;
        let height = rows.len();
        for (row, line) in rows.iter().enumerate() {
            for (column, character) in line.iter().enumerate() {
                let place = || format!("map row {} column {}", row + 1, column + 1);
                let center = corner(column, height - 1 - row, 0.5, cell);
                match *character {
                    '#' | '.' | ' ' => {}
                    'O' => world.items.push(Item::Circle { center, radius: cell * 0.4 }),
                    'L' => world.items.push(Item::Lamp { at: center, intensity: LAMP_INTENSITY }),
                    other => {
                        if let Some(heading) = start_heading(other) {
                            if std::mem::replace(&mut started, true) {
                                return Err(SpecError::new(place(), "is a second start")
                                    .in_part(Part::MapRow(row)));
                            }
                            world.start = Pose::new(center[0], center[1], heading);
                        } else if let Some(color) = floor_color(other) {
                            let low = corner(column, height - 1 - row, 0.0, cell);
                            let high = corner(column, height - 1 - row, 1.0, cell);
                            world.items.push(Item::rectangle(low, high, color));
                        } else {
                            let reason = format!("has an unknown character: {other:?}");
                            return Err(SpecError::new(place(), reason).in_part(Part::MapRow(row)));
                        }
                    }
                }
            }
        }
        add_walls(&mut world, rows, cell);
        Ok(world)
    }
}

fn start_heading(character: char) -> Option<f64> {
    match character {
        'S' | '^' => Some(0.0),
        '>' => Some(90.0),
        'v' => Some(180.0),
        '<' => Some(270.0),
        _ => None,
    }
}

fn floor_color(character: char) -> Option<Color> {
    let (_, name) = FLOORS.iter().find(|(letter, _)| *letter == character)?;
    name.parse().ok()
}

/// A point of a cell, `share` of the way from its lower left to its upper right corner.
#[expect(clippy::cast_precision_loss, reason = "rows and columns of a drawing")]
fn corner(column: usize, row_from_below: usize, share: f64, cell: f64) -> Point {
    [(column as f64 + share) * cell, (row_from_below as f64 + share) * cell]
}

/// Joins wall cells to rectangles: first as wide, then as high as they go.
fn add_walls(world: &mut WorldSpec, mut rows: Vec<Vec<char>>, cell: f64) {
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
            let low = corner(column, height - below, 0.0, cell);
            let high = corner(end, height - row, 0.0, cell);
            world.items.push(Item::Box {
                pose: Pose::new(
                    f64::midpoint(low[0], high[0]),
                    f64::midpoint(low[1], high[1]),
                    0.0,
                ),
                width: high[0] - low[0],
                depth: high[1] - low[1],
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_are_joined_and_the_start_is_found() {
        let world = WorldSpec::from_map("#####\n#.>.#\n#.L.#\n#####\n", 20.0).unwrap();
        let boxes = world.items.iter().filter(|item| item.kind() == "box").count();
        assert_eq!(boxes, 4);
        assert_eq!(world.start, Pose::new(50.0, 50.0, 90.0));
        assert!(world.items.contains(&Item::Lamp { at: [50.0, 30.0], intensity: LAMP_INTENSITY }));
        let left = Item::Box { pose: Pose::new(10.0, 40.0, 0.0), width: 20.0, depth: 40.0 };
        let top = Item::Box { pose: Pose::new(50.0, 70.0, 0.0), width: 100.0, depth: 20.0 };
        assert!(world.items.contains(&top), "{:?}", world.items);
        assert!(!world.items.contains(&left), "the left column goes down to the floor");
    }

    #[test]
    fn errors_name_row_and_column() {
        let error = WorldSpec::from_map("###\n#X#", 20.0).unwrap_err();
        assert_eq!(error.to_string(), "map row 2 column 2 has an unknown character: 'X'");
        assert!(WorldSpec::from_map("SS", 20.0).is_err());
        assert!(WorldSpec::from_map("S", 0.0).is_err());
    }
}
