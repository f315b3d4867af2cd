//! Ray (A) – triangle (B), from the front (physics contract, 2.5).
//!
//! Degenerate cases: a ray through a shared edge or vertex hits every triangle there (the engine keeps the
//! lowest); a ray in the triangle's plane hits nothing.

use super::Feature;
use super::ray_plane::{RayHit, hit_plane};
use super::triangle_features::TriangleView;
use crate::primitive::{Ray, TriangleSet};

/// Where a ray hits a triangle. `reach` (m) is how far behind the ray's origin the triangle may lie.
pub fn ray_triangle(ray: &Ray, set: &TriangleSet, triangle: u32, reach: f64) -> Option<RayHit> {
    let view = TriangleView::new(set, triangle);
    let inside = (0..3).all(|k| {
        // The triple product is taken over the ends in one order for both faces of the edge, so that no ray
        // slips between them.
        let [first, second] = view.edge_ends(k);
        let product = ray.direction.dot(&(first - ray.origin).cross(&(second - ray.origin)));
        if first == view.corners[k] { product <= 0.0 } else { product >= 0.0 }
    });
    if !inside {
        return None;
    }
    hit_plane(ray, &view.normal, -view.height(&ray.origin), reach, Feature::face(triangle as usize))
}
