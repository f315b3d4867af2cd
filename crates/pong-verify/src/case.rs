//! A case with a known answer, and what became of it.

use crate::row::Row;

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
