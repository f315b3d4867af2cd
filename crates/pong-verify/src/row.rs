//! A quantity with its expected and its measured value.

/// Tolerance of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// |got − expected| ≤ bound·|expected|.
    Relative(f64),
    /// |got − expected| ≤ bound, in the unit of the quantity.
    Absolute(f64),
    /// |got| ≤ bound: the expected value is zero.
    Below(f64),
    /// got ≥ expected − bound: larger is better.
    AtLeast(f64),
}

/// One line of the report.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the quantity.
    pub quantity: String,
    /// Closed-form value, in `unit`.
    pub expected: f64,
    /// Measured value, in `unit`.
    pub got: f64,
    /// Tolerance.
    pub bound: Bound,
    /// Unit of both values.
    pub unit: &'static str,
    /// Order in the step, observed by halving it; no unit.
    pub order: Option<f64>,
}

impl Row {
    /// A value with a relative tolerance.
    pub fn relative(
        quantity: impl Into<String>,
        unit: &'static str,
        expected: f64,
        got: f64,
        tolerance: f64,
    ) -> Self {
        Self::new(quantity.into(), unit, expected, got, Bound::Relative(tolerance))
    }

    /// A value with an absolute tolerance.
    pub fn absolute(
        quantity: impl Into<String>,
        unit: &'static str,
        expected: f64,
        got: f64,
        tolerance: f64,
    ) -> Self {
        Self::new(quantity.into(), unit, expected, got, Bound::Absolute(tolerance))
    }

    /// A value that should be zero.
    pub fn below(quantity: impl Into<String>, unit: &'static str, got: f64, bound: f64) -> Self {
        Self::new(quantity.into(), unit, 0.0, got, Bound::Below(bound))
    }

    /// A lower limit with a tolerance.
    pub fn at_least(
        quantity: impl Into<String>,
        unit: &'static str,
        expected: f64,
        got: f64,
        tolerance: f64,
    ) -> Self {
        Self::new(quantity.into(), unit, expected, got, Bound::AtLeast(tolerance))
    }

    /// An integer that must match exactly.
    pub fn count(quantity: impl Into<String>, expected: usize, got: usize) -> Self {
        Self::new(quantity.into(), "", expected as f64, got as f64, Bound::Absolute(0.0))
    }

    fn new(quantity: String, unit: &'static str, expected: f64, got: f64, bound: Bound) -> Self {
        Self { quantity, expected, got, bound, unit, order: None }
    }

    /// Adds the observed order.
    pub fn with_order(self, order: f64) -> Self {
        Self { order: Some(order), ..self }
    }

    /// |got − expected|; for a lower limit, the shortfall.
    pub fn error(&self) -> f64 {
        match self.bound {
            // `max` would turn NaN into a shortfall of zero.
            Bound::AtLeast(_) if self.got > self.expected => 0.0,
            _ => (self.got - self.expected).abs(),
        }
    }

    /// The largest error allowed, in the unit of the quantity.
    pub fn allowed(&self) -> f64 {
        match self.bound {
            Bound::Relative(tolerance) => tolerance * self.expected.abs(),
            Bound::Absolute(tolerance) | Bound::Below(tolerance) | Bound::AtLeast(tolerance) => tolerance,
        }
    }

    /// True if the error is within the tolerance; false for NaN.
    pub fn passes(&self) -> bool {
        self.error() <= self.allowed()
    }

    /// The expected value as text.
    pub fn expected_text(&self) -> String {
        match self.bound {
            Bound::Below(_) => "0".to_owned(),
            Bound::AtLeast(_) => format!("≥ {}", self.expected),
            _ => self.value_text(self.expected),
        }
    }

    /// The measured value as text.
    pub fn got_text(&self) -> String {
        match self.bound {
            Bound::Below(bound) => small(self.got.abs(), bound),
            Bound::AtLeast(_) => format!("{:.1}", self.got),
            _ => self.value_text(self.got),
        }
    }

    /// The error as text, in the terms of the tolerance.
    pub fn error_text(&self) -> String {
        match self.bound {
            Bound::Relative(tolerance) => small(self.error() / self.expected.abs(), tolerance),
            Bound::Absolute(tolerance) | Bound::Below(tolerance) | Bound::AtLeast(tolerance) => {
                small(self.error(), tolerance)
            }
        }
    }

    /// The tolerance as text.
    pub fn tolerance_text(&self) -> String {
        match self.bound {
            Bound::Relative(tolerance) => format!("{} rel.", short(tolerance)),
            Bound::Absolute(0.0) => "exact".to_owned(),
            Bound::Absolute(tolerance) | Bound::Below(tolerance) | Bound::AtLeast(tolerance) => {
                short(tolerance)
            }
        }
    }

    /// The order as text.
    pub fn order_text(&self) -> String {
        self.order.map_or(String::new(), |order| format!("{order:.1}"))
    }

    /// Text with the digits that the tolerance resolves, and one more.
    fn value_text(&self, value: f64) -> String {
        let allowed = self.allowed();
        let scale = if self.expected == 0.0 { value.abs() } else { self.expected.abs() };
        if allowed == 0.0 || scale == 0.0 || !value.is_finite() {
            return format!("{}", value + 0.0);
        }
        // Slightly less, so that rounding of a power of ten adds no digit.
        let digits = (libm::ceil(libm::log10(scale / allowed) - 1e-6) as i64 + 1).clamp(4, 15) as usize;
        significant(value, digits, self.expected)
    }
}

/// A value with the decimals that give `digits` significant digits to `like`.
fn significant(value: f64, digits: usize, like: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let size = if like == 0.0 { value.abs() } else { like.abs() };
    let exponent = libm::floor(libm::log10(size)) as i64;
    if !(-4..7).contains(&exponent) {
        return format!("{value:.*e}", digits - 1);
    }
    let decimals = (digits as i64 - 1 - exponent).max(0) as usize;
    format!("{value:.decimals$}")
}

/// Text of an error beside its tolerance. Far below the tolerance it is rounding noise, whose digits are not
/// reported.
fn small(value: f64, tolerance: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    if value < tolerance * 1e-3 {
        return format!("< {}", short(tolerance * 1e-3));
    }
    if value >= 1e-2 { format!("{value:.2}") } else { format!("{value:.0e}") }
}

fn short(value: f64) -> String {
    let plain = format!("{value:.3e}");
    let (mantissa, exponent) = plain.split_once('e').unwrap_or((&plain, "0"));
    let mantissa = mantissa.trim_end_matches('0').trim_end_matches('.');
    match exponent {
        "0" => mantissa.to_owned(),
        "-1" | "-2" | "1" | "2" => format!("{}", mantissa_times(mantissa, exponent)),
        _ => format!("{mantissa}e{exponent}"),
    }
}

fn mantissa_times(mantissa: &str, exponent: &str) -> f64 {
    format!("{mantissa}e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_follow_the_tolerance() {
        let row = Row::relative("depth", "m", 9.81e-5, 9.81e-5 * (1.0 + 1e-13), 1e-9);
        assert_eq!(row.expected_text(), "9.810000000e-5");
        assert_eq!(row.got_text(), row.expected_text());
        assert_eq!(row.error_text(), "< 1e-12");
        assert!(row.passes());
    }

    #[test]
    fn nothing_passes_with_nan() {
        assert!(!Row::relative("x", "", 1.0, f64::NAN, 1.0).passes());
        assert!(!Row::below("x", "", f64::NAN, 1.0).passes());
        assert!(!Row::count("x", 3, 2).passes());
        assert!(!Row::at_least("x", "", 2.0, f64::NAN, 1.0).passes());
    }

    #[test]
    fn more_than_is_asked_passes_and_less_does_not() {
        let row = |got| Row::at_least("order", "", 2.0, got, 0.2);
        assert!(row(1.81).passes() && row(4.0).passes() && !row(1.79).passes());
        assert_eq!(row(4.0).expected_text(), "≥ 2");
    }

    #[test]
    fn tolerances_are_short() {
        assert_eq!(short(1e-9), "1e-9");
        assert_eq!(short(0.1), "0.1");
        assert_eq!(short(0.015), "0.015");
        assert_eq!(short(2.5e-4), "2.5e-4");
    }
}
