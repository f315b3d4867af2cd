//! Format of numbers in the tables and the plot.

/// A relative error as per cent, with three digits.
pub(crate) fn percent(error: f64) -> String {
    let value = 100.0 * error;
    match value {
        0.0 => "0".to_owned(),
        v if !v.is_finite() => "–".to_owned(),
        v if v < 1e-3 => format!("{v:.1e}"),
        v if v == v.round() && v < 100.0 => format!("{v}"),
        v => digits(v),
    }
}

/// Three digits without an exponent where that is short.
pub(crate) fn digits(value: f64) -> String {
    match value.abs() {
        v if v >= 1e5 => format!("{value:.1e}"),
        v if v >= 100.0 => format!("{value:.0}"),
        v if v >= 10.0 => format!("{value:.1}"),
        v if v >= 1.0 => format!("{value:.2}"),
        v if v >= 0.1 => format!("{value:.3}"),
        v if v >= 0.01 => format!("{value:.4}"),
        v if v >= 0.001 => format!("{value:.5}"),
        _ => format!("{value:.1e}"),
    }
}

/// Nanoseconds as microseconds.
pub(crate) fn microseconds(ns: u64) -> String {
    digits(ns as f64 / 1e3)
}
