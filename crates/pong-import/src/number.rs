//! Numbers as their authors typed them: from single precision, and after transforms.

use nalgebra::Vector3;

/// Shortest decimal that rounds to `value` in single precision: 0.1f32 becomes 0.1, not 0.10000000149011612.
/// Strictly monotonic.
pub fn widened(value: f32) -> f64 {
    if value == value.trunc() && value.abs() < 1e7 {
        return f64::from(value);
    }
    let mut digits = [0u8; 64];
    let text = {
        use std::io::Write;
        let mut rest: &mut [u8] = &mut digits;
        let _ = write!(rest, "{value:e}");
        let left = rest.len();
        &digits[..64 - left]
    };
    std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()).unwrap_or(f64::from(value))
}

/// Rounds to a decimal grid a dozen digits below the size of a model.
///
/// Products of transforms leave 0.30000000000000004 where 0.3 is meant; points that differ only in the last
/// bit would otherwise be separate vertices.
#[derive(Clone, Copy, Debug)]
pub struct Grid {
    per_unit: f64,
}

/// Digits kept below the leading one of the model's size.
const DIGITS: i32 = 13;

impl Grid {
    /// The grid for coordinates of at most this size.
    pub fn of_size(size: f64) -> Self {
        let leading = if size > 0.0 && size.is_finite() { size.log10().floor() as i32 } else { 0 };
        // Powers of ten are exact up to 1e22; larger models need no rounding.
        Self { per_unit: 10f64.powi((DIGITS - leading).clamp(0, 22)) }
    }

    pub fn round(self, value: f64) -> f64 {
        let scaled = value * self.per_unit;
        // Above 2^53 every number is an integer.
        if scaled.abs() < 9e15 { scaled.round_ties_even() / self.per_unit + 0.0 } else { value }
    }

    pub fn round_place(self, place: &Vector3<f64>) -> Vector3<f64> {
        place.map(|x| self.round(x))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_becomes_the_decimal_it_was_typed_as() {
        for (value, expected) in
            [(0.1f32, 0.1), (-12.375, -12.375), (1e-30, 1e-30), (16_777_216.0, 16_777_216.0)]
        {
            assert_eq!(widened(value), expected);
        }
        assert_eq!(widened(f32::MAX) as f32, f32::MAX);
        assert!(widened(f32::NAN).is_nan());
    }

    #[test]
    fn the_grid_keeps_what_is_typed_and_drops_what_products_leave() {
        let grid = Grid::of_size(3.0);
        assert_eq!(grid.round(0.1 + 0.2), 0.3);
        assert_eq!(grid.round(2.2e-16).to_bits(), 0);
        assert_eq!(grid.round(-1e-17).to_bits(), 0);
        assert_eq!(Grid::of_size(1e-3).round(1.23456789012e-4), 1.23456789012e-4);
        assert_eq!(Grid::of_size(1e30).round(1e30), 1e30);
    }
}
