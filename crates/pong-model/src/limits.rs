//! Which numbers a model may hold.

/// Largest number of a model that is not a rigid stiffness, of either sign: with places, lengths and factors of laws within
/// it, products of any two, with any stiffness, are finite.
pub const LARGEST: f64 = 1e100;

/// Greatest and least size of a primitive, m: a length, a radius, an edge, a thickness. Within them no product of
/// lengths leaves the range of numbers, and single precision holds the boxes around primitives.
pub const LARGEST_SIZE: f64 = 1e30;

/// See [`LARGEST_SIZE`].
pub const SMALLEST_SIZE: f64 = 1e-30;

/// What is wrong with a number: rule, cause and cure.
pub(crate) type NumberFault = (&'static str, String, &'static str);

/// Of a number that must be finite.
pub(crate) fn not_finite(value: f64) -> Option<NumberFault> {
    let told = || ("not-finite", format!("{value} is no finite number"), "give a finite number");
    (!value.is_finite()).then(told)
}

/// Of a number that must be finite and not beyond [`LARGEST`].
pub(crate) fn out_of_range(value: f64) -> Option<NumberFault> {
    let beyond = || format!("{value:e} is beyond ±{LARGEST:e}");
    let too_large = || ("too-large", beyond(), "give a smaller number; check its unit");
    not_finite(value).or_else(|| (value.abs() > LARGEST).then(too_large))
}
