//! Ray (A) – triangle (B), from the front (docs/theory.md, 2.5).
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
#[inline(always)]
pub fn ray_triangle(ray: &Ray, set: &TriangleSet, triangle: u32, reach: f64) -> Option<RayHit> {
    hit_corners(ray, set.corners(triangle), triangle, reach)
}

/// Where a ray hits the back of a triangle. It does exactly where it would hit the triangle turned over.
#[inline]
pub fn ray_back_of_triangle(ray: &Ray, set: &TriangleSet, triangle: u32, reach: f64) -> Option<RayHit> {
    let [first, second, third] = set.corners(triangle);
    hit_corners(ray, [first, third, second], triangle, reach)
}

#[inline(always)]
fn hit_corners(ray: &Ray, corners: [Vec3; 3], triangle: u32, reach: f64) -> Option<RayHit> {
    if !passes_inside(ray, &corners) {
        return None;
    }
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0])).normalize();
    let view = TriangleView { index: triangle, corners, normal };
    hit_plane(ray, &view.normal, -view.height(&ray.origin), reach, Feature::face(triangle as usize))
}

/// Whether the corners turn about the ray counter-clockwise, seen along it.
///
/// Two coordinates across the ray, distances from two planes through it (not normalised), are the components of
/// `arm × direction` beside the direction's main one.
#[inline(always)]
fn passes_inside(ray: &Ray, corners: &[Vec3; 3]) -> bool {
    let direction = &ray.direction;
    let size = direction.abs();
    // Without branches, as directions follow no pattern. Of equal ones the first is the main one.
    let y_before_x = size.y > size.x;
    let is_z = size.z > if y_before_x { size.y } else { size.x };
    let main = |x: f64, y: f64, z: f64| {
        let of_two = if y_before_x { y } else { x };
        if is_z { z } else { of_two }
    };
    let is_forward = main(direction.x, direction.y, direction.z) > 0.0;
    let across = corners.map(|corner| {
        let product = (corner - ray.origin).cross(direction);
        [main(product.y, product.z, product.x), main(product.z, product.x, product.y)]
    });
    let passes = |k: usize| {
        let ([ax, ay], [bx, by]) = (across[k], across[(k + 1) % 3]);
        if is_forward { ax * by <= ay * bx } else { ax * by >= ay * bx }
    };
    passes(0) & passes(1) & passes(2)
}
