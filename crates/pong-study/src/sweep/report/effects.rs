//! Effects of single levers: levels that differ from one level in one lever.

use super::numbers::{digits, percent};
use crate::sweep::level::{Level, Lever, Motion};
use crate::sweep::study::{Place, Row, Study};
use pong_executive::Integrator;
use pong_report::table;

/// A table for the scene as written, and one for the level that is cheapest by calls within the tolerance.
pub(super) fn effects(study: &Study) -> String {
    let mut text = section(
        study,
        study.plan.base,
        if study.is_log() { "the log as recorded" } else { "the scene as written" },
    );
    if let Some(second) = study.second.filter(|second| *second != study.plan.base) {
        text += &section(study, second, "the fewest calls within the tolerance");
    }
    text
}

fn section(study: &Study, anchor: usize, what: &str) -> String {
    let base = &study.rows[anchor];
    let mut rows: Vec<(Lever, &Row)> =
        study.rows.iter().filter_map(|row| Some((differs(study, anchor, row)?, row))).collect();
    rows.sort_by_key(|(lever, _)| *lever);
    if rows.is_empty() {
        return String::new();
    }
    let lines: Vec<Vec<String>> = rows.iter().map(|(lever, row)| line(study, base, *lever, row)).collect();
    let error =
        study.error(base).map_or("it diverges".to_owned(), |error| format!("error {} %", percent(error)));
    format!(
        "\n## One lever at a time, from {what}\n\n{}: {error}.\n\n{}",
        base.name,
        table::markdown(&["lever", "to", "time, ×", "error, %", "bits"], &lines)
    )
}

/// The only lever in which a row differs from another; `None` if there is not exactly one.
fn differs(study: &Study, anchor: usize, row: &Row) -> Option<Lever> {
    let base = &study.rows[anchor].level;
    match row.place {
        Place::Around { anchor: of, lever } => (of == anchor).then_some(lever),
        Place::Grid => {
            let step = row.level.steps_per_frame != base.steps_per_frame;
            let integrator = row.level.motion != base.motion;
            match (step, integrator) {
                (true, false) => Some(Lever::Step),
                (false, true) if is_long(&row.level) != is_long(base) => Some(Lever::LongFrame),
                (false, true) => Some(Lever::Integrator),
                _ => None,
            }
        }
    }
}

fn is_long(level: &Level) -> bool {
    matches!(level.motion, Motion::Integrated(Integrator::LongFrame { .. }))
}

fn line(study: &Study, base: &Row, lever: Lever, row: &Row) -> Vec<String> {
    let to = match lever {
        Lever::Step => row.level.step_name(study.plan.frames.frame_s),
        Lever::Integrator | Lever::LongFrame => crate::sweep::level::motion_name(row.level.motion),
        _ => row.level.settings().into_iter().map(|(_, name)| name).collect::<Vec<_>>().join(", "),
    };
    let time = match (&row.times, &base.times) {
        (Some(own), Some(base)) => digits(own.median_ns() as f64 / base.median_ns().max(1) as f64),
        _ => "–".to_owned(),
    };
    let error = study.error(row).map_or("diverges".to_owned(), percent);
    let bits = study.same_bits(row).map_or("", |same| if same { "same" } else { "NOT THE SAME" });
    vec![lever.name().to_owned(), to, time, error, bits.to_owned()]
}
