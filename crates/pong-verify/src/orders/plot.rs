//! Plot of the curves: largest error against the step, log-log, one panel per integrator.

use super::{Curve, METHODS};
use pong_report::svg::{COLOURS, LogAxis, Picture};

const FIELD_WIDTH: f64 = 220.0;
const FIELD_HEIGHT: f64 = 300.0;
/// Distance between two panels, with room for half a label of each axis.
const GAP: f64 = 48.0;
const LEFT: f64 = 70.0;
const TOP: f64 = 40.0;
const LEGEND: f64 = 20.0;
/// The second cycle of colours is dashed, the third dotted.
const DASHES: [&str; 3] = ["", " stroke-dasharray=\"7 4\"", " stroke-dasharray=\"2 4\""];

/// An SVG picture of all curves.
pub fn svg(curves: &[Curve]) -> String {
    let motions: Vec<&str> =
        curves.iter().filter(|curve| curve.method == 0).map(|curve| curve.motion).collect();
    let width = LEFT + 3.0 * (FIELD_WIDTH + GAP);
    let height = TOP + FIELD_HEIGHT + 60.0 + LEGEND * motions.len() as f64;
    let mut out = Picture::new(width, height);
    let points = |method: Option<usize>| {
        let of = curves.iter().filter(move |curve| method.is_none_or(|method| curve.method == method));
        of.flat_map(|curve| curve.points)
    };
    let errors = LogAxis::around(points(None).map(|(_, error)| error), [TOP + FIELD_HEIGHT, TOP]);
    for (method, (name, ..)) in METHODS.iter().enumerate() {
        let left = LEFT + (FIELD_WIDTH + GAP) * method as f64;
        let steps = LogAxis::around(points(Some(method)).map(|(step, _)| step), [left, left + FIELD_WIDTH]);
        out.text([left, TOP - 12.0], "start", name);
        axes(&mut out, &steps, &errors, method == 0);
        for (index, motion) in motions.iter().enumerate() {
            let curve = curves.iter().find(|curve| curve.method == method && curve.motion == *motion);
            curve.into_iter().for_each(|curve| draw(&mut out, curve, index, &steps, &errors));
        }
    }
    for (index, motion) in motions.iter().enumerate() {
        let y = TOP + FIELD_HEIGHT + 56.0 + LEGEND * index as f64;
        out.line([LEFT, y - 4.0, LEFT + 40.0, y - 4.0], &style(index));
        out.text([LEFT + 50.0, y], "start", motion);
    }
    out.finish()
}

fn axes(out: &mut Picture, steps: &LogAxis, errors: &LogAxis, labelled: bool) {
    let [left, right] = steps.pixels;
    for decade in errors.ticks() {
        let y = errors.at(libm::exp10(f64::from(decade)));
        out.line([left, y, right, y], "stroke=\"#ddd\"");
        if labelled && decade % 2 == 0 {
            out.text([left - 8.0, y + 4.0], "end", &format!("1e{decade}"));
        }
    }
    for decade in steps.ticks() {
        let x = steps.at(libm::exp10(f64::from(decade)));
        out.line([x, TOP, x, TOP + FIELD_HEIGHT], "stroke=\"#ddd\"");
        out.text([x, TOP + FIELD_HEIGHT + 18.0], "middle", &format!("1e{decade}"));
    }
    out.text([0.5 * (left + right), TOP + FIELD_HEIGHT + 34.0], "middle", "step, s");
    if labelled {
        let y = TOP + 0.5 * FIELD_HEIGHT;
        out.text_upwards([18.0, y], "worst error, m/s");
    }
}

fn draw(out: &mut Picture, curve: &Curve, index: usize, steps: &LogAxis, errors: &LogAxis) {
    let places: Vec<[f64; 2]> =
        curve.points.iter().map(|(step, error)| [steps.at(*step), errors.at(*error)]).collect();
    for pair in places.windows(2) {
        out.line([pair[0][0], pair[0][1], pair[1][0], pair[1][1]], &style(index));
    }
    for [x, y] in places {
        out.circle([x, y], 3.0, &format!("fill=\"{}\"", COLOURS[index % COLOURS.len()]), "");
    }
}

fn style(index: usize) -> String {
    let dash = DASHES[index / COLOURS.len() % DASHES.len()];
    format!("stroke=\"{}\" stroke-width=\"2\"{dash}", COLOURS[index % COLOURS.len()])
}
