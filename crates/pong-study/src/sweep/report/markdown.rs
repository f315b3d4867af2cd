//! The report in Markdown.

use super::effects;
use super::numbers::{digits, microseconds, percent};
use crate::sweep::errors::Quantity;
use crate::sweep::level::seconds;
use crate::sweep::reference::Reference;
use crate::sweep::study::{Answer, Row, Study};
use pong_model::printable;
use pong_report::table;
use std::fmt::Write as _;

/// The whole report: convergence of the reference, every level, the choice, the effect of each lever.
pub fn markdown(study: &Study) -> String {
    let frames = &study.plan.frames;
    let mut page = format!("# Speed against accuracy: {}\n\n", printable(&study.scene));
    let duration = frames.frame_s * frames.count as f64;
    let _ = writeln!(
        page,
        "{} frames of {}, {} in all. A frame time is that of the whole frame, executive included; the shortest of all \
         rounds, frame by frame. Errors are relative to the peak, or to what the reference sums up or travels.\n",
        frames.count,
        seconds(frames.frame_s),
        seconds(duration)
    );
    page += &study.reference.as_ref().map_or_else(|| of_log(study), |checks| reference(study, checks));
    page += &verdict(study);
    page += "\n## Levels, the fastest first\n\n";
    page += &levels(study);
    page += &remarks(study);
    page += &effects::effects(study);
    page
}

/// Basis of comparison for the levels of a log.
fn of_log(study: &Study) -> String {
    let against = match study.apart {
        Some(0.0) => "which gives the log's own wrenches bit for bit".to_owned(),
        Some(apart) => format!(
            "whose wrenches are up to {} % of the peak from the log's own: commits between its frames are not in the log, \
             or another version wrote it",
            percent(apart)
        ),
        None => "which was run earlier".to_owned(),
    };
    format!(
        "## The reference\n\nThe engine at every frame of the log with the log's models, {against}. The motions are those of \
         the log at every level: no error grows by itself here, and none is damped.\n"
    )
}

fn reference(study: &Study, reference: &Reference) -> String {
    let step = seconds(study.plan.frames.frame_s / f64::from(reference.steps_per_frame));
    let mut text =
        format!("## The reference\n\nRK4 at {step}, checked against steps twice and four times as long.\n\n");
    let rows: Vec<Vec<String>> = Quantity::ALL
        .iter()
        .map(|quantity| {
            let check = reference.of(*quantity);
            let order = check.order.map_or("rounding".to_owned(), |order| format!("{order:.2}"));
            vec![quantity.name().to_owned(), order, percent(check.error)]
        })
        .collect();
    text += &table::markdown(&["quantity", "observed order", "estimated error, %"], &rows);
    text
}

fn verdict(study: &Study) -> String {
    let within = percent(study.within);
    let names: Vec<&str> = study.of.iter().map(|quantity| quantity.name()).collect();
    let names = names.join(", ");
    let uncertainty = percent(study.uncertainty());
    let cheapest = study.cheapest.map(|index| &study.rows[index]);
    let text = match (study.converged, cheapest) {
        (false, _) => format!(
            "**The reference has not converged**: its own error in {names} is about {uncertainty} %, and {within} % cannot be \
             judged by it. No level is named. Give more --refinements or a shorter --frame, ask for less (--within), or \
             for quantities that do converge (--of): after a bounce or a slip that hangs on chance, the path does not."
        ),
        (true, None) => format!(
            "**No level is within {within} %** in {names}. Give a shorter --frame or more --halvings."
        ),
        (true, Some(row)) => {
            let base = &study.rows[study.plan.base];
            let against = match (&row.times, &base.times) {
                (Some(own), Some(base)) => {
                    let ratio = base.median_ns() as f64 / own.median_ns().max(1) as f64;
                    format!(" ({} times as fast as {})", digits(ratio), as_written(study))
                }
                _ => String::new(),
            };
            format!(
                "**The cheapest level within {within} %** in {names}: **{}**{against}. A level counts as within if its error and \
                 that of the reference ({uncertainty} %) together are.",
                printable(&row.name)
            )
        }
    };
    format!("\n{text}\n")
}

fn as_written(study: &Study) -> &'static str {
    if study.is_log() { "every frame with the log's models" } else { "the scene as written" }
}

fn levels(study: &Study) -> String {
    let mut order: Vec<usize> = (0..study.rows.len()).collect();
    order.sort_by_key(|index| {
        let row = &study.rows[*index];
        (row.times.as_ref().map_or(u64::MAX, |times| times.median_ns()), *index)
    });
    let mut heading: Vec<String> = ["level", "calls", "median, µs", "p99, µs"].map(str::to_owned).to_vec();
    heading.extend(shown(study).iter().map(|quantity| format!("{}, %", quantity.name())));
    // The motions of a log are the same at every level.
    heading.extend((!study.is_log()).then(|| "mm".to_owned()));
    heading.push(String::new());
    let heading: Vec<&str> = heading.iter().map(String::as_str).collect();
    let rows: Vec<Vec<String>> = order.iter().map(|index| line(study, *index)).collect();
    table::markdown(&heading, &rows)
}

/// The quantities that have a column.
fn shown(study: &Study) -> &'static [Quantity] {
    if study.is_log() { &Quantity::ALL[..3] } else { &Quantity::ALL }
}

fn line(study: &Study, index: usize) -> Vec<String> {
    let row = &study.rows[index];
    let mut cells = vec![row.name.clone(), row.level.calls_per_frame().to_string()];
    let times = row.times.as_ref();
    cells.push(times.map_or("–".to_owned(), |times| microseconds(times.median_ns())));
    cells.push(times.map_or("–".to_owned(), |times| microseconds(times.tail_ns())));
    match &row.answer {
        Answer::Diverged { .. } => {
            let columns = shown(study).len() + usize::from(!study.is_log());
            cells.extend(std::iter::repeat_n("–".to_owned(), columns));
        }
        Answer::Reached { errors, .. } => {
            cells.extend(shown(study).iter().map(|quantity| percent(errors.of(*quantity))));
            cells.extend((!study.is_log()).then(|| digits(1e3 * errors.position_m)));
        }
    }
    cells.push(marks(study, index, row));
    cells
}

fn marks(study: &Study, index: usize, row: &Row) -> String {
    let mut marks = Vec::new();
    if let Answer::Diverged { time_s } = row.answer {
        marks.push(format!("diverged at {}", seconds(time_s)));
    }
    if let Answer::Reached { incomplete: 1.., .. } = row.answer {
        marks.push("contacts missing".to_owned());
    }
    if study.same_bits(row) == Some(false) {
        marks.push("NOT THE SAME BITS".to_owned());
    }
    if index == study.plan.base {
        marks.push("as written".to_owned());
    }
    if row.on_front {
        marks.push("front".to_owned());
    }
    if study.cheapest == Some(index) {
        marks.push("cheapest within".to_owned());
    }
    marks.join(", ")
}

fn remarks(study: &Study) -> String {
    let mut text = String::from(
        "\n*calls*: how often a frame asks the engine. *front*: no level is both as fast and as accurate.",
    );
    if !study.is_log() {
        text += " *mm*: the greatest distance of a body from its place at the end of the reference.";
    }
    text.push('\n');
    let reached = |row: &&Row| row.times.is_some();
    let spread = study.rows.iter().filter(reached).filter_map(|row| row.times.as_ref());
    let spread = spread.map(|times| times.spread()).fold(0.0, f64::max);
    let _ = writeln!(
        text,
        "Between rounds the median of a level differed by {} % at most; the shortest of all rounds, which the table has, differs \
         less. Levels that are the same but for a lever that does nothing here show by how much.",
        percent(spread)
    );
    text
}
