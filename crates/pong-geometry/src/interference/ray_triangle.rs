//! Ray (A) – triangle (B): hits on its front (docs/theory.md, 2.5), and on its back as the front of the
//! reversed triangle.
//!
//! The inside test projects the corners along the ray. The two projected coordinates of a corner are
//! bit-identical in all triangles that share it. On which side of an edge the ray passes is decided by
//! comparing two products. Rounding is monotonic: it may make the products equal, but never reverses the
//! comparison. Equal counts as inside. So a closed ring of triangles around the ray is always hit, at edges
//! and vertices too (after Woop, Benthin and Wald 2013, Watertight ray/triangle intersection).
//!
//! Degenerate cases: a ray through a shared edge or vertex hits one or more of its triangles, of which the
//! engine keeps the one of lowest index. A ray in the triangle's plane has no hit.

use super::Feature;
use super::ray_plane::{RayHit, hit_plane};
use crate::Vec3;
use crate::primitive::{Ray, TriangleSet};

/// Returns the hit of a ray on the front of a triangle; `None` if there is none. The triangle may lie up to
/// `reach` (m) behind the ray's origin.
#[inline(always)]
pub fn ray_triangle(ray: &Ray, set: &TriangleSet, triangle: u32, reach: f64) -> Option<RayHit> {
    hit_corners(ray, set.corners(triangle), triangle, reach)
}

/// Returns the hit of a ray on the back of a triangle: exactly the hit on the front of the reversed triangle.
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
    // The normal is normalised last, beside the division that finds the distance.
    let normal = (corners[1] - corners[0]).cross(&(corners[2] - corners[0]));
    let rise = normal.dot(&(corners[0] - ray.origin));
    let hit = hit_plane(ray, &normal, rise, reach, Feature::face(triangle as usize))?;
    Some(RayHit { normal_b: normal.normalize(), ..hit })
}

/// Returns `true` if the three corners run counter-clockwise around the ray, seen along it: the ray passes
/// inside.
///
/// The corners are projected to two coordinates perpendicular to the ray, their distances (not normalised)
/// from two planes through the ray. These are the components of `arm × direction`, with `arm` from the origin
/// to the corner, except the component along the dominant axis of the direction.
#[inline(always)]
fn passes_inside(ray: &Ray, corners: &[Vec3; 3]) -> bool {
    let direction = &ray.direction;
    let size = direction.abs();
    // Branch-free, because directions are unpredictable. Among equal components the first is dominant.
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
