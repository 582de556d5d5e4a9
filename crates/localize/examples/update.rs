//! What an update takes: 500 particles and a measurement, in a room with three boxes.
//!
//! `cargo run --release -p ev3-localize --example update -- UPDATES [table]`
//!
//! Instructions are counted from outside: `tools/instructions.sh`.
use ev3_localize::{Count, Field, Localizer, Options, Pose};
use ev3_roadmap::{Bounds, Map, Obstacle};
use std::error::Error;
use std::hint::black_box;

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let updates: u32 = arguments.next().ok_or("how many updates?")?.parse()?;
    let obstacles = vec![
        Obstacle::rectangle([90.0, 165.0], 40.0, 25.0, 20.0)?,
        Obstacle::rectangle([200.0, 90.0], 30.0, 45.0, -15.0)?,
        Obstacle::rectangle([150.0, 125.0], 16.0, 16.0, 0.0)?,
    ];
    let bounds = Bounds { low: [0.0, 0.0], high: [300.0, 250.0] };
    let field = Field::new(&Map::new(obstacles, Some(bounds))?, 8.0, 15.0)?;
    let field = if arguments.next().is_some() { field.with_table() } else { field };
    let options = Options { count: Count::Fixed(500), ..Options::default() };
    let mut localizer = Localizer::new(field.clone(), options);
    let begin = Pose { x: 40.0, y: 40.0, heading: 40.0 };
    localizer.start_at(begin, 2.0);
    for update in 1..=updates {
        // There and back, so that it stays in the room
        let way = f64::from(if update / 40 % 2 == 0 { update % 40 } else { 40 - update % 40 });
        let there = begin.ahead(2.5 * way);
        let heard = field.heard(there.ahead(7.0)).unwrap_or(255.0);
        black_box(localizer.step(there, heard));
    }
    Ok(())
}
