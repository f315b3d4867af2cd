//! Point (A) – plane (B): the plane is the half space `normal · x ≤ offset`.

use super::{Feature, Interference};
use crate::primitive::{Plane, Point};

/// Returns the contact of a point below a plane; `None` for a point above or on it.
pub fn point_plane(point: &Point, plane: &Plane) -> Option<Interference> {
    let depth = -plane.height(&point.position);
    (depth > 0.0).then_some(Interference {
        depth,
        normal_b: plane.normal,
        deepest_b: point.position,
        feature: Feature::WHOLE,
    })
}
