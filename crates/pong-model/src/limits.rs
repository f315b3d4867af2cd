//! Limits of the numbers in a model.

/// Largest magnitude of a number in a model other than a rigid stiffness. The product of any stiffness with
/// two positions, lengths or factors of laws within it is finite.
pub const LARGEST: f64 = 1e100;

/// Maximum size of a primitive, m: a length, a radius, an edge, a thickness. Between the limits, the products
/// of up to four lengths in the contact tests stay within the range of numbers, and single precision can hold
/// the boxes around primitives.
pub const LARGEST_SIZE: f64 = 1e30;

/// Minimum size of a primitive, m: see [`LARGEST_SIZE`].
pub const SMALLEST_SIZE: f64 = 1e-30;

/// Fault of a number: rule, cause and cure.
pub(crate) type NumberFault = (&'static str, String, &'static str);

/// Fault of a number that must be finite; `None` if it is.
pub(crate) fn not_finite(value: f64) -> Option<NumberFault> {
    let told = || ("not-finite", format!("{value} is no finite number"), "give a finite number");
    (!value.is_finite()).then(told)
}

/// Fault of a number that must be finite and within ±[`LARGEST`]; `None` if it is.
pub(crate) fn out_of_range(value: f64) -> Option<NumberFault> {
    let beyond = || format!("{value:e} is beyond ±{LARGEST:e}");
    let too_large = || ("too-large", beyond(), "give a smaller number; check its unit");
    not_finite(value).or_else(|| (value.abs() > LARGEST).then(too_large))
}
