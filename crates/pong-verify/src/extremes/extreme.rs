//! An extreme that must hold, and what became of it.

use crate::case::{Failure, Outcome};
use crate::cases::find;
use crate::row::Row;

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
    pub(super) fn of(self, short: usize, long: usize) -> usize {
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
    pub(super) rows: fn(Length) -> Outcome,
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

/// The rows of a case of the verification report.
pub(super) fn rows_of(case: &str) -> Outcome {
    let case = find(case).ok_or_else(|| Failure::from(format!("there is no case {case}")))?;
    (case.rows)()
}
