//! The time that an update takes: 500 particles and a measurement, in a room with three boxes.
//!
//! `cargo run --release -p ev3-localize --example update -- UPDATES [table]`
//!
//! With the table the room has a third of the size: to fill it takes instructions by its area,
//! to look into it does not.
//!
//! Instructions are counted from outside: `tools/instructions.sh`.
use ev3_localize::{Count, Field, Localizer, Options, Pose};
use ev3_roadmap::{Bounds, Map, Obstacle};
use std::error::Error;
use std::hint::black_box;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let updates: u32 = arguments.next().ok_or("how many updates?")?.parse()?;
    let has_table = arguments.next().is_some();
    let size = if has_table { 0.35 } else { 1.0 };
    let block = |x: f64, y: f64, along: f64, across: f64, turn| {
        Obstacle::rectangle([size * x, size * y], size * along, size * across, turn)
    };
    let obstacles = vec![
        block(90.0, 165.0, 40.0, 25.0, 20.0)?,
        block(200.0, 90.0, 30.0, 45.0, -15.0)?,
        block(150.0, 125.0, 16.0, 16.0, 0.0)?,
    ];
    let bounds = Bounds { low: [0.0, 0.0], high: [size * 300.0, size * 250.0] };
    let field = Field::new(&Map::new(obstacles, Some(bounds))?, 8.0, 15.0)?;
    let field = if has_table { field.with_table() } else { field };
    let options = Options { count: Count::Fixed(500), ..Options::default() };
    let mut localizer = Localizer::new(field.clone(), options);
    let begin = Pose { x: size * 40.0, y: size * 40.0, heading: 40.0 };
    localizer.start_at(begin, 2.0);
    for update in 1..=updates {
        // There and back, so that it stays in the room
        let way = f64::from(if update / 30 % 2 == 0 { update % 30 } else { 30 - update % 30 });
        let there = begin.ahead(2.5 * way);
        let heard = field.heard(there.ahead(7.0)).unwrap_or(255.0);
        black_box(localizer.step(there, heard));
    }
    Ok(())
}
