//! Line plots with logarithmic axes, side by side in one SVG file.

use std::fmt::Write as _;

/// One plot.
pub struct Panel {
    /// Label of the x axis.
    pub x: &'static str,
    /// Lines: a name, then points (x, y), both above zero.
    pub lines: Vec<(String, Vec<(f64, f64)>)>,
}

const WIDTH: f64 = 300.0;
const HEIGHT: f64 = 220.0;
/// Margins left of, above and below each plot.
const MARGIN: (f64, f64, f64) = (58.0, 26.0, 46.0);
/// Room below for the names of the lines.
const LEGEND: f64 = 18.0;
/// Colours that are distinguishable with red-green colour blindness.
const COLORS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// All panels in one SVG file; `y` is the label of the y axis.
pub fn svg(panels: &[Panel], y: &str) -> String {
    let (left, above, below) = MARGIN;
    let names = panels.iter().map(|panel| panel.lines.len()).max().unwrap_or(0) as f64;
    let size = (panels.len() as f64 * (WIDTH + left) + 10.0, above + HEIGHT + below + names * LEGEND);
    let mut out = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {0} {1}\" \
         font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        size.0, size.1
    );
    for (number, panel) in panels.iter().enumerate() {
        let shift = left + number as f64 * (WIDTH + left);
        writeln!(out, "<g transform=\"translate({shift},{above})\">").expect("memory takes all");
        panel.draw(&mut out, y);
        out += "</g>\n";
    }
    out + "</svg>\n"
}

/// A logarithmic axis of some length.
struct Axis {
    low: f64,
    high: f64,
    length: f64,
}

impl Axis {
    /// Axis between powers of ten, or of two where that suffices.
    fn around(values: impl Iterator<Item = f64> + Clone, length: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min).log10();
        let high = values.fold(0.0, f64::max).log10();
        let step = if high - low > 1.5 { 1.0 } else { 2_f64.log10() };
        let (low, high) = ((low / step - 0.05).floor() * step, (high / step + 0.05).ceil() * step);
        Self { low, high: high.max(low + step), length }
    }

    /// Axis from the least value to the greatest, with a margin.
    fn between(values: impl Iterator<Item = f64> + Clone, length: f64) -> Self {
        let low = values.clone().fold(f64::INFINITY, f64::min).log10();
        let high = values.fold(0.0, f64::max).log10();
        let room = 0.05 * (high - low).max(0.1);
        Self { low: low - room, high: high + room, length }
    }

    fn at(&self, value: f64) -> f64 {
        (value.log10() - self.low) / (self.high - self.low) * self.length
    }

    fn ticks(&self) -> Vec<f64> {
        let factor: f64 = if self.high - self.low > 2.0 { 10.0 } else { 2.0 };
        let step = factor.log10();
        let first = (self.low / step - 1e-6).ceil() as i32;
        let last = (self.high / step + 1e-6).floor() as i32;
        (first..=last).map(|power| factor.powi(power)).collect()
    }
}

fn label(value: f64) -> String {
    match value {
        v if v >= 1e6 => format!("{:.0}M", v / 1e6),
        v if v >= 1e3 => format!("{:.0}k", v / 1e3),
        v => format!("{v}"),
    }
}

impl Panel {
    fn draw(&self, out: &mut String, y_name: &str) {
        let points = || self.lines.iter().flat_map(|(_, points)| points);
        let x = Axis::between(points().map(|p| p.0), WIDTH - 20.0);
        let y = Axis::around(points().map(|p| p.1), HEIGHT);
        let right = x.length;
        let mut line = |text: String| {
            out.push_str(&text);
            out.push('\n');
        };
        for tick in x.ticks() {
            let at = x.at(tick);
            line(format!("<path d=\"M{at:.1} 0V{HEIGHT}\" stroke=\"#ddd\"/>"));
            let below = HEIGHT + 14.0;
            line(format!("<text x=\"{at:.1}\" y=\"{below}\" text-anchor=\"middle\">{}</text>", label(tick)));
        }
        for tick in y.ticks() {
            let at = HEIGHT - y.at(tick);
            line(format!("<path d=\"M0 {at:.1}H{right}\" stroke=\"#ddd\"/>"));
            let text = at + 4.0;
            line(format!("<text x=\"-6\" y=\"{text:.1}\" text-anchor=\"end\">{}</text>", label(tick)));
        }
        line(format!(
            "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            0.5 * right,
            HEIGHT + 30.0,
            self.x
        ));
        line(format!("<text x=\"-40\" y=\"-10\">{y_name}</text>"));
        for (number, (name, points)) in self.lines.iter().enumerate() {
            let color = COLORS[number % COLORS.len()];
            let place = |p: &(f64, f64)| format!("{:.1},{:.1}", x.at(p.0), HEIGHT - y.at(p.1));
            let path = points.iter().map(place).collect::<Vec<_>>();
            line(format!(
                "<polyline points=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.6\"/>",
                path.join(" ")
            ));
            for point in &path {
                let (cx, cy) = point.split_once(',').unwrap_or_default();
                line(format!("<circle cx=\"{cx}\" cy=\"{cy}\" r=\"2.5\" fill=\"{color}\"/>"));
            }
            let at = HEIGHT + 48.0 + number as f64 * LEGEND;
            line(format!("<path d=\"M0 {0}H18\" stroke=\"{color}\" stroke-width=\"2\"/>", at - 4.0));
            line(format!("<text x=\"24\" y=\"{at}\">{name}</text>"));
        }
    }
}
