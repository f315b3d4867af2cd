//! A case with a known answer, and its verdict.

use crate::row::Row;

/// Reason why a case could not be completed.
pub type Failure = Box<dyn std::error::Error>;

/// Result of a case.
pub type Outcome = Result<Vec<Row>, Failure>;

/// A case with a known answer.
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// Unique name; `V…` are the numbers of the validation plan, `W…` further cases of the same kind.
    pub id: &'static str,
    /// Subject of the case.
    pub title: &'static str,
    /// The set-up in a sentence or two.
    pub set_up: &'static str,
    /// Source of the expected values.
    pub source: &'static str,
    /// Computes the rows.
    pub rows: fn() -> Outcome,
}

/// Verdict on a case.
#[derive(Clone, Debug)]
pub struct Verdict {
    /// The case.
    pub case: Case,
    /// Its rows; empty if it could not be run.
    pub rows: Vec<Row>,
    /// Reason why it could not be run.
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
    /// True if it ran and every row is within its tolerance.
    pub fn passes(&self) -> bool {
        self.failure.is_none() && !self.rows.is_empty() && self.rows.iter().all(Row::passes)
    }
}
