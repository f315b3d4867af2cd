//! Boxes, areas and outlines of points.

use nalgebra::Vector3;

/// Lowest and highest coordinates; zeros for no points.
pub fn bounds(places: &[Vector3<f64>]) -> (Vector3<f64>, Vector3<f64>) {
    let first = places.first().copied().unwrap_or_default();
    places.iter().fold((first, first), |(low, high), place| (low.inf(place), high.sup(place)))
}

/// Twice the area along the normal.
pub fn area_vector([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a))
}

/// Each corner of an outline with the next one.
pub fn ring<T: Copy>(outline: &[T]) -> impl Iterator<Item = (T, T)> + '_ {
    outline.iter().copied().zip(outline.iter().copied().cycle().skip(1))
}
