//! Ray (A) – triangle (B), from the front (physics contract, 2.5).
//!
//! Whether the ray passes inside is decided seen along it: every corner gets two coordinates across the ray, the
//! same bits for every triangle that shares it, and the sense in which an edge passes the ray is the comparison of
//! two products. Rounding is monotonic, so that comparison may come out even but never the wrong way round: with
//! "even" counted as inside, what encloses the ray in the plane of those coordinates is hit, at edges and at
//! vertices too (after Woop, Benthin and Wald 2013, Watertight ray/triangle intersection).
//!
//! Degenerate cases: a ray through a shared edge or vertex hits one or more triangles there (the engine keeps the
//! lowest); a ray in the triangle's plane hits nothing.

use super::Feature;
use super::ray_plane::{RayHit, hit_plane};
use super::triangle_features::TriangleView;
use crate::Vec3;
use crate::primitive::{Ray, TriangleSet};

/// Where a ray hits a triangle. `reach` (m) is how far behind the ray's origin the triangle may lie.
pub fn ray_triangle(ray: &Ray, set: &TriangleSet, triangle: u32, reach: f64) -> Option<RayHit> {
    let across = set.corners(triangle).map(|corner| across_ray(ray, &corner));
    let passes = |k: usize| {
        let ([ax, ay], [bx, by]) = (across[k], across[(k + 1) % 3]);
        ax * by <= ay * bx
    };
    if !(passes(0) && passes(1) && passes(2)) {
        return None;
    }
    let view = TriangleView::new(set, triangle);
    hit_plane(ray, &view.normal, -view.height(&ray.origin), reach, Feature::face(triangle as usize))
}

/// Where a point lies across the ray: its distances from two planes through the ray (not normalised).
#[inline]
fn across_ray(ray: &Ray, point: &Vec3) -> [f64; 2] {
    let d = &ray.direction;
    let main = d.iamax();
    // Seen along the ray, first and second turn counter-clockwise.
    let (first, second) = ((main + 1) % 3, (main + 2) % 3);
    let (first, second) = if d[main] > 0.0 { (first, second) } else { (second, first) };
    let arm = point - ray.origin;
    [arm[first] * d[main] - d[first] * arm[main], arm[second] * d[main] - d[second] * arm[main]]
}
