//! Table of extremes, as text and as Markdown for `docs/extremes.md`. No date, duration or machine is
//! recorded.

use super::extreme::{Answer, Finding};
use crate::row::{Bound, Row};
use pong_report::table;
use std::fmt::Write as _;

impl Answer {
    fn word(self) -> &'static str {
        match self {
            Self::Safe => "safe",
            Self::Refused => "refused",
            Self::Told => "reported",
        }
    }
}

/// Ratio of the allowance to the error.
fn margin(row: &Row) -> String {
    /// Above this ratio the error is rounding noise and its digits are not reported.
    const ENOUGH: f64 = 1000.0;
    let times = || row.allowed() / row.error();
    match row.bound {
        _ if !row.passes() => "NONE".to_owned(),
        Bound::Absolute(0.0) => "exact".to_owned(),
        _ if row.allowed() > ENOUGH * row.error() => format!("> {ENOUGH}"),
        _ if times() >= 100.0 => format!("{:.0}", times()),
        _ => format!("{:.1}", times()),
    }
}

/// Aligned lines for a terminal.
pub fn text(findings: &[Finding]) -> String {
    let mut out = String::new();
    for Finding { extreme, rows } in findings {
        let _ = writeln!(out, "{:<4} {:<8} {}", extreme.id, extreme.answer.word(), extreme.asked);
        match rows {
            Err(failure) => {
                let _ = writeln!(out, "       could not be run: {failure}");
            }
            Ok(rows) => rows.iter().for_each(|row| {
                let (unit, allowed) = (row.unit, row.tolerance_text());
                let mark = if row.passes() { "" } else { "  FAILS" };
                let _ = writeln!(
                    out,
                    "       margin {:>7}  {}: {} {unit}, error {}, allowed {allowed}{mark}",
                    margin(row),
                    row.quantity,
                    row.got_text(),
                    row.error_text()
                );
            }),
        }
    }
    out
}

/// Text of `docs/extremes.md`.
pub fn markdown(findings: &[Finding]) -> String {
    let mut out = String::from(HEADER);
    let of = |Finding { extreme, rows }: &Finding| {
        let least = rows.as_ref().ok().and_then(|rows| {
            let share = |row: &Row| row.error() / row.allowed();
            rows.iter().filter(|row| row.allowed() > 0.0).max_by(|a, b| share(a).total_cmp(&share(b)))
        });
        let least = least.map_or("exact".to_owned(), margin);
        let id = format!("[{}](#{})", extreme.id, extreme.id.to_lowercase());
        let answer = extreme.answer.word();
        vec![id, extreme.asked.to_string(), answer.to_owned(), least, extreme.limit.to_string()]
    };
    let rows: Vec<Vec<String>> = findings.iter().map(of).collect();
    out.push('\n');
    let heading = ["", "extreme, and what is asked", "engine", "least margin", "limit"];
    out += &table::markdown_of_prose(&heading, &rows);
    findings.iter().for_each(|finding| section(&mut out, finding));
    out
}

fn section(out: &mut String, Finding { extreme, rows }: &Finding) {
    let text = wrapped(&format!("**{}** {}", extreme.asked, extreme.set_up));
    let _ = writeln!(out, "\n## {}\n\n{text}", extreme.id);
    if !extreme.also.is_empty() {
        let _ = writeln!(out, "\nSee also: {}.", extreme.also);
    }
    match rows {
        Err(failure) => {
            let _ = writeln!(out, "\nCould not be run: {failure}");
        }
        Ok(rows) => {
            let of = |row: &Row| {
                let (got, error, allowed) = (row.got_text(), row.error_text(), row.tolerance_text());
                vec![row.quantity.clone(), row.unit.to_owned(), got, error, allowed, margin(row)]
            };
            let rows: Vec<Vec<String>> = rows.iter().map(of).collect();
            let heading = ["quantity", "unit", "got", "error", "allowed", "margin"];
            out.push('\n');
            *out += &table::markdown_of_prose(&heading, &rows);
        }
    }
}

/// Words of a text in lines of the page's width.
fn wrapped(text: &str) -> String {
    const WIDTH: usize = 118;
    let (mut out, mut width) = (String::new(), 0);
    for word in text.split(' ') {
        let length = word.chars().count();
        if out.is_empty() {
            width = length;
        } else if width + 1 + length <= WIDTH {
            out.push(' ');
            width += 1 + length;
        } else {
            out.push('\n');
            width = length;
        }
        out.push_str(word);
    }
    out
}

const HEADER: &str = "\
# Extremes

This page is for engineers who want to know the range in which the engine is reliable. For each extreme it gives what
the engine does there, what was measured, and the limit. `pong verify --extremes -o docs/extremes.md` writes this file
and `bash ci/extremes` checks it; `--long` runs the soaks with the same code. The file has no dates and nothing about a
machine.

| column | meaning |
|---|---|
| engine: **safe** | it computes as anywhere else |
| engine: **refused** | it says what is wrong, where and what to do, and nothing changes |
| engine: **reported** | it computes what it can and reports that the result is not complete |
| margin | the allowed error divided by the measured error; *exact* where no error is allowed |

The formulas and the allowed errors are in `crates/pong-verify/src/extremes`.
";
