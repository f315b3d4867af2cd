//! The table of results: as text for a terminal, as Markdown for the documentation.
//!
//! The report holds no date, no duration and nothing about a machine: the same engine gives the same file.

use crate::{Row, Verdict};
use std::fmt::Write as _;

const HEADS: [&str; 9] =
    ["case", "quantity", "unit", "expected", "got", "error", "tolerance", "order", "pass"];

fn cells(id: &str, row: &Row) -> [String; 9] {
    [
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
    let mut lines = vec![HEADS.map(str::to_owned)];
    for verdict in verdicts {
        lines.extend(verdict.rows.iter().map(|row| cells(verdict.case.id, row)));
    }
    let widths: [usize; 9] =
        std::array::from_fn(|i| lines.iter().map(|line| line[i].chars().count()).max().unwrap_or(0));
    let mut out = String::new();
    for line in &lines {
        let padded: Vec<String> =
            line.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        let _ = writeln!(out, "{}", padded.join("  ").trim_end());
    }
    for verdict in verdicts {
        if let Some(failure) = &verdict.failure {
            let _ = writeln!(out, "{} could not be run: {failure}", verdict.case.id);
        }
    }
    out
}

/// The report of `docs/verification.md`.
pub fn markdown(verdicts: &[Verdict]) -> String {
    let mut out = String::from(HEADER);
    let passed = verdicts.iter().filter(|verdict| verdict.passes()).count();
    let rows: usize = verdicts.iter().map(|verdict| verdict.rows.len()).sum();
    let _ = writeln!(out, "\n{passed} of {} cases pass ({rows} quantities).", verdicts.len());
    out.push_str("\n| case | about | result |\n|---|---|---|\n");
    for verdict in verdicts {
        let case = &verdict.case;
        let result = if verdict.passes() { "pass" } else { "**FAIL**" };
        let anchor = case.id.to_lowercase();
        let _ = writeln!(out, "| [{}](#{anchor}) | {} | {result} |", case.id, case.title);
    }
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
    let _ = writeln!(out, "| {} |\n|{}", HEADS[1..].join(" | "), "---|".repeat(8));
    for row in &verdict.rows {
        let _ = writeln!(out, "| {} |", cells(case.id, row)[1..].join(" | "));
    }
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
