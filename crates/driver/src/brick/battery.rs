//! The battery: class `power_supply`.
//!
//! Its voltage shows roughly how full it is: it depends on the chemistry, falls while motors draw
//! current, and hardly changes in the middle of the discharge.
use crate::class::Class;
use crate::device::Device;
use crate::device::registry::Registry;
use crate::error::Result;
use ev3_os::Errno;
use std::sync::Arc;

/// How a kind of battery discharges.
struct Chemistry {
    /// As `technology` has it.
    name: &'static str,
    cells: f64,
    /// Volts of a cell, and the remaining charge in percent, upwards.
    curve: &'static [(f64, f64)],
}

/// The EV3's batteries. Each curve was read, to some 5 percent, off manufacturers' data sheets for
/// a current of a fifth of the capacity an hour, which is about what a driving robot draws; it ends
/// where brickd shuts the brick down, at 6.0 V or 4.5 V, or where nothing is left before.
const CHEMISTRIES: [Chemistry; 3] = [
    // LEGO's own pack. Cells as Panasonic's NCR18650.
    Chemistry {
        name: "Li-ion",
        cells: 2.0,
        curve: &[
            (3.0, 0.0),
            (3.3, 8.0),
            (3.5, 22.0),
            (3.6, 36.0),
            (3.7, 52.0),
            (3.8, 65.0),
            (4.0, 87.0),
            (4.15, 100.0),
        ],
    },
    // As Energizer's NH15.
    Chemistry {
        name: "NiMH",
        cells: 6.0,
        curve: &[(1.0, 0.0), (1.1, 6.0), (1.15, 13.0), (1.2, 35.0), (1.25, 70.0), (1.35, 100.0)],
    },
    // AA cells, as Energizer's E91; the brick calls them unknown.
    Chemistry {
        name: "Unknown",
        cells: 6.0,
        curve: &[
            (0.75, 0.0),
            (0.9, 5.0),
            (1.0, 12.0),
            (1.1, 25.0),
            (1.2, 45.0),
            (1.3, 68.0),
            (1.4, 88.0),
            (1.5, 100.0),
        ],
    },
];

/// The battery; `None` where the board has none, or does not show it.
pub fn battery(registry: &Registry) -> Result<Option<Arc<Device>>> {
    Ok(registry.all(Class::Battery)?.first().cloned())
}

/// The voltage, in volts.
pub fn volts(battery: &Device) -> Result<f64> {
    battery.number("voltage_now").map(from_micros)
}

/// The current that is drawn, in amperes; `None` on boards that do not measure it.
pub fn amperes(battery: &Device) -> Result<Option<f64>> {
    Ok(if_there(battery.number("current_now"))?.map(from_micros))
}

/// The chemistry by the kernel's word: `Li-ion`, `NiMH`, or `Unknown`, which are
/// AA cells. `None` on boards that do not report it.
pub fn chemistry(battery: &Device) -> Result<Option<String>> {
    if_there(battery.text("technology"))
}

/// The remaining charge in percent, by the voltage and the chemistry; `None` where
/// the chemistry is not known.
pub fn percent(battery: &Device) -> Result<Option<i64>> {
    let chemistry = chemistry(battery)?;
    let known = CHEMISTRIES.iter().find(|known| chemistry.as_deref() == Some(known.name));
    let Some(known) = known else { return Ok(None) };
    Ok(Some(left(known.curve, volts(battery)? / known.cells)))
}

/// The remaining charge at this voltage of a cell, by the curve.
#[expect(clippy::cast_possible_truncation, reason = "a percentage")]
fn left(curve: &[(f64, f64)], volts: f64) -> i64 {
    let above = curve.iter().position(|(at, _)| *at >= volts);
    let percent = match above.and_then(|index| Some((curve.get(index)?, index.checked_sub(1)))) {
        None => 100.0,
        Some((_, None)) => 0.0,
        Some((high, Some(index))) => {
            let low = curve.get(index).unwrap_or(high);
            low.1 + (high.1 - low.1) * (volts - low.0) / (high.0 - low.0)
        }
    };
    percent.round() as i64
}

#[expect(clippy::cast_precision_loss, reason = "a few volts or amperes")]
fn from_micros(micros: i64) -> f64 {
    micros as f64 / 1e6
}

/// `None` for a file that the board's driver does not have.
fn if_there<T>(read: Result<T>) -> Result<Option<T>> {
    match read {
        Err(error) if error.errno() == Some(Errno::NOENT) => Ok(None),
        read => read.map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_rise_and_end_at_0_and_100() {
        for Chemistry { name, curve, .. } in &CHEMISTRIES {
            assert!(curve.is_sorted_by(|a, b| a.0 < b.0 && a.1 < b.1), "{name}");
            assert_eq!(curve.first().map(|point| point.1), Some(0.0), "{name}");
            assert_eq!(curve.last().map(|point| point.1), Some(100.0), "{name}");
        }
    }

    #[test]
    fn between_two_points_it_is_in_proportion() {
        let curve = [(1.0, 0.0), (1.2, 50.0), (1.3, 100.0)];
        for (volts, percent) in
            [(0.5, 0), (1.0, 0), (1.1, 25), (1.2, 50), (1.25, 75), (1.3, 100), (9.0, 100)]
        {
            assert_eq!(left(&curve, volts), percent, "{volts} V");
        }
    }
}
