//! Beliefs and knowledge of places beside the pose: by a localizer, and by a map that the
//! robot makes.
use super::believed::{ToWorld, ellipse};
use super::notes::notes;
use super::state::{Cluster, Decimal, Fine, Localized, OrNull, Raster, fine, text};
use crate::localize::{mapping, with};
use ev3_localize::{Localizer, Mapper};
use ev3_motion::Pose;
use ev3_os::Instant;
use ev3_os::locked;
use std::sync::Mutex;
use std::time::Duration;
use swipl::prelude::*;

/// The most particles that are sent.
const MOST: usize = 400;

natives! {
    /// map_show_(+Mapper): pages show it.
    semidet fn "map_show_"(_context, mapper) {
        mapping(mapper, |mapper| { keep_map(mapper); Ok(()) })
    }

    /// localize_show_(+Localizer): pages show it.
    semidet fn "localize_show_"(_context, localizer) {
        with(localizer, |localizer| { keep_localized(localizer); Ok(()) })
    }
}

/// Pages show this localizer. Its poses are those of its map, which is taken for the world.
fn keep_localized(of: &Localizer) {
    let all = of.particles();
    let some = all.iter().step_by(all.len().div_ceil(MOST).max(1));
    let clusters = of.clusters();
    let localized = Localized {
        particles: some.map(|particle| parts(particle.pose)).collect(),
        clusters: clusters
            .iter()
            .map(|cluster| Cluster {
                weight: Decimal(cluster.weight),
                pose: parts(cluster.pose),
                ellipse: fine(ellipse(cluster.covariance)),
            })
            .collect(),
        confidence: Decimal(of.confidence()),
    };
    notes().keep("localized", text(&localized));
}

fn parts(Pose { x, y, heading }: Pose) -> [Fine; 3] {
    fine([x, y, heading])
}

/// Pages show this map. To think about all looks again takes a while: that is done so seldom
/// that it takes at most a twentieth of the time.
fn keep_map(mapper: &mut Mapper) {
    static NEXT: Mutex<Option<Instant>> = Mutex::new(None);
    let began = Instant::now();
    let mut next = locked(&NEXT);
    if next.is_some_and(|next| began < next) {
        return;
    }
    notes().keep("map", text(&OrNull(raster(mapper))));
    let rest = (20 * began.elapsed()).max(Duration::from_secs(1));
    *next = Some(Instant::now() + rest);
}

fn raster(mapper: &mut Mapper) -> Option<Raster> {
    let [[left, low], _] = mapper.extent()?;
    let side = Mapper::cell_side();
    let place = |way: f64| (way / side).floor();
    let cells = mapper.cells().into_iter();
    let to_world = ToWorld::now();
    Some(Raster {
        cell: Decimal(side),
        origin: fine(to_world.point([left, low])),
        h: Decimal(to_world.turn()),
        cells: cells.map(|([x, y], p)| fine([place(x - left), place(y - low), p])).collect(),
    })
}
