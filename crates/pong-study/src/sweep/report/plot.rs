//! The plot: median frame time against the worst error, both logarithmic.

use crate::sweep::level::motion_name;
use crate::sweep::study::{Place, Row, Study};
use pong_report::svg::{COLOURS, LogAxis, Picture};
use std::fmt::Write as _;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 520.0;
/// Left, top, right and bottom of the plot area.
const FIELD: [f64; 4] = [80.0, 56.0, 640.0, 460.0];
/// Lines of the grid.
const GRID: &str = "stroke=\"#ddd\"";
/// Errors below this are drawn at it: 1e-6 %.
const FLOOR: f64 = 1e-8;

/// A row of the study to draw.
struct Dot<'a> {
    row: &'a Row,
    time_us: f64,
    error: f64,
    colour: usize,
    cheapest: bool,
}

/// An SVG picture: a dot for each level, the Pareto front, the tolerance, the reference's own error.
pub fn svg(study: &Study) -> String {
    let dots = dots(study);
    let marks = [study.within].into_iter();
    let x = LogAxis::around(dots.iter().map(|dot| dot.time_us), [FIELD[0], FIELD[2]]);
    let y = LogAxis::around(dots.iter().map(|dot| dot.error).chain(marks), [FIELD[3], FIELD[1]]);
    let mut out = Picture::new(WIDTH, HEIGHT);
    let title = format!(
        "{}: time of a frame of {}",
        study.scene,
        crate::sweep::level::seconds(study.plan.frames.frame_s)
    );
    out.text([FIELD[0], 28.0], "start", &title);
    axes(&mut out, &x, &y);
    lines(&mut out, study, &y);
    front(&mut out, &dots, &x, &y);
    dots.iter().for_each(|dot| draw(&mut out, dot, &x, &y));
    legend(&mut out, study, &dots);
    out.finish()
}

fn dots(study: &Study) -> Vec<Dot<'_>> {
    let mut seen = Vec::new();
    let mut dots = Vec::new();
    for (index, row) in study.rows.iter().enumerate() {
        let motion = row.level.motion;
        let colour = seen.iter().position(|known| *known == motion).unwrap_or_else(|| {
            seen.push(motion);
            seen.len() - 1
        });
        let (Some(times), Some(error)) = (&row.times, study.error(row)) else { continue };
        let (error, time_us) = (error.clamp(FLOOR, 1e3), times.median_ns().max(1) as f64 / 1e3);
        dots.push(Dot { row, time_us, error, colour, cheapest: study.cheapest == Some(index) });
    }
    dots
}

fn axes(out: &mut Picture, x: &LogAxis, y: &LogAxis) {
    let [left, top, right, bottom] = FIELD;
    for time in x.ticks().map(|power| libm::exp10(f64::from(power))) {
        let at = x.at(time);
        out.line([at, top, at, bottom], GRID);
        out.text([at, bottom + 20.0], "middle", &plain(time));
    }
    for error in y.ticks().map(|power| libm::exp10(f64::from(power))) {
        let at = y.at(error);
        out.line([left, at, right, at], GRID);
        out.text([left - 8.0, at + 4.0], "end", &plain(100.0 * error));
    }
    out.text([0.5 * (left + right), bottom + 44.0], "middle", "median frame time, µs");
    out.text_upwards([22.0, 0.5 * (top + bottom)], "worst error, %");
}

/// A power of ten, with an exponent where it is long.
fn plain(value: f64) -> String {
    if (1e-3..1e6).contains(&value) {
        let text = format!("{value:.3}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{value:.0e}")
}

/// Lines for the tolerance, and for the reference's own error if it is within the plot area.
fn lines(out: &mut Picture, study: &Study, y: &LogAxis) {
    let uncertainty = study.uncertainty();
    let own = (uncertainty >= y.least()).then_some((uncertainty, "the reference's own", "#999"));
    for (error, name, colour) in [(study.within, "tolerance", "#c00")].into_iter().chain(own) {
        let at = y.at(error);
        out.line([FIELD[0], at, FIELD[2], at], &format!("stroke=\"{colour}\" stroke-dasharray=\"6 4\""));
        out.text([FIELD[2] - 4.0, at - 5.0], "end", name);
    }
}

/// Staircase through the front: no level lies below and to the left of it.
fn front(out: &mut Picture, dots: &[Dot<'_>], x: &LogAxis, y: &LogAxis) {
    let mut corners: Vec<[f64; 2]> =
        dots.iter().filter(|dot| dot.row.on_front).map(|dot| [x.at(dot.time_us), y.at(dot.error)]).collect();
    corners.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut path = String::new();
    for (index, [at_x, at_y]) in corners.iter().enumerate() {
        let _ = if index == 0 {
            write!(path, "M{at_x:.1} {at_y:.1}")
        } else {
            write!(path, "H{at_x:.1}V{at_y:.1}")
        };
    }
    out.path(&path, "stroke=\"#222\" stroke-width=\"1.2\"");
}

fn draw(out: &mut Picture, dot: &Dot<'_>, x: &LogAxis, y: &LogAxis) {
    let (at_x, at_y, colour) = (x.at(dot.time_us), y.at(dot.error), COLOURS[dot.colour % COLOURS.len()]);
    let fill = if dot.row.place == Place::Grid { colour } else { "none" };
    let title = format!("{}: {:.2} µs, {:.2e} %", dot.row.name, dot.time_us, 100.0 * dot.error);
    let style = format!("fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"");
    out.circle([at_x, at_y], 4.5, &style, &title);
    if dot.cheapest {
        out.circle([at_x, at_y], 9.0, "fill=\"none\" stroke=\"#c00\" stroke-width=\"2\"", "");
    }
}

fn legend(out: &mut Picture, study: &Study, dots: &[Dot<'_>]) {
    let (left, mut at) = (FIELD[2] + 24.0, FIELD[1] + 8.0);
    let mut entry = |fill: &str, stroke: &str, radius: f64, name: &str| {
        let style = format!("fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"1.5\"");
        out.circle([left, at], radius, &style, "");
        out.text([left + 16.0, at + 4.0], "start", name);
        at += 22.0;
    };
    for (index, colour) in COLOURS.iter().enumerate() {
        if let Some(dot) = dots.iter().find(|dot| dot.colour == index) {
            entry(colour, colour, 4.5, &motion_name(dot.row.level.motion));
        }
    }
    entry("none", "#222", 4.5, "another lever pulled");
    if study.cheapest.is_some() {
        entry("none", "#c00", 8.0, "cheapest within");
    }
    out.line([left - 8.0, at, left + 8.0, at], "stroke=\"#222\"");
    out.text([left + 16.0, at + 4.0], "start", "Pareto front");
}
