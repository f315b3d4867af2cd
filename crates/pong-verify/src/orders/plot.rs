//! The curves as a picture: worst error against the step, both logarithmic, a field for each integrator.

use super::{Curve, METHODS};
use std::fmt::Write as _;

const FIELD_WIDTH: f64 = 220.0;
const FIELD_HEIGHT: f64 = 300.0;
/// Between two fields, with room for half a label of each axis.
const GAP: f64 = 48.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 40.0;
const LEGEND: f64 = 20.0;
/// Told apart by the colour-blind too; the second round is dashed, the third dotted.
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
const DASHES: [&str; 3] = ["", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 4\""];

/// A logarithmic axis: decades at its ends and pixels there.
struct Axis {
    decades: [f64; 2],
    pixels: [f64; 2],
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(libm::log10) {
            (low, high) = (low.min(value), high.max(value));
        }
        Self { decades: [libm::floor(low), libm::ceil(high)], pixels }
    }

    fn at(&self, value: f64) -> f64 {
        let [low, high] = self.decades;
        let share = (libm::log10(value) - low) / (high - low);
        self.pixels[0] + share * (self.pixels[1] - self.pixels[0])
    }

    fn ticks(&self) -> impl Iterator<Item = i32> {
        self.decades[0] as i32..=self.decades[1] as i32
    }
}

/// An SVG picture of all curves.
pub fn svg(curves: &[Curve]) -> String {
    let motions: Vec<&str> =
        curves.iter().filter(|curve| curve.method == 0).map(|curve| curve.motion).collect();
    let width = LEFT + 3.0 * (FIELD_WIDTH + GAP);
    let height = TOP + FIELD_HEIGHT + 60.0 + LEGEND * motions.len() as f64;
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
         font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
    );
    let points = |method: Option<usize>| {
        let of = curves.iter().filter(move |curve| method.is_none_or(|method| curve.method == method));
        of.flat_map(|curve| curve.points)
    };
    let errors = Axis::around(points(None).map(|(_, error)| error), [TOP + FIELD_HEIGHT, TOP]);
    for (method, (name, ..)) in METHODS.iter().enumerate() {
        let left = LEFT + (FIELD_WIDTH + GAP) * method as f64;
        let steps = Axis::around(points(Some(method)).map(|(step, _)| step), [left, left + FIELD_WIDTH]);
        text(&mut out, [left, TOP - 12.0], "start", name);
        axes(&mut out, &steps, &errors, method == 0);
        for (index, motion) in motions.iter().enumerate() {
            let curve = curves.iter().find(|curve| curve.method == method && curve.motion == *motion);
            curve.into_iter().for_each(|curve| draw(&mut out, curve, index, &steps, &errors));
        }
    }
    for (index, motion) in motions.iter().enumerate() {
        let y = TOP + FIELD_HEIGHT + 56.0 + LEGEND * index as f64;
        line(&mut out, [LEFT, y - 4.0, LEFT + 40.0, y - 4.0], &style(index));
        text(&mut out, [LEFT + 50.0, y], "start", motion);
    }
    out + "</svg>\n"
}

fn axes(out: &mut String, steps: &Axis, errors: &Axis, labelled: bool) {
    let [left, right] = steps.pixels;
    for decade in errors.ticks() {
        let y = errors.at(libm::exp10(f64::from(decade)));
        line(out, [left, y, right, y], "stroke=\"#ddd\"");
        if labelled && decade % 2 == 0 {
            text(out, [left - 8.0, y + 4.0], "end", &format!("1e{decade}"));
        }
    }
    for decade in steps.ticks() {
        let x = steps.at(libm::exp10(f64::from(decade)));
        line(out, [x, TOP, x, TOP + FIELD_HEIGHT], "stroke=\"#ddd\"");
        text(out, [x, TOP + FIELD_HEIGHT + 18.0], "middle", &format!("1e{decade}"));
    }
    text(out, [0.5 * (left + right), TOP + FIELD_HEIGHT + 34.0], "middle", "step, s");
    if labelled {
        let y = TOP + 0.5 * FIELD_HEIGHT;
        let _ = writeln!(
            out,
            "<text transform=\"translate(18 {y:.0}) rotate(-90)\" text-anchor=\"middle\">worst error, m/s</text>"
        );
    }
}

fn draw(out: &mut String, curve: &Curve, index: usize, steps: &Axis, errors: &Axis) {
    let places: Vec<[f64; 2]> =
        curve.points.iter().map(|(step, error)| [steps.at(*step), errors.at(*error)]).collect();
    for pair in places.windows(2) {
        line(out, [pair[0][0], pair[0][1], pair[1][0], pair[1][1]], &style(index));
    }
    for [x, y] in places {
        let colour = COLOURS[index % COLOURS.len()];
        let _ = writeln!(out, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
    }
}

fn style(index: usize) -> String {
    let dash = DASHES[index / COLOURS.len() % DASHES.len()];
    format!("stroke=\"{}\" stroke-width=\"2\"{dash}", COLOURS[index % COLOURS.len()])
}

fn line(out: &mut String, [x1, y1, x2, y2]: [f64; 4], style: &str) {
    let _ = writeln!(out, "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>");
}

fn text(out: &mut String, [x, y]: [f64; 2], anchor: &str, text: &str) {
    let _ = writeln!(out, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{text}</text>");
}
