//! Fitting a box along the frame's axes: exact, from the least and greatest coordinates.

use super::volume::Volume;
use crate::Vec3;

/// The box around points, margin included; `None` if there are none.
pub fn aabb_of_points(points: impl IntoIterator<Item = Vec3>) -> Option<Volume> {
    points
        .into_iter()
        .map(|p| (p, p))
        .reduce(|(min, max), (p, _)| (min.inf(&p), max.sup(&p)))
        .map(|(min, max)| fit_aabb_bounds(min, max))
}

/// The box between the least and greatest coordinates (m), grown by [`super::RELATIVE_MARGIN`].
pub fn fit_aabb_bounds(min: Vec3, max: Vec3) -> Volume {
    Volume::Aabb { center: (min + max) * 0.5, half: (max - min) * 0.5 }.inflated()
}
