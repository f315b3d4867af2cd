//! Plots as SVG text: lines, dots, labels, and logarithmic axes. Lengths are in pixels, y downwards.

use std::fmt::Write as _;

/// Colours that colour-blind readers can distinguish, on light and dark backgrounds.
pub const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

/// An SVG picture being built.
pub struct Picture(String);

impl Picture {
    /// An empty white picture.
    pub fn new(width: f64, height: f64) -> Self {
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{width}\" height=\"{height}\" \
             font-family=\"sans-serif\" font-size=\"13\" fill=\"#222\">\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
        ))
    }

    /// A line between two points, with attributes of its stroke.
    pub fn line(&mut self, [x1, y1, x2, y2]: [f64; 4], style: &str) {
        let _ =
            writeln!(self.0, "<line x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\" {style}/>");
    }

    /// A disc or ring with attributes of its fill and stroke; the title is shown as a tooltip.
    pub fn circle(&mut self, [x, y]: [f64; 2], radius: f64, style: &str, title: &str) {
        let _ = write!(self.0, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {style}");
        let _ = match title {
            "" => writeln!(self.0, "/>"),
            title => writeln!(self.0, "><title>{}</title></circle>", escaped(title)),
        };
    }

    /// An unfilled path, in SVG's own commands.
    pub fn path(&mut self, commands: &str, style: &str) {
        let _ = writeln!(self.0, "<path d=\"{commands}\" fill=\"none\" {style}/>");
    }

    /// Text with its start, middle or end at a point.
    pub fn text(&mut self, [x, y]: [f64; 2], anchor: &str, words: &str) {
        let words = escaped(words);
        let _ = writeln!(self.0, "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>");
    }

    /// Text that runs upwards, with its middle at a point.
    pub fn text_upwards(&mut self, [x, y]: [f64; 2], words: &str) {
        let words = escaped(words);
        let _ = writeln!(
            self.0,
            "<text transform=\"translate({x:.0} {y:.0}) rotate(-90)\" text-anchor=\"middle\">{words}</text>"
        );
    }

    /// Returns the complete file.
    pub fn finish(self) -> String {
        self.0 + "</svg>\n"
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// A logarithmic axis by whole decades.
pub struct LogAxis {
    /// Exponents of ten at its ends.
    decades: [i32; 2],
    /// Its ends on the page, pixels.
    pub pixels: [f64; 2],
}

impl LogAxis {
    /// Axis around all values, of one decade at least; from 1 to 10 without values.
    pub fn around(values: impl Iterator<Item = f64>, pixels: [f64; 2]) -> Self {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in values.map(libm::log10) {
            (low, high) = (low.min(value), high.max(value));
        }
        if low > high {
            return Self { decades: [0, 1], pixels };
        }
        let from = libm::floor(low) as i32;
        Self { decades: [from, (libm::ceil(high) as i32).max(from + 1)], pixels }
    }

    /// The pixel of a value, clamped to the axis.
    pub fn at(&self, value: f64) -> f64 {
        let [low, high] = self.decades.map(f64::from);
        let share = (libm::log10(value) - low) / (high - low);
        self.pixels[0] + share.clamp(0.0, 1.0) * (self.pixels[1] - self.pixels[0])
    }

    /// Exponents of the powers of ten on it.
    pub fn ticks(&self) -> impl Iterator<Item = i32> + use<> {
        self.decades[0]..=self.decades[1]
    }

    /// The least value on it.
    pub fn least(&self) -> f64 {
        libm::exp10(f64::from(self.decades[0]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_goes_by_whole_decades() {
        let axis = LogAxis::around([2e-3, 0.5].into_iter(), [0.0, 300.0]);
        assert_eq!(axis.ticks().collect::<Vec<_>>(), [-3, -2, -1, 0]);
        assert!((axis.at(1e-2) - 100.0).abs() < 1e-9 && axis.at(1e-9) == 0.0 && axis.at(9.0) == 300.0);
        assert_eq!(LogAxis::around([1.0].into_iter(), [0.0, 1.0]).ticks().count(), 2);
        assert_eq!(LogAxis::around([].into_iter(), [0.0, 1.0]).least(), 1.0);
    }

    #[test]
    fn words_are_escaped() {
        let mut picture = Picture::new(10.0, 10.0);
        picture.text([1.0, 2.0], "start", "a<b");
        assert!(
            picture
                .finish()
                .contains("<text x=\"1.0\" y=\"2.0\" text-anchor=\"start\">a&lt;b</text>\n</svg>")
        );
    }
}
