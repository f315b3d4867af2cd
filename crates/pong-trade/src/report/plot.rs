//! The plot: median frame time against the worst error, both logarithmic.

use crate::level::motion_name;
use crate::study::{Place, Row, Study};
use std::fmt::Write as _;

const WIDTH: f64 = 860.0;
const HEIGHT: f64 = 520.0;
/// Left, top, right, bottom of the field.
const FIELD: [f64; 4] = [80.0, 56.0, 640.0, 460.0];
/// Told apart by the colour-blind too, and on light and dark ground.
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
/// Errors below are drawn here: 1e-6 %.
const FLOOR: f64 = 1e-8;

/// What is drawn of a row.
struct Dot<'a> {
    row: &'a Row,
    time_us: f64,
    error: f64,
    colour: usize,
    cheapest: bool,
}

/// A logarithmic axis.
struct Axis {
    /// Exponents of ten at its ends.
    from: f64,
    to: f64,
    /// Pixels at its ends.
    start: f64,
    end: f64,
}

impl Axis {
    /// Around all values, by whole decades.
    fn around(values: impl Iterator<Item = f64>, start: f64, end: f64) -> Self {
        let logs: Vec<f64> = values.map(libm::log10).collect();
        let least = logs.iter().copied().fold(f64::INFINITY, f64::min);
        let most = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if least > most {
            return Self { from: 0.0, to: 1.0, start, end };
        }
        let (from, to) = (libm::floor(least), libm::ceil(most));
        Self { from, to: to.max(from + 1.0), start, end }
    }

    fn at(&self, value: f64) -> f64 {
        let share = (libm::log10(value) - self.from) / (self.to - self.from);
        self.start + share.clamp(0.0, 1.0) * (self.end - self.start)
    }

    fn decades(&self) -> impl Iterator<Item = f64> {
        (self.from as i32..=self.to as i32).map(|power| libm::exp10(f64::from(power)))
    }
}

/// An SVG picture: a dot for each level, the Pareto front, the tolerance, the reference's own error.
pub fn svg(study: &Study) -> String {
    let dots = dots(study);
    let marks = [study.within].into_iter();
    let x = Axis::around(dots.iter().map(|dot| dot.time_us), FIELD[0], FIELD[2]);
    let y = Axis::around(dots.iter().map(|dot| dot.error).chain(marks), FIELD[3], FIELD[1]);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\" viewBox=\"0 0 {WIDTH} {HEIGHT}\" \
         font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let title =
        format!("{}: time of a frame of {}", study.scene, crate::level::seconds(study.plan.frames.frame_s));
    text(&mut out, FIELD[0], 28.0, "start", &title);
    axes(&mut out, &x, &y);
    lines(&mut out, study, &y);
    front(&mut out, &dots, &x, &y);
    dots.iter().for_each(|dot| draw(&mut out, dot, &x, &y));
    legend(&mut out, study, &dots);
    out + "</svg>\n"
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

fn axes(out: &mut String, x: &Axis, y: &Axis) {
    let [left, top, right, bottom] = FIELD;
    for time in x.decades() {
        let at = x.at(time);
        line(out, [at, top, at, bottom], "#ddd", "");
        text(out, at, bottom + 20.0, "middle", &plain(time));
    }
    for error in y.decades() {
        let at = y.at(error);
        line(out, [left, at, right, at], "#ddd", "");
        text(out, left - 8.0, at + 4.0, "end", &plain(100.0 * error));
    }
    text(out, 0.5 * (left + right), bottom + 44.0, "middle", "median frame time, µs");
    let _ = writeln!(
        out,
        "<text transform=\"translate(22 {:.0}) rotate(-90)\" text-anchor=\"middle\" fill=\"#222\">worst error, %</text>",
        0.5 * (top + bottom)
    );
}

/// A power of ten, with an exponent where it is long.
fn plain(value: f64) -> String {
    if (1e-3..1e6).contains(&value) {
        let text = format!("{value:.3}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{value:.0e}")
}

/// The tolerance, and what the reference may be off itself, if that is within the field.
fn lines(out: &mut String, study: &Study, y: &Axis) {
    let uncertainty = study.uncertainty();
    let own = (uncertainty >= libm::exp10(y.from)).then_some((uncertainty, "the reference's own", "#999"));
    for (error, name, colour) in [(study.within, "tolerance", "#c00")].into_iter().chain(own) {
        let at = y.at(error);
        line(out, [FIELD[0], at, FIELD[2], at], colour, "6 4");
        text(out, FIELD[2] - 4.0, at - 5.0, "end", name);
    }
}

/// Stairs through the front: what is below and to the left of them no level reaches.
fn front(out: &mut String, dots: &[Dot<'_>], x: &Axis, y: &Axis) {
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
    let _ = writeln!(out, "<path d=\"{path}\" fill=\"none\" stroke=\"#222\" stroke-width=\"1.2\"/>");
}

fn draw(out: &mut String, dot: &Dot<'_>, x: &Axis, y: &Axis) {
    let (at_x, at_y, colour) = (x.at(dot.time_us), y.at(dot.error), COLOURS[dot.colour % COLOURS.len()]);
    let fill = if dot.row.place == Place::Grid { colour } else { "none" };
    let title = format!("{}: {:.2} µs, {:.2e} %", dot.row.name, dot.time_us, 100.0 * dot.error);
    let _ = writeln!(
        out,
        "<circle cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"4.5\" fill=\"{fill}\" stroke=\"{colour}\" stroke-width=\"1.5\"><title>{}</title></circle>",
        escaped(&title)
    );
    if dot.cheapest {
        let _ = writeln!(
            out,
            "<circle cx=\"{at_x:.1}\" cy=\"{at_y:.1}\" r=\"9\" fill=\"none\" stroke=\"#c00\" stroke-width=\"2\"/>"
        );
    }
}

fn legend(out: &mut String, study: &Study, dots: &[Dot<'_>]) {
    let (left, mut at) = (FIELD[2] + 24.0, FIELD[1] + 8.0);
    let mut entry = |fill: &str, stroke: &str, radius: f64, name: &str| {
        let _ = writeln!(
            out,
            "<circle cx=\"{left}\" cy=\"{at}\" r=\"{radius}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"1.5\"/>"
        );
        text(out, left + 16.0, at + 4.0, "start", name);
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
    line(out, [left - 8.0, at, left + 8.0, at], "#222", "");
    text(out, left + 16.0, at + 4.0, "start", "Pareto front");
}

fn line(out: &mut String, [x1, y1, x2, y2]: [f64; 4], colour: &str, dashes: &str) {
    let _ = writeln!(
        out,
        "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" stroke=\"{colour}\" stroke-dasharray=\"{dashes}\"/>"
    );
}

fn text(out: &mut String, x: f64, y: f64, anchor: &str, words: &str) {
    let _ = writeln!(
        out,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\" fill=\"#222\">{}</text>",
        escaped(words)
    );
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
