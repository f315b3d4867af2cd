//! Cases with known answers, run along the whole path: model file → engine → wrench → integrator.
//!
//! Every expected value follows from a closed form that the case itself computes; nothing is taken from the
//! engine. Sines, logarithms and powers come from a pure-Rust libm, so that the report is the same on every
//! machine of an architecture.
//!
//! ```
//! let case = pong_verify::find("V1").unwrap();
//! let verdict = case.run();
//! assert!(verdict.passes(), "{verdict}");
//! ```
//!
//! | file | holds |
//! |---|---|
//! | `row.rs` | a quantity, its expected value and what came out |
//! | `scene.rs` | model files → sealed world → simulation |
//! | `measure.rs` | periods, roots, observed orders, random numbers |
//! | `cases/` | the cases, one file each or a few that belong together |
//! | `orders/` | orders of contact motions in the step, and their picture |
//! | `report.rs` | the table as text and as Markdown |
//! | `extremes/` | the extremes that must hold, with their margins |

#![forbid(unsafe_code)]

mod cases;
pub mod extremes;
mod measure;
pub mod orders;
pub mod report;
mod row;
mod scene;

pub use cases::cases;
pub use row::{Bound, Row};

use std::fmt;

/// Why a case could not be run to its end.
pub type Failure = Box<dyn std::error::Error>;

/// What a case returns.
pub type Outcome = Result<Vec<Row>, Failure>;

/// A case with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Name, unique; `V…` are the numbers of the validation plan, `W…` further cases in the same spirit.
    pub id: &'static str,
    /// What it is about.
    pub title: &'static str,
    /// The set-up in a sentence or two.
    pub set_up: &'static str,
    /// Where the expected values come from.
    pub source: &'static str,
    /// Computes the rows.
    pub rows: fn() -> Outcome,
}

/// What became of a case.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The case.
    pub case: Case,
    /// Its rows; empty if it could not be run.
    pub rows: Vec<Row>,
    /// Why it could not be run.
    pub failure: Option<String>,
}

impl Case {
    /// Runs the case.
    pub fn run(&self) -> Verdict {
        match (self.rows)() {
            Ok(rows) => Verdict { case: *self, rows, failure: None },
            Err(failure) => Verdict { case: *self, rows: Vec::new(), failure: Some(failure.to_string()) },
        }
    }
}

impl Verdict {
    /// Whether it ran, and every row is within its tolerance.
    pub fn passes(&self) -> bool {
        self.failure.is_none() && !self.rows.is_empty() && self.rows.iter().all(Row::passes)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&report::text(std::slice::from_ref(self)))
    }
}

/// The case of an id, in upper or lower case.
pub fn find(id: &str) -> Option<Case> {
    cases().into_iter().find(|case| case.id.eq_ignore_ascii_case(id))
}
