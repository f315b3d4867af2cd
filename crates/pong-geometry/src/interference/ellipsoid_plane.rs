//! Ellipsoid (A) – plane `n·x = d` (B): depth `d − n·c + √Σ(aᵢ·nᵢ)²`, with the centre c and the semi-axes aᵢ.

use super::{Feature, Interference};
use crate::primitive::{Ellipsoid, Plane};

/// Tests an ellipsoid (A) against a half space (B). `None` unless the ellipsoid extends below the plane.
pub fn ellipsoid_plane(e: &Ellipsoid, plane: &Plane) -> Option<Interference> {
    let depth = e.half_width(&plane.normal) - plane.height(&e.center);
    (depth > 0.0).then(|| Interference {
        depth,
        normal_b: plane.normal,
        deepest_b: e.support(&-plane.normal),
        feature: Feature::WHOLE,
    })
}
