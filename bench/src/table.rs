//! Markdown tables that are also readable in a terminal.

use crate::timing::{Clock, Times, digits};
use std::fmt;

/// Rows of cells under a head.
pub struct Table {
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these columns.
    pub fn new(head: &[&str]) -> Self {
        Self { rows: vec![head.iter().map(|&cell| cell.to_owned()).collect()] }
    }

    /// Adds a row.
    pub fn row(&mut self, cells: impl IntoIterator<Item = String>) {
        self.rows.push(cells.into_iter().collect());
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let cell = |row: &[String], column: usize| row.get(column).cloned().unwrap_or_default();
        let width = |column| self.rows.iter().map(|row| cell(row, column).chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        for (number, row) in self.rows.iter().enumerate() {
            for (column, &width) in widths.iter().enumerate() {
                write!(f, "| {:<width$} ", cell(row, column))?;
            }
            writeln!(f, "|")?;
            if number == 0 {
                widths.iter().try_for_each(|&width| write!(f, "|{}", "-".repeat(width + 2)))?;
                writeln!(f, "|")?;
            }
        }
        Ok(())
    }
}

/// Shortest and median pass: `20.1 / 20.9`, in units of `unit` seconds; a dash for contenders that did not
/// run.
pub fn min_and_median(times: Option<&Times>, clock: Clock, unit: f64) -> String {
    let told = |times: &Times| {
        format!("{} / {}", digits(times.min(clock) / unit), digits(times.median(clock) / unit))
    };
    times.map_or("–".to_owned(), told)
}

/// Text of a value, or a dash.
pub fn or_dash(value: Option<impl fmt::Display>) -> String {
    value.map_or("–".to_owned(), |value| value.to_string())
}

/// Target for a number that is not a time, and whether it is reached.
pub fn at_most(wanted: f64, value: f64) -> String {
    ratio_at_most(wanted, Some([value; 2]))
}

/// Target for a ratio of times, and the verdict: `≤ 2.00, reached`, `≤ 2.00, missed 1.3 times`. Given the
/// ratios of two halves of the rounds: if one half reaches the target and the other misses it, the verdict is
/// `at the limit`, since another run may decide either way.
pub fn ratio_at_most(wanted: f64, halves: Option<[f64; 2]>) -> String {
    let wanted_text = digits(wanted);
    match halves {
        None => format!("≤ {wanted_text}"),
        Some([_, worse]) if worse <= wanted => format!("≤ {wanted_text}, reached"),
        Some([better, _]) if better <= wanted => format!("≤ {wanted_text}, at the limit"),
        Some([better, _]) => format!("≤ {wanted_text}, missed {} times", digits(better / wanted)),
    }
}

/// As [`ratio_at_most`], for ratios where more is better.
pub fn ratio_at_least(wanted: f64, halves: Option<[f64; 2]>) -> String {
    let inverse = ratio_at_most(1.0 / wanted, halves.map(|[less, more]| [1.0 / more, 1.0 / less]));
    let (_, verdict) = inverse.split_once(", ").unwrap_or_default();
    format!("≥ {}, {verdict}", digits(wanted))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_turn_at_the_target() {
        assert_eq!(at_most(2.0, 2.0), "≤ 2.00, reached");
        assert_eq!(ratio_at_most(2.0, Some([3.0, 4.0])), "≤ 2.00, missed 1.50 times");
        assert_eq!(ratio_at_most(2.0, Some([1.9, 2.1])), "≤ 2.00, at the limit");
        assert_eq!(ratio_at_least(1.9, Some([1.9, 2.0])), "≥ 1.90, reached");
        assert_eq!(ratio_at_least(1.9, Some([0.9, 0.95])), "≥ 1.90, missed 2.00 times");
    }
}
