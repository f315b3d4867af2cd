//! An extreme condition, and its result.

use crate::case::{Failure, Outcome};
use crate::cases::find;
use crate::row::Row;

/// Behaviour of the engine at an extreme.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// Normal result.
    Safe,
    /// Refusal with thing, cause and cure.
    Refused,
    /// Partial result with a warning that it is incomplete.
    Told,
}

/// Duration of a run.
#[derive(Clone, Copy, Debug, Default)]
pub struct Length {
    /// True for soaks of minutes.
    pub long: bool,
}

impl Length {
    /// Selects one of two sizes.
    pub(super) fn of(self, short: usize, long: usize) -> usize {
        if self.long { long } else { short }
    }
}

/// A row of the table.
#[derive(Clone, Copy, Debug)]
pub struct Extreme {
    /// Name: `E1` …
    pub id: &'static str,
    /// The extreme, and the requirement.
    pub asked: &'static str,
    /// Description of the set-up.
    pub set_up: &'static str,
    /// Behaviour of the engine.
    pub answer: Answer,
    /// Limit of the range.
    pub limit: &'static str,
    /// Tests that cover other aspects.
    pub also: &'static str,
    pub(super) rows: fn(Length) -> Outcome,
}

/// Result of an extreme.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The extreme.
    pub extreme: Extreme,
    /// Rows, or the reason why there are none.
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
    /// True if every row is within its tolerance.
    pub fn passes(&self) -> bool {
        self.rows.as_ref().is_ok_and(|rows| !rows.is_empty() && rows.iter().all(Row::passes))
    }
}

/// The rows of a case of the verification report.
pub(super) fn rows_of(case: &str) -> Outcome {
    let case = find(case).ok_or_else(|| Failure::from(format!("there is no case {case}")))?;
    (case.rows)()
}
