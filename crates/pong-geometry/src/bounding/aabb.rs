//! Axis-aligned bounding box in the group frame. It is exact: it follows from the minimum and maximum
//! coordinates.

use super::volume::Volume;
use crate::Vec3;

/// Returns the box around points, with margin; `None` if there are no points.
pub fn aabb_of_points(points: impl IntoIterator<Item = Vec3>) -> Option<Volume> {
    points
        .into_iter()
        .map(|p| (p, p))
        .reduce(|(min, max), (p, _)| (min.inf(&p), max.sup(&p)))
        .map(|(min, max)| fit_aabb_bounds(min, max))
}

/// Returns the box between minimum and maximum coordinates (m), grown by [`super::RELATIVE_MARGIN`].
pub fn fit_aabb_bounds(min: Vec3, max: Vec3) -> Volume {
    Volume::Aabb { center: (min + max) * 0.5, half: (max - min) * 0.5 }.inflated()
}
