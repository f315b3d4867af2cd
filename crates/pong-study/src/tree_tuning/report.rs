//! Report of the times before and after.

use crate::runs::counts::Counts;
use crate::tree_tuning::tune::{RunTuned, Tuned};
use pong_model::printable;
use pong_report::table;
use std::fmt::Write as _;
use std::path::Path;

/// Most refused proposals that are listed one by one.
const REFUSED_TOLD: usize = 5;

/// The report: each run before and after, the changes of each model, and how to use it.
pub fn page(tuned: &Tuned) -> String {
    let mut out = String::new();
    for run in &tuned.runs {
        let _ = writeln!(out, "# {}\n\n{}\n", printable(&run.name), compared(run));
        out += &before_and_after(run, tuned.models.iter().any(|model| !model.changes.is_empty()));
        out.push('\n');
    }
    out += &verdict(tuned);
    for model in &tuned.models {
        out += &changes(tuned, model);
    }
    if !tuned.refused.is_empty() {
        let _ = writeln!(out, "\nThrown away, since a model may not change an answer:\n");
        tuned.refused.iter().take(REFUSED_TOLD).for_each(|line| {
            let _ = writeln!(out, "* {}", printable(line));
        });
        if tuned.refused.len() > REFUSED_TOLD {
            let _ = writeln!(out, "* and {} more", tuned.refused.len() - REFUSED_TOLD);
        }
    }
    out
}

fn compared(run: &RunTuned) -> String {
    let mut text = format!(
        "{} frames, every one compared bit by bit; {} of them, spread over the run, timed.",
        run.frames,
        run.times_ns[0].len()
    );
    if run.limited > 0 {
        let _ = write!(
            text,
            " In {} frames a limit left contacts out; which may hang on bounds and leaves. Raise the contact capacity.",
            run.limited
        );
    }
    text
}

fn verdict(tuned: &Tuned) -> String {
    let noise = percent(tuned.noise);
    let [compared, timed] = tuned.tried;
    let tried = format!("{compared} proposals were compared, {timed} of them timed.");
    if tuned.taken {
        let gain = percent(tuned.gain);
        return format!(
            "**{gain} less time** for the same bits; the same models timed twice differ by {noise}. {tried}\n"
        );
    }
    format!(
        "The models are as good as this finds: nothing is faster by more than 1 % and twice the noise, which is {noise}. \
         Nothing was written. {tried}\n"
    )
}

fn changes(tuned: &Tuned, model: &crate::tree_tuning::ModelTuned) -> String {
    let Some(written) = &model.written else {
        let words = if tuned.taken { "stays as it is" } else { return String::new() };
        return format!("\n## {}\n\n{} {words}.\n", printable(&model.name), model.file.display());
    };
    let mut out = format!("\n## {}\n\n{} is written. In it:\n\n", printable(&model.name), written.display());
    model.changes.iter().for_each(|line| {
        let _ = writeln!(out, "* {}", printable(line));
    });
    let name = |path: &Path| path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let _ = writeln!(
        out,
        "\nTo use it, load `{}` instead of `{}`: all names and paths are the same, contact state fits both.",
        name(written),
        name(&model.file)
    );
    out
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

fn before_and_after(run: &RunTuned, changed: bool) -> String {
    let mut rows = Vec::new();
    let times = run.times_ns.each_ref().map(|times| Times::of(times));
    let mut time = |name: &str, value: &dyn Fn(&Times) -> f64| {
        let [before, again, after] = times.each_ref().map(value);
        rows.push(row(name, [before, again], after));
    };
    time("median frame, µs", &|times| times.median);
    time("99th percentile, µs", &|times| times.tail);
    time("mean, µs", &|times| times.mean);
    let [before, after] = &run.counts;
    let mut add = |name: &str, value: &dyn Fn(&Counts) -> u64| {
        let mean = |counts: &Counts| value(counts) as f64 / counts.frames.max(1) as f64;
        rows.push(row(name, [mean(before), f64::NAN], mean(after)));
    };
    add("tests of bounds per frame", &|counts| counts.volumes_tested()[0]);
    add("of which apart", &|counts| counts.volumes_tested()[0] - counts.volumes_tested()[1]);
    let kinds: std::collections::BTreeSet<_> =
        before.volumes.keys().chain(after.volumes.keys()).copied().collect();
    for kind in kinds {
        let name = format!("{} × {}", kind.0, kind.1);
        add(&name, &|counts| counts.volumes.get(&kind).map_or(0, |tally| tally[0]));
    }
    add("pairs of leaves", &|counts| counts.leaf_pairs);
    add("boxes below leaves, by eight", &|counts| counts.boxes);
    add("contact tests", &|counts| counts.primitives_tested()[0]);
    if !changed {
        rows.iter_mut().for_each(|row| row[3..].fill("–".to_owned()));
    }
    table::markdown(&["", "before", "again", "after", "×"], &rows)
}

fn row(name: &str, [before, again]: [f64; 2], after: f64) -> Vec<String> {
    let ratio = if before > 0.0 { format!("{:.3}", after / before) } else { "–".to_owned() };
    let again = if again.is_nan() { "".to_owned() } else { number(again) };
    vec![name.to_owned(), number(before), again, number(after), ratio]
}

/// Three digits, or all digits before the point if there are more.
fn number(value: f64) -> String {
    match value {
        0.0 => "0".to_owned(),
        v if v < 10.0 => format!("{v:.2}"),
        v if v < 100.0 => format!("{v:.1}"),
        v => format!("{v:.0}"),
    }
}

struct Times {
    median: f64,
    tail: f64,
    mean: f64,
}

impl Times {
    fn of(times_ns: &[u64]) -> Self {
        let mut sorted = times_ns.to_vec();
        sorted.sort_unstable();
        let last = sorted.len().saturating_sub(1);
        let at = |share: f64| {
            sorted.get(libm::round(share * last as f64) as usize).map_or(0.0, |ns| *ns as f64 * 1e-3)
        };
        let mean = sorted.iter().sum::<u64>() as f64 * 1e-3 / sorted.len().max(1) as f64;
        Self { median: at(0.5), tail: at(0.99), mean }
    }
}
