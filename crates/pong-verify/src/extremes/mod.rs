//! The extremes that must hold (docs/extremes.md), row by row, each with its margin: how many times what was
//! measured fits into what is allowed.
//!
//! Some rows are cases of the verification report, run again. `long` asks for the soaks; the code is the same.

mod crowd;
mod drops;
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

pub use report::{markdown, text};

use crate::{Failure, Outcome, Row};

/// What the engine does at an extreme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Computes as anywhere else.
    Safe,
    /// Refuses it, with thing, cause and cure.
    Refused,
    /// Computes what it can, and tells that it is not the whole.
    Told,
}

/// How long a run may take.
#[derive(Clone, Copy, Debug, Default)]
pub struct Length {
    /// Soaks of minutes.
    pub long: bool,
}

impl Length {
    /// One of two sizes.
    fn of(self, short: usize, long: usize) -> usize {
        if self.long { long } else { short }
    }
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    /// `E1` …
    pub id: &'static str,
    /// The extreme, and what is asked.
    pub asked: &'static str,
    /// What is run.
    pub set_up: &'static str,
    /// What the engine does.
    pub answer: Answer,
    /// Where the limit lies.
    pub limit: &'static str,
    /// Tests that look at the same from other sides.
    pub also: &'static str,
    rows: fn(Length) -> Outcome,
}

/// What became of one.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The extreme.
    pub extreme: Extreme,
    /// Quantities, or why there are none.
    pub rows: Result<Vec<Row>, String>,
}

impl Extreme {
    /// Runs it.
    pub fn run(&self, length: Length) -> Finding {
        let rows = (self.rows)(length).map_err(|failure| failure.to_string());
        Finding { extreme: *self, rows }
    }
}

impl Finding {
    /// Whether all is within what is allowed.
    pub fn passes(&self) -> bool {
        self.rows.as_ref().is_ok_and(|rows| !rows.is_empty() && rows.iter().all(Row::passes))
    }
}

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

/// The rows of a case of the verification report.
fn rows_of(case: &str) -> Outcome {
    let case = crate::find(case).ok_or_else(|| Failure::from(format!("there is no case {case}")))?;
    (case.rows)()
}
