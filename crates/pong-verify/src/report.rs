//! Table of results, as text for a terminal and as Markdown for the documentation.
//!
//! The report contains no date, duration or machine: the same engine gives the same file.

use crate::case::Verdict;
use crate::row::Row;
use pong_report::table;
use std::fmt::{self, Write as _};

const HEADS: [&str; 9] =
    ["case", "quantity", "unit", "expected", "got", "error", "tolerance", "order", "pass"];

fn cells(id: &str, row: &Row) -> Vec<String> {
    vec![
        id.to_owned(),
        row.quantity.clone(),
        row.unit.to_owned(),
        row.expected_text(),
        row.got_text(),
        row.error_text(),
        row.tolerance_text(),
        row.order_text(),
        if row.passes() { "yes" } else { "NO" }.to_owned(),
    ]
}

/// The table as aligned text.
pub fn text(verdicts: &[Verdict]) -> String {
    let of =
        |verdict: &'_ Verdict| verdict.rows.iter().map(|row| cells(verdict.case.id, row)).collect::<Vec<_>>();
    let rows: Vec<Vec<String>> = verdicts.iter().flat_map(of).collect();
    let mut out = table::aligned_left(&HEADS, &rows);
    for verdict in verdicts {
        if let Some(failure) = &verdict.failure {
            let _ = writeln!(out, "{} could not be run: {failure}", verdict.case.id);
        }
    }
    out
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&text(std::slice::from_ref(self)))
    }
}

/// Text of `docs/verification.md`.
pub fn markdown(verdicts: &[Verdict]) -> String {
    let mut out = String::from(HEADER);
    let passed = verdicts.iter().filter(|verdict| verdict.passes()).count();
    let rows: usize = verdicts.iter().map(|verdict| verdict.rows.len()).sum();
    let _ = writeln!(out, "\n{passed} of {} cases pass ({rows} quantities).", verdicts.len());
    let of = |verdict: &Verdict| {
        let case = &verdict.case;
        let result = if verdict.passes() { "pass" } else { "**FAIL**" };
        vec![format!("[{}](#{})", case.id, case.id.to_lowercase()), case.title.to_owned(), result.to_owned()]
    };
    let rows: Vec<Vec<String>> = verdicts.iter().map(of).collect();
    out.push('\n');
    out += &table::markdown_of_prose(&["case", "about", "result"], &rows);
    for verdict in verdicts {
        section(&mut out, verdict);
    }
    out
}

fn section(out: &mut String, verdict: &Verdict) {
    let case = &verdict.case;
    let _ = writeln!(out, "\n## {}\n", case.id);
    let _ = writeln!(out, "**{}.** {}\n\nSource: {}\n", case.title, case.set_up, case.source);
    if let Some(failure) = &verdict.failure {
        let _ = writeln!(out, "Could not be run: {failure}");
        return;
    }
    let rows: Vec<Vec<String>> = verdict.rows.iter().map(|row| cells(case.id, row)[1..].to_vec()).collect();
    *out += &table::markdown_of_prose(&HEADS[1..], &rows);
}

const HEADER: &str = "\
# Verification report

Cases with known answers, run along the whole path: model file → engine → wrench → integrator. Expected values
follow from the closed form or reference named with each case and are computed without the engine.
`pong verify -o docs/verification.md` writes this file; a test keeps it current. It holds no dates and nothing about
the machine: the same source gives the same file.

*Error* is relative where the tolerance is marked `rel.`, otherwise in the unit of the quantity; `< x` stands for
what is a thousand times below the tolerance. *Order* is the order in the step, observed by halving it. The models
are in `models/verification`, the code of each case in `crates/pong-verify/src/cases`. g = 9.81 m/s².
";
