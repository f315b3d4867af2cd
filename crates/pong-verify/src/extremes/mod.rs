//! Extreme conditions (docs/extremes.md), row by row, each with its margin: the allowance divided by the
//! measured error.
//!
//! Some rows are cases of the verification report, run again. `long` selects the soaks; the code is the same.

mod crowd;
mod drops;
mod extreme;
mod friction;
mod grazing;
mod overlap;
mod place;
mod refused;
mod report;
mod rest;
mod rig;
mod scale;
mod thin_walls;

pub use extreme::{Answer, Extreme, Finding, Length};
pub use report::{markdown, text};

/// All extremes, in the order of the report.
pub fn extremes() -> Vec<Extreme> {
    vec![
        place::FAR,
        scale::SIZES,
        scale::MASSES,
        refused::SHAPES,
        refused::ROUNDED,
        grazing::TOUCH,
        grazing::COINCIDENT,
        refused::RUN_TIME,
        drops::STEP,
        overlap::DEEP,
        thin_walls::SHOTS,
        thin_walls::MISSES,
        crowd::CROWD,
        rest::REST,
        friction::FACETS,
        friction::LOADS,
        drops::DROPS,
        drops::HELD,
    ]
}
