//! Report of the removed primitives and the saving.

use super::trim::{Gone, ModelTrimmed, RunTrimmed, Trimmed};
use pong_model::printable;
use pong_report::table;
use std::fmt::Write as _;

/// Most primitives of a model that are listed one by one.
const GONE_TOLD: usize = 12;

/// The report: for each model the removed primitives and their distances, for each run the saving.
pub fn page(trimmed: &Trimmed) -> String {
    let mut out = format!(
        "What came no nearer than {} m to any partner goes. Of every frame the wrenches are the same bits.\n",
        trimmed.margin
    );
    trimmed.models.iter().for_each(|model| out += &model_page(model));
    trimmed.runs.iter().for_each(|run| out += &run_page(run));
    out
}

fn model_page(model: &ModelTrimmed) -> String {
    let name = printable(&model.name);
    let Some(written) = &model.written else {
        return format!(
            "\n## {name}\n\nAll {} primitives came near; {} stays.\n",
            model.primitives,
            model.file.display()
        );
    };
    let [before, after] = model.volumes;
    let mut out = format!(
        "\n## {name}\n\n{} of {} primitives go, and {} of {before} bounding volumes. {} is written.\n\n",
        model.gone.len(),
        model.primitives,
        before.saturating_sub(after),
        written.display()
    );
    let mut gone: Vec<&Gone> = model.gone.iter().collect();
    gone.sort_by(|a, b| a.nearest.total_cmp(&b.nearest));
    let rows: Vec<Vec<String>> = gone
        .iter()
        .take(GONE_TOLD)
        .map(|gone| vec![printable(&gone.path).to_string(), distance(gone.nearest)])
        .collect();
    out += &table::markdown(&["goes", "came no nearer than, m"], &rows);
    if gone.len() > GONE_TOLD {
        let _ = writeln!(out, "\nand {} that stayed farther away.", gone.len() - GONE_TOLD);
    }
    out
}

fn distance(metres: f64) -> String {
    if metres.is_infinite() { "has no partner".to_owned() } else { format!("{metres:.3}") }
}

fn run_page(run: &RunTrimmed) -> String {
    let mut out = format!("\n## {}\n\n{} frames compared.\n\n", printable(&run.name), run.frames);
    let medians = run.times_ns.each_ref().map(|times| median_us(times));
    let per_frame = |sum: fn(&crate::runs::Counts) -> u64| {
        run.counts.each_ref().map(|counts| sum(counts) as f64 / counts.frames.max(1) as f64)
    };
    let rows = [
        row("median frame, µs", medians),
        row("tests of bounds per frame", per_frame(|counts| counts.volumes_tested()[0])),
        row("pairs of leaves", per_frame(|counts| counts.leaf_pairs)),
        row("boxes below leaves, by eight", per_frame(|counts| counts.boxes)),
        row("contact tests", per_frame(|counts| counts.primitives_tested()[0])),
    ];
    out += &table::markdown(&["", "before", "after", "×"], &rows);
    let unused: Vec<String> = run
        .testers
        .iter()
        .filter(|(_, [before, after])| *before > 0 && *after == 0)
        .map(|((a, b), _)| format!("{a}–{b}"))
        .collect();
    if !unused.is_empty() {
        let _ = writeln!(out, "\nContact testers that nothing needs any more: {}.", unused.join(", "));
    }
    out
}

fn row(name: &str, [before, after]: [f64; 2]) -> Vec<String> {
    let ratio = if before > 0.0 { format!("{:.3}", after / before) } else { "–".to_owned() };
    vec![name.to_owned(), format!("{before:.2}"), format!("{after:.2}"), ratio]
}

fn median_us(times_ns: &[u64]) -> f64 {
    let mut sorted = times_ns.to_vec();
    sorted.sort_unstable();
    sorted.get(sorted.len() / 2).map_or(0.0, |ns| *ns as f64 * 1e-3)
}
