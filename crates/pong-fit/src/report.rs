//! The page, the tables and the plot of an identification.

use crate::fit::{Errors, Estimate, Fit};
use crate::intervals::Profile;
use crate::paste::number;
use pong_report::svg::Picture;
use pong_report::table;
use std::io;
use std::path::Path;

/// Writes fit.md, parameters.csv, profiles.csv and fit.svg into a folder, which is made if it is not there.
///
/// # Errors
/// A folder or file that cannot be written.
pub fn write(fit: &Fit, folder: &Path) -> io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let files = [
        ("fit.md", markdown(fit)),
        ("parameters.csv", parameters_csv(fit)),
        ("profiles.csv", profiles_csv(fit)),
        ("fit.svg", plot(fit)),
    ];
    files.iter().try_for_each(|(name, text)| pong_model::files::replace(&folder.join(name), text.as_bytes()))
}

/// The page.
pub fn markdown(fit: &Fit) -> String {
    let mut page = format!("# Parameters of `{}` from measurements\n\n", fit.scene);
    let what = if fit.split_in_time { "the later part of each record" } else { "records that took no part" };
    page += &format!(
        "{} records, {} residuals, {} unknowns with those of the starts, {} runs. The search {}. The test part is {what}.\n\n",
        fit.train[1].records,
        fit.counts.0,
        fit.counts.1,
        fit.runs,
        if fit.converged { "converged" } else { "did **not** converge" },
    );
    page += "## Parameters\n\n";
    page += &parameters(fit);
    page += "\n## Errors\n\nRoot mean squares of the differences to the measurements; `weighted` is in standard deviations of the \
             sensors, 1 if the model is as good as they are.\n\n";
    page += &errors(fit);
    page += "\n## Values within one standard error\n\nThe range in which the mean error of the records is within one standard error \
             of the least, all other parameters fitted again, and the peak contact force over it (median of the records).\n\n";
    page += &one_error(fit);
    page += "\n## Correlations\n\n";
    page += &correlations(fit);
    if !fit.notes.is_empty() {
        page += "\n## Notes\n\n";
        fit.notes.iter().for_each(|note| page += &format!("* {note}\n"));
    }
    page += "\n## To paste\n\n";
    fit.to_paste.iter().for_each(|text| page += &format!("```ron\n{text}\n```\n\n"));
    page += "## Tries\n\n";
    page += &tries(fit);
    page
}

fn interval((low, high): (f64, f64)) -> String {
    format!("{} to {}", number(low), number(high))
}

fn with_unit(one: &Estimate) -> String {
    if one.unit.is_empty() { format!("`{}`", one.name) } else { format!("`{}`, {}", one.name, one.unit) }
}

fn parameters(fit: &Fit) -> String {
    let percent = format!("{} %", number(100.0 * fit.confidence));
    let [profile, bootstrap] = ["profile", "bootstrap"].map(|kind| format!("{kind}, {percent}"));
    let heading = ["parameter", "value", &profile, &bootstrap, "in the scene", "bounds"];
    let row = |one: &Estimate| {
        let ends = |(low, high): (f64, f64)| {
            let mark = |open: bool| if open { " (bound)" } else { "" };
            format!("{}{} to {}{}", number(low), mark(one.open.0), number(high), mark(one.open.1))
        };
        vec![
            with_unit(one),
            if one.moved { number(one.value) } else { "not moved by the data".to_owned() },
            one.profile.map_or_else(|| format!("{} (curvature)", interval(one.linear)), ends),
            one.bootstrap.filter(|_| one.moved).map_or_else(|| "–".to_owned(), interval),
            number(one.in_scene),
            interval(one.bounds),
        ]
    };
    table::markdown(&heading, &fit.parameters.iter().map(row).collect::<Vec<_>>())
}

fn errors(fit: &Fit) -> String {
    let columns = [
        ("fit, scene's values", &fit.train[0]),
        ("fit, values found", &fit.train[1]),
        ("test, scene's values", &fit.test[0]),
        ("test, values found", &fit.test[1]),
    ];
    let mut rows = Vec::new();
    let cell = |errors: &Errors, value: Option<f64>| {
        if errors.records == 0 { "–".to_owned() } else { value.map_or("–".to_owned(), number) }
    };
    for (quantity, _) in &fit.train[1].of {
        let of =
            |errors: &Errors| errors.of.iter().find(|(known, _)| known == quantity).map(|(_, value)| *value);
        let mut row = vec![format!("{}, {}", quantity.name(), quantity.unit())];
        row.extend(columns.iter().map(|(_, errors)| cell(errors, of(errors))));
        rows.push(row);
    }
    let mut weighted = vec!["weighted".to_owned()];
    weighted.extend(columns.iter().map(|(_, errors)| cell(errors, Some(errors.weighted))));
    rows.push(weighted);
    let mut count = vec!["records".to_owned()];
    count.extend(columns.iter().map(|(_, errors)| errors.records.to_string()));
    rows.push(count);
    let mut heading = vec!["quantity"];
    heading.extend(columns.iter().map(|(name, _)| *name));
    table::markdown(&heading, &rows)
}

fn one_error(fit: &Fit) -> String {
    let row = |one: &Estimate| {
        let none = || "–".to_owned();
        vec![
            with_unit(one),
            one.one_error.map_or_else(none, interval),
            one.peak_force.map_or_else(none, interval),
        ]
    };
    let rows: Vec<Vec<String>> = fit.parameters.iter().map(row).collect();
    let mut text = table::markdown(&["parameter", "range", "peak force, N"], &rows);
    text +=
        &format!("\nAt the optimum the median of the peak contact forces is {} N.\n", number(fit.peak_force));
    text
}

fn correlations(fit: &Fit) -> String {
    let mut heading = vec![""];
    let labels: Vec<String> = (1..=fit.parameters.len()).map(|number| number.to_string()).collect();
    heading.extend(labels.iter().map(String::as_str));
    let row = |(place, one): (usize, &Estimate)| {
        let mut row = vec![format!("{} `{}`", place + 1, one.name)];
        row.extend(
            fit.correlations[place]
                .iter()
                .map(|c| if c.is_nan() { "–".to_owned() } else { format!("{c:.3}") }),
        );
        row
    };
    table::markdown(&heading, &fit.parameters.iter().enumerate().map(row).collect::<Vec<_>>())
}

fn tries(fit: &Fit) -> String {
    let list = |values: &[f64]| values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(", ");
    let rows: Vec<Vec<String>> =
        fit.tries.iter().map(|one| vec![list(&one.from), list(&one.to), number(one.weighted)]).collect();
    table::markdown(&["from", "to", "weighted error"], &rows)
}

fn parameters_csv(fit: &Fit) -> String {
    let mut text = "parameter,unit,value,profile_low,profile_high,bootstrap_low,bootstrap_high,one_error_low,one_error_high,\
                    peak_force_low,peak_force_high,in_scene,bound_low,bound_high,moved\n"
        .to_owned();
    for one in &fit.parameters {
        let pair =
            |pair: Option<(f64, f64)>| pair.map_or(",".to_owned(), |(low, high)| format!("{low:?},{high:?}"));
        text += &format!(
            "{},{},{:?},{},{},{},{},{:?},{:?},{:?},{}\n",
            one.name,
            one.unit,
            one.value,
            pair(Some(one.profile.unwrap_or(one.linear))),
            pair(one.bootstrap),
            pair(one.one_error),
            pair(one.peak_force),
            one.in_scene,
            one.bounds.0,
            one.bounds.1,
            one.moved
        );
    }
    text
}

fn profiles_csv(fit: &Fit) -> String {
    let mut text = "parameter,value,rise,threshold,threshold_one_error\n".to_owned();
    for (one, profile) in fit.parameters.iter().zip(&fit.profiles) {
        for (value, rise) in &profile.points {
            let (interval, error) = profile.thresholds;
            text += &format!("{},{value:?},{rise:?},{interval:?},{error:?}\n", one.name);
        }
    }
    text
}

const PANEL: [f64; 2] = [260.0, 190.0];
const MARGIN: f64 = 36.0;

/// The profiles: square root of the rise over the value, a panel for each parameter.
fn plot(fit: &Fit) -> String {
    let count = fit.profiles.len().max(1);
    let columns = count.min(3);
    let rows = count.div_ceil(columns);
    let mut picture = Picture::new(columns as f64 * PANEL[0], rows as f64 * PANEL[1]);
    if fit.profiles.is_empty() {
        picture.text([0.5 * PANEL[0], 0.5 * PANEL[1]], "middle", "no profiles were computed");
    }
    for (place, (one, profile)) in fit.parameters.iter().zip(&fit.profiles).enumerate() {
        let corner = [(place % columns) as f64 * PANEL[0], (place / columns) as f64 * PANEL[1]];
        panel(&mut picture, corner, one, profile);
    }
    picture.finish()
}

fn panel(picture: &mut Picture, [left, top]: [f64; 2], one: &Estimate, profile: &Profile) {
    let root = |rise: f64| rise.max(0.0).sqrt();
    let values = || profile.points.iter().map(|(value, _)| *value);
    let (low, high) = (values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max));
    let highest =
        profile.points.iter().map(|(_, rise)| root(*rise)).fold(root(profile.thresholds.0), f64::max) * 1.05;
    let (width, height) = (PANEL[0] - 1.5 * MARGIN, PANEL[1] - 2.0 * MARGIN);
    let x = |value: f64| left + MARGIN + width * (value - low) / (high - low).max(f64::MIN_POSITIVE);
    let y = |rise: f64| top + MARGIN + height * (1.0 - root(rise) / highest.max(f64::MIN_POSITIVE));
    let (right, bottom) = (left + MARGIN + width, top + MARGIN + height);
    picture.line([left + MARGIN, bottom, right, bottom], "stroke:#444");
    picture.line([left + MARGIN, top + MARGIN, left + MARGIN, bottom], "stroke:#444");
    for (threshold, style) in [
        (profile.thresholds.0, "stroke:#c33;stroke-dasharray:4"),
        (profile.thresholds.1, "stroke:#39c;stroke-dasharray:2"),
    ] {
        if root(threshold) <= highest {
            picture.line([left + MARGIN, y(threshold), right, y(threshold)], style);
        }
    }
    let point = |(value, rise): &(f64, f64)| format!("{:.2} {:.2}", x(*value), y(*rise));
    let path: Vec<String> = profile.points.iter().map(point).collect();
    picture.path(&format!("M{}", path.join(" L")), "fill:none;stroke:#222");
    for (value, rise) in &profile.points {
        picture.circle(
            [x(*value), y(*rise)],
            2.5,
            "fill:#222",
            &format!("{}: rise {}", number(*value), number(*rise)),
        );
    }
    let name =
        one.name.rsplit('.').take(2).collect::<Vec<_>>().into_iter().rev().collect::<Vec<_>>().join(".");
    let title = if one.unit.is_empty() { name } else { format!("{name}, {}", one.unit) };
    picture.text([left + MARGIN + 0.5 * width, top + 0.6 * MARGIN], "middle", &title);
    picture.text([left + MARGIN, bottom + 16.0], "middle", &number(low));
    picture.text([right, bottom + 16.0], "middle", &number(high));
    picture.text_upwards([left + 0.5 * MARGIN, top + MARGIN + 0.5 * height], "√(rise / s²)");
}
