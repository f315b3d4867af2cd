//! Intervals between successive measurements, and what the checks of them found.

use super::record::{Record, Row};

/// Result of the checks: each line has thing, cause and cure.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Checked {
    /// Faults: the data cannot be used as they are.
    pub faults: Vec<String>,
    /// Notes.
    pub notes: Vec<String>,
}

/// Two successive measurements of a body, and the time between them, s.
pub(super) type Interval<'a> = (&'a Row, &'a Row, f64);

/// Intervals of a body in a record, in the order of time.
pub(super) fn intervals<'a>(record: &'a Record, body: &'a str) -> impl Iterator<Item = Interval<'a>> {
    let of_body = move || record.rows.iter().filter(move |row| row.body == body);
    of_body().zip(of_body().skip(1)).map(|(a, b)| (a, b, record.times[b.time] - record.times[a.time]))
}

/// Median; not-a-number without values.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
